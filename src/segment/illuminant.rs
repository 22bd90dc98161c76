//! Section 5.4.1: all highlight lines are parallel to the illuminant, and all dichromatic planes contain it.
//!
//! The paper averages the first eigenvectors of the highlight clusters. Those are biased towards each body vector, as the
//! cluster is a wedge (the body reflection varies under a highlight): 2–15°, and its tables show it (9.0° for the white
//! cups, 13.1° for the pink ones).
//!
//! Refined (`robust_illuminant`): every object says in which plane the illuminant lies (its normal n_k), some also where
//! in that plane (a second normal q_k, see `in_plane`). The illuminant is the unit vector that minimizes
//! Σ ρ(n_k·s)²/(var_k + 0.4°²) + Σ ρ(q_k·s)²/(var_k + floor²), Cauchy's ρ, by reweighted smallest eigenvectors.
//! 0.1° is typical, a single sphere stays below 1°; two coplanar objects: 20° → 0.2°.
//!
//! Printed patterns and metals put forward planes that hold no light. The minimum is therefore sought from several starts:
//! the highlight lines' direction, white, and where any two planes meet. A start is judged by how many constraints it
//! satisfies, each counting at most once, and by how usual such a light is: lamps and skies lie within about 14° of white
//! between yellow and blue, and within 6° between green and magenta.

use super::candidates::HighlightLine;
use crate::color::{Vec3, axis_angle_deg};
use crate::raster::HypothesisId;
use crate::trace::Contribution;
use nalgebra::Matrix3;

/// Something that the illuminant is perpendicular to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// The hypothesis that says so.
    pub hypothesis: HypothesisId,
    /// Unit vector.
    pub normal: Vec3,
    /// Variance of its angle, degrees².
    pub variance_deg2: f64,
    /// Residual beyond which it is doubted (Cauchy's scale), degrees.
    pub doubt_deg: f64,
    /// How well the region's pixels bear it out, in 0…1.
    pub reliability: f64,
}

/// Where the search starts, and how strongly it is held there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Unit direction.
    pub direction: Vec3,
    /// Standard deviation, degrees.
    pub sd_deg: f64,
}

/// The illuminant, and what each constraint said.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersection {
    /// Unit direction.
    pub direction: Vec3,
    /// Within so many degrees of it the light lies, by what the constraints allow and how well they agree (two standard
    /// deviations in the direction that is known worst).
    pub interval_deg: f64,
    /// What each constraint said, in their order.
    pub contributions: Vec<Contribution>,
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
    let white = Vec3::repeat(1.0).normalize();
    let mut strongest: Vec<&Constraint> = constraints.iter().collect();
    strongest.sort_by(|a, b| (b.reliability / b.variance_deg2).total_cmp(&(a.reliability / a.variance_deg2)));
    strongest.truncate(MAX_PAIRED);
    let pairs = strongest.iter().enumerate().flat_map(|(i, a)| {
        strongest[i + 1..].iter().filter_map(|b| a.normal.cross(&b.normal).try_normalize(0.1))
    });
    let into_cube = |direction: Vec3| direction * if direction.sum() < 0.0 { -1.0 } else { 1.0 };
    let starts = [prior.direction, white].into_iter().chain(pairs.map(into_cube));
    let direction = starts
        .filter(|start| start.min() > LEAST_BAND)
        .map(|start| settle(constraints, prior, start))
        .max_by(|a, b| merit(constraints, prior, a).total_cmp(&merit(constraints, prior, b)))
        .unwrap_or(prior.direction);
    let said = |c: &Constraint| Contribution {
        hypothesis: c.hypothesis,
        residual_deg: residual_deg(c, &direction),
        weight: weight(c, &direction),
    };
    let contributions = constraints.iter().map(said).collect();
    Intersection { direction, interval_deg: interval_deg(constraints, prior, &direction), contributions }
}

/// Two standard deviations of the direction where it is known worst, degrees.
fn interval_deg(constraints: &[Constraint], prior: &Prior, direction: &Vec3) -> f64 {
    let mut information = Matrix3::identity() / prior.sd_deg.powi(2);
    let (mut misfit, mut count) = (0.0, 0.0);
    for constraint in constraints {
        let weight = weight(constraint, direction);
        information += constraint.normal * constraint.normal.transpose() * weight;
        misfit += weight * residual_deg(constraint, direction).powi(2);
        count += weight * constraint.variance_deg2;
    }
    // Only what turns the direction counts, and not what lengthens it.
    information += direction * direction.transpose() * 1e6;
    let (values, _) = crate::color::principal_axes(&information);
    let disagreement = (misfit / (count - 2.0f64).max(1.0)).max(1.0);
    (2.0 * (disagreement / values[2].max(1e-9)).sqrt()).min(90.0)
}

/// Strongest constraints whose pairs are tried as starts.
const MAX_PAIRED: usize = 8;
/// A light has at least this much of every band.
const LEAST_BAND: f64 = 0.02;
/// How far from white lights lie: yellow to blue, green to magenta, degrees.
const WHITE_SD_DEG: [f64; 2] = [14.0, 6.0];

/// What the most unusual light costs, in satisfied constraints: enough of them outweigh it.
const MOST_UNUSUAL: f64 = 3.0;

/// The nearest minimum, by reweighted smallest eigenvectors.
fn settle(constraints: &[Constraint], prior: &Prior, start: Vec3) -> Vec3 {
    let held = Matrix3::identity() - prior.direction * prior.direction.transpose();
    let mut direction = start;
    for _ in 0..12 {
        let mut sum = held / prior.sd_deg.powi(2);
        for constraint in constraints {
            sum += constraint.normal * constraint.normal.transpose() * weight(constraint, &direction);
        }
        let (_, axes) = crate::color::principal_axes(&sum);
        let next = axes[2] * if axes[2].sum() < 0.0 { -1.0 } else { 1.0 };
        let turned = next.cross(&direction).norm();
        direction = next;
        if turned < 1e-6 {
            break;
        }
    }
    direction
}

/// Constraints that a direction satisfies, less what it costs to be unusual and far from the prior.
fn merit(constraints: &[Constraint], prior: &Prior, direction: &Vec3) -> f64 {
    let satisfied: f64 = constraints
        .iter()
        .map(|c| {
            let u = residual_deg(c, direction) / (c.doubt_deg + c.variance_deg2.sqrt());
            c.reliability / (1.0 + u * u)
        })
        .sum();
    let unusual = unusualness(direction);
    let far = (axis_angle_deg(direction, &prior.direction) / prior.sd_deg).powi(2) / 2.0;
    satisfied - unusual / (1.0 + unusual / MOST_UNUSUAL) - far
}

/// How far a light lies from white: between blue (negative) and yellow, and between magenta and green, degrees.
pub fn white_offsets_deg(direction: &Vec3) -> [f64; 2] {
    let white = Vec3::repeat(1.0).normalize();
    let yellow_blue = Vec3::new(1.0, 0.0, -1.0).normalize();
    let green_magenta = yellow_blue.cross(&white);
    [yellow_blue, green_magenta].map(|axis| direction.dot(&axis).atan2(direction.dot(&white)).to_degrees())
}

/// How unusual a light is: minus the logarithm of its likelihood.
pub fn unusualness(direction: &Vec3) -> f64 {
    let [yellow_blue, green_magenta] = white_offsets_deg(direction);
    f64::midpoint((yellow_blue / WHITE_SD_DEG[0]).powi(2), (green_magenta / WHITE_SD_DEG[1]).powi(2))
}

fn residual_deg(constraint: &Constraint, direction: &Vec3) -> f64 {
    constraint.normal.dot(direction).clamp(-1.0, 1.0).asin().to_degrees()
}

fn weight(constraint: &Constraint, direction: &Vec3) -> f64 {
    let relative_residual = residual_deg(constraint, direction) / constraint.doubt_deg;
    constraint.reliability / (constraint.variance_deg2 * (1.0 + relative_residual * relative_residual))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plane_of(number: usize, body: Vec3, light: &Vec3) -> Constraint {
        let normal = body.cross(light).normalize();
        Constraint {
            hypothesis: HypothesisId::from_index(number - 1),
            normal,
            variance_deg2: 0.2,
            doubt_deg: 1.0,
            reliability: 1.0,
        }
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
            planes.push(Constraint { hypothesis: HypothesisId::from_index(8), normal: stranger, variance_deg2: 0.2, doubt_deg: 1.0, reliability: 1.0 });
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
