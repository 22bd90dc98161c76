//! Why a pixel, a hypothesis and a region are what they are: sentences, each with the step that the sentence is about.

use super::RegionNames;
use crate::describe::{Names, condense};
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::trace::{Stage, Trace, lineage, story};
use crate::view::ResultSnapshot;
use std::sync::Arc;

/// A sentence about a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Account {
    /// The step.
    pub step: usize,
    /// The stage of the step.
    pub stage: Stage,
    /// Number of joinings between the hypothesis of the sentence and the subject of the list.
    pub depth: usize,
    /// The sentence.
    pub text: String,
}

/// The answers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Why {
    /// The pixel that was asked about, and its history, newest first.
    pub pixel: Option<(PixelIndex, Vec<Account>)>,
    /// The hypothesis that was asked about, and its story.
    pub hypothesis: Option<(HypothesisId, Vec<Account>)>,
    /// The region of the result, and the hypotheses that made the region: first the hypothesis that became the region.
    pub region: Option<(RegionId, Vec<Account>)>,
}

/// The answers for a pixel, and for a hypothesis; without a hypothesis, for the region of the pixel.
pub fn why(
    shown: &ResultSnapshot,
    trace: &Arc<Trace>,
    names: &RegionNames,
    pixel: Option<PixelIndex>,
    hypothesis: Option<HypothesisId>,
) -> Why {
    let words = Names::of(trace);
    let stage = |step: usize| trace.stage_at(step).unwrap_or(Stage::Masks);
    let account = |step: usize, depth: usize, text: String| Account { step, stage: stage(step), depth, text };
    let image = &shown.picture.photo.image;
    let pixel = pixel.filter(|&pixel| pixel.index() < image.pixels.len()).map(|pixel| {
        let history = condense(&shown.analysis.pixel_history(trace, pixel));
        let place = shown.analysis.pixel_place(pixel);
        let at_full_resolution =
            place.map(|place| account(trace.len().saturating_sub(1), 0, words.pixel_place(&place)));
        let told = history.iter().rev().map(|condensed| {
            let text = words.history_entry(&condensed.last);
            let text = if condensed.times > 1 { format!("{text} ({} times)", condensed.times) } else { text };
            account(condensed.last.step, 0, text)
        });
        (pixel, at_full_resolution.into_iter().chain(told).collect())
    });
    let of_pixel = || {
        let (pixel, _) = pixel.as_ref()?;
        names.hypotheses_of(RegionId::from_label(shown.labels()[pixel.index()])?).next()
    };
    let asked = hypothesis.or_else(of_pixel);
    let hypothesis = asked.and_then(|asked| {
        let told = words.story(&story(trace, asked)?);
        Some((asked, told.into_iter().map(|(step, text)| account(step, 0, text)).collect()))
    });
    let region = asked.and_then(|asked| names.region_of(asked)).map(|region| {
        let told = lineage(trace, region);
        let told =
            told.iter().map(|ancestor| account(ancestor.step(), ancestor.depth, words.ancestor(ancestor)));
        (region, told.collect())
    });
    Why { pixel, hypothesis, region }
}
