//! Questions to the records of the second look, which looks at parts of a large photograph in finer pictures.

use super::history::{HistoryEntry, pixel_history};
use super::lineage::regions_of;
use super::timeline::{SecondLookRecord, Trace};
use crate::raster::{HypothesisId, Mask, PixelIndex, RegionId};

impl Trace {
    /// The record of the second look at a pixel of the photograph; none where the second look did not look.
    pub fn second_look_at(&self, pixel: PixelIndex) -> Option<&SecondLookRecord> {
        self.second_look().iter().find(|record| record.has_looked_at(pixel))
    }

    /// The record of the second look that contains a region of the result, and the number of the region in it; none for a region of the
    /// working picture.
    pub fn second_look_region(&self, region: RegionId) -> Option<(&SecondLookRecord, RegionId)> {
        let in_record = |record: &SecondLookRecord| record.region_with_number(region);
        self.second_look().iter().find_map(|record| in_record(record).map(|finer| (record, finer)))
    }
}

impl SecondLookRecord {
    /// Column and row of the photograph where the finer picture begins, pixels.
    pub fn corner(&self) -> [usize; 2] {
        [self.roi.left, self.roi.top]
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
