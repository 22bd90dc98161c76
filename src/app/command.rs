//! The only ways to change a [`super::State`].

use super::{Ask, DebugCommand, Export, Severity, Workspace};
use crate::analysis::Stage;
use crate::params::{AmbientSetting, Method, Parameter, Params, Setting, Switch};
use crate::photo::ReadOptions;
use crate::raster::Mask;
use crate::view::{
    CubeSettings, ImageSettings, Item, Origin, Picture, PlaneSettings, ProfileLine, ResultSnapshot, Theme,
};
use std::path::PathBuf;
use std::sync::Arc;

/// Changes with the same gesture are one step of the history, until [`Command::EndGesture`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Dragging a parameter's slider.
    Parameter(Parameter),
    /// Painting with the brush.
    Brush,
    /// Turning the pinned illuminant.
    Illuminant,
    /// Dragging a band of the ambient light.
    Ambient,
}

/// How newly marked pixels join those marked before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Combine {
    /// They take their place.
    #[default]
    Replace,
    /// Both (Shift).
    Union,
    /// Those before without these (Alt).
    Subtract,
}

/// A change.
#[derive(Clone, Debug)]
pub enum Command {
    /// Read a photograph and show it.
    Open(Origin),
    /// Read the open photograph again, its values understood in this way.
    ReadAs(ReadOptions),
    /// Read a workspace's photograph, and put everything back as it was when that has been read.
    Restore(Box<Workspace>),
    /// A photograph was read.
    Opened(Arc<Picture>),
    /// Work began or went on to a stage.
    Progress {
        /// The request.
        generation: u64,
        /// The stage that begins.
        stage: Stage,
    },
    /// A result, or a part of one.
    Analyzed(Arc<ResultSnapshot>),
    /// An export goes on.
    Exporting {
        /// Files written so far.
        done: usize,
        /// Files that it writes in all.
        total: usize,
    },
    /// An export ended, with the sentence to say.
    Exported(Result<String, String>),
    /// Reading failed.
    OpenFailed(String),

    /// Set one parameter.
    SetParameter(Parameter, Setting, Option<Gesture>),
    /// Choose the algorithm; parameters at the other method's defaults follow.
    SetMethod(Method),
    /// Switch a refinement.
    SetSwitch(Switch, bool),
    /// Set all parameters: a preset, or a file.
    SetParams(Box<Params>),
    /// Read parameters from a TOML file.
    LoadParams(PathBuf),
    /// Fix the light's direction, or let it be found.
    PinIlluminant(Option<[f64; 3]>, Option<Gesture>),
    /// Say what is to be done about ambient light.
    SetAmbient(AmbientSetting, Option<Gesture>),
    /// Restrict the analysis to these pixels, or lift the restriction.
    RestrictTo(Option<Arc<Mask>>),
    /// What follows is a step of its own.
    EndGesture,
    /// Take back the last step.
    Undo,
    /// Take back the last undo.
    Redo,

    /// The pointer is over this.
    Hover(Option<Item>),
    /// Select this.
    Select(Option<Item>),
    /// Mark pixels.
    Mark(Arc<Mask>, Combine, Option<Gesture>),
    /// Mark the pixels that are not.
    InvertMarked,
    /// Unmark and deselect all.
    ClearSelection,

    /// Keep the newest result to compare with, or let it go.
    Pin(bool),
    /// Show the pinned result (A) or the newest (B).
    ShowPinned(bool),
    /// Settings of the image view.
    Image(ImageSettings),
    /// Settings of the color space view.
    Cube(CubeSettings),
    /// Settings of the plane view.
    Plane(PlaneSettings),
    /// The line of the profile.
    Profile(ProfileLine),
    /// Dark or light.
    Theme(Theme),
    /// How panels and cameras are arranged, in words that only the window understands.
    Layout(String),
    /// The color space view's camera.
    Camera(String),

    /// Ask why, or what if.
    Ask(Ask),
    /// Change the debugger.
    Debug(DebugCommand),

    /// Write something.
    Export(Export),
    /// Stop writing.
    CancelExport,
    /// Open a workspace file.
    OpenWorkspace(PathBuf),
    /// Say something.
    Notify(Severity, String),
    /// Take a notice away.
    Dismiss(u64),
    /// Forget the photographs opened before.
    ForgetRecent,
}
