//! Which estimate of the light is used: that of the dichromatic planes, or that of the votes? (refinement `vote_light`)
//!
//! The estimate by planes is right to a tenth of a degree where objects are what section 3 assumes, and up to 18° off where
//! objects are printed. The estimate by votes is right to a degree in both cases. So the planes win where regions that fit
//! the model and show highlights cover at least 30 % of the lit pixels (the support). Below that share the votes win, if
//! they agree well enough on a light that is not unusual. Where the votes do not win and the support is below 5 %, no light
//! is used, and no region is split by a plane: a picture without highlights stays as it is.
//!
//! [`choose_light`] is the whole rule. The function reads its arguments only; `planar` carries the decision out.

use super::plane_light::PlaneLight;
use super::vote_light::VoteLight;
use crate::color::{Vec3, axis_angle_deg};
use crate::trace::{LightBasis, LightLimits};

/// The limits of the rule.
pub const LIGHT_LIMITS: LightLimits =
    LightLimits { support: 0.3, hardly: 0.05, share: 0.02, offsets_deg: [20.0, 8.0] };
/// Support, in multiples of [`LIGHT_LIMITS`]' support, from which on a disagreement with the votes leaves the interval of the
/// planes' light as it is.
const AMPLE_SUPPORT: f64 = 2.0;

/// What the choice is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightEvidence {
    /// The estimate by the dichromatic planes.
    pub planes: PlaneLight,
    /// The estimate by the votes of small highlights; `None` where too few pixels can vote.
    pub votes: Option<VoteLight>,
    /// Share of the lit pixels in regions that fit the model and show a highlight under the planes' light, 0…1.
    pub support: f64,
}

/// The light that is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightDecision {
    /// The evidence that the light rests on.
    pub basis: LightBasis,
    /// Unit direction; `None`: no light is known.
    pub direction: Option<Vec3>,
    /// Number of regions, or of small highlights that voted, that the light rests on.
    pub objects: usize,
    /// Angle within which the light lies, by the evidence alone, degrees; `None` without a light.
    pub interval_deg: Option<f64>,
}

impl LightDecision {
    /// The planes' light whatever else is known; no light where the planes give none.
    pub fn planes_alone(planes: &PlaneLight) -> Self {
        let direction = planes.known_direction();
        Self {
            basis: if direction.is_some() { LightBasis::Planes } else { LightBasis::Nothing },
            direction,
            objects: planes.regions,
            interval_deg: direction.map(|_| planes.interval_deg),
        }
    }
}

/// The light to use.
pub fn choose_light(evidence: &LightEvidence) -> LightDecision {
    let by_planes = LightDecision::planes_alone(&evidence.planes);
    let Some(votes) = evidence.votes else { return by_planes };
    if evidence.support < LIGHT_LIMITS.support && votes_are_credible(&votes) {
        return LightDecision {
            basis: LightBasis::Votes,
            direction: Some(votes.result.direction.into()),
            objects: votes.result.blobs as usize,
            interval_deg: Some(votes.interval_deg),
        };
    }
    if evidence.support < LIGHT_LIMITS.hardly {
        return LightDecision {
            basis: LightBasis::Nothing,
            direction: None,
            interval_deg: None,
            ..by_planes
        };
    }
    let interval_deg = by_planes.interval_deg.map(|interval| interval.max(contradiction_deg(evidence)));
    LightDecision { interval_deg, ..by_planes }
}

/// Whether enough votes agree on a light, and that light is not unusual.
fn votes_are_credible(votes: &VoteLight) -> bool {
    let limits = LIGHT_LIMITS;
    let usual = (0..2).all(|axis| votes.result.offsets_deg[axis].abs() <= limits.offsets_deg[axis]);
    usual && votes.result.share >= limits.share
}

/// Least interval of the planes' light because the votes contradict it, degrees: half of the angle between both lights.
/// Two estimates that contradict each other are not as exact as each alone appears. 0 under ample support.
fn contradiction_deg(evidence: &LightEvidence) -> f64 {
    let lights = evidence.planes.known_direction().zip(evidence.votes);
    match lights {
        Some((by_planes, votes)) if evidence.support < AMPLE_SUPPORT * LIGHT_LIMITS.support => {
            axis_angle_deg(&by_planes, &votes.result.direction.into()) / 2.0
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::VoteResult;

    fn white() -> Vec3 {
        Vec3::repeat(1.0).normalize()
    }

    fn yellowish() -> Vec3 {
        Vec3::new(0.62, 0.57, 0.54).normalize()
    }

    /// Planes for white with an interval of 1°, and votes of a share for a yellowish light at an offset from white (degrees,
    /// blue to yellow) with an interval of 3°.
    fn evidence(support: f64, share: f64, offset_deg: f64) -> LightEvidence {
        let planes =
            PlaneLight { direction: Some(white()), regions: 4, interval_deg: 1.0, highlights_alone: false };
        let result = VoteResult {
            direction: yellowish().into(),
            voters: 90,
            blobs: 7,
            share,
            offsets_deg: [offset_deg, 0.0],
        };
        LightEvidence { planes, votes: Some(VoteLight { result, interval_deg: 3.0 }), support }
    }

    fn basis(support: f64, share: f64, offset_deg: f64) -> LightBasis {
        choose_light(&evidence(support, share, offset_deg)).basis
    }

    #[test]
    fn planes_win_by_support_and_votes_by_their_share() {
        assert_eq!(basis(0.3, 0.5, 5.0), LightBasis::Planes);
        assert_eq!(basis(0.29, 0.02, 5.0), LightBasis::Votes);
        assert_eq!(basis(0.0, 0.02, 20.0), LightBasis::Votes);
        assert_eq!(basis(0.29, 0.019, 5.0), LightBasis::Planes, "too few votes agree");
        assert_eq!(basis(0.29, 0.5, 20.1), LightBasis::Planes, "an unusual light");
        assert_eq!(basis(0.049, 0.019, 5.0), LightBasis::Nothing);
    }

    #[test]
    fn the_decision_carries_what_the_winner_says() {
        let votes = choose_light(&evidence(0.1, 0.5, 5.0));
        assert_eq!((votes.direction, votes.objects), (Some(yellowish()), 7));
        assert_eq!(votes.interval_deg, Some(3.0));
        let nothing = choose_light(&evidence(0.0, 0.0, 5.0));
        assert_eq!((nothing.direction, nothing.interval_deg), (None, None));
    }

    #[test]
    fn votes_that_contradict_the_planes_widen_the_interval_unless_support_is_ample() {
        let half_deg = axis_angle_deg(&white(), &yellowish()) / 2.0;
        assert!(half_deg > 1.0);
        assert_eq!(choose_light(&evidence(0.59, 0.5, 5.0)).interval_deg, Some(half_deg));
        assert_eq!(choose_light(&evidence(0.61, 0.5, 5.0)).interval_deg, Some(1.0));
    }

    #[test]
    fn without_votes_the_planes_decide_and_without_regions_there_is_no_light() {
        let planes_alone = LightEvidence { votes: None, ..evidence(0.0, 0.0, 5.0) };
        assert_eq!(choose_light(&planes_alone).basis, LightBasis::Planes);
        let planes = PlaneLight { regions: 0, ..planes_alone.planes };
        let nothing = choose_light(&LightEvidence { planes, ..planes_alone });
        assert_eq!((nothing.basis, nothing.direction), (LightBasis::Nothing, None));
    }
}
