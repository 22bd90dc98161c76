//! The reducer of the commands that start and stop work in the background.

use super::edits::analyze;
use super::photographs;
use super::reports::reading_of;
use crate::app::files_to_open::files_to_open;
use crate::app::{Effect, FilesToOpen, JobCommand, Severity, State};
use crate::photo::ReadOptions;
use crate::view::{ElsewherePaths, Origin};

/// Starts or stops work in the background.
pub(super) fn reduce(state: &mut State, command: JobCommand) -> Vec<Effect> {
    match command {
        JobCommand::Open(origin) => {
            state.restoring = None;
            vec![Effect::Read(origin, ReadOptions::default())]
        }
        JobCommand::OpenFiles(origins) => open_files(state, origins, false),
        JobCommand::OpenFilesFirstShown(origins) => open_files(state, origins, true),
        JobCommand::OpenFolders(origins) => vec![Effect::FindInFolders(origins)],
        JobCommand::OpenBeside(origin, elsewhere) => {
            read_files(state, FilesToOpen { photographs: vec![origin], elsewhere, ..FilesToOpen::default() })
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
        JobCommand::ClosePhotograph(picture) => photographs::close(state, &picture),
        JobCommand::ReadAs(options) => {
            state.restoring = None;
            state.picture.iter().map(|picture| Effect::Read(picture.origin.clone(), options)).collect()
        }
        JobCommand::OpenWorkspace(path) => {
            vec![Effect::ReadWorkspace { path, elsewhere: ElsewherePaths::default() }]
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
        JobCommand::Analyze => analyze(state),
        JobCommand::CancelAnalysis if state.jobs.analysis.is_none() => {
            state.give_up_recording().into_iter().collect()
        }
        JobCommand::CancelAnalysis => {
            state.give_up_analysis();
            vec![Effect::CancelAnalysis]
        }
        JobCommand::CancelExport => {
            state.jobs.cancels_export = state.jobs.export.is_some();
            vec![Effect::StopWriting]
        }
    }
}

/// Opens files together, each as what it is by its name. `shows_first`: whether the first photograph is to be shown and not the last.
pub(super) fn open_files(state: &mut State, origins: Vec<Origin>, shows_first: bool) -> Vec<Effect> {
    let (files, notes) = files_to_open(origins, state.picture.is_some());
    for (severity, text) in notes {
        state.notify_of_files(severity, text);
    }
    read_files(state, FilesToOpen { shows_first, ..files })
}

/// Reads files that are opened together: photographs first, then the rest.
fn read_files(state: &mut State, files: FilesToOpen) -> Vec<Effect> {
    if !files.photographs.is_empty() {
        state.restoring = None;
        return vec![Effect::ReadTogether(files)];
    }
    let FilesToOpen { elsewhere, workspace, .. } = files;
    match workspace {
        Some(path) => vec![Effect::ReadWorkspace { path, elsewhere }],
        None => reading_of(&elsewhere, true),
    }
}
