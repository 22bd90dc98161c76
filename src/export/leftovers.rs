//! Hidden files and folders of unfinished writing: their names, the locks that tell a running program from a killed one, and
//! the removal of what a killed one left.
//!
//! An unfinished result is a folder `.dichroscope-PROCESS-SERIAL` beside its target, with a file of the same name and the
//! ending `.lock`, which the program locks as long as it works. The system unlocks the file when the program ends, however it
//! ends. An unfinished single file has the ending `.part` and is locked itself.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};

const PREFIX: &str = ".dichroscope-";
const LOCK: &str = "lock";
const PART: &str = "part";

/// Serial number of the next hidden name of this process.
static SERIAL: AtomicU32 = AtomicU32::new(0);

/// A hidden place of this process: short, so that the name of the target may be as long as the file system allows.
fn hidden_sibling(target: &Path) -> PathBuf {
    let serial = SERIAL.fetch_add(1, Ordering::Relaxed);
    target.with_file_name(format!("{PREFIX}{}-{serial}", std::process::id()))
}

/// A hidden folder beside a target. A drop deletes it and its lock.
#[derive(Debug)]
pub(super) struct HiddenFolder {
    folder: PathBuf,
    /// Locked as long as it is open; `None` where the file system knows no locks.
    lock: Option<File>,
}

impl HiddenFolder {
    /// Makes the folder; missing parents too. What killed programs left beside it is removed.
    pub(super) fn beside(target: &Path) -> io::Result<Self> {
        if let Some(parent) = target.parent().filter(|parent| !parent.as_os_str().is_empty()) {
            fs::create_dir_all(parent)?;
        }
        remove_leftovers_beside(target);
        loop {
            let folder = hidden_sibling(target);
            let lock_path = folder.with_extension(LOCK);
            let lock = File::create(&lock_path)?;
            let lock = lock.lock().is_ok().then_some(lock);
            // Another process may have taken the file for a leftover before it was locked.
            if lock.is_some() && !lock_path.exists() {
                continue;
            }
            let hidden = Self { folder, lock };
            fs::create_dir(&hidden.folder)?;
            return Ok(hidden);
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.folder
    }
}

impl Drop for HiddenFolder {
    fn drop(&mut self) {
        // The folder was renamed, or an earlier error is the one to report.
        let _ = fs::remove_dir_all(&self.folder);
        let _ = fs::remove_file(self.folder.with_extension(LOCK));
        self.lock = None;
    }
}

/// A hidden file beside a target, locked while it is written.
pub(super) fn create_part(target: &Path) -> io::Result<(PathBuf, File)> {
    remove_leftovers_beside(target);
    loop {
        let path = hidden_sibling(target).with_extension(PART);
        let file = File::create(&path)?;
        if file.lock().is_err() || path.exists() {
            return Ok((path, file));
        }
    }
}

/// Removes what killed programs left beside a target; once a folder, as a folder may hold many results.
fn remove_leftovers_beside(target: &Path) {
    static SEEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let parent = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Ok(parent) = parent.canonicalize() else { return };
    if SEEN.lock().unwrap_or_else(PoisonError::into_inner).insert(parent.clone()) {
        remove_leftovers(&parent);
    }
}

/// Removes the hidden files and folders of programs that do not run any more. What cannot be removed is left.
pub fn remove_leftovers(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())) {
        let is_hidden =
            path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(PREFIX.as_bytes()));
        let extension = path.extension().and_then(|extension| extension.to_str());
        if !is_hidden || !matches!(extension, Some(LOCK | PART)) {
            continue;
        }
        let Ok(file) = File::options().read(true).write(true).open(&path) else { continue };
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock | TryLockError::Error(_)) => continue,
        }
        if extension == Some(LOCK) {
            let _ = fs::remove_dir_all(path.with_extension(""));
        }
        let _ = fs::remove_file(&path);
    }
}

/// Waits until the files of a folder, and the folder itself, are on the disk.
pub(super) fn sync_folder(folder: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            File::options().read(true).write(true).open(entry.path())?.sync_all()?;
        }
    }
    sync_entries(folder);
    Ok(())
}

/// Waits until the names in a folder are on the disk, where the system can do that.
pub(super) fn sync_entries(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        // Not every system syncs folders.
        let _ = folder.sync_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_nobody_works_on_is_removed() {
        let root = tempfile::tempdir().unwrap();
        let target = root.path().join("result");
        let working = HiddenFolder::beside(&target).unwrap();
        let dead = root.path().join(".dichroscope-1-0");
        fs::create_dir(&dead).unwrap();
        fs::write(dead.join("half"), "").unwrap();
        fs::write(dead.with_extension(LOCK), "").unwrap();
        fs::write(root.path().join(".dichroscope-1-1.part"), "").unwrap();
        fs::write(root.path().join(".profile"), "").unwrap();
        remove_leftovers(root.path());
        assert!(!dead.exists() && working.path().exists());
        assert_eq!(
            fs::read_dir(root.path()).unwrap().count(),
            3,
            "folder, lock, and a file of another program"
        );
        drop(working);
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }
}
