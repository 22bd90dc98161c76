//! Section 6: a region's reflection vectors, fitted once more to what the segmentation found.
//!
//! The paper labels every pixel as matte or highlight by the nearer line and refits both lines. The first eigenvector of
//! matte pixels need not pass black, and faint surface reflection pulls it inward.
//!
//! Refined: the body vector is the direction from black in which the matte pixels lie, found from the outer edge of the
//! cluster inward by mean shift (`edge_body`, rough surfaces .87° → .54°); the surface vector is the scene's illuminant
//! (`scene_illuminant`, +5.7 dB body, +7.6 dB surface).

use crate::color::{Line, Moments, Vec3, dot, rgb, vec3};
use crate::photo::Masks;
use crate::reflection::DichromaticPlane;
use crate::segment::{HighlightTest, Pixels, PlanarHypothesis, Scene};

/// Reflection vectors of one region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vectors {
    /// C_b, unit.
    pub body: Vec3,
    /// C_s, unit; none without a dichromatic plane.
    pub surface: Option<Vec3>,
    /// Mean colour of the matte pixels, counts.
    pub matte_mean: Vec3,
}

/// Half width of the band around the matte line that the mean shift looks at, in σ.
const BANDWIDTH: f64 = 2.5;
/// Pixels that a fit looks at, evenly chosen.
const FIT_SAMPLES: usize = 10_000;

/// Fits body and surface vector to the region's undistorted pixels.
pub fn fit_vectors(scene: &Scene, hypothesis: &PlanarHypothesis, pixels: Pixels) -> Vectors {
    let colors = undistorted(scene.pixels.as_slice(), scene.masks, pixels);
    let test = HighlightTest::new(hypothesis);
    let is_highlight = |&color: &[f32; 3]| test.is_some_and(|test| test.is_highlight(color));
    let (highlight, matte): (Vec<_>, Vec<_>) = colors.iter().copied().partition(is_highlight);
    let matte_moments: Moments = matte.iter().copied().collect();
    let matte_mean = if matte.is_empty() { hypothesis.matte.mean } else { matte_moments.mean() };
    let body = if scene.refine.edge_body {
        body_through_black(hypothesis, &matte, scene.sigma())
    } else {
        Line::principal(&matte_moments).map_or(hypothesis.matte.direction, |line| line.direction)
    };
    let surface = hypothesis.plane.map(|plane| {
        if scene.refine.scene_illuminant {
            return plane.surface;
        }
        let own = Line::principal(&highlight.iter().copied().collect()).filter(|_| highlight.len() > 2);
        own.map_or(plane.surface, |line| line.direction)
    });
    Vectors { body, surface, matte_mean }
}

fn undistorted(image: &[[f32; 3]], masks: &Masks, pixels: Pixels) -> Vec<[f32; 3]> {
    let usable = pixels.sample(FIT_SAMPLES).filter(|&pixel| masks.usable(pixel as usize));
    usable.map(|pixel| image[pixel as usize]).collect()
}

/// The direction from black along which the matte pixels lie.
///
/// In coordinates along the matte line, `inward` in the plane and `normal` to it, the body line through black has a slope
/// in the plane and one across. Both start from the outer edge of the cluster, where no surface reflection reaches, and
/// shift to the mean of the pixels within the bandwidth until they rest.
fn body_through_black(hypothesis: &PlanarHypothesis, colors: &[[f32; 3]], sigma: f64) -> Vec3 {
    let along_axis = hypothesis.matte.direction;
    let inward = hypothesis.plane.map_or_else(
        || hypothesis.matte.inward().try_normalize(1e-9).unwrap_or_else(|| any_across(&along_axis)),
        |plane: DichromaticPlane| plane.inward,
    );
    let normal = along_axis.cross(&inward);
    let axes = [rgb(&along_axis), rgb(&inward), rgb(&normal)];
    let points: Vec<[f64; 3]> = colors
        .iter()
        .map(|&color| axes.map(|axis| f64::from(dot(color, axis))))
        .filter(|point| point[0] > 0.0)
        .collect();
    let Some(mut slope) = outer_edge(&points) else { return along_axis };
    let mut across = 0.0;
    let band = BANDWIDTH * sigma;
    for _ in 0..60 {
        let mut sums = [0.0f64; 3];
        for &[along, inside, height] in &points {
            let (u, v) = ((inside - slope * along) / band, (height - across * along) / (2.0 * band));
            if u.abs() < 1.0 && v.abs() < 1.0 {
                let weight = 1.0 - u * u;
                sums[0] += weight * along * along;
                sums[1] += weight * along * inside;
                sums[2] += weight * along * height;
            }
        }
        if sums[0] <= 0.0 {
            break;
        }
        let next = (sums[1] / sums[0], sums[2] / sums[0]);
        let moved = (next.0 - slope).abs() + (next.1 - across).abs();
        (slope, across) = next;
        if moved < 1e-6 {
            break;
        }
    }
    (along_axis + inward * slope + normal * across).normalize()
}

/// Slope of the outer edge of a cluster: the 5 % quantile of inside / along over the brighter half.
fn outer_edge(points: &[[f64; 3]]) -> Option<f64> {
    let mut lengths: Vec<f64> = points.iter().map(|p| p[0]).collect();
    let middle = lengths.len() / 2;
    let median =
        if lengths.is_empty() { 0.0 } else { *lengths.select_nth_unstable_by(middle, f64::total_cmp).1 };
    let mut slopes: Vec<f64> = points.iter().filter(|p| p[0] >= median).map(|p| p[1] / p[0]).collect();
    let rank = slopes.len() / 20;
    (!slopes.is_empty()).then(|| *slopes.select_nth_unstable_by(rank, f64::total_cmp).1)
}

fn any_across(direction: &Vec3) -> Vec3 {
    let axis = if direction.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    direction.cross(&axis).normalize()
}

/// Root mean square distance of the region's undistorted pixels from its plane, or from its line without one.
pub fn fit_rms(scene: &Scene, vectors: &Vectors, pixels: Pixels) -> f64 {
    let colors = undistorted(scene.pixels.as_slice(), scene.masks, pixels);
    let normal = vectors.surface.and_then(|s| vectors.body.cross(&s).try_normalize(1e-6));
    let squares: f64 = colors
        .iter()
        .map(|&color| match normal {
            Some(normal) => vec3(color).dot(&normal).powi(2),
            None => vec3(color).cross(&vectors.body).norm_squared() / 2.0,
        })
        .sum();
    (squares / (colors.len().max(1)) as f64).sqrt()
}
