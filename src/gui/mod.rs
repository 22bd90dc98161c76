//! The window: one file per panel, all of them over one [`crate::app::State`].
//!
//! A panel reads the state through a [`Cx`] and leaves commands there; it keeps nothing but what it has uploaded and the
//! gesture that the pointer is in the middle of.

mod app;
mod breakpoints_panel;
mod compare_panel;
mod cube_panel;
mod cx;
mod dock;
mod files;
mod icons;
mod image_panel;
mod later;
mod menu;
mod notices;
mod offscreen;
mod parameters;
mod plane_panel;
mod profile_panel;
mod regions_panel;
mod screenshot;
mod selection_panel;
mod shortcuts;
mod status;
#[doc(hidden)]
pub mod testing;
mod theme;
mod timeline_panel;
mod verdict;
mod view_export;
mod watch_panel;
mod why_panel;
mod widgets;
mod window;

pub use app::App;
pub use cx::Cx;
pub use dock::Pane;
pub use screenshot::{ScreenshotError, screenshot};
pub use window::{WindowError, open};
