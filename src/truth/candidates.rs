//! Which test of highlight candidates was right: the 50 % heuristic of section 3.2, or Gershon's test (section 5.4.1).

use super::GroundTruth;
use crate::analysis::Analysis;
use crate::raster::UNASSIGNED;
use crate::segment::is_of_candidate;
use crate::trace::{CandidateSource, CandidateTested, Event, Trace};
use serde::Serialize;
use std::collections::BTreeMap;

/// Length of the true surface reflection from which on a pixel is a highlight, counts.
const HIGHLIGHT_COUNTS: f32 = 10.0;

/// How often each of both tests was right. A candidate is a highlight where most of its pixels lie on the object of its hypothesis, and most
/// have true surface reflection of 10 counts or more. Not counted are candidates that were absorbed before, and those whose
/// hypothesis lies on no object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct CandidateCounts {
    /// Number of candidates that were counted.
    pub tests: usize,
    /// Number of these that are highlights.
    pub highlights: usize,
    /// Number of verdicts that were right with the 50 % heuristic.
    pub right_by_position: usize,
    /// Number of highlights that the 50 % heuristic accepts.
    pub accepted_by_position: usize,
    /// Number of verdicts that were right with Gershon's test.
    pub right_by_gershon: usize,
    /// Number of highlights that Gershon's test accepts.
    pub accepted_by_gershon: usize,
}

impl CandidateCounts {
    /// Counts the tests of a run. `analysis` and `trace` are of one run; none where the ground truth has another size.
    pub fn of(truth: &GroundTruth, analysis: &Analysis, trace: &Trace) -> Option<Self> {
        let found = Clusters::of(truth, analysis)?;
        let mut counts = Self::default();
        for (_, event) in trace.events() {
            let Event::CandidateTested(test) = event else { continue };
            let Some(is_highlight) = found.is_highlight(test) else { continue };
            counts.add(test, is_highlight);
        }
        Some(counts)
    }

    fn add(&mut self, test: &CandidateTested, is_highlight: bool) {
        let [position, gershon] = [test.verdict.accepted_by_position(), test.verdict.accepted_by_gershon()];
        self.tests += 1;
        self.highlights += usize::from(is_highlight);
        self.right_by_position += usize::from(position == is_highlight);
        self.accepted_by_position += usize::from(position && is_highlight);
        self.right_by_gershon += usize::from(gershon == is_highlight);
        self.accepted_by_gershon += usize::from(gershon && is_highlight);
    }
}

/// What the ground truth says of a cluster: its number of pixels, those of each object, and the highlights among them.
#[derive(Clone, Debug, Default)]
struct Cluster {
    pixels: usize,
    objects: BTreeMap<u16, usize>,
    highlights: usize,
}

impl Cluster {
    /// Adds a pixel of the picture.
    fn add(&mut self, truth: &GroundTruth, pixel: usize) {
        let surface = truth.surface[pixel].iter().map(|band| band * band).sum::<f32>().sqrt();
        self.pixels += 1;
        self.highlights += usize::from(surface >= HIGHLIGHT_COUNTS);
        *self.objects.entry(truth.labels[pixel]).or_default() += 1;
    }

    /// The object with more than half of the pixels.
    fn object(&self) -> Option<u16> {
        let most = self.objects.iter().find(|(_, pixels)| 2 * **pixels > self.pixels);
        most.map(|(&object, _)| object).filter(|&object| object != UNASSIGNED)
    }
}

/// The clusters of the matte regions, by label, and of the leftover pixels of each merged area, by the area's first window.
struct Clusters {
    regions: BTreeMap<u16, Cluster>,
    leftovers: BTreeMap<u32, Cluster>,
    /// The leftovers with their clipped and bloomed pixels (reading `distorted_candidates`).
    leftovers_with_distorted: BTreeMap<u32, Cluster>,
}

impl Clusters {
    fn of(truth: &GroundTruth, analysis: &Analysis) -> Option<Self> {
        let (labels, areas) = (&analysis.matte.labels, &analysis.areas);
        if (labels.width(), labels.height()) != (truth.labels.width(), truth.labels.height()) {
            return None;
        }
        let mut found = Self {
            regions: BTreeMap::new(),
            leftovers: BTreeMap::new(),
            leftovers_with_distorted: BTreeMap::new(),
        };
        for (pixel, &label) in labels.as_slice().iter().enumerate() {
            if label != UNASSIGNED {
                found.regions.entry(label).or_default().add(truth, pixel);
            }
            let Some(area) = areas[pixel].checked_sub(1) else { continue };
            let is_left = |with_distorted| is_of_candidate(labels, &analysis.masks, with_distorted, pixel);
            if is_left(false) {
                found.leftovers.entry(area).or_default().add(truth, pixel);
            }
            if is_left(true) {
                found.leftovers_with_distorted.entry(area).or_default().add(truth, pixel);
            }
        }
        Some(found)
    }

    /// Whether a candidate is a highlight of its hypothesis by the ground truth; none where this is not to be said.
    fn is_highlight(&self, test: &CandidateTested) -> Option<bool> {
        let object = self.regions.get(&test.hypothesis.get())?.object()?;
        let candidate = match test.candidate {
            CandidateSource::Leftover(area) if test.with_distorted => {
                self.leftovers_with_distorted.get(&area)?
            }
            CandidateSource::Leftover(area) => self.leftovers.get(&area)?,
            CandidateSource::Hypothesis(other) => self.regions.get(&other.get())?,
            CandidateSource::Absorbed(_) | CandidateSource::Marked => return None,
        };
        Some(candidate.object() == Some(object) && 2 * candidate.highlights > candidate.pixels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cluster_lies_on_the_object_with_more_than_half_of_its_pixels() {
        let cluster = |objects: &[(u16, usize)]| Cluster {
            pixels: objects.iter().map(|object| object.1).sum(),
            objects: objects.iter().copied().collect(),
            highlights: 0,
        };
        assert_eq!(cluster(&[(1, 6), (2, 5)]).object(), Some(1));
        assert_eq!(cluster(&[(1, 5), (2, 5)]).object(), None);
        assert_eq!(cluster(&[(0, 8), (2, 5)]).object(), None, "most lies on the background");
    }
}
