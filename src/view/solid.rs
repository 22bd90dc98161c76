//! Lines and surfaces as plain numbers, and the bodies of which the shapes of the model consist.

use super::vector::{Point, cross64, dot64, point, unit};

/// A surface of triangles. Triangles share points where the surface is smooth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners of the triangles.
    pub points: Vec<Point>,
    /// Unit normal at each point, outward.
    pub normals: Vec<Point>,
    /// Indices into `points`, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// A body: its surface, and outlines that show its form where the surface is translucent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solid {
    /// The surface as triangles.
    pub surface: Mesh,
    /// The outlines, as polylines.
    pub outlines: Vec<Vec<Point>>,
}

impl Mesh {
    /// Adds a flat convex polygon, counter-clockwise as seen along −`normal`.
    pub(super) fn add_polygon(&mut self, corners: &[Point], normal: Point) {
        let first = self.points.len() as u32;
        self.points.extend_from_slice(corners);
        self.normals.resize(self.points.len(), normal);
        self.triangles.extend((2..corners.len() as u32).map(|i| [first, first + i - 1, first + i]));
    }

    /// Adds a grid of points with normals, `columns` in a row, whose rows close to rings where `closed`.
    fn add_grid(&mut self, grid: &[(Point, Point)], columns: usize, closed: bool) {
        let first = self.points.len();
        self.points.extend(grid.iter().map(|(point, _)| *point));
        self.normals.extend(grid.iter().map(|(_, normal)| *normal));
        for row in 1..grid.len() / columns {
            for column in 0..columns - usize::from(!closed) {
                let at = |r: usize, c: usize| (first + r * columns + c % columns) as u32;
                let [a, b] = [at(row - 1, column), at(row - 1, column + 1)];
                let [c, d] = [at(row, column), at(row, column + 1)];
                self.triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
}

/// All points with `normal · p ≤ limit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// Unit vector that points out of the half space.
    pub normal: [f64; 3],
    /// Signed distance of the side from the origin.
    pub limit: f64,
}

impl HalfSpace {
    /// The half space that ends at `limit` along `direction`, which need not be a unit vector.
    pub fn new(direction: [f64; 3], limit: f64) -> Self {
        let length = dot64(direction, direction).sqrt();
        Self { normal: direction.map(|v| v / length), limit: limit / length }
    }

    fn excess(&self, point: [f64; 3]) -> f64 {
        dot64(self.normal, point) - self.limit
    }
}

/// The six sides of the cube from 0 to `full_counts`.
pub fn cube(full_counts: f64) -> [HalfSpace; 6] {
    std::array::from_fn(|side| {
        let mut normal = [0.0; 3];
        normal[side % 3] = if side < 3 { -1.0 } else { 1.0 };
        HalfSpace { normal, limit: if side < 3 { 0.0 } else { full_counts } }
    })
}

/// The face of a convex body, given by half spaces, on the side of one of them: its corners counter-clockwise from outside,
/// none where that side does not bound the body. `reach` is larger than the body.
pub fn face(sides: &[HalfSpace], side: usize, reach: f64) -> Vec<[f64; 3]> {
    let HalfSpace { normal, limit } = sides[side];
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let u = cross64(axis, normal);
    let u = u.map(|v| v / dot64(u, u).sqrt());
    let v = cross64(normal, u);
    let mut corners: Vec<[f64; 3]> = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
        .map(|[s, t]| std::array::from_fn(|i| normal[i] * limit + reach * (s * u[i] + t * v[i])))
        .to_vec();
    for (other, half) in sides.iter().enumerate() {
        // Of two sides in one plane the earlier one bounds the body.
        let same = dot64(half.normal, normal) > 1.0 - 1e-12 && (half.limit - limit).abs() < 1e-9 * reach;
        if same && other < side {
            return Vec::new();
        }
        if !same {
            corners = clipped(&corners, half);
        }
    }
    if corners.len() < 3 { Vec::new() } else { corners }
}

/// The part of a convex polygon inside a half space (Sutherland & Hodgman 1974).
fn clipped(corners: &[[f64; 3]], half: &HalfSpace) -> Vec<[f64; 3]> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (from, to) = (half.excess(a), half.excess(b));
        if from <= 0.0 {
            kept.push(a);
        }
        if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
            let t = from / (from - to);
            kept.push(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t));
        }
    }
    kept
}

/// The convex body inside all of `sides`, within `reach` of the origin. The outlines are the edges of the
/// faces on the first `shown` sides.
pub fn convex_body(sides: &[HalfSpace], reach: f64, shown: usize) -> Solid {
    let mut body = Solid::default();
    for side in 0..sides.len() {
        let corners: Vec<Point> = face(sides, side, reach).into_iter().map(point).collect();
        if corners.is_empty() {
            continue;
        }
        body.surface.add_polygon(&corners, point(sides[side].normal));
        if side < shown {
            body.outlines.push(corners.iter().chain(corners.first()).copied().collect());
        }
    }
    body
}

/// Facets around a cylinder or an ellipsoid.
const AROUND: usize = 64;
/// Rows of an ellipsoid from pole to pole.
const ROWS: usize = 32;
/// Rows of the dark sphere's octant.
const OCTANT_ROWS: usize = 16;

/// A cylinder between the dark sphere and the far sides of the cube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// A point of the axis, counts.
    pub mean: [f64; 3],
    /// Unit vector along the axis.
    pub direction: [f64; 3],
    /// Distance of the surface from the axis, counts.
    pub radius: f64,
    /// Radius of the dark sphere, at which the cylinder begins, counts.
    pub dark: f64,
    /// The end of the cube in each band, counts.
    pub full: f64,
}

impl Tube {
    /// The surface from the dark sphere to the far sides of the cube, with both rims; none where nothing lies between them.
    pub fn solid(&self) -> Option<Solid> {
        let d = self.direction;
        let axis = if d[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let u = cross64(d, axis);
        let u = u.map(|v| v / dot64(u, u).sqrt());
        let v = cross64(d, u);
        let (mut near, mut far) = (Vec::with_capacity(AROUND), Vec::with_capacity(AROUND));
        for i in 0..AROUND {
            let (sine, cosine) = (std::f64::consts::TAU * i as f64 / AROUND as f64).sin_cos();
            let outward: [f64; 3] = std::array::from_fn(|k| u[k] * cosine + v[k] * sine);
            let on_side: [f64; 3] = std::array::from_fn(|k| self.mean[k] + outward[k] * self.radius);
            let [from, to] = self.extent(on_side)?;
            let at = |t: f64| point(std::array::from_fn(|k| on_side[k] + d[k] * t));
            near.push((at(from), point(outward)));
            far.push((at(to), point(outward)));
        }
        let ring = |rim: &[(Point, Point)]| rim.iter().chain(rim.first()).map(|(p, _)| *p).collect();
        let outlines = vec![ring(&near), ring(&far)];
        let mut surface = Mesh::default();
        surface.add_grid(&[near, far].concat(), AROUND, true);
        Some(Solid { surface, outlines })
    }

    /// The two ends of the axis.
    pub fn axis(&self) -> Option<[Point; 2]> {
        let ends = self.extent(self.mean)?;
        Some(ends.map(|t| point(std::array::from_fn(|k| self.mean[k] + self.direction[k] * t))))
    }

    /// The distances from `start` along the axis at which the line through `start` leaves the dark sphere and the cube, counts;
    /// none where nothing of the line lies between them.
    fn extent(&self, start: [f64; 3]) -> Option<[f64; 2]> {
        let d = self.direction;
        let nearest = -dot64(start, d);
        let off2 = dot64(start, start) - nearest * nearest;
        let from = nearest + (self.dark * self.dark - off2).max(0.0).sqrt();
        let leaves = |k: usize| (d[k] > 1e-9).then(|| (self.full - start[k]) / d[k]);
        let to = (0..3).filter_map(leaves).fold(f64::INFINITY, f64::min);
        (to.is_finite() && from < to).then_some([from, to])
    }
}

/// The part of a sphere around black that lies in the cube, with its three edges.
pub fn octant(radius: f64) -> Solid {
    let along = |i: usize, n: usize| std::f64::consts::FRAC_PI_2 * i as f64 / n as f64;
    let direction = |row: usize, column: usize| {
        let (up, around) = (along(row, OCTANT_ROWS).sin_cos(), along(column, OCTANT_ROWS).sin_cos());
        [up.1 * around.1, up.1 * around.0, up.0]
    };
    let rows = (0..=OCTANT_ROWS).flat_map(|row| (0..=OCTANT_ROWS).map(move |column| (row, column)));
    let grid: Vec<(Point, Point)> = rows
        .map(|(row, column)| direction(row, column))
        .map(|d| (point(d.map(|v| v * radius)), point(d)))
        .collect();
    let mut surface = Mesh::default();
    surface.add_grid(&grid, OCTANT_ROWS + 1, false);
    let edge = |place: &dyn Fn(usize) -> [f64; 3]| {
        (0..=OCTANT_ROWS).map(|i| point(place(i).map(|v| v * radius))).collect()
    };
    let outlines = vec![
        edge(&|i| direction(i, 0)),
        edge(&|i| direction(0, OCTANT_ROWS - i)),
        edge(&|i| direction(i, OCTANT_ROWS)),
    ];
    Solid { surface, outlines }
}

/// The ellipsoid with half axes along the unit vectors `axes`, with its three principal ellipses.
pub fn ellipsoid(center: [f64; 3], axes: [[f64; 3]; 3], half_lengths: [f64; 3]) -> Solid {
    // A flat ellipsoid still has normals.
    let half = half_lengths.map(|length| length.max(1e-3));
    let at = |d: [f64; 3]| {
        point(std::array::from_fn(|k| center[k] + (0..3).map(|i| d[i] * half[i] * axes[i][k]).sum::<f64>()))
    };
    let normal = |d: [f64; 3]| {
        let n: Point =
            point(std::array::from_fn(|k| (0..3).map(|i| d[i] / half[i] * axes[i][k]).sum::<f64>()));
        unit(n).unwrap_or([0.0, 0.0, 1.0])
    };
    let turn = |i: usize| (std::f64::consts::TAU * i as f64 / AROUND as f64).sin_cos();
    let mut grid = Vec::with_capacity((ROWS + 1) * AROUND);
    for row in 0..=ROWS {
        let (sine, cosine) = (std::f64::consts::PI * (1.0 - row as f64 / ROWS as f64)).sin_cos();
        for column in 0..AROUND {
            let (y, x) = turn(column);
            let d = [sine * x, sine * y, cosine];
            grid.push((at(d), normal(d)));
        }
    }
    let mut surface = Mesh::default();
    surface.add_grid(&grid, AROUND, true);
    let ring = |place: &dyn Fn((f64, f64)) -> [f64; 3]| (0..=AROUND).map(|i| at(place(turn(i)))).collect();
    let outlines =
        vec![ring(&|(s, c)| [c, s, 0.0]), ring(&|(s, c)| [c, 0.0, s]), ring(&|(s, c)| [0.0, c, s])];
    Solid { surface, outlines }
}

#[cfg(test)]
mod tests {
    use super::super::vector::{cross, dot};
    use super::*;
    use proptest::prelude::*;

    /// Volume that a surface encloses, and its area.
    fn volume_and_area(mesh: &Mesh) -> (f32, f32) {
        mesh.triangles.iter().fold((0.0, 0.0), |(volume, area), corners| {
            let [a, b, c] = corners.map(|i| mesh.points[i as usize]);
            let side = |p: Point| std::array::from_fn(|i| p[i] - a[i]);
            let across = cross(side(b), side(c));
            (volume + dot(a, cross(b, c)) / 6.0, area + dot(across, across).sqrt() / 2.0)
        })
    }

    /// The order of the corners agrees with the normals.
    fn is_outward(mesh: &Mesh) -> bool {
        mesh.triangles.iter().all(|corners| {
            let [a, b, c] = corners.map(|i| mesh.points[i as usize]);
            let side = |p: Point| std::array::from_fn(|i| p[i] - a[i]);
            let across = cross(side(b), side(c));
            // At the poles of a grid triangles have no area.
            dot(across, across) < 1e-9 || corners.iter().all(|&i| dot(across, mesh.normals[i as usize]) > 0.0)
        })
    }

    #[test]
    fn a_cube_cut_across_its_diagonal_has_a_hexagon() {
        let mut sides = cube(2.0).to_vec();
        sides.push(HalfSpace::new([1.0; 3], 3.0));
        let hexagon = face(&sides, 6, 10.0);
        assert_eq!(hexagon.len(), 6);
        assert!(hexagon.iter().all(|p| p.iter().any(|v| (v - 1.0).abs() < 1e-9)), "{hexagon:?}");
        let half = convex_body(&sides, 10.0, 7);
        let (volume, _) = volume_and_area(&half.surface);
        assert!((volume - 4.0).abs() < 1e-4 && is_outward(&half.surface), "{volume}");
    }

    #[test]
    fn a_half_space_that_bounds_nothing_has_no_face() {
        let mut sides = cube(1.0).to_vec();
        sides.push(HalfSpace::new([1.0; 3], 9.0));
        sides.push(HalfSpace::new([2.0, 0.0, 0.0], 2.0));
        assert!(face(&sides, 6, 10.0).is_empty() && face(&sides, 7, 10.0).is_empty());
        let whole = convex_body(&sides, 10.0, 8);
        assert_eq!((whole.surface.triangles.len(), whole.outlines.len()), (12, 6));
    }

    #[test]
    fn sphere_and_ellipsoid_have_their_volume_and_area() {
        let (_, area) = volume_and_area(&octant(23.0).surface);
        assert!((area / (std::f32::consts::PI * 23.0 * 23.0 / 2.0) - 1.0).abs() < 0.01);
        assert!(is_outward(&octant(23.0).surface));
        let axes = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
        let body = ellipsoid([90.0, 80.0, 70.0], axes, [9.0, 5.0, 2.0]);
        let (volume, _) = volume_and_area(&body.surface);
        assert!((volume / (4.0 / 3.0 * std::f32::consts::PI * 90.0) - 1.0).abs() < 0.02, "{volume}");
        assert!(is_outward(&body.surface) && body.outlines.len() == 3);
        let top = body.surface.points.iter().fold(0.0f32, |most, p| most.max(p[1]));
        assert!((top - 89.0).abs() < 1e-3, "{top}");
    }

    #[test]
    fn a_tube_begins_at_the_dark_sphere_and_ends_at_the_cube() {
        let tube =
            Tube { mean: [90.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0], radius: 5.0, dark: 13.0, full: 255.0 };
        let [from, to] = tube.axis().unwrap();
        assert_eq!((from, to), ([13.0, 0.0, 0.0], [255.0, 0.0, 0.0]));
        let rims = tube.solid().unwrap().outlines;
        assert!(rims[0].iter().all(|p| (p[0] - 12.0).abs() < 1e-4), "5² + 12² = 13²");
        let missing = Tube { mean: [50.0, 50.0, 0.0], dark: 400.0, ..tube };
        assert!(missing.solid().is_none());
    }

    proptest! {
        #[test]
        fn a_slab_through_the_cube_is_closed(
            n in prop::array::uniform3(-1f64..1.0), c in prop::array::uniform3(20f64..235.0), half in 1f64..9.0,
        ) {
            prop_assume!(dot64(n, n) > 0.01);
            let upper = HalfSpace::new(n, dot64(n, c) + half * dot64(n, n).sqrt());
            let lower = HalfSpace::new(n.map(|v| -v), half * dot64(n, n).sqrt() - dot64(n, c));
            let sides = [&[upper, lower][..], &cube(255.0)].concat();
            let body = convex_body(&sides, 1000.0, 2);
            prop_assert!(is_outward(&body.surface));
            for &p in &body.surface.points {
                let inside = sides.iter().all(|side| side.excess(p.map(f64::from)) < 1e-3);
                prop_assert!(inside, "{p:?}");
            }
            // A closed surface encloses the same volume from wherever it is seen.
            let (volume, area) = volume_and_area(&body.surface);
            let mut moved = body.surface.clone();
            for p in &mut moved.points { *p = p.map(|v| v - 100.0); }
            prop_assert!((volume_and_area(&moved).0 - volume).abs() < 1e-3 * area * 255.0 / 3.0);
        }

        #[test]
        fn a_tube_lies_at_its_radius(
            d in prop::array::uniform3(0.1f64..1.0), m in 60f64..120.0, off in prop::array::uniform3(-3f64..3.0),
        ) {
            let length = dot64(d, d).sqrt();
            let d = d.map(|v| v / length);
            let mean = std::array::from_fn(|k| d[k] * m + off[k]);
            let tube = Tube { mean, direction: d, radius: 9.0, dark: 23.0, full: 255.0 };
            let solid = tube.solid().unwrap();
            prop_assert!(is_outward(&solid.surface));
            for p in &solid.surface.points {
                let v = std::array::from_fn(|k| f64::from(p[k]) - mean[k]);
                let off = cross64(v, d);
                prop_assert!((dot64(off, off).sqrt() - 9.0).abs() < 1e-3);
            }
            for p in &solid.outlines[0] {
                prop_assert!((f64::from(dot(*p, *p)).sqrt() - 23.0).abs() < 1e-2);
            }
            for p in &solid.outlines[1] {
                prop_assert!((p.iter().fold(0.0f32, |most, v| most.max(*v)) - 255.0).abs() < 1e-2);
            }
        }
    }
}
