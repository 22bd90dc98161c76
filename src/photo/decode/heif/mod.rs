//! Decoder of HEIF with HEVC pictures (ISO/IEC 23008-12), the photographs of phones (HEIC) and of some cameras (HIF), based on
//! the `hpvcd` crate.

mod aperture;

use super::exif::Exif;
use super::{Budget, Decoded};
use crate::photo::coding::{Compression, LossyCompression};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{Density, DensityUnit, Layout, Samples};
use aperture::{Part, is_quarter_turn};
use hpvcd::{ChromaFormat, Cicp, DecodeError, DecodedImage, ImageBuffer, ImageInfo, ParseLimits, SampleBuf};

/// Decodes the main picture, upright. Thumbnails, depth and gain maps are left out.
pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    // The size is checked here, with the limit that holds for every format.
    let unlimited = ParseLimits { max_dimension: u32::MAX, max_pixels: u64::MAX, ..ParseLimits::new() };
    let info = hpvcd::read_heic_info_with_limits(bytes, &unlimited)?;
    let (width, height) = budget.admit(info.width, info.height)?;
    let limits = ParseLimits { max_pixels: (width * height) as u64, ..unlimited };
    let picture = hpvcd::Decoder::new()
        .with_threads(rayon::current_num_threads())
        .with_limits(limits)
        .with_decode_gain_map(false)
        .decode(bytes)?;
    let max = (1 << picture.bit_depth.bits()) - 1;
    let exif = picture.exif.as_deref().map(Exif::of_block).unwrap_or_default();
    let density = density(&picture, &exif);
    let cicp = picture.color.cicp.map(code_points_of_rgb).filter(|_| picture.color.icc.is_none());
    let whole = Part { left: 0, top: 0, width: picture.width as usize, height: picture.height as usize };
    let stored = (info.coded_width as usize, info.coded_height as usize);
    let part = picture.clean_aperture.map(|aperture| Part::of_aperture(aperture, stored));
    let warning = (part == Some(None))
        .then(|| "the file asks to show a part outside of its picture: the whole picture is read".to_owned());
    let part = part.flatten().map_or(whole, |part| part.upright(stored, picture.orientation));
    let (layout, samples) = samples(picture.pixels, picture.alpha)?;
    let samples = cut(samples, part, whole, layout.channels());
    Ok(Decoded {
        max: Some(max),
        // A profile goes before the code points, which then only say how the samples are coded (ISO/IEC 23008-12, 6.5.5.1).
        icc: picture.color.icc,
        cicp,
        is_adobe_rgb: exif.is_adobe_rgb,
        density,
        compression: compression(&info),
        warnings: warning.into_iter().collect(),
        ..Decoded::plain((part.width, part.height), layout, samples)
    })
}

/// The samples of `part` of a picture of the size `whole`.
fn cut(samples: Samples, part: Part, whole: Part, channels: usize) -> Samples {
    if part == whole {
        return samples;
    }
    match samples {
        Samples::U8(v) => Samples::U8(part.of(&v, whole.width, channels)),
        Samples::U16(v) => Samples::U16(part.of(&v, whole.width, channels)),
        Samples::U32(v) => Samples::U32(part.of(&v, whole.width, channels)),
        Samples::F32(v) => Samples::F32(part.of(&v, whole.width, channels)),
    }
}

/// The bands of the picture, with its alpha where there is one.
fn samples(pixels: ImageBuffer, alpha: Option<SampleBuf>) -> Result<(Layout, Samples), Fault> {
    let layout = Layout::of_channels(pixels.channels() + usize::from(alpha.is_some()));
    let layout = layout.ok_or_else(|| Fault::damaged("its number of bands is wrong"))?;
    let bands = pixels.channels();
    let samples = match (pixels, alpha) {
        (ImageBuffer::Luma8(v) | ImageBuffer::Rgb8(v), None) => Samples::U8(v),
        (ImageBuffer::Luma16(v) | ImageBuffer::Rgb16(v), None) => Samples::U16(v),
        (ImageBuffer::Luma8(v) | ImageBuffer::Rgb8(v), Some(SampleBuf::U8(alpha))) => {
            Samples::U8(interleaved(&v, &alpha, bands)?)
        }
        (ImageBuffer::Luma16(v) | ImageBuffer::Rgb16(v), Some(SampleBuf::U16(alpha))) => {
            Samples::U16(interleaved(&v, &alpha, bands)?)
        }
        _ => return Err(Fault::unsupported("an alpha of another depth than its colors", CONVERT)),
    };
    Ok((layout, samples))
}

/// The samples of pixels of `bands` bands, with the alpha of each pixel behind them.
fn interleaved<T: Copy>(colors: &[T], alpha: &[T], bands: usize) -> Result<Vec<T>, Fault> {
    if colors.len() != alpha.len() * bands {
        return Err(Fault::damaged("its alpha has another size than its colors"));
    }
    let pixels = colors.chunks_exact(bands).zip(alpha);
    Ok(pixels.flat_map(|(colors, alpha)| colors.iter().chain([alpha])).copied().collect())
}

/// The code points of the decoded samples: the primaries and the curve of the file, and RGB of full range, into which the
/// decoder has converted the samples.
fn code_points_of_rgb(cicp: Cicp) -> [u8; 4] {
    const RGB: u8 = 0;
    const FULL_RANGE: u8 = 1;
    [cicp.primaries as u8, cicp.transfer as u8, RGB, FULL_RANGE]
}

/// The density of the upright picture: of EXIF, or the aspect of a pixel that the file states.
fn density(picture: &DecodedImage, exif: &Exif) -> Option<Density> {
    let aspect = picture.pixel_aspect_ratio.filter(|aspect| !aspect.is_square());
    let density = match aspect {
        Some(aspect) => Density::new([(aspect.v_spacing, 1), (aspect.h_spacing, 1)], DensityUnit::Ratio),
        None => exif.density,
    }?;
    Some(if is_quarter_turn(picture.orientation) { density.turned() } else { density })
}

fn compression(info: &ImageInfo) -> Compression {
    let chroma_subsampled = matches!(info.chroma, ChromaFormat::Yuv420 | ChromaFormat::Yuv422);
    Compression::Lossy(LossyCompression { quantization_step: 0.0, chroma_subsampled })
}

/// What a HEIF holds that holds an AVIF, a JPEG or an uncompressed picture.
const OTHER_CODER: &str = "a picture that is not coded as HEVC";

impl From<DecodeError> for Fault {
    fn from(error: DecodeError) -> Self {
        match error {
            DecodeError::UnsupportedItemType(_) => Self::unsupported(OTHER_CODER, CONVERT),
            // The configuration of the coder.
            DecodeError::MissingBox(name) if name.contains("hvcC") => Self::unsupported(OTHER_CODER, CONVERT),
            DecodeError::Unsupported(_)
            | DecodeError::UnsupportedChroma(_)
            | DecodeError::UnsupportedBitDepth(_) => Self::unsupported(error, CONVERT),
            other => Self::damaged(other),
        }
    }
}
