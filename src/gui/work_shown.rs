//! When work in the background is shown: not before it has taken a moment, so that nothing flickers.

use crate::app::{Job, JobState};
use std::time::Duration;

/// Time after which running work is shown with a spinner and a progress bar.
pub const PROGRESS_DELAY: Duration = Duration::from_millis(150);

/// Time after which the recording of decisions is shown. The result is there already, and the recording follows each change of a slider.
pub const RECORDING_DELAY: Duration = Duration::from_millis(500);

/// Whether work is under way that has taken long enough to be shown.
pub fn is_work_shown(job: Option<&Job>) -> bool {
    job.is_some_and(|job| job.since.elapsed() >= PROGRESS_DELAY)
}

/// Whether an analysis or a recording is shown, which Escape cancels.
pub fn is_cancelable_work_shown(jobs: &JobState) -> bool {
    let is_recording_shown = |job: Job| job.since.elapsed() >= RECORDING_DELAY;
    is_work_shown(jobs.analysis.as_ref()) || jobs.recording.is_some_and(is_recording_shown)
}
