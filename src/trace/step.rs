//! One step of a trace: an event, or a decision about one pixel and the values that decided.

use super::{Event, PixelKind};
use crate::raster::{HypothesisId, PixelIndex};

/// Two hypotheses wanted a pixel, or a hypothesis did not take a pixel whose color it accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contest {
    /// The measure by which the contest was decided.
    pub measure: Measure,
    /// The value of the hypothesis that wanted the pixel.
    pub challenger: f32,
    /// The value of the hypothesis that had the pixel, or the limit.
    pub holder: f32,
}

/// The measure by which a contest was decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Measure {
    /// Distances of the color from both axes, counts: the nearer wins (5.3.2).
    Axis,
    /// Distances from both planes, counts: the nearer wins (5.4.2).
    Plane,
    /// The pixel is a matte pixel of another hypothesis: distance of the color from the axis of the challenger, and the radius,
    /// counts (5.4.2).
    ForeignMatte,
    /// Number of pixels of the winner around the pixel, and number of pixels of all hypotheses there.
    Vote,
}

/// One step of a trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step<'a> {
    /// A decision with its numbers.
    Event(&'a Event),
    /// A pixel changed its owner.
    Claim {
        /// The pixel.
        pixel: PixelIndex,
        /// The hypothesis that had the pixel; none: no hypothesis.
        before: Option<HypothesisId>,
        /// The hypothesis that has the pixel from now on; none: no hypothesis.
        after: Option<HypothesisId>,
        /// The contest; none where only one hypothesis wanted the pixel.
        contest: Option<Contest>,
    },
    /// A change of owner was refused.
    Refusal {
        /// The pixel.
        pixel: PixelIndex,
        /// The hypothesis that keeps the pixel.
        holder: HypothesisId,
        /// The hypothesis that wanted the pixel.
        challenger: HypothesisId,
        /// The contest.
        contest: Contest,
    },
    /// A pixel got its kind (section 6).
    Label {
        /// The pixel.
        pixel: PixelIndex,
        /// The kind.
        kind: PixelKind,
    },
}
