//! Decisions as data: what was decided, about what, on which numbers.
//!
//! The stages tell a [`Recorder`] what they decide. [`Silent`] listens to nothing at no cost; [`Tape`] keeps everything, a
//! [`Reel`] a stage. A [`Trace`] is all reels in order; a [`Replay`] is a cursor in it that goes forward and back and shows
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
mod reel;
mod replay;
mod standing;
mod step;
mod terms;
mod timeline;
mod vectors;

pub use ambient::{Ambient, AmbientVerdict, Meeting};
pub use branches::{BranchesSought, HighlightCore};
pub use event::{
    CandidateChosen, CandidateSource, CandidateTest, CandidateVerdict, Contribution, Event, HypothesisChosen,
    IlluminantEstimated, LineRefitted, MasksMade, Pass, PassedOver, SliceMade, WindowsLaid,
};
pub use history::{
    Barrier, Happening, LocalFate, LocalStory, MaskVerdict, MergeRefusal, MergeStory, Reach, Release,
    SplitStory, Unfit, What, WindowStory, pixel_history,
};
pub use kind::Kind;
pub use light::{Elected, LightBasis, LightChosen, LightLimits, Outshone, VotesCast};
pub use lineage::{Ancestor, Birth, HypothesisStory, Joined, JoinedHow, final_numbers, lineage, story};
pub use local::{
    BeliefLimits, BeliefTested, BlobJudged, Doubt, LocalBegan, LocalDecision, LocalLimits, LocalPoint,
    LocalPoints, LocalRecord, LocalStart, RepairTried, RepairVerdict,
};
pub use recorder::{Recorder, Silent, Tape};
pub use reel::{Reel, Steps};
pub use replay::Replay;
pub use standing::{End, Grid, Hypothesis};
pub use step::{Contest, Measure, Step};
pub use terms::{Class, PixelKind, Stage};
pub use timeline::{Block, PassSpan, Topic, Trace};
pub use vectors::{FitLimits, VectorsFitted};
