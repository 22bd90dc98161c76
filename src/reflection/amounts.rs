//! Section 6, equation 13: the amounts of body reflection, surface reflection and noise in a color of a region.
//!
//! The split of a picture and the history of a pixel both take the amounts from [`AmountRule`].

use super::{Components, MIN_ANGLE_DEG, ReflectionTransform};
use crate::color::{Vec3, axis_angle_deg, dot, rgb};

/// How the undistorted colors of one region are divided into amounts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmountRule {
    /// Body reflection vector C_b, unit.
    body: [f32; 3],
    /// None where body and surface vector cannot be told apart: then every amount is body reflection.
    transform: Option<ReflectionTransform>,
    /// Surface reflection less than this distance off the body line is taken for none, counts; negative infinity: never.
    least_offset: f32,
}

/// The amounts of one color.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amounts {
    /// The amounts m_b, m_s and ε, counts.
    pub components: Components,
    /// Distance off the body line of surface reflection that was taken for none, counts; none where nothing was.
    pub removed_offset: Option<f32>,
}

impl AmountRule {
    /// The rule of a region with the unit vectors `body` and `surface`. Where `surface` is none, or less than
    /// [`MIN_ANGLE_DEG`] from `body`, every amount is body reflection. `least_offset`: surface reflection less than this
    /// distance off the body line is taken for none, counts; negative infinity: never.
    pub fn new(body: &Vec3, surface: Option<&Vec3>, least_offset: f32) -> Self {
        let transform = surface
            .filter(|surface| axis_angle_deg(body, surface) >= MIN_ANGLE_DEG)
            .and_then(|surface| ReflectionTransform::new(body, surface));
        Self { body: rgb(body), transform, least_offset }
    }

    /// The amounts of an undistorted color, counts above the ambient light.
    #[inline]
    pub fn amounts(&self, color: [f32; 3]) -> Amounts {
        let only_body = Components { body: dot(color, self.body), surface: 0.0, noise: 0.0 };
        let Some(transform) = &self.transform else {
            return Amounts { components: only_body, removed_offset: None };
        };
        let components = transform.split(color);
        let offset = components.surface * transform.sine();
        if offset < self.least_offset {
            let components = Components { noise: components.noise, ..only_body };
            return Amounts { components, removed_offset: Some(offset) };
        }
        Amounts { components, removed_offset: None }
    }

    /// The colors of body reflection and of surface reflection with these amounts, counts above the ambient light.
    #[inline]
    pub fn colors(&self, components: Components) -> [[f32; 3]; 2] {
        let surface = self.transform.map_or([0.0; 3], |transform| transform.surface());
        [self.body.map(|band| band * components.body), surface.map(|band| band * components.surface)]
    }

    /// The transform of equation 13; none where every amount is body reflection.
    pub fn transform(&self) -> Option<&ReflectionTransform> {
        self.transform.as_ref()
    }

    /// Surface reflection less than this distance off the body line is taken for none, counts.
    pub fn least_offset(&self) -> f32 {
        self.least_offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn little_surface_reflection_is_none_and_its_offset_is_kept() {
        let (body, surface) = (Vec3::new(0.9, 0.3, 0.2).normalize(), Vec3::repeat(1.0).normalize());
        let transform = ReflectionTransform::new(&body, &surface).unwrap();
        let rule = AmountRule::new(&body, Some(&surface), 2.5);
        let color = |surface| transform.join(Components { body: 100.0, surface, noise: 1.0 });
        let strong = rule.amounts(color(50.0));
        assert!((strong.components.surface - 50.0).abs() < 1e-3 && strong.removed_offset.is_none());
        let faint = rule.amounts(color(2.0));
        assert!(faint.components.surface == 0.0 && faint.removed_offset.unwrap() < 2.5, "{faint:?}");
        assert!((faint.components.noise - 1.0).abs() < 1e-4);
        assert!((faint.components.body - dot(color(2.0), rgb(&body))).abs() < 1e-4);
    }

    #[test]
    fn without_a_plane_every_amount_is_body_reflection() {
        let body = Vec3::repeat(1.0).normalize();
        for surface in [None, Some(&body)] {
            let rule = AmountRule::new(&body, surface, f32::NEG_INFINITY);
            let Amounts { components, removed_offset } = rule.amounts([10.0; 3]);
            assert!(rule.transform().is_none() && removed_offset.is_none());
            assert_eq!((components.surface, components.noise), (0.0, 0.0));
            let [body, surface] = rule.colors(components);
            assert!((body[0] - 10.0).abs() < 1e-4 && surface[0].abs() < 1e-9);
        }
    }
}
