//! Who holds which pixel. Every change of hands goes through here, so that a record of claims is complete.

use crate::raster::{LabelMap, UNASSIGNED};
use crate::trace::Recorder;

/// The label map while it grows, and the recorder that is told of each claim.
pub struct Ledger<'a, R: Recorder> {
    /// Region of each pixel.
    pub labels: LabelMap,
    /// Listens to every claim.
    pub recorder: &'a mut R,
}

impl<'a, R: Recorder> Ledger<'a, R> {
    /// A ledger that goes on from `labels`.
    pub fn new(labels: LabelMap, recorder: &'a mut R) -> Self {
        Self { labels, recorder }
    }

    /// Gives a pixel to a region, or to none.
    #[inline]
    pub fn assign(&mut self, pixel: usize, region: u16) {
        let before = self.labels[pixel];
        if before != region {
            self.labels[pixel] = region;
            if R::KEEPS {
                self.recorder.claim(pixel as u32, before, region);
            }
        }
    }

    /// Grows a region from the pixels in `front`, 4-connected and ring by ring: each neighbour that is not the region's
    /// is claimed when `accept(recorder, pixel, holder)` says so. Seeds must be the region's already. Claimed pixels are
    /// appended to `front`, in order.
    pub fn grow(
        &mut self,
        region: u16,
        front: &mut Vec<u32>,
        mut accept: impl FnMut(&mut R, usize, u16) -> bool,
    ) {
        let (width, len) = (self.labels.width(), self.labels.len());
        let mut next = 0;
        while next < front.len() {
            let pixel = front[next] as usize;
            next += 1;
            let x = pixel % width;
            let mut visit = |near: usize| {
                let holder = self.labels[near];
                if holder != region && accept(self.recorder, near, holder) {
                    self.assign(near, region);
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

    /// The pixels of every region, each list in row-major order; region `id` at index `id − 1`.
    pub fn members(&self, regions: usize) -> Members {
        Members::of(&self.labels, regions)
    }
}

/// Pixels by region.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Members {
    starts: Vec<usize>,
    pixels: Vec<u32>,
}

impl Members {
    /// Sorts the pixels of `labels` by region, for `regions` regions.
    pub fn of(labels: &LabelMap, regions: usize) -> Self {
        let mut starts = vec![0usize; regions + 2];
        for &label in labels.as_slice() {
            starts[usize::from(label) + 1] += 1;
        }
        starts[1] = 0;
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut pixels = vec![0u32; starts[regions + 1]];
        for (pixel, &label) in labels.as_slice().iter().enumerate() {
            if label != UNASSIGNED {
                let at = &mut next[usize::from(label)];
                pixels[*at] = pixel as u32;
                *at += 1;
            }
        }
        Self { starts, pixels }
    }

    /// Pixels of region `id` (from 1).
    pub fn region(&self, id: u16) -> &[u32] {
        &self.pixels[self.starts[usize::from(id)]..self.starts[usize::from(id) + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::Log;

    #[test]
    fn members_are_sorted_by_region() {
        let labels = LabelMap::from_vec(3, 2, vec![2, 0, 1, 1, 2, 2]).unwrap();
        let members = Members::of(&labels, 3);
        assert_eq!(members.region(1), [2, 3]);
        assert_eq!(members.region(2), [0, 4, 5]);
        assert!(members.region(3).is_empty());
    }

    #[test]
    fn growth_goes_ring_by_ring_and_every_claim_is_recorded() {
        let mut log = Log::default();
        let mut ledger = Ledger::new(LabelMap::filled(3, 3, 0), &mut log);
        let mut front = vec![4];
        ledger.assign(4, 1);
        ledger.grow(1, &mut front, |_, pixel, _| pixel != 0);
        assert_eq!(front, [4, 1, 3, 5, 7, 2, 6, 8]);
        assert_eq!(ledger.labels.as_slice(), [0, 1, 1, 1, 1, 1, 1, 1, 1]);
        let end = ledger.labels.clone();
        assert_eq!(log.replay(3, 3).unwrap().labels, end);
    }
}
