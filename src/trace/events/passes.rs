//! The beginnings of stages and passes.

use super::EventData;
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
#[non_exhaustive]
pub enum Pass {
    /// Regions are split by the histograms of color features (7.2, an earlier method).
    Splitting,
    /// The peaks of the whole picture's histogram become regions (5.1, an earlier method).
    Clusters,
    /// The marked pixels are divided between a matte and a highlight line, or join the region of these lines (6, the method by hand).
    Marked,
    /// Merged areas start hypotheses, whose cylinders grow (5.3).
    Hypotheses,
    /// Broad highlights are absorbed by their objects (refines 5.3).
    Absorbing,
    /// Unexplained pixels are classified again in windows of this side, pixels (refines 5.3).
    SmallerWindows(u16),
    /// Contested pixels go to the majority around them (refines 5.3.2).
    Vote,
    /// Hypotheses on one matte line become one (refines 5.3.2).
    Uniting,
    /// Neighbors are tested as highlights (5.4.1).
    Candidates,
    /// The color of the light is estimated (5.4.1), for the first time or again.
    Illuminant,
    /// The light is chosen between planes and votes (refines 5.4.1).
    LightChoice,
    /// The labels are reset to those of the matte hypotheses, for slices under another light (refines 5.4).
    Reset,
    /// Slices grow (5.4.2).
    Slices,
    /// Highlights grow into what is brighter than where they start (5.5).
    Brightness,
    /// Clipped components join the hypothesis around them (5.5).
    ClippedHoles,
    /// Small components wholly inside a hypothesis join the hypothesis (5.5).
    SmallHoles,
    /// Hypotheses on one matte line that an occluder separates are joined.
    Joining,
    /// Parts of a hypothesis that are separate objects become hypotheses of their own.
    Separating,
    /// Hypotheses that are too small are dropped, the others are numbered as regions.
    Numbering,
    /// Ambient light is estimated from the matte lines (7.5).
    Ambient,
    /// Body and surface vectors of each region (section 6).
    Vectors,
    /// Pixels that no region explains are split by their surroundings (beyond section 6).
    LocalSplit,
    /// Clipped blobs of such pixels are filled from the pixels around them.
    ClipRepair,
    /// Each pixel gets its kind (section 6).
    Labels,
}

impl Pass {
    /// The name on the timeline and in sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Splitting => "region splitting",
            Self::Clusters => "color clusters",
            Self::Marked => "marked pixels",
            Self::Hypotheses => "hypotheses",
            Self::Absorbing => "absorb highlights",
            Self::SmallerWindows(_) => "smaller windows",
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

impl EventData for StageBegan {}

impl EventData for PassBegan {}
