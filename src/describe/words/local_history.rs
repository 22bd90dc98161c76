//! A pixel's surroundings in words, where no region explains it.

use super::super::events::failed_limits;
use super::{signed, typographic};
use crate::trace::{HighlightTerms, LocalFate, LocalStory, Ramp, RestoredBand, Unfit};

/// Smallest change of chromaticity that is told, degrees.
const LEAST_TURN_DEG: f32 = 0.05;

/// The sentence of the figures by which a pixel was judged.
pub(super) fn surroundings(story: &LocalStory) -> String {
    let LocalStory { excess, noise, variation, weight, limits, fate, body, .. } = story;
    let seen = seen(story);
    if *fate == LocalFate::Clipped {
        return format!(
            "{seen}, but it is clipped: only the ring around its blob can tell what of it is highlight"
        );
    }
    let follows = follows(story);
    let Some([ratio, median]) = story.ratios.filter(|_| *fate != LocalFate::Gray) else {
        return format!(
            "{seen}: {}, so that its own color does not tell how much of it is highlight{follows}",
            without_hue(story)
        );
    };
    let around = format!("{seen}; around it its hue has \u{3ba} = a/c {ratio:.2} (median {median:.2})");
    if *fate == LocalFate::Faint {
        return format!(
            "{around}: \u{3ba}c = {body:.1} counts are body, and it is hardly paler: ms = {excess:.1} counts, noise up to {noise:.1}{follows}"
        );
    }
    let paler = format!("{around}: \u{3ba}c = {body:.1} counts are body, ms = {excess:.1} counts too many");
    if *fate == LocalFate::Weak {
        return format!("{paler}, no more than its hue varies ({variation:.1}){follows}");
    }
    if *fate == LocalFate::Pale {
        let Ramp { start, end } = limits.ratio;
        return format!(
            "{paler}, but its hue is nearly gray: \u{3ba} above {start} counts less, from {end} on nothing{follows}"
        );
    }
    let Some(terms) = &story.terms else {
        return format!("{paler}, more than its hue varies ({variation:.1}){follows}");
    };
    let evidence = evidence(story, terms);
    if *fate == LocalFate::Print {
        return format!("{paler}, but it looks like white print: {evidence}{follows}");
    }
    format!("{paler}; {evidence}; weight {weight:.2}{follows}")
}

/// The pixel's mean and chromatic part, and how its clipped band was restored.
fn seen(story: &LocalStory) -> String {
    let LocalStory { mean, chroma, .. } = story;
    let restored = story.restored.map_or_else(String::new, |RestoredBand { band, value, .. }| {
        let name = ["red", "green", "blue"][usize::from(band)];
        format!("its {name} alone is clipped, and is {value:.1} counts by the other two bands and the hue around; ")
    });
    format!("{restored}a {mean:.1} and c {chroma:.1} counts (mean and chromatic part under the light)")
}

/// What follows for the pixel: its surface reflection, and how its chromaticity is moved; empty without surface reflection.
fn follows(story: &LocalStory) -> String {
    let LocalStory { surface, weight, turn_deg, .. } = story;
    let has_surface = *surface > 0.0;
    if !has_surface {
        return String::new();
    }
    let turned = if *turn_deg >= LEAST_TURN_DEG {
        format!(
            "; the chromaticity of its body is moved by {turn_deg:.1}\u{b0} towards that of the pixels around"
        )
    } else {
        String::new()
    };
    if *weight > 0.0 {
        format!(": surface is {surface:.1} counts, smooth but for the edges of the picture{turned}")
    } else {
        format!("; by the pixels beside it surface is {surface:.1} counts{turned}")
    }
}

/// Why no ratio of mean and chromatic part is known for the pixel's hue.
fn without_hue(story: &LocalStory) -> String {
    let limits = &story.limits;
    match story.fate {
        LocalFate::Gray if story.chroma <= limits.chroma => {
            format!("it is too gray to have a hue (c at most {:.1})", limits.chroma)
        }
        LocalFate::Gray => format!("it is too dark to have a hue (a at most {:.1})", limits.mean),
        _ => "no pixel of the picture has its hue".to_owned(),
    }
}

/// The evidence for a highlight: the log odds, and the terms here.
fn evidence(story: &LocalStory, terms: &HighlightTerms) -> String {
    let Ramp { start, end } = story.limits.odds;
    let HighlightTerms { chroma, independence, brightness, edges } = terms;
    let [start, end] = [start, end].map(|odds| typographic(&odds.to_string()));
    let [odds, of_picture] = [story.odds, story.picture_odds].map(|odds| signed(odds, 1));
    let [chroma, independence, brightness, edges] =
        [chroma, independence, brightness, edges].map(|&odds| signed(odds, 1));
    format!(
        "log odds of a highlight {odds} (nothing counts up to {start}, all from {end} on), averaged around, of the picture {of_picture}; \
         here chroma {chroma}, independence of the body {independence}, brightness {brightness}, edges {edges}"
    )
}

/// The sentence why the plane of a region is not used for a pixel.
pub(super) fn unfit(region: &str, story: &Unfit) -> String {
    let why = if story.model_fits {
        format!(
            "{region} holds, but not here: this part of it is hardly anything but highlight, clipped and surrounded by \
             other regions, or a highlight under which the body is much weaker than beside it"
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
