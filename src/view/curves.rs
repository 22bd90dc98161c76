//! Straight lines and surfaces of the RGB cube as curves and surfaces of the other color spaces.
//!
//! The shapes of the model are straight in RGB only. For other spaces the shapes are subdivided until the pieces look straight.

use super::ColorSpace;
use super::solid::Mesh;
use super::space::LOG_FLOOR;
use super::vector::{Point, cross, distance, dot, halfway, unit};
use std::collections::BTreeMap;

/// Largest distance of a piece of a curve from its chord, in the unit of the world.
const STRAIGHT: f32 = 2e-3;
/// Least and largest number of halvings of a segment: pieces of a thousandth of the cube's size cannot be seen.
const SEGMENT_HALVINGS: [usize; 2] = [2, 9];
/// Largest number of times that triangles are divided.
const SURFACE_HALVINGS: usize = 4;

impl ColorSpace {
    /// The twelve edges of the RGB cube in the world: the outline of all colors.
    pub fn frame(self, full_counts: f32) -> Vec<Vec<Point>> {
        let mut edges = Vec::with_capacity(12);
        for corner in 0..8usize {
            for band in (0..3).filter(|band| corner >> band & 1 == 0) {
                let end = |at: usize| std::array::from_fn(|i| (at >> i & 1) as f32 * full_counts);
                edges.push(self.segment(end(corner), end(corner | 1 << band), full_counts));
            }
        }
        edges
    }

    /// The straight segment from `a` to `b`, both in counts, as a curve in the world.
    pub fn segment(self, a: Point, b: Point, full_counts: f32) -> Vec<Point> {
        let at = |t: f32| std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t);
        if self == Self::Rgb {
            return vec![self.place(a, full_counts), self.place(b, full_counts)];
        }
        // Chromaticity is not continuous at black: the curve begins just beside black.
        let is_black = |v: Point| v.iter().sum::<f32>() < 1e-3 * full_counts;
        let leaps = self == Self::Chromaticity;
        let from = if leaps && is_black(a) { 1e-3 } else { 0.0 };
        let to = if leaps && is_black(b) { 1.0 - 1e-3 } else { 1.0 };
        let curve = |t: f32| self.place(at(t), full_counts);
        let mut points = vec![curve(from)];
        subdivide(&curve, [from, to], 0, &mut points);
        points
    }

    /// [`Self::segment`] for each piece of a polyline.
    pub fn polyline(self, points: &[Point], full_counts: f32) -> Vec<Point> {
        let mut curve: Vec<Point> =
            points.first().map(|&p| self.place(p, full_counts)).into_iter().take(1).collect();
        for pair in points.windows(2) {
            let piece = self.segment(pair[0], pair[1], full_counts);
            if curve.len() == 1 {
                curve.clear();
                curve.extend(piece);
            } else {
                curve.extend(piece.into_iter().skip(1));
            }
        }
        curve
    }

    /// A surface in counts as a surface in the world, subdivided until the surface looks smooth, without cracks.
    pub fn surface(self, mesh: &Mesh, full_counts: f32) -> Mesh {
        let mut fine = mesh.clone();
        if self != Self::Rgb {
            for _ in 0..SURFACE_HALVINGS {
                if !self.divide(&mut fine, full_counts) {
                    break;
                }
            }
            let turned = fine.points.iter().zip(&fine.normals);
            fine.normals = turned.map(|(&p, &n)| self.normal(p, n, full_counts)).collect();
        }
        for point in &mut fine.points {
            *point = self.place(*point, full_counts);
        }
        fine
    }

    /// Divides the triangles whose edges become curves. Only the ends of an edge decide whether the edge is divided, so that its
    /// two triangles agree. Returns whether any was.
    fn divide(self, mesh: &mut Mesh, full_counts: f32) -> bool {
        let mut middles: BTreeMap<(u32, u32), Option<u32>> = BTreeMap::new();
        let mut triangles = Vec::with_capacity(mesh.triangles.len() * 4);
        for triangle in std::mem::take(&mut mesh.triangles) {
            let middle: [Option<u32>; 3] = std::array::from_fn(|i| {
                let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let (p, q) = (mesh.points[a as usize], mesh.points[b as usize]);
                    self.bends(p, q, full_counts).then(|| {
                        mesh.points.push(halfway(p, q));
                        let (m, n) = (mesh.normals[a as usize], mesh.normals[b as usize]);
                        mesh.normals.push(unit(halfway(m, n)).unwrap_or(m));
                        mesh.points.len() as u32 - 1
                    })
                })
            });
            push_divided(&mut triangles, triangle, middle);
        }
        mesh.triangles = triangles;
        middles.values().any(Option::is_some)
    }

    /// Whether the straight edge between two colors becomes a curve in the world that is not straight.
    fn bends(self, a: Point, b: Point, full_counts: f32) -> bool {
        let (p, q) = (self.place(a, full_counts), self.place(b, full_counts));
        let middle = self.place(halfway(a, b), full_counts);
        distance(middle, halfway(p, q)) > 2.0 * STRAIGHT
    }

    /// The normal of a surface in the world: the cofactors of the map's derivatives, applied to the normal in counts.
    fn normal(self, point: Point, normal: Point, full_counts: f32) -> Point {
        let step = 1e-3 * full_counts;
        // Away from black and the cube's lower sides, where some spaces have no derivative.
        let inside = point.map(|v| v.max(LOG_FLOOR * full_counts + 2.0 * step));
        let columns: [Point; 3] = std::array::from_fn(|band| {
            let (mut low, mut high) = (inside, inside);
            low[band] -= step;
            high[band] += step;
            let (p, q) = (self.place(low, full_counts), self.place(high, full_counts));
            std::array::from_fn(|i| q[i] - p[i])
        });
        let cofactors =
            [cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])];
        let orientation = dot(columns[0], cofactors[0]).signum();
        let turned: Point =
            std::array::from_fn(|i| orientation * (0..3).map(|k| cofactors[k][i] * normal[k]).sum::<f32>());
        unit(turned).unwrap_or(normal)
    }
}

/// Appends the curve after `range[0]`, up to and with `range[1]`.
fn subdivide(curve: &impl Fn(f32) -> Point, range: [f32; 2], depth: usize, points: &mut Vec<Point>) {
    let middle = f32::midpoint(range[0], range[1]);
    let (p, q) = (curve(range[0]), curve(range[1]));
    let stray = [0.25, 0.5, 0.75].map(|t: f32| {
        let chord = std::array::from_fn(|i| p[i] + (q[i] - p[i]) * t);
        distance(curve(range[0] + (range[1] - range[0]) * t), chord)
    });
    let straight = stray.iter().all(|&stray| stray <= STRAIGHT);
    if depth >= SEGMENT_HALVINGS[1] || (depth >= SEGMENT_HALVINGS[0] && straight) {
        points.push(q);
        return;
    }
    subdivide(curve, [range[0], middle], depth + 1, points);
    subdivide(curve, [middle, range[1]], depth + 1, points);
}

/// A triangle, divided at the middles of those of its edges that have one; edge `i` runs from corner `i` to the next.
fn push_divided(triangles: &mut Vec<[u32; 3]>, corners: [u32; 3], middles: [Option<u32>; 3]) {
    // Turned so that the first edge is divided, and, of two, the last is not.
    let turn = match middles {
        [None, Some(_), _] => 1,
        [_, None, Some(_)] => 2,
        _ => 0,
    };
    let [a, b, c] = std::array::from_fn(|i| corners[(i + turn) % 3]);
    match std::array::from_fn(|i| middles[(i + turn) % 3]) {
        [Some(ab), Some(bc), Some(ca)] => {
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        [Some(ab), Some(bc), None] => triangles.extend([[a, ab, bc], [ab, b, bc], [a, bc, c]]),
        [Some(ab), None, _] => triangles.extend([[a, ab, c], [ab, b, c]]),
        _ => triangles.push([a, b, c]),
    }
}

#[cfg(test)]
mod tests {
    use super::super::solid::octant;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_ray_from_black_is_upright_in_chromaticity_and_straight_in_hsv() {
        let ray = ColorSpace::Chromaticity.segment([0.0; 3], [200.0, 80.0, 40.0], 255.0);
        assert!(ray.iter().all(|p| distance(*p, [0.625, 0.25, p[2]]) < 1e-4), "{ray:?}");
        let [first, .., last] = ColorSpace::Hsv.segment([0.0; 3], [200.0, 80.0, 40.0], 255.0)[..] else {
            panic!("a segment has two ends")
        };
        assert!(distance(first, [0.5, 0.5, 0.0]) < 1e-6 && (last[2] - 200.0 / 255.0).abs() < 1e-6);
    }

    #[test]
    fn a_curve_goes_through_every_corner_of_a_polyline_once() {
        let corners = [[10.0, 20.0, 30.0], [200.0, 40.0, 90.0], [90.0, 250.0, 10.0]];
        for space in ColorSpace::ALL {
            let curve = space.polyline(&corners, 255.0);
            for corner in corners {
                let place = space.place(corner, 255.0);
                assert_eq!(curve.iter().filter(|&&p| distance(p, place) < 1e-6).count(), 1, "{space:?}");
            }
            assert!(space.polyline(&[], 255.0).is_empty());
        }
        assert_eq!(ColorSpace::Rgb.polyline(&corners, 255.0).len(), 3);
        assert_eq!(ColorSpace::Rgb.frame(255.0).len(), 12);
    }

    #[test]
    fn a_subdivided_surface_has_no_cracks() {
        let body = octant(200.0).surface;
        for space in ColorSpace::ALL {
            let mut fine = body.clone();
            while fine.triangles.len() < 20_000 && space.divide(&mut fine, 255.0) {}
            let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
            for [a, b, c] in &fine.triangles {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    *edges.entry((*from.min(to), *from.max(to))).or_default() += 1;
                }
            }
            let on_edge = |i: u32| fine.points[i as usize].iter().any(|v| v.abs() < 1e-3);
            for ((a, b), triangles) in edges {
                let ends = [a, b].map(|i| fine.points[i as usize]);
                assert!(
                    triangles == 2 || (triangles == 1 && on_edge(a) && on_edge(b)),
                    "{space:?} {ends:?} {triangles}"
                );
            }
            let placed = space.surface(&body, 255.0);
            assert!(placed.normals.iter().all(|n| (dot(*n, *n) - 1.0).abs() < 1e-3), "{space:?}");
        }
    }

    proptest! {
        #[test]
        fn a_segment_stays_near_the_true_curve(
            a in prop::array::uniform3(1f32..255.0), b in prop::array::uniform3(1f32..255.0), t in 0f32..1.0,
        ) {
            for space in ColorSpace::ALL {
                let curve = space.segment(a, b, 255.0);
                let exact = space.place(std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t), 255.0);
                let near = curve.windows(2).map(|ends| {
                    let (p, q) = (ends[0], ends[1]);
                    let (d, e): (Point, Point) =
                        (std::array::from_fn(|i| q[i] - p[i]), std::array::from_fn(|i| exact[i] - p[i]));
                    let along = (dot(d, e) / dot(d, d).max(1e-12)).clamp(0.0, 1.0);
                    distance(e, d.map(|v| v * along))
                });
                prop_assert!(near.fold(f32::INFINITY, f32::min) < 2.0 * STRAIGHT, "{space:?}");
            }
        }

        #[test]
        fn normals_stay_across_the_surface(
            p in prop::array::uniform3(20f32..250.0), u in prop::array::uniform3(-1f32..1.0),
            v in prop::array::uniform3(-1f32..1.0),
        ) {
            let Some(normal) = unit(cross(u, v)) else { return Ok(()) };
            prop_assume!(dot(cross(u, v), cross(u, v)) > 0.05);
            // Where two bands are equal, HSV has a kink.
            prop_assume!((0..3).all(|i| (p[i] - p[(i + 1) % 3]).abs() > 2.0));
            for space in ColorSpace::ALL {
                let turned = space.normal(p, normal, 255.0);
                for tangent in [u, v] {
                    let end = |s: f32| space.place(std::array::from_fn(|i| p[i] + s * tangent[i]), 255.0);
                    let (low, high) = (end(-0.5), end(0.5));
                    let moved = unit(std::array::from_fn(|i| high[i] - low[i])).unwrap();
                    prop_assert!(dot(turned, moved).abs() < 0.05, "{space:?} {}", dot(turned, moved));
                }
                // A point that lay outside still lies outside.
                let out = space.place(std::array::from_fn(|i| p[i] + 0.5 * normal[i]), 255.0);
                let own = space.place(p, 255.0);
                prop_assert!(dot(turned, std::array::from_fn(|i| out[i] - own[i])) > 0.0, "{space:?}");
            }
        }
    }
}
