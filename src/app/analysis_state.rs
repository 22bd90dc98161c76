//! Whether the result that is shown is that of the present parameters, and what stays of an analysis that was given up.

use super::{Effect, Preview, State};
use crate::raster::Mask;
use crate::view::ResultSnapshot;
use std::sync::Arc;

impl State {
    /// Whether an analysis is under way whose result the panels will show.
    pub fn awaits_result(&self) -> bool {
        self.jobs.analysis.is_some() && !self.shows_pinned()
    }

    /// Whether the newest result is complete and belongs to the present parameters and area.
    pub fn is_current(&self) -> bool {
        self.newest.as_ref().filter(|newest| newest.stale_from.is_none()).is_some_and(|newest| {
            let is_asked_for = newest.params == self.document.params
                && is_same_area(newest.area.as_ref(), self.document.area.as_ref());
            newest.generation == self.generation || !self.is_analyzing() && is_asked_for
        })
    }

    /// Whether an analysis is under way.
    fn is_analyzing(&self) -> bool {
        let is_awaited = |preview: &Preview| preview.shown.generation >= self.generation;
        self.jobs.analysis.is_some() || self.preview.as_ref().is_some_and(is_awaited)
    }

    /// Whether the photograph has no result for the present parameters and area and none is being computed: the analysis was canceled,
    /// or ended by an error.
    pub fn lacks_result(&self) -> bool {
        self.picture.is_some() && !self.is_analyzing() && !self.is_current()
    }

    /// Whether the decisions that led to the newest result are not recorded and will not be: the analysis was canceled.
    pub fn lacks_trace(&self) -> bool {
        let is_expected = |newest: &Arc<ResultSnapshot>| {
            newest.generation == self.generation || newest.generation == self.debugger.generation
        };
        !self.is_analyzing() && !self.newest.as_ref().is_some_and(is_expected)
    }

    /// Whether the result that is shown belongs to other parameters or another area than the present ones, which are not being analyzed.
    pub fn shows_other_parameters(&self) -> bool {
        self.lacks_result() && self.newest.is_some() && !self.shows_pinned()
    }

    /// Ends the analysis without a result: the last complete one stays. Where there is none, what is shown stays: the result for the working
    /// picture.
    pub(super) fn give_up_analysis(&mut self) {
        (self.jobs.analysis, self.jobs.recording) = (None, None);
        // The request has no result, also where its parameters have one.
        self.generation += 1;
        self.keep_complete_result();
        let has_complete = self.newest.as_ref().is_some_and(|newest| newest.stale_from.is_none());
        self.preview = self.preview.take().filter(|_| !has_complete);
        self.give_up_pin();
    }

    /// Ends the recording of the decisions of the newest result, which stays; returns what stops the worker. Nothing without a recording.
    pub(super) fn give_up_recording(&mut self) -> Option<Effect> {
        self.jobs.recording.take()?;
        // A result that is not that of the last request is waiting for no record.
        self.generation += 1;
        Some(Effect::CancelAnalysis)
    }

    /// Takes the last complete result for the newest one, where some of the stages of that are still to be computed.
    pub(super) fn keep_complete_result(&mut self) {
        self.newest = self.last_complete.take().or(self.newest.take());
    }
}

/// Whether two areas are one and the same, or both the whole picture.
pub(super) fn is_same_area(one: Option<&Arc<Mask>>, other: Option<&Arc<Mask>>) -> bool {
    match (one, other) {
        (None, None) => true,
        (Some(one), Some(other)) => Arc::ptr_eq(one, other),
        _ => false,
    }
}
