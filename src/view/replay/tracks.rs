//! What the cursor is about, as pixels: what a region has just taken, what it left beside, which clusters are compared.

use super::growth;
use crate::color::Cylinder;
use crate::photo::Masks;
use crate::raster::{HypothesisId, LabelMap, Raster, UNASSIGNED};
use crate::reflection::Slice;
use crate::segment::is_leftover;
use crate::trace::{CandidateSource, CandidateTested, Event, Replay, Step, Topic};

/// Pixels of the region that grows at the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tracks {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Pixels that it has claimed since its block began and still holds, in the order of the claims.
    pub claimed: Vec<u32>,
    /// Those of them that were claimed in the ring at work.
    pub newest: Vec<u32>,
    /// Neighbors of it whose colors lie outside of what it may claim. Ascending.
    pub outside: Vec<u32>,
    /// Neighbors of it that it did not get although their colors lie inside: another region's, or not to be believed.
    /// Ascending.
    pub kept_out: Vec<u32>,
}

/// What bounds the growth of a region in the color cube.
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

    fn hold(&self, color: [f32; 3]) -> bool {
        match self {
            Self::Cylinder(cylinder) => cylinder.contains(color),
            Self::Slice(slice) => slice.contains(color),
        }
    }
}

/// The growth in which the cursor stands; none where the step taken last belongs to none.
///
/// Neighbors whose colors lie inside and that nobody has are not asked yet: they are left out.
pub fn tracks(replay: &Replay, colors: &Raster<[f32; 3]>, masks: &Masks) -> Option<Tracks> {
    let block = replay.trace().block_at(replay.at().checked_sub(1)?)?;
    let growth = growth(replay)?;
    let bounds = Bounds::of(replay, growth.hypothesis, block.topic);
    let mut tracks = Tracks {
        hypothesis: growth.hypothesis,
        claimed: growth.claimed,
        newest: Vec::new(),
        outside: Vec::new(),
        kept_out: Vec::new(),
    };
    for pixel in growth.around {
        let at = pixel as usize;
        let Some(bounds) = &bounds else { continue };
        if !masks.dark(at) && !bounds.hold(colors.as_slice()[at]) {
            tracks.outside.push(pixel);
        } else if replay.labels()[at] != UNASSIGNED || masks.dark(at) || masks.distorted(at) {
            tracks.kept_out.push(pixel);
        }
    }
    tracks.newest = newest_ring(replay, block.steps.start, growth.hypothesis);
    Some(tracks)
}

/// The pixels of the ring of a growth that is at work: those reached from none of the same ring.
fn newest_ring(replay: &Replay, from: usize, hypothesis: HypothesisId) -> Vec<u32> {
    let labels = replay.labels();
    let mut claims = Vec::new();
    for (_, step) in replay.trace().steps_in(from..replay.at()) {
        match step {
            Step::Event(Event::SeedsPlaced(_) | Event::GrowthBegan(_)) => claims.clear(),
            Step::Claim { pixel, after, .. } if after == Some(hypothesis) => claims.push(pixel.get()),
            _ => {}
        }
    }
    let seeds = matches!(
        replay.trace().steps_in(from..replay.at()).rev().find_map(|(_, step)| match step {
            Step::Event(event @ (Event::SeedsPlaced(_) | Event::GrowthBegan(_))) => Some(event),
            _ => None,
        }),
        Some(Event::SeedsPlaced(_))
    );
    let start = if seeds { 0 } else { start_of_ring(&claims, labels) };
    claims.drain(..start);
    claims.retain(|&pixel| labels[pixel as usize] == hypothesis.get());
    claims
}

/// Where among the claims of a growth its last ring begins: at a pixel all of whose neighbors so far are of one ring.
fn start_of_ring(claims: &[u32], labels: &LabelMap) -> usize {
    const EARLIER: u8 = 1;
    const CURRENT: u8 = 2;
    let mut seen = vec![0u8; labels.len()];
    let mut start = 0;
    for (index, &pixel) in claims.iter().enumerate() {
        let (mut earlier, mut current) = (false, false);
        labels.for_each_neighbor(pixel as usize, |near| {
            earlier |= seen[near] == EARLIER;
            current |= seen[near] == CURRENT;
        });
        if current && !earlier {
            for &before in &claims[start..index] {
                seen[before as usize] = EARLIER;
            }
            start = index;
        }
        seen[pixel as usize] = CURRENT;
    }
    start
}

/// The highlight test at the cursor: the one made last, or the one that the chosen candidate had passed.
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

/// The pixels of a highlight candidate; none of one that was absorbed, as its object has them now.
pub fn candidate_pixels(replay: &Replay, source: CandidateSource, masks: &Masks) -> Vec<u32> {
    let labels = replay.labels();
    match source {
        CandidateSource::Hypothesis(hypothesis) => pixels_of_region(replay, hypothesis),
        CandidateSource::Absorbed(_) => Vec::new(),
        CandidateSource::Leftover(area) => {
            let Some(grid) = replay.first_grid() else { return Vec::new() };
            let (areas, width) = (grid.areas(), labels.width());
            let of_area = |pixel: usize| areas.get(grid.window_of(pixel, width)) == Some(&area);
            let of_candidate = |&pixel: &usize| is_leftover(labels, masks, pixel) && of_area(pixel);
            (0..labels.len()).filter(of_candidate).map(|pixel| pixel as u32).collect()
        }
    }
}

/// The pixels of a hypothesis at the cursor, ascending.
pub fn pixels_of_region(replay: &Replay, hypothesis: HypothesisId) -> Vec<u32> {
    let labels = replay.labels().as_slice();
    (0u32..).zip(labels).filter(|(_, label)| **label == hypothesis.get()).map(|(pixel, _)| pixel).collect()
}

/// Splits a tested region's pixels: those by which the length of its matte line is measured, and those on the inside of
/// the line, where highlights grow, which are ignored for it (5.4.1, figure 9).
pub fn measured_and_ignored(
    test: &CandidateTested,
    pixels: &[u32],
    colors: &Raster<[f32; 3]>,
) -> (Vec<u32>, Vec<u32>) {
    let outer_side = test.matte.outer_side();
    pixels.iter().partition(|&&pixel| outer_side.contains(colors.as_slice()[pixel as usize]))
}

/// At most `most` of these, evenly chosen.
pub fn sampled(pixels: &[u32], most: usize) -> impl Iterator<Item = u32> + '_ {
    let count = pixels.len().min(most);
    (0..count).map(move |i| pixels[i * pixels.len() / count])
}
