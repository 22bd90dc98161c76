//! Notices about finished work, warnings and errors, over the lower part of the views, so that no panel moves when a notice comes or goes.

use super::theme::SMALL_PT;
use super::{PanelContext, dialog_room, widgets};
use crate::app::{Notice, Severity, ViewCommand};
use egui::{Align2, Area, Frame, Id, Margin, Order, RichText, Ui, pos2};
use std::time::Duration;

/// Width of the notices, points.
const WIDTH_PT: f32 = 560.0;
/// Largest number of notices shown at once; of more, the newest are shown.
const MOST_NOTICES: usize = 4;
/// Largest height of the notices, as a share of the window's.
const MOST_HEIGHT: f32 = 0.6;
/// Time after which the notice of a success or of an answer goes by itself, seconds. Warnings and errors stay until they are dismissed.
pub const PASSING_SECONDS: f64 = 6.0;

/// The notices that are shown.
#[derive(Default)]
pub struct Notices {
    /// The notices that go by themselves, with the time at which each was first shown, seconds.
    shown_since: Vec<(u64, f64)>,
    /// Number of notices in the last frame.
    count: usize,
}

impl Notices {
    /// Shows the notices over the panels, in the middle above `floor`, a height in points. The panels stay where they are.
    pub fn show(&mut self, ui: &Ui, cx: &mut PanelContext, floor: f32) {
        let state = cx.state;
        if state.notices.is_empty() {
            *self = Self::default();
            return;
        }
        self.let_passing_go(ui, cx);
        let room = ui.ctx().content_rect();
        let place = pos2(room.center().x, floor - 8.0);
        let id = Id::unique("notices");
        if ui.memory(|memory| memory.area_rect(id)).is_none() || self.count != state.notices.len() {
            // The notices are measured in this frame and shown in the next one.
            self.count = state.notices.len();
            ui.ctx().request_repaint();
        }
        let area = Area::new(id).order(Order::Foreground).pivot(Align2::CENTER_BOTTOM);
        let frame = Frame::popup(ui.style()).fill(cx.palette.panel).inner_margin(Margin::symmetric(8, 5));
        area.fixed_pos(place).constrain(true).show(ui.ctx(), |ui| {
            frame.show(ui, |ui| {
                ui.set_width(WIDTH_PT.min(room.width() - 40.0));
                let height = MOST_HEIGHT * room.height();
                dialog_room::scrolling_from_end(ui, "notices", height, |ui| rows(ui, cx));
            });
        });
    }

    /// Dismisses the successes and answers that have been shown long enough.
    fn let_passing_go(&mut self, ui: &Ui, cx: &mut PanelContext) {
        let now = ui.input(|input| input.time);
        let passes = |notice: &&Notice| matches!(notice.severity, Severity::Done | Severity::Answer);
        let passing = cx.state.notices.iter().filter(passes);
        let since =
            |id: u64| self.shown_since.iter().find(|(known, _)| *known == id).map(|(_, since)| *since);
        self.shown_since = passing.map(|notice| (notice.id, since(notice.id).unwrap_or(now))).collect();
        for &(id, since) in &self.shown_since {
            let rest = PASSING_SECONDS - (now - since);
            if rest <= 0.0 {
                cx.send(ViewCommand::Dismiss(id));
            } else {
                ui.ctx().request_repaint_after(Duration::from_secs_f64(rest));
            }
        }
    }
}

/// Shows the newest notices, and the number of those before.
fn rows(ui: &mut Ui, cx: &mut PanelContext) {
    let notices = &cx.state.notices;
    let hidden = notices.len().saturating_sub(MOST_NOTICES);
    for notice in notices.iter().skip(hidden) {
        row(ui, cx, notice);
    }
    if hidden > 0 {
        let text = format!("{hidden} earlier");
        ui.label(RichText::new(text).size(SMALL_PT).color(cx.palette.secondary));
    }
}

/// Shows one notice: its kind, its sentence, which wraps, and the button that dismisses the notice.
fn row(ui: &mut Ui, cx: &mut PanelContext, notice: &Notice) {
    let (severity_text, tone) = match notice.severity {
        Severity::Answer => ("Answer", cx.palette.secondary),
        Severity::Done => ("Done", cx.palette.secondary),
        Severity::Warning => ("Note", cx.palette.accent),
        Severity::Error => ("Error", cx.palette.error),
    };
    ui.horizontal_top(|ui| {
        if ui.button("Dismiss").clicked() {
            cx.send(ViewCommand::Dismiss(notice.id));
        }
        ui.label(RichText::new(severity_text).color(tone));
        ui.add(egui::Label::new(widgets::unbroken(&notice.text)).wrap().selectable(true));
    });
}
