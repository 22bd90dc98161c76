//! The second look at one rectangle of the photograph: the stages from the windows to the split in a finer picture.

use super::FinerPixels;
use crate::analysis::photograph::Photograph;
use crate::analysis::prepared::masks_made;
use crate::analysis::slot::recorded;
use crate::analysis::windows::{classify_windows, merged_areas};
use crate::intrinsic::{FittedPlace, JudgedPlans, RegionPlans, judged_plans, split};
use crate::params::{Refine, Stage};
use crate::photo::{Masks, WorkingPicture};
use crate::raster::{Blocks, LabelMap, Mask, RegionId, Roi, UNASSIGNED};
use crate::segment::{
    AnalysisInput, FinalRegions, PictureVotes, PlanarHypothesis, clipping_regions, final_regions,
    full_resolution_labels, matte_regions, planar_regions,
};
use crate::trace::{Recorder, SecondLookRecord, StageTrace, Trace};
use std::marker::PhantomData;
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
    /// Of the regions of the finer picture, by [`RegionId::index`], whether the region was kept.
    kept: Vec<bool>,
    /// The decisions; none where no record is kept.
    record: Option<SecondLookRecord>,
}

impl Tile {
    /// Looks at the rectangle `roi` of the photograph, at the pixels for which `is_sought` is true; a pixel stands for its block. None where
    /// no region is found and no record is kept.
    pub(super) fn new<R: Recorder>(
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
        let mut records = StageRecords::<R>::default();
        let (regions, plans) = regions_and_plans(&finer_input, finer, &mut records)?;
        let kept = plans.separated();
        if finer_input.stopped() || !(R::KEEPS || kept.contains(&true)) {
            return None;
        }
        let record = records.finish().map(|stage_traces| {
            let trace = Trace::of_working_picture(blocks, stage_traces);
            let (image, masks, patches) = (picture.image, picture.masks, patches.clone());
            SecondLookRecord { roi, image, masks, patches, trace, regions: Vec::new() }
        });
        let regions = retained(regions, &kept);
        let photograph_input = input.with_picture(&cropped.pixels, &cropped_masks);
        Some(Self {
            labels: full_resolution_labels(&photograph_input, &regions, &blocks),
            plans: plans.kept(&kept, FittedPlace { block_side: finer.side, corner: [roi.left, roi.top] }),
            hypotheses: regions.hypotheses,
            record,
            kept,
            roi,
            blocks,
            patches,
        })
    }

    /// The record, with the numbers of the regions in the result, in which they follow the first `before` regions; none where no record was
    /// kept.
    pub(super) fn take_record(&mut self, before: usize) -> Option<SecondLookRecord> {
        let mut numbers = before..;
        let number = |&is_kept: &bool| if is_kept { numbers.next().map(RegionId::from_index) } else { None };
        let regions = self.kept.iter().map(number).collect();
        self.record.take().map(|record| SecondLookRecord { regions, ..record })
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

/// The regions of a finer picture under the light that was given, and how each is split; none where no area is a matte line and no record is
/// kept. The images of the split are made for the record alone.
fn regions_and_plans<R: Recorder>(
    input: &AnalysisInput,
    finer: &FinerPixels,
    records: &mut StageRecords<R>,
) -> Option<(FinalRegions, JudgedPlans)> {
    records.stage(Stage::Masks, |recorder| {
        if R::KEEPS {
            recorder.record(masks_made(input.masks, finer.limits, input.pixels.len(), finer.sigma));
        }
    });
    let windows = records.stage(Stage::Classify, |recorder| classify_windows(input, recorder));
    let merged = records.stage(Stage::Merge, |recorder| merged_areas(input, &windows, recorder));
    let areas = &merged.areas;
    let matte = records.stage(Stage::Linear, |recorder| matte_regions(input, &windows, areas, recorder));
    if !R::KEEPS && !matte.hypotheses.iter().any(|hypothesis| hypothesis.alive) {
        return None;
    }
    let planar = records.stage(Stage::Planar, |recorder| {
        let votes = PictureVotes::are_asked(input).then(|| PictureVotes::of(input)).flatten();
        planar_regions(input, &windows, areas, &matte, votes.as_ref(), recorder)
    });
    let mut regions = records.stage(Stage::Clipping, |recorder| {
        let labels = clipping_regions(input, &planar, recorder);
        final_regions(input, labels, &planar, recorder)
    });
    regions.light = finer.light;
    let plans = if R::KEEPS {
        records.stage(Stage::Split, |recorder| split(input, &regions, recorder)).judged_plans()
    } else {
        judged_plans(input, &regions)
    };
    Some((regions, plans))
}

/// The records of the stages that have run.
struct StageRecords<R> {
    stage_traces: Vec<Arc<StageTrace>>,
    recorder: PhantomData<R>,
}

impl<R> Default for StageRecords<R> {
    fn default() -> Self {
        Self { stage_traces: Vec::new(), recorder: PhantomData }
    }
}

impl<R: Recorder> StageRecords<R> {
    /// Runs a stage, and keeps its record.
    fn stage<T>(&mut self, stage: Stage, run: impl FnOnce(&mut R) -> T) -> T {
        let (made, stage_trace) = recorded(stage, run);
        self.stage_traces.extend(stage_trace);
        made
    }

    /// The records; none where nothing is kept.
    fn finish(self) -> Option<Vec<Arc<StageTrace>>> {
        R::KEEPS.then_some(self.stage_traces)
    }
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
