//! The notes of the analysis over the picture, each of which can be dismissed. The note about a camera's contrast curve offers to read the file
//! with it.

use crate::analysis::RunWarning;
use crate::describe::grouped_sentences;
use crate::gui::PanelContext;
use crate::gui::theme::SMALL_PT;
use crate::photo::EncodingChoice;
use crate::view::Origin;
use egui::accesskit::Role;
use egui::{FontId, Painter, Rect, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

/// Side of the button that dismisses a note, points.
const CLOSE_PT: f32 = 18.0;

/// The notes that a person dismissed. They come back with another photograph.
#[derive(Default)]
pub struct DismissedNotes {
    of: Option<Origin>,
    notes: Vec<String>,
    /// The encoding that a note offers and that was clicked.
    wanted_encoding: Option<EncodingChoice>,
}

impl DismissedNotes {
    /// Shows the notes along the upper edge of `view`, but for those that were dismissed.
    pub fn show(&mut self, ui: &Ui, painter: &Painter, cx: &PanelContext, view: Rect) {
        let (Some(shown), Some(picture)) = (cx.state.shown(), &cx.state.picture) else { return };
        if self.of.as_ref() != Some(&picture.origin) {
            *self = Self { of: Some(picture.origin.clone()), ..Self::default() };
        }
        let mut top = view.top() + 6.0;
        for (warning, note) in shown.analysis.warnings.iter().zip(grouped_sentences(&shown.analysis.warnings))
        {
            if self.notes.contains(&note) {
                continue;
            }
            let (bottom, is_dismissed) = show_note(ui, painter, cx, view.with_min_y(top), &note);
            top = bottom + 4.0;
            if is_dismissed {
                self.notes.push(note);
            }
            if let Some(encoding) = offered_encoding(warning).filter(|_| !cx.is_export) {
                let (bottom, is_clicked) = show_offer(ui, painter, cx, view.with_min_y(top), encoding);
                top = bottom + 4.0;
                if is_clicked {
                    self.wanted_encoding = Some(encoding);
                }
            }
        }
    }

    /// The encoding of a note that was clicked since the last call.
    pub fn take_wanted_encoding(&mut self) -> Option<EncodingChoice> {
        self.wanted_encoding.take()
    }
}

/// The encoding with which a warning advises to read the file.
fn offered_encoding(warning: &RunWarning) -> Option<EncodingChoice> {
    match warning {
        RunWarning::Contrast(found) => Some(found.encoding()),
        _ => None,
    }
}

/// Shows the button that reads the file with another encoding at the upper edge of `view`. Returns its lower edge, and whether it was clicked.
fn show_offer(
    ui: &Ui,
    painter: &Painter,
    cx: &PanelContext,
    view: Rect,
    encoding: EncodingChoice,
) -> (f32, bool) {
    let palette = cx.palette;
    let text = format!("Read the file as {encoding}");
    let galley = painter.layout_no_wrap(text.clone(), FontId::proportional(SMALL_PT), palette.accent);
    let size = galley.size() + vec2(16.0, 8.0);
    let area = Rect::from_min_size(pos2(view.center().x - size.x / 2.0, view.top()), size);
    let response = ui.interact(area, ui.scope_id().with("read as a note offers"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, text.clone()));
    let is_marked = response.hovered() || response.has_focus();
    painter.rect_filled(area, 3.0, palette.panel.gamma_multiply(if is_marked { 1.0 } else { 0.9 }));
    painter.rect_stroke(area, 3.0, Stroke::new(1.0, palette.accent), StrokeKind::Inside);
    painter.galley(area.min + vec2(8.0, 4.0), galley, palette.accent);
    let tip = "Undoes the camera's contrast curve before the analysis. File \u{25b8} Read as has the other ways to read the file.";
    (area.bottom(), response.on_hover_text(tip).clicked())
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
