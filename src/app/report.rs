//! What workers report. Only [`super::Application`] hands reports to the state.

use super::reduce::{analyzed, edit_params, notify, opened};
use super::what_if_job::{self, Asked, WhatIfProgress};
use super::{Effect, Severity, State, Workspace, debugger};
use crate::analysis::Stage;
use crate::params::Params;
use crate::trace::Replay;
use crate::view::{Picture, ResultSnapshot};
use std::sync::Arc;

/// What a worker reports.
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
        /// Files written so far.
        done: usize,
        /// Files in all.
        total: usize,
    },
    /// An export ended: the sentence to show.
    Exported(Result<String, String>),
    /// A what-if job went on or ended.
    WhatIf(Asked, WhatIfProgress),
}

/// Takes a report into the state.
pub(super) fn reduce(state: &mut State, report: Report) -> Vec<Effect> {
    match report {
        Report::Opened(picture) => return opened(state, picture),
        Report::OpenFailed(reason) => {
            (state.jobs.reading, state.restoring) = (None, None);
            notify(state, Severity::Error, reason);
        }
        Report::ParamsRead(params) => return edit_params(state, None, |old| *old = *params),
        Report::WorkspaceRead(workspace) => return restore(state, workspace),
        Report::Failed(reason) => notify(state, Severity::Error, reason),
        Report::Progress { generation, stage } => {
            if let Some(job) = state.jobs.analysis.as_mut().filter(|_| generation == state.generation) {
                job.stage = Some(stage);
            }
        }
        Report::Analyzed(shown) => return analyzed(state, shown),
        Report::Traced { generation, replay } => debugger::trace_arrived(state, generation, *replay),
        Report::Exporting { done, total } => {
            if let Some(job) = &mut state.jobs.export {
                job.files = Some((done, total));
            }
        }
        Report::Exported(outcome) => {
            state.jobs.export = None;
            match outcome {
                Ok(said) => notify(state, Severity::Done, said),
                Err(reason) => notify(state, Severity::Error, reason),
            }
        }
        Report::WhatIf(asked, progress) => what_if_job::report(state, asked, progress),
    }
    Vec::new()
}

/// Begins to restore a workspace: its photograph is read first.
pub(super) fn restore(state: &mut State, workspace: Box<Workspace>) -> Vec<Effect> {
    match workspace.reading() {
        Ok(options) => {
            let origin = workspace.origin.clone();
            state.restoring = Some(workspace);
            vec![Effect::Read(origin, options)]
        }
        Err(reason) => {
            notify(state, Severity::Error, reason);
            Vec::new()
        }
    }
}
