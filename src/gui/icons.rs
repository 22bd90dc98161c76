//! Icons on buttons, drawn as lines.

use super::theme::ThemeColors;
use egui::{Color32, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, Vec2, pos2, vec2};

/// An icon on a button.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Icon {
    /// The pointer tool.
    Arrow,
    /// The rectangle tool: a dashed rectangle.
    Rectangle,
    /// The lasso tool: a free outline.
    Lasso,
    /// The polygon tool: an outline of straight sides.
    Polygon,
    /// A lock, closed or open.
    Lock(bool),
}

/// Side of a square button with an icon, points.
pub const SIDE_PT: f32 = 22.0;

/// A button that is on or off. `name` is its accessible name; `draw` paints the icon into a square, in a color.
pub fn icon_button(
    ui: &mut Ui,
    palette: &ThemeColors,
    on: bool,
    name: &str,
    tip: &str,
    draw: impl FnOnce(&Painter, Rect, Color32),
) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(SIDE_PT), Sense::click());
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::accesskit::Role::Button, ui.is_enabled(), on, name));
    let ground = match (on, response.hovered() || response.has_focus()) {
        (true, _) => palette.accent.gamma_multiply(0.3),
        (false, true) => palette.line,
        (false, false) => Color32::TRANSPARENT,
    };
    ui.painter().rect_filled(rect, 3.0, ground);
    let color = match (ui.is_enabled(), on) {
        (false, _) => palette.secondary.gamma_multiply(0.5),
        (true, true) => palette.text,
        (true, false) => palette.text.gamma_multiply(0.75),
    };
    draw(ui.painter(), rect.shrink(4.0), color);
    response.on_hover_text(tip)
}

/// A button with an icon; `name` is its accessible name.
pub fn button(ui: &mut Ui, palette: &ThemeColors, icon: Icon, selected: bool, name: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(ui.spacing().interact_size.y), Sense::click());
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::accesskit::Role::Button, ui.is_enabled(), selected, name)
    });
    let visuals = ui.style().interact_selectable(&response, selected);
    if selected || response.hovered() || response.has_focus() {
        ui.painter().rect(
            rect,
            visuals.corner_radius,
            visuals.weak_bg_fill,
            visuals.bg_stroke,
            egui::StrokeKind::Inside,
        );
    }
    let color = if selected { palette.accent } else { palette.text };
    paint(ui.painter(), icon, rect.shrink(4.0), color);
    response
}

/// Paints `icon` into a square.
fn paint(painter: &Painter, icon: Icon, rect: Rect, color: Color32) {
    let at = |x: f32, y: f32| rect.min + vec2(x, y) * rect.size();
    let stroke = Stroke::new(1.3, color);
    let closed = |points: Vec<Pos2>| Shape::closed_line(points, stroke);
    match icon {
        Icon::Arrow => {
            let points =
                [(0.2, 0.0), (0.2, 0.85), (0.42, 0.66), (0.58, 1.0), (0.72, 0.94), (0.56, 0.6), (0.82, 0.6)];
            painter.add(closed(points.map(|(x, y)| at(x, y)).to_vec()));
        }
        Icon::Rectangle => {
            let corners = [at(0.0, 0.12), at(1.0, 0.12), at(1.0, 0.88), at(0.0, 0.88), at(0.0, 0.12)];
            painter.extend(Shape::dashed_line(&corners, stroke, 2.5, 1.8));
        }
        Icon::Lasso => {
            let ring = (0..=20).map(|i| {
                let (y, x) = (std::f32::consts::TAU * i as f32 / 20.0).sin_cos();
                at(0.5 + 0.48 * x, 0.4 + 0.32 * y - 0.08 * x * y)
            });
            painter.add(Shape::line(ring.collect(), stroke));
            painter.add(Shape::line(vec![at(0.3, 0.68), at(0.2, 0.82), at(0.32, 1.0)], stroke));
        }
        Icon::Polygon => {
            let points = [(0.1, 0.3), (0.6, 0.05), (0.95, 0.5), (0.7, 0.95), (0.2, 0.85)];
            painter.add(closed(points.map(|(x, y)| at(x, y)).to_vec()));
        }
        Icon::Lock(shut) => {
            let body = Rect::from_min_max(at(0.15, 0.48), at(0.85, 0.98));
            painter.rect_stroke(body, 1.5, stroke, egui::StrokeKind::Middle);
            let lift = if shut { 0.0 } else { 0.14 };
            let shackle = (0..=10).map(|i| {
                let (y, x) = (std::f32::consts::PI * i as f32 / 10.0).sin_cos();
                at(0.5 - 0.24 * x, 0.3 - lift - 0.24 * y)
            });
            let foot = if shut { pos2(0.74, 0.48) } else { pos2(0.74, 0.3) };
            let left = at(0.26, 0.48);
            let points = std::iter::once(left).chain(shackle).chain([at(foot.x, foot.y - lift)]);
            painter.add(Shape::line(points.collect(), stroke));
        }
    }
}
