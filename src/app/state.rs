//! All there is to show.

use super::{Debugger, Document, History, JobState, ViewSettings, WhatIfJob, Workspace};
use crate::params::Params;
use crate::trace::Replay;
use crate::view::{Item, Picture, ResultSnapshot};
use std::path::PathBuf;
use std::sync::Arc;

/// All there is to show. Panels read it; only [`super::reduce()`] changes it.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// The open photograph.
    pub picture: Option<Arc<Picture>>,
    /// Parameters, pins and selection.
    pub document: Document,
    /// What can be undone.
    pub history: History,
    /// The newest result.
    pub newest: Option<Arc<ResultSnapshot>>,
    /// The result that was pinned to be compared with.
    pub pinned: Option<Arc<ResultSnapshot>>,
    /// What the pointer is over, in any panel.
    pub hover: Option<Item>,
    /// How things are shown.
    pub view: ViewSettings,
    /// The step debugger.
    pub debugger: Debugger,
    /// The pixel that was clicked last, if nothing else has been selected since: its history is told.
    pub(super) asked_pixel: Option<u32>,
    /// What would change a pixel's fate, as far as that has been asked.
    pub what_if_job: Option<WhatIfJob>,
    /// What goes on in the background.
    pub jobs: JobState,
    /// What a person should know, oldest first.
    pub notices: Vec<Notice>,
    /// Photographs opened before, newest first.
    pub recent: Vec<PathBuf>,
    /// Number of the newest request.
    pub generation: u64,
    pub(super) notices_so_far: u64,
    /// The workspace whose photograph is being read.
    pub(super) restoring: Option<Box<Workspace>>,
    /// What follows when a restored workspace's pinned result has been found anew.
    pub(super) after_pin: Option<AfterPin>,
}

/// What a restored workspace still lacks while its pinned result is found anew.
#[derive(Clone, Copy, Debug)]
pub(super) struct AfterPin {
    pub(super) params: Params,
    pub(super) item: Option<Item>,
    pub(super) show_pinned: bool,
}

impl State {
    /// The result that the panels show: the newest, or the pinned one where that is asked for.
    pub fn shown(&self) -> Option<&Arc<ResultSnapshot>> {
        match &self.pinned {
            Some(pinned) if self.view.show_pinned => Some(pinned),
            _ => self.newest.as_ref(),
        }
    }

    /// Whether what is shown was made from the parameters as they are.
    pub fn is_current(&self) -> bool {
        self.newest
            .as_ref()
            .is_some_and(|shown| shown.generation == self.generation && shown.stale_from.is_none())
    }

    /// The region that an item is or lies in, in the result shown.
    pub fn region_of(&self, item: Item) -> Option<u16> {
        let shown = self.shown()?;
        let labels = &shown.labels();
        let region = match item {
            Item::Region(region) => region,
            Item::Pixel(pixel) => *labels.as_slice().get(pixel as usize)?,
            Item::Window(_) | Item::Bin(_) => return None,
        };
        (region != 0 && usize::from(region) <= shown.analysis.intrinsic.regions.len()).then_some(region)
    }

    /// The ends of the profile's line, in pixels of the picture: through the hovered pixel, else through the selected one,
    /// else through the middle.
    pub fn profile_ends(&self) -> Option<[[f32; 2]; 2]> {
        let pixel = |item: Option<Item>| match item {
            Some(Item::Pixel(pixel)) => Some(pixel),
            _ => None,
        };
        let at = pixel(self.hover).or(pixel(self.document.selection.item));
        self.picture.as_ref().map(|picture| crate::view::profile_ends(self.view.profile, picture, at))
    }

    /// The pixel that is asked about: the selected one, or the one at which the selected region was clicked.
    pub fn asked_pixel(&self) -> Option<u32> {
        match self.document.selection.item {
            Some(Item::Pixel(pixel)) => Some(pixel),
            _ => self.asked_pixel,
        }
    }

    /// The cursor, where image, color space and tables show the instant that it stands at, and not the result.
    pub fn followed(&self) -> Option<&Replay> {
        let replay = self.debugger.stopped().filter(|_| self.view.debug.follow && !self.view.show_pinned)?;
        let (trace, picture) = (replay.trace(), self.picture.as_ref()?);
        (self.newest.is_some() && (trace.width(), trace.height()) == picture.size()).then_some(replay)
    }

    /// The region that panels about one region show: the selected item's.
    pub fn selected_region(&self) -> Option<u16> {
        self.document.selection.item.and_then(|item| self.region_of(item))
    }
}

/// How grave a notice is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Something was done.
    Done,
    /// Something to beware of.
    Warning,
    /// Something failed.
    Error,
}

/// A sentence that stays until it is dismissed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// To dismiss it by.
    pub id: u64,
    /// How grave it is.
    pub severity: Severity,
    /// What happened, to what, and what to do.
    pub text: String,
}
