//! Decisions as data: what was decided, about what, on which numbers.
//!
//! The stages tell a [`Recorder`] what they decide. [`NoopRecorder`] listens to nothing at no cost; [`TraceRecorder`] keeps everything, a
//! [`StageTrace`] a stage. A [`Trace`] is all reels in order; a [`Replay`] is a cursor in it that goes forward and back and shows
//! what stood at that instant.

mod ambient;
mod branches;
mod event;
mod history;
mod kind;
mod light;
mod lineage;
mod local;
mod recorder;
mod replay;
mod replay_state;
mod stage_trace;
mod step;
mod terms;
mod timeline;
mod vectors;

pub use crate::params::Stage;
pub use ambient::{Ambient, AmbientVerdict, Meeting};
pub use branches::{BranchesSought, HighlightCore};
pub use event::{
    CandidateChosen, CandidateSource, CandidateTest, CandidateVerdict, Contribution, Event, HypothesisChosen,
    IlluminantEstimated, LineRefitted, MasksMade, Pass, PassedOver, SliceMade, WindowsLaid,
};
pub use history::{
    Barrier, HistoryEntry, HistoryKind, LocalFate, LocalStory, MaskVerdict, MergeRefusal, MergeStory, Reach,
    Release, SplitStory, Unfit, WindowStory, pixel_history,
};
pub use kind::Kind;
pub use light::{LightBasis, LightChosen, LightLimits, TwoLightTest, VoteResult, VotesCast};
pub use lineage::{Ancestor, Birth, HypothesisStory, Joined, JoinedHow, final_numbers, lineage, story};
pub use local::{
    BlobJudged, LocalBegan, LocalDecision, LocalLimits, LocalPoint, LocalPoints, LocalRecord, LocalStart,
    PlausibilityLimits, PlausibilityTested, RejectReason, RepairTried, RepairVerdict,
};
pub use recorder::{NoopRecorder, Recorder, TraceRecorder};
pub use replay::Replay;
pub use replay_state::{End, Grid, Hypothesis};
pub use stage_trace::{StageTrace, Steps};
pub use step::{Contest, Measure, Step};
pub use terms::{Class, PixelKind};
pub use timeline::{Block, PassSpan, Topic, Trace};
pub use vectors::{FitLimits, VectorsFitted};
