//! Projects single points from the world to the screen.

use nalgebra::{Matrix4, Vector3};

/// The position of a world point on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenPoint {
    /// Position from the top left corner, y downwards, in the unit of the screen's size.
    pub at: [f32; 2],
    /// Depth: 0 at the near plane, 1 at the far plane. A smaller depth is in front.
    pub depth: f32,
}

/// A line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start of the line of sight, world units.
    pub origin: [f32; 3],
    /// Direction, unit vector.
    pub direction: [f32; 3],
}

impl Ray {
    /// The point at which the ray meets the plane through `point`; `None` for a ray parallel to the plane.
    pub fn meet_plane(&self, point: [f32; 3], normal: [f32; 3]) -> Option<[f32; 3]> {
        let [origin, direction, point, normal] =
            [self.origin, self.direction, point, normal].map(Vector3::from);
        let slope = direction.dot(&normal);
        let along = (point - origin).dot(&normal) / slope;
        (slope.abs() > 1e-6 * normal.norm()).then(|| (origin + direction * along).into())
    }

    /// Distance of a point from the ray's line, world units.
    pub fn distance(&self, point: [f32; 3]) -> f32 {
        let [origin, direction, point] = [self.origin, self.direction, point].map(Vector3::from);
        (point - origin).cross(&direction).norm()
    }
}

/// A camera and a screen, ready to project many points. Made by [`super::Orbit::projector`].
#[derive(Clone, Copy, Debug)]
pub struct Projector {
    clip_from_world: Matrix4<f32>,
    size: [f32; 2],
}

impl Projector {
    pub(super) fn new(clip_from_world: &Matrix4<f32>, size: [f32; 2]) -> Self {
        Self { clip_from_world: *clip_from_world, size }
    }

    /// The position of a world point on the screen or outside of the screen; `None` for a point behind the near plane.
    pub fn screen_from_world(&self, world: [f32; 3]) -> Option<ScreenPoint> {
        let m = &self.clip_from_world;
        let [x, y, z] = world;
        // The product is written out, because the function is called for each point and debug builds do not inline nalgebra's.
        let clip = |row: usize| m[(row, 0)] * x + m[(row, 1)] * y + m[(row, 2)] * z + m[(row, 3)];
        let (w, depth) = (clip(3), clip(2));
        (w > 0.0 && depth >= 0.0).then(|| ScreenPoint {
            at: [(0.5 + 0.5 * clip(0) / w) * self.size[0], (0.5 - 0.5 * clip(1) / w) * self.size[1]],
            depth: depth / w,
        })
    }
}
