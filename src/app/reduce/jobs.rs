//! The reducer of the commands that start and stop work in the background.

use super::photographs;
use crate::app::{Effect, JobCommand, Severity, State};
use crate::photo::ReadOptions;

/// Starts or stops work in the background.
pub(super) fn reduce(state: &mut State, command: JobCommand) -> Vec<Effect> {
    match command {
        JobCommand::Open(origin) => {
            state.restoring = None;
            vec![Effect::Read(origin, ReadOptions::default())]
        }
        JobCommand::OpenTogether(origins) => {
            state.restoring = None;
            vec![Effect::ReadTogether(origins)]
        }
        JobCommand::Switch(switching) => photographs::switch(state, switching),
        JobCommand::ClosePhotograph => photographs::close(state),
        JobCommand::ReadAs(options) => {
            state.restoring = None;
            state.picture.iter().map(|picture| Effect::Read(picture.origin.clone(), options)).collect()
        }
        JobCommand::OpenWorkspace(path) => vec![Effect::ReadWorkspace(path)],
        JobCommand::LoadParams(path) => vec![Effect::ReadParams(path)],
        JobCommand::Export(_) if state.jobs.export.is_some() => {
            let text = "an export is still under way: wait for its end, or cancel it first";
            state.notify(Severity::Warning, text.to_owned());
            Vec::new()
        }
        JobCommand::Export(export) => vec![Effect::Write(export)],
        JobCommand::Rescue(text) => {
            state.notify(Severity::Error, text);
            vec![Effect::Rescue]
        }
        JobCommand::CancelExport => vec![Effect::StopWriting],
    }
}
