//! The linear stage as a whole (section 5.3): the linear hypotheses, and the refinements that change them afterwards.

use super::absorb::absorb;
use super::candidates::is_leftover;
use super::classify::{Classifier, Windows, classify};
use super::input::AnalysisInput;
use super::linear::{Hypothesis, linear};
use super::merge::{Areas, merge};
use super::recorded_labels::RecordedLabels;
use super::seed_areas::SeedAreaRules;
use super::unite::{merge_regions, vote};
use crate::raster::{LabelMap, UNASSIGNED};
use crate::trace::{Pass, Recorder};

/// Sides of the smaller windows and their minimal areas, pixels.
const SMALLER_WINDOWS: [(usize, usize); 2] = [(10, 150), (6, 72)];

/// Output of the linear stage.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MatteRegions {
    /// Region of each pixel; region `id` is hypothesis `id − 1`.
    pub labels: LabelMap,
    /// The hypotheses in the order in which they were made, with those that no longer exist.
    pub hypotheses: Vec<Hypothesis>,
}

/// Finds the matte regions of an image from its windows and merged areas.
pub fn matte_regions<R: Recorder>(
    input: &AnalysisInput,
    windows: &Windows,
    areas: &Areas,
    recorder: &mut R,
) -> MatteRegions {
    let labels = LabelMap::filled(input.pixels.width(), input.pixels.height(), UNASSIGNED);
    let mut recorded_labels = RecordedLabels::new(labels, recorder);
    let mut hypotheses = Vec::new();
    let min_area_px = input.used.min_area as usize;
    let first = SeedAreaRules { min_area_px, points: false, through_black: false };
    linear(input, windows, areas, &first, &mut hypotheses, &mut recorded_labels);
    absorb_highlights(input, &mut hypotheses, &mut recorded_labels);
    repeat_in_smaller_windows(input, &mut hypotheses, &mut recorded_labels);
    // Without newly released pixels another search in smaller windows would find the same.
    if absorb_highlights(input, &mut hypotheses, &mut recorded_labels) {
        repeat_in_smaller_windows(input, &mut hypotheses, &mut recorded_labels);
        absorb_highlights(input, &mut hypotheses, &mut recorded_labels);
    }
    if input.refine.proximity_vote {
        recorded_labels.begin(Pass::Vote);
        vote(input, &hypotheses, &mut recorded_labels);
    }
    if input.refine.merge_regions {
        recorded_labels.begin(Pass::Uniting);
        merge_regions(input, &mut hypotheses, &mut recorded_labels);
    }
    MatteRegions { labels: recorded_labels.labels, hypotheses }
}

/// Absorbs broad highlights into the regions of their objects (refinement `absorb_highlights`). Returns whether that released pixels.
fn absorb_highlights<R: Recorder>(
    input: &AnalysisInput,
    hypotheses: &mut [Hypothesis],
    recorded_labels: &mut RecordedLabels<R>,
) -> bool {
    if !input.refine.absorb_highlights {
        return false;
    }
    recorded_labels.begin(Pass::Absorbing);
    absorb(input, hypotheses, recorded_labels)
}

/// Repeats classification, merging and the linear stage on the leftover pixels, with smaller windows and areas, for objects
/// that are smaller than the minimal area or whose colors vary too little for a line (refinement `second_look`). What ARCHITECTURE.md calls
/// the second look is another step: it takes place in a finer picture (`analysis/second_look`).
fn repeat_in_smaller_windows<R: Recorder>(
    input: &AnalysisInput,
    hypotheses: &mut Vec<Hypothesis>,
    recorded_labels: &mut RecordedLabels<R>,
) {
    if !input.refine.second_look {
        return;
    }
    for (size_px, min_area_px) in SMALLER_WINDOWS {
        if input.stopped() {
            return;
        }
        recorded_labels.begin(Pass::SmallerWindows(size_px as u16));
        let min_area_px = min_area_px.min(input.used.min_area as usize);
        let mut classifier = Classifier::new(input.used.camera_noise, input.refine.tail_test);
        let labels = &recorded_labels.labels;
        let leftover = |pixel: usize| is_leftover(labels, input.masks, pixel);
        let min_valid = size_px * size_px / 2;
        let windows =
            classify(input.pixels, leftover, size_px, min_valid, &mut classifier, recorded_labels.recorder);
        let areas = merge(&windows, &mut classifier, recorded_labels.recorder);
        let rules = SeedAreaRules { min_area_px, points: true, through_black: true };
        linear(input, &windows, &areas, &rules, hypotheses, recorded_labels);
    }
}
