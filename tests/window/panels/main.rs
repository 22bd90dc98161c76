//! Tests of the whole window without a screen: widgets are found by accessible names, clicked, dragged and typed into.
//!
//! Work is done in the calling thread ([`dichroscope::app::Executor::Inline`]), so that no test waits for another
//! thread. Only tests that draw the color space or compare pictures need a graphics adapter, see [`window::with_gpu`].

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod accessibility;
mod by_hand;
mod canceling;
mod clipped_objects;
mod closing;
mod color_space_panel;
mod colors;
mod commands;
mod compare;
mod cursor;
mod debugger;
mod debugger_answers;
mod elsewhere;
mod exports;
mod first_minute;
mod geometry;
mod habits;
mod history;
mod image_panel;
mod images;
mod inspector;
mod keyboard;
mod lamps;
mod low_windows;
mod menus_of_views;
mod named_marks;
mod opening;
mod photographs;
mod pictures;
mod plane_panel;
mod preview;
mod reach;
mod regions;
mod sizes;
mod sliders;
#[path = "../../synthetic/mod.rs"]
mod synthetic;
mod why;
mod window;
