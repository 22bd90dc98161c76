//! Settings that are kept from one session to the next.

use super::{State, ViewSettings};
use crate::export::write_file;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// The settings of the views, and the photographs opened before.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Theme, layout and views, without what belongs to one photograph.
    pub view: ViewSettings,
    /// Photographs opened before, newest first.
    pub recent: Vec<PathBuf>,
}

impl Settings {
    /// The settings of a state.
    pub fn of(state: &State) -> Self {
        let mut view = state.view.clone();
        (view.image.center_px, view.image.zoom) = (None, None);
        view.camera.clear();
        (view.profile, view.show_pinned) = (crate::view::ProfileLine::Row, false);
        Self { view, recent: state.recent.clone() }
    }

    /// The file in the platform's folder for settings; none where the platform has no such folder.
    #[cfg(feature = "gui")]
    pub fn path() -> Option<PathBuf> {
        let folders = directories::ProjectDirs::from("", "", "dichroscope")?;
        Some(folders.config_dir().join("settings.json"))
    }

    /// The settings in a file; the default ones, with a warning, where the file cannot be used.
    pub fn load(path: &Path) -> (Self, Option<String>) {
        let unusable = |reason: String| {
            let text = format!("{}: {reason}; the usual settings are in force", path.display());
            (Self::default(), Some(text))
        };
        match std::fs::read(path) {
            Ok(text) => match serde_json::from_slice(&text) {
                Ok(settings) => (settings, None),
                Err(error) => unusable(format!("these are no settings ({error})")),
            },
            Err(error) if error.kind() == ErrorKind::NotFound => (Self::default(), None),
            Err(error) => unusable(format!("cannot be read: {error}")),
        }
    }

    /// Writes the file, and makes its folder where there is none.
    ///
    /// # Errors
    /// A sentence that names the file.
    pub fn save(&self, path: &Path) -> Result<(), String> {
        let failed = |reason: String| format!("{}: settings cannot be kept: {reason}", path.display());
        let text = serde_json::to_string_pretty(self).map_err(|error| failed(error.to_string()))?;
        write_file(path, (text + "\n").as_bytes()).map_err(|error| failed(super::write::error_chain(&error)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Theme;

    #[test]
    fn saved_settings_are_read_back() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("deep/settings.json");
        assert_eq!(Settings::load(&path), (Settings::default(), None));
        let mut state = State { recent: vec!["a.png".into()], ..State::default() };
        (state.view.theme, state.view.layout) = (Theme::Light, "tabs".into());
        (state.view.image.zoom, state.view.image.opacity) = (Some(3.0), 0.5);
        let settings = Settings::of(&state);
        settings.save(&path).unwrap();
        let (loaded, warning) = Settings::load(&path);
        assert_eq!((&loaded, warning), (&settings, None));
        assert_eq!((loaded.view.image.zoom, loaded.view.theme), (None, Theme::Light));
    }

    #[test]
    fn a_broken_file_is_a_warning_and_the_defaults() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("settings.json");
        for text in ["", "{", r#"{"view": 3}"#] {
            std::fs::write(&path, text).unwrap();
            let (settings, warning) = Settings::load(&path);
            assert_eq!(settings, Settings::default());
            assert!(warning.unwrap().contains("settings.json"), "{text}");
        }
        std::fs::write(&path, r#"{"view": {"theme": "Light"}, "later": 1}"#).unwrap();
        assert_eq!(Settings::load(&path).0.view.theme, Theme::Light);
        assert!(Settings::load(root.path()).1.is_some(), "a folder is no file");
        assert!(Settings::default().save(root.path()).unwrap_err().contains("cannot be kept"));
    }
}
