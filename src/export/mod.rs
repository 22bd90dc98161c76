//! Results as files that other programs read.

mod matte;

pub use matte::{MatteError, write_matte};
