//! The plane on the screen: conversion between counts and screen points, the oblique axes, and the skewed T.

use super::labels::{ChartLabel, Obstacles, TickNumbers};
use crate::gui::glossary::Term;
use crate::gui::theme::ThemeColors;
use crate::view::RegionPlane;
use egui::{Align2, Painter, Pos2, Rect, Response, Shape, Stroke, Ui, Vec2, pos2, vec2};

/// Smallest distance between two ticks, points.
const TICKS_APART_PT: f32 = 44.0;
/// Margin around the fitted plane for the axes' labels, points.
const MARGIN_PT: Vec2 = vec2(40.0, 30.0);
/// Scroll distance that zooms by the factor e, points.
const SCROLL_PT: f32 = 260.0;
/// Smallest and largest scale, counts per point.
const SCALES: [f32; 2] = [0.002, 20.0];

/// Position and scale of the plane in the view. Both axes have the same scale, so that angles are preserved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chart {
    /// The point in the middle of the view, oblique counts (see [`RegionPlane::oblique`]).
    pub center: [f32; 2],
    /// Counts per screen point.
    pub counts_per_pt: f32,
}

impl Chart {
    /// The chart in which all points, the origin and the skewed T are seen.
    pub fn fit(plane: &RegionPlane, rect: Rect) -> Self {
        let [body, surface] = plane.extent;
        let finite = |v: f32| if v.is_finite() { v } else { 0.0 };
        let corners = [[0.0, 0.0], [plane.matte_length, 0.0]]
            .into_iter()
            .chain(plane.highlight_lines().flatten())
            .chain(plane.points.iter().map(|point| [point.body, point.surface]))
            .chain(plane.points.is_empty().then_some([finite(body[1]), finite(surface[1])]));
        let mut area = Rect::NOTHING;
        for [body, surface] in corners {
            area.extend_with(plane.oblique(body, surface).into());
        }
        let free = (rect.size() - 2.0 * MARGIN_PT).max(vec2(20.0, 20.0));
        let needed = area.size().max(vec2(1.0, 1.0)) / free;
        Self { center: area.center().into(), counts_per_pt: needed.max_elem().clamp(SCALES[0], SCALES[1]) }
    }

    /// Screen position of oblique counts; the second axis points up.
    pub fn screen(self, [x, y]: [f32; 2], rect: Rect) -> Pos2 {
        rect.center() + vec2(x - self.center[0], self.center[1] - y) / self.counts_per_pt
    }

    /// Oblique counts at a screen position.
    pub fn oblique(self, at: Pos2, rect: Rect) -> [f32; 2] {
        let from_middle = (at - rect.center()) * self.counts_per_pt;
        [self.center[0] + from_middle.x, self.center[1] - from_middle.y]
    }

    /// Moves the contents by `delta`, screen points.
    pub fn pan(&mut self, delta: Vec2) {
        self.center[0] -= delta.x * self.counts_per_pt;
        self.center[1] += delta.y * self.counts_per_pt;
    }

    /// Enlarges by `factor`; the counts under the pointer stay under the pointer.
    pub fn zoom(&mut self, factor: f32, pointer: Pos2, rect: Rect) {
        if factor > 0.0 && factor.is_finite() && (factor - 1.0).abs() > 1e-6 {
            let under = self.oblique(pointer, rect);
            self.counts_per_pt = (self.counts_per_pt / factor).clamp(SCALES[0], SCALES[1]);
            let now = self.oblique(pointer, rect);
            self.center = [self.center[0] + under[0] - now[0], self.center[1] + under[1] - now[1]];
        }
    }

    /// Paints both axes through black, and a grid of lines of equal amounts. Returns the ticks' numbers, which are painted over the points.
    pub fn axes<'a>(
        self,
        painter: &'a Painter,
        plane: &RegionPlane,
        rect: Rect,
        palette: &'a ThemeColors,
    ) -> TickNumbers<'a> {
        let mut numbers = TickNumbers { painter, rect, palette, taken: Vec::new(), texts: Vec::new() };
        let round_step = round_step(TICKS_APART_PT * self.counts_per_pt);
        let corners = [rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()]
            .map(|corner| plane.from_oblique(self.oblique(corner, rect)));
        let at = |body: f32, surface: f32| self.screen(plane.oblique(body, surface), rect);
        let span = |axis: usize| {
            let all = corners.map(|corner| corner[axis]);
            [
                all.iter().copied().fold(f32::INFINITY, f32::min),
                all.iter().copied().fold(f32::NEG_INFINITY, f32::max),
            ]
        };
        let (body, surface) = (span(0), span(1));
        for value in multiples(body, round_step) {
            let stroke = line(value, palette);
            painter.line_segment([at(value, surface[0]), at(value, surface[1])], stroke);
            let foot = at(value, 0.0);
            if value != 0.0 && rect.shrink2(vec2(12.0, 0.0)).x_range().contains(foot.x) {
                // In a view that is lower than both margins, the upper margin wins.
                let y = foot.y.min(rect.bottom() - 34.0).max(rect.top() + 16.0);
                numbers.add(value, pos2(foot.x, y + 3.0), Align2::CENTER_TOP);
            }
        }
        for value in multiples(surface, round_step) {
            painter.line_segment([at(body[0], value), at(body[1], value)], line(value, palette));
            let foot = at(0.0, value);
            if value != 0.0 && rect.shrink2(vec2(0.0, 20.0)).y_range().contains(foot.y) {
                numbers.add(value, pos2(foot.x - 4.0, foot.y), Align2::RIGHT_CENTER);
            }
        }
        numbers
    }

    /// Position of the label of the m_s axis: left of the point where the axis leaves the view at the top or at a side.
    fn top_of_axis(self, plane: &RegionPlane, rect: Rect) -> Pos2 {
        let black = self.screen([0.0, 0.0], rect);
        let away = plane.oblique(0.0, 1.0);
        let rise = vec2(away[0], -away[1]);
        let area = rect.shrink2(vec2(90.0, 24.0));
        let to_top = (area.top() - black.y) / rise.y.min(-1e-3);
        let side = if rise.x >= 0.0 { area.right() } else { area.left() };
        let to_side = if rise.x.abs() < 1e-3 { f32::INFINITY } else { (side - black.x) / rise.x };
        black + rise * to_top.min(to_side).max(0.0) + vec2(-34.0, -4.0)
    }

    /// Paints matte line, highlight lines, meeting points and the border of the cylinder, with labels.
    pub fn skewed_t(
        self,
        ui: &Ui,
        response: &Response,
        plane: &RegionPlane,
        rect: Rect,
        palette: &ThemeColors,
        obstacles: &Obstacles,
    ) {
        let painter = ui.painter_at(rect);
        let at = |[body, surface]: [f32; 2]| self.screen(plane.oblique(body, surface), rect);
        for side in [plane.radius, -plane.radius] {
            let ends = [[0.0, side], [plane.matte_length, side]].map(|end| self.screen(end, rect));
            painter.extend(Shape::dashed_line(&ends, Stroke::new(1.0, palette.secondary), 4.0, 4.0));
        }
        let stroke = Stroke::new(1.8, palette.text);
        let matte = plane.matte_line().map(at);
        painter.line_segment(matte, stroke);
        let mut names = vec![ChartLabel {
            at: pos2(rect.right() - 8.0, matte[0].y - 4.0),
            anchor: Align2::RIGHT_BOTTOM,
            text: "m_b, counts",
            tip: "",
            term: Some(Term::BodyAmount),
        }];
        names.extend(self.highlight_lines(&painter, plane, rect, stroke));
        let axis = if plane.has_plane { "m_s, counts" } else { "across, counts" };
        names.push(ChartLabel {
            at: self.top_of_axis(plane, rect),
            anchor: Align2::RIGHT_TOP,
            text: axis,
            tip: "Distance across the matte line.",
            term: plane.has_plane.then_some(Term::SurfaceAmount),
        });
        names.push(ChartLabel {
            at: matte[0].lerp(matte[1], 0.3) + vec2(0.0, 16.0),
            anchor: Align2::CENTER_TOP,
            text: "matte line",
            tip: "",
            term: Some(Term::MatteLine),
        });
        names.extend(self.meeting_points(&painter, plane, rect, palette));
        let mut taken = obstacles.taken.clone();
        for name in names {
            name.show(ui, response, rect, palette, obstacles.points, &mut taken);
        }
    }

    /// Paints the highlight lines. Returns their label, placed at the longest line; `None` without a line.
    fn highlight_lines(
        self,
        painter: &Painter,
        plane: &RegionPlane,
        rect: Rect,
        stroke: Stroke,
    ) -> Option<ChartLabel> {
        let lines: Vec<[[f32; 2]; 2]> = plane.highlight_lines().collect();
        for line in &lines {
            painter.line_segment(
                line.map(|[body, surface]| self.screen(plane.oblique(body, surface), rect)),
                stroke,
            );
        }
        let longest = lines.iter().max_by(|a, b| a[1][1].total_cmp(&b[1][1]))?;
        let away = plane.oblique(0.0, 1.0);
        let end = self.screen(plane.oblique(longest[1][0], longest[1][1]), rect);
        let (text, term) = if lines.len() > 1 {
            ("highlight lines", None)
        } else {
            ("highlight line", Some(Term::HighlightLine))
        };
        let tip = "More and more light reflected at the surface, along m_s, from each shade on which a highlight lies (sections 3.1, 7.4).";
        Some(ChartLabel {
            at: end + vec2(away[0], -away[1]) * 10.0,
            anchor: Align2::CENTER_BOTTOM,
            text,
            tip,
            term,
        })
    }

    /// Paints the points where highlight lines leave the matte line. Returns their label, placed below their middle;
    /// `None` without a point.
    fn meeting_points(
        self,
        painter: &Painter,
        plane: &RegionPlane,
        rect: Rect,
        palette: &ThemeColors,
    ) -> Option<ChartLabel> {
        let places: Vec<Pos2> =
            plane.branches.iter().map(|branch| self.screen([branch.meeting_point, 0.0], rect)).collect();
        for &place in &places {
            painter.circle(place, 4.0, palette.panel, Stroke::new(1.8, palette.text));
        }
        let middle = Rect::from_points(&places).center();
        let (text, tip) = match places.len() {
            0 => return None,
            1 => (
                "meeting point",
                "The shade on which the highlight lies: where its line leaves the matte line (section 3.1).",
            ),
            _ => (
                "meeting points",
                "The shades on which highlights lie: where their lines leave the matte line (sections 3.1, 7.4).",
            ),
        };
        Some(ChartLabel { at: middle + vec2(0.0, 16.0), anchor: Align2::CENTER_TOP, text, tip, term: None })
    }
}

/// The chart after this frame's input: a drag pans, the wheel zooms at the pointer, a double click fits the plane. `chart` is the
/// chart that a person moved; without such a chart, the plane is fitted into the view. `is_moved` is whether a person has
/// moved the chart. `pans` is whether a drag pans; otherwise a drag draws an outline.
pub fn navigate(
    ui: &Ui,
    response: &Response,
    plane: &RegionPlane,
    chart: Option<Chart>,
    rect: Rect,
    is_moved: &mut bool,
    pans: bool,
) -> Chart {
    let fitted = chart.filter(|_| !response.double_clicked());
    let mut chart = fitted.unwrap_or_else(|| Chart::fit(plane, rect));
    let before = chart;
    if pans || response.dragged_by(egui::PointerButton::Middle) {
        chart.pan(response.drag_delta());
    }
    if let Some(pointer) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        chart.zoom((scroll / SCROLL_PT).exp() * pinch, pointer, rect);
    }
    *is_moved = (*is_moved && !response.double_clicked()) || chart != before;
    chart
}

/// Stroke of the grid line of a value: the line of zero is an axis and darker.
fn line(value: f32, palette: &ThemeColors) -> Stroke {
    if value == 0.0 {
        Stroke::new(1.0, palette.secondary)
    } else {
        Stroke::new(1.0, palette.line.gamma_multiply(0.55))
    }
}

/// The smallest number not below `least` that is 1, 2 or 5 times a power of ten.
fn round_step(least: f32) -> f32 {
    let decade = 10f32.powf(least.max(1e-6).log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * decade)
        .into_iter()
        .find(|round_step| *round_step >= least)
        .unwrap_or(least)
}

/// The multiples of `step` within a range, at most 400.
fn multiples([low, high]: [f32; 2], round_step: f32) -> impl Iterator<Item = f32> {
    let range = (low / round_step).ceil() as i32..=(high / round_step).floor() as i32;
    range.take(400).map(move |i| i as f32 * round_step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round() {
        for (least, round) in [(0.7, 1.0), (1.0, 1.0), (1.2, 2.0), (3.0, 5.0), (7.0, 10.0), (44.0, 50.0)] {
            assert!((round_step(least) - round).abs() < 1e-4 * round, "{least}: {}", round_step(least));
        }
        assert_eq!(multiples([-1.0, 2.1], 1.0).collect::<Vec<_>>(), [-1.0, 0.0, 1.0, 2.0]);
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(300.0, 200.0));
        let mut chart = Chart { center: [100.0, 30.0], counts_per_pt: 0.8 };
        let pointer = pos2(60.0, 150.0);
        let before = chart.oblique(pointer, rect);
        chart.zoom(2.5, pointer, rect);
        let after = chart.oblique(pointer, rect);
        assert!((before[0] - after[0]).abs() < 1e-3 && (before[1] - after[1]).abs() < 1e-3);
        assert!(chart.screen(before, rect).distance(pointer) < 1e-2);
        chart.pan(vec2(10.0, -6.0));
        assert!(chart.screen(before, rect).distance(pointer + vec2(10.0, -6.0)) < 1e-2);
    }
}
