//! The plane panel in classification and merging (section 5.2): the clusters that the step tested, their ellipses in the plane of the two
//! largest axes, and the limits of the classes.

use super::chart::Chart;
use super::secondary_text;
use crate::app::State;
use crate::gui::theme::SMALL_PT;
use crate::gui::{PanelContext, threshold_bar, widgets};
use crate::view::{Cluster, ClusterPlane, ELLIPSE_DEVIATIONS, Meaning, cluster_plane};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Number of corners by which an ellipse is drawn.
const CORNERS: usize = 64;
/// Margin around the clusters, points.
const MARGIN_PT: f32 = 28.0;

/// The clusters at the debugger's cursor, computed once for each place of the cursor.
#[derive(Default)]
pub struct ClusterCache {
    /// Generation of the trace, number of steps taken, and the clusters.
    shown: Option<(u64, usize, Option<ClusterPlane>)>,
}

impl ClusterCache {
    /// The clusters that the step at the cursor tested; none where the step is about no window and no pair of areas.
    pub fn get(&mut self, state: &State) -> Option<&ClusterPlane> {
        let (replay, shown) = (state.followed()?, state.newest.as_ref()?);
        let place = (state.debugger.generation, replay.at());
        if self.shown.as_ref().is_none_or(|(generation, at, _)| (*generation, *at) != place) {
            self.shown = Some((place.0, place.1, cluster_plane(replay, &shown.analysis.working)));
        }
        self.shown.as_ref()?.2.as_ref()
    }
}

/// Shows the clusters.
pub fn show(ui: &mut Ui, cx: &PanelContext, plane: &ClusterPlane) {
    if !cx.is_export {
        egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 3)).show(ui, |ui| legend(ui, cx, plane));
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    if rect.width() < 16.0 || rect.height() < 16.0 {
        return;
    }
    response.widget_info(|| {
        WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, format!("Clusters of {}", plane.title))
    });
    let painter = ui.painter_at(rect);
    let chart = fitted(plane, rect);
    paint_limits(&painter, cx, plane, chart, rect);
    for cluster in &plane.clusters {
        paint_points(&painter, cx, cluster, chart, rect);
    }
    for cluster in &plane.clusters {
        paint_ellipse(&painter, cx, cluster, chart, rect);
    }
    let ground = cx.palette.panel.gamma_multiply(0.8);
    let corner = rect.left_top() + vec2(8.0, 4.0);
    let font = FontId::proportional(SMALL_PT);
    let galley = painter.layout(plane.title.clone(), font, cx.palette.text, (rect.width() - 16.0).max(20.0));
    let title = Rect::from_min_size(corner, galley.size());
    painter.rect_filled(title.expand2(vec2(2.0, 0.0)), 2.0, ground);
    painter.galley(corner, galley, cx.palette.text);
    threshold_bar::show_at(ui, cx.palette, ground, title.left_bottom() + vec2(0.0, 2.0), &plane.tests);
}

/// Shows the legend of the clusters, and what the lines are.
fn legend(ui: &mut Ui, cx: &PanelContext, plane: &ClusterPlane) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (index, cluster) in plane.clusters.iter().enumerate() {
            let (name, tip) = match (index, cluster.meaning) {
                (_, None) if plane.clusters.len() == 1 => ("window", "The colors of the window (section 5.2.1)."),
                (_, None) => ("union", "The ellipse of both areas together (section 5.2.2)."),
                (0, _) => ("area", "The area that remains if both merge (section 5.2.2)."),
                (_, Some(Meaning::Refused)) => ("stays apart", "The union is of another class (section 5.2.2)."),
                _ => ("merged", "The union is of the class of both areas (section 5.2.2)."),
            };
            widgets::chip(ui, cx.palette, color(cx, cluster), name).on_hover_text(tip);
            ui.label(secondary_text(cx, name)).on_hover_text(tip);
            ui.add_space(6.0);
        }
        let tip = "Ellipses and lines at two standard deviations: a cluster within the dashed lines of an axis does not vary along \
                   the axis beyond the noise (section 5.2.1).";
        ui.label(secondary_text(cx, "dashed: noise")).on_hover_text(tip);
    });
}

/// The color of a cluster.
fn color(cx: &PanelContext, cluster: &Cluster) -> Color32 {
    cluster.meaning.map_or(cx.palette.text, |meaning| widgets::color(meaning.color(None)))
}

/// The chart in which all points, ellipses and limits are seen.
fn fitted(plane: &ClusterPlane, rect: Rect) -> Chart {
    let mut area = Rect::from_center_size(Pos2::ZERO, vec2(1.0, 1.0));
    for cluster in &plane.clusters {
        cluster.points.iter().for_each(|(place, ..)| area.extend_with((*place).into()));
        corners(cluster).for_each(|corner| area.extend_with(corner.into()));
    }
    for (axis, limit) in plane.limits.iter().enumerate() {
        let Some(limit) = limit.map(|limit| limit * ELLIPSE_DEVIATIONS) else { continue };
        for side in [-limit, limit] {
            area.extend_with(if axis == 0 { pos2(side, 0.0) } else { pos2(0.0, side) });
        }
    }
    let free = (rect.size() - vec2(2.0 * MARGIN_PT, 2.0 * MARGIN_PT)).max(vec2(20.0, 20.0));
    let needed = (area.size() / free).max_elem();
    Chart {
        center: area.center().into(),
        counts_per_pt: if needed.is_finite() { needed.max(0.002) } else { 1.0 },
    }
}

/// The corners of the ellipse of a cluster, counts.
fn corners(cluster: &Cluster) -> impl Iterator<Item = [f32; 2]> + '_ {
    let [long, short] = cluster.ellipse;
    (0..=CORNERS).map(move |corner| {
        let (sin, cos) = (std::f32::consts::TAU * corner as f32 / CORNERS as f32).sin_cos();
        std::array::from_fn(|axis| {
            cluster.mean[axis] + ELLIPSE_DEVIATIONS * (cos * long[axis] + sin * short[axis])
        })
    })
}

/// Paints both axes, and across each axis the deviation that the noise explains, dashed.
fn paint_limits(painter: &Painter, cx: &PanelContext, plane: &ClusterPlane, chart: Chart, rect: Rect) {
    let origin = chart.screen([0.0, 0.0], rect);
    let axis_stroke = Stroke::new(1.0, cx.palette.line);
    painter.hline(rect.x_range(), origin.y, axis_stroke);
    painter.vline(origin.x, rect.y_range(), axis_stroke);
    let stroke = Stroke::new(1.2, cx.palette.secondary);
    for (axis, limit) in plane.limits.iter().enumerate() {
        let Some(limit) = limit else { continue };
        for side in [-limit * ELLIPSE_DEVIATIONS, limit * ELLIPSE_DEVIATIONS] {
            let line = if axis == 0 {
                let x = chart.screen([side, 0.0], rect).x;
                [pos2(x, rect.top()), pos2(x, rect.bottom())]
            } else {
                let y = chart.screen([0.0, side], rect).y;
                [pos2(rect.left(), y), pos2(rect.right(), y)]
            };
            painter.extend(Shape::dashed_line(&line, stroke, 4.0, 4.0));
        }
    }
    let font = FontId::proportional(SMALL_PT);
    let note = |at: Pos2, align: Align2, text: &str| {
        let place = painter.text(at, align, text, font.clone(), cx.palette.secondary);
        painter.rect_filled(place.expand2(vec2(2.0, 0.0)), 2.0, cx.palette.panel.gamma_multiply(0.75));
        painter.text(at, align, text, font.clone(), cx.palette.secondary);
    };
    note(pos2(rect.right() - 6.0, origin.y - 2.0), Align2::RIGHT_BOTTOM, "1st axis, counts");
    note(pos2(origin.x + 4.0, rect.bottom() - 4.0), Align2::LEFT_BOTTOM, "2nd axis");
}

/// Paints the colors of a cluster, in the color of its meaning or as measured.
fn paint_points(painter: &Painter, cx: &PanelContext, cluster: &Cluster, chart: Chart, rect: Rect) {
    let by_label = cx.state.view.plane.color_by_label && cluster.meaning.is_some();
    let own = color(cx, cluster);
    let mut mesh = egui::Mesh::default();
    for (place, measured, _) in &cluster.points {
        let point_color = if by_label { own } else { widgets::own_color(*measured, cx.state.contrast()) };
        mesh.add_colored_rect(
            Rect::from_center_size(chart.screen(*place, rect), vec2(2.2, 2.2)),
            point_color,
        );
    }
    painter.add(Shape::mesh(mesh));
}

/// Paints the ellipse of a cluster and its axes.
fn paint_ellipse(painter: &Painter, cx: &PanelContext, cluster: &Cluster, chart: Chart, rect: Rect) {
    let color = color(cx, cluster);
    let line: Vec<Pos2> = corners(cluster).map(|corner| chart.screen(corner, rect)).collect();
    painter.add(Shape::line(line.clone(), Stroke::new(3.2, Color32::from_black_alpha(110))));
    painter.add(Shape::line(line, Stroke::new(1.6, color)));
    for axis in cluster.ellipse {
        let end = |sign: f32| {
            let at = [0, 1].map(|k| cluster.mean[k] + sign * ELLIPSE_DEVIATIONS * axis[k]);
            chart.screen(at, rect)
        };
        painter.line_segment([end(-1.0), end(1.0)], Stroke::new(1.0, color));
    }
}
