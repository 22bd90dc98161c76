//! A pixel's surroundings in words, where no region explains it.

use super::super::events::failed_limits;
use crate::trace::{HighlightTerms, LocalFate, LocalStory, Ramp, RestoredBand, Unfit};

/// Smallest change of chromaticity that is told, degrees.
const LEAST_TURN_DEG: f32 = 0.05;

/// The sentence of the figures by which a pixel was judged.
pub(super) fn surroundings(story: &LocalStory) -> String {
    let LocalStory { mean, chroma, excess, noise, variation, odds, weight, limits, surface, .. } = story;
    let restored = story.restored.map_or_else(String::new, |RestoredBand { band, value, .. }| {
        let name = ["red", "green", "blue"][usize::from(band)];
        format!("its {name} alone is clipped, and is {value:.1} counts by the other two bands and the hue around; ")
    });
    let seen =
        format!("{restored}a {mean:.1} and c {chroma:.1} counts (mean and chromatic part under the light)");
    if story.fate == LocalFate::Clipped {
        return format!(
            "{seen}, but it is clipped: only the ring around its blob can tell what of it is highlight"
        );
    }
    let turned = if story.turn_deg >= LEAST_TURN_DEG {
        format!(
            "; the chromaticity of its body is moved by {:.1}\u{b0} towards that of the pixels around",
            story.turn_deg
        )
    } else {
        String::new()
    };
    let follows = match (*surface > 0.0, *weight > 0.0) {
        (true, true) => {
            format!(": surface is {surface:.1} counts, smooth but for the edges of the picture{turned}")
        }
        (true, false) => format!("; by the pixels beside it surface is {surface:.1} counts{turned}"),
        (false, _) => String::new(),
    };
    let Some([ratio, median]) = story.ratios.filter(|_| story.fate != LocalFate::Gray) else {
        let why = match story.fate {
            LocalFate::Gray if *chroma <= limits.chroma => {
                format!("it is too gray to have a hue (c at most {:.1})", limits.chroma)
            }
            LocalFate::Gray => format!("it is too dark to have a hue (a at most {:.1})", limits.mean),
            _ => "no pixel of the picture has its hue".to_owned(),
        };
        return format!(
            "{seen}: {why}, so that its own color does not tell how much of it is highlight{follows}"
        );
    };
    let around = format!("{seen}; around it its hue has \u{3ba} = a/c {ratio:.2} (median {median:.2})");
    let body = story.body;
    if story.fate == LocalFate::Faint {
        return format!(
            "{around}: \u{3ba}c = {body:.1} counts are body, and it is hardly paler: ms = {excess:.1} counts, noise up to {noise:.1}{follows}"
        );
    }
    let paler = format!("{around}: \u{3ba}c = {body:.1} counts are body, ms = {excess:.1} counts too many");
    if story.fate == LocalFate::Weak {
        return format!("{paler}, no more than its hue varies ({variation:.1}){follows}");
    }
    if story.fate == LocalFate::Pale {
        let Ramp { start, end } = limits.ratio;
        return format!(
            "{paler}, but its hue is nearly gray: \u{3ba} above {start} counts less, from {end} on nothing{follows}"
        );
    }
    let Some(HighlightTerms { chroma, independence, brightness, edges }) = story.terms else {
        return format!("{paler}, more than its hue varies ({variation:.1}){follows}");
    };
    let Ramp { start, end } = limits.odds;
    let evidence = format!(
        "log odds of a highlight {odds:+.1} (nothing counts up to {start}, all from {end} on), averaged around, of the picture {:+.1}; \
         here chroma {chroma:+.1}, independence of the body {independence:+.1}, brightness {brightness:+.1}, edges {edges:+.1}",
        story.picture_odds
    );
    if story.fate == LocalFate::Print {
        return format!("{paler}, but it looks like white print: {evidence}{follows}");
    }
    format!("{paler}; {evidence}; weight {weight:.2}{follows}")
}

/// The sentence why the plane of a region is not used for a pixel.
pub(super) fn unfit(region: &str, story: &Unfit) -> String {
    let why = if story.model_fits {
        format!(
            "{region} holds, but not here: this part of it is hardly anything but highlight, or clipped and surrounded by \
             other regions"
        )
    } else {
        let failed = failed_limits(&story.fit, &story.limits, story.has_plane);
        format!("{region} does not hold: {failed}")
    };
    let instead = match story.surface {
        None => "it is filled with the body around it".to_owned(),
        Some(surface) if surface > 0.0 => {
            format!("its surroundings give it {surface:.1} counts of surface, the rest is body")
        }
        Some(_) => "it keeps its color as body".to_owned(),
    };
    format!("{why}; {instead}")
}
