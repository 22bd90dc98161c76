//! Which estimate of the light is used: that of the dichromatic planes, or that of the votes? (refinement `vote_light`)
//!
//! The estimate by planes is right to a tenth of a degree where objects are what section 3 assumes, and up to 20° off where
//! objects are printed. The estimate by votes is right to one or two degrees in both cases. Neither is judged by how large the
//! rest of the picture is: a wall or a table that shows no highlight says nothing about the light.
//!
//! The votes win if the logarithm of the odds for them exceeds a limit. The odds have three parts: how much less usual the
//! planes' light is (lamps and skies lie near white, see [`unusualness`]), how much wider its interval is, and how much smaller
//! its own share of the votes is; the last part counts as far as regions that fit the model and show highlights do not cover
//! the lit pixels (the support). Where one estimate is no light that could be, the other decides, and where both are, no light
//! is used and no region is split by a plane: a picture without highlights stays as it is.
//!
//! Replayed on the evidence of 564 pictures (82 rendered scenes, a third of them printed or before a wall of the lamp's color; as
//! they are, with shot noise, compressed, demosaiced and both), the rule's light is more than 2° off in 127; planes alone 148,
//! votes alone 280, the better of both 97, the earlier rule, by the support alone, 189. The limits were chosen on the same
//! pictures.
//!
//! Without a light by planes, votes for a light of an unusual color that a tenth of the lit pixels have are void: where
//! a second body lies in spots on the first, the spots rise above their surroundings as highlights do, and vote for a
//! light of their own color. (A frog with a yellow belly: the light was claimed 20° off, body 38.3 dB, doing nothing
//! 43.7 dB.) White and gray bodies under an ordinary lamp have the color of the light as well; therefore votes within
//! 9° of white stay.
//!
//! [`choose_light`] is the whole rule. The function reads its arguments only; `planar` carries the decision out.

use super::illuminant::{MOST_LAMP_OFFSETS_DEG, unusualness, white_offsets_deg};
use super::plane_light::PlaneLight;
use super::vote_light::VoteLight;
use crate::color::{Vec3, axis_angle_deg};
use crate::trace::{LightBasis, LightLimits, LightOdds};

/// The limits of the rule.
pub const LIGHT_LIMITS: LightLimits = LightLimits {
    log_odds: 0.5,
    share: 0.01,
    share_without_planes: 0.02,
    offsets_deg: MOST_LAMP_OFFSETS_DEG,
    body_share: 0.1,
    body_offset_deg: 9.0,
    planes_offsets_deg: [40.0, 20.0],
    planes_interval_deg: 30.0,
};
/// Least value of a band in the unit direction of the planes' light: where a band lacks, nothing tells surface reflection from a saturated
/// body.
const LEAST_BAND_OF_PLANES: f64 = 0.05;
/// Largest difference of the unusualness of both lights that counts.
const MOST_UNUSUAL: f64 = 4.0;
/// Exponent of the ratio of both intervals, and of that of both shares.
const RATIO_EXPONENT: f64 = 0.5;
/// Least interval of the votes that counts, degrees: votes that agree exactly are not as exact as that.
const LEAST_VOTES_INTERVAL_DEG: f64 = 2.5;
/// Share that is added to both shares before they are compared, so that a share of zero is not infinitely small.
const NEGLIGIBLE_SHARE: f64 = 0.002;
/// Factor of the votes' interval where they win: where planes fail, votes are less exact than they agree.
const VOTES_WIDENING: f64 = 2.0;
/// Support from which on a disagreement with the votes leaves the interval of the planes' light as it is, 0…1.
const AMPLE_SUPPORT: f64 = 0.6;

/// What the choice is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightEvidence {
    /// The estimate by the dichromatic planes.
    pub planes: PlaneLight,
    /// The estimate by the votes of small highlights; `None` where too few pixels can vote.
    pub votes: Option<VoteLight>,
    /// Share of the votes that the planes' light has, 0…1; 0 without votes.
    pub planes_share: f64,
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
    /// Angle within which the light lies, as far as the evidence tells, degrees; `None` without a light.
    pub interval_deg: Option<f64>,
    /// The odds for the votes; `None` where at most one of both estimates is a light that could be.
    pub odds: Option<LightOdds>,
}

impl LightDecision {
    /// No light.
    const NOTHING: Self =
        Self { basis: LightBasis::Nothing, direction: None, objects: 0, interval_deg: None, odds: None };

    /// The planes' light whatever else is known; no light where the planes give none.
    pub fn planes_alone(planes: &PlaneLight) -> Self {
        let Some(direction) = planes.known_direction() else { return Self::NOTHING };
        Self {
            basis: LightBasis::Planes,
            direction: Some(direction),
            objects: planes.regions,
            interval_deg: Some(planes.interval_deg),
            odds: None,
        }
    }

    fn votes_alone(votes: &VoteLight) -> Self {
        Self {
            basis: LightBasis::Votes,
            direction: Some(votes.result.direction.into()),
            objects: votes.result.blobs as usize,
            interval_deg: Some(VOTES_WIDENING * votes.interval_deg),
            odds: None,
        }
    }
}

/// The light to use.
pub fn choose_light(evidence: &LightEvidence) -> LightDecision {
    let limits = LIGHT_LIMITS;
    let planes = Some(evidence.planes).filter(planes_could_be);
    let least_share = if planes.is_some() { limits.share } else { limits.share_without_planes };
    let votes = evidence.votes.filter(|votes| votes_could_be(votes, least_share));
    match (planes, votes) {
        (None, None) => LightDecision::NOTHING,
        (Some(planes), None) => LightDecision::planes_alone(&planes),
        (None, Some(votes)) if votes.result.has_color_of_a_body(&limits) => LightDecision::NOTHING,
        (None, Some(votes)) => LightDecision::votes_alone(&votes),
        (Some(planes), Some(votes)) => {
            let odds = odds(evidence, &votes);
            if odds.sum() > limits.log_odds {
                return LightDecision { odds: Some(odds), ..LightDecision::votes_alone(&votes) };
            }
            let interval_deg = planes.interval_deg.max(doubt_by_votes_deg(evidence, &votes));
            LightDecision {
                interval_deg: Some(interval_deg),
                odds: Some(odds),
                ..LightDecision::planes_alone(&planes)
            }
        }
    }
}

/// Logarithm of the odds that the votes' light is the better one, by its parts.
fn odds(evidence: &LightEvidence, votes: &VoteLight) -> LightOdds {
    let planes = evidence.planes;
    let unusual = planes.direction.map_or(0.0, |direction| unusualness(&direction))
        - unusualness(&votes.result.direction.into());
    let share = |share: f64| share + NEGLIGIBLE_SHARE;
    let shares = (share(votes.result.share) / share(evidence.planes_share)).ln();
    LightOdds {
        unusualness: unusual.clamp(-MOST_UNUSUAL, MOST_UNUSUAL),
        intervals: RATIO_EXPONENT
            * (planes.interval_deg / votes.interval_deg.max(LEAST_VOTES_INTERVAL_DEG)).ln(),
        shares: RATIO_EXPONENT * (1.0 - evidence.support.clamp(0.0, 1.0)) * shares,
    }
}

/// Whether the planes' light could be a light: it is known within its limit, and is not of a color that no lamp has.
fn planes_could_be(planes: &PlaneLight) -> bool {
    let usual = |direction: Vec3| {
        let offsets_deg = white_offsets_deg(&direction);
        let is_near_white =
            (0..2).all(|axis| offsets_deg[axis].abs() <= LIGHT_LIMITS.planes_offsets_deg[axis]);
        is_near_white && direction.min() >= LEAST_BAND_OF_PLANES
    };
    planes.known_direction().is_some_and(usual) && planes.interval_deg <= LIGHT_LIMITS.planes_interval_deg
}

/// Whether enough votes agree on a light, and that light is not unusual.
fn votes_could_be(votes: &VoteLight, least_share: f64) -> bool {
    let usual = (0..2).all(|axis| votes.result.offsets_deg[axis].abs() <= LIGHT_LIMITS.offsets_deg[axis]);
    usual && votes.result.share >= least_share
}

/// Least interval of the planes' light because the votes contradict it, degrees: half of the angle between both lights.
/// Two estimates that contradict each other are not as exact as each alone appears. Ample support leaves no doubt.
fn doubt_by_votes_deg(evidence: &LightEvidence, votes: &VoteLight) -> f64 {
    match evidence.planes.known_direction() {
        Some(by_planes) if evidence.support < AMPLE_SUPPORT => {
            axis_angle_deg(&by_planes, &votes.result.direction.into()) / 2.0
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::VoteResult;

    /// A light so many degrees from white, towards yellow.
    fn yellowish(offset_deg: f64) -> Vec3 {
        let yellow_blue = Vec3::new(1.0, 0.0, -1.0).normalize();
        (Vec3::repeat(1.0).normalize() + yellow_blue * offset_deg.to_radians().tan()).normalize()
    }

    /// Planes for a light with an interval of 1°, and votes of a share for a light with an interval of 3°; the lights' offsets
    /// from white in degrees.
    fn evidence(planes_deg: f64, votes_deg: f64, share: f64) -> LightEvidence {
        let planes = PlaneLight {
            direction: Some(yellowish(planes_deg)),
            regions: 4,
            interval_deg: 1.0,
            spread_deg: 0.0,
            highlights_alone: false,
        };
        let result = VoteResult {
            direction: yellowish(votes_deg).into(),
            voters: 90,
            blobs: 7,
            share,
            offsets_deg: [votes_deg, 0.0],
            body_share: 0.0,
        };
        let votes = Some(VoteLight { result, interval_deg: 3.0 });
        LightEvidence { planes, votes, planes_share: share, support: 0.5 }
    }

    fn basis(evidence: &LightEvidence) -> LightBasis {
        choose_light(evidence).basis
    }

    #[test]
    fn the_more_unusual_light_loses_by_much_and_exact_planes_win_else() {
        assert_eq!(basis(&evidence(3.0, 9.0, 0.1)), LightBasis::Planes);
        assert_eq!(basis(&evidence(12.0, 3.0, 0.1)), LightBasis::Planes, "a little more unusual");
        assert_eq!(basis(&evidence(25.0, 3.0, 0.1)), LightBasis::Votes);
    }

    #[test]
    fn a_large_picture_without_highlights_does_not_outvote_planes() {
        let wall = LightEvidence { support: 0.0, ..evidence(3.0, 9.0, 0.1) };
        assert_eq!(basis(&wall), LightBasis::Planes);
    }

    #[test]
    fn wide_intervals_and_a_small_share_of_the_votes_count_against_planes() {
        let usual = evidence(6.0, 2.0, 0.06);
        assert_eq!(basis(&usual), LightBasis::Planes);
        let wide = PlaneLight { interval_deg: 12.0, ..usual.planes };
        assert_eq!(basis(&LightEvidence { planes: wide, ..usual }), LightBasis::Votes);
        let equal = PlaneLight { interval_deg: 3.0, ..usual.planes };
        let contradicted = LightEvidence { planes: equal, planes_share: 0.005, support: 0.1, ..usual };
        assert_eq!(basis(&contradicted), LightBasis::Votes);
        let supported = LightEvidence { support: 0.95, ..contradicted };
        assert_eq!(basis(&supported), LightBasis::Planes);
    }

    #[test]
    fn what_could_not_be_a_light_does_not_decide() {
        let no_lamp = LightEvidence { votes: None, ..evidence(45.0, 0.0, 0.0) };
        assert_eq!(choose_light(&no_lamp), LightDecision::NOTHING);
        let unknown = PlaneLight { interval_deg: 31.0, ..evidence(0.0, 0.0, 0.0).planes };
        let by_votes = LightEvidence { planes: unknown, ..evidence(0.0, 5.0, 0.02) };
        assert_eq!(basis(&by_votes), LightBasis::Votes);
        assert_eq!(
            basis(&LightEvidence { planes: unknown, ..evidence(0.0, 5.0, 0.019) }),
            LightBasis::Nothing
        );
        assert_eq!(basis(&evidence(25.0, 20.1, 0.5)), LightBasis::Planes, "an unusual light by votes");
        assert_eq!(basis(&evidence(25.0, 3.0, 0.009)), LightBasis::Planes, "too few votes agree");
    }

    #[test]
    fn planes_for_a_light_that_lacks_a_band_are_void() {
        let light = |blue: f64| {
            let usual = evidence(0.0, 0.0, 0.0);
            let direction = Some(Vec3::new(0.8, 0.6, blue).normalize());
            LightEvidence { planes: PlaneLight { direction, ..usual.planes }, votes: None, ..usual }
        };
        assert_eq!(basis(&light(0.02)), LightBasis::Nothing, "a street lamp's own glow");
        assert_eq!(basis(&light(0.09)), LightBasis::Planes, "tungsten without a white balance");
    }

    #[test]
    fn votes_for_the_unusual_color_of_a_body_are_void() {
        let of_body = |offset_deg: f64, share: f64| {
            let mut evidence = evidence(45.0, offset_deg, 0.1);
            if let Some(votes) = &mut evidence.votes {
                votes.result.body_share = share;
            }
            basis(&evidence)
        };
        assert_eq!(of_body(15.0, 0.11), LightBasis::Nothing, "a second body in spots");
        assert_eq!(of_body(15.0, 0.09), LightBasis::Votes);
        assert_eq!(of_body(8.0, 0.9), LightBasis::Votes, "white paper under a lamp near white");
    }

    #[test]
    fn the_decision_carries_what_the_winner_says() {
        let votes = choose_light(&evidence(25.0, 3.0, 0.1));
        assert_eq!(
            (votes.direction, votes.objects, votes.interval_deg),
            (Some(yellowish(3.0)), 7, Some(6.0))
        );
        let planes = choose_light(&evidence(3.0, 9.0, 0.1));
        assert_eq!((planes.direction, planes.objects), (Some(yellowish(3.0)), 4));
        assert!((planes.interval_deg.unwrap() - 3.0).abs() < 1e-6, "half of the disagreement of 6°");
        let ample = LightEvidence { support: 0.61, ..evidence(3.0, 9.0, 0.1) };
        assert_eq!(choose_light(&ample).interval_deg, Some(1.0));
    }

    #[test]
    fn without_votes_the_planes_decide_and_without_regions_there_is_no_light() {
        let planes_alone = LightEvidence { votes: None, ..evidence(0.0, 0.0, 0.0) };
        assert_eq!(basis(&planes_alone), LightBasis::Planes);
        let planes = PlaneLight { regions: 0, ..planes_alone.planes };
        assert_eq!(choose_light(&LightEvidence { planes, ..planes_alone }), LightDecision::NOTHING);
    }
}
