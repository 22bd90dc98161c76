//! The drawings of two panels as plain data. Tests of the window look at these drawings and at accessible names.
//!
//! No panel uses this module. The module is public for the tests of the window, which are a package of their own.

pub use super::cube_panel::testing::{ColorSpaceDrawing, color_space_pixels};
pub use super::image_panel::Placement;
pub use super::plane_panel::testing::PlaneDrawing;
