//! Which light is used, in words.

use super::{count, direction, percent};
use crate::trace::{Elected, LightBasis, LightChosen, LightLimits, VotesCast};

/// What small highlights say.
pub(super) fn votes_cast(votes: &VotesCast) -> String {
    let Some(elected) = votes.elected else {
        return format!(
            "small highlights do not vote: fewer than {} pixels have anything to say of the light",
            votes.least_voters
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

/// Which light is used, and on what it rests.
pub(super) fn light_chosen(chosen: &LightChosen) -> String {
    let LightChosen { basis, support, limits, .. } = chosen;
    let known = chosen.direction.map_or_else(String::new, |light| format!(" {}", direction(light)));
    let covered =
        format!("regions that hold and show highlights cover {} of the lit pixels", percent(*support));
    let enough = percent(limits.support);
    match (basis, &chosen.votes) {
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
        (_, votes) if chosen.planes.is_none() => {
            format!("no light is known: no region shows a highlight, and {}", no_use(votes.as_ref(), limits))
        }
        (_, votes) => format!(
            "no light is known: {covered}, less than {}, and {}",
            percent(limits.hardly),
            no_use(votes.as_ref(), limits)
        ),
    }
}

/// Why votes do not decide.
fn no_use(votes: Option<&Elected>, limits: &LightLimits) -> String {
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

fn voters(elected: &Elected) -> String {
    format!("{} of {}", count(elected.voters, "pixel"), count(elected.blobs, "small highlight"))
}

fn farthest(limits: &LightLimits) -> String {
    let [yellow, magenta] = limits.offsets_deg;
    format!("{yellow:.0}\u{b0} and {magenta:.0}\u{b0}")
}

/// `2.1° to yellow and 0.4° to green of white`
pub(super) fn white([yellow, magenta]: [f64; 2]) -> String {
    let along = if yellow < 0.0 { "blue" } else { "yellow" };
    let across = if magenta < 0.0 { "green" } else { "magenta" };
    format!("{:.1}\u{b0} to {along} and {:.1}\u{b0} to {across} of white", yellow.abs(), magenta.abs())
}

/// A percentage with one decimal.
pub(super) fn tenths(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}
