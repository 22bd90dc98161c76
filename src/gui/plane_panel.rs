//! The plane panel: the selected region's pixels in its dichromatic plane, the skewed T of figure 2.

mod chart;
mod cluster;
mod cursor;
mod kinds;
mod labels;
pub mod testing;

use super::action::Action;
use super::theme::SMALL_PT;
use super::{PanelContext, context_menu, lacking_result, popup_scroll, widgets};
use crate::app::Edit;
use crate::baseline::MarkedSkewedT;
use crate::color::ContrastCurve;
use crate::gui::outline::{Outline, combine_by_keys};
use crate::params::Method;
use crate::raster::{PixelIndex, RegionId};
use crate::segment::LightBasis;
use crate::view::{
    Item, NamedMarks, Picture, PixelAmounts, PlaneBranch, Point, RegionPlane, ResultSnapshot, Theme, Tool,
    plane_mask, region_plane, sphere_in_plane,
};
use chart::{Chart, navigate};
use egui::text::LayoutJob;
use egui::{Align2, Color32, Rect, Response, RichText, Sense, Shape, Stroke, Ui, vec2};
use labels::{Obstacles, PointDensity};
use std::sync::Arc;

/// Largest distance from the pointer at which a point counts as hovered, screen points.
const HOVER_RADIUS_PT: f32 = 8.0;
/// Radius of the ring around the hovered color, points.
const RING_PT: f32 = 6.0;
/// Width and height of the area kept for the amounts of the hovered color, points.
const HOVERED_TEXT_PT: egui::Vec2 = vec2(300.0, 30.0);
/// Width of a view that has room for the facts beside the values of the hovered color, points.
const TWO_TEXTS_PT: f32 = 480.0;

/// The plane panel.
#[derive(Default)]
pub struct PlanePanel {
    of: Option<(Arc<ResultSnapshot>, RegionId)>,
    /// The instant at the debugger's cursor that is shown; `None` when the result is shown.
    plane_instant: Option<cursor::PlaneInstant>,
    /// The clusters of a step of the classification or the merging.
    clusters: cluster::ClusterCache,
    plane: Option<RegionPlane>,
    chart: Option<Chart>,
    /// Whether a person has panned or zoomed. Until then, the chart is fitted to the plane at every change.
    is_moved: bool,
    point_mesh: Option<PointMesh>,
    /// The outline that is being drawn.
    outline: Outline,
    /// The pixel that the context menu is about; none where the pointer was at no point.
    menu_pixel: Option<PixelIndex>,
}

/// The points as a mesh, with the inputs that the mesh was made for.
struct PointMesh {
    inputs: (Chart, Rect, bool, Theme, Option<ContrastCurve>),
    named_marks: Arc<NamedMarks>,
    mesh: Arc<egui::Mesh>,
    /// Where the points lie, for labels that keep away from points.
    density: PointDensity,
}

impl PlanePanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let state = cx.state;
        if let Some(replay) = state.followed() {
            if let Some(clusters) = self.clusters.get(state) {
                return cluster::show(ui, cx, clusters);
            }
            return match cursor::plane_instant(state) {
                Some(frame) => self.show_instant(ui, cx, replay, frame),
                None => widgets::placeholder(ui, cx.palette, "The step at the cursor concerns no region."),
            };
        }
        let Some((shown, region)) = cx.state.shown().cloned().zip(cx.state.selected_region()) else {
            return nothing_selected(ui, cx);
        };
        self.update(&shown, region);
        self.show_region(ui, cx, &shown, region);
    }

    /// Shows the plane of a region of the result.
    fn show_region(&mut self, ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot, region: RegionId) {
        let Some(plane) = &self.plane else {
            widgets::placeholder(
                ui,
                cx.palette,
                "This region has no matte line, and so no dichromatic plane.",
            );
            return;
        };
        if !cx.is_export {
            let frame = egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 3));
            frame.show(ui, |ui| kinds::toolbar(ui, cx, plane));
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 16.0 || rect.height() < 16.0 {
            return;
        }
        response.widget_info(|| {
            let name = format!("Dichromatic plane of region {region}");
            egui::WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, name)
        });
        let moved = self.chart.filter(|_| self.is_moved);
        let is_pointer = cx.state.view.plane.tool == Tool::Pointer;
        let chart = navigate(ui, &response, plane, moved, rect, &mut self.is_moved, is_pointer);
        self.chart = Some(chart);
        let painter = ui.painter_at(rect);
        let numbers = chart.axes(&painter, plane, rect, cx.palette);
        let mesh = point_mesh(&mut self.point_mesh, cx, plane, chart, rect);
        painter.add(Shape::Mesh(mesh));
        let numbers = numbers.paint();
        paint_sphere(&painter, cx, plane, chart, rect);
        // In a narrow view the values of the hovered color take the place of the facts.
        let is_taken =
            rect.width() < TWO_TEXTS_PT && hovered_color(cx, &shown.picture).is_some() && !cx.is_export;
        let facts = (!is_taken).then(|| paint_facts(&painter, cx, plane, shown, rect)).flatten();
        let amounts = paint_hovered(&painter, cx, plane, chart, &shown.picture, rect);
        let density = PointDensity::default();
        let points = self.point_mesh.as_ref().map_or(&density, |point_mesh| &point_mesh.density);
        let obstacles =
            Obstacles { points, taken: facts.into_iter().chain([amounts]).chain(numbers).collect() };
        chart.skewed_t(ui, &response, plane, rect, cx.palette, &obstacles);
        if let Some(outline) = self.outline.handle_pointer(ui, &response, cx.state.view.plane.tool) {
            mark_outlined(
                ui,
                cx,
                shown,
                plane,
                &outline.iter().map(|at| chart.oblique(*at, rect)).collect::<Vec<_>>(),
            );
        }
        self.outline.paint(&painter, &response, cx.palette.accent);
        if is_pointer {
            self.handle_pointer(cx, &response, chart, rect);
        }
        self.context_menu(cx, &response, chart, rect);
    }

    /// Shows, at a click with the secondary button, what can be done with the pixel of the nearest point and with the chart.
    fn context_menu(&mut self, cx: &mut PanelContext, response: &Response, chart: Chart, rect: Rect) {
        if let Some(at) = response.interact_pointer_pos().filter(|_| response.secondary_clicked()) {
            self.menu_pixel = self.pixel_near(at, chart, rect);
        }
        popup_scroll::context_menu(response, |ui| {
            if let Some(pixel) = self.menu_pixel {
                context_menu::of_pixel_alone(ui, cx, pixel);
                ui.separator();
            }
            if ui.button("Fit the plane").clicked() {
                self.is_moved = false;
            }
            context_menu::action(ui, cx, "Export\u{2026}", Action::Export);
        });
    }

    /// The pixel whose point is nearest to a place on the screen; none where all points are far.
    fn pixel_near(&self, at: egui::Pos2, chart: Chart, rect: Rect) -> Option<PixelIndex> {
        let radius = HOVER_RADIUS_PT * chart.counts_per_pt;
        self.plane.as_ref()?.nearest(chart.oblique(at, rect), radius).map(|point| point.pixel)
    }

    /// Drops an unfinished outline when Escape is pressed, and consumes the key, so that the selection stays.
    pub fn cancel_on_escape(&mut self, ctx: &egui::Context) {
        if self.outline.is_unfinished()
            && ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, egui::Key::Escape))
        {
            self.outline = Outline::default();
        }
    }

    /// Computes the plane of a region, where result or region have changed.
    fn update(&mut self, shown: &Arc<ResultSnapshot>, region: RegionId) {
        if self.plane_instant.take().is_some() {
            (self.of, self.is_moved) = (None, false);
        }
        let known = self.of.as_ref().map(|(shown, region)| (Arc::as_ptr(shown), *region));
        if known == Some((Arc::as_ptr(shown), region)) {
            return;
        }
        // A chart that a person moved is kept when the same region of a newer result is shown.
        if known.is_none_or(|(_, known)| known != region) {
            self.is_moved = false;
        }
        self.plane = region_plane(shown, region);
        self.point_mesh = None;
        self.of = Some((Arc::clone(shown), region));
    }

    /// Sends what the pointer does: hovering a point hovers its pixel, a click selects the pixel.
    fn handle_pointer(&self, cx: &mut PanelContext, response: &Response, chart: Chart, rect: Rect) {
        let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
        let pointer = clicked.or(response.hover_pos().filter(|_| !response.dragged()));
        let hover = pointer.and_then(|at| self.pixel_near(at, chart, rect)).map(Item::Pixel);
        if let Some(item) = hover {
            cx.hover(item);
        }
        if let Some(item) = hover.filter(|_| response.clicked() && !response.double_clicked()) {
            cx.send(Edit::Select(Some(item)));
        }
    }
}

/// Marks the pixels of the region whose colors lie inside an outline, oblique counts.
fn mark_outlined(
    ui: &Ui,
    cx: &mut PanelContext,
    shown: &ResultSnapshot,
    plane: &RegionPlane,
    corners: &[[f32; 2]],
) {
    if let Some(mask) = plane_mask(shown, plane, |place| crate::gpu::pick::encloses(corners, place)) {
        cx.send(Edit::Mark(Arc::new(mask), combine_by_keys(ui), None));
    }
}

/// Shows, while no region is selected, a sentence and the button that selects the largest region.
fn nothing_selected(ui: &mut Ui, cx: &mut PanelContext) {
    let text = "Select a region to see its dichromatic plane.";
    if lacking_result::has_none(cx.state) {
        return lacking_result::placeholder(ui, cx, text);
    }
    let regions = cx.state.shown().map(|shown| &shown.analysis.intrinsic.regions);
    let largest = regions.and_then(|regions| regions.iter().rev().max_by_key(|region| region.pixels));
    let button = largest.map(|_| "Select the largest region");
    if widgets::placeholder_with_button(ui, cx.palette, text, button)
        && let Some(largest) = largest
    {
        cx.send(Edit::Select(Some(Item::Region(largest.id))));
    }
}

/// The points as a mesh of two triangles each, rebuilt when chart, coloring or theme change.
fn point_mesh(
    cached: &mut Option<PointMesh>,
    cx: &PanelContext,
    plane: &RegionPlane,
    chart: Chart,
    rect: Rect,
) -> Arc<egui::Mesh> {
    let by_label = cx.state.view.plane.color_by_label;
    let own = cx.state.focus_color();
    let contrast = cx.state.contrast();
    let inputs = (chart, rect, by_label, cx.state.view.theme, contrast);
    let named = &cx.state.document.selection.named;
    let is_same = |known: &&PointMesh| known.inputs == inputs && Arc::ptr_eq(&known.named_marks, named);
    if let Some(point_mesh) = cached.as_ref().filter(is_same) {
        return Arc::clone(&point_mesh.mesh);
    }
    let (mut mesh, mut density) = (egui::Mesh::default(), PointDensity::new(rect));
    mesh.reserve_vertices(4 * plane.points.len());
    mesh.reserve_triangles(2 * plane.points.len());
    for point in &plane.points {
        let at = chart.screen(plane.oblique(point.body, point.surface), rect);
        if rect.expand(4.0).contains(at) {
            // At the debugger's cursor the colors tell what the step did.
            let mark = named.at(point.pixel.index()).filter(|_| point.meaning.is_none());
            let color = if let Some(mark) = mark {
                widgets::color(mark.color)
            } else if by_label {
                kinds::color_of(point, own, cx.state.view.theme)
            } else {
                widgets::own_color(point.color, contrast)
            };
            let side = 1.7 + 0.5 * (point.count as f32).ln();
            mesh.add_colored_rect(Rect::from_center_size(at, vec2(side, side)), color);
            density.add(at);
        }
    }
    let mesh = Arc::new(mesh);
    *cached = Some(PointMesh { inputs, named_marks: Arc::clone(named), mesh: Arc::clone(&mesh), density });
    mesh
}

/// Paints the cluster of the sphere of section 3, where the panel *Geometry* draws it.
fn paint_sphere(painter: &egui::Painter, cx: &PanelContext, plane: &RegionPlane, chart: Chart, rect: Rect) {
    let settings = cx.state.view.geometry;
    if !settings.is_drawn || cx.state.followed().is_some() {
        return;
    }
    let mut mesh = egui::Mesh::default();
    for [body, surface] in sphere_in_plane(settings, plane) {
        let at = chart.screen(plane.oblique(body, surface), rect);
        if rect.expand(2.0).contains(at) {
            mesh.add_colored_rect(Rect::from_center_size(at, vec2(2.0, 2.0)), cx.palette.accent);
        }
    }
    painter.add(Shape::mesh(mesh));
}

/// Where the lines of marked pixels meet, and the gap between them, as another line of text; empty under other methods.
fn meeting_text(shown: &ResultSnapshot) -> String {
    let is_by_hand = shown.params.method == Method::ByHand;
    let found = MarkedSkewedT::of(&shown.analysis.matte, &shown.analysis.planar).filter(|_| is_by_hand);
    found.map_or_else(String::new, |found| {
        format!(
            "\nT at {:.0} % of the matte line, gap {:.1} counts",
            found.position_percent, found.gap_counts
        )
    })
}

/// Writes angle, slice width and noise into the upper left corner, or why the region has no plane. Returns the rectangle of the
/// text.
fn paint_facts(
    painter: &egui::Painter,
    cx: &PanelContext,
    plane: &RegionPlane,
    shown: &ResultSnapshot,
    rect: Rect,
) -> Option<Rect> {
    let regions = &shown.analysis.intrinsic.regions;
    let region = plane.region.and_then(|region| regions.get(region.index()))?;
    let rms = region.fit_rms_counts;
    let text = if plane.has_plane {
        let (angle, slice) = (plane.angle_deg, plane.slice_half_width);
        let several = several_highlights(&plane.branches);
        let meeting = meeting_text(shown);
        format!(
            "angle {angle:.1}\u{b0}\nslice \u{b1}{slice:.1} counts\n\u{3b5} {rms:.2} counts rms{meeting}{several}"
        )
    } else {
        let hypothesis = plane.region.and_then(|region| shown.analysis.finals.hypotheses.get(region.index()));
        let has_highlight = hypothesis.is_some_and(|hypothesis| hypothesis.highlight.is_some());
        let why = if shown.analysis.finals.light.basis == LightBasis::NotSought {
            "the method seeks no light"
        } else if shown.analysis.finals.light.basis == LightBasis::ByHand {
            "the marked pixels have no skewed T"
        } else if shown.analysis.illuminant.is_none() {
            "the light's color is unknown, as no highlight was found"
        } else if !has_highlight && !shown.params.refinements().extend_planes {
            "no neighbor passed the tests of a highlight (section 5.4.1)"
        } else if shown.params.rules().readings.angle_by_width {
            "the angle between body and surface vector is too small for the cylinder width (section 7.5)"
        } else {
            "its body color is the light's"
        };
        let radius = plane.radius;
        format!(
            "No dichromatic plane: {why}.\nShown across the matte line.\ncylinder radius {radius:.1} counts\n\
             {rms:.2} counts rms from the line"
        )
    };
    // In a wide view the facts stand beside the values of the hovered color; in a narrow one the values take their place.
    let taken_pt = if rect.width() >= TWO_TEXTS_PT { HOVERED_TEXT_PT.x + 24.0 } else { 16.0 };
    let mut job = widgets::with_subscripts(&text, SMALL_PT, cx.palette.secondary);
    job.wrap.max_width = (rect.width() - taken_pt).max(1.0);
    Some(paint_text(painter, cx, rect.left_top() + vec2(8.0, 4.0), Align2::LEFT_TOP, job))
}

/// Writes a text with subscripts and a background, so that it is readable over lines; returns its rectangle.
fn paint_text(
    painter: &egui::Painter,
    cx: &PanelContext,
    at: egui::Pos2,
    anchor: Align2,
    mut job: LayoutJob,
) -> Rect {
    job.halign = anchor.x();
    let galley = painter.layout_job(job);
    let place = anchor.anchor_size(at, galley.size());
    painter.rect_filled(place.expand2(vec2(2.0, 0.0)), 2.0, cx.palette.panel.gamma_multiply(0.92));
    let corner = if anchor.x() == egui::Align::RIGHT { place.right_top() } else { place.left_top() };
    painter.galley(corner, galley, Color32::PLACEHOLDER);
    place
}

/// A line of text that lists the highlights on different shades (section 7.4); empty for fewer than two.
fn several_highlights(branches: &[PlaneBranch]) -> String {
    if branches.len() < 2 {
        return String::new();
    }
    let shades: Vec<String> = branches.iter().map(|branch| format!("{:.0}", branch.meeting_point)).collect();
    format!("\n{} highlight lines from m_b {}", shades.len(), shades.join(", "))
}

/// Paints a ring around the color that is hovered in any panel, and writes its amounts of body, surface and noise: as measured,
/// and in the result where the result differs. Returns the rectangle that is kept for this text, also without a hovered color, so
/// that no label moves when the pointer does.
fn paint_hovered(
    painter: &egui::Painter,
    cx: &PanelContext,
    plane: &RegionPlane,
    chart: Chart,
    picture: &Picture,
    rect: Rect,
) -> Rect {
    let corner = rect.right_top() + vec2(-8.0, 4.0);
    let kept =
        Rect::from_min_max(corner - vec2(HOVERED_TEXT_PT.x, 0.0), corner + vec2(0.0, HOVERED_TEXT_PT.y));
    let color = hovered_color(cx, picture);
    let Some(amounts) = color.map(|color| plane.amounts(color)) else { return kept };
    let at = chart.screen(plane.oblique(amounts.body, amounts.surface), rect);
    let elsewhere = |item| matches!(item, Item::Pixel(_)) && cx.state.region_of(item) != plane.region;
    let inside = !cx.state.hover.is_some_and(elsewhere);
    let color = if inside { cx.palette.accent } else { cx.palette.secondary };
    painter.circle_stroke(at, RING_PT, Stroke::new(3.5, Color32::from_black_alpha(140)));
    painter.circle_stroke(at, RING_PT, Stroke::new(1.6, color));
    let other = if inside { "" } else { "   not in this region" };
    let counts = |v: f32| widgets::signed(f64::from(v), 1);
    let [body, surface, noise] = [amounts.body, amounts.surface, amounts.noise].map(counts);
    let mut text = format!("measured  m_b {body}   m_s {surface}   \u{3b5} {noise}{other}");
    let in_result = match (cx.state.hover, cx.state.shown()) {
        (Some(Item::Pixel(pixel)), Some(shown)) if inside && cx.state.followed().is_none() => {
            PixelAmounts::of(shown, pixel).filter(|amounts| amounts.different_measured().is_some())
        }
        _ => None,
    };
    if let Some(PixelAmounts { result, .. }) = in_result {
        let surface = result.surface.map_or_else(|| "\u{2013}".to_owned(), counts);
        let body = counts(result.body);
        text = format!("{text}\nin the result, after the cut at noise  m_b {body}   m_s {surface}");
    }
    let job = widgets::with_subscripts(&text, SMALL_PT, cx.palette.text);
    paint_text(painter, cx, corner, Align2::RIGHT_TOP, job);
    kept
}

/// The color of the pixel or bin that is hovered in any panel, counts.
fn hovered_color(cx: &PanelContext, picture: &Picture) -> Option<Point> {
    match cx.state.hover? {
        Item::Pixel(pixel) => picture.photo.image.pixels.as_slice().get(pixel.index()).copied(),
        Item::Bin(bin) => picture.histogram.bins.get(bin as usize).map(|bin| bin.mean),
        Item::Region(_) | Item::Window(_) => None,
    }
}

/// Small text in the secondary color.
fn secondary_text(cx: &PanelContext, text: &str) -> RichText {
    RichText::new(text).size(SMALL_PT).color(cx.palette.secondary)
}
