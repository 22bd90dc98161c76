//! How the panels show what there is. Part of a workspace, not of the undo history.

use super::DebugSettings;
use crate::view::{CubeSettings, ImageSettings, PlaneSettings, ProfileLine, Theme};
use serde::{Deserialize, Serialize};

/// The settings of every view.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewSettings {
    /// The image view.
    pub image: ImageSettings,
    /// The color space view, but for its camera.
    pub cube: CubeSettings,
    /// The plane view.
    pub plane: PlaneSettings,
    /// Where the profile runs.
    pub profile: ProfileLine,
    /// The step debugger.
    pub debug: DebugSettings,
    /// Whether the pinned result is shown in place of the newest (A/B).
    pub show_pinned: bool,
    /// Dark or light.
    pub theme: Theme,
    /// How panels and cameras are arranged, in words that only the window understands; empty: as usual.
    pub layout: String,
    /// The color space view's camera, as the window writes it; empty: the usual one.
    pub camera: String,
}
