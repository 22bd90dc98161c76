//! The color space in three dimensions: plain data in, pixels out.
//!
//! A [`Scene`] holds points, lines and translucent solids in world units (counts / 255); an [`Orbit`] camera looks at it;
//! a [`Renderer`] draws it into a texture of its own, so that the window, picture files and tests show the same pixels.
//! [`Headless`] is a graphics device without a window; [`pick`] finds what lies under a cursor, without a graphics device.
//! This room knows nothing of the program's other rooms, and nothing of the window's toolkit.

mod camera;
mod headless;
pub mod pick;
mod pipelines;
mod projector;
mod renderer;
mod scene;
pub mod shapes;
mod target;
mod upload;

#[cfg(test)]
mod tests;

pub use camera::{DISTANCE_RANGE, FIELD_OF_VIEW_DEG, Orbit, Preset, Projection, TURN_DEG_PER_PX};
pub use headless::{Headless, NoAdapter};
pub use projector::{Projector, Ray, ScreenPoint};
pub use renderer::Renderer;
pub use scene::{Batch, Line, Mesh, Overlay, Point, Scene, Vertex};
pub use target::read_texture;
