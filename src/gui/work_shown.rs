//! When work in the background is shown: not before it has taken a moment, so that nothing flickers.

use crate::app::Job;
use std::time::Duration;

/// Time after which running work is shown with a spinner and a progress bar.
pub const PROGRESS_DELAY: Duration = Duration::from_millis(150);

/// Whether work is under way that has taken long enough to be shown.
pub fn is_work_shown(job: Option<&Job>) -> bool {
    job.is_some_and(|job| job.since.elapsed() >= PROGRESS_DELAY)
}
