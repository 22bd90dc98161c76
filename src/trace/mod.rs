//! Decisions as data: what was decided, about what, on which numbers.
//!
//! The stages hand their decisions to a [`Recorder`]. [`NoopRecorder`] keeps nothing at no cost; [`TraceRecorder`] keeps every
//! decision of a stage in a [`StageTrace`]. A [`Trace`] holds the stage traces in order. A [`Replay`] is a cursor in a trace: it
//! moves forward and back and shows the state of the analysis at each step.

mod blocks;
mod events;
mod history;
mod lineage;
mod local;
mod measured;
mod recorder;
mod replay;
mod replay_state;
mod second_look;
mod stage_trace;
mod step;
mod step_subjects;
mod terms;
mod timeline;

pub use crate::params::Stage;
pub use blocks::{Block, PassSpan, Topic};
#[cfg(test)]
pub(crate) use events::all_events;
pub(crate) use events::dispatch_event;
pub use events::*;
pub use history::{
    Barrier, BorderLimit, HistoryEntry, HistoryKind, LocalFate, LocalStory, MaskVerdict, MergeRefusal,
    MergeStory, Reach, Release, SplitStory, Unfit, WindowStory, pixel_history,
};
pub use lineage::{
    Ancestor, Birth, HypothesisStory, Joined, JoinedHow, lineage, region_of, regions_of, story,
};
pub use local::{LocalFigures, LocalPoint, LocalPoints, LocalRecord, RestoredBand};
pub use measured::Measured;
pub use recorder::{NoopRecorder, Recorder, TraceRecorder};
pub use replay::Replay;
pub use replay_state::{End, Grid, Hypothesis};
pub use stage_trace::{StageTrace, Steps};
pub use step::{Contest, Measure, Step};
pub use terms::{Class, PixelKind};
pub use timeline::{SecondLookRecord, Trace};
