//! The report of each region: figures and warnings.

use super::confidence::of_region;
use super::region_plan::RegionPlan;
use super::region_warning::RegionWarning;
use super::{HighlightBranch, RegionReflection};
use crate::color::Vec3;
use crate::raster::{Raster, RegionId};
use crate::segment::{AnalysisInput, Members, Pixels};
use crate::trace::PixelKind;
use rayon::prelude::*;

/// A picture whose regions were split.
pub struct RegionReports<'a> {
    /// The picture.
    pub input: &'a AnalysisInput<'a>,
    /// The pixels of the regions.
    pub members: &'a Members,
    /// The kind of each pixel.
    pub kinds: &'a Raster<PixelKind>,
    /// Standard deviation of the noise of the picture to which the regions' vectors were fitted, counts.
    pub fit_sigma: f64,
}

impl RegionReports<'_> {
    /// The report of each region, by its plan and the regions that it touches, both by [`RegionId::index`].
    pub fn of(&self, plans: &[RegionPlan], touching: Vec<Vec<RegionId>>) -> Vec<RegionReflection> {
        let report = |(index, (plan, neighbors)): (usize, (&RegionPlan, Vec<RegionId>))| {
            let id = RegionId::from_index(index);
            let Self { kinds, fit_sigma, .. } = *self;
            RegionSummary { id, pixels: self.members.region(id), kinds, fit_sigma }
                .report(self.input, plan, neighbors)
        };
        plans.par_iter().zip(touching).enumerate().map(report).collect()
    }
}

/// A region and the result of its split.
struct RegionSummary<'a> {
    /// The region.
    id: RegionId,
    /// The region's pixels.
    pixels: Pixels<'a>,
    /// The kind of each pixel of the picture.
    kinds: &'a Raster<PixelKind>,
    /// Standard deviation of the noise of the picture to which the region's vectors were fitted, counts.
    fit_sigma: f64,
}

impl RegionSummary<'_> {
    /// The report of the region, which was split by `plan` and touches the regions `neighbors`.
    fn report(&self, input: &AnalysisInput, plan: &RegionPlan, neighbors: Vec<RegionId>) -> RegionReflection {
        let pixels = self.pixels;
        let count = |test: &dyn Fn(usize) -> bool| pixels.iter().filter(|&p| test(p as usize)).count();
        let matte_pixels = count(&|pixel| self.kinds[pixel] == PixelKind::Matte);
        let highlight_pixels = pixels.len() - matte_pixels;
        let vectors = &plan.vectors;
        let surface = vectors.surface;
        let angle_deg = surface.map(|surface| crate::color::axis_angle_deg(&vectors.body, &surface));
        let separable = plan.transform().is_some();
        let fit = &plan.fit;
        let highlight_branches = self.branches(input, plan, highlight_pixels);
        RegionReflection {
            id: self.id,
            pixels: pixels.len(),
            matte_pixels,
            highlight_pixels,
            clipped_pixels: count(&|pixel| input.masks.clipped(pixel)),
            body: vectors.body.into(),
            surface: surface.map(Into::into),
            matte_mean: vectors.matte_mean.into(),
            highlight_start: surface.map(|_| plan.starts[0].into()),
            plane_normal: plan.transform().map(|t| t.normal().map(f64::from)),
            angle_deg,
            fit_rms_counts: fit.rms_counts,
            fit_sigma_counts: fit.sigma_counts,
            fit_limit_counts: fit.limits().rms_counts,
            verdict: plan.verdict,
            confidence: of_region(fit, plan.model_fits(), angle_deg.filter(|_| separable)),
            texture: fit.texture,
            separable,
            neighbors,
            warnings: self.warnings(input, plan, angle_deg),
            highlight_branches,
        }
    }

    /// The region's highlight lines and their pixels. An undistorted pixel belongs to the line nearest in color, another pixel to
    /// the line of the highlight nearest in the picture.
    fn branches(
        &self,
        input: &AnalysisInput,
        plan: &RegionPlan,
        highlight_pixels: usize,
    ) -> Vec<HighlightBranch> {
        let Some(test) = &plan.splitter.highlight_test else { return Vec::new() };
        let mut pixels = vec![0usize; plan.starts.len()];
        if let [only] = pixels.as_mut_slice() {
            *only = highlight_pixels;
        } else {
            for pixel in self.pixels.iter() {
                match self.kinds[pixel as usize] {
                    PixelKind::Highlight => pixels[test.nearest(input.pixels[pixel as usize])] += 1,
                    PixelKind::Restored | PixelKind::Lost => pixels[plan.branch_near(input, pixel)] += 1,
                    PixelKind::Matte | PixelKind::Unassigned => {}
                }
            }
        }
        let branch = |(pixels, (start, &body)): (usize, (&Vec3, &f32))| HighlightBranch {
            start: (*start).into(),
            body: f64::from(body),
            pixels,
            share: pixels as f64 / highlight_pixels.max(1) as f64,
        };
        pixels.into_iter().zip(plan.starts.iter().zip(&plan.start_bodies)).map(branch).collect()
    }

    /// The doubts about the region's split.
    fn warnings(
        &self,
        input: &AnalysisInput,
        plan: &RegionPlan,
        angle_deg: Option<f64>,
    ) -> Vec<RegionWarning> {
        let mut warnings = Vec::new();
        match angle_deg {
            None => warnings.push(RegionWarning::NoPlane { keeps_color: plan.splitter.keeps_color }),
            Some(angle) => warnings.extend(plan.angle_limits.warning(angle).map(RegionWarning::Angle)),
        }
        warnings.extend(fit_warnings(input, plan));
        let foot = plan.hypothesis.matte.foot().norm();
        if foot > self.fit_sigma {
            warnings.push(RegionWarning::OffBlack { counts: foot });
        }
        let lost = self.pixels.iter().filter(|&p| self.kinds[p as usize] == PixelKind::Lost).count();
        if lost > 0 {
            warnings.push(RegionWarning::Clipped { pixels: lost });
        }
        if plan.start_bodies.len() > 1 {
            warnings.push(RegionWarning::SeveralHighlights { bodies_counts: plan.start_bodies.clone() });
        }
        warnings
    }
}

/// The warnings about the measures beyond the limits of a region that the model fits.
fn fit_warnings(input: &AnalysisInput, plan: &RegionPlan) -> Vec<RegionWarning> {
    let mut warnings = Vec::new();
    let fit = &plan.fit;
    if fit.poor() {
        warnings.push(RegionWarning::PoorFit {
            has_plane: plan.transform().is_some(),
            rms_counts: fit.rms_counts,
            limit_counts: fit.limits().rms_counts,
        });
    }
    if fit.textured() {
        warnings.push(RegionWarning::Texture { anticorrelation: fit.texture });
    }
    if fit.has_color_of_light() {
        warnings.push(RegionWarning::ColorOfLight { light_share: fit.light_share });
    }
    if fit.has_new_edges() {
        warnings.push(RegionWarning::NewEdges { share: fit.new_edges.share() });
    }
    if let Some(probability) = fit.highlights.filter(|_| fit.lacks_highlights()) {
        warnings.push(RegionWarning::NoHighlights { probability });
    }
    if !plan.model_fits() {
        warnings.push(RegionWarning::ModelFails { is_split_locally: input.refine.local_split });
    }
    warnings
}
