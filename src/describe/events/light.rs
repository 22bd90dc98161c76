//! The light (section 5.4.1 and its refinements).

use super::{Describe, LineObjects, nothing};
use crate::describe::Names;
use crate::describe::names::{count, direction, percent, tenths};
use crate::trace::{
    Contribution, IlluminantEstimated, IlluminantGiven, LightBasis, LightChosen, LightLimits, TwoLightTest,
    VoteResult, VotesCast,
};
use serde_json::{Value, json};

impl Describe for IlluminantEstimated {
    fn sentence(&self, _names: &Names) -> String {
        let Self { direction: light, contributions, outshone } = self;
        let weighted = contributions.iter().filter(|contribution| contribution.weight > 0.0);
        let worst = weighted.clone().map(|contribution| contribution.residual_deg).fold(0.0, f64::max);
        let from = match weighted.count() {
            0 => String::new(),
            n => format!(" from {}, at most {worst:.1}\u{b0} off", count(n as u64, "constraint")),
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
                "small highlights do not vote: fewer than {} pixels have anything to say of the light",
                self.least_voters
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
        let Self { basis, support, limits, .. } = self;
        let known = self.direction.map_or_else(String::new, |light| format!(" {}", direction(light)));
        let covered =
            format!("regions that hold and show highlights cover {} of the lit pixels", percent(*support));
        let enough = percent(limits.support);
        match (basis, &self.votes) {
            (LightBasis::Planes, _) if *support >= limits.support => {
                format!("the light{known} is that of the planes: {covered}, {enough} suffice")
            }
            (LightBasis::Planes, votes) => format!(
                "the light{known} is that of the planes: {covered}, less than {enough}, but {}",
                no_use(votes.as_ref(), limits)
            ),
            (LightBasis::Votes, Some(votes)) => format!(
                "the light{known} is that of the votes: {covered}, planes need {enough}; {} agree with {} of the votes (at least {}), \
                 {} (at most {})",
                voters(votes),
                tenths(votes.share),
                tenths(limits.share),
                white(votes.offsets_deg),
                farthest(limits)
            ),
            (_, votes) if self.planes.is_none() => {
                format!(
                    "no light is known: no region shows a highlight, and {}",
                    no_use(votes.as_ref(), limits)
                )
            }
            (_, votes) => format!(
                "no light is known: {covered}, less than {}, and {}",
                percent(limits.hardly),
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
            }),
            json!({
                "support": limits.support,
                "hardly_supported": limits.hardly,
                "share": limits.share,
                "offsets_deg": limits.offsets_deg,
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
            limits: LightLimits { support: 0.3, hardly: 0.05, share: 0.02, offsets_deg: [20.0, 8.0] },
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
        count(pixels, "pixel"),
        by_highlights.sqrt(),
        by_all.sqrt(),
        better.sqrt(),
        most.sqrt()
    )
}

/// Why votes do not decide.
fn no_use(votes: Option<&VoteResult>, limits: &LightLimits) -> String {
    match votes {
        None => "too few pixels of small highlights vote".to_owned(),
        Some(votes) if votes.share < limits.share => format!(
            "small highlights do not agree: {} of their votes are for one light, at least {} are needed",
            tenths(votes.share),
            tenths(limits.share)
        ),
        Some(votes) => format!(
            "small highlights vote for an unusual light, {} (at most {})",
            white(votes.offsets_deg),
            farthest(limits)
        ),
    }
}

fn voters(elected: &VoteResult) -> String {
    format!("{} of {}", count(elected.voters, "pixel"), count(elected.blobs, "small highlight"))
}

fn farthest(limits: &LightLimits) -> String {
    let [yellow, magenta] = limits.offsets_deg;
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
    VoteResult { direction: [0.6, 0.0, 0.8], voters: 300, blobs: 5, share: 0.25, offsets_deg: [2.0, -1.0] }
}
