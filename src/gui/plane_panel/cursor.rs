//! The plane panel at the debugger's cursor: a skewed-T test (section 5.4.1), drawn in the plane that both lines span,
//! or a region that grows in its slice (section 5.4.2).

use super::labels::{Obstacles, PointDensity};
use super::{PlanePanel, navigate, paint_hovered, point_mesh, secondary_text};
use crate::app::State;
use crate::gui::{PanelContext, skewed_t_test, widgets};
use crate::raster::HypothesisId;
use crate::trace::Replay;
use crate::view::{LegendEntry, Meaning, growing_plane, test_at_cursor, test_plane};
use egui::{Sense, Stroke, Ui, vec2};

/// What the points of a skewed-T test may be.
const TESTED: [Meaning; 3] = [Meaning::Taken, Meaning::Ignored, Meaning::Candidate];

/// What the points of a growing region may be.
const GROWING: [Meaning; 3] = [Meaning::Taken, Meaning::JustTaken, Meaning::Refused];

/// Identity of an instant: generation of the trace, number of steps taken, and id of the hypothesis shown.
pub type PlaneInstant = (u64, usize, HypothesisId);

/// The instant to show at the cursor; `None` when the step concerns no hypothesis.
pub fn plane_instant(state: &State) -> Option<PlaneInstant> {
    let replay = state.followed()?;
    let hypothesis = match test_at_cursor(replay) {
        Some(test) => test.hypothesis,
        None => state.debugger.focus().filter(|&focus| replay.hypothesis(focus).is_some())?,
    };
    Some((state.debugger.generation, replay.at(), hypothesis))
}

impl PlanePanel {
    /// Shows the plane of the hypothesis at the cursor.
    pub(super) fn show_instant(
        &mut self,
        ui: &mut Ui,
        cx: &mut PanelContext,
        replay: &Replay,
        plane_instant: PlaneInstant,
    ) {
        let state = cx.state;
        let Some(picture) = &state.picture else { return };
        self.update_instant(state, replay, plane_instant);
        let Some(plane) = &self.plane else {
            let text = "At the cursor there is no plane: a line is missing, or both have one direction.";
            return widgets::placeholder(ui, cx.palette, text);
        };
        let test = test_at_cursor(replay);
        if !cx.is_export {
            let meanings = if test.is_some() { TESTED } else { GROWING };
            egui::Frame::new()
                .inner_margin(egui::Margin::symmetric(6, 3))
                .show(ui, |ui| legend(ui, cx, meanings));
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 16.0 || rect.height() < 16.0 {
            return;
        }
        response.widget_info(|| {
            let what = if test.is_some() { "Skewed-T test" } else { "Growth" };
            let name = format!("{what} of hypothesis {}", plane_instant.2);
            egui::WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, name)
        });
        let moved = self.chart.filter(|_| self.is_moved);
        let chart = navigate(ui, &response, plane, moved, rect, &mut self.is_moved, true);
        self.chart = Some(chart);
        let painter = ui.painter_at(rect);
        let numbers = chart.axes(&painter, plane, rect, cx.palette);
        painter.add(egui::Shape::Mesh(point_mesh(&mut self.point_mesh, cx, plane, chart, rect)));
        let numbers = numbers.paint();
        if let Some(test) = test {
            // The part of the matte line on which a highlight may begin (section 5.4.1).
            let along = |percent: f64| (percent / 100.0 * test.matte_length) as f32;
            let upper =
                test.position_limits.map(|percent| chart.screen(plane.oblique(along(percent), 0.0), rect));
            painter.line_segment(upper, Stroke::new(5.0, cx.palette.accent.gamma_multiply(0.55)));
        }
        let checks = test.map(|test| {
            skewed_t_test::show(ui, cx.palette, cx.palette.panel, rect.left_top() + vec2(8.0, 4.0), test)
        });
        let amounts = paint_hovered(&painter, cx, plane, chart, picture, rect);
        let density = PointDensity::default();
        let points = self.point_mesh.as_ref().map_or(&density, |point_mesh| &point_mesh.density);
        let obstacles =
            Obstacles { points, taken: checks.into_iter().chain([amounts]).chain(numbers).collect() };
        chart.skewed_t(ui, &response, plane, rect, cx.palette, &obstacles);
        self.handle_pointer(cx, &response, chart, rect);
    }

    /// Computes the plane at the cursor, where the instant has changed.
    fn update_instant(&mut self, state: &State, replay: &Replay, plane_instant: PlaneInstant) {
        let Some(shown) = &state.newest else { return };
        if self.plane_instant == Some(plane_instant) {
            return;
        }
        let (region, working) = (state.debugger.names.region_of(plane_instant.2), &shown.analysis.working);
        let test = test_at_cursor(replay);
        self.plane = match test {
            Some(test) => test_plane(replay, test, region, working),
            None => growing_plane(replay, plane_instant.2, region, working),
        };
        // A chart that a person moved is kept while the same region grows.
        if test.is_some() || self.plane_instant.is_none_or(|(_, _, before)| before != plane_instant.2) {
            self.is_moved = false;
        }
        (self.plane_instant, self.point_mesh) = (Some(plane_instant), None);
    }
}

/// Shows the legend of the points' colors.
fn legend(ui: &mut Ui, cx: &PanelContext, meanings: [Meaning; 3]) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for meaning in meanings {
            let LegendEntry { name, color, tooltip } = meaning.legend(cx.state.focus_color());
            widgets::chip(ui, cx.palette, widgets::color(color), name).on_hover_text(tooltip);
            ui.label(secondary_text(cx, name)).on_hover_text(tooltip);
            ui.add_space(6.0);
        }
    });
}
