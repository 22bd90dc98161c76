//! The readout: values of one pixel in a strip of cells with fixed positions.

use crate::app::State;
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::intrinsic::PixelKind;
use crate::raster::{HypothesisId, PixelIndex};
use crate::trace::{Class, Replay};
use crate::view::{Item, Picture, RegionNames, ResultSnapshot};
use egui::accesskit::Role;
use egui::{Align2, Color32, FontId, Rect, Sense, Ui, WidgetInfo, pos2, vec2};

/// Height of a line, points.
const LINE_PT: f32 = 18.0;
/// Distance between two cells, points.
const GAP_PT: f32 = 6.0;

/// A cell of the strip: a name and space for a value.
struct Cell {
    name: &'static str,
    tip: &'static str,
    /// Width of the value, points.
    width: f32,
}

/// A cell of the strip.
const fn cell(name: &'static str, width: f32, tip: &'static str) -> Cell {
    Cell { name, tip, width }
}

/// The cells of the strip, in the order of the values.
const CELLS: [Cell; 11] = [
    cell("x", 28.0, "Column, from 0 at the left"),
    cell("y", 28.0, "Row, from 0 at the top"),
    cell("R", 34.0, "Red of the photograph, linear counts"),
    cell("G", 34.0, "Green of the photograph, linear counts"),
    cell("B", 34.0, "Blue of the photograph, linear counts"),
    cell("", 38.0, "Class of its window: the shape of the color cluster (section 5.2.1)"),
    cell(
        "",
        26.0,
        "Its region; at the debugger's cursor the hypothesis that holds it, by its number of birth",
    ),
    cell(
        "m_b",
        40.0,
        "Amount of body reflection in the result, counts: surface reflection below the noise counts as none. The plane shows the amount measured (section 6)",
    ),
    cell(
        "m_s",
        40.0,
        "Amount of surface reflection in the result, counts: 0 where it is below the noise. The plane shows the amount measured (section 6)",
    ),
    cell("\u{3b5}", 32.0, "Distance from the dichromatic plane, counts (section 6)"),
    cell("", 50.0, "What the pixel is to its region (section 6)"),
];

/// Height of the strip, points.
pub fn height(ui: &Ui, width: f32) -> f32 {
    if needs_two_lines(ui, width) { 2.0 * LINE_PT } else { LINE_PT }
}

/// Whether the cells need two lines.
fn needs_two_lines(ui: &Ui, width: f32) -> bool {
    let cell_width = |cell: &Cell| cell.width + name_width(ui, cell.name) + GAP_PT;
    CELLS.iter().map(cell_width).sum::<f32>() - GAP_PT > width
}

/// Width of a cell's name with the space after the name, points.
fn name_width(ui: &Ui, name: &str) -> f32 {
    if name.is_empty() {
        return 0.0;
    }
    let font = FontId::proportional(SMALL_PT);
    ui.painter().layout_no_wrap(name.to_owned(), font, Color32::WHITE).size().x + 3.0
}

/// Shows the strip for the pixel that is hovered in any panel, otherwise for the selected pixel.
pub fn show(ui: &mut Ui, state: &State, palette: &ThemeColors) {
    let full = ui.available_rect_before_wrap();
    let pixel = [state.hover, state.document.selection.item].into_iter().find_map(|item| match item {
        Some(Item::Pixel(pixel)) => Some(pixel.index()),
        _ => None,
    });
    let readout = state.picture.as_ref().zip(pixel).and_then(|(picture, pixel)| match state.followed() {
        Some(replay) => PixelReadout::at_cursor(picture, replay, &state.debugger.names, pixel),
        None => PixelReadout::of(picture, state.shown().map(|shown| &**shown), pixel),
    });
    let values = readout.as_ref().map_or_else(Default::default, PixelReadout::values);
    let chip = readout.as_ref().and_then(|readout| readout.chip);
    let strip = ui.interact(full, ui.scope_id().with("readout"), Sense::hover());
    strip.widget_info(|| WidgetInfo::labeled(Role::Label, true, sentence(&values)));
    let lines: &[&[usize]] = if needs_two_lines(ui, full.width()) {
        &[&[0, 1, 2, 3, 4, 6], &[5, 7, 8, 9, 10]]
    } else {
        &[&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]]
    };
    for (line, cells) in lines.iter().enumerate() {
        let mut x = full.left();
        for &cell in *cells {
            let top = full.top() + line as f32 * LINE_PT;
            x = show_cell(ui, palette, pos2(x, top), cell, &values[cell], chip) + GAP_PT;
        }
    }
}

/// Paints a cell with its upper left corner at `at`; returns the horizontal position of its right end.
fn show_cell(
    ui: &Ui,
    palette: &ThemeColors,
    at: egui::Pos2,
    index: usize,
    value: &str,
    chip: Option<Color32>,
) -> f32 {
    let cell = &CELLS[index];
    let font = FontId::proportional(SMALL_PT);
    let painter = ui.painter();
    let middle = at.y + LINE_PT / 2.0;
    painter.text(pos2(at.x, middle), Align2::LEFT_CENTER, cell.name, font.clone(), palette.secondary);
    let left = at.x + name_width(ui, cell.name);
    let right = left + cell.width;
    if let Some(color) = chip.filter(|_| index == 6) {
        let square = Rect::from_center_size(pos2(left + 5.0, middle), vec2(9.0, 9.0));
        painter.rect_filled(square, 2.0, color);
    }
    let (x, align) = match index {
        5 | 10 => (left, Align2::LEFT_CENTER),
        _ => (right, Align2::RIGHT_CENTER),
    };
    let (text, tone) = if value.is_empty() { ("\u{2013}", palette.secondary) } else { (value, palette.text) };
    painter.text(pos2(x, middle), align, text, font, tone);
    let area = Rect::from_min_max(at, pos2(right, at.y + LINE_PT));
    ui.interact(area, ui.scope_id().with(("readout", index)), Sense::hover()).on_hover_text(cell.tip);
    right
}

/// The values as a sentence for screen readers.
fn sentence(values: &[String; 11]) -> String {
    if values[0].is_empty() {
        return "No pixel".to_owned();
    }
    let named = CELLS.iter().zip(values).filter(|(_, value)| !value.is_empty());
    named.map(|(cell, value)| format!("{} {value}", cell.name)).collect::<Vec<_>>().join(", ")
}

/// Values of a pixel.
struct PixelReadout {
    /// Column and row.
    at: [usize; 2],
    /// Linear counts of red, green and blue.
    color: [f32; 3],
    /// The values of the result; none before a result.
    analyzed: Option<AnalyzedPixel>,
    /// Color of the region or hypothesis.
    chip: Option<Color32>,
}

/// Values of a pixel in a result.
struct AnalyzedPixel {
    /// Class of the pixel's window.
    class: Option<Class>,
    /// Kind of the pixel: matte, highlight and so on.
    kind: PixelKind,
    /// Number of the region; at the debugger's cursor, of the hypothesis.
    region: Option<u16>,
    /// The amounts; none in no region.
    amounts: Option<Amounts>,
}

/// Amounts of body and surface reflection and noise of a pixel, counts (equation 13).
struct Amounts {
    body: f32,
    surface: Option<f32>,
    noise: f32,
}

impl PixelReadout {
    fn of(picture: &Picture, shown: Option<&ResultSnapshot>, pixel: usize) -> Option<Self> {
        let image = &picture.photo.image;
        let color = *image.pixels.as_slice().get(pixel)?;
        let at = [pixel % image.width(), pixel / image.width()];
        let analyzed = shown.map(|shown| AnalyzedPixel::of(shown, pixel, at));
        let chip =
            analyzed.as_ref().and_then(|analyzed| analyzed.region).zip(shown).and_then(|(region, shown)| {
                let color = shown.region_colors.get(usize::from(region).wrapping_sub(1))?;
                Some(crate::gui::widgets::color(*color))
            });
        Some(Self { at, color, analyzed, chip })
    }

    /// Values at the debugger's cursor; the region is a hypothesis id. `None` outside of the photograph.
    fn at_cursor(picture: &Picture, replay: &Replay, names: &RegionNames, pixel: usize) -> Option<Self> {
        let image = &picture.photo.image;
        let color = *image.pixels.as_slice().get(pixel)?;
        let working_pixel = replay.trace().working_pixel(PixelIndex::from_index(pixel)).index();
        let class = replay.first_grid().and_then(|grid| {
            let window = grid.window_of(working_pixel, replay.trace().width());
            grid.classes.as_slice().get(window).copied().flatten().flatten()
        });
        let hypothesis = HypothesisId::from_label(*replay.labels().as_slice().get(working_pixel)?);
        let region = hypothesis.map(HypothesisId::get);
        let analyzed = AnalyzedPixel { class, kind: replay.kind(working_pixel), region, amounts: None };
        let chip = hypothesis.map(|hypothesis| crate::gui::widgets::color(names.color(hypothesis)));
        let at = [pixel % image.width(), pixel / image.width()];
        Some(Self { at, color, analyzed: Some(analyzed), chip })
    }

    fn values(&self) -> [String; 11] {
        let counts = |value: f32| format!("{value:.1}");
        let mut values: [String; 11] = Default::default();
        (values[0], values[1]) = (self.at[0].to_string(), self.at[1].to_string());
        for (value, &band) in values[2..5].iter_mut().zip(&self.color) {
            *value = counts(band);
        }
        let Some(analyzed) = &self.analyzed else { return values };
        analyzed.class.map_or("", Class::name).clone_into(&mut values[5]);
        let Some(region) = analyzed.region else { return values };
        values[6] = region.to_string();
        if let Some(amounts) = &analyzed.amounts {
            values[7] = counts(amounts.body);
            values[8] = amounts.surface.map_or_else(String::new, counts);
            values[9] = format!("{:+.1}", amounts.noise);
        }
        // A pixel in no region has no kind.
        let kind = if analyzed.kind == PixelKind::Unassigned { "" } else { analyzed.kind.name() };
        kind.clone_into(&mut values[10]);
        values
    }
}

impl AnalyzedPixel {
    fn of(shown: &ResultSnapshot, pixel: usize, [x, y]: [usize; 2]) -> Self {
        let intrinsic = &shown.analysis.intrinsic;
        let label = shown.labels()[pixel];
        let reflection = intrinsic.regions.get(usize::from(label).wrapping_sub(1));
        // The component along a unit vector is the amount.
        let amount_along =
            |color: [f32; 3], vector: [f64; 3]| crate::color::dot(color, vector.map(|v| v as f32));
        Self {
            class: shown.classes().get(x / shown.window_px(), y / shown.window_px()).copied().flatten(),
            kind: intrinsic.kinds[pixel],
            region: reflection.map(|_| label),
            amounts: reflection.map(|region| Amounts {
                body: amount_along(intrinsic.body[pixel], region.body),
                surface: region.surface.map(|surface| amount_along(intrinsic.surface[pixel], surface)),
                noise: intrinsic.noise[pixel],
            }),
        }
    }
}
