//! The colour space in three dimensions: plain data in, pixels out.
//!
//! A [`Scene`] holds points, lines and translucent solids in world units (counts / 255); an [`Orbit`] camera looks at it;
//! [`pick`] finds what lies under a cursor.
//! This room knows nothing of the program's other rooms, and nothing of the window's toolkit.

mod camera;
pub mod pick;
mod projector;
mod scene;
pub mod shapes;

pub use camera::{DISTANCE_RANGE, FIELD_OF_VIEW_DEG, Orbit, Preset, Projection, TURN_DEG_PER_PX};
pub use projector::{Projector, Ray, ScreenPoint};
pub use scene::{Batch, Line, Mesh, Overlay, Point, Scene, Vertex};
