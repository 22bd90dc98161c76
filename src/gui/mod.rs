//! The window: one file per panel; all panels show one [`crate::app::State`].
//!
//! A panel reads the state from a [`PanelContext`] and sends commands to the application. A panel keeps only its
//! uploads to the graphics device, and the gesture in progress.

mod about;
mod action;
mod app;
mod background_value;
mod breakpoints_panel;
mod closing;
mod command_list;
mod command_palette;
mod compact_dock;
mod compare_panel;
mod confirmed_path;
mod context_menu;
mod copied_texts;
mod cube_choices;
mod cube_panel;
mod cursor_owners;
mod debugger_answers;
mod dialog;
mod dock;
mod dropped_files;
mod elsewhere_section;
mod export_form;
mod files;
mod geometry_panel;
mod glossary;
mod history_panel;
mod icons;
mod image_panel;
mod inspector_panel;
mod instant_key;
mod keyboard_focus;
mod menu;
mod menu_keys;
mod move_cursor;
mod named_marks_list;
mod notices;
mod offscreen;
mod offscreen_app;
mod outline;
mod pane;
mod panel_context;
mod parameters;
mod perform;
mod plane_panel;
mod profile_panel;
mod proposed_path;
mod regions_panel;
mod screenshot;
mod screenshot_lamps;
mod selection_panel;
mod shortcuts;
mod skewed_t_test;
mod start;
mod status;
mod system_dialog;
mod task;
#[doc(hidden)]
pub mod testing;
mod theme;
mod threshold_bar;
mod timeline_panel;
mod typed_path;
mod verdict_strip;
mod view_export;
mod watch_panel;
mod widgets;
mod window;
mod window_content;

pub use app::App;
pub use pane::Pane;
pub use panel_context::PanelContext;
pub use screenshot::{ScreenshotError, screenshot};
pub use window::{WindowError, open};
