//! Writes a result folder so that the target is always complete.

use super::choice::{is_matte, is_result_file};
use super::exchange::replace;
use super::leftovers::{HiddenFolder, sync_entries, sync_folder};
use super::{ExportError, is_result_folder};
use crate::describe::{self, Report};
use std::fs::{self, DirEntry};
use std::io;
use std::path::{Path, PathBuf};

/// An unfinished result in a hidden folder beside its target.
///
/// A drop without [`Staging::publish`] deletes the hidden folder.
#[derive(Debug)]
pub struct Staging {
    hidden: HiddenFolder,
    target: PathBuf,
    force: bool,
}

/// Checks that a result may be written to `target`: `target` does not exist, is an empty folder or holds an earlier result, whole
/// or in part.
///
/// With `force`, any folder may be replaced.
///
/// # Errors
/// [`ExportError::Occupied`] or [`ExportError::NotAFolder`].
pub fn check_target(target: &Path, force: bool) -> Result<(), ExportError> {
    // A link without a target exists, but is not a folder.
    if fs::symlink_metadata(target).is_err() {
        return Ok(());
    }
    if fs::read_dir(target).is_err() {
        return Err(ExportError::NotAFolder(target.to_owned()));
    }
    if force || is_result_folder(target) || part_of_a_result(target).is_some() {
        Ok(())
    } else {
        Err(ExportError::Occupied(target.to_owned()))
    }
}

/// Names of the files in a folder that holds files of a result without their report, and nothing else; also of an empty folder.
fn part_of_a_result(folder: &Path) -> Option<Vec<String>> {
    let name_of = |entry: io::Result<DirEntry>| {
        let entry = entry.ok().filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()))?;
        let name = entry.file_name().into_string().ok()?;
        (is_result_file(&name) && name != describe::FILE_NAME).then_some(name)
    };
    fs::read_dir(folder).ok()?.map(name_of).collect()
}

impl Staging {
    /// Makes a hidden folder beside `target`. Missing parent folders are made.
    ///
    /// # Errors
    /// When `target` must not be replaced (see [`check_target`]), or the folder cannot be made.
    pub fn begin(target: &Path, force: bool) -> Result<Self, ExportError> {
        check_target(target, force)?;
        // A link is followed, so that the folder behind the link is replaced and not the link.
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
        let hidden = HiddenFolder::beside(&target)
            .map_err(|source| ExportError::Io { path: target.clone(), source })?;
        Ok(Self { hidden, target, force })
    }

    /// The hidden folder, for the files of the result.
    pub fn folder(&self) -> &Path {
        self.hidden.path()
    }

    /// Adds the report, if there is one, and gives the hidden folder the name of the target. An earlier result is replaced as a
    /// whole: at every moment there is a whole result at the target, the earlier or the new one, also after a loss of power. Where
    /// neither has a report, earlier files that were not written again stay.
    ///
    /// # Errors
    /// When the report cannot be written or the folder cannot be renamed; the earlier result then remains.
    pub fn publish(self, report: Option<&Report>) -> Result<(), ExportError> {
        if let Some(report) = report {
            let path = self.folder().join(describe::FILE_NAME);
            match report.to_json() {
                Ok(text) => fs::write(&path, text).map_err(|source| ExportError::Io { path, source })?,
                Err(source) => return Err(ExportError::Json { path, source }),
            }
        }
        let failed = |source| ExportError::Io { path: self.target.clone(), source };
        if report.is_none() {
            self.keep_other_files().map_err(failed)?;
        }
        sync_folder(self.folder()).map_err(failed)?;
        // Another process may have created the target since `begin`.
        check_target(&self.target, self.force)?;
        // Afterwards the hidden folder is the earlier result, which the drop deletes.
        replace(self.folder(), &self.target).map_err(failed)?;
        if let Some(parent) = self.target.parent() {
            sync_entries(parent);
        }
        Ok(())
    }

    /// Copies the files of an earlier result without a report that were not written again.
    fn keep_other_files(&self) -> io::Result<()> {
        let written: Vec<_> = fs::read_dir(self.folder())?.flatten().map(|entry| entry.file_name()).collect();
        let has_matte = written.iter().any(|name| name.to_str().is_some_and(is_matte));
        for name in part_of_a_result(&self.target).unwrap_or_default() {
            let is_replaced = written.iter().any(|new| *new == *name) || has_matte && is_matte(&name);
            if !is_replaced {
                fs::copy(self.target.join(&name), self.folder().join(&name))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPORT: &str = r#"{"schema": 1, "program": "0.0.1", "image": {}}"#;

    #[test]
    fn only_empty_folders_and_earlier_results_may_be_replaced() {
        let root = tempfile::tempdir().unwrap();
        let target = root.path().join("result");
        assert!(check_target(&target, false).is_ok());
        fs::create_dir(&target).unwrap();
        assert!(check_target(&target, false).is_ok());
        fs::write(target.join("thesis.tex"), "years of work").unwrap();
        assert!(matches!(check_target(&target, false), Err(ExportError::Occupied(_))));
        assert!(check_target(&target, true).is_ok());
        fs::write(target.join("report.json"), REPORT).unwrap();
        assert!(check_target(&target, false).is_ok());
        let file = target.join("thesis.tex");
        assert!(matches!(check_target(&file, true), Err(ExportError::NotAFolder(_))));
    }

    #[test]
    fn parts_of_a_result_are_put_together_and_replaced_by_a_whole_one() {
        let root = tempfile::tempdir().unwrap();
        let target = root.path().join("result");
        let write = |files: &[(&str, &str)]| {
            let staging = Staging::begin(&target, false)?;
            for (name, text) in files {
                fs::write(staging.folder().join(name), text).unwrap();
            }
            staging.publish(None)
        };
        let text = |name: &str| fs::read_to_string(target.join(name)).unwrap_or_default();
        write(&[("matte.png", "first"), ("body.exr", "first")]).unwrap();
        write(&[("matte.jpg", "second")]).unwrap();
        assert_eq!([text("matte.jpg"), text("body.exr"), text("matte.png")], ["second", "first", ""]);
        fs::write(target.join(describe::FILE_NAME), REPORT).unwrap();
        write(&[("noise.png", "third")]).unwrap();
        assert_eq!(
            fs::read_dir(&target).unwrap().count(),
            1,
            "a result with a report is replaced as a whole"
        );
        fs::write(target.join("thesis.tex"), "years of work").unwrap();
        assert!(matches!(write(&[("noise.png", "fourth")]), Err(ExportError::Occupied(_))));
        fs::remove_file(target.join("thesis.tex")).unwrap();
        fs::create_dir(target.join("body.png")).unwrap();
        assert!(matches!(write(&[("noise.png", "fifth")]), Err(ExportError::Occupied(_))));
    }

    #[test]
    fn an_unpublished_result_leaves_no_files() {
        let root = tempfile::tempdir().unwrap();
        let staging = Staging::begin(&root.path().join("a/result"), false).unwrap();
        fs::write(staging.folder().join("half"), "").unwrap();
        assert!(!root.path().join("a/result").exists());
        drop(staging);
        assert_eq!(fs::read_dir(root.path().join("a")).unwrap().count(), 0);
    }
}
