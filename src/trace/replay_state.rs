//! The state of the analysis after some events of a trace, but for the labels: windows, areas, hypotheses, lights and the
//! decisions of the split. One function interprets the record: the cursor of a replay, the history of a pixel and the lineage of
//! a region read the state that it makes. Every part is a stack that is pushed forward and popped back.

use super::timeline::EventId;
use super::{
    Absorbed, CandidateChosen, Class, ComponentSplit, Dropped, Event, HypothesisChosen, HypothesisPassedOver,
    IlluminantGiven, MarkedCluster, MarkedLineFitted, MergeTried, PassedOver, PatchMade, RegionsMerged,
    Renumbered, SliceMade, Trace, VectorsFitted, WindowClassified, WindowsLaid,
};
use crate::color::{Cylinder, Line};
use crate::raster::{HypothesisId, Raster, RegionId};

/// The state after some events.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ReplayState {
    pub(super) grids: Vec<Grid>,
    /// The hypotheses so far, ended ones included, by [`HypothesisId::index`].
    pub(super) hypotheses: Vec<Hypothesis>,
    /// The estimates and choices of the light so far.
    pub(super) lights: Vec<EventId>,
    /// The event that numbered the regions of the result.
    numbered: Option<EventId>,
    /// The fits of the regions' vectors so far, in the order of the regions.
    vectors: Vec<EventId>,
    /// The decisions of the local split so far.
    pub(super) local: Vec<EventId>,
    /// Number of pixels that have their kind.
    pub(super) labeled: usize,
}

/// A grid of windows, and how far its windows are classified and merged.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Grid {
    /// Size and number of the windows.
    pub laid: WindowsLaid,
    /// Class of each window, row-major: none as long as the window was not classified; `Some(None)` where the window holds too
    /// few pixels for a class.
    #[allow(clippy::option_option, reason = "not classified, classified without a class, classified")]
    pub classes: Raster<Option<Option<Class>>>,
    /// The area that each window has joined: the first window of it, or one that has itself joined another.
    parents: Vec<u32>,
}

impl Grid {
    fn new(laid: &WindowsLaid) -> Self {
        let count = (laid.columns * laid.rows) as usize;
        Self {
            laid: laid.clone(),
            classes: Raster::filled(laid.columns as usize, laid.rows as usize, None),
            parents: (0..count as u32).collect(),
        }
    }

    /// Index of the window that holds a pixel of a picture `width` pixels wide.
    pub fn window_of(&self, pixel: usize, width: usize) -> usize {
        self.laid.window_of(pixel, width)
    }

    /// The first window of each window's area.
    pub fn areas(&self) -> Vec<u32> {
        let mut roots: Vec<u32> = Vec::with_capacity(self.parents.len());
        // An area joins one with a smaller first window, whose root is known by then.
        for (window, &parent) in self.parents.iter().enumerate() {
            roots.push(if parent as usize == window { parent } else { roots[parent as usize] });
        }
        roots
    }

    /// The first window of one window's area.
    pub fn area_of(&self, window: usize) -> u32 {
        let mut at = window;
        while self.parents.get(at).is_some_and(|&parent| parent as usize != at) {
            at = self.parents[at] as usize;
        }
        at as u32
    }
}

/// A hypothesis, as far as it is known.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hypothesis {
    /// First window of the area that the hypothesis started from; none for a part that was separated.
    pub area: Option<u32>,
    /// The hypothesis that it was separated from.
    pub parent: Option<HypothesisId>,
    /// Radius of its cylinder, counts.
    pub radius: f64,
    lines: Vec<Line>,
    slices: Vec<EventId>,
    highlights: Vec<EventId>,
    ends: Vec<End>,
    /// The events about the hypothesis, oldest first: how it began, fits, tests, choices, slices, how it ended.
    pub(super) events: Vec<EventId>,
}

/// How a hypothesis ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum End {
    /// The hypothesis claimed too few pixels.
    Barren,
    /// The hypothesis was the broad highlight of this one.
    Absorbed(HypothesisId),
    /// The hypothesis became part of this one.
    Merged(HypothesisId),
    /// The hypothesis was too small to keep.
    Dropped,
    /// The hypothesis, a region of an earlier method, was divided into parts.
    Divided,
}

impl Hypothesis {
    /// A hypothesis that starts from an area, with its first matte line.
    fn of_area(chosen: &HypothesisChosen, id: EventId) -> Self {
        let HypothesisChosen { area, radius, line, .. } = *chosen;
        Self { area: Some(area), radius, lines: vec![line], ..Self::of_patch(None, id) }
    }

    /// The hypothesis of a part that is separated from this one, which is `whole`.
    fn part(&self, whole: HypothesisId, id: EventId) -> Self {
        Self { area: None, parent: Some(whole), ends: Vec::new(), events: vec![id], ..self.clone() }
    }

    /// A region of an earlier method, which has no line; `parent`: the region that it is a part of.
    fn of_patch(parent: Option<HypothesisId>, id: EventId) -> Self {
        Self {
            area: None,
            parent,
            radius: 0.0,
            lines: Vec::new(),
            slices: Vec::new(),
            highlights: Vec::new(),
            ends: Vec::new(),
            events: vec![id],
        }
    }

    /// The hypothesis of marked pixels, with its first matte line.
    fn of_marked(fitted: &MarkedLineFitted, id: EventId) -> Self {
        Self { radius: fitted.radius, lines: vec![fitted.line], ..Self::of_patch(None, id) }
    }

    /// The axis of the hypothesis's cylinder.
    pub fn line(&self) -> Option<&Line> {
        self.lines.last()
    }

    /// The cylinder, radius in counts; none without an axis.
    pub(super) fn cylinder(&self) -> Option<Cylinder> {
        self.line().map(|line| Cylinder::new(line, self.radius))
    }

    /// How the hypothesis ended; none as long as it stands.
    pub fn end(&self) -> Option<End> {
        self.ends.last().copied()
    }
}

impl ReplayState {
    /// The state after all events of a trace.
    pub(super) fn at_end(trace: &Trace) -> Self {
        let mut state = Self::default();
        for (id, event) in trace.placed_events() {
            state.take(event, id);
        }
        state
    }

    /// One hypothesis; none where the hypothesis was not made yet.
    pub(super) fn hypothesis(&self, hypothesis: HypothesisId) -> Option<&Hypothesis> {
        self.hypotheses.get(hypothesis.index())
    }

    /// The slice of a hypothesis, where there is one. `trace` is the trace of the events.
    pub(super) fn slice<'t>(&self, trace: &'t Trace, hypothesis: HypothesisId) -> Option<&'t SliceMade> {
        match trace.event_at(*self.hypothesis(hypothesis)?.slices.last()?) {
            Event::SliceMade(made) => Some(made),
            _ => None,
        }
    }

    /// The highlight line chosen for a hypothesis.
    pub(super) fn highlight<'t>(
        &self,
        trace: &'t Trace,
        hypothesis: HypothesisId,
    ) -> Option<&'t CandidateChosen> {
        match trace.event_at(*self.hypothesis(hypothesis)?.highlights.last()?) {
            Event::CandidateChosen(chosen) => Some(chosen),
            _ => None,
        }
    }

    /// Unit direction of the light as it is estimated or chosen so far.
    pub(super) fn light(&self, trace: &Trace) -> Option<[f64; 3]> {
        match trace.event_at(*self.lights.last()?) {
            Event::IlluminantEstimated(estimated) => Some(estimated.direction),
            Event::HighlightsAveraged(averaged) => Some(averaged.direction),
            Event::IlluminantGiven(IlluminantGiven { direction }) => Some(*direction),
            Event::LightChosen(chosen) => chosen.direction,
            _ => None,
        }
    }

    /// The region that a hypothesis became, once the regions of the result are numbered; none before that, and for a
    /// hypothesis that became no region.
    pub(super) fn region_of(&self, trace: &Trace, hypothesis: HypothesisId) -> Option<RegionId> {
        match trace.event_at(self.numbered?) {
            Event::Renumbered(Renumbered { regions }) => regions.get(hypothesis.index()).copied().flatten(),
            _ => None,
        }
    }

    /// The vectors by which the region of a hypothesis is split, once they are fitted.
    pub(super) fn vectors_of<'t>(
        &self,
        trace: &'t Trace,
        hypothesis: HypothesisId,
    ) -> Option<&'t VectorsFitted> {
        let region = self.region_of(trace, hypothesis)?;
        match trace.event_at(*self.vectors.get(region.index())?) {
            Event::VectorsFitted(fitted) => Some(fitted),
            _ => None,
        }
    }

    fn of(&mut self, hypothesis: HypothesisId) -> Option<&mut Hypothesis> {
        self.hypotheses.get_mut(hypothesis.index())
    }

    /// Changes the state by an event; `id` is the place of the event.
    pub(super) fn take(&mut self, event: &Event, id: EventId) {
        match event {
            Event::WindowsLaid(laid) => self.grids.push(Grid::new(laid)),
            Event::WindowClassified(WindowClassified { window, class, .. }) => {
                self.classify(*window, Some(*class));
            }
            Event::MergeTried(MergeTried { into, from, class, union, .. }) if class == union => {
                self.join(*from, *into);
            }
            Event::HypothesisChosen(chosen) => self.hypotheses.push(Hypothesis::of_area(chosen, id)),
            Event::PatchMade(PatchMade { of, .. }) => self.hypotheses.push(Hypothesis::of_patch(*of, id)),
            Event::HistogramsSearched(searched) if searched.chosen().is_none() => {
                self.tell(searched.hypothesis, id);
            }
            Event::MarkedLineFitted(fitted) => self.take_marked_line(fitted, id),
            Event::ComponentSplit(ComponentSplit { hypothesis, .. }) => {
                let part = self.of(*hypothesis).map(|whole| whole.part(*hypothesis, id));
                self.hypotheses.extend(part);
            }
            Event::LineRefitted(refitted) => {
                if let Some(hypothesis) = self.of(refitted.hypothesis) {
                    hypothesis.lines.push(refitted.line);
                    hypothesis.events.push(id);
                }
            }
            Event::SliceMade(made) => {
                if let Some(hypothesis) = self.of(made.hypothesis) {
                    hypothesis.slices.push(id);
                    hypothesis.events.push(id);
                }
            }
            Event::CandidateTested(test) => self.tell(test.hypothesis, id),
            Event::MatteAreasUnited(united) => self.tell(united.hypothesis, id),
            Event::CandidateChosen(chosen) => {
                if let Some(hypothesis) = self.of(chosen.hypothesis) {
                    hypothesis.highlights.push(id);
                    hypothesis.events.push(id);
                }
            }
            Event::IlluminantEstimated(_)
            | Event::HighlightsAveraged(_)
            | Event::IlluminantGiven(_)
            | Event::LightChosen(_) => {
                self.lights.push(id);
            }
            Event::Renumbered(_) => self.numbered = Some(id),
            Event::VectorsFitted(_) => self.vectors.push(id),
            Event::LocalBegan(_)
            | Event::PictureOddsFound(_)
            | Event::RepairTried(_)
            | Event::PlausibilityTested(_) => self.local.push(id),
            other => {
                if let Some((ended, end)) = self.ending(other)
                    && let Some(hypothesis) = self.of(ended)
                {
                    hypothesis.ends.push(end);
                    hypothesis.events.push(id);
                }
            }
        }
    }

    /// Takes a line of the marked pixels. The first one, a matte line, makes the hypothesis.
    fn take_marked_line(&mut self, fitted: &MarkedLineFitted, id: EventId) {
        match self.of(fitted.hypothesis) {
            None => self.hypotheses.push(Hypothesis::of_marked(fitted, id)),
            Some(hypothesis) => {
                if fitted.cluster == MarkedCluster::Matte {
                    hypothesis.lines.push(fitted.line);
                }
                hypothesis.events.push(id);
            }
        }
    }

    /// Undoes [`Self::take_marked_line`].
    fn take_back_marked_line(&mut self, fitted: &MarkedLineFitted) {
        let is_first = |hypothesis: &mut Hypothesis| hypothesis.events.len() == 1;
        if self.of(fitted.hypothesis).is_some_and(is_first) {
            self.hypotheses.pop();
        } else if let Some(hypothesis) = self.pop_event(fitted.hypothesis)
            && fitted.cluster == MarkedCluster::Matte
        {
            hypothesis.lines.pop();
        }
    }

    /// Undoes the change of the event that was taken last.
    pub(super) fn take_back(&mut self, event: &Event) {
        match event {
            Event::WindowsLaid(_) => {
                self.grids.pop();
            }
            Event::WindowClassified(WindowClassified { window, .. }) => self.classify(*window, None),
            Event::MergeTried(MergeTried { from, class, union, .. }) if class == union => {
                self.join(*from, *from);
            }
            Event::HypothesisChosen(_) | Event::ComponentSplit(_) | Event::PatchMade(_) => {
                self.hypotheses.pop();
            }
            Event::HistogramsSearched(searched) if searched.chosen().is_none() => {
                self.pop_event(searched.hypothesis);
            }
            Event::MarkedLineFitted(fitted) => self.take_back_marked_line(fitted),
            Event::LineRefitted(refitted) => {
                self.pop_event(refitted.hypothesis).and_then(|hypothesis| hypothesis.lines.pop());
            }
            Event::SliceMade(made) => {
                self.pop_event(made.hypothesis).and_then(|hypothesis| hypothesis.slices.pop());
            }
            Event::CandidateTested(test) => {
                self.pop_event(test.hypothesis);
            }
            Event::MatteAreasUnited(united) => {
                self.pop_event(united.hypothesis);
            }
            Event::CandidateChosen(chosen) => {
                self.pop_event(chosen.hypothesis).and_then(|hypothesis| hypothesis.highlights.pop());
            }
            Event::IlluminantEstimated(_)
            | Event::HighlightsAveraged(_)
            | Event::IlluminantGiven(_)
            | Event::LightChosen(_) => {
                self.lights.pop();
            }
            Event::Renumbered(_) => self.numbered = None,
            Event::VectorsFitted(_) => {
                self.vectors.pop();
            }
            Event::LocalBegan(_)
            | Event::PictureOddsFound(_)
            | Event::RepairTried(_)
            | Event::PlausibilityTested(_) => {
                self.local.pop();
            }
            other => {
                if let Some((ended, _)) = self.ending(other) {
                    self.pop_event(ended).and_then(|hypothesis| hypothesis.ends.pop());
                }
            }
        }
    }

    /// Adds an event to the story of a hypothesis.
    fn tell(&mut self, hypothesis: HypothesisId, id: EventId) {
        if let Some(hypothesis) = self.of(hypothesis) {
            hypothesis.events.push(id);
        }
    }

    /// Removes the newest event of a hypothesis, and returns the hypothesis.
    fn pop_event(&mut self, hypothesis: HypothesisId) -> Option<&mut Hypothesis> {
        let hypothesis = self.of(hypothesis)?;
        hypothesis.events.pop();
        Some(hypothesis)
    }

    /// The hypothesis that an event ends, and how.
    fn ending(&self, event: &Event) -> Option<(HypothesisId, End)> {
        match event {
            Event::HypothesisPassedOver(HypothesisPassedOver { reason: PassedOver::Barren, .. }) => {
                let newest = self.hypotheses.len().checked_sub(1)?;
                Some((HypothesisId::from_index(newest), End::Barren))
            }
            Event::Absorbed(Absorbed { hypothesis, by, .. }) => Some((*hypothesis, End::Absorbed(*by))),
            Event::RegionsMerged(RegionsMerged { hypothesis, into, .. }) => {
                Some((*hypothesis, End::Merged(*into)))
            }
            Event::Dropped(Dropped { hypothesis, .. }) => Some((*hypothesis, End::Dropped)),
            Event::HistogramsSearched(searched) if searched.chosen().is_some() => {
                Some((searched.hypothesis, End::Divided))
            }
            _ => None,
        }
    }

    #[allow(clippy::option_option, reason = "as Grid::classes")]
    fn classify(&mut self, window: u32, class: Option<Option<Class>>) {
        if let Some(grid) = self.grids.last_mut()
            && let Some(place) = grid.classes.as_mut_slice().get_mut(window as usize)
        {
            *place = class;
        }
    }

    fn join(&mut self, from: u32, into: u32) {
        if let Some(grid) = self.grids.last_mut()
            && let Some(parent) = grid.parents.get_mut(from as usize)
        {
            *parent = into;
        }
    }
}
