//! The split of the photograph by what was found in its working picture (no counterpart in the paper).
//!
//! The vectors, highlight lines and verdicts of the regions come from the working picture. Every pixel of the photograph is
//! split by the transform T of its region, clipped pixels are restored, and where the region's model does not fit, the pixel gets
//! the local split that the working picture found around it. So the detail of the photograph is in the body and in the surface image:
//! input = body + surface + ε·n for each pixel of the photograph.
//!
//! What is noise in a single pixel is more than what is noise in a mean: the picture's own noise decides which surface reflection
//! is taken for none, how far the prior of a restored pixel is trusted, and which ε lowers the confidence.

use super::Intrinsic;
use super::border_mixtures::limit_surface_at_borders;
use super::detail::Detail;
use super::finish::Finish;
use super::images::Images;
use super::local::{LocalWorkingSplit, split_locally_at_full_resolution};
use super::region::RegionReports;
use super::region_plan::{FittedPlace, RegionPlan};
use super::split::{WorkingSplit, add_ambient, without_light};
use crate::raster::{LabelMap, Mask, RegionId};
use crate::segment::{Members, neighbors};
use rayon::prelude::*;

/// Splits the photograph `detail` by the split of its working picture. The ambient light that was subtracted from the working picture
/// is subtracted before, and added to the body reflection afterwards.
pub fn split_photograph(detail: &Detail, working: &WorkingSplit) -> Intrinsic {
    let ambient = working.intrinsic.ambient;
    let mut intrinsic = match ambient.subtracted {
        None => split_from(detail, working),
        Some(counts) => {
            let pixels = without_light(detail.input.pixels, &counts);
            split_from(&Detail { input: detail.input.with_pixels(&pixels), ..*detail }, working)
        }
    };
    add_ambient(&mut intrinsic, ambient);
    intrinsic
}

/// Splits a photograph whose colors are measured from the ambient light.
fn split_from(detail: &Detail, working: &WorkingSplit) -> Intrinsic {
    let (input, found) = (&detail.input, &working.found);
    let place = FittedPlace { block_side: detail.blocks.side(), ..FittedPlace::WHOLE_PICTURE };
    let mut plans: Vec<RegionPlan> =
        found.plans.iter().map(|plan| plan.at_full_resolution(input, place)).collect();
    let touching = match detail.second_look {
        None => found.touching.clone(),
        Some(second_look) => {
            plans.extend(second_look.at_full_resolution(input));
            neighbors(detail.labels, plans.len())
        }
    };
    let members = Members::of(detail.labels, plans.len());
    let mut images = Images::split_undistorted(input, detail.labels, &plans);
    if input.stopped() {
        return images.unfinished();
    }
    images.restore(&found.origin, input, detail.labels, &plans, &members);
    limit_surface_at_borders(input, detail.labels, &plans, &mut images);
    if input.stopped() {
        return images.unfinished();
    }
    let explained_mask = explained_mask(detail, working);
    let local = LocalWorkingSplit {
        local: found.local.as_ref(),
        replaced: found.replaced.as_ref(),
        body: &working.intrinsic.body,
        origin: found.origin,
    };
    let is_split = |pixel: usize| {
        let plan = RegionId::from_label(detail.labels[pixel]).and_then(|region| plans.get(region.index()));
        plan.is_some_and(|plan| plan.splits_pixels)
    };
    let local_confidence =
        split_locally_at_full_resolution(detail, &local, &explained_mask, is_split, &mut images);
    if input.stopped() {
        return images.unfinished();
    }
    let reports = RegionReports { input, members: &members, kinds: &images.kinds, fit_sigma: found.sigma }
        .of(&plans, touching);
    let finish = Finish {
        input,
        labels: detail.labels,
        light: detail.working_regions.light.direction,
        explained_mask: &explained_mask,
        pixel_sigmas: plans.iter().map(|plan| input.fit_sigma(&plan.vectors.matte_mean) as f32).collect(),
    };
    finish.intrinsic(images, reports, local_confidence)
}

/// The pixels that the skewed T of their region explains: those of a region whose model fits, unless the working pixel of the
/// same region, here or next to here, was taken out; and those of the regions of the second look.
fn explained_mask(detail: &Detail, working: &WorkingSplit) -> Mask {
    let blocks = &detail.blocks;
    let [width, height] = blocks.picture();
    let mut mask = Mask::filled(width, height, false);
    mask.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        let places = (y / blocks.side() * blocks.columns()..).zip(row.chunks_mut(blocks.side()));
        let labels = detail.labels.row(y).chunks(blocks.side());
        for ((place, explained), labels) in places.zip(labels) {
            for (explained, &label) in explained.iter_mut().zip(labels) {
                *explained = is_explained(detail, working, place, label);
            }
        }
    });
    mask
}

/// Whether the skewed T of the region `label` explains a pixel in the block of the working pixel `place`; see [`explained_mask`].
#[inline]
fn is_explained(detail: &Detail, working: &WorkingSplit, place: usize, label: u16) -> bool {
    let Some(region) = RegionId::from_label(label) else { return false };
    let Some(plan) = working.found.plans.get(region.index()) else { return true };
    plan.model_fits()
        && working_pixel_of(&detail.working_regions.labels, place, label)
            .is_some_and(|near| working.found.explained_mask[near])
}

/// The working pixel with a label: the one at `place`, or else the first of the eight around. `working`: the labels of the working
/// pixels.
fn working_pixel_of(working: &LabelMap, place: usize, label: u16) -> Option<usize> {
    if working[place] == label {
        return Some(place);
    }
    working.around(place).find(|&near| working[near] == label)
}
