//! A result as the panels see it.

use super::Picture;
use crate::analysis::{Analysis, Stage};
use crate::raster::LabelMap;
use crate::segment::Params;
use std::sync::Arc;

/// What one request found. Shared, never changed.
#[derive(Debug)]
pub struct Shown {
    /// Number of the request; larger is newer.
    pub generation: u64,
    /// The photograph.
    pub picture: Arc<Picture>,
    /// What was asked.
    pub params: Params,
    /// What was found.
    pub analysis: Analysis,
    /// The first stage whose output is still an older request's; none: all is of this one.
    pub stale_from: Option<Stage>,
    /// Colours of the final regions, sRGB; region `id` at index `id − 1`. They stay with the objects while parameters move.
    pub region_colours: Vec<[u8; 3]>,
    /// Share of the pixels that are not dark which are in a region; 0 where all are dark.
    pub coverage: f64,
    /// Time of each stage that ran, in the order of [`Stage::ALL`], milliseconds; none: its earlier output still stood.
    pub took_ms: [Option<f64>; Stage::ALL.len()],
}

impl Shown {
    /// The final regions.
    pub fn labels(&self) -> &LabelMap {
        &self.analysis.finals.labels
    }

    /// Time of the stages that ran, milliseconds.
    pub fn total_ms(&self) -> f64 {
        self.took_ms.iter().flatten().sum()
    }
}

/// The region of `after` that covers most of `region`'s pixels in `before`; none where none covers any.
pub(super) fn heir(before: &LabelMap, after: &LabelMap, region: u16) -> Option<u16> {
    let mut counts: Vec<usize> = Vec::new();
    for (&old, &new) in before.as_slice().iter().zip(after.as_slice()) {
        if old == region && new != 0 {
            if counts.len() <= usize::from(new) {
                counts.resize(usize::from(new) + 1, 0);
            }
            counts[usize::from(new)] += 1;
        }
    }
    let best = (1..counts.len()).max_by_key(|&id| (counts[id], std::cmp::Reverse(id)))?;
    (counts[best] > 0).then_some(best as u16)
}
