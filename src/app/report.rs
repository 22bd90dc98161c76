//! The reports of workers. Only [`super::Application`] applies reports to the state.

use super::files_to_open::Note;
use super::{Document, Preview, WhatIfProgress, WhatIfRequest, Workspace};
use crate::analysis::Stage;
use crate::params::Params;
use crate::trace::Replay;
use crate::view::{Elsewhere, ElsewhereKind, ElsewherePaths, Origin, Picture, ResultSnapshot};
use std::path::PathBuf;
use std::sync::Arc;

/// A workspace that was written: of which photograph, and the document as it was written.
#[derive(Clone, Debug)]
pub(super) struct WrittenWorkspace {
    pub(super) path: PathBuf,
    pub(super) picture: Arc<Picture>,
    pub(super) document: Document,
}

/// A report of a worker.
#[derive(Clone, Debug)]
pub(super) enum Report {
    /// A photograph was read.
    Opened(Arc<Picture>),
    /// Photographs that are opened together were read.
    OpenedTogether {
        /// In the order of opening: a photograph, or the sentence that says why the photograph could not be read.
        photographs: Vec<Result<Arc<Picture>, String>>,
        /// Pictures of another program, still to be read.
        elsewhere: ElsewherePaths,
        /// The workspace, still to be read.
        workspace: Option<PathBuf>,
    },
    /// The photographs in folders were found, which are opened next, and sentences about folders that hold none.
    FoundInFolders(Vec<Origin>, Vec<Note>),
    /// A photograph could not be read: the sentence to show.
    OpenFailed(String),
    /// A parameter file was read.
    ParamsRead(Box<Params>),
    /// A workspace file was read; its photograph is still to be read.
    WorkspaceRead {
        /// The contents of the file.
        workspace: Box<Workspace>,
        /// The file.
        path: PathBuf,
    },
    /// A picture that another program made of a photograph was read.
    ElsewhereRead {
        /// What the picture is.
        kind: ElsewhereKind,
        /// The picture alone, with its file.
        read: Box<Elsewhere>,
        /// The photograph that the picture was read for.
        picture: Arc<Picture>,
        /// Whether the image view is to show the picture.
        shows: bool,
    },
    /// A picture that another program made of a photograph could not be read.
    ElsewhereFailed {
        /// What the picture should have been.
        kind: ElsewhereKind,
        /// Its file.
        path: PathBuf,
        /// The photograph that the picture was to be read for.
        picture: Arc<Picture>,
        /// The sentence to show.
        reason: String,
    },
    /// Work could not be done: the sentence to show.
    Failed(String),
    /// Work ended by a panic, an error of the program.
    Panicked {
        /// The work that ended.
        work: Work,
        /// The text of the panic.
        reason: String,
    },
    /// The workspace was written after a panic: its path, or the sentence that says why the workspace was not written.
    Rescued(Result<PathBuf, String>),
    /// The analysis began a stage.
    Progress {
        /// Number of the request.
        generation: u64,
        /// The stage that begins.
        stage: Stage,
    },
    /// A result, or a part of one.
    Analyzed(Arc<ResultSnapshot>),
    /// The result for the working picture, before the pass at full resolution.
    Preview(Preview),
    /// The recording of the decisions of a result began a stage.
    Recording {
        /// Number of the result.
        generation: u64,
        /// The stage that begins.
        stage: Stage,
    },
    /// The decisions of a result were recorded.
    Traced {
        /// Number of the result.
        generation: u64,
        /// A cursor at the end of the trace.
        replay: Box<Replay>,
    },
    /// An export has written some of its files.
    Exporting {
        /// Number of files written so far.
        done: usize,
        /// Number of all files.
        total: usize,
    },
    /// An export ended.
    Exported {
        /// The sentence to show.
        outcome: Result<String, String>,
        /// What was written, if the export is a workspace.
        workspace: Option<Box<WrittenWorkspace>>,
    },
    /// A what-if job made progress or ended.
    WhatIf(WhatIfRequest, WhatIfProgress),
}

/// The work of a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Work {
    /// Reading a photograph.
    Photograph,
    /// Finding the photographs in a folder.
    Folder,
    /// Reading a parameter file or a workspace file.
    File,
    /// Analyzing, recording decisions, and scoring.
    Analysis,
    /// Writing an export.
    Export,
    /// The search for parameters that change a pixel's region.
    WhatIf,
    /// Writing the workspace after a panic.
    Rescue,
}

impl Work {
    /// The name of the work, as the subject of a sentence.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Photograph => "reading the photograph",
            Self::Folder => "reading the folder",
            Self::File => "reading the file",
            Self::Analysis => "the analysis",
            Self::Export => "the export",
            Self::WhatIf => "the search for what would change the pixel",
            Self::Rescue => "saving the workspace",
        }
    }
}
