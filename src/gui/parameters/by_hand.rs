//! The values that a person gives by hand: the light, the ambient light and the analyzed area (sections 5.4 and 6).

use super::columns::{GAP_PT, NARROW_PT, ROW_PT, VALUE_PT, label};
use crate::app::{Edit, Gesture};
use crate::gui::theme::SMALL_PT;
use crate::gui::{PanelContext, widgets};
use crate::params::{AmbientSetting, IlluminantSetting};
use egui::{Align, Button, DragValue, Layout, RichText, Ui, vec2};

/// Shows the values that a person gives by hand: the light, the ambient light and the analyzed area.
pub fn given_by_hand(ui: &mut Ui, cx: &mut PanelContext) {
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
