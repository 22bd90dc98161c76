//! Where the model does not hold, in words.

use super::light::tenths;
use super::{Names, count, percent};
use crate::trace::{
    BlobJudged, FitLimits, LocalBegan, LocalDecision, LocalFate, LocalStart, LocalStory, PlausibilityTested,
    RejectReason, RepairTried, RepairVerdict, Unfit, VectorsFitted,
};

impl Names {
    /// A step of the local split.
    pub(super) fn local(&self, decision: &LocalDecision) -> String {
        match decision {
            LocalDecision::Began(began) => local_began(began),
            LocalDecision::Blobs { found, small, small_pixels, least } => format!(
                "{}, of which {small} have fewer than {least} pixels ({small_pixels} in all) and are none",
                count(*found, "candidate highlight")
            ),
            LocalDecision::Blob(judged) => self.blob(judged),
            LocalDecision::Plausibility(tested) => plausibility(tested),
            LocalDecision::Repair(tried) => self.repair(tried),
        }
    }

    fn blob(&self, judged: &BlobJudged) -> String {
        let BlobJudged { pixel, pixels, clipped, strong, calm, core, kept, .. } = *judged;
        let blob = format!("the candidate highlight of {} at {}", count(pixels, "pixel"), self.pixel(pixel));
        match (kept, core, clipped) {
            (true, 0, _) => {
                format!("{blob} passes: it has no strong core, but {} in it", count(clipped, "clipped pixel"))
            }
            (true, ..) => {
                format!("{blob} passes: {core} of them are a strong core, paler than their hue varies")
            }
            _ if strong == 0 => {
                format!("{blob} fails: no pixel of it is paler than its hue varies")
            }
            _ if calm == 0 => format!(
                "{blob} fails: {strong} of them are paler than their hue varies, but all these look like texture"
            ),
            _ => format!(
                "{blob} fails: {calm} of them are paler than their hue varies and no texture, but nowhere do 3 \u{d7} 3 \
                 of these lie together"
            ),
        }
    }

    fn repair(&self, tried: &RepairTried) -> String {
        let RepairTried { pixel, pixels, ring: [share, least], rise: [inner, outer], verdict, .. } = *tried;
        let blob = format!("the blob of {} at {}", count(pixels, "clipped pixel"), self.pixel(pixel));
        let [share, least] = [share, least].map(|share| percent(f64::from(share)));
        match verdict {
            RepairVerdict::Filled => format!(
                "{blob} is filled with the body around it: {share} of its ring of 2 px are highlight (at least {least}), {inner:.1} \
                 counts next to it, {outer:.1} farther out"
            ),
            RepairVerdict::TooLarge => format!("{blob} is left: it is as large as a window or the sky"),
            RepairVerdict::NoRing => format!("{blob} is left: no ring of unclipped pixels lies around it"),
            RepairVerdict::NoHighlight => format!(
                "{blob} is left: {share} of its ring of 2 px are highlight, at least {least} are needed"
            ),
            RepairVerdict::NoRise => format!(
                "{blob} is left: the highlight does not rise towards it, {inner:.1} counts next to it, {outer:.1} farther out"
            ),
        }
    }
}

fn local_began(began: &LocalBegan) -> String {
    let LocalBegan { start, pixels, lit, least, .. } = began;
    let outside = format!("{pixels} of {} lie outside of what holds", count(*lit, "lit pixel"));
    match start {
        LocalStart::Begins => {
            format!("{outside}: they are split by how much paler they are than their hue around them")
        }
        LocalStart::Off if *pixels == 0 => outside,
        LocalStart::Off => format!("{outside}: they keep their colors, as the local split is off"),
        LocalStart::Few => format!("{outside}, fewer than {least}: they keep their colors"),
        LocalStart::NoLight => format!("{outside}: they keep their colors, as the light is not known"),
    }
}

/// What speaks for highlights, or the doubt that ended it.
fn plausibility(tested: &PlausibilityTested) -> String {
    let PlausibilityTested { share, surface, outshining, limits, reject_reason } = tested;
    let light = share.map(|share| {
        format!("{} of the votes are for the light (at least {})", tenths(share), tenths(limits.share))
    });
    let amount = surface.map(|share| {
        format!(
            "{} of the light there would be surface reflection (at most {})",
            tenths(share),
            percent(limits.surface)
        )
    });
    let bright = outshining.map(|(share, strong)| {
        format!(
            "{} of {} outshine the body under them (at most {})",
            percent(share),
            count(strong, "strong highlight pixel"),
            percent(limits.outshining)
        )
    });
    let failed = match reject_reason {
        None => {
            let found: Vec<String> = [light, amount, bright].into_iter().flatten().collect();
            return format!("highlights are believed: {}", found.join("; "));
        }
        Some(RejectReason::NoVote) => light,
        Some(RejectReason::TooMuch) => amount,
        Some(RejectReason::Outshining) => bright,
    };
    format!("no highlight is believed, nothing is split locally: {}", failed.unwrap_or_default())
}

/// What a pixel was judged by.
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
    let [all, none] = limits.texture;
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

/// Whether a region holds, by its figures.
pub(super) fn verdict(fitted: &VectorsFitted) -> String {
    let VectorsFitted { rms_counts, texture, texture_slope, limits, .. } = fitted;
    let has_plane = fitted.surface.is_some();
    let failed = failed_limits([*rms_counts, *texture, *texture_slope], limits, has_plane);
    match (fitted.holds, failed.as_str()) {
        (false, _) => format!("it does not hold and its plane is not used: {failed}"),
        (true, "") => {
            let texture = if has_plane {
                format!(
                    ", texture correlation {texture:.2} (suspect above {}), slope {texture_slope:.2} (above {})",
                    limits.texture, limits.texture_slope
                )
            } else {
                String::new()
            };
            format!("it holds: {}{texture}", distance(*rms_counts, limits, has_plane))
        }
        (true, _) => format!("whether it holds is not asked ({failed})"),
    }
}

/// The limits that a region's figures exceed; empty where they do not.
fn failed_limits([rms, texture, slope]: [f64; 3], limits: &FitLimits, has_plane: bool) -> String {
    let far = (rms > limits.rms_counts).then(|| distance(rms, limits, has_plane));
    let textured = (texture > limits.texture && slope > limits.texture_slope).then(|| {
        format!(
            "body and surface vary against each other like a print, correlation {texture:.2} (at most {}), slope {slope:.2} (at \
             most {})",
            limits.texture, limits.texture_slope
        )
    });
    far.into_iter().chain(textured).collect::<Vec<_>>().join(", and ")
}

/// `2.2 counts rms from its plane (at most 1.9 = 1.5 σ)`
fn distance(rms: f64, limits: &FitLimits, has_plane: bool) -> String {
    let what = if has_plane { "plane" } else { "line" };
    let FitLimits { rms_counts, rms_sigmas, .. } = limits;
    format!("{rms:.1} counts rms from its {what} (at most {rms_counts:.1} = {rms_sigmas} \u{3c3})")
}

/// Why a region's plane is not used for a pixel, and what it has instead.
pub(super) fn unfit(number: u16, story: &Unfit) -> String {
    let why = if story.region_holds {
        format!(
            "region {number} holds, but not here: this part of it is hardly anything but highlight, or clipped and surrounded by \
             other regions"
        )
    } else {
        let failed = failed_limits(story.fit, &story.limits, story.has_plane);
        format!("region {number} does not hold: {failed}")
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
