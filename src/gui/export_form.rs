//! The form of an export: its kind, and the options of the kind.

use super::PanelContext;
use super::pane::Pane;
use crate::app::{ExportKind, ExportOptions};
use egui::{RichText, Ui};

/// Views that can be drawn at any size.
const VIEWS: [Pane; 3] = [Pane::Colors, Pane::Plane, Pane::Profile];

/// Width of the number and the name beside a slider, points.
const SLIDER_TEXT_PT: f32 = 200.0;

/// What is exported, and how.
pub struct ExportForm {
    /// The kind of the export.
    pub kind: ExportKind,
    /// The options of all kinds.
    pub options: ExportOptions,
    /// The view that is drawn, for a kind that draws one.
    pub view: Pane,
    /// Width and height of the drawn view, pixels.
    pub size_px: [u32; 2],
}

impl Default for ExportForm {
    fn default() -> Self {
        let (kind, options) = (ExportKind::Matte, ExportOptions::default());
        Self { kind, options, view: Pane::Colors, size_px: [1800, 1200] }
    }
}

impl ExportForm {
    /// Shows the kinds of export, and the options of the chosen kind. Returns whether another kind was chosen.
    pub fn show(&mut self, ui: &mut Ui, cx: &PanelContext) -> bool {
        let mut is_chosen = false;
        for kind in ExportKind::ALL.into_iter().filter(|kind| kind.is_offered()) {
            let of_region = kind == ExportKind::Selection && self.options.region.is_some();
            let available =
                (of_region || kind.is_available(cx.state)) && (kind != ExportKind::View || cx.gpu.is_some());
            let radio = ui.add_enabled(available, egui::RadioButton::new(self.kind == kind, kind.title()));
            if radio.on_hover_text(kind.tip()).on_disabled_hover_text(kind.tip()).clicked() {
                self.kind = kind;
                (self.options.layer, self.options.region) = (None, None);
                is_chosen = true;
            }
        }
        ui.add_space(4.0);
        self.show_options(ui, cx);
        ui.add_space(4.0);
        is_chosen
    }

    /// Shows the options of the chosen kind.
    fn show_options(&mut self, ui: &mut Ui, cx: &PanelContext) {
        match self.kind {
            ExportKind::Matte => self.surface_slider(ui),
            ExportKind::Result => {
                self.surface_slider(ui);
                ui.checkbox(&mut self.options.force, "replace the folder whatever it holds").on_hover_text(
                    "An earlier result is replaced anyway; this replaces any other folder too.",
                );
            }
            ExportKind::Layer => {
                let layer = self.options.layer.unwrap_or(cx.state.view.image.layer);
                let text = format!("{}: .png as shown, .exr or .npy with its numbers", layer.name());
                ui.label(RichText::new(text).color(cx.palette.secondary));
            }
            ExportKind::Selection => {
                let marked = || "the marked pixels".to_owned();
                let of = self
                    .options
                    .region
                    .map_or_else(marked, |region| format!("the pixels of region {region}"));
                let text = format!("{of}: .png as a mask, .csv as a table, .ply as points in the color cube");
                ui.label(RichText::new(text).color(cx.palette.secondary));
            }
            ExportKind::View => {
                ui.horizontal_wrapped(|ui| {
                    for pane in VIEWS {
                        ui.selectable_value(&mut self.view, pane, pane.title());
                    }
                    for (side, name) in self.size_px.iter_mut().zip(["width", "height"]) {
                        let field = ui.add(egui::DragValue::new(side).range(64..=8192).suffix(" px"));
                        field.widget_info(|| {
                            egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, name)
                        });
                    }
                });
            }
            _ => {}
        }
    }

    /// Shows the slider of the share of surface reflection that stays in the photograph without highlights.
    fn surface_slider(&mut self, ui: &mut Ui) {
        ui.spacing_mut().slider_width = (ui.available_width() - SLIDER_TEXT_PT).clamp(40.0, 200.0);
        let slider =
            egui::Slider::new(&mut self.options.keep_surface, 0.0..=1.0).text("surface reflection kept");
        ui.add(slider.custom_formatter(|v, _| format!("{:.0} %", v * 100.0)).custom_parser(|text| {
            text.trim_end_matches(['%', ' ']).parse::<f64>().ok().map(|percent| percent / 100.0)
        }))
        .on_hover_text("0 %: no highlights. 100 %: the photograph as it was, but for restored pixels.");
    }
}
