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
use super::detail::{Detail, WorkingSplit};
use super::finish::Finish;
use super::images::Images;
use super::local::{LocalSplit, split_locally_at_full_resolution};
use super::region::RegionReports;
use super::region_plan::RegionPlan;
use crate::raster::{Mask, RegionId};
use crate::segment::Members;
use rayon::prelude::*;

/// Splits the photograph `detail` by the split of its working picture. `local`: what the local split found there; none where it
/// did not run. `touching`: the neighbors of each region, by [`RegionId::index`].
pub(super) fn split_photograph(
    detail: &Detail,
    working: &WorkingSplit,
    local: Option<&LocalSplit>,
    touching: Vec<Vec<RegionId>>,
) -> Intrinsic {
    let input = &detail.input;
    let plans: Vec<RegionPlan> =
        working.plans.iter().map(|plan| plan.at_full_resolution(input, detail.blocks.side())).collect();
    let members = Members::of(detail.labels, plans.len());
    let mut images = Images::split_undistorted(input, detail.labels, &plans);
    if input.stopped() {
        return images.unfinished();
    }
    images.restore(&working.origin, input, detail.labels, &plans, &members);
    limit_surface_at_borders(input, detail.labels, &plans, &mut images);
    let explained_mask = explained_mask(detail, working);
    let local_confidence =
        split_locally_at_full_resolution(detail, working, local, &explained_mask, &mut images);
    let reports =
        RegionReports { input, members: &members, kinds: &images.kinds, fit_sigma: working.input.sigma() }
            .of(&plans, touching);
    let finish = Finish {
        input,
        labels: detail.labels,
        light: working.regions.light.direction,
        explained_mask: &explained_mask,
        pixel_sigmas: plans.iter().map(|plan| input.fit_sigma(&plan.vectors.matte_mean) as f32).collect(),
    };
    finish.intrinsic(images, reports, local_confidence.as_ref())
}

/// The pixels that the skewed T of their region explains: those of a region whose model fits, unless the working pixel of the
/// same region, here or next to here, was taken out.
fn explained_mask(detail: &Detail, working: &WorkingSplit) -> Mask {
    let [width, height] = detail.blocks.picture();
    let mut mask = Mask::filled(width, height, false);
    mask.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, explained) in row.iter_mut().enumerate() {
            let label = detail.labels[y * width + x];
            let plan = RegionId::from_label(label).and_then(|id| working.plans.get(id.index()));
            if plan.is_none_or(|plan| !plan.model_fits) {
                continue;
            }
            let place = detail.blocks.block_of(y * width + x);
            *explained =
                working_pixel_of(working, place, label).is_some_and(|near| working.explained_mask[near]);
        }
    });
    mask
}

/// The working pixel with a label: the one at `place`, or else the first of the eight around.
fn working_pixel_of(working: &WorkingSplit, place: usize, label: u16) -> Option<usize> {
    let labels = &working.regions.labels;
    if labels[place] == label {
        return Some(place);
    }
    labels.around(place).find(|&near| labels[near] == label)
}
