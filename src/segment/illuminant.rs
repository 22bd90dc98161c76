//! Section 5.4.1: all highlight lines are parallel to the illuminant, and all dichromatic planes contain it.
//!
//! The paper averages the first eigenvectors of the highlight clusters. Those are biased towards each body vector, as the
//! cluster is a wedge (the body reflection varies under a highlight): 2–15°, and its tables show it (9.0° for the white
//! cups, 13.1° for the pink ones).
//!
//! Refined (`robust_illuminant`): every object says in which plane the illuminant lies (its normal n_k), some also where
//! in that plane (a second normal q_k, see `in_plane`). The illuminant is the unit vector that minimises
//! Σ ρ(n_k·s)²/(var_k + 0.4°²) + Σ ρ(q_k·s)²/(var_k + floor²), Cauchy's ρ, by reweighted smallest eigenvectors.
//! 0.1° is typical, a single sphere stays below 1°; two coplanar objects: 20° → 0.2°.

use super::candidates::HighlightLine;
use crate::color::Vec3;
use nalgebra::Matrix3;

/// Something that the illuminant is perpendicular to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// The region that says so.
    pub region: u16,
    /// Unit vector.
    pub normal: Vec3,
    /// Variance of its angle, degrees².
    pub variance_deg2: f64,
    /// Residual beyond which it is doubted (Cauchy's scale), degrees.
    pub doubt_deg: f64,
}

/// Where the search starts, and how strongly it is held there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Unit direction.
    pub direction: Vec3,
    /// Standard deviation, degrees.
    pub sd_deg: f64,
}

/// The illuminant, and what each constraint said: region, residual in degrees, weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersection {
    /// Unit direction.
    pub direction: Vec3,
    /// Region, residual in degrees, weight of each constraint.
    pub contributions: Vec<(u16, f64, f64)>,
}

/// The paper's estimate: the average direction of all highlight lines; `None` without one.
pub fn average_direction(lines: &[Option<HighlightLine>]) -> Option<Vec3> {
    let sum: Vec3 = lines.iter().flatten().map(|line| line.direction).sum();
    (sum.norm() > 0.0).then(|| sum.normalize())
}

/// The average direction weighted by the pixels of the highlights; `None` without one.
pub fn weighted_direction(lines: &[Option<HighlightLine>]) -> Option<Vec3> {
    let sum: Vec3 = lines.iter().flatten().map(|line| line.direction * line.pixels).sum();
    (sum.norm() > 0.0).then(|| sum.normalize())
}

/// Intersects the constraints, robustly.
pub fn intersect(constraints: &[Constraint], prior: &Prior) -> Intersection {
    let held = Matrix3::identity() - prior.direction * prior.direction.transpose();
    let mut direction = prior.direction;
    // A wide start keeps a far prior from deciding who is doubted.
    for widening in [8.0, 4.0, 2.0].into_iter().chain(std::iter::repeat_n(1.0, 12)) {
        let mut sum = held / prior.sd_deg.powi(2);
        for constraint in constraints {
            let weight = weight(constraint, &direction, widening);
            sum += constraint.normal * constraint.normal.transpose() * weight;
        }
        let (_, axes) = crate::color::principal_axes(&sum);
        let next = axes[2] * if axes[2].sum() < 0.0 { -1.0 } else { 1.0 };
        let turned = next.cross(&direction).norm();
        direction = next;
        if widening <= 1.0 && turned < 1e-7 {
            break;
        }
    }
    let contributions = constraints
        .iter()
        .map(|c| (c.region, residual_deg(c, &direction), weight(c, &direction, 1.0)))
        .collect();
    Intersection { direction, contributions }
}

fn residual_deg(constraint: &Constraint, direction: &Vec3) -> f64 {
    constraint.normal.dot(direction).clamp(-1.0, 1.0).asin().to_degrees()
}

fn weight(constraint: &Constraint, direction: &Vec3, widening: f64) -> f64 {
    let doubt = residual_deg(constraint, direction) / (constraint.doubt_deg * widening);
    1.0 / (constraint.variance_deg2 * (1.0 + doubt * doubt))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::axis_angle_deg;
    use proptest::prelude::*;

    fn plane_of(region: u16, body: Vec3, light: &Vec3) -> Constraint {
        let normal = body.cross(light).normalize();
        Constraint { region, normal, variance_deg2: 0.2, doubt_deg: 1.0 }
    }

    proptest! {
        #[test]
        fn planes_meet_in_the_light_and_a_stranger_is_doubted(
            light in prop::array::uniform3(0.35f64..1.0),
        ) {
            let light = Vec3::from(light).normalize();
            let bodies = [[0.9, 0.2, 0.1], [0.1, 0.9, 0.2], [0.1, 0.2, 0.9], [0.9, 0.7, 0.05]];
            let mut planes: Vec<Constraint> =
                bodies.iter().map(|&b| plane_of(1, Vec3::from(b), &light)).collect();
            let stranger = Vec3::new(0.5, -0.4, 0.1).normalize();
            planes.push(Constraint { region: 9, normal: stranger, variance_deg2: 0.2, doubt_deg: 1.0 });
            let prior = Prior { direction: Vec3::repeat(1.0).normalize(), sd_deg: 30.0 };
            let found = intersect(&planes, &prior);
            prop_assert!(axis_angle_deg(&found.direction, &light) < 0.5);
        }
    }

    #[test]
    fn without_evidence_the_prior_stays() {
        let prior = Prior { direction: Vec3::new(0.6, 0.6, 0.529).normalize(), sd_deg: 8.0 };
        assert!(axis_angle_deg(&intersect(&[], &prior).direction, &prior.direction) < 1e-6);
    }
}
