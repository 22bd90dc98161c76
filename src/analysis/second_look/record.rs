//! The record of the second look at one rectangle of the photograph.

use crate::photo::{LinearImage, Masks};
use crate::raster::{HypothesisId, Mask, PixelIndex, RegionId, Roi};
use crate::trace::{HistoryEntry, Trace, pixel_history, regions_of};
use std::sync::Arc;

/// Every decision about one finer picture of the second look, which shows a rectangle of the photograph. Numbers of hypotheses, areas and
/// pixels in the record are those of the finer picture.
#[derive(Clone, Debug)]
pub struct SecondLookRecord {
    /// The rectangle, pixels of the photograph.
    roi: Roi,
    /// The colors of the finer picture.
    image: Arc<LinearImage>,
    /// The masks of the finer picture.
    masks: Arc<Masks>,
    /// The finer pixels that were looked at.
    patches: Mask,
    /// The decisions.
    trace: Trace,
    /// Number in the result of each region of the finer picture, by [`RegionId::index`]; none for a region that was not kept.
    regions: Vec<Option<RegionId>>,
}

impl SecondLookRecord {
    /// The record `trace` of a finer picture with colors `image` and marks `masks`, which shows the rectangle `roi`.
    pub(super) fn new(
        roi: Roi,
        image: Arc<LinearImage>,
        masks: Arc<Masks>,
        patches: Mask,
        trace: Trace,
    ) -> Self {
        Self { roi, image, masks, patches, trace, regions: Vec::new() }
    }

    /// This record, where the regions that are `kept`, by [`RegionId::index`], are the regions from index `first` on in the result.
    #[must_use]
    pub(super) fn numbered(self, kept: &[bool], first: usize) -> Self {
        let mut numbers = first..;
        let number = |&is_kept: &bool| if is_kept { numbers.next().map(RegionId::from_index) } else { None };
        Self { regions: kept.iter().map(number).collect(), ..self }
    }

    /// Column and row of the photograph where the finer picture begins, pixels.
    pub fn corner(&self) -> [usize; 2] {
        [self.roi.left, self.roi.top]
    }

    /// The decisions, in pixels and numbers of the finer picture.
    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    /// Number in the result of each region of the finer picture, by [`RegionId::index`]; none for a region that was not kept.
    pub fn regions(&self) -> &[Option<RegionId>] {
        &self.regions
    }

    /// Number in the result of a region of the finer picture; none for a region that was not kept.
    pub fn number_in_result(&self, region: RegionId) -> Option<RegionId> {
        self.regions.get(region.index()).copied().flatten()
    }

    /// The region of the result that a hypothesis of the finer picture became; none for any other hypothesis.
    pub fn region_of(&self, hypothesis: HypothesisId) -> Option<RegionId> {
        let region = regions_of(&self.trace)?.get(hypothesis.index()).copied().flatten()?;
        self.number_in_result(region)
    }

    /// The region of the finer picture that has a number in the result; none where that region lies in another picture.
    pub fn region_with_number(&self, number: RegionId) -> Option<RegionId> {
        let index = self.regions.iter().position(|region| *region == Some(number))?;
        Some(RegionId::from_index(index))
    }

    /// Whether the second look looked at a pixel of the photograph in this finer picture.
    pub fn has_looked_at(&self, pixel: PixelIndex) -> bool {
        self.finer_pixel(pixel).is_some_and(|finer| self.patches[finer.index()])
    }

    /// The finer pixel that contains a pixel of the photograph; none outside of the rectangle.
    pub fn finer_pixel(&self, pixel: PixelIndex) -> Option<PixelIndex> {
        let blocks = self.trace.pixel_blocks();
        self.roi.index(pixel.index()).map(|index| PixelIndex::from_index(blocks.block_of(index)))
    }

    /// The finer pixels for which `test` is true of the pixel of the photograph in their middle.
    pub fn finer_pixels_where(&self, test: impl Fn(PixelIndex) -> bool) -> Mask {
        let blocks = self.trace.pixel_blocks();
        let middle = |block: usize| PixelIndex::from_index(self.roi.pixel(blocks.middle(block)));
        let tested = (0..self.patches.len()).map(|block| test(middle(block))).collect();
        Mask::from_vec(self.patches.width(), self.patches.height(), tested).unwrap_or_default()
    }

    /// Everything that was decided about the finer pixel that contains a pixel of the photograph, oldest first. Empty outside of the
    /// rectangle.
    pub fn pixel_history(&self, pixel: PixelIndex) -> Vec<HistoryEntry> {
        let history = |finer| pixel_history(&self.trace, &self.image, &self.masks, finer);
        self.finer_pixel(pixel).map_or_else(Vec::new, history)
    }
}
