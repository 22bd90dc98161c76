//! The growth that the cursor stands in: which pixels a region has taken so far, which around it it did not take, and in
//! which rings.

use crate::raster::{HypothesisId, LabelMap};
use crate::trace::{Block, Event, Replay, SeedsPlaced, Step, Topic};

/// Pixels of the region that the cursor is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Growth {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Pixels that it has claimed since its block began and still holds, in the order of the claims.
    pub claimed: Vec<u32>,
    /// Neighbors of its pixels that are not its: refused, or not asked yet. Ascending.
    pub around: Vec<u32>,
}

/// The growth in which the cursor stands; none where the step taken last belongs to no region's growth.
pub fn growth(replay: &Replay) -> Option<Growth> {
    let last = replay.at().checked_sub(1)?;
    let block = replay.trace().block_at(last)?;
    let hypothesis = match block.topic {
        Topic::Hypothesis(hypothesis)
        | Topic::Slice(hypothesis)
        | Topic::Brightness(hypothesis)
        | Topic::Hole(hypothesis) => hypothesis,
        Topic::Absorption(_) | Topic::Candidates(_) | Topic::Part(_) => return None,
    };
    let labels = replay.labels();
    let mut seen = vec![false; labels.len()];
    let mut claimed = Vec::new();
    for (_, step) in replay.trace().steps_in(block.steps.start..replay.at()) {
        if let Step::Claim { pixel, after, .. } = step
            && after == Some(hypothesis)
            && labels[pixel.index()] == hypothesis.get()
            && !std::mem::replace(&mut seen[pixel.index()], true)
        {
            claimed.push(pixel.get());
        }
    }
    let mut around = Vec::new();
    for &pixel in &claimed {
        labels.for_each_neighbor(pixel as usize, |near| {
            if labels[near] != hypothesis.get() && !std::mem::replace(&mut seen[near], true) {
                around.push(near as u32);
            }
        });
    }
    around.sort_unstable();
    Some(Growth { hypothesis, claimed, around })
}

/// Ends of the rings of a block's growth, ascending: after each the pixels that were reached in one step more have joined.
/// Events and the block's own end are ends too. The cursor comes back to where it was.
pub fn rings(replay: &mut Replay, block: &Block) -> Vec<usize> {
    let (at, hypothesis) = (replay.at(), block.topic.hypothesis());
    replay.seek(block.steps.start);
    let labels = replay.labels();
    let mut rings = Rings { ring_of: vec![0; labels.len()], ring: 1, seeds: 0, ends: Vec::new() };
    for (n, step) in replay.trace().steps_in(block.steps.clone()) {
        rings.take(n, &step, labels, hypothesis);
    }
    let mut ends = rings.ends;
    ends.retain(|&end| end > block.steps.start);
    ends.push(block.steps.end);
    ends.dedup();
    replay.seek(at);
    ends
}

struct Rings {
    /// Ring in which each pixel was claimed, from 1.
    ring_of: Vec<u32>,
    ring: u32,
    /// Claims to come that are seeds, all of one ring.
    seeds: u32,
    ends: Vec<usize>,
}

impl Rings {
    fn take(&mut self, n: usize, step: &Step, before: &LabelMap, hypothesis: HypothesisId) {
        match *step {
            Step::Event(event) => {
                if let Event::SeedsPlaced(SeedsPlaced { pixels, .. }) = event {
                    self.seeds = *pixels;
                }
                self.begin(n);
            }
            Step::Claim { pixel, after, .. } if after == Some(hypothesis) => {
                let pixel = pixel.index();
                let mut nearest = u32::MAX;
                before.for_each_neighbor(pixel, |near| match self.ring_of[near] {
                    0 if before[near] == hypothesis.get() => nearest = 0,
                    0 => {}
                    ring => nearest = nearest.min(ring),
                });
                if self.seeds > 0 {
                    self.seeds -= 1;
                } else if nearest == self.ring {
                    // Reached from a pixel of this very ring: a new one begins.
                    self.begin(n);
                }
                self.ring_of[pixel] = self.ring;
            }
            Step::Claim { pixel, .. } => self.ring_of[pixel.index()] = 0,
            Step::Refusal { .. } | Step::Label { .. } => {}
        }
    }

    fn begin(&mut self, n: usize) {
        if self.ends.last() != Some(&n) {
            self.ends.push(n);
            self.ring += 1;
        }
    }
}
