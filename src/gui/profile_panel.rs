//! To be filled.

use super::{Cx, widgets};

/// The panel.
#[derive(Default)]
pub struct ProfilePanel;

impl ProfilePanel {
    /// Shows it.
    pub fn show(&mut self, ui: &mut egui::Ui, cx: &mut Cx) {
        widgets::nothing(ui, cx.tones, "ProfilePanel");
    }
}
