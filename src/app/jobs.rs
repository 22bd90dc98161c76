//! What takes longer than a frame: one analysis, and exports.

use super::{Document, State, Workspace};
use crate::analysis::Stage;
use crate::view::{ImageSettings, Picture, ResultSnapshot};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Something to be written.
#[derive(Clone, Debug, PartialEq)]
pub enum Export {
    /// The files of `analyze`, in this folder.
    Result {
        /// The folder, replaced whole.
        folder: PathBuf,
        /// Whether a folder that is no earlier result may be replaced.
        force: bool,
    },
    /// The photograph without its highlights.
    Matte {
        /// The file; its extension is that of the photograph's format.
        path: PathBuf,
        /// Share of the surface reflection that stays, 0…1.
        keep_surface: f64,
    },
    /// The selection as a mask (`.png`), its pixels as a table (`.csv`) or as points (`.ply`).
    Selection {
        /// The file; its extension says which.
        path: PathBuf,
    },
    /// The area that the analysis is restricted to, as a mask for `--area`.
    Area {
        /// The file, a PNG.
        path: PathBuf,
    },
    /// The regions table, tab separated.
    Regions {
        /// The file.
        path: PathBuf,
    },
    /// The profile's numbers.
    Profile {
        /// The file.
        path: PathBuf,
    },
    /// What the image view shows, a pixel a pixel.
    Layer {
        /// The file.
        path: PathBuf,
        /// What it shows, and how.
        settings: ImageSettings,
    },
    /// A picture that a view has drawn.
    Picture {
        /// The file, a PNG.
        path: PathBuf,
        /// Columns and rows.
        size: [u32; 2],
        /// sRGB and alpha, row-major.
        rgba: Arc<[u8]>,
    },
    /// The parameters as TOML.
    Parameters {
        /// The file.
        path: PathBuf,
    },
    /// The workspace.
    Workspace {
        /// The file.
        path: PathBuf,
    },
}

impl Export {
    /// The file or folder that it makes.
    pub fn path(&self) -> &std::path::Path {
        match self {
            Self::Result { folder, .. } => folder,
            Self::Matte { path, .. }
            | Self::Selection { path }
            | Self::Area { path }
            | Self::Regions { path }
            | Self::Profile { path }
            | Self::Layer { path, .. }
            | Self::Picture { path, .. }
            | Self::Parameters { path }
            | Self::Workspace { path } => path,
        }
    }
}

/// The work that goes on.
#[derive(Clone, Copy, Debug, Default)]
pub struct JobState {
    /// The analysis.
    pub analysis: Option<Job>,
    /// Reading a photograph.
    pub reading: Option<Job>,
    /// An export.
    pub export: Option<Job>,
}

/// One piece of work.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// When it began.
    pub since: Instant,
    /// The stage it is at, of an analysis.
    pub stage: Option<Stage>,
    /// Files written, of how many, of an export.
    pub files: Option<(usize, usize)>,
}

impl Job {
    /// Work that begins.
    pub(super) fn now() -> Self {
        Self { since: Instant::now(), stage: None, files: None }
    }
}

/// Asks a writer to stop.
#[derive(Debug, Default)]
pub(super) struct Stop(AtomicBool);

impl Stop {
    pub(super) fn stop(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub(super) fn stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What there is to write, as it was when the writing was asked for.
#[derive(Clone, Debug)]
pub(super) struct ExportInput {
    pub(super) picture: Option<Arc<Picture>>,
    pub(super) shown: Option<Arc<ResultSnapshot>>,
    pub(super) pinned: Option<Arc<ResultSnapshot>>,
    pub(super) document: Document,
    pub(super) selected_region: Option<u16>,
    /// Ends of the profile's line, pixels.
    pub(super) profile: Option<[[f32; 2]; 2]>,
    pub(super) workspace: Result<Workspace, String>,
}

impl ExportInput {
    pub(super) fn of(state: &State) -> Self {
        Self {
            picture: state.picture.clone(),
            shown: state.shown().cloned(),
            pinned: state.pinned.clone(),
            document: state.document.clone(),
            selected_region: state.selected_region(),
            profile: state.profile_ends(),
            workspace: Workspace::of(state),
        }
    }
}
