//! The texture of a region: how body and surface reflection vary against each other from pixel to pixel (a measure of `segment/model_fit`).
//!
//! Within a few pixels of a printed pattern the surface reflection rises where the body reflection falls, while a highlight does not
//! change the body reflection under it. The texture is the anticorrelation of body and surface reflection. Before the two are correlated,
//! the local mean (every second pixel of 9 × 9 pixels) and the covariance of the noise are subtracted. The variance of that noise is
//! the variance along the normal of the plane, and at least that of the camera noise. Pixels whose surroundings are not wholly in the
//! region are left out where enough others remain: in compressed and demosaiced pictures their colors are mixtures, and a mixture with
//! a neutral background has less body and more surface reflection, as the pixels of a print have.

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::color::{Vec3, vec3};
use crate::raster::LabelMap;
use crate::reflection::ReflectionTransform;
use nalgebra::Matrix3;

/// Largest number of pixels that are compared with their surroundings, evenly chosen.
const SAMPLES: usize = 2000;
/// Surroundings of a pixel along each axis, in steps of 2 px: a grid of 5 × 5 pixels.
const STEPS: std::ops::RangeInclusive<isize> = -2..=2;
/// If at least this many pixels have surroundings wholly in their region, texture is measured with these pixels only.
const INNER_PIXELS: usize = 100;
/// Least variance of body and surface reflection, as a share of the noise's variance.
const NOISE_FLOOR: f64 = 0.15;

/// How body and surface reflection vary against each other from pixel to pixel.
#[derive(Clone, Copy, Default)]
pub struct Texture {
    /// 1 for a print, about 0 for highlights.
    pub anticorrelation: f64,
    /// Decrease of body reflection per increase of surface reflection.
    pub slope: f64,
}

impl Texture {
    /// The texture of region `id`, whose colors `transform` splits into body and surface reflection.
    pub fn of_region(
        input: &AnalysisInput,
        labels: &LabelMap,
        id: u16,
        pixels: Pixels,
        transform: &ReflectionTransform,
    ) -> Self {
        Self::of(&variation(input, labels, id, pixels), transform, input.sigma())
    }

    /// The texture of colors that vary. The covariance of the noise is subtracted; the variance of a band's noise is the larger of `sigma`² times the noise factor
    /// and the variance along the normal of the plane.
    fn of(variation: &Variation, transform: &ReflectionTransform, sigma: f64) -> Self {
        let [body_row, surface_row] = transform.amount_rows().map(vec3);
        let along = |a: &Vec3, b: &Vec3| (a.transpose() * variation.covariance * b)[0];
        let normal = vec3(transform.normal());
        let per_band = along(&normal, &normal).max(sigma * sigma * variation.noise_factor);
        let covariance = |a: &Vec3, b: &Vec3| along(a, b) - per_band * a.dot(b);
        let least = |row: &Vec3| NOISE_FLOOR * per_band * row.norm_squared() + 1e-12;
        let body = covariance(&body_row, &body_row).max(least(&body_row));
        let surface = covariance(&surface_row, &surface_row).max(least(&surface_row));
        let both = covariance(&body_row, &surface_row);
        Self { anticorrelation: -both / (body * surface).sqrt(), slope: -both / surface }
    }
}

/// The variation of colors from pixel to pixel.
struct Variation {
    /// Mean of v·vᵀ, v the difference of a color from the mean color of the surroundings, counts².
    covariance: Matrix3<f64>,
    /// Variance of a band of v by the noise alone, in units of the noise's variance.
    noise_factor: f64,
    /// Number of pixels that were compared.
    pixels: usize,
}

/// The variation within region `id`, of the pixels inside where enough are.
fn variation(input: &AnalysisInput, labels: &LabelMap, id: u16, pixels: Pixels) -> Variation {
    let inside = variation_of(input, labels, id, pixels, ComparedPixels::Inside);
    if inside.pixels >= INNER_PIXELS {
        inside
    } else {
        variation_of(input, labels, id, pixels, ComparedPixels::All)
    }
}

/// Which pixels of a region are compared with their surroundings.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ComparedPixels {
    /// Pixels whose surroundings are wholly in their region.
    Inside,
    /// All pixels; of the surroundings, the pixels of the region count.
    All,
}

/// The variation within region `id`. Only usable pixels count.
fn variation_of(
    input: &AnalysisInput,
    labels: &LabelMap,
    id: u16,
    pixels: Pixels,
    compared: ComparedPixels,
) -> Variation {
    let (width, height) = (labels.width() as isize, labels.height() as isize);
    let around = |place: isize, end: isize| {
        STEPS.map(move |step| place + 2 * step).filter(move |place| (0..end).contains(place))
    };
    let mut sum = Matrix3::zeros();
    let (mut noise_factor, mut count) = (0.0, 0);
    for pixel in pixels.sample(SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize)) {
        let (x, y) = (pixel as isize % width, pixel as isize / width);
        let near = around(y, height).flat_map(|v| around(x, width).map(move |u| (v * width + u) as usize));
        if compared == ComparedPixels::Inside && near.clone().any(|near| labels[near] != id) {
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
        noise_factor += 1.0 - 1.0 / f64::from(places);
        count += 1;
    }
    let divisor = count.max(1) as f64;
    Variation { covariance: sum / divisor, noise_factor: noise_factor / divisor, pixels: count }
}
