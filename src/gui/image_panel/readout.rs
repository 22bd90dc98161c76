//! The readout: values of one pixel in groups with fixed widths: place, color, region, amounts in the result, amounts measured.

use crate::app::State;
use crate::describe::reason_label;
use crate::gui::glossary::Term;
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets::{self, with_subscripts};
use crate::intrinsic::PixelKind;
use crate::view::{Amounts, Item, Layer, PixelReading, ResultSnapshot};
use egui::accesskit::Role;
use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Ui, WidgetInfo, pos2, vec2};
use std::sync::Arc;

/// Height of a line, points.
const LINE_PT: f32 = 18.0;
/// Distance between a name and its value, points.
const NAME_GAP_PT: f32 = 4.0;
/// Distance between two cells of a group, points.
const CELL_GAP_PT: f32 = 8.0;
/// Distance between two groups, points.
const GROUP_GAP_PT: f32 = 20.0;
/// Width of a swatch, points.
const SWATCH_PT: f32 = 10.0;

/// A cell: a name and space for a value.
struct Cell {
    /// The name before the value; empty for none.
    name: &'static str,
    /// The widest text of the value.
    widest: &'static str,
    /// Whether the value ends at the right end of its space, as numbers do.
    is_number: bool,
    tip: Tip,
}

/// The tooltip of a cell.
enum Tip {
    Text(&'static str),
    Card(Term),
}

/// A number's cell.
const fn number(name: &'static str, widest: &'static str, tip: Tip) -> Cell {
    Cell { name, widest, is_number: true, tip }
}

/// A word's cell.
const fn word(name: &'static str, widest: &'static str, tip: &'static str) -> Cell {
    Cell { name, widest, is_number: false, tip: Tip::Text(tip) }
}

/// The groups of cells. Values are lists of the same shape.
const GROUPS: [&[Cell]; 8] = [
    &[
        number("x", "8888", Tip::Text("Column, from 0 at the left")),
        number("y", "8888", Tip::Text("Row, from 0 at the top")),
    ],
    &[
        number("R", "888.8", Tip::Card(Term::Counts)),
        number("G", "888.8", Tip::Card(Term::Counts)),
        number("B", "888.8", Tip::Card(Term::Counts)),
    ],
    &[
        word("", "888", "Its region; at the debugger's cursor the hypothesis that holds it, by its number"),
        word("", "highlight", "What the pixel is to its region (section 6)"),
        word("", "volume", "Class of its window: the shape of the color cluster (section 5.2.1)"),
    ],
    &[
        word(
            "result",
            "",
            "The amounts in the result, after surface reflection below the noise was counted as none (section 6)",
        ),
        number("m_b", "888.8", Tip::Card(Term::BodyAmount)),
        number("m_s", "888.8", Tip::Card(Term::SurfaceAmount)),
        number("\u{3b5}", "\u{2212}88.8", Tip::Card(Term::Epsilon)),
    ],
    &[
        word(
            "measured",
            "",
            "The amounts of the color as measured, which the plane shows, where they differ from those of the result (section 6)",
        ),
        number("m_b", "888.8", Tip::Card(Term::BodyAmount)),
        number("m_s", "\u{2212}88.8", Tip::Card(Term::SurfaceAmount)),
    ],
    &[
        word("other", "", "The values of another program's label map and diffuse picture (menu File)"),
        number("label", "88888", Tip::Text("Label in the other program's map, 0 for none")),
        number("R", "888.8", Tip::Text("Diffuse picture of the other program, linear counts of red")),
        number("G", "888.8", Tip::Text("Diffuse picture of the other program, linear counts of green")),
        number("B", "888.8", Tip::Text("Diffuse picture of the other program, linear counts of blue")),
    ],
    &[word("lamp", "second", "The lamp that the pixel is split with (section 7.5)")],
    &[word("why", "clipped in all bands", "Why no skewed T explains the pixel (sections 5.6 and 7.5)")],
];
/// Index of the group of the amounts as measured, of the group of another program's values, of the group of the lamp, and of the
/// group of the reason.
const MEASURED: usize = 4;
const OTHER: usize = 5;
const LAMP: usize = 6;
const REASON: usize = 7;

/// Which groups have values beside those of every photograph.
#[derive(Clone, Copy)]
struct Extras {
    /// A picture of another program is open.
    other: bool,
    /// The result has two lamps.
    lamps: bool,
    /// A view shows why pixels are not explained.
    reasons: bool,
}

impl Extras {
    fn of(state: &State) -> Self {
        let has_lamps = |shown: &Arc<ResultSnapshot>| shown.analysis.finals.light.second.is_some();
        Self {
            other: state.elsewhere.is_some(),
            lamps: state.shown().is_some_and(has_lamps),
            reasons: state.view.image.shows(Layer::Reasons),
        }
    }
}

/// Texts of the cells, by group and cell; empty for no value.
type Values = [Vec<String>; GROUPS.len()];

/// Width of the strip below which measured amounts are left to the plane and to *Why*, points.
const NARROW_PT: f32 = 420.0;

/// The groups of a strip of this width, each with its upper left corner from the strip's upper left corner: groups that do not fit into a
/// line begin another, and a strip that `is_low` has one line.
fn shown_groups(ui: &Ui, width: f32, is_low: bool, extras: Extras) -> Vec<(usize, Pos2)> {
    let gap = if width < NARROW_PT { CELL_GAP_PT } else { GROUP_GAP_PT };
    let is_shown = |group: usize| match group {
        MEASURED => is_low || width >= NARROW_PT,
        OTHER => extras.other,
        LAMP => extras.lamps,
        REASON => extras.reasons,
        _ => true,
    };
    let mut at = Pos2::ZERO;
    let mut shown = Vec::new();
    for group in (0..GROUPS.len()).filter(|&group| is_shown(group)) {
        let group_pt = group_width(ui, GROUPS[group]);
        if at.x > 0.0 && at.x + group_pt > width {
            at = pos2(0.0, at.y + LINE_PT);
        }
        if is_low && at.y > 0.0 {
            break;
        }
        shown.push((group, at));
        at.x += group_pt + gap;
    }
    shown
}

/// Height of the strip, points. `is_low`: whether the strip has one line, as in a low panel.
pub fn height(ui: &Ui, state: &State, width: f32, is_low: bool) -> f32 {
    let groups = shown_groups(ui, width, is_low, Extras::of(state));
    groups.last().map_or(0.0, |(_, place)| place.y) + LINE_PT
}

/// Width of a group, points.
fn group_width(ui: &Ui, cells: &[Cell]) -> f32 {
    let widths = cells.iter().map(|cell| cell_width(ui, cell) + CELL_GAP_PT);
    widths.sum::<f32>() - CELL_GAP_PT + swatch_width(cells)
}

/// Width of the swatch before a group, with the gap after the swatch, points: color and region have swatches.
fn swatch_width(cells: &[Cell]) -> f32 {
    let has_swatch = cells.first().is_some_and(|cell| cell.name == "R" || cell.widest == "888");
    if has_swatch { SWATCH_PT + NAME_GAP_PT } else { 0.0 }
}

/// Width of a cell, points.
fn cell_width(ui: &Ui, cell: &Cell) -> f32 {
    let gap = if cell.name.is_empty() || cell.widest.is_empty() { 0.0 } else { NAME_GAP_PT };
    text_width(ui, cell.name) + gap + text_width(ui, cell.widest)
}

/// Width of a text, points.
fn text_width(ui: &Ui, text: &str) -> f32 {
    ui.painter().layout_job(with_subscripts(text, SMALL_PT, Color32::WHITE)).size().x
}

/// Shows the strip for the pixel that is hovered in any panel, otherwise for the pixel that was clicked last.
pub fn show(ui: &mut Ui, state: &State, palette: &ThemeColors, is_low: bool) {
    let full = ui.available_rect_before_wrap();
    let hovered = match state.hover {
        Some(Item::Pixel(pixel)) => Some(pixel),
        _ => None,
    };
    let pixel = hovered.or(state.explained_pixel());
    let readout = pixel.and_then(|pixel| state.reading_of(pixel));
    let values = readout.as_ref().map_or_else(Default::default, values_of);
    let strip = ui.interact(full, ui.scope_id().with("readout"), Sense::hover());
    strip.widget_info(|| WidgetInfo::labeled(Role::Label, true, sentence(&values)));
    let swatches = [
        None,
        readout.as_ref().map(|readout| widgets::own_color(readout.color, state.contrast())),
        readout.as_ref().and_then(|readout| readout.chip).map(widgets::color),
        None,
        None,
        None,
        None,
        None,
    ];
    if readout.is_none() {
        let text = "Point at a pixel to read its values.";
        let galley = ui.painter().layout(
            text.to_owned(),
            FontId::proportional(SMALL_PT),
            palette.secondary,
            full.width(),
        );
        ui.painter().galley(full.min + vec2(0.0, 2.0), galley, palette.secondary);
        return;
    }
    for (group, place) in shown_groups(ui, full.width(), is_low, Extras::of(state)) {
        // Measured amounts that are those of the result are not repeated.
        if group == MEASURED && values[MEASURED].is_empty() {
            continue;
        }
        let mut at = full.min + place.to_vec2();
        if swatch_width(GROUPS[group]) > 0.0 {
            let center = at + vec2(SWATCH_PT / 2.0, LINE_PT / 2.0);
            let square = Rect::from_center_size(center, vec2(SWATCH_PT, SWATCH_PT));
            if let Some(color) = swatches[group] {
                widgets::paint_chip(ui.painter(), square, color, palette);
            }
            at.x += SWATCH_PT + NAME_GAP_PT;
        }
        for (index, cell) in GROUPS[group].iter().enumerate() {
            let value = values[group].get(index).map_or("", String::as_str);
            let id = ui.scope_id().with(("readout", group, index));
            at.x = show_cell(ui, palette, at, cell, value, id) + CELL_GAP_PT;
        }
    }
}

/// Paints a cell with its upper left corner at `at`; returns the horizontal position of its right end.
fn show_cell(ui: &Ui, palette: &ThemeColors, at: Pos2, cell: &Cell, value: &str, id: egui::Id) -> f32 {
    let painter = ui.painter();
    let middle = at.y + LINE_PT / 2.0;
    let name = painter.layout_job(with_subscripts(cell.name, SMALL_PT, palette.secondary));
    painter.galley(pos2(at.x, middle - name.size().y / 2.0), name, palette.secondary);
    let right = at.x + cell_width(ui, cell);
    if !cell.widest.is_empty() {
        let (x, align) = if cell.is_number {
            (right, Align2::RIGHT_CENTER)
        } else {
            (right - text_width(ui, cell.widest), Align2::LEFT_CENTER)
        };
        let (text, tone) =
            if value.is_empty() { ("\u{2013}", palette.secondary) } else { (value, palette.text) };
        painter.text(pos2(x, middle), align, text, FontId::proportional(SMALL_PT), tone);
    }
    let area = Rect::from_min_max(at, pos2(right, at.y + LINE_PT));
    let response = ui.interact(area, id, Sense::hover());
    match cell.tip {
        Tip::Text(tip) => drop(response.on_hover_text(tip)),
        Tip::Card(term) => drop(term.card(response, palette)),
    }
    right
}

/// The values as a sentence for screen readers.
fn sentence(values: &Values) -> String {
    if values[0].is_empty() {
        return "No pixel".to_owned();
    }
    let groups = GROUPS.iter().zip(values).filter(|(_, values)| !values.is_empty());
    let texts = groups.flat_map(|(cells, values)| {
        let heading = cells.iter().filter(|cell| cell.widest.is_empty()).map(|cell| cell.name.to_owned());
        let named = cells.iter().zip(values).filter(|(_, value)| !value.is_empty());
        heading.chain(named.map(|(cell, value)| format!("{} {value}", cell.name))).collect::<Vec<_>>()
    });
    texts.collect::<Vec<_>>().join(", ")
}

/// The texts of the cells for a pixel.
fn values_of(reading: &PixelReading) -> Values {
    let counts = |value: f32| widgets::signed(f64::from(value), 1);
    let mut values = Values::default();
    values[0] = reading.at.map(|place| place.to_string()).to_vec();
    values[1] = reading.color.map(counts).to_vec();
    if let Some(other) = reading.elsewhere {
        let diffuse = other.diffuse.map_or_else(Default::default, |color| color.map(counts));
        let label = other.label.map_or_else(String::new, |label| label.to_string());
        values[OTHER] = [String::new(), label].into_iter().chain(diffuse).collect();
    }
    let Some(analyzed) = &reading.analyzed else { return values };
    // A pixel in no region has no kind.
    let is_in_region = analyzed.region.is_some() && analyzed.kind != PixelKind::Unassigned;
    values[2] = vec![
        analyzed.region.map_or_else(String::new, |region| region.to_string()),
        if is_in_region { analyzed.kind.name().to_owned() } else { String::new() },
        analyzed.class.map_or_else(String::new, |class| class.name().to_owned()),
    ];
    values[REASON].extend(analyzed.reason.map(|reason| reason_label(reason).to_owned()));
    values[LAMP].extend(analyzed.lamp.map(|lamp| lamp.name().to_owned()));
    let surface = |amounts: &Amounts| amounts.surface.map_or_else(String::new, counts);
    if let Some(amounts) = &analyzed.amounts {
        let result = &amounts.result;
        values[3] = vec![String::new(), counts(result.body), surface(result), counts(result.noise)];
        if let Some(measured) = amounts.different_measured() {
            values[MEASURED] = vec![String::new(), counts(measured.body), surface(&measured)];
        }
    }
    values
}
