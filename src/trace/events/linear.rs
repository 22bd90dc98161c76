//! Linear hypotheses: how they start, grow and end (section 5.3).

use super::{EventData, Subject};
use crate::color::Line;
use crate::raster::HypothesisId;

/// A merged area started a linear hypothesis (section 5.3.1).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HypothesisChosen {
    /// The new hypothesis.
    pub hypothesis: HypothesisId,
    /// First window of the area.
    pub area: u32,
    /// Number of areas taken before in this pass: 0 for the largest.
    pub rank: u32,
    /// Number of pixels of the area that no hypothesis had claimed.
    pub pixels: u32,
    /// The axis of the cylinder.
    pub line: Line,
    /// Radius of the cylinder, counts.
    pub radius: f64,
}

/// A merged area did not start a hypothesis, or the hypothesis that it started was taken back (section 5.3.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct HypothesisPassedOver {
    /// First window of the area.
    pub area: u32,
    /// Number of pixels of the area that no hypothesis had claimed.
    pub pixels: u32,
    /// Fewest unclaimed pixels that the area needs.
    pub least: u32,
    /// Why the area was passed over.
    pub reason: PassedOver,
}

/// Why an area did not start a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PassedOver {
    /// The area never had the fewest pixels.
    TooSmall,
    /// Hypotheses claimed so many pixels of the area that too few were left.
    Consumed,
    /// The line of the area passes farther from black than the radius of the cylinder.
    FarFromBlack,
    /// The colors of the area have no extent to fit a line to.
    NoExtent,
    /// The growth from the area claimed too few pixels, which were given back.
    Barren,
    /// There are as many hypotheses as a label map can hold.
    NoNumberLeft,
}

/// The claims that follow, `pixels` of them, are the places where a hypothesis starts to grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SeedsPlaced {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Number of the claims.
    pub pixels: u32,
}

/// A hypothesis starts to grow: the claims that follow were reached from a neighbor.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct GrowthBegan {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Bound of the growth, counts: radius of the cylinder (linear stage), half thickness of the slice (planar stage), least
    /// brightness (clipping stage).
    pub limit: f32,
}

/// The line of a hypothesis was fitted again to the pixels that the hypothesis had grown into.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LineRefitted {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// The axis of the cylinder from now on.
    pub line: Line,
}

/// A linear hypothesis turned out to be the broad highlight of its neighbor (refines section 5.3).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Absorbed {
    /// The highlight, a hypothesis no longer.
    pub hypothesis: HypothesisId,
    /// The object that the highlight lies on.
    pub by: HypothesisId,
    /// Distance of the highlight's line from black, counts.
    pub highlight_foot: f64,
    /// Distance of the object's line from black, counts.
    pub object_foot: f64,
    /// Distance between both lines, counts.
    pub gap: f64,
}

/// Two hypotheses became one, as their lines do not differ significantly (refines section 5.3.2).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RegionsMerged {
    /// The hypothesis that vanished.
    pub hypothesis: HypothesisId,
    /// The hypothesis that has its pixels now.
    pub into: HypothesisId,
    /// Angle between both lines, degrees.
    pub angle_deg: f64,
    /// Root mean square distance of the vanished hypothesis's pixels from the other's line, counts.
    pub rms: f64,
}

impl EventData for HypothesisChosen {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for HypothesisPassedOver {}

impl EventData for SeedsPlaced {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for GrowthBegan {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for LineRefitted {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for Absorbed {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), Some(Subject::Hypothesis(self.by))]
    }
}

impl EventData for RegionsMerged {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), Some(Subject::Hypothesis(self.into))]
    }
}
