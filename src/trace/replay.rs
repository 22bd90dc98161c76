//! A cursor in a trace: forward, back, anywhere, and what stood at that instant.
//!
//! Claims are played on the label map one by one, in either direction; everything else is a stack per thing, pushed forward
//! and popped back. A long way is shortened by starting from a keyframe: labels as they were at one of a few steps.

use super::replay_state::{EventId, Grid, Hypothesis, ReplayState};
use super::stage_trace::Owners;
use super::{
    CandidateChosen, Event, IlluminantGiven, Pass, PixelKind, Renumbered, SliceMade, Stage, StageTrace, Step,
    Trace,
};
use crate::raster::{HypothesisId, LabelMap, RegionId, UNASSIGNED};
use std::sync::Arc;

/// Steps nearer than this are played from where the cursor is.
const NEAR: usize = 1 << 16;

/// The state of the analysis after some steps of a trace.
#[derive(Clone, Debug)]
pub struct Replay {
    trace: Arc<Trace>,
    at: usize,
    labels: LabelMap,
    /// Pixels of each label: of no hypothesis first, then of each hypothesis.
    sizes: Vec<u32>,
    standing: ReplayState,
    keyframes: Vec<Keyframe>,
}

/// Labels after the first `at` steps.
#[derive(Clone, Debug)]
struct Keyframe {
    at: usize,
    labels: Arc<LabelMap>,
    sizes: Vec<u32>,
}

impl Replay {
    /// A cursor before the first step.
    pub fn new(trace: Arc<Trace>) -> Self {
        let labels = LabelMap::filled(trace.width(), trace.height(), UNASSIGNED);
        let sizes = vec![labels.len() as u32];
        Self { trace, at: 0, labels, sizes, standing: ReplayState::default(), keyframes: Vec::new() }
    }

    /// What it is a cursor in.
    pub fn trace(&self) -> &Arc<Trace> {
        &self.trace
    }

    /// Steps taken.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The step taken last; none before the first.
    pub fn last(&self) -> Option<Step<'_>> {
        self.trace.step(self.at.checked_sub(1)?)
    }

    /// The stage of the step taken last; of the first one before it.
    pub fn stage(&self) -> Option<Stage> {
        self.trace.stage_at(self.at.saturating_sub(1))
    }

    /// The pass of the step taken last.
    pub fn pass(&self) -> Option<Pass> {
        self.trace.pass_at(self.at.checked_sub(1)?).map(|span| span.pass)
    }

    /// Hypothesis of each pixel.
    pub fn labels(&self) -> &LabelMap {
        &self.labels
    }

    /// Number of pixels in no hypothesis.
    pub fn unassigned(&self) -> u32 {
        self.sizes[usize::from(UNASSIGNED)]
    }

    /// Number of pixels of a hypothesis.
    pub fn size(&self, hypothesis: HypothesisId) -> u32 {
        self.sizes.get(usize::from(hypothesis.get())).copied().unwrap_or(0)
    }

    /// The hypotheses so far, ended ones included, by [`HypothesisId::index`].
    pub fn hypotheses(&self) -> &[Hypothesis] {
        &self.standing.hypotheses
    }

    /// The hypotheses so far, ended ones included, each with its id.
    pub fn numbered_hypotheses(
        &self,
    ) -> impl DoubleEndedIterator<Item = (HypothesisId, &Hypothesis)> + ExactSizeIterator {
        HypothesisId::all(self.standing.hypotheses.len()).zip(&self.standing.hypotheses)
    }

    /// One hypothesis; none where the hypothesis was not made yet.
    pub fn hypothesis(&self, hypothesis: HypothesisId) -> Option<&Hypothesis> {
        self.standing.hypotheses.get(hypothesis.index())
    }

    /// The slice of a hypothesis, where there is one.
    pub fn slice(&self, hypothesis: HypothesisId) -> Option<&SliceMade> {
        match self.find(*self.hypothesis(hypothesis)?.slices.last()?) {
            Event::SliceMade(made) => Some(made),
            _ => None,
        }
    }

    /// The highlight line chosen for a hypothesis.
    pub fn highlight(&self, hypothesis: HypothesisId) -> Option<&CandidateChosen> {
        match self.find(*self.hypothesis(hypothesis)?.highlights.last()?) {
            Event::CandidateChosen(chosen) => Some(chosen),
            _ => None,
        }
    }

    /// The windows that the analysis looks at: of the last grid laid.
    pub fn grid(&self) -> Option<&Grid> {
        self.standing.grids.last()
    }

    /// The windows of the whole picture: of the first grid laid.
    pub fn first_grid(&self) -> Option<&Grid> {
        self.standing.grids.first()
    }

    /// Unit direction of the light as it is estimated so far.
    pub fn light(&self) -> Option<[f64; 3]> {
        match self.find(*self.standing.lights.last()?) {
            Event::IlluminantEstimated(estimated) => Some(estimated.direction),
            Event::IlluminantGiven(IlluminantGiven { direction }) => Some(*direction),
            Event::LightChosen(chosen) => chosen.direction,
            _ => None,
        }
    }

    /// The region that a hypothesis became, once the regions of the result are numbered; none before that, and for a
    /// hypothesis that became no region.
    pub fn region_of(&self, hypothesis: HypothesisId) -> Option<RegionId> {
        match self.find(self.standing.finals?) {
            Event::Renumbered(Renumbered { regions }) => regions.get(hypothesis.index()).copied().flatten(),
            _ => None,
        }
    }

    /// A pixel's role; none as long as it has none.
    pub fn kind(&self, pixel: usize) -> PixelKind {
        let Some(stage_trace) = self.trace.stage_trace(Stage::Split).filter(|_| self.standing.labeled > 0)
        else {
            return PixelKind::Unassigned;
        };
        let kind =
            stage_trace.kinds().and_then(|kinds| kinds.as_slice().get(pixel)).copied().unwrap_or_default();
        if pixel < stage_trace.labeled_pixel(self.standing.labeled) { kind } else { PixelKind::Unassigned }
    }

    /// All pixels before this one have their role.
    pub fn labeled_up_to(&self) -> usize {
        let stage_trace = self.trace.stage_trace(Stage::Split).filter(|_| self.standing.labeled > 0);
        stage_trace.map_or(0, |stage_trace| stage_trace.labeled_pixel(self.standing.labeled))
    }

    /// Takes a step; false at the end.
    pub fn forward(&mut self) -> bool {
        let more = self.at < self.trace.len();
        self.play_to(self.at + usize::from(more));
        more
    }

    /// Takes a step back; false at the beginning.
    pub fn back(&mut self) -> bool {
        let more = self.at > 0;
        self.play_to(self.at - usize::from(more));
        more
    }

    /// Goes to after the first `n` steps, or to the end.
    pub fn seek(&mut self, n: usize) {
        let n = n.min(self.trace.len());
        let moves = |a: usize, b: usize| self.moves_before(a).abs_diff(self.moves_before(b));
        let here = moves(self.at, n);
        let shortcut = self.keyframes.iter().min_by_key(|frame| moves(frame.at, n));
        if here > NEAR
            && let Some(frame) = shortcut.filter(|frame| moves(frame.at, n) + self.labels.len() / 8 < here)
        {
            let frame = frame.clone();
            self.labels.as_mut_slice().copy_from_slice(frame.labels.as_slice());
            self.sizes = frame.sizes;
            // Only the labels jump: all else is played, as it is little.
            self.play_events(frame.at);
        }
        self.play_to(n);
    }

    /// Plays the whole trace once and keeps the labels as they are every now and then, so that later seeks are short.
    pub fn prepare(&mut self) {
        self.keyframes.clear();
        self.seek(0);
        // With a picture's worth of claims between keyframes, a seek plays about half of that at most.
        let every = self.labels.len().max(NEAR);
        let total = self.moves_before(self.trace.len());
        self.keep();
        for target in 1..=total / every {
            self.play_to(self.step_of_move(target * every));
            self.keep();
        }
        self.play_to(self.trace.len());
        self.keep();
    }

    /// Memory of the labels and keyframes, bytes.
    pub fn bytes(&self) -> usize {
        (self.keyframes.len() + 1) * self.labels.len() * size_of::<u16>()
    }

    fn keep(&mut self) {
        let labels = Arc::new(self.labels.clone());
        self.keyframes.push(Keyframe { at: self.at, labels, sizes: self.sizes.clone() });
    }

    /// Changes of hands among the first `n` steps.
    fn moves_before(&self, n: usize) -> usize {
        let stage_traces = self.trace.stage_traces().iter().zip(self.trace.starts());
        stage_traces
            .map(|(stage_trace, &start)| {
                let local = n.saturating_sub(start).min(stage_trace.len());
                (local - stage_trace.events_before(local)).min(stage_trace.moves().len())
            })
            .sum()
    }

    /// The step after which so many hands have changed.
    fn step_of_move(&self, moves: usize) -> usize {
        let mut left = moves;
        for (stage_trace, &start) in self.trace.stage_traces().iter().zip(self.trace.starts()) {
            if left < stage_trace.moves().len() {
                return start + stage_trace.step_of_move(left);
            }
            left -= stage_trace.moves().len();
        }
        self.trace.len()
    }

    /// Plays events and claims up to step `n`, forward or back.
    fn play_to(&mut self, n: usize) {
        let (from, to) = (self.at, n);
        self.play_moves(from, to);
        self.play_events(to);
    }

    fn play_moves(&mut self, from: usize, to: usize) {
        let trace = Arc::clone(&self.trace);
        let spans = trace.stage_traces().iter().zip(trace.starts());
        let range = |stage_trace: &StageTrace, start: usize, n: usize| {
            let local = n.saturating_sub(start).min(stage_trace.len());
            (local - stage_trace.events_before(local)).min(stage_trace.moves().len())
        };
        if from <= to {
            for (stage_trace, &start) in spans {
                for change in
                    &stage_trace.moves()[range(stage_trace, start, from)..range(stage_trace, start, to)]
                {
                    if let Some(Owners { before, after }) = change.change() {
                        self.hand_over(change.pixel(), before, after);
                    }
                }
            }
        } else {
            for (stage_trace, &start) in spans.rev() {
                for change in stage_trace.moves()
                    [range(stage_trace, start, to)..range(stage_trace, start, from)]
                    .iter()
                    .rev()
                {
                    if let Some(Owners { before, after }) = change.change() {
                        self.hand_over(change.pixel(), after, before);
                    }
                }
            }
        }
    }

    #[inline]
    fn hand_over(&mut self, pixel: usize, from: Option<HypothesisId>, to: Option<HypothesisId>) {
        let (from, to) = (HypothesisId::label(from), HypothesisId::label(to));
        debug_assert_eq!(self.labels[pixel], from, "pixel {pixel}");
        self.labels[pixel] = to;
        let most = usize::from(from.max(to));
        if most >= self.sizes.len() {
            self.sizes.resize(most + 1, 0);
        }
        self.sizes[usize::from(from)] -= 1;
        self.sizes[usize::from(to)] += 1;
    }

    fn play_events(&mut self, to: usize) {
        let trace = Arc::clone(&self.trace);
        let from = std::mem::replace(&mut self.at, to);
        let spans: Vec<(usize, &Arc<StageTrace>, usize)> = trace
            .stage_traces()
            .iter()
            .zip(trace.starts())
            .enumerate()
            .map(|(i, (stage_trace, &start))| (i, stage_trace, start))
            .collect();
        let before = |stage_trace: &StageTrace, start: usize, n: usize| {
            stage_trace.events_before(n.saturating_sub(start).min(stage_trace.len()))
        };
        let labels = |stage_trace: &StageTrace, start: usize, n: usize| {
            let local = n.saturating_sub(start).min(stage_trace.len());
            (local - stage_trace.events_before(local)).saturating_sub(stage_trace.moves().len())
        };
        self.standing.labeled =
            spans.iter().map(|&(_, stage_trace, start)| labels(stage_trace, start, to)).sum();
        if from <= to {
            for (index, stage_trace, start) in spans {
                for event in before(stage_trace, start, from)..before(stage_trace, start, to) {
                    self.standing.take(stage_trace.event(event), (index, event));
                }
            }
        } else {
            for (_, stage_trace, start) in spans.into_iter().rev() {
                for event in (before(stage_trace, start, to)..before(stage_trace, start, from)).rev() {
                    self.standing.take_back(stage_trace.event(event));
                }
            }
        }
    }

    fn find(&self, (stage_trace, event): EventId) -> &Event {
        self.trace.stage_traces()[stage_trace].event(event)
    }
}

/// Whether the same instant is shown, whatever way led there.
impl PartialEq for Replay {
    fn eq(&self, other: &Self) -> bool {
        let sizes = |replay: &Self| {
            let kept = replay.sizes.iter().rposition(|&size| size > 0).map_or(0, |last| last + 1);
            replay.sizes[..kept].to_vec()
        };
        self.at == other.at
            && self.labels == other.labels
            && sizes(self) == sizes(other)
            && self.standing == other.standing
    }
}
