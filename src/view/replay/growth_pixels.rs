//! The pixels that the cursor is about: the pixels that a hypothesis has taken and not taken, and the clusters that are compared.

use super::growth::{growth, newest_ring};
use crate::color::Cylinder;
use crate::photo::Masks;
use crate::raster::{HypothesisId, Raster, UNASSIGNED};
use crate::reflection::Slice;
use crate::segment::is_of_candidate;
use crate::trace::{CandidateSource, CandidateTested, Event, Replay, Topic};

/// Pixels of the hypothesis that grows at the cursor, and the pixels around them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GrowthPixels {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Pixels that the hypothesis has claimed since its block began and still has, in the order of the claims.
    pub claimed: Vec<u32>,
    /// The pixels of them that the newest ring claimed.
    pub newest: Vec<u32>,
    /// 4-neighbors of these pixels whose colors lie outside the cylinder or slice. Ascending.
    pub outside: Vec<u32>,
    /// 4-neighbors that the hypothesis did not get although their colors lie inside: pixels of another hypothesis, dark or
    /// distorted pixels. Ascending.
    pub kept_out: Vec<u32>,
}

/// The colors that a growing hypothesis accepts.
enum Bounds {
    Cylinder(Cylinder),
    Slice(Slice),
}

impl Bounds {
    fn of(replay: &Replay, id: HypothesisId, topic: Topic) -> Option<Self> {
        match topic {
            Topic::Hypothesis(_) => {
                let hypothesis = replay.hypothesis(id)?;
                Some(Self::Cylinder(Cylinder::new(hypothesis.line()?, hypothesis.radius)))
            }
            Topic::Slice(_) => Some(Self::Slice(replay.slice(id)?.slice)),
            _ => None,
        }
    }

    fn contains(&self, color: [f32; 3]) -> bool {
        match self {
            Self::Cylinder(cylinder) => cylinder.contains(color),
            Self::Slice(slice) => slice.contains(color),
        }
    }
}

/// The growth in which the cursor stands; none where the step taken last belongs to none.
///
/// Neighbors in no hypothesis whose colors lie inside were not reached yet: they are left out.
pub fn growth_pixels(replay: &Replay, colors: &Raster<[f32; 3]>, masks: &Masks) -> Option<GrowthPixels> {
    let block = replay.trace().block_at(replay.at().checked_sub(1)?)?;
    let growth = growth(replay)?;
    let bounds = Bounds::of(replay, growth.hypothesis, block.topic);
    let mut grown = GrowthPixels {
        hypothesis: growth.hypothesis,
        claimed: growth.claimed,
        newest: Vec::new(),
        outside: Vec::new(),
        kept_out: Vec::new(),
    };
    for pixel in growth.around {
        let at = pixel as usize;
        let Some(bounds) = &bounds else { continue };
        if !masks.dark(at) && !bounds.contains(colors.as_slice()[at]) {
            grown.outside.push(pixel);
        } else if replay.labels()[at] != UNASSIGNED || masks.dark(at) || masks.distorted(at) {
            grown.kept_out.push(pixel);
        }
    }
    grown.newest = newest_ring(replay, block.steps.start, growth.hypothesis);
    Some(grown)
}

/// The highlight test at the cursor: the test made last, or the test that the chosen candidate had passed.
pub fn test_at_cursor(replay: &Replay) -> Option<&CandidateTested> {
    let last = replay.at().checked_sub(1)?;
    let trace = replay.trace();
    match trace.event(last)? {
        Event::CandidateTested(test) => Some(test),
        Event::CandidateChosen(chosen) => {
            let block = trace.block_at(last)?;
            (block.steps.start..last).rev().find_map(|n| match trace.event(n)? {
                Event::CandidateTested(test) if test.candidate == chosen.candidate => Some(&**test),
                _ => None,
            })
        }
        _ => None,
    }
}

/// The pixels of a tested highlight candidate; none of a candidate that was absorbed, as its object has them now.
pub fn candidate_pixels(replay: &Replay, test: &CandidateTested, masks: &Masks) -> Vec<u32> {
    let labels = replay.labels();
    match test.candidate {
        CandidateSource::Hypothesis(hypothesis) => pixels_of_region(replay, hypothesis),
        CandidateSource::Absorbed(_) => Vec::new(),
        CandidateSource::Marked => {
            let is_highlight = |&pixel: &usize| is_of_candidate(labels, masks, false, pixel);
            (0..labels.len()).filter(is_highlight).map(|pixel| pixel as u32).collect()
        }
        CandidateSource::Leftover(area) => {
            let Some(grid) = replay.first_grid() else { return Vec::new() };
            let (areas, width) = (grid.areas(), labels.width());
            let of_area = |pixel: usize| areas.get(grid.window_of(pixel, width)) == Some(&area);
            let of_candidate =
                |&pixel: &usize| of_area(pixel) && is_of_candidate(labels, masks, test.with_distorted, pixel);
            (0..labels.len()).filter(of_candidate).map(|pixel| pixel as u32).collect()
        }
    }
}

/// The pixels of a hypothesis at the cursor, ascending.
pub fn pixels_of_region(replay: &Replay, hypothesis: HypothesisId) -> Vec<u32> {
    let labels = replay.labels().as_slice();
    (0u32..).zip(labels).filter(|(_, label)| **label == hypothesis.get()).map(|(pixel, _)| pixel).collect()
}

/// Divides the pixels of a tested hypothesis: the pixels by which the length of the matte line is measured, and the pixels on the
/// inside of the line, where highlights grow, which are ignored (5.4.1, figure 9).
pub fn measured_and_ignored(
    test: &CandidateTested,
    pixels: &[u32],
    colors: &Raster<[f32; 3]>,
) -> (Vec<u32>, Vec<u32>) {
    let outer_side = test.matte.outer_side();
    pixels.iter().partition(|&&pixel| outer_side.contains(colors.as_slice()[pixel as usize]))
}

/// At most `most` of the pixels, evenly chosen.
pub fn sampled(pixels: &[u32], most: usize) -> impl Iterator<Item = u32> + '_ {
    let count = pixels.len().min(most);
    (0..count).map(move |i| pixels[i * pixels.len() / count])
}
