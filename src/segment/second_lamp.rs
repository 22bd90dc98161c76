//! A second lamp of another color (section 7.5; refinement `second_lamp`).
//!
//! "Many realistic scenes will contain more than a single, point-like light source": a window and a lamp, or two lamps. The robust
//! intersection of the dichromatic planes then finds the light of most regions, and the planes of the other regions miss that light by far
//! more than their errors. Those regions are searched for a second light: a usual color of lamps that lies in the planes of at least two of
//! them and in the direction within each plane that the highlights of the region tell (`in_plane`). Two constraints of each region leave
//! little to chance: on 82 rendered scenes with one lamp, as they are, with shot noise and compressed, no second lamp is found, demosaiced and
//! compressed one, in a scene whose ambient light has another color than the lamp. Of twelve scenes of balls under two lamps it is found in
//! eight, with an error of .1° to 3.4°.
//!
//! Each region is split with the lamp that its own highlights agree with, a region without highlights with that of the nearest region
//! (`lit_regions`). A second lamp that was given is not sought: the regions' highlights only tell which of both lights each region.

use super::evidence::{branch_constraint, plane_of_highlights};
use super::illuminant::{Constraint, MOST_LAMP_OFFSETS_DEG, Prior, intersect, white_offsets_deg};
use super::lit_regions::{SecondLamp, lights_of_regions};
use super::two_lights::Evidence;
use crate::color::{Vec3, axis_angle_deg};
use crate::raster::{HypothesisId, LabelMap};
use crate::trace::{LampLimits, LampOfRegion, LampsCompared};

/// The limits of the search.
pub const LAMP_LIMITS: LampLimits = LampLimits {
    contradicts: 2.0,
    agrees: 1.0,
    regions: 2,
    share: 0.5,
    ample_regions: 3,
    merit: 0.6,
    angle_deg: 5.0,
    offsets_deg: MOST_LAMP_OFFSETS_DEG,
};
/// Error that is added to two standard deviations of a constraint, degrees: of a plane, and of a direction within a plane.
const MARGINS_DEG: [f64; 2] = [0.7, 1.5];
/// Standard deviation of the prior white when the second lamp is fitted, degrees.
const PRIOR_SD_DEG: f64 = 30.0;

/// What the highlights of one region tell of the light.
struct Opinion {
    hypothesis: HypothesisId,
    /// The light lies in the plane in which the highlights rise …
    plane: Constraint,
    /// … and in this direction within the plane.
    within: Constraint,
}

impl Opinion {
    fn of(evidence: &Evidence) -> Option<Self> {
        let highlights = evidence.highlights.as_ref()?;
        Some(Self {
            hypothesis: evidence.lies_in.hypothesis,
            plane: plane_of_highlights(&evidence.lies_in, &evidence.plane, Some(&highlights.rise)),
            within: branch_constraint(&evidence.lies_in, &evidence.plane, highlights),
        })
    }

    /// Angles between a light and both constraints, as shares of so many standard deviations of the constraints and the margins.
    fn misfits(&self, light: &Vec3, deviations: f64) -> [f64; 2] {
        let misfit = |constraint: &Constraint, margin_deg: f64| {
            let angle_deg = constraint.normal.dot(light).clamp(-1.0, 1.0).asin().to_degrees().abs();
            angle_deg / (deviations * constraint.variance_deg2.sqrt() + margin_deg)
        };
        [misfit(&self.plane, MARGINS_DEG[0]), misfit(&self.within, MARGINS_DEG[1])]
    }

    /// The larger of both angles, as a share of the largest error that is expected.
    fn misfit(&self, light: &Vec3) -> f64 {
        let [plane, within] = self.misfits(light, 2.0);
        plane.max(within)
    }

    /// How well the opinion agrees with a light, 0…1.
    fn merit(&self, light: &Vec3) -> f64 {
        let [plane, within] = self.misfits(light, 1.0);
        1.0 / (1.0 + plane * plane + within * within)
    }

    /// The light that satisfies both constraints of the opinion.
    fn light(&self) -> Option<Vec3> {
        into_cube(self.plane.normal.cross(&self.within.normal))
    }
}

/// The unit direction of a light along an axis; none for an axis of length 0.
fn into_cube(axis: Vec3) -> Option<Vec3> {
    let axis = axis.try_normalize(0.1)?;
    Some(if axis.sum() < 0.0 { -axis } else { axis })
}

/// Whether the highlights of any region contradict the light, unit.
pub fn contradicts(evidence: &[Evidence], light: &Vec3) -> bool {
    evidence.iter().filter_map(Opinion::of).any(|opinion| opinion.misfit(light) > LAMP_LIMITS.contradicts)
}

/// Searches the regions' evidence for a second lamp beside the light `first`, unit, which is known within `first_interval_deg`: a lamp that is
/// nearer is no other one. `interval_widening`: factor of the intervals of both lamps
/// ([`AnalysisInput::interval_widening`](super::AnalysisInput::interval_widening)). Returns the comparison, and the
/// second lamp where there is one; `None` with fewer than two regions that contradict the first light. `matte_labels`: the matte region of
/// each pixel, of `count` hypotheses.
pub fn second_lamp(
    evidence: &[Evidence],
    first: &Vec3,
    first_interval_deg: f64,
    interval_widening: f64,
    matte_labels: &LabelMap,
    count: usize,
) -> Option<(LampsCompared, Option<SecondLamp>)> {
    let least_angle_deg = LAMP_LIMITS.angle_deg.max(interval_widening * first_interval_deg);
    let limits = LampLimits { angle_deg: least_angle_deg, ..LAMP_LIMITS };
    let opinions: Vec<Opinion> = evidence.iter().filter_map(Opinion::of).collect();
    let contradicting: Vec<&Opinion> =
        opinions.iter().filter(|opinion| opinion.misfit(first) > LAMP_LIMITS.contradicts).collect();
    if contradicting.len() < LAMP_LIMITS.regions as usize {
        return None;
    }
    let best = candidates(&contradicting)
        .filter(|light| is_lamp(light, first, &limits))
        .map(|light| Candidate::new(light, &contradicting))
        .max_by(|a, b| a.merit().total_cmp(&b.merit()));
    let fitted = best.map(Candidate::fitted);
    let found = fitted.filter(|(candidate, _)| {
        is_lamp(&candidate.light, first, &limits) && candidate.is_accepted(contradicting.len())
    });
    let found =
        found.map(|(candidate, interval_deg)| (candidate, (interval_widening * interval_deg).min(90.0)));
    let compared = LampsCompared {
        first: (*first).into(),
        second: found.as_ref().map(|(candidate, _)| candidate.light.into()),
        given: false,
        interval_deg: found.as_ref().map(|(_, interval_deg)| *interval_deg),
        contradicting: contradicting.len() as u32,
        agreeing: found.as_ref().map_or(0, |(candidate, _)| candidate.agreeing.len() as u32),
        regions: lamps_of_regions(&opinions, first, found.as_ref().map(|(candidate, _)| &candidate.light)),
        limits,
    };
    let lamp = found.map(|(candidate, interval_deg)| SecondLamp {
        direction: candidate.light,
        interval_deg: Some(interval_deg),
        regions: candidate.agreeing.len(),
        lights: regions_lit_by_second(&compared, matte_labels, count),
    });
    Some((compared, lamp))
}

/// The regions that the second lamp lights, where the colors of both lamps, unit, are given or known otherwise: no lamp is sought.
/// Arguments and result as of [`second_lamp`].
pub fn given_second_lamp(
    evidence: &[Evidence],
    first: &Vec3,
    second: &Vec3,
    matte_labels: &LabelMap,
    count: usize,
) -> (LampsCompared, SecondLamp) {
    let opinions: Vec<Opinion> = evidence.iter().filter_map(Opinion::of).collect();
    let contradicts = |opinion: &&Opinion| opinion.misfit(first) > LAMP_LIMITS.contradicts;
    let agrees = |opinion: &&Opinion| opinion.misfit(second) < LAMP_LIMITS.agrees;
    let contradicting = opinions.iter().filter(contradicts);
    let compared = LampsCompared {
        first: (*first).into(),
        second: Some((*second).into()),
        given: true,
        interval_deg: None,
        contradicting: contradicting.clone().count() as u32,
        agreeing: contradicting.filter(agrees).count() as u32,
        regions: lamps_of_regions(&opinions, first, Some(second)),
        limits: LAMP_LIMITS,
    };
    let lamp = SecondLamp {
        direction: *second,
        interval_deg: None,
        regions: compared.regions.iter().filter(|region| region.is_second()).count(),
        lights: regions_lit_by_second(&compared, matte_labels, count),
    };
    (compared, lamp)
}

/// How well the highlights of each region agree with both lamps.
fn lamps_of_regions(opinions: &[Opinion], first: &Vec3, second: Option<&Vec3>) -> Vec<LampOfRegion> {
    let lamp_of = |opinion: &Opinion| LampOfRegion {
        hypothesis: opinion.hypothesis,
        misfits: [Some(first), second].map(|light| light.map(|light| opinion.misfit(light))),
    };
    opinions.iter().map(lamp_of).collect()
}

/// Whether the second lamp lights each of `count` regions, as the comparison says, and elsewhere as it lights the nearest region.
fn regions_lit_by_second(compared: &LampsCompared, matte_labels: &LabelMap, count: usize) -> Vec<bool> {
    let mut known = vec![None; count];
    for region in &compared.regions {
        known[region.hypothesis.index()] = Some(region.is_second());
    }
    lights_of_regions(matte_labels, &known)
}

/// The lights that could be the second lamp: those of each opinion, and those that two planes contain.
fn candidates<'o>(contradicting: &'o [&'o Opinion]) -> impl Iterator<Item = Vec3> + 'o {
    let own = contradicting.iter().filter_map(|opinion| opinion.light());
    let crossed = contradicting.iter().enumerate().flat_map(move |(index, a)| {
        contradicting[index + 1..].iter().filter_map(|b| into_cube(a.plane.normal.cross(&b.plane.normal)))
    });
    own.chain(crossed)
}

/// Whether a light is another one than `first`, and of a usual color.
fn is_lamp(light: &Vec3, first: &Vec3, limits: &LampLimits) -> bool {
    let offsets_deg = white_offsets_deg(light);
    axis_angle_deg(light, first) >= limits.angle_deg
        && (0..2).all(|axis| offsets_deg[axis].abs() <= LAMP_LIMITS.offsets_deg[axis])
}

/// A light that could be the second lamp, and the contradicting regions that agree with it.
struct Candidate<'o> {
    light: Vec3,
    agreeing: Vec<&'o Opinion>,
}

impl<'o> Candidate<'o> {
    fn new(light: Vec3, contradicting: &[&'o Opinion]) -> Self {
        let agrees = |opinion: &&&Opinion| opinion.misfit(&light) < LAMP_LIMITS.agrees;
        Self { light, agreeing: contradicting.iter().filter(agrees).copied().collect() }
    }

    fn merit(&self) -> f64 {
        self.agreeing.iter().map(|opinion| opinion.merit(&self.light)).sum()
    }

    /// The candidate at the light that fits the constraints of all agreeing regions best, and two standard deviations of that light, degrees.
    fn fitted(self) -> (Self, f64) {
        let constraints: Vec<Constraint> =
            self.agreeing.iter().flat_map(|opinion| [opinion.plane, opinion.within]).collect();
        let found = intersect(&constraints, &Prior { direction: self.light, sd_deg: PRIOR_SD_DEG });
        let fitted = Self::new(found.direction, &self.agreeing);
        (fitted, found.interval_deg)
    }

    /// Whether enough of the regions that contradict the first light agree with this light, and closely.
    fn is_accepted(&self, contradicting: usize) -> bool {
        let agreeing = self.agreeing.len();
        let enough = agreeing >= LAMP_LIMITS.regions as usize
            && (agreeing >= LAMP_LIMITS.ample_regions as usize
                || agreeing as f64 >= LAMP_LIMITS.share * contradicting as f64);
        enough && self.merit() >= LAMP_LIMITS.merit * agreeing as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Line;
    use crate::raster::{Raster, UNASSIGNED};
    use crate::reflection::DichromaticPlane;
    use crate::segment::in_plane::{InPlane, Rise};

    const LAMPS: [[f64; 3]; 2] = [[0.68, 0.58, 0.45], [0.54, 0.57, 0.62]];
    const BODIES: [[f64; 3]; 5] =
        [[0.9, 0.3, 0.2], [0.2, 0.8, 0.3], [0.3, 0.3, 0.9], [0.8, 0.7, 0.2], [0.7, 0.2, 0.7]];

    /// The evidence of a region with the body vector `body`, whose highlights have the color `lamp`.
    fn evidence(index: usize, body: [f64; 3], lamp: [f64; 3]) -> Evidence {
        let (body, lamp) = (Vec3::from(body).normalize(), Vec3::from(lamp).normalize());
        let plane = DichromaticPlane::new(&Line::new(body * 90.0, body), &lamp).unwrap();
        let highlights = InPlane {
            cotangent: lamp.dot(&body) / (1.0 - lamp.dot(&body).powi(2)).sqrt(),
            variance_rad2: 1e-4,
            rise: Rise { tangent: 0.0, variance: 1e-5 },
            strong: Vec::new(),
        };
        let lies_in = Constraint {
            hypothesis: HypothesisId::from_index(index),
            normal: plane.normal,
            variance_deg2: 0.2,
            residual_scale_deg: 1.0,
            reliability: 1.0,
        };
        Evidence { plane, lies_in, highlights: Some(highlights) }
    }

    /// The second lamp of five regions, where `second` says which region the second lamp lights. The regions are columns of a picture.
    fn found(second: [bool; 5]) -> Option<SecondLamp> {
        found_with(1.0, second)
    }

    /// The same where the intervals are `interval_widening` times as wide.
    fn found_with(interval_widening: f64, second: [bool; 5]) -> Option<SecondLamp> {
        let labels = Raster::from_vec(6, 2, [1, 2, 3, 4, 5, 6].repeat(2)).unwrap();
        let evidence: Vec<Evidence> =
            (0..5).map(|index| evidence(index, BODIES[index], LAMPS[usize::from(second[index])])).collect();
        let first = Vec3::from(LAMPS[0]).normalize();
        second_lamp(&evidence, &first, 1.0, interval_widening, &labels, 6).and_then(|(_, lamp)| lamp)
    }

    #[test]
    fn two_regions_that_agree_on_another_lamp_are_lit_by_that_lamp() {
        let lamp = found([false, false, false, true, true]).unwrap();
        assert!(axis_angle_deg(&lamp.direction, &Vec3::from(LAMPS[1])) < 0.2, "{lamp:?}");
        assert_eq!(lamp.regions, 2);
        let last = "the last region has no highlights; the fifth is nearest";
        assert_eq!(lamp.lights, [false, false, false, true, true, true], "{last}");
    }

    #[test]
    fn alike_errors_of_neighbors_widen_the_intervals_of_both_lamps() {
        let second = [false, false, false, true, true];
        let interval_deg = |widening| found_with(widening, second).and_then(|lamp| lamp.interval_deg);
        let (plain, widened) = (interval_deg(1.0).unwrap(), interval_deg(2.0).unwrap());
        assert!((widened / plain - 2.0).abs() < 1e-9, "{plain}\u{b0} and {widened}\u{b0}");
        assert_eq!(interval_deg(60.0), None, "within the interval of the first light it is no other lamp");
    }

    #[test]
    fn a_given_lamp_lights_the_regions_whose_highlights_agree_with_it_better_than_with_the_first() {
        let labels = Raster::from_vec(6, 2, [1, 2, 3, 4, 5, 6].repeat(2)).unwrap();
        let [first, second] = LAMPS.map(|lamp| Vec3::from(lamp).normalize());
        let lamp_of = |index: usize| usize::from(index == 4);
        let evidence: Vec<Evidence> =
            (0..5).map(|index| evidence(index, BODIES[index], LAMPS[lamp_of(index)])).collect();
        assert!(
            second_lamp(&evidence, &first, 1.0, 1.0, &labels, 6).is_none(),
            "one region alone is no second lamp"
        );
        let (compared, lamp) = given_second_lamp(&evidence, &first, &second, &labels, 6);
        assert_eq!(lamp.lights, [false, false, false, false, true, true], "the last has no highlights");
        assert_eq!((lamp.regions, lamp.direction, lamp.interval_deg), (1, second, None));
        assert!(compared.given && compared.contradicting == 1 && compared.agreeing == 1, "{compared:?}");
        let (_, none) = given_second_lamp(&[], &first, &second, &labels, 6);
        assert_eq!(
            (none.regions, none.lights),
            (0, vec![false; 6]),
            "no highlights, no region of the second lamp"
        );
    }

    #[test]
    fn one_region_alone_and_regions_that_do_not_agree_are_no_lamp() {
        assert_eq!(found([false; 5]), None);
        assert_eq!(found([false, true, false, false, false]), None, "a print, or a metal");
        let prints = [[0.30, 0.62, 0.72], [0.75, 0.60, 0.30], [0.72, 0.35, 0.60]];
        let evidence: Vec<Evidence> =
            (0..3).map(|index| evidence(index, BODIES[index], prints[index])).collect();
        let first = Vec3::from(LAMPS[0]).normalize();
        let labels = Raster::filled(3, 1, UNASSIGNED);
        let (compared, lamp) = second_lamp(&evidence, &first, 1.0, 1.0, &labels, 3).unwrap();
        assert!(lamp.is_none() && compared.second.is_none() && compared.contradicting == 3, "{compared:?}");
    }

    #[test]
    fn a_lamp_within_the_interval_of_the_first_is_no_other_lamp() {
        let evidence: Vec<Evidence> =
            (0..5).map(|index| evidence(index, BODIES[index], LAMPS[usize::from(index > 2)])).collect();
        let labels = Raster::from_vec(6, 2, [1, 2, 3, 4, 5, 6].repeat(2)).unwrap();
        let first = Vec3::from(LAMPS[0]).normalize();
        let lamp = |interval_deg| second_lamp(&evidence, &first, interval_deg, 1.0, &labels, 6).unwrap();
        assert!(lamp(6.0).1.is_some(), "the lamps are 12.6\u{b0} apart");
        let (compared, none) = lamp(20.0);
        assert!(none.is_none() && compared.second.is_none(), "{compared:?}");
    }
}
