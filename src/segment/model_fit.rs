//! Does the model fit a region: is the region one object with one skewed T, as section 3 assumes? (refinement `region_holds`)
//!
//! Two measures decide. The first is the root mean square distance from the dichromatic plane: the noise on plastic (1.0 σ),
//! 2–16 σ on printed or grown surfaces. The second is texture: a pattern of two colors lies in one plane as exactly as a
//! highlight does (distance 1.0 σ, but the body image 13 dB worse than the input). Within a few pixels of such a pattern the
//! surface reflection rises where the body reflection falls, while a highlight does not change the body reflection under it.
//! The texture is the anticorrelation of body and surface reflection, of which the means over 9 × 9 pixels and the share of
//! the noise are subtracted. Over 45 scenes the texture is below .24 in all regions that the plane splits well, and above .45
//! in nearly all regions in which the split is worse than the input.

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::color::{Vec3, dot, rgb};
use crate::raster::LabelMap;
use crate::reflection::ReflectionTransform;
use crate::trace::FitLimits;
use nalgebra::Matrix3;

/// Largest root mean square distance from plane or line that the noise explains, σ.
pub const POOR_FIT: f64 = 1.5;
/// A region is textured if the anticorrelation of body and surface reflection exceeds this value …
pub const TEXTURE_CORRELATION: f64 = 0.25;
/// … and the body reflection falls by more than this share of the rise of the surface reflection.
const TEXTURE_SLOPE: f64 = 0.2;
/// Largest number of pixels whose distance from the plane is measured, evenly chosen.
const SAMPLES: usize = 6000;
/// Largest number of pixels that are compared with their surroundings, evenly chosen.
const TEXTURE_SAMPLES: usize = 2000;
/// Surroundings of a pixel along each axis, in steps of 2 px: a grid of 5 × 5 pixels.
const STEPS: std::ops::RangeInclusive<isize> = -2..=2;
/// Least variance of body and surface reflection, as a share of the noise's variance.
const NOISE_FLOOR: f64 = 0.15;

/// The plane that a region's pixels are compared with; a line where there is no surface vector.
#[derive(Clone, Copy, Debug)]
pub struct FittedPlane<'a> {
    /// A point of the plane, counts.
    pub origin: &'a Vec3,
    /// Unit vector of body reflection.
    pub body: &'a Vec3,
    /// Unit vector of surface reflection; `None`: the pixels are compared with the line along `body`.
    pub surface: Option<&'a Vec3>,
}

/// How well the reflection vectors of a region explain the region's pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RegionFit {
    /// Root mean square distance of the undistorted pixels from the plane, or from the line where there is no plane, counts.
    pub rms_counts: f64,
    /// Anticorrelation of body and surface reflection from pixel to pixel: 1 for a print, about 0 for highlights.
    pub texture: f64,
    /// Decrease of body reflection per increase of surface reflection from pixel to pixel.
    pub texture_slope: f64,
}

impl RegionFit {
    /// Measures how well a plane fits the pixels of region `id` in `labels`.
    pub fn new(
        input: &AnalysisInput,
        labels: &LabelMap,
        id: u16,
        pixels: Pixels,
        plane: &FittedPlane,
    ) -> Self {
        let FittedPlane { origin, body, surface } = *plane;
        let transform = surface.and_then(|surface| ReflectionTransform::new(body, surface));
        let (from, along) = (rgb(origin), rgb(body));
        let (mut squares, mut count) = (0.0, 0usize);
        for pixel in pixels.sample(SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize)) {
            let color = input.pixels[pixel as usize];
            let v = std::array::from_fn(|band| color[band] - from[band]);
            let distance2 = match &transform {
                Some(transform) => dot(v, transform.normal()).powi(2),
                None => (dot(v, v) - dot(v, along).powi(2)).max(0.0) / 2.0,
            };
            squares += f64::from(distance2);
            count += 1;
        }
        let rms_counts = (squares / count.max(1) as f64).sqrt();
        let (texture, texture_slope) = transform.map_or((0.0, 0.0), |transform| {
            texture(&variation(input, labels, id, pixels), &transform, input.sigma())
        });
        Self { rms_counts, texture, texture_slope }
    }

    /// Whether the pixels lie farther from the plane than the noise explains; `sigma`: noise of a band, counts.
    pub fn poor(&self, sigma: f64) -> bool {
        self.rms_counts > POOR_FIT * sigma
    }

    /// Whether surface reflection rises where body reflection falls, from pixel to pixel.
    pub fn textured(&self) -> bool {
        self.texture > TEXTURE_CORRELATION && self.texture_slope > TEXTURE_SLOPE
    }

    /// Largest measures of a region that the model fits.
    pub fn limits(sigma: f64) -> FitLimits {
        FitLimits {
            rms_counts: POOR_FIT * sigma,
            rms_sigmas: POOR_FIT,
            texture: TEXTURE_CORRELATION,
            texture_slope: TEXTURE_SLOPE,
        }
    }

    /// Whether the model fits the region: one skewed T explains the pixels.
    pub fn model_fits(&self, sigma: f64) -> bool {
        !self.poor(sigma) && !self.textured()
    }
}

/// The variation of colors from pixel to pixel.
struct Variation {
    /// Mean of v·vᵀ, v the difference of a color from the mean color of the surroundings, counts².
    covariance: Matrix3<f64>,
    /// Variance of each band by the noise alone, σ².
    noise: f64,
}

/// The variation within region `id`; surroundings count as far as they belong to the region and are usable.
fn variation(input: &AnalysisInput, labels: &LabelMap, id: u16, pixels: Pixels) -> Variation {
    let (width, height) = (labels.width() as isize, labels.height() as isize);
    let mut sum = Matrix3::zeros();
    let (mut noise, mut count) = (0.0, 0.0);
    for pixel in pixels.sample(TEXTURE_SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize)) {
        let (x, y) = (pixel as isize % width, pixel as isize / width);
        let mut mean = [0.0f32; 3];
        let mut places = 0.0f32;
        for v in STEPS.map(|step| y + 2 * step).filter(|v| (0..height).contains(v)) {
            for u in STEPS.map(|step| x + 2 * step).filter(|u| (0..width).contains(u)) {
                let near = (v * width + u) as usize;
                if labels[near] == id && input.masks.usable(near) {
                    let color = input.pixels[near];
                    mean.iter_mut().zip(color).for_each(|(mean, band)| *mean += band);
                    places += 1.0;
                }
            }
        }
        let color = input.pixels[pixel as usize];
        let v: [f32; 3] = std::array::from_fn(|band| color[band] - mean[band] / places);
        let v = crate::color::vec3(v);
        sum += v * v.transpose();
        noise += 1.0 - 1.0 / f64::from(places);
        count += 1.0f64;
    }
    let count = count.max(1.0);
    Variation { covariance: sum / count, noise: noise / count }
}

/// Anticorrelation of body and surface reflection, and the slope of the decrease; the covariance of the noise is subtracted.
fn texture(variation: &Variation, transform: &ReflectionTransform, sigma: f64) -> (f64, f64) {
    let [body_row, surface_row] = transform.amount_rows().map(crate::color::vec3);
    let per_band = sigma * sigma * variation.noise;
    let covariance = |a: &Vec3, b: &Vec3| (a.transpose() * variation.covariance * b)[0] - per_band * a.dot(b);
    let least = |row: &Vec3| NOISE_FLOOR * per_band * row.norm_squared() + 1e-12;
    let body = covariance(&body_row, &body_row).max(least(&body_row));
    let surface = covariance(&surface_row, &surface_row).max(least(&surface_row));
    let both = covariance(&body_row, &surface_row);
    (-both / (body * surface).sqrt(), -both / surface)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::Members;
    use crate::segment::testing::Drawing;

    /// The fit of the true reflection vectors to a picture in which `amounts` gives the body and surface reflection of each
    /// pixel.
    fn fit(amounts: impl Fn(f64, f64) -> (f64, f64)) -> RegionFit {
        let (body, surface) = (Vec3::new(0.9, 0.4, 0.2).normalize(), Vec3::repeat(1.0).normalize());
        let drawing = Drawing::by_place(40, |x, y| {
            let (b, s) = amounts(x, y);
            body * b + surface * s
        });
        let labels = LabelMap::filled(40, 40, 1);
        let members = Members::of(&labels, 1);
        let input = drawing.input();
        let plane = FittedPlane { origin: &Vec3::zeros(), body: &body, surface: Some(&surface) };
        RegionFit::new(&input, &labels, 1, members.region(1u16), &plane)
    }

    #[test]
    fn a_highlight_on_a_slope_is_no_texture() {
        let found = fit(|x, y| {
            let d2 = (x - 20.0).powi(2) + (y - 20.0).powi(2);
            (60.0 + x, 120.0 * (-d2 / 30.0).exp())
        });
        assert!(found.model_fits(1.25) && found.texture < 0.2, "{found:?}");
    }

    #[test]
    fn a_check_of_two_colors_of_one_plane_is_texture() {
        let found = fit(|x, y| {
            if (x as usize / 5 + y as usize / 5).is_multiple_of(2) { (100.0, 0.0) } else { (50.0, 60.0) }
        });
        assert!(found.textured() && !found.poor(1.25) && !found.model_fits(1.25), "{found:?}");
        assert!((found.texture - 1.0).abs() < 0.1, "{found:?}");
        assert!((found.texture_slope - 50.0 / 60.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn the_model_fits_shading_alone() {
        let found = fit(|x, y| (60.0 + x + (y / 6.0).sin() * y, 0.0));
        assert!(found.model_fits(1.25), "{found:?}");
    }
}
