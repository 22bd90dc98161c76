//! The history of a pixel, of a hypothesis and of a region as sentences, each with the step that the sentence is about.

use super::RegionNames;
use crate::describe::{Names, condense};
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::trace::{Stage, Trace, lineage, story};
use crate::view::ResultSnapshot;
use std::sync::Arc;

/// A sentence about a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WhySentence {
    /// The step that the sentence is about; none for a decision of the second look, whose steps are not those of the trace.
    pub step: Option<usize>,
    /// The stage of the step.
    pub stage: Stage,
    /// Number of joinings between the hypothesis of the sentence and the subject of the list.
    pub depth: usize,
    /// The sentence as text.
    pub text: String,
}

/// The answers to the questions about a pixel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Why {
    /// The pixel that was asked about, and its history, newest first.
    pub pixel: Option<(PixelIndex, Vec<WhySentence>)>,
    /// The hypothesis that was asked about, and its story.
    pub hypothesis: Option<(HypothesisId, Vec<WhySentence>)>,
    /// The region of the result, and the hypotheses that made the region: first the hypothesis that became the region.
    pub region: Option<(RegionId, Vec<WhySentence>)>,
}

impl WhySentence {
    /// A sentence about a step of the trace.
    fn of_step(trace: &Trace, step: usize, depth: usize, text: String) -> Self {
        let stage = trace.stage_at(step).unwrap_or(Stage::Masks);
        Self { step: Some(step), stage, depth, text }
    }
}

/// The answers for a pixel, and for a hypothesis; without a hypothesis, for the region of the pixel, or for `region`, if the second look found
/// it.
pub fn why(
    shown: &ResultSnapshot,
    trace: &Arc<Trace>,
    names: &RegionNames,
    pixel: Option<PixelIndex>,
    hypothesis: Option<HypothesisId>,
    region: Option<RegionId>,
) -> Why {
    let names_in_sentences = Names::of(trace);
    let sentence = |step: usize, depth: usize, text: String| WhySentence::of_step(trace, step, depth, text);
    let image = &shown.picture.photo.image;
    let pixel = pixel.filter(|&pixel| pixel.index() < image.pixels.len());
    let pixel = pixel.map(|pixel| (pixel, of_pixel(shown, trace, &names_in_sentences, pixel)));
    let region_of_pixel =
        pixel.as_ref().and_then(|(pixel, _)| RegionId::from_label(shown.labels()[pixel.index()]));
    let hypothesis_of_pixel = || names.hypotheses_of(region_of_pixel?).next();
    let subject = hypothesis.or_else(hypothesis_of_pixel);
    let hypothesis = subject.and_then(|subject| {
        let sentences = names_in_sentences.story(&story(trace, subject)?);
        Some((subject, sentences.into_iter().map(|(step, text)| sentence(step, 0, text)).collect()))
    });
    let made = subject.and_then(|subject| names.region_of(subject)).map(|region| {
        let sentences = lineage(trace, region);
        let sentences = sentences
            .iter()
            .map(|ancestor| sentence(ancestor.step(), ancestor.depth, names_in_sentences.ancestor(ancestor)));
        (region, sentences.collect())
    });
    let asked = region_of_pixel.or(region).filter(|_| subject.is_none());
    let region = made.or_else(|| region_of_second_look(trace, asked?));
    Why { pixel, hypothesis, region }
}

/// What was decided about a pixel: at full resolution, in the second look, and about its working pixel, each newest first.
fn of_pixel(
    shown: &ResultSnapshot,
    trace: &Arc<Trace>,
    names: &Names,
    pixel: PixelIndex,
) -> Vec<WhySentence> {
    let record = trace.second_look_at(pixel);
    let last_step = trace.len().saturating_sub(1);
    let at_full_resolution = shown
        .analysis
        .pixel_place(pixel)
        .map(|place| WhySentence::of_step(trace, last_step, 0, names.pixel_place(&place, record.is_some())));
    let of_second_look = record.into_iter().flat_map(|record| {
        let names = Names::of_second_look(record);
        let history = condense(&record.pixel_history(pixel));
        let said = history.iter().rev().map(|condensed| {
            let text = repeated(names.second_look_entry(&condensed.last), condensed.times);
            WhySentence { step: None, stage: condensed.last.stage, depth: 0, text }
        });
        said.collect::<Vec<_>>()
    });
    let history = condense(&shown.analysis.pixel_history(trace, pixel));
    let of_working_pixel = history.iter().rev().map(|condensed| {
        let text = repeated(names.history_entry(&condensed.last), condensed.times);
        WhySentence::of_step(trace, condensed.last.step, 0, text)
    });
    at_full_resolution.into_iter().chain(of_second_look).chain(of_working_pixel).collect()
}

/// What a region of the second look is made of.
fn region_of_second_look(trace: &Trace, region: RegionId) -> Option<(RegionId, Vec<WhySentence>)> {
    let (record, finer) = trace.second_look_region(region)?;
    let names = Names::of_second_look(record);
    let sentences = lineage(&record.trace, finer).into_iter().map(|ancestor| {
        let stage = record.trace.stage_at(ancestor.step()).unwrap_or(Stage::Clipping);
        WhySentence { step: None, stage, depth: ancestor.depth, text: names.second_look_ancestor(&ancestor) }
    });
    Some((region, sentences.collect()))
}

/// A sentence, and how often it was said.
fn repeated(text: String, times: usize) -> String {
    if times > 1 { format!("{text} ({times} times)") } else { text }
}
