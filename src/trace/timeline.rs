//! The trace of a run: the traces of all stages, with steps that are numbered through all of them.

use super::{Block, Event, PassSpan, Stage, StageTrace, Step};
use crate::photo::{LinearImage, Masks};
use crate::raster::{Blocks, Mask, PixelIndex, RegionId, Roi};
use std::ops::Range;
use std::sync::Arc;

/// The place of an event in a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct EventId {
    /// Index of the stage trace.
    pub(super) stage: usize,
    /// Index among the events of the stage.
    pub(super) index: usize,
}

/// Every decision about one finer picture of the second look, which shows a rectangle of the photograph. Numbers of hypotheses, areas and
/// pixels in the record are those of the finer picture.
#[derive(Clone, Debug)]
pub struct SecondLookRecord {
    /// The rectangle, pixels of the photograph.
    pub(crate) roi: Roi,
    /// The colors of the finer picture.
    pub(crate) image: Arc<LinearImage>,
    /// The masks of the finer picture.
    pub(crate) masks: Arc<Masks>,
    /// The finer pixels that were looked at.
    pub(crate) patches: Mask,
    /// The decisions, in pixels and numbers of the finer picture.
    pub trace: Trace,
    /// Number in the result of each region of the finer picture, by [`RegionId::index`]; none for a region that was not kept.
    pub regions: Vec<Option<RegionId>>,
}

/// All decisions of a run, stage after stage. Steps are counted through all stages.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The blocks of the photograph that are the pixels of the working picture.
    pixel_blocks: Blocks,
    stage_traces: Vec<Arc<StageTrace>>,
    /// First step of each stage, and the end.
    starts: Vec<usize>,
    /// The records of the second look, one for each finer picture.
    second_look: Arc<[SecondLookRecord]>,
}

impl Trace {
    /// The traces of the stages of a picture of `width × height` pixels, in the order of the stages.
    pub fn new(width: usize, height: usize, stage_traces: Vec<Arc<StageTrace>>) -> Self {
        Self::of_working_picture(Blocks::new(1, width, height), stage_traces)
    }

    /// The traces of the stages of a working picture, whose pixels are the blocks `pixel_blocks` of a photograph.
    pub fn of_working_picture(pixel_blocks: Blocks, stage_traces: Vec<Arc<StageTrace>>) -> Self {
        let mut starts = vec![0];
        let mut end = 0;
        for stage_trace in &stage_traces {
            end += stage_trace.len();
            starts.push(end);
        }
        Self { pixel_blocks, stage_traces, starts, second_look: Arc::default() }
    }

    /// This trace with the records of the second look, one for each finer picture.
    #[must_use]
    pub fn with_second_look(self, second_look: Arc<[SecondLookRecord]>) -> Self {
        Self { second_look, ..self }
    }

    /// The records of the second look, one for each finer picture; their steps are not counted among those of this trace.
    pub fn second_look(&self) -> &[SecondLookRecord] {
        &self.second_look
    }

    /// Columns of the working picture.
    pub fn width(&self) -> usize {
        self.pixel_blocks.columns()
    }

    /// Rows of the working picture.
    pub fn height(&self) -> usize {
        self.pixel_blocks.rows()
    }

    /// The blocks of the photograph; each is a pixel of the working picture, whose decisions the trace holds.
    pub fn pixel_blocks(&self) -> Blocks {
        self.pixel_blocks
    }

    /// The working pixel that contains a pixel of the photograph.
    pub fn working_pixel(&self, pixel: PixelIndex) -> PixelIndex {
        PixelIndex::from_index(self.pixel_blocks.block_of(pixel.index()))
    }

    /// Number of steps.
    pub fn len(&self) -> usize {
        self.starts.last().copied().unwrap_or(0)
    }

    /// Whether nothing was decided.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Memory of the traces, bytes.
    pub fn bytes(&self) -> usize {
        self.stage_traces.iter().map(|stage_trace| stage_trace.bytes()).sum()
    }

    /// Step `n`; none from [`Trace::len`] on.
    pub fn step(&self, n: usize) -> Option<Step<'_>> {
        let (index, local) = self.locate(n)?;
        self.stage_traces[index].step(local)
    }

    /// All steps, numbered, from either end.
    pub fn steps(&self) -> impl DoubleEndedIterator<Item = (usize, Step<'_>)> {
        self.steps_in(0..self.len())
    }

    /// The steps in a range, numbered, from either end.
    pub fn steps_in(&self, range: Range<usize>) -> impl DoubleEndedIterator<Item = (usize, Step<'_>)> {
        self.numbered().flat_map(move |(start, stage_trace)| {
            let from = range.start.saturating_sub(start).min(stage_trace.len());
            let to = range.end.saturating_sub(start).min(stage_trace.len());
            (start + from..start + to).zip(stage_trace.steps_in(from..to))
        })
    }

    /// All events, with their steps.
    pub fn events(&self) -> impl DoubleEndedIterator<Item = (usize, &Event)> {
        self.numbered().flat_map(|(start, stage_trace)| {
            stage_trace.events().map(move |(step, event)| (start + step, event))
        })
    }

    /// The event at step `n`; none where the step is no event.
    pub fn event(&self, n: usize) -> Option<&Event> {
        match self.step(n)? {
            Step::Event(event) => Some(event),
            _ => None,
        }
    }

    /// The stages with their steps.
    pub fn stages(&self) -> impl Iterator<Item = (Stage, Range<usize>)> + '_ {
        let spans = self.starts.windows(2).map(|pair| pair[0]..pair[1]);
        self.stage_traces
            .iter()
            .zip(spans)
            .filter_map(|(stage_trace, span)| Some((stage_trace.stage()?, span)))
    }

    /// The stage in which step `n` lies; none outside.
    pub fn stage_at(&self, n: usize) -> Option<Stage> {
        self.locate(n).and_then(|(index, _)| self.stage_traces[index].stage())
    }

    /// The steps of a stage; empty where the trace does not hold the stage.
    pub fn steps_of(&self, stage: Stage) -> Range<usize> {
        self.stages().find(|(found, _)| *found == stage).map_or(0..0, |(_, span)| span)
    }

    /// The trace of a stage.
    pub fn stage_trace(&self, stage: Stage) -> Option<&Arc<StageTrace>> {
        self.stage_traces.iter().find(|stage_trace| stage_trace.stage() == Some(stage))
    }

    /// The passes, in order.
    pub fn passes(&self) -> impl DoubleEndedIterator<Item = PassSpan> + '_ {
        self.numbered().flat_map(|(start, stage_trace)| {
            stage_trace
                .passes()
                .iter()
                .map(move |span| PassSpan { steps: shifted(&span.steps, start), pass: span.pass })
        })
    }

    /// The blocks, in order.
    pub fn blocks(&self) -> impl DoubleEndedIterator<Item = Block> + '_ {
        self.numbered().flat_map(|(start, stage_trace)| {
            stage_trace
                .blocks()
                .iter()
                .map(move |block| Block { steps: shifted(&block.steps, start), topic: block.topic })
        })
    }

    /// The pass in which step `n` lies.
    pub fn pass_at(&self, n: usize) -> Option<PassSpan> {
        let (index, local) = self.locate(n)?;
        let passes = self.stage_traces[index].passes();
        let last = passes.partition_point(|span| span.steps.start <= local).checked_sub(1)?;
        let PassSpan { steps, pass } = &passes[last];
        steps.contains(&local).then(|| PassSpan { steps: shifted(steps, self.starts[index]), pass: *pass })
    }

    /// The block in which step `n` lies.
    pub fn block_at(&self, n: usize) -> Option<Block> {
        let (index, local) = self.locate(n)?;
        let blocks = self.stage_traces[index].blocks();
        let last = blocks.partition_point(|block| block.steps.start <= local).checked_sub(1)?;
        let Block { steps, topic } = &blocks[last];
        steps.contains(&local).then(|| Block { steps: shifted(steps, self.starts[index]), topic: *topic })
    }

    /// Number of contested claims, refusals and events among these steps: all steps but uncontested claims.
    pub fn decisions_in(&self, steps: Range<usize>) -> usize {
        let within = |start: usize, stage_trace: &StageTrace| {
            let (from, to) = (
                steps.start.max(start) - start,
                steps.end.min(start + stage_trace.len()).saturating_sub(start),
            );
            if from < to { stage_trace.decisions_before(to) - stage_trace.decisions_before(from) } else { 0 }
        };
        self.numbered().map(|(start, stage_trace)| within(start, stage_trace)).sum()
    }

    /// The first step at which two traces differ; none where they are the same. Stage traces that both share are not compared.
    pub fn first_difference(&self, other: &Self) -> Option<usize> {
        for (index, (one, two)) in self.stage_traces.iter().zip(&other.stage_traces).enumerate() {
            if Arc::ptr_eq(one, two) || one == two {
                continue;
            }
            let (mut a, mut b) = (one.steps(), two.steps());
            let same = std::iter::from_fn(|| match (a.next(), b.next()) {
                (Some(a), Some(b)) if a == b => Some(()),
                _ => None,
            });
            return Some(self.starts[index] + same.count());
        }
        (self.stage_traces.len() != other.stage_traces.len()).then(|| self.len().min(other.len()))
    }

    /// The events, each with its place in the trace.
    pub(super) fn placed_events(&self) -> impl Iterator<Item = (EventId, &Event)> {
        self.stage_traces.iter().enumerate().flat_map(|(stage, stage_trace)| {
            stage_trace.events().enumerate().map(move |(index, (_, event))| (EventId { stage, index }, event))
        })
    }

    /// The event at a place.
    pub(super) fn event_at(&self, id: EventId) -> &Event {
        self.stage_traces[id.stage].event(id.index)
    }

    /// The step of the event at a place.
    pub(super) fn step_of_event(&self, id: EventId) -> usize {
        self.starts[id.stage] + self.stage_traces[id.stage].step_of_event(id.index)
    }

    pub(super) fn stage_traces(&self) -> &[Arc<StageTrace>] {
        &self.stage_traces
    }

    pub(super) fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// Index of the stage trace in which step `n` lies, and its number there.
    pub(super) fn locate(&self, n: usize) -> Option<(usize, usize)> {
        if n >= self.len() {
            return None;
        }
        let index = self.starts.partition_point(|&start| start <= n) - 1;
        Some((index, n - self.starts[index]))
    }

    fn numbered(&self) -> impl DoubleEndedIterator<Item = (usize, &StageTrace)> + '_ {
        self.stage_traces.iter().enumerate().map(|(index, stage_trace)| (self.starts[index], &**stage_trace))
    }
}

fn shifted(steps: &Range<usize>, by: usize) -> Range<usize> {
    steps.start + by..steps.end + by
}
