//! Icons of the image panel's buttons.

use crate::gui::icons::icon_button;
use crate::gui::theme::ThemeColors;
use crate::view::{ArrangementKind, Fill, Tool};
use egui::{Color32, Painter, Pos2, Rect, Response, Shape, Stroke, Ui, pos2, vec2};

pub use crate::gui::icons::SIDE_PT;

/// The icon on a button.
#[derive(Clone, Copy)]
pub enum ToolbarIcon {
    /// A tool of the image panel.
    Tool(Tool),
    /// One layer, or the arrangement of two.
    Arrangement(ArrangementKind),
    /// Filled areas or outlines.
    Fill(Fill),
    /// The display settings exposure, gamma and opacity.
    Display,
}

/// A button that is on or off. `name` is its accessible name.
pub fn toggle(
    ui: &mut Ui,
    palette: &ThemeColors,
    icon: ToolbarIcon,
    on: bool,
    name: &str,
    tip: &str,
) -> Response {
    icon_button(ui, palette, on, name, tip, |painter, square, color| draw(painter, square, icon, color))
}

/// Paints an icon. Coordinates are those of a square of 14 × 14.
fn draw(painter: &Painter, square: Rect, icon: ToolbarIcon, color: Color32) {
    let stroke = Stroke::new(1.3, color);
    let at = |x: f32, y: f32| square.min + vec2(x, y) * (square.width() / 14.0);
    let part = |x0, y0, x1, y1| Rect::from_min_max(at(x0, y0), at(x1, y1));
    let frame = |rect| painter.rect_stroke(rect, 1.0, stroke, egui::StrokeKind::Middle);
    match icon {
        ToolbarIcon::Tool(tool) => draw_tool(painter, tool, stroke, at),
        ToolbarIcon::Arrangement(ArrangementKind::Single) => {
            frame(part(1.5, 2.5, 12.5, 11.5));
        }
        ToolbarIcon::Arrangement(ArrangementKind::Wipe) => {
            frame(part(1.5, 2.5, 12.5, 11.5));
            painter.rect_filled(part(7.0, 2.5, 12.5, 11.5), 0.0, color.gamma_multiply(0.55));
            painter.line_segment([at(7.0, 0.5), at(7.0, 13.5)], stroke);
        }
        ToolbarIcon::Arrangement(ArrangementKind::SideBySide) => {
            frame(part(0.8, 3.0, 6.2, 11.0));
            frame(part(7.8, 3.0, 13.2, 11.0));
        }
        ToolbarIcon::Fill(Fill::Fill) => {
            painter.rect_filled(part(2.0, 2.0, 12.0, 12.0), 2.0, color.gamma_multiply(0.7));
        }
        ToolbarIcon::Fill(Fill::Outline) => {
            frame(part(2.5, 2.5, 11.5, 11.5));
        }
        ToolbarIcon::Display => {
            painter.circle_stroke(at(7.0, 7.0), 5.4, stroke);
            let on_circle = |i: usize| {
                let angle = (i as f32 / 12.0 - 0.5) * std::f32::consts::PI;
                at(7.0 + 5.4 * angle.cos(), 7.0 + 5.4 * angle.sin())
            };
            painter.add(Shape::convex_polygon((0..=12).map(on_circle).collect(), color, Stroke::NONE));
        }
    }
}

/// Paints the icon of a tool.
fn draw_tool(painter: &Painter, tool: Tool, stroke: Stroke, at: impl Fn(f32, f32) -> Pos2) {
    let path = |points: &[(f32, f32)]| -> Vec<Pos2> { points.iter().map(|&(x, y)| at(x, y)).collect() };
    match tool {
        Tool::Pointer => {
            let arrow =
                [(3.5, 1.5), (11.0, 8.2), (7.4, 8.5), (9.2, 12.2), (7.5, 13.0), (5.8, 9.2), (3.5, 11.5)];
            painter.add(Shape::closed_line(path(&arrow), stroke));
        }
        Tool::Rectangle => {
            let corners = path(&[(1.5, 2.5), (12.5, 2.5), (12.5, 11.5), (1.5, 11.5), (1.5, 2.5)]);
            painter.extend(Shape::dashed_line(&corners, stroke, 2.4, 1.7));
        }
        Tool::Lasso => {
            let on_circle = |i: usize| {
                let angle = i as f32 / 24.0 * std::f32::consts::TAU;
                at(7.3 + 5.6 * angle.cos(), 5.6 + 3.9 * angle.sin())
            };
            painter.add(Shape::closed_line((0..24).map(on_circle).collect(), stroke));
            painter.add(Shape::line(path(&[(4.2, 9.0), (3.0, 10.6), (4.2, 11.8), (3.0, 13.3)]), stroke));
        }
        Tool::Polygon => {
            let corners = [(2.0, 11.5), (3.5, 3.0), (9.0, 5.5), (12.5, 2.0), (11.0, 12.0)];
            painter.add(Shape::closed_line(path(&corners), Stroke::new(1.0, stroke.color)));
            for (x, y) in corners {
                painter.circle_filled(at(x, y), 1.5, stroke.color);
            }
        }
        Tool::Brush => {
            painter.circle_filled(at(7.0, 7.0), 2.6, stroke.color);
            painter.circle_stroke(at(7.0, 7.0), 5.6, Stroke::new(1.0, stroke.color));
        }
        Tool::Profile => {
            painter.line_segment([at(2.5, 11.5), at(11.5, 2.5)], stroke);
            painter.circle_filled(at(2.5, 11.5), 2.0, stroke.color);
            painter.circle_filled(at(11.5, 2.5), 2.0, stroke.color);
        }
        Tool::WhitePatch => {
            let card = Rect::from_min_max(at(2.0, 2.0), at(12.0, 12.0));
            painter.rect_stroke(card, 1.0, Stroke::new(1.0, stroke.color), egui::StrokeKind::Middle);
            painter.rect_filled(card.shrink(2.4), 0.0, stroke.color);
        }
    }
}

/// Paints a small cross at a point, with a dark border, so that it is visible on any background.
pub fn cross(painter: &Painter, at: Pos2, color: Color32) {
    for (width, color) in [(3.0, Color32::from_black_alpha(150)), (1.2, color)] {
        for (dx, dy) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let direction = vec2(dx, dy);
            painter.line_segment([at + direction * 4.0, at + direction * 11.0], (width, color));
        }
    }
}

/// Paints a dashed line over a dark line, so that it is visible on any background.
pub fn dashed(painter: &Painter, points: &[Pos2], color: Color32) {
    painter.add(Shape::line(points.to_vec(), Stroke::new(2.6, Color32::from_black_alpha(140))));
    painter.extend(Shape::dashed_line(points, Stroke::new(1.4, color), 5.0, 3.0));
}

/// The four corners of a rectangle as a closed path: the first is repeated at the end.
pub fn corners(rect: Rect) -> [Pos2; 5] {
    let Rect { min, max } = rect;
    [min, pos2(max.x, min.y), max, pos2(min.x, max.y), min]
}
