//! The part of the state that undo restores: parameters, area and selection; and the history of that part.

use crate::params::{Parameter, Params};
use crate::raster::Mask;
use crate::view::Selection;
use std::sync::Arc;

/// Everything that a person decides about the analysis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The parameters of the analysis, with the pinned lamps.
    pub params: Params,
    /// The pixels that the analysis is restricted to; none: all.
    pub area: Option<Arc<Mask>>,
    /// The selected item and the marked pixels.
    pub selection: Selection,
}

impl Document {
    /// Whether parameters, area or marks differ from those of another document. The selected item is no work.
    pub fn holds_other_work(&self, other: &Self) -> bool {
        let work = |document: &Self| {
            let Selection { marked, named, .. } = &document.selection;
            (document.params, document.area.clone(), marked.clone(), Arc::clone(named))
        };
        work(self) != work(other)
    }
}

/// A continuous movement of a person. Changes of one gesture are one step of the history, until [`History::end_gesture`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// Dragging a parameter's slider.
    Parameter(Parameter),
    /// Painting with the brush.
    Brush,
    /// Turning the pinned illuminant, or pinning all lamps that were found.
    Illuminant,
    /// Turning the pinned second lamp.
    SecondIlluminant,
    /// Dragging a band of the ambient light.
    Ambient,
}

/// Earlier and undone documents.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Document>,
    future: Vec<Document>,
    /// The gesture whose changes belong to the last step; none: the next change is a new step.
    open: Option<Gesture>,
}

/// Largest number of steps that are kept.
const LONGEST: usize = 500;

impl History {
    /// Adds `before`, the document before a change, as a step. Changes of one gesture are one step.
    pub fn step(&mut self, before: &Document, gesture: Option<Gesture>) {
        self.future.clear();
        if gesture.is_some() && self.open == gesture {
            return;
        }
        self.open = gesture;
        if self.past.len() == LONGEST {
            self.past.remove(0);
        }
        self.past.push(before.clone());
    }

    /// Ends a gesture, if it is the one under way: the next change is a step of its own.
    pub fn end_gesture(&mut self, gesture: Gesture) {
        if self.open == Some(gesture) {
            self.open = None;
        }
    }

    /// Undoes the last step: returns the document before it, and keeps the present one for redo.
    pub fn undo(&mut self, now: &Document) -> Option<Document> {
        self.open = None;
        let earlier = self.past.pop()?;
        self.future.push(now.clone());
        Some(earlier)
    }

    /// Redoes the last undone step: returns its document, and keeps the present one for undo.
    pub fn redo(&mut self, now: &Document) -> Option<Document> {
        self.open = None;
        let later = self.future.pop()?;
        self.past.push(now.clone());
        Some(later)
    }

    /// Goes to an entry of [`History::entries`]: returns its document, and keeps all others. None where the entry is the present one or
    /// does not exist.
    pub fn go_to(&mut self, entry: usize, now: &Document) -> Option<Document> {
        let mut reached = None;
        while entry != self.past.len() {
            let current = reached.as_ref().unwrap_or(now).clone();
            let next = if entry < self.past.len() { self.undo(&current) } else { self.redo(&current) };
            let Some(next) = next else { break };
            reached = Some(next);
        }
        reached
    }

    /// All documents, the earliest first; `now` is the present one, at the index of the second value.
    pub fn entries<'a>(&'a self, now: &'a Document) -> (Vec<&'a Document>, usize) {
        let all = self.past.iter().chain([now]).chain(self.future.iter().rev());
        (all.collect(), self.past.len())
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// Removes all steps, because their masks and selections belong to another photograph.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}
