//! What undo takes back: parameters, pins and the selection.

use super::Gesture;
use crate::params::Params;
use crate::raster::Mask;
use crate::view::Selection;
use std::sync::Arc;

/// Everything that a person decides about the analysis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// What is asked of the analysis, a pinned illuminant included.
    pub params: Params,
    /// The pixels that it is restricted to; none: all.
    pub area: Option<Arc<Mask>>,
    /// What is selected.
    pub selection: Selection,
}

/// Earlier and undone documents.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Document>,
    future: Vec<Document>,
    /// The gesture whose changes still belong to the last step.
    open: Option<Gesture>,
}

/// Steps kept.
const LONGEST: usize = 500;

impl History {
    /// Remembers `before`, the document that is about to change. Changes of one gesture are one step.
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

    /// What follows is a step of its own.
    pub fn end_gesture(&mut self) {
        self.open = None;
    }

    /// The document before the last step.
    pub fn undo(&mut self, now: &Document) -> Option<Document> {
        self.open = None;
        let earlier = self.past.pop()?;
        self.future.push(now.clone());
        Some(earlier)
    }

    /// The document that was undone last.
    pub fn redo(&mut self, now: &Document) -> Option<Document> {
        self.open = None;
        let later = self.future.pop()?;
        self.past.push(now.clone());
        Some(later)
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }

    /// Forgets masks and selections of another picture: a document of another size cannot come back.
    pub fn forget(&mut self) {
        *self = Self::default();
    }
}
