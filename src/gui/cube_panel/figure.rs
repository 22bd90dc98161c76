//! The shapes of one region in the color space: cylinder, slice, skewed T, illuminant, window ellipsoid.

use super::labels::{Label, all_around};
use crate::app::State;
use crate::gpu::{self, Line, Orbit, Overlay, Projection, Projector, Vertex};
use crate::gui::instant_key::{InstantKey, instant_key};
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets;
use crate::raster::RegionId;
use crate::view::{
    self, ColorSpace, CubeSettings, Item, Mesh, Picture, Point, RegionShapes, ResultSnapshot, Solid, Theme,
};
use egui::{Color32, Rect, Stroke, Ui};
use std::borrow::Cow;
use std::sync::Arc;

const CYLINDER_ALPHA: u8 = 16;
const SLICE_ALPHA: u8 = 14;
const DARK_ALPHA: u8 = 30;
const ELLIPSOID_ALPHA: u8 = 26;
const OUTLINE_ALPHA: u8 = 170;
const LINE_PT: f32 = 2.0;
const OUTLINE_PT: f32 = 1.2;
const DASH_PT: f32 = 5.0;

/// The shapes of the selected region, otherwise of the hovered one.
#[derive(Default)]
pub struct Figure {
    /// The inputs that the shapes were made from.
    inputs: Option<Inputs>,
    /// Translucent bodies.
    pub meshes: Vec<gpu::Mesh>,
    /// Edges of the translucent bodies, and the lines of the skewed T.
    pub lines: Vec<Line>,
    /// Bodies whose silhouettes are drawn, with their colors.
    smooth_meshes: Vec<(Mesh, Color32)>,
    shape_labels: Vec<ShapeLabel>,
    /// Ends of the matte line, world units: labels are placed across this line.
    matte_line: Option<[Point; 2]>,
}

/// A labeled point, world units.
struct ShapeLabel {
    place: Point,
    text: Cow<'static, str>,
    tip: &'static str,
    dot: bool,
}

/// Everything that the shapes depend on.
#[derive(Clone, PartialEq)]
struct Inputs {
    /// The result, compared by its address. The `Arc` is kept, so that no other result can take the address.
    shown: SameResult,
    region: Option<RegionId>,
    window: Option<u32>,
    /// Color space, which of cylinder, slice, lines, illuminant and ellipsoid are shown, theme.
    view: (ColorSpace, [bool; 5], Theme),
    /// The instant at the debugger's cursor, in place of the result.
    instant: Option<InstantKey>,
}

/// A result that equals another one if both are the same snapshot.
#[derive(Clone)]
struct SameResult(Arc<ResultSnapshot>);

impl PartialEq for SameResult {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Inputs {
    fn of(state: &State) -> Option<Self> {
        let CubeSettings {
            space,
            show_cylinder,
            show_slice,
            show_lines,
            show_illuminant,
            show_ellipsoid,
            ..
        } = state.view.cube;
        let selected = state.document.selection.item;
        let window = |item| if let Some(Item::Window(window)) = item { Some(window) } else { None };
        let hovered = || state.hover.and_then(|item| state.region_of(item));
        Some(Self {
            shown: SameResult(Arc::clone(state.shown()?)),
            region: state.selected_region().or_else(hovered),
            window: window(state.hover).or_else(|| window(selected)),
            view: (
                space,
                [show_cylinder, show_slice, show_lines, show_illuminant, show_ellipsoid],
                state.view.theme,
            ),
            instant: instant_key(state),
        })
    }
}

impl Figure {
    /// Rebuilds the shapes when an input has changed; returns whether one has.
    pub fn update(&mut self, state: &State, picture: &Picture) -> bool {
        let inputs = Inputs::of(state);
        if self.inputs == inputs {
            return false;
        }
        *self = Self { inputs: inputs.clone(), ..Self::default() };
        let Some(Inputs { shown: SameResult(shown), region, window, view: (space, show, theme), .. }) =
            inputs
        else {
            return true;
        };
        let palette = ThemeColors::of(theme);
        let mut builder = ShapeBuilder { figure: self, space, full: picture.histogram.full_counts };
        if let Some(replay) = state.followed() {
            builder.add_instant(state, replay, &shown, &palette);
            return true;
        }
        let [cylinder, slice, lines, illuminant, ellipsoid] = show;
        if let Some(region) = region
            && let Some(shapes) = view::region_shapes(&shown, region)
        {
            let color = shown.region_colors.get(region.index());
            let color = color.map_or(palette.secondary, |&color| widgets::color(color));
            if cylinder {
                builder.cylinder(&shown, &shapes, color, palette.secondary);
            }
            if let Some(solid) = shapes.slice.as_ref().filter(|_| slice) {
                builder.add_solid(solid, color, SLICE_ALPHA);
                builder.add_label_at_corner(
                    solid,
                    "slice",
                    "The colors within the slice's half width of the dichromatic plane (section 5.4.2).",
                );
            }
            if lines {
                builder.add_skewed_t(&shapes, palette.text);
            }
        }
        if let Some(ends) = view::illuminant_line(&shown).filter(|_| illuminant) {
            let tip = "The color of the light, common to all highlights (section 5.4).";
            builder.add_light(&ends, palette.text, "illuminant", tip);
        }
        if let Some(ends) = view::second_lamp_line(&shown).filter(|_| illuminant) {
            let tip = "The color of a second lamp, whose highlights some of the regions show (section 7.5).";
            builder.add_light(&ends, palette.text, "second lamp", tip);
        }
        if let Some(solid) = window.filter(|_| ellipsoid).and_then(|w| view::window_ellipsoid(&shown, w)) {
            builder.add_solid(&solid, palette.accent, ELLIPSOID_ALPHA);
            builder.add_label_at_corner(&solid, "window", "The window's colors at two standard deviations: what its class is decided from (section 5.2.1).");
        }
        true
    }

    /// The silhouettes of the smooth bodies: the curves along which the surface turns away from the camera.
    pub fn silhouettes(&self, orbit: &Orbit) -> Vec<Line> {
        let mut lines = Vec::new();
        for (mesh, color) in &self.smooth_meshes {
            silhouette(mesh, orbit, |a, b| lines.push(outline_piece(a, b, *color)));
        }
        lines
    }

    /// The labels of the shapes, the most important first. The dots are painted here.
    pub fn labels(&self, ui: &Ui, projector: &Projector, rect: Rect, palette: &ThemeColors) -> Vec<Label> {
        let painter = ui.painter_at(rect);
        let ends =
            self.matte_line.map(|ends| ends.map(|end| super::frame::screen_from_world(projector, rect, end)));
        let matte_line =
            if let Some([Some(a), Some(b)]) = ends { (b - a).normalized() } else { egui::Vec2::ZERO };
        let mut sides = all_around();
        sides.sort_by(|a, b| a.dot(matte_line).abs().total_cmp(&b.dot(matte_line).abs()));
        let of = |note: &ShapeLabel| {
            let at = super::frame::screen_from_world(projector, rect, note.place)?;
            if note.dot {
                painter.circle(at, 4.0, palette.background, Stroke::new(1.8, palette.text));
            }
            Some(Label {
                text: note.text.to_string(),
                at,
                sides: sides.clone(),
                leader: true,
                color: palette.text,
                size_pt: SMALL_PT,
                tip: note.tip,
            })
        };
        self.shape_labels.iter().filter_map(of).collect()
    }
}

/// Converts shapes from counts into the color space shown, and adds them to the figure.
pub struct ShapeBuilder<'a> {
    figure: &'a mut Figure,
    space: ColorSpace,
    full: f32,
}

impl ShapeBuilder<'_> {
    /// Adds the cylinder of a region and the dark sphere.
    fn cylinder(&mut self, shown: &ResultSnapshot, shapes: &RegionShapes, color: Color32, dark: Color32) {
        if let Some(solid) = &shapes.cylinder {
            self.add_solid(solid, color, CYLINDER_ALPHA);
            self.add_label_at_corner(
                solid,
                "cylinder",
                "The colors within the cylinder's radius of the matte line (section 5.3.2).",
            );
        }
        if let Some(solid) = view::dark_sphere(shown) {
            self.add_solid(&solid, dark, DARK_ALPHA);
        }
    }

    /// Adds both lines of a region, meeting points and labels.
    fn add_skewed_t(&mut self, shapes: &RegionShapes, color: Color32) {
        for &place in &shapes.meeting_points {
            let tip = if shapes.meeting_point_found {
                "Where the highlight line leaves the matte line: the body reflection under the highlight (section 3.1)."
            } else {
                "No highlight was found: where highlights usually leave the matte line, at half of its length or beyond (section 5.4.1)."
            };
            self.add_label(place, "meeting point", tip, true);
        }
        let tip = "The end of the matte line, where the surface faces the light (section 5.4.1).";
        self.add_label(shapes.brightest_matte, "brightest matte point", tip, true);
        self.add_matte_line(&shapes.matte_line, color, LINE_PT);
        let third = interpolated(shapes.matte_line, 0.35);
        self.add_label(
            third,
            "matte line",
            "Body reflection alone: from black to the brightest matte point (section 3.1).",
            false,
        );
        for &ends in &shapes.highlight_lines {
            self.add_line(&ends, color, LINE_PT, 0.0);
            let tip = "Body reflection of one shade plus more and more light reflected at the surface (section 3.1).";
            self.add_label(interpolated(ends, 0.75), "highlight line", tip, false);
        }
    }

    /// Adds the line of the light's color.
    pub fn add_light(&mut self, ends: &[Point; 2], color: Color32, name: &'static str, tip: &'static str) {
        let dash = if self.space == ColorSpace::Rgb { DASH_PT } else { 0.0 };
        self.add_line(ends, color, OUTLINE_PT, dash);
        self.add_label(ends[1], name, tip, false);
    }

    /// Adds the matte line; labels are placed across this line.
    pub fn add_matte_line(&mut self, ends: &[Point; 2], color: Color32, width_px: f32) {
        self.add_line(ends, color, width_px, 0.0);
        self.figure.matte_line = Some(ends.map(|end| self.space.place(end, self.full)));
    }

    /// Adds a translucent body with a label.
    pub fn add_body(&mut self, solid: &Solid, color: Color32, name: &'static str, tip: &'static str) {
        self.add_solid(solid, color, CYLINDER_ALPHA);
        self.add_label_at_corner(solid, name, tip);
    }

    /// Adds a label at a color, counts; with a dot if `dot` is set.
    pub fn add_label(
        &mut self,
        counts: Point,
        text: impl Into<Cow<'static, str>>,
        tip: &'static str,
        dot: bool,
    ) {
        let place = self.space.place(counts, self.full);
        self.figure.shape_labels.push(ShapeLabel { place, text: text.into(), tip, dot });
    }

    /// Adds a label at the first point of the solid's last outline.
    fn add_label_at_corner(&mut self, solid: &Solid, text: &'static str, tip: &'static str) {
        if let Some(&corner) = solid.outlines.last().and_then(|outline| outline.first()) {
            self.add_label(corner, text, tip, false);
        }
    }

    /// Adds a polyline through colors, counts.
    pub fn add_line(&mut self, counts: &[Point], color: Color32, width_px: f32, dash_px: f32) {
        let curve = self.space.polyline(counts, self.full);
        let pieces = curve.windows(2).map(|ends| Line {
            a: ends[0],
            b: ends[1],
            color: color.to_array(),
            width_px,
            dash_px,
            overlay: Overlay::Over,
        });
        self.figure.lines.extend(pieces);
    }

    /// Adds a body: its surface, its edges and its silhouette.
    fn add_solid(&mut self, solid: &Solid, color: Color32, alpha: u8) {
        let surface = self.space.surface(&solid.surface, self.full);
        let [r, g, b, _] = color.to_array();
        let corner = |&index: &u32| Vertex {
            position: surface.points[index as usize],
            normal: surface.normals[index as usize],
            color: [r, g, b, alpha],
        };
        self.figure.meshes.push(gpu::Mesh::new(surface.triangles.iter().flatten().map(corner).collect()));
        for edge in &solid.outlines {
            let curve = self.space.polyline(edge, self.full);
            self.figure.lines.extend(curve.windows(2).map(|ends| outline_piece(ends[0], ends[1], color)));
        }
        self.figure.smooth_meshes.push((surface, color));
    }
}

/// A piece of an outline, faint where points hide the piece.
fn outline_piece(a: Point, b: Point, color: Color32) -> Line {
    let [r, g, b_, _] = color.to_array();
    let color = [r, g, b_, OUTLINE_ALPHA];
    Line { a, b, color, width_px: OUTLINE_PT, dash_px: 0.0, overlay: Overlay::Faint }
}

/// The point at a share `t` of the way between two points.
fn interpolated([a, b]: [Point; 2], t: f32) -> Point {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

/// The silhouette of a mesh: the curve on which the interpolated normal is perpendicular to the line of sight
/// (Hertzmann & Zorin 2000).
fn silhouette(mesh: &Mesh, orbit: &Orbit, mut add: impl FnMut(Point, Point)) {
    let [_, _, forward] = orbit.right_up_forward();
    let eye = orbit.eye();
    let facing: Vec<f32> = mesh
        .points
        .iter()
        .zip(&mesh.normals)
        .map(|(point, normal)| match orbit.projection {
            Projection::Perspective => (0..3).map(|i| normal[i] * (eye[i] - point[i])).sum(),
            Projection::Orthographic => (0..3).map(|i| -normal[i] * forward[i]).sum::<f32>(),
        })
        .collect();
    for triangle in &mesh.triangles {
        let mut crossings = [[0.0; 3]; 3];
        let mut found = 0;
        for side in 0..3 {
            let (a, b) = (triangle[side] as usize, triangle[(side + 1) % 3] as usize);
            if (facing[a] > 0.0) != (facing[b] > 0.0) {
                let t = facing[a] / (facing[a] - facing[b]);
                crossings[found] = interpolated([mesh.points[a], mesh.points[b]], t);
                found += 1;
            }
        }
        if found == 2 {
            add(crossings[0], crossings[1]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The side of an upright cylinder of radius 0.2 around the middle of the unit square.
    fn cylinder_side(sides: u32) -> Mesh {
        let mut mesh = Mesh::default();
        for side in 0..sides {
            let (y, x) = (std::f32::consts::TAU * side as f32 / sides as f32).sin_cos();
            for z in [0.0, 1.0] {
                mesh.points.push([0.5 + 0.2 * x, 0.5 + 0.2 * y, z]);
                mesh.normals.push([x, y, 0.0]);
            }
            let at = |i: u32| (2 * side + i) % (2 * sides);
            mesh.triangles.extend([[at(0), at(2), at(3)], [at(0), at(3), at(1)]]);
        }
        mesh
    }

    #[test]
    fn a_cylinder_has_two_straight_silhouettes_where_it_turns_away() {
        let mut orbit = Orbit { projection: Projection::Orthographic, ..Orbit::default() };
        // Seen along +y, the silhouettes are the lines at the smallest and the largest x.
        orbit.look_along([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let mut found = Vec::new();
        silhouette(&cylinder_side(62), &orbit, |a, b| found.push((a, b)));
        assert!(found.len() >= 4);
        for (a, b) in found {
            for end in [a, b] {
                assert!(((end[0] - 0.5).abs() - 0.2).abs() < 2e-3, "{end:?}");
            }
            assert_eq!(a[0] < 0.5, b[0] < 0.5);
        }
    }
}
