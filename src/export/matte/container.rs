//! Encodes samples as PNG, JPEG or TIFF, with the color information of the photograph's file.

mod tiff;

use super::Picture;
use crate::export::matte_format::MatteFormat;
use crate::photo::{Density, DensityUnit, Format, Layout, Photo, Samples, Source, ToneCurve};
use image::codecs::jpeg::{JpegEncoder, PixelDensity, PixelDensityUnit};
use image::{ExtendedColorType, ImageEncoder};
use png::chunk::ChunkType;

/// JPEG quality: the loss is hardly visible compared with the files of cameras. Colors are not subsampled (4:4:4).
const JPEG_QUALITY: u8 = 97;

type Encoded = Result<Vec<u8>, String>;

/// The format of the file, and its bytes.
pub(super) fn encode(photo: &Photo, picture: Picture) -> (MatteFormat, Encoded) {
    let Picture { layout, samples } = picture;
    let source = &photo.source;
    let size = (photo.image.width() as u32, photo.image.height() as u32);
    // A profile for one band does not apply to three bands, and a profile with a tone curve does not apply to linear floats.
    let profile_fits = source.layout == layout && (source.max.is_some() || photo.encoding.is_linear());
    let icc = source.icc.as_deref().filter(|_| profile_fits);
    let max = source.max.unwrap_or(1);
    match (source.format, samples) {
        (Format::Tiff, samples) | (_, samples @ (Samples::U32(_) | Samples::F32(_))) => {
            let fields = tiff::Fields::of(source, layout, icc);
            (
                MatteFormat::Tiff,
                tiff::encode(size, layout, samples, &fields).map_err(|error| error.to_string()),
            )
        }
        (Format::Jpeg, Samples::U8(samples)) if !layout.has_alpha() => {
            (MatteFormat::Jpeg, jpeg(source, size, layout, &samples, icc).map_err(|error| error.to_string()))
        }
        (_, Samples::U8(samples)) if 255 % max == 0 => {
            let data: Vec<u8> = samples.iter().map(|&v| v.saturating_mul((255 / max) as u8)).collect();
            (
                MatteFormat::Png,
                png(photo, layout, png::BitDepth::Eight, &data, icc).map_err(|error| error.to_string()),
            )
        }
        (_, Samples::U8(samples)) => {
            let samples = samples.into_iter().map(u16::from).collect();
            (MatteFormat::Png, png_16(photo, layout, samples, icc).map_err(|error| error.to_string()))
        }
        (_, Samples::U16(samples)) => {
            (MatteFormat::Png, png_16(photo, layout, samples, icc).map_err(|error| error.to_string()))
        }
    }
}

fn jpeg(
    source: &Source,
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
    if let Some(density) = source.density.and_then(jpeg_density) {
        encoder.set_pixel_density(density);
    }
    if source.is_adobe_rgb {
        encoder.set_exif_metadata(ADOBE_RGB_EXIF.to_vec()).map_err(image::ImageError::Unsupported)?;
    }
    let color = if layout.is_gray() { ExtendedColorType::L8 } else { ExtendedColorType::Rgb8 };
    encoder.write_image(samples, width, height, color)?;
    Ok(bytes)
}

/// A density in the units of JFIF; `None` where JFIF cannot hold it.
fn jpeg_density(density: Density) -> Option<PixelDensity> {
    let (unit, factor) = match density.unit {
        DensityUnit::Ratio => (PixelDensityUnit::PixelAspectRatio, 1.0),
        DensityUnit::Inch => (PixelDensityUnit::Inches, 1.0),
        DensityUnit::Centimeter => (PixelDensityUnit::Centimeters, 1.0),
        DensityUnit::Meter => (PixelDensityUnit::Centimeters, 0.01),
    };
    let [across, down] = density.per_unit().map(|pixels| (pixels * factor).round());
    let fits = |pixels: f64| (1.0..=65535.0).contains(&pixels);
    (fits(across) && fits(down)).then_some(PixelDensity { density: (across as u16, down as u16), unit })
}

/// An EXIF block that says no more than that the colors are those of Adobe RGB: a directory that refers to that of the camera,
/// which says "uncalibrated" and refers to that of interoperability, which says R03 (DCF 2.0, 3.2.2).
const ADOBE_RGB_EXIF: &[u8] = b"II*\0\x08\0\0\0\
    \x01\0\x69\x87\x04\0\x01\0\0\0\x1A\0\0\0\0\0\0\0\
    \x02\0\x01\xA0\x03\0\x01\0\0\0\xFF\xFF\0\0\x05\xA0\x04\0\x01\0\0\0\x38\0\0\0\0\0\0\0\
    \x01\0\x01\0\x02\0\x04\0\0\0R03\0\0\0\0\0";

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
    if let Some(cicp) = photo.source.cicp {
        writer.write_chunk(ChunkType(*b"cICP"), &cicp)?;
    }
    if let Some(intent) = chunks.srgb {
        writer.write_chunk(ChunkType(*b"sRGB"), &[intent])?;
    }
    if let Some(gama) = chunks.gama.or_else(|| gama_of_curves(&photo.source)) {
        writer.write_chunk(ChunkType(*b"gAMA"), &gama.to_be_bytes())?;
    }
    if let Some(points) = chunks.chrm {
        writer.write_chunk(ChunkType(*b"cHRM"), &points.map(u32::to_be_bytes).concat())?;
    }
    if let Some((pixels, unit)) = photo.source.density.and_then(png_density) {
        let bytes = [&pixels[0].to_be_bytes()[..], &pixels[1].to_be_bytes(), &[unit]].concat();
        writer.write_chunk(ChunkType(*b"pHYs"), &bytes)?;
    }
    writer.write_image_data(data)?;
    writer.finish()?;
    Ok(bytes)
}

/// The gAMA chunk of the exponent that a BMP states for all bands, × 100 000.
fn gama_of_curves(source: &Source) -> Option<u32> {
    let [red, green, blue] = source.transfer.as_ref()?;
    let exponent = match red {
        ToneCurve::Gamma(exponent) => *exponent,
        ToneCurve::Linear => 1.0,
        _ => return None,
    };
    (red == green && green == blue).then(|| (1e5 / exponent).round() as u32)
}

/// A density as pixels per meter and the number of this unit, or as a ratio and 0; `None` where PNG cannot hold it.
fn png_density(density: Density) -> Option<([u32; 2], u8)> {
    let (unit, factor) = match density.unit {
        DensityUnit::Ratio => (0, 1.0),
        DensityUnit::Inch => (1, 1.0 / 0.0254),
        DensityUnit::Centimeter => (1, 100.0),
        DensityUnit::Meter => (1, 1.0),
    };
    let pixels = density.per_unit().map(|pixels| (pixels * factor).round());
    let fits = pixels.iter().all(|pixels| (1.0..=f64::from(i32::MAX)).contains(pixels));
    fits.then(|| (pixels.map(|pixels| pixels as u32), unit))
}
