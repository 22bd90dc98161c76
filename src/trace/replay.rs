//! A cursor in a trace, and the state of the analysis at the cursor.
//!
//! Claims are played on the label map one by one, in either direction; events change the [`ReplayState`]. For a long way the cursor
//! starts from a keyframe: the labels as they were at one of a few steps.

use super::replay_state::{Grid, Hypothesis, ReplayState};
use super::stage_trace::Owners;
use super::timeline::EventId;
use super::{CandidateChosen, Pass, PixelKind, SliceMade, Stage, StageTrace, Step, Trace};
use crate::raster::{HypothesisId, LabelMap, RegionId, UNASSIGNED};
use std::ops::Range;
use std::sync::Arc;

/// Number of claims up to which the cursor plays from its place and looks for no keyframe.
const NEAR: usize = 1 << 16;

/// The state of the analysis after some steps of a trace.
#[derive(Clone, Debug)]
pub struct Replay {
    trace: Arc<Trace>,
    at: usize,
    labels: LabelMap,
    /// Pixels of each label: of no hypothesis first, then of each hypothesis.
    sizes: Vec<u32>,
    state: ReplayState,
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
        Self { trace, at: 0, labels, sizes, state: ReplayState::default(), keyframes: Vec::new() }
    }

    /// The trace.
    pub fn trace(&self) -> &Arc<Trace> {
        &self.trace
    }

    /// Number of steps taken.
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
        &self.state.hypotheses
    }

    /// The hypotheses so far, ended ones included, each with its id.
    pub fn numbered_hypotheses(
        &self,
    ) -> impl DoubleEndedIterator<Item = (HypothesisId, &Hypothesis)> + ExactSizeIterator {
        HypothesisId::all(self.state.hypotheses.len()).zip(&self.state.hypotheses)
    }

    /// One hypothesis; none where the hypothesis was not made yet.
    pub fn hypothesis(&self, hypothesis: HypothesisId) -> Option<&Hypothesis> {
        self.state.hypothesis(hypothesis)
    }

    /// The slice of a hypothesis, where there is one.
    pub fn slice(&self, hypothesis: HypothesisId) -> Option<&SliceMade> {
        self.state.slice(&self.trace, hypothesis)
    }

    /// The highlight line chosen for a hypothesis.
    pub fn highlight(&self, hypothesis: HypothesisId) -> Option<&CandidateChosen> {
        self.state.highlight(&self.trace, hypothesis)
    }

    /// The grid of windows that was laid last.
    pub fn grid(&self) -> Option<&Grid> {
        self.state.grids.last()
    }

    /// The grid of windows of the whole picture, which was laid first.
    pub fn first_grid(&self) -> Option<&Grid> {
        self.state.grids.first()
    }

    /// Unit direction of the light as it is estimated or chosen so far.
    pub fn light(&self) -> Option<[f64; 3]> {
        self.state.light(&self.trace)
    }

    /// The region that a hypothesis became, once the regions of the result are numbered; none before that, and for a
    /// hypothesis that became no region.
    pub fn region_of(&self, hypothesis: HypothesisId) -> Option<RegionId> {
        self.state.region_of(&self.trace, hypothesis)
    }

    /// Kind of a pixel; unassigned as long as the kind is not decided.
    pub fn kind(&self, pixel: usize) -> PixelKind {
        let Some(stage_trace) = self.trace.stage_trace(Stage::Split).filter(|_| self.state.labeled > 0)
        else {
            return PixelKind::Unassigned;
        };
        let kind =
            stage_trace.kinds().and_then(|kinds| kinds.as_slice().get(pixel)).copied().unwrap_or_default();
        if pixel < stage_trace.pixel_of_kind_step(self.state.labeled) { kind } else { PixelKind::Unassigned }
    }

    /// Number of leading pixels whose kind is decided.
    pub fn labeled_up_to(&self) -> usize {
        let stage_trace = self.trace.stage_trace(Stage::Split).filter(|_| self.state.labeled > 0);
        stage_trace.map_or(0, |stage_trace| stage_trace.pixel_of_kind_step(self.state.labeled))
    }

    /// Takes one step; false at the end.
    pub fn forward(&mut self) -> bool {
        let more = self.at < self.trace.len();
        self.play_to(self.at + usize::from(more));
        more
    }

    /// Takes one step back; false at the beginning.
    pub fn back(&mut self) -> bool {
        let more = self.at > 0;
        self.play_to(self.at - usize::from(more));
        more
    }

    /// Moves the cursor behind the first `n` steps, or to the end.
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
            // Only the labels are taken from the keyframe: events are few, and are played.
            self.play_events(frame.at);
        }
        self.play_to(n);
    }

    /// Plays the whole trace once and makes keyframes, so that later seeks are short.
    pub fn prepare(&mut self) {
        self.keyframes.clear();
        self.seek(0);
        // With as many claims between keyframes as the picture has pixels, a seek plays about half as many at most.
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

    /// Number of moves among the first `n` steps.
    fn moves_before(&self, n: usize) -> usize {
        let stage_traces = self.trace.stage_traces().iter().zip(self.trace.starts());
        stage_traces.map(|(stage_trace, &start)| stage_trace.moves_before(n.saturating_sub(start))).sum()
    }

    /// The step of the move with this number.
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
        let moves = |stage_trace: &StageTrace, start: usize, steps: Range<usize>| {
            let [first, end] =
                [steps.start, steps.end].map(|n| stage_trace.moves_before(n.saturating_sub(start)));
            first..end
        };
        if from <= to {
            for (stage_trace, &start) in spans {
                for change in &stage_trace.moves()[moves(stage_trace, start, from..to)] {
                    if let Some(Owners { before, after }) = change.change() {
                        self.change_owner(change.pixel(), before, after);
                    }
                }
            }
        } else {
            for (stage_trace, &start) in spans.rev() {
                for change in stage_trace.moves()[moves(stage_trace, start, to..from)].iter().rev() {
                    if let Some(Owners { before, after }) = change.change() {
                        self.change_owner(change.pixel(), after, before);
                    }
                }
            }
        }
    }

    #[inline]
    fn change_owner(&mut self, pixel: usize, from: Option<HypothesisId>, to: Option<HypothesisId>) {
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
            stage_trace.events_before(n.saturating_sub(start))
        };
        let kinds = spans.iter();
        let kinds =
            kinds.map(|&(_, stage_trace, start)| stage_trace.kind_steps_before(to.saturating_sub(start)));
        self.state.labeled = kinds.sum();
        if from <= to {
            for (index, stage_trace, start) in spans {
                for event in before(stage_trace, start, from)..before(stage_trace, start, to) {
                    self.state.take(stage_trace.event(event), EventId { stage: index, index: event });
                }
            }
        } else {
            for (_, stage_trace, start) in spans.into_iter().rev() {
                for event in (before(stage_trace, start, to)..before(stage_trace, start, from)).rev() {
                    self.state.take_back(stage_trace.event(event));
                }
            }
        }
    }
}

/// Equal cursors show the same instant, whatever way led there.
impl PartialEq for Replay {
    fn eq(&self, other: &Self) -> bool {
        let sizes = |replay: &Self| {
            let kept = replay.sizes.iter().rposition(|&size| size > 0).map_or(0, |last| last + 1);
            replay.sizes[..kept].to_vec()
        };
        self.at == other.at
            && self.labels == other.labels
            && sizes(self) == sizes(other)
            && self.state == other.state
    }
}
