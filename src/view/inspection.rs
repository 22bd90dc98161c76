//! What the inspector shows about a step, a pixel, a region, a window, a color or marked pixels, as plain data: the verdict, each
//! measured value beside its limit, and the section.

mod candidate;
mod fits;
mod instant;
mod item;
mod step;
mod threshold;

pub use candidate::candidate_tests;
pub use instant::{inspect_beginning, inspect_item_at};
pub use item::{inspect_item, inspect_marked};
pub use step::{histograms_at_cursor, inspect_step, step_verdict};
pub use threshold::{Limits, ThresholdTest};

use crate::raster::RegionId;

/// Whether a verdict is good or bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// Taken, passed or explained.
    Good,
    /// Refused, failed or not explained.
    Bad,
    /// Neither: a number or a beginning.
    Neutral,
}

/// The findings about one thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// The thing, such as "Pixel 12, 7".
    pub subject: String,
    /// The verdict in one to four words.
    pub verdict: String,
    /// Whether the verdict is good or bad.
    pub tone: Tone,
    /// What the verdict means, as a sentence or a part of one.
    pub sentence: String,
    /// The values with their limits.
    pub tests: Vec<ThresholdTest>,
    /// Of a pixel whose region does not hold: the region, and its values with their limits.
    pub of_region: Option<(RegionId, Vec<ThresholdTest>)>,
    /// The section of the paper, such as "5.3.2".
    pub section: &'static str,
}
