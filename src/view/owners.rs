//! The owners of pixels: the regions of a result, or at the debugger's cursor the hypotheses so far.

use super::{Item, RegionNames, ResultSnapshot, marking};
use crate::raster::{Blocks, HypothesisId, LabelMap, Mask, RegionId, UNASSIGNED};
use crate::trace::Replay;

/// What an owner of pixels is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OwnerKind {
    /// A region of a result.
    Region,
    /// A hypothesis at the debugger's cursor.
    Hypothesis,
}

impl OwnerKind {
    /// The name of one owner.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Region => "region",
            Self::Hypothesis => "hypothesis",
        }
    }

    /// The name of several owners.
    pub const fn plural(self) -> &'static str {
        match self {
            Self::Region => "regions",
            Self::Hypothesis => "hypotheses",
        }
    }
}

/// The hypotheses that own the pixels at the debugger's cursor, copied so that another thread can count them.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnersAtCursor {
    /// Hypothesis of each working pixel.
    labels: LabelMap,
    blocks: Blocks,
    /// The region that each hypothesis becomes, by [`HypothesisId::index`].
    becomes: Vec<Option<RegionId>>,
}

impl OwnersAtCursor {
    /// The owners at the cursor.
    pub fn of(replay: &Replay, names: &RegionNames) -> Self {
        let ids = HypothesisId::all(replay.hypotheses().len());
        Self {
            labels: replay.labels().clone(),
            blocks: replay.trace().pixel_blocks(),
            becomes: ids.map(|id| names.region_of(id)).collect(),
        }
    }

    /// The pixels of an item at the cursor; none where there are none. A region has the pixels of the hypotheses that become it.
    pub fn mask_of(&self, item: Item, shown: &ResultSnapshot) -> Option<Mask> {
        let Item::Region(region) = item else { return marking::mask_of(item, shown) };
        let is_of_region = |label: u16| {
            let becomes = HypothesisId::from_label(label).and_then(|id| *self.becomes.get(id.index())?);
            becomes == Some(region)
        };
        let mask = self.blocks.enlarged(&self.labels.map(|&label| is_of_region(label)));
        mask.as_slice().contains(&true).then_some(mask)
    }
}

/// The label of each pixel of the photograph by its owner.
#[derive(Clone, Copy)]
pub(super) struct Owners<'a> {
    pub kind: OwnerKind,
    labels: &'a LabelMap,
    /// The blocks of the photograph's pixels that have one label.
    blocks: Blocks,
    /// Number of owners.
    pub count: usize,
}

impl<'a> Owners<'a> {
    /// The owners at the cursor, otherwise in the result.
    pub fn new(shown: &'a ResultSnapshot, at_cursor: Option<&'a OwnersAtCursor>) -> Self {
        match at_cursor {
            Some(OwnersAtCursor { labels, blocks, becomes }) => {
                Self { kind: OwnerKind::Hypothesis, labels, blocks: *blocks, count: becomes.len() }
            }
            None => Self {
                kind: OwnerKind::Region,
                labels: shown.labels(),
                blocks: Blocks::default(),
                count: shown.analysis.finals.hypotheses.len(),
            },
        }
    }

    /// The label of a pixel's owner; 0 for none.
    pub fn label(&self, pixel: usize) -> u16 {
        self.labels.as_slice().get(self.blocks.block_of(pixel)).copied().unwrap_or(UNASSIGNED)
    }
}
