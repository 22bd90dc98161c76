//! The shapes of the model as triangles and edges: cylinders around lines, slices around planes, the cube itself.

use super::scene::Vertex;
use nalgebra::Vector3;

const CORNERS: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];

/// The twelve edges of the unit cube, each with the end nearer to black first.
pub fn cube_edges() -> [[[f32; 3]; 2]; 12] {
    std::array::from_fn(|edge| {
        let (axis, side) = (edge / 4, edge % 4);
        // The two bits of `side` are the coordinates of the other two axes; the bit at `axis` is 0 and 1.
        let low = side & ((1 << axis) - 1);
        let from = low | ((side & !((1 << axis) - 1)) << 1);
        [CORNERS[from], CORNERS[from | (1 << axis)]]
    })
}

/// Triangles of a cylinder around the line from `a` to `b`, with flat ends and `sides` facets. The facets look round, because their
/// normals are those of the cylinder.
pub fn cylinder(a: [f32; 3], b: [f32; 3], radius: f32, sides: usize, color: [u8; 4]) -> Vec<Vertex> {
    let [a, b] = [a, b].map(Vector3::from);
    let Some(axis) = (b - a).try_normalize(1e-9) else { return Vec::new() };
    let [u, v] = perpendicular(axis);
    let sides = sides.max(3);
    let spoke = |side: usize| {
        let angle = std::f32::consts::TAU * (side % sides) as f32 / sides as f32;
        u * angle.cos() + v * angle.sin()
    };
    let mut triangles = Vec::with_capacity(12 * sides);
    let mut push = |position: Vector3<f32>, normal: Vector3<f32>| {
        triangles.push(Vertex { position: position.into(), normal: normal.into(), color });
    };
    for side in 0..sides {
        let [from, to] = [spoke(side), spoke(side + 1)];
        for (end, spoke) in [(a, from), (a, to), (b, to), (a, from), (b, to), (b, from)] {
            push(end + spoke * radius, spoke);
        }
        for (center, normal, spokes) in [(a, -axis, [to, from]), (b, axis, [from, to])] {
            push(center, normal);
            for spoke in spokes {
                push(center + spoke * radius, normal);
            }
        }
    }
    triangles
}

/// Triangles of a slab: a flat convex polygon, extended to both sides by `half_width` along the polygon's normal. A slab without
/// width is a single sheet.
pub fn slab(polygon: &[[f32; 3]], half_width: f32, color: [u8; 4]) -> Vec<Vertex> {
    let corners: Vec<Vector3<f32>> = polygon.iter().map(|&corner| Vector3::from(corner)).collect();
    let Some(normal) = polygon_normal(&corners) else { return Vec::new() };
    let mut triangles = Vec::new();
    let mut push = |corners: [Vector3<f32>; 3], normal: Vector3<f32>| {
        let vertex = |corner: Vector3<f32>| Vertex { position: corner.into(), normal: normal.into(), color };
        triangles.extend(corners.map(vertex));
    };
    let thick = half_width > 0.0;
    let aside = normal * if thick { half_width } else { 0.0 };
    for pair in corners[1..].windows(2) {
        push([corners[0], pair[0], pair[1]].map(|c| c + aside), normal);
        if thick {
            push([corners[0], pair[1], pair[0]].map(|c| c - aside), -normal);
        }
    }
    for (index, &from) in corners.iter().enumerate().filter(|_| thick) {
        let to = corners[(index + 1) % corners.len()];
        let Some(outward) = (to - from).cross(&normal).try_normalize(1e-9) else { continue };
        push([from - aside, to - aside, to + aside], outward);
        push([from - aside, to + aside, from + aside], outward);
    }
    triangles
}

/// The intersection of a plane and the unit cube: a convex polygon of three to six corners, counter-clockwise seen against the
/// normal; empty where the plane misses the cube.
pub fn plane_in_cube(point: [f32; 3], normal: [f32; 3]) -> Vec<[f32; 3]> {
    let point = Vector3::from(point);
    let Some(normal) = Vector3::from(normal).try_normalize(1e-9) else { return Vec::new() };
    let mut corners: Vec<Vector3<f32>> = Vec::new();
    for [from, to] in cube_edges().map(|edge| edge.map(Vector3::from)) {
        let [above, below] = [(from - point).dot(&normal), (to - point).dot(&normal)];
        let along = above / (above - below);
        if (0.0..=1.0).contains(&along) {
            let corner = from + (to - from) * along;
            // Three edges meet at a corner of the cube, so that a corner may be found more than once.
            if corners.iter().all(|known| (known - corner).norm() > 1e-5) {
                corners.push(corner);
            }
        }
    }
    if corners.len() < 3 {
        return Vec::new();
    }
    let middle = corners.iter().sum::<Vector3<f32>>() / corners.len() as f32;
    let [u, v] = perpendicular(normal);
    let angle = |corner: &Vector3<f32>| (corner - middle).dot(&v).atan2((corner - middle).dot(&u));
    corners.sort_by(|one, other| angle(one).total_cmp(&angle(other)));
    corners.into_iter().map(Into::into).collect()
}

/// Two unit vectors u and v that are perpendicular to `axis`, with u × v = axis.
fn perpendicular(axis: Vector3<f32>) -> [Vector3<f32>; 2] {
    let helper = if axis.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let u = helper.cross(&axis).normalize();
    [u, axis.cross(&u)]
}

/// Unit normal of a flat polygon whose corners run counter-clockwise around the normal; `None` for a polygon without area.
fn polygon_normal(corners: &[Vector3<f32>]) -> Option<Vector3<f32>> {
    let first = corners.first()?;
    let fans = corners[1..].windows(2).map(|pair| (pair[0] - first).cross(&(pair[1] - first)));
    fans.sum::<Vector3<f32>>().try_normalize(1e-12)
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLOR: [u8; 4] = [200, 100, 50, 90];

    /// Checks that every triangle is counter-clockwise around the triangle's normals, and that the surface is closed: the vectors
    /// of all areas add up to zero.
    #[track_caller]
    fn assert_closed_and_outward(triangles: &[Vertex]) {
        let mut total = Vector3::zeros();
        for corners in triangles.as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|vertex| Vector3::from(vertex.position));
            let area = (b - a).cross(&(c - a));
            for vertex in corners {
                assert!(area.dot(&Vector3::from(vertex.normal)) > 0.8 * area.norm(), "{corners:?}");
            }
            total += area;
        }
        assert!(total.norm() < 1e-5, "{total}");
    }

    #[test]
    fn twelve_edges_of_unit_length() {
        let edges = cube_edges();
        for (index, [from, to]) in edges.iter().enumerate() {
            let mut step: [u8; 3] = std::array::from_fn(|axis| (to[axis] - from[axis]) as u8);
            step.sort_unstable();
            assert_eq!(step, [0, 0, 1]);
            assert!(!edges[..index].contains(&[*from, *to]));
        }
    }

    #[test]
    fn a_cylinder_keeps_its_radius() {
        let (a, b) = ([0.0, 0.1, 0.0], [0.6, 0.5, 0.9]);
        let triangles = cylinder(a, b, 0.05, 24, COLOR);
        assert_closed_and_outward(&triangles);
        let axis = (Vector3::from(b) - Vector3::from(a)).normalize();
        for vertex in triangles {
            let away = (Vector3::from(vertex.position) - Vector3::from(a)).cross(&axis).norm();
            assert!(away < 1e-6 || (away - 0.05).abs() < 1e-6, "{vertex:?}");
        }
        assert!(cylinder(a, a, 0.05, 24, COLOR).is_empty());
    }

    #[test]
    fn the_plane_across_gray_is_a_hexagon() {
        let hexagon = plane_in_cube([0.5; 3], [1.0; 3]);
        assert_eq!(hexagon.len(), 6);
        for (index, corner) in hexagon.iter().enumerate() {
            let next = hexagon[(index + 1) % 6];
            let side = (Vector3::from(next) - Vector3::from(*corner)).norm();
            assert!((side - 0.5_f32.sqrt()).abs() < 1e-5, "{side}");
        }
    }

    #[test]
    fn planes_cut_polygons_of_three_to_six_corners() {
        for (point, normal, corners) in [
            ([0.2, 0.0, 0.0], [1.0, 1.0, 1.0], 3),
            ([0.5; 3], [1.0, 0.0, 0.0], 4),
            ([0.0; 3], [1.0, -1.0, 0.0], 4),
            ([0.5, 0.5, 0.4], [1.0, 1.0, 0.8], 6),
            ([0.5, 0.5, 0.8], [1.0, 1.0, 1.6], 5),
            ([3.0; 3], [1.0, 1.0, 1.0], 0),
            ([0.0; 3], [0.0; 3], 0),
        ] {
            assert_eq!(plane_in_cube(point, normal).len(), corners, "{point:?} {normal:?}");
        }
    }

    #[test]
    fn a_slab_is_closed_and_a_sheet_is_single() {
        let polygon = plane_in_cube([0.5, 0.4, 0.3], [0.3, -0.2, 0.9]);
        assert_closed_and_outward(&slab(&polygon, 0.02, COLOR));
        let sheet = slab(&polygon, 0.0, COLOR);
        assert_eq!(sheet.len(), 3 * (polygon.len() - 2));
        let normal = Vector3::new(0.3, -0.2, 0.9).normalize();
        assert!(
            (Vector3::from(sheet[0].normal) - normal).norm() < 1e-5,
            "the polygon turns around its normal"
        );
        assert!(slab(&[], 0.1, COLOR).is_empty());
    }
}
