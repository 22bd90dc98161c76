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

    /// Whether the space is a cube, whose edges are parallel to the axes.
    fn is_cube(&self) -> bool {
        matches!(self.inputs, Some((ColorSpace::Rgb | ColorSpace::LogRgb, ..)))
    }

    /// Labels of the axes, the black corner and the ticks, the most important first. The ticks are painted here. Names and ticks
    /// of the axes of a cube stand at its silhouette, where no points are.
    pub fn labels(&self, ui: &Ui, projector: &Projector, rect: Rect, palette: &ThemeColors) -> Vec<Label> {
        let on_screen = |world| screen_from_world(projector, rect, world);
        let Some(middle) = on_screen([0.5; 3]) else { return Vec::new() };
        let (mut names, mut values) = (Vec::new(), Vec::new());
        let painter = ui.painter_at(rect);
        for axis in &self.axes {
            let Some(ends) = axis.line.first().zip(axis.line.last()).map(|(a, b)| [*a, *b]) else { continue };
            let moved = if self.is_cube() { edge_at_silhouette(ends, on_screen, middle) } else { NOT_MOVED };
            let on_edge = |world| on_screen(mirrored(world, moved));
            let Some((from, to)) = on_edge(ends[0]).zip(on_edge(ends[1])) else { continue };
            let along = (to - from).normalized();
            let length = (to - from).length();
            let is_closed = length < 1.0;
            let unit = if axis.unit.is_empty() || axis.unit == "\u{b0}" { "" } else { ", counts" };
            let side = match is_closed {
                true => vec2(0.0, -1.0),
                // Beyond the end of an edge of the axis there are no points; beyond that of another edge there may be.
                false if moved == NOT_MOVED => along,
                false => outward(along, from, middle),
            };
            names.push(Label {
                text: format!("{}{unit}", axis.name),
                at: to,
                sides: vec![side, outward(along, from, middle), along, -outward(along, from, middle)],
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
                let Some(at) = on_edge(tick.place) else { continue };
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

/// An edge of the unit cube, world units: whether each coordinate of the edge is mirrored, 1 − x in place of x.
type MirroredAxes = [bool; 3];

/// The axis itself.
const NOT_MOVED: MirroredAxes = [false; 3];
/// Share of the largest distance from the middle above which an edge is at the silhouette: of two edges at opposite sides, perspective
/// makes one a little nearer.
const AT_SILHOUETTE: f32 = 0.9;

/// A point of an axis, moved to a parallel edge of the unit cube.
fn mirrored(world: [f32; 3], moved: MirroredAxes) -> [f32; 3] {
    std::array::from_fn(|axis| if moved[axis] { 1.0 - world[axis] } else { world[axis] })
}

/// An edge of the unit cube on the screen.
struct CubeEdge {
    moved: MirroredAxes,
    /// Distance of the edge's line from the middle of the cube, points.
    off_middle: f32,
    /// Sum of the heights of both ends, downward, points.
    y: f32,
}

/// The edge of the unit cube, parallel to the axis with these ends, that is at the silhouette: the axis itself where it is, else the lower one
/// of the others on the screen. `middle`: the place of the middle of the cube on the screen.
fn edge_at_silhouette(
    ends: [[f32; 3]; 2],
    on_screen: impl Fn([f32; 3]) -> Option<Pos2>,
    middle: Pos2,
) -> MirroredAxes {
    let along = (0..3).find(|&axis| (ends[1][axis] - ends[0][axis]).abs() > 0.5).unwrap_or(0);
    let [first, second] = [(along + 1) % 3, (along + 2) % 3];
    let edge = |index: usize| {
        let mut moved = NOT_MOVED;
        (moved[first], moved[second]) = (index & 1 != 0, index & 2 != 0);
        let (from, to) = on_screen(mirrored(ends[0], moved)).zip(on_screen(mirrored(ends[1], moved)))?;
        let across = (to - from).normalized().rot90();
        Some(CubeEdge { moved, off_middle: across.dot(from - middle).abs(), y: from.y + to.y })
    };
    let edges: Vec<CubeEdge> = (0..4).filter_map(edge).collect();
    let farthest = edges.iter().map(|edge| edge.off_middle).fold(0.0, f32::max);
    let at_silhouette = edges.iter().filter(|edge| edge.off_middle >= AT_SILHOUETTE * farthest);
    let preferred = at_silhouette.max_by(|a, b| {
        let is_axis = |edge: &CubeEdge| edge.moved == NOT_MOVED;
        is_axis(a).cmp(&is_axis(b)).then(a.y.total_cmp(&b.y))
    });
    preferred.map_or(NOT_MOVED, |edge| edge.moved)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The cube seen from the front right and above: red to the right, blue up, green away from the viewer, up and to the right.
    fn seen([red, green, blue]: [f32; 3]) -> Pos2 {
        Pos2::new(100.0 * red + 40.0 * green, -100.0 * blue - 30.0 * green)
    }

    #[test]
    fn ticks_stand_at_the_silhouette_of_the_cube() {
        let middle = seen([0.5; 3]);
        let edge = |ends: [[f32; 3]; 2]| edge_at_silhouette(ends, |world| Some(seen(world)), middle);
        let black = [0.0; 3];
        assert_eq!(edge([black, [1.0, 0.0, 0.0]]), NOT_MOVED, "the red axis is the lower edge");
        assert_eq!(edge([black, [0.0, 0.0, 1.0]]), NOT_MOVED, "the blue axis is the left edge");
        let green = edge([black, [0.0, 1.0, 0.0]]);
        assert_eq!(
            green,
            [true, false, false],
            "the green axis is inside: its ticks stand at the lower right edge"
        );
        assert_eq!(seen(mirrored([0.0, 0.25, 0.0], green)), Pos2::new(110.0, -7.5));
    }
}
