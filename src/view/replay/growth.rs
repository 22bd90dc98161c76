//! The growth at the cursor: the pixels that a hypothesis has taken so far, the pixels around these, and the rings of the growth:
//! the pixels that were reached in one step.

use super::rings::Rings;
use crate::raster::HypothesisId;
use crate::trace::{Block, Replay, Step, Topic};

/// Pixels of the hypothesis that grows at the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Growth {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Pixels that the hypothesis has claimed since its block began and still has, in the order of the claims.
    pub claimed: Vec<u32>,
    /// 4-neighbors of these pixels that the hypothesis does not have: refused, or not reached yet. Ascending.
    pub around: Vec<u32>,
}

/// The growth in which the cursor stands; none where the step taken last belongs to no growth.
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
    let mut visited = vec![false; labels.len()];
    let mut claimed = Vec::new();
    for (_, step) in replay.trace().steps_in(block.steps.start..replay.at()) {
        if let Step::Claim { pixel, after, .. } = step
            && after == Some(hypothesis)
            && labels[pixel.index()] == hypothesis.get()
            && !std::mem::replace(&mut visited[pixel.index()], true)
        {
            claimed.push(pixel.get());
        }
    }
    let mut around = Vec::new();
    for &pixel in &claimed {
        labels.for_each_neighbor(pixel as usize, |near| {
            if labels[near] != hypothesis.get() && !std::mem::replace(&mut visited[near], true) {
                around.push(near as u32);
            }
        });
    }
    around.sort_unstable();
    Some(Growth { hypothesis, claimed, around })
}

/// Ends of the rings of a block's growth, ascending: after each the pixels that were reached in one more step of growth have
/// joined. Events and the end of the block are ends too. The cursor returns to its place.
pub fn rings(replay: &mut Replay, block: &Block) -> Vec<usize> {
    let at = replay.at();
    replay.seek(block.steps.start);
    let rings = Rings::of(replay.trace(), replay.labels(), block.steps.clone(), block.topic.hypothesis());
    replay.seek(at);
    let mut ends = rings.starts;
    ends.retain(|&end| end > block.steps.start);
    ends.push(block.steps.end);
    ends.dedup();
    ends
}

/// The pixels that the newest ring of a growth took and that the hypothesis still has, in the order of the claims; `from` is the
/// first step of the growth's block.
pub fn newest_ring(replay: &Replay, from: usize, hypothesis: HypothesisId) -> Vec<u32> {
    let labels = replay.labels();
    let mut newest = Rings::of(replay.trace(), labels, from..replay.at(), hypothesis).newest;
    newest.retain(|&pixel| labels[pixel as usize] == hypothesis.get());
    newest
}
