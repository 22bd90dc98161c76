//! Notices about finished work, warnings and errors, in a strip of their own below the panels, so that no notice covers a control.

use super::PanelContext;
use super::theme::SMALL_PT;
use crate::app::{Notice, Severity, ViewCommand};
use egui::{Frame, Margin, RichText, Ui};
use std::time::Duration;

/// Largest number of notices shown at once; of more, the newest are shown.
const MOST_NOTICES: usize = 4;
/// Time after which the notice of a success goes by itself, seconds. Warnings and errors stay until they are dismissed.
const SUCCESS_SECONDS: f64 = 6.0;

/// The strip of notices.
#[derive(Default)]
pub struct Notices {
    /// The notices of successes with the time at which each was first shown, seconds.
    shown_since: Vec<(u64, f64)>,
}

impl Notices {
    /// Shows the strip at the lower border of `ui`, if there are notices.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let state = cx.state;
        if state.notices.is_empty() {
            self.shown_since.clear();
            return;
        }
        self.let_successes_go(ui, cx);
        let frame = Frame::new().fill(cx.palette.panel).inner_margin(Margin::symmetric(8, 3));
        egui::Panel::bottom("notices").frame(frame).resizable(false).show(ui, |ui| {
            let hidden = state.notices.len().saturating_sub(MOST_NOTICES);
            for notice in state.notices.iter().skip(hidden) {
                row(ui, cx, notice);
            }
            if hidden > 0 {
                ui.label(
                    RichText::new(format!("{hidden} earlier")).size(SMALL_PT).color(cx.palette.secondary),
                );
            }
        });
    }

    /// Dismisses the successes that have been shown long enough.
    fn let_successes_go(&mut self, ui: &Ui, cx: &mut PanelContext) {
        let now = ui.input(|input| input.time);
        let successes = cx.state.notices.iter().filter(|notice| notice.severity == Severity::Done);
        let since =
            |id: u64| self.shown_since.iter().find(|(known, _)| *known == id).map(|(_, since)| *since);
        self.shown_since = successes.map(|notice| (notice.id, since(notice.id).unwrap_or(now))).collect();
        for &(id, since) in &self.shown_since {
            let rest = SUCCESS_SECONDS - (now - since);
            if rest <= 0.0 {
                cx.send(ViewCommand::Dismiss(id));
            } else {
                ui.ctx().request_repaint_after(Duration::from_secs_f64(rest));
            }
        }
    }
}

/// Shows one notice: its kind, its sentence, which wraps, and the button that dismisses the notice.
fn row(ui: &mut Ui, cx: &mut PanelContext, notice: &Notice) {
    let (severity_text, tone) = match notice.severity {
        Severity::Done => ("Done", cx.palette.secondary),
        Severity::Warning => ("Note", cx.palette.accent),
        Severity::Error => ("Error", cx.palette.error),
    };
    ui.horizontal_top(|ui| {
        if ui.button("Dismiss").clicked() {
            cx.send(ViewCommand::Dismiss(notice.id));
        }
        ui.label(RichText::new(severity_text).color(tone));
        ui.add(egui::Label::new(&notice.text).wrap().selectable(true));
    });
}
