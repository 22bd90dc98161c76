//! The work in the background that the panels show.

use crate::analysis::Stage;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// The work that is under way.
#[derive(Clone, Copy, Debug, Default)]
pub struct JobState {
    /// The analysis under way.
    pub analysis: Option<Job>,
    /// The recording of the decisions of the newest result, which is complete.
    pub recording: Option<Job>,
    /// The reading of a photograph, of parameters or of a workspace.
    pub reading: Option<Job>,
    /// The export under way.
    pub export: Option<Job>,
    /// Whether the export under way was canceled: it ends at its next stop check.
    pub cancels_export: bool,
    /// The id of the notice that says why the last export failed; none where that was written or stopped.
    pub failed_export: Option<u64>,
}

/// One piece of work.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// The time at which the work began.
    pub since: Instant,
    /// Of an analysis or a recording: the stage under way.
    pub stage: Option<Stage>,
    /// Of an export: files written so far, and files in all.
    pub files: Option<(usize, usize)>,
}

impl Job {
    /// Work that begins now.
    pub(super) fn now() -> Self {
        Self { since: Instant::now(), stage: None, files: None }
    }
}

/// A flag that asks a worker to stop.
#[derive(Debug, Default)]
pub(super) struct Stop(AtomicBool);

impl Stop {
    pub(super) fn stop(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub(super) fn stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
