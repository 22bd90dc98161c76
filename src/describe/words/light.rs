//! Which light is used, in words.

use super::{count, direction, percent};
use crate::trace::{Ambient, LightBasis, LightChosen, LightLimits, TwoLightTest, VoteResult, VotesCast};

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

/// Whether the highlights alone told the light.
pub(super) fn whose_light(outshone: &TwoLightTest) -> String {
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

/// What the matte lines tell of ambient light.
pub(super) fn ambient_sought(ambient: &Ambient) -> String {
    let counts = |counts: [f64; 3]| counts.map(|band| format!("{band:.1}")).join(", ");
    let reason = ambient.verdict.reason();
    let Some(meeting) = ambient.meeting else {
        return match ambient.subtracted {
            Some(given) => format!("ambient light of {} counts is subtracted: {reason}", counts(given)),
            None => format!("no ambient light is subtracted: {reason}"),
        };
    };
    let what = if ambient.subtracted.is_some() { "ambient light is" } else { "no ambient light is" };
    let [miss, of_black] = meeting.miss_counts;
    format!(
        "{what} subtracted: {reason}; {} pass {} \u{b1} {} counts by {miss:.1} counts (rms) and black by {of_black:.1}, \
         \u{3c7}\u{b2} {:.1} (significant above 16.3)",
        count(meeting.lines as u64, "matte line"),
        counts(meeting.counts),
        counts(meeting.sd_counts),
        meeting.chi_square
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

/// A percentage with one decimal.
pub(super) fn tenths(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}
