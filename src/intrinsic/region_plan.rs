//! Section 6: how the pixels of one region are split: the region's vectors, highlight lines and tests.

use super::angle_limits::AngleLimits;
use super::pixel::PixelSplitter;
use super::vectors::{Vectors, fit_vectors, matte_mean};
use crate::color::{Cylinder, Line, Vec3, rgb};
use crate::raster::RegionId;
use crate::reflection::{AmountRule, HighlightTest, ReflectionTransform};
use crate::segment::{
    AnalysisInput, BranchSearch, Branches, FinalRegions, FittedPlane, LightFindings, Pixels,
    PlanarHypothesis, RegionFit, RegionVerdict,
};
use crate::trace::VectorsFitted;

/// Where a region has several highlight lines, distance from the matte line at which each line begins, standard deviations of
/// the camera noise.
const CLEARANCE_SIGMAS: f64 = 2.0;

/// How one region's pixels are split. Colors are counts above the ambient light.
#[derive(Clone)]
pub(super) struct RegionPlan {
    /// The region's hypothesis, measured from the ambient light.
    pub(super) hypothesis: PlanarHypothesis,
    /// Body and surface reflection vector.
    pub(super) vectors: Vectors,
    /// Splits an undistorted pixel.
    pub(super) splitter: PixelSplitter,
    /// How well the region's pixels agree with the vectors.
    pub(super) fit: RegionFit,
    /// Whether the skewed T of the vectors explains the region, and where not, why; always `Fits` without refinement `region_holds`.
    pub(super) verdict: RegionVerdict,
    /// Whether refinement `region_holds` asks if the skewed T explains the region.
    is_judged: bool,
    /// Whether the region's pixels are split by the vectors: always in the picture to which the vectors were fitted, where the split is
    /// judged; in the photograph only where the model fits.
    pub(super) splits_pixels: bool,
    /// The groups of the region's highlights by the body reflection under them; empty without refinement `second_branch`.
    branches: Branches,
    /// Where each highlight line leaves the matte line, counts, the strongest line first. At least one.
    pub(super) starts: Vec<Vec3>,
    /// Where the lines of the highlight test begin, counts. One line begins at its start. Several lines begin
    /// [`CLEARANCE_SIGMAS`] away from the matte line: otherwise matte pixels near each start would be taken for highlight
    /// pixels.
    test_starts: Vec<Vec3>,
    /// Amount of body reflection m_b at each of `starts`, counts.
    pub(super) start_bodies: Vec<f32>,
    /// Where the picture to which the plan was fitted lies in the picture that the plan splits.
    place: FittedPlace,
    /// The angles between body and surface vector that a split needs.
    pub(super) angle_limits: AngleLimits,
    /// The line from which ε is measured, where the region has no plane (reading `cylinder_noise`).
    noise_line: Option<Line>,
}

impl RegionPlan {
    /// The plan of `region`, whose pixels are `pixels`.
    pub(super) fn new(
        input: &AnalysisInput,
        regions: &FinalRegions,
        region: RegionId,
        hypothesis: &PlanarHypothesis,
        pixels: Pixels,
    ) -> Self {
        let vectors = fit_vectors(input, hypothesis, pixels);
        let angle_limits = AngleLimits::new(input, hypothesis, pixels);
        let rule = amount_rule(input, &vectors, &angle_limits);
        let unsplit = rule.transform().is_none();
        let noise_line =
            (unsplit && input.readings.cylinder_noise).then(|| Line::new(vectors.matte_mean, vectors.body));
        let rule = rule.with_noise_line(noise_line.map(|line| cylinder(input, &line)));
        let keeps_color = unsplit && input.readings.unsplit_without_highlight;
        let origin = fit_origin(&vectors, keeps_color);
        let fitted_plane =
            FittedPlane { origin: &origin, body: &vectors.body, surface: vectors.surface.as_ref() };
        let fit = RegionFit {
            light_share: light_share(&regions.light, rule.transform()),
            ..RegionFit::new(input, &regions.labels, region.get(), pixels, &fitted_plane)
        };
        let start_body = rule.transform().map_or(0.0, |t| t.split(rgb(&hypothesis.start)).body.max(0.0));
        let highlight_test = hypothesis.highlight_test().filter(|_| rule.transform().is_some());
        let plan = Self {
            hypothesis: *hypothesis,
            vectors,
            splitter: PixelSplitter { rule, highlight_test, keeps_color },
            fit,
            verdict: first_verdict(input, &fit),
            is_judged: input.refine.region_holds,
            splits_pixels: true,
            branches: Branches::default(),
            starts: vec![hypothesis.start],
            test_starts: vec![hypothesis.start],
            start_bodies: vec![start_body],
            place: FittedPlace::WHOLE_PICTURE,
            angle_limits,
            noise_line,
        };
        let wanted = input.refine.second_branch && fit.model_fits() && !input.stopped();
        let Some(transform) = rule.transform().filter(|_| wanted) else { return plan };
        let search = BranchSearch {
            input,
            labels: &regions.labels,
            region,
            transform,
            matte_length: hypothesis.matte_length,
            light_interval_deg: regions.light.interval_deg,
        };
        plan.with_branches(input, search.run(pixels), pixels)
    }

    /// This plan with the highlight lines of `branches`. Only more than one branch changes the highlight test and the mean of the
    /// matte pixels. The body vector stays: it is fitted at the outer edge of the cluster, where no highlight pixels are.
    fn with_branches(mut self, input: &AnalysisInput, branches: Branches, pixels: Pixels) -> Self {
        let bodies = branches.bodies();
        self.branches = branches;
        let Some(plane) = self.hypothesis.plane.filter(|_| bodies.len() > 1) else { return self };
        self.starts = bodies.iter().map(|&body| self.vectors.body * f64::from(body)).collect();
        self.start_bodies = bodies;
        let clearance = CLEARANCE_SIGMAS * input.used.camera_noise / plane.angle_rad.sin();
        self.test_starts = self.starts.iter().map(|start| start + plane.surface * clearance).collect();
        let test = HighlightTest::of_lines(&self.hypothesis.matte, &self.test_starts, &plane.surface);
        self.vectors.matte_mean = matte_mean(input, pixels, &test).unwrap_or(self.vectors.matte_mean);
        self.splitter.highlight_test = Some(test);
        self
    }

    /// The transform of equation 13; none where all of a pixel's light is body reflection.
    pub(super) fn transform(&self) -> Option<&ReflectionTransform> {
        self.splitter.rule.transform()
    }

    /// Whether the skewed T of the vectors explains the region.
    pub(super) fn model_fits(&self) -> bool {
        self.verdict.fits()
    }

    /// Judges the region again after another measure was taken. A region that was rejected stays so, for the first reason.
    pub(super) fn judge_again(&mut self) {
        if self.verdict.fits() {
            self.verdict = self.fit.verdict();
        }
    }

    /// The groups of the region's highlights.
    pub(super) fn branches(&self) -> &Branches {
        &self.branches
    }

    /// The place in `starts` of the line of the highlight that contains a pixel or is nearest to the pixel in the picture.
    pub(super) fn branch_near(&self, input: &AnalysisInput, pixel: u32) -> usize {
        if self.starts.len() < 2 {
            return 0;
        }
        let [x, y] = self.place.pixel(input.pixels.width(), pixel as usize);
        self.branches.nearest(x as u32, y as u32)
    }

    /// This plan for the photograph `input`. `place`: where the picture to which this plan was fitted lies in the photograph.
    pub(super) fn at_full_resolution(&self, input: &AnalysisInput, place: FittedPlace) -> Self {
        let mut plan = self.clone();
        plan.place = place;
        plan.splits_pixels = self.model_fits();
        if input.refine.no_negative_surface {
            let noise_line = self.noise_line.map(|line| cylinder(input, &line));
            plan.splitter.rule =
                amount_rule(input, &self.vectors, &self.angle_limits).with_noise_line(noise_line);
        }
        plan
    }

    /// The record of this plan. `origin`: the ambient light, from which the plan's colors are measured, counts.
    pub(super) fn vectors_fitted(&self, region: RegionId, origin: &[f64; 3]) -> VectorsFitted {
        let PlanarHypothesis { matte, start, .. } = self.hypothesis.from_origin(&-Vec3::from(*origin));
        VectorsFitted {
            region,
            body: self.vectors.body,
            surface: self.transform().and(self.vectors.surface),
            matte,
            start,
            starts: self.test_starts.iter().map(|start| start + Vec3::from(*origin)).collect(),
            highlight: self.hypothesis.plane.map(|plane| plane.surface),
            least_offset: self.splitter.rule.least_offset(),
            figures: self.fit.figures(),
            limits: self.fit.limits(),
            model_fits: self.model_fits(),
            is_judged: self.is_judged,
            origin: *origin,
            unsplit: self.splitter.keeps_color,
            noise_line: self.noise_line,
        }
    }
}

/// Where a picture to which plans were fitted lies in a photograph: the picture is a rectangle of the photograph, averaged over blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FittedPlace {
    /// Side of a pixel of the picture, pixels of the photograph; at least 1.
    pub block_side: usize,
    /// Column and row of the photograph where the picture begins, pixels.
    pub corner: [usize; 2],
}

impl FittedPlace {
    /// The picture is the photograph.
    pub(super) const WHOLE_PICTURE: Self = Self { block_side: 1, corner: [0, 0] };

    /// Column and row, in the picture, of pixel `pixel` of the photograph of `width` columns.
    fn pixel(&self, width: usize, pixel: usize) -> [usize; 2] {
        let at = [pixel % width.max(1), pixel / width.max(1)];
        std::array::from_fn(|axis| at[axis].saturating_sub(self.corner[axis]) / self.block_side)
    }
}

/// How regions are split, in their order.
#[derive(Clone, Default)]
pub struct RegionPlans {
    plans: Vec<(FittedPlace, RegionPlan)>,
}

impl RegionPlans {
    /// Plans that were fitted to a picture that lies at `place`.
    pub(super) fn new(plans: impl Iterator<Item = RegionPlan>, place: FittedPlace) -> Self {
        Self { plans: plans.map(|plan| (place, plan)).collect() }
    }

    /// Appends the plans of more regions.
    pub fn extend(&mut self, more: Self) {
        self.plans.extend(more.plans);
    }

    /// The plans for the photograph `input`.
    pub(super) fn at_full_resolution(&self, input: &AnalysisInput) -> Vec<RegionPlan> {
        self.plans.iter().map(|(place, plan)| plan.at_full_resolution(input, *place)).collect()
    }
}

/// Interval of the light as a share of the angle between body and surface vector; 0 where no light is known or all of a pixel's light
/// is body reflection.
fn light_share(light: &LightFindings, transform: Option<&ReflectionTransform>) -> f64 {
    let angle_deg = transform.map(|transform| f64::from(transform.sine()).asin().to_degrees());
    light.interval_deg.zip(angle_deg).map_or(0.0, |(interval_deg, angle_deg)| interval_deg / angle_deg)
}

/// Whether the model fits a region, by the measures that are taken before the pixels are split.
fn first_verdict(input: &AnalysisInput, fit: &RegionFit) -> RegionVerdict {
    if !input.refine.region_holds {
        RegionVerdict::Fits
    } else if input.is_marked() {
        fit.verdict_of_marked()
    } else {
        fit.verdict()
    }
}

/// A point of the plane or line with which the pixels of a region are compared, counts. The split is linear, so that its plane contains
/// black; a region that is not split has its own matte line.
fn fit_origin(vectors: &Vectors, keeps_color: bool) -> Vec3 {
    if keeps_color && vectors.surface.is_none() { vectors.matte_mean } else { Vec3::zeros() }
}

/// The rule that divides the colors of a region with these vectors and these limits of their angle.
fn amount_rule(input: &AnalysisInput, vectors: &Vectors, angle_limits: &AngleLimits) -> AmountRule {
    let Vectors { body, surface, .. } = vectors;
    let least_offset = least_offset(input, vectors);
    AmountRule::with_least_angle(body, surface.as_ref(), least_offset, angle_limits.least_deg)
}

/// The matte cylinder around a line.
fn cylinder(input: &AnalysisInput, line: &Line) -> Cylinder {
    Cylinder::new(line, input.used.radius_counts())
}

/// Distance off the body line below which surface reflection is taken for none, counts (refinement `no_negative_surface`): two standard
/// deviations of the noise, and where compression has an error of its own, of that error at the intensity of the region.
fn least_offset(input: &AnalysisInput, vectors: &Vectors) -> f32 {
    if !input.refine.no_negative_surface {
        return f32::NEG_INFINITY;
    }
    let fit_sigma = if input.has_extended_coding() { input.fit_sigma(&vectors.matte_mean) } else { 0.0 };
    input.used.camera_noise.max(2.0 * fit_sigma) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_of_the_photograph_lies_in_the_pixel_of_the_picture_that_plans_were_fitted_to() {
        let place = FittedPlace { block_side: 3, corner: [10, 20] };
        assert_eq!(
            [0, 10 * 100 + 50, 25 * 100 + 17].map(|pixel| place.pixel(100, pixel)),
            [[0, 0], [13, 0], [2, 1]]
        );
        assert_eq!(FittedPlace::WHOLE_PICTURE.pixel(100, 2517), [17, 25]);
    }

    #[test]
    fn the_share_of_the_light_is_its_interval_over_the_angle_to_the_body() {
        let surface = Vec3::repeat(1.0).normalize();
        let across = Vec3::new(1.0, -1.0, 0.0).normalize();
        let (sin, cos) = 6.0f64.to_radians().sin_cos();
        let transform = ReflectionTransform::new(&(surface * cos + across * sin), &surface);
        let light = |interval_deg| LightFindings { interval_deg, ..LightFindings::default() };
        let share = |interval_deg| light_share(&light(interval_deg), transform.as_ref());
        assert!((share(Some(9.0)) - 1.5).abs() < 1e-4 && (share(Some(3.0)) - 0.5).abs() < 1e-4);
        let far = RegionFit { sigma_counts: 1.0, limit_sigmas: 1.5, ..RegionFit::default() };
        let fits = |interval_deg| RegionFit { light_share: share(interval_deg), ..far }.model_fits();
        assert!(!fits(Some(9.0)), "the body is not told from the light");
        assert!(fits(Some(3.0)) && fits(None), "a known light, and a light that was given");
        assert!(light_share(&light(Some(9.0)), None).abs() < 1e-9, "no plane");
    }
}
