//! Reads a file into linear light, and masks the pixels that are not used.
//!
//! [`read`] reads nine formats, recognized by content and not by name. The function undoes the tone curve that the
//! user, the file or the default of the sample type gives, composites transparency on black, and turns the picture
//! upright. The resulting [`Photo`] holds linear counts for the analysis, and the [`Source`], which is needed to write
//! a picture in the way of the original file.

mod clipped_objects;
mod coding;
mod curve;
mod decode;
mod digest;
mod encoding;
mod error;
mod format;
mod icc;
mod linear;
mod linearize;
mod masks;
mod noise;
mod noise_correlation;
mod orient;
mod plateau;
mod source;
mod working;

pub use clipped_objects::{ClippedArea, ClippedAreaVerdict, clipped_areas};
pub use coding::{CodingCause, CodingError, Compression, LossyCompression};
pub use curve::ToneCurve;
pub(crate) use curve::nearest_code;
pub(crate) use decode::believable_pixels;
pub use digest::sha256_hex;
pub use encoding::{Encoding, EncodingChoice, InvalidEncoding};
pub use error::ReadError;
pub use format::Format;
pub use linear::{LARGEST_COUNTS, LinearImage};
pub use masks::{MaskLimits, Masks};
pub use noise::{NoiseEstimate, ShotNoise};
pub use noise_correlation::NoiseCorrelation;
pub use source::{AlphaKind, Density, DensityUnit, Layout, PngColor, Samples, Source, TiffColor};
pub use working::WorkingPicture;

use crate::raster::{Mask, Raster};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

/// Default number of counts at full scale.
pub const FULL_SCALE_COUNTS: f64 = 255.0;

/// Counts that 1.0 stands for in the files of a result, whatever the full scale of the photograph.
pub(crate) const COUNTS_PER_UNIT: f32 = 255.0;

/// Options for reading files.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadOptions {
    /// The user's choice of the tone curve.
    pub encoding: EncodingChoice,
    /// Counts that an integer's maximum and a float's 1.0 stand for; `None`: [`FULL_SCALE_COUNTS`].
    pub full_scale: Option<f64>,
    /// Limit of the number of pixels, megapixels. Larger pictures are rejected before memory is allocated for them.
    pub max_megapixels: f64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { encoding: EncodingChoice::Auto, full_scale: None, max_megapixels: 100.0 }
    }
}

/// A photograph in linear light, with all information of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct Photo {
    /// Name of the file as given by the caller.
    pub name: String,
    /// Linear image for the analysis, upright.
    pub image: Arc<LinearImage>,
    /// Samples and color information of the file, upright.
    pub source: Source,
    /// The tone curves of the file, and the reason for their choice.
    pub encoding: Encoding,
    /// Counts that an integer's maximum and a float's 1.0 stand for.
    pub full_scale: f64,
    /// Warnings for the user, each one an English sentence.
    pub warnings: Vec<String>,
}

/// Reads the photograph at `path`.
///
/// # Errors
/// [`ReadError`], displayed as one line that names the file: the file cannot be read, is no supported picture, is
/// damaged or too large, or an option has no valid value.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Photo, ReadError> {
    decode(&read_bytes(path)?, &path.display().to_string(), options)
}

/// The bytes of the picture file at `path`, read once from its beginning to its end, so that it may be a pipe.
///
/// # Errors
/// [`ReadError`] where the file cannot be read, is empty, or does not begin like a picture.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let name = path.display().to_string();
    let file = File::open(path).map_err(|cause| ReadError::Io { file: name.clone(), cause })?;
    read_stream(file, &name)
}

/// The bytes of a picture from a stream, for example standard input. `name` is used in messages.
///
/// # Errors
/// The errors of [`read_bytes`].
pub fn read_stream(mut stream: impl Read, name: &str) -> Result<Vec<u8>, ReadError> {
    let io = |cause| ReadError::Io { file: name.to_owned(), cause };
    // The first bytes are read alone, so that an unsupported file is rejected quickly, however large or endless it is.
    let mut bytes = Vec::new();
    (&mut stream).take(Format::MAGIC_BYTES as u64).read_to_end(&mut bytes).map_err(io)?;
    identify(&bytes, name)?;
    stream.read_to_end(&mut bytes).map_err(io)?;
    Ok(bytes)
}

/// Reads any supported picture as a mask, upright: a pixel is true when a band exceeds zero. The tone curve does not
/// matter.
///
/// # Errors
/// The errors of [`read`].
pub fn read_mask(path: &Path, options: &ReadOptions) -> Result<Mask, ReadError> {
    decode_mask(&read_bytes(path)?, &path.display().to_string(), options)
}

/// As [`read_mask`], from the bytes of a file. `name_hint` is used in messages.
///
/// # Errors
/// The errors of [`decode()`].
pub fn decode_mask(bytes: &[u8], name_hint: &str, options: &ReadOptions) -> Result<Mask, ReadError> {
    let photo = decode(bytes, name_hint, &ReadOptions { encoding: EncodingChoice::Linear, ..*options })?;
    Ok(photo.image.pixels.map(|color| color.iter().any(|&band| band > 0.0)))
}

/// Reads the photograph in `bytes`. `name_hint` is used in messages, and its extension is compared with the content.
///
/// # Errors
/// The errors of [`read`].
pub fn decode(bytes: &[u8], name_hint: &str, options: &ReadOptions) -> Result<Photo, ReadError> {
    check(options)?;
    let format = identify(bytes, name_hint)?;
    let budget = decode::Budget { max_megapixels: options.max_megapixels, file_bytes: bytes.len() };
    let decoded = decode::decode(format, bytes, budget).map_err(|fault| fault.of(name_hint, format))?;

    let mut warnings: Vec<String> = format.extension_warning(name_hint).into_iter().collect();
    warnings.extend_from_slice(&decoded.warnings);
    let compression = decoded.compression;
    let negative = decoded.upright_negative();
    let (source, (width, height)) = source(format, decoded);
    let encoding = Encoding::of(options.encoding, &source, &mut warnings);
    let full_scale = options.full_scale.unwrap_or(FULL_SCALE_COUNTS);
    let mut pixels = linearize::linear_pixels(&source, &encoding.curves, full_scale);
    for (pixel, _) in pixels.iter_mut().zip(negative.into_iter().flatten()).filter(|(_, negative)| *negative)
    {
        // A linear image recognizes a pixel without a value by a number that is none.
        *pixel = [f32::NAN; 3];
    }
    let pixels = Raster::from_vec(width, height, pixels)
        .ok_or_else(|| error::Fault::damaged("its size does not fit its pixels").of(name_hint, format))?;
    let clipping_value = if source.max.is_none() { plateau::clipping_value(&pixels) } else { None };
    let saturation = source.max.map(|_| full_scale as f32).or(clipping_value);
    if let Some(counts) = clipping_value {
        let value = f64::from(counts) / full_scale;
        warnings.push(format!(
            "many values of the file are equal to the largest one, {value:.4}, and are taken for clipped unless --clip-threshold says otherwise"
        ));
    }
    let coding =
        source.max.and_then(|max| CodingError::of_samples(compression, max, &encoding.curves[1], full_scale));
    let (huge, largest) = huge_values(&pixels);
    if huge > 0 {
        warnings.push(format!(
            "{huge} of {} pixels have values up to {:.1e} times full scale, which no light has: they are left out",
            pixels.len(),
            f64::from(largest) / full_scale
        ));
    }
    let contrast = source.max.and_then(|_| encoding.contrast());
    let image = LinearImage::new(pixels, saturation).with_coding(coding).with_contrast(contrast);
    let image = Arc::new(image);
    warnings.extend(pixel_warnings(&source, &image, huge));
    Ok(Photo { name: name_hint.to_owned(), image, source, encoding, full_scale, warnings })
}

/// The upright content of a file, and its width and height.
fn source(format: Format, decoded: decode::Decoded) -> (Source, (usize, usize)) {
    let (samples, size) =
        orient::upright(decoded.samples, decoded.size, decoded.layout.channels(), decoded.orientation);
    let is_turned = orient::turns_by_a_quarter(decoded.orientation);
    let source = Source {
        format,
        layout: decoded.layout,
        samples,
        max: decoded.max,
        alpha: decoded.alpha,
        icc: decoded.icc,
        cicp: decoded.cicp,
        png: decoded.png,
        tiff_color: decoded.tiff_color,
        transfer: decoded.transfer,
        is_adobe_rgb: decoded.is_adobe_rgb,
        density: decoded.density.map(|density| if is_turned { density.turned() } else { density }),
    };
    (source, size)
}

fn check(options: &ReadOptions) -> Result<(), ReadError> {
    let positive = |value: f64| value.is_finite() && value > 0.0;
    match options.full_scale {
        Some(value) if !positive(value) => {
            Err(ReadError::Option { name: "full scale", value, unit: " of counts" })
        }
        _ if !positive(options.max_megapixels) => {
            let value = options.max_megapixels;
            Err(ReadError::Option { name: "max megapixels", value, unit: " of megapixels" })
        }
        _ => Ok(()),
    }
}

fn identify(bytes: &[u8], name: &str) -> Result<Format, ReadError> {
    let file = name.to_owned();
    if bytes.is_empty() {
        return Err(ReadError::Empty { file });
    }
    Format::of_content(bytes).map_err(|found| ReadError::UnknownFormat { file, found })
}

/// Number of pixels with a finite value above [`LARGEST_COUNTS`], and the largest value, counts.
fn huge_values(pixels: &Raster<[f32; 3]>) -> (usize, f32) {
    let huge = |pixel: &[f32; 3]| {
        let values = pixel.iter().copied().filter(|value| value.is_finite() && *value > LARGEST_COUNTS);
        values.reduce(f32::max)
    };
    let largest = pixels.as_slice().iter().filter_map(huge);
    largest.fold((0, 0.0), |(pixel_count, most), value| (pixel_count + 1, most.max(value)))
}

/// The warnings about pixels that are not used as they are. `huge`: number of those with too large values, which have a warning.
fn pixel_warnings(source: &Source, image: &LinearImage, huge: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    let pixels = image.pixels.len();
    let aspect = source.density.map_or(1.0, |density| density.pixel_aspect());
    if !(0.99..=1.01).contains(&aspect) {
        warnings.push(format!(
            "the file says that its pixels are {aspect:.2} times as wide as high: they are taken for squares"
        ));
    }
    let transparent = linearize::count_transparent(source);
    if transparent > 0 {
        warnings.push(format!(
            "{transparent} of {pixels} pixels are not fully opaque: the picture was composited on black"
        ));
    }
    let invalid = image.invalid.count().saturating_sub(huge);
    if invalid > 0 {
        warnings.push(format!(
            "{invalid} of {pixels} pixels have values that are negative or not finite: they are left out"
        ));
    }
    warnings
}
