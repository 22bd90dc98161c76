//! The values of parameters set to `auto`, estimated from the image (section 7.3).

use crate::params::{Parameter, Params, Setting, UsedParams};
use crate::photo::{CodingError, FULL_SCALE_COUNTS, LinearImage, ShotNoise};

/// Least and largest estimate of σ0, counts. Below 1.5 counts every limit is so narrow that windows take noise for lines.
const NOISE_RANGE: (f64, f64) = (1.5, 16.0);
/// The intensity, as a share of full scale, at which σ0 contains the error of lossy compression, which the windows do not see:
/// that of a typical matte pixel.
const TYPICAL_INTENSITY: f64 = 0.25;
/// σ0 in standard deviations of the noise of a band.
const NOISE_SIGMAS: f64 = 2.0;
/// The paper's clipping threshold as a share of full scale.
const CLIP_SHARE: f64 = Parameter::ClipThreshold.spec().paper / FULL_SCALE_COUNTS;
/// Largest automatic radius of cylinders, counts: wider cylinders contain pixels of other objects.
const MOST_RADIUS_COUNTS: f64 = 8.0;
/// Least automatic radius of cylinders, σ0.
const LEAST_RADIUS_NOISES: f64 = 2.0;
/// Least and largest automatic side of a window, pixels.
const WINDOW_RANGE_PX: (f64, f64) = (6.0, 40.0);
/// Least automatic minimal area, pixels: two of the smallest windows.
const LEAST_AREA_PX: f64 = 72.0;
/// Number of pixels of the paper's images; windows and areas are proportional to the image size.
const PAPER_PIXELS: f64 = 512.0 * 480.0;
/// Number of pixels of an automatic working picture: twice those of the paper's images.
const WORKING_PIXELS: f64 = 0.5e6;

/// Side of a working pixel, pixels of the photograph: the parameter `scale`, or automatically √(pixels / 0.5 million), rounded.
pub fn scale_factor(params: &Params, image: &LinearImage) -> usize {
    let automatic = || ((image.width() * image.height()) as f64 / WORKING_PIXELS).sqrt().round().max(1.0);
    params.scale.value().unwrap_or_else(automatic) as usize
}

/// The limits of the masks, which are needed before the noise is known: clipping threshold, bloom density, minimal
/// intensity. An automatic minimal intensity is the paper's value here; [`used_params`] computes the final value.
pub fn mask_limits(params: &Params, image: &LinearImage) -> crate::photo::MaskLimits {
    let clip_threshold = match params.clip_threshold {
        Setting::Value(value) => value,
        // Integer files saturate at their largest value; a float file where many values are equal, if anywhere.
        Setting::Auto => image.saturation.map_or(f64::INFINITY, |s| CLIP_SHARE * f64::from(s)),
    };
    crate::photo::MaskLimits {
        min_intensity: number(params, Parameter::MinIntensity),
        clip_threshold,
        bloom_density: number(params, Parameter::BloomDensity) as usize,
    }
}

/// The errors of an image's values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NoiseFindings {
    /// Standard deviation of the noise of a band in windows, counts; `None`: it could not be measured, and σ0 is the paper's.
    pub sigma: Option<f64>,
    /// The noise of a pixel as a function of the intensity; `None`: it was not found to grow with the light, or σ0 was given.
    pub shot: Option<ShotNoise>,
    /// The error of the file's way of storing values; `None`: the noise contains it.
    pub coding: Option<CodingError>,
    /// Whether the errors of neighboring pixels are alike: after lossy compression or demosaicing.
    pub extended: bool,
}

/// The values of all parameters, for the working picture `image`, whose pixels are blocks of `factor` × `factor` pixels of the
/// photograph, and for the errors of its values.
///
/// σ0 = 2σ, and at least twice the error of lossy compression, which windows do not see. The radius of cylinders is 4σ0 as in
/// the paper but at most 8 counts, because wider cylinders contain pixels of other objects, and at least 2σ0. Windows and areas have the same share of the image as in the paper. The radius of the dark
/// sphere is 9.2σ0, as in table 6.
pub fn used_params(params: &Params, image: &LinearImage, factor: usize, noise: &NoiseFindings) -> UsedParams {
    let limits = mask_limits(params, image);
    let camera_noise = params.camera_noise.value().unwrap_or_else(|| {
        let Some(sigma) = noise.sigma else { return Parameter::CameraNoise.spec().paper };
        let unseen = unseen_sigma(params, noise, factor);
        (NOISE_SIGMAS * sigma).max(NOISE_SIGMAS * unseen).clamp(NOISE_RANGE.0, NOISE_RANGE.1)
    });
    let paper_radius = Parameter::CylinderWidth.spec().paper * camera_noise;
    let automatic_radius = paper_radius.min(MOST_RADIUS_COUNTS).max(LEAST_RADIUS_NOISES * camera_noise);
    let width = |setting: Setting| setting.value().unwrap_or(automatic_radius / camera_noise);
    let scale = ((image.width() * image.height()) as f64 / PAPER_PIXELS).sqrt();
    let paper_window = Parameter::WindowSize.spec().paper;
    let window = (paper_window * scale).round().clamp(WINDOW_RANGE_PX.0, WINDOW_RANGE_PX.1);
    let area = (Parameter::MinArea.spec().paper * scale * scale).round().max(LEAST_AREA_PX);
    let dark_per_noise = Parameter::MinIntensity.spec().paper / Parameter::CameraNoise.spec().paper;
    UsedParams {
        clip_threshold: limits.clip_threshold,
        bloom_density: limits.bloom_density as f64,
        camera_noise,
        min_intensity: params.min_intensity.value().unwrap_or(dark_per_noise * camera_noise),
        cylinder_width: width(params.cylinder_width),
        slice_width: width(params.slice_width),
        window_size: params.window_size.value().unwrap_or(window),
        min_area: params.min_area.value().unwrap_or(area),
        scale: factor as f64,
        illuminant: params.illuminant.direction(),
        second_illuminant: params.second_illuminant.direction(),
        ambient: params.ambient,
    }
}

/// Standard deviation of the coding error that windows do not show, counts, of a mean of `side` × `side` pixels of ordinary intensity;
/// 0 where windows show all.
fn unseen_sigma(params: &Params, noise: &NoiseFindings, side: usize) -> f64 {
    let coding = noise.coding.as_ref().filter(|_| params.refinements().coding_error);
    let extended = coding.filter(|coding| coding.is_extended());
    extended.map_or(0.0, |coding| coding.averaged(side).at_share(TYPICAL_INTENSITY))
}

/// σ0 of a single pixel of the photograph, counts: twice the standard deviation `sigma` measured there, or twice the coding error that
/// windows do not show, and never below the `working` σ0, which is that of a mean of pixels.
pub fn detail_noise(params: &Params, noise: &NoiseFindings, working: f64, sigma: Option<f64>) -> f64 {
    let unseen = unseen_sigma(params, noise, 1);
    sigma.map_or(working, |sigma| (NOISE_SIGMAS * sigma.max(unseen)).min(NOISE_RANGE.1).max(working))
}

fn number(params: &Params, parameter: Parameter) -> f64 {
    params.get(parameter).value().unwrap_or(parameter.spec().paper)
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use crate::raster::Raster;

    fn image(saturation: Option<f32>) -> LinearImage {
        LinearImage::new(Raster::filled(512, 480, [9.0; 3]), saturation)
    }

    fn of_sigma(sigma: f64) -> NoiseFindings {
        NoiseFindings { sigma: Some(sigma), ..NoiseFindings::default() }
    }

    #[test]
    fn lossy_compression_raises_the_noise_that_windows_measure() {
        use crate::photo::{Compression, LossyCompression, ToneCurve};
        let of = |compression| NoiseFindings {
            sigma: Some(0.2),
            coding: CodingError::of_samples(compression, 255, &ToneCurve::Srgb, 255.0),
            ..NoiseFindings::default()
        };
        let used =
            |noise: &NoiseFindings, params: &Params| used_params(params, &image(None), 1, noise).camera_noise;
        let jpeg =
            of(Compression::Lossy(LossyCompression { quantization_step: 3.0, chroma_subsampled: true }));
        let raised = used(&jpeg, &Params::default());
        assert!(raised > 1.8 && raised < 2.1, "{raised}");
        assert_eq!(used(&of(Compression::Lossless), &Params::default()), 1.5, "rounding is in the windows");
        let mut without = Params::default();
        without.refine.coding_error = false;
        assert_eq!(used(&jpeg, &without), 1.5);
    }

    #[test]
    fn defaults_are_the_papers_numbers_at_the_papers_noise() {
        let used = used_params(&Params::paper(), &image(Some(255.0)), 1, &NoiseFindings::default());
        assert_eq!((used.clip_threshold, used.camera_noise, used.min_area), (240.0, 2.5, 500.0));
        assert_eq!((used.radius_counts(), used.slice_half_width_counts()), (10.0, 10.0));
    }

    #[test]
    fn automatic_numbers_follow_the_noise_and_the_file() {
        let all = Params {
            bloom_density: Setting::Auto,
            min_intensity: Setting::Auto,
            window_size: Setting::Auto,
            min_area: Setting::Auto,
            ..Params::default()
        };
        let used = used_params(&all, &image(None), 1, &of_sigma(3.0));
        assert_eq!(used.clip_threshold, f64::INFINITY);
        assert_eq!((used.camera_noise, used.radius_counts()), (6.0, 12.0));
        assert_eq!((used.window_size, used.min_area), (10.0, 500.0));
        assert!((used.min_intensity - 55.2).abs() < 1e-9);
        assert_eq!(used_params(&all, &image(Some(2040.0)), 1, &of_sigma(1.25)).clip_threshold, 1920.0);
        assert_eq!(used_params(&all, &image(None), 1, &of_sigma(1e9)).camera_noise, 16.0);
    }

    #[test]
    fn an_automatic_working_picture_has_half_a_megapixel() {
        let of = |width, height, params: &Params| {
            scale_factor(params, &LinearImage::new(Raster::filled(width, height, [9.0; 3]), None))
        };
        let automatic = Params::default();
        assert_eq!(of(512, 480, &automatic), 1);
        assert_eq!(of(1280, 870, &automatic), 1);
        assert_eq!(of(2048, 1920, &automatic), 3);
        assert_eq!(of(4000, 3000, &automatic), 5);
        assert_eq!(of(0, 0, &automatic), 1);
        assert_eq!(of(2048, 1920, &Params::paper()), 1);
        assert_eq!(of(64, 48, &Params { scale: Setting::Value(4.0), ..Params::default() }), 4);
    }

    #[test]
    fn a_pixel_of_the_photograph_is_at_least_as_noisy_as_a_working_pixel() {
        assert_eq!(
            [None, Some(0.2), Some(2.5), Some(99.0)].map(|sigma| detail_noise(
                &Params::default(),
                &NoiseFindings::default(),
                1.0,
                sigma
            )),
            [1.0, 1.0, 5.0, 16.0]
        );
    }
}
