//! The first stage: masks, working picture, and the noise of both pictures.

use super::resolve::{NoiseFindings, detail_noise, mask_limits, scale_factor, used_params};
use super::subject::Subject;
use crate::params::{Baseline, Params, Rules, Setting, UsedParams};
use crate::photo::{
    ClippedArea, ClippedAreaVerdict, CodingError, LinearImage, MaskLimits, Masks, NoiseCorrelation,
    NoiseEstimate, ShotNoise, WorkingPicture, clipped_areas,
};
use crate::raster::{Blocks, Mask};
use crate::segment::AnalysisInput;
use crate::trace::{ClippedAreaJudged, MasksMade, Recorder};
use std::sync::Arc;

/// What the first stage makes: the masks, the working picture, and the noise of both pictures.
pub(super) struct Prepared {
    /// The limits that the masks were made with.
    pub(super) limits: MaskLimits,
    /// The masks of the photograph.
    pub(super) masks: Arc<Masks>,
    /// The working picture.
    pub(super) working: Arc<WorkingPicture>,
    /// The noise of a working pixel, and the coding error of a pixel of the photograph.
    pub(super) noise: Arc<NoiseFindings>,
    /// The coding error of a working pixel; none: the noise contains it.
    pub(super) working_coding: Option<CodingError>,
    /// The noise of a pixel of the photograph; none: the working picture is the photograph, or the noise could not be measured.
    pub(super) detail: Option<NoiseEstimate>,
}

impl Prepared {
    /// The input of the stages: the working picture.
    pub(super) fn working_input<'a>(&'a self, used: &'a UsedParams, rules: Rules) -> AnalysisInput<'a> {
        let input = AnalysisInput::new(&self.working.image, &self.working.masks, used, rules.refine)
            .with_readings(rules.readings)
            .with_marked_pixels(rules.baseline == Some(Baseline::ByHand));
        self.with_errors(input, self.working_coding.as_ref(), self.noise.shot)
    }

    /// The input of the pass at full resolution: the photograph.
    pub(super) fn detail_input<'a>(
        &'a self,
        image: &'a LinearImage,
        used: &'a UsedParams,
        rules: Rules,
    ) -> AnalysisInput<'a> {
        let input = AnalysisInput::new(image, &self.masks, used, rules.refine)
            .with_readings(rules.readings)
            .with_marked_pixels(rules.baseline == Some(Baseline::ByHand));
        let shot = self.detail.map_or(self.noise.shot, |detail| detail.shot);
        self.with_errors(input, self.noise.coding.as_ref(), shot)
    }

    /// An input with a coding error and shot noise, as far as the refinements `coding_error` and `shot_noise` are on.
    pub(super) fn with_errors<'a>(
        &'a self,
        input: AnalysisInput<'a>,
        coding: Option<&'a CodingError>,
        shot: Option<ShotNoise>,
    ) -> AnalysisInput<'a> {
        let input = if input.refine.shot_noise { input.with_shot_noise(shot) } else { input };
        if input.refine.coding_error { input.with_coding(coding, self.noise.extended) } else { input }
    }

    /// The parameters for single pixels of the photograph, which are noisier than working pixels.
    pub(super) fn detail_params(&self, params: &Params, used: UsedParams) -> UsedParams {
        let camera_noise =
            detail_noise(params, &self.noise, used.camera_noise, self.detail.map(|detail| detail.sigma));
        UsedParams { camera_noise, ..used }
    }
}

/// Key of the masks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MaskKey {
    limits: MaskLimits,
    /// Side of a working pixel, pixels.
    factor: usize,
    /// The setting of the camera noise, if the masks depend on it: the noise is to be estimated, or the minimal intensity is
    /// computed from the noise.
    camera_noise: Option<Setting>,
    /// Whether the minimal intensity is computed from the noise.
    automatic_intensity: bool,
    /// Whether that noise is at least the error of lossy compression (refinement `coding_error`).
    least_noise_of_coding: bool,
    /// Whether clipped objects are left out (refinement `clipped_objects`).
    clipped_objects: bool,
    /// The area of the session.
    area: Option<Arc<Mask>>,
}

/// The first stage: its parameters.
pub(super) struct Preparation<'a> {
    subject: &'a Subject,
    params: &'a Params,
    limits: MaskLimits,
    /// Side of a working pixel, pixels.
    factor: usize,
    automatic_noise: bool,
    automatic_intensity: bool,
}

impl<'a> Preparation<'a> {
    pub(super) fn new(subject: &'a Subject, params: &'a Params) -> Self {
        Self {
            subject,
            params,
            limits: mask_limits(params, &subject.image),
            factor: scale_factor(params, &subject.image),
            automatic_noise: params.camera_noise == Setting::Auto,
            automatic_intensity: params.min_intensity == Setting::Auto,
        }
    }

    /// The key of the output.
    pub(super) fn key(&self) -> MaskKey {
        let depends = self.automatic_noise || self.automatic_intensity;
        MaskKey {
            limits: self.limits,
            factor: self.factor,
            camera_noise: depends.then_some(self.params.camera_noise),
            automatic_intensity: self.automatic_intensity,
            least_noise_of_coding: self.automatic_noise
                && self.automatic_intensity
                && self.params.refinements().coding_error,
            clipped_objects: self.params.refinements().clipped_objects,
            area: self.subject.area.clone(),
        }
    }

    /// Makes masks and working picture, and measures the noise.
    pub(super) fn run<R: Recorder>(&self, recorder: &mut R) -> Prepared {
        let (image, factor) = (&self.subject.image, self.factor);
        let (mut masks, mut working) = self.pictures();
        let measured = || NoiseEstimate::measure(&working.image, &working.masks);
        let noise = || noise_findings(image, &masks, if self.automatic_noise { measured() } else { None });
        // Which pixels are dark, which may depend on the noise, does not matter for clipped areas.
        let (noise, areas) = rayon::join(noise, || self.clipped_areas(&working));
        let mut limits = self.limits;
        if self.automatic_intensity {
            limits.min_intensity = used_params(self.params, &working.image, factor, &noise).min_intensity;
            masks = Arc::new(Arc::unwrap_or_clone(masks).with_dark_pixels(image, &limits));
            working = working.with_dark_pixels(&masks, &limits);
        }
        if areas.iter().any(|area| area.verdict == ClippedAreaVerdict::Object) {
            (masks, working) = working.with_objects(masks, &areas);
        }
        let pixels = Blocks::new(1, image.width(), image.height());
        let sparse = || NoiseEstimate::measure_sparsely(image, &masks, &pixels, factor);
        let detail = if factor > 1 && self.automatic_noise { sparse() } else { None };
        if R::KEEPS {
            let made = masks_made(&working.masks, limits, working.image.pixels.len(), noise.sigma);
            recorder.record(made);
            for area in &areas {
                recorder.record(ClippedAreaJudged::from(area));
            }
        }
        let working_coding = noise.coding.as_ref().map(|coding| coding.averaged(factor));
        Prepared { limits, masks, working: Arc::new(working), noise: Arc::new(noise), working_coding, detail }
    }

    /// The clipped areas of the working picture that are judged.
    fn clipped_areas(&self, working: &WorkingPicture) -> Vec<ClippedArea> {
        if !self.params.refinements().clipped_objects {
            return Vec::new();
        }
        clipped_areas(&working.image, &working.masks, self.limits.clip_threshold)
    }

    /// The masks of the photograph, and the working picture.
    fn pictures(&self) -> (Arc<Masks>, WorkingPicture) {
        let Subject { image, area } = self.subject;
        let masks = Masks::new(image, &self.limits);
        let masks = Arc::new(match area {
            Some(area) => masks.within(area),
            None => masks,
        });
        let working = WorkingPicture::new(image, &masks, &self.limits, self.factor);
        (masks, working)
    }
}

/// The errors of an image's values; `windows`: the noise that its windows show. A lossless file may hold a picture that was
/// compressed or demosaiced before; the correlation of the noise between neighboring pixels shows it.
fn noise_findings(image: &LinearImage, masks: &Masks, windows: Option<NoiseEstimate>) -> NoiseFindings {
    let coding = image.coding.clone();
    let sigma = windows.map(|windows| windows.sigma);
    let shot = windows.and_then(|windows| windows.shot);
    if coding.as_ref().is_some_and(CodingError::is_extended) {
        return NoiseFindings { sigma, shot, coding, extended: true };
    }
    let Some(correlation) = NoiseCorrelation::measure(image, masks) else {
        return NoiseFindings { sigma, shot, coding, extended: false };
    };
    let coding = coding.map(|coding| if correlation.is_compressed() { coding.as_extended() } else { coding });
    NoiseFindings { sigma, shot, coding, extended: correlation.is_extended() }
}

/// The record of masks that were made with `limits`, in a picture of `pixels` pixels with noise `sigma`.
pub(super) fn masks_made(masks: &Masks, limits: MaskLimits, pixels: usize, sigma: Option<f64>) -> MasksMade {
    let count = |test: &dyn Fn(usize) -> bool| (0..pixels).filter(|&pixel| test(pixel)).count() as u32;
    MasksMade {
        limits,
        dark: count(&|pixel| masks.dark(pixel) && !masks.in_clipped_object(pixel)),
        distorted: count(&|pixel| !masks.dark(pixel) && masks.distorted(pixel)),
        sigma,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Refine;
    use crate::raster::Raster;

    #[test]
    fn masks_depend_on_coding_error_only_where_their_threshold_depends_on_the_estimated_noise() {
        let image = Arc::new(LinearImage::new(Raster::filled(32, 32, [90.0; 3]), Some(255.0)));
        let subject = Subject { image, area: None };
        let depends = |min_intensity, camera_noise| {
            let keys = [false, true].map(|coding_error| {
                let refine = Refine { coding_error, ..Refine::default() };
                Preparation::new(
                    &subject,
                    &Params { camera_noise, min_intensity, refine, ..Params::default() },
                )
                .key()
            });
            keys[0] != keys[1]
        };
        let given = Setting::Value(20.0);
        assert!(depends(Setting::Auto, Setting::Auto));
        assert!(!depends(given, Setting::Auto) && !depends(Setting::Auto, Setting::Value(2.5)));
    }
}
