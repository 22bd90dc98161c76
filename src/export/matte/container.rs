//! Encodes samples as PNG, JPEG or TIFF, with the color information of the photograph's file.

use super::Picture;
use crate::photo::{AlphaKind, Format, Layout, Photo, Samples};
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use png::chunk::ChunkType;
use std::io::Cursor;
use tiff::encoder::{TiffEncoder, TiffValue, colortype};
use tiff::tags::{ExtraSamples, Tag};

/// JPEG quality: the loss is hardly visible compared with the files of cameras. Colors are not subsampled (4:4:4).
const JPEG_QUALITY: u8 = 97;

type Encoded = Result<Vec<u8>, String>;

/// The extension of the file, and its bytes.
pub(super) fn encode(photo: &Photo, picture: Picture) -> (&'static str, Encoded) {
    let Picture { layout, samples } = picture;
    let source = &photo.source;
    let size = (photo.image.width() as u32, photo.image.height() as u32);
    // A profile for one band does not apply to three bands, and a profile with a tone curve does not apply to linear floats.
    let profile_fits = source.layout == layout && (source.max.is_some() || photo.encoding.is_linear());
    let icc = source.icc.as_deref().filter(|_| profile_fits);
    let max = source.max.unwrap_or(1);
    match (source.format, samples) {
        (Format::Tiff, samples) | (_, samples @ (Samples::U32(_) | Samples::F32(_))) => {
            ("tif", tiff(size, layout, source.alpha, &samples, icc).map_err(|error| error.to_string()))
        }
        (Format::Jpeg, Samples::U8(samples)) if !layout.has_alpha() => {
            ("jpg", jpeg(size, layout, &samples, icc).map_err(|error| error.to_string()))
        }
        (_, Samples::U8(samples)) if 255 % max == 0 => {
            let data: Vec<u8> = samples.iter().map(|&v| v.saturating_mul((255 / max) as u8)).collect();
            ("png", png(photo, layout, png::BitDepth::Eight, &data, icc).map_err(|error| error.to_string()))
        }
        (_, Samples::U8(samples)) => {
            let samples = samples.into_iter().map(u16::from).collect();
            ("png", png_16(photo, layout, samples, icc).map_err(|error| error.to_string()))
        }
        (_, Samples::U16(samples)) => {
            ("png", png_16(photo, layout, samples, icc).map_err(|error| error.to_string()))
        }
    }
}

fn jpeg(
    (width, height): (u32, u32),
    layout: Layout,
    samples: &[u8],
    icc: Option<&[u8]>,
) -> image::ImageResult<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut bytes, JPEG_QUALITY);
    if let Some(profile) = icc {
        encoder.set_icc_profile(profile.to_vec()).map_err(image::ImageError::Unsupported)?;
    }
    let color = if layout.is_gray() { ExtendedColorType::L8 } else { ExtendedColorType::Rgb8 };
    encoder.write_image(samples, width, height, color)?;
    Ok(bytes)
}

/// The bytes of a 16-bit PNG. Samples from 0 to the maximum of the source are scaled to 16 bits.
fn png_16(
    photo: &Photo,
    layout: Layout,
    samples: Vec<u16>,
    icc: Option<&[u8]>,
) -> Result<Vec<u8>, png::EncodingError> {
    let max = photo.source.max.unwrap_or(65535);
    let spread = |sample: u16| ((u32::from(sample).min(max) * 65535 + max / 2) / max) as u16;
    let data: Vec<u8> = samples.into_iter().flat_map(|sample| spread(sample).to_be_bytes()).collect();
    png(photo, layout, png::BitDepth::Sixteen, &data, icc)
}

fn png(
    photo: &Photo,
    layout: Layout,
    depth: png::BitDepth,
    data: &[u8],
    icc: Option<&[u8]>,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut info = png::Info::with_size(photo.image.width() as u32, photo.image.height() as u32);
    info.color_type = match layout {
        Layout::Gray => png::ColorType::Grayscale,
        Layout::GrayAlpha => png::ColorType::GrayscaleAlpha,
        Layout::Rgb => png::ColorType::Rgb,
        Layout::Rgba => png::ColorType::Rgba,
    };
    info.bit_depth = depth;
    info.icc_profile = icc.map(Into::into);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::with_info(&mut bytes, info)?;
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    // The chunks are written one by one, because the encoder writes only some combinations of these chunks.
    let chunks = photo.source.png;
    if let Some(cicp) = chunks.cicp {
        writer.write_chunk(ChunkType(*b"cICP"), &cicp)?;
    }
    if let Some(intent) = chunks.srgb {
        writer.write_chunk(ChunkType(*b"sRGB"), &[intent])?;
    }
    if let Some(gama) = chunks.gama {
        writer.write_chunk(ChunkType(*b"gAMA"), &gama.to_be_bytes())?;
    }
    writer.write_image_data(data)?;
    writer.finish()?;
    Ok(bytes)
}

fn tiff(
    size: (u32, u32),
    layout: Layout,
    alpha: AlphaKind,
    samples: &Samples,
    icc: Option<&[u8]>,
) -> tiff::TiffResult<Vec<u8>> {
    let alpha = layout.has_alpha().then_some(match alpha {
        AlphaKind::Straight => ExtraSamples::UnassociatedAlpha,
        AlphaKind::Associated => ExtraSamples::AssociatedAlpha,
    });
    match (samples, layout.is_gray()) {
        (Samples::U8(v), true) => tiff_of::<colortype::Gray8>(size, alpha, v, icc),
        (Samples::U8(v), false) => tiff_of::<colortype::RGB8>(size, alpha, v, icc),
        (Samples::U16(v), true) => tiff_of::<colortype::Gray16>(size, alpha, v, icc),
        (Samples::U16(v), false) => tiff_of::<colortype::RGB16>(size, alpha, v, icc),
        (Samples::U32(v), true) => tiff_of::<colortype::Gray32>(size, alpha, v, icc),
        (Samples::U32(v), false) => tiff_of::<colortype::RGB32>(size, alpha, v, icc),
        (Samples::F32(v), true) => tiff_of::<colortype::Gray32Float>(size, alpha, v, icc),
        (Samples::F32(v), false) => tiff_of::<colortype::RGB32Float>(size, alpha, v, icc),
    }
}

fn tiff_of<C: colortype::ColorType>(
    (width, height): (u32, u32),
    alpha: Option<ExtraSamples>,
    samples: &[C::Inner],
    icc: Option<&[u8]>,
) -> tiff::TiffResult<Vec<u8>>
where
    [C::Inner]: TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes)?;
    let mut image = encoder.new_image::<C>(width, height)?;
    if let Some(alpha) = alpha {
        image.extra_samples(&[alpha])?;
    }
    if let Some(profile) = icc {
        image.encoder().write_tag(Tag::IccProfile, profile)?;
    }
    image.write_data(samples)?;
    Ok(bytes.into_inner())
}
