//! Sliders and switches: what is asked of the analysis (section 7.3, table 6).

use super::theme::SMALL_PT;
use super::{Cx, widgets};
use crate::segment::{Method, Parameter, Params, Setting};
use crate::workbench::{Command, Gesture};
use egui::{Align, Button, DragValue, Layout, RichText, ScrollArea, Slider, Ui, vec2};

/// Width of the labels' column, points.
const LABEL_PT: f32 = 104.0;
/// Width of value and unit.
const VALUE_PT: f32 = 74.0;
/// Width of the `auto` button.
const AUTO_PT: f32 = 38.0;

/// Shows the panel.
pub fn show(ui: &mut Ui, cx: &mut Cx) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            method(ui, cx);
            for parameter in Parameter::ALL {
                row(ui, cx, parameter);
            }
            by_hand(ui, cx);
            switches(ui, cx);
        });
    });
}

fn method(ui: &mut Ui, cx: &mut Cx) {
    let now = cx.state.document.params.method;
    ui.horizontal(|ui| {
        label(
            ui,
            cx,
            "method",
            "Refined: the paper's algorithm with switches below. Paper: as written in 1990 (section 5).",
        );
        for (choice, name) in [(Method::Refined, "refined"), (Method::Paper, "paper")] {
            if ui.selectable_label(now == choice, name).clicked() {
                cx.send(Command::SetMethod(choice));
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let defaults = Params::of(now);
            let changed = cx.state.document.params != defaults;
            if ui
                .add_enabled(changed, Button::new("Reset").small())
                .on_hover_text("Every parameter and switch to this method's default.")
                .clicked()
            {
                cx.send(Command::SetParams(Box::new(defaults)));
            }
        });
    });
    ui.add_space(4.0);
}

fn label(ui: &mut Ui, cx: &Cx, text: &str, tip: &str) -> egui::Response {
    let size = vec2(LABEL_PT, ui.spacing().interact_size.y);
    let layout = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(LABEL_PT);
        ui.add(egui::Label::new(RichText::new(text).color(cx.tones.text)).truncate())
    })
    .inner
    .on_hover_text(tip)
}

/// What a slider needs beyond the parameter's own specification: the range of the hand, and the paper's section.
struct Feel {
    title: &'static str,
    range: std::ops::RangeInclusive<f64>,
    step: f64,
    logarithmic: bool,
    section: &'static str,
}

/// Typed values may leave the slider's range, as far as the parameter's own.
fn feel(parameter: Parameter) -> Feel {
    let of = |title, range, step, logarithmic, section| Feel { title, range, step, logarithmic, section };
    match parameter {
        Parameter::ClipThreshold => of("clip threshold", 100.0..=255.0, 1.0, false, "section 4"),
        Parameter::BloomDensity => of("noise density", 1.0..=9.0, 1.0, false, "section 4"),
        Parameter::CameraNoise => of("camera noise \u{3c3}0", 0.5..=12.0, 0.05, true, "section 5.2.1"),
        Parameter::MinIntensity => of("min. intensity", 0.0..=80.0, 1.0, false, "section 5.3"),
        Parameter::CylinderWidth => of("cylinder width", 1.0..=12.0, 0.1, false, "section 5.3"),
        Parameter::SliceWidth => of("slice width", 1.0..=12.0, 0.1, false, "section 5.4"),
        Parameter::WindowSize => of("window size", 4.0..=32.0, 1.0, false, "section 5.2.1"),
        Parameter::MinArea => of("min. area", 50.0..=10_000.0, 10.0, true, "section 5.3"),
    }
}

fn row(ui: &mut Ui, cx: &mut Cx, parameter: Parameter) {
    let (spec, feel) = (parameter.spec(), feel(parameter));
    let setting = cx.state.document.params.get(parameter);
    let used = cx.state.newest.as_ref().map(|shown| shown.analysis.used.get(parameter));
    let gesture = Gesture::Parameter(parameter);
    // What is typed or dragged starts from what is in force.
    let mut value = setting.value().or(used).filter(|value| value.is_finite()).unwrap_or(spec.paper);
    let tip = format!(
        "{}: {}.\nPaper, table 6: {} {}. Double-click: back to the default. ({})",
        spec.name, spec.meaning, spec.paper, spec.unit, feel.section
    );
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let name = label(ui, cx, feel.title, &tip);
        let rail = (ui.available_width() - VALUE_PT - AUTO_PT - 12.0).max(40.0);
        ui.spacing_mut().slider_width = rail;
        let slider = Slider::new(&mut value, feel.range.clone())
            .show_value(false)
            .step_by(feel.step)
            .logarithmic(feel.logarithmic)
            .clamping(egui::SliderClamping::Never)
            .text("");
        let slider = ui.add(slider).on_hover_text(&tip);
        slider.widget_info(|| egui::WidgetInfo::slider(ui.is_enabled(), value, feel.title));
        let decimals = usize::from(feel.step < 1.0) * 2;
        let typed = DragValue::new(&mut value)
            .speed(feel.step)
            .range(spec.range.0..=spec.range.1)
            .max_decimals(decimals)
            .min_decimals(decimals.min(1));
        let typed = ui.add_sized(vec2(44.0, 18.0), typed).on_hover_text(&tip);
        let unit = RichText::new(spec.unit).size(SMALL_PT).color(cx.tones.quiet);
        ui.add_sized(vec2(VALUE_PT - 44.0, 18.0), egui::Label::new(unit).truncate());
        let automatic = setting == Setting::Auto;
        let auto = ui.add_sized(
            vec2(AUTO_PT, 18.0),
            Button::selectable(automatic, RichText::new("auto").size(SMALL_PT)),
        );
        let auto = auto.on_hover_text("Estimated from the image; the slider shows what was used.");
        if name.double_clicked() || slider.double_clicked() {
            let default = Params::of(cx.state.document.params.method).get(parameter);
            cx.send(Command::SetParameter(parameter, default, None));
        } else if slider.changed() || typed.changed() {
            let value = if spec.whole { value.round() } else { value };
            let value = value.clamp(spec.range.0, spec.range.1);
            cx.send(Command::SetParameter(parameter, Setting::Value(value), Some(gesture)));
        } else if auto.clicked() {
            let setting = if automatic { Setting::Value(value) } else { Setting::Auto };
            cx.send(Command::SetParameter(parameter, setting, None));
        }
        if slider.drag_stopped() || typed.drag_stopped() || typed.lost_focus() || slider.lost_focus() {
            cx.send(Command::EndGesture);
        }
    });
}

/// The pinned illuminant and the outlined area.
fn by_hand(ui: &mut Ui, cx: &mut Cx) {
    widgets::heading(ui, cx.tones, "By hand");
    if let Some(area) = &cx.state.document.area {
        let pixels = area.as_slice().iter().filter(|&&inside| inside).count();
        ui.horizontal(|ui| {
            label(ui, cx, "area", "Only these pixels are analysed; the others stay as they are.");
            ui.label(format!("{pixels} px"));
            if ui.small_button("Whole picture").clicked() {
                cx.send(Command::RestrictTo(None));
            }
        });
    }
}

fn switches(ui: &mut Ui, cx: &mut Cx) {
    let mut params = cx.state.document.params;
    let refined = params.method == Method::Refined;
    let open = egui::CollapsingHeader::new(RichText::new("Refinements").size(SMALL_PT).color(cx.tones.quiet));
    open.default_open(true).show(ui, |ui| {
        ui.add_enabled_ui(refined, |ui| {
            for (name, switch) in params.refine.switches() {
                let mut on = *switch && refined;
                let words = name.replace('_', " ");
                if ui.checkbox(&mut on, words).on_hover_text(crate::segment::Refine::meaning(name)).changed()
                {
                    cx.send(Command::SetSwitch(name, on));
                }
            }
        });
    });
}
