//! The compressions of strips and tiles (tag 259).

use super::page::Page;
use super::photometric;
use crate::photo::coding::Compression;
use crate::photo::decode::jpeg::{self, Color, Header};
use crate::photo::error::{CONVERT, Fault};
use std::borrow::Cow;
use std::io::Read;
use weezl::BitOrder;
use weezl::decode::Decoder as LzwDecoder;

pub(super) const NONE: u64 = 1;
pub(super) const FAX_4: u64 = 4;
const LZW: u64 = 5;
pub(super) const JPEG: u64 = 7;
const DEFLATE: u64 = 8;
pub(super) const PACK_BITS: u64 = 32773;
const OLD_DEFLATE: u64 = 32946;
const ZSTD: u64 = 50000;

/// Compressions that are not supported, with their names.
const UNSUPPORTED: [(u64, &str); 17] = [
    (2, "CCITT run lengths"),
    (3, "CCITT fax group 3"),
    (6, "old-style JPEG"),
    (9, "JBIG"),
    (10, "JBIG"),
    (32766, "NeXT"),
    (32771, "CCITT run lengths"),
    (32809, "ThunderScan"),
    (34661, "JBIG"),
    (34676, "SGI LogLuv"),
    (34677, "SGI LogLuv"),
    (34712, "JPEG 2000"),
    (34887, "LERC"),
    (34925, "LZMA"),
    (50001, "WebP"),
    (50002, "JPEG XL"),
    (52546, "JPEG XL"),
];

/// Fails for a compression that this program does not read.
pub(super) fn expect_supported(compression: u64) -> Result<(), Fault> {
    match compression {
        NONE | FAX_4 | LZW | JPEG | DEFLATE | PACK_BITS | OLD_DEFLATE | ZSTD => Ok(()),
        other => {
            let named = UNSUPPORTED.iter().find(|(number, _)| *number == other);
            let name = named.map_or_else(|| format!("number {other}"), |(_, name)| (*name).to_owned());
            Err(Fault::unsupported(format!("the compression {name}"), CONVERT))
        }
    }
}

/// What the compression of a page does to its values.
pub(super) fn of_page(page: &Page) -> Result<Compression, Fault> {
    if page.compression != JPEG {
        return Ok(Compression::Lossless);
    }
    Ok(Header::of_file(&jpeg_stream(page, stored(page, 0)?)?)?.compression())
}

/// The decompressed bytes of a strip or tile: at least `rows` rows of `row_bytes` bytes.
pub(super) fn chunk<'a>(
    page: &Page<'a>,
    index: usize,
    rows: usize,
    row_bytes: usize,
) -> Result<Cow<'a, [u8]>, Fault> {
    let needed = rows.checked_mul(row_bytes).filter(|&bytes| isize::try_from(bytes).is_ok());
    let needed = needed.ok_or_else(|| Fault::damaged("its strips or tiles are too large"))?;
    let stored = stored(page, index)?;
    // JPEG data are a stream of their own, which the order of bits does not concern.
    let stored: Cow<'a, [u8]> = if page.reversed_bits && page.compression != JPEG {
        Cow::Owned(stored.iter().map(|byte| byte.reverse_bits()).collect())
    } else {
        Cow::Borrowed(stored)
    };
    let data: Cow<'a, [u8]> = match page.compression {
        NONE => stored,
        LZW => Cow::Owned(lzw(&stored, needed)?),
        DEFLATE | OLD_DEFLATE => Cow::Owned(all_of(flate2::read::ZlibDecoder::new(&stored[..]), needed)?),
        ZSTD => {
            let decoder = ruzstd::decoding::StreamingDecoder::new(&stored[..]).map_err(Fault::damaged)?;
            Cow::Owned(all_of(decoder, needed)?)
        }
        PACK_BITS => Cow::Owned(pack_bits(&stored, needed)),
        FAX_4 => Cow::Owned(fax_4(&stored, page.chunk.0, rows, row_bytes)?),
        _ => Cow::Owned(jpeg_samples(page, &stored, rows)?),
    };
    if data.len() < needed {
        return Err(Fault::damaged("its strips or tiles end too early"));
    }
    Ok(data)
}

/// The bytes of a strip or tile as they are in the file.
fn stored<'a>(page: &Page<'a>, index: usize) -> Result<&'a [u8], Fault> {
    let outside = || Fault::damaged("its strips or tiles lie outside of the file");
    let offset = page.offsets.get(index).and_then(|&offset| usize::try_from(offset).ok());
    let rest = offset.and_then(|offset| page.bytes.get(offset..)).ok_or_else(outside)?;
    match page.counts.get(index).and_then(|&count| usize::try_from(count).ok()) {
        // A page may lack the numbers of bytes; some writers state 0.
        None | Some(0) => Ok(rest),
        // Data without compression that end too early are found to be short by their length.
        Some(count) => Ok(&rest[..count.min(rest.len())]),
    }
}

/// Reads `needed` bytes, or as many as there are.
fn all_of(decoder: impl Read, needed: usize) -> Result<Vec<u8>, Fault> {
    let mut data = Vec::new();
    decoder.take(needed as u64).read_to_end(&mut data).map_err(Fault::damaged)?;
    Ok(data)
}

/// Number of bytes by which the decompressed bytes grow, so that a short file does not take the memory of a long one.
const LZW_STEP: usize = 1 << 16;

/// LZW of TIFF 6.0 (section 13), or of earlier programs, which write the lowest bit first and change the code length later.
/// The first code, 256, tells the orders apart.
fn lzw(stored: &[u8], needed: usize) -> Result<Vec<u8>, Fault> {
    let mut decoder = match stored {
        [0, second, ..] if second & 1 == 1 => LzwDecoder::new(BitOrder::Lsb, 8),
        _ => LzwDecoder::with_tiff_size_switch(BitOrder::Msb, 8),
    };
    let mut data = Vec::new();
    let mut rest = stored;
    while data.len() < needed {
        let begin = data.len();
        data.resize((begin + LZW_STEP).min(needed), 0);
        let result = decoder.decode_bytes(rest, &mut data[begin..]);
        data.truncate(begin + result.consumed_out);
        rest = &rest[result.consumed_in..];
        match result.status.map_err(Fault::damaged)? {
            weezl::LzwStatus::Ok => {}
            weezl::LzwStatus::NoProgress | weezl::LzwStatus::Done => break,
        }
    }
    Ok(data)
}

/// `PackBits` (TIFF 6.0, section 9): a byte n below 128 stands before n + 1 bytes, one above 128 before a byte that counts
/// 257 − n times.
fn pack_bits(stored: &[u8], needed: usize) -> Vec<u8> {
    let mut data = Vec::new();
    let mut rest = stored;
    while data.len() < needed {
        let Some((&head, after)) = rest.split_first() else { break };
        let head = usize::from(head);
        rest = match head {
            0..128 => {
                let literal = &after[..(head + 1).min(after.len())];
                data.extend_from_slice(literal);
                &after[literal.len()..]
            }
            128 => after,
            _ => {
                let Some((&value, after)) = after.split_first() else { break };
                data.resize(data.len() + 257 - head, value);
                after
            }
        };
    }
    data
}

/// CCITT fax group 4: black runs become ones.
fn fax_4(stored: &[u8], columns: usize, rows: usize, row_bytes: usize) -> Result<Vec<u8>, Fault> {
    let too_large = || Fault::unsupported("a fax of more than 65535 columns or rows", CONVERT);
    let width = u16::try_from(columns).map_err(|_| too_large())?;
    let height = u16::try_from(rows).map_err(|_| too_large())?;
    let mut data = vec![0; rows * row_bytes];
    let mut lines = data.chunks_exact_mut(row_bytes);
    let decoded = fax::decoder::decode_g4(stored.iter().copied(), width, Some(height), |transitions| {
        if let Some(line) = lines.next() {
            for (x, color) in fax::decoder::pels(transitions, width).enumerate() {
                line[x / 8] |= u8::from(color == fax::Color::Black) << (7 - x % 8);
            }
        }
    });
    decoded.map(|()| data).ok_or_else(|| Fault::damaged("its fax data are broken"))
}

/// A whole JPEG stream: the shared tables without their end marker, and the strip without its start marker.
fn jpeg_stream(page: &Page, stored: &[u8]) -> Result<Vec<u8>, Fault> {
    let cut = || Fault::damaged("its JPEG data end too early");
    match page.jpeg_tables {
        None => Ok(stored.to_vec()),
        Some(tables) => {
            let tables = tables.strip_suffix(&[0xFF, 0xD9]).unwrap_or(tables);
            Ok([tables, stored.get(2..).ok_or_else(cut)?].concat())
        }
    }
}

fn jpeg_samples(page: &Page, stored: &[u8], rows: usize) -> Result<Vec<u8>, Fault> {
    let stream = jpeg_stream(page, stored)?;
    let header = Header::of_file(&stream)?;
    header.expect_supported()?;
    header.expect_enough_bytes(stream.len())?;
    let fits = header.width as usize == page.chunk.0
        && header.height as usize >= rows
        && header.height as usize <= page.chunk.1
        && header.components.len() == page.bands_of_chunk();
    if !fits {
        return Err(Fault::damaged("its JPEG data do not fit its strips or tiles"));
    }
    let is_ycbcr = page.photometric == photometric::YCBCR;
    let samples = jpeg::samples(&stream, &header, if is_ycbcr { Color::FromYcbcr } else { Color::AsStored })?;
    if samples.flaw.is_some() {
        return Err(Fault::damaged("its JPEG data are broken"));
    }
    Ok(samples.data)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pack_bits_are_literals_and_runs() {
        // The example of Apple's technical note 1023, which TIFF 6.0 refers to.
        let packed = b"\xFE\xAA\x02\x80\x00\x2A\xFD\xAA\x03\x80\x00\x2A\x22\xF7\xAA";
        let unpacked = pack_bits(packed, 24);
        assert_eq!(unpacked.len(), 24);
        assert_eq!(unpacked[..8], [0xAA, 0xAA, 0xAA, 0x80, 0, 0x2A, 0xAA, 0xAA]);
        assert!(pack_bits(b"\x05ab", 6).len() < 6 && pack_bits(b"\xFE", 6).is_empty());
    }

    #[test]
    fn a_compression_that_is_not_read_is_named() {
        let Err(Fault::Unsupported { found, .. }) = expect_supported(34712) else { panic!() };
        assert_eq!(found, "the compression JPEG 2000");
        assert!(expect_supported(7).is_ok() && expect_supported(0).is_err());
    }
}
