//! Notices about finished work, warnings and errors, shown in the lower left corner until dismissed.

use super::PanelContext;
use crate::app::{Severity, ViewCommand};
use egui::{Align2, Frame, RichText, Ui, vec2};

/// Largest number of notices shown at once; of more, the newest are shown.
const MOST_NOTICES: usize = 4;

/// Shows the notices over the bottom left corner.
pub fn show(ui: &Ui, cx: &mut PanelContext) {
    if cx.state.notices.is_empty() {
        return;
    }
    let area = egui::Area::new(egui::Id::unique("notices")).anchor(Align2::LEFT_BOTTOM, vec2(12.0, -36.0));
    area.order(egui::Order::Foreground).show(ui.ctx(), |ui| {
        let hidden = cx.state.notices.len().saturating_sub(MOST_NOTICES);
        let mut dismissed = Vec::new();
        for notice in cx.state.notices.iter().skip(hidden) {
            let (severity_text, tone) = match notice.severity {
                Severity::Done => ("Done", cx.palette.secondary),
                Severity::Warning => ("Note", cx.palette.accent),
                Severity::Error => ("Error", cx.palette.error),
            };
            Frame::popup(ui.style()).stroke((1.0, tone)).show(ui, |ui| {
                ui.horizontal(|ui| {
                    ui.set_max_width(460.0);
                    ui.label(RichText::new(severity_text).color(tone));
                    ui.add(egui::Label::new(&notice.text).wrap().selectable(true));
                    if ui.button("Dismiss").clicked() {
                        dismissed.push(notice.id);
                    }
                });
            });
        }
        if hidden > 0 {
            ui.label(RichText::new(format!("{hidden} earlier")).color(cx.palette.secondary));
        }
        for id in dismissed {
            cx.send(ViewCommand::Dismiss(id));
        }
    });
}
