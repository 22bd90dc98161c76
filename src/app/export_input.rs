//! The input of an export, and the options of an export.

use super::{Document, State, Workspace};
use crate::raster::RegionId;
use crate::view::{Elsewhere, ImageSettings, Layer, Picture, ResultSnapshot};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Options of an export. Each kind of export reads the options that it needs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExportOptions {
    /// Share of the surface reflection that stays in the photograph without highlights, also in the folder of a result, 0…1.
    pub keep_surface: f64,
    /// Whether a folder that is no earlier result may be replaced.
    pub force: bool,
    /// The picture that a view has drawn.
    pub drawn: Option<DrawnPicture>,
    /// The layer to write; none: the layer that the image view shows.
    pub layer: Option<Layer>,
    /// The region whose pixels are written by an export of pixels; none: the marked pixels.
    pub region: Option<RegionId>,
}

/// A picture that a view has drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPicture {
    /// Columns and rows.
    pub size: [u32; 2],
    /// sRGB and alpha, row-major.
    pub rgba: Arc<[u8]>,
}

/// The parts of the state that exports are made from, as they were when the export was requested.
#[derive(Clone, Debug)]
pub(super) struct ExportInput {
    pub(super) picture: Option<Arc<Picture>>,
    pub(super) shown: Option<Arc<ResultSnapshot>>,
    pub(super) pinned: Option<Arc<ResultSnapshot>>,
    pub(super) elsewhere: Option<Arc<Elsewhere>>,
    /// Whether the result that the window shows is being computed anew.
    pub(super) is_analyzing: bool,
    /// Whether the result that the window shows, if any, belongs to other parameters, as the analysis was canceled.
    pub(super) lacks_result: bool,
    pub(super) document: Document,
    /// The settings of the image view.
    pub(super) image: ImageSettings,
    pub(super) selected_region: Option<RegionId>,
    /// Ends of the profile's line, pixels.
    pub(super) profile: Option<[[f32; 2]; 2]>,
    pub(super) workspace: Result<Workspace, String>,
    /// The files of the photographs that are open, and of the pictures of other programs.
    pub(super) open_files: Vec<PathBuf>,
}

impl ExportInput {
    /// The parts of `state`.
    pub(super) fn of(state: &State) -> Self {
        Self {
            picture: state.picture.clone(),
            shown: state.shown().cloned(),
            pinned: state.pinned.clone(),
            elsewhere: state.elsewhere.clone(),
            is_analyzing: state.awaits_result(),
            lacks_result: state.lacks_result() && !state.shows_pinned(),
            document: state.document.clone(),
            image: state.view.image.clone(),
            selected_region: state.selected_region(),
            profile: state.profile_ends(),
            workspace: state.workspace(),
            open_files: open_files(state),
        }
    }
}

/// The files of the photographs that are open, and of the pictures of other programs.
pub(super) fn open_files(state: &State) -> Vec<PathBuf> {
    let pictures = state.picture.iter().chain(state.others.iter().map(|other| &other.picture));
    let photographs = pictures.filter_map(|picture| picture.origin.path());
    let elsewhere =
        state.elsewhere.iter().chain(state.others.iter().filter_map(|other| other.elsewhere.as_ref()));
    let foreign = elsewhere.flat_map(|all| all.paths.files().map(|(_, path)| path));
    photographs.chain(foreign).map(Path::to_path_buf).collect()
}
