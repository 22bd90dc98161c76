//! The commands of a person. A [`Command`] is the only way in which panels change a [`super::State`]; the reports of workers are
//! a type of their own, which no panel can make.

use super::{DebugCommand, Export, Gesture, Question, Severity, Switching};
use crate::params::{AmbientSetting, Method, Parameter, Params, Reading, Setting, Switch};
use crate::photo::ReadOptions;
use crate::raster::Mask;
use crate::truth::sample::SampleSet;
use crate::view::{
    CubeSettings, ElsewhereKind, ElsewherePaths, GeometrySettings, ImageSettings, Item, Origin, Picture,
    PlaneSettings, ProfileLine, Theme,
};
use std::path::PathBuf;
use std::sync::Arc;

/// A change that a person wants: one of five kinds, each with a reducer of its own.
#[derive(Clone, Debug)]
pub enum Command {
    /// Change the document.
    Edit(Edit),
    /// Change how results are shown.
    View(ViewCommand),
    /// Start or stop work in the background.
    Job(JobCommand),
    /// Ask a question about a pixel.
    Ask(Question),
    /// Change the debugger.
    Debug(DebugCommand),
}

/// A change of the document. All but the first four are steps of the undo history.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Take back the last step.
    Undo,
    /// Take back the last undo.
    Redo,
    /// Go to an entry of the history, by its index from the earliest on: several steps of undo or redo at once.
    GoTo(usize),
    /// End this gesture, if it is the one under way: the next change is a step of its own.
    EndGesture(Gesture),

    /// Set one parameter.
    SetParameter(Parameter, Setting, Option<Gesture>),
    /// Choose the algorithm; parameters at the other method's defaults follow.
    SetMethod(Method),
    /// Switch a refinement of the method in force.
    SetSwitch(Switch, bool),
    /// Switch a reading of the paper's method.
    SetReading(Reading, bool),
    /// Set all parameters, to those of a preset.
    SetParams(Box<Params>),
    /// Set the light's direction; none: the analysis finds it.
    PinIlluminant(Option<[f64; 3]>, Option<Gesture>),
    /// Set the second lamp's direction; none: the analysis seeks a second lamp.
    PinSecondIlluminant(Option<[f64; 3]>, Option<Gesture>),
    /// Set how ambient light is treated.
    SetAmbient(AmbientSetting, Option<Gesture>),
    /// Restrict the analysis to these pixels; none: analyze the whole picture.
    RestrictTo(Option<Arc<Mask>>),
    /// Fit a skewed T to these pixels: the method by hand, restricted to them (section 6).
    FitSkewedT(Arc<Mask>),

    /// Select an item, or nothing.
    Select(Option<Item>),
    /// Mark pixels with a tool.
    Mark(Arc<Mask>, Combine, Option<Gesture>),
    /// Mark exactly the pixels that are not marked.
    InvertMarked,
    /// Change the named marks.
    NamedMark(NamedMarkEdit),
    /// Unmark all pixels and select nothing; named marks stay.
    ClearSelection,
}

/// A change of the named marks, which are counted from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamedMarkEdit {
    /// Keep the marked pixels as a new mark, which the tools change from now on.
    Keep,
    /// Let the tools change this mark.
    Activate(usize),
    /// Let the tools change no mark, and mark nothing.
    Release,
    /// Give this mark another name.
    Rename(usize, String),
    /// Give this mark another color.
    Recolor(usize),
    /// Remove this mark.
    Remove(usize),
}

/// A change of how results are shown. Such a change is no step of the undo history and needs no analysis.
#[derive(Clone, Debug)]
pub enum ViewCommand {
    /// The pointer is over this item, or over none.
    Hover(Option<Item>),
    /// The pointer is near these color bins in the color space view.
    HoverBins(Vec<u32>),
    /// Keep the newest result to compare with (true), or drop the kept one (false).
    Pin(bool),
    /// Show the pinned result (true) or the newest (false).
    ShowPinned(bool),
    /// Set the image view.
    Image(ImageSettings),
    /// Set the color space view.
    Cube(CubeSettings),
    /// Set the plane view.
    Plane(PlaneSettings),
    /// Set the sphere of section 3.
    Geometry(GeometrySettings),
    /// Set the line of the profile.
    Profile(ProfileLine),
    /// Set the light or the dark theme.
    Theme(Theme),
    /// Set the size of all texts and controls, in multiples of the size at first.
    TextSize(f32),
    /// Set the arrangement of the panels, in the window's own format.
    Layout(String),
    /// Set the camera of the color space view, in the window's own format.
    Camera(String),
    /// Show a notice with this text.
    Notify(Severity, String),
    /// Remove the notice with this id.
    Dismiss(u64),
    /// Show the next open photograph in the second view of the picture (true), or a second layer of the same one (false).
    ComparePhotographs(bool),
    /// Close the label map or the diffuse picture of another program.
    CloseElsewhere(ElsewhereKind),
    /// Forget the photographs opened before.
    ForgetRecent,
}

/// Work in the background.
#[derive(Clone, Debug)]
pub enum JobCommand {
    /// Read a photograph and show it.
    Open(Origin),
    /// Open several files, in this order, each as what its name says: photographs, of which the last is shown; then a workspace; and
    /// pictures of another program, which are held against the photograph that is shown in the end.
    OpenFiles(Vec<Origin>),
    /// As [`Self::OpenFiles`], but of several photographs the first that can be read is shown, and the others follow it in their order.
    OpenFilesFirstShown(Vec<Origin>),
    /// As [`Self::OpenFilesFirstShown`], where a path may also be that of a folder: the photographs in it are opened.
    OpenFolders(Vec<Origin>),
    /// Read a photograph and show it, and then read pictures that another program made of it.
    OpenBeside(Origin, ElsewherePaths),
    /// Read a picture that another program made of the open photograph, and show it.
    OpenElsewhere(ElsewhereKind, PathBuf),
    /// Show another open photograph.
    Switch(Switching),
    /// Close an open photograph. In place of the photograph that is shown, the next one is shown; the only one stays.
    ClosePhotograph(Arc<Picture>),
    /// Read the open photograph again with these options.
    ReadAs(ReadOptions),
    /// Read a workspace file, then its photograph, and restore the rest of the workspace.
    OpenWorkspace(PathBuf),
    /// Read parameters from a TOML file.
    LoadParams(PathBuf),
    /// Write a file or a folder.
    Export(Export),
    /// Analyze the open photograph with the present parameters.
    Analyze,
    /// Cancel the analysis under way, or the recording of its decisions. The last complete result stays.
    CancelAnalysis,
    /// Stop the export under way.
    CancelExport,
    /// Show the sentence about a panic of the window, and save the workspace beside the photograph.
    Rescue(String),
}

impl JobCommand {
    /// Opens the scenes of a set of samples together. The first is shown, and the others follow it in their order.
    pub fn open_samples(set: &SampleSet) -> Self {
        Self::OpenFilesFirstShown(set.scenes.iter().map(|&name| Origin::Sample(name.to_owned())).collect())
    }
}

impl From<Edit> for Command {
    fn from(edit: Edit) -> Self {
        Self::Edit(edit)
    }
}

impl From<ViewCommand> for Command {
    fn from(command: ViewCommand) -> Self {
        Self::View(command)
    }
}

impl From<JobCommand> for Command {
    fn from(command: JobCommand) -> Self {
        Self::Job(command)
    }
}

impl From<Question> for Command {
    fn from(question: Question) -> Self {
        Self::Ask(question)
    }
}

impl From<DebugCommand> for Command {
    fn from(command: DebugCommand) -> Self {
        Self::Debug(command)
    }
}

/// How newly marked pixels combine with the pixels marked before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Combine {
    /// Only the new pixels.
    #[default]
    Replace,
    /// The pixels of both (Shift).
    Union,
    /// The pixels marked before without the new ones (Alt).
    Subtract,
}
