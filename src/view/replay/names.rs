//! Region and color of each hypothesis of a trace, by what became of the hypothesis.

use crate::raster::{HypothesisId, RegionId};
use crate::trace::{End, Replay};

/// Color of a hypothesis that a trace does not hold, sRGB.
const UNKNOWN_COLOR: [u8; 3] = [128; 3];

/// The region that each hypothesis became part of, and a color for each hypothesis; lists by [`HypothesisId::index`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RegionNames {
    regions: Vec<Option<RegionId>>,
    colors: Vec<[u8; 3]>,
}

impl RegionNames {
    /// The names, from a cursor at the end of its trace; `colors` are the colors of the regions, sRGB.
    pub fn new(end_of_trace: &Replay, colors: &[[u8; 3]]) -> Self {
        let count = end_of_trace.hypotheses().len();
        let regions: Vec<Option<RegionId>> =
            HypothesisId::all(count).map(|id| region_at_end(end_of_trace, id)).collect();
        let mut dropped_colors = super::super::colors::colors_of_dropped(colors, count).into_iter();
        let color = |&region: &Option<RegionId>| {
            let kept = region.and_then(|region| colors.get(region.index())).copied();
            kept.or_else(|| dropped_colors.next()).unwrap_or(UNKNOWN_COLOR)
        };
        let colors = regions.iter().map(color).collect();
        Self { regions, colors }
    }

    /// The region that a hypothesis became part of; none where nothing is left of the hypothesis.
    pub fn region_of(&self, hypothesis: HypothesisId) -> Option<RegionId> {
        self.regions.get(hypothesis.index()).copied().flatten()
    }

    /// The color of a hypothesis, sRGB: the color of the region that the hypothesis became part of, where there is one.
    pub fn color(&self, hypothesis: HypothesisId) -> [u8; 3] {
        self.colors.get(hypothesis.index()).copied().unwrap_or(UNKNOWN_COLOR)
    }

    /// The hypotheses that became part of a region, in the order in which hypotheses were made.
    pub fn hypotheses_of(&self, region: RegionId) -> impl Iterator<Item = HypothesisId> + '_ {
        let all = HypothesisId::all(self.regions.len()).zip(&self.regions);
        all.filter(move |&(_, &found)| found == Some(region)).map(|(id, _)| id)
    }
}

/// The region of a hypothesis, or of the hypothesis that it became part of.
fn region_at_end(end_of_trace: &Replay, hypothesis: HypothesisId) -> Option<RegionId> {
    let mut current = hypothesis;
    // A hypothesis becomes part of one that is active at that time: a chain of these has no circle, and no more members than
    // there are hypotheses.
    for _ in 0..=end_of_trace.hypotheses().len() {
        if let Some(region) = end_of_trace.region_of(current) {
            return Some(region);
        }
        match end_of_trace.hypothesis(current).and_then(crate::trace::Hypothesis::end) {
            Some(End::Merged(into) | End::Absorbed(into)) => current = into,
            _ => return None,
        }
    }
    None
}
