//! Planar hypotheses (section 5.4.2).

use super::{EventData, Subject};
use crate::color::Vec3;
use crate::raster::HypothesisId;
use crate::reflection::{DichromaticPlane, Slice};

/// The dichromatic plane of a hypothesis became a slice (section 5.4.2).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SliceMade {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// The dichromatic plane.
    pub plane: DichromaticPlane,
    /// Length of the matte line from black, counts.
    pub matte_length: f64,
    /// The point where the highlight line leaves the matte line, counts.
    pub start: Vec3,
    /// Half the thickness of the slice, counts.
    pub half_width: f64,
    /// The colors that the slice accepts.
    pub slice: Slice,
}

/// A matte area became a part of another region: the growth of that region took more than half of the area, whose colors lie in the
/// region's matte cylinder (section 5.4.2).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MatteAreasUnited {
    /// The hypothesis whose matte area was taken.
    pub hypothesis: HypothesisId,
    /// The hypothesis that grew.
    pub into: HypothesisId,
    /// Number of pixels of the matte area that were taken.
    pub taken_px: u32,
    /// Number of all pixels of the matte area.
    pub area_px: u32,
}

impl EventData for MatteAreasUnited {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), Some(Subject::Hypothesis(self.into))]
    }
}

impl EventData for SliceMade {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}
