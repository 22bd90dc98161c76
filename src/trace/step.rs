//! One entry of a trace: an event, or what happened to one pixel, and by what it was decided.

use super::{Event, PixelKind};
use crate::raster::{HypothesisId, PixelIndex};

/// Two regions wanted a pixel, or a region did not take one that lay in its reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contest {
    /// By what it was decided.
    pub measure: Measure,
    /// What the challenger had to show.
    pub challenger: f32,
    /// What it was held against.
    pub holder: f32,
}

/// By what a contest was decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// Distances of the color from both axes, counts: the nearer wins (5.3.2).
    Axis,
    /// Distances from both planes, counts: the nearer wins (5.4.2).
    Plane,
    /// The pixel is another region's matte pixel: its distance from the challenger's axis, against the radius (5.4.2).
    ForeignMatte,
    /// Pixels of the winner among its surroundings, against the pixels of all regions there.
    Vote,
}

/// One entry of a trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step<'a> {
    /// A decision with its numbers.
    Event(&'a Event),
    /// A pixel changed hands.
    Claim {
        /// The pixel.
        pixel: PixelIndex,
        /// The hypothesis that had the pixel; none: no hypothesis.
        before: Option<HypothesisId>,
        /// The hypothesis that has the pixel from now on; none: no hypothesis.
        after: Option<HypothesisId>,
        /// Why, where two regions wanted it.
        contest: Option<Contest>,
    },
    /// A pixel did not change hands.
    Refusal {
        /// The pixel.
        pixel: PixelIndex,
        /// The hypothesis that keeps the pixel.
        holder: HypothesisId,
        /// The hypothesis that wanted the pixel.
        challenger: HypothesisId,
        /// Why.
        contest: Contest,
    },
    /// A pixel's final role (section 6).
    Label {
        /// The pixel.
        pixel: PixelIndex,
        /// Its role.
        kind: PixelKind,
    },
}
