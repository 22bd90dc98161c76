//! The label map while regions change. Every change of a pixel's region goes through [`RecordedLabels`], so that the record of
//! claims is complete.

use crate::raster::{HypothesisId, LabelMap, PixelIndex, UNASSIGNED};
use crate::trace::{Pass, PassBegan, Recorder};
use rayon::prelude::*;

/// Number of pixels that a region grows from between two checks whether to stop: about a millisecond.
const PIXELS_PER_POLL: usize = 1 << 16;

/// Number of rows that one task of [`Members::of`] looks at.
const BAND_ROWS: usize = 64;

/// A label map that changes, and the recorder of each change.
pub struct RecordedLabels<'a, R: Recorder> {
    /// Region of each pixel.
    pub labels: LabelMap,
    /// Records every claim.
    pub recorder: &'a mut R,
}

impl<'a, R: Recorder> RecordedLabels<'a, R> {
    /// Starts from `labels`.
    pub fn new(labels: LabelMap, recorder: &'a mut R) -> Self {
        Self { labels, recorder }
    }

    /// Records that a pass of the stage begins.
    pub fn begin(&mut self, pass: Pass) {
        if R::KEEPS {
            self.recorder.record(PassBegan { pass });
        }
    }

    /// Assigns a pixel to a hypothesis, or to none.
    #[inline]
    pub fn assign(&mut self, pixel: usize, owner: Option<HypothesisId>) {
        let before = self.labels[pixel];
        let after = HypothesisId::label(owner);
        if before != after {
            self.labels[pixel] = after;
            if R::KEEPS {
                let before = HypothesisId::from_label(before);
                self.recorder.claim(PixelIndex::from_index(pixel), before, owner);
            }
        }
    }

    /// Grows a hypothesis from the pixels in `front`, 4-connected and ring by ring: each neighbor that belongs to another
    /// hypothesis or to none is claimed if `accept(recorder, pixel, holder)` returns true, where `holder` is the hypothesis that
    /// the pixel belongs to. The pixels in `front` must belong to the hypothesis already. Claimed pixels are appended to `front`,
    /// in order. Growth ends soon after `stop` returns true.
    pub fn grow(
        &mut self,
        hypothesis: HypothesisId,
        front: &mut Vec<u32>,
        stop: impl Fn() -> bool,
        mut accept: impl FnMut(&mut R, usize, Option<HypothesisId>) -> bool,
    ) {
        let (width, len) = (self.labels.width(), self.labels.len());
        let mut next = 0;
        while next < front.len() {
            let (pixel, x) = (front[next] as usize, (front[next] % width as u32) as usize);
            next += 1;
            if next % PIXELS_PER_POLL == 0 && stop() {
                return;
            }
            let mut visit = |near: usize| {
                let holder = self.labels[near];
                if holder != hypothesis.get() && accept(self.recorder, near, HypothesisId::from_label(holder))
                {
                    self.assign(near, Some(hypothesis));
                    front.push(near as u32);
                }
            };
            if pixel >= width {
                visit(pixel - width);
            }
            if x > 0 {
                visit(pixel - 1);
            }
            if x + 1 < width {
                visit(pixel + 1);
            }
            if pixel + width < len {
                visit(pixel + width);
            }
        }
    }

    /// The pixels among `pixels` that belong to `hypothesis` and have a 4-neighbor that does not, in the order of `pixels`.
    /// Growth from these pixels alone gives the same result as growth from all, and a large region has few of them.
    pub fn border(&self, hypothesis: HypothesisId, pixels: Pixels) -> Vec<u32> {
        let own = hypothesis.get();
        let (width, labels) = (self.labels.width(), self.labels.as_slice());
        let mut border = Vec::new();
        for &(first, length) in pixels.runs() {
            // A run lies within one row.
            let (first, x) = (first as usize, first as usize % width);
            for pixel in first..first + length as usize {
                let column = x + pixel - first;
                let other = |near: usize| labels[near] != own;
                let edge = (pixel >= width && other(pixel - width))
                    || (column > 0 && other(pixel - 1))
                    || (column + 1 < width && other(pixel + 1))
                    || (pixel + width < labels.len() && other(pixel + width));
                if edge && labels[pixel] == own {
                    border.push(pixel as u32);
                }
            }
        }
        border
    }

    /// The pixels of every region, each list in row-major order; region `id` at index `id − 1`.
    pub fn members(&self, regions: usize) -> Members {
        Members::of(&self.labels, regions)
    }
}

/// The pixels of every region, as runs of consecutive pixels: made in one pass over the labels, in little memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Members {
    /// Index of the first run of each region, and the number of runs at the end.
    starts: Vec<usize>,
    /// First pixel and length of each run, ordered by region and row-major within a region.
    runs: Vec<(u32, u32)>,
    /// Number of pixels of each region.
    sizes: Vec<usize>,
}

/// The pixels of one region, row-major.
#[derive(Clone, Copy, Debug)]
pub struct Pixels<'a> {
    runs: &'a [(u32, u32)],
    size: usize,
}

impl Members {
    /// Sorts the pixels of `labels` by region, for `regions` regions.
    pub fn of(labels: &LabelMap, regions: usize) -> Self {
        let bands = (0..labels.height()).into_par_iter().step_by(BAND_ROWS);
        let found: Vec<Vec<(u16, u32, u32)>> = bands.map(|top| runs_of_band(labels, top)).collect();
        let mut starts = vec![0usize; regions + 2];
        let mut sizes = vec![0usize; regions + 1];
        for &(label, _, length) in found.iter().flatten() {
            starts[usize::from(label) + 1] += 1;
            sizes[usize::from(label)] += length as usize;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut runs = vec![(0u32, 0u32); found.iter().map(Vec::len).sum()];
        for (label, first, length) in found.into_iter().flatten() {
            let at = &mut next[usize::from(label)];
            runs[*at] = (first, length);
            *at += 1;
        }
        Self { starts, runs, sizes }
    }

    /// Pixels of a hypothesis or region, whichever the label map holds.
    pub fn region(&self, id: impl Into<u16>) -> Pixels<'_> {
        let id = usize::from(id.into());
        Pixels { runs: &self.runs[self.starts[id]..self.starts[id + 1]], size: self.sizes[id] }
    }
}

/// Label, first pixel and length of each run of pixels of one region in the [`BAND_ROWS`] rows from `top` on.
fn runs_of_band(labels: &LabelMap, top: usize) -> Vec<(u16, u32, u32)> {
    let mut found = Vec::new();
    for y in top..labels.height().min(top + BAND_ROWS) {
        let mut start = (y * labels.width()) as u32;
        for run in labels.row(y).chunk_by(|a, b| a == b) {
            if run[0] != UNASSIGNED {
                found.push((run[0], start, run.len() as u32));
            }
            start += run.len() as u32;
        }
    }
    found
}

impl<'a> Pixels<'a> {
    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.size
    }

    /// Whether the region has no pixel.
    pub fn is_empty(&self) -> bool {
        self.size == 0
    }

    /// First pixel and length of each run.
    pub fn runs(&self) -> &'a [(u32, u32)] {
        self.runs
    }

    /// The rows of the pixels in an image `width` pixels wide, first to last; `None` without a pixel.
    pub fn rows(&self, width: usize) -> Option<std::ops::Range<usize>> {
        let (first, last) = (self.runs.first()?, self.runs.last()?);
        Some(first.0 as usize / width..last.0 as usize / width + 1)
    }

    /// All pixels, row-major.
    pub fn iter(&self) -> impl Iterator<Item = u32> + use<'a> {
        self.runs.iter().flat_map(|&(first, length)| first..first + length)
    }

    /// At most `most` of the pixels, evenly chosen.
    pub fn sample(&self, most: usize) -> impl Iterator<Item = u32> + use<'a> {
        let step = self.size.div_ceil(most).max(1) as u32;
        // Number of pixels to pass over before the next one that is taken.
        let mut skip = 0;
        self.runs.iter().flat_map(move |&(first, length)| {
            let start = skip;
            let taken = length.saturating_sub(start).div_ceil(step);
            skip = start + taken * step - length;
            (0..taken).map(move |i| first + start + i * step)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{Stage, TraceRecorder};

    const FIRST: HypothesisId = HypothesisId::from_index(0);

    #[test]
    fn members_are_sorted_by_region() {
        let labels = LabelMap::from_vec(3, 2, vec![2, 0, 1, 1, 2, 2]).unwrap();
        let members = Members::of(&labels, 3);
        let pixels = |id: u16| members.region(id).iter().collect::<Vec<_>>();
        assert_eq!(pixels(1), [2, 3]);
        assert_eq!(pixels(2), [0, 4, 5]);
        assert_eq!(members.region(2u16).len(), 3);
        assert!(members.region(3u16).is_empty());
        assert_eq!(members.region(2u16).sample(2).collect::<Vec<_>>(), [0, 5]);
    }

    #[test]
    fn growth_from_the_border_is_growth_from_all_pixels() {
        let rows = [[1u16, 1, 1, 0, 2], [1, 1, 1, 0, 2], [1, 1, 1, 0, 0], [0, 0, 0, 0, 1]];
        let labels = LabelMap::from_vec(5, 4, rows.concat()).unwrap();
        let members = Members::of(&labels, 2);
        let grown = |from_border: bool| {
            let mut recorder = TraceRecorder::default();
            let mut recorded_labels = RecordedLabels::new(labels.clone(), &mut recorder);
            let all = members.region(1u16);
            let mut front =
                if from_border { recorded_labels.border(FIRST, all) } else { all.iter().collect() };
            let seeds = front.clone();
            recorded_labels.grow(FIRST, &mut front, || false, |_, _, holder| holder.is_none());
            (recorder.finish(Stage::Linear).unwrap(), seeds)
        };
        let (from_border, seeds) = grown(true);
        assert_eq!(seeds, [2, 7, 10, 11, 12, 19]);
        assert_eq!(from_border, grown(false).0);
    }

    #[test]
    fn growth_goes_ring_by_ring_and_every_claim_is_recorded() {
        let mut recorder = TraceRecorder::default();
        let mut recorded_labels = RecordedLabels::new(LabelMap::filled(3, 3, 0), &mut recorder);
        let mut front = vec![4];
        recorded_labels.assign(4, Some(FIRST));
        recorded_labels.grow(FIRST, &mut front, || false, |_, pixel, _| pixel != 0);
        assert_eq!(front, [4, 1, 3, 5, 7, 2, 6, 8]);
        assert_eq!(recorded_labels.labels.as_slice(), [0, 1, 1, 1, 1, 1, 1, 1, 1]);
        let end = recorded_labels.labels.clone();
        let mut played = LabelMap::filled(3, 3, 0);
        let stage_trace = recorder.finish(Stage::Linear).unwrap();
        assert_eq!((stage_trace.play(&mut played), played), (Ok(()), end));
    }
}
