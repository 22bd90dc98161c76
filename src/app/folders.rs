//! Folders that are opened: in place of each, the photographs in it.

use super::files_to_open::Note;
use super::state::Severity;
use crate::photo::Format;
use crate::truth::sample::CAMERA_FILE;
use crate::view::Origin;
use std::io;
use std::path::{Path, PathBuf};

/// The origins with the photographs of each folder in place of the folder, in the order of their names, and a sentence about each folder
/// that gives none.
pub(super) fn with_photographs_of_folders(origins: Vec<Origin>) -> (Vec<Origin>, Vec<Note>) {
    let (mut files, mut notes) = (Vec::new(), Vec::new());
    for origin in origins {
        let Some(folder) = origin.path().filter(|path| path.is_dir()) else {
            files.push(origin);
            continue;
        };
        match photographs_in(folder) {
            Ok(photographs) if photographs.is_empty() => {
                let text = format!(
                    "{}: no photograph lies in this folder; folders in it are not searched: open one of them",
                    folder.display()
                );
                notes.push((Severity::Error, text));
            }
            Ok(photographs) => files.extend(photographs.into_iter().map(Origin::File)),
            Err(reason) => {
                let text = format!("{}: the folder cannot be read: {reason}", folder.display());
                notes.push((Severity::Error, text));
            }
        }
    }
    (files, notes)
}

/// The photographs that lie in a folder itself, by the extensions of their names, in the order of their names. Hidden files are none. Of
/// a scene with ground truth, the photograph alone: the other pictures are the truth.
///
/// # Errors
/// When the folder cannot be read.
fn photographs_in(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let of_scene = folder.join(CAMERA_FILE);
    if of_scene.is_file() && folder.join("truth.json").is_file() {
        return Ok(vec![of_scene]);
    }
    let is_photograph = |path: &PathBuf| {
        let is_hidden = path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."));
        !is_hidden && Format::known_extension(path) && path.is_file()
    };
    let paths: io::Result<Vec<PathBuf>> =
        folder.read_dir()?.map(|entry| entry.map(|entry| entry.path())).collect();
    let mut photographs: Vec<PathBuf> = paths?.into_iter().filter(is_photograph).collect();
    photographs.sort();
    Ok(photographs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_folder_gives_its_photographs_in_the_order_of_their_names() {
        let root = tempfile::tempdir().unwrap();
        fs::create_dir_all(root.path().join("sub.png")).unwrap();
        for name in ["b.JPG", "a.png", ".hidden.png", "notes.txt", "sub.png/c.png"] {
            fs::write(root.path().join(name), "").unwrap();
        }
        let origins = [root.path().join("x.png"), root.path().to_path_buf()].map(Origin::File);
        let (files, notes) = with_photographs_of_folders(origins.into());
        let names: Vec<String> = files.iter().map(Origin::name).collect();
        assert_eq!(names, ["x.png", "a.png", "b.JPG"]);
        assert!(notes.is_empty());
    }

    #[test]
    fn of_a_scene_with_ground_truth_the_photograph_alone_is_opened() {
        let root = tempfile::tempdir().unwrap();
        for name in [CAMERA_FILE, "labels.png", "body.exr", "truth.json"] {
            fs::write(root.path().join(name), "").unwrap();
        }
        assert_eq!(photographs_in(root.path()).unwrap(), [root.path().join(CAMERA_FILE)]);
        fs::remove_file(root.path().join("truth.json")).unwrap();
        assert_eq!(photographs_in(root.path()).unwrap().len(), 3);
    }

    #[test]
    fn a_folder_without_photographs_is_told() {
        let root = tempfile::tempdir().unwrap();
        let (files, notes) = with_photographs_of_folders(vec![Origin::File(root.path().to_path_buf())]);
        assert!(files.is_empty());
        let [(Severity::Error, text)] = notes.as_slice() else { panic!("{notes:?}") };
        assert!(
            text.contains(&root.path().display().to_string()) && text.contains("no photograph"),
            "{text}"
        );
    }
}
