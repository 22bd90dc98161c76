//! The light that is used, and its evidence: the directions of highlight clusters (5.4.1), the planes of hypotheses, or the votes of
//! small highlights (beyond 5.4).

use super::EventData;
use crate::raster::HypothesisId;

/// The color of the light was estimated (section 5.4.1).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct IlluminantEstimated {
    /// Unit direction of the light.
    pub direction: [f64; 3],
    /// The contribution of each hypothesis.
    pub contributions: Vec<Contribution>,
    /// The comparison of the light of all pixels off the matte lines with the light of the highlights alone; none where there was no
    /// comparison.
    pub outshone: Option<TwoLightTest>,
}

/// The contribution of one hypothesis to the estimate of the light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Contribution {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Angle between the light and the constraint of the hypothesis, degrees.
    pub residual_deg: f64,
    /// Weight of the constraint.
    pub weight: f64,
}

/// The color of the light was computed as the average direction of all highlight clusters (section 5.4.1, the paper's method).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HighlightsAveraged {
    /// Unit direction of the light, the average.
    pub direction: [f64; 3],
    /// The highlight directions that were averaged, each with the same weight.
    pub contributions: Vec<AveragedDirection>,
}

/// The highlight direction of one hypothesis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AveragedDirection {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Unit direction of the highlight cluster.
    pub direction: [f64; 3],
    /// Angle between this direction and the average, degrees.
    pub angle_deg: f64,
}

/// The color of the light was given, and therefore not estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IlluminantGiven {
    /// Unit direction of the light.
    pub direction: [f64; 3],
}

/// The evidence of the light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum LightBasis {
    /// There is no evidence: no light is known.
    #[default]
    Nothing,
    /// The method seeks no light: it finds regions alone.
    NotSought,
    /// The light was given.
    Given,
    /// The average of the directions of highlight clusters (the paper's method).
    Average,
    /// The highlight line of pixels that a person has marked (the method by hand).
    ByHand,
    /// The dichromatic planes of regions.
    Planes,
    /// The votes of small highlights.
    Votes,
}

impl LightBasis {
    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "none",
            Self::NotSought => "not_sought",
            Self::Given => "given",
            Self::Average => "average",
            Self::ByHand => "by_hand",
            Self::Planes => "planes",
            Self::Votes => "votes",
        }
    }
}

/// The light that small highlights vote for.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct VoteResult {
    /// Unit direction.
    pub direction: [f64; 3],
    /// Number of pixels that voted.
    pub voters: u32,
    /// Number of small highlights of these pixels.
    pub blobs: u32,
    /// Share of the votes for the light, 0…1.
    pub share: f64,
    /// Angles from white, degrees: from blue (negative) to yellow, and from green (negative) to magenta.
    pub offsets_deg: [f64; 2],
    /// Share of the lit pixels whose color is that of the light, 0…1.
    pub body_share: f64,
}

impl VoteResult {
    /// Whether the light has the unusual color of a body of the picture, which spots of that body would vote for.
    pub fn has_color_of_a_body(&self, limits: &LightLimits) -> bool {
        let from_white_deg = self.offsets_deg[0].hypot(self.offsets_deg[1]);
        from_white_deg > limits.body_offset_deg && self.body_share > limits.body_share
    }
}

/// Small highlights voted for a light (refines section 5.4.1).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct VotesCast {
    /// The light with most votes; none where too few pixels voted.
    pub elected: Option<VoteResult>,
    /// Fewest pixels with which a vote counts.
    pub least_voters: u32,
}

/// It was decided which light is used (refines section 5.4.1).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LightChosen {
    /// The evidence of the light that is used.
    pub basis: LightBasis,
    /// Unit direction of the light that is used; none: no light is known.
    pub direction: Option<[f64; 3]>,
    /// The light by the dichromatic planes, unit, and the number of its objects.
    pub planes: Option<([f64; 3], u32)>,
    /// The light by the votes.
    pub votes: Option<VoteResult>,
    /// Share of the lit pixels in regions that are explained and show highlights under the light of the planes, 0…1.
    pub support: f64,
    /// The odds for the votes; none where at most one of both estimates is a light that could be.
    pub odds: Option<LightOdds>,
    /// The limits of the rule.
    pub limits: LightLimits,
}

/// Logarithm of the odds that the light by the votes is better than the light by the planes, by its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightOdds {
    /// How much less usual the planes' light is.
    pub unusualness: f64,
    /// How much wider the interval of the planes' light is.
    pub intervals: f64,
    /// How much smaller the share of the votes for the planes' light is.
    pub shares: f64,
}

impl LightOdds {
    /// All parts together.
    pub fn sum(&self) -> f64 {
        self.unusualness + self.intervals + self.shares
    }
}

/// The limits of the rule that chooses the light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LightLimits {
    /// Logarithm of the odds above which the votes win.
    pub log_odds: f64,
    /// Least share of the votes for the light that they elect, 0…1 …
    pub share: f64,
    /// … and the least share where the planes give no light.
    pub share_without_planes: f64,
    /// Largest distance from white of a light by votes: blue to yellow, green to magenta, degrees.
    pub offsets_deg: [f64; 2],
    /// A light by votes whose color is that of a larger share of the lit pixels, 0…1, and farther from white than the next limit is that of
    /// a second body.
    pub body_share: f64,
    /// Angle from white up to which a light by votes may have the color of a body, degrees.
    pub body_offset_deg: f64,
    /// Largest distance from white of a light by planes, likewise, degrees.
    pub planes_offsets_deg: [f64; 2],
    /// Widest interval of a light by planes, degrees.
    pub planes_interval_deg: f64,
}

/// How well two lights explain the pixels whose surface reflection outshines the body (7.5): the light of all pixels off the matte
/// lines, and the light of the highlights alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TwoLightTest {
    /// Number of these pixels.
    pub pixels: u32,
    /// Mean squared distance of the pixels from the planes under the light of all pixels, σ².
    pub by_all: f64,
    /// The same under the light of the highlights alone, σ²; none where the first distance is small enough.
    pub by_highlights: Option<f64>,
    /// Largest distance under the light of the highlights, σ², and the least factor by which the distance has to be smaller.
    pub limits: [f64; 2],
    /// Whether the highlights' light was taken.
    pub taken: bool,
}

/// The regions whose highlights contradict the light that is used were searched for a second lamp (section 7.5), or the regions were divided
/// between the light that is used and a second lamp that was given.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LampsCompared {
    /// Unit direction of the light that is used.
    pub first: [f64; 3],
    /// Unit direction of the second lamp; none where the contradicting regions do not agree on a lamp.
    pub second: Option<[f64; 3]>,
    /// Whether the second lamp was given and not sought.
    pub given: bool,
    /// Two standard deviations of the second lamp's direction, degrees; none for a lamp that was given.
    pub interval_deg: Option<f64>,
    /// Number of regions whose highlights contradict the first light.
    pub contradicting: u32,
    /// Number of these that agree with the second lamp.
    pub agreeing: u32,
    /// How well each region with highlights agrees with both.
    pub regions: Vec<LampOfRegion>,
    /// The limits of the search.
    pub limits: LampLimits,
}

/// How well the highlights of one region agree with two lamps.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LampOfRegion {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Angle between the light and the highlights, as a share of the largest error that is expected: of the first light and of the second;
    /// none without a second lamp.
    pub misfits: [Option<f64>; 2],
}

impl LampOfRegion {
    /// Whether the second lamp lights the region.
    pub fn is_second(&self) -> bool {
        matches!(self.misfits, [Some(first), Some(second)] if second < first)
    }
}

/// The limits of the search for a second lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LampLimits {
    /// Misfit above which a region contradicts the first light.
    pub contradicts: f64,
    /// Misfit below which a region agrees with the second lamp.
    pub agrees: f64,
    /// Fewest regions that agree …
    pub regions: u32,
    /// … and their least share of the contradicting regions, 0…1, …
    pub share: f64,
    /// … which does not matter from this number of agreeing regions on.
    pub ample_regions: u32,
    /// Least mean merit of the agreeing regions: 1 / (1 + the sum of both squared angles in standard deviations).
    pub merit: f64,
    /// Least angle between both lamps, degrees: at least the interval of the first light.
    pub angle_deg: f64,
    /// Largest distance of the second lamp from white: blue to yellow, green to magenta, degrees.
    pub offsets_deg: [f64; 2],
}

impl EventData for IlluminantEstimated {
    fn heap_bytes(&self) -> usize {
        size_of_val(self.contributions.as_slice())
    }
}

impl EventData for HighlightsAveraged {
    fn heap_bytes(&self) -> usize {
        size_of_val(self.contributions.as_slice())
    }
}

impl EventData for IlluminantGiven {}

impl EventData for VotesCast {}

impl EventData for LightChosen {}

impl EventData for LampsCompared {
    fn heap_bytes(&self) -> usize {
        size_of_val(self.regions.as_slice())
    }
}
