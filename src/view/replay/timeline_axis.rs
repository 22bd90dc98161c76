//! The places of the steps of a trace along a line: the layout of the timeline, without a screen.
//!
//! A trace has a million claims and a thousand windows. With shares in proportion to the number of steps, all but two
//! passes would be too thin to see. Stages, and passes within a stage, therefore get a share that grows slowly with
//! their number of steps and has a lower limit; within a pass, places are proportional to steps.

use crate::trace::{Pass, PassSpan, Trace};
use std::ops::Range;

/// Exponent of the weight: `n` steps weigh `n` to this power.
const COMPRESSION: f64 = 0.3;
/// Weight of labels, as a share of the weight of other steps: there is one label per pixel, all decided alike (6).
const LABEL_WEIGHT: f64 = 0.02;
/// Least share of a stage in the line.
const LEAST_STAGE_SHARE: f64 = 0.045;
/// Least share of a pass in its stage.
const LEAST_PASS_SHARE: f64 = 0.03;
/// Number of steps that are visible at the largest zoom.
const FEWEST_STEPS: f64 = 12.0;

/// The steps of a trace along a line from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct TimelineAxis {
    /// Steps and their places, both ascending; between two entries, places are proportional to steps.
    knots: Vec<(usize, f64)>,
}

/// The visible section of the line, as places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineSection {
    /// The place at its left end.
    pub from: f64,
    /// The place at its right end.
    pub to: f64,
}

impl TimelineAxis {
    /// The line of a trace.
    pub fn of(trace: &Trace) -> Self {
        let passes: Vec<PassSpan> = trace.passes().collect();
        let spans = trace.stages().map(|(_, steps)| steps).filter(|steps| !steps.is_empty());
        let stages: Vec<Vec<(Range<usize>, f64)>> =
            spans.map(|stage| parts_of_stage(&stage, &passes)).collect();
        let weights =
            stages.iter().map(|parts| compressed_weight(parts.iter().map(weighted_steps).sum())).collect();
        let mut axis = Self { knots: vec![(0, 0.0)] };
        let mut place = 0.0;
        for (parts, share) in stages.iter().zip(shares(weights, LEAST_STAGE_SHARE)) {
            let weights = parts.iter().map(|part| compressed_weight(weighted_steps(part))).collect();
            for ((part, _), share_of_stage) in parts.iter().zip(shares(weights, LEAST_PASS_SHARE)) {
                place += share * share_of_stage;
                axis.knots.push((part.end, place));
            }
        }
        // The sum of the shares is 1 but for rounding.
        if let Some(last) = axis.knots.last_mut().filter(|last| last.0 > 0) {
            last.1 = 1.0;
        }
        axis
    }

    /// The place after `steps` steps.
    pub fn place_of(&self, steps: usize) -> f64 {
        let next = self.knots.partition_point(|knot| knot.0 < steps);
        match (next.checked_sub(1).map(|before| self.knots[before]), self.knots.get(next)) {
            (Some((a, from)), Some(&(b, to))) => from + (to - from) * (steps - a) as f64 / (b - a) as f64,
            (None, Some(first)) => first.1,
            (_, None) => 1.0,
        }
    }

    /// The step at a place; none outside the line.
    pub fn step_at(&self, place: f64) -> Option<usize> {
        let next = self.knots.partition_point(|knot| knot.1 <= place);
        let (&(a, from), &(b, to)) = (self.knots.get(next.checked_sub(1)?)?, self.knots.get(next)?);
        // By rounding, the place of a step may lie slightly before its beginning.
        let steps = (place - from) / (to - from) * (b - a) as f64 + 1e-6;
        Some(a + (steps as usize).min(b - a - 1))
    }

    /// Number of steps before a cursor at a place; the step at the place is the last of these.
    pub fn taken_at(&self, place: f64) -> usize {
        let end = self.knots.last().map_or(0, |knot| knot.0);
        if place <= 0.0 { 0 } else { self.step_at(place).map_or(end, |step| step + 1) }
    }

    /// The ranges of evenly spaced steps that overlap a section, each with the width of a step, as places.
    pub fn stretches(&self, section: TimelineSection) -> impl Iterator<Item = (Range<usize>, f64)> + '_ {
        let pairs = self.knots.windows(2).map(|pair| (pair[0], pair[1]));
        let seen = pairs.filter(move |(a, b)| b.1 > section.from && a.1 < section.to);
        seen.map(|(a, b)| (a.0..b.0, (b.1 - a.1) / (b.0 - a.0) as f64))
    }

    /// The width of a step at a place.
    fn step_width(&self, place: f64) -> f64 {
        let next = self.knots.partition_point(|knot| knot.1 <= place).clamp(1, self.knots.len().max(2) - 1);
        match (self.knots.get(next - 1), self.knots.get(next)) {
            (Some(a), Some(b)) => (b.1 - a.1) / (b.0 - a.0) as f64,
            _ => 1.0,
        }
    }
}

impl Default for TimelineSection {
    /// The whole line.
    fn default() -> Self {
        Self { from: 0.0, to: 1.0 }
    }
}

impl TimelineSection {
    /// The place at a share of the section, 0 at its left end.
    pub fn place(&self, share: f64) -> f64 {
        self.from + share * (self.to - self.from)
    }

    /// The share of the section at a place: 0 at the left end, 1 at the right end, below 0 or above 1 outside.
    pub fn share(&self, place: f64) -> f64 {
        (place - self.from) / (self.to - self.from)
    }

    /// The section magnified by `factor`; the place at `share` stays at `share`, as long as the line fills the section.
    #[must_use]
    pub fn zoomed(&self, axis: &TimelineAxis, factor: f64, share: f64) -> Self {
        let anchor = self.place(share);
        let least = (FEWEST_STEPS * axis.step_width(anchor)).min(1.0);
        let width = ((self.to - self.from) / factor).clamp(least, 1.0);
        Self { from: anchor - share * width, to: anchor + (1.0 - share) * width }.within_line()
    }

    /// The section moved by a share of its width, within the line.
    #[must_use]
    pub fn panned(&self, shares: f64) -> Self {
        let by = shares * (self.to - self.from);
        Self { from: self.from + by, to: self.to + by }.within_line()
    }

    /// The section moved just so far that it contains a place.
    #[must_use]
    pub fn showing(&self, place: f64) -> Self {
        match self.share(place) {
            share if share < 0.0 => self.panned(share - 0.1),
            share if share > 1.0 => self.panned(share - 0.9),
            _ => *self,
        }
    }

    fn within_line(self) -> Self {
        let width = (self.to - self.from).min(1.0);
        let from = self.from.clamp(0.0, 1.0 - width);
        Self { from, to: from + width }
    }
}

/// Number of decisions (contested claims, refusals and events) in each of `columns` columns of a section.
pub fn timeline_density(
    trace: &Trace,
    axis: &TimelineAxis,
    section: TimelineSection,
    columns: usize,
) -> Vec<usize> {
    let edge = |column: usize| {
        let place = section.place(column as f64 / columns.max(1) as f64);
        axis.step_at(place).unwrap_or(if place < 0.5 { 0 } else { trace.len() })
    };
    let edges: Vec<usize> = (0..=columns).map(edge).collect();
    edges
        .windows(2)
        // A step wider than a column is in each of its columns.
        .map(|pair| trace.decisions_in(pair[0]..pair[1].max((pair[0] + 1).min(trace.len()))))
        .collect()
}

/// The passes of a stage and the steps between them, each with the weight of a step.
fn parts_of_stage(stage: &Range<usize>, passes: &[PassSpan]) -> Vec<(Range<usize>, f64)> {
    let mut parts = Vec::new();
    let mut at = stage.start;
    for PassSpan { steps, pass } in passes {
        if steps.start >= stage.start && steps.end <= stage.end {
            let weight = if *pass == Pass::Labels { LABEL_WEIGHT } else { 1.0 };
            parts.extend([(at..steps.start, 1.0), (steps.clone(), weight)]);
            at = steps.end;
        }
    }
    parts.push((at..stage.end, 1.0));
    parts.retain(|(part, _)| !part.is_empty());
    parts
}

fn weighted_steps((steps, weight): &(Range<usize>, f64)) -> f64 {
    weight * steps.len() as f64
}

fn compressed_weight(weighted_steps: f64) -> f64 {
    weighted_steps.powf(COMPRESSION)
}

/// Weights as shares, whose sum is 1.
fn shares(weights: Vec<f64>, least: f64) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    let floored: Vec<f64> = weights.into_iter().map(|weight| (weight / total).max(least)).collect();
    let total: f64 = floored.iter().sum();
    floored.iter().map(|share| share / total).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{HypothesisId, PixelIndex};
    use crate::trace::{PassBegan, StageBegan};
    use crate::trace::{Recorder, Stage, TraceRecorder};
    use std::sync::Arc;

    /// Stages of few and of many steps; the second has passes.
    fn trace() -> Trace {
        let mut recorder = TraceRecorder::default();
        recorder.record(StageBegan { stage: Stage::Masks });
        let masks = recorder.finish(Stage::Masks).unwrap();
        let mut recorder = TraceRecorder::default();
        recorder.record(StageBegan { stage: Stage::Linear });
        for (pass, claims) in [(Pass::Hypotheses, 50_000), (Pass::Vote, 3), (Pass::Uniting, 0)] {
            recorder.record(PassBegan { pass });
            for pixel in 0..claims {
                recorder.claim(PixelIndex::new(pixel), None, HypothesisId::from_label(1));
            }
        }
        let linear = recorder.finish(Stage::Linear).unwrap();
        Trace::new(300, 200, vec![Arc::new(masks), Arc::new(linear)])
    }

    #[test]
    fn places_ascend_and_lead_back_to_their_steps() {
        let trace = trace();
        let axis = TimelineAxis::of(&trace);
        assert_eq!((axis.place_of(0), axis.place_of(trace.len())), (0.0, 1.0));
        for step in 0..trace.len() {
            let (place, next) = (axis.place_of(step), axis.place_of(step + 1));
            assert!(place < next, "step {step}");
            assert_eq!(axis.step_at(place), Some(step));
            assert_eq!(axis.step_at(f64::midpoint(place, next)), Some(step));
            assert_eq!(axis.taken_at(f64::midpoint(place, next)), step + 1);
        }
        assert_eq!((axis.step_at(-0.1), axis.step_at(1.0)), (None, None));
        assert_eq!((axis.taken_at(0.0), axis.taken_at(1.5)), (0, trace.len()));
    }

    #[test]
    fn the_smallest_stage_and_pass_are_seen() {
        let axis = TimelineAxis::of(&trace());
        assert!(axis.place_of(1) > 0.04, "masks: {}", axis.place_of(1));
        let last = 1.0 - axis.place_of(trace().len() - 1);
        assert!(last > 0.02, "the last pass: {last}");
        let hypotheses = axis.place_of(50_000) - axis.place_of(10);
        assert!(hypotheses > 0.5, "what is large stays the largest: {hypotheses}");
    }

    #[test]
    fn zooming_keeps_the_step_under_the_pointer() {
        let axis = TimelineAxis::of(&trace());
        for share in [0.2, 0.5, 0.77] {
            let step = axis.step_at(TimelineSection::default().place(share));
            let mut section = TimelineSection::default();
            for _ in 0..200 {
                section = section.zoomed(&axis, 1.25, share);
                assert_eq!(axis.step_at(section.place(share)), step);
            }
            let seen = axis.step_at(section.to).unwrap() - axis.step_at(section.from).unwrap();
            assert!((8..=16).contains(&seen), "deepest zoom at {share}: {seen} steps");
            for _ in 0..200 {
                section = section.zoomed(&axis, 0.8, share);
            }
            assert_eq!(section, TimelineSection::default());
        }
    }

    #[test]
    fn a_section_stays_on_the_line_and_follows_a_place() {
        let axis = TimelineAxis::of(&trace());
        let section = TimelineSection::default().zoomed(&axis, 4.0, 0.5);
        assert!((section.panned(-9.0).from - 0.0).abs() < 1e-12);
        assert!((section.panned(9.0).to - 1.0).abs() < 1e-12);
        assert_eq!(section.showing(0.5), section);
        for place in [0.0, 0.1, 0.9, 1.0] {
            let share = section.showing(place).share(place);
            assert!((-1e-9..=1.0 + 1e-9).contains(&share), "{place}: {share}");
        }
    }

    #[test]
    fn density_counts_each_decision_once_where_steps_are_narrow() {
        let trace = trace();
        let axis = TimelineAxis::of(&trace);
        let density = timeline_density(&trace, &axis, TimelineSection::default(), 40);
        assert_eq!(density.len(), 40);
        assert!(density.iter().sum::<usize>() >= trace.decisions_in(0..trace.len()));
        let stretches: Vec<_> = axis.stretches(TimelineSection::default()).map(|(steps, _)| steps).collect();
        assert_eq!((stretches[0].start, stretches[stretches.len() - 1].end), (0, trace.len()));
    }

    #[test]
    fn a_trace_without_steps_has_a_line_without_places() {
        let trace = Trace::new(3, 3, Vec::new());
        let axis = TimelineAxis::of(&trace);
        assert_eq!((axis.step_at(0.5), axis.taken_at(0.5)), (None, 0));
        let section = TimelineSection::default().zoomed(&axis, 2.0, 0.5);
        assert_eq!(timeline_density(&trace, &axis, section, 3), [0, 0, 0]);
    }
}
