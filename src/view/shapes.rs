//! The shapes of the model in the RGB cube, in counts: the colors that a hypothesis claims, and the lines of the hypothesis.

mod cursor;

pub use cursor::{CursorShapes, cluster_ellipsoid, cursor_shapes};

use super::ResultSnapshot;
use super::solid::{HalfSpace, Solid, Tube, convex_body, cube, ellipsoid, octant};
use super::vector::{Point, dot64};
use crate::color::{Moments, Vec3, dot, principal_axes, rgb};
use crate::intrinsic::RegionReflection;
use crate::raster::RegionId;
use crate::reflection::{DichromaticPlane, HighlightTest, MOST_BRANCHES};
use crate::segment::PlanarHypothesis;
use crate::trace::PixelKind;
use rayon::prelude::*;

/// Standard deviations that the ellipsoid of a window reaches.
const ELLIPSOID_SIGMAS: f64 = 2.0;

/// The skewed T of a region, and the parts of the cube that the region claims, in counts.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionShapes {
    /// The region of the shapes.
    pub region: RegionId,
    /// The cylinder (5.3.2), from the dark sphere to the far sides of the cube; none where nothing lies between them.
    pub cylinder: Option<Solid>,
    /// The ends of the axis of the cylinder.
    pub axis: Option<[Point; 2]>,
    /// The slice (5.4.2), cut to the cube; its outlines are the two faces along the plane. None without a plane.
    pub slice: Option<Solid>,
    /// The matte line, from its point nearest to black to the brightest matte point.
    pub matte_line: [Point; 2],
    /// The brightest matte point, at the end of the matte line (5.4.1).
    pub brightest_matte: Point,
    /// The points where the highlight lines leave the matte line, the strongest first; none without a plane.
    pub meeting_points: Vec<Point>,
    /// The highlight lines, from their meeting points along the illuminant to the brightest highlight pixel; only lines with
    /// highlight pixels.
    pub highlight_lines: Vec<[Point; 2]>,
    /// Whether the meeting points were measured on highlights; if not, the meeting point is where highlights usually start.
    pub meeting_point_found: bool,
}

/// The shapes of a region; none where there is no such region.
pub fn region_shapes(shown: &ResultSnapshot, region: RegionId) -> Option<RegionShapes> {
    let hypothesis = hypothesis(shown, region)?;
    let full = full(shown);
    let tube = Tube {
        mean: hypothesis.matte.mean.into(),
        direction: hypothesis.matte.direction.into(),
        radius: shown.analysis.used.radius_counts(),
        dark: shown.analysis.used.min_intensity,
        full,
    };
    let foot = hypothesis.matte.foot();
    let end = foot + hypothesis.matte.direction * hypothesis.matte_length;
    let reflection = shown.analysis.intrinsic.regions.get(region.index())?;
    let starts = if hypothesis.plane.is_some() { starts(reflection, hypothesis) } else { Vec::new() };
    let highlight_lines = hypothesis.plane.map(|plane| highlight_lines(shown, region, &starts, &plane));
    Some(RegionShapes {
        region,
        cylinder: tube.solid(),
        axis: tube.axis(),
        slice: hypothesis.plane.map(|plane| slice(shown, hypothesis, &plane, full)),
        matte_line: [rgb(&foot), rgb(&end)],
        brightest_matte: rgb(&end),
        meeting_points: starts.iter().map(rgb).collect(),
        highlight_lines: highlight_lines.unwrap_or_default(),
        meeting_point_found: hypothesis.highlight.is_some() || starts.len() > 1,
    })
}

/// The part of the dark sphere inside the cube; none where nothing is too dark.
pub fn dark_sphere(shown: &ResultSnapshot) -> Option<Solid> {
    let radius = shown.analysis.used.min_intensity;
    (radius > 0.0).then(|| octant(radius))
}

/// The line from black along the color of the light to the side of the cube; none where the light is unknown.
pub fn illuminant_line(shown: &ResultSnapshot) -> Option<[Point; 2]> {
    light_line(shown, shown.analysis.illuminant?.direction)
}

/// The line from black along the color of the second lamp to the side of the cube; none with one lamp.
pub fn second_lamp_line(shown: &ResultSnapshot) -> Option<[Point; 2]> {
    light_line(shown, shown.analysis.planar.light.second?.direction)
}

fn light_line(shown: &ResultSnapshot, direction: [f64; 3]) -> Option<[Point; 2]> {
    let largest = direction.iter().fold(0.0f64, |most, v| most.max(*v));
    (largest > 0.0).then(|| [[0.0; 3], direction.map(|v| (v / largest * full(shown)) as f32)])
}

/// The ellipsoid of a window's colors at two standard deviations; none without at least two pixels.
pub fn window_ellipsoid(shown: &ResultSnapshot, window: u32) -> Option<Solid> {
    ellipsoid_of(shown.analysis.windows.moments.as_slice().get(window as usize)?)
}

fn ellipsoid_of(moments: &Moments) -> Option<Solid> {
    if moments.n < 2.0 {
        return None;
    }
    let (variances, axes) = principal_axes(&moments.covariance());
    let half = variances.map(|variance| ELLIPSOID_SIGMAS * variance.max(0.0).sqrt());
    Some(ellipsoid(moments.mean().into(), axes.map(Into::into), half))
}

/// A region's skewed T.
pub(super) fn hypothesis(shown: &ResultSnapshot, region: RegionId) -> Option<&PlanarHypothesis> {
    shown.analysis.finals.hypotheses.get(region.index())
}

/// A direction across the matte line of a hypothesis without a light: towards gray, or any direction for a gray object.
pub(super) fn across(hypothesis: &PlanarHypothesis) -> Vec3 {
    let direction = hypothesis.matte.direction;
    let towards_gray = hypothesis.matte.inward().try_normalize(1e-6);
    towards_gray.unwrap_or_else(|| direction.cross(&Vec3::x()).normalize().cross(&direction))
}

fn full(shown: &ResultSnapshot) -> f64 {
    f64::from(shown.picture.histogram.full_counts)
}

/// The slice by which the segmentation claims pixels ([`crate::reflection::Slice`]) as a body, bounded where the
/// refinement is on.
fn slice(
    shown: &ResultSnapshot,
    hypothesis: &PlanarHypothesis,
    plane: &DichromaticPlane,
    full: f64,
) -> Solid {
    let used = &shown.analysis.used;
    let bounds = shown.params.refinements().slice_bounds;
    let bounds = bounds.then(|| [used.radius_counts(), hypothesis.matte_length]);
    slice_body(plane, used.slice_half_width_counts(), bounds, full)
}

/// A slice as a body; `bounds` are the cylinder's radius and the length of the matte line, of a bounded slice.
fn slice_body(plane: &DichromaticPlane, half_width: f64, bounds: Option<[f64; 2]>, full: f64) -> Solid {
    let mean: [f64; 3] = plane.matte.mean.into();
    let normal: [f64; 3] = plane.normal.into();
    let level = dot64(normal, mean);
    let mut sides = vec![
        HalfSpace::new(normal, level + half_width),
        HalfSpace::new(normal.map(|v| -v), half_width - level),
    ];
    sides.extend(cube(full));
    if let Some([radius, matte_length]) = bounds {
        let inward: [f64; 3] = plane.inward.into();
        let on_line = dot64(inward, mean);
        sides.push(HalfSpace::new(inward.map(|v| -v), radius - on_line));
        // Body reflection is along − cotθ·offset.
        let cotangent = 1.0 / plane.angle_rad.tan();
        let slack = radius / plane.angle_rad.sin();
        let body: [f64; 3] = (plane.matte.direction - plane.inward * cotangent).into();
        let zero = -cotangent * on_line;
        let most = 1.15 * matte_length + radius + slack;
        sides.push(HalfSpace::new(body, most + zero));
        sides.push(HalfSpace::new(body.map(|v| -v), slack - zero));
    }
    convex_body(&sides, 4.0 * full, 2)
}

/// The points where the highlight lines of a region leave its matte line, counts, the strongest first.
pub(super) fn starts(reflection: &RegionReflection, hypothesis: &PlanarHypothesis) -> Vec<Vec3> {
    let found: Vec<Vec3> = reflection.highlight_branches.iter().map(|branch| branch.start.into()).collect();
    if found.is_empty() { vec![hypothesis.start] } else { found }
}

/// The line from each start along the light to the brightest highlight pixel that is nearer to this line than to
/// the others, counts.
fn highlight_lines(
    shown: &ResultSnapshot,
    region: RegionId,
    starts: &[Vec3],
    plane: &DichromaticPlane,
) -> Vec<[Point; 2]> {
    let test = HighlightTest::of_lines(&plane.matte, starts, &plane.surface);
    let surface = rgb(&plane.surface);
    let at_start: Vec<f32> = starts.iter().map(|start| dot(rgb(start), surface)).collect();
    let kinds = shown.analysis.intrinsic.kinds.as_slice();
    let pixels = shown.picture.photo.image.pixels.as_slice();
    let reach = |mut reach: [f32; MOST_BRANCHES], ((&label, &kind), &color): ((&u16, &PixelKind), &Point)| {
        if label == region.get() && kind == PixelKind::Highlight {
            let branch = test.nearest(color);
            reach[branch] = reach[branch].max(dot(color, surface) - at_start[branch]);
        }
        reach
    };
    let none = || [0.0f32; MOST_BRANCHES];
    let farther = |a: [f32; MOST_BRANCHES], b: [f32; MOST_BRANCHES]| std::array::from_fn(|i| a[i].max(b[i]));
    let all = shown.labels().as_slice().par_iter().zip(kinds).zip(pixels).with_min_len(1 << 14);
    let reach = all.fold(none, reach).reduce(none, farther);
    let lines = starts.iter().zip(reach).filter(|&(_, reach)| reach > 0.0);
    lines.map(|(start, reach)| [rgb(start), rgb(&(start + plane.surface * f64::from(reach)))]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::vector::{cross, distance};
    use super::*;
    use crate::reflection::Slice;
    use crate::view::testing::tiny;

    fn line_distance(shown: &ResultSnapshot, region: RegionId, p: Point) -> f64 {
        hypothesis(shown, region).unwrap().matte.distance(&crate::color::vec3(p))
    }

    #[test]
    fn every_region_has_its_shapes() {
        let shown = tiny();
        let regions = shown.analysis.intrinsic.regions.len();
        let beyond = RegionId::from_index(regions);
        assert!(regions > 0 && region_shapes(&shown, beyond).is_none());
        let radius = shown.analysis.used.radius_counts();
        for region in RegionId::all(regions) {
            let shapes = region_shapes(&shown, region).unwrap();
            for &p in &shapes.cylinder.unwrap().surface.points {
                assert!((line_distance(&shown, region, p) - radius).abs() < 1e-2);
            }
            for p in shapes.matte_line.into_iter().chain([shapes.brightest_matte]) {
                assert!(line_distance(&shown, region, p) < 1e-2);
            }
        }
    }

    #[test]
    fn the_highlight_line_runs_with_the_light_inside_the_slice() {
        let shown = tiny();
        let light = rgb(&Vec3::from(shown.analysis.illuminant.unwrap().direction));
        let [black, end] = illuminant_line(&shown).unwrap();
        assert_eq!((black, end.iter().fold(0.0f32, |most, v| most.max(*v))), ([0.0; 3], 255.0));
        let mut lines = 0;
        for region in RegionId::all(shown.analysis.intrinsic.regions.len()) {
            for [from, to] in region_shapes(&shown, region).unwrap().highlight_lines {
                let along: Point = std::array::from_fn(|i| to[i] - from[i]);
                assert!(dot(cross(along, light), cross(along, light)).sqrt() < 0.02 * distance(from, to));
                lines += 1;
            }
        }
        assert!(lines > 0);
    }

    #[test]
    fn the_slice_is_what_the_segmentation_claims() {
        let shown = tiny();
        let used = &shown.analysis.used;
        let mut slices = 0;
        for region in RegionId::all(shown.analysis.intrinsic.regions.len()) {
            let hypothesis = hypothesis(&shown, region).unwrap();
            let (Some(plane), Some(body)) = (hypothesis.plane, region_shapes(&shown, region).unwrap().slice)
            else {
                continue;
            };
            slices += 1;
            let margin = 0.02;
            let claimed = Slice::bounded(
                &plane,
                used.slice_half_width_counts() + margin,
                used.radius_counts() + margin,
                hypothesis.matte_length,
            );
            assert_eq!(body.outlines.len(), 2);
            for &p in &body.surface.points {
                assert!(claimed.contains(p) && p.iter().all(|v| (-0.01..=255.01).contains(v)), "{p:?}");
            }
        }
        assert!(slices > 0);
    }

    #[test]
    fn windows_have_ellipsoids_of_two_standard_deviations() {
        let shown = tiny();
        let windows = &shown.analysis.windows;
        let window = (0..windows.moments.len()).max_by_key(|&w| windows.moments[w].n as u32).unwrap();
        let body = window_ellipsoid(&shown, window as u32).unwrap();
        let (variances, axes) = principal_axes(&windows.moments[window].covariance());
        let mean = rgb(&windows.moments[window].mean());
        let reach =
            body.surface.points.iter().map(|p| dot(std::array::from_fn(|i| p[i] - mean[i]), rgb(&axes[0])));
        let reach = f64::from(reach.fold(0.0, f32::max));
        assert!((reach - 2.0 * variances[0].sqrt()).abs() < 0.02 * reach + 1e-2);
        assert!(window_ellipsoid(&shown, u32::MAX).is_none());
        assert!(dark_sphere(&shown).is_some());
    }
}
