//! What tests of the window look at beyond accessible names: what two panels have drawn, as plain data.
//!
//! No panel uses this module. It is public for the tests of the window, which are a package of their own.

pub use super::cube_panel::testing::{ColorSpaceDrawing, color_space_pixels};
pub use super::image_panel::Placement;
pub use super::plane_panel::testing::PlaneDrawing;
