//! The parameters panel: sliders, switches, the given light and the analyzed area (section 7.3, table 6).

mod phoenix;

use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::{Edit, Gesture};
use crate::params::{
    AmbientSetting, IlluminantSetting, Method, Parameter, ParameterSpec, Params, Reading, Setting, Switch,
};
use egui::{Align, Button, DragValue, Layout, RichText, ScrollArea, Sense, Slider, Ui, vec2};

/// Width of the labels' column, points.
const LABEL_PT: f32 = 108.0;
/// Width of the field of a value, points.
const VALUE_PT: f32 = 46.0;
/// Width of a value's unit, points.
const UNIT_PT: f32 = 38.0;
/// Width of the button `auto`, points.
const AUTO_PT: f32 = 38.0;
/// Height of a row, points.
const ROW_PT: f32 = 20.0;
/// Width below which a panel is narrow, points.
const NARROW_PT: f32 = 284.0;
/// Width below which a row has two lines, points.
const STACKED_PT: f32 = 260.0;
/// Width of the labels' column in a narrow panel, points.
const NARROW_LABEL_PT: f32 = 90.0;
/// Distance between two columns, points.
const GAP_PT: f32 = 4.0;

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
                Method::TopDown => {}
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
        if ui.available_width() >= NARROW_PT {
            label(
                ui,
                "held against",
                "What the paper is held against: earlier methods, which find regions alone.",
            );
        }
        methods(ui, cx, &[Method::Phoenix, Method::TopDown]);
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

/// Shows the label of a row.
fn label(ui: &mut Ui, text: &str, tip: &str) -> egui::Response {
    let size = vec2(LABEL_PT, ui.spacing().interact_size.y);
    let layout = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_width(LABEL_PT);
        ui.add(egui::Label::new(text).truncate().show_tooltip_when_elided(false))
    })
    .inner
    .on_hover_text(tip)
}

/// The cells of a row, the same in every row.
struct Columns {
    label: Cell,
    slider: Cell,
    value: Cell,
    unit: Cell,
    auto: Cell,
}

/// A cell of a row: its rectangle.
struct Cell(egui::Rect);

impl Cell {
    fn show(&self, ui: &mut Ui, widget: impl egui::Widget) -> egui::Response {
        let layout = Layout::left_to_right(Align::Center);
        let builder = egui::UiBuilder::new().max_rect(self.0).layout(layout);
        ui.scope_builder(builder, |ui| ui.add(widget)).inner
    }
}

impl Columns {
    fn of(ui: &mut Ui) -> Self {
        if ui.available_width() < STACKED_PT {
            return Self::stacked(ui);
        }
        let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW_PT), egui::Sense::hover());
        let mut left = row.left();
        // In a narrow panel only the tooltips show the units.
        let (label, unit) =
            if row.width() < NARROW_PT { (NARROW_LABEL_PT, 0.0) } else { (LABEL_PT, UNIT_PT) };
        let slider = (row.width() - label - VALUE_PT - unit - AUTO_PT - 4.0 * GAP_PT).max(20.0);
        let mut cell = |width: f32| {
            let rect = egui::Rect::from_min_size(egui::pos2(left, row.top()), vec2(width, row.height()));
            left += width + GAP_PT;
            Cell(rect)
        };
        Self {
            label: cell(label),
            slider: cell(slider),
            value: cell(VALUE_PT),
            unit: cell(unit),
            auto: cell(AUTO_PT),
        }
    }
}

impl Columns {
    /// The cells in two lines, for a panel in which one line leaves no room for the slider.
    fn stacked(ui: &mut Ui) -> Self {
        let size = vec2(ui.available_width(), 2.0 * ROW_PT);
        let (area, _) = ui.allocate_exact_size(size, egui::Sense::hover());
        let cell = |from: f32, to: f32, line: f32| {
            let top = area.top() + line * ROW_PT;
            let (left, right) = (area.left() + from, area.left() + to.max(from));
            Cell(egui::Rect::from_min_max(egui::pos2(left, top), egui::pos2(right, top + ROW_PT)))
        };
        let width = area.width();
        let auto = (width - AUTO_PT).max(0.0);
        let value = (auto - GAP_PT - VALUE_PT).max(0.0);
        Self {
            label: cell(0.0, value - GAP_PT, 0.0),
            slider: cell(0.0, width, 1.0),
            value: cell(value, value + VALUE_PT, 0.0),
            unit: cell(width, width, 0.0),
            auto: cell(auto, auto + AUTO_PT, 0.0),
        }
    }
}

/// Shows a parameter: name, slider, field, unit and the button `auto`.
fn row(ui: &mut Ui, cx: &mut PanelContext, parameter: Parameter) {
    let spec = parameter.spec();
    let setting = cx.state.document.params.get(parameter);
    let used = cx.state.newest.as_ref().map(|shown| shown.analysis.used.get(parameter));
    let gesture = Gesture::Parameter(parameter);
    // Dragging and typing start from the value in force.
    let mut value = setting.value().or(used).filter(|value| value.is_finite()).unwrap_or(spec.paper);
    let tip = format!(
        "{}: {}.\nPaper, table 6: {} {}. Double-click: back to the default. ({})",
        spec.name, spec.meaning, spec.paper, spec.unit, spec.section
    );
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
        if is_released || field.drag_stopped() || field.lost_focus() {
            cx.send(Edit::EndGesture);
        }
    });
}

/// Shows what a parameter of working pixels is in pixels of the photograph, where the two differ.
fn in_photograph_pixels(ui: &mut Ui, cx: &PanelContext, parameter: Parameter, value: f64) {
    let side = cx.state.newest.as_ref().map_or(1, |shown| shown.analysis.working.blocks.side());
    let Some(pixels) = photograph_pixels(parameter, value, side) else { return };
    let pixels = crate::view::grouped(pixels as usize);
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

/// Shows the values that a person gives by hand: the light, the ambient light and the analyzed area.
fn given_by_hand(ui: &mut Ui, cx: &mut PanelContext) {
    widgets::heading(ui, cx.palette, "By hand");
    illuminant(ui, cx);
    ambient(ui, cx);
    let (area, marked) = (&cx.state.document.area, &cx.state.document.selection.marked);
    let narrow = ui.available_width() < NARROW_PT;
    ui.horizontal(|ui| {
        label(ui, "area", "Only these pixels are analyzed; the others stay as they are.");
        match area {
            Some(area) => {
                let pixels = area.count();
                ui.label(format!("{} px", crate::view::grouped(pixels)));
            }
            // A narrow panel has room for the button only.
            None if narrow => {}
            None => {
                ui.label(RichText::new("whole picture").color(cx.palette.secondary));
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if area.is_some() {
                if ui.small_button("Lift").on_hover_text("Analyze the whole picture again.").clicked() {
                    cx.send(Edit::RestrictTo(None));
                }
            } else {
                let take = ui.add_enabled(marked.is_some(), Button::new("To marked").small());
                let tip = "Analyze only the marked pixels. Mark some with a tool of the image view.";
                if take.on_hover_text(tip).on_disabled_hover_text(tip).clicked() {
                    cx.send(Edit::RestrictTo(marked.clone()));
                }
            }
        });
    });
}

/// Shows the direction of the light: the direction found, or a given direction, to which every plane then turns.
fn illuminant(ui: &mut Ui, cx: &mut PanelContext) {
    let setting = cx.state.document.params.illuminant;
    let given = setting.direction();
    // The numbers as typed: the components of a unit vector would all change with each digit.
    let field = match setting {
        IlluminantSetting::Given(bands) if bands.iter().all(|&band| band <= 1.0) => Some(bands),
        _ => given,
    };
    let found =
        cx.state.newest.as_ref().and_then(|shown| shown.analysis.illuminant).map(|light| light.direction);
    let tip =
        "The color of the light. Found, or given: then every dichromatic plane turns to it (section 5.4).";
    let mut direction = field.or(found).unwrap_or([1.0, 1.0, 1.0].map(|v: f64| v / 3f64.sqrt()));
    let field = Bands { name: "illuminant", tip, most: 1.0, speed: 0.002, decimals: 3 };
    let [changed, released] = field.show(ui, &mut direction, |ui| {
        let pin = Button::selectable(given.is_some(), RichText::new("pin").size(SMALL_PT));
        let pin = ui.add_enabled(given.is_some() || found.is_some(), pin);
        pin.widget_info(|| {
            let role = egui::accesskit::Role::CheckBox;
            egui::WidgetInfo::selected(role, true, given.is_some(), "pin illuminant")
        });
        if pin.on_hover_text("Keep this light, or let it be found again.").clicked() {
            cx.send(Edit::PinIlluminant(if given.is_some() { None } else { found }, None));
        }
    });
    if changed {
        cx.send(Edit::PinIlluminant(Some(direction), Some(Gesture::Illuminant)));
    }
    if released {
        cx.send(Edit::EndGesture);
    }
}

/// Shows the ambient light: the counts that were found and subtracted, or given counts.
fn ambient(ui: &mut Ui, cx: &mut PanelContext) {
    let setting = cx.state.document.params.ambient;
    let found = cx.state.newest.as_ref().map(|shown| shown.analysis.intrinsic.ambient);
    let tip = "Light from everywhere, counts: where the matte lines meet. It is subtracted before the split and belongs to \
               the body reflection after it (section 7.5).";
    let mut counts = match setting {
        AmbientSetting::Given(counts) => counts,
        AmbientSetting::Off => [0.0; 3],
        AmbientSetting::Auto => found.and_then(|ambient| ambient.subtracted).unwrap_or_default(),
    };
    let field = Bands { name: "ambient", tip, most: 200.0, speed: 0.1, decimals: 1 };
    let [changed, released] = field.show(ui, &mut counts, |ui| {
        let auto = setting == AmbientSetting::Auto;
        let button = ui.add(Button::selectable(auto, RichText::new("auto").size(SMALL_PT)));
        button.widget_info(|| {
            egui::WidgetInfo::selected(egui::accesskit::Role::CheckBox, true, auto, "ambient automatic")
        });
        let why = found.map_or("", |ambient| ambient.verdict.reason());
        if button.on_hover_text(format!("Found in the picture, or off. {why}")).clicked() {
            let next = if auto { AmbientSetting::Off } else { AmbientSetting::Auto };
            cx.send(Edit::SetAmbient(next, None));
        }
    });
    if changed {
        cx.send(Edit::SetAmbient(AmbientSetting::Given(counts), Some(Gesture::Ambient)));
    }
    if released {
        cx.send(Edit::EndGesture);
    }
}

/// A row of three numbers, red, green and blue.
struct Bands {
    name: &'static str,
    tip: &'static str,
    most: f64,
    speed: f64,
    decimals: usize,
}

impl Bands {
    /// Shows the row with the widgets of `end` at the right; returns whether a number was changed, and whether a number was
    /// released.
    fn show(&self, ui: &mut Ui, values: &mut [f64; 3], end: impl FnOnce(&mut Ui)) -> [bool; 2] {
        let narrow = ui.available_width() < NARROW_PT;
        if narrow {
            label(ui, self.name, self.tip);
        }
        let (mut changed, mut released) = (false, false);
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP_PT;
            if !narrow {
                label(ui, self.name, self.tip);
            }
            for (value, band) in values.iter_mut().zip(["red", "green", "blue"]) {
                let before = *value;
                let field = DragValue::new(value)
                    .range(0.0..=self.most)
                    .clamp_existing_to_range(false)
                    .speed(self.speed)
                    .fixed_decimals(self.decimals);
                let mut field = ui.add_sized(vec2(VALUE_PT, ROW_PT), field);
                let text = |v: f64| format!("{v:.*}", self.decimals);
                widgets::keep_unless_edited(&mut field, before, value, text);
                field.widget_info(|| {
                    let name = format!("{} {band}", self.name);
                    egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, name)
                });
                let field = field.on_hover_text(self.tip);
                changed |= field.changed();
                released |= field.drag_stopped() || field.lost_focus();
            }
            ui.with_layout(Layout::right_to_left(Align::Center), end);
        });
        [changed, released]
    }
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
