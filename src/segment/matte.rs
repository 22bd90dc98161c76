//! The linear stage as a whole (section 5.3): hypotheses, and the refinements that look at them again.

use super::absorb::absorb;
use super::classify::{Classifier, Windows, classify};
use super::ledger::Ledger;
use super::linear::{Choice, Hypothesis, linear};
use super::merge::{Areas, merge};
use super::scene::Scene;
use super::unite::{merge_regions, vote};
use crate::raster::{LabelMap, UNASSIGNED};
use crate::trace::{Pass, Recorder};

/// Windows and minimal areas of the second look, pixels.
const SECOND_LOOKS: [(usize, usize); 2] = [(10, 150), (6, 72)];

/// What the linear stage found.
#[derive(Clone, Debug, PartialEq)]
pub struct MatteRegions {
    /// Region of each pixel; region `id` is hypothesis `id − 1`.
    pub labels: LabelMap,
    /// The hypotheses in the order of their birth, dead ones included.
    pub hypotheses: Vec<Hypothesis>,
}

/// Finds the matte regions.
pub fn matte_regions<R: Recorder>(
    scene: &Scene,
    windows: &Windows,
    areas: &Areas,
    recorder: &mut R,
) -> MatteRegions {
    let labels = LabelMap::filled(scene.pixels.width(), scene.pixels.height(), UNASSIGNED);
    let mut ledger = Ledger::new(labels, recorder);
    let mut hypotheses = Vec::new();
    let min_area_px = scene.used.min_area as usize;
    let first = Choice { min_area_px, points: false, through_black: false };
    linear(scene, windows, areas, &first, &mut hypotheses, &mut ledger);
    for round in 0..3 {
        if scene.refine.absorb_highlights {
            ledger.begin(Pass::Absorbing);
        }
        let released = scene.refine.absorb_highlights && absorb(scene, &mut hypotheses, &mut ledger);
        // Without newly released pixels another look would see what the last one saw.
        if round == 2 || (round == 1 && !released) {
            break;
        }
        if scene.refine.second_look {
            second_look(scene, &mut hypotheses, &mut ledger);
        }
    }
    if scene.refine.proximity_vote {
        ledger.begin(Pass::Vote);
        vote(scene, &hypotheses, &mut ledger);
    }
    if scene.refine.merge_regions {
        ledger.begin(Pass::Uniting);
        merge_regions(scene, &mut hypotheses, &mut ledger);
    }
    MatteRegions { labels: ledger.labels, hypotheses }
}

/// Repeats the stages so far on unexplained pixels, for what is smaller than the minimal area or too flat for a line.
fn second_look<R: Recorder>(scene: &Scene, hypotheses: &mut Vec<Hypothesis>, ledger: &mut Ledger<R>) {
    for (size_px, min_area_px) in SECOND_LOOKS {
        if scene.stopped() {
            return;
        }
        ledger.begin(Pass::SecondLook(size_px as u16));
        let min_area_px = min_area_px.min(scene.used.min_area as usize);
        let mut classifier = Classifier::new(scene.used.camera_noise, scene.refine.tail_test);
        let labels = &ledger.labels;
        let unexplained = |pixel: usize| labels[pixel] == UNASSIGNED && scene.masks.usable(pixel);
        let min_valid = size_px * size_px / 2;
        let windows =
            classify(scene.pixels, unexplained, size_px, min_valid, &mut classifier, ledger.recorder);
        let areas = merge(&windows, &mut classifier, ledger.recorder);
        let choice = Choice { min_area_px, points: true, through_black: true };
        linear(scene, &windows, &areas, &choice, hypotheses, ledger);
    }
}
