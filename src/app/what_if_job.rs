//! Questions about a pixel: why the pixel has its region, and which change of a parameter would give it another region.

use crate::analysis::WhatIf;
use crate::raster::PixelIndex;
use std::sync::Arc;

/// The search for parameters that would give a pixel another region. The search repeats the analysis.
#[derive(Clone, Debug)]
pub struct WhatIfJob {
    /// The pixel and the result that the job is about.
    pub request: WhatIfRequest,
    /// Analyses made so far.
    pub done: usize,
    /// Analyses that are to be made.
    pub total: usize,
    /// The changes found; none until the job has ended.
    pub found: Option<Arc<Vec<WhatIf>>>,
}

/// The pixel and the result that a what-if job is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WhatIfRequest {
    /// The pixel in question.
    pub pixel: PixelIndex,
    /// Number of the result.
    pub generation: u64,
}

impl WhatIfJob {
    /// A job that has not begun.
    pub(super) fn new(request: WhatIfRequest) -> Self {
        Self { request, done: 0, total: 0, found: None }
    }
}

/// The progress of a what-if job.
#[derive(Clone, Debug)]
pub enum WhatIfProgress {
    /// Analyses made so far, and in all.
    Progress(usize, usize),
    /// The job ended and found these changes.
    Found(Vec<WhatIf>),
    /// The job was stopped.
    Stopped,
}

/// A question about a pixel.
#[derive(Clone, Copy, Debug)]
pub enum Question {
    /// Which decisions gave this pixel its region?
    Why(PixelIndex),
    /// How far must each parameter change for this pixel to get another region? None: stop the search.
    WhatIf(Option<PixelIndex>),
}
