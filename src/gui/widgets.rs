//! Small widgets and formats that several panels share.

use super::theme::{BODY_PT, SMALL_PT, ThemeColors, heading_font, subscript_font};
use crate::color::{ContrastCurve, srgb_from_linear};
use crate::view::FigureWords;
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Color32, FontId, Layout, Response, RichText, Sense, Ui, vec2};

/// A semibold heading over a group of controls.
pub fn heading(ui: &mut Ui, palette: &ThemeColors, text: &str) -> Response {
    ui.add_space(6.0);
    ui.label(RichText::new(text).font(heading_font(BODY_PT)).color(palette.text))
}

/// A text in which symbols of the paper have real subscripts: what follows an underscore in `m_b`, `m_s`, `C_b`, `C_s`, and the
/// 0 in σ0. The characters stay as they are, underscores included, for screen readers and copies.
pub fn with_subscripts(text: &str, size: f32, color: Color32) -> LayoutJob {
    let mut job = LayoutJob::default();
    for (part, is_subscript) in parts_with_subscripts(text) {
        let font_id = if is_subscript { subscript_font(size) } else { FontId::proportional(size) };
        job.append(part, 0.0, TextFormat { font_id, color, ..TextFormat::default() });
    }
    job
}

/// The parts of a text, and whether each is a subscript.
fn parts_with_subscripts(text: &str) -> Vec<(&str, bool)> {
    let mut parts = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let found =
            ["m_b", "m_s", "C_b", "C_s", "\u{3c3}0"].into_iter().filter_map(|symbol| rest.find(symbol)).min();
        let Some(at) = found else {
            parts.push((rest, false));
            break;
        };
        let letter = rest[at..].chars().next().map_or(0, char::len_utf8);
        let end = at + if rest[at + letter..].starts_with('_') { letter + 2 } else { letter + 1 };
        parts.extend([(&rest[..at + letter], false), (&rest[at + letter..end], true)]);
        rest = &rest[end..];
    }
    parts
}

/// Paints a color as a square with an outline, so that a white square is seen on a light panel and a black one on a dark panel.
pub fn paint_chip(painter: &egui::Painter, rect: egui::Rect, color: Color32, palette: &ThemeColors) {
    painter.rect(rect, 2.0, color, egui::Stroke::new(1.0, palette.secondary), egui::StrokeKind::Inside);
}

/// A number with `decimals` decimals and the sign of typographers; zero has no sign.
pub fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{:.decimals$}", value.abs());
    let is_zero = text.chars().all(|letter| matches!(letter, '0' | '.'));
    if value < 0.0 && !is_zero { format!("\u{2212}{text}") } else { text }
}

/// A sentence whose numbers do not part at the end of a line. egui breaks a line at every space but U+00A0, so also at the thin spaces of
/// [`crate::describe::grouped`].
pub fn unbroken(sentence: &str) -> String {
    sentence.replace('\u{2009}', "\u{a0}")
}

/// A word with a capital first letter.
pub fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Side of the square that shows a color, points.
pub const CHIP_PT: f32 = 12.0;
/// Gap between such a square and the color's name, points.
const CHIP_GAP_PT: f32 = 4.0;

/// A square filled with a color, with an outline; `name` is its accessible name.
pub fn chip(ui: &mut Ui, palette: &ThemeColors, color: Color32, name: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(egui::Vec2::splat(CHIP_PT), Sense::hover());
    paint_chip(ui.painter(), rect, color, palette);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Label, true, name));
    response
}

/// A color and its name as one widget, so that a wrapped row does not part them.
pub fn legend_entry(ui: &mut Ui, palette: &ThemeColors, color: Color32, name: &str) -> Response {
    let galley =
        ui.painter().layout_no_wrap(name.to_owned(), FontId::proportional(SMALL_PT), palette.secondary);
    let size = vec2(CHIP_PT + CHIP_GAP_PT + galley.size().x, galley.size().y.max(CHIP_PT));
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let center = rect.left_center() + vec2(CHIP_PT / 2.0, 0.0);
    let square = egui::Rect::from_center_size(center, egui::Vec2::splat(CHIP_PT));
    paint_chip(ui.painter(), square, color, palette);
    let corner = rect.left_center() + vec2(CHIP_PT + CHIP_GAP_PT, -galley.size().y / 2.0);
    ui.painter().galley(corner, galley, palette.secondary);
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

/// The name of a figure with its unit, which wraps at `width` points; the sentence that says what the figure measures is its tooltip.
pub fn figure_name(ui: &mut Ui, width: f32, figure: FigureWords) -> Response {
    let FigureWords { name, meaning, unit, .. } = figure;
    let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
    let wrapped = ui.vertical(|ui| {
        ui.set_max_width(width);
        ui.add(egui::Label::new(format!("{name}{unit}")).wrap()).on_hover_text(meaning)
    });
    wrapped.inner
}

/// Width of the names of a table whose `columns` columns of numbers stand in `room` points.
pub fn width_of_names(room: f32, columns: usize) -> f32 {
    (room - 64.0 * columns as f32).clamp(72.0, 220.0)
}

/// A sentence in the middle of a panel that has nothing to show.
pub fn placeholder(ui: &mut Ui, palette: &ThemeColors, text: &str) {
    placeholder_with_button(ui, palette, text, None);
}

/// A sentence in the middle of a panel that has nothing to show, over a button that changes that; returns whether the button
/// was clicked.
pub fn placeholder_with_button(ui: &mut Ui, palette: &ThemeColors, text: &str, button: Option<&str>) -> bool {
    ui.vertical_centered(|ui| {
        ui.add_space((0.5 * ui.available_height() - 24.0).max(8.0));
        ui.label(RichText::new(text).color(palette.secondary));
        button.is_some_and(|button| ui.button(button).clicked())
    })
    .inner
}

/// An opaque color from sRGB bytes.
pub fn color([r, g, b]: [u8; 3]) -> Color32 {
    Color32::from_rgb(r, g, b)
}

/// The sRGB color of linear counts, of which 255 are full scale, with the contrast curve of the camera where the photograph was read with one.
pub fn own_color(counts: [f32; 3], contrast: Option<ContrastCurve>) -> Color32 {
    let [r, g, b] = counts.map(|v| {
        let coded = f64::from(srgb_from_linear((v / 255.0).clamp(0.0, 1.0)));
        (255.0 * contrast.map_or(coded, |curve| curve.apply(coded))).round() as u8
    });
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_own_color_has_the_contrast_curve_of_the_photograph() {
        let counts = [20.0, 128.0, 255.0];
        let [plain, curved] = [None, Some(ContrastCurve::new(1.3))].map(|curve| own_color(counts, curve));
        assert_eq!(plain, Color32::from_rgb(79, 188, 255));
        assert!(curved.r() < plain.r() && curved.g() > plain.g() && curved.b() == 255, "{curved:?}");
    }

    #[test]
    fn numbers_have_a_sign_unless_they_are_shown_as_zero() {
        let shown = [1.26, -1.26, -0.04, 0.0].map(|value| signed(value, 1));
        assert_eq!(shown, ["1.3", "\u{2212}1.3", "0.0", "0.0"]);
    }

    #[test]
    fn subscripts_are_found_and_no_character_is_lost() {
        let parts = parts_with_subscripts("surface C_s, m_b at \u{d7}\u{3c3}0");
        let subscripts: Vec<&str> = parts.iter().filter(|part| part.1).map(|part| part.0).collect();
        assert_eq!(subscripts, ["_s", "_b", "0"]);
        for text in ["", "m_b", "\u{3c3}", "a \u{3c3}0 b m_s", "m_", "x_y"] {
            assert_eq!(with_subscripts(text, 13.0, Color32::WHITE).text, text);
        }
    }
}
