//! Why a pixel, a hypothesis and a region are what they are: sentences, each with the step that it tells of.

use super::RegionNames;
use crate::describe::{Names, condense};
use crate::trace::{Stage, Trace, lineage, pixel_history, story};
use crate::view::ResultSnapshot;
use std::sync::Arc;

/// A sentence about a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Account {
    /// The step.
    pub step: usize,
    /// Its stage.
    pub stage: Stage,
    /// How many joinings lie between it and what the list is about.
    pub depth: usize,
    /// What happened.
    pub text: String,
}

/// The answers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Why {
    /// The pixel that was asked about, and its history, newest first.
    pub pixel: Option<(u32, Vec<Account>)>,
    /// The hypothesis that was asked about, by its number of birth, and its story.
    pub hypothesis: Option<(u16, Vec<Account>)>,
    /// The final region, and the hypotheses that made it, itself first.
    pub region: Option<(u16, Vec<Account>)>,
}

/// Answers for a pixel, and for a hypothesis or else for what the pixel became part of.
pub fn why(
    shown: &ResultSnapshot,
    trace: &Arc<Trace>,
    names: &RegionNames,
    pixel: Option<u32>,
    birth: Option<u16>,
) -> Why {
    let words = Names::of(trace);
    let stage = |step: usize| trace.stage_at(step).unwrap_or(Stage::Masks);
    let account = |step: usize, depth: usize, text: String| Account { step, stage: stage(step), depth, text };
    let image = &shown.picture.photo.image;
    let pixel = pixel.filter(|&pixel| (pixel as usize) < image.pixels.len()).map(|pixel| {
        let history = condense(&pixel_history(trace, image, &shown.analysis.masks, pixel as usize));
        let told = history.iter().rev().map(|condensed| {
            let text = words.happening(&condensed.last);
            let text = if condensed.times > 1 { format!("{text} ({} times)", condensed.times) } else { text };
            account(condensed.last.step, 0, text)
        });
        (pixel, told.collect())
    });
    let of_pixel = || {
        let (pixel, _) = pixel.as_ref()?;
        let label = shown.labels()[*pixel as usize];
        names.births_of(label).find(|_| label != 0)
    };
    let birth = birth.or_else(of_pixel);
    let hypothesis = birth.and_then(|birth| {
        let told = words.story(&story(trace, birth)?);
        Some((birth, told.into_iter().map(|(step, text)| account(step, 0, text)).collect()))
    });
    let number = birth.map(|birth| names.final_number(birth)).filter(|&number| number != 0);
    let region = number.map(|number| {
        let told = lineage(trace, number);
        let told =
            told.iter().map(|ancestor| account(ancestor.step(), ancestor.depth, words.ancestor(ancestor)));
        (number, told.collect())
    });
    Why { pixel, hypothesis, region }
}
