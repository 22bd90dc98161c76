//! A skewed-T test at the debugger's cursor, in the plane of both lines: there a T is read best.

use super::{PlanePanel, cloud, hovered, kinds, navigate, quiet};
use crate::gui::{Cx, verdict, widgets};
use crate::trace::{CandidateTest, PixelKind, Replay};
use crate::workbench::test_plane;
use egui::{Sense, Stroke, Ui, vec2};

/// What the points are, and what that means.
const NAMES: [(PixelKind, &str, &str); 3] = [
    (
        PixelKind::Matte,
        "measured",
        "Pixels on the outside of the matte line: its length is measured by them (section 5.4.1).",
    ),
    (
        PixelKind::Lost,
        "ignored",
        "Pixels on its inside, where highlights grow: ignored for its length (section 5.4.1).",
    ),
    (
        PixelKind::Highlight,
        "candidate",
        "The neighbouring cluster that is tested as its highlight (section 5.4.1).",
    ),
];

impl PlanePanel {
    /// Shows the test.
    pub(super) fn show_test(&mut self, ui: &mut Ui, cx: &mut Cx, replay: &Replay, test: &CandidateTest) {
        let state = cx.state;
        let (Some(picture), Some(shown)) = (&state.picture, &state.newest) else { return };
        let at = (state.debugger.generation, replay.at());
        if self.test != Some(at) {
            let region = state.debugger.names.final_number(test.region);
            self.plane = test_plane(replay, test, region, picture, &shown.analysis.masks);
            (self.test, self.chart, self.cloud) = (Some(at), None, None);
        }
        let Some(plane) = &self.plane else {
            let text = "The candidate's line runs along the matte line: they span no plane.";
            return widgets::nothing(ui, cx.tones, text);
        };
        if !cx.bare {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 3)).show(ui, |ui| {
                ui.horizontal_wrapped(|ui| {
                    ui.spacing_mut().item_spacing.x = 4.0;
                    for (kind, name, tip) in NAMES {
                        widgets::chip(ui, kinds::colour(kind, state.view.theme), name).on_hover_text(tip);
                        ui.label(quiet(cx, name)).on_hover_text(tip);
                        ui.add_space(6.0);
                    }
                });
            });
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 16.0 || rect.height() < 16.0 {
            return;
        }
        response.widget_info(|| {
            let name = format!("Skewed-T test of hypothesis {}", test.region);
            egui::WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, name)
        });
        let chart = navigate(ui, &response, plane, self.chart, rect);
        self.chart = Some(chart);
        let painter = ui.painter_at(rect);
        chart.axes(&painter, plane, rect, cx.tones);
        painter.add(egui::Shape::Mesh(cloud(&mut self.cloud, cx, plane, chart, rect)));
        // The part of the matte line on which a highlight may begin.
        let along = |percent: f64| (percent / 100.0 * test.matte_length) as f32;
        let upper =
            test.position_limits.map(|percent| chart.screen(plane.oblique(along(percent), 0.0), rect));
        painter.line_segment(upper, Stroke::new(5.0, cx.tones.accent.gamma_multiply(0.55)));
        chart.skewed_t(ui, &response, plane, rect, cx.tones);
        verdict::show(ui, cx.tones, rect.left_top() + vec2(8.0, 4.0), test);
        hovered(&painter, cx, plane, chart, picture, rect);
        self.point(cx, &response, chart, rect);
    }
}
