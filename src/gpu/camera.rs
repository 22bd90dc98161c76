//! The camera that turns around the color cube.
//!
//! World units are counts / 255: black is the origin, white (1, 1, 1); x is red, y green, z blue. The camera looks at a
//! target from a distance. Any orientation is possible, so that the camera can face any plane; dragging turns blue up again.

use super::projector::{Projector, Ray, ScreenPoint};
use nalgebra::{Matrix3, Matrix4, Quaternion, Rotation3, UnitQuaternion, Vector3, Vector4};
use serde::{Deserialize, Serialize};

/// Height of the field of view in perspective, degrees. The angle is small, so that parallel lines of the cube look parallel.
const FIELD_OF_VIEW_DEG: f32 = 30.0;
/// Angle by which a drag of one logical pixel turns the camera, degrees.
const TURN_DEG_PER_PX: f32 = 0.4;
/// Least and greatest distance to which zooming leads, world units.
const DISTANCE_RANGE: [f32; 2] = [0.01, 200.0];

/// Angle of a drag after which the roll has fallen to 1/e, degrees: blue is up again after a short drag, without a jump.
const LEVELING_DEG: f32 = 30.0;
/// Length of the horizontal part of the unit viewing direction below which the direction counts as vertical.
const POLE: f32 = 1e-3;
/// Distance from the cube up to which colors are drawn, world units: some pictures have colors far outside of the unit cube.
const WORLD_RADIUS: f32 = 32.0;
const CENTER: [f32; 3] = [0.5; 3];
/// Space around a framed sphere, as a factor of its radius.
const MARGIN: f32 = 1.06;
const BLUE: Vector3<f32> = Vector3::new(0.0, 0.0, 1.0);

/// The projection of depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// Perspective: farther objects are smaller.
    #[default]
    Perspective,
    /// Orthographic projection: parallel lines are parallel, and equal lengths equal.
    Orthographic,
}

/// Named views.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// From the front: red to the right, blue up, green into the screen.
    Home,
    /// Along the red axis, towards black: green to the right, blue up.
    Red,
    /// Along the green axis, from black: red to the right, blue up.
    Green,
    /// Along the blue axis, towards black: red to the right, green up.
    Blue,
    /// From white to black: the cube is a hexagon, blue up, gray a point.
    Gray,
}

impl Preset {
    /// All views, in the order of the menu.
    pub const ALL: [Self; 5] = [Self::Home, Self::Red, Self::Green, Self::Blue, Self::Gray];

    /// Direction of view, and the direction that is up on the screen.
    pub fn direction_and_up(self) -> [[f32; 3]; 2] {
        match self {
            Self::Home => [[-0.45, 1.0, -0.5], [0.0, 0.0, 1.0]],
            Self::Red => [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Green => [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            Self::Blue => [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
            Self::Gray => [[-1.0, -1.0, -1.0], [0.0, 0.0, 1.0]],
        }
    }
}

/// A camera on a sphere around a target, as plain data.
///
/// Screen positions and sizes are in one unit, logical or physical pixels; positions are measured from the top left corner, y
/// downwards.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Orbit {
    /// The point that the camera looks at and turns around, world units.
    pub target: [f32; 3],
    /// Unit quaternion (i, j, k, real part) from camera axes (right, up, backwards) to world axes.
    pub orientation: [f32; 4],
    /// Distance from the eye to the target, world units. The distance sets the scale of the orthographic projection as well.
    pub distance: f32,
    /// The projection of depth. Objects at the target have the same size in both projections.
    pub projection: Projection,
    /// What is nearer to the eye than this share of the cube's depth is cut away, 0…1; 0: nothing is. No part of a saved camera.
    #[serde(skip)]
    pub cut: f32,
}

impl Default for Orbit {
    /// The home view of the whole cube in a square window.
    fn default() -> Self {
        let mut camera = Self {
            target: CENTER,
            orientation: [0.0, 0.0, 0.0, 1.0],
            distance: 1.0,
            projection: Projection::Perspective,
            cut: 0.0,
        };
        camera.preset(Preset::Home);
        camera.fit(1.0);
        camera
    }
}

impl Orbit {
    /// This camera, or the default camera where this camera's numbers cannot be used, for cameras from a settings file.
    #[must_use]
    pub fn checked(self) -> Self {
        let numbers = self.target.iter().chain(&self.orientation).chain([&self.distance]);
        let finite = numbers.clone().all(|number| number.is_finite() && number.abs() < 1e6);
        let unit = (Vector4::from(self.orientation).norm() - 1.0).abs() < 1e-2;
        let in_range = (DISTANCE_RANGE[0]..=DISTANCE_RANGE[1]).contains(&self.distance);
        if finite && unit && in_range { self } else { Self::default() }
    }

    /// Turns the camera around the target, as a drag of `delta` logical pixels asks. The camera moves like a turntable: blue stays
    /// up, and where blue is not up, it returns there smoothly.
    pub fn orbit(&mut self, delta: [f32; 2]) {
        let [yaw, pitch, roll] = self.yaw_pitch_roll();
        let turned_deg = TURN_DEG_PER_PX * delta[0].hypot(delta[1]);
        let step = (TURN_DEG_PER_PX).to_radians();
        let right_angle = std::f32::consts::FRAC_PI_2;
        let pitch = (pitch - delta[1] * step).clamp(-right_angle, right_angle);
        self.set_yaw_pitch_roll(yaw - delta[0] * step, pitch, roll * (-turned_deg / LEVELING_DEG).exp());
    }

    /// Moves the scene by `delta` on a screen of `height`: points at the target's depth move by `delta`.
    pub fn pan(&mut self, delta: [f32; 2], height: f32) {
        if height > 0.0 {
            let world_per_px = 2.0 * self.half_height() / height;
            let [right, up, _] = self.axes();
            let moved = (right * -delta[0] + up * delta[1]) * world_per_px;
            self.target = (Vector3::from(self.target) + moved).into();
        }
    }

    /// Enlarges by `factor` (> 1 is nearer). The world point under the cursor at the target's depth keeps its place on the screen.
    pub fn zoom_at(&mut self, factor: f32, cursor: [f32; 2], size: [f32; 2]) {
        if size[1] > 0.0 {
            let world_per_px = 2.0 * self.half_height() / size[1];
            let [right, up, _] = self.axes();
            let offset = right * (cursor[0] - 0.5 * size[0]) - up * (cursor[1] - 0.5 * size[1]);
            self.zoom_about(factor, (Vector3::from(self.target) + offset * world_per_px).into());
        }
    }

    /// Enlarges by `factor`. The world point `fixed`, at any depth, keeps its place on the screen.
    pub fn zoom_about(&mut self, factor: f32, fixed: [f32; 3]) {
        if factor > 0.0 && factor.is_finite() {
            let distance = (self.distance / factor).clamp(DISTANCE_RANGE[0], DISTANCE_RANGE[1]);
            let fixed = Vector3::from(fixed);
            let target = fixed + (Vector3::from(self.target) - fixed) * (distance / self.distance);
            (self.target, self.distance) = (target.into(), distance);
        }
    }

    /// Turns the camera to look along `direction` with `up` upwards on the screen; target and distance do not change.
    ///
    /// `up` need not be perpendicular to `direction`; where the two are parallel, blue or green is up. A direction without length
    /// changes nothing.
    pub fn look_along(&mut self, direction: [f32; 3], up: [f32; 3]) {
        let Some(forward) = Vector3::from(direction).try_normalize(1e-12) else { return };
        let candidates = [Vector3::from(up), BLUE, Vector3::y()];
        let right = candidates.iter().find_map(|up| {
            let up = up.try_normalize(1e-12)?;
            forward.cross(&up).try_normalize(1e-4)
        });
        if let Some(right) = right {
            self.set_axes(right, right.cross(&forward), -forward);
        }
    }

    /// Turns the camera to a named view; target and distance do not change.
    pub fn preset(&mut self, preset: Preset) {
        let [direction, up] = preset.direction_and_up();
        self.look_along(direction, up);
    }

    /// Turns the camera to face the plane with this normal: the normal points to the viewer, `up` is up.
    pub fn face(&mut self, normal: [f32; 3], up: [f32; 3]) {
        self.look_along(normal.map(|n| -n), up);
    }

    /// Turns the camera to see the plane with this normal edge-on, as an upright line along `up`; the normal points right.
    pub fn edge_on(&mut self, normal: [f32; 3], up: [f32; 3]) {
        let direction = Vector3::from(up).cross(&Vector3::from(normal));
        self.look_along(direction.into(), up);
    }

    /// Moves the unit cube to the center of the screen, as large as possible for this aspect ratio (width / height).
    pub fn fit(&mut self, aspect: f32) {
        self.frame(CENTER, 0.75_f32.sqrt(), aspect);
    }

    /// Moves a sphere to the center of the screen, as large as possible for this aspect ratio (width / height).
    pub fn frame(&mut self, center: [f32; 3], radius: f32, aspect: f32) {
        // The sine is used because the silhouette of a sphere in perspective is a little larger than a great circle.
        let half_angle = (0.5 * FIELD_OF_VIEW_DEG).to_radians();
        let narrow = (half_angle.tan() * aspect.clamp(1e-3, 1.0)).atan();
        let distance = radius.max(0.0) * MARGIN / narrow.sin();
        self.target = center;
        self.distance = distance.clamp(DISTANCE_RANGE[0], DISTANCE_RANGE[1]);
    }

    /// Position of the camera, world units; in the orthographic projection the center of the plane from which it looks.
    pub fn eye(&self) -> [f32; 3] {
        let [_, _, backwards] = self.axes();
        (Vector3::from(self.target) + backwards * self.distance).into()
    }

    /// Unit vectors to the right, up and into the screen, in world axes.
    pub fn right_up_forward(&self) -> [[f32; 3]; 3] {
        let [right, up, backwards] = self.axes();
        [right.into(), up.into(), (-backwards).into()]
    }

    /// Half of the visible height at the target's depth, world units.
    pub fn half_height(&self) -> f32 {
        self.distance * (0.5 * FIELD_OF_VIEW_DEG).to_radians().tan()
    }

    /// The matrix from world coordinates to wgpu's clip space: x right, y up, depth from 0 (near) to 1.
    pub fn view_projection(&self, aspect: f32) -> Matrix4<f32> {
        let from_camera = self.rotation();
        let from_world = from_camera.inverse().to_homogeneous();
        let eye = Vector3::from(self.eye());
        self.projection_matrix(aspect) * from_world * Matrix4::new_translation(&-eye)
    }

    /// The transform from the world to a screen of this size, for many points.
    pub fn projector(&self, size: [f32; 2]) -> Projector {
        Projector::new(&self.view_projection(size[0].max(1.0) / size[1].max(1.0)), size)
    }

    /// The position of a world point on a screen of this size; `None` for a point behind the near plane.
    pub fn screen_from_world(&self, world: [f32; 3], size: [f32; 2]) -> Option<ScreenPoint> {
        self.projector(size).screen_from_world(world)
    }

    /// The line of sight through a position on a screen of this size.
    pub fn ray_from_screen(&self, at: [f32; 2], size: [f32; 2]) -> Ray {
        let [right, up, backwards] = self.axes();
        let world_per_px = 2.0 * self.half_height() / size[1].max(1.0);
        let aside = (right * (at[0] - 0.5 * size[0]) - up * (at[1] - 0.5 * size[1])) * world_per_px;
        let eye = Vector3::from(self.eye());
        let (origin, direction) = match self.projection {
            Projection::Perspective => (eye, (aside - backwards * self.distance).normalize()),
            Projection::Orthographic => (eye + aside, -backwards),
        };
        Ray { origin: origin.into(), direction: direction.into() }
    }

    /// The distance from the eye of the plane in front of which everything is cut away, world units; none where nothing is.
    fn cut_distance(&self) -> Option<f32> {
        let backwards = self.rotation() * Vector3::z();
        let to_center = (Vector3::from(self.eye()) - Vector3::from(CENTER)).dot(&backwards);
        let radius = 0.5 * 3f32.sqrt();
        (self.cut > 0.0).then(|| to_center - radius + 2.0 * radius * self.cut.min(1.0))
    }

    /// The projection matrix with depth from 0 to 1, as wgpu needs; nalgebra's matrices have depth from −1 to 1.
    fn projection_matrix(&self, aspect: f32) -> Matrix4<f32> {
        let reach = WORLD_RADIUS + (Vector3::from(self.target) - Vector3::from(CENTER)).norm();
        let aspect = if aspect > 0.0 { aspect } else { 1.0 };
        let mut matrix = Matrix4::zeros();
        match self.projection {
            Projection::Perspective => {
                let nearest = 0.02 * self.distance;
                let near = self.cut_distance().map_or(nearest, |cut| cut.max(nearest));
                let far = self.distance + reach;
                let scale = self.distance / self.half_height();
                matrix[(0, 0)] = scale / aspect;
                matrix[(1, 1)] = scale;
                matrix[(2, 2)] = far / (near - far);
                matrix[(2, 3)] = near * far / (near - far);
                matrix[(3, 2)] = -1.0;
            }
            Projection::Orthographic => {
                let nearest = self.distance - reach;
                let near = self.cut_distance().map_or(nearest, |cut| cut.max(nearest));
                let far = self.distance + reach;
                let scale = 1.0 / self.half_height();
                matrix[(0, 0)] = scale / aspect;
                matrix[(1, 1)] = scale;
                matrix[(2, 2)] = 1.0 / (near - far);
                matrix[(2, 3)] = near / (near - far);
                matrix[(3, 3)] = 1.0;
            }
        }
        matrix
    }

    fn rotation(&self) -> UnitQuaternion<f32> {
        let [i, j, k, w] = self.orientation;
        UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k))
    }

    /// The directions right, up and backwards (to the viewer), in world axes.
    fn axes(&self) -> [Vector3<f32>; 3] {
        let rotation = self.rotation();
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| rotation * axis)
    }

    fn set_axes(&mut self, right: Vector3<f32>, up: Vector3<f32>, backwards: Vector3<f32>) {
        let matrix = Matrix3::from_columns(&[right, up, backwards]);
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix));
        self.orientation = rotation.coords.into();
    }

    /// Heading of the view in the red-green plane (counter-clockwise from red), its slope, and the tilt of the horizon;
    /// radians.
    fn yaw_pitch_roll(&self) -> [f32; 3] {
        let [right, up, backwards] = self.axes();
        let forward = -backwards;
        let horizontal = forward.x.hypot(forward.y);
        let pitch = forward.z.atan2(horizontal);
        if horizontal < POLE {
            // Seen from above, the heading is the direction that is up on the screen; from below, the direction that is down.
            let heading = up * -forward.z.signum();
            return [heading.y.atan2(heading.x), pitch, 0.0];
        }
        let yaw = forward.y.atan2(forward.x);
        let level_right = forward.cross(&BLUE).normalize();
        let level_up = level_right.cross(&forward);
        [yaw, pitch, right.dot(&level_up).atan2(right.dot(&level_right))]
    }

    fn set_yaw_pitch_roll(&mut self, yaw: f32, pitch: f32, roll: f32) {
        let level_right = Vector3::new(yaw.sin(), -yaw.cos(), 0.0);
        let forward = Vector3::new(yaw.cos() * pitch.cos(), yaw.sin() * pitch.cos(), pitch.sin());
        let level_up = level_right.cross(&forward);
        let right = level_right * roll.cos() + level_up * roll.sin();
        self.set_axes(right, right.cross(&forward), -forward);
    }
}

#[cfg(test)]
mod tests;
