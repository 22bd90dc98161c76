//! Finds the points under a cursor or inside a lasso, on the CPU, from the data that is drawn.
//!
//! Screen positions are in logical pixels, the unit of [`Point::size_px`]. The [`Projector`] has to be made for a size in logical
//! pixels.

use super::projector::Projector;
use super::scene::Point;

/// A point at the cursor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the point in the list.
    pub index: usize,
    /// Distance from the cursor to the rim of the point's dot, logical pixels; 0 when the cursor is on the dot.
    pub beside_px: f32,
    /// Depth of the point: 0 at the near plane, 1 at the far plane.
    pub depth: f32,
}

/// The point at the cursor: the front-most of the dots under the cursor; without such a dot, the dot whose rim is nearest, if the
/// dot's center is within `radius_px` of the cursor.
pub fn nearest(points: &[Point], projector: &Projector, cursor: [f32; 2], radius_px: f32) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    for (index, point) in points.iter().enumerate() {
        let Some(screen) = projector.screen_from_world(point.position) else { continue };
        let offset_px = [screen.at[0] - cursor[0], screen.at[1] - cursor[1]];
        let dot_radius_px = 0.5 * point.size_px;
        let reach_px = radius_px.max(dot_radius_px);
        let squared = offset_px[0] * offset_px[0] + offset_px[1] * offset_px[1];
        if squared <= reach_px * reach_px {
            let beside_px = (squared.sqrt() - dot_radius_px).max(0.0);
            let hit = Hit { index, beside_px, depth: screen.depth };
            if best.is_none_or(|best| (hit.beside_px, hit.depth) < (best.beside_px, best.depth)) {
                best = Some(hit);
            }
        }
    }
    best
}

/// Indices of the points whose centers are projected to within `radius_px` of the cursor, ascending.
pub fn within(points: &[Point], projector: &Projector, cursor: [f32; 2], radius_px: f32) -> Vec<usize> {
    let is_near = |point: &Point| {
        projector.screen_from_world(point.position).is_some_and(|screen| {
            let [dx, dy] = [screen.at[0] - cursor[0], screen.at[1] - cursor[1]];
            dx * dx + dy * dy <= radius_px * radius_px
        })
    };
    (0..points.len()).filter(|&index| is_near(&points[index])).collect()
}

/// Indices of the points whose centers are projected into the polygon (see [`encloses`]), ascending.
pub fn inside_polygon(points: &[Point], projector: &Projector, polygon: &[[f32; 2]]) -> Vec<usize> {
    let low = [0, 1].map(|axis| polygon.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min));
    let high = [0, 1].map(|axis| polygon.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max));
    let inside = |point: &Point| {
        projector.screen_from_world(point.position).is_some_and(|screen| {
            let in_box = (0..2).all(|axis| (low[axis]..=high[axis]).contains(&screen.at[axis]));
            in_box && encloses(polygon, screen.at)
        })
    };
    (0..points.len()).filter(|&index| inside(&points[index])).collect()
}

/// Whether a position lies inside a closed polygon, by the even-odd rule: where the border crosses itself, areas that are
/// enclosed twice are outside. Fewer than three corners enclose nothing.
pub fn encloses(polygon: &[[f32; 2]], [x, y]: [f32; 2]) -> bool {
    let Some(&last) = polygon.last() else { return false };
    let mut inside = false;
    let mut from = last;
    for &to in polygon {
        // The interval is half-open, so that a corner belongs to one of the two sides that meet there.
        if (from[1] > y) != (to[1] > y) {
            let crossing = from[0] + (y - from[1]) / (to[1] - from[1]) * (to[0] - from[0]);
            inside ^= x < crossing;
        }
        from = to;
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{Orbit, Preset, Projection};

    const SIZE: [f32; 2] = [200.0, 200.0];

    /// A camera that looks along green, with red to the right and blue up, at the center of the cube.
    fn front() -> Orbit {
        let mut camera = Orbit { projection: Projection::Orthographic, ..Orbit::default() };
        camera.preset(Preset::Green);
        camera
    }

    fn dot(position: [f32; 3], size_px: f32) -> Point {
        Point { position, color: [255; 4], size_px }
    }

    #[track_caller]
    fn at(position: [f32; 3]) -> [f32; 2] {
        front().screen_from_world(position, SIZE).expect("in view").at
    }

    #[test]
    fn the_front_most_dot_is_found_where_dots_overlap() {
        let points = [dot([0.5, 0.9, 0.5], 8.0), dot([0.5, 0.1, 0.5], 8.0), dot([0.5, 0.5, 0.5], 8.0)];
        let hit = nearest(&points, &front().projector(SIZE), at([0.5; 3]), 20.0).expect("three dots");
        assert_eq!((hit.index, hit.beside_px), (1, 0.0));
    }

    #[test]
    fn beside_all_dots_the_nearest_within_the_radius_is_found() {
        let points = [dot([0.2, 0.1, 0.5], 2.0), dot([0.6, 0.9, 0.5], 2.0)];
        let projector = front().projector(SIZE);
        let middle = at([0.5; 3]);
        let beside = at([0.6, 0.0, 0.5])[0] - middle[0];
        let hit = nearest(&points, &projector, middle, beside + 0.5).expect("one within reach");
        assert_eq!(hit.index, 1);
        assert!((hit.beside_px - (beside - 1.0)).abs() < 1e-3, "{hit:?}");
        assert_eq!(nearest(&points, &projector, middle, beside - 0.5), None);
        assert_eq!(nearest(&[], &projector, middle, 100.0), None);
    }

    #[test]
    fn a_large_dot_is_hit_anywhere_on_it() {
        let points = [dot([0.5; 3], 30.0)];
        let [x, y] = at([0.5; 3]);
        assert!(nearest(&points, &front().projector(SIZE), [x + 14.0, y], 3.0).is_some());
        assert!(nearest(&points, &front().projector(SIZE), [x + 16.0, y], 3.0).is_none());
    }

    #[test]
    fn all_points_within_the_radius_are_found() {
        let points = [dot([0.5, 0.9, 0.5], 2.0), dot([0.5, 0.1, 0.5], 2.0), dot([0.9, 0.5, 0.5], 2.0)];
        let projector = front().projector(SIZE);
        assert_eq!(within(&points, &projector, at([0.5; 3]), 3.0), [0, 1]);
        assert_eq!(within(&points, &projector, at([0.5; 3]), 1e4), [0, 1, 2]);
        assert_eq!(within(&points, &projector, at([0.1, 0.5, 0.1]), 3.0), [0_usize; 0]);
    }

    #[test]
    fn a_lasso_selects_the_points_inside() {
        let points: Vec<Point> =
            (0..5).map(|i| dot([0.2 + 0.15 * i as f32, 0.3 * i as f32, 0.5], 2.0)).collect();
        let [left, right] = [at([0.3, 0.0, 0.4]), at([0.7, 0.0, 0.6])];
        let lasso = [left, [right[0], left[1]], right, [left[0], right[1]]];
        assert_eq!(inside_polygon(&points, &front().projector(SIZE), &lasso), [1, 2, 3]);
        assert_eq!(inside_polygon(&points, &front().projector(SIZE), &[]), [0_usize; 0]);
    }

    #[test]
    fn areas_that_a_polygon_encloses_twice_are_outside() {
        let star = [0, 2, 4, 1, 3]
            .map(|k| (1.25 + k as f32 * 0.4) * std::f32::consts::PI)
            .map(|a| [a.cos(), a.sin()]);
        assert!(!encloses(&star, [0.0, 0.0]), "the center of a pentagram is enclosed twice");
        let tip = star[0].map(|c| 0.7 * c);
        assert!(encloses(&star, tip));
        assert!(!encloses(&star, star[0].map(|c| -0.8 * c)));
        assert!(!encloses(&[[0.0, 0.0], [1.0, 1.0]], [0.5, 0.5]));
    }
}
