//! The content of a photograph's file, stored so that pictures can be written in the way of the original file.

use super::curve::ToneCurve;
use super::format::Format;

/// Samples of a photograph's file in the upright orientation, with the file's statements about their meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Format of the file.
    pub format: Format,
    /// Bands of each pixel.
    pub layout: Layout,
    /// All samples, pixel by pixel, in the upright orientation. Palette indices are replaced by colors, and gray and
    /// palette samples of less than 8 bits are scaled to 8 bits.
    pub samples: Samples,
    /// The largest value that an integer sample can take; `None` for floats.
    pub max: Option<u32>,
    /// Meaning of the alpha channel, for a layout with alpha.
    pub alpha: AlphaKind,
    /// Bytes of the embedded ICC profile.
    pub icc: Option<Vec<u8>>,
    /// Code points of the color (ITU-T H.273) that a PNG (chunk cICP) or a HEIF (box nclx) states: primaries, transfer
    /// characteristics, matrix and full-range flag of the samples as read.
    pub cicp: Option<[u8; 4]>,
    /// Other color chunks of a PNG file, without the profile.
    pub png: PngColor,
    /// White point and primaries of a TIFF or `OpenEXR` file.
    pub tiff_color: TiffColor,
    /// Tone curves of the bands that a TIFF or BMP states in its header.
    pub transfer: Option<[ToneCurve; 3]>,
    /// Whether EXIF says that the colors are those of Adobe RGB, as cameras do instead of embedding a profile.
    pub is_adobe_rgb: bool,
    /// Pixels per unit of length of the upright picture.
    pub density: Option<Density>,
}

/// The channels of a pixel, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One gray band.
    Gray,
    /// One gray band and alpha.
    GrayAlpha,
    /// Red, green and blue band.
    Rgb,
    /// Red, green and blue band, and alpha.
    Rgba,
}

impl Layout {
    /// Number of samples per pixel.
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

    /// Whether the layout has one color band.
    pub const fn is_gray(self) -> bool {
        matches!(self, Self::Gray | Self::GrayAlpha)
    }

    /// The layout with three color bands and the same alpha.
    pub(crate) const fn colored(self) -> Self {
        if self.has_alpha() { Self::Rgba } else { Self::Rgb }
    }

    /// The layout with `channels` samples per pixel; `None` for other numbers than 1 to 4.
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

/// Samples in the type of the file. Half floats are converted to 32-bit floats, doubles are rounded to 32 bits.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the types name themselves")]
pub enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
    F32(Vec<f32>),
}

impl Samples {
    /// Number of samples of all channels together.
    pub fn len(&self) -> usize {
        match self {
            Self::U8(v) => v.len(),
            Self::U16(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::F32(v) => v.len(),
        }
    }

    /// Whether there are no samples.
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

/// Relation between the color bands and the alpha channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaKind {
    /// The bands hold the color of the opaque pixel (PNG, WebP, most TIFFs).
    Straight,
    /// The bands are already multiplied by alpha, so the bands are the picture on black (`OpenEXR`, some TIFFs).
    Associated,
}

/// The color chunks of a PNG (PNG 3rd edition, 11.3.2), without the embedded profile and the code points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PngColor {
    /// Chunk sRGB: number of the rendering intent.
    pub srgb: Option<u8>,
    /// Chunk gAMA: exponent of the file's encoding × 100 000.
    pub gama: Option<u32>,
    /// Chunk cHRM: chromaticities x and y of white, red, green and blue × 100 000.
    pub chrm: Option<[u32; 8]>,
}

/// White point and primaries as TIFF states them: numerators and denominators of chromaticities. They are written again and
/// not used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TiffColor {
    /// Tag 318: x and y of the white point; empty where the file does not state it.
    pub white_point: Vec<(u32, u32)>,
    /// Tag 319: x and y of red, green and blue; empty where the file does not state them.
    pub primaries: Vec<(u32, u32)>,
}

/// Pixels per unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Density {
    /// Across and down, each as numerator and denominator above 0.
    pub axes: [(u32, u32); 2],
    /// The unit of length.
    pub unit: DensityUnit,
}

/// Unit of a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the units name themselves")]
pub enum DensityUnit {
    /// No unit: only the ratio of both axes is known.
    Ratio,
    Inch,
    Centimeter,
    Meter,
}

impl Density {
    /// A density; `None` where an axis is 0 or no number.
    pub(super) fn new(axes: [(u32, u32); 2], unit: DensityUnit) -> Option<Self> {
        axes.iter().all(|&(over, under)| over > 0 && under > 0).then_some(Self { axes, unit })
    }

    /// The density of pixels `aspect` times as wide as high, of an unknown size.
    pub(super) fn of_pixel_aspect(aspect: f32) -> Option<Self> {
        Self::new([(10_000, 1), ((aspect * 1e4).round() as u32, 1)], DensityUnit::Ratio)
    }

    /// The density of the picture turned by a quarter.
    pub(super) fn turned(self) -> Self {
        Self { axes: [self.axes[1], self.axes[0]], ..self }
    }

    /// Pixels per unit of length across and down.
    pub fn per_unit(&self) -> [f64; 2] {
        self.axes.map(|(over, under)| f64::from(over) / f64::from(under))
    }

    /// Width of a pixel as a multiple of its height.
    pub fn pixel_aspect(&self) -> f64 {
        let [across, down] = self.per_unit();
        down / across
    }
}
