//! Iteration over a stage trace from either end.

use super::StageTrace;
use crate::trace::Step;
use std::ops::Range;

/// The steps of a stage trace, in order.
#[derive(Clone, Debug)]
pub struct Steps<'a> {
    stage_trace: &'a StageTrace,
    front: Place,
    back: Place,
}

impl<'a> Steps<'a> {
    /// The steps of `stage_trace` in a range.
    pub(super) fn new(stage_trace: &'a StageTrace, range: &Range<usize>) -> Self {
        let place = |n: usize| {
            let n = n.min(stage_trace.len());
            let event = stage_trace.events_before(n);
            let contest =
                stage_trace.contested.partition_point(|&contested| (contested as usize) < n - event);
            Place { n, event, contest }
        };
        Self { stage_trace, front: place(range.start), back: place(range.end.max(range.start)) }
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
        let (stage_trace, at) = (self.stage_trace, &mut self.front);
        let n = at.n;
        at.n += 1;
        if stage_trace.event_steps.get(at.event) == Some(&(n as u32)) {
            at.event += 1;
            return Some(Step::Event(&stage_trace.events[at.event - 1]));
        }
        let index = n - at.event;
        if index >= stage_trace.moves.len() {
            return stage_trace.label(index - stage_trace.moves.len());
        }
        let contested = stage_trace.contested.get(at.contest) == Some(&(index as u32));
        let contest = contested.then(|| stage_trace.contest(at.contest));
        at.contest += usize::from(contested);
        Some(stage_trace.moves[index].step(contest))
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
        let (stage_trace, at) = (self.stage_trace, &mut self.back);
        at.n -= 1;
        if at.event > 0 && stage_trace.event_steps[at.event - 1] == at.n as u32 {
            at.event -= 1;
            return Some(Step::Event(&stage_trace.events[at.event]));
        }
        let index = at.n - at.event;
        if index >= stage_trace.moves.len() {
            return stage_trace.label(index - stage_trace.moves.len());
        }
        let contested = at.contest > 0 && stage_trace.contested[at.contest - 1] == index as u32;
        at.contest -= usize::from(contested);
        Some(stage_trace.moves[index].step(contested.then(|| stage_trace.contest(at.contest))))
    }
}

impl ExactSizeIterator for Steps<'_> {}
