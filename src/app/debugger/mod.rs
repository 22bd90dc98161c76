//! The step debugger without a screen: a cursor in the trace of the newest result, its moves, and the breakpoints.

mod anchor;
mod breakpoint;
mod cursor;
#[cfg(test)]
mod instant_tests;
mod missed;
mod moves;
#[cfg(test)]
mod tests;

pub use breakpoint::{Breakpoint, CandidateCheck, Condition, SavedClass};
pub use cursor::{Direction, Goal, StepUnit};
pub use missed::Missed;

use anchor::{Anchor, best_overlaps};

use crate::raster::HypothesisId;
use crate::segment::FinalRegions;
use crate::trace::{Replay, Step, Subject, Trace};
use crate::view::RegionNames;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::Arc;

/// The state of the debugger while it is open.
#[derive(Clone, Debug, Default)]
pub struct Debugger {
    /// The cursor; none until the trace has been recorded.
    pub replay: Option<Replay>,
    /// Names and colors of the trace's regions.
    pub names: Arc<RegionNames>,
    /// Number of the result whose trace is replayed.
    pub generation: u64,
    /// The hypothesis that was chosen in a table.
    pub chosen: Option<HypothesisId>,
    /// The direction in which the cursor plays; none: the cursor does not play.
    pub playing: Option<Direction>,
    /// The breakpoint that stopped the cursor last: its index in [`DebugSettings::breakpoints`].
    pub stopped_by: Option<usize>,
    /// What the last move of the cursor did not find; none where the move ended where it was to end.
    pub missed: Option<Missed>,
    /// Number of moves of the cursor so far: the same answer to two moves is two answers.
    pub moves: u64,
    /// The first step at which the trace differs from the pinned result's trace, once the two were compared.
    pub difference: Option<Difference>,
    /// The regions of the result whose trace is replayed.
    pub(super) finals: Option<Arc<FinalRegions>>,
    /// The step at which playing ends; none: the end of the trace.
    pub(super) play_until: Option<usize>,
    /// The fraction of a unit that playing has accumulated, 0…1.
    pub(super) unit_fraction: f64,
    /// The steps of one block, and the ends of its rings: a cache.
    pub(super) rings: Option<(Range<usize>, Arc<[usize]>)>,
}

/// The first difference between two traces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// The traces are the same.
    None,
    /// The first step that differs.
    At(usize),
    /// The pinned result has no trace.
    NotRecorded,
}

impl Debugger {
    /// The trace, once it has been recorded.
    pub fn trace(&self) -> Option<&Arc<Trace>> {
        self.replay.as_ref().map(Replay::trace)
    }

    /// The cursor, if it stands before the end of the trace; panels then show that instant in place of the result.
    pub fn stopped(&self) -> Option<&Replay> {
        self.replay.as_ref().filter(|replay| replay.at() < replay.trace().len())
    }

    /// The place in another trace that corresponds to the cursor's; none where the cursor stands at the end of its trace.
    /// `names` and `finals` belong to the other trace.
    pub(super) fn corresponding_place(
        &self,
        trace: &Trace,
        names: &RegionNames,
        finals: &FinalRegions,
    ) -> Option<usize> {
        let anchor = Anchor::of(self.stopped()?, &self.names)?;
        let before = self.finals.as_ref();
        let overlaps = before.map_or_else(Vec::new, |old| best_overlaps(&old.labels, &finals.labels));
        Some(anchor.find(trace, names, &overlaps))
    }

    /// The hypothesis of the step taken last; the chosen hypothesis where that step concerns none.
    pub fn focus(&self) -> Option<HypothesisId> {
        let replay = self.replay.as_ref()?;
        let of_step = |last| {
            let block = replay.trace().block_at(last);
            block.map_or_else(|| self.subject_of(replay, last), |block| Some(block.topic.hypothesis()))
        };
        replay.at().checked_sub(1).and_then(of_step).or(self.chosen)
    }

    /// The hypothesis that a step outside of all blocks is about, or that became the region that the step is about.
    fn subject_of(&self, replay: &Replay, step: usize) -> Option<HypothesisId> {
        let event = match replay.trace().step(step)? {
            Step::Event(event) => event,
            Step::Label { pixel, .. } => {
                let label = replay.labels().as_slice().get(pixel.index());
                return label.copied().and_then(HypothesisId::from_label);
            }
            Step::Claim { .. } | Step::Refusal { .. } => return None,
        };
        event.subjects().into_iter().flatten().find_map(|subject| match subject {
            Subject::Hypothesis(hypothesis) => Some(hypothesis),
            Subject::Region(region) => {
                let became = |&id: &HypothesisId| replay.region_of(id) == Some(region);
                self.names.hypotheses_of(region).find(became)
            }
            Subject::Blob(_) => None,
        })
    }
}

/// The settings of the debugger, which are saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DebugSettings {
    /// Whether decisions are recorded.
    pub open: bool,
    /// The breakpoints.
    pub breakpoints: Vec<Breakpoint>,
    /// The unit by which playing advances.
    #[serde(rename = "grain")]
    pub unit: StepUnit,
    /// Speed of playing, units per second.
    pub per_second: f64,
    /// Whether playing starts again from the beginning at the end.
    pub looped: bool,
    /// Whether image, color space and tables show the instant at the cursor.
    pub follow: bool,
}

impl Default for DebugSettings {
    fn default() -> Self {
        Self {
            open: true,
            breakpoints: Vec::new(),
            unit: StepUnit::Ring,
            per_second: 30.0,
            looped: false,
            follow: true,
        }
    }
}

/// A command of the debugger.
#[derive(Clone, Debug)]
pub enum DebugCommand {
    /// Set the settings.
    Settings(DebugSettings),
    /// Move the cursor behind this many steps.
    Seek(usize),
    /// Move by one unit.
    Step(StepUnit, Direction),
    /// Move into the next block and play it ring by ring.
    Into,
    /// Move to the next step that fits a goal; to the end of the trace where none does.
    RunTo(Goal, Direction),
    /// Play in a direction; none: stop playing.
    Play(Option<Direction>),
    /// Advance playing by this time, seconds.
    Tick(f64),
    /// Choose a hypothesis.
    Choose(Option<HypothesisId>),
    /// Find the first difference from the pinned result's trace, and move there.
    Compare,
}
