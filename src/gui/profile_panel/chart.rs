//! The curves of the profile, drawn in the style of the plane: thin axes with round numbers, quiet grid lines, and the values under
//! the pointer.

use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets;
use egui::{
    Align, Align2, Color32, FontId, Layout, Painter, Pos2, Rangef, Rect, Shape, Stroke, Ui, pos2, vec2,
};

/// Smallest distance between two ticks of the axes of positions and of values, points.
const TICKS_APART_PT: [f32; 2] = [64.0, 36.0];

/// A curve of the profile.
pub struct Curve {
    /// The name in the legend.
    pub name: &'static str,
    /// The color of the line.
    pub color: Color32,
    /// Runs of points without a gap: position along the line, pixels, and value, counts.
    pub runs: Vec<Vec<[f32; 2]>>,
}

impl Curve {
    /// The value at the point nearest to a position; none where the curve has a gap there.
    fn value_at(&self, position_px: f32) -> Option<f32> {
        let points = self.runs.iter().flatten();
        let off = |point: &&[f32; 2]| (point[0] - position_px).abs();
        let nearest = points.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        (off(&nearest) <= 1.0).then_some(nearest[1])
    }
}

/// The place of the values in the view.
#[derive(Clone, Copy)]
pub struct ProfileChart {
    /// The area of the curves, screen points.
    area: Rect,
    /// First and last position along the line, pixels.
    positions: Rangef,
    /// Smallest and largest value, counts.
    values: Rangef,
}

impl ProfileChart {
    /// The chart in which all curves are seen, in `rect` with room for the numbers of the axes.
    pub fn fit(curves: &[Curve], rect: Rect) -> Self {
        let (mut positions, mut values) = (Rangef::NOTHING, Rangef::new(0.0, 1.0));
        for &[position, value] in curves.iter().flat_map(|curve| curve.runs.iter().flatten()) {
            positions = Rangef::new(positions.min.min(position), positions.max.max(position));
            values = Rangef::new(values.min.min(value), values.max.max(value));
        }
        if !positions.min.is_finite() {
            positions = Rangef::new(0.0, 1.0);
        }
        let area = Rect::from_min_max(
            rect.min + vec2(36.0, 22.0),
            (rect.max - vec2(10.0, 20.0)).max(rect.min + vec2(37.0, 23.0)),
        );
        let air = 0.04 * values.span();
        Self { area, positions, values: Rangef::new(values.min - air, values.max + air) }
    }

    fn x(&self, position_px: f32) -> f32 {
        egui::remap(
            position_px,
            self.positions.min..=self.positions.max.max(self.positions.min + 1e-3),
            self.area.x_range(),
        )
    }

    fn y(&self, value: f32) -> f32 {
        egui::remap(value, self.values.min..=self.values.max, self.area.bottom()..=self.area.top())
    }

    /// The position along the line at the pointer, pixels.
    pub fn position_at(&self, pointer: Pos2) -> f32 {
        egui::remap_clamp(pointer.x, self.area.x_range(), self.positions.min..=self.positions.max)
    }

    /// Paints grid, axes, numbers and curves.
    pub fn paint(&self, ui: &Ui, palette: &ThemeColors, curves: &[Curve]) {
        let painter = ui.painter();
        let font = FontId::proportional(SMALL_PT);
        let quiet = Stroke::new(1.0, palette.line.gamma_multiply(0.55));
        let per_pt = [self.positions.span() / self.area.width(), self.values.span() / self.area.height()];
        for value in multiples(self.values, round_step(TICKS_APART_PT[1] * per_pt[1])) {
            let stroke = if value == 0.0 { Stroke::new(1.0, palette.secondary) } else { quiet };
            painter.hline(self.area.x_range(), self.y(value), stroke);
            let place = pos2(self.area.left() - 4.0, self.y(value));
            painter.text(place, Align2::RIGHT_CENTER, number(value), font.clone(), palette.secondary);
        }
        for position in multiples(self.positions, round_step((TICKS_APART_PT[0] * per_pt[0]).max(1.0))) {
            painter.vline(self.x(position), self.area.y_range(), quiet);
            let place = pos2(self.x(position), self.area.bottom() + 3.0);
            painter.text(place, Align2::CENTER_TOP, number(position), font.clone(), palette.secondary);
        }
        let corner = self.area.left_top() - vec2(0.0, 4.0);
        painter.text(corner, Align2::LEFT_BOTTOM, "counts", font.clone(), palette.text);
        let corner = self.area.right_top() - vec2(0.0, 4.0);
        painter.text(corner, Align2::RIGHT_BOTTOM, "px along the line", font, palette.text);
        let clipped = painter.with_clip_rect(self.area.expand(2.0));
        for curve in curves {
            for run in &curve.runs {
                let points: Vec<Pos2> = run.iter().map(|&[x, y]| pos2(self.x(x), self.y(y))).collect();
                clipped.add(Shape::line(points, Stroke::new(1.4, curve.color)));
            }
        }
    }

    /// Paints a line at a position, with a dot on each curve.
    pub fn mark(&self, painter: &Painter, palette: &ThemeColors, curves: &[Curve], position_px: f32) {
        painter.vline(self.x(position_px), self.area.y_range(), Stroke::new(1.0, palette.accent));
        for curve in curves {
            if let Some(value) = curve.value_at(position_px) {
                painter.circle(
                    pos2(self.x(position_px), self.y(value)),
                    3.0,
                    curve.color,
                    Stroke::new(1.0, palette.panel),
                );
            }
        }
    }
}

/// Shows the names of the curves with their colors, and their values at a position, where there is one. A click on a name hides or
/// shows the curve; `hidden` holds the names of hidden curves.
pub fn legend(
    ui: &mut Ui,
    palette: &ThemeColors,
    curves: &[Curve],
    hidden: &mut Vec<&'static str>,
    position_px: Option<f32>,
) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 2.0);
        for curve in curves {
            let is_hidden = hidden.contains(&curve.name);
            let color = if is_hidden { palette.line } else { curve.color };
            let value = position_px.filter(|_| !is_hidden).and_then(|position| curve.value_at(position));
            let value = value
                .map_or_else(String::new, |value| format!(" {:>6}", widgets::signed(f64::from(value), 1)));
            let tone = if is_hidden { palette.secondary } else { palette.text };
            let text = widgets::with_subscripts(&format!("{}{value}", curve.name), SMALL_PT, tone);
            // Color and name have a space of their own, so that a wrapped row does not part them.
            let name_pt = ui.painter().layout_job(text.clone()).size().x;
            let width_pt = widgets::CHIP_PT + ui.spacing().item_spacing.x + name_pt.ceil();
            let space = vec2(width_pt, ui.spacing().interact_size.y);
            let entry = ui.allocate_ui_with_layout(space, Layout::left_to_right(Align::Center), |ui| {
                widgets::chip(ui, palette, color, curve.name);
                ui.add(egui::Button::new(text).frame(false))
            });
            let name = entry.inner;
            if name.on_hover_text("Click to hide or show this curve.").clicked() {
                if is_hidden { hidden.retain(|name| *name != curve.name) } else { hidden.push(curve.name) }
            }
            ui.add_space(8.0);
        }
    });
}

/// The smallest number not below `least` that is 1, 2 or 5 times a power of ten.
fn round_step(least: f32) -> f32 {
    let decade = 10f32.powf(least.max(1e-6).log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * decade)
        .into_iter()
        .find(|step| *step >= least)
        .unwrap_or(least)
}

/// The multiples of `step` within a range, at most 400.
fn multiples(range: Rangef, step: f32) -> impl Iterator<Item = f32> {
    let numbers = (range.min / step).ceil() as i32..=(range.max / step).floor() as i32;
    numbers.take(400).map(move |i| i as f32 * step)
}

/// A number with a decimal where it is no whole number.
fn number(value: f32) -> String {
    widgets::signed(f64::from(value), usize::from(value.fract() != 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: &[[f32; 2]]) -> Curve {
        Curve { name: "R", color: Color32::RED, runs: vec![points.to_vec()] }
    }

    #[test]
    fn every_value_lies_in_the_area_and_the_pointer_finds_its_position() {
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(300.0, 200.0));
        let curves = [curve(&[[0.0, -3.0], [50.0, 240.0], [100.0, 20.0]])];
        let chart = ProfileChart::fit(&curves, rect);
        for &[position, value] in &curves[0].runs[0] {
            let at = pos2(chart.x(position), chart.y(value));
            assert!(chart.area.expand(0.1).contains(at) && rect.contains(at), "{at}");
            assert!((chart.position_at(at) - position).abs() < 0.01);
        }
        assert_eq!(curves[0].value_at(50.4), Some(240.0));
        assert_eq!(curves[0].value_at(70.0), None, "a gap");
    }

    #[test]
    fn no_curve_and_no_room_are_no_trouble() {
        let chart = ProfileChart::fit(&[], Rect::from_min_size(Pos2::ZERO, vec2(1.0, 1.0)));
        assert!(chart.position_at(pos2(5.0, 5.0)).is_finite() && chart.y(0.0).is_finite());
    }
}
