//! The second look at one rectangle of the photograph: the stages from the windows to the split in a finer picture.

use super::FinerPixels;
use crate::analysis::photograph::Photograph;
use crate::analysis::windows::{classify_windows, merged_areas};
use crate::intrinsic::{FittedPlace, RegionPlans, RegionReflection, split};
use crate::params::Refine;
use crate::photo::{Masks, WorkingPicture};
use crate::raster::{Blocks, LabelMap, Mask, RegionId, Roi, UNASSIGNED};
use crate::segment::{
    AnalysisInput, FinalRegions, PlanarHypothesis, clipping_regions, final_regions, full_resolution_labels,
    matte_regions, planar_regions,
};
use crate::trace::NoopRecorder;
use std::sync::Arc;

/// What the second look found in one rectangle of the photograph.
pub(super) struct Tile {
    /// The rectangle, pixels of the photograph.
    roi: Roi,
    /// Region of each pixel of the rectangle, from 1 in each rectangle.
    labels: LabelMap,
    /// The blocks of pixels of the rectangle that are the pixels of the finer picture.
    blocks: Blocks,
    /// The finer pixels that were looked at.
    patches: Mask,
    /// The regions' planar hypotheses.
    pub(super) hypotheses: Vec<PlanarHypothesis>,
    /// How each region is split.
    pub(super) plans: RegionPlans,
}

impl Tile {
    /// Looks at the rectangle `roi` of the photograph, at the pixels for which `is_sought` is true; a pixel stands for its block. None where
    /// no region is found.
    pub(super) fn new(
        photograph: &Photograph,
        finer: &FinerPixels,
        roi: Roi,
        is_sought: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let Photograph { prepared, rules, image, input, .. } = photograph;
        let cropped = Arc::new(image.cropped(&roi));
        let cropped_masks = Arc::new(prepared.masks.cropped(&roi));
        let mut picture = WorkingPicture::new(&cropped, &cropped_masks, &prepared.limits, finer.side);
        let blocks = picture.blocks;
        let sought =
            (0..blocks.columns() * blocks.rows()).map(|block| is_sought(roi.pixel(blocks.middle(block))));
        let patches = Mask::from_vec(blocks.columns(), blocks.rows(), sought.collect()).unwrap_or_default();
        picture.masks = Arc::new(Masks::clone(&picture.masks).within(&patches));
        // With a light that is given no second lamp is sought.
        let refine = Refine { second_lamp: false, ..rules.refine };
        let finer_input = AnalysisInput::new(&picture.image, &picture.masks, &finer.used, refine)
            .with_readings(rules.readings)
            .stopped_by(input.stopping());
        let finer_input = prepared.with_errors(finer_input, finer.coding.as_ref(), finer.shot);
        let mut regions = regions(&finer_input);
        regions.light = finer.light;
        let split = split(&finer_input, &regions, &mut NoopRecorder);
        let is_kept = |region: &RegionReflection| region.model_fits && region.separable;
        let kept: Vec<bool> = split.intrinsic.regions.iter().map(is_kept).collect();
        if finer_input.stopped() || !kept.contains(&true) {
            return None;
        }
        let regions = retained(regions, &kept);
        let photograph_input = input.with_picture(&cropped.pixels, &cropped_masks);
        Some(Self {
            labels: full_resolution_labels(&photograph_input, &regions, &blocks),
            plans: split
                .region_plans(&kept, FittedPlace { block_side: finer.side, corner: [roi.left, roi.top] }),
            hypotheses: regions.hypotheses,
            roi,
            blocks,
            patches,
        })
    }

    /// Gives pixels of the photograph, whose regions are `labels`, the regions of this rectangle, which follow the first `before` regions.
    /// These take the pixels that are in no region, and the pixels of the patches.
    pub(super) fn add_to(&self, labels: &mut LabelMap, before: usize) {
        for (index, &found) in self.labels.as_slice().iter().enumerate() {
            let Some(region) = RegionId::from_label(found) else { continue };
            let label = &mut labels[self.roi.pixel(index)];
            if *label == UNASSIGNED || self.patches[self.blocks.block_of(index)] {
                *label = RegionId::from_index(before + region.index()).get();
            }
        }
    }
}

/// The regions of a picture under the light that was given.
fn regions(input: &AnalysisInput) -> FinalRegions {
    let mut silent = NoopRecorder;
    let windows = classify_windows(input, &mut silent);
    let merged = merged_areas(input, &windows, &mut silent);
    let matte = matte_regions(input, &windows, &merged.areas, &mut silent);
    let planar = planar_regions(input, &windows, &merged.areas, &matte, &mut silent);
    let labels = clipping_regions(input, &planar, &mut silent);
    final_regions(input, labels, &planar, &mut silent)
}

/// The regions that are `kept`, by [`RegionId::index`].
fn retained(mut regions: FinalRegions, kept: &[bool]) -> FinalRegions {
    let mut number = 0;
    let labels: Vec<u16> = kept
        .iter()
        .map(|&is_kept| {
            number += u16::from(is_kept);
            if is_kept { number } else { UNASSIGNED }
        })
        .collect();
    for label in regions.labels.as_mut_slice() {
        *label = RegionId::from_label(*label).map_or(UNASSIGNED, |region| labels[region.index()]);
    }
    let mut is_kept = kept.iter();
    regions.hypotheses.retain(|_| is_kept.next() == Some(&true));
    regions
}
