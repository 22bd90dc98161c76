//! Every event as a sentence and as the objects of a trace line, side by side, by section of the paper.

mod ambient;
mod baseline;
mod borders;
mod branches;
mod by_hand;
mod candidates;
mod clipping;
mod light;
mod linear;
mod local;
mod masks;
mod passes;
mod planar;
#[cfg(test)]
mod tests;
mod vectors;
mod windows;

pub(super) use baseline::interval_text;
pub(super) use linear::passed_over;
pub(super) use vectors::failed_limits;
pub(super) use windows::variances;

use super::Names;
use crate::color::{Line, Vec3};
#[cfg(test)]
use crate::raster::HypothesisId;
use crate::trace::{Event, dispatch_event};
use serde_json::{Value, json};

/// The three objects of an event's trace line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LineObjects {
    /// The subjects of the event.
    pub ids: Value,
    /// The measured values and the decision.
    pub values: Value,
    /// The limits that decided.
    pub thresholds: Value,
}

impl LineObjects {
    fn new(ids: Value, values: Value, thresholds: Value) -> Self {
        Self { ids, values, thresholds }
    }
}

/// The descriptions of an event.
pub(super) trait Describe {
    /// The event as one sentence: value against threshold, with units.
    fn sentence(&self, names: &Names) -> String;

    /// The event as the objects of a trace line.
    fn line_objects(&self, names: &Names) -> LineObjects;

    /// An event of this kind for tests, about hypotheses or regions with different numbers.
    #[cfg(test)]
    fn example() -> Self
    where
        Self: Sized;
}

impl<T: Describe> Describe for Box<T> {
    fn sentence(&self, names: &Names) -> String {
        T::sentence(self, names)
    }

    fn line_objects(&self, names: &Names) -> LineObjects {
        T::line_objects(self, names)
    }

    #[cfg(test)]
    fn example() -> Self {
        Self::new(T::example())
    }
}

impl Names {
    /// The sentence of an event.
    pub fn event(&self, event: &Event) -> String {
        dispatch_event!(event, data => data.sentence(self))
    }
}

/// The objects of an event's trace line.
pub(super) fn line_objects(names: &Names, event: &Event) -> LineObjects {
    dispatch_event!(event, data => data.line_objects(names))
}

/// An object without keys.
fn nothing() -> Value {
    json!({})
}

/// A line as an object.
fn line(line: &Line) -> Value {
    json!({"mean": vector(&line.mean), "direction": vector(&line.direction)})
}

fn vector(vector: &Vec3) -> [f64; 3] {
    (*vector).into()
}

/// The hypothesis with a number, for examples.
#[cfg(test)]
fn hypothesis(number: u16) -> HypothesisId {
    HypothesisId::from_label(number).expect("hypotheses count from 1")
}
