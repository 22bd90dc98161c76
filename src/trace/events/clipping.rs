//! Clipped pixels and holes (section 5.5), and which hypotheses become regions of the result.

use super::{EventData, Subject};
use crate::raster::{HypothesisId, PixelIndex, RegionId};

/// A component of unassigned pixels was given to the hypothesis around it (section 5.5).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct HoleFilled {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// First pixel of the component, row-major.
    pub pixel: PixelIndex,
    /// Pixels of the component.
    pub pixels: u32,
    /// Share of the component's assigned border that the hypothesis holds, 0…1.
    pub border_share: f64,
}

/// A hypothesis was too small to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Dropped {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Pixels of the hypothesis.
    pub pixels: u32,
}

/// A part of a hypothesis that lies apart became a hypothesis of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ComponentSplit {
    /// The hypothesis that the part was separated from.
    pub hypothesis: HypothesisId,
    /// The new hypothesis.
    pub part: HypothesisId,
    /// Pixels of the part.
    pub pixels: u32,
}

/// The hypotheses that are left became the regions of the result.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Renumbered {
    /// The region of each hypothesis, by [`HypothesisId::index`]; none for a hypothesis that is in no region.
    pub regions: Box<[Option<RegionId>]>,
}

impl EventData for HoleFilled {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for Dropped {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for ComponentSplit {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), Some(Subject::Hypothesis(self.part))]
    }
}

impl EventData for Renumbered {
    fn heap_bytes(&self) -> usize {
        size_of_val(&*self.regions)
    }
}
