//! Unpacks the samples of a row: any number of bits, either order of bytes.

use exr::prelude::f16;

/// How the samples of a row are stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packing {
    /// Bits of a sample.
    pub bits: u32,
    pub big_endian: bool,
}

/// A type that samples are unpacked to.
pub(super) trait Sample: Copy + Default {
    /// Unpacks as many samples as `out` holds; `row` is long enough.
    fn unpack(row: &[u8], packing: Packing, out: &mut [Self]);
}

impl Sample for u8 {
    fn unpack(row: &[u8], packing: Packing, out: &mut [Self]) {
        if packing.bits == 8 {
            out.copy_from_slice(&row[..out.len()]);
        } else {
            unpack_integers(row, packing, out, |value| value as Self);
        }
    }
}

impl Sample for u16 {
    fn unpack(row: &[u8], packing: Packing, out: &mut [Self]) {
        unpack_integers(row, packing, out, |value| value as Self);
    }
}

impl Sample for u32 {
    fn unpack(row: &[u8], packing: Packing, out: &mut [Self]) {
        unpack_integers(row, packing, out, |value| value as Self);
    }
}

impl Sample for f32 {
    /// Half floats and floats of 24 bits are widened, doubles rounded.
    fn unpack(row: &[u8], packing: Packing, out: &mut [Self]) {
        let float: fn(u64) -> Self = match packing.bits {
            16 => |bits| f16::from_bits(bits as u16).to_f32(),
            24 => |bits| of_24_bits(bits as u32),
            32 => |bits| Self::from_bits(bits as u32),
            _ => |bits| f64::from_bits(bits) as Self,
        };
        unpack_integers(row, packing, out, float);
    }
}

/// Whole bytes have the file's order of bytes; other samples follow one another, the highest bit first.
fn unpack_integers<T>(row: &[u8], packing: Packing, out: &mut [T], convert: impl Fn(u64) -> T) {
    let append = |number: u64, &byte: &u8| (number << 8) | u64::from(byte);
    if packing.bits.is_multiple_of(8) {
        let bytes = row.chunks_exact(packing.bits as usize / 8);
        for (out, bytes) in out.iter_mut().zip(bytes) {
            *out = convert(if packing.big_endian {
                bytes.iter().fold(0, append)
            } else {
                bytes.iter().rev().fold(0, append)
            });
        }
        return;
    }
    let mask = (1u64 << packing.bits) - 1;
    let (mut buffer, mut held) = (0u64, 0);
    let mut bytes = row.iter();
    for out in out {
        // At most 31 bits are missing of a sample and 7 are held, so that 64 bits suffice.
        while held < packing.bits {
            buffer = append(buffer, bytes.next().unwrap_or(&0));
            held += 8;
        }
        held -= packing.bits;
        *out = convert((buffer >> held) & mask);
    }
}

/// A float of a sign, 7 bits of exponent with the bias 63, and 16 bits of fraction (TIFF Technical Note 3).
fn of_24_bits(bits: u32) -> f32 {
    let sign = if bits >> 23 == 1 { -1.0 } else { 1.0 };
    let (exponent, fraction) = ((bits >> 16) & 0x7F, (bits & 0xFFFF) as f32 / 65536.0);
    sign * match exponent {
        0 => fraction * 2f32.powi(-62),
        127 if fraction == 0.0 => f32::INFINITY,
        127 => f32::NAN,
        exponent => (1.0 + fraction) * 2f32.powi(exponent as i32 - 63),
    }
}

/// Undoes the predictor of a row of pixels of `bands` samples (TIFF 6.0, section 14, and Technical Note 3). Returns whether
/// the bytes of the row are big-endian afterwards.
pub(super) fn undo_predictor(row: &mut [u8], predictor: u64, bands: usize, packing: Packing) -> bool {
    let bytes = packing.bits as usize / 8;
    match predictor {
        2 => undo_differences(row, bytes, bands, packing.big_endian),
        3 => {
            undo_differences(row, 1, bands, true);
            gather_bytes(row, bytes);
            return true;
        }
        _ => {}
    }
    packing.big_endian
}

/// Replaces each sample by its sum with the sample of the same band of the pixel before.
fn undo_differences(row: &mut [u8], bytes: usize, bands: usize, big_endian: bool) {
    let stride = bytes * bands;
    for at in (stride..(row.len() / bytes) * bytes).step_by(bytes) {
        let mut carry = 0;
        for place in 0..bytes {
            // From the lowest byte to the highest.
            let byte = if big_endian { bytes - 1 - place } else { place };
            let sum = u16::from(row[at + byte]) + u16::from(row[at + byte - stride]) + carry;
            row[at + byte] = sum as u8;
            carry = sum >> 8;
        }
    }
}

/// The floating-point predictor stores the highest bytes of all samples first, then the second ones, and so on.
fn gather_bytes(row: &mut [u8], bytes: usize) {
    let apart = row.to_vec();
    let samples = row.len() / bytes;
    for (index, sample) in row.chunks_exact_mut(bytes).enumerate() {
        for (byte, out) in sample.iter_mut().enumerate() {
            *out = apart[byte * samples + index];
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn samples_of_any_number_of_bits() {
        let unpacked = |row: &[u8], bits| {
            let mut out = [0u16; 2];
            u16::unpack(row, Packing { bits, big_endian: false }, &mut out);
            out
        };
        assert_eq!(unpacked(&[0xAB, 0xCD, 0xEF], 12), [0xABC, 0xDEF]);
        assert_eq!(unpacked(&[0xFF, 0xC0, 0x10], 10), [0x3FF, 0x001]);
        assert_eq!(unpacked(&[0x34, 0x12, 0x78, 0x56], 16), [0x1234, 0x5678]);
        let mut wide = [0u32; 1];
        u32::unpack(&[3, 2, 1], Packing { bits: 24, big_endian: false }, &mut wide);
        assert_eq!(wide, [0x01_02_03]);
    }

    #[test]
    fn floats_of_24_bits() {
        assert_eq!([0x3F_0000, 0x40_8000, 0xBF_0000].map(of_24_bits), [1.0, 3.0, -1.0]);
        assert!(of_24_bits(0x7F_0001).is_nan() && of_24_bits(0x7F_0000).is_infinite());
    }

    #[test]
    fn differences_carry_over_bytes_in_either_order() {
        let packing = |big_endian| Packing { bits: 16, big_endian };
        let mut little = [0xFF, 0x00, 0x02, 0x00];
        undo_predictor(&mut little, 2, 1, packing(false));
        assert_eq!(little, [0xFF, 0x00, 0x01, 0x01]);
        let mut big = [0x00, 0xFF, 0x00, 0x02];
        undo_predictor(&mut big, 2, 1, packing(true));
        assert_eq!(big, [0x00, 0xFF, 0x01, 0x01]);
    }
}
