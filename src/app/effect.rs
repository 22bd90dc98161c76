//! The work that a change of the state asks for. Reducers return effects; only [`super::Application`] carries effects out.

use super::{Export, FilesToOpen, WhatIfRequest};
use crate::photo::ReadOptions;
use crate::view::{ElsewhereKind, ElsewherePaths, Origin};
use std::path::PathBuf;

/// Work that a command or a report asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Analyze the picture with the document as it is now.
    Analyze,
    /// Record the decisions of that analysis.
    Trace,
    /// Cancel the analysis or the recording under way.
    CancelAnalysis,
    /// Search the parameters that would give a pixel another region.
    FindWhatIf(WhatIfRequest),
    /// Stop that search.
    StopWhatIf,
    /// Write the workspace beside the photograph, after a panic.
    Rescue,
    /// Read a photograph with these options.
    Read(Origin, ReadOptions),
    /// Read the photographs of files that are opened together; the other files are read when the photographs are open.
    ReadTogether(FilesToOpen),
    /// Find the photographs in folders that are opened, among files that are opened together with them.
    FindInFolders(Vec<Origin>),
    /// Read a picture that another program made of the open photograph.
    ReadElsewhere {
        /// What the picture is.
        kind: ElsewhereKind,
        /// The file.
        path: PathBuf,
        /// Whether the image view is to show the picture.
        shows: bool,
    },
    /// Read a parameter file.
    ReadParams(PathBuf),
    /// Read a workspace file.
    ReadWorkspace {
        /// The file.
        path: PathBuf,
        /// Pictures of another program for the photograph of the workspace, in place of those that the workspace names.
        elsewhere: ElsewherePaths,
    },
    /// Write a file or a folder.
    Write(Export),
    /// Stop the export under way.
    StopWriting,
}
