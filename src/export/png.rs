//! Pictures as PNG.

use super::ExportError;
use crate::color::srgb_from_linear;
use crate::raster::{LabelMap, Raster};
use png::{BitDepth, ColorType, Compression, EncodingError, SrgbRenderingIntent};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Labels as 16-bit gray values: numbers, not colors, and therefore untagged.
pub(super) fn write_labels(path: &Path, labels: &LabelMap) -> Result<(), ExportError> {
    let bytes: Vec<u8> = labels.as_slice().iter().flat_map(|label| label.to_be_bytes()).collect();
    let kind = Kind { color: ColorType::Grayscale, depth: BitDepth::Sixteen, srgb: false };
    write(path, (labels.width(), labels.height()), &kind, &bytes)
}

/// Writes 8-bit sRGB values with an sRGB chunk.
pub(super) fn write_rgb(path: &Path, values: &Raster<[u8; 3]>) -> Result<(), ExportError> {
    let kind = Kind { color: ColorType::Rgb, depth: BitDepth::Eight, srgb: true };
    write(path, (values.width(), values.height()), &kind, values.as_slice().as_flattened())
}

/// Writes 8-bit gray values with an sRGB chunk.
pub(super) fn write_gray(path: &Path, values: &Raster<u8>) -> Result<(), ExportError> {
    let kind = Kind { color: ColorType::Grayscale, depth: BitDepth::Eight, srgb: true };
    write(path, (values.width(), values.height()), &kind, values.as_slice())
}

/// 8-bit gray values as the bytes of a PNG without a color space: a mask, not light.
pub fn png_of_gray(values: &Raster<u8>) -> Vec<u8> {
    let kind = Kind { color: ColorType::Grayscale, depth: BitDepth::Eight, srgb: false };
    let mut bytes = Vec::new();
    match encode(&mut bytes, (values.width(), values.height()), &kind, values.as_slice()) {
        Ok(()) => bytes,
        // A PNG has at least one pixel.
        Err(_) => Vec::new(),
    }
}

/// 8-bit sRGB values with alpha, as the bytes of a PNG; `size` is columns and rows.
pub fn png_of_rgba(size: [u32; 2], rgba: &[u8]) -> Vec<u8> {
    let kind = Kind { color: ColorType::Rgba, depth: BitDepth::Eight, srgb: true };
    let mut bytes = Vec::new();
    // Writing to memory fails only where the size does not fit the values.
    match encode(&mut bytes, (size[0] as usize, size[1] as usize), &kind, rgba) {
        Ok(()) => bytes,
        Err(_) => Vec::new(),
    }
}

/// 8-bit sRGB value of linear light, where 1 is white; brighter light is white too.
pub(super) fn code_from_linear(linear: f32) -> u8 {
    (srgb_from_linear(linear.clamp(0.0, 1.0)) * 255.0).round() as u8
}

struct Kind {
    color: ColorType,
    depth: BitDepth,
    srgb: bool,
}

fn write(path: &Path, size: (usize, usize), kind: &Kind, bytes: &[u8]) -> Result<(), ExportError> {
    let file = File::create(path).map_err(|source| ExportError::Io { path: path.to_owned(), source })?;
    encode(BufWriter::new(file), size, kind, bytes)
        .map_err(|source| ExportError::Png { path: path.to_owned(), source })
}

fn encode(
    mut file: impl Write,
    size: (usize, usize),
    kind: &Kind,
    bytes: &[u8],
) -> Result<(), EncodingError> {
    let mut encoder = png::Encoder::new(&mut file, size.0 as u32, size.1 as u32);
    encoder.set_color(kind.color);
    encoder.set_depth(kind.depth);
    encoder.set_compression(Compression::Fast);
    if kind.srgb {
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
    fn the_tone_curve_meets_its_known_points() {
        assert_eq!([-3.0, 0.0, 0.002, 0.215_861, 1.0, 9.0].map(code_from_linear), [0, 0, 7, 128, 255, 255]);
    }
}
