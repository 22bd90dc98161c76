//! A result with all that panels show of it: region colors, times, trace and accuracy.

use super::{Accuracy, Picture};
use crate::analysis::{Analysis, Stage};
use crate::baseline::baseline_regions;
use crate::intrinsic::Reason;
use crate::params::{Baseline, Params, Refine};
use crate::raster::{LabelMap, Mask, Raster, RegionId, UNASSIGNED};
use crate::segment::AnalysisInput;
use crate::trace::{Class, NoopRecorder, Trace};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::sync::{Arc, OnceLock};

/// The result of one request. Snapshots are shared and do not change.
#[derive(Debug)]
pub struct ResultSnapshot {
    /// Number of the request; larger is newer.
    pub generation: u64,
    /// The photograph.
    pub picture: Arc<Picture>,
    /// The parameters of the request.
    pub params: Params,
    /// The pixels that the request was restricted to; none: all pixels.
    pub area: Option<Arc<Mask>>,
    /// The outputs of all stages.
    pub analysis: Analysis,
    /// The first stage whose output belongs to an older request; none: all outputs belong to this request.
    pub stale_from: Option<Stage>,
    /// Colors of the regions, sRGB, by [`RegionId::index`]. They stay with the objects while parameters move.
    pub region_colors: Vec<[u8; 3]>,
    /// Share of the pixels that are not dark which are in a region; 0 where all are dark.
    pub coverage: f64,
    /// Time of each stage that ran, in the order of [`Stage::ALL`], milliseconds; none: the earlier output of the stage
    /// was reused.
    pub took_ms: [Option<f64>; Stage::ALL.len()],
    /// The decisions that led to the result, once recorded.
    pub(crate) trace: OnceLock<Arc<Trace>>,
    /// The accuracy against the ground truth, once measured.
    pub(crate) accuracy: OnceLock<Option<Accuracy>>,
    /// The regions that Phoenix finds in the photograph, once asked for.
    pub(crate) phoenix: OnceLock<LabelMap>,
    /// The reasons that pixels have, once asked for.
    pub(crate) reasons: OnceLock<Vec<Reason>>,
}

impl ResultSnapshot {
    /// The snapshot of a complete result of the whole photograph, as number 0 and without times. `region_colors` has an sRGB color for
    /// each region.
    pub fn new(
        picture: Arc<Picture>,
        params: Params,
        analysis: Analysis,
        region_colors: Vec<[u8; 3]>,
    ) -> Self {
        Self {
            generation: 0,
            picture,
            params,
            area: None,
            coverage: coverage(&analysis),
            analysis,
            stale_from: None,
            region_colors,
            took_ms: [None; Stage::ALL.len()],
            trace: OnceLock::new(),
            accuracy: OnceLock::new(),
            phoenix: OnceLock::new(),
            reasons: OnceLock::new(),
        }
    }

    /// Whether the result is that of a working picture, whose pixels are larger than those of the photograph.
    pub fn is_of_working_picture(&self) -> bool {
        (self.labels().width(), self.labels().height()) != self.picture.size()
    }

    /// The final regions.
    pub fn labels(&self) -> &LabelMap {
        &self.analysis.finals.labels
    }

    /// Regions after the linear stage, numbered in the order of their hypotheses.
    pub fn linear_labels(&self) -> &LabelMap {
        &self.analysis.matte.labels
    }

    /// Regions after the planar stage, numbered in the order of their hypotheses.
    pub fn planar_labels(&self) -> &LabelMap {
        &self.analysis.planar.labels
    }

    /// Class of each window, row-major; none where too few pixels are valid.
    pub fn classes(&self) -> &Raster<Option<Class>> {
        &self.analysis.windows.classes
    }

    /// Merged area of each pixel, from 1; 0 where its window has no class.
    pub fn areas(&self) -> &Raster<u32> {
        &self.analysis.areas
    }

    /// The decisions that led to the result; none until they are recorded.
    pub fn trace(&self) -> Option<&Arc<Trace>> {
        self.trace.get()
    }

    /// The accuracy against the ground truth; none without a ground truth, and until the worker has measured.
    pub fn accuracy(&self) -> Option<&Accuracy> {
        self.accuracy.get()?.as_ref()
    }

    /// Measures the accuracy, where there is a ground truth. Takes about as long as the analysis.
    pub(crate) fn measure(&self) {
        self.accuracy.get_or_init(|| super::accuracy::accuracy(&self.picture, &self.params, &self.analysis));
    }

    /// The regions that Phoenix (section 7.2) finds in the photograph, with the settings of the request, at the size of the final regions.
    /// The first call takes about as long as a run of the paper's method.
    pub fn phoenix_labels(&self) -> &LabelMap {
        self.phoenix.get_or_init(|| {
            let Analysis { working, used, finals, .. } = &self.analysis;
            let input = AnalysisInput::new(&working.image, &working.masks, used, Refine::all(false));
            let baseline = Baseline::Phoenix(self.params.phoenix);
            let found = baseline_regions(&input, &baseline, &mut NoopRecorder).labels;
            if found.len() == finals.labels.len() { found } else { working.blocks.enlarged(&found) }
        })
    }

    /// The reasons why pixels of the photograph are not explained, each once, in the order of [`Reason::ALL`]. The first call looks at all pixels.
    pub fn reasons(&self) -> &[Reason] {
        self.reasons.get_or_init(|| {
            let found = self.analysis.intrinsic.reasons.as_slice().par_iter().fold(
                || [false; Reason::ALL.len()],
                |mut found, &reason| {
                    found[reason as usize] = true;
                    found
                },
            );
            let found = found.reduce(Default::default, |a, b| std::array::from_fn(|i| a[i] || b[i]));
            let others = Reason::ALL.into_iter().zip(found).skip(1);
            others.filter(|(_, is_found)| *is_found).map(|(reason, _)| reason).collect()
        })
    }

    /// Side of a window, pixels.
    pub fn window_px(&self) -> usize {
        self.analysis.windows.size_px.max(1)
    }

    /// Time of the stages that ran, milliseconds.
    pub fn total_ms(&self) -> f64 {
        self.took_ms.iter().flatten().sum()
    }
}

/// Share of the pixels that are not dark which are in a region, 0…1.
fn coverage(analysis: &Analysis) -> f64 {
    let labels = analysis.finals.labels.as_slice().iter().enumerate();
    let (lit, assigned) = labels
        .filter(|&(pixel, _)| !analysis.masks.dark(pixel))
        .fold((0u64, 0u64), |sums, (_, &label)| (sums.0 + 1, sums.1 + u64::from(label != 0)));
    assigned as f64 / lit.max(1) as f64
}

/// The region of `after` that covers most of `region`'s pixels in `before`; none where none covers any.
pub(crate) fn best_overlap(before: &LabelMap, after: &LabelMap, region: RegionId) -> Option<RegionId> {
    best_overlaps(before, after).get(usize::from(region.get())).copied().flatten()
}

/// For each label of `before` (the first: of unassigned pixels) the region of `after` that covers most of its pixels, of
/// equals the one with the smaller number; none where none covers any.
pub(crate) fn best_overlaps(before: &LabelMap, after: &LabelMap) -> Vec<Option<RegionId>> {
    overlaps(before, after)
        .iter()
        .map(|covers| {
            let regions =
                covers.iter().filter_map(|&(label, pixels)| Some((pixels, RegionId::from_label(label)?)));
            regions.max_by_key(|&(pixels, region)| (pixels, Reverse(region))).map(|(_, region)| region)
        })
        .collect()
}

/// For each label of `before` (the first: of unassigned pixels) the labels of `after` with shared pixels, each
/// with the number of shared pixels, in the order in which the pixels come.
pub(crate) fn overlaps(before: &LabelMap, after: &LabelMap) -> Vec<Vec<(u16, usize)>> {
    let mut shared: Vec<Vec<(u16, usize)>> = vec![Vec::new()];
    let mut add = |(old, new): (u16, u16), pixels: usize| {
        let old = usize::from(old);
        if shared.len() <= old {
            shared.resize(old + 1, Vec::new());
        }
        match shared[old].iter_mut().find(|(known, _)| *known == new) {
            Some((_, count)) => *count += pixels,
            None => shared[old].push((new, pixels)),
        }
    };
    // Neighboring pixels mostly have the same pair of labels: one look-up per run of pixels.
    let (mut run, mut length) = ((UNASSIGNED, UNASSIGNED), 0);
    for pair in before.as_slice().iter().copied().zip(after.as_slice().iter().copied()) {
        if pair != run {
            add(run, length);
            (run, length) = (pair, 0);
        }
        length += 1;
    }
    add(run, length);
    shared
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(text: &str) -> LabelMap {
        let data: Vec<u16> = text.bytes().map(|b| u16::from(b - b'0')).collect();
        Raster::from_vec(data.len(), 1, data).unwrap()
    }

    #[test]
    fn the_best_overlap_covers_most_and_of_equals_has_the_smaller_number() {
        let (before, after) = (labels("0111122223340"), labels("1330122110443"));
        assert_eq!(best_overlaps(&before, &after), [1, 3, 1, 4, 4].map(RegionId::from_label));
        let best_overlap = |before: &LabelMap, after: &LabelMap, region: usize| {
            best_overlap(before, after, RegionId::from_index(region - 1)).map(RegionId::get)
        };
        assert_eq!((best_overlap(&before, &after, 2), best_overlap(&before, &after, 9)), (Some(1), None));
        assert_eq!(best_overlap(&labels("11"), &labels("00"), 1), None);
    }

    #[test]
    fn overlaps_count_every_pixel_once() {
        let shared = overlaps(&labels("0111122223340"), &labels("1330122110443"));
        assert_eq!(shared.iter().flatten().map(|pair| pair.1).sum::<usize>(), 13);
        assert_eq!(shared[2], [(2, 2), (1, 2)]);
    }
}
