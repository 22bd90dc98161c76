//! The reducer of the commands that start and stop work in the background.

use super::photographs;
use crate::app::{Effect, JobCommand, Severity, State};
use crate::photo::ReadOptions;
use crate::view::ElsewherePaths;

/// Starts or stops work in the background.
pub(super) fn reduce(state: &mut State, command: JobCommand) -> Vec<Effect> {
    match command {
        JobCommand::Open(origin) => {
            (state.restoring, state.opens_beside) = (None, ElsewherePaths::default());
            vec![Effect::Read(origin, ReadOptions::default())]
        }
        JobCommand::OpenTogether(origins) => {
            (state.restoring, state.opens_beside) = (None, ElsewherePaths::default());
            vec![Effect::ReadTogether(origins)]
        }
        JobCommand::OpenBeside(origin, paths) => {
            (state.restoring, state.opens_beside) = (None, paths);
            vec![Effect::Read(origin, ReadOptions::default())]
        }
        JobCommand::OpenElsewhere(kind, path) if state.picture.is_none() => {
            let text = format!(
                "{}: a {} is held against a photograph: open the photograph first",
                path.display(),
                kind.name()
            );
            state.notify(Severity::Error, text);
            Vec::new()
        }
        JobCommand::OpenElsewhere(kind, path) => vec![Effect::ReadElsewhere { kind, path, shows: true }],
        JobCommand::Switch(switching) => photographs::switch(state, switching),
        JobCommand::ClosePhotograph => photographs::close(state),
        JobCommand::ReadAs(options) => {
            (state.restoring, state.opens_beside) = (None, ElsewherePaths::default());
            state.picture.iter().map(|picture| Effect::Read(picture.origin.clone(), options)).collect()
        }
        JobCommand::OpenWorkspace(path) => {
            state.opens_beside = ElsewherePaths::default();
            vec![Effect::ReadWorkspace(path)]
        }
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
