//! Writers of small files of every format, in the variants that other programs write.

use image::{ExtendedColorType, ImageEncoder};
use std::io::Cursor;

/// End of a PNG's first chunk, the header, bytes.
const AFTER_IHDR: usize = 8 + 25;

/// The contents of a PNG; samples of 16 bits are big-endian.
#[derive(Default)]
pub struct Png<'a> {
    pub size: (u32, u32),
    pub color: Option<png::ColorType>,
    pub bits: u8,
    pub data: &'a [u8],
    pub palette: Option<&'a [u8]>,
    pub trns: Option<&'a [u8]>,
    pub icc: Option<&'a [u8]>,
    pub exif: Option<&'a [u8]>,
    pub chunks: &'a [([u8; 4], &'a [u8])],
}

impl Png<'_> {
    pub fn bytes(&self) -> Vec<u8> {
        let mut info = png::Info::with_size(self.size.0, self.size.1);
        info.color_type = self.color.unwrap_or(png::ColorType::Rgb);
        info.bit_depth = png::BitDepth::from_u8(self.bits.max(1)).unwrap();
        info.palette = self.palette.map(Into::into);
        info.trns = self.trns.map(Into::into);
        info.icc_profile = self.icc.map(Into::into);
        info.exif_metadata = self.exif.map(Into::into);
        // The encoder writes PLTE together with the header, so cICP and similar chunks are inserted by hand, right
        // after IHDR.
        let mut bytes = Vec::new();
        let mut writer = png::Encoder::with_info(&mut bytes, info).unwrap().write_header().unwrap();
        writer.write_image_data(self.data).unwrap();
        writer.finish().unwrap();
        let mut extra = Vec::new();
        for (name, data) in self.chunks {
            extra.extend_from_slice(&(data.len() as u32).to_be_bytes());
            extra.extend_from_slice(name);
            extra.extend_from_slice(data);
            extra.extend_from_slice(&crc32(&[name, *data].concat()).to_be_bytes());
        }
        bytes.splice(AFTER_IHDR..AFTER_IHDR, extra);
        bytes
    }
}

fn crc32(data: &[u8]) -> u32 {
    !data.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { 0xEDB8_8320 ^ (c >> 1) } else { c >> 1 })
    })
}

/// A PNG with 8-bit RGB, three samples per pixel.
pub fn rgb8_png(size: (u32, u32), data: &[u8]) -> Vec<u8> {
    Png { size, bits: 8, data, ..Png::default() }.bytes()
}

pub fn bmp(size: (u32, u32), color: ExtendedColorType, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::codecs::bmp::BmpEncoder::new(&mut bytes).write_image(data, size.0, size.1, color).unwrap();
    bytes
}

pub fn webp(size: (u32, u32), color: ExtendedColorType, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut bytes);
    encoder.write_image(data, size.0, size.1, color).unwrap();
    bytes
}

pub fn jpeg(size: (u32, u32), color: ExtendedColorType, data: &[u8], icc: Option<&[u8]>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100);
    if let Some(icc) = icc {
        encoder.set_icc_profile(icc.to_vec()).unwrap();
    }
    encoder.write_image(data, size.0, size.1, color).unwrap();
    bytes
}

pub fn hdr(size: (usize, usize), pixels: &[[f32; 3]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels: Vec<_> = pixels.iter().map(|&p| image::Rgb(p)).collect();
    image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, size.0, size.1).unwrap();
    bytes
}

/// An EXR layer of named channels with the same sample type.
pub fn exr(size: (usize, usize), channels: &[(&str, exr::image::FlatSamples)]) -> Vec<u8> {
    use exr::prelude::*;
    let list = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone()));
    let channels = AnyChannels::sort(list.collect());
    let layer = Layer::new(size, LayerAttributes::named("photo"), Encoding::FAST_LOSSLESS, channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A TIFF with additional tags.
pub fn tiff<C: tiff::encoder::colortype::ColorType>(
    size: (u32, u32),
    data: &[C::Inner],
    extra: &[tiff::tags::ExtraSamples],
    short_tags: &[(u16, u16)],
    icc: Option<&[u8]>,
) -> Vec<u8>
where
    [C::Inner]: tiff::encoder::TiffValue,
{
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder.new_image::<C>(size.0, size.1).unwrap();
    if !extra.is_empty() {
        image.extra_samples(extra).unwrap();
    }
    for &(tag, value) in short_tags {
        image.encoder().write_tag(tiff::tags::Tag::from_u16_exhaustive(tag), value).unwrap();
    }
    if let Some(icc) = icc {
        image.encoder().write_tag(tiff::tags::Tag::IccProfile, icc).unwrap();
    }
    image.write_data(data).unwrap();
    bytes.into_inner()
}

/// A little-endian TIFF with one uncompressed strip, rows padded to bytes, and a hand-written directory.
pub fn raw_tiff(size: (u16, u16), bits: u16, photometric: u16, color_map: &[u16], data: &[u8]) -> Vec<u8> {
    let data_at = 8u32;
    let map_at = data_at + data.len().next_multiple_of(2) as u32;
    let directory_at = map_at + 2 * color_map.len() as u32;
    let mut bytes = b"II*\0".to_vec();
    bytes.extend_from_slice(&directory_at.to_le_bytes());
    bytes.extend_from_slice(data);
    bytes.resize(map_at as usize, 0);
    bytes.extend(color_map.iter().flat_map(|v| v.to_le_bytes()));
    let mut entries: Vec<(u16, u16, u32, u32)> = vec![
        (256, 3, 1, u32::from(size.0)),
        (257, 3, 1, u32::from(size.1)),
        (258, 3, 1, u32::from(bits)),
        (259, 3, 1, 1),
        (262, 3, 1, u32::from(photometric)),
        (273, 4, 1, data_at),
        (277, 3, 1, 1),
        (278, 3, 1, u32::from(size.1)),
        (279, 4, 1, data.len() as u32),
    ];
    if !color_map.is_empty() {
        entries.push((320, 3, color_map.len() as u32, map_at));
    }
    bytes.extend_from_slice(&(entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend_from_slice(&tag.to_le_bytes());
        bytes.extend_from_slice(&kind.to_le_bytes());
        bytes.extend_from_slice(&count.to_le_bytes());
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    bytes.extend_from_slice(&0u32.to_le_bytes());
    bytes
}

/// An EXIF block with an orientation only.
pub fn exif(orientation: u8) -> Vec<u8> {
    let mut bytes = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".to_vec();
    bytes.extend_from_slice(&[orientation, 0, 0, 0, 0, 0, 0, 0]);
    bytes
}

/// An EXIF block that says Adobe RGB: "uncalibrated" and the interoperability index R03.
pub const ADOBE_RGB_EXIF: &[u8] = b"MM\0*\0\0\0\x08\0\x01\x87\x69\0\x04\0\0\0\x01\0\0\0\x1A\0\0\0\0\
    \0\x02\xA0\x01\0\x03\0\0\0\x01\xFF\xFF\0\0\xA0\x05\0\x04\0\0\0\x01\0\0\0\x38\0\0\0\0\
    \0\x01\0\x01\0\x02\0\0\0\x04R03\0\0\0\0\0";

/// An ICC profile with a header and these tags only; `space` is `RGB ` or `GRAY`.
pub fn icc(space: [u8; 4], tags: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut bytes = vec![0u8; 128];
    bytes[8..12].copy_from_slice(&[4, 0x30, 0, 0]);
    bytes[12..16].copy_from_slice(b"mntr");
    bytes[16..20].copy_from_slice(&space);
    bytes[20..24].copy_from_slice(b"XYZ ");
    bytes[36..40].copy_from_slice(b"acsp");
    // The illuminant of the profile connection space, D50.
    bytes[68..80].copy_from_slice(&[0, 0, 0xF6, 0xD6, 0, 1, 0, 0, 0, 0, 0xD3, 0x2D]);
    bytes.extend_from_slice(&(tags.len() as u32).to_be_bytes());
    let mut at = 132 + 12 * tags.len();
    for (name, data) in tags {
        bytes.extend_from_slice(name);
        bytes.extend_from_slice(&(at as u32).to_be_bytes());
        bytes.extend_from_slice(&(data.len() as u32).to_be_bytes());
        at += data.len();
    }
    bytes.extend(tags.iter().flat_map(|(_, data)| data.clone()));
    let length = (bytes.len() as u32).to_be_bytes();
    bytes[..4].copy_from_slice(&length);
    bytes
}

/// An RGB profile with one curve for all bands.
pub fn rgb_icc(curve: &[u8]) -> Vec<u8> {
    icc(*b"RGB ", &[*b"rTRC", *b"gTRC", *b"bTRC"].map(|name| (name, curve.to_vec())))
}

/// An ICC tag of type `curveType`.
pub fn curv(values: &[u16]) -> Vec<u8> {
    let mut bytes = b"curv\0\0\0\0".to_vec();
    bytes.extend_from_slice(&(values.len() as u32).to_be_bytes());
    bytes.extend(values.iter().flat_map(|v| v.to_be_bytes()));
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes
}

/// An ICC tag of type `parametricCurveType`.
pub fn para(kind: u16, parameters: &[f64]) -> Vec<u8> {
    let mut bytes = b"para\0\0\0\0".to_vec();
    bytes.extend_from_slice(&kind.to_be_bytes());
    bytes.extend_from_slice(&[0, 0]);
    bytes.extend(parameters.iter().flat_map(|p| ((p * 65536.0).round() as i32).to_be_bytes()));
    bytes
}

/// An ICC tag of type `lut8Type` that maps all colors to black.
pub fn mft1() -> Vec<u8> {
    let mut bytes = b"mft1\0\0\0\0\x03\x03\x02\0".to_vec();
    let one = [0, 1, 0, 0];
    let zero = [0; 4];
    bytes.extend([one, zero, zero, zero, one, zero, zero, zero, one].concat());
    let (input, cube, output) = (3 * 256, 2 * 2 * 2 * 3, 3 * 256);
    bytes.resize(bytes.len() + input + cube + output, 0);
    bytes
}
