//! The camera that circles the color cube.
//!
//! World units are counts / 255: black is the origin, white (1, 1, 1); x is red, y green, z blue. The camera looks at a
//! target from a distance; its orientation is free, so that it can face any plane, and dragging brings blue back up.

use super::projector::{Projector, Ray, ScreenPoint};
use nalgebra::{Matrix3, Matrix4, Quaternion, Rotation3, UnitQuaternion, Vector3, Vector4};
use serde::{Deserialize, Serialize};

/// Height of the perspective's field of view. Narrow: parallel lines of the cube should look parallel.
pub const FIELD_OF_VIEW_DEG: f32 = 30.0;
/// How far a drag of one logical pixel turns the camera.
pub const TURN_DEG_PER_PX: f32 = 0.4;
/// Nearest and farthest that zooming goes, world units.
pub const DISTANCE_RANGE: [f32; 2] = [0.01, 200.0];

/// While the camera is turned this far, roll falls to 1/e: blue is up again after a short drag, without a jump.
const LEVELING_DEG: f32 = 30.0;
/// Horizontal part of the viewing direction below which it counts as vertical.
const POLE: f32 = 1e-3;
/// Pictures with head room have colors well outside the unit cube: what lies within this distance is drawn.
const WORLD_RADIUS: f32 = 32.0;
const CENTER: [f32; 3] = [0.5; 3];
/// Space around a framed sphere, as a factor of its radius.
const MARGIN: f32 = 1.06;
const BLUE: Vector3<f32> = Vector3::new(0.0, 0.0, 1.0);

/// How depth shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// Farther is smaller.
    #[default]
    Perspective,
    /// Parallel lines stay parallel, and equal lengths equal.
    Orthographic,
}

/// Views that have a name.
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
    /// All of them, in the order of a menu.
    pub const ALL: [Self; 5] = [Self::Home, Self::Red, Self::Green, Self::Blue, Self::Gray];

    /// Direction of view and what is up in it.
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

/// A camera on a sphere around a target. Plain data: copy it, compare it, store it.
///
/// Screen positions and sizes are in one unit, logical or physical pixels as the caller likes, from the top left corner
/// with y downwards.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Orbit {
    /// What it looks at and turns around, world units.
    pub target: [f32; 3],
    /// Unit quaternion (i, j, k, real part) from camera axes (right, up, backwards) to world axes.
    pub orientation: [f32; 4],
    /// From the eye to the target, world units; it also sets the scale of the orthographic projection.
    pub distance: f32,
    /// How depth shows. Switching keeps the size of things at the target.
    pub projection: Projection,
}

impl Default for Orbit {
    /// The home view of the whole cube in a square window.
    fn default() -> Self {
        let mut camera = Self {
            target: CENTER,
            orientation: [0.0, 0.0, 0.0, 1.0],
            distance: 1.0,
            projection: Projection::Perspective,
        };
        camera.preset(Preset::Home);
        camera.fit(1.0);
        camera
    }
}

impl Orbit {
    /// This camera, or the default one where its numbers cannot be used: a settings file may hold anything.
    #[must_use]
    pub fn checked(self) -> Self {
        let numbers = self.target.iter().chain(&self.orientation).chain([&self.distance]);
        let finite = numbers.clone().all(|number| number.is_finite() && number.abs() < 1e6);
        let unit = (Vector4::from(self.orientation).norm() - 1.0).abs() < 1e-2;
        let in_range = (DISTANCE_RANGE[0]..=DISTANCE_RANGE[1]).contains(&self.distance);
        if finite && unit && in_range { self } else { Self::default() }
    }

    /// Turns the camera around its target as the hand drags the scene by `delta` logical pixels (turntable: blue stays
    /// up; where a face-on view has tilted it, it returns smoothly).
    pub fn orbit(&mut self, delta: [f32; 2]) {
        let [yaw, pitch, roll] = self.yaw_pitch_roll();
        let turned_deg = TURN_DEG_PER_PX * delta[0].hypot(delta[1]);
        let step = (TURN_DEG_PER_PX).to_radians();
        let right_angle = std::f32::consts::FRAC_PI_2;
        let pitch = (pitch - delta[1] * step).clamp(-right_angle, right_angle);
        self.set_yaw_pitch_roll(yaw - delta[0] * step, pitch, roll * (-turned_deg / LEVELING_DEG).exp());
    }

    /// Moves the scene by `delta` on a screen of `height`: what lies at the target's depth follows the hand.
    pub fn pan(&mut self, delta: [f32; 2], height: f32) {
        if height > 0.0 {
            let world_per_px = 2.0 * self.half_height() / height;
            let [right, up, _] = self.axes();
            let moved = (right * -delta[0] + up * delta[1]) * world_per_px;
            self.target = (Vector3::from(self.target) + moved).into();
        }
    }

    /// Enlarges by `factor` (> 1 is nearer) so that the world point under the cursor, at the target's depth, stays there.
    pub fn zoom_at(&mut self, factor: f32, cursor: [f32; 2], size: [f32; 2]) {
        if size[1] > 0.0 {
            let world_per_px = 2.0 * self.half_height() / size[1];
            let [right, up, _] = self.axes();
            let offset = right * (cursor[0] - 0.5 * size[0]) - up * (cursor[1] - 0.5 * size[1]);
            self.zoom_about(factor, (Vector3::from(self.target) + offset * world_per_px).into());
        }
    }

    /// Enlarges by `factor` so that the world point `fixed`, at any depth, stays where it is on the screen.
    pub fn zoom_about(&mut self, factor: f32, fixed: [f32; 3]) {
        if factor > 0.0 && factor.is_finite() {
            let distance = (self.distance / factor).clamp(DISTANCE_RANGE[0], DISTANCE_RANGE[1]);
            let fixed = Vector3::from(fixed);
            let target = fixed + (Vector3::from(self.target) - fixed) * (distance / self.distance);
            (self.target, self.distance) = (target.into(), distance);
        }
    }

    /// Looks along `direction` with `up` upwards on the screen; the target and the distance stay.
    ///
    /// `up` need not be perpendicular; where it says nothing (parallel to `direction`), blue or green is up. A direction
    /// without length changes nothing.
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

    /// Looks along a named direction; the target and the distance stay.
    pub fn preset(&mut self, preset: Preset) {
        let [direction, up] = preset.direction_and_up();
        self.look_along(direction, up);
    }

    /// Faces the plane with this normal: the normal points at the viewer, `up` is up.
    pub fn face(&mut self, normal: [f32; 3], up: [f32; 3]) {
        self.look_along(normal.map(|n| -n), up);
    }

    /// Sees the plane with this normal edge-on, as the upright line in which `up` lies; the normal points right.
    pub fn edge_on(&mut self, normal: [f32; 3], up: [f32; 3]) {
        let direction = Vector3::from(up).cross(&Vector3::from(normal));
        self.look_along(direction.into(), up);
    }

    /// Moves the unit cube into the middle, as large as it goes on a screen of this aspect (width / height).
    pub fn fit(&mut self, aspect: f32) {
        self.frame(CENTER, 0.75_f32.sqrt(), aspect);
    }

    /// Moves a sphere into the middle, as large as it goes on a screen of this aspect (width / height).
    pub fn frame(&mut self, center: [f32; 3], radius: f32, aspect: f32) {
        // The sphere's silhouette in perspective is a little larger than its great circle: hence the sine.
        let half_angle = (0.5 * FIELD_OF_VIEW_DEG).to_radians();
        let narrow = (half_angle.tan() * aspect.clamp(1e-3, 1.0)).atan();
        let distance = radius.max(0.0) * MARGIN / narrow.sin();
        self.target = center;
        self.distance = distance.clamp(DISTANCE_RANGE[0], DISTANCE_RANGE[1]);
    }

    /// Where the camera is, world units (in the orthographic projection: the middle of what it sees from).
    pub fn eye(&self) -> [f32; 3] {
        let [_, _, backwards] = self.axes();
        (Vector3::from(self.target) + backwards * self.distance).into()
    }

    /// Unit vectors to the right, up and into the screen, in world axes.
    pub fn right_up_forward(&self) -> [[f32; 3]; 3] {
        let [right, up, backwards] = self.axes();
        [right.into(), up.into(), (-backwards).into()]
    }

    /// Half of what is seen at the target's depth from bottom to top, world units.
    pub fn half_height(&self) -> f32 {
        self.distance * (0.5 * FIELD_OF_VIEW_DEG).to_radians().tan()
    }

    /// From world coordinates to wgpu's clip space: x right, y up, depth 0 (near) to 1.
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

    /// Where a world point is on a screen of this size; `None` when it is behind the near plane.
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

    /// nalgebra's own matrices map depth to −1…1, wgpu wants 0…1.
    fn projection_matrix(&self, aspect: f32) -> Matrix4<f32> {
        let reach = WORLD_RADIUS + (Vector3::from(self.target) - Vector3::from(CENTER)).norm();
        let aspect = if aspect > 0.0 { aspect } else { 1.0 };
        let mut matrix = Matrix4::zeros();
        match self.projection {
            Projection::Perspective => {
                let (near, far) = (0.02 * self.distance, self.distance + reach);
                let scale = self.distance / self.half_height();
                matrix[(0, 0)] = scale / aspect;
                matrix[(1, 1)] = scale;
                matrix[(2, 2)] = far / (near - far);
                matrix[(2, 3)] = near * far / (near - far);
                matrix[(3, 2)] = -1.0;
            }
            Projection::Orthographic => {
                let (near, far) = (self.distance - reach, self.distance + reach);
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

    /// Right, up and backwards (towards the viewer) in world axes.
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
            // Seen from above, the heading is what is up on the screen; from below, what is down.
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
