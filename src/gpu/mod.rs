//! Draws the color space in three dimensions, from plain data to pixels.
//!
//! A `Scene` holds points, lines and translucent solids in world units (counts / 255); an [`Orbit`] camera looks at the scene;
//! a `Renderer` draws the scene into a separate texture, so that the window, picture files and tests show the same pixels.
//! `Headless` is a graphics device without a window; `pick` finds the points under a cursor, without a graphics device.
//! This room uses neither the program's other rooms nor the window's toolkit.

mod camera;
mod headless;
pub(crate) mod pick;
mod pipelines;
mod projector;
mod renderer;
mod scene;
pub mod shapes;
mod target;
mod upload;

#[cfg(test)]
mod tests;

pub use camera::{Orbit, Preset, Projection};
pub use projector::{Projector, Ray, ScreenPoint};
pub use scene::Vertex;

pub(crate) use headless::{Headless, NoAdapter};
pub(crate) use renderer::Renderer;
pub(crate) use scene::{Batch, Line, Mesh, Overlay, Point, Scene};
pub(crate) use target::read_texture;
