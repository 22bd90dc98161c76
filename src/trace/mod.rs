//! Decisions as data: what was decided, about what, on which numbers.
//!
//! The stages tell a [`Recorder`] what they decide; [`Silent`] listens to nothing at no cost, [`Log`] keeps everything and
//! can be replayed from zero to the analysis's result.

mod event;
mod recorder;

pub use event::{CandidateSource, CandidateVerdict, Class, Event, PassedOver, PixelKind, Stage, Triple};
pub use recorder::{Entry, Log, Recorder, Replayed, Silent};
