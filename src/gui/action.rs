//! What keys, menus and buttons do: the vocabulary that shortcuts, menus, toolbars and panels share.

use super::cube_choices::NamedView;
use super::pane::Pane;
use crate::app::{Direction, StepUnit, Switching};
use crate::params::{Method, Preset};
use crate::raster::RegionId;
use crate::trace::Kind;
use crate::view::{ArrangementKind, ColorBy, ColorSpace, ElsewhereKind, Layer, Theme, Tool};

/// What a key or a menu does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Open the dialog for a photograph.
    Open,
    /// Open the dialog for a workspace.
    OpenWorkspace,
    /// Open the dialog for a picture that another program made of the open photograph.
    OpenElsewhere(ElsewhereKind),
    /// Close such a picture.
    CloseElsewhere(ElsewhereKind),
    /// Open the export dialog.
    Export,
    /// Open the export dialog for a single file of a layer.
    ExportLayer(Layer, LayerFile),
    /// Open the export dialog for the pixels of a set.
    ExportPixels(PixelSet),
    /// Open the dialog that saves the workspace to another file.
    SaveWorkspaceAs,
    /// Open the dialog that reads parameters from a file.
    LoadParameters,
    /// Open the dialog that writes the parameters to a file.
    SaveParameters,
    /// Copy the `dichroscope analyze` call that reproduces what is on the screen.
    CopyCommandLine,
    /// Open a sample scene, by its index in the list of scenes.
    Sample(usize),
    /// Open the sample scenes of three lamps together.
    ThreeLamps,
    /// Read the photograph with an encoding, by its index in the list of encodings that the menu offers.
    ReadAs(usize),
    /// Forget the photographs that were opened before.
    ForgetRecent,
    /// Save the workspace: to its file, or where the dialog says when it has none.
    Save,
    /// Show another open photograph.
    Switch(Switching),
    /// Stop the export under way.
    CancelExport,
    /// Close the photograph that is shown.
    ClosePhotograph,
    /// Compare the next open photograph in the second view, or no longer.
    ComparePhotographs,
    /// Close the window.
    Quit,
    /// Show a panel, in front of the other tabs.
    Show(Pane),
    /// Arrange all panels as at first.
    ShowAll,
    /// Take back the last step.
    Undo,
    /// Take back the last undo.
    Redo,
    /// Mark everything that is not marked.
    Invert,
    /// Mark the pixels of the selected region.
    MarkRegion,
    /// Keep the marked pixels under a name.
    KeepMark,
    /// Let the tools change no named mark any more.
    ReleaseMark,
    /// Fit a skewed T to the marked pixels.
    FitSkewedT,
    /// Analyze only the marked pixels.
    AnalyzeMarked,
    /// Analyze the whole picture again.
    AnalyzeAll,
    /// Analyze with the present parameters.
    Analyze,
    /// Cancel the analysis, or the recording of its decisions.
    CancelAnalysis,
    /// Analyze by a method.
    Method(Method),
    /// Take the parameters of a column of table 6.
    Preset(Preset),
    /// Take the default of every parameter and switch of the method in force.
    ResetParameters,
    /// Keep a lamp that was found, or let it be found again.
    PinLamp(Lamp),
    /// Let the ambient light be found, or take none.
    AmbientAuto,
    /// Search for the parameters that would change the fate of the clicked pixel, or stop the search.
    FindWhatIf,
    /// Select nothing.
    Escape,
    /// Select the region after (`true`) or before the selected one.
    Region(bool),
    /// Show this layer in the image view.
    Layer(Layer),
    /// Show one layer or two in the image view.
    Arrange(ArrangementKind),
    /// Show this layer as the second one of the image view.
    SecondLayer(Layer),
    /// Use this tool in the image view, and in the color space view where it has the tool.
    Tool(Tool),
    /// Change what the color space view shows, or from where.
    Cube(CubeAction),
    /// Color the points of the plane view by what they are to the region (`true`), or as they were measured.
    PlaneByLabel(bool),
    /// Use this tool in the plane view.
    PlaneTool(Tool),
    /// Lay the profile along the column (`true`) or the row of the selected or hovered pixel.
    Profile(bool),
    /// Draw the sphere of section 3 in the color space and the plane, or no longer.
    DrawSphere,
    /// Copy the table of the regions.
    CopyRegions,
    /// Copy the numbers of the profile.
    CopyProfile,
    /// Keep the result to compare with, or drop the kept one.
    Pin,
    /// Keep the newest result in the place of the kept one.
    PinAnew,
    /// Go to the first decision in which the pinned and the newest analysis differ.
    FirstDifference,
    /// Switch between the pinned result and the newest.
    Swap,
    /// Fit the whole picture into the image view.
    Fit,
    /// Show one pixel for each screen point.
    OneToOne,
    /// Zoom the image view, or move the picture in it, by one step.
    View(ViewStep),
    /// Switch between outlines and fills.
    Outline,
    /// Lock readout and inspector to the selected pixel or region, or let them follow the pointer.
    LockReadout,
    /// Switch between the light and the dark theme.
    Theme,
    /// Use a theme.
    UseTheme(Theme),
    /// Change the size of all texts and controls.
    TextSize(TextStep),
    /// Move the debugger's cursor, or start or stop recording.
    Debug(DebugAction),
    /// Remove all notices.
    DismissNotices,
    /// Show every action by its name.
    Palette,
    /// Open the first menu of the menu bar, or close the open one.
    Menus,
    /// Show the list of keys.
    Help,
}

impl Action {
    /// Whether the action opens a field for text.
    pub const fn asks_for_text(self) -> bool {
        matches!(
            self,
            Self::Open
                | Self::OpenWorkspace
                | Self::OpenElsewhere(_)
                | Self::Export
                | Self::ExportLayer(..)
                | Self::ExportPixels(_)
                | Self::SaveWorkspaceAs
                | Self::LoadParameters
                | Self::SaveParameters
                | Self::Palette
        )
    }
}

/// A change of the size of all texts and controls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextStep {
    /// A tenth larger.
    Larger,
    /// A tenth smaller.
    Smaller,
    /// As large as at first.
    AsAtFirst,
}

/// A step of the image view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewStep {
    /// Enlarge the picture.
    ZoomIn,
    /// Reduce the picture.
    ZoomOut,
    /// Show more of the left.
    Left,
    /// Show more of the right.
    Right,
    /// Show more of the top.
    Up,
    /// Show more of the bottom.
    Down,
}

/// A change of the color space view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CubeAction {
    /// Color the points by this.
    ColorBy(ColorBy),
    /// Show this space.
    Space(ColorSpace),
    /// Move the camera to a named view.
    View(NamedView),
    /// Switch between perspective and orthographic projection.
    Perspective,
    /// Switch a shape or a look of the points, by its index in the list of boxes.
    Box(usize),
    /// Keep the camera when another region is selected, or no longer.
    Lock,
}

/// One of the two lamps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lamp {
    /// The light.
    First,
    /// The second lamp.
    Second,
}

/// Pixels that are exported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelSet {
    /// The marked pixels.
    Marked,
    /// The pixels of a region.
    Region(RegionId),
    /// The pixels of the selected region.
    SelectedRegion,
}

/// A kind of file for a single layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerFile {
    /// The layer as it is shown, 8 bits a band.
    Png,
    /// The layer's numbers as 32-bit floats, with channels.
    Exr,
    /// The layer's numbers as an array of NumPy.
    Npy,
}

impl LayerFile {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Png, Self::Exr, Self::Npy];

    /// The name in menus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Exr => "OpenEXR",
            Self::Npy => "NumPy array",
        }
    }

    /// The extension of the file, without a dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
            Self::Npy => "npy",
        }
    }
}

/// What a key or a button does to the debugger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DebugAction {
    /// Play in this direction, or stop playing.
    Play(Direction),
    /// Move the cursor by one unit.
    Step(StepUnit, Direction),
    /// Move the cursor before the first step.
    Start,
    /// Move the cursor to the end, the result.
    End,
    /// Move into the next hypothesis or slice.
    Into,
    /// Move to the next breakpoint in this direction.
    Breakpoint(Direction),
    /// Set a breakpoint for the selected pixel or region, or take that one away.
    ToggleBreakpoint,
    /// Move to the next change of the selected item in this direction.
    Change(Direction),
    /// Move to the next event of a kind.
    Next(Kind),
    /// Begin anew at the end of the trace while playing, or stop there.
    Loop,
    /// Start or stop recording decisions.
    Record,
}
