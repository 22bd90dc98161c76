//! Section 6: a region's reflection vectors, fitted again to the pixels of the segmented region.
//!
//! The paper labels every pixel as matte or highlight by the nearer line and refits both lines. The first eigenvector of
//! the matte pixels does not in general pass through black, and faint surface reflection turns the eigenvector inward.
//!
//! Refined: the body vector is the direction from black in which the matte pixels lie, found from the outer edge of the
//! cluster inward by mean shift (`edge_body`, rough surfaces .87° → .54°); the surface vector is the scene's illuminant
//! (`scene_illuminant`, +5.7 dB body, +7.6 dB surface). The vectors of marked pixels are those of their skewed T, which was fitted to all of them. A given illuminant is the surface vector under the paper's method too.

use crate::color::{Line, Moments, Vec3, axis_angle_deg, dot, rgb};
use crate::reflection::{DichromaticPlane, HighlightTest};
use crate::segment::{AnalysisInput, Pixels, PlanarHypothesis};

/// Reflection vectors of one region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vectors {
    /// C_b, unit.
    pub body: Vec3,
    /// C_s, unit; none without a dichromatic plane.
    pub surface: Option<Vec3>,
    /// Mean color of the matte pixels, counts.
    pub matte_mean: Vec3,
}

/// Half width of the band around the matte line whose pixels the mean shift uses, standard deviations of the noise.
const BANDWIDTH: f64 = 2.5;
/// Most pixels of a fit, evenly chosen; the reading `every_pixel` has no such limit.
const FIT_SAMPLES: usize = 6000;
/// Angle below which the lamp of a region is a given lamp, degrees: both differ by rounding only.
const SAME_LAMP_DEG: f64 = 0.001;

/// Fits body and surface vector to the region's undistorted pixels.
pub fn fit_vectors(input: &AnalysisInput, hypothesis: &PlanarHypothesis, pixels: Pixels) -> Vectors {
    let colors = undistorted(input, pixels);
    let test = hypothesis.highlight_test();
    let is_highlight = |&color: &[f32; 3]| test.is_some_and(|test| test.is_highlight(color));
    let (highlight, matte): (Vec<_>, Vec<_>) = colors.iter().copied().partition(is_highlight);
    let matte_moments: Moments = matte.iter().copied().collect();
    let matte_mean = if matte.is_empty() { hypothesis.matte.mean } else { matte_moments.mean() };
    let body = if input.is_marked() {
        hypothesis.matte.direction
    } else if input.refine.edge_body {
        body_through_black(hypothesis, &matte, input.sigma())
    } else {
        Line::principal(&matte_moments).map_or(hypothesis.matte.direction, |line| line.direction)
    };
    let surface = hypothesis.plane.map(|plane| {
        if input.is_marked() || input.refine.scene_illuminant || is_given(input, &plane.surface) {
            return plane.surface;
        }
        let own = Line::principal(&highlight.iter().copied().collect()).filter(|_| highlight.len() > 2);
        own.map_or(plane.surface, |line| line.direction)
    });
    Vectors { body, surface, matte_mean }
}

/// Whether the lamp of a region, the unit vector `surface`, is a light or a second lamp that was given.
fn is_given(input: &AnalysisInput, surface: &Vec3) -> bool {
    let lamps = [input.used.illuminant, input.used.second_illuminant].into_iter().flatten();
    lamps.map(Vec3::from).any(|lamp| axis_angle_deg(&lamp, surface) < SAME_LAMP_DEG)
}

/// Mean color of the region's matte pixels, counts; none without a matte pixel. `test` recognizes highlight pixels.
pub fn matte_mean(input: &AnalysisInput, pixels: Pixels, test: &HighlightTest) -> Option<Vec3> {
    let mut matte = undistorted(input, pixels);
    matte.retain(|&color| !test.is_highlight(color));
    (!matte.is_empty()).then(|| matte.into_iter().collect::<Moments>().mean())
}

/// Colors of at most [`FIT_SAMPLES`] usable pixels.
fn undistorted(input: &AnalysisInput, pixels: Pixels) -> Vec<[f32; 3]> {
    let sample = pixels.sample(input.fit_samples(FIT_SAMPLES));
    let usable = sample.filter(|&pixel| input.masks.usable(pixel as usize));
    usable.map(|pixel| input.pixels[pixel as usize]).collect()
}

/// The direction from black along which the matte pixels lie.
///
/// In the coordinates of the matte line's direction, the direction inward in the plane and the normal of the plane, the body line
/// through black has two slopes: in the plane and across the plane. The mean shift starts at the outer edge of the cluster, where
/// no surface reflection is, and moves both slopes to the mean of the pixels within the bandwidth until the slopes are stable.
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

/// A unit vector perpendicular to `direction`.
fn any_across(direction: &Vec3) -> Vec3 {
    let axis = if direction.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    direction.cross(&axis).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{axis_angle_deg, vec3};
    use crate::intrinsic::split;
    use crate::params::{Params, UsedParams};
    use crate::photo::{LinearImage, MaskLimits, Masks};
    use crate::raster::{LabelMap, Raster};
    use crate::segment::{FinalRegions, LightFindings};
    use crate::trace::NoopRecorder;
    use proptest::prelude::*;

    const MATTE_PX: usize = 600;
    const HIGHLIGHT_PX: usize = 200;

    /// A row of pixels of a skewed T: a matte ramp, then a highlight that starts at 0.8 of the ramp. Noise alternates between
    /// ±`noise` counts across the plane. Returns the amounts of body and surface reflection, and the image.
    fn skewed_t(body: &Vec3, surface: &Vec3, noise: f64) -> (Vec<[f64; 2]>, LinearImage) {
        let matte = (0..MATTE_PX).map(|i| [30.0 + 120.0 * i as f64 / MATTE_PX as f64, 0.0]);
        let highlight = (1..=HIGHLIGHT_PX).map(|i| [120.0, 90.0 * i as f64 / HIGHLIGHT_PX as f64]);
        let amounts: Vec<[f64; 2]> = matte.chain(highlight).collect();
        let normal = body.cross(surface).normalize();
        let color = |(i, [b, s]): (usize, &[f64; 2])| {
            rgb(&(body * *b + surface * *s + normal * if i % 2 == 0 { noise } else { -noise }))
        };
        let pixels = amounts.iter().enumerate().map(color).collect();
        let image = LinearImage::new(Raster::from_vec(amounts.len(), 1, pixels).unwrap(), None);
        (amounts, image)
    }

    fn used_params() -> UsedParams {
        UsedParams { clip_threshold: f64::INFINITY, ..UsedParams::paper() }
    }

    fn color_direction() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(0.05f64..1.0).prop_map(|v| Vec3::from(v).normalize())
    }

    proptest! {
        #[test]
        fn line_plane_and_split_recover_what_made_them(
            body in color_direction(), surface in color_direction(), off in -0.01f64..0.01,
        ) {
            prop_assume!(axis_angle_deg(&body, &surface) > 15.0);
            let (amounts, image) = skewed_t(&body, &surface, 0.8);
            let used = used_params();
            let limits = MaskLimits { min_intensity: 23.0, clip_threshold: f64::INFINITY, bloom_density: 9 };
            let masks = Masks::new(&image, &limits);
            let input = AnalysisInput::new(&image, &masks, &used, Params::default().refinements());
            // The segmentation's line differs a little from the true one, like a fit to noise.
            let matte = Line::new(body * 90.0, body + Vec3::new(off, -off, off / 2.0));
            let plane = DichromaticPlane::new(&matte, &surface);
            let start = body * 120.0;
            let hypothesis =
                PlanarHypothesis { origin: crate::raster::HypothesisId::from_index(0), matte, matte_length: 150.0, plane, start, highlight: None, alive: true };
            let labels = LabelMap::filled(amounts.len(), 1, 1);
            let regions = FinalRegions { labels, hypotheses: vec![hypothesis], light: LightFindings::default(), second_lamp_mask: None };
            let result = split(&input, &regions, &mut NoopRecorder).intrinsic;
            let found = &result.regions[0];
            prop_assert!(axis_angle_deg(&found.body.into(), &body) < 0.1);
            let normal = body.cross(&surface).normalize();
            prop_assert!(axis_angle_deg(&found.plane_normal.unwrap().into(), &normal) < 0.5);
            for (pixel, [b, s]) in amounts.iter().enumerate() {
                let sine = body.cross(&surface).norm();
                // Surface reflection below the noise is taken for none.
                if s * sine > 2.0 * used.camera_noise || *s == 0.0 {
                    let (mb, ms) = (vec3(result.body[pixel]).norm(), vec3(result.surface[pixel]).norm());
                    prop_assert!((mb - b).abs() < 1.0 + 0.8 / sine, "{mb} {b}");
                    prop_assert!((ms - s).abs() < 1.0 + 0.8 / sine, "{ms} {s}");
                }
            }
        }
    }
}
