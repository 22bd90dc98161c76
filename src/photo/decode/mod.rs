//! Decoders, one per format: from the bytes of a file to its samples as stored, with the file's statements about them.

mod exr;
mod jpeg;
mod png;
mod simple;
mod tiff;

use super::coding::Compression;
use super::error::Fault;
use super::format::Format;
use super::source::{AlphaKind, Layout, PngColor, Samples};
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
    pub png: PngColor,
    pub compression: Compression,
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
            png: PngColor::default(),
            compression: Compression::Lossless,
            orientation: Orientation::NoTransforms,
            warnings: Vec::new(),
        }
    }
}

/// Limit of the size of a picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    pub max_megapixels: f64,
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
        Ok((width as usize, height as usize))
    }

    /// Number of bytes that a decoder may allocate for itself while it decodes an accepted picture.
    fn working_bytes(self) -> usize {
        const OVERHEAD: f64 = (64 << 20) as f64;
        (self.max_megapixels * 1e6).mul_add(BYTES_PER_PIXEL as f64, OVERHEAD) as usize
    }
}

/// Number of bytes of the widest pixel: four samples of 64 bits.
const BYTES_PER_PIXEL: u64 = 32;

/// Decodes the picture in `bytes`, whose first bytes are those of `format`.
pub(super) fn decode(format: Format, bytes: &[u8], budget: Budget) -> Result<Decoded, Fault> {
    match format {
        Format::Png => png::decode(bytes, budget),
        Format::Jpeg => jpeg::decode(bytes, budget),
        Format::Tiff => tiff::decode(bytes, budget),
        Format::Exr => exr::decode(bytes, budget),
        Format::Bmp => simple::bmp(bytes, budget),
        Format::Pnm => simple::pnm(bytes, budget),
        Format::WebP => simple::webp(bytes, budget),
        Format::Hdr => simple::hdr(bytes, budget),
    }
}
