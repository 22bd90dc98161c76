//! Writes the workspace after a panic, so that no work is lost.

use super::export_input::ExportInput;
use crate::export::write_file;
use std::path::{Path, PathBuf};

/// Largest number in the name of a rescued workspace.
const MOST_RESCUED: usize = 999;

/// Writes the workspace beside the photograph, or to the folder of temporary files where that cannot be done, and returns
/// its path.
///
/// # Errors
/// A message, where there is no workspace to write, or neither folder can be written to.
pub(super) fn write_workspace(input: &ExportInput) -> Result<PathBuf, String> {
    let workspace = input.workspace.as_ref().map_err(String::clone)?;
    let origin = input.picture.as_ref().map(|picture| &picture.origin);
    let photo = origin.and_then(|origin| origin.path());
    let stem = photo.and_then(Path::file_stem).map_or("dichroscope".into(), |stem| stem.to_string_lossy());
    let name = |number: usize| match number {
        1 => format!("{stem}-rescued.dichroscope"),
        _ => format!("{stem}-rescued-{number}.dichroscope"),
    };
    let beside = photo.and_then(Path::parent).map(Path::to_path_buf);
    let mut reason = String::new();
    for folder in beside.into_iter().chain([std::env::temp_dir()]) {
        // A workspace that an earlier panic rescued stays.
        let free = (1..=MOST_RESCUED).map(|number| folder.join(name(number))).find(|path| !path.exists());
        let Some(path) = free else { continue };
        match write_file(&path, workspace.to_json(&path)?.as_bytes()) {
            Ok(()) => return Ok(path),
            Err(error) => reason = super::write::error_chain(&error),
        }
    }
    Err(reason)
}
