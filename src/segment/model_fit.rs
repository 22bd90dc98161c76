//! Does a region hold: is it one object with one skewed T, as section 3 assumes? (refinement `region_holds`)
//!
//! Two figures decide. The root mean square of the distance from the dichromatic plane: noise on plastic (1.0 σ), 2–16 σ on
//! printed or grown surfaces. And texture: a pattern of two colors lies in one plane as neatly as a highlight does (fit 1.0 σ
//! with the body image 13 dB worse than the input), but within a few pixels its surface reflection rises where its body
//! reflection falls, while a highlight leaves the body reflection under it as it is. Over 45 scenes the correlation of both,
//! their means over 9 × 9 pixels and the noise's own share taken off, is below .24 in all regions that the plane splits
//! well, and above .45 in nearly all that it splits worse than nothing.

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::color::{Vec3, dot, rgb};
use crate::raster::LabelMap;
use crate::reflection::ReflectionTransform;
use crate::trace::FitLimits;
use nalgebra::Matrix3;

/// Most rms distance from plane or line that is noise, σ.
pub const POOR_FIT: f64 = 1.5;
/// From this correlation of body and surface reflection on, texture is suspected …
pub const TEXTURE_CORRELATION: f64 = 0.25;
/// … and believed where surface reflection takes at least this share of its own amount from the body reflection.
const TEXTURE_SLOPE: f64 = 0.2;
/// Pixels whose distance from the plane is looked at, evenly chosen, and those whose surroundings are.
const SAMPLES: usize = 6000;
const TEXTURE_SAMPLES: usize = 2000;
/// Places around a pixel whose mean it is compared with, in steps of 2 px: 5 × 5 of them.
const STEPS: std::ops::RangeInclusive<isize> = -2..=2;
/// Variance that counts as noise anyway, as a share of the noise's own.
const NOISE_FLOOR: f64 = 0.15;

/// How well a region's pixels bear out its reflection vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RegionFit {
    /// Root mean square distance of its undistorted pixels from the plane (from the line without one), counts.
    pub rms_counts: f64,
    /// Anticorrelation of body and surface reflection from pixel to pixel: 1 for a print, about 0 for highlights.
    pub texture: f64,
    /// Body reflection lost per surface reflection gained from pixel to pixel.
    pub texture_slope: f64,
}

impl RegionFit {
    /// Of the pixels of region `id` to the plane of unit vectors `body` and `surface` through `origin`.
    pub fn new(
        input: &AnalysisInput,
        labels: &LabelMap,
        (id, pixels): (u16, Pixels),
        (origin, body, surface): (&Vec3, &Vec3, Option<&Vec3>),
    ) -> Self {
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

    /// Whether pixels lie farther from the plane than noise explains.
    pub fn poor(&self, sigma: f64) -> bool {
        self.rms_counts > POOR_FIT * sigma
    }

    /// Whether body and surface reflection vary against each other.
    pub fn textured(&self) -> bool {
        self.texture > TEXTURE_CORRELATION && self.texture_slope > TEXTURE_SLOPE
    }

    /// Up to where the figures of a region that holds may go.
    pub fn limits(sigma: f64) -> FitLimits {
        FitLimits {
            rms_counts: POOR_FIT * sigma,
            rms_sigmas: POOR_FIT,
            texture: TEXTURE_CORRELATION,
            texture_slope: TEXTURE_SLOPE,
        }
    }

    /// Whether one skewed T explains the region.
    pub fn holds(&self, sigma: f64) -> bool {
        !self.poor(sigma) && !self.textured()
    }
}

/// How colors vary from pixel to pixel.
struct Variation {
    /// Mean of v·vᵀ, v the difference of a pixel from the mean around it, counts².
    covariance: Matrix3<f64>,
    /// The noise's share in each band's variance, in σ².
    noise: f64,
}

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

/// Anticorrelation of body and surface reflection, and its slope; the noise is taken off.
fn texture(variation: &Variation, transform: &ReflectionTransform, sigma: f64) -> (f64, f64) {
    let [body_row, surface_row] = transform.amount_rows().map(crate::color::vec3);
    let per_band = sigma * sigma * variation.noise;
    let with = |a: &Vec3, b: &Vec3| (a.transpose() * variation.covariance * b)[0] - per_band * a.dot(b);
    let least = |row: &Vec3| NOISE_FLOOR * per_band * row.norm_squared() + 1e-12;
    let body = with(&body_row, &body_row).max(least(&body_row));
    let surface = with(&surface_row, &surface_row).max(least(&surface_row));
    let both = with(&body_row, &surface_row);
    (-both / (body * surface).sqrt(), -both / surface)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::segment::Members;
    use crate::segment::testing::Drawing;

    /// The fit of a picture in which `amounts` says each pixel's body and surface reflection, to the vectors that made it.
    fn fit(amounts: impl Fn(f64, f64) -> (f64, f64)) -> RegionFit {
        let (body, surface) = (Vec3::new(0.9, 0.4, 0.2).normalize(), Vec3::repeat(1.0).normalize());
        let drawing = Drawing::by_place(40, |x, y| {
            let (b, s) = amounts(x, y);
            body * b + surface * s
        });
        let labels = LabelMap::filled(40, 40, 1);
        let members = Members::of(&labels, 1);
        let input = drawing.input();
        RegionFit::new(&input, &labels, (1, members.region(1u16)), (&Vec3::zeros(), &body, Some(&surface)))
    }

    #[test]
    fn a_highlight_on_a_slope_is_no_texture() {
        let found = fit(|x, y| {
            let d2 = (x - 20.0).powi(2) + (y - 20.0).powi(2);
            (60.0 + x, 120.0 * (-d2 / 30.0).exp())
        });
        assert!(found.holds(1.25) && found.texture < 0.2, "{found:?}");
    }

    #[test]
    fn a_check_of_two_colors_of_one_plane_is_texture() {
        let found = fit(|x, y| {
            if (x as usize / 5 + y as usize / 5).is_multiple_of(2) { (100.0, 0.0) } else { (50.0, 60.0) }
        });
        assert!(found.textured() && !found.poor(1.25) && !found.holds(1.25), "{found:?}");
        assert!((found.texture - 1.0).abs() < 0.1, "{found:?}");
        assert!((found.texture_slope - 50.0 / 60.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn shading_alone_holds() {
        let found = fit(|x, y| (60.0 + x + (y / 6.0).sin() * y, 0.0));
        assert!(found.holds(1.25), "{found:?}");
    }
}
