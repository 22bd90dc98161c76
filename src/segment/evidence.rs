//! Section 5.4.1, refined (`robust_illuminant`): the constraints on the illuminant's direction from the pixels of one region.
//!
//! The pixels off the matte line lie in a plane with the matte line, and so does the illuminant: one constraint. The
//! direction within that plane (`in_plane`) is a second constraint.

use super::illuminant::Constraint;
use super::in_plane::{InPlane, LEAST_ALONG_SHARE, MOST_HEIGHT_PER_OFFSET, Rise};
use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::color::Vec3;
use crate::raster::{HypothesisId, LabelMap, Mask, Raster, UNASSIGNED};
use crate::reflection::{DichromaticPlane, PlanePoint};

/// Least offset from the matte line of a pixel that tells of the plane, as a share of the cylinder's radius.
const LEAST_OFFSET_RADII: f32 = 0.75;
/// Least standard deviation of a plane's normal, degrees.
const PLANE_FLOOR_DEG: f64 = 0.4;
/// Least standard deviation of a direction within a plane, degrees.
const DIRECTION_FLOOR_DEG: f64 = 2.0;

/// Unclaimed pixels whose colors lie near a dichromatic plane, on the illuminant's side of the matte line, and that are
/// connected to the matte region by such pixels within 8 px. `matte_length` in counts; `pixels`: those of the matte region.
pub fn nearby_highlight(
    input: &AnalysisInput,
    labels: &LabelMap,
    plane: &DichromaticPlane,
    matte_length: f64,
    pixels: Pixels,
) -> Vec<u32> {
    const REACH_PX: usize = 8;
    let axes = plane.coordinates();
    let least_offset = LEAST_OFFSET_RADII * input.used.radius_counts() as f32;
    let least_along = LEAST_ALONG_SHARE as f32 * matte_length as f32;
    let mut seen: Mask = Raster::filled(labels.width(), labels.height(), false);
    let mut ring = Vec::new();
    let mut step = |from: &mut dyn Iterator<Item = u32>| -> Vec<u32> {
        let mut next = Vec::new();
        for pixel in from {
            labels.for_each_neighbor(pixel as usize, |near| {
                if labels[near] != UNASSIGNED || !input.masks.usable(near) || seen[near] {
                    return;
                }
                let point = axes.of(input.pixels[near]);
                if point.offset > least_offset && is_near_plane(&point) && point.along > least_along {
                    seen[near] = true;
                    next.push(near as u32);
                }
            });
        }
        next
    };
    let mut found = step(&mut pixels.iter());
    ring.extend_from_slice(&found);
    for _ in 1..REACH_PX {
        ring = step(&mut ring.iter().copied());
        found.extend_from_slice(&ring);
    }
    found
}

/// Whether a color lies at a small angle to the plane.
fn is_near_plane(point: &PlanePoint) -> bool {
    point.height.abs() < MOST_HEIGHT_PER_OFFSET * point.offset
}

/// The constraint by the plane in which a region's highlights rise above their surroundings. Without a highlight (`rise` is
/// `None`) it is the constraint by all pixels, with a larger variance.
pub fn plane_of_highlights(by_all: &Constraint, plane: &DichromaticPlane, rise: Option<&Rise>) -> Constraint {
    const FAINT_DEG: f64 = 5.0;
    let Some(rise) = rise else {
        return Constraint { variance_deg2: by_all.variance_deg2 + FAINT_DEG * FAINT_DEG, ..*by_all };
    };
    let variance_deg2 = rise.variance * 1f64.to_degrees().powi(2) + PLANE_FLOOR_DEG * PLANE_FLOOR_DEG;
    Constraint { normal: normal_of(plane, rise.tangent), variance_deg2, ..*by_all }
}

/// The normal of the plane through the matte line that is inclined to `plane` by the angle with this tangent.
fn normal_of(plane: &DichromaticPlane, tangent: f64) -> Vec3 {
    plane.matte.direction.cross(&(plane.inward + plane.normal * tangent)).normalize()
}

/// The constraint by the plane through the matte line and all of a region's pixels off the line; `None` with too few such
/// pixels. `matte_length` in counts.
pub fn plane_constraint(
    input: &AnalysisInput,
    hypothesis: HypothesisId,
    plane: &DichromaticPlane,
    matte_length: f64,
    pixels: impl Iterator<Item = u32>,
) -> Option<Constraint> {
    const MIN_PIXELS: f64 = 10.0;
    const POOR_FIT: f64 = 2.0;
    let axes = plane.coordinates();
    let (radius, sigma) = (input.used.radius_counts() as f32, input.sigma());
    let points: Vec<HighlightPoint> = pixels
        .filter(|&pixel| input.masks.usable(pixel as usize))
        .map(|pixel| (pixel as usize, axes.of(input.pixels[pixel as usize])))
        .filter(|(_, p)| p.offset > LEAST_OFFSET_RADII * radius && is_near_plane(p))
        .filter(|(_, p)| f64::from(p.along) > LEAST_ALONG_SHARE * matte_length)
        .map(|(pixel, p)| HighlightPoint {
            offset: f64::from(p.offset),
            height: f64::from(p.height),
            variance_share: relative_variance(input, pixel),
        })
        .collect();
    let fit = robust_slope(&points, sigma)?;
    if fit.weight < MIN_PIXELS {
        return None;
    }
    let per_pixel = fit.residual.max(sigma).powi(2);
    Some(Constraint {
        hypothesis,
        normal: normal_of(plane, fit.tangent),
        variance_deg2: per_pixel / fit.squares * 1f64.to_degrees().powi(2)
            + PLANE_FLOOR_DEG * PLANE_FLOOR_DEG,
        residual_scale_deg: 1.0,
        // Pixels that scatter about the plane by more than the noise are no highlight on one material.
        reliability: (POOR_FIT * sigma / fit.residual).powi(2).min(1.0),
    })
}

/// A pixel off the matte line, by the coordinates of its color in the dichromatic plane.
struct HighlightPoint {
    /// Distance from the matte line in the plane, counts.
    offset: f64,
    /// Distance from the plane, with sign, counts.
    height: f64,
    /// Variance of the height, in units of the noise's variance.
    variance_share: f64,
}

/// Variance of a band of a pixel, in units of the noise's variance: more than 1 where the band was interpolated across a narrow highlight.
///
/// Only in demosaiced photographs that were not compressed: of 100 rendered pictures these gain .2 dB on average (25 prints .6 dB). At JPEG 92 the
/// same pictures lose .3 dB (prints .9 dB).
fn relative_variance(input: &AnalysisInput, pixel: usize) -> f64 {
    if input.is_only_interpolated() {
        1.0 + (f64::from(input.interpolation_sigma(pixel)) / input.sigma()).powi(2)
    } else {
        1.0
    }
}

/// A line through the origin, fitted to points of a dichromatic plane (offset, height).
struct Slope {
    /// Height per offset.
    tangent: f64,
    /// Σ w·offset², w Tukey's weight by the relative variance of the height.
    squares: f64,
    /// Sum of Tukey's weights.
    weight: f64,
    /// Root mean square of the weighted residuals, each in units of its relative standard deviation, counts.
    residual: f64,
}

/// Scale of Tukey's weights in the first round of the fit, σ.
const FIRST_SCALE_SIGMAS: f64 = 8.0;
/// Least scale of Tukey's weights, σ.
const LEAST_SCALE_SIGMAS: f64 = 1.5;
/// Residual from which on the weight is 0, in scales.
const TUNING: f64 = 4.0;
/// Rounds of the fit.
const SLOPE_ROUNDS: usize = 10;

/// Fits height = tangent · offset with Tukey's weights, whose scale decreases from [`FIRST_SCALE_SIGMAS`] to the scale of the noise. `None` where
/// no point has weight.
fn robust_slope(points: &[HighlightPoint], sigma: f64) -> Option<Slope> {
    let mut fit = Slope { tangent: 0.0, squares: 0.0, weight: 0.0, residual: 0.0 };
    let mut scale = FIRST_SCALE_SIGMAS * sigma;
    for _ in 0..SLOPE_ROUNDS {
        let (mut product, mut squares, mut weight_sum, mut residuals) = (0.0, 0.0, 0.0, 0.0);
        for &HighlightPoint { offset, height, variance_share } in points {
            let residual = (height - fit.tangent * offset) / variance_share.sqrt();
            let u = residual / (TUNING * scale);
            if u.abs() < 1.0 {
                let tukey = (1.0 - u * u).powi(2);
                let weight = tukey / variance_share;
                product += weight * offset * height;
                squares += weight * offset * offset;
                weight_sum += tukey;
                residuals += tukey * residual * residual;
            }
        }
        if squares <= 0.0 {
            return None;
        }
        let residual = (residuals / weight_sum).sqrt();
        fit = Slope { tangent: product / squares, squares, weight: weight_sum, residual };
        scale = (scale / 2.0).max(LEAST_SCALE_SIGMAS * sigma).max(residual);
    }
    Some(fit)
}

/// The constraint by an in-plane estimate: the illuminant lies at the estimated angle from the matte line, within the plane
/// of the constraint `lies_in`.
pub fn branch_constraint(lies_in: &Constraint, plane: &DichromaticPlane, branch: &InPlane) -> Constraint {
    let inward = lies_in.normal.cross(&plane.matte.direction);
    let light = (plane.matte.direction * branch.cotangent + inward).normalize();
    let variance_deg2 =
        branch.variance_rad2 * 1f64.to_degrees().powi(2) + DIRECTION_FLOOR_DEG * DIRECTION_FLOOR_DEG;
    Constraint {
        hypothesis: lies_in.hypothesis,
        normal: lies_in.normal.cross(&light),
        variance_deg2,
        residual_scale_deg: 4.0,
        reliability: lies_in.reliability,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_large_variance_do_not_tilt_the_plane_of_the_others() {
        // Twenty points on a slope of .1, and forty that color fringes put on a slope of −.02.
        let points = |fringe_variance_share: f64| -> Vec<HighlightPoint> {
            (1..=60)
                .map(|i| {
                    let offset = f64::from(i);
                    let (slope, variance_share) =
                        if i % 3 == 0 { (0.1, 1.0) } else { (-0.02, fringe_variance_share) };
                    HighlightPoint { offset, height: slope * offset, variance_share }
                })
                .collect()
        };
        let tangent =
            |fringe_variance_share| robust_slope(&points(fringe_variance_share), 1.0).unwrap().tangent;
        assert!((tangent(400.0) - 0.1).abs() < 0.005, "{}", tangent(400.0));
        assert!(tangent(1.0) < 0.05, "with equal variances the fringes decide: {}", tangent(1.0));
    }
}
