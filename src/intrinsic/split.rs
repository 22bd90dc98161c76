//! Section 6: the steps of the split, in order: ambient light, plans of the regions, images, local split, reports.

use super::ambient::ambient;
use super::confidence::ConfidenceInput;
use super::explained_mask::explained_mask;
use super::images::Images;
use super::local::split_locally;
use super::reason::ReasonInput;
use super::region::RegionSummary;
use super::region_plan::RegionPlan;
use super::{Intrinsic, RegionReflection};
use crate::raster::{Mask, Raster, RegionId};
use crate::segment::{AnalysisInput, Branches, FinalRegions, Members, members, neighbors};
use crate::trace::{Ambient, BranchesSought, Pass, PassBegan, Recorder};
use rayon::prelude::*;

/// Splits every pixel of the picture into body reflection, surface reflection and noise. The ambient light is subtracted before
/// and added to the body reflection afterwards.
pub fn split<R: Recorder>(input: &AnalysisInput, regions: &FinalRegions, recorder: &mut R) -> Intrinsic {
    let members = members(regions);
    let ambient = ambient(input, regions, &members);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Ambient });
        recorder.record(ambient);
    }
    let Some(counts) = ambient.subtracted else {
        return Intrinsic { ambient, ..split_from(&[0.0; 3], input, regions, &members, recorder) };
    };
    let light = counts.map(|band| band as f32);
    let pixels = input.pixels.map(|&color| std::array::from_fn(|band| color[band] - light[band]));
    let shifted = FinalRegions {
        labels: regions.labels.clone(),
        hypotheses: regions
            .hypotheses
            .iter()
            .map(|hypothesis| hypothesis.from_origin(&counts.into()))
            .collect(),
        light: regions.light,
    };
    let mut result = split_from(&counts, &input.with_pixels(&pixels), &shifted, &members, recorder);
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
    let mut images = Images::split_undistorted(input, regions, &plans);
    if input.stopped() {
        return images.unfinished();
    }
    images.restore(origin, input, regions, &plans, members);
    record_plans(origin, &plans, recorder);
    let model_fits: Vec<bool> = plans.iter().map(|plan| plan.model_fits).collect();
    let explained_mask = explained_mask(input, regions, members, &model_fits, &images.kinds);
    let local = split_locally(input, origin, regions, &explained_mask, &mut images, recorder);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Labels });
        recorder.labels(&images.kinds);
    }
    let touching = neighbors(&regions.labels, regions.hypotheses.len());
    let reports: Vec<RegionReflection> = plans
        .par_iter()
        .zip(touching)
        .enumerate()
        .map(|(index, (plan, neighbors))| {
            let id = RegionId::from_index(index);
            let summary = RegionSummary { id, pixels: members.region(id), kinds: &images.kinds };
            summary.report(input, plan, neighbors)
        })
        .collect();
    finished(input, regions, &explained_mask, images, reports, local.as_ref())
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

/// The result, with the confidence and the reason of each pixel. `local`: the confidence of the local split, where it ran.
fn finished(
    input: &AnalysisInput,
    regions: &FinalRegions,
    explained_mask: &Mask,
    images: Images,
    reports: Vec<RegionReflection>,
    local: Option<&Raster<f32>>,
) -> Intrinsic {
    let Images { body, surface, noise, kinds } = images;
    let confidence_input = ConfidenceInput {
        labels: &regions.labels,
        explained_mask,
        kinds: &kinds,
        noise: &noise,
        regions: &reports,
    };
    let confidence = confidence_input.confidence(local);
    let reason_input = ReasonInput {
        masks: input.masks,
        labels: &regions.labels,
        explained_mask,
        kinds: &kinds,
        noise: &noise,
        regions: &reports,
        light: regions.light.direction,
    };
    let reasons = reason_input.reasons();
    let ambient = Ambient::default();
    Intrinsic { body, surface, noise, kinds, confidence, reasons, ambient, regions: reports }
}
