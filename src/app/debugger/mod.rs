//! The step debugger without a screen: a cursor in the trace of the newest result, how it moves, what stops it, and what
//! there is to see where it stands.

mod anchor;
mod breakpoint;
mod cursor;
#[cfg(test)]
mod instant_tests;
mod reduce;
#[cfg(test)]
mod tests;

pub use breakpoint::{Breakpoint, CandidateCheck, Condition, SavedClass};
pub use cursor::{Direction, Goal, Grain};
pub(super) use reduce::{reduce, trace_arrived};

use crate::segment::FinalRegions;
use crate::trace::{Replay, Trace};
use crate::view::RegionNames;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::Arc;

/// The debugger, as long as it is open.
#[derive(Clone, Debug, Default)]
pub struct Debugger {
    /// The cursor; none until the trace is there.
    pub replay: Option<Replay>,
    /// What the regions of the trace are called and colored.
    pub names: Arc<RegionNames>,
    /// Number of the result whose trace it is.
    pub generation: u64,
    /// The region that was chosen in a table, by its number of birth.
    pub chosen: Option<u16>,
    /// Which way it plays; none: it rests.
    pub playing: Option<Direction>,
    /// What stopped it last: the breakpoint's index in [`DebugSettings::breakpoints`].
    pub stopped_by: Option<usize>,
    /// The first step at which the trace differs from the pinned result's, where that was asked for.
    pub difference: Option<Difference>,
    /// The regions of the result whose trace it is.
    pub(super) finals: Option<Arc<FinalRegions>>,
    /// Playing ends here.
    pub(super) until: Option<usize>,
    /// Units that are due but not whole yet.
    pub(super) due: f64,
    /// Ends of the rings of one block, as they were last needed.
    pub(super) rings: Option<(Range<usize>, Arc<[usize]>)>,
}

/// Where two traces part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// They do not.
    None,
    /// At this step.
    At(usize),
    /// The pinned result has no trace.
    NotRecorded,
}

impl Debugger {
    /// The trace, once it is there.
    pub fn trace(&self) -> Option<&Arc<Trace>> {
        self.replay.as_ref().map(Replay::trace)
    }

    /// The cursor, where it stands before the end: then panels show that instant, and not the result.
    pub fn stopped(&self) -> Option<&Replay> {
        self.replay.as_ref().filter(|replay| replay.at() < replay.trace().len())
    }

    /// The region that the step taken last is about, by its number of birth; the chosen one where it is about none.
    pub fn focus(&self) -> Option<u16> {
        let replay = self.replay.as_ref()?;
        let block = replay.at().checked_sub(1).and_then(|last| replay.trace().block_at(last));
        block.map(|block| block.topic.region()).or(self.chosen)
    }
}

/// What of the debugger is remembered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct DebugSettings {
    /// Whether decisions are recorded.
    pub open: bool,
    /// What stops the cursor.
    pub breakpoints: Vec<Breakpoint>,
    /// What playing advances by.
    pub grain: Grain,
    /// How many of these a second.
    pub per_second: f64,
    /// Whether playing begins anew at the end.
    pub looped: bool,
    /// Whether image and color space follow the cursor.
    pub follow: bool,
}

impl Default for DebugSettings {
    fn default() -> Self {
        Self {
            open: true,
            breakpoints: Vec::new(),
            grain: Grain::Ring,
            per_second: 30.0,
            looped: false,
            follow: true,
        }
    }
}

/// A change of the debugger.
#[derive(Clone, Debug)]
pub enum DebugCommand {
    /// Change what is remembered.
    Settings(DebugSettings),
    /// Go to after this many steps.
    Seek(usize),
    /// Go one such unit.
    Step(Grain, Direction),
    /// Go into the next block and play it ring by ring.
    Into,
    /// Go to where this happens next, or happened last; to the end of the trace where it does not.
    RunTo(Goal, Direction),
    /// Play, or rest.
    Play(Option<Direction>),
    /// So many seconds have passed.
    Tick(f64),
    /// Choose a region, by its number of birth.
    Choose(Option<u16>),
    /// Find where the trace parts from the pinned result's, and go there.
    Compare,
}
