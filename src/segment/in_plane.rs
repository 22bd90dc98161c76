//! Where in its dichromatic plane does an object put the illuminant? (refinement `robust_illuminant`)
//!
//! Within a plane, colour alone cannot tell a highlight from brighter body reflection of another colour; position can:
//! body reflection varies smoothly over the surface, a highlight does not. Around each highlight the coordinate along the
//! matte line is regressed on a polynomial of the position, for the body, plus cotθ times the in-plane offset, for the
//! highlight. cotθ is where the illuminant lies. The offset is noisy itself, which would pull cotθ towards zero: its share
//! σ²Σw is subtracted from the offset's sum of squares after partialling out the polynomial.
//!
//! Two fits, a cubic over a near ring and a quadratic over a wide one, err differently: their mean is used, and their
//! difference counts as error.

use super::scene::Scene;
use crate::raster::{LabelMap, Mask, Raster, dilate, label_components};
use crate::reflection::DichromaticPlane;
use nalgebra::{DMatrix, DVector};

/// Fewest pixels of a highlight.
const MIN_BLOB_PX: usize = 12;
/// Pixels that one fit looks at, evenly chosen.
const MAX_SAMPLES: usize = 4000;
const TUKEY: f64 = 4.7;
/// A highlight whose offsets are noise to more than this share says nothing.
const MAX_NOISE_SHARE: f64 = 0.3;

/// One object's estimate of the angle between body and surface vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InPlane {
    /// cot θ.
    pub cotangent: f64,
    /// Variance of θ, radians².
    pub variance_rad2: f64,
}

/// A pixel as the regression sees it.
#[derive(Clone, Copy, Debug)]
struct Sample {
    x: f64,
    y: f64,
    along: f64,
    offset: f64,
}

/// Estimates cotθ from the highlights of one region; `None` without a highlight that says anything.
pub fn estimate(
    scene: &Scene,
    labels: &LabelMap,
    region: u16,
    pixels: &[u32],
    plane: &DichromaticPlane,
    matte_length: f64,
) -> Option<InPlane> {
    let crop = Crop::around(labels, pixels)?;
    let blobs = highlight_blobs(scene, labels, region, pixels, plane, &crop);
    let mut sum = (0.0, 0.0);
    for blob in &blobs {
        let surroundings = |radius| samples(scene, labels, region, plane, matte_length, blob, &crop, radius);
        let half = ((blob.count as f64 / std::f64::consts::PI).sqrt()).clamp(3.0, 12.0) as usize;
        let near = regress(&surroundings(half), 3, scene.sigma());
        let wide = regress(&surroundings(2 * half), 2, scene.sigma());
        if let (Some(near), Some(wide)) = (near, wide) {
            let cotangent = f64::midpoint(near.0, wide.0);
            let variance = near.1 + (near.0 - wide.0).powi(2);
            sum.0 += cotangent / variance;
            sum.1 += 1.0 / variance;
        }
    }
    if sum.1 <= 0.0 {
        return None;
    }
    let cotangent = sum.0 / sum.1;
    let sine2 = 1.0 / (1.0 + cotangent * cotangent);
    Some(InPlane { cotangent, variance_rad2: sine2 * sine2 / sum.1 })
}

/// A rectangle of the image.
struct Crop {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
    image_width: usize,
}

impl Crop {
    /// The bounding box of pixels, 24 pixels wider on each side.
    fn around(labels: &LabelMap, pixels: &[u32]) -> Option<Self> {
        let (width, height) = (labels.width(), labels.height());
        let xs = pixels.iter().map(|&p| p as usize % width);
        let ys = pixels.iter().map(|&p| p as usize / width);
        let (left, right) = (xs.clone().min()?.saturating_sub(24), (xs.max()? + 25).min(width));
        let (top, bottom) = (ys.clone().min()?.saturating_sub(24), (ys.max()? + 25).min(height));
        Some(Self { left, top, width: right - left, height: bottom - top, image_width: width })
    }

    fn pixel(&self, index: usize) -> usize {
        (index / self.width + self.top) * self.image_width + index % self.width + self.left
    }
}

/// One highlight of a region, as a mask over a crop.
struct Blob {
    mask: Mask,
    count: usize,
}

/// Connected pixels of the region that lie more than a radius inside the plane, clipped pixels joined in.
fn highlight_blobs(
    scene: &Scene,
    labels: &LabelMap,
    region: u16,
    _pixels: &[u32],
    plane: &DichromaticPlane,
    crop: &Crop,
) -> Vec<Blob> {
    let axes = plane.coordinates();
    let least = scene.used.radius_counts() as f32;
    let bright = (0..crop.width * crop.height)
        .map(|index| {
            let pixel = crop.pixel(index);
            let own = labels[pixel] == region;
            let distorted = scene.masks.distorted(pixel) && (own || labels[pixel] == 0);
            distorted || (own && axes.of(scene.pixels[pixel]).offset > least)
        })
        .collect();
    let bright: Mask = Raster::from_vec(crop.width, crop.height, bright).unwrap_or_default();
    let components = label_components(&bright, |&inside| inside);
    (1..components.sizes.len())
        .filter(|&i| components.sizes[i] >= MIN_BLOB_PX)
        .map(|i| Blob {
            mask: components.labels.map(|&label| label as usize == i),
            count: components.sizes[i],
        })
        .collect()
}

/// The believable pixels of the region on and around a highlight.
#[allow(clippy::too_many_arguments, reason = "a region, its plane, a highlight on it, and how far to look")]
fn samples(
    scene: &Scene,
    labels: &LabelMap,
    region: u16,
    plane: &DichromaticPlane,
    matte_length: f64,
    blob: &Blob,
    crop: &Crop,
    radius: usize,
) -> Vec<Sample> {
    let axes = plane.coordinates();
    let near = dilate(&blob.mask, radius);
    let thickness = scene.used.radius_counts() as f32;
    let least_along = (0.3 * matte_length) as f32;
    let inside = near.as_slice().iter().enumerate().filter(|&(_, &near)| near);
    let found: Vec<Sample> = inside
        .filter_map(|(index, _)| {
            let pixel = crop.pixel(index);
            if labels[pixel] != region || scene.masks.distorted(pixel) {
                return None;
            }
            let point = axes.of(scene.pixels[pixel]);
            (point.height.abs() < thickness && point.along > least_along).then(|| Sample {
                x: (index % crop.width) as f64,
                y: (index / crop.width) as f64,
                along: f64::from(point.along),
                offset: f64::from(point.offset),
            })
        })
        .collect();
    let step = found.len().div_ceil(MAX_SAMPLES).max(1);
    found.into_iter().step_by(step).collect()
}

/// cotθ and its variance from one highlight's surroundings.
fn regress(samples: &[Sample], degree: usize, sigma: f64) -> Option<(f64, f64)> {
    let terms = (degree + 1) * (degree + 2) / 2;
    if samples.len() < 4 * (terms + 1) {
        return None;
    }
    let n = samples.len() as f64;
    let centre = samples.iter().fold((0.0, 0.0), |c, s| (c.0 + s.x / n, c.1 + s.y / n));
    let spread =
        samples.iter().map(|s| (s.x - centre.0).abs().max((s.y - centre.1).abs())).fold(1.0, f64::max);
    let rows: Vec<Vec<f64>> = samples
        .iter()
        .map(|s| {
            let (x, y) = ((s.x - centre.0) / spread, (s.y - centre.1) / spread);
            let mut row = Vec::with_capacity(terms + 1);
            for total in 0..=degree {
                for power in 0..=total {
                    row.push(x.powi((total - power) as i32) * y.powi(power as i32));
                }
            }
            row.push(s.offset);
            row
        })
        .collect();
    let mut weights = vec![1.0; samples.len()];
    let mut answer = None;
    for _ in 0..6 {
        let solution = solve(samples, &rows, &weights, sigma)?;
        let mut residuals: Vec<f64> = samples
            .iter()
            .zip(&rows)
            .map(|(s, row)| s.along - row.iter().zip(&solution.coefficients).map(|(r, c)| r * c).sum::<f64>())
            .collect();
        let mut sizes: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
        let middle = sizes.len() / 2;
        let (_, &mut median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
        let scale = (1.4826 * median).max(sigma * (1.0 + solution.cotangent.powi(2)).sqrt());
        for (weight, residual) in weights.iter_mut().zip(&mut residuals) {
            let u = *residual / (TUKEY * scale);
            *weight = if u.abs() < 1.0 { (1.0 - u * u).powi(2) } else { 0.0 };
        }
        answer = Some((solution.cotangent, scale * scale / solution.information));
    }
    answer
}

struct Solution {
    coefficients: Vec<f64>,
    cotangent: f64,
    information: f64,
}

/// Weighted least squares, the offset's coefficient corrected for the offset's own noise.
fn solve(samples: &[Sample], rows: &[Vec<f64>], weights: &[f64], sigma: f64) -> Option<Solution> {
    let terms = rows.first()?.len() - 1;
    let mut normal = DMatrix::<f64>::zeros(terms + 1, terms + 1);
    let mut right = DVector::<f64>::zeros(terms + 1);
    let mut total = 0.0;
    for ((sample, row), &weight) in samples.iter().zip(rows).zip(weights) {
        if weight > 0.0 {
            total += weight;
            for i in 0..=terms {
                let w = weight * row[i];
                right[i] += w * sample.along;
                for j in i..=terms {
                    normal[(j, i)] += w * row[j];
                }
            }
        }
    }
    normal.fill_upper_triangle_with_lower_triangle();
    let polynomial = normal.view((0, 0), (terms, terms)).into_owned().cholesky()?;
    let coupling = normal.view((0, terms), (terms, 1)).into_owned();
    let body = right.rows(0, terms).into_owned();
    let explained = polynomial.solve(&coupling);
    let squares = normal[(terms, terms)] - coupling.dot(&explained);
    let noise = sigma * sigma * total;
    if squares <= 0.0 || noise > MAX_NOISE_SHARE * squares {
        return None;
    }
    let information = squares - noise;
    let cotangent = (right[terms] - explained.column(0).dot(&body)) / information;
    let mut coefficients: Vec<f64> =
        polynomial.solve(&(body - coupling.column(0) * cotangent)).iter().copied().collect();
    coefficients.push(cotangent);
    Some(Solution { coefficients, cotangent, information })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_highlight_on_a_curved_body_gives_its_angle() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                let body = 150.0 + 2.0 * x - 0.05 * (x - 10.0).powi(2) - 0.03 * y * y + 0.001 * x * y * y;
                let offset = 60.0 * (-((x - 15.0).powi(2) + (y - 14.0).powi(2)) / 30.0).exp();
                Sample { x, y, along: body + 1.7 * offset, offset }
            })
            .collect();
        let (cotangent, variance) = regress(&samples, 3, 0.01).unwrap();
        assert!((cotangent - 1.7).abs() < 1e-3 && variance < 1e-4, "{cotangent} {variance}");
    }

    #[test]
    fn offsets_that_are_noise_say_nothing() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                Sample { x, y, along: 100.0 + x, offset: f64::from(i * 7919 % 11) / 11.0 }
            })
            .collect();
        assert!(regress(&samples, 3, 1.25).is_none());
    }
}
