//! The parameters panel: sliders, switches, the given light and the analyzed area (section 7.3, table 6).

mod by_hand;
mod columns;
mod phoenix;

pub use by_hand::{toggle_ambient, toggle_light, toggle_second_lamp};

use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::{Edit, Gesture};
use crate::params::{Method, Parameter, ParameterSpec, Params, Reading, Setting, Switch};
use by_hand::given_by_hand;
use columns::{Cell, Columns, LABEL_PT, NARROW_PT, label};
use egui::{Align, Button, DragValue, Layout, RichText, ScrollArea, Sense, Slider, Ui};

/// Shows the panel.
pub fn show(ui: &mut Ui, cx: &mut PanelContext) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            method(ui, cx);
            for parameter in Parameter::ALL {
                row(ui, cx, parameter);
            }
            given_by_hand(ui, cx);
            match cx.state.document.params.method {
                Method::Refined | Method::Paper => switches(ui, cx),
                Method::Phoenix => phoenix::show(ui, cx),
                Method::TopDown | Method::ByHand => {}
            }
        });
    });
}

/// Shows the choice of the method and the button "Reset".
fn method(ui: &mut Ui, cx: &mut PanelContext) {
    let current = cx.state.document.params.method;
    let has_reset = ui.horizontal(|ui| {
        let tip =
            "The paper's algorithm, refined or as written in 1990 (section 5), or an earlier method that finds regions alone (sections 7.2 and 5.1).";
        if ui.available_width() >= NARROW_PT {
            label(ui, "method", tip);
        }
        methods(ui, cx, &[Method::Refined, Method::Paper]);
        let has_room = ui.available_width() >= RESET_PT;
        if has_room {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| reset(ui, cx, current));
        }
        has_room
    });
    if !has_reset.inner {
        reset(ui, cx, current);
    }
    ui.horizontal(|ui| {
        // Three buttons are nearly as narrow as their texts, so that they stay in one line.
        ui.spacing_mut().button_padding.x = 3.0;
        ui.spacing_mut().item_spacing.x = 2.0;
        if ui.available_width() >= NARROW_PT {
            label(
                ui,
                "or earlier",
                "Earlier methods, to compare the paper's with. The skewed T by hand is fitted to the marked area, the others find regions alone.",
            );
        }
        methods(ui, cx, &[Method::ByHand, Method::Phoenix, Method::TopDown]);
    });
    ui.add_space(4.0);
}

/// Shows the buttons of some methods.
fn methods(ui: &mut Ui, cx: &mut PanelContext, choices: &[Method]) {
    let current = cx.state.document.params.method;
    for &choice in choices {
        if ui.selectable_label(current == choice, choice.name()).on_hover_text(choice.meaning()).clicked() {
            cx.send(Edit::SetMethod(choice));
        }
    }
}

/// Width of the button "Reset" with its margin, points.
const RESET_PT: f32 = 50.0;

/// Shows the button "Reset".
fn reset(ui: &mut Ui, cx: &mut PanelContext, method: Method) {
    let defaults = Params::of(method);
    let button = ui.add_enabled(cx.state.document.params != defaults, Button::new("Reset").small());
    if button.on_hover_text("Every parameter and switch to this method's default.").clicked() {
        cx.send(Edit::SetParams(Box::new(defaults)));
    }
}

/// Shows a parameter: name, slider, field, unit and the button `auto`.
fn row(ui: &mut Ui, cx: &mut PanelContext, parameter: Parameter) {
    let spec = parameter.spec();
    let setting = cx.state.document.params.get(parameter);
    let used = cx.state.newest_run().map(|shown| shown.analysis.used.get(parameter));
    let gesture = Gesture::Parameter(parameter);
    // Dragging and typing start from the value in force.
    let mut value = setting.value().or(used).filter(|value| value.is_finite()).unwrap_or(spec.paper);
    let tip = tooltip(&spec);
    let columns = Columns::of(ui);
    ui.scope(|ui| {
        // The button `auto` is as narrow as its cell and stays in one line.
        ui.spacing_mut().button_padding.x = 4.0;
        let color = ui.visuals().text_color();
        let size = if columns.label.0.width() < LABEL_PT { SMALL_PT } else { super::theme::BODY_PT };
        let title = widgets::with_subscripts(spec.title, size, color);
        let name = egui::Label::new(title)
            .truncate()
            .show_tooltip_when_elided(false)
            .selectable(false)
            .sense(Sense::click());
        let name = columns.label.show(ui, name).on_hover_text(&tip);
        ui.spacing_mut().slider_width = columns.slider.0.width();
        let slider = slider(&spec, &mut value);
        // The slider has no tooltip, which would hide the rows below while a person drags.
        let slider = widgets::clickable(&columns.slider.show(ui, slider));
        slider.widget_info(|| egui::WidgetInfo::slider(true, value, spec.title));
        let before = value;
        let mut field = ui.put(columns.value.0, field(&spec, &mut value)).on_hover_text(&tip);
        if !slider.changed() {
            widgets::keep_unless_edited(&mut field, before, &mut value, |v| {
                format!("{v:.*}", decimals(&spec))
            });
        }
        field.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, spec.name));
        let unit = widgets::with_subscripts(spec.unit, SMALL_PT, cx.palette.secondary);
        if columns.unit.0.width() > 0.0 {
            columns.unit.show(ui, egui::Label::new(unit).truncate());
        }
        let automatic = setting == Setting::Auto;
        let auto = auto_button(ui, &columns.auto, &spec, automatic);
        if name.double_clicked() || slider.double_clicked() {
            let default = Params::of(cx.state.document.params.method).get(parameter);
            cx.send(Edit::SetParameter(parameter, default, None));
        } else if slider.changed() || field.changed() {
            let value = if spec.whole { value.round() } else { value };
            let value = value.clamp(spec.range[0], spec.range[1]);
            cx.send(Edit::SetParameter(parameter, Setting::Value(value), Some(gesture)));
        } else if auto.clicked() {
            let setting = if automatic { Setting::Value(value) } else { Setting::Auto };
            cx.send(Edit::SetParameter(parameter, setting, None));
        }
        in_photograph_pixels(ui, cx, parameter, value);
        let is_released = slider.drag_stopped() || slider.clicked() || slider.lost_focus();
        // A press on the slider takes the focus from the field, and begins a gesture.
        let is_left = field.drag_stopped() || field.lost_focus() && !slider.is_pointer_button_down_on();
        if is_released || is_left {
            cx.send(Edit::EndGesture(gesture));
        }
    });
}

/// The tooltip of a parameter's name and field.
fn tooltip(spec: &ParameterSpec) -> String {
    let in_paper = if spec.is_in_paper() {
        format!("Paper, table 6: {} {} ({}).", spec.paper, spec.unit, spec.section)
    } else {
        format!("The paper has no such parameter; {} {} is its way.", spec.paper, spec.unit)
    };
    format!("{}: {}.\n{in_paper} Double-click: back to the default.", spec.name, spec.meaning)
}

/// Shows what a parameter of working pixels is in pixels of the photograph, where the two differ.
fn in_photograph_pixels(ui: &mut Ui, cx: &PanelContext, parameter: Parameter, value: f64) {
    let side = cx.state.working_side_px();
    let Some(pixels) = photograph_pixels(parameter, value, side) else { return };
    let pixels = crate::describe::grouped(pixels as usize);
    let text = format!("of working pixels of {side} \u{d7} {side}; in the photograph {pixels} px");
    ui.add(egui::Label::new(RichText::new(text).size(SMALL_PT).color(cx.palette.secondary)).wrap());
}

/// A length or an area of working pixels in pixels of the photograph; none for other parameters, and where a working pixel is a
/// pixel of the photograph. `side` is the side of a working pixel, pixels of the photograph.
fn photograph_pixels(parameter: Parameter, value: f64, side: usize) -> Option<f64> {
    let side = side as f64;
    match parameter {
        _ if side <= 1.0 => None,
        Parameter::WindowSize => Some(value * side),
        Parameter::MinArea => Some(value * side * side),
        _ => None,
    }
}

/// The slider of a parameter, without the number.
fn slider<'a>(spec: &ParameterSpec, value: &'a mut f64) -> Slider<'a> {
    Slider::new(value, spec.slider.range[0]..=spec.slider.range[1])
        .show_value(false)
        .step_by(spec.slider.step)
        .logarithmic(spec.slider.logarithmic)
        .clamping(egui::SliderClamping::Never)
}

/// The field in which a parameter's value is typed.
fn field<'a>(spec: &ParameterSpec, value: &'a mut f64) -> DragValue<'a> {
    DragValue::new(value)
        .speed(spec.slider.step)
        .range(spec.range[0]..=spec.range[1])
        .clamp_existing_to_range(false)
        .fixed_decimals(decimals(spec))
}

/// The number of decimals that a parameter's field shows.
fn decimals(spec: &ParameterSpec) -> usize {
    usize::from(spec.slider.step < 1.0) * 2
}

/// Shows the button that sets a parameter to `auto`, or to the value that was used.
fn auto_button(ui: &mut Ui, cell: &Cell, spec: &ParameterSpec, automatic: bool) -> egui::Response {
    let auto = Button::selectable(automatic, RichText::new("auto").size(SMALL_PT));
    let auto = auto.wrap_mode(egui::TextWrapMode::Extend);
    let auto = ui.put(cell.0, auto);
    auto.widget_info(|| {
        let name = format!("{} auto", spec.title);
        egui::WidgetInfo::selected(egui::accesskit::Role::CheckBox, true, automatic, name)
    });
    auto.on_hover_text("Estimated from the image; the slider shows what was used.")
}

/// Shows the boxes of the switches: the readings of the paper's method, and the refinements of either method.
fn switches(ui: &mut Ui, cx: &mut PanelContext) {
    let params = cx.state.document.params;
    let header = |title: &str| {
        let title = RichText::new(title).size(SMALL_PT).color(cx.palette.secondary);
        egui::CollapsingHeader::new(title).default_open(true)
    };
    let words = |name: &str| name.replace('_', " ");
    let [readings, refinements] = [header("Readings"), header("Refinements")];
    if params.method == Method::Paper {
        readings.show(ui, |ui| {
            for reading in Reading::ALL {
                let mut on = params.paper.readings.get(reading);
                let spec = reading.spec();
                let tip = format!("{}\n{}", spec.title, spec.explanation());
                if ui.checkbox(&mut on, words(spec.name)).on_hover_text(tip).changed() {
                    cx.send(Edit::SetReading(reading, on));
                }
            }
        });
    }
    refinements.show(ui, |ui| {
        for switch in Switch::ALL {
            let mut on = params.refinements().get(switch);
            if ui.checkbox(&mut on, words(switch.name())).on_hover_text(switch.meaning()).changed() {
                cx.send(Edit::SetSwitch(switch, on));
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_areas_of_working_pixels_are_shown_in_pixels_of_the_photograph() {
        assert_eq!(photograph_pixels(Parameter::WindowSize, 10.0, 3), Some(30.0));
        assert_eq!(photograph_pixels(Parameter::MinArea, 500.0, 3), Some(4500.0));
        assert_eq!(photograph_pixels(Parameter::MinArea, 500.0, 1), None);
        assert_eq!(photograph_pixels(Parameter::CameraNoise, 2.0, 3), None);
    }
}
