//! The regions of an earlier method in the form of the outputs of the linear and planar stages, without planes and without a light.

use super::phoenix::phoenix;
use super::region_list::RegionList;
use super::top_down::top_down;
use crate::color::vec3;
use crate::params::Baseline;
use crate::raster::{HypothesisId, LabelMap, UNASSIGNED};
use crate::segment::{
    AnalysisInput, Hypothesis, LightFindings, MatteRegions, PlanarHypothesis, PlanarRegions, RecordedLabels,
};
use crate::trace::{Pass, Recorder};

/// The regions of an earlier method. Regions that were divided have no pixels, and are not alive.
pub fn baseline_regions<R: Recorder>(
    input: &AnalysisInput,
    baseline: &Baseline,
    recorder: &mut R,
) -> MatteRegions {
    let labels = LabelMap::filled(input.pixels.width(), input.pixels.height(), UNASSIGNED);
    let mut recorded_labels = RecordedLabels::new(labels, recorder);
    recorded_labels.begin(match baseline {
        Baseline::Phoenix(_) => Pass::Splitting,
        Baseline::TopDown => Pass::Clusters,
        Baseline::ByHand => Pass::Marked,
    });
    let mut regions = RegionList { recorded_labels, hypotheses: Vec::new() };
    match baseline {
        Baseline::Phoenix(settings) => phoenix(input, settings, &mut regions),
        Baseline::TopDown => top_down(input, &mut regions),
        // Marked pixels have stages of their own (`by_hand`).
        Baseline::ByHand => {}
    }
    let RegionList { recorded_labels, hypotheses } = regions;
    MatteRegions { labels: recorded_labels.labels, hypotheses }
}

/// The regions of `matte` as planar regions without planes, highlights and light.
pub fn regions_without_planes(input: &AnalysisInput, matte: &MatteRegions) -> PlanarRegions {
    let mut lengths = vec![0.0f64; matte.hypotheses.len()];
    for (&label, &color) in matte.labels.as_slice().iter().zip(input.pixels.as_slice()) {
        if let Some(id) = HypothesisId::from_label(label) {
            let along = matte.hypotheses[id.index()].line.direction.dot(&vec3(color));
            lengths[id.index()] = lengths[id.index()].max(along);
        }
    }
    let hypotheses = HypothesisId::all(matte.hypotheses.len()).zip(&matte.hypotheses);
    let planar = |(origin, Hypothesis { line, alive, .. }): (HypothesisId, &Hypothesis)| PlanarHypothesis {
        origin,
        matte: *line,
        matte_length: lengths[origin.index()],
        plane: None,
        start: line.mean,
        highlight: None,
        alive: *alive,
    };
    PlanarRegions {
        labels: matte.labels.clone(),
        hypotheses: hypotheses.map(planar).collect(),
        illuminant: None,
        light: LightFindings::not_sought(),
        second_lamp_mask: None,
    }
}
