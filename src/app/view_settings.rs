//! Settings of all views. They are part of a workspace, not of the undo history.

use super::DebugSettings;
use crate::view::{CubeSettings, GeometrySettings, ImageSettings, PlaneSettings, ProfileLine, Theme};
use serde::{Deserialize, Serialize};

/// The settings of every view.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewSettings {
    /// The image view.
    pub image: ImageSettings,
    /// The color space view without its camera.
    pub cube: CubeSettings,
    /// The plane view.
    pub plane: PlaneSettings,
    /// The sphere of section 3.
    pub geometry: GeometrySettings,
    /// The line of the profile.
    pub profile: ProfileLine,
    /// The step debugger.
    pub debug: DebugSettings,
    /// Whether the pinned result is shown in place of the newest (A/B).
    pub show_pinned: bool,
    /// The light or the dark theme.
    pub theme: Theme,
    /// The size of all texts and controls, in multiples of the size at first; none: that size.
    pub text_size: Option<f32>,
    /// The arrangement of the panels, in the window's own format; empty: the first arrangement.
    pub layout: String,
    /// The camera of the color space view, in the window's own format; empty: the initial camera.
    pub camera: String,
}
