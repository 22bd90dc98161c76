//! Decodes the samples of a JPEG with the library that decodes its arrangement of scans and samples rightly.
//!
//! zune-jpeg 0.5.15 is the faster library. Its pixels are wrong, without an error, where the components of a sequential
//! file come in separate scans and a vertical factor exceeds 1, and where luminance has fewer samples than a color
//! difference; zune-jpeg refuses horizontal factors of 3. jpeg-decoder 0.3.2 decodes these, but counts the blocks of a
//! component wrongly in a scan of its own where the component's factor lies between 1 and the largest one. Both were
//! compared with libjpeg on 112 arrangements. A file that neither library decodes rightly is refused.

use super::gaps::{Gap, first_gap};
use super::header::{Component, Header};
use crate::photo::error::{CONVERT, Fault};
use jpeg_decoder::ColorTransform;
use std::fmt;
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;

/// Meaning of three components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::photo::decode) enum Color {
    /// The components are the bands.
    AsStored,
    /// The components are luminance and color differences, to be converted to red, green and blue.
    FromYcbcr,
}

/// The decoded samples of a JPEG.
#[derive(Debug)]
pub(in crate::photo::decode) struct JpegSamples {
    /// The samples of all components in full resolution, pixel by pixel.
    pub data: Vec<u8>,
    /// What is wrong with the file's data, so that a part of the samples is not what was stored.
    pub flaw: Option<Flaw>,
}

/// What is wrong with the data of a file that was decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::photo::decode) enum Flaw {
    /// Blocks are missing.
    Gap(Gap),
    /// The library decoded the file only by leaving the standard.
    Patched,
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Gap(gap) => gap.fmt(f),
            Self::Patched => f.write_str(
                "the JPEG's data are damaged or deviate from the standard: a part of the picture may be wrong",
            ),
        }
    }
}

/// The samples of the JPEG `bytes`, whose markers say `header`.
pub(in crate::photo::decode) fn samples(
    bytes: &[u8],
    header: &Header,
    color: Color,
) -> Result<JpegSamples, Fault> {
    let (decoded, gap) = std::thread::scope(|scope| {
        let gap = scope.spawn(|| first_gap(bytes, header));
        // The decoding stays on this thread, whose panics become errors.
        (decoded(bytes, header, color), gap.join().unwrap_or(Some(Gap::Damaged(0))))
    });
    let (data, is_patched) = decoded?;
    if gap == Some(Gap::EndsEarly(0)) {
        return Err(Fault::damaged("its data end within the first blocks"));
    }
    if data.len() != header.width as usize * header.height as usize * header.components.len() {
        return Err(Fault::damaged("its pixels do not fill its size"));
    }
    Ok(JpegSamples { data, flaw: gap.map(Flaw::Gap).or(is_patched.then_some(Flaw::Patched)) })
}

/// The samples of a JPEG, and whether the library filled in what it could not decode.
fn decoded(bytes: &[u8], header: &Header, color: Color) -> Result<(Vec<u8>, bool), Fault> {
    match with_zune(bytes, header, color, true) {
        Some(Ok(data)) => Ok((data, false)),
        Some(Err(_)) => {
            // Without the strict mode, the library accepts deviations from the standard, and fills in missing data.
            let patched = with_zune(bytes, header, color, false);
            let data = patched.unwrap_or_else(|| Err(Fault::damaged("it cannot be decoded")))?;
            Ok((data, true))
        }
        None if is_right_in_jpeg_decoder(header) => Ok((with_jpeg_decoder(bytes, color)?, false)),
        None => {
            let feature = "color components in scans of their own, unusually sampled";
            Err(Fault::unsupported(feature, CONVERT))
        }
    }
}

/// Decodes with zune-jpeg; `None` where zune-jpeg would decode wrong pixels, or assumes another color space than
/// `color`.
fn with_zune(bytes: &[u8], header: &Header, color: Color, strict: bool) -> Option<Result<Vec<u8>, Fault>> {
    if !is_right_in_zune(header) {
        return None;
    }
    // `Budget::admit` has checked the size: the library's own limits are lifted.
    let options = DecoderOptions::default()
        .set_strict_mode(strict)
        .set_max_width(usize::MAX)
        .set_max_height(usize::MAX);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    if let Err(error) = decoder.decode_headers() {
        return Some(Err(Fault::damaged(error)));
    }
    let stored = decoder.input_colorspace()?;
    let out = match (color, stored) {
        (Color::FromYcbcr, ColorSpace::YCbCr) => ColorSpace::RGB,
        (Color::AsStored, ColorSpace::Luma | ColorSpace::RGB | ColorSpace::YCbCr) => stored,
        _ => return None,
    };
    decoder.set_options(options.jpeg_set_out_colorspace(out));
    Some(decoder.decode().map_err(Fault::damaged))
}

fn with_jpeg_decoder(bytes: &[u8], color: Color) -> Result<Vec<u8>, Fault> {
    let mut decoder = jpeg_decoder::Decoder::new(bytes);
    decoder.read_info().map_err(fault)?;
    let gray = decoder.info().is_some_and(|info| info.pixel_format == jpeg_decoder::PixelFormat::L8);
    if !gray {
        decoder.set_color_transform(match color {
            Color::AsStored => ColorTransform::RGB,
            Color::FromYcbcr => ColorTransform::YCbCr,
        });
    }
    decoder.decode().map_err(fault)
}

fn fault(error: jpeg_decoder::Error) -> Fault {
    match error {
        jpeg_decoder::Error::Unsupported(feature) => Fault::unsupported(format!("{feature:?}"), CONVERT),
        other => Fault::damaged(other),
    }
}

fn is_right_in_zune(header: &Header) -> bool {
    let Some(first) = header.components.first() else { return false };
    if header.components.len() == 1 {
        return true;
    }
    let (across, down) = header.largest_factors();
    let powers_of_two = header.components.iter().all(|component| component.across.is_power_of_two());
    let luminance_is_largest = (first.across, first.down) == (across, down);
    let one_scan = header.scans.iter().all(|scan| scan.len() == header.components.len());
    let single_rows = down == 1 && header.scans.iter().all(|scan| scan.len() == 1);
    let full = (across, down) == (1, 1);
    let scans = header.is_progressive() || one_scan || single_rows || full;
    powers_of_two && luminance_is_largest && scans
}

/// Whether jpeg-decoder counts the blocks rightly of all components that have a scan of their own.
fn is_right_in_jpeg_decoder(header: &Header) -> bool {
    let (across, down) = header.largest_factors();
    let alone = |component: &&Component| {
        header.is_progressive() || header.scans.iter().any(|scan| *scan == [component.id])
    };
    header.components.iter().filter(alone).all(|component| {
        let right = |size: u32, factor: u32, largest: u32| {
            let blocks = (size * factor).div_ceil(largest).div_ceil(8);
            blocks == (size.div_ceil(8 * largest) * factor).min(size.div_ceil(8))
        };
        right(header.width, component.across, across) && right(header.height, component.down, down)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A header with these factors of three components and these scans.
    fn header(factors: [(u32, u32); 3], scans: &[&[u8]]) -> Header {
        let components = factors.iter().zip(1..).map(|(&(across, down), id)| Component { id, across, down });
        let mut header = Header::default();
        (header.width, header.height) = (163, 110);
        header.components = components.collect();
        header.scans = scans.iter().map(|scan| scan.to_vec()).collect();
        header
    }

    #[test]
    fn the_usual_arrangements_are_for_zune_and_others_for_jpeg_decoder() {
        let one: &[&[u8]] = &[&[1, 2, 3]];
        let each: &[&[u8]] = &[&[1], &[2], &[3]];
        for factors in [[(1, 1); 3], [(2, 2), (1, 1), (1, 1)], [(4, 1), (1, 1), (1, 1)]] {
            assert!(is_right_in_zune(&header(factors, one)), "{factors:?}");
        }
        assert!(is_right_in_zune(&header([(2, 1), (1, 1), (1, 1)], each)));
        let below = [(1, 1), (2, 1), (2, 1)];
        assert!(!is_right_in_zune(&header(below, one)) && is_right_in_jpeg_decoder(&header(below, one)));
        let halved = [(2, 2), (1, 1), (1, 1)];
        assert!(!is_right_in_zune(&header(halved, each)) && is_right_in_jpeg_decoder(&header(halved, each)));
        let between = [(4, 2), (2, 1), (2, 1)];
        assert!(
            !is_right_in_zune(&header(between, each)) && !is_right_in_jpeg_decoder(&header(between, each))
        );
    }
}
