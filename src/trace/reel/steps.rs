//! Walking a reel from either end.

use super::Reel;
use crate::trace::Step;
use std::ops::Range;

/// The steps of a reel, in order.
#[derive(Clone, Debug)]
pub struct Steps<'a> {
    reel: &'a Reel,
    front: Place,
    back: Place,
}

impl<'a> Steps<'a> {
    /// The steps of `reel` in a range.
    pub(super) fn new(reel: &'a Reel, range: &Range<usize>) -> Self {
        let place = |n: usize| {
            let n = n.min(reel.len());
            let event = reel.events_before(n);
            let contest = reel.contested.partition_point(|&contested| (contested as usize) < n - event);
            Place { n, event, contest }
        };
        Self { reel, front: place(range.start), back: place(range.end.max(range.start)) }
    }
}

/// Steps, events and contests before a place.
#[derive(Clone, Copy, Debug)]
struct Place {
    n: usize,
    event: usize,
    contest: usize,
}

impl<'a> Iterator for Steps<'a> {
    type Item = Step<'a>;

    fn next(&mut self) -> Option<Step<'a>> {
        if self.front.n >= self.back.n {
            return None;
        }
        let (reel, at) = (self.reel, &mut self.front);
        let n = at.n;
        at.n += 1;
        if reel.event_steps.get(at.event) == Some(&(n as u32)) {
            at.event += 1;
            return Some(Step::Event(&reel.events[at.event - 1]));
        }
        let index = n - at.event;
        if index >= reel.moves.len() {
            return reel.label(index - reel.moves.len());
        }
        let contested = reel.contested.get(at.contest) == Some(&(index as u32));
        let contest = contested.then(|| reel.contest(at.contest));
        at.contest += usize::from(contested);
        Some(reel.moves[index].step(contest))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.back.n.saturating_sub(self.front.n);
        (left, Some(left))
    }
}

impl DoubleEndedIterator for Steps<'_> {
    fn next_back(&mut self) -> Option<Self::Item> {
        if self.front.n >= self.back.n {
            return None;
        }
        let (reel, at) = (self.reel, &mut self.back);
        at.n -= 1;
        if at.event > 0 && reel.event_steps[at.event - 1] == at.n as u32 {
            at.event -= 1;
            return Some(Step::Event(&reel.events[at.event]));
        }
        let index = at.n - at.event;
        if index >= reel.moves.len() {
            return reel.label(index - reel.moves.len());
        }
        let contested = at.contest > 0 && reel.contested[at.contest - 1] == index as u32;
        at.contest -= usize::from(contested);
        Some(reel.moves[index].step(contested.then(|| reel.contest(at.contest))))
    }
}

impl ExactSizeIterator for Steps<'_> {}
