//! Photographs that are open beside the one that is shown, and the change from one to another.

use super::awaited::Awaited;
use super::{Document, History};
use crate::raster::PixelIndex;
use crate::view::{Elsewhere, Picture, ResultSnapshot};
use std::path::PathBuf;
use std::sync::Arc;

/// Largest number of photographs that are kept open beside the one that is shown; of more, one is closed.
pub(super) const MOST_OTHERS: usize = 7;

/// An open photograph that is not shown: what a person decided about it, and its last results.
#[derive(Clone, Debug)]
pub struct OpenPhotograph {
    /// The photograph.
    pub picture: Arc<Picture>,
    /// Parameters, area and selection.
    pub document: Document,
    /// The steps that can be undone and redone.
    pub history: History,
    /// The document as it was when the photograph was opened, or when the workspace was saved last.
    pub(super) saved: Document,
    /// The last result.
    pub newest: Option<Arc<ResultSnapshot>>,
    /// The pinned result.
    pub pinned: Option<Arc<ResultSnapshot>>,
    /// What another program made of the photograph.
    pub elsewhere: Option<Arc<Elsewhere>>,
    /// The light that the analysis last found by itself, unit.
    pub found_light: Option<[f64; 3]>,
    /// The workspace file.
    pub workspace_path: Option<PathBuf>,
    /// The pixel whose history is shown.
    pub(super) explained_pixel: Option<PixelIndex>,
    /// What is done as soon as its next result is complete.
    pub(super) awaited: Awaited,
}

impl OpenPhotograph {
    /// Whether parameters, marks or area are in no workspace that was saved.
    pub fn is_unsaved(&self) -> bool {
        self.document.holds_other_work(&self.saved)
    }
}

/// The photograph to show in place of the present one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Switching {
    /// The next one in the circle of open photographs.
    Next,
    /// The one before.
    Previous,
    /// The one at this index of [`super::State::others`].
    To(usize),
}
