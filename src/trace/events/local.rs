//! Decisions of the local split, where no region explains the pixels (beyond section 6).

use super::{EventData, Subject};
use crate::raster::PixelIndex;
use crate::reflection::{Desaturation, WhitenedColor};
use crate::trace::Measured;

/// The local split begins, or does not (beyond section 6).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LocalBegan {
    /// Whether the local split begins, or why not.
    pub start: LocalStart,
    /// Number of lit pixels that no region explains.
    pub pixels: u32,
    /// Number of all lit pixels.
    pub lit: u32,
    /// Fewest unexplained pixels with which the local split begins.
    pub least: u32,
    /// The light, unit.
    pub light: Option<[f64; 3]>,
    /// The color from which colors are measured: black, or the ambient light, counts.
    pub origin: [f64; 3],
    /// The limits of the local split.
    pub limits: LocalLimits,
    /// Whether texture is tested (refinement `texture_test`).
    pub texture_test: bool,
    /// Whether whole blobs are judged, or single pixels (refinement `hysteresis`).
    pub hysteresis: bool,
    /// Whether clipped blobs are filled (refinement `clip_repair`).
    pub clip_repair: bool,
}

/// Whether the local split begins, or why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LocalStart {
    /// The local split begins.
    Begins,
    /// The local split is switched off.
    Off,
    /// Too few pixels are unexplained.
    Few,
    /// The light is not known, or a band of the light is zero.
    NoLight,
}

/// What pixels of the local split are held against.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LocalLimits {
    /// Least mean of J = I / (√3 s) that has a hue, counts.
    pub mean: f32,
    /// Least chromatic part of J that has a hue, counts.
    pub chroma: f32,
    /// How the weight of surface reflection falls with texture.
    pub texture: TextureFade,
    /// Texture below which a pixel can be of a strong core.
    pub core_texture: f32,
    /// Standard deviation of a band's noise, counts.
    pub sigma: f32,
}

/// The range of texture, 0…1, over which the weight of surface reflection falls from 1 to 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TextureFade {
    /// Texture up to which all of a pixel's surface reflection counts.
    pub start: f32,
    /// How far texture rises from `start` until no surface reflection counts.
    pub width: f32,
}

impl TextureFade {
    /// Texture up to which all of a pixel's surface reflection counts, and texture from which on none does.
    pub fn ends(&self) -> [f32; 2] {
        [self.start, self.start + self.width]
    }
}

impl LocalLimits {
    /// Whether a color is bright and saturated enough to have a hue.
    #[inline]
    pub fn has_hue(&self, color: WhitenedColor) -> bool {
        color.mean > self.mean && color.chroma > self.chroma
    }

    /// The desaturation of a pixel. `ratios`: κ and the median of a/c around the pixel. Only unclipped colors that have a hue
    /// are judged.
    #[inline]
    pub fn desaturation(&self, color: WhitenedColor, ratios: [f32; 2], is_clipped: bool) -> Desaturation {
        if self.has_hue(color) && !is_clipped {
            Desaturation::new(color, ratios, self.sigma)
        } else {
            Desaturation::unjudged(color, ratios[0])
        }
    }

    /// The share of a pixel's surface reflection that counts, 0…1, by texture.
    #[inline]
    pub fn weight(&self, texture: f32) -> f32 {
        1.0 - ((texture - self.texture.start) / self.texture.width).clamp(0.0, 1.0)
    }
}

/// A candidate highlight was judged (refinement `hysteresis`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BlobJudged {
    /// Number of the blob, from 1; the numbers of clipped blobs follow.
    pub blob: u16,
    /// The first pixel of the blob.
    pub pixel: PixelIndex,
    /// Number of pixels, without the clipped ones.
    pub pixels: u32,
    /// Number of clipped pixels that are connected with the blob.
    pub clipped: u32,
    /// Number of pixels with surface reflection above the variation of their hue.
    pub strong: u32,
    /// Number of these pixels that do not look like texture.
    pub calm: u32,
    /// Number of these pixels in squares of 3 × 3 such pixels: the core.
    pub core: u32,
    /// Whether the blob is a highlight: whether there is a core, or clipped pixels.
    pub kept: bool,
}

/// The plausibility of the highlights under this light was tested (refinement `belief`). The first test that fails ends the
/// tests: later figures are none.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlausibilityTested {
    /// Share of the votes for the light, 0…1; none where explained regions support the light, the light was given, or votes are off.
    pub share: Option<f64>,
    /// Share of the light of the unexplained pixels that would be surface reflection, 0…1.
    pub surface: Option<f64>,
    /// Share of the strong highlight pixels whose surface reflection exceeds the body reflection, 0…1, and the number of strong
    /// pixels.
    pub outshining: Option<(f64, u32)>,
    /// The limits of these figures.
    pub limits: PlausibilityLimits,
    /// Why no pixel is split locally; none: the highlights are plausible.
    pub reject_reason: Option<RejectReason>,
}

/// The limits of a [`PlausibilityTested`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlausibilityLimits {
    /// Least share of the votes, 0…1.
    pub share: f64,
    /// Largest share of surface reflection, 0…1.
    pub surface: f64,
    /// Largest share of strong pixels whose surface reflection exceeds the body reflection, 0…1.
    pub outshining: f64,
}

/// Why the highlights are not plausible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RejectReason {
    /// Too small a share of the votes is for the light.
    NoVote,
    /// Too much would be surface reflection.
    TooMuch,
    /// Surface reflection exceeds body reflection in too many pixels: the highlights are white objects.
    Outshining,
}

impl RejectReason {
    /// The name in trace lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoVote => "no_vote",
            Self::TooMuch => "too_much",
            Self::Outshining => "outshining",
        }
    }
}

/// A blob of clipped pixels was filled from the pixels around it, or not (refinement `clip_repair`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RepairTried {
    /// Number of the blob, after those of the candidate highlights.
    pub blob: u16,
    /// The first pixel of the blob.
    pub pixel: PixelIndex,
    /// Number of pixels.
    pub pixels: u32,
    /// Share of the ring of 2 px around the blob that is highlight, 0…1, and the least share at which it is filled.
    pub ring: Measured<f32>,
    /// Mean surface reflection of the ring's inner pixels, counts a band.
    pub inner: f32,
    /// Mean surface reflection of the ring's outer pixels, counts a band.
    pub outer: f32,
    /// Whether the blob was filled, or why not.
    pub verdict: RepairVerdict,
}

/// Whether a clipped blob is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RepairVerdict {
    /// The blob is filled.
    Filled,
    /// The blob is as large as windows and skies.
    TooLarge,
    /// There is no ring of unclipped pixels around the blob.
    NoRing,
    /// Too little of the ring is highlight.
    NoHighlight,
    /// Surface reflection does not rise towards the blob.
    NoRise,
}

impl RepairVerdict {
    /// The name in trace lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Filled => "filled",
            Self::TooLarge => "too_large",
            Self::NoRing => "no_ring",
            Self::NoHighlight => "no_highlight",
            Self::NoRise => "no_rise",
        }
    }
}

/// Candidate highlights outside of the explained regions were counted; a [`BlobJudged`] follows for each large enough one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BlobsCounted {
    /// Number of candidate highlights.
    pub found: u32,
    /// Candidate highlights of too few pixels.
    pub small: u32,
    /// Pixels in those.
    pub small_pixels: u32,
    /// Fewest pixels of a candidate highlight that may count.
    pub least: u32,
}

impl EventData for LocalBegan {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for BlobsCounted {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for BlobJudged {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Blob(self.blob)), None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for PlausibilityTested {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for RepairTried {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Blob(self.blob)), None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}
