//! The kinds of dialogs that ask for a path.

use crate::view::ElsewhereKind;

/// The dialogs of the window, by what a person chooses in the dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialog {
    /// A photograph to open.
    Open,
    /// A parameter file to read.
    LoadParameters,
    /// The path to write the parameters to.
    SaveParameters,
    /// A workspace to read.
    OpenWorkspace,
    /// A picture that another program made of the open photograph.
    OpenElsewhere(ElsewhereKind),
    /// The path to write the workspace to.
    SaveWorkspace,
    /// The kind of an export, and the path to write.
    Export,
}

impl Dialog {
    /// The title of the dialog.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::LoadParameters => "Load parameters",
            Self::SaveParameters => "Save parameters",
            Self::OpenWorkspace => "Open workspace",
            Self::OpenElsewhere(ElsewhereKind::Labels) => "Open a label map of another program",
            Self::OpenElsewhere(ElsewhereKind::Diffuse) => "Open a diffuse picture of another program",
            Self::SaveWorkspace => "Save workspace",
            Self::Export => "Export",
        }
    }

    /// The text of the button that confirms.
    pub const fn button(self) -> &'static str {
        match self {
            Self::Open | Self::OpenWorkspace | Self::OpenElsewhere(_) => "Open",
            Self::LoadParameters => "Load",
            Self::SaveParameters | Self::SaveWorkspace => "Save",
            Self::Export => "Export",
        }
    }

    /// Whether the dialog reads a file; other dialogs write one.
    pub const fn reads(self) -> bool {
        matches!(self, Self::Open | Self::LoadParameters | Self::OpenWorkspace | Self::OpenElsewhere(_))
    }
}
