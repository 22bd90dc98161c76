//! The whole window without a screen: found by accessible names, clicked, dragged and typed in, and looked at.
//!
//! Work is done in the call itself ([`dichroscope::app::Executor::Inline`]), so that no test waits for a thread.
//! Only what draws the color space or takes pictures needs a graphics adapter, see [`window::with_gpu`].

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod accessibility;
mod color_space_panel;
mod colors;
mod compare;
mod cursor;
mod debugger;
mod exports;
mod image_panel;
mod images;
mod keyboard;
mod opening;
mod pictures;
mod plane_panel;
mod regions;
mod sliders;
mod why;
mod window;
