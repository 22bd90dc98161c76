//! The decisions of one stage, in little memory.
//!
//! A change of owner takes 8 bytes: pixel, owner before, owner after. It can be played in both directions. A contest adds the
//! values that decided (13 bytes), an event its numbers; kinds take one byte per pixel. Decisions that can be computed again
//! exactly, like the refusal of a color outside a cylinder, are not kept (see `history`).

mod steps;

pub use steps::Steps;

use super::blocks::Contents;
use super::{Block, Contest, Event, LocalRecord, Measure, PassSpan, PixelKind, Stage, Step};
use crate::raster::{HypothesisId, LabelMap, PixelIndex, Raster};
use std::ops::Range;

/// Set in the pixel of a move where the pixel kept its owner.
const REFUSED: u32 = 1 << 31;

/// A change of a pixel's owner, or with [`REFUSED`] a change that was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Move {
    pixel: u32,
    owners: Owners,
}

/// The owner of a pixel before and after a change; none: no hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Owners {
    pub(super) before: Option<HypothesisId>,
    pub(super) after: Option<HypothesisId>,
}

impl Move {
    /// The pixel.
    #[inline]
    pub(super) fn pixel(self) -> usize {
        (self.pixel & !REFUSED) as usize
    }

    /// The owners of the pixel before and after the change; none where the change was refused.
    #[inline]
    pub(super) fn change(self) -> Option<Owners> {
        (self.pixel & REFUSED == 0).then_some(self.owners)
    }

    /// The hypothesis that has the pixel and the hypothesis that wanted the pixel, as owners before and after, whether or not
    /// the change was refused.
    #[inline]
    pub(super) fn owners(self) -> Owners {
        self.owners
    }
}

/// Every decision of one stage, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageTrace {
    stage: Option<Stage>,
    events: Vec<Event>,
    /// Step of each event, ascending. All other steps are moves, and after the moves the kinds of the pixels.
    event_steps: Vec<u32>,
    moves: Vec<Move>,
    /// Moves that were contested, ascending.
    contested: Vec<u32>,
    /// Values of challenger and holder of each contest.
    contest_values: Vec<[f32; 2]>,
    /// Measure of each contest.
    measures: Vec<Measure>,
    pixel_kinds: Option<PixelKinds>,
    local: Option<Box<LocalRecord>>,
    contents: Contents,
}

/// The kinds of all pixels; pixels without a kind are no steps.
#[derive(Clone, Debug, PartialEq)]
struct PixelKinds {
    kinds: Raster<PixelKind>,
    /// Number of pixels with a kind before each row, and in all.
    before_row: Vec<u32>,
}

impl StageTrace {
    pub(super) fn push_event(&mut self, event: Event) {
        self.event_steps.push((self.events.len() + self.moves.len()) as u32);
        self.events.push(event);
    }

    #[inline]
    pub(super) fn push_claim(
        &mut self,
        pixel: PixelIndex,
        before: Option<HypothesisId>,
        after: Option<HypothesisId>,
    ) {
        debug_assert_eq!(pixel.get() & REFUSED, 0, "pictures of two thousand megapixels are not read");
        self.moves.push(Move { pixel: pixel.get(), owners: Owners { before, after } });
    }

    /// Records a contest. A refused contest is a move of its own; a granted contest belongs to the move that the next
    /// [`StageTrace::push_claim`] appends.
    pub(super) fn push_contest(
        &mut self,
        pixel: PixelIndex,
        holder: HypothesisId,
        challenger: HypothesisId,
        granted: bool,
        contest: Contest,
    ) {
        self.contested.push(self.moves.len() as u32);
        self.contest_values.push([contest.challenger, contest.holder]);
        self.measures.push(contest.measure);
        if !granted {
            let owners = Owners { before: Some(holder), after: Some(challenger) };
            self.moves.push(Move { pixel: pixel.get() | REFUSED, owners });
        }
    }

    pub(super) fn set_kinds(&mut self, kinds: Raster<PixelKind>) {
        let mut sum = 0;
        let mut before_row = vec![0];
        for y in 0..kinds.height() {
            sum += kinds.row(y).iter().filter(|&&kind| kind != PixelKind::Unassigned).count() as u32;
            before_row.push(sum);
        }
        self.pixel_kinds = Some(PixelKinds { kinds, before_row });
    }

    pub(super) fn set_local(&mut self, record: LocalRecord) {
        self.local = Some(Box::new(record));
    }

    pub(super) fn finished(mut self, stage: Stage) -> Self {
        self.stage = Some(stage);
        self.contents = Contents::of(self.events(), self.len());
        self
    }

    /// The stage.
    pub fn stage(&self) -> Option<Stage> {
        self.stage
    }

    /// Number of steps.
    pub fn len(&self) -> usize {
        self.events.len() + self.moves.len() + self.kind_steps()
    }

    /// Whether nothing was decided.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Step `n`; none from [`StageTrace::len`] on.
    pub fn step(&self, n: usize) -> Option<Step<'_>> {
        match self.event_steps.binary_search(&(n as u32)) {
            Ok(index) => Some(Step::Event(&self.events[index])),
            Err(events) if n - events < self.moves.len() => Some(self.moved(n - events)),
            Err(events) => self.label(n - events - self.moves.len()),
        }
    }

    /// All steps, from either end.
    pub fn steps(&self) -> Steps<'_> {
        self.steps_in(0..self.len())
    }

    /// The steps in a range, from either end.
    pub fn steps_in(&self, range: Range<usize>) -> Steps<'_> {
        Steps::new(self, &range)
    }

    /// The events, each with the step at which it lies.
    pub fn events(&self) -> impl DoubleEndedIterator<Item = (usize, &Event)> + ExactSizeIterator {
        self.event_steps.iter().map(|&step| step as usize).zip(&self.events)
    }

    /// Memory of the trace, bytes.
    pub fn bytes(&self) -> usize {
        let boxed: usize = self.events.iter().map(Event::heap_bytes).sum();
        self.events.len() * (size_of::<Event>() + size_of::<u32>())
            + boxed
            + self.moves.len() * size_of::<Move>()
            + self.contested.len() * (size_of::<u32>() + size_of::<[f32; 2]>() + size_of::<Measure>())
            + self
                .pixel_kinds
                .as_ref()
                .map_or(0, |pixel_kinds| pixel_kinds.kinds.len() + 4 * pixel_kinds.before_row.len())
            + self.local.as_ref().map_or(0, |local| local.bytes())
    }

    /// Plays all changes of owners on `labels`, which hold hypotheses.
    ///
    /// # Errors
    /// The index, among all moves, of the first move that contradicts the moves before: its pixel has another
    /// owner, or lies outside the picture.
    pub fn play(&self, labels: &mut LabelMap) -> Result<(), usize> {
        for (index, change) in self.moves.iter().enumerate() {
            let label = labels.as_mut_slice().get_mut(change.pixel()).ok_or(index)?;
            if *label != HypothesisId::label(change.owners.before) {
                return Err(index);
            }
            if let Some(Owners { after, .. }) = change.change() {
                *label = HypothesisId::label(after);
            }
        }
        Ok(())
    }

    /// The passes, by the steps of the stage.
    pub(super) fn passes(&self) -> &[PassSpan] {
        &self.contents.passes
    }

    /// The blocks, by the steps of the stage.
    pub(super) fn blocks(&self) -> &[Block] {
        &self.contents.blocks
    }

    /// Events and contests before step `n`.
    pub(super) fn decisions_before(&self, n: usize) -> usize {
        let events = self.events_before(n);
        let moves = (n - events) as u32;
        events + self.contested.partition_point(|&contested| contested < moves)
    }

    pub(super) fn moves(&self) -> &[Move] {
        &self.moves
    }

    /// Number of events before step `n`.
    pub(super) fn events_before(&self, n: usize) -> usize {
        self.event_steps.partition_point(|&step| (step as usize) < n)
    }

    /// Number of moves before step `n`.
    pub(super) fn moves_before(&self, n: usize) -> usize {
        let n = n.min(self.len());
        (n - self.events_before(n)).min(self.moves.len())
    }

    /// Number of the steps before step `n` that give a pixel its kind.
    pub(super) fn kind_steps_before(&self, n: usize) -> usize {
        let n = n.min(self.len());
        (n - self.events_before(n)).saturating_sub(self.moves.len())
    }

    pub(super) fn event(&self, index: usize) -> &Event {
        &self.events[index]
    }

    /// Step of the event with this index.
    pub(super) fn step_of_event(&self, index: usize) -> usize {
        self.event_steps[index] as usize
    }

    /// Step of the move with this index.
    pub(super) fn step_of_move(&self, index: usize) -> usize {
        // The j-th event has `event_steps[j] − j` moves before it: ascending in j.
        let (mut low, mut high) = (0, self.event_steps.len());
        while low < high {
            let middle = usize::midpoint(low, high);
            if self.event_steps[middle] as usize - middle <= index { low = middle + 1 } else { high = middle }
        }
        index + low
    }

    /// The contest of a move; none where only one hypothesis wanted the pixel.
    pub(super) fn contest_of_move(&self, index: usize) -> Option<Contest> {
        self.contested.binary_search(&(index as u32)).ok().map(|contest| self.contest(contest))
    }

    /// The kinds of all pixels, of the last stage.
    pub fn kinds(&self) -> Option<&Raster<PixelKind>> {
        self.pixel_kinds.as_ref().map(|pixel_kinds| &pixel_kinds.kinds)
    }

    /// The record of the local split, of the last stage.
    pub fn local(&self) -> Option<&LocalRecord> {
        self.local.as_deref()
    }

    /// The step at which a pixel got its kind; none for a pixel without a kind.
    pub fn step_of_kind(&self, pixel: usize) -> Option<usize> {
        let pixel_kinds = self.pixel_kinds.as_ref()?;
        let kind = pixel_kinds.kinds.as_slice().get(pixel)?;
        let (row, column) = (pixel / pixel_kinds.kinds.width(), pixel % pixel_kinds.kinds.width());
        let in_row =
            pixel_kinds.kinds.row(row)[..column].iter().filter(|&&k| k != PixelKind::Unassigned).count();
        let before = self.events.len() + self.moves.len() + pixel_kinds.before_row[row] as usize;
        (*kind != PixelKind::Unassigned).then_some(before + in_row)
    }

    /// The pixel of the `n`-th step that gives a pixel its kind, from 0; the number of all pixels where no such step
    /// exists; 0 without kinds.
    pub(super) fn pixel_of_kind_step(&self, n: usize) -> usize {
        let Some(pixel_kinds) = &self.pixel_kinds else { return 0 };
        let row = pixel_kinds.before_row.partition_point(|&before| before as usize <= n).saturating_sub(1);
        if row >= pixel_kinds.kinds.height() {
            return pixel_kinds.kinds.len();
        }
        let left = n - pixel_kinds.before_row[row] as usize;
        let mut labeled = pixel_kinds.kinds.row(row).iter().enumerate();
        let at = labeled.by_ref().filter(|&(_, &kind)| kind != PixelKind::Unassigned).nth(left);
        at.map_or(pixel_kinds.kinds.len(), |(column, _)| row * pixel_kinds.kinds.width() + column)
    }

    fn kind_steps(&self) -> usize {
        self.pixel_kinds
            .as_ref()
            .and_then(|pixel_kinds| pixel_kinds.before_row.last())
            .map_or(0, |&all| all as usize)
    }

    fn label(&self, n: usize) -> Option<Step<'_>> {
        let pixel_kinds = self.pixel_kinds.as_ref()?;
        let pixel = self.pixel_of_kind_step(n);
        let kind = *pixel_kinds.kinds.as_slice().get(pixel)?;
        Some(Step::Label { pixel: PixelIndex::from_index(pixel), kind })
    }

    fn moved(&self, index: usize) -> Step<'_> {
        self.moves[index].step(self.contest_of_move(index))
    }

    fn contest(&self, index: usize) -> Contest {
        let [challenger, holder] = self.contest_values[index];
        Contest { measure: self.measures[index], challenger, holder }
    }
}

impl Move {
    fn step<'a>(self, contest: Option<Contest>) -> Step<'a> {
        let pixel = PixelIndex::from_index(self.pixel());
        let Owners { before, after } = self.owners;
        match (self.change(), contest, before, after) {
            (None, Some(contest), Some(holder), Some(challenger)) => {
                Step::Refusal { pixel, holder, challenger, contest }
            }
            (_, contest, ..) => Step::Claim { pixel, before, after, contest },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{Dropped, Recorder, StageBegan, TraceRecorder};

    fn hypothesis(number: u16) -> HypothesisId {
        HypothesisId::from_label(number).unwrap()
    }

    fn recorder() -> TraceRecorder {
        let mut recorder = TraceRecorder::default();
        recorder.record(StageBegan { stage: Stage::Linear });
        recorder.claim(PixelIndex::new(1), HypothesisId::from_label(0), HypothesisId::from_label(1));
        let contest = Contest { measure: Measure::Axis, challenger: 2.0, holder: 1.0 };
        recorder.contest(PixelIndex::new(1), hypothesis(1), hypothesis(2), false, contest);
        recorder.record(Dropped { hypothesis: hypothesis(3), pixels: 0 });
        recorder.contest(
            PixelIndex::new(1),
            hypothesis(1),
            hypothesis(3),
            true,
            Contest { challenger: 0.5, ..contest },
        );
        recorder.claim(PixelIndex::new(1), HypothesisId::from_label(1), HypothesisId::from_label(3));
        recorder.labels(
            &Raster::from_vec(
                2,
                2,
                vec![PixelKind::Unassigned, PixelKind::Matte, PixelKind::Unassigned, PixelKind::Highlight],
            )
            .unwrap(),
        );
        recorder
    }

    #[test]
    fn steps_come_in_the_order_in_which_they_were_taken() {
        let stage_trace = recorder().finish(Stage::Linear).unwrap();
        let lost = Contest { measure: Measure::Axis, challenger: 2.0, holder: 1.0 };
        let won = Contest { measure: Measure::Axis, challenger: 0.5, holder: 1.0 };
        let expected = [
            Step::Event(&Event::StageBegan(StageBegan { stage: Stage::Linear })),
            Step::Claim {
                pixel: PixelIndex::new(1),
                before: HypothesisId::from_label(0),
                after: HypothesisId::from_label(1),
                contest: None,
            },
            Step::Refusal {
                pixel: PixelIndex::new(1),
                holder: hypothesis(1),
                challenger: hypothesis(2),
                contest: lost,
            },
            Step::Event(&Event::Dropped(Dropped { hypothesis: hypothesis(3), pixels: 0 })),
            Step::Claim {
                pixel: PixelIndex::new(1),
                before: HypothesisId::from_label(1),
                after: HypothesisId::from_label(3),
                contest: Some(won),
            },
            Step::Label { pixel: PixelIndex::new(1), kind: PixelKind::Matte },
            Step::Label { pixel: PixelIndex::new(3), kind: PixelKind::Highlight },
        ];
        assert_eq!(stage_trace.len(), expected.len());
        assert_eq!(stage_trace.steps().collect::<Vec<_>>(), expected);
        let back: Vec<Step> = stage_trace.steps().rev().collect();
        assert!(back.iter().eq(expected.iter().rev()));
        assert_eq!(stage_trace.steps_in(2..5).collect::<Vec<_>>(), expected[2..5]);
        for (n, step) in expected.iter().enumerate() {
            assert_eq!(stage_trace.step(n).as_ref(), Some(step), "step {n}");
        }
        assert_eq!(stage_trace.step(expected.len()), None);
        assert_eq!([0, 1, 2].map(|index| stage_trace.step_of_move(index)), [1, 2, 4]);
        assert_eq!([0, 1, 3].map(|pixel| stage_trace.step_of_kind(pixel)), [None, Some(5), Some(6)]);
        assert_eq!([0, 1, 2].map(|n| stage_trace.pixel_of_kind_step(n)), [1, 3, 4]);
    }

    #[test]
    fn a_record_that_contradicts_itself_is_found_out() {
        let play = |claims: &[(u32, u16, u16)]| {
            let mut recorder = TraceRecorder::default();
            for &(pixel, before, after) in claims {
                let [before, after] = [before, after].map(HypothesisId::from_label);
                recorder.claim(PixelIndex::new(pixel), before, after);
            }
            recorder.finish(Stage::Linear).unwrap().play(&mut LabelMap::filled(1, 1, 0))
        };
        assert_eq!(play(&[(0, 0, 1), (0, 1, 2)]), Ok(()));
        assert_eq!(play(&[(0, 0, 1), (0, 0, 2)]), Err(1));
        assert_eq!(play(&[(5, 0, 1)]), Err(0));
    }

    #[test]
    fn an_event_and_a_move_take_as_little_as_promised() {
        assert_eq!(size_of::<Move>(), 8);
        assert!(size_of::<Event>() <= 40, "{}", size_of::<Event>());
    }
}
