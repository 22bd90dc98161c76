//! The notes of the analysis over the picture, each of which can be dismissed.

use crate::describe::grouped_sentences;
use crate::gui::PanelContext;
use crate::gui::theme::SMALL_PT;
use crate::view::Origin;
use egui::accesskit::Role;
use egui::{FontId, Painter, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Side of the button that dismisses a note, points.
const CLOSE_PT: f32 = 18.0;

/// The notes that a person dismissed. They come back with another photograph.
#[derive(Default)]
pub struct DismissedNotes {
    of: Option<Origin>,
    notes: Vec<String>,
}

impl DismissedNotes {
    /// Shows the notes along the upper edge of `view`, but for those that were dismissed.
    pub fn show(&mut self, ui: &Ui, painter: &Painter, cx: &PanelContext, view: Rect) {
        let (Some(shown), Some(picture)) = (cx.state.shown(), &cx.state.picture) else { return };
        if self.of.as_ref() != Some(&picture.origin) {
            *self = Self { of: Some(picture.origin.clone()), notes: Vec::new() };
        }
        let mut top = view.top() + 6.0;
        for note in grouped_sentences(&shown.analysis.warnings) {
            if self.notes.contains(&note) {
                continue;
            }
            let (bottom, is_dismissed) = show_note(ui, painter, cx, view.with_min_y(top), &note);
            top = bottom + 4.0;
            if is_dismissed {
                self.notes.push(note);
            }
        }
    }
}

/// Shows a note at the upper edge of `view`, and outside of exported pictures the button that dismisses it. Returns the lower edge of the note, and
/// whether the button was clicked.
fn show_note(ui: &Ui, painter: &Painter, cx: &PanelContext, view: Rect, note: &str) -> (f32, bool) {
    let palette = cx.palette;
    let room = (view.width() - 32.0 - CLOSE_PT).max(40.0);
    let galley = painter.layout(note.to_owned(), FontId::proportional(SMALL_PT), palette.text, room);
    let size = galley.size() + vec2(12.0 + CLOSE_PT, 6.0);
    let area = Rect::from_min_size(pos2(view.center().x - size.x / 2.0, view.top()), size);
    painter.rect_filled(area, 3.0, palette.panel.gamma_multiply(0.9));
    painter.galley(area.min + vec2(6.0, 3.0), galley, palette.text);
    if cx.is_export {
        return (area.bottom(), false);
    }
    let button = Rect::from_min_max(pos2(area.right() - CLOSE_PT, area.top()), area.max);
    let button = button.with_max_y(area.top() + CLOSE_PT);
    let response = ui.interact(button, ui.scope_id().with(("dismiss the note", note)), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Dismiss the note"));
    let color = if response.hovered() { palette.accent } else { palette.secondary };
    let (middle, reach) = (button.center(), 3.5);
    for sign in [-1.0, 1.0] {
        let ends = [middle - vec2(reach, sign * reach), middle + vec2(reach, sign * reach)];
        painter.line_segment(ends, Stroke::new(1.3, color));
    }
    (area.bottom(), response.on_hover_text("Dismiss the note; the table and the report keep it.").clicked())
}
