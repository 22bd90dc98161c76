//! Decoders, one per format: from the bytes of a file to its samples as stored, with the file's statements about them.

mod bmp;
mod exif;
mod exr;
mod guard;
mod hdr;
mod heif;
mod ifd;
mod jpeg;
mod png;
mod simple;
mod tiff;

use super::coding::Compression;
use super::curve::ToneCurve;
use super::error::Fault;
use super::format::Format;
use super::orient;
use super::source::{AlphaKind, Density, Layout, PngColor, Samples, TiffColor};
use image::metadata::Orientation;

/// Samples of a decoded file, with the file's statements about them.
#[derive(Debug)]
pub(super) struct Decoded {
    /// Number of columns and rows, before the orientation is applied.
    pub size: (usize, usize),
    pub layout: Layout,
    /// `layout.channels()` samples per pixel, row by row, before the orientation is applied.
    pub samples: Samples,
    /// Largest value of an integer sample; `None` for floats.
    pub max: Option<u32>,
    pub alpha: AlphaKind,
    pub icc: Option<Vec<u8>>,
    pub cicp: Option<[u8; 4]>,
    pub png: PngColor,
    pub tiff_color: TiffColor,
    /// Tone curves of the bands that the file states otherwise than by a profile.
    pub transfer: Option<[ToneCurve; 3]>,
    /// Whether EXIF says that the colors are those of Adobe RGB.
    pub is_adobe_rgb: bool,
    pub density: Option<Density>,
    pub compression: Compression,
    /// Pixels with a sample below zero, which `samples` holds as 0; `None`: there are none.
    pub negative: Option<Vec<bool>>,
    /// Transformation that turns the stored picture upright.
    pub orientation: Orientation,
    pub warnings: Vec<String>,
}

impl Decoded {
    /// Samples of a file that states nothing else about them.
    fn plain(size: (usize, usize), layout: Layout, samples: Samples) -> Self {
        Self {
            size,
            layout,
            max: samples.type_max(),
            samples,
            alpha: AlphaKind::Straight,
            icc: None,
            cicp: None,
            png: PngColor::default(),
            tiff_color: TiffColor::default(),
            transfer: None,
            is_adobe_rgb: false,
            density: None,
            compression: Compression::Lossless,
            negative: None,
            orientation: Orientation::NoTransforms,
            warnings: Vec::new(),
        }
    }

    /// The marks of pixels with a sample below zero, in the upright orientation.
    pub(super) fn upright_negative(&self) -> Option<Vec<bool>> {
        let marks = self.negative.as_ref()?;
        Some(orient::upright_marks(marks, self.size, self.orientation))
    }

    /// Takes over what EXIF says; the file's own statements go before.
    fn take_exif(&mut self, exif: &exif::Exif) {
        self.orientation = exif.orientation.unwrap_or(Orientation::NoTransforms);
        self.density = self.density.or(exif.density);
        self.is_adobe_rgb = exif.is_adobe_rgb;
    }
}

/// Limit of the size of a picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    pub max_megapixels: f64,
    /// Number of bytes of the file.
    pub file_bytes: usize,
}

impl Budget {
    /// Checks a declared size against the limit; returns columns and rows.
    fn admit(self, width: impl TryInto<u64>, height: impl TryInto<u64>) -> Result<(usize, usize), Fault> {
        // A size that exceeds 64 bits is too large in any case.
        let (width, height) = (width.try_into().unwrap_or(u64::MAX), height.try_into().unwrap_or(u64::MAX));
        if width == 0 || height == 0 {
            return Err(Fault::NoPixels { width, height });
        }
        let too_large = Fault::TooLarge { width, height, limit_megapixels: self.max_megapixels };
        let bytes_at_most = width.checked_mul(height).and_then(|pixels| pixels.checked_mul(BYTES_PER_PIXEL));
        let fits = bytes_at_most.is_some_and(|bytes| isize::try_from(bytes).is_ok());
        if !fits || width as f64 * height as f64 > self.max_megapixels * 1e6 {
            return Err(too_large);
        }
        if width * height > believable_pixels(self.file_bytes) {
            let megapixels = width as f64 * height as f64 / 1e6;
            let bytes = self.file_bytes;
            return Err(Fault::damaged(format!("it declares {megapixels:.1} megapixels in {bytes} bytes")));
        }
        Ok((width as usize, height as usize))
    }

    /// Number of bytes that a decoder may allocate for itself while it decodes an accepted picture.
    fn working_bytes(self) -> usize {
        const OVERHEAD: f64 = (64 << 20) as f64;
        (self.max_megapixels * 1e6).mul_add(BYTES_PER_PIXEL as f64, OVERHEAD) as usize
    }
}

/// Largest number of pixels that a file of `file_bytes` bytes is believed to hold.
pub fn believable_pixels(file_bytes: usize) -> u64 {
    SMALL_PICTURE.saturating_add(PIXELS_PER_BYTE.saturating_mul(file_bytes as u64))
}

/// Number of pixels that are believed to be in a byte of a file, besides those of a small picture: more than any photograph's
/// file holds, so that a short file cannot make the program take much memory.
const PIXELS_PER_BYTE: u64 = 2048;
/// Number of pixels that any file may declare.
const SMALL_PICTURE: u64 = 2_000_000;

/// Number of bytes of the widest pixel: four samples of 64 bits.
const BYTES_PER_PIXEL: u64 = 32;

/// Decodes the picture in `bytes`, whose first bytes are those of `format`. A panic of a decoding library becomes an error.
pub(super) fn decode(format: Format, bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    guard::caught(|| of_format(format, bytes, budget)).unwrap_or_else(|message| Err(Fault::Crashed(message)))
}

fn of_format(format: Format, bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    match format {
        Format::Png => png::decode(bytes, budget),
        Format::Jpeg => jpeg::decode(bytes, budget),
        Format::Tiff => tiff::decode(bytes, budget),
        Format::Exr => exr::decode(bytes, budget),
        Format::Bmp => bmp::decode(bytes, budget),
        Format::Pnm => simple::pnm(bytes, budget),
        Format::WebP => simple::webp(bytes, budget),
        Format::Hdr => hdr::decode(bytes, budget),
        Format::Heif => heif::decode(bytes, budget),
    }
}
