//! The one way of drawing a value against its threshold: name, value and limit as text, over a bar on which the part that passes is
//! lighter, the limit is a line and the value a mark in the color of its verdict.

use super::theme::{SMALL_PT, ThemeColors};
use super::widgets;
use crate::view::{Limits, Meaning, ThresholdTest};
use egui::accesskit::Role;
use egui::{Color32, FontId, Painter, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Width of the tick or cross before the text, points.
const MARK_PT: f32 = 13.0;
/// Height of the bar, points.
const BAR_PT: f32 = 4.0;
/// Width of the bars over a chart, points.
const CHART_BAR_PT: f32 = 170.0;
/// Distance between two tests, points.
const GAP_PT: f32 = 3.0;

/// Shows tests one below the other in the width of `ui`.
pub fn show(ui: &mut Ui, palette: &ThemeColors, tests: &[ThresholdTest]) {
    for test in tests {
        let galley = text(ui.painter(), palette, test, ui.available_width() - MARK_PT);
        let size = vec2(ui.available_width(), galley.size().y + BAR_PT + GAP_PT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        paint(ui.painter(), palette, rect, test, galley);
        name(response, test);
    }
}

/// Shows tests over a chart, the upper left corner at `corner`, on the background color `ground`; returns their rectangle. Texts
/// wrap at the right end of `ui`.
pub fn show_at(
    ui: &Ui,
    palette: &ThemeColors,
    ground: Color32,
    corner: Pos2,
    tests: &[ThresholdTest],
) -> Rect {
    let mut area = Rect::from_min_size(corner, vec2(0.0, 0.0));
    for test in tests {
        let room = ui.max_rect().right() - corner.x - 4.0;
        let galley = text(ui.painter(), palette, test, room - MARK_PT);
        let width = CHART_BAR_PT.min(room).max(galley.size().x + MARK_PT);
        let size = vec2(width, galley.size().y + BAR_PT + GAP_PT);
        let rect = Rect::from_min_size(area.left_bottom(), size);
        ui.painter().rect_filled(rect.expand2(vec2(2.0, 0.0)), 2.0, ground);
        paint(ui.painter(), palette, rect, test, galley);
        name(ui.interact(rect, ui.scope_id().with(("verdict", test.name)), Sense::hover()), test);
        area = area.union(rect);
    }
    area
}

/// The text of a test, in lines of at most `width` points.
fn text(
    painter: &Painter,
    palette: &ThemeColors,
    test: &ThresholdTest,
    width: f32,
) -> std::sync::Arc<egui::Galley> {
    let tone = if test.passed { palette.secondary } else { palette.text };
    painter.layout(test.text(), FontId::proportional(SMALL_PT), tone, width.max(40.0))
}

/// Gives the widget of a test its accessible name and its tooltip.
fn name(response: egui::Response, test: &ThresholdTest) {
    let accessible = format!("{}: {}", if test.passed { "passed" } else { "failed" }, test.text());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, accessible.clone()));
    response.on_hover_text(test.tip);
}

/// The color of a verdict.
fn tone(test: &ThresholdTest, palette: &ThemeColors) -> Color32 {
    if test.passed { palette.accent } else { widgets::color(Meaning::Refused.color(None)) }
}

/// Paints tick or cross, text and bar.
fn paint(
    painter: &Painter,
    palette: &ThemeColors,
    rect: Rect,
    test: &ThresholdTest,
    galley: std::sync::Arc<egui::Galley>,
) {
    let bottom = rect.top() + galley.size().y;
    mark(painter, pos2(rect.left() + 4.5, rect.top() + SMALL_PT * 0.62), test.passed, tone(test, palette));
    painter.galley(rect.min + vec2(MARK_PT, 0.0), galley, palette.text);
    let bar = Rect::from_min_max(pos2(rect.left() + MARK_PT, bottom), pos2(rect.right(), bottom + BAR_PT));
    painter.rect_filled(bar, 1.0, palette.well);
    let x = |value: f64| bar.left() + test.share(value) * bar.width();
    let [low, high] = test.range();
    let passing = match test.limits {
        Limits::AtMost(limit) => [low, limit],
        Limits::AtLeast(limit) => [limit, high],
        Limits::Within(limits) => limits,
    };
    let lighter = Rect::from_x_y_ranges(x(passing[0])..=x(passing[1]), bar.y_range());
    painter.rect_filled(lighter, 1.0, palette.secondary.gamma_multiply(0.45));
    for limit in passing.into_iter().filter(|limit| *limit > low && *limit < high) {
        let at = x(limit);
        let line = [pos2(at, bar.top() - 1.5), pos2(at, bar.bottom() + 1.5)];
        painter.line_segment(line, Stroke::new(1.5, palette.text));
    }
    let value = pos2(x(test.value), bar.center().y);
    painter.circle(value, 3.0, tone(test, palette), Stroke::new(1.0, palette.panel));
}

/// Paints a tick or a cross.
fn mark(painter: &Painter, middle: Pos2, passed: bool, color: Color32) {
    let strokes = if passed {
        [[vec2(-3.5, 0.0), vec2(-1.0, 2.5)], [vec2(-1.0, 2.5), vec2(3.5, -3.0)]]
    } else {
        [[vec2(-3.0, -3.0), vec2(3.0, 3.0)], [vec2(-3.0, 3.0), vec2(3.0, -3.0)]]
    };
    for ends in strokes {
        painter.line_segment(ends.map(|end| middle + end), Stroke::new(1.5, color));
    }
}
