//! Small widgets and formats that several panels share.

use super::theme::{SMALL_PT, ThemeColors};
use egui::{Align, Color32, Layout, Response, RichText, Sense, Ui, vec2};

/// A heading in the secondary color over a group of controls.
pub fn heading(ui: &mut Ui, palette: &ThemeColors, text: &str) -> Response {
    ui.add_space(6.0);
    ui.label(RichText::new(text).size(SMALL_PT).color(palette.secondary))
}

/// A square of 12 points filled with a color; `name` is its accessible name.
pub fn chip(ui: &mut Ui, color: Color32, name: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
    ui.painter().rect_filled(rect, 2.0, color);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Label, true, name));
    response
}

/// The response of a slider that senses clicks too; egui's sliders sense drags only.
pub fn clickable(slider: &Response) -> Response {
    let clicks = slider.interact(Sense::click());
    slider.union(clicks)
}

/// Takes back the change that egui makes when a field loses the focus: egui then writes the shown text, which is rounded, into
/// the value. `text` gives the text that the field shows for a value. Typed and dragged changes stay.
pub fn keep_unless_edited<N: Copy>(
    field: &mut Response,
    before: N,
    value: &mut N,
    text: impl Fn(N) -> String,
) {
    if field.lost_focus() && text(before) == text(*value) {
        *value = before;
        field.flags.remove(egui::response::Flags::CHANGED);
    }
}

/// A number, and its unit in the secondary color, right-aligned in `width` points.
pub fn number(ui: &mut Ui, palette: &ThemeColors, width: f32, value: &str, unit: &str) {
    ui.allocate_ui_with_layout(vec2(width, 18.0), Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.set_min_width(width);
        if !unit.is_empty() {
            ui.label(RichText::new(unit).color(palette.secondary));
        }
        ui.label(value);
    });
}

/// A sentence in the middle of a panel that has nothing to show.
pub fn placeholder(ui: &mut Ui, palette: &ThemeColors, text: &str) {
    ui.centered_and_justified(|ui| ui.label(RichText::new(text).color(palette.secondary)));
}

/// An opaque color from sRGB bytes.
pub fn color([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}

/// A whole number with thin spaces between groups of three digits.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 2);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push('\u{2009}');
        }
        text.push(digit);
    }
    text
}

/// The sRGB color of linear counts; 255 counts are full scale.
pub fn own_color(counts: [f32; 3]) -> Color32 {
    let [r, g, b] = counts.map(|v| egui::ecolor::gamma_u8_from_linear_f32((v / 255.0).clamp(0.0, 1.0)));
    Color32::from_rgb(r, g, b)
}
