//! Section 3: the color cluster of a sphere in its dichromatic plane, point by point. The body reflection is Lambertian, as in equations
//! (6) and (9); the surface reflection is a lobe around the normal that bisects the directions to light and camera.
//!
//! # Deviation
//! Section 3 derives where the highlight line starts and not its shape: the lobe is a normal distribution of the angle between normal
//! and bisector, of which the standard deviation is the roughness. A smooth sphere has a thin, steep highlight line; with roughness the
//! line widens and leans, because the body reflection changes under a wide highlight.

use super::photometry::SphereGeometry;

/// A point of the sphere that is lit and seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpherePoint {
    /// m_b, Lambertian body reflection, 0…1.
    pub body: f32,
    /// m_s, surface reflection as a share of the lobe's peak, 0…1.
    pub surface: f32,
    /// The place in the camera's picture by parallel projection, units of the sphere's radius: to the light's side, and out of the plane of
    /// light, camera and center.
    pub at: [f32; 2],
}

/// The lit and seen points of a sphere, on a grid of `side` × `side` points over the camera's picture of the sphere, row by row.
/// `roughness_deg`: the standard deviation of the lobe, degrees.
pub fn sphere_points(geometry: SphereGeometry, roughness_deg: f64, side: usize) -> Vec<SpherePoint> {
    let step = 2.0 / side.max(2) as f64;
    let place = |index: usize| (index as f64 + 0.5) * step - 1.0;
    let mut points = Vec::new();
    for row in 0..side {
        points.extend((0..side).filter_map(|column| {
            let at = [place(column), place(row)];
            let (body, surface) = geometry.amounts_at(at, roughness_deg)?;
            Some(SpherePoint { body: body as f32, surface: surface as f32, at: at.map(|v| v as f32) })
        }));
    }
    points
}

impl SphereGeometry {
    /// Body reflection, and surface reflection as a share of the lobe's peak, at a place of the camera's picture; none where the place is
    /// beside the sphere, not lit or not seen.
    fn amounts_at(self, [x, y]: [f64; 2], roughness_deg: f64) -> Option<(f64, f64)> {
        let toward = (1.0 - x * x - y * y).max(0.0).sqrt();
        if x * x + y * y >= 1.0 {
            return None;
        }
        // The bisector of light and camera is the third axis; the distance of both is 1.
        let (sine, cosine) = (self.phase_deg().to_radians() / 2.0).sin_cos();
        let (light, camera) = ([sine, 0.0, cosine], [-sine, 0.0, cosine]);
        let normal = [x * cosine - toward * sine, y, x * sine + toward * cosine];
        let radius = self.radius_over_distance();
        // A point is lit, or seen, where light or camera lies above the tangent plane of the point.
        if dot(normal, light) <= radius || dot(normal, camera) <= radius {
            return None;
        }
        let from_point =
            |place: [f64; 3]| unit(std::array::from_fn(|axis| place[axis] - radius * normal[axis]));
        let (to_light, to_camera) = (from_point(light), from_point(camera));
        let bisector = unit(std::array::from_fn(|axis| to_light[axis] + to_camera[axis]));
        let off_deg = dot(normal, bisector).clamp(-1.0, 1.0).acos().to_degrees();
        let surface = (-0.5 * (off_deg / roughness_deg.max(0.1)).powi(2)).exp();
        Some((dot(normal, to_light), surface))
    }
}

/// The phase angle at which the highlight of a sphere starts at the share `q` of the matte line, degrees: the smallest one. None where no
/// phase angle has this share.
pub fn phase_of_q(radius: f64, distance: f64, q: f64) -> Option<f64> {
    const STEPS: u32 = 2000;
    let most = SphereGeometry::new(radius, distance, 0.0)?.max_phase_deg();
    let phases = (0..STEPS).map(|step| most * f64::from(step) / f64::from(STEPS));
    if q > 1.0 {
        return None;
    }
    phases.into_iter().find(|&phase| {
        SphereGeometry::new(radius, distance, phase)
            .and_then(SphereGeometry::q)
            .is_some_and(|found| found <= q)
    })
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A vector of length 1; of a vector without length, that vector.
fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|axis| axis / length) } else { v }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The brightest point, and the point with most surface reflection.
    fn extremes(geometry: SphereGeometry) -> (SpherePoint, SpherePoint) {
        let points = sphere_points(geometry, 4.0, 401);
        let most =
            |of: fn(&SpherePoint) -> f32| *points.iter().max_by(|a, b| of(a).total_cmp(&of(b))).unwrap();
        (most(|point| point.body), most(|point| point.surface))
    }

    #[test]
    fn the_cluster_has_the_amounts_of_equations_6_and_9() {
        for (distance, phase_deg) in
            [(2.0, 0.0), (2.0, 80.0), (5.0, 45.0), (5.0, 120.0), (f64::INFINITY, 90.0)]
        {
            let geometry = SphereGeometry::new(1.0, distance, phase_deg).unwrap();
            let (brightest, highlight) = extremes(geometry);
            let near = |found: f32, expected: f64| (f64::from(found) - expected).abs() < 0.02;
            assert!(near(brightest.body, geometry.brightest_body()), "{distance} {phase_deg} {brightest:?}");
            assert!(near(highlight.body, geometry.highlight_body()), "{distance} {phase_deg} {highlight:?}");
            assert!(highlight.surface > 0.99);
        }
    }

    #[test]
    fn the_skewed_t_turns_into_a_dog_leg_as_light_and_camera_meet() {
        let share = |phase_deg: f64| {
            let geometry = SphereGeometry::new(1.0, 5.0, phase_deg).unwrap();
            let (brightest, highlight) = extremes(geometry);
            highlight.body / brightest.body
        };
        assert!(share(0.0) > 0.99, "the highlight lies at the end of the matte line");
        assert!(share(120.0) < 0.6, "the highlight leaves the matte line in the middle");
    }

    #[test]
    fn the_phase_angle_of_a_share_has_that_share() {
        for q in [0.95, 0.8, 0.6, 0.51] {
            let phase = phase_of_q(1.0, 5.0, q).unwrap();
            let found = SphereGeometry::new(1.0, 5.0, phase).unwrap().q().unwrap();
            assert!((found - q).abs() < 2e-3, "{q} {found}");
        }
        assert_eq!((phase_of_q(1.0, 5.0, 0.45), phase_of_q(1.0, 5.0, 1.2)), (None, None));
        assert_eq!(phase_of_q(1.0, 5.0, 1.0), Some(0.0));
    }

    #[test]
    fn a_sphere_beyond_every_light_and_an_empty_grid_give_no_points() {
        let geometry = SphereGeometry::new(1.0, 5.0, 0.0).unwrap();
        let dark = SphereGeometry::new(1.0, 5.0, geometry.max_phase_deg()).unwrap();
        assert!(sphere_points(dark, 5.0, 41).is_empty());
        assert!(sphere_points(geometry, 5.0, 0).is_empty());
    }
}
