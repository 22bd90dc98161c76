//! What is done to a photograph as soon as its next result is complete.

use crate::params::Params;
use crate::view::Item;

/// What is done as soon as the next result is complete. It stays with its photograph while another one is shown.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Awaited {
    /// Whether the largest region is to be selected: the plane, the color space and the history then show something from the start.
    pub(super) preselects: bool,
    /// Whether its region is to be selected, although pixels are marked: a skewed T was fitted to them.
    pub(super) selects_region: bool,
    /// Whether the selected region has the number that it has in that result already, as undo and workspaces restore both together.
    pub(super) is_numbered: bool,
    /// The rest of a restored workspace, which is applied when its pinned result has been computed.
    pub(super) after_pin: Option<AfterPin>,
}

/// The part of a restored workspace that is applied after its pinned result has been computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct AfterPin {
    /// The parameters of the newest result.
    pub(super) params: Params,
    /// The selected item.
    pub(super) item: Option<Item>,
    /// Whether the pinned result is shown in place of the newest.
    pub(super) show_pinned: bool,
}
