//! Section 6, equation 13 and figure 12: the coordinate system of body vector, surface vector and their normal.
//!
//! Every color is m̃_b·C_b + m̃_s·C_s + ε·n with unit vectors C_b and C_s. n is C_b × C_s divided by its length, so that ε is
//! in counts.

use crate::color::{Vec3, dot, rgb};
use nalgebra::Matrix3;

/// Transforms colors into amounts of body reflection, surface reflection and noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReflectionTransform {
    body: [f32; 3],
    surface: [f32; 3],
    normal: [f32; 3],
    rows: [[f32; 3]; 3],
    sine: f32,
}

/// A color's components, counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Components {
    /// m̃_b: amount of body reflection.
    pub body: f32,
    /// m̃_s: amount of surface reflection.
    pub surface: f32,
    /// ε: signed distance from the dichromatic plane.
    pub noise: f32,
}

impl ReflectionTransform {
    /// T for unit vectors `body` and `surface`; `None` when they are collinear to 1e-6.
    pub fn new(body: &Vec3, surface: &Vec3) -> Option<Self> {
        let across = body.cross(surface);
        let sine = across.norm();
        if sine < 1e-6 {
            return None;
        }
        let normal = across / sine;
        let inverse = Matrix3::from_columns(&[*body, *surface, normal]).try_inverse()?;
        let row = |i: usize| [inverse[(i, 0)] as f32, inverse[(i, 1)] as f32, inverse[(i, 2)] as f32];
        Some(Self {
            body: rgb(body),
            surface: rgb(surface),
            normal: rgb(&normal),
            rows: [row(0), row(1), row(2)],
            sine: sine as f32,
        })
    }

    /// The components of a color (T applied).
    #[inline]
    pub fn split(&self, color: [f32; 3]) -> Components {
        Components {
            body: dot(self.rows[0], color),
            surface: dot(self.rows[1], color),
            noise: dot(self.rows[2], color),
        }
    }

    /// How far a color is from those that the transform explains, counts: the larger of the distance from the plane and of the distance beyond
    /// the matte or the highlight line, where an amount of reflection would be negative.
    #[inline]
    pub fn misfit_counts(&self, color: [f32; 3]) -> f32 {
        let amounts = self.split(color);
        amounts.noise.abs().max(-amounts.body.min(amounts.surface) * self.sine)
    }

    /// The color of components (T⁻¹ applied).
    #[inline]
    pub fn join(&self, components: Components) -> [f32; 3] {
        std::array::from_fn(|band| {
            components.body * self.body[band]
                + components.surface * self.surface[band]
                + components.noise * self.normal[band]
        })
    }

    /// The rows of T whose scalar products with a color are the amounts of body and surface reflection.
    pub fn amount_rows(&self) -> [[f32; 3]; 2] {
        [self.rows[0], self.rows[1]]
    }

    /// C_b, unit.
    pub fn body(&self) -> [f32; 3] {
        self.body
    }

    /// C_s, unit.
    pub fn surface(&self) -> [f32; 3] {
        self.surface
    }

    /// Unit normal of the dichromatic plane, along C_b × C_s.
    pub fn normal(&self) -> [f32; 3] {
        self.normal
    }

    /// Sine of the angle θ between both vectors: surface reflection of amount m̃_s lies m̃_s·sinθ off the body line.
    pub fn sine(&self) -> f32 {
        self.sine
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_transform_and_its_inverse_are_one(
            b in prop::array::uniform3(0.05f64..1.0),
            s in prop::array::uniform3(0.2f64..1.0),
            color in prop::array::uniform3(0f32..255.0),
            amounts in (0f32..250.0, 0f32..250.0, -8f32..8.0),
        ) {
            let (b, s) = (Vec3::from(b).normalize(), Vec3::from(s).normalize());
            prop_assume!(b.cross(&s).norm() > 0.1);
            let transform = ReflectionTransform::new(&b, &s).unwrap();
            for (back, band) in transform.join(transform.split(color)).into_iter().zip(color) {
                prop_assert!((back - band).abs() < 5e-3);
            }
            let made = Components { body: amounts.0, surface: amounts.1, noise: amounts.2 };
            let found = transform.split(transform.join(made));
            prop_assert!((found.body - made.body).abs() < 5e-3);
            prop_assert!((found.surface - made.surface).abs() < 5e-3);
            prop_assert!((found.noise - made.noise).abs() < 5e-3);
        }
    }

    #[test]
    fn the_misfit_is_the_distance_from_the_plane_or_beyond_a_line() {
        let (b, s) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.6, 0.8, 0.0));
        let transform = ReflectionTransform::new(&b, &s).unwrap();
        let misfit = |body, surface, noise| {
            transform.misfit_counts(transform.join(Components { body, surface, noise }))
        };
        let is = |found: f32, expected: f32| (found - expected).abs() < 1e-4;
        assert!(is(misfit(50.0, 20.0, 0.0), 0.0), "between the lines");
        assert!(is(misfit(50.0, 20.0, -3.0), 3.0), "off the plane");
        assert!(is(misfit(50.0, -5.0, 1.0), 4.0), "5 counts of negative surface reflection, at the sine .8");
        assert!(is(misfit(-10.0, 20.0, 1.0), 8.0), "10 counts of negative body reflection");
    }

    #[test]
    fn collinear_vectors_have_no_transform() {
        let v = Vec3::repeat(1.0).normalize();
        assert!(ReflectionTransform::new(&v, &v).is_none());
    }
}
