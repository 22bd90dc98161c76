//! The regions panel: a table of the regions, and a row about the light.

mod hypothesis_table;
mod light_summary;
mod table_columns;

use super::theme::{SMALL_PT, ThemeColors};
use super::{PanelContext, context_menu, lacking_result, popup_scroll, widgets};
use crate::app::Edit;
use crate::describe::grouped_sentences;
use crate::intrinsic::{HighlightBranch, RegionReflection};
use crate::view::{Item, ResultSnapshot};
use egui::accesskit::Role;
use egui::{Align, Button, Color32, Label, Layout, RichText, Sense, Ui, WidgetInfo};
use egui_extras::{TableBuilder, TableRow};
use table_columns::{TableColumn, count_width, fitting, widest, with_columns};

/// Height of a row, points.
const ROW_PT: f32 = 18.0;

/// The column that the rows are sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum SortKey {
    #[default]
    Id,
    Pixels,
    Body,
    Surface,
    Angle,
    Highlight,
    Rms,
    Warnings,
}

/// A column: key, title, width in points, tooltip.
const COLUMNS: [(SortKey, &str, f32, &str); 8] = [
    (SortKey::Id, "#", 40.0, "The region's number; its color is that of the Regions layer."),
    (SortKey::Pixels, "pixels", 52.0, "All its pixels, restored ones included."),
    (
        SortKey::Body,
        "body C_b",
        96.0,
        "Body reflection vector: unit direction of the matte line through black, red green blue (section 3.1, 6).",
    ),
    (
        SortKey::Surface,
        "surface C_s",
        96.0,
        "Surface reflection vector: unit direction of the highlight line, the color of the light (section 3.1, 6).",
    ),
    (
        SortKey::Angle,
        "angle",
        48.0,
        "Between body and surface vector: the smaller it is, the harder they are to tell apart (section 7.5).",
    ),
    (
        SortKey::Highlight,
        "highlight",
        58.0,
        "Pixels nearer to the highlight line than to the matte line, clipped and bloomed ones included (section 6).",
    ),
    (
        SortKey::Rms,
        "rms",
        44.0,
        "Root mean square distance of its undistorted pixels from its dichromatic plane, counts (section 6).",
    ),
    (SortKey::Warnings, "notes", 150.0, "What to beware of in this region."),
];

/// The columns that a narrow panel leaves out, the first one first: the surface vectors are all alike.
const DISPENSABLE: [SortKey; 5] =
    [SortKey::Surface, SortKey::Highlight, SortKey::Angle, SortKey::Rms, SortKey::Body];

/// Width of a column that shows a vector by its color alone, points.
const CHIP_COLUMN_PT: f32 = 24.0;

/// Width of a color and the gap to the number after it, points.
const CHIP_PT: f32 = 18.0;

/// Least width of the column of the regions' numbers, whose heading has an arrow, points.
const LEAST_NUMBER_PT: f32 = 26.0;

/// Width of the heading of the highlight pixels with an arrow, points.
const HIGHLIGHT_TITLE_PT: f32 = 70.0;

/// Least width of the notes in a narrow panel, points: the notes are cut with dots, and whole in the tooltip.
const NARROW_NOTES_PT: f32 = 40.0;

/// Whether a column holds vectors.
const fn is_vector(key: SortKey) -> bool {
    matches!(key, SortKey::Body | SortKey::Surface)
}

/// Width of the panel from which a column of vectors shows numbers, points: the surface vectors, which are all alike, lose their
/// numbers first.
const fn width_with_numbers_of(key: SortKey) -> f32 {
    if matches!(key, SortKey::Surface) { 690.0 } else { 520.0 }
}

/// The regions panel.
#[derive(Default)]
pub struct RegionsPanel {
    key: SortKey,
    descending: bool,
    /// Sorting of the table of hypotheses at the debugger's cursor.
    hypothesis_table: hypothesis_table::HypothesisTable,
}

impl RegionsPanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let Some(shown) = cx.state.shown().cloned() else {
            let text = match cx.state.preview {
                Some(_) => "The picture shows a preview. Regions appear when the analysis is finished.",
                None => "Regions appear when a photograph has been analyzed.",
            };
            return lacking_result::placeholder(ui, cx, text);
        };
        let state = cx.state;
        egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 4)).show(ui, |ui| {
            if let Some(replay) = state.followed() {
                return self.hypothesis_table.show(ui, cx, replay);
            }
            light_summary::show(ui, cx, &shown);
            if shown.analysis.intrinsic.regions.is_empty() {
                // The verdict under the picture says why.
                return widgets::placeholder(ui, cx.palette, "No region was found.");
            }
            // A scrolled area keeps the width of wider contents, which a panel that got narrower has no room for.
            let width = ui.available_width();
            egui::ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
                ui.set_max_width(width);
                self.table(ui, cx, &shown);
            });
        });
    }

    /// Shows the table of the regions. Where the panel is narrow, vectors are shown by their colors alone, and columns are left out, so
    /// that the others have room.
    fn table(&mut self, ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot) {
        let ui_width = ui.available_width();
        let gap_pt = if ui_width < width_with_numbers_of(SortKey::Body) { 4.0 } else { 6.0 };
        ui.spacing_mut().item_spacing = egui::vec2(gap_pt, 1.0);
        let selected = cx.state.selected_region();
        let regions = &shown.analysis.intrinsic.regions;
        let order = self.order(regions);
        let mut hovered = None;
        let columns = fitting(column_widths(ui, regions), &DISPENSABLE, gap_pt, ui_width);
        let shows_numbers = |key: SortKey| ui_width >= width_with_numbers_of(key);
        // The cells take no keyboard focus: each would be a stop of Tab. The keys [ and ] select regions.
        let mut table = TableBuilder::new(ui).striped(false).sense(Sense::CLICK).resizable(false);
        table = with_columns(table, &columns);
        if let Some(row) = selected.and_then(|id| order.iter().position(|&index| index == id.index())) {
            table = table.scroll_to_row(row, None);
        }
        table
            .header(ROW_PT, |mut header| {
                for (key, title, _, tip) in COLUMNS {
                    if !columns.iter().any(|(column, _)| *column == key) {
                        continue;
                    }
                    // Of "body C_b", a narrow column shows the symbol.
                    let symbol = title.rsplit(' ').next().unwrap_or(title);
                    let shown_title = if is_vector(key) && !shows_numbers(key) { symbol } else { title };
                    header.col(|ui| self.heading(ui, cx.palette, key, shown_title, tip));
                }
            })
            .body(|body| {
                body.rows(ROW_PT, order.len(), |mut row| {
                    let region = &regions[order[row.index()]];
                    row.set_selected(selected == Some(region.id));
                    for &(key, _) in &columns {
                        table_cell(&mut row, cx.palette, key, region, shown, shows_numbers(key));
                    }
                    let response = row.response();
                    if response.hovered() {
                        hovered = Some(Item::Region(region.id));
                    }
                    popup_scroll::context_menu(&response, |ui| context_menu::of_region(ui, cx, region.id));
                    if response.clicked() {
                        let chosen = (selected != Some(region.id)).then_some(Item::Region(region.id));
                        cx.send(Edit::Select(chosen));
                    }
                });
            });
        if let Some(item) = hovered {
            cx.hover(item);
        }
    }

    /// Shows the title of a column, which sorts the rows by the column.
    fn heading(&mut self, ui: &mut Ui, palette: &ThemeColors, key: SortKey, title: &str, tip: &str) {
        let chosen = self.key == key;
        ui.with_layout(layout_of(key), |ui| {
            if sorted_by(ui, palette, chosen.then_some(self.descending), title, tip) {
                // The first click sorts numbers in descending order and ids in ascending order.
                self.descending = if chosen { !self.descending } else { !matches!(key, SortKey::Id) };
                self.key = key;
            }
        });
    }

    /// Indices of the regions in the order of the rows.
    fn order(&self, regions: &[RegionReflection]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..regions.len()).collect();
        let value = |region: &RegionReflection| match self.key {
            SortKey::Id => f64::from(region.id.get()),
            SortKey::Pixels => region.pixels as f64,
            SortKey::Body => hue_rad(region.body),
            SortKey::Surface => region.surface.map_or(-10.0, hue_rad),
            SortKey::Angle => region.angle_deg.unwrap_or(-1.0),
            SortKey::Highlight => region.highlights().unwrap_or(0) as f64,
            SortKey::Rms => region.fit_rms_counts,
            SortKey::Warnings => region.warnings.len() as f64,
        };
        order.sort_by(|&a, &b| {
            let by_value = value(&regions[a]).total_cmp(&value(&regions[b]));
            if self.descending { by_value.reverse() } else { by_value }.then(a.cmp(&b))
        });
        order
    }
}

/// The least widths of the columns in a panel of this width. Numbers are never cut.
fn column_widths(ui: &Ui, regions: &[RegionReflection]) -> Vec<TableColumn<SortKey>> {
    let shows_numbers = |key: SortKey| ui.available_width() >= width_with_numbers_of(key);
    let width_of = |(key, _, width, _): (SortKey, &str, f32, &str)| {
        let width = match key {
            SortKey::Id => number_width(ui, regions.iter().map(|region| region.id.to_string())),
            SortKey::Body | SortKey::Surface if !shows_numbers(key) => CHIP_COLUMN_PT,
            SortKey::Pixels => width.max(count_width(ui, regions.iter().map(|region| region.pixels))),
            SortKey::Highlight => {
                let title_pt = if shows_numbers(SortKey::Body) { HIGHLIGHT_TITLE_PT } else { width };
                title_pt.max(count_width(ui, regions.iter().filter_map(RegionReflection::highlights)))
            }
            SortKey::Warnings if !shows_numbers(SortKey::Body) => NARROW_NOTES_PT,
            SortKey::Warnings if !shows_numbers(SortKey::Surface) => 110.0,
            _ => width,
        };
        (key, width)
    };
    COLUMNS.map(width_of).to_vec()
}

/// Width of a column of colors with numbers, points.
fn number_width(ui: &Ui, numbers: impl Iterator<Item = String>) -> f32 {
    (CHIP_PT + widest(ui, numbers)).max(LEAST_NUMBER_PT)
}

/// Hue of a color, radians: the angle around the gray diagonal, by which colors are sorted.
fn hue_rad([r, g, b]: [f64; 3]) -> f64 {
    (3f64.sqrt() * (g - b)).atan2(2.0 * r - g - b)
}

/// Numbers are aligned to the right, other values to the left.
fn layout_of(key: SortKey) -> Layout {
    match key {
        SortKey::Id | SortKey::Body | SortKey::Surface | SortKey::Warnings => {
            Layout::left_to_right(Align::Center)
        }
        _ => Layout::right_to_left(Align::Center),
    }
}

/// Shows a cell of a row. `shows_numbers`: whether a vector is shown with its numbers.
fn table_cell(
    row: &mut TableRow,
    palette: &ThemeColors,
    key: SortKey,
    region: &RegionReflection,
    shown: &ResultSnapshot,
    shows_numbers: bool,
) {
    let dash = || RichText::new("\u{2013}").color(palette.secondary);
    match key {
        SortKey::Id => cell(row, |ui| {
            let color = shown.region_colors.get(region.id.index()).copied().unwrap_or([128; 3]);
            widgets::chip(ui, palette, widgets::color(color), &format!("color of region {}", region.id));
            ui.add(Label::new(region.id.to_string()).selectable(false));
        }),
        SortKey::Pixels => number_cell(row, RichText::new(crate::describe::grouped(region.pixels)), None),
        SortKey::Body => {
            cell(row, |ui| vector(ui, palette, "body color", Some(region.body), shows_numbers));
        }
        SortKey::Surface => {
            cell(row, |ui| vector(ui, palette, "color of the light on it", region.surface, shows_numbers));
        }
        SortKey::Angle => {
            let angle = region.angle_deg.map(|angle| RichText::new(format!("{angle:.1}\u{b0}")));
            number_cell(row, angle.unwrap_or_else(dash), None);
        }
        SortKey::Highlight => {
            let pixels = region.highlights().map(crate::describe::grouped);
            let branches = &region.highlight_branches;
            let tip = (!branches.is_empty()).then(|| highlight_lines(branches));
            number_cell(row, pixels.map_or_else(dash, RichText::new), tip);
        }
        SortKey::Rms => {
            let rms = RichText::new(format!("{:.2}", region.fit_rms_counts));
            if region.fit_rms_counts > region.fit_limit_counts {
                let tip = format!("Beyond its limit of {:.1} counts (section 6).", region.fit_limit_counts);
                number_cell(row, rms.color(palette.warning), Some(tip));
            } else {
                number_cell(row, rms, None);
            }
        }
        SortKey::Warnings => cell(row, |ui| notes(ui, region, palette)),
    }
}

/// Shows a number at the right edge of a cell, with a tooltip where there is one.
fn number_cell(row: &mut TableRow, text: RichText, tip: Option<String>) {
    row.col(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let label = ui.add(Label::new(text).selectable(false));
            if let Some(tip) = tip {
                label.on_hover_text(tip);
            }
        });
    });
}

/// Shows the first of a region's warnings, in the color of warnings where the model does not fit; the tooltip has all.
fn notes(ui: &mut Ui, region: &RegionReflection, palette: &ThemeColors) {
    let warnings = grouped_sentences(&region.warnings);
    let Some((first, others)) = warnings.split_first() else { return };
    let text = if others.is_empty() { first.clone() } else { format!("{first} (+{})", others.len()) };
    let color = if region.model_fits() { palette.secondary } else { palette.warning };
    let label = Label::new(RichText::new(text).size(SMALL_PT).color(color))
        .truncate()
        .show_tooltip_when_elided(false);
    ui.add(label.selectable(false)).on_hover_text(warnings.join("\n"));
}

/// Tooltip about the shades on which a region's highlights lie, one line per highlight line (section 7.4).
fn highlight_lines(branches: &[HighlightBranch]) -> String {
    let line = |branch: &HighlightBranch| {
        let (pixels, percent) = (crate::describe::grouped(branch.pixels), 100.0 * branch.share);
        format!("from m_b {:.0} counts: {pixels} px, {percent:.0} %", branch.body)
    };
    let lines: Vec<String> = branches.iter().map(line).collect();
    format!("Highlight lines (section 7.4)\n{}", lines.join("\n"))
}

/// Adds a cell with contents laid out horizontally.
fn cell(row: &mut TableRow, contents: impl FnOnce(&mut Ui)) {
    row.col(|ui| {
        ui.horizontal_centered(contents);
    });
}

/// Shows a square of a unit vector's color, called `name`, then its three components in aligned columns; without numbers, the
/// square's tooltip has the components.
fn vector(ui: &mut Ui, palette: &ThemeColors, name: &str, vector: Option<[f64; 3]>, shows_numbers: bool) {
    ui.spacing_mut().item_spacing.x = 4.0;
    let Some(vector) = vector else {
        ui.label(RichText::new("\u{2013}").color(palette.secondary));
        return;
    };
    let [r, g, b] = vector;
    let tip = format!("{}: {r:.3} {g:.3} {b:.3}", widgets::capitalized(name));
    widgets::chip(ui, palette, brightest_color(vector), name).on_hover_text(tip);
    for value in vector.into_iter().filter(|_| shows_numbers) {
        ui.add(Label::new(widgets::signed(value, 2).replace("0.", ".")).selectable(false));
    }
}

/// The brightest color in a direction: the largest component is full scale.
fn brightest_color(direction: [f64; 3]) -> Color32 {
    let most = direction.iter().fold(1e-9f64, |most, &v| most.max(v));
    let [r, g, b] = direction.map(|v| (v / most).max(0.0) as f32);
    egui::Rgba::from_rgb(r, g, b).into()
}

/// Shows the title of a sortable column; returns whether the title was clicked. `descending` is the order of the rows
/// if they are sorted by this column, otherwise `None`.
fn sorted_by(ui: &mut Ui, palette: &ThemeColors, descending: Option<bool>, title: &str, tip: &str) -> bool {
    let arrow = descending.map(|descending| if descending { "\u{2193}" } else { "\u{2191}" });
    // A title that is too long is cut at its end, where the arrow of a title at the right edge would be lost.
    let shown_title = match arrow {
        Some(arrow) if ui.layout().prefer_right_to_left() => format!("{arrow} {title}"),
        Some(arrow) => format!("{title} {arrow}"),
        None => title.to_owned(),
    };
    let tone = if descending.is_some() { palette.text } else { palette.secondary };
    let text = widgets::with_subscripts(&shown_title, SMALL_PT, tone);
    let heading = ui.add(Button::new(text).frame(false));
    let order = descending.map_or("", |descending| if descending { ", descending" } else { ", ascending" });
    heading.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("{title}{order}")));
    heading.on_hover_text(tip).clicked()
}
