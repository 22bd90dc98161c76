//! The second look: what the working picture of a large photograph leaves unexplained is sought in a finer picture (refinement
//! `small_objects`; no counterpart in the paper).
//!
//! An object of less than about 25 working pixels across has too few windows for a matte line, and is in no region, or in that of the
//! wall behind it, whose plane does not explain it (`far_colors`). Where the working picture has such patches, the
//! stages from the windows to the split run again in a picture with blocks of 2/5 of the side, confined to the patches, with windows and
//! areas of as many pixels. Light and ambient light are those of the first look; without a light, and with two lamps, there is no second
//! look. A region is kept where its plane explains it. The regions of the second look follow those of the first. The record of a
//! run is of working pixels, so that it does not contain the decisions of the second look.
//!
//! Measured on four rendered pictures of 12 megapixels, each with 24 balls of 60 to 200 pixels, before black and before a wall, as PNG and
//! demosaiced at JPEG 92: 62 → 96 of the 96 balls are regions, body of the balls 38.4 → 41.1 dB (doing nothing: 29.3).
//! The second look takes as long as the rest of the analysis of such a picture or twice as long, as the whole finer picture is made.

use super::photograph::Photograph;
use super::resolve::{NoiseFindings, used_params};
use super::windows::{classify_windows, merged_areas};
use super::working_outputs::WorkingOutputs;
use crate::intrinsic::{Intrinsic, Reason, RegionPlans, RegionReflection, split};
use crate::params::{AmbientSetting, Refine, UsedParams};
use crate::photo::{CodingError, Masks, NoiseEstimate, ShotNoise, WorkingPicture};
use crate::raster::{
    Blocks, Border, ComponentSearch, Connectivity, LabelMap, Mask, RegionId, UNASSIGNED, dilate, erode,
};
use crate::segment::{
    AnalysisInput, FinalRegions, clipping_regions, final_regions, full_resolution_labels, matte_regions,
    planar_regions,
};
use crate::trace::NoopRecorder;
use std::sync::Arc;

/// A patch contains a square of unexplained working pixels that reaches this far from its middle: what is narrower is the mixed
/// colors at a border.
const PATCH_REACH_PX: usize = 2;
/// Side of a finer block as a share of the side of a working pixel.
const FINER: f64 = 0.4;
/// Every so many windows are measured for the noise.
const NOISE_STEP: usize = 2;

/// What the second look found.
pub(super) struct SecondLook {
    /// The blocks of pixels of the photograph that are the pixels of the finer picture.
    pub(super) blocks: Blocks,
    /// The regions as labels of the finer picture, from 1.
    pub(super) regions: FinalRegions,
    /// How each region is split.
    pub(super) plans: RegionPlans,
    /// The finer pixels that were looked at.
    patches: Mask,
}

/// Looks at the patches that the working picture leaves unexplained; none where nothing was found.
/// `labels`: the regions of the first look, of each pixel of the photograph.
pub(super) fn second_look(
    photograph: &Photograph,
    working: &WorkingOutputs,
    labels: &LabelMap,
) -> Option<SecondLook> {
    let Photograph { prepared, rules, input, .. } = photograph;
    let light = working.finals.value.light;
    let side = (prepared.working.blocks.side() as f64 * FINER).round().max(1.0) as usize;
    let direction = light.direction.filter(|_| light.second.is_none() && rules.baseline.is_none())?;
    if !rules.refine.small_objects || side == prepared.working.blocks.side() {
        return None;
    }
    let reasons = &working.split.value.intrinsic.reasons;
    let patches = patches(&prepared.working.masks, working)?;
    let blocks = &prepared.working.blocks;
    let finer = FinerPicture::new(photograph, side, |pixel| {
        let working_pixel = blocks.block_of(pixel);
        let is_free = labels[pixel] == UNASSIGNED || reasons[working_pixel] == Reason::OtherObject;
        is_free && patches[working_pixel]
    });
    let ambient = working.split.value.intrinsic.ambient.subtracted;
    let used = UsedParams {
        illuminant: Some(direction),
        ambient: ambient.map_or(AmbientSetting::Off, AmbientSetting::Given),
        ..finer.used
    };
    let finer_input = finer.input(photograph, &used).stopped_by(input.stopping());
    let mut regions = regions(&finer_input);
    regions.light = light;
    let split = split(&finer_input, &regions, &mut NoopRecorder);
    if finer_input.stopped() {
        return None;
    }
    let is_kept = |region: &RegionReflection| region.model_fits && region.separable;
    let kept: Vec<bool> = split.intrinsic.regions.iter().map(is_kept).collect();
    if !kept.contains(&true) {
        return None;
    }
    Some(SecondLook {
        blocks: finer.picture.blocks,
        regions: retained(regions, &kept),
        plans: split.region_plans(&kept, side),
        patches: finer.patches,
    })
}

/// The regions of the second look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SecondLookFindings {
    /// Side of a pixel of the finer picture, pixels of the photograph.
    pub side: usize,
    /// Number of the regions, which follow those of the working picture.
    pub regions: usize,
}

impl SecondLook {
    /// How many regions were found, and in which picture.
    pub(super) fn findings(&self) -> SecondLookFindings {
        SecondLookFindings { side: self.blocks.side(), regions: self.regions.hypotheses.len() }
    }

    /// The regions of the photograph `input` with those of the second look after them. These take the pixels that are in no region, and the
    /// pixels of the patches.
    pub(super) fn added_to(&self, input: &AnalysisInput, mut regions: FinalRegions) -> FinalRegions {
        let before = regions.hypotheses.len();
        let found = full_resolution_labels(input, &self.regions, &self.blocks);
        for (pixel, label) in regions.labels.as_mut_slice().iter_mut().enumerate() {
            let is_free = *label == UNASSIGNED || self.patches[self.blocks.block_of(pixel)];
            if let Some(region) = RegionId::from_label(found[pixel]).filter(|_| is_free) {
                *label = RegionId::from_index(before + region.index()).get();
            }
        }
        regions.hypotheses.extend(&self.regions.hypotheses);
        regions
    }
}

/// The working pixels that are lit and that no plane explains, and those beside them; without narrow strips, and without
/// patches that lie mostly beside a region that its plane does not explain, of which they are a part. None where there is no such pixel.
fn patches(masks: &Masks, working: &WorkingOutputs) -> Option<Mask> {
    let Intrinsic { reasons, regions, .. } = &*working.split.value.intrinsic;
    let labels = &working.finals.value.labels;
    let unexplained =
        |reason: Reason| matches!(reason, Reason::NoMatteLine | Reason::MixedBoundary | Reason::OtherObject);
    let left = masks.mask(|masks, pixel| !masks.dark(pixel) && unexplained(reasons[pixel]));
    let cores = erode(&left, PATCH_REACH_PX);
    if !cores.as_slice().contains(&true) {
        return None;
    }
    let wide = dilate(&cores, PATCH_REACH_PX);
    let mut kept = left.map(|_| false);
    let mut search = ComponentSearch::new(labels.width(), labels.height(), Connectivity::Four);
    for start in 0..labels.len() {
        let inside = |pixel: usize| left[pixel] && wide[pixel];
        let Some(patch) = search.component_at(start, inside) else { continue };
        let beside = Border::of(labels, patch, |pixel| !inside(pixel)).main_region();
        let region = beside.and_then(|(label, _)| RegionId::from_label(label));
        if region.is_none_or(|region| regions[region.index()].model_fits) {
            for &pixel in patch {
                kept[pixel] = true;
            }
        }
    }
    Some(dilate(&kept, 1))
}

/// The finer picture of the second look.
struct FinerPicture {
    /// The picture, whose pixels outside of the patches are marked as outside of the area.
    picture: WorkingPicture,
    /// The finer pixels that are looked at.
    patches: Mask,
    /// The noise of a finer pixel as a function of the intensity.
    shot: Option<ShotNoise>,
    /// The coding error of a finer pixel.
    coding: Option<CodingError>,
    /// The parameters, with the automatic noise of a finer pixel.
    used: UsedParams,
}

impl FinerPicture {
    /// The picture with blocks of `side` pixels. `is_sought`: whether to look at a pixel of the photograph, which stands for its block.
    fn new(photograph: &Photograph, side: usize, is_sought: impl Fn(usize) -> bool) -> Self {
        let Photograph { prepared, image, params, used, .. } = photograph;
        let mut picture = WorkingPicture::new(image, &prepared.masks, &prepared.limits, side);
        let blocks = picture.blocks;
        let measured = NoiseEstimate::measure_sparsely(&picture.image, &picture.masks, NOISE_STEP);
        let noise = NoiseFindings {
            sigma: measured.map(|measured| measured.sigma).or(prepared.noise.sigma),
            shot: measured.map_or(prepared.noise.shot, |measured| measured.shot),
            ..NoiseFindings::clone(&prepared.noise)
        };
        let of_blocks = (0..blocks.columns() * blocks.rows()).map(|block| is_sought(blocks.middle(block)));
        let patches =
            Mask::from_vec(blocks.columns(), blocks.rows(), of_blocks.collect()).unwrap_or_default();
        picture.masks = Arc::new(Masks::clone(&picture.masks).within(&patches));
        let finer = used_params(params, &picture.image, side, &noise);
        let UsedParams { window_size, min_area, min_intensity, .. } = **used;
        let used = UsedParams { min_intensity, window_size, min_area, ..finer };
        let coding = noise.coding.as_ref().map(|coding| coding.averaged(side));
        Self { picture, patches, shot: noise.shot, coding, used }
    }

    /// The input of the stages. With a light that is given no second lamp is sought.
    fn input<'a>(&'a self, photograph: &Photograph<'a>, used: &'a UsedParams) -> AnalysisInput<'a> {
        let Photograph { prepared, rules, .. } = photograph;
        let refine = Refine { second_lamp: false, ..rules.refine };
        let input = AnalysisInput::new(&self.picture.image, &self.picture.masks, used, refine)
            .with_readings(rules.readings);
        prepared.with_errors(input, self.coding.as_ref(), self.shot)
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
