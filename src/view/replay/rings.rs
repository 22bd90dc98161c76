//! The rings of a growth: a ring is the pixels that are reached from the pixels of the ring before.

use crate::raster::{HypothesisId, LabelMap};
use crate::trace::{Event, SeedsPlaced, Step, Trace};
use std::ops::Range;

/// In place of a ring: the owner of the pixel changes within the steps, but has not changed yet.
const NOT_YET: u32 = u32::MAX;

/// The rings in which a hypothesis took pixels within some steps.
pub(super) struct Rings {
    /// Ring in which each pixel was taken, from 1; 0 for a pixel whose owner does not change within the steps.
    ring_of: Vec<u32>,
    /// The ring at work.
    ring: u32,
    /// Claims to come that are seeds, all of one ring.
    seeds: u32,
    /// Steps at which a ring begins, ascending.
    pub(super) starts: Vec<usize>,
    /// The pixels of the ring that took pixels last, in the order of the claims; none right after seeds or a
    /// growth were announced.
    pub(super) newest: Vec<u32>,
}

impl Rings {
    /// The rings of `hypothesis` within `steps`. `labels` are the hypotheses of all pixels at any instant from the first of
    /// these steps to after the last.
    pub(super) fn of(
        trace: &Trace,
        labels: &LabelMap,
        steps: Range<usize>,
        hypothesis: HypothesisId,
    ) -> Self {
        let mut rings = Self {
            ring_of: vec![0; labels.len()],
            ring: 1,
            seeds: 0,
            starts: Vec::new(),
            newest: Vec::new(),
        };
        for (_, step) in trace.steps_in(steps.clone()) {
            if let Step::Claim { pixel, .. } = step {
                rings.ring_of[pixel.index()] = NOT_YET;
            }
        }
        for (n, step) in trace.steps_in(steps) {
            rings.apply(n, &step, labels, hypothesis);
        }
        rings
    }

    fn apply(&mut self, n: usize, step: &Step, labels: &LabelMap, hypothesis: HypothesisId) {
        match *step {
            Step::Event(event) => {
                if let Event::SeedsPlaced(SeedsPlaced { pixels, .. }) = event {
                    self.seeds = *pixels;
                }
                if matches!(event, Event::SeedsPlaced(_) | Event::GrowthBegan(_)) {
                    self.newest.clear();
                }
                self.begin_ring(n);
            }
            Step::Claim { pixel, after, .. } if after == Some(hypothesis) => {
                let mut nearest = NOT_YET;
                labels.for_each_neighbor(pixel.index(), |near| match self.ring_of[near] {
                    0 if labels[near] == hypothesis.get() => nearest = 0,
                    0 | NOT_YET => {}
                    ring => nearest = nearest.min(ring),
                });
                if self.seeds > 0 {
                    self.seeds -= 1;
                } else if nearest == self.ring {
                    // Reached from a pixel of this very ring: a new ring begins.
                    self.begin_ring(n);
                }
                if self.newest.first().is_some_and(|&first| self.ring_of[first as usize] != self.ring) {
                    self.newest.clear();
                }
                self.newest.push(pixel.get());
                self.ring_of[pixel.index()] = self.ring;
            }
            Step::Claim { pixel, .. } => self.ring_of[pixel.index()] = NOT_YET,
            Step::Refusal { .. } | Step::Label { .. } => {}
        }
    }

    fn begin_ring(&mut self, n: usize) {
        if self.starts.last() != Some(&n) {
            self.starts.push(n);
            self.ring += 1;
        }
    }
}
