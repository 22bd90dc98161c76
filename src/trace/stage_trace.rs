//! One stage's decisions, compactly.
//!
//! A change of hands takes 8 bytes: the pixel, whose it was, whose it is. It can be undone as easily as done. A contest adds
//! what it was decided by (13 bytes), an event its numbers; labels are a byte a pixel. What can be computed again exactly,
//! like the refusal of a color outside a cylinder, is not kept (see `history`).

mod steps;

pub use steps::Steps;

use super::timeline::Contents;
use super::{Block, Contest, Event, LocalRecord, Measure, PassSpan, PixelKind, Stage, Step};
use crate::raster::{LabelMap, Raster};
use std::ops::Range;

/// Set in a move's pixel where the pixel did not change hands.
const REFUSED: u32 = 1 << 31;

/// A change of hands, or with [`REFUSED`] one that did not happen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Move {
    pixel: u32,
    before: u16,
    after: u16,
}

impl Move {
    /// The pixel.
    #[inline]
    pub(super) fn pixel(self) -> usize {
        (self.pixel & !REFUSED) as usize
    }

    /// Whether the pixel changed hands: from the first region to the second.
    #[inline]
    pub(super) fn hands(self) -> Option<(u16, u16)> {
        (self.pixel & REFUSED == 0).then_some((self.before, self.after))
    }

    /// The regions concerned, whether or not the pixel changed hands.
    #[inline]
    pub(super) fn regions(self) -> (u16, u16) {
        (self.before, self.after)
    }
}

/// Every decision of one stage, in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageTrace {
    stage: Option<Stage>,
    events: Vec<Event>,
    /// Step at which each event lies, ascending. All other steps are moves, or labels after these.
    event_steps: Vec<u32>,
    moves: Vec<Move>,
    /// Moves that were contested, ascending, and by what they were decided.
    contested: Vec<u32>,
    shown: Vec<[f32; 2]>,
    measures: Vec<Measure>,
    labels: Option<Labels>,
    local: Option<Box<LocalRecord>>,
    contents: Contents,
}

/// Every pixel's role; those that have none are no steps.
#[derive(Clone, Debug, PartialEq)]
struct Labels {
    kinds: Raster<PixelKind>,
    /// Labeled pixels before each row, and in all.
    before_row: Vec<u32>,
}

impl StageTrace {
    pub(super) fn push_event(&mut self, event: Event) {
        self.event_steps.push((self.events.len() + self.moves.len()) as u32);
        self.events.push(event);
    }

    #[inline]
    pub(super) fn push_claim(&mut self, pixel: u32, before: u16, after: u16) {
        debug_assert_eq!(pixel & REFUSED, 0, "pictures of two thousand megapixels are not read");
        self.moves.push(Move { pixel, before, after });
    }

    pub(super) fn push_contest(
        &mut self,
        pixel: u32,
        holder: u16,
        challenger: u16,
        granted: bool,
        contest: Contest,
    ) {
        self.contested.push(self.moves.len() as u32);
        self.shown.push([contest.challenger, contest.holder]);
        self.measures.push(contest.measure);
        if !granted {
            self.moves.push(Move { pixel: pixel | REFUSED, before: holder, after: challenger });
        }
    }

    pub(super) fn set_labels(&mut self, kinds: Raster<PixelKind>) {
        let mut sum = 0;
        let mut before_row = vec![0];
        for y in 0..kinds.height() {
            sum += kinds.row(y).iter().filter(|&&kind| kind != PixelKind::Unassigned).count() as u32;
            before_row.push(sum);
        }
        self.labels = Some(Labels { kinds, before_row });
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
        self.events.len() + self.moves.len() + self.labeled()
    }

    /// Whether nothing was decided.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What happened at step `n`; none from [`StageTrace::len`] on.
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

    /// Memory that it takes, bytes.
    pub fn bytes(&self) -> usize {
        let boxed: usize = self.events.iter().map(Event::heap_bytes).sum();
        self.events.len() * (size_of::<Event>() + size_of::<u32>())
            + boxed
            + self.moves.len() * size_of::<Move>()
            + self.contested.len() * (size_of::<u32>() + size_of::<[f32; 2]>() + size_of::<Measure>())
            + self.labels.as_ref().map_or(0, |labels| labels.kinds.len() + 4 * labels.before_row.len())
            + self.local.as_ref().map_or(0, |local| local.bytes())
    }

    /// Plays all changes of hands on `labels`, by the regions' numbers of birth.
    ///
    /// # Errors
    /// The number of the first change that contradicts what went before it: of a pixel that was in other hands, or outside
    /// the picture.
    pub fn play(&self, labels: &mut LabelMap) -> Result<(), usize> {
        for (index, change) in self.moves.iter().enumerate() {
            let label = labels.as_mut_slice().get_mut(change.pixel()).ok_or(index)?;
            if *label != change.before {
                return Err(index);
            }
            if let Some((_, after)) = change.hands() {
                *label = after;
            }
        }
        Ok(())
    }

    /// Its passes, by its own steps.
    pub(super) fn passes(&self) -> &[PassSpan] {
        &self.contents.passes
    }

    /// Its blocks, likewise.
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

    pub(super) fn event(&self, index: usize) -> &Event {
        &self.events[index]
    }

    /// Step of the change of hands with this index.
    pub(super) fn step_of_move(&self, index: usize) -> usize {
        // The j-th event has `event_steps[j] − j` moves before it: ascending in j.
        let (mut low, mut high) = (0, self.event_steps.len());
        while low < high {
            let middle = usize::midpoint(low, high);
            if self.event_steps[middle] as usize - middle <= index { low = middle + 1 } else { high = middle }
        }
        index + low
    }

    /// By what a change of hands was decided, where two regions wanted the pixel.
    pub(super) fn contest_of_move(&self, index: usize) -> Option<Contest> {
        self.contested.binary_search(&(index as u32)).ok().map(|contest| self.contest(contest))
    }

    /// Every pixel's role, of the last stage.
    pub fn kinds(&self) -> Option<&Raster<PixelKind>> {
        self.labels.as_ref().map(|labels| &labels.kinds)
    }

    /// What pixels were judged by where the model does not hold, of the last stage.
    pub fn local(&self) -> Option<&LocalRecord> {
        self.local.as_deref()
    }

    /// Step at which a pixel got its role; none where it got none.
    pub fn step_of_label(&self, pixel: usize) -> Option<usize> {
        let labels = self.labels.as_ref()?;
        let kind = labels.kinds.as_slice().get(pixel)?;
        let (row, column) = (pixel / labels.kinds.width(), pixel % labels.kinds.width());
        let in_row = labels.kinds.row(row)[..column].iter().filter(|&&k| k != PixelKind::Unassigned).count();
        let before = self.events.len() + self.moves.len() + labels.before_row[row] as usize;
        (*kind != PixelKind::Unassigned).then_some(before + in_row)
    }

    /// The pixel that gets its role as the `n`-th; the picture's end where all have theirs.
    pub(super) fn labeled_pixel(&self, n: usize) -> usize {
        let Some(labels) = &self.labels else { return 0 };
        let row = labels.before_row.partition_point(|&before| before as usize <= n).saturating_sub(1);
        if row >= labels.kinds.height() {
            return labels.kinds.len();
        }
        let left = n - labels.before_row[row] as usize;
        let mut labeled = labels.kinds.row(row).iter().enumerate();
        let at = labeled.by_ref().filter(|&(_, &kind)| kind != PixelKind::Unassigned).nth(left);
        at.map_or(labels.kinds.len(), |(column, _)| row * labels.kinds.width() + column)
    }

    fn labeled(&self) -> usize {
        self.labels.as_ref().and_then(|labels| labels.before_row.last()).map_or(0, |&all| all as usize)
    }

    fn label(&self, n: usize) -> Option<Step<'_>> {
        let labels = self.labels.as_ref()?;
        let pixel = self.labeled_pixel(n);
        let kind = *labels.kinds.as_slice().get(pixel)?;
        Some(Step::Label { pixel: pixel as u32, kind })
    }

    fn moved(&self, index: usize) -> Step<'_> {
        self.moves[index].step(self.contest_of_move(index))
    }

    fn contest(&self, index: usize) -> Contest {
        let [challenger, holder] = self.shown[index];
        Contest { measure: self.measures[index], challenger, holder }
    }
}

impl Move {
    fn step<'a>(self, contest: Option<Contest>) -> Step<'a> {
        let pixel = self.pixel() as u32;
        match (self.hands(), contest) {
            (None, Some(contest)) => {
                Step::Refusal { pixel, holder: self.before, challenger: self.after, contest }
            }
            (_, contest) => Step::Claim { pixel, before: self.before, after: self.after, contest },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{Dropped, Recorder, StageBegan, TraceRecorder};

    fn recorder() -> TraceRecorder {
        let mut recorder = TraceRecorder::default();
        recorder.record(StageBegan { stage: Stage::Linear });
        recorder.claim(1, 0, 1);
        let contest = Contest { measure: Measure::Axis, challenger: 2.0, holder: 1.0 };
        recorder.contest(1, 1, 2, false, contest);
        recorder.record(Dropped { region: 3, pixels: 0 });
        recorder.contest(1, 1, 3, true, Contest { challenger: 0.5, ..contest });
        recorder.claim(1, 1, 3);
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
            Step::Claim { pixel: 1, before: 0, after: 1, contest: None },
            Step::Refusal { pixel: 1, holder: 1, challenger: 2, contest: lost },
            Step::Event(&Event::Dropped(Dropped { region: 3, pixels: 0 })),
            Step::Claim { pixel: 1, before: 1, after: 3, contest: Some(won) },
            Step::Label { pixel: 1, kind: PixelKind::Matte },
            Step::Label { pixel: 3, kind: PixelKind::Highlight },
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
        assert_eq!([0, 1, 3].map(|pixel| stage_trace.step_of_label(pixel)), [None, Some(5), Some(6)]);
        assert_eq!([0, 1, 2].map(|n| stage_trace.labeled_pixel(n)), [1, 3, 4]);
    }

    #[test]
    fn a_record_that_contradicts_itself_is_found_out() {
        let play = |claims: &[(u32, u16, u16)]| {
            let mut recorder = TraceRecorder::default();
            for &(pixel, before, after) in claims {
                recorder.claim(pixel, before, after);
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
