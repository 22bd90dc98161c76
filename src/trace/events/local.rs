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
    /// The second lamp, unit; none with one lamp.
    pub second_light: Option<[f64; 3]>,
    /// The color from which colors are measured: black, or the ambient light, counts.
    pub origin: [f64; 3],
    /// The limits of the local split.
    pub limits: LocalLimits,
    /// Whether highlights are told from print (refinement `highlight_evidence`).
    pub highlight_evidence: bool,
    /// Whether the amounts follow the edges of the picture (refinement `guided_amount`).
    pub guided_amount: bool,
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
    /// Log odds of a highlight over which the weight of surface reflection rises from 0 to 1.
    pub odds: Ramp,
    /// κ over which the weight of surface reflection falls from 1 to 0: colors that are nearly gray have no reliable hue.
    pub ratio: Ramp,
    /// Standard deviation of a band's noise, counts.
    pub sigma: f32,
}

/// A range over which a weight changes smoothly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ramp {
    /// The value up to which the weight does not change.
    pub start: f32,
    /// The value from which on the weight does not change any more.
    pub end: f32,
}

impl Ramp {
    /// 0 up to the start, 1 from the end on, and a smooth step between.
    #[inline]
    pub fn step(&self, value: f32) -> f32 {
        let share = ((value - self.start) / (self.end - self.start)).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
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

    /// The share of a pixel's excess ms that is surface reflection, 0…1, by the log odds of a highlight and by κ. A color that cannot be
    /// judged has none. Where highlights are not told from print (no `odds`), all counts that exceeds the variation of the hue.
    #[inline]
    pub fn weight(&self, found: &Desaturation, ratio: f32, odds: Option<f32>) -> f32 {
        let Some(odds) = odds else { return f32::from(u8::from(found.is_strong())) };
        if !found.is_judged() {
            return 0.0;
        }
        let above_noise = Ramp { start: found.noise_limit, end: 2.0 * found.noise_limit };
        self.odds.step(odds) * above_noise.step(found.surface) * (1.0 - self.ratio.step(ratio))
    }
}

/// What speaks for and against a highlight in one pixel, log odds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HighlightTerms {
    /// The chromatic part is as large as around.
    pub chroma: f32,
    /// Body and surface reflection do not vary against each other.
    pub independence: f32,
    /// The pixel is brighter than the body around.
    pub brightness: f32,
    /// Surface reflection has edges where body reflection has none.
    pub edges: f32,
}

impl HighlightTerms {
    /// The sum of the terms.
    pub fn sum(&self) -> f32 {
        self.chroma + self.independence + self.brightness + self.edges
    }
}

/// The odds of the picture were found (refinement `highlight_evidence`): how much of what is paler than its hue is highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PictureOddsFound {
    /// Number of unexplained pixels that are paler than their hue beyond the noise.
    pub pixels: u32,
    /// Log odds that are added to those of each pixel: positive where most of the excess is of highlights.
    pub log_odds: f32,
}

/// The plausibility of highlights under this light was tested (refinement `belief`).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PlausibilityTested {
    /// Share of the votes for the light, 0…1; none where explained regions support the light, the light was given, or votes are off.
    pub share: Option<f64>,
    /// Least share of the votes, 0…1.
    pub least_share: f64,
}

impl PlausibilityTested {
    /// Whether highlights under this light are plausible; where not, no pixel is split locally.
    pub fn plausible(&self) -> bool {
        self.share.is_none_or(|share| share >= self.least_share)
    }
}

/// A blob of clipped pixels was filled from the pixels around it, or not (refinement `clip_repair`).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RepairTried {
    /// Number of the blob, from 1.
    pub blob: u16,
    /// The first pixel of the blob.
    pub pixel: PixelIndex,
    /// Number of pixels.
    pub pixels: u32,
    /// Share of the ring of 2 px around the blob that is highlight, 0…1, and the least share at which the blob is filled.
    pub ring: Measured<f32>,
    /// Mean surface reflection of the ring's inner pixels, counts a band.
    pub inner: f32,
    /// Mean surface reflection of the ring's outer pixels, counts a band.
    pub outer: f32,
    /// Standard deviation of the body reflection of the ring, of a small blob of the ring's unexplained pixels, as a share of its mean, and the largest share at which the blob is filled.
    pub spread: Measured<f32>,
    /// Number of highlight pixels around the blob, and the least number at which the blob is filled.
    pub around: Measured<f32>,
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
    /// The body reflection of the ring is of several materials.
    Uneven,
    /// The highlight around the blob is too small for the blob.
    TooSmall,
}

impl RepairVerdict {
    /// The name in trace lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Filled => "filled",
            Self::TooLarge => "too_large",
            Self::NoRing => "no_ring",
            Self::NoHighlight => "no_highlight",
            Self::Uneven => "uneven",
            Self::TooSmall => "too_small",
            Self::NoRise => "no_rise",
        }
    }
}

impl EventData for LocalBegan {}

impl EventData for PictureOddsFound {}

impl EventData for PlausibilityTested {}

impl EventData for RepairTried {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Blob(self.blob)), None]
    }
}
