//! The path that a dialog works with once it is confirmed, and what speaks against that path.

use super::dialog::Dialog;
use super::typed_path::typed_path;
use crate::app::{ExportKind, State, is_workspace, problem_of_replacing};
use std::path::{Path, PathBuf};

/// The path in a typed text; of a file to write that has no extension, with that of its kind. `exported` is the kind that the
/// export dialog writes.
pub fn confirmed_path(typed: &str, dialog: Dialog, exported: ExportKind) -> PathBuf {
    let path = typed_path(typed).unwrap_or_default();
    let kind = match dialog {
        Dialog::SaveWorkspace => return workspace_path(path),
        Dialog::SaveParameters => ExportKind::Parameters,
        Dialog::Export => exported,
        Dialog::Open | Dialog::LoadParameters | Dialog::OpenWorkspace | Dialog::OpenElsewhere(_) => {
            return path;
        }
    };
    match Path::new(kind.file()).extension() {
        Some(extension) if path.extension().is_none() && path.file_name().is_some() => {
            path.with_added_extension(extension)
        }
        _ => path,
    }
}

/// A workspace's path, with the extension of workspaces appended where the path has another extension or none.
fn workspace_path(path: PathBuf) -> PathBuf {
    if is_workspace(&path) {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".dichroscope");
    PathBuf::from(name)
}

/// What speaks against the work of a dialog; none where the path is a file that can be read, or can be written now. A dialog that opens
/// photographs also opens those in a folder.
pub fn problem_of(dialog: Dialog, path: &Path, state: &State) -> Option<String> {
    if !dialog.reads() {
        let busy = "another export is still under way: wait for its end, or cancel it, and then try again";
        let is_busy = state.jobs.export.is_some();
        return is_busy.then(|| busy.to_owned()).or_else(|| problem_of_replacing(path, state));
    }
    if path.is_file() || (dialog == Dialog::Open && path.is_dir()) {
        return None;
    }
    let what = if path.is_dir() {
        "is a folder: type the name of a file in it too, or choose one with Browse"
    } else {
        "there is no such file: correct the path, or choose a file with Browse"
    };
    Some(format!("{}: {what}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_workspace_gets_its_extension() {
        for (typed, path) in [
            ("a", "a.dichroscope"),
            ("a.v2", "a.v2.dichroscope"),
            ("/b/a.dichroscope", "/b/a.dichroscope"),
            ("a.json", "a.json.dichroscope"),
        ] {
            let confirmed = confirmed_path(typed, Dialog::SaveWorkspace, ExportKind::View);
            assert_eq!(confirmed, Path::new(path));
        }
    }

    #[test]
    fn a_file_to_write_gets_the_extension_of_its_kind_where_it_has_none_and_a_file_to_read_gets_none() {
        for (typed, dialog, path) in [
            ("a", Dialog::SaveParameters, "a.toml"),
            ("a", Dialog::Export, "a.png"),
            ("a.tif", Dialog::Export, "a.tif"),
            ("", Dialog::Export, ""),
            ("a", Dialog::Open, "a"),
        ] {
            let confirmed = confirmed_path(typed, dialog, ExportKind::View);
            assert_eq!(confirmed, Path::new(path), "{typed:?} in {dialog:?}");
        }
    }

    #[test]
    fn a_path_that_cannot_be_read_has_a_problem_and_a_path_to_be_written_has_none() {
        let (folder, state) = (tempfile::tempdir().unwrap(), State::default());
        let missing = folder.path().join("x.png");
        assert!(problem_of(Dialog::Open, &missing, &state).unwrap().contains("no such file"));
        assert!(problem_of(Dialog::OpenWorkspace, folder.path(), &state).unwrap().contains("is a folder"));
        assert_eq!(problem_of(Dialog::Open, folder.path(), &state), None);
        assert_eq!(problem_of(Dialog::Export, &missing, &state), None);
        std::fs::write(&missing, "").unwrap();
        assert_eq!(problem_of(Dialog::Open, &missing, &state), None);
    }
}
