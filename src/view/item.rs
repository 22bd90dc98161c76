//! The items that can be hovered and selected. All panels share one hover and one selection.

use super::named_marks::NamedMarks;
use crate::raster::{Mask, PixelIndex, RegionId};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Something that a person can point at in any panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Item {
    /// A pixel of the photograph.
    Pixel(PixelIndex),
    /// A window of the classification, by its row-major index.
    Window(u32),
    /// A region of the result.
    Region(RegionId),
    /// A bin of the color histogram, by its index in [`super::Histogram::bins`].
    Bin(u32),
}

/// The selection: at most one item, and pixels marked by lasso, rectangle or brush.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// The item that was clicked.
    pub item: Option<Item>,
    /// The marked pixels; none: no pixel is marked.
    pub marked: Option<Arc<Mask>>,
    /// The named marks.
    pub named: Arc<NamedMarks>,
}

impl Selection {
    /// Whether no item is selected and no pixel is marked; named marks do not count.
    pub fn is_empty(&self) -> bool {
        self.item.is_none() && self.marked.is_none()
    }
}
