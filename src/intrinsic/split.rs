//! Section 6: the steps of the split, in order: ambient light, plans of the regions, images, local split, reports.

use super::Intrinsic;
use super::ambient::ambient;
use super::border_mixtures::limit_surface_at_borders;
use super::detail::{Detail, WorkingSplit};
use super::explained_mask::explained_mask;
use super::finish::Finish;
use super::full_resolution::split_photograph;
use super::images::Images;
use super::local::{LocalInput, split_locally};
use super::region::RegionReports;
use super::region_plan::RegionPlan;
use crate::raster::RegionId;
use crate::segment::{AnalysisInput, Branches, FinalRegions, Members, members, neighbors};
use crate::trace::{BranchesSought, Pass, PassBegan, Recorder};
use rayon::prelude::*;

/// Splits every pixel of the picture into body reflection, surface reflection and noise. The ambient light is subtracted before
/// and added to the body reflection afterwards. `detail`: the photograph, where `input` is a working picture with larger
/// pixels; the photograph is split by what was found in the working picture. Only the decisions about the working picture
/// are recorded.
pub fn split<R: Recorder>(
    input: &AnalysisInput,
    regions: &FinalRegions,
    detail: Option<&Detail>,
    recorder: &mut R,
) -> Intrinsic {
    let members = members(regions);
    let ambient = ambient(input, regions, &members);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Ambient });
        recorder.record(ambient);
    }
    let Some(counts) = ambient.subtracted else {
        return Intrinsic { ambient, ..split_from(&[0.0; 3], input, regions, &members, detail, recorder) };
    };
    let light = counts.map(|band| band as f32);
    let without_light = |&color: &[f32; 3]| std::array::from_fn(|band| color[band] - light[band]);
    let pixels = input.pixels.map(without_light);
    let detail_pixels = detail.map(|detail| detail.input.pixels.map(without_light));
    let shifted_detail = detail
        .zip(detail_pixels.as_ref())
        .map(|(detail, pixels)| Detail { input: detail.input.with_pixels(pixels), ..*detail });
    let shifted = FinalRegions {
        labels: regions.labels.clone(),
        hypotheses: regions
            .hypotheses
            .iter()
            .map(|hypothesis| hypothesis.from_origin(&counts.into()))
            .collect(),
        light: regions.light,
    };
    let shifted_input = input.with_pixels(&pixels);
    let mut result =
        split_from(&counts, &shifted_input, &shifted, &members, shifted_detail.as_ref(), recorder);
    result.ambient = ambient;
    for color in result.body.as_mut_slice() {
        *color = std::array::from_fn(|band| color[band] + light[band]);
    }
    for region in &mut result.regions {
        let starts = region.highlight_branches.iter_mut().map(|branch| &mut branch.start);
        let moved = std::iter::once(&mut region.matte_mean).chain(&mut region.highlight_start).chain(starts);
        moved.for_each(|color| *color = std::array::from_fn(|band| color[band] + counts[band]));
    }
    result
}

/// Splits a picture whose colors are measured from `origin`, the ambient light in counts.
fn split_from<R: Recorder>(
    origin: &[f64; 3],
    input: &AnalysisInput,
    regions: &FinalRegions,
    members: &Members,
    detail: Option<&Detail>,
    recorder: &mut R,
) -> Intrinsic {
    let plans: Vec<RegionPlan> = regions
        .hypotheses
        .par_iter()
        .enumerate()
        .map(|(index, hypothesis)| {
            let id = RegionId::from_index(index);
            RegionPlan::new(input, regions, id, hypothesis, members.region(id))
        })
        .collect();
    let mut images = Images::split_undistorted(input, &regions.labels, &plans);
    if input.stopped() {
        return images.unfinished();
    }
    images.restore(origin, input, &regions.labels, &plans, members);
    record_plans(origin, &plans, recorder);
    let limited = limit_surface_at_borders(input, &regions.labels, &plans, &mut images);
    if R::KEEPS && input.refine.border_mixtures {
        recorder.record(limited);
    }
    let model_fits: Vec<bool> = plans.iter().map(|plan| plan.model_fits).collect();
    let explained_mask = explained_mask(input, regions, members, &model_fits, &images.kinds);
    let local_input = LocalInput { input, light: regions.light, explained_mask: &explained_mask };
    let local = split_locally(&local_input, origin, &mut images, recorder);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Labels });
        recorder.labels(&images.kinds);
    }
    let touching = neighbors(&regions.labels, regions.hypotheses.len());
    if let Some(detail) = detail {
        let working = WorkingSplit {
            origin: *origin,
            input,
            regions,
            plans: &plans,
            explained_mask: &explained_mask,
            images: &images,
        };
        return split_photograph(detail, &working, local.as_ref(), touching);
    }
    let reports =
        RegionReports { input, members, kinds: &images.kinds, fit_sigma: input.sigma() }.of(&plans, touching);
    let local_confidence = local.map(|local| local.confidence);
    let finish = Finish {
        input,
        labels: &regions.labels,
        light: regions.light.direction,
        explained_mask: &explained_mask,
        pixel_sigmas: plans.iter().map(|plan| plan.fit.sigma_counts as f32).collect(),
    };
    finish.intrinsic(images, reports, local_confidence.as_ref())
}

/// Records how each region is split. `origin`: the ambient light, counts.
fn record_plans<R: Recorder>(origin: &[f64; 3], plans: &[RegionPlan], recorder: &mut R) {
    if !R::KEEPS {
        return;
    }
    recorder.record(PassBegan { pass: Pass::Vectors });
    for (region, plan) in RegionId::all(plans.len()).zip(plans) {
        let Branches { cores, gaps } = plan.branches().clone();
        if !cores.is_empty() {
            recorder.record(BranchesSought { region, cores, gaps });
        }
        recorder.record(plan.vectors_fitted(region, origin));
    }
}
