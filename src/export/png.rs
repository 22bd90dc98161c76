//! Writes pictures as PNG.

use super::ExportError;
use crate::color::{ContrastCurve, srgb_from_linear};
use crate::raster::{LabelMap, Raster};
use png::{BitDepth, ColorType, Compression, EncodingError, SrgbRenderingIntent};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes labels as 16-bit gray values, without an sRGB chunk, because labels are numbers and not colors.
pub(super) fn write_labels(path: &Path, labels: &LabelMap) -> Result<(), ExportError> {
    let bytes: Vec<u8> = labels.as_slice().iter().flat_map(|label| label.to_be_bytes()).collect();
    let sample_type = SampleType { color: ColorType::Grayscale, depth: BitDepth::Sixteen, srgb: false };
    write(path, (labels.width(), labels.height()), &sample_type, &bytes)
}

/// Writes 8-bit sRGB values with an sRGB chunk.
pub(super) fn write_rgb(path: &Path, values: &Raster<[u8; 3]>) -> Result<(), ExportError> {
    let sample_type = SampleType { color: ColorType::Rgb, depth: BitDepth::Eight, srgb: true };
    write(path, (values.width(), values.height()), &sample_type, values.as_slice().as_flattened())
}

/// Writes 8-bit gray values with an sRGB chunk.
pub(super) fn write_gray(path: &Path, values: &Raster<u8>) -> Result<(), ExportError> {
    let sample_type = SampleType { color: ColorType::Grayscale, depth: BitDepth::Eight, srgb: true };
    write(path, (values.width(), values.height()), &sample_type, values.as_slice())
}

/// The bytes of a PNG with 8-bit gray values, without a color space, for masks. Empty for a raster without pixels.
pub fn png_of_gray(values: &Raster<u8>) -> Vec<u8> {
    let sample_type = SampleType { color: ColorType::Grayscale, depth: BitDepth::Eight, srgb: false };
    let mut bytes = Vec::new();
    match encode(&mut bytes, (values.width(), values.height()), &sample_type, values.as_slice()) {
        Ok(()) => bytes,
        // Writing to memory fails only for a raster without pixels.
        Err(_) => Vec::new(),
    }
}

/// The bytes of a PNG with 8-bit sRGB values and alpha. `size`: columns and rows. Empty where `rgba` does not have this size.
pub fn png_of_rgba(size: [u32; 2], rgba: &[u8]) -> Vec<u8> {
    let sample_type = SampleType { color: ColorType::Rgba, depth: BitDepth::Eight, srgb: true };
    let mut bytes = Vec::new();
    // Writing to memory fails only where `rgba` does not have this size.
    match encode(&mut bytes, (size[0] as usize, size[1] as usize), &sample_type, rgba) {
        Ok(()) => bytes,
        Err(_) => Vec::new(),
    }
}

/// The bytes of a PNG with 8-bit sRGB values, as small as the encoder makes them in reasonable time. Empty for a raster without
/// pixels.
pub fn png_of_rgb(values: &Raster<[u8; 3]>) -> Vec<u8> {
    let sample_type = SampleType { color: ColorType::Rgb, depth: BitDepth::Eight, srgb: true };
    let size = (values.width(), values.height());
    let mut bytes = Vec::new();
    let compression = Compression::Balanced;
    match encode_with(compression, &mut bytes, size, &sample_type, values.as_slice().as_flattened()) {
        Ok(()) => bytes,
        // Writing to memory fails only for a raster without pixels.
        Err(_) => Vec::new(),
    }
}

/// 8-bit sRGB value of linear light after a camera's contrast curve. 1 and more is white.
pub(super) fn code_with_contrast(linear: f32, curve: &ContrastCurve) -> u8 {
    let coded = f64::from(srgb_from_linear(linear.clamp(0.0, 1.0)));
    (curve.apply(coded) * 255.0).round() as u8
}

/// 8-bit sRGB value of linear light. 1 and more is white.
pub(super) fn code_from_linear(linear: f32) -> u8 {
    (srgb_from_linear(linear.clamp(0.0, 1.0)) * 255.0).round() as u8
}

/// Sample type of a PNG, and whether the file has an sRGB chunk.
struct SampleType {
    color: ColorType,
    depth: BitDepth,
    srgb: bool,
}

fn write(
    path: &Path,
    size: (usize, usize),
    sample_type: &SampleType,
    bytes: &[u8],
) -> Result<(), ExportError> {
    let file = File::create(path).map_err(|source| ExportError::Io { path: path.to_owned(), source })?;
    encode(BufWriter::new(file), size, sample_type, bytes).map_err(|source| match source {
        // An error of the system is reported as that of any other file.
        EncodingError::IoError(source) => ExportError::Io { path: path.to_owned(), source },
        source => ExportError::Png { path: path.to_owned(), source },
    })
}

fn encode(
    file: impl Write,
    size: (usize, usize),
    sample_type: &SampleType,
    bytes: &[u8],
) -> Result<(), EncodingError> {
    encode_with(Compression::Fast, file, size, sample_type, bytes)
}

fn encode_with(
    compression: Compression,
    mut file: impl Write,
    size: (usize, usize),
    sample_type: &SampleType,
    bytes: &[u8],
) -> Result<(), EncodingError> {
    let mut encoder = png::Encoder::new(&mut file, size.0 as u32, size.1 as u32);
    encoder.set_color(sample_type.color);
    encoder.set_depth(sample_type.depth);
    encoder.set_compression(compression);
    if sample_type.srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    file.flush().map_err(EncodingError::IoError)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_points_of_the_tone_curve() {
        assert_eq!([-3.0, 0.0, 0.002, 0.215_861, 1.0, 9.0].map(code_from_linear), [0, 0, 7, 128, 255, 255]);
    }
}
