//! A pixel's surroundings in words, where no region explains it.

use super::super::events::failed_limits;
use crate::raster::RegionId;
use crate::trace::{LocalFate, LocalStory, Unfit};

/// The sentence of the figures by which a pixel was judged.
pub(super) fn surroundings(story: &LocalStory) -> String {
    let LocalStory { mean, chroma, excess, noise, variation, texture, weight, limits, .. } = story;
    let seen = format!("a {mean:.1} and c {chroma:.1} counts (mean and chromatic part under the light)");
    if story.fate == LocalFate::Clipped {
        return format!(
            "{seen}, but it is clipped: only the ring around its blob can tell what of it is highlight"
        );
    }
    let Some([ratio, median]) = story.ratios.filter(|_| story.fate != LocalFate::Gray) else {
        let why = match story.fate {
            LocalFate::Gray if *chroma <= limits.chroma => {
                format!("it is too gray to have a hue (c at most {:.1})", limits.chroma)
            }
            LocalFate::Gray => format!("it is too dark to have a hue (a at most {:.1})", limits.mean),
            _ => "nothing around it has its hue".to_owned(),
        };
        return format!("{seen}: {why}, so that nothing tells how much of it is highlight");
    };
    let around = format!("{seen}; around it its hue has \u{3ba} = a/c {ratio:.2} (median {median:.2})");
    let body = story.body;
    if story.fate == LocalFate::Faint {
        return format!(
            "{around}: \u{3ba}c = {body:.1} counts are body, and it is hardly paler: ms = {excess:.1} counts, noise up to {noise:.1}"
        );
    }
    let paler = format!("{around}: \u{3ba}c = {body:.1} counts are body, ms = {excess:.1} counts too many");
    if story.fate == LocalFate::Weak {
        return format!("{paler}, no more than its hue varies ({variation:.1})");
    }
    let above = if excess > variation {
        format!("more than noise ({noise:.1}) and than its hue varies ({variation:.1})")
    } else {
        format!("more than noise ({noise:.1}), less than its hue varies ({variation:.1})")
    };
    let [all, none] = limits.texture.ends();
    let fate = match story.fate {
        LocalFate::Texture => {
            format!(
                "but it varies against the body like texture, t {texture:.2}: from {none:.2} on nothing counts"
            )
        }
        LocalFate::Thin => "but no square of 3 \u{d7} 3 pixels like it holds it".to_owned(),
        LocalFate::Small => format!("but its blob has fewer than {} pixels", story.least_px),
        LocalFate::NoHighlight => "but its blob is no highlight".to_owned(),
        _ => {
            let would = if story.doubted { "would be" } else { "is" };
            format!(
                "texture t {texture:.2} (all counts up to {all:.2}, nothing from {none:.2} on), weight {weight:.2}: surface \
                 {would} {:.1} counts",
                story.surface()
            )
        }
    };
    format!("{paler}, {above}; {fate}")
}

/// The sentence why the plane of a region is not used for a pixel.
pub(super) fn unfit(region: RegionId, story: &Unfit) -> String {
    let why = if story.model_fits {
        format!(
            "region {region} holds, but not here: this part of it is hardly anything but highlight, or clipped and surrounded by \
             other regions"
        )
    } else {
        let failed = failed_limits(story.fit, &story.limits, story.has_plane);
        format!("region {region} does not hold: {failed}")
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
