//! The application without a screen.
//!
//! A [`State`] is all data that panels show. Panels send [`Command`]s, and [`reduce()`] applies each command to the state:
//! a pure function that returns the [`Effect`]s to be carried out, and is tested without a window. An [`Application`] carries
//! the effects out, on threads or inline in tests; workers answer with reports, which only the application can apply.
//!
//! Files use one another in one direction: plain data (document, view settings, debugger, workspace), then the state, then
//! exports and commands, then the reducers, then the application.

mod analysis_state;
mod analysis_worker;
mod application;
mod awaited;
mod command;
mod command_line;
mod debugger;
mod document;
mod document_change;
mod effect;
mod export_input;
mod exports;
mod files_to_open;
mod folders;
mod jobs;
mod panics;
mod photographs;
mod preview;
mod read;
mod reduce;
mod report;
mod rescue;
mod settings;
mod state;
mod view_settings;
mod what_if_job;
mod workspace;
mod write;

pub use analysis_worker::AnalysisRequest;
pub use application::{Application, Executor};
pub use command::{Combine, Command, Edit, JobCommand, NamedMarkEdit, ViewCommand};
pub use command_line::analyze_call;
pub use debugger::{
    Breakpoint, CandidateCheck, Condition, DebugCommand, DebugSettings, Debugger, Difference, Direction,
    Goal, Missed, SavedClass, StepUnit,
};
pub use document::{Document, Gesture, History};
pub use document_change::document_change;
pub use effect::Effect;
pub use export_input::{DrawnPicture, ExportOptions};
pub use exports::{Export, ExportKind, problem_of_replacing};
pub use files_to_open::FilesToOpen;
pub use jobs::{Job, JobState};
pub use panics::catch_panic;
pub use photographs::{OpenPhotograph, Switching};
pub use preview::Preview;
pub use reduce::reduce;
pub use settings::Settings;
pub use state::{NOT_ANALYZED, Notice, Severity, State};
pub use view_settings::ViewSettings;
pub use what_if_job::{Question, WhatIfJob, WhatIfProgress, WhatIfRequest};
pub use workspace::{Workspace, is_workspace};
