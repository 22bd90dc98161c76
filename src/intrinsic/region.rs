//! The report of each region: figures and warnings.

use super::confidence::of_region;
use super::region_plan::RegionPlan;
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

    fn warnings(&self, input: &AnalysisInput, plan: &RegionPlan, angle_deg: Option<f64>) -> Vec<String> {
        let mut warnings = Vec::new();
        match angle_deg {
            None if plan.splitter.keeps_color => {
                warnings.push("no dichromatic plane: the region is not split".to_owned());
            }
            None => warnings.push("no dichromatic plane: everything counts as body reflection".to_owned()),
            Some(angle) => warnings.extend(plan.angle_limits.warning(angle)),
        }
        warnings.extend(fit_warnings(input, plan));
        let foot = plan.hypothesis.matte.foot().norm();
        if foot > self.fit_sigma {
            warnings.push(format!(
                "the matte line misses black by {foot:.1} counts: ambient light, inter-reflection or no single material"
            ));
        }
        let lost = self.pixels.iter().filter(|&p| self.kinds[p as usize] == PixelKind::Lost).count();
        if lost > 0 {
            warnings.push(format!("{lost} pixels are clipped in every band: their split is a guess"));
        }
        warnings.extend(several_highlights(&plan.start_bodies));
        warnings
    }
}

/// The warnings about the measures beyond the limits of a region that the model fits.
fn fit_warnings(input: &AnalysisInput, plan: &RegionPlan) -> Vec<String> {
    let mut warnings = Vec::new();
    let fit = &plan.fit;
    if fit.poor() {
        let what = if plan.transform().is_some() { "plane" } else { "matte line" };
        let (rms, limit) = (fit.rms_counts, fit.limits().rms_counts);
        warnings
            .push(format!("poor fit: pixels lie {rms:.1} counts from the {what} (rms), {limit:.1} is noise"));
    }
    if fit.textured() {
        warnings.push(format!(
            "texture: surface and body vary against each other (correlation \u{2212}{:.2})",
            fit.texture.min(1.0)
        ));
    }
    if fit.has_color_of_light() {
        warnings.push(format!(
            "the light is uncertain by {:.1} times the angle between body and surface vector: body and surface reflection are \
             one color as far as is known",
            fit.light_share
        ));
    }
    if fit.has_new_edges() {
        warnings.push(format!(
            "part of an object: the split would make new edges at {:.0} % of the border",
            100.0 * fit.new_edges.share()
        ));
    }
    if let Some(highlights) = fit.highlights.filter(|_| fit.lacks_highlights()) {
        warnings.push(format!(
            "print or another color: what the plane takes for surface reflection is a highlight with a probability of {highlights:.2}"
        ));
    }
    if !plan.model_fits() {
        let pixels = if input.refine.local_split {
            "the local split alone divides its pixels"
        } else {
            "its pixels are not split"
        };
        warnings.push(format!("the model does not hold: the plane of the region is not used, {pixels}"));
    }
    warnings
}

/// The warning about highlights on different amounts of body reflection `bodies`, counts; none for fewer than two.
fn several_highlights(bodies: &[f32]) -> Option<String> {
    let (last, others) = bodies.split_last().filter(|(_, others)| !others.is_empty())?;
    let others: Vec<String> = others.iter().map(|body| format!("{body:.0}")).collect();
    let many = ["two", "three", "four"].get(others.len() - 1).copied().unwrap_or("several");
    let others = others.join(", ");
    Some(format!(
        "{many} highlights with different body reflection under them: m_b {others} and {last:.0} counts (7.4)"
    ))
}

#[cfg(test)]
mod tests {
    use super::several_highlights;

    #[test]
    fn only_highlights_on_different_shades_are_worth_a_sentence() {
        assert_eq!((several_highlights(&[]), several_highlights(&[84.0])), (None, None));
        let two = several_highlights(&[84.4, 131.6]).unwrap();
        assert_eq!(
            two,
            "two highlights with different body reflection under them: m_b 84 and 132 counts (7.4)"
        );
        let three = several_highlights(&[84.4, 131.6, 20.0]).unwrap();
        assert!(three.starts_with("three") && three.contains("m_b 84, 132 and 20 counts"), "{three}");
    }
}
