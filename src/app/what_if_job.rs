//! Questions: why a pixel is what it is, and what if: the analysis asked again and again with other parameters.

use super::{Effect, State};
use crate::analysis::WhatIf;
use std::sync::Arc;

/// How far parameters would have to move for a pixel to end otherwise.
#[derive(Clone, Debug)]
pub struct WhatIfJob {
    /// What was asked.
    pub asked: Asked,
    /// Analyses made, and in all.
    pub done: usize,
    /// Analyses that are to be made.
    pub total: usize,
    /// The answers; none until all are there.
    pub found: Option<Arc<Vec<WhatIf>>>,
}

/// A question.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// The pixel, row-major.
    pub pixel: u32,
    /// The result that it was asked of.
    pub generation: u64,
}

impl WhatIfJob {
    /// A question that nothing has been done for.
    pub(super) fn new(asked: Asked) -> Self {
        Self { asked, done: 0, total: 0, found: None }
    }
}

/// News of an inquiry.
#[derive(Clone, Debug)]
pub enum WhatIfProgress {
    /// It goes on: analyses made, of how many.
    Progress(usize, usize),
    /// It has ended.
    Found(Vec<WhatIf>),
    /// It was stopped.
    Stopped,
}

/// A question, or news of one.
#[derive(Clone, Debug)]
pub enum Ask {
    /// Why is this pixel what it is?
    Why(u32),
    /// How far would each parameter have to move for this pixel to end otherwise? None: stop asking.
    WhatIf(Option<u32>),
    /// The analysis has something to say to that.
    News(Asked, WhatIfProgress),
}

/// Asks, and hears the answers.
pub(super) fn reduce(state: &mut State, ask: Ask) -> Vec<Effect> {
    match ask {
        Ask::Why(pixel) => {
            state.asked_pixel = Some(pixel).filter(|&pixel| is_inside(state, pixel));
            Vec::new()
        }
        Ask::WhatIf(pixel) => ask_what_if(state, pixel),
        Ask::News(asked, news) => {
            hear(state, asked, news);
            Vec::new()
        }
    }
}

fn is_inside(state: &State, pixel: u32) -> bool {
    state.picture.as_ref().is_some_and(|picture| (pixel as usize) < picture.photo.image.pixels.len())
}

/// Asks anew, or stops asking.
fn ask_what_if(state: &mut State, pixel: Option<u32>) -> Vec<Effect> {
    let asked = pixel
        .filter(|&pixel| is_inside(state, pixel))
        .map(|pixel| Asked { pixel, generation: state.generation });
    state.what_if_job = asked.map(WhatIfJob::new);
    [Effect::StopInquiring].into_iter().chain(asked.map(Effect::Inquire)).collect()
}

/// News of an inquiry, unless something else has been asked since.
fn hear(state: &mut State, asked: Asked, news: WhatIfProgress) {
    let Some(what_if_job) = state.what_if_job.as_mut().filter(|what_if_job| what_if_job.asked == asked)
    else {
        return;
    };
    match news {
        WhatIfProgress::Progress(done, total) => (what_if_job.done, what_if_job.total) = (done, total),
        WhatIfProgress::Found(found) => what_if_job.found = Some(Arc::new(found)),
        // Who stopped it, has asked for something else or for nothing.
        WhatIfProgress::Stopped => {}
    }
}
