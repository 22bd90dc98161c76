//! The regions of an earlier method while they are made: each has the main axis of its colors, and its pixels.

use crate::color::{Line, Moments, Vec3};
use crate::raster::HypothesisId;
use crate::segment::{AnalysisInput, Hypothesis, RecordedLabels};
use crate::trace::{Event, PatchMade, Recorder};

/// The regions while they are made.
pub(super) struct RegionList<'r, R: Recorder> {
    pub(super) recorded_labels: RecordedLabels<'r, R>,
    /// One hypothesis per region, divided regions included.
    pub(super) hypotheses: Vec<Hypothesis>,
}

impl<R: Recorder> RegionList<'_, R> {
    /// The number of the next region; none where a label map can hold no more.
    pub(super) fn next_id(&self) -> Option<HypothesisId> {
        (self.hypotheses.len() < HypothesisId::MOST).then(|| HypothesisId::from_index(self.hypotheses.len()))
    }

    /// Records a decision.
    pub(super) fn record(&mut self, event: impl Into<Event>) {
        self.recorded_labels.recorder.record(event);
    }

    /// Adds the region that `made` describes, with these pixels. The region that it is a part of lives no longer.
    pub(super) fn add(&mut self, input: &AnalysisInput, made: PatchMade, pixels: &[u32]) {
        if let Some(of) = made.of {
            self.hypotheses[of.index()].alive = false;
        }
        let cluster: Moments = pixels.iter().map(|&pixel| input.pixels[pixel as usize]).collect();
        self.hypotheses.push(Hypothesis::new(line_of(&cluster)));
        if R::KEEPS {
            self.record(made);
        }
        for &pixel in pixels {
            self.recorded_labels.assign(pixel as usize, Some(made.hypothesis));
        }
    }
}

/// The main axis of a cluster; of a cluster without extent the line from black through its mean.
fn line_of(cluster: &Moments) -> Line {
    Line::principal(cluster).unwrap_or_else(|| {
        let mean = cluster.mean();
        Line::new(mean, if mean.norm() > 0.0 { mean } else { Vec3::repeat(1.0) })
    })
}
