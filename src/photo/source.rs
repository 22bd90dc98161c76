//! What a file held, kept so that the photograph can be written back as it came.

use super::format::Format;

/// The file behind a photograph: its samples as they were, upright, and what it said about their meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// The file's format.
    pub format: Format,
    /// The bands of each pixel.
    pub layout: Layout,
    /// All samples, pixel after pixel, in the upright orientation; palettes are already looked up, and gray and
    /// palette samples of less than 8 bits are spread over 8.
    pub samples: Samples,
    /// The largest value that an integer sample can take; `None` for floats.
    pub max: Option<u32>,
    /// What the alpha channel means, where the layout has one.
    pub alpha: AlphaKind,
    /// The embedded ICC profile.
    pub icc: Option<Vec<u8>>,
    /// The color chunks of a PNG other than the profile.
    pub png: PngColor,
}

/// The bands of a pixel, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One band.
    Gray,
    /// One band and alpha.
    GrayAlpha,
    /// Three bands.
    Rgb,
    /// Three bands and alpha.
    Rgba,
}

impl Layout {
    /// Samples per pixel.
    pub const fn channels(self) -> usize {
        match self {
            Self::Gray => 1,
            Self::GrayAlpha => 2,
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }

    /// Whether the last sample of a pixel is its alpha.
    pub const fn has_alpha(self) -> bool {
        matches!(self, Self::GrayAlpha | Self::Rgba)
    }

    /// Whether there is one band, alpha aside.
    pub const fn is_gray(self) -> bool {
        matches!(self, Self::Gray | Self::GrayAlpha)
    }

    /// The same with three bands.
    pub(crate) const fn colored(self) -> Self {
        if self.has_alpha() { Self::Rgba } else { Self::Rgb }
    }

    /// The layout of this many channels.
    pub(super) const fn of_channels(channels: usize) -> Option<Self> {
        match channels {
            1 => Some(Self::Gray),
            2 => Some(Self::GrayAlpha),
            3 => Some(Self::Rgb),
            4 => Some(Self::Rgba),
            _ => None,
        }
    }
}

/// Samples in the file's own type (half floats are widened, doubles rounded to single).
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the types name themselves")]
pub enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
    F32(Vec<f32>),
}

impl Samples {
    /// Number of samples.
    pub fn len(&self) -> usize {
        match self {
            Self::U8(v) => v.len(),
            Self::U16(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::F32(v) => v.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The largest value of the integer type; `None` for floats.
    pub const fn type_max(&self) -> Option<u32> {
        match self {
            Self::U8(_) => Some(u8::MAX as u32),
            Self::U16(_) => Some(u16::MAX as u32),
            Self::U32(_) => Some(u32::MAX),
            Self::F32(_) => None,
        }
    }
}

/// What an alpha channel means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaKind {
    /// The bands are those of the opaque pixel (PNG, WebP, most TIFFs).
    Straight,
    /// The bands are multiplied by alpha already: composited on black as they stand (`OpenEXR`, some TIFFs).
    Associated,
}

/// The color chunks of a PNG (PNG 3rd edition, 11.3.2), the embedded profile aside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PngColor {
    /// cICP: primaries, transfer characteristics, matrix, full range flag.
    pub cicp: Option<[u8; 4]>,
    /// sRGB: the rendering intent.
    pub srgb: Option<u8>,
    /// gAMA: the exponent of the file's encoding × 100 000.
    pub gama: Option<u32>,
}
