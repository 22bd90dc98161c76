//! The reports of workers. Only [`super::Application`] applies reports to the state.

use super::{WhatIfProgress, WhatIfRequest, Workspace};
use crate::analysis::Stage;
use crate::params::Params;
use crate::trace::Replay;
use crate::view::{Picture, ResultSnapshot};
use std::sync::Arc;

/// A report of a worker.
#[derive(Clone, Debug)]
pub(super) enum Report {
    /// A photograph was read.
    Opened(Arc<Picture>),
    /// A photograph could not be read: the sentence to show.
    OpenFailed(String),
    /// A parameter file was read.
    ParamsRead(Box<Params>),
    /// A workspace file was read; its photograph is still to be read.
    WorkspaceRead(Box<Workspace>),
    /// Work could not be done: the sentence to show.
    Failed(String),
    /// The analysis began a stage.
    Progress {
        /// Number of the request.
        generation: u64,
        /// The stage that begins.
        stage: Stage,
    },
    /// A result, or a part of one.
    Analyzed(Arc<ResultSnapshot>),
    /// The decisions of a result were recorded.
    Traced {
        /// Number of the result.
        generation: u64,
        /// A cursor at the end of the trace.
        replay: Box<Replay>,
    },
    /// An export has written some of its files.
    Exporting {
        /// Number of files written so far.
        done: usize,
        /// Number of all files.
        total: usize,
    },
    /// An export ended: the sentence to show.
    Exported(Result<String, String>),
    /// A what-if job made progress or ended.
    WhatIf(WhatIfRequest, WhatIfProgress),
}
