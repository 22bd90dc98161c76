//! Decoder of TIFF 6.0 and `BigTIFF`, based on the `tiff` crate: gray, palette and RGB of 1 to 32 bits, floats of 16 to
//! 64 bits.

mod palette;

use super::{Budget, Decoded};
use crate::photo::error::{CONVERT, Fault};
use crate::photo::source::{AlphaKind, Layout, Samples};
use image::metadata::Orientation;
use std::io::Cursor;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

type Reader<'a> = Decoder<Cursor<&'a [u8]>>;

pub(super) fn decode(bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    let mut reader = Decoder::new(Cursor::new(bytes))?;
    let (width, height) = reader.dimensions()?;
    let size = budget.admit(width, height)?;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = budget.working_bytes();
    limits.intermediate_buffer_size = budget.working_bytes();
    // No value can be longer than the file, whatever length the file states.
    limits.ifd_value_size = bytes.len();
    let mut reader = reader.with_limits(limits.clone());

    let (layout, samples) = match palette::of(&mut reader)? {
        None => read_samples(&mut reader, size)?,
        Some(palette) => {
            let as_gray = palette::indices_as_gray(bytes)?;
            let mut reader = Decoder::new(Cursor::new(&as_gray[..]))?.with_limits(limits);
            (Layout::Rgb, palette.look_up(&indices(&mut reader, size)?)?)
        }
    };
    let mut decoded = Decoded::plain(size, layout, samples);
    // Value 1 is associated alpha, 2 is unassociated. When the tag is missing or unspecified, the color is rarely
    // multiplied.
    if extra_samples(&mut reader)?.first() == Some(&1) {
        decoded.alpha = AlphaKind::Associated;
    }
    // An unreadable profile is treated like a missing one.
    decoded.icc = reader.get_tag_u8_vec(Tag::IccProfile).ok();
    decoded.orientation = reader
        .find_tag_unsigned::<u8>(Tag::Orientation)?
        .and_then(Orientation::from_exif)
        .unwrap_or(Orientation::NoTransforms);
    if reader.more_images() {
        decoded.warnings.push("the TIFF holds several pictures: only the first is read".into());
    }
    Ok(decoded)
}

fn extra_samples(reader: &mut Reader) -> Result<Vec<u16>, Fault> {
    Ok(reader.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples)?.unwrap_or_default())
}

/// Bands of each pixel, and number of bits of each sample.
fn stored_layout(reader: &mut Reader) -> Result<(Layout, u8), Fault> {
    let color = reader.colortype()?;
    match color {
        ColorType::Gray(bits) => Ok((Layout::Gray, bits)),
        ColorType::GrayA(bits) => Ok((Layout::GrayAlpha, bits)),
        ColorType::RGB(bits) => Ok((Layout::Rgb, bits)),
        ColorType::RGBA(bits) => Ok((Layout::Rgba, bits)),
        ColorType::Multiband { bit_depth, .. } => {
            // Gray with additional samples; the first additional sample is used if the file declares it as alpha.
            let has_alpha = matches!(extra_samples(reader)?.first(), Some(1 | 2));
            Ok((if has_alpha { Layout::GrayAlpha } else { Layout::Gray }, bit_depth))
        }
        ColorType::CMYK(_) | ColorType::CMYKA(_) => {
            Err(Fault::unsupported("CMYK, the colors of a printing press", "convert it to RGB"))
        }
        other => Err(Fault::unsupported(format!("{other:?} pixels"), CONVERT)),
    }
}

/// Reads the samples of the bands in the layout; further bands of the file are dropped.
fn read_samples(reader: &mut Reader, (width, height): (usize, usize)) -> Result<(Layout, Samples), Fault> {
    let (layout, bits) = stored_layout(reader)?;
    let (buffer, planes) = read_buffer(reader)?;
    let shape = Shape { pixels: width * height, planes, channels: layout.channels() };
    let samples = match buffer {
        DecodingResult::U8(packed) if bits < 8 => {
            let spread = 255 / ((1u16 << bits) - 1).min(255) as u8;
            let samples = unpack(&packed, width, height, bits)?;
            Samples::U8(shape.interleave(samples.into_iter().map(|sample| sample * spread).collect())?)
        }
        DecodingResult::U8(v) if bits == 8 => Samples::U8(shape.interleave(v)?),
        DecodingResult::U16(v) if bits == 16 => Samples::U16(shape.interleave(v)?),
        DecodingResult::U32(v) if bits == 32 => Samples::U32(shape.interleave(v)?),
        DecodingResult::F32(v) => Samples::F32(shape.interleave(v)?),
        DecodingResult::F16(v) => Samples::F32(shape.interleave(v.into_iter().map(f32::from).collect())?),
        DecodingResult::F64(v) => {
            Samples::F32(shape.interleave(v.into_iter().map(|sample| sample as f32).collect())?)
        }
        _ => return Err(Fault::unsupported(format!("samples of {bits} bits of an unusual kind"), CONVERT)),
    };
    Ok((layout, samples))
}

/// Reads palette indices from a file whose photometric interpretation was set to gray.
fn indices(reader: &mut Reader, (width, height): (usize, usize)) -> Result<Vec<u8>, Fault> {
    let (_, bits) = stored_layout(reader)?;
    let (buffer, planes) = read_buffer(reader)?;
    match buffer {
        DecodingResult::U8(packed) if bits < 8 => unpack(&packed, width, height, bits),
        DecodingResult::U8(indices) if bits == 8 => {
            Shape { pixels: width * height, planes, channels: 1 }.interleave(indices)
        }
        _ => Err(Fault::unsupported(format!("a palette with indices of {bits} bits"), CONVERT)),
    }
}

/// Reads all samples in the decoder's order, and the number of planes that the samples are divided into.
fn read_buffer(reader: &mut Reader) -> Result<(DecodingResult, usize), Fault> {
    let mut buffer = DecodingResult::U8(Vec::new());
    let stored = reader.read_image_to_buffer(&mut buffer)?;
    if buffer.as_buffer(0).byte_len() < stored.complete_len {
        return Err(Fault::damaged("its planes do not fit its size"));
    }
    Ok((buffer, stored.planes))
}

/// Unpacks samples of 1, 2 or 4 bits, in rows padded to whole bytes, into one byte each.
fn unpack(packed: &[u8], width: usize, height: usize, bits: u8) -> Result<Vec<u8>, Fault> {
    if !matches!(bits, 1 | 2 | 4) {
        return Err(Fault::unsupported(format!("samples of {bits} bits"), CONVERT));
    }
    let row_bytes = packed.len() / height;
    let per_row = width * usize::from(bits);
    if row_bytes * 8 < per_row {
        return Err(Fault::damaged("its rows are too short"));
    }
    let max = (1u8 << bits) - 1;
    let samples = packed.chunks_exact(row_bytes).flat_map(|row| {
        (0..width).map(move |x| {
            let bit = x * usize::from(bits);
            let shift = 8 - usize::from(bits) - bit % 8;
            (row[bit / 8] >> shift) & max
        })
    });
    Ok(samples.collect())
}

/// Arrangement of the samples in the decoder's buffer, and number of channels to keep per pixel.
struct Shape {
    pixels: usize,
    planes: usize,
    channels: usize,
}

impl Shape {
    fn interleave<T: Copy>(&self, samples: Vec<T>) -> Result<Vec<T>, Fault> {
        let stored = samples.len() / self.pixels;
        if stored < self.channels || samples.len() != stored * self.pixels {
            return Err(Fault::damaged("its pixels do not fill its size"));
        }
        if self.planes > 1 {
            let at = |pixel: usize| (0..self.channels).map(move |band| band * self.pixels + pixel);
            return Ok((0..self.pixels).flat_map(at).map(|index| samples[index]).collect());
        }
        if stored == self.channels {
            return Ok(samples);
        }
        Ok(samples.chunks_exact(stored).flat_map(|pixel| &pixel[..self.channels]).copied().collect())
    }
}
