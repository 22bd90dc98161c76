//! The legend of the points' colors: window classes or density, and at the debugger's cursor what the step did with the pixels.
//! Points in the color of their region, or in the color that they stand for, need no legend.

use super::cloud::{class_color, color_by, density_color};
use crate::gui::PanelContext;
use crate::gui::theme::SMALL_PT;
use crate::gui::widgets;
use crate::trace::Class;
use crate::view::{ColorBy, LegendEntry, Meaning};
use egui::{Align2, Color32, FontId, Mesh, Painter, Rect, Ui, pos2, vec2};

const RAMP_PT: egui::Vec2 = vec2(96.0, 6.0);
const STEPS: usize = 24;

/// Paints the legend into the upper left corner; returns its rectangle. `fullest` is the pixel count
/// of the fullest bin; `meanings` are those of the points at the debugger's cursor.
pub fn show(ui: &Ui, cx: &PanelContext, rect: Rect, fullest: u32, meanings: &[Meaning]) -> Rect {
    let painter = ui.painter_at(rect);
    let corner = rect.min + vec2(8.0, 6.0);
    if !meanings.is_empty() && cx.state.followed().is_some() {
        let entry = |meaning: &Meaning| {
            let LegendEntry { name, color, .. } = meaning.legend(cx.state.focus_color());
            (name, widgets::color(color))
        };
        return entries(&painter, cx, corner, meanings.iter().map(entry));
    }
    match color_by(cx.state) {
        ColorBy::Class => {
            let classes = [Class::Point, Class::Line, Class::Plane, Class::Volume];
            entries(&painter, cx, corner, classes.into_iter().map(|class| (class.name(), class_color(class))))
        }
        ColorBy::Density => density(&painter, cx, corner, fullest),
        ColorBy::Own | ColorBy::Region => Rect::from_min_max(corner, corner),
    }
}

/// Paints colors with their names in a row; returns their rectangle.
fn entries(
    painter: &Painter,
    cx: &PanelContext,
    corner: egui::Pos2,
    entries: impl Iterator<Item = (&'static str, Color32)>,
) -> Rect {
    let mut area = Rect::from_min_size(corner, vec2(0.0, 0.0));
    for (name, color) in entries {
        let left = pos2(area.right(), corner.y);
        painter.rect_filled(Rect::from_min_size(left + vec2(0.0, 3.0), vec2(9.0, 9.0)), 2.0, color);
        let font = FontId::proportional(SMALL_PT);
        let text = painter.text(left + vec2(13.0, 0.0), Align2::LEFT_TOP, name, font, cx.palette.text);
        area = area.union(text.expand2(vec2(5.0, 0.0)));
    }
    area
}

/// Paints the colors of the densities; returns their rectangle.
fn density(painter: &Painter, cx: &PanelContext, corner: egui::Pos2, fullest: u32) -> Rect {
    let mut ramp = Mesh::default();
    let bar = Rect::from_min_size(corner + vec2(0.0, 2.0), RAMP_PT);
    for step in 0..=STEPS {
        let share = step as f32 / STEPS as f32;
        let x = bar.left() + share * bar.width();
        let color = density_color(share, cx.state.view.theme);
        ramp.colored_vertex(pos2(x, bar.top()), color);
        ramp.colored_vertex(pos2(x, bar.bottom()), color);
        if step > 0 {
            let last = 2 * step as u32;
            ramp.add_triangle(last - 2, last - 1, last);
            ramp.add_triangle(last - 1, last, last + 1);
        }
    }
    painter.add(ramp);
    let font = FontId::proportional(SMALL_PT);
    let below = bar.left_bottom() + vec2(0.0, 1.0);
    let one = painter.text(below, Align2::LEFT_TOP, "1 px", font.clone(), cx.palette.secondary);
    let end = bar.right_bottom() + vec2(0.0, 1.0);
    let most = painter.text(
        end,
        Align2::RIGHT_TOP,
        format!("{} px a color", crate::describe::grouped(fullest)),
        font,
        cx.palette.secondary,
    );
    bar.union(one).union(most)
}
