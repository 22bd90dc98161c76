//! The distances of the selected pixel's color from every hypothesis at the debugger's cursor, each with its limit.

use crate::gui::theme::SMALL_PT;
use crate::gui::{PanelContext, widgets};
use crate::view::AxisDistance;
use egui::{Align, Label, Layout, RichText, Ui, vec2};

/// Width of the column of the hypotheses' numbers, points.
const NUMBER_PT: f32 = 40.0;
/// Width of a distance and its limit, points.
const DISTANCE_PT: f32 = 74.0;
/// Height of a line, points.
const LINE_PT: f32 = 16.0;

/// Shows a line for each hypothesis; nothing where no pixel is selected or no decisions are recorded, or while the pinned result is shown,
/// whose hypotheses are others.
pub fn show(ui: &mut Ui, cx: &PanelContext) {
    if cx.state.shows_pinned() {
        return;
    }
    let Some(pixel) = cx.state.watched().and_then(|found| found.pixel) else { return };
    let palette = cx.palette;
    let text = if pixel.distances.is_empty() {
        "No hypothesis yet has a distance from this color."
    } else {
        "Distances from the hypotheses, counts"
    };
    let heading = ui.label(RichText::new(text).size(SMALL_PT).color(palette.secondary));
    heading.on_hover_text(
        "From each cylinder's axis against its radius (5.3.2), and from each slice's plane against half its thickness (5.4.2).",
    );
    if pixel.distances.is_empty() {
        return;
    }
    let quiet = |text: &str| RichText::new(text).size(SMALL_PT).color(palette.secondary);
    ui.spacing_mut().item_spacing = vec2(4.0, 1.0);
    ui.horizontal(|ui| {
        ui.add_space(NUMBER_PT + ui.spacing().item_spacing.x);
        for title in ["axis / radius", "plane / half"] {
            cell(ui, quiet(title));
        }
    });
    for distance in &pixel.distances {
        ui.horizontal(|ui| row(ui, cx, distance));
    }
    ui.add_space(4.0);
}

/// Shows the distances from one hypothesis. A distance within its limit has the color of text, another one the quiet color.
fn row(ui: &mut Ui, cx: &PanelContext, distance: &AxisDistance) {
    let (palette, hypothesis) = (cx.palette, distance.hypothesis);
    let color = widgets::color(cx.state.debugger.names.color(hypothesis));
    ui.allocate_ui_with_layout(vec2(NUMBER_PT, LINE_PT), Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_width(NUMBER_PT);
        widgets::chip(ui, palette, color, &format!("color of hypothesis {hypothesis}"));
        let number = ui.label(RichText::new(hypothesis.to_string()).size(SMALL_PT));
        number.on_hover_text(format!("hypothesis {hypothesis}, {:.0} counts along its axis", distance.along));
    });
    let is_inside = |[value, limit]: [f64; 2]| value <= limit;
    let with_limit = |pair: [f64; 2]| {
        let tone = if is_inside(pair) { palette.text } else { palette.secondary };
        RichText::new(format!("{:.1} / {:.1}", pair[0], pair[1])).size(SMALL_PT).color(tone)
    };
    cell(ui, with_limit(distance.axis));
    let none = RichText::new("\u{2013}").size(SMALL_PT).color(palette.secondary);
    cell(ui, distance.plane.map_or(none, with_limit));
    let words = match (is_inside(distance.axis), distance.plane.is_some_and(is_inside)) {
        (true, true) => "in both",
        (true, false) => "in cylinder",
        (false, true) => "in slice",
        (false, false) => "",
    };
    ui.label(RichText::new(words).size(SMALL_PT).color(palette.text));
}

/// Shows a value, aligned to the right.
fn cell(ui: &mut Ui, text: RichText) {
    ui.allocate_ui_with_layout(vec2(DISTANCE_PT, LINE_PT), Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_width(DISTANCE_PT);
        ui.add(Label::new(text).extend());
    });
}
