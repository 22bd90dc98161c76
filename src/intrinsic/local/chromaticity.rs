//! Rule `chromaticity_prior`: the chromaticity of body reflection inside highlights, from the pixels around.
//!
//! Body reflection is what remains of a pixel without m_s·C_s. Where the highlight is strong and the body dark, a small error of C_s, of the
//! tone curve or of the file's values turns the direction u = body/|body| far: a pale red becomes orange. With an
//! error δ of the light and σ of the pixel's values, the variance of u is v = ((|m_s·C_s|·sin δ)² + σ²)/|body|² + θ²,
//! radians², where θ is the variation of one material. The most probable direction is the mean of u and of the directions
//! around it, each with the weight 1/v of its certainty, a Gaussian of its distance, and a weight that falls to 0 where the two
//! directions differ by more than the errors of both explain: other colors of a print are left out. Body reflection keeps its length
//! along the new direction; what is left of the pixel is in the residual. Only the chromaticity changes, and only as
//! far as a pixel has surface reflection.

use super::desaturation_map::DesaturationMap;
use crate::color::{dot, length, vec3};
use crate::intrinsic::images::Images;
use crate::raster::{Mask, Raster, Roi};
use crate::segment::AnalysisInput;
use crate::trace::Ramp;
use rayon::prelude::*;

/// Error δ of the direction of the light as it acts on one pixel, tone curve included, degrees.
const LIGHT_ERROR_DEG: f32 = 2.0;
/// Variation θ of the direction within one material, radians.
const MATERIAL_VARIATION: f32 = 0.02;
/// Standard deviation of the Gaussian weight of the distance, pixels.
const GAUSSIAN_PX: f32 = 5.0;
/// Largest distance of a pixel that counts, pixels along x and y.
const REACH_PX: isize = 9;
/// Distance between the pixels that count, pixels along x and y.
const STEP_PX: usize = 3;
/// Squared difference of two directions, in units of the variance of the difference, from which on the weight is 0.
const LARGEST_DIFFERENCE: f32 = 6.0;
/// Surface reflection as a share of body reflection over which the direction goes from no change to the whole change.
const SURFACE_SHARE: Ramp = Ramp { start: 0.01, end: 0.06 };

/// The changes of the chromaticity in a window.
pub struct ChromaticityChanges {
    /// The window.
    roi: Roi,
    /// Change of body reflection as a share of its length; zeros where nothing changes. Empty without the rule.
    of: Raster<[f32; 3]>,
}

/// The direction of body reflection at a pixel.
#[derive(Clone, Copy, Default)]
struct Direction {
    /// Unit vector of body reflection.
    unit: [f32; 3],
    /// Variance of the direction, radians².
    variance: f32,
    /// Reciprocal of the variance; 0 for a pixel that does not count.
    precision: f32,
}

impl ChromaticityChanges {
    /// The changes for the pixels of `unexplained` that have surface reflection; none where the rule is off. `images`: after the surface reflection was taken off.
    pub fn around_highlights(
        input: &AnalysisInput,
        map: &DesaturationMap,
        unexplained: &Mask,
        images: &Images,
    ) -> Self {
        let roi = map.roi;
        if !input.refine.chromaticity_prior {
            return Self { roi, of: Raster::default() };
        }
        let directions = roi.raster_by_place(|column, row| {
            if map.usable[row * roi.width + column] > 0.0 {
                direction(input, roi.at(column, row), images)
            } else {
                Direction::default()
            }
        });
        let weights = distance_weights();
        let of = roi.raster_by_place(|column, row| {
            let (index, pixel) = (row * roi.width + column, roi.at(column, row));
            let (body, surface) = (length(images.body[pixel]), length(images.surface[pixel]));
            let own = directions[index];
            if own.precision <= 0.0 || !unexplained[pixel] || surface <= SURFACE_SHARE.start * body {
                return [0.0; 3];
            }
            let unit = most_probable(&directions, [column, row], &weights);
            let along: f32 = dot(unit, own.unit);
            let share = SURFACE_SHARE.step(surface / body);
            std::array::from_fn(|band| share * (along * unit[band] - own.unit[band]))
        });
        Self { roi, of }
    }

    /// The change at a pixel of the picture, a share of the length of body reflection; none outside of the window or without the rule.
    pub fn at(&self, pixel: usize) -> Option<[f32; 3]> {
        self.of.as_slice().get(self.roi.index(pixel)?).copied()
    }

    /// The angle by which the direction at `index` of the window changes, degrees: the change is the sine of the angle.
    pub fn angle_deg(&self, index: usize) -> f32 {
        self.of.as_slice().get(index).map_or(0.0, |&change| length(change).min(1.0).asin().to_degrees())
    }

    /// Changes the body reflection of the pixels of the window.
    pub fn apply(&self, input: &AnalysisInput, images: &mut Images) {
        let width = images.body.width();
        let rows = images.body.as_mut_slice().par_chunks_mut(width.max(1)).skip(self.roi.top);
        rows.zip(self.of.as_slice().par_chunks(self.roi.width.max(1))).enumerate().for_each(
            |(row, (body, changes))| {
                let color = input.pixels.row(self.roi.top + row);
                for (x, &change) in (self.roi.left..).zip(changes) {
                    body[x] = changed(body[x], change, color[x]);
                }
            },
        );
    }
}

/// Body reflection after a change of its chromaticity, counts: not below 0 and not above the `color` of the pixel. `change`: a share of the
/// length of body reflection; without a change body reflection stays as it is.
pub fn changed(body: [f32; 3], change: [f32; 3], color: [f32; 3]) -> [f32; 3] {
    if change.iter().all(|band| *band == 0.0) {
        return body;
    }
    let length = length(body);
    std::array::from_fn(|band| (body[band] + length * change[band]).clamp(0.0, color[band].max(0.0)))
}

/// The direction of body reflection at an unclipped pixel of the picture, and its variance.
fn direction(input: &AnalysisInput, pixel: usize, images: &Images) -> Direction {
    let (body, surface) = (images.body[pixel], length(images.surface[pixel]));
    let of_body = length(body);
    if of_body <= 0.0 {
        return Direction::default();
    }
    let sigma = input.fit_sigma(&vec3(input.pixels[pixel])) as f32;
    let of_light = surface * LIGHT_ERROR_DEG.to_radians().sin();
    let variance =
        (of_light * of_light + sigma * sigma) / (of_body * of_body) + MATERIAL_VARIATION * MATERIAL_VARIATION;
    Direction { unit: body.map(|band| band / of_body), variance, precision: 1.0 / variance }
}

/// The weights of the pixels that count, by their distance along x and y from the pixel, pixels.
fn distance_weights() -> Vec<([isize; 2], f32)> {
    let steps = || (-REACH_PX..=REACH_PX).step_by(STEP_PX);
    let places = steps().flat_map(|dy| steps().map(move |dx| [dx, dy]));
    let weight = |[dx, dy]: [isize; 2]| {
        let squared = (dx * dx + dy * dy) as f32;
        (squared > 0.0 && squared <= (REACH_PX * REACH_PX) as f32)
            .then(|| ([dx, dy], (-squared / (2.0 * GAUSSIAN_PX * GAUSSIAN_PX)).exp()))
    };
    places.filter_map(weight).collect()
}

/// The most probable direction of the pixel in column `x` and row `y`, unit.
fn most_probable(
    directions: &Raster<Direction>,
    [x, y]: [usize; 2],
    weights: &[([isize; 2], f32)],
) -> [f32; 3] {
    let (width, height) = (directions.width(), directions.height());
    let own = directions[y * width + x];
    let mut sum = own.unit.map(|band| own.precision * band);
    for &([dx, dy], distance_weight) in weights {
        let place = x.checked_add_signed(dx).zip(y.checked_add_signed(dy));
        let Some((x, y)) = place.filter(|&(x, y)| x < width && y < height) else { continue };
        let near = directions[y * width + x];
        let difference: [f32; 3] = std::array::from_fn(|band| near.unit[band] - own.unit[band]);
        let likeness =
            1.0 - dot(difference, difference) / (LARGEST_DIFFERENCE * (near.variance + own.variance));
        if likeness > 0.0 {
            let weight = distance_weight * near.precision * likeness * likeness;
            sum.iter_mut().zip(near.unit).for_each(|(sum, band)| *sum += weight * band);
        }
    }
    let length = length(sum);
    if length > 0.0 { sum.map(|band| band / length) } else { own.unit }
}
