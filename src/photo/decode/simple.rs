//! Decoders of the formats that the `image` crate reads sufficiently: PNM and WebP; and the reading of its decoders.

use super::{Budget, Decoded};
use crate::photo::coding::{Compression, LossyCompression};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{Layout, Samples};
use image::codecs::pnm::{ArbitraryHeader, GraymapHeader, PixmapHeader, PnmDecoder, PnmHeader};
use image::codecs::webp::WebPDecoder;
use image::{ColorType, ImageDecoder};
use std::io::Cursor;

/// Decodes WebP; of an animation the first frame.
pub(super) fn webp(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let decoder = WebPDecoder::new(Cursor::new(bytes))?;
    let animated = decoder.has_animation();
    let mut decoded = read(decoder, budget)?;
    if animated {
        decoded.warnings.push("the WebP is animated: only its first frame is read".into());
    }
    decoded.compression = webp_compression(bytes);
    Ok(decoded)
}

/// Compression of the first picture in a WebP (RFC 9649): a chunk `VP8L` is lossless; `VP8 ` is lossy, and stores color
/// differences with half the samples each way. An animation holds its pictures in chunks `ANMF`.
fn webp_compression(bytes: &[u8]) -> Compression {
    const FILE_HEADER_BYTES: usize = 12;
    const CHUNK_HEADER_BYTES: usize = 8;
    const FRAME_HEADER_BYTES: usize = 16;
    let lossy = Compression::Lossy(LossyCompression { quantization_step: 0.0, chroma_subsampled: true });
    let mut at = FILE_HEADER_BYTES;
    while let Some(header) = bytes.get(at..at + CHUNK_HEADER_BYTES) {
        let length = u32::from_le_bytes([header[4], header[5], header[6], header[7]]) as usize;
        let skipped = match &header[..4] {
            b"VP8L" => return Compression::Lossless,
            b"VP8 " => return lossy,
            b"ANMF" => FRAME_HEADER_BYTES,
            // Chunks begin at even places.
            _ => length.saturating_add(length % 2),
        };
        at = at.saturating_add(CHUNK_HEADER_BYTES).saturating_add(skipped);
        if at > bytes.len() {
            break;
        }
    }
    lossy
}

/// Decodes PNM. Samples keep the range 0 to the file's own maximum.
pub(super) fn pnm(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    if bytes.starts_with(b"P7") {
        expect_known_tuple(bytes)?;
    }
    let (picture, header) = PnmDecoder::new(Cursor::new(bytes))?.into_inner();
    let (max, pixels_at) = (pnm_max(&header), picture.position() as usize);
    let mut decoded = read(PnmDecoder::new(Cursor::new(bytes))?, budget)?;
    if is_followed_by_another(bytes, pixels_at, max, &decoded) {
        decoded.warnings.push("the PNM file holds several pictures: only the first is read".into());
    }
    let samples = match decoded.samples {
        Samples::U8(samples) => {
            let codes = codes_before_spreading(255, max);
            Samples::U8(samples.into_iter().map(|v| codes[usize::from(v)] as u8).collect())
        }
        Samples::U16(samples) => {
            let codes = codes_before_spreading(65535, max);
            Samples::U16(samples.into_iter().map(|v| codes[usize::from(v)] as u16).collect())
        }
        floats_or_wider => floats_or_wider,
    };
    Ok(Decoded { max: Some(max), samples, ..decoded })
}

/// Fails for a PAM whose tuples have a type that is not gray, RGB or one of them with alpha.
fn expect_known_tuple(bytes: &[u8]) -> Result<(), Fault> {
    let header = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]).into_owned();
    let kind = header
        .lines()
        .take_while(|line| line.trim() != "ENDHDR")
        .find_map(|line| line.trim().strip_prefix("TUPLTYPE"));
    let known = ["BLACKANDWHITE", "GRAYSCALE", "RGB", "BLACKANDWHITE_ALPHA", "GRAYSCALE_ALPHA", "RGB_ALPHA"];
    match kind.map(str::trim) {
        Some(kind) if !known.contains(&kind) => {
            Err(Fault::unsupported(format!("tuples of the type {kind}"), CONVERT))
        }
        _ => Ok(()),
    }
}

/// Whether another picture follows the binary samples of a PNM, which begin at `pixels_at`.
fn is_followed_by_another(bytes: &[u8], pixels_at: usize, max: u32, decoded: &Decoded) -> bool {
    let is_binary = bytes.get(1).is_some_and(|kind| (b'5'..=b'7').contains(kind));
    let length = decoded.samples.len() * if max > 255 { 2 } else { 1 };
    let rest = bytes.get(pixels_at + length..).unwrap_or_default();
    is_binary && matches!(rest, [b'P', b'1'..=b'7', space, ..] if space.is_ascii_whitespace())
}

/// Table that undoes the scaling of the `image` crate: it scales samples of `0..=max` to `0..=spread`, rounded. The
/// table is computed with the same 32-bit operations and holds the original sample of each scaled one.
fn codes_before_spreading(spread: u32, max: u32) -> Vec<u32> {
    let factor = spread as f32 / max as f32;
    let mut codes = vec![max; spread as usize + 1];
    for code in 0..=max.min(spread) {
        codes[(code as f32 * factor).round() as usize] = code;
    }
    codes
}

fn pnm_max(header: &PnmHeader) -> u32 {
    if let Some(GraymapHeader { maxwhite, .. }) = header.as_graymap() {
        *maxwhite
    } else if let Some(PixmapHeader { maxval, .. }) = header.as_pixmap() {
        *maxval
    } else if let Some(ArbitraryHeader { maxval, .. }) = header.as_arbitrary()
        && *maxval > 1
    {
        *maxval
    } else {
        // The `image` crate scales black and white to 8 bits.
        255
    }
}

/// Reads the samples of a decoder of the `image` crate, with profile and orientation.
pub(super) fn read(mut decoder: impl ImageDecoder, budget: Budget) -> Result<Decoded, Fault> {
    let (width, height) = decoder.dimensions();
    let size = budget.admit(width, height)?;
    let icc = decoder.icc_profile()?;
    let orientation = decoder.orientation()?;
    let color = decoder.color_type();
    let layout = Layout::of_channels(usize::from(color.channel_count()));
    let layout = layout.ok_or_else(|| Fault::unsupported(format!("{color:?} pixels"), CONVERT))?;
    let mut data = vec![0; size.0 * size.1 * usize::from(color.bytes_per_pixel())];
    decoder.read_image(&mut data)?;
    let samples = match color {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Samples::U8(data),
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            Samples::U16(data.chunks_exact(2).map(|b| u16::from_ne_bytes([b[0], b[1]])).collect())
        }
        ColorType::Rgb32F | ColorType::Rgba32F => {
            let float = |b: &[u8]| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]);
            Samples::F32(data.chunks_exact(4).map(float).collect())
        }
        other => return Err(Fault::unsupported(format!("{other:?} pixels"), CONVERT)),
    };
    Ok(Decoded { icc, orientation, ..Decoded::plain(size, layout, samples) })
}

#[cfg(test)]
mod compression_tests {
    use super::*;

    /// A WebP file of chunks, each a name and a number of bytes of content.
    fn webp(chunks: &[(&[u8; 4], usize)]) -> Vec<u8> {
        let mut file = b"RIFF\0\0\0\0WEBP".to_vec();
        for (name, length) in chunks {
            file.extend_from_slice(*name);
            file.extend_from_slice(&(*length as u32).to_le_bytes());
            file.resize(file.len() + length + length % 2, 0);
        }
        file
    }

    #[test]
    fn a_webp_is_lossless_by_the_chunk_of_its_picture_wherever_the_chunk_is() {
        let is_lossless = |file: &[u8]| webp_compression(file) == Compression::Lossless;
        assert!(is_lossless(&webp(&[(b"VP8L", 9)])));
        assert!(is_lossless(&webp(&[(b"VP8X", 10), (b"ICCP", 3001), (b"VP8L", 9)])), "behind a profile");
        assert!(!is_lossless(&webp(&[(b"VP8X", 10), (b"ALPH", 7), (b"VP8 ", 9)])));
        let mut animation = webp(&[(b"VP8X", 10), (b"ANMF", 16)]);
        animation.extend_from_slice(b"VP8L\x01\0\0\0\0");
        assert!(is_lossless(&animation), "the picture of a frame lies behind 16 bytes of the frame");
        assert!(!is_lossless(b"RIFF") && !is_lossless(&[]), "a file that ends early says nothing");
    }
}
