//! The reducer of questions about a pixel, and of the progress of what-if jobs.

use crate::app::{Effect, Question, State, WhatIfJob, WhatIfProgress, WhatIfRequest};
use crate::raster::PixelIndex;
use std::sync::Arc;

/// Takes up a question.
pub(super) fn reduce(state: &mut State, question: Question) -> Vec<Effect> {
    match question {
        Question::Why(pixel) => {
            state.explained_pixel = Some(pixel).filter(|&pixel| is_inside(state, pixel));
            Vec::new()
        }
        Question::WhatIf(pixel) => start_what_if(state, pixel),
    }
}

/// Whether the open photograph has the pixel.
fn is_inside(state: &State, pixel: PixelIndex) -> bool {
    state.picture.as_ref().is_some_and(|picture| pixel.index() < picture.photo.image.pixels.len())
}

/// Stops the job under way, and starts a job for `pixel` where a pixel is given.
fn start_what_if(state: &mut State, pixel: Option<PixelIndex>) -> Vec<Effect> {
    let request = pixel
        .filter(|&pixel| is_inside(state, pixel))
        .map(|pixel| WhatIfRequest { pixel, generation: state.generation });
    state.what_if_job = request.map(WhatIfJob::new);
    [Effect::StopWhatIf].into_iter().chain(request.map(Effect::FindWhatIf)).collect()
}

/// Applies the progress of a job, unless another job has been started since.
pub(super) fn take_progress(state: &mut State, request: WhatIfRequest, progress: WhatIfProgress) {
    let Some(job) = state.what_if_job.as_mut().filter(|job| job.request == request) else { return };
    match progress {
        WhatIfProgress::Progress(done, total) => (job.done, job.total) = (done, total),
        WhatIfProgress::Found(found) => job.found = Some(Arc::new(found)),
        // The command that stopped the job has changed the state already.
        WhatIfProgress::Stopped => {}
    }
}
