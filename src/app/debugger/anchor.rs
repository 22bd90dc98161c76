//! The corresponding place in another trace, to which the cursor moves when a parameter has changed.

use crate::raster::{HypothesisId, LabelMap, RegionId};
use crate::trace::{Block, Event, Kind, Replay, Stage, Topic, Trace};
use crate::view::RegionNames;
use std::mem::discriminant;

/// A cursor's place in terms that have a meaning in another trace.
#[derive(Clone, Debug, PartialEq)]
pub struct Anchor {
    stage: Stage,
    /// Place within the stage, 0…1; used where nothing else corresponds.
    share: f64,
    block: Option<BlockAnchor>,
}

#[derive(Clone, Debug, PartialEq)]
struct BlockAnchor {
    topic: Topic,
    /// The region that the hypothesis became part of; none: nothing is left of the hypothesis.
    region: Option<RegionId>,
    /// The area that the hypothesis started from.
    area: Option<u32>,
    /// Number of earlier blocks about the same region.
    earlier_blocks: usize,
    /// Place within the block, 0…1.
    share: f64,
    /// The decision at the cursor: its kind, and the number of that kind earlier in the block.
    decision: Option<(Kind, usize)>,
}

impl Anchor {
    /// The anchor of a cursor.
    pub fn of(replay: &Replay, names: &RegionNames) -> Option<Self> {
        let (trace, last) = (replay.trace(), replay.at().checked_sub(1)?);
        let stage = trace.stage_at(last)?;
        let share =
            |steps: &std::ops::Range<usize>| (last + 1 - steps.start) as f64 / steps.len().max(1) as f64;
        let block = trace.block_at(last).map(|block| {
            let hypothesis = block.topic.hypothesis();
            let earlier_blocks =
                trace.blocks().filter(|b| b.topic == block.topic && b.steps.start < block.steps.start);
            BlockAnchor {
                topic: block.topic,
                region: names.region_of(hypothesis),
                area: replay.hypothesis(hypothesis).and_then(|hypothesis| hypothesis.area),
                earlier_blocks: earlier_blocks.count(),
                share: share(&block.steps),
                decision: trace.event(last).map(|event| {
                    (event.kind(), events_of(trace, block.steps.start..last, event.kind()).count())
                }),
            }
        });
        Some(Self { stage, share: share(&trace.steps_of(stage)), block })
    }

    /// The corresponding number of steps in another trace. `best_overlaps` gives for each label of the first result the region of
    /// the other that covers most of its pixels.
    pub fn find(&self, trace: &Trace, names: &RegionNames, best_overlaps: &[Option<RegionId>]) -> usize {
        let steps = trace.steps_of(self.stage);
        let found = self.block.as_ref().and_then(|block| block.find(trace, names, best_overlaps));
        found.unwrap_or_else(|| steps.start + (self.share * steps.len() as f64).round() as usize)
    }
}

impl BlockAnchor {
    fn find(&self, trace: &Trace, names: &RegionNames, best_overlaps: &[Option<RegionId>]) -> Option<usize> {
        let blocks = |hypothesis: HypothesisId| {
            let is_same_kind = |block: &Block| discriminant(&block.topic) == discriminant(&self.topic);
            trace.blocks().filter(move |block| is_same_kind(block) && block.topic.hypothesis() == hypothesis)
        };
        // None where the hypothesis became no region.
        let best_overlap =
            self.region.and_then(|region| best_overlaps.get(usize::from(region.get())).copied());
        // The hypothesis from the same area, if it became the same region; otherwise any that did.
        let from_area = self.area.and_then(|area| hypothesis_from_area(trace, area));
        let from_area = from_area
            .filter(|&id| best_overlap.is_none_or(|best_overlap| names.region_of(id) == best_overlap));
        let hypothesis = from_area.filter(|&id| blocks(id).next().is_some()).or_else(|| {
            names.hypotheses_of(best_overlap.flatten()?).find(|&id| blocks(id).next().is_some())
        })?;
        let block = blocks(hypothesis).nth(self.earlier_blocks).or_else(|| blocks(hypothesis).next_back())?;
        Some(self.place_in(trace, &block))
    }

    /// The number of steps at the corresponding place of a block.
    fn place_in(&self, trace: &Trace, block: &Block) -> usize {
        let decision = self.decision.and_then(|(kind, before)| {
            let is_same_kind = events_of(trace, block.steps.clone(), kind);
            is_same_kind.take(before + 1).last().map(|n| n + 1)
        });
        decision.unwrap_or_else(|| {
            let steps_within = (self.share * block.steps.len() as f64).round() as usize;
            block.steps.start + steps_within.clamp(1, block.steps.len().max(1))
        })
    }
}

/// The hypothesis that started from an area of the picture's own grid.
fn hypothesis_from_area(trace: &Trace, area: u32) -> Option<HypothesisId> {
    trace.events().find_map(|(_, event)| match event {
        Event::HypothesisChosen(chosen) if chosen.area == area => Some(chosen.hypothesis),
        _ => None,
    })
}

/// The steps in a range that are events of a kind.
fn events_of(trace: &Trace, steps: std::ops::Range<usize>, kind: Kind) -> impl Iterator<Item = usize> + '_ {
    trace.events().filter(move |(n, event)| steps.contains(n) && event.kind() == kind).map(|(n, _)| n)
}

/// For each label of the earlier result the region of the later result that covers most of its pixels.
pub fn best_overlaps(before: &LabelMap, after: &LabelMap) -> Vec<Option<RegionId>> {
    if (before.width(), before.height()) != (after.width(), after.height()) {
        return Vec::new();
    }
    crate::view::best_overlaps(before, after)
}
