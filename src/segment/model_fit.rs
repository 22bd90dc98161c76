//! Does the model fit a region: is the region one object with one skewed T, as section 3 assumes? (refinement `region_holds`)
//!
//! Two measures decide. The first is the root mean square distance from the dichromatic plane: 1.0 times what the noise and
//! the error of the file's values explain at the region's intensity (σ) on plastic, 2–16 σ on printed or grown surfaces. The
//! limit is 1.5 σ, and 3 σ where compression or demosaicing mixed the colors at the rims of highlights and objects. The second is texture: a pattern of two colors lies in one plane as exactly as a
//! highlight does (distance 1.0 σ, but the body image 13 dB worse than the input). Within a few pixels of such a pattern the
//! surface reflection rises where the body reflection falls, while a highlight does not change the body reflection under it.
//! The texture is the anticorrelation of body and surface reflection, of which the means over 9 × 9 pixels and the share of
//! the noise are subtracted. The noise of so near pixels is measured across the plane, where there is no texture. Pixels
//! within 4 px of another region are left out where enough others remain: in compressed and demosaiced pictures their colors
//! are mixtures, and a mixture with a wall of the lamp's color has the anticorrelation of a print.
//!
//! Regions of plain objects that the model fits, before and after σ contained the error of the file's values, on 25 rendered
//! scenes: 87 → 92 of 96 as they are, 13 → 82 of 92 at JPEG 92, 37 → 83 of 91 demosaiced; body 44.2 → 44.4, 36.8 → 38.1 and
//! 38.5 → 38.6 dB (doing nothing: 22.7). Of printed scenes (body 29.1 → 29.7, 26.4 → 26.9, 25.4 → 27.2 dB; doing nothing:
//! 22.5–22.9) more regions fit as well, 79 → 84 of 157 as they are.

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::color::{Vec3, dot, rgb, vec3};
use crate::raster::LabelMap;
use crate::reflection::ReflectionTransform;
use crate::trace::FitLimits;
use nalgebra::Matrix3;

/// Largest root mean square distance from plane or line that noise and coding explain, σ.
const POOR_FIT: f64 = 1.5;
/// The same where the errors of neighboring pixels are alike: compression and demosaicing mix the colors at the rims of
/// highlights and objects.
const POOR_EXTENDED_FIT: f64 = 3.0;
/// A region is textured if the anticorrelation of body and surface reflection exceeds this value …
pub const TEXTURE_CORRELATION: f64 = 0.35;
/// … and the body reflection falls by more than this share of the rise of the surface reflection.
const TEXTURE_SLOPE: f64 = 0.35;
/// Largest number of pixels whose distance from the plane is measured, evenly chosen.
const SAMPLES: usize = 6000;
/// Largest number of pixels that are compared with their surroundings, evenly chosen.
const TEXTURE_SAMPLES: usize = 2000;
/// Surroundings of a pixel along each axis, in steps of 2 px: a grid of 5 × 5 pixels.
const STEPS: std::ops::RangeInclusive<isize> = -2..=2;
/// Fewest pixels away from other regions that are enough to measure texture with these alone.
const INNER_PIXELS: f64 = 100.0;
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
    /// What the noise and the error of the file's values explain of it (σ), counts.
    pub sigma_counts: f64,
    /// Largest `rms_counts` of a region that the model fits, σ.
    pub limit_sigmas: f64,
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
        let (mut squares, mut sum, mut count) = (0.0, Vec3::zeros(), 0usize);
        for pixel in pixels.sample(SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize)) {
            let color = input.pixels[pixel as usize];
            let v = std::array::from_fn(|band| color[band] - from[band]);
            let distance2 = match &transform {
                Some(transform) => dot(v, transform.normal()).powi(2),
                None => (dot(v, v) - dot(v, along).powi(2)).max(0.0) / 2.0,
            };
            squares += f64::from(distance2);
            sum += vec3(color);
            count += 1;
        }
        let pixel_count = count.max(1) as f64;
        let (texture, texture_slope) = transform.map_or((0.0, 0.0), |transform| {
            texture(&variation(input, labels, id, pixels), &transform, input.sigma())
        });
        Self {
            rms_counts: (squares / pixel_count).sqrt(),
            sigma_counts: input.fit_sigma(&(sum / pixel_count)),
            limit_sigmas: if input.extended { POOR_EXTENDED_FIT } else { POOR_FIT },
            texture,
            texture_slope,
        }
    }

    /// Whether the pixels lie farther from the plane than noise and coding explain.
    pub fn poor(&self) -> bool {
        self.rms_counts > self.limit_sigmas * self.sigma_counts
    }

    /// Whether surface reflection rises where body reflection falls, from pixel to pixel.
    pub fn textured(&self) -> bool {
        self.texture > TEXTURE_CORRELATION && self.texture_slope > TEXTURE_SLOPE
    }

    /// Largest measures of a region that the model fits.
    pub fn limits(&self) -> FitLimits {
        FitLimits {
            rms_counts: self.limit_sigmas * self.sigma_counts,
            rms_sigmas: self.limit_sigmas,
            texture: TEXTURE_CORRELATION,
            texture_slope: TEXTURE_SLOPE,
        }
    }

    /// Whether the model fits the region: one skewed T explains the pixels.
    pub fn model_fits(&self) -> bool {
        !self.poor() && !self.textured()
    }
}

/// The variation of colors from pixel to pixel.
struct Variation {
    /// Mean of v·vᵀ, v the difference of a color from the mean color of the surroundings, counts².
    covariance: Matrix3<f64>,
    /// Variance of each band by the noise alone, σ².
    noise: f64,
}

/// The variation within region `id`, away from other regions where enough pixels are.
fn variation(input: &AnalysisInput, labels: &LabelMap, id: u16, pixels: Pixels) -> Variation {
    let (inner, count) = variation_of(input, labels, id, pixels, Surroundings::OneRegion);
    if count >= INNER_PIXELS { inner } else { variation_of(input, labels, id, pixels, Surroundings::Any).0 }
}

/// Which pixels of a region are compared with their surroundings.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Surroundings {
    /// Pixels whose surroundings belong to their region.
    OneRegion,
    /// All pixels; surroundings count as far as they belong to the region.
    Any,
}

/// The variation within region `id` and the number of pixels that were compared; surroundings count as far as they are usable.
fn variation_of(
    input: &AnalysisInput,
    labels: &LabelMap,
    id: u16,
    pixels: Pixels,
    surroundings: Surroundings,
) -> (Variation, f64) {
    let (width, height) = (labels.width() as isize, labels.height() as isize);
    let around = |place: isize, end: isize| {
        STEPS.map(move |step| place + 2 * step).filter(move |place| (0..end).contains(place))
    };
    let mut sum = Matrix3::zeros();
    let (mut noise, mut count) = (0.0, 0.0);
    for pixel in pixels.sample(TEXTURE_SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize)) {
        let (x, y) = (pixel as isize % width, pixel as isize / width);
        let near = around(y, height).flat_map(|v| around(x, width).map(move |u| (v * width + u) as usize));
        if surroundings == Surroundings::OneRegion && near.clone().any(|near| labels[near] != id) {
            continue;
        }
        let (mut mean, mut places) = ([0.0f32; 3], 0.0f32);
        for near in near.filter(|&near| labels[near] == id && input.masks.usable(near)) {
            mean.iter_mut().zip(input.pixels[near]).for_each(|(mean, band)| *mean += band);
            places += 1.0;
        }
        let color = input.pixels[pixel as usize];
        let v = vec3(std::array::from_fn(|band| color[band] - mean[band] / places));
        sum += v * v.transpose();
        noise += 1.0 - 1.0 / f64::from(places);
        count += 1.0f64;
    }
    let pixel_count = count.max(1.0);
    (Variation { covariance: sum / pixel_count, noise: noise / pixel_count }, count)
}

/// Anticorrelation of body and surface reflection, and the slope of the decrease; the covariance of the noise is subtracted,
/// which is `sigma` or, where that is more, what varies across the plane.
fn texture(variation: &Variation, transform: &ReflectionTransform, sigma: f64) -> (f64, f64) {
    let [body_row, surface_row] = transform.amount_rows().map(vec3);
    let along = |a: &Vec3, b: &Vec3| (a.transpose() * variation.covariance * b)[0];
    let normal = vec3(transform.normal());
    let per_band = along(&normal, &normal).max(sigma * sigma * variation.noise);
    let covariance = |a: &Vec3, b: &Vec3| along(a, b) - per_band * a.dot(b);
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
        assert!(found.model_fits() && found.texture < 0.2, "{found:?}");
    }

    #[test]
    fn a_check_of_two_colors_of_one_plane_is_texture() {
        let found = fit(|x, y| {
            if (x as usize / 5 + y as usize / 5).is_multiple_of(2) { (100.0, 0.0) } else { (50.0, 60.0) }
        });
        assert!(found.textured() && !found.poor() && !found.model_fits(), "{found:?}");
        assert!((found.texture - 1.0).abs() < 0.1, "{found:?}");
        assert!((found.texture_slope - 50.0 / 60.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn the_model_fits_shading_alone() {
        let found = fit(|x, y| (60.0 + x + (y / 6.0).sin() * y, 0.0));
        assert!(found.model_fits(), "{found:?}");
    }
}
