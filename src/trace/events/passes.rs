//! Where stages and their passes begin.

use super::{EventData, Subject};
use crate::trace::Stage;

/// The steps that follow belong to a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StageBegan {
    /// The stage.
    pub stage: Stage,
}

/// The steps that follow belong to a pass of the stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassBegan {
    /// The pass.
    pub pass: Pass,
}

/// A part of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// Areas become cylinders that grow (5.3).
    Hypotheses,
    /// Broad highlights go back to their objects (refines 5.3).
    Absorbing,
    /// Unexplained pixels are classified again in windows of this side, pixels (refines 5.3).
    SecondLook(u16),
    /// Contested pixels follow the majority around them (refines 5.3.2).
    Vote,
    /// Regions on one matte line become one (refines 5.3.2).
    Uniting,
    /// Neighbors are tested as highlights (5.4.1).
    Candidates,
    /// The light's color is estimated (5.4.1), for the first time or once more.
    Illuminant,
    /// Planes or votes: which light is used (refines 5.4.1).
    LightChoice,
    /// Labels go back to the matte regions, for slices that turn to another light (refines 5.4).
    Reset,
    /// Slices grow (5.4.2).
    Slices,
    /// Highlights grow into what is brighter than where they start (5.5).
    Brightness,
    /// Clipped components join the region around them (5.5).
    ClippedHoles,
    /// Small components wholly inside a region join it (5.5).
    SmallHoles,
    /// Regions on one matte line that an occluder parts are joined.
    Joining,
    /// Parts of a region that are objects of their own are separated.
    Separating,
    /// Regions that are too small go, the others are numbered.
    Numbering,
    /// What the matte lines tell of ambient light (7.5).
    Ambient,
    /// Body and surface vectors of each region (section 6).
    Vectors,
    /// Where no region holds, pixels are split by their surroundings (beyond section 6).
    LocalSplit,
    /// Clipped blobs there are filled from around them.
    ClipRepair,
    /// Each pixel's role (section 6).
    Labels,
}

impl Pass {
    /// Its name on the timeline and in traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hypotheses => "hypotheses",
            Self::Absorbing => "absorb highlights",
            Self::SecondLook(_) => "second look",
            Self::Vote => "proximity vote",
            Self::Uniting => "unite regions",
            Self::Candidates => "skewed-T tests",
            Self::Illuminant => "illuminant",
            Self::LightChoice => "choice of light",
            Self::Reset => "back to matte",
            Self::Slices => "slices",
            Self::Brightness => "brighter than the start",
            Self::ClippedHoles => "clipped holes",
            Self::SmallHoles => "small holes",
            Self::Joining => "join across",
            Self::Separating => "separate parts",
            Self::Numbering => "number",
            Self::Ambient => "ambient light",
            Self::Vectors => "vectors",
            Self::LocalSplit => "local split",
            Self::ClipRepair => "clip repair",
            Self::Labels => "labels",
        }
    }
}

impl EventData for StageBegan {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}

impl EventData for PassBegan {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [None, None]
    }

    fn heap_bytes(&self) -> usize {
        0
    }
}
