//! Writes a file so that the target is always complete.

use super::ExportError;
use super::leftovers::{create_part, sync_entries};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file that is written piece by piece to a hidden file beside its place, and appears there as a whole.
///
/// A drop without [`PartFile::publish`] deletes the hidden file. A place that is no regular file, as `/dev/null` or a pipe, is
/// written at once.
#[derive(Debug)]
pub struct PartFile {
    file: File,
    /// The hidden file and the place; `None` where the place is written at once, or the file is published.
    rename: Option<(PathBuf, PathBuf)>,
}

impl PartFile {
    /// Begins to write the file at `path`.
    ///
    /// # Errors
    /// When `path` is a folder or lies in none, or the file cannot be made.
    pub fn begin(path: &Path) -> io::Result<Self> {
        // A link is followed, so that the file behind the link is replaced and not the link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        match fs::metadata(&path) {
            Ok(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if !found.is_file() => {
                return Ok(Self { file: File::options().write(true).open(&path)?, rename: None });
            }
            _ => {}
        }
        let (hidden, file) = create_part(&path)?;
        Ok(Self { file, rename: Some((hidden, path)) })
    }

    /// Gives the file its name; an earlier file is replaced. The file is on the disk afterwards.
    ///
    /// # Errors
    /// When the file cannot be written or renamed; an earlier file then remains.
    pub fn publish(mut self) -> io::Result<()> {
        let Some((hidden, path)) = &self.rename else { return Ok(()) };
        self.file.sync_all()?;
        fs::rename(hidden, path)?;
        if let Some(folder) = path.parent() {
            sync_entries(folder);
        }
        self.rename = None;
        Ok(())
    }
}

impl Write for PartFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        if let Some((hidden, _)) = &self.rename {
            // An error of the cleanup is ignored, because it would hide the first error.
            let _ = fs::remove_file(hidden);
        }
    }
}

/// Writes `bytes` to a hidden file beside `path` and renames the hidden file to `path`. Missing parent folders are made.
///
/// # Errors
/// When `path` is a folder, or a file or folder cannot be made, written or renamed; an earlier file then remains.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ExportError> {
    let written = || -> io::Result<()> {
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder)?;
        }
        let mut file = PartFile::begin(path)?;
        file.write_all(bytes)?;
        file.publish()
    };
    written().map_err(|source| ExportError::Io { path: path.to_owned(), source })
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
