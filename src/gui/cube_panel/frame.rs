//! The frame of the color space: the RGB cube's edges in the space shown, axes with ticks, and the axis gizmo.

use super::labels::Label;
use crate::gpu::{Line, Overlay, Projector};
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::view::{Axis, ColorSpace, Theme};
use egui::{Color32, FontId, Pos2, Rect, Stroke, Ui, Vec2, vec2};

const EDGE_PT: f32 = 1.0;
const AXIS_PT: f32 = 1.4;
/// Length of a tick, screen points.
const TICK_PT: f32 = 3.0;
/// Radius of the gizmo, screen points.
const GIZMO_PT: f32 = 22.0;

/// Edges and axes of the space.
#[derive(Default)]
pub struct AxesFrame {
    /// Color space, bits of full scale and theme that the lines were made for.
    inputs: Option<(ColorSpace, u32, Theme)>,
    /// Edges and axes as lines, world units.
    pub lines: Vec<Line>,
    axes: Vec<Axis>,
}

impl AxesFrame {
    /// Rebuilds edges and axes when space, full scale or theme have changed; returns whether one has.
    pub fn update(&mut self, space: ColorSpace, full_counts: f32, theme: Theme) -> bool {
        let inputs = Some((space, full_counts.to_bits(), theme));
        if self.inputs == inputs {
            return false;
        }
        let palette = ThemeColors::of(theme);
        let dim = mixed(palette.background, palette.secondary, 0.45);
        self.lines.clear();
        for edge in space.frame(full_counts) {
            self.lines.extend(line_segments(&edge, dim, EDGE_PT));
        }
        self.axes = space.axes(full_counts);
        let bright = mixed(palette.background, palette.secondary, 0.9);
        for axis in &self.axes {
            self.lines.extend(line_segments(&axis.line, bright, AXIS_PT));
        }
        self.inputs = inputs;
        true
    }

    /// Labels of the axes, the black corner and the ticks, the most important first. The ticks are painted here.
    pub fn labels(&self, ui: &Ui, projector: &Projector, rect: Rect, palette: &ThemeColors) -> Vec<Label> {
        let on_screen = |world| screen_from_world(projector, rect, world);
        let Some(middle) = on_screen([0.5; 3]) else { return Vec::new() };
        let (mut names, mut values) = (Vec::new(), Vec::new());
        let painter = ui.painter_at(rect);
        for axis in &self.axes {
            let ends = axis.line.first().zip(axis.line.last());
            let Some((from, to)) = ends.and_then(|(a, b)| Some((on_screen(*a)?, on_screen(*b)?))) else {
                continue;
            };
            let along = (to - from).normalized();
            let length = (to - from).length();
            let is_closed = length < 1.0;
            let unit = if axis.unit.is_empty() || axis.unit == "\u{b0}" { "" } else { ", counts" };
            let side = if is_closed { vec2(0.0, -1.0) } else { along };
            names.push(Label {
                text: format!("{}{unit}", axis.name),
                at: to,
                sides: vec![side, outward(along, from, middle), -outward(along, from, middle)],
                color: palette.text,
                size_pt: SMALL_PT + 0.5,
                tip: axis.meaning,
                leader: false,
            });
            if !is_closed && length < 24.0 {
                // The axis is seen end-on: the labels of its values would overlap.
                continue;
            }
            for tick in &axis.ticks {
                let Some(at) = on_screen(tick.place) else { continue };
                let side = if is_closed {
                    (at - middle).normalized()
                } else {
                    outward(along, from.lerp(to, 0.5), middle)
                };
                painter.line_segment([at, at + side * TICK_PT], Stroke::new(1.0, palette.secondary));
                values.push(Label {
                    text: format!("{}{}", tick.label, if axis.unit == "\u{b0}" { "\u{b0}" } else { "" }),
                    at,
                    sides: vec![side],
                    color: palette.secondary,
                    size_pt: SMALL_PT,
                    tip: "",
                    leader: false,
                });
            }
        }
        if let (Some((ColorSpace::Rgb, ..)), Some(at)) = (self.inputs, on_screen([0.0; 3])) {
            painter.circle(at, 3.5, Color32::BLACK, Stroke::new(1.2, palette.text));
            names.push(black_label(at, middle, palette));
        }
        names.extend(values);
        names
    }
}

/// The label of the black corner.
fn black_label(at: Pos2, middle: Pos2, palette: &ThemeColors) -> Label {
    Label {
        text: "black".to_owned(),
        at,
        sides: vec![(at - middle).normalized(), vec2(0.0, 1.0), vec2(-1.0, 0.0)],
        color: palette.secondary,
        size_pt: SMALL_PT,
        tip: "No light at all: every matte line starts here (section 3.1).",
        leader: false,
    }
}

/// Paints the directions of the red, green and blue axes into the lower left corner; returns the rectangle.
pub fn gizmo(
    ui: &Ui,
    [right, up, forward]: [[f32; 3]; 3],
    rect: Rect,
    names: [&str; 3],
    palette: &ThemeColors,
) -> Rect {
    let area = Rect::from_min_size(
        rect.left_bottom() + vec2(4.0, -2.0 * GIZMO_PT - 24.0),
        Vec2::splat(2.0 * GIZMO_PT + 20.0),
    );
    let painter = ui.painter_at(rect);
    let hues = [
        Color32::from_rgb(0xE0, 0x5A, 0x50),
        Color32::from_rgb(0x55, 0xB0, 0x5A),
        Color32::from_rgb(0x5A, 0x88, 0xE8),
    ];
    let mut order = [0, 1, 2];
    // Axes that point away from the viewer are painted first.
    order.sort_by(|&a: &usize, &b: &usize| forward[b].total_cmp(&forward[a]));
    for axis in order {
        let tip = vec2(right[axis], -up[axis]);
        let end = area.center() + tip * GIZMO_PT;
        let color =
            if forward[axis] > 0.05 { mixed(palette.background, hues[axis], 0.6) } else { hues[axis] };
        painter.line_segment([area.center(), end], Stroke::new(1.8, color));
        let beyond = if tip.length() < 0.2 { vec2(0.3, -0.3) } else { tip.normalized() * 0.32 };
        painter.text(
            end + beyond * GIZMO_PT,
            egui::Align2::CENTER_CENTER,
            names[axis],
            FontId::proportional(SMALL_PT),
            color,
        );
    }
    area
}

/// Screen position of a point in world units; `None` behind the camera.
pub fn screen_from_world(projector: &Projector, rect: Rect, world: [f32; 3]) -> Option<Pos2> {
    projector.screen_from_world(world).map(|point| rect.min + Vec2::from(point.at))
}

/// A polyline, world units, as line segments that points hide.
fn line_segments(curve: &[[f32; 3]], color: Color32, width_px: f32) -> impl Iterator<Item = Line> + '_ {
    curve.windows(2).map(move |ends| Line {
        a: ends[0],
        b: ends[1],
        color: color.to_array(),
        width_px,
        dash_px: 0.0,
        overlay: Overlay::Hidden,
    })
}

/// The unit vector perpendicular to `along` that points away from `middle`, as seen from `on`.
fn outward(along: Vec2, on: Pos2, middle: Pos2) -> Vec2 {
    let across = along.rot90();
    if across.dot(on - middle) < 0.0 { -across } else { across }
}

/// Linear interpolation of sRGB codes from `a` (`t` = 0) to `b` (`t` = 1).
pub fn mixed(a: Color32, b: Color32, t: f32) -> Color32 {
    let at = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * t).round() as u8;
    Color32::from_rgb(at(a.r(), b.r()), at(a.g(), b.g()), at(a.b(), b.b()))
}
