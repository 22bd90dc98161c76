//! A skewed-T test (section 5.4.1) in words: each value with its limit, and whether it passed.

use super::theme::{SMALL_PT, ThemeColors};
use crate::trace::CandidateTested;
use crate::view::{Check, candidate_name, skewed_t_view};
use egui::accesskit::Role;
use egui::{Color32, FontId, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Width of the tick or cross before a line, points.
const MARK_PT: f32 = 12.0;

/// Shows the test with its upper left corner at `corner`, on the background color `ground`; returns the rectangle.
pub fn show(ui: &Ui, palette: &ThemeColors, ground: Color32, corner: Pos2, test: &CandidateTested) -> Rect {
    let halo = ground.gamma_multiply(0.8);
    let heading = format!("highlight of {}: {}?", test.hypothesis, candidate_name(test.candidate));
    let tip =
        "A neighboring cluster is the region's highlight if both lines form a skewed T (section 5.4.1).";
    let mut area_so_far = line(ui, (palette, halo), corner, &heading, None, tip);
    for Check { passed, text, tip } in skewed_t_view(test, None).checks {
        let below = area_so_far.left_bottom() + vec2(0.0, 1.0);
        area_so_far = area_so_far.union(line(ui, (palette, halo), below, &text, Some(passed), tip));
    }
    area_so_far
}

/// Shows a line of text: with a cross and in the text color if failed, with a tick and in the
/// secondary color if passed.
fn line(
    ui: &Ui,
    (palette, halo): (&ThemeColors, Color32),
    at: Pos2,
    text: &str,
    passed: Option<bool>,
    tip: &str,
) -> Rect {
    let tone = if passed == Some(true) { palette.secondary } else { palette.text };
    let galley = ui.painter().layout_no_wrap(text.to_owned(), FontId::proportional(SMALL_PT), tone);
    let mark_width = if passed.is_some() { MARK_PT } else { 0.0 };
    let area = Rect::from_min_size(at, galley.size() + vec2(mark_width, 0.0));
    ui.painter().rect_filled(area.expand2(vec2(2.0, 0.0)), 2.0, halo);
    ui.painter().galley(at + vec2(mark_width, 0.0), galley, tone);
    if let Some(passed) = passed {
        let middle = pos2(at.x + 4.0, area.center().y);
        let stroke = Stroke::new(1.5, tone);
        let strokes = if passed {
            [[vec2(-3.5, 0.0), vec2(-1.0, 2.5)], [vec2(-1.0, 2.5), vec2(3.5, -3.0)]]
        } else {
            [[vec2(-3.0, -3.0), vec2(3.0, 3.0)], [vec2(-3.0, 3.0), vec2(3.0, -3.0)]]
        };
        for ends in strokes {
            ui.painter().line_segment(ends.map(|end| middle + end), stroke);
        }
    }
    let accessible_text = match passed {
        None => text.to_owned(),
        Some(true) => format!("passed: {text}"),
        Some(false) => format!("failed: {text}"),
    };
    let response = ui.interact(area, ui.scope_id().with(("verdict", text)), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, accessible_text.clone()));
    response.on_hover_text(tip);
    area
}
