//! The light (section 5.4.1 and its refinements).

use super::{Describe, LineObjects, nothing};
use crate::describe::names::{direction, signed, tenths};
use crate::describe::{Names, counted};
use crate::trace::{
    AveragedDirection, Contribution, HighlightsAveraged, IlluminantEstimated, IlluminantGiven, LampLimits,
    LampOfRegion, LampsCompared, LightBasis, LightChosen, LightLimits, LightOdds, TwoLightTest, VoteResult,
    VotesCast,
};
use serde_json::{Value, json};

impl Describe for IlluminantEstimated {
    fn sentence(&self, _names: &Names) -> String {
        let Self { direction: light, contributions, outshone } = self;
        let weighted = contributions.iter().filter(|contribution| contribution.weight > 0.0);
        let worst = weighted.clone().map(|contribution| contribution.residual_deg).fold(0.0, f64::max);
        let from = match weighted.count() {
            0 => String::new(),
            n => format!(" from {}, at most {worst:.1}\u{b0} off", counted(n, "constraint")),
        };
        let whose = outshone.as_ref().map_or_else(String::new, whose_light);
        format!("the light is {}{from}{whose}", direction(*light))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let contribution = |c: &Contribution| json!({"region": c.hypothesis, "residual_deg": c.residual_deg, "weight": c.weight});
        let contributions: Vec<Value> = self.contributions.iter().map(contribution).collect();
        LineObjects::new(
            nothing(),
            json!({
                "given": false,
                "direction": self.direction,
                "contributions": contributions,
                "outshone": self.outshone.map(outshone),
            }),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let outshone = TwoLightTest {
            pixels: 40,
            by_all: 9.0,
            by_highlights: Some(1.0),
            limits: [4.0, 2.0],
            taken: true,
        };
        let contribution = Contribution { hypothesis: super::hypothesis(1), residual_deg: 0.25, weight: 2.0 };
        Self { direction: [0.6, 0.0, 0.8], contributions: vec![contribution], outshone: Some(outshone) }
    }
}

impl Describe for HighlightsAveraged {
    fn sentence(&self, names: &Names) -> String {
        let of = |c: &AveragedDirection| {
            let name = names.hypothesis(c.hypothesis);
            format!("{} of {name} ({:.1}\u{b0} off)", direction(c.direction), c.angle_deg)
        };
        let parts: Vec<String> = self.contributions.iter().map(of).collect();
        format!(
            "the light is {}, the average of {}: {}",
            direction(self.direction),
            counted(parts.len(), "highlight direction"),
            parts.join(", ")
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let contribution = |c: &AveragedDirection| json!({"region": c.hypothesis, "direction": c.direction, "angle_deg": c.angle_deg});
        let contributions: Vec<Value> = self.contributions.iter().map(contribution).collect();
        let values = json!({"given": false, "direction": self.direction, "averaged": true, "contributions": contributions});
        LineObjects::new(nothing(), values, nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        let direction = [0.6, 0.0, 0.8];
        let contribution = AveragedDirection { hypothesis: super::hypothesis(1), direction, angle_deg: 0.0 };
        Self { direction, contributions: vec![contribution] }
    }
}

impl Describe for IlluminantGiven {
    fn sentence(&self, _names: &Names) -> String {
        format!("the light is given: {}", direction(self.direction))
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(nothing(), json!({"given": true, "direction": self.direction}), nothing())
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { direction: [0.6, 0.0, 0.8] }
    }
}

impl Describe for VotesCast {
    fn sentence(&self, _names: &Names) -> String {
        let Some(elected) = self.elected else {
            return format!(
                "small highlights do not vote: fewer than {} have anything to say of the light",
                counted(self.least_voters, "pixel")
            );
        };
        format!(
            "{} vote for the light {}: it has {} of the votes and lies {}",
            voters(&elected),
            direction(elected.direction),
            tenths(elected.share),
            white(elected.offsets_deg)
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"elected": self.elected.as_ref().map(elected)}),
            json!({"voters": self.least_voters}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { elected: Some(example_votes()), least_voters: 60 }
    }
}

impl Describe for LightChosen {
    fn sentence(&self, _names: &Names) -> String {
        let Self { basis, limits, odds, .. } = self;
        let known = self.direction.map_or_else(String::new, |light| format!(" {}", direction(light)));
        match (basis, &self.votes) {
            (LightBasis::Planes, votes) => {
                let reason = odds.map_or_else(
                    || no_use(votes.as_ref(), limits),
                    |odds| format!("the votes are not the better evidence, {}", odds_in_words(&odds, limits)),
                );
                format!("the light{known} is that of the planes: {reason}")
            }
            (LightBasis::Votes, Some(votes)) => {
                let reason = odds.map_or_else(
                    || no_light_by_planes(self.planes.is_some(), limits),
                    |odds| format!("the votes are the better evidence, {}", odds_in_words(&odds, limits)),
                );
                format!(
                    "the light{known} is that of the votes: {reason}; {} agree with {} of the votes, {} (at most {})",
                    voters(votes),
                    tenths(votes.share),
                    white(votes.offsets_deg),
                    farthest(limits.offsets_deg)
                )
            }
            (_, votes) => format!(
                "no light is known: {}, and {}",
                no_light_by_planes(self.planes.is_some(), limits),
                no_use(votes.as_ref(), limits)
            ),
        }
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let limits = self.limits;
        let planes =
            self.planes.map(|(direction, objects)| json!({"direction": direction, "objects": objects}));
        LineObjects::new(
            nothing(),
            json!({
                "basis": self.basis.name(),
                "direction": self.direction,
                "support": self.support,
                "planes": planes,
                "votes": self.votes.as_ref().map(elected),
                "log_odds": self.odds.map(|odds| json!({
                    "unusualness": odds.unusualness,
                    "intervals": odds.intervals,
                    "shares": odds.shares,
                    "sum": odds.sum(),
                })),
            }),
            json!({
                "log_odds": limits.log_odds,
                "share": limits.share,
                "share_without_planes": limits.share_without_planes,
                "offsets_deg": limits.offsets_deg,
                "body_share": limits.body_share,
                "body_offset_deg": limits.body_offset_deg,
                "planes_offsets_deg": limits.planes_offsets_deg,
                "planes_interval_deg": limits.planes_interval_deg,
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            basis: LightBasis::Votes,
            direction: Some([0.6, 0.0, 0.8]),
            planes: Some(([0.0, 0.6, 0.8], 3)),
            votes: Some(example_votes()),
            support: 0.125,
            odds: Some(LightOdds { unusualness: 0.5, intervals: 0.25, shares: 0.125 }),
            limits: crate::segment::LIGHT_LIMITS,
        }
    }
}

impl Describe for LampsCompared {
    fn sentence(&self, names: &Names) -> String {
        let Self { second, contradicting, agreeing, limits, .. } = self;
        let Some(second) = second else {
            return format!(
                "one lamp: the highlights of {} contradict its color, but too few of them agree on a second lamp (at least {} and {:.0} %, or {})",
                counted(*contradicting, "region"),
                limits.regions,
                100.0 * limits.share,
                limits.ample_regions
            );
        };
        let lit = self.regions.iter().filter(|region| region.is_second());
        let lit: Vec<String> = lit.map(|region| names.hypothesis(region.hypothesis)).collect();
        if self.given {
            let lit = if lit.is_empty() { "no region".to_owned() } else { lit.join(", ") };
            return format!(
                "the second lamp was given, {}, beside {}: of {} with highlights those agree better with the second lamp that it lights, {lit}",
                direction(*second),
                direction(self.first),
                counted(self.regions.len(), "region"),
            );
        }
        let error =
            self.interval_deg.map_or_else(String::new, |degrees| format!(" \u{b1} {degrees:.1}\u{b0}"));
        format!(
            "a second lamp, {}{error}, beside {}: the highlights of {} contradict the first, and {agreeing} of these agree with the second, \
             which lights {}",
            direction(*second),
            direction(self.first),
            counted(*contradicting, "region"),
            lit.join(", ")
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let region = |region: &LampOfRegion| json!({"region": region.hypothesis, "misfits": region.misfits, "second": region.is_second()});
        let LampLimits { contradicts, agrees, regions, share, ample_regions, merit, angle_deg, offsets_deg } =
            self.limits;
        LineObjects::new(
            nothing(),
            json!({
                "first": self.first,
                "second": self.second,
                "given": self.given,
                "interval_deg": self.interval_deg,
                "contradicting": self.contradicting,
                "agreeing": self.agreeing,
                "regions": self.regions.iter().map(region).collect::<Vec<Value>>(),
            }),
            json!({
                "contradicts": contradicts,
                "agrees": agrees,
                "regions": regions,
                "share": share,
                "ample_regions": ample_regions,
                "merit": merit,
                "angle_deg": angle_deg,
                "offsets_deg": offsets_deg,
            }),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let region = |number, misfits| LampOfRegion { hypothesis: super::hypothesis(number), misfits };
        Self {
            first: [0.6, 0.0, 0.8],
            second: Some([0.8, 0.0, 0.6]),
            given: false,
            interval_deg: Some(0.5),
            contradicting: 2,
            agreeing: 2,
            regions: vec![region(1, [Some(0.25), Some(4.0)]), region(2, [Some(3.0), Some(0.5)])],
            limits: crate::segment::LAMP_LIMITS,
        }
    }
}

/// Whether the light is that of the highlights alone.
fn whose_light(outshone: &TwoLightTest) -> String {
    let TwoLightTest { pixels, by_all, by_highlights, limits: [most, better], taken } = *outshone;
    let Some(by_highlights) = by_highlights else { return String::new() };
    let (alone, relation) = if taken { ("of the highlights alone", "") } else { ("of all pixels", "not ") };
    format!(
        "; it is that {alone}: from the planes of the highlights {} that the light outshines lie {:.1} \u{3c3} (rms), from those of \
         all pixels off the matte lines {:.1} \u{3c3}, {relation}{:.1} times better and at most {:.1} \u{3c3}",
        counted(pixels, "pixel"),
        by_highlights.sqrt(),
        by_all.sqrt(),
        better.sqrt(),
        most.sqrt()
    )
}

/// The odds that decided between planes and votes.
fn odds_in_words(odds: &LightOdds, limits: &LightLimits) -> String {
    format!(
        "by the color of both lights {}, by their intervals {}, by their shares of the votes {}: log odds of {} for the votes, \
         more than {:.2} are needed",
        signed(odds.unusualness, 2),
        signed(odds.intervals, 2),
        signed(odds.shares, 2),
        signed(odds.sum(), 2),
        limits.log_odds
    )
}

/// Why the planes' light does not decide.
fn no_light_by_planes(any: bool, limits: &LightLimits) -> String {
    if any {
        format!(
            "the planes give a light that no lamp has (farther from white than {}) or that is not known within {:.0}\u{b0}",
            farthest(limits.planes_offsets_deg),
            limits.planes_interval_deg
        )
    } else {
        "no region shows a highlight".to_owned()
    }
}

/// Why votes do not decide.
fn no_use(votes: Option<&VoteResult>, limits: &LightLimits) -> String {
    let usual =
        |votes: &VoteResult| (0..2).all(|axis| votes.offsets_deg[axis].abs() <= limits.offsets_deg[axis]);
    match votes {
        None => "too few pixels of small highlights vote".to_owned(),
        Some(votes) if usual(votes) && votes.has_color_of_a_body(limits) => format!(
            "small highlights vote for a light of the color of a body, {}: {} of the lit pixels have that color (at most {} \
             farther than {:.0}\u{b0} from white)",
            white(votes.offsets_deg),
            tenths(votes.body_share),
            tenths(limits.body_share),
            limits.body_offset_deg
        ),
        Some(votes) if usual(votes) => format!(
            "small highlights do not agree: {} of their votes are for one light, at least {} are needed",
            tenths(votes.share),
            tenths(limits.share_without_planes)
        ),
        Some(votes) => format!(
            "small highlights vote for an unusual light, {} (at most {})",
            white(votes.offsets_deg),
            farthest(limits.offsets_deg)
        ),
    }
}

fn voters(elected: &VoteResult) -> String {
    format!("{} of {}", counted(elected.voters, "pixel"), counted(elected.blobs, "small highlight"))
}

fn farthest([yellow, magenta]: [f64; 2]) -> String {
    format!("{yellow:.0}\u{b0} and {magenta:.0}\u{b0}")
}

/// `2.1° to yellow and 0.4° to green of white`
fn white([yellow, magenta]: [f64; 2]) -> String {
    let along = if yellow < 0.0 { "blue" } else { "yellow" };
    let across = if magenta < 0.0 { "green" } else { "magenta" };
    format!("{:.1}\u{b0} to {along} and {:.1}\u{b0} to {across} of white", yellow.abs(), magenta.abs())
}

fn elected(elected: &VoteResult) -> Value {
    json!({
        "direction": elected.direction,
        "voters": elected.voters,
        "blobs": elected.blobs,
        "share": elected.share,
        "offsets_deg": elected.offsets_deg,
        "body_share": elected.body_share,
    })
}

/// How well two lights explain the outshone pixels.
fn outshone(outshone: TwoLightTest) -> Value {
    json!({
        "pixels": outshone.pixels,
        "by_all": outshone.by_all,
        "by_highlights": outshone.by_highlights,
        "limits": outshone.limits,
        "taken": outshone.taken,
    })
}

#[cfg(test)]
fn example_votes() -> VoteResult {
    VoteResult {
        direction: [0.6, 0.0, 0.8],
        voters: 300,
        blobs: 5,
        share: 0.25,
        offsets_deg: [2.0, -1.0],
        body_share: 0.0625,
    }
}
