//! Section 5.4.1: all highlight lines are parallel to the illuminant, and all dichromatic planes contain it.
//!
//! The paper averages the first eigenvectors of the highlight clusters. These eigenvectors are biased towards each body vector
//! by 2–15°, because a highlight cluster is a wedge (the body reflection varies under a highlight). The tables of the paper
//! show the bias (9.0° for the white cups, 13.1° for the pink ones).
//!
//! Refined (`robust_illuminant`): every object constrains the illuminant to a plane with normal n_k, some objects also to a
//! direction in that plane (a second normal q_k, see `in_plane`). The illuminant is the unit vector s that minimizes
//! Σ ρ(n_k·s)²/(var_k + 0.4°²) + Σ ρ(q_k·s)²/(var_k + floor²), Cauchy's ρ, by reweighted smallest eigenvectors.
//! The error is typically 0.1° and below 1° for a single sphere; for two coplanar objects it falls from 20° to 0.2°.
//!
//! The planes of printed patterns and of metals do not contain the illuminant. The minimum is therefore searched from several
//! starts: the highlight lines' direction, white, and the intersection of each pair of planes. The merit of a result is the
//! number of constraints that it satisfies, less a cost for an unusual light: the colors of lamps and skies lie within about
//! 14° of white between yellow and blue, and within 6° between green and magenta.
//!
//! The variances of the constraints say how far the light is known where all planes are right. Where some are not, other
//! minima have nearly the same merit, and the light turns when one region is left out. Both are the spread of the light.

use super::candidates::HighlightLine;
use crate::color::{Vec3, axis_angle_deg};
use crate::raster::HypothesisId;
use crate::trace::Contribution;
use nalgebra::Matrix3;

/// A plane of the color space that contains the illuminant's direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// The hypothesis that the constraint comes from.
    pub hypothesis: HypothesisId,
    /// Unit normal of the plane: the illuminant is perpendicular to it.
    pub normal: Vec3,
    /// Variance of the normal's angle, degrees².
    pub variance_deg2: f64,
    /// Scale of Cauchy's ρ, degrees: a residual of this size halves the constraint's weight.
    pub residual_scale_deg: f64,
    /// Share of the constraint's full weight that the scatter of the region's pixels leaves, 0…1.
    pub reliability: f64,
}

/// Prior knowledge of the illuminant's direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// Most probable unit direction; a start of the search.
    pub direction: Vec3,
    /// Standard deviation, degrees.
    pub sd_deg: f64,
}

/// The direction in which the constraints intersect.
#[derive(Clone, Debug, PartialEq)]
pub struct Intersection {
    /// Unit direction of the illuminant.
    pub direction: Vec3,
    /// Two standard deviations of the direction along the axis of largest error, degrees, from the variances of the
    /// constraints and their disagreement.
    pub interval_deg: f64,
    /// Two standard deviations of the direction, degrees, by the other minima of the search and by a jackknife over the regions:
    /// how far the direction depends on single regions.
    pub spread_deg: f64,
    /// Residual and weight of each constraint, in the order of the constraints.
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

/// The direction that satisfies the constraints best. With no constraint it is the prior's direction.
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
    let minima: Vec<(Vec3, f64)> = starts
        .filter(|start| start.min() > LEAST_BAND)
        .map(|start| nearest_minimum(constraints, prior, start))
        .map(|minimum| (minimum, merit(constraints, prior, &minimum)))
        .collect();
    let best = minima.iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let direction = best.map_or(prior.direction, |best| best.0);
    let contribution = |constraint: &Constraint| Contribution {
        hypothesis: constraint.hypothesis,
        residual_deg: residual_deg(constraint, &direction),
        weight: weight(constraint, &direction),
    };
    let contributions = constraints.iter().map(contribution).collect();
    let by_regions_deg = spread_by_regions_deg(constraints, prior, &direction);
    Intersection {
        direction,
        interval_deg: interval_deg(constraints, prior, &direction),
        spread_deg: spread_by_rivals_deg(&minima, &direction).max(by_regions_deg).min(90.0),
        contributions,
    }
}

/// Two standard deviations of the direction where the odds of two minima of the search are the exponential of the difference of their merits,
/// degrees. `minima`: directions and merits; of those within [`SAME_MINIMUM_DEG`] of one another one counts.
fn spread_by_rivals_deg(minima: &[(Vec3, f64)], direction: &Vec3) -> f64 {
    let best = minima.iter().map(|(_, merit)| *merit).fold(f64::NEG_INFINITY, f64::max);
    let mut rivals = vec![*direction];
    let (mut squares, mut total) = (0.0, 1.0);
    for (minimum, merit) in minima {
        if rivals.iter().all(|rival| axis_angle_deg(rival, minimum) > SAME_MINIMUM_DEG) {
            let probability = (merit - best).exp();
            squares += probability * axis_angle_deg(minimum, direction).powi(2);
            total += probability;
            rivals.push(*minimum);
        }
    }
    2.0 * (squares / total).sqrt()
}

/// Two standard deviations of the direction by a jackknife: each region is left out once, with others where there are more than
/// [`MOST_JACKKNIFE_PARTS`]; degrees. 0 for fewer than [`LEAST_JACKKNIFE_REGIONS`] regions.
fn spread_by_regions_deg(constraints: &[Constraint], prior: &Prior, direction: &Vec3) -> f64 {
    let mut regions: Vec<HypothesisId> = constraints.iter().map(|constraint| constraint.hypothesis).collect();
    regions.sort_unstable();
    regions.dedup();
    if regions.len() < LEAST_JACKKNIFE_REGIONS {
        return 0.0;
    }
    let parts = regions.len().min(MOST_JACKKNIFE_PARTS);
    let part_of = |constraint: &Constraint| {
        regions.binary_search(&constraint.hypothesis).map_or(0, |place| place % parts)
    };
    let turned_deg2 = |part: usize| {
        let others: Vec<Constraint> =
            constraints.iter().filter(|constraint| part_of(constraint) != part).copied().collect();
        axis_angle_deg(&nearest_minimum(&others, prior, *direction), direction).powi(2)
    };
    let count = parts as f64;
    2.0 * ((0..parts).map(turned_deg2).sum::<f64>() * (count - 1.0) / count).sqrt()
}

/// Two standard deviations of the direction along the axis of largest error, degrees.
fn interval_deg(constraints: &[Constraint], prior: &Prior, direction: &Vec3) -> f64 {
    let mut information = Matrix3::identity() / prior.sd_deg.powi(2);
    let (mut misfit, mut count) = (0.0, 0.0);
    for constraint in constraints {
        let weight = weight(constraint, direction);
        information += constraint.normal * constraint.normal.transpose() * weight;
        misfit += weight * residual_deg(constraint, direction).powi(2);
        count += weight * constraint.variance_deg2;
    }
    // A large information along the direction itself: an error along it does not turn the direction.
    information += direction * direction.transpose() * 1e6;
    let (values, _) = crate::color::principal_axes(&information);
    let disagreement = (misfit / (count - 2.0f64).max(1.0)).max(1.0);
    (2.0 * (disagreement / values[2].max(1e-9)).sqrt()).min(90.0)
}

/// Angle within which two minima of the search are the same, degrees.
const SAME_MINIMUM_DEG: f64 = 1.0;
/// Fewest regions for a jackknife: without one of three, two planes alone decide.
const LEAST_JACKKNIFE_REGIONS: usize = 4;
/// Largest number of parts of the regions for the jackknife: its cost does not grow with the square of the number of regions.
const MOST_JACKKNIFE_PARTS: usize = 8;
/// Number of the strongest constraints whose pairwise intersections are starts of the search.
const MAX_PAIRED: usize = 8;
/// Least value of a band in the unit direction of a light.
pub const LEAST_BAND: f64 = 0.02;
/// Largest distance from white of a lamp that rests on highlights alone: blue to yellow, green to magenta, degrees.
pub const MOST_LAMP_OFFSETS_DEG: [f64; 2] = [20.0, 8.0];
/// Standard deviations of the colors of lights about white: yellow to blue, green to magenta, degrees.
const WHITE_SD_DEG: [f64; 2] = [14.0, 6.0];

/// Largest cost of an unusual light, in satisfied constraints: more constraints than that outweigh the cost.
const MOST_UNUSUAL: f64 = 3.0;

/// Largest number of rounds of the search for a minimum.
const MOST_ROUNDS: usize = 12;
/// Turn of the direction below which the search ends, radians.
const SETTLED_RAD: f64 = 1e-6;

/// The minimum nearest to `start`, by reweighted smallest eigenvectors.
fn nearest_minimum(constraints: &[Constraint], prior: &Prior, start: Vec3) -> Vec3 {
    let across_prior = Matrix3::identity() - prior.direction * prior.direction.transpose();
    let mut direction = start;
    for _ in 0..MOST_ROUNDS {
        let mut sum = across_prior / prior.sd_deg.powi(2);
        for constraint in constraints {
            sum += constraint.normal * constraint.normal.transpose() * weight(constraint, &direction);
        }
        let (_, axes) = crate::color::principal_axes(&sum);
        let next = axes[2] * if axes[2].sum() < 0.0 { -1.0 } else { 1.0 };
        let turned = next.cross(&direction).norm();
        direction = next;
        if turned < SETTLED_RAD {
            break;
        }
    }
    direction
}

/// Number of constraints that a direction satisfies (each counts at most 1), less the costs of an unusual light and of the
/// distance from the prior.
fn merit(constraints: &[Constraint], prior: &Prior, direction: &Vec3) -> f64 {
    let satisfied: f64 = constraints
        .iter()
        .map(|c| {
            let u = residual_deg(c, direction) / (c.residual_scale_deg + c.variance_deg2.sqrt());
            c.reliability / (1.0 + u * u)
        })
        .sum();
    let unusual = unusualness(direction);
    let from_prior = (axis_angle_deg(direction, &prior.direction) / prior.sd_deg).powi(2) / 2.0;
    satisfied - unusual / (1.0 + unusual / MOST_UNUSUAL) - from_prior
}

/// Angles of a light's direction from white, degrees: between blue (negative) and yellow, and between green (negative) and
/// magenta.
pub fn white_offsets_deg(direction: &Vec3) -> [f64; 2] {
    let white = Vec3::repeat(1.0).normalize();
    let yellow_blue = Vec3::new(1.0, 0.0, -1.0).normalize();
    let green_magenta = yellow_blue.cross(&white);
    [yellow_blue, green_magenta].map(|axis| direction.dot(&axis).atan2(direction.dot(&white)).to_degrees())
}

/// Minus the logarithm of a light's likelihood among lamps and skies, 0 for white.
pub fn unusualness(direction: &Vec3) -> f64 {
    let [yellow_blue, green_magenta] = white_offsets_deg(direction);
    f64::midpoint((yellow_blue / WHITE_SD_DEG[0]).powi(2), (green_magenta / WHITE_SD_DEG[1]).powi(2))
}

fn residual_deg(constraint: &Constraint, direction: &Vec3) -> f64 {
    constraint.normal.dot(direction).clamp(-1.0, 1.0).asin().to_degrees()
}

fn weight(constraint: &Constraint, direction: &Vec3) -> f64 {
    let relative_residual = residual_deg(constraint, direction) / constraint.residual_scale_deg;
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
            residual_scale_deg: 1.0,
            reliability: 1.0,
        }
    }

    proptest! {
        #[test]
        fn planes_intersect_in_the_light_and_an_outlier_has_little_weight(
            light in prop::array::uniform3(0.35f64..1.0),
        ) {
            let light = Vec3::from(light).normalize();
            let bodies = [[0.9, 0.2, 0.1], [0.1, 0.9, 0.2], [0.1, 0.2, 0.9], [0.9, 0.7, 0.05]];
            let mut planes: Vec<Constraint> =
                bodies.iter().map(|&b| plane_of(1, Vec3::from(b), &light)).collect();
            let outlier = Vec3::new(0.5, -0.4, 0.1).normalize();
            planes.push(Constraint { hypothesis: HypothesisId::from_index(8), normal: outlier, variance_deg2: 0.2, residual_scale_deg: 1.0, reliability: 1.0 });
            let prior = Prior { direction: Vec3::repeat(1.0).normalize(), sd_deg: 30.0 };
            let found = intersect(&planes, &prior);
            prop_assert!(axis_angle_deg(&found.direction, &light) < 0.5);
        }
    }

    const BODIES: [[f64; 3]; 4] = [[0.9, 0.2, 0.1], [0.1, 0.9, 0.2], [0.1, 0.2, 0.9], [0.9, 0.7, 0.05]];
    const NO_PRIOR_SD_DEG: f64 = 30.0;

    /// The planes of four regions whose bodies have the colors of [`BODIES`] under `lights`.
    fn planes_under(lights: [Vec3; 4]) -> Vec<Constraint> {
        (1..)
            .zip(BODIES)
            .zip(lights)
            .map(|((n, body), light)| plane_of(n, Vec3::from(body), &light))
            .collect()
    }

    #[test]
    fn a_light_on_which_all_regions_agree_has_no_spread() {
        let light = Vec3::new(0.6, 0.6, 0.529).normalize();
        let prior = Prior { direction: light, sd_deg: NO_PRIOR_SD_DEG };
        let found = intersect(&planes_under([light; 4]), &prior);
        assert!(axis_angle_deg(&found.direction, &light) < 0.01 && found.spread_deg < 0.1, "{found:?}");
    }

    #[test]
    fn a_light_has_the_spread_of_the_lights_that_are_as_probable() {
        let [a, b] = [[0.65, 0.58, 0.49], [0.49, 0.58, 0.65]].map(|light| Vec3::from(light).normalize());
        let apart_deg = axis_angle_deg(&a, &b);
        let prior = Prior { direction: Vec3::repeat(1.0).normalize(), sd_deg: NO_PRIOR_SD_DEG };
        let found = intersect(&planes_under([a, a, b, b]), &prior);
        assert!(found.interval_deg < apart_deg / 2.0, "by the variances alone: {found:?}");
        assert!(found.spread_deg > apart_deg / 2.0, "{apart_deg}: {found:?}");
    }

    #[test]
    fn a_light_has_the_spread_of_the_lights_without_each_region() {
        let light = Vec3::new(0.6, 0.6, 0.529).normalize();
        let turned = Vec3::new(0.64, 0.58, 0.5).normalize();
        let prior = Prior { direction: light, sd_deg: NO_PRIOR_SD_DEG };
        let spread_deg = |lights| {
            let constraints = planes_under(lights);
            let found = intersect(&constraints, &prior);
            spread_by_regions_deg(&constraints, &prior, &found.direction)
        };
        assert!(spread_deg([light; 4]) < 0.01);
        assert!(spread_deg([light, light, light, turned]) > 0.1);
        let three: Vec<Constraint> = planes_under([light, light, turned, light])[..3].to_vec();
        assert!(spread_by_regions_deg(&three, &prior, &light).abs() < 1e-12, "too few regions");
    }

    #[test]
    fn without_evidence_the_prior_stays() {
        let prior = Prior { direction: Vec3::new(0.6, 0.6, 0.529).normalize(), sd_deg: 8.0 };
        assert!(axis_angle_deg(&intersect(&[], &prior).direction, &prior.direction) < 1e-6);
    }
}
