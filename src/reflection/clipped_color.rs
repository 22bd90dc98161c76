//! Whether a color with clipped bands can be body and surface reflection of given directions (section 5.5, refinement `clipped_bands`).
//!
//! A clipped band tells that the light in it was at least the clip threshold; the other bands tell their values. The color can
//! be m_b·C_b + m_s·C_s with m_b, m_s ≥ 0 where the distance d is small: d² is the least sum of the squared differences of the known bands, and
//! of what the clipped bands lack of the threshold.

use crate::color::{Vec3, dot, length, rgb};

/// Largest distance of a color that can be body and surface reflection, as a share of the length of the color: bloom, inter-reflection,
/// coding and noise. A color with a clipped band is longer than the clip threshold.
const MOST_DISTANCE: f32 = 0.125;

/// The directions of body and surface reflection with which colors with clipped bands are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClippedColorTest {
    /// Color without any reflection, counts.
    origin: [f32; 3],
    body: [f32; 3],
    surface: [f32; 3],
    /// Value from which on a band is clipped, counts.
    clip_threshold: f32,
}

impl ClippedColorTest {
    /// The test for unit vectors of body and surface reflection. `origin`: color without any reflection, counts; `clip_threshold`: counts.
    pub fn new(origin: &Vec3, body: &Vec3, surface: &Vec3, clip_threshold: f32) -> Self {
        Self { origin: rgb(origin), body: rgb(body), surface: rgb(surface), clip_threshold }
    }

    /// The distance of a color with a clipped band and the limit that the distance exceeds, counts; `None` where the color can be body and
    /// surface reflection, or has no clipped band.
    pub fn refusal(&self, color: [f32; 3]) -> Option<[f32; 2]> {
        if color.iter().all(|band| *band < self.clip_threshold) {
            return None;
        }
        let (distance, limit) = (self.distance(color), MOST_DISTANCE * length(color));
        (distance > limit).then_some([distance, limit])
    }

    /// d: how far the color is from the nearest color that body and surface reflection can have, counts.
    pub fn distance(&self, color: [f32; 3]) -> f32 {
        let is_clipped = color.map(|band| band >= self.clip_threshold);
        let wanted: [f32; 3] =
            std::array::from_fn(|band| color[band].min(self.clip_threshold) - self.origin[band]);
        // At the least sum, each clipped band either lacks light and counts like a known one, or does not count.
        let clipped_bands = (0..3).map(|band| u8::from(is_clipped[band]) << band).sum::<u8>();
        let sets = (0u8..8)
            .filter(|set| set & !clipped_bands == 0)
            .map(|set| std::array::from_fn(|band| !is_clipped[band] || set & (1 << band) != 0));
        let squares = sets.map(|counted: [bool; 3]| {
            let only =
                |vector: [f32; 3]| std::array::from_fn(|band| if counted[band] { vector[band] } else { 0.0 });
            let [body, surface] = amounts(only(wanted), only(self.body), only(self.surface));
            let differences: [f32; 3] = std::array::from_fn(|band| {
                let difference = wanted[band] - body * self.body[band] - surface * self.surface[band];
                if is_clipped[band] { difference.max(0.0) } else { difference }
            });
            dot(differences, differences)
        });
        squares.fold(f32::INFINITY, f32::min).sqrt()
    }
}

/// The amounts of body and surface reflection, not negative, whose sum is nearest to a color. Computed in double precision: where two bands are
/// counted, body and surface are often nearly parallel in these.
fn amounts(color: [f32; 3], body: [f32; 3], surface: [f32; 3]) -> [f32; 2] {
    let dot =
        |a: [f32; 3], b: [f32; 3]| (0..3).map(|band| f64::from(a[band]) * f64::from(b[band])).sum::<f64>();
    let (bb, bs, ss) = (dot(body, body), dot(body, surface), dot(surface, surface));
    let (bc, sc) = (dot(body, color), dot(surface, color));
    let determinant = bb * ss - bs * bs;
    if determinant > 1e-6 * bb * ss {
        let both = [(ss * bc - bs * sc) / determinant, (bb * sc - bs * bc) / determinant];
        if both.iter().all(|amount| *amount >= 0.0) {
            return both.map(|amount| amount as f32);
        }
    }
    let alone = |product: f64, square: f64| if square > 0.0 { (product / square).max(0.0) } else { 0.0 };
    let (body_alone, surface_alone) = (alone(bc, bb), alone(sc, ss));
    // What each alone explains of the squared length of the color.
    if body_alone * bc >= surface_alone * sc { [body_alone as f32, 0.0] } else { [0.0, surface_alone as f32] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CLIP: f32 = 240.0;

    fn test(body: [f64; 3]) -> ClippedColorTest {
        let surface = Vec3::new(0.6, 0.58, 0.55).normalize();
        ClippedColorTest::new(&Vec3::zeros(), &Vec3::from(body).normalize(), &surface, CLIP)
    }

    proptest! {
        #[test]
        fn a_color_of_the_model_is_near_however_many_bands_clip(
            body in prop::array::uniform3(0.05f64..1.0), m_b in 20.0f32..500.0, m_s in 0.0f32..500.0,
        ) {
            let test = test(body);
            let color = std::array::from_fn(|band| (m_b * test.body[band] + m_s * test.surface[band]).min(255.0));
            prop_assert!(test.distance(color) < 0.5, "{color:?}: {}", test.distance(color));
        }

        #[test]
        fn the_distance_of_an_unclipped_color_is_that_from_the_plane_where_both_amounts_are_positive(
            body in prop::array::uniform3(0.05f64..1.0), m_b in 30.0f32..100.0, m_s in 30.0f32..100.0, off in -8.0f32..8.0,
        ) {
            let test = test(body);
            let normal = rgb(&Vec3::new(test.body[0] as f64, test.body[1] as f64, test.body[2] as f64)
                .cross(&Vec3::new(test.surface[0] as f64, test.surface[1] as f64, test.surface[2] as f64)));
            let length = dot(normal, normal).sqrt();
            prop_assume!(length > 0.3);
            let color = std::array::from_fn(|band| {
                m_b * test.body[band] + m_s * test.surface[band] + off * normal[band] / length
            });
            prop_assume!(color.iter().all(|band: &f32| *band < CLIP));
            prop_assert!((test.distance(color) - off.abs()).abs() < 0.02);
        }
    }

    #[test]
    fn a_color_of_a_body_nearly_parallel_to_the_light_in_two_bands_is_near() {
        let test = test([0.409_631_702_424_868_6, 0.758_595_829_249_715_4, 0.380_644_890_391_111_8]);
        let color = test.body.map(|band| (386.759_86 * band).min(255.0));
        assert!(test.distance(color) < 0.01, "{}", test.distance(color));
    }

    #[test]
    fn a_green_that_clips_is_far_from_an_orange_object_and_a_clipped_white_is_near_to_any() {
        let orange = test([0.85, 0.4, 0.3]);
        assert!(orange.distance([30.0, 255.0, 60.0]) > 100.0);
        assert!(orange.distance([255.0, 200.0, 150.0]) < 3.0, "a highlight of the object");
        assert!(orange.distance([255.0; 3]) < 1e-3);
        assert!(orange.refusal([30.0, 255.0, 60.0]).is_some_and(|[distance, limit]| distance > limit));
        assert_eq!(orange.refusal([30.0, 200.0, 60.0]), None, "nothing clips");
        assert_eq!(orange.refusal([255.0, 200.0, 150.0]), None);
    }
}
