//! The values of parameters set to `auto`, estimated from the image (section 7.3).

use crate::params::{Parameter, Params, Setting, UsedParams};
use crate::photo::LinearImage;

/// Least and largest estimate of σ0, counts.
const NOISE_RANGE: (f64, f64) = (1.0, 16.0);
/// The paper's clipping threshold as a share of full scale.
const CLIP_SHARE: f64 = 240.0 / 255.0;
/// Number of pixels of the paper's images; windows and areas are proportional to the image size.
const PAPER_PIXELS: f64 = 512.0 * 480.0;

/// The limits of the masks, which are needed before the noise is known: clipping threshold, bloom density, minimal
/// intensity. An automatic minimal intensity is the paper's value here; [`used_params`] computes the final value.
pub fn mask_limits(params: &Params, image: &LinearImage) -> crate::photo::MaskLimits {
    let clip_threshold = match params.clip_threshold {
        Setting::Value(value) => value,
        // Integer files saturate at their largest value; a float file does not say where it saturates.
        Setting::Auto => image.saturation.map_or(f64::INFINITY, |s| CLIP_SHARE * f64::from(s)),
    };
    crate::photo::MaskLimits {
        min_intensity: number(params, Parameter::MinIntensity),
        clip_threshold,
        bloom_density: number(params, Parameter::BloomDensity) as usize,
    }
}

/// The values of all parameters. `sigma`: standard deviation of the noise of a band, counts; `None`: the noise could not be
/// measured, and σ0 is the paper's.
///
/// σ0 = 2σ. The radius of cylinders is 4σ0 as in the paper but at most 8 counts, because wider cylinders contain pixels of
/// other objects, and at least 2σ0. Windows and areas have the same share of the image as in the paper. The radius of the dark
/// sphere is 9.2σ0, as in table 6.
pub fn used_params(params: &Params, image: &LinearImage, sigma: Option<f64>) -> UsedParams {
    let limits = mask_limits(params, image);
    let camera_noise = params.camera_noise.value().unwrap_or_else(|| {
        sigma.map_or(Parameter::CameraNoise.spec().paper, |s| (2.0 * s).clamp(NOISE_RANGE.0, NOISE_RANGE.1))
    });
    let automatic_radius = (4.0 * camera_noise).min(8.0).max(2.0 * camera_noise);
    let width = |setting: Setting| setting.value().unwrap_or(automatic_radius / camera_noise);
    let scale = ((image.width() * image.height()) as f64 / PAPER_PIXELS).sqrt();
    let window = (10.0 * scale).round().clamp(6.0, 40.0);
    let dark_per_noise = Parameter::MinIntensity.spec().paper / Parameter::CameraNoise.spec().paper;
    UsedParams {
        clip_threshold: limits.clip_threshold,
        bloom_density: limits.bloom_density as f64,
        camera_noise,
        min_intensity: params.min_intensity.value().unwrap_or(dark_per_noise * camera_noise),
        cylinder_width: width(params.cylinder_width),
        slice_width: width(params.slice_width),
        window_size: params.window_size.value().unwrap_or(window),
        min_area: params.min_area.value().unwrap_or((500.0 * scale * scale).round().max(72.0)),
        illuminant: params.illuminant.direction(),
        ambient: params.ambient,
    }
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

    #[test]
    fn defaults_are_the_papers_numbers_at_the_papers_noise() {
        let used = used_params(&Params::paper(), &image(Some(255.0)), None);
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
        let used = used_params(&all, &image(None), Some(3.0));
        assert_eq!(used.clip_threshold, f64::INFINITY);
        assert_eq!((used.camera_noise, used.radius_counts()), (6.0, 12.0));
        assert_eq!((used.window_size, used.min_area), (10.0, 500.0));
        assert!((used.min_intensity - 55.2).abs() < 1e-9);
        assert_eq!(used_params(&all, &image(Some(2040.0)), Some(1.25)).clip_threshold, 1920.0);
        assert_eq!(used_params(&all, &image(None), Some(1e9)).camera_noise, 16.0);
    }
}
