//! What stands at an instant of a trace, but for the labels: windows, areas, regions, lights. Every thing is a stack that is
//! pushed forward and popped back.

use super::{
    Absorbed, Class, ComponentSplit, Dropped, Event, HypothesisPassedOver, MergeTried, PassedOver,
    RegionsMerged, WindowClassified, WindowsLaid,
};
use crate::color::Line;
use crate::raster::{HypothesisId, Raster};

/// Everything but the labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ReplayState {
    pub(super) grids: Vec<Grid>,
    pub(super) hypotheses: Vec<Hypothesis>,
    /// Lights so far: index of the stage trace and of the event.
    pub(super) lights: Vec<EventId>,
    /// What gave the regions their final numbers.
    pub(super) finals: Option<EventId>,
    /// Number of labels given.
    pub(super) labeled: usize,
}

pub(super) type EventId = (usize, usize);

/// A grid of windows, as far as it is classified and merged.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// How it lies.
    pub laid: WindowsLaid,
    /// Class of each window, row-major: none as long as it is not known; none within where it holds too few pixels.
    #[allow(clippy::option_option, reason = "not known, known to have none, known")]
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

/// A region, as far as it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// First window of the area that it started from; none for a part that was separated.
    pub area: Option<u32>,
    /// The hypothesis that it was separated from.
    pub parent: Option<HypothesisId>,
    /// Radius of its cylinder, counts.
    pub radius: f64,
    lines: Vec<Line>,
    pub(super) slices: Vec<EventId>,
    pub(super) highlights: Vec<EventId>,
    ends: Vec<End>,
}

/// How a region ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It claimed too few pixels.
    Barren,
    /// The hypothesis was the broad highlight of this one.
    Absorbed(HypothesisId),
    /// The hypothesis became part of this one.
    Merged(HypothesisId),
    /// It was too small to keep.
    Dropped,
}

impl Hypothesis {
    /// The axis of its cylinder.
    pub fn line(&self) -> Option<&Line> {
        self.lines.last()
    }

    /// How it ended; none as long as it stands.
    pub fn end(&self) -> Option<End> {
        self.ends.last().copied()
    }
}

impl ReplayState {
    fn of(&mut self, hypothesis: HypothesisId) -> Option<&mut Hypothesis> {
        self.hypotheses.get_mut(hypothesis.index())
    }

    /// Takes an event in.
    pub(super) fn take(&mut self, event: &Event, id: EventId) {
        match event {
            Event::WindowsLaid(laid) => self.grids.push(Grid::new(laid)),
            Event::WindowClassified(WindowClassified { window, class, .. }) => {
                self.classify(*window, Some(*class));
            }
            Event::MergeTried(MergeTried { into, from, class, union, .. }) if class == union => {
                self.join(*from, *into);
            }
            Event::HypothesisChosen(chosen) => self.hypotheses.push(Hypothesis {
                area: Some(chosen.area),
                parent: None,
                radius: chosen.radius,
                lines: vec![chosen.line],
                slices: Vec::new(),
                highlights: Vec::new(),
                ends: Vec::new(),
            }),
            Event::ComponentSplit(ComponentSplit { hypothesis, .. }) => {
                let mut part = self.of(*hypothesis).cloned();
                if let Some(part) = &mut part {
                    (part.area, part.parent) = (None, Some(*hypothesis));
                    part.ends.clear();
                }
                self.hypotheses.extend(part);
            }
            Event::LineRefitted(refitted) => {
                if let Some(hypothesis) = self.of(refitted.hypothesis) {
                    hypothesis.lines.push(refitted.line);
                }
            }
            Event::SliceMade(made) => {
                if let Some(hypothesis) = self.of(made.hypothesis) {
                    hypothesis.slices.push(id);
                }
            }
            Event::CandidateChosen(chosen) => {
                if let Some(hypothesis) = self.of(chosen.hypothesis) {
                    hypothesis.highlights.push(id);
                }
            }
            Event::IlluminantEstimated(_) | Event::IlluminantGiven(_) | Event::LightChosen(_) => {
                self.lights.push(id);
            }
            Event::Renumbered(_) => self.finals = Some(id),
            other => {
                if let Some((ended, end)) = self.ending(other)
                    && let Some(hypothesis) = self.of(ended)
                {
                    hypothesis.ends.push(end);
                }
            }
        }
    }

    /// Takes it back.
    pub(super) fn take_back(&mut self, event: &Event) {
        match event {
            Event::WindowsLaid(_) => {
                self.grids.pop();
            }
            Event::WindowClassified(WindowClassified { window, .. }) => self.classify(*window, None),
            Event::MergeTried(MergeTried { from, class, union, .. }) if class == union => {
                self.join(*from, *from);
            }
            Event::HypothesisChosen(_) | Event::ComponentSplit(_) => {
                self.hypotheses.pop();
            }
            Event::LineRefitted(refitted) => {
                self.of(refitted.hypothesis).and_then(|hypothesis| hypothesis.lines.pop());
            }
            Event::SliceMade(made) => {
                self.of(made.hypothesis).and_then(|hypothesis| hypothesis.slices.pop());
            }
            Event::CandidateChosen(chosen) => {
                self.of(chosen.hypothesis).and_then(|hypothesis| hypothesis.highlights.pop());
            }
            Event::IlluminantEstimated(_) | Event::IlluminantGiven(_) | Event::LightChosen(_) => {
                self.lights.pop();
            }
            Event::Renumbered(_) => self.finals = None,
            other => {
                if let Some((ended, _)) = self.ending(other) {
                    self.of(ended).and_then(|hypothesis| hypothesis.ends.pop());
                }
            }
        }
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
            _ => None,
        }
    }

    #[allow(clippy::option_option, reason = "as in the grid")]
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
