//! Writes a file so that the target is always complete.

use super::ExportError;
use super::leftovers::{create_part, sync_entries};
use std::fs;
use std::io::Write;
use std::path::Path;

/// Writes `bytes` to a hidden file beside `path` and renames the hidden file to `path`. Missing parent folders are made.
///
/// # Errors
/// When `path` is a folder, or a file or folder cannot be made, written or renamed; an earlier file then remains.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ExportError> {
    // A link is followed, so that the file behind the link is replaced and not the link.
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let failed = |source| ExportError::Io { path: path.clone(), source };
    if path.is_dir() {
        return Err(failed(std::io::ErrorKind::IsADirectory.into()));
    }
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    let (hidden, mut file) = create_part(path).map_err(failed)?;
    let written =
        file.write_all(bytes).and_then(|()| file.sync_all()).and_then(|()| fs::rename(&hidden, path));
    if let Some(folder) = path.parent().filter(|_| written.is_ok()) {
        sync_entries(folder);
    }
    written.map_err(|source| {
        // An error of the cleanup is ignored, because it would hide the first error.
        let _ = fs::remove_file(&hidden);
        failed(source)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_no_hidden_file_remains() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("a/b.txt");
        write_file(&path, b"one").unwrap();
        write_file(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(root.path().join("a")).unwrap().count(), 1);
    }

    #[test]
    fn a_folder_is_not_replaced_by_a_file() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("results");
        fs::create_dir(&folder).unwrap();
        let message = write_file(&folder, b"").unwrap_err().to_string();
        assert!(message.starts_with("cannot write") && message.ends_with("results"), "{message}");
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }
}
