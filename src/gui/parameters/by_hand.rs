//! The values that a person gives by hand: the light, a second lamp, the ambient light and the analyzed area (sections 5.4 and 6).

use super::columns::{GAP_PT, NARROW_PT, ROW_PT, VALUE_PT, label};
use crate::app::{Edit, Gesture};
use crate::describe::ambient_reason;
use crate::gui::theme::SMALL_PT;
use crate::gui::{PanelContext, widgets};
use crate::params::{AmbientSetting, IlluminantSetting, Method, Params};
use egui::{Align, Button, DragValue, Layout, RichText, Ui, vec2};

/// Shows the values that a person gives by hand: the light, a second lamp, the ambient light and the analyzed area.
pub fn given_by_hand(ui: &mut Ui, cx: &mut PanelContext) {
    widgets::heading(ui, cx.palette, "By hand");
    illuminant(ui, cx);
    if cx.state.document.params.method == Method::Refined {
        second_lamp(ui, cx);
    }
    ambient(ui, cx);
    let (area, marked) = (&cx.state.document.area, &cx.state.document.selection.marked);
    let narrow = ui.available_width() < NARROW_PT;
    ui.horizontal(|ui| {
        label(ui, "area", "Only these pixels are analyzed; the others stay as they are.");
        match area {
            Some(area) => {
                let pixels = area.count();
                ui.label(format!("{} px", crate::describe::grouped(pixels)));
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
    let found =
        cx.state.newest_run().and_then(|shown| shown.analysis.illuminant).map(|light| light.direction);
    let tip =
        "The color of the light. Found, or given: then every dichromatic plane turns to it (section 5.4).";
    let mut direction = typed_numbers(setting).or(found).unwrap_or(WHITE);
    let field =
        Bands { name: "illuminant", tip, range: [0.0, 1.0], speed: 0.002, decimals: 3, at_once: true };
    let edited = field.show(ui, &mut direction, |ui| {
        let pin = Button::selectable(given.is_some(), RichText::new("pin").size(SMALL_PT));
        let pin = ui.add_enabled(given.is_some() || found.is_some(), pin);
        pin.widget_info(|| {
            let role = egui::accesskit::Role::CheckBox;
            egui::WidgetInfo::selected(role, true, given.is_some(), "pin illuminant")
        });
        let tip =
            "Keep this light, and the second lamp where one was found; or let the light be found again.";
        if pin.on_hover_text(tip).clicked() {
            toggle_light(cx);
        }
    });
    if edited.changed {
        cx.send(Edit::PinIlluminant(Some(direction), Some(Gesture::Illuminant)));
    }
    if edited.released {
        cx.send(Edit::EndGesture(Gesture::Illuminant));
    }
}

/// A white light, unit.
const WHITE: [f64; 3] = [0.577_350_269_189_625_8; 3];
/// Least band of a second lamp that the fields accept.
const LEAST_BAND: f64 = 0.001;

/// The numbers of a given lamp as they were typed, where they are at most 1: the components of a unit vector would all change with each
/// digit. Otherwise the unit direction; none where no lamp is given.
fn typed_numbers(setting: IlluminantSetting) -> Option<[f64; 3]> {
    match setting {
        IlluminantSetting::Given(bands) if bands.iter().all(|&band| band <= 1.0) => Some(bands),
        _ => setting.direction(),
    }
}

/// Lets the light be found, where it is given; otherwise keeps the light that was found, and the second lamp with it.
pub fn toggle_light(cx: &mut PanelContext) {
    let given = cx.state.document.params.illuminant.direction();
    let found =
        cx.state.newest_run().and_then(|shown| shown.analysis.illuminant).map(|light| light.direction);
    pin_found_lamps(cx, if given.is_some() { None } else { found });
}

/// Lets a second lamp be sought, where one is given; otherwise keeps the second lamp that was found.
pub fn toggle_second_lamp(cx: &mut PanelContext) {
    let given = cx.state.document.params.second_illuminant.direction();
    let found = found_second_lamp(cx);
    cx.send(Edit::PinSecondIlluminant(if given.is_some() { None } else { found }, None));
}

/// Lets the ambient light be found, or takes none where it is found.
pub fn toggle_ambient(cx: &mut PanelContext) {
    let is_auto = cx.state.document.params.ambient == AmbientSetting::Auto;
    cx.send(Edit::SetAmbient(if is_auto { AmbientSetting::Off } else { AmbientSetting::Auto }, None));
}

/// Gives the light `direction`, or lets it be found; with a given light the second lamp that was found is given too, in one step of
/// the history: beside a given light no second lamp is sought.
fn pin_found_lamps(cx: &mut PanelContext, direction: Option<[f64; 3]>) {
    cx.send(Edit::PinIlluminant(direction, Some(Gesture::Illuminant)));
    let second = found_second_lamp(cx).filter(|_| direction.is_some());
    if cx.state.document.params.second_illuminant == IlluminantSetting::Auto && second.is_some() {
        cx.send(Edit::PinSecondIlluminant(second, Some(Gesture::Illuminant)));
    }
    cx.send(Edit::EndGesture(Gesture::Illuminant));
}

/// The second lamp of the newest run, unit.
fn found_second_lamp(cx: &PanelContext) -> Option<[f64; 3]> {
    cx.state.newest_run().and_then(|shown| shown.analysis.finals.light.second).map(|second| second.direction)
}

/// Shows the color of the second lamp: found, or given. Without either the numbers are those of the first light, in the secondary color,
/// and wait for a color to be typed.
fn second_lamp(ui: &mut Ui, cx: &mut PanelContext) {
    let params = cx.state.document.params;
    let (setting, found) = (params.second_illuminant, found_second_lamp(cx));
    let given = setting.direction();
    let first = cx.state.newest_run().and_then(|shown| shown.analysis.illuminant);
    let known = typed_numbers(setting).or(found);
    let tip = if known.is_some() {
        "The color of a second lamp (section 7.5, second_illuminant). Found, or given: then each region is split with the lamp that its \
         highlights agree with."
    } else {
        "No second lamp was found (section 7.5). Type its color (second_illuminant), or draw a white patch in its light with Shift."
    };
    let mut direction = known.or(first.map(|light| light.direction)).unwrap_or(WHITE);
    let range = [LEAST_BAND, 1.0];
    let field = Bands { name: "second lamp", tip, range, speed: 0.002, decimals: 3, at_once: false };
    let edited = ui
        .scope(|ui| {
            if known.is_none() {
                ui.visuals_mut().override_text_color = Some(cx.palette.secondary);
            }
            field.show(ui, &mut direction, |ui| {
                let pin = Button::selectable(given.is_some(), RichText::new("pin").size(SMALL_PT));
                let pin = ui.add_enabled(given.is_some() || found.is_some(), pin);
                pin.widget_info(|| {
                    let role = egui::accesskit::Role::CheckBox;
                    egui::WidgetInfo::selected(role, true, given.is_some(), "pin second lamp")
                });
                if pin.on_hover_text("Keep this lamp, or let a second lamp be sought again.").clicked() {
                    toggle_second_lamp(cx);
                }
            })
        })
        .inner;
    let next = Params { second_illuminant: IlluminantSetting::Given(direction), ..params };
    // A drag goes through colors that are not accepted, such as that of the first light, and is not stopped there by errors.
    if edited.changed && (!edited.dragged || next.validate().is_ok()) {
        cx.send(Edit::PinSecondIlluminant(Some(direction), Some(Gesture::SecondIlluminant)));
    }
    if edited.released {
        cx.send(Edit::EndGesture(Gesture::SecondIlluminant));
    }
}

/// Shows the ambient light: the counts that were found and subtracted, or given counts.
fn ambient(ui: &mut Ui, cx: &mut PanelContext) {
    let setting = cx.state.document.params.ambient;
    let found = cx.state.newest_run().map(|shown| shown.analysis.intrinsic.ambient);
    let tip = "Light from everywhere, counts: where the matte lines meet. It is subtracted before the split and belongs to \
               the body reflection after it (section 7.5).";
    let mut counts = match setting {
        AmbientSetting::Given(counts) => counts,
        AmbientSetting::Off => [0.0; 3],
        AmbientSetting::Auto => found.and_then(|ambient| ambient.subtracted).unwrap_or_default(),
    };
    let field = Bands { name: "ambient", tip, range: [0.0, 200.0], speed: 0.1, decimals: 1, at_once: true };
    let edited = field.show(ui, &mut counts, |ui| {
        let auto = setting == AmbientSetting::Auto;
        let button = ui.add(Button::selectable(auto, RichText::new("auto").size(SMALL_PT)));
        button.widget_info(|| {
            egui::WidgetInfo::selected(egui::accesskit::Role::CheckBox, true, auto, "ambient automatic")
        });
        let why = found.map_or("", |ambient| ambient_reason(ambient.verdict));
        if button.on_hover_text(format!("Found in the picture, or off. {why}")).clicked() {
            toggle_ambient(cx);
        }
    });
    if edited.changed {
        cx.send(Edit::SetAmbient(AmbientSetting::Given(counts), Some(Gesture::Ambient)));
    }
    if edited.released {
        cx.send(Edit::EndGesture(Gesture::Ambient));
    }
}

/// A row of three numbers, red, green and blue.
struct Bands {
    name: &'static str,
    tip: &'static str,
    /// Least and largest number.
    range: [f64; 2],
    /// Change of a number per point that a drag moves.
    speed: f64,
    decimals: usize,
    /// Whether each typed digit changes the number, and not only the end of typing.
    at_once: bool,
}

/// What a person does with a row of three numbers.
#[derive(Default)]
struct Edited {
    /// A number was changed.
    changed: bool,
    /// A number was released.
    released: bool,
    /// A number is being dragged.
    dragged: bool,
}

impl Bands {
    /// Shows the row with the widgets of `end` at the right; returns what is done with the numbers.
    fn show(&self, ui: &mut Ui, values: &mut [f64; 3], end: impl FnOnce(&mut Ui)) -> Edited {
        let narrow = ui.available_width() < NARROW_PT;
        if narrow {
            label(ui, self.name, self.tip);
        }
        let mut edited = Edited::default();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP_PT;
            if !narrow {
                label(ui, self.name, self.tip);
            }
            for (value, band) in values.iter_mut().zip(["red", "green", "blue"]) {
                let before = *value;
                let field = DragValue::new(value)
                    .range(self.range[0]..=self.range[1])
                    .clamp_existing_to_range(false)
                    .speed(self.speed)
                    .update_while_editing(self.at_once)
                    .fixed_decimals(self.decimals);
                let mut field = ui.add_sized(vec2(VALUE_PT, ROW_PT), field);
                let text = |v: f64| format!("{v:.*}", self.decimals);
                widgets::keep_unless_edited(&mut field, before, value, text);
                field.widget_info(|| {
                    let name = format!("{} {band}", self.name);
                    egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, name)
                });
                let field = field.on_hover_text(self.tip);
                edited.changed |= field.changed();
                edited.released |= field.drag_stopped() || field.lost_focus();
                edited.dragged |= field.dragged();
            }
            ui.with_layout(Layout::right_to_left(Align::Center), end);
        });
        edited
    }
}
