//! The second look: what the working picture of a large photograph leaves unexplained is sought in a finer picture (refinement
//! `small_objects`; no counterpart in the paper).
//!
//! An object of less than about 25 working pixels across has too few windows for a matte line, and is in no region, or in that of the
//! wall behind it, whose plane does not explain it (`far_colors`). Where the working picture has such patches, the
//! stages from the windows to the split run again in finer pictures, one for each rectangle that contains patches, with blocks of 2/5 of
//! the side, confined to the patches, with windows and areas of as many pixels. Light and ambient light are those of the first look; without a light, and with two lamps, there is no second
//! look. A region is kept where its plane explains it. The regions of the second look follow those of the first. Each
//! finer picture has a record of its own ([`SecondLookRecord`]).
//!
//! Measured on four rendered pictures of 12 megapixels, each with 24 balls of 60 to 200 pixels, before black and before a wall, as PNG and
//! demosaiced at JPEG 92: 62 → 96 of the 96 balls are regions, body of the balls 38.4 → 41.1 dB (doing nothing: 29.3).
//! On two of them the analysis takes 1.1 and .8 s, with the whole picture made finer it took 2.7 and 1.5 s (two shared cores).

mod patches;
mod tile;

use super::photograph::Photograph;
use super::resolve::{NoiseFindings, used_params};
use super::working_outputs::WorkingOutputs;
use crate::intrinsic::{Reason, RegionPlans};
use crate::params::{AmbientSetting, UsedParams};
use crate::photo::{CodingError, MaskLimits, NoiseEstimate, ShotNoise};
use crate::raster::{Blocks, LabelMap, UNASSIGNED, disjoint_rectangles};
use crate::segment::{FinalRegions, LightFindings};
use crate::trace::{Recorder, SecondLookRecord};
use patches::patches;
use rayon::prelude::*;
use std::sync::Arc;
use tile::Tile;

/// Side of a finer block as a share of the side of a working pixel.
const FINER: f64 = 0.4;
/// Every so many windows are measured for the noise.
const NOISE_STEP: usize = 6;
/// The patches in a rectangle are this far from the edges, working pixels.
const MARGIN_PX: usize = 1;

/// What the second look found.
#[derive(Default)]
pub(super) struct SecondLook {
    /// Side of a pixel of the finer pictures, pixels of the photograph.
    side: usize,
    /// The rectangles of the photograph in which regions were found, and those of which there is a record.
    tiles: Vec<Tile>,
    /// How each region is split.
    pub(super) plans: RegionPlans,
    /// The decisions, one record for each rectangle; empty where no record is kept.
    pub(super) records: Arc<[SecondLookRecord]>,
    /// Whether a record was kept.
    pub(super) is_recorded: bool,
}

/// Looks at the patches that the working picture leaves unexplained. `labels`: the regions of the first look, of each pixel of the
/// photograph.
pub(super) fn second_look<R: Recorder>(
    photograph: &Photograph,
    working: &WorkingOutputs,
    labels: &LabelMap,
) -> SecondLook {
    let Photograph { prepared, rules, .. } = photograph;
    let light = working.finals.value.light;
    let blocks = &prepared.working.blocks;
    let side = (blocks.side() as f64 * FINER).round().max(1.0) as usize;
    let mut found = SecondLook { side, is_recorded: R::KEEPS, ..SecondLook::default() };
    let is_possible = light.direction.is_some() && light.second.is_none() && rules.baseline.is_none();
    if !is_possible || !rules.refine.small_objects || side == blocks.side() {
        return found;
    }
    let reasons = &working.split.value.intrinsic.reasons;
    let Some(patches) = patches(&prepared.working.masks, working) else { return found };
    let finer = FinerPixels::new(photograph, working, side);
    let is_sought = |pixel: usize| {
        let working_pixel = blocks.block_of(pixel);
        let is_free = labels[pixel] == UNASSIGNED || reasons[working_pixel] == Reason::OtherObject;
        is_free && patches[working_pixel]
    };
    let rectangles = disjoint_rectangles(&patches, MARGIN_PX);
    let looked_at =
        rectangles.par_iter().map(|roi| Tile::new::<R>(photograph, &finer, roi.of_pixels(blocks), is_sought));
    found.tiles = looked_at.collect::<Vec<_>>().into_iter().flatten().collect();
    let mut before = working.finals.value.hypotheses.len();
    let mut records = Vec::new();
    for tile in &mut found.tiles {
        found.plans.extend(std::mem::take(&mut tile.plans));
        records.extend(tile.take_record(before));
        before += tile.hypotheses.len();
    }
    found.records = records.into();
    found
}

/// The regions of the second look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SecondLookFindings {
    /// Side of a pixel of the finer pictures, pixels of the photograph.
    pub side: usize,
    /// Number of the regions, which follow those of the working picture.
    pub regions: usize,
}

impl SecondLook {
    /// How many regions were found, and in pictures of which pixels; none where nothing was found.
    pub(super) fn findings(&self) -> Option<SecondLookFindings> {
        let regions = self.tiles.iter().map(|tile| tile.hypotheses.len()).sum();
        (regions > 0).then_some(SecondLookFindings { side: self.side, regions })
    }

    /// The regions of the photograph with those of the second look after them.
    pub(super) fn added_to(&self, mut regions: FinalRegions) -> FinalRegions {
        for tile in &self.tiles {
            tile.add_to(&mut regions.labels, regions.hypotheses.len());
            regions.hypotheses.extend(&tile.hypotheses);
        }
        regions
    }
}

/// What is known of the pixels of the finer pictures.
struct FinerPixels {
    /// Side of a pixel, pixels of the photograph.
    side: usize,
    /// The limits of the masks.
    limits: MaskLimits,
    /// Standard deviation of the noise, counts; none: it could not be measured.
    sigma: Option<f64>,
    /// The noise as a function of the intensity.
    shot: Option<ShotNoise>,
    /// The coding error.
    coding: Option<CodingError>,
    /// The light of the first look.
    light: LightFindings,
    /// The parameters, with the automatic noise of a finer pixel, and light and ambient light of the first look.
    used: UsedParams,
}

impl FinerPixels {
    /// Of pixels of `side` pixels of the photograph.
    fn new(photograph: &Photograph, working: &WorkingOutputs, side: usize) -> Self {
        let Photograph { prepared, image, params, used, .. } = photograph;
        let blocks = Blocks::new(side, image.width(), image.height());
        let measured = NoiseEstimate::measure_sparsely(image, &prepared.masks, &blocks, NOISE_STEP);
        let noise = NoiseFindings {
            sigma: measured.map(|measured| measured.sigma).or(prepared.noise.sigma),
            shot: measured.map_or(prepared.noise.shot, |measured| measured.shot),
            ..NoiseFindings::clone(&prepared.noise)
        };
        let light = working.finals.value.light;
        let ambient = working.split.value.intrinsic.ambient.subtracted;
        let UsedParams { window_size, min_area, min_intensity, .. } = **used;
        let used = UsedParams {
            min_intensity,
            window_size,
            min_area,
            illuminant: light.direction,
            ambient: ambient.map_or(AmbientSetting::Off, AmbientSetting::Given),
            ..used_params(params, image, side, &noise)
        };
        let coding = noise.coding.as_ref().map(|coding| coding.averaged(side));
        Self { side, limits: prepared.limits, sigma: noise.sigma, shot: noise.shot, coding, light, used }
    }
}
