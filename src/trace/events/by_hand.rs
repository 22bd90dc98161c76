//! The decisions about pixels that a person has marked (section 6, first paragraph; the method of 1987 and 1988).

use super::{EventData, Subject};
use crate::color::Line;
use crate::raster::HypothesisId;

/// A part of the marked pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum MarkedCluster {
    /// The pixels that are nearer to the matte line.
    Matte,
    /// The pixels that are nearer to the highlight line.
    Highlight,
    /// The clipped and bloomed pixels, which no line is fitted to.
    Distorted,
}

/// The line of the matte or of the highlight pixels among the marked ones was fitted. The first such event makes the hypothesis.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MarkedLineFitted {
    /// The hypothesis of the marked pixels.
    pub hypothesis: HypothesisId,
    /// Whose line: that of the matte or of the highlight pixels.
    pub cluster: MarkedCluster,
    /// Number of the round, from 1: both lines are fitted again until no pixel changes between them.
    pub round: u32,
    /// Number of pixels that the line was fitted to.
    pub pixels: u32,
    /// The line.
    pub line: Line,
    /// Root mean square distance of these pixels from the line, counts.
    pub rms_counts: f64,
    /// Radius of the cylinder around the line, counts.
    pub radius: f64,
}

/// The claims that follow, `pixels` of them, are marked pixels that the hypothesis takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct MarkedPixelsTaken {
    /// The hypothesis of the marked pixels.
    pub hypothesis: HypothesisId,
    /// Which of the marked pixels.
    pub cluster: MarkedCluster,
    /// Number of the claims.
    pub pixels: u32,
}

impl MarkedCluster {
    /// The name in trace lines and sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Matte => "matte",
            Self::Highlight => "highlight",
            Self::Distorted => "distorted",
        }
    }
}

impl EventData for MarkedLineFitted {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}

impl EventData for MarkedPixelsTaken {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }
}
