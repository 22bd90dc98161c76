//! How much of the picture supports the light by the dichromatic planes (refinement `vote_light`): the share of the lit
//! pixels in regions that fit the model and show a highlight.

use super::input::AnalysisInput;
use super::model_fit::{FittedPlane, RegionFit};
use super::planar_hypothesis::PlanarHypothesis;
use super::recorded_labels::Members;
use crate::raster::{HypothesisId, LabelMap};
use rayon::prelude::*;

/// A region shows a highlight if at least this many of its pixels are nearer to the highlight line than to the matte line …
const HIGHLIGHT_PX: usize = 30;
/// … and at least this share of its pixels.
const HIGHLIGHT_SHARE: f64 = 0.005;
/// Pixels of a region that are looked at, evenly chosen.
const SAMPLES: usize = 6000;

/// Share, 0…1, of the lit pixels that lie in regions which fit the model of their hypothesis and show a highlight.
pub fn highlight_support(input: &AnalysisInput, labels: &LabelMap, hypotheses: &[PlanarHypothesis]) -> f64 {
    let members = Members::of(labels, hypotheses.len());
    let supporting = (0..hypotheses.len())
        .into_par_iter()
        .map(HypothesisId::from_index)
        .map(|id| {
            let hypothesis = &hypotheses[id.index()];
            let pixels = members.region(id);
            let Some((plane, test)) = hypothesis.plane.zip(hypothesis.highlight_test()) else { return 0 };
            if input.stopped() || pixels.len() < HIGHLIGHT_PX {
                return 0;
            }
            let fitted = FittedPlane {
                origin: &plane.matte.mean,
                body: &plane.matte.direction,
                surface: Some(&plane.surface),
            };
            let usable = pixels.sample(SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize));
            let (highlights, seen) = usable.fold((0, 0), |(highlights, seen), pixel| {
                (highlights + usize::from(test.is_highlight(input.pixels[pixel as usize])), seen + 1)
            });
            let share = highlights as f64 / f64::from(seen.max(1));
            let shows_highlight =
                share >= HIGHLIGHT_SHARE && share * pixels.len() as f64 >= HIGHLIGHT_PX as f64;
            let supports =
                shows_highlight && RegionFit::new(input, labels, id.get(), pixels, &fitted).model_fits();
            if supports { pixels.len() } else { 0 }
        })
        .sum::<usize>();
    let lit = (0..labels.len()).filter(|&pixel| !input.masks.dark(pixel)).count();
    supporting as f64 / lit.max(1) as f64
}
