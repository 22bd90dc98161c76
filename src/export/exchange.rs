//! Replaces a folder by another one.

use std::fs;
use std::io;
use std::path::Path;

/// Renames `new` to `target`. Where `target` exists, both exchange their names in one step, so that there is a whole folder at
/// `target` at every moment; afterwards `new` is the earlier folder, or it is gone.
///
/// On systems without such a step, the earlier folder is renamed before: for a moment there is no `target`.
pub(super) fn replace(new: &Path, target: &Path) -> io::Result<()> {
    if fs::symlink_metadata(target).is_err() {
        return fs::rename(new, target);
    }
    match exchange(new, target) {
        Err(error) if is_unsupported(&error) => replace_in_two_steps(new, target),
        done => done,
    }
}

fn is_unsupported(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::Unsupported | io::ErrorKind::InvalidInput)
}

#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn exchange(one: &Path, other: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn exchange(_one: &Path, _other: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

fn replace_in_two_steps(new: &Path, target: &Path) -> io::Result<()> {
    let old = new.with_extension("old");
    fs::rename(target, &old)?;
    if let Err(error) = fs::rename(new, target) {
        fs::rename(&old, target)?;
        return Err(error);
    }
    // A later removal of leftovers finds the earlier folder by the name of the new one.
    fs::rename(&old, new)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_replace_and_keep_the_earlier_folder_aside() {
        for replace in [replace, replace_in_two_steps] {
            let root = tempfile::tempdir().unwrap();
            let [new, target] = ["new", "target"].map(|name| root.path().join(name));
            for (folder, text) in [(&new, "new"), (&target, "old")] {
                fs::create_dir(folder).unwrap();
                fs::write(folder.join("file"), text).unwrap();
            }
            replace(&new, &target).unwrap();
            assert_eq!(fs::read_to_string(target.join("file")).unwrap(), "new");
            assert_eq!(fs::read_to_string(new.join("file")).unwrap(), "old");
        }
        let root = tempfile::tempdir().unwrap();
        fs::create_dir(root.path().join("new")).unwrap();
        replace(&root.path().join("new"), &root.path().join("target")).unwrap();
        assert!(root.path().join("target").exists());
    }
}
