//! The size of all texts and controls, which a person changes for a projector or a dense display.

use super::PanelContext;
use super::action::TextStep;
use crate::app::ViewCommand;
use egui::Context;

/// Smallest and largest size, in multiples of the size at first.
const SIZES: [f32; 2] = [0.5, 4.0];

/// Changes the size by a step, from the next frame on.
pub fn change(ctx: &Context, step: TextStep) {
    match step {
        TextStep::Larger => egui::gui_zoom::zoom_in(ctx),
        TextStep::Smaller => egui::gui_zoom::zoom_out(ctx),
        TextStep::AsAtFirst => ctx.set_zoom_factor(1.0),
    }
}

/// The size that window and state agreed on last; none before the first frame.
#[derive(Default)]
pub struct TextSize {
    agreed: Option<f32>,
}

impl TextSize {
    /// Takes the size of the state where that has changed (settings were restored); otherwise sends the window's size to the state.
    pub fn sync(&mut self, ctx: &Context, cx: &mut PanelContext) {
        let saved = cx.state.view.text_size;
        let now = ctx.zoom_factor();
        if saved != self.agreed {
            self.agreed = saved;
            let size = saved.unwrap_or(1.0).clamp(SIZES[0], SIZES[1]);
            ctx.set_zoom_factor(size);
        } else if (now - saved.unwrap_or(1.0)).abs() > 1e-3 {
            self.agreed = Some(now);
            cx.send(ViewCommand::TextSize(now));
        }
    }
}
