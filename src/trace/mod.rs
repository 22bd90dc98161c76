//! Decisions as data: what was decided, about what, on which numbers.

mod event;

pub use event::Class;
