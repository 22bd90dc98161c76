//! Questions about a pixel: why it is what it is, and which changes of a parameter would make it something else.

use super::{Effect, State};
use crate::analysis::WhatIf;
use crate::raster::PixelIndex;
use std::sync::Arc;

/// The search for parameters that would make a pixel something else, which repeats the analysis.
#[derive(Clone, Debug)]
pub struct WhatIfJob {
    /// The question.
    pub asked: Asked,
    /// Analyses made so far.
    pub done: usize,
    /// Analyses that are to be made.
    pub total: usize,
    /// The answers; none until the job has ended.
    pub found: Option<Arc<Vec<WhatIf>>>,
}

/// The question of one job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// The pixel.
    pub pixel: PixelIndex,
    /// Number of the result that the question is about.
    pub generation: u64,
}

impl WhatIfJob {
    /// A job that has not begun.
    pub(super) fn new(asked: Asked) -> Self {
        Self { asked, done: 0, total: 0, found: None }
    }
}

/// How far a what-if job is.
#[derive(Clone, Debug)]
pub enum WhatIfProgress {
    /// Analyses made so far, and in all.
    Progress(usize, usize),
    /// The job ended with these answers.
    Found(Vec<WhatIf>),
    /// The job was stopped.
    Stopped,
}

/// A question about a pixel.
#[derive(Clone, Copy, Debug)]
pub enum Ask {
    /// Why is this pixel what it is?
    Why(PixelIndex),
    /// How far must each parameter change for this pixel to become something else? None: stop the search.
    WhatIf(Option<PixelIndex>),
}

/// Asks a question.
pub(super) fn reduce(state: &mut State, ask: Ask) -> Vec<Effect> {
    match ask {
        Ask::Why(pixel) => {
            state.asked_pixel = Some(pixel).filter(|&pixel| is_inside(state, pixel));
            Vec::new()
        }
        Ask::WhatIf(pixel) => ask_what_if(state, pixel),
    }
}

fn is_inside(state: &State, pixel: PixelIndex) -> bool {
    state.picture.as_ref().is_some_and(|picture| pixel.index() < picture.photo.image.pixels.len())
}

/// Stops the job under way and starts another one, if one is asked for.
fn ask_what_if(state: &mut State, pixel: Option<PixelIndex>) -> Vec<Effect> {
    let asked = pixel
        .filter(|&pixel| is_inside(state, pixel))
        .map(|pixel| Asked { pixel, generation: state.generation });
    state.what_if_job = asked.map(WhatIfJob::new);
    [Effect::StopInquiring].into_iter().chain(asked.map(Effect::Inquire)).collect()
}

/// Takes in how far a job is, unless something else has been asked since.
pub(super) fn report(state: &mut State, asked: Asked, progress: WhatIfProgress) {
    let Some(what_if_job) = state.what_if_job.as_mut().filter(|what_if_job| what_if_job.asked == asked)
    else {
        return;
    };
    match progress {
        WhatIfProgress::Progress(done, total) => (what_if_job.done, what_if_job.total) = (done, total),
        WhatIfProgress::Found(found) => what_if_job.found = Some(Arc::new(found)),
        // Whoever stopped the job has set the state already.
        WhatIfProgress::Stopped => {}
    }
}
