//! Workspace files: the place of a photograph, the parameters of its analysis, the selection and the views, as JSON.

use super::{Document, ViewSettings};
use crate::params::Params;
use crate::photo::{EncodingChoice, ReadOptions};
use crate::raster::Mask;
use crate::view::{ElsewherePaths, Item, MaskRuns, NamedMark, Origin, Picture};
use serde::{Deserialize, Serialize};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

/// Version of the format. The version rises when a field changes its name or its meaning.
const SCHEMA: u32 = 1;

/// The contents of a workspace file, as JSON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Workspace {
    schema: u32,
    /// Version of the program that wrote the file.
    program: String,
    /// The photograph; in the file, a path is relative to the file's folder where it can be.
    pub origin: Origin,
    /// The encoding of the photograph's values, as text of the flag `--encoding`.
    pub encoding: String,
    /// Counts of full scale, where it is not 255.
    #[serde(default)]
    pub full_scale: Option<f64>,
    /// The parameters of the analysis, with a given illuminant.
    pub params: Params,
    /// The parameters of the pinned result.
    #[serde(default)]
    pub pinned: Option<Params>,
    /// The pixels that the analysis is restricted to.
    #[serde(default)]
    pub area: Option<MaskRuns>,
    /// The selected item.
    #[serde(default)]
    pub item: Option<Item>,
    /// The marked pixels.
    #[serde(default)]
    pub marked: Option<MaskRuns>,
    /// The named marks.
    #[serde(default)]
    pub named_marks: Vec<SavedMark>,
    /// The pictures of another program; in the file, paths are relative to the file's folder where they can be.
    #[serde(default)]
    pub elsewhere: ElsewherePaths,
    /// The settings of the views.
    #[serde(default)]
    pub view: ViewSettings,
}

/// A named mark in a workspace file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedMark {
    /// The name.
    pub name: String,
    /// The color, sRGB.
    pub color: [u8; 3],
    /// The pixels.
    pub pixels: MaskRuns,
}

impl SavedMark {
    fn of(mark: &NamedMark) -> Self {
        Self { name: mark.name.clone(), color: mark.color, pixels: MaskRuns::of(&mark.mask) }
    }
}

/// The fields that identify a workspace, in every version of the format.
#[derive(Deserialize)]
struct WorkspaceHeader {
    schema: u32,
    #[serde(rename = "origin")]
    _origin: serde::de::IgnoredAny,
}

impl Workspace {
    /// A workspace of the open photograph, the document, the parameters of the pinned result and the settings of the views.
    ///
    /// # Errors
    /// A sentence, where the photograph is in no file that could be opened again.
    pub(super) fn new(
        picture: &Picture,
        document: &Document,
        pinned: Option<&Params>,
        view: &ViewSettings,
    ) -> Result<Self, String> {
        if let Origin::Bytes { name, .. } = &picture.origin {
            return Err(format!(
                "{name}: came without a file, and a workspace names one: save the picture and open it from there"
            ));
        }
        let selection = &document.selection;
        let runs = |mask: &Arc<Mask>| MaskRuns::of(mask);
        Ok(Self {
            schema: SCHEMA,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            origin: picture.origin.clone(),
            encoding: picture.reading.encoding.to_string(),
            full_scale: picture.reading.full_scale,
            params: document.params,
            pinned: pinned.copied(),
            area: document.area.as_ref().map(runs),
            item: selection.item,
            marked: selection.marked.as_ref().map(runs),
            named_marks: selection.named.marks.iter().map(SavedMark::of).collect(),
            elsewhere: ElsewherePaths::default(),
            view: view.clone(),
        })
    }

    /// The options with which the photograph is read.
    ///
    /// # Errors
    /// A sentence, where the encoding is unknown.
    pub fn reading(&self) -> Result<ReadOptions, String> {
        let encoding: EncodingChoice = self.encoding.parse().map_err(|error| format!("{error}"))?;
        Ok(ReadOptions { encoding, full_scale: self.full_scale, ..ReadOptions::default() })
    }

    /// The text of the file at `path`.
    ///
    /// # Errors
    /// A sentence that names `path`.
    pub fn to_json(&self, path: &Path) -> Result<String, String> {
        let mut written = self.clone();
        if let Origin::File(photo) = &self.origin {
            written.origin = Origin::File(relative_to_file(photo, path));
        }
        written.elsewhere = self.elsewhere.map(|file| relative_to_file(file, path));
        let text = serde_json::to_string_pretty(&written);
        text.map(|text| text + "\n")
            .map_err(|error| format!("{}: cannot be written: {error}", path.display()))
    }

    /// Reads the file at `path`, and makes the photograph's path absolute.
    ///
    /// # Errors
    /// A sentence that names the file, what is wrong with it and what to do.
    pub fn load(path: &Path) -> Result<Self, String> {
        let file = path.display();
        let text = std::fs::read(path)
            .map_err(|error| format!("{file}: the workspace cannot be read: {error}; choose another file"))?;
        let no_workspace =
            |error| format!("{file}: is no workspace of Dichroscope ({error}); choose another file");
        let header: WorkspaceHeader = serde_json::from_slice(&text).map_err(no_workspace)?;
        if header.schema != SCHEMA {
            return Err(format!(
                "{file}: has schema {}, this program reads {SCHEMA}; open it with the version that wrote it",
                header.schema
            ));
        }
        let mut workspace: Self = serde_json::from_slice(&text).map_err(no_workspace)?;
        workspace.params.validate().map_err(|error| format!("{file}: {error}; correct it there"))?;
        workspace.reading().map_err(|error| format!("{file}: {error}; correct it there"))?;
        if let Some(pinned) = &workspace.pinned {
            pinned.validate().map_err(|error| format!("{file}: pinned {error}; correct it there"))?;
        }
        if let Origin::File(photo) = &workspace.origin {
            let photo = path.parent().unwrap_or(Path::new("")).join(photo);
            if !photo.is_file() {
                return Err(format!(
                    "{file}: its photograph {} is not there; put it back, or open it from where it is now",
                    photo.display()
                ));
            }
            workspace.origin = Origin::File(absolute_path(&photo));
        }
        // Whether these files are there is seen when they are read: a workspace opens without them.
        let folder = path.parent().unwrap_or(Path::new(""));
        workspace.elsewhere = workspace.elsewhere.map(|file| absolute_path(&folder.join(file)));
        Ok(workspace)
    }
}

/// Whether a path has the extension of workspaces.
pub fn is_workspace(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "dichroscope")
}

/// The absolute path of a file, without `.` and `..` components: `scenes/../photo.png` becomes `/…/photo.png`. A path stays as it is
/// where the working directory is unknown.
pub(super) fn absolute_path(path: &Path) -> PathBuf {
    without_dot_components(&std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
}

/// A path without `.` and `..` components; a relative path stays relative.
fn without_dot_components(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir if matches!(result.components().next_back(), Some(Component::Normal(_))) => {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
}

/// The path of `photo` relative to the folder of `file`; unchanged where there is none (another drive).
fn relative_to_file(photo: &Path, file: &Path) -> PathBuf {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (Ok(photo), Ok(folder)) = (std::path::absolute(photo), std::path::absolute(folder)) else {
        return photo.to_owned();
    };
    let (photo, folder) = (without_dot_components(&photo), without_dot_components(&folder));
    let shared = photo.components().zip(folder.components()).take_while(|(a, b)| a == b).count();
    // Paths that share no root have no relative path.
    if shared == 0 || !photo.components().take(shared).any(|part| part == Component::RootDir) {
        return photo;
    }
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    up.chain(photo.components().skip(shared)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::State;
    use crate::params::{Parameter, Setting};
    use crate::view::testing::gray;

    const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

    fn workspace(photo: &Path) -> Workspace {
        let mut picture = Arc::into_inner(gray(&["...", "..."], 90)).unwrap();
        picture.origin = Origin::File(photo.to_owned());
        let mut state = State { picture: Some(Arc::new(picture)), ..State::default() };
        *state.document.params.slot(Parameter::CameraNoise) = Setting::Value(3.25);
        let mask =
            crate::raster::Raster::from_vec(3, 2, vec![true, false, true, true, false, false]).unwrap();
        state.document.selection.marked = Some(Arc::new(mask));
        state.document.selection.item = Some(Item::Region(crate::raster::RegionId::from_index(1)));
        state.view.image.exposure_ev = 0.3;
        state.view.layout = "opaque".into();
        let elsewhere = photo.parent().map(|folder| folder.join("labels.png"));
        let paths = ElsewherePaths { labels: elsewhere, diffuse: None };
        state.elsewhere = Some(Arc::new(crate::view::Elsewhere { paths, ..Default::default() }));
        state.workspace().unwrap()
    }

    #[test]
    fn a_saved_workspace_is_read_back() {
        let root = tempfile::tempdir().unwrap();
        std::fs::create_dir(root.path().join("photos")).unwrap();
        std::fs::create_dir(root.path().join("work")).unwrap();
        let (photo, file) = (root.path().join("photos/a.png"), root.path().join("work/a.dichroscope"));
        std::fs::copy(PHOTO, &photo).unwrap();
        let saved = workspace(&photo);
        let text = saved.to_json(&file).unwrap();
        assert!(text.contains("../photos/a.png") && text.contains("../photos/labels.png"), "{text}");
        std::fs::write(&file, text).unwrap();
        assert_eq!(Workspace::load(&file).unwrap(), saved);

        // The folder may be moved as a whole.
        let moved = tempfile::tempdir().unwrap();
        for part in ["photos", "work"] {
            std::fs::rename(root.path().join(part), moved.path().join(part)).unwrap();
        }
        let found = Workspace::load(&moved.path().join("work/a.dichroscope")).unwrap();
        assert_eq!(found.origin, Origin::File(moved.path().join("photos/a.png")));
        assert_eq!(found.elsewhere.labels, Some(moved.path().join("photos/labels.png")));
        std::fs::remove_file(moved.path().join("photos/a.png")).unwrap();
        let error = Workspace::load(&moved.path().join("work/a.dichroscope")).unwrap_err();
        assert!(error.contains("a.png is not there"), "{error}");
    }

    #[test]
    fn a_file_that_is_no_workspace_is_an_error_that_says_why() {
        let root = tempfile::tempdir().unwrap();
        let file = root.path().join("x.dichroscope");
        let assert_error = |text: Option<&str>, expected: &str| {
            if let Some(text) = text {
                std::fs::write(&file, text).unwrap();
            }
            let error = Workspace::load(&file).unwrap_err();
            assert!(error.starts_with(&file.display().to_string()) && error.contains(expected), "{error}");
        };
        assert_error(None, "cannot be read");
        assert_error(Some("{}"), "is no workspace");
        assert_error(Some(r#"{"schema": 7, "origin": {}}"#), "has schema 7, this program reads 1");
        let good = workspace(Path::new(PHOTO)).to_json(&file).unwrap();
        assert_error(Some(&good.replace("3.25", "-3.25")), "camera_noise");
        assert_error(Some(&good.replace("\"auto\"", "\"rec709\"")), "");
        assert_error(Some(&good[..good.len() / 2]), "is no workspace");
    }

    #[test]
    fn a_photograph_without_a_file_makes_no_workspace() {
        let message = State::default().workspace().unwrap_err();
        assert!(message.contains("open a photograph"), "{message}");
        let state = State { picture: Some(gray(&["."], 1)), ..State::default() };
        assert!(state.workspace().unwrap_err().contains("came without a file"));
    }

    #[test]
    fn photographs_are_named_relative_to_the_workspace() {
        let relative = |photo: &str, file: &str| relative_to_file(Path::new(photo), Path::new(file));
        assert_eq!(relative("/a/b/c.png", "/a/b/w.d"), Path::new("c.png"));
        assert_eq!(relative("/a/b/c.png", "/a/x/y/w.d"), Path::new("../../b/c.png"));
        assert_eq!(relative("c.png", "w.d"), Path::new("c.png"));
        assert_eq!(without_dot_components(Path::new("/a/./b/../c/d/../e.png")), Path::new("/a/c/e.png"));
    }
}
