//! Which light is used, and on what it rests: the planes of regions, or the votes of small highlights (beyond 5.4).

use super::{EventData, Subject};
use crate::raster::HypothesisId;

/// The color of the light was estimated (section 5.4.1).
#[derive(Clone, Debug, PartialEq)]
pub struct IlluminantEstimated {
    /// Unit direction.
    pub direction: [f64; 3],
    /// Each region that had a say.
    pub contributions: Vec<Contribution>,
    /// Whether all pixels off the matte lines or the highlights alone had it, where both were held against each other.
    pub outshone: Option<TwoLightTest>,
}

/// What one region said about the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// How far the light lies from where the region puts it, degrees.
    pub residual_deg: f64,
    /// Its weight.
    pub weight: f64,
}

/// The color of the light was given: it was not estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IlluminantGiven {
    /// Unit direction of the light.
    pub direction: [f64; 3],
}

/// What the light rests on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightBasis {
    /// Nothing told of it.
    #[default]
    Nothing,
    /// It was given.
    Given,
    /// The dichromatic planes of regions.
    Planes,
    /// The votes of small highlights.
    Votes,
}

impl LightBasis {
    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nothing => "none",
            Self::Given => "given",
            Self::Planes => "planes",
            Self::Votes => "votes",
        }
    }
}

/// The light that small highlights vote for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoteResult {
    /// Unit direction.
    pub direction: [f64; 3],
    /// Pixels that were heard.
    pub voters: u32,
    /// Small highlights that they belong to.
    pub blobs: u32,
    /// Share of the votes that the light has, 0…1.
    pub share: f64,
    /// How far it lies from white: between blue (negative) and yellow, and between green (negative) and magenta, degrees.
    pub offsets_deg: [f64; 2],
}

/// Small highlights voted for a light (refines section 5.4.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VotesCast {
    /// The light with most votes; none where too few pixels have anything to say.
    pub elected: Option<VoteResult>,
    /// Fewest pixels that make a vote.
    pub least_voters: u32,
}

/// It was decided which light is used (refines section 5.4.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightChosen {
    /// What the light that is used rests on.
    pub basis: LightBasis,
    /// Its unit direction; none: no light is known.
    pub direction: Option<[f64; 3]>,
    /// The light by the dichromatic planes, unit, and how many objects it rests on.
    pub planes: Option<([f64; 3], u32)>,
    /// The light by the votes.
    pub votes: Option<VoteResult>,
    /// Share of the lit pixels in regions that hold and show highlights under the planes' light, 0…1.
    pub support: f64,
    /// What decided.
    pub limits: LightLimits,
}

/// What the ways to a light are held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightLimits {
    /// Support from which on the planes are believed, whatever the votes say, 0…1.
    pub support: f64,
    /// Support below which they are not, if votes were cast and are of no use either, 0…1.
    pub hardly: f64,
    /// Least share of the votes that elects a light, 0…1.
    pub share: f64,
    /// Farthest from white that a light by votes may lie: blue to yellow, green to magenta, degrees.
    pub offsets_deg: [f64; 2],
}

/// How well two lights explain the pixels that the light outshines (7.5): that of all pixels off the matte lines, and that of
/// the highlights alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLightTest {
    /// Outshone pixels.
    pub pixels: u32,
    /// Their mean squared distance from the planes under the one light, σ² …
    pub by_all: f64,
    /// … and under the other; none where the first one does well enough.
    pub by_highlights: Option<f64>,
    /// Up to where the other may go, and how many times better it has to be.
    pub limits: [f64; 2],
    /// Whether the highlights' light was taken.
    pub taken: bool,
}

impl EventData for IlluminantEstimated {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        size_of_val(self.contributions.as_slice())
    }
}

impl EventData for IlluminantGiven {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for VotesCast {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for LightChosen {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}
