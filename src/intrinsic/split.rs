//! Section 6: the steps of the split, in order: ambient light, plans of the regions, images, local split, reports.

use super::Intrinsic;
use super::ambient::ambient;
use super::border_edges::reject_regions_with_new_edges;
use super::border_mixtures::limit_surface_at_borders;
use super::explained_mask::{Explained, explained_mask};
use super::far_colors::remove_far_colors;
use super::finish::Finish;
use super::images::Images;
use super::local::{HueRestored, Lamps, LocalInput, LocalSplit, Observations, Regions, split_locally};
use super::plane_evidence::reject_regions_without_evidence;
use super::region::RegionReports;
use super::region_plan::{FittedPlace, RegionPlan, RegionPlans};
use crate::color::Line;
use crate::raster::{Mask, Raster, RegionId};
use crate::segment::{AnalysisInput, Branches, FinalRegions, Members, PlanarHypothesis, members, neighbors};
use crate::trace::{Ambient, BordersLimited, BranchesSought, Pass, PassBegan, Recorder};
use rayon::prelude::*;
use std::sync::Arc;

/// The split of the working picture, and what the photograph is split by.
pub struct WorkingSplit {
    /// The intrinsic images of the working picture, and the reports of the regions.
    pub intrinsic: Arc<Intrinsic>,
    /// What [`split_photograph`](super::split_photograph) needs beside the images.
    pub(super) found: Found,
}

impl WorkingSplit {
    /// How each region is split.
    pub fn judged_plans(self) -> JudgedPlans {
        JudgedPlans(self.found.plans)
    }
}

/// How each region is split, by [`RegionId::index`], after all tests of the regions.
pub struct JudgedPlans(Vec<RegionPlan>);

impl JudgedPlans {
    /// Of each region, whether the model fits the region and separates body and surface reflection.
    pub fn separated(&self) -> Vec<bool> {
        self.0.iter().map(|plan| plan.model_fits() && plan.transform().is_some()).collect()
    }

    /// The plans of the regions that are `kept`, by [`RegionId::index`]. `place`: where the picture that was split lies in the photograph.
    pub fn kept(self, kept: &[bool], place: FittedPlace) -> RegionPlans {
        let plans = self.0.into_iter().zip(kept).filter(|(_, is_kept)| **is_kept);
        RegionPlans::new(plans.map(|(plan, _)| plan), place)
    }
}

/// What the split of the working picture found.
pub(super) struct Found {
    /// The ambient light that was subtracted, counts.
    pub(super) origin: [f64; 3],
    /// Standard deviation of the noise of a working pixel, counts.
    pub(super) sigma: f64,
    /// How each region is split, by [`RegionId::index`].
    pub(super) plans: Vec<RegionPlan>,
    /// The working pixels that the skewed T of their region explains.
    pub(super) explained_mask: Mask,
    /// The working pixels in which another color replaces the body reflection of their region; none where there is no such pixel.
    pub(super) replaced: Option<Mask>,
    /// What the local split found; none where it did not run.
    pub(super) local: Option<LocalSplit>,
    /// The neighbors of each region, by [`RegionId::index`].
    pub(super) touching: Vec<Vec<RegionId>>,
}

/// Splits every pixel of the picture into body reflection, surface reflection and noise. The ambient light is subtracted before
/// and added to the body reflection afterwards.
pub fn split<R: Recorder>(input: &AnalysisInput, regions: &FinalRegions, recorder: &mut R) -> WorkingSplit {
    let members = members(regions);
    let ambient = ambient(input, regions, &members);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Ambient });
        recorder.record(ambient);
    }
    let (mut intrinsic, found) = from_ambient(&ambient, input, regions, |origin, input, regions| {
        split_from(origin, input, regions, &members, recorder)
    });
    add_ambient(&mut intrinsic, ambient);
    WorkingSplit { intrinsic: Arc::new(intrinsic), found }
}

/// How [`split`] splits the regions, without the images and the local split, which take most of the time.
pub fn judged_plans(input: &AnalysisInput, regions: &FinalRegions) -> JudgedPlans {
    let members = members(regions);
    let ambient = ambient(input, regions, &members);
    from_ambient(&ambient, input, regions, |origin, input, regions| {
        let lamps = Lamps::new(&regions.light, regions.second_lamp_mask.as_ref());
        let matte = matte_lines(regions);
        let local_regions = Regions { labels: &regions.labels, members: &members, matte: &matte };
        let (restored, plans) = rayon::join(
            || HueRestored::new(input, origin, &regions.light, lamps.as_ref()),
            || plans(input, regions, &members),
        );
        let picture = PictureToSplit { origin, input, restored: restored.as_ref(), lamps: lamps.as_ref() };
        JudgedPlans(split_by_planes(&picture, plans, &local_regions).plans)
    })
}

/// What `work` makes of the picture and the regions when their colors are measured from the ambient light that is to be subtracted, its first
/// argument, counts.
fn from_ambient<T>(
    ambient: &Ambient,
    input: &AnalysisInput,
    regions: &FinalRegions,
    work: impl FnOnce(&[f64; 3], &AnalysisInput, &FinalRegions) -> T,
) -> T {
    let Some(counts) = ambient.subtracted else { return work(&[0.0; 3], input, regions) };
    let pixels = without_light(input.pixels, &counts);
    let from_light = |hypothesis: &PlanarHypothesis| hypothesis.from_origin(&counts.into());
    let shifted = FinalRegions {
        labels: regions.labels.clone(),
        hypotheses: regions.hypotheses.iter().map(from_light).collect(),
        light: regions.light,
        second_lamp_mask: regions.second_lamp_mask.clone(),
    };
    work(&counts, &input.with_pixels(&pixels), &shifted)
}

/// The colors without the ambient light `counts`.
pub(super) fn without_light(pixels: &Raster<[f32; 3]>, counts: &[f64; 3]) -> Raster<[f32; 3]> {
    let light = counts.map(|band| band as f32);
    pixels.map(|color| std::array::from_fn(|band| color[band] - light[band]))
}

/// Adds the ambient light that was subtracted to the body reflection and to the colors of the reports.
pub(super) fn add_ambient(intrinsic: &mut Intrinsic, ambient: Ambient) {
    intrinsic.ambient = ambient;
    let Some(counts) = ambient.subtracted else { return };
    let light = counts.map(|band| band as f32);
    for color in intrinsic.body.as_mut_slice() {
        *color = std::array::from_fn(|band| color[band] + light[band]);
    }
    for region in &mut intrinsic.regions {
        let starts = region.highlight_branches.iter_mut().map(|branch| &mut branch.start);
        let moved = std::iter::once(&mut region.matte_mean).chain(&mut region.highlight_start).chain(starts);
        moved.for_each(|color| *color = std::array::from_fn(|band| color[band] + counts[band]));
    }
}

/// Splits a picture whose colors are measured from `origin`, the ambient light in counts.
fn split_from<R: Recorder>(
    origin: &[f64; 3],
    input: &AnalysisInput,
    regions: &FinalRegions,
    members: &Members,
    recorder: &mut R,
) -> (Intrinsic, Found) {
    let lamps = Lamps::new(&regions.light, regions.second_lamp_mask.as_ref());
    let matte = matte_lines(regions);
    let local_regions = Regions { labels: &regions.labels, members, matte: &matte };
    let (restored, plans) = rayon::join(
        || HueRestored::new(input, origin, &regions.light, lamps.as_ref()),
        || plans(input, regions, members),
    );
    let picture = PictureToSplit { origin, input, restored: restored.as_ref(), lamps: lamps.as_ref() };
    let SplitByPlanes { plans, mut images, mut limited, observations } =
        split_by_planes(&picture, plans, &local_regions);
    let mut found = Found {
        origin: *origin,
        sigma: input.sigma(),
        plans,
        explained_mask: Mask::default(),
        replaced: None,
        local: None,
        touching: Vec::new(),
    };
    if input.stopped() {
        return (images.unfinished(), found);
    }
    let plans = &found.plans;
    record_plans(origin, plans, recorder);
    if R::KEEPS && input.refine.border_mixtures {
        let fits = |label: u16| RegionId::from_label(label).is_some_and(|id| plans[id.index()].model_fits());
        limited.pixels.retain(|limited| fits(regions.labels[limited.pixel.index()]));
        recorder.record(limited);
    }
    let model_fits: Vec<bool> = plans.iter().map(RegionPlan::model_fits).collect();
    let (Explained { mask, replaced }, touching) = rayon::join(
        || explained_mask(input, regions, members, &model_fits, &images),
        || neighbors(&regions.labels, regions.hypotheses.len()),
    );
    (found.explained_mask, found.replaced, found.touching) = (mask, replaced, touching);
    remove_far_colors(input, &regions.labels, plans, &mut found.explained_mask);
    let explained_mask = &found.explained_mask;
    let local_input = LocalInput {
        input,
        restored: restored.as_ref(),
        light: regions.light,
        lamps: lamps.as_ref(),
        explained_mask,
        replaced: found.replaced.as_ref(),
        observations,
        regions: local_regions,
    };
    found.local = split_locally(&local_input, origin, &mut images, recorder);
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Labels });
        recorder.labels(&images.kinds);
    }
    let reports = RegionReports { input, members, kinds: &images.kinds, fit_sigma: found.sigma }
        .of(plans, found.touching.clone());
    let finish = Finish {
        input,
        labels: &regions.labels,
        light: regions.light.direction,
        explained_mask: &found.explained_mask,
        pixel_sigmas: plans.iter().map(|plan| plan.fit.sigma_counts as f32).collect(),
    };
    let local_confidence = found.local.as_ref().map(|local| local.confidence.clone());
    (finish.intrinsic(images, reports, local_confidence), found)
}

/// A picture that was split by the planes of its regions.
struct SplitByPlanes<'a> {
    /// How each region is split, by [`RegionId::index`], after all tests.
    plans: Vec<RegionPlan>,
    /// The images by these plans, those of the regions that the model does not fit among them.
    images: Images,
    /// The pixels at borders whose surface reflection was limited.
    limited: BordersLimited,
    /// What the tests observed around the lit pixels; none where no region was tested by it.
    observations: Option<Observations<'a>>,
}

/// A picture before its split.
struct PictureToSplit<'a> {
    /// The ambient light from which the colors are measured, counts.
    origin: &'a [f64; 3],
    /// The picture.
    input: &'a AnalysisInput<'a>,
    /// The bands that were restored by hue; none where there are none.
    restored: Option<&'a HueRestored>,
    /// The lamps; none where no light is known or a band of the light is zero.
    lamps: Option<&'a Lamps>,
}

/// Splits a picture by the `plans` of its regions, and rejects the regions that the model does not fit. A run that was stopped restores and
/// rejects nothing.
fn split_by_planes<'a>(
    picture: &PictureToSplit,
    mut plans: Vec<RegionPlan>,
    regions: &Regions<'a>,
) -> SplitByPlanes<'a> {
    let &PictureToSplit { origin, input, restored, lamps } = picture;
    let mut images = Images::split_undistorted(input, regions.labels, &plans);
    if input.stopped() {
        return SplitByPlanes { plans, images, limited: BordersLimited::default(), observations: None };
    }
    images.restore(origin, input, regions.labels, &plans, regions.members);
    let limited = limit_surface_at_borders(input, regions.labels, &plans, &mut images);
    reject_regions_with_new_edges(input, regions.labels, regions.members, &images, &mut plans);
    let observed = restored.map_or(*input, |restored| restored.input(input));
    let observations = reject_regions_without_evidence(input, &observed, lamps, regions, &images, &mut plans);
    SplitByPlanes { plans, images, limited, observations }
}

/// The matte line of each region, by [`RegionId::index`], counts above the ambient light.
fn matte_lines(regions: &FinalRegions) -> Vec<Line> {
    regions.hypotheses.iter().map(|hypothesis| hypothesis.matte).collect()
}

/// How each region is split, by [`RegionId::index`].
fn plans(input: &AnalysisInput, regions: &FinalRegions, members: &Members) -> Vec<RegionPlan> {
    let hypotheses = regions.hypotheses.par_iter().enumerate();
    let plan = |(index, hypothesis)| {
        let id = RegionId::from_index(index);
        RegionPlan::new(input, regions, id, hypothesis, members.region(id))
    };
    hypotheses.map(plan).collect()
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
