//! The regions panel at the debugger's cursor: a table of the hypotheses so far; before the first one, counts of
//! windows and areas.

use super::table_columns::{TableColumn, count_width, fitting, widest, with_columns};
use super::{ROW_PT, cell, vector};
use crate::app::{Command, DebugCommand, Edit};
use crate::gui::theme::ThemeColors;
use crate::gui::{PanelContext, widgets};
use crate::raster::RegionId;
use crate::trace::Replay;
use crate::view::{
    HypothesisRow, Item, LegendEntry, RegionNames, Status, WindowCounts, class_entries, hypothesis_rows,
    window_counts,
};
use egui::{Align, Label, Layout, RichText, Sense, Ui};
use egui_extras::{TableBuilder, TableRow};

/// The column that the rows are sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum SortKey {
    #[default]
    Birth,
    Pixels,
    Direction,
    Radius,
    Status,
    Becomes,
}

/// A column: key, title, width in points, tooltip.
const COLUMNS: [(SortKey, &str, f32, &str); 6] = [
    (
        SortKey::Birth,
        "#",
        40.0,
        "The hypothesis' number, in the order of birth; its color is that of what becomes of it.",
    ),
    (SortKey::Pixels, "pixels", 52.0, "Pixels of the working picture that it has at the cursor."),
    (
        SortKey::Direction,
        "direction",
        96.0,
        "Unit direction of its line at the cursor, red green blue (section 5.3.1).",
    ),
    (SortKey::Radius, "radius", 52.0, "Radius of its cylinder, counts (section 5.3.2)."),
    (SortKey::Status, "status", 110.0, "What became of it up to the cursor (section 5.3)."),
    (SortKey::Becomes, "result", 70.0, "The region of the result that it is, or is part of."),
];

/// The columns that a narrow panel leaves out, the first one first.
const DISPENSABLE: [SortKey; 2] = [SortKey::Radius, SortKey::Direction];

/// Width of the panel from which directions show numbers, points.
const WIDTH_WITH_NUMBERS_PT: f32 = 430.0;

/// The table's order of rows.
#[derive(Clone, Copy, Debug, Default)]
pub struct HypothesisTable {
    key: SortKey,
    descending: bool,
}

impl HypothesisTable {
    /// Shows the light, and the hypotheses or the windows at the cursor.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext, replay: &Replay) {
        light(ui, cx.palette, replay);
        let rows = hypothesis_rows(replay, &cx.state.debugger.names);
        if !rows.is_empty() {
            egui::ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| {
                self.table(ui, cx, &rows, replay.trace().pixel_blocks().side());
            });
        } else if let Some(counts) = window_counts(replay) {
            windows(ui, cx.palette, &counts);
        } else {
            widgets::placeholder(ui, cx.palette, "At the cursor no window has been laid yet.");
        }
    }

    /// `side`: side of a working pixel, pixels of the photograph. The record is of working pixels.
    fn table(&mut self, ui: &mut Ui, cx: &mut PanelContext, rows: &[HypothesisRow], side: usize) {
        let working_pixels = format!("{side} \u{d7} {side} px");
        let room_pt = ui.available_width();
        let shows_numbers = room_pt >= WIDTH_WITH_NUMBERS_PT;
        let gap_pt = if shows_numbers { 6.0 } else { 4.0 };
        ui.spacing_mut().item_spacing = egui::vec2(gap_pt, 1.0);
        let focus = cx.state.debugger.focus();
        let order = self.order(rows);
        let mut hovered = None;
        let columns = fitting(column_widths(ui, rows, shows_numbers), &DISPENSABLE, gap_pt, room_pt);
        let mut table = TableBuilder::new(ui).striped(false).sense(Sense::CLICK).resizable(false);
        table = with_columns(table, &columns);
        if let Some(row) = order.iter().position(|&index| Some(rows[index].hypothesis) == focus) {
            table = table.scroll_to_row(row, None);
        }
        table
            .header(ROW_PT, |mut header| {
                for (key, title, _, tip) in COLUMNS {
                    if !columns.iter().any(|(column, _)| *column == key) {
                        continue;
                    }
                    let is_count = key == SortKey::Pixels && side > 1;
                    let title = match key {
                        _ if is_count => working_pixels.as_str(),
                        SortKey::Direction if !shows_numbers => "d",
                        _ => title,
                    };
                    header.col(|ui| self.heading(ui, cx.palette, key, title, tip));
                }
            })
            .body(|body| {
                body.rows(ROW_PT, order.len(), |mut row| {
                    let row_of = &rows[order[row.index()]];
                    row.set_selected(Some(row_of.hypothesis) == focus);
                    for &(key, _) in &columns {
                        table_cell(
                            &mut row,
                            cx.palette,
                            key,
                            row_of,
                            &cx.state.debugger.names,
                            shows_numbers,
                        );
                    }
                    let response = row.response();
                    let becomes = row_of.region.map(Item::Region);
                    if response.hovered() {
                        hovered = becomes;
                    }
                    if response.clicked() {
                        // What is selected has a history of its own, in place of which that of the hypothesis is shown.
                        cx.commands.extend(becomes.map(|item| Edit::Select(Some(item)).into()));
                        cx.send(Command::Debug(DebugCommand::Choose(Some(row_of.hypothesis))));
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
        let layout = match key {
            SortKey::Pixels | SortKey::Radius => Layout::right_to_left(Align::Center),
            _ => Layout::left_to_right(Align::Center),
        };
        ui.with_layout(layout, |ui| {
            if super::sorted_by(ui, palette, chosen.then_some(self.descending), title, tip) {
                self.descending = if chosen { !self.descending } else { key == SortKey::Pixels };
                self.key = key;
            }
        });
    }

    /// Indices of the hypotheses in the order of the rows.
    fn order(self, rows: &[HypothesisRow]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..rows.len()).collect();
        let value = |row: &HypothesisRow| match self.key {
            SortKey::Birth => f64::from(row.hypothesis.get()),
            SortKey::Pixels => f64::from(row.pixels),
            SortKey::Direction => row.direction.map_or(-10.0, super::hue_rad),
            SortKey::Radius => row.radius,
            SortKey::Status => match row.status {
                Status::AtWork => 0.0,
                Status::Stands => 1.0,
                Status::Absorbed(_) => 2.0,
                Status::Merged(_) => 3.0,
                Status::Barren => 4.0,
                Status::Dropped => 5.0,
                Status::Divided => 6.0,
            },
            SortKey::Becomes => f64::from(RegionId::label(row.region)),
        };
        order.sort_by(|&a, &b| {
            let by_value = value(&rows[a]).total_cmp(&value(&rows[b]));
            if self.descending { by_value.reverse() } else { by_value }.then(a.cmp(&b))
        });
        order
    }
}

/// The least widths of the columns. Numbers and words are never cut.
fn column_widths(ui: &Ui, rows: &[HypothesisRow], shows_numbers: bool) -> Vec<TableColumn<SortKey>> {
    let width_of = |(key, _, width, _): (SortKey, &str, f32, &str)| {
        let width = match key {
            SortKey::Birth => super::number_width(ui, rows.iter().map(|row| row.hypothesis.to_string())),
            SortKey::Pixels => width.max(count_width(ui, rows.iter().map(|row| row.pixels as usize))),
            SortKey::Direction if !shows_numbers => super::CHIP_COLUMN_PT,
            SortKey::Status if !shows_numbers => widest(ui, rows.iter().map(|row| row.status.text())),
            _ => width,
        };
        (key, width)
    };
    COLUMNS.map(width_of).to_vec()
}

/// Shows a cell of a row. `shows_numbers`: whether a direction is shown with its numbers.
fn table_cell(
    row: &mut TableRow,
    palette: &ThemeColors,
    key: SortKey,
    row_of: &HypothesisRow,
    names: &RegionNames,
    shows_numbers: bool,
) {
    let has_ended = !matches!(row_of.status, Status::AtWork | Status::Stands);
    let tone = if has_ended { palette.secondary } else { palette.text };
    let plain = |ui: &mut Ui, text: String| {
        ui.add(Label::new(RichText::new(text).color(tone)).selectable(false));
    };
    let number = |row: &mut TableRow, text: String| {
        super::number_cell(row, RichText::new(text).color(tone), None);
    };
    match key {
        SortKey::Birth => cell(row, |ui| {
            let color = widgets::color(names.color(row_of.hypothesis));
            widgets::chip(ui, palette, color, &format!("color of hypothesis {}", row_of.hypothesis));
            plain(ui, row_of.hypothesis.to_string());
        }),
        SortKey::Pixels => number(row, crate::describe::grouped(row_of.pixels)),
        SortKey::Direction => {
            cell(row, |ui| vector(ui, palette, "color of the line", row_of.direction, shows_numbers));
        }
        SortKey::Radius => number(row, format!("{:.1}", row_of.radius)),
        SortKey::Status => cell(row, |ui| plain(ui, row_of.status.text())),
        SortKey::Becomes => cell(row, |ui| {
            let becomes = match row_of.region {
                None => "\u{2013}".to_owned(),
                Some(number) => format!("\u{2192} region {number}"),
            };
            plain(ui, becomes);
        }),
    }
}

/// Shows the light's direction as estimated at the cursor.
fn light(ui: &mut Ui, palette: &ThemeColors, replay: &Replay) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        let tip = "The color of the light as it is estimated up to the cursor (section 5.4).";
        ui.label(RichText::new("light so far").color(palette.secondary)).on_hover_text(tip);
        match replay.light() {
            Some(direction) => vector(ui, palette, "color of the light", Some(direction), true),
            None => {
                ui.label(RichText::new("not estimated yet").color(palette.secondary));
            }
        }
    });
}

/// Shows the number of windows of each class, and the number of areas that they form.
fn windows(ui: &mut Ui, palette: &ThemeColors, counts: &WindowCounts) {
    ui.add_space(4.0);
    let row = |ui: &mut Ui, entry: Option<LegendEntry>, name: &str, tip: &str, count: usize| {
        match entry {
            Some(entry) => widgets::chip(ui, palette, widgets::color(entry.color), name),
            None => ui.label(""),
        };
        ui.label(name).on_hover_text(tip);
        widgets::number(ui, palette, 70.0, &crate::describe::grouped(count), "");
        ui.end_row();
    };
    egui::Grid::new("windows so far").num_columns(3).spacing([6.0, 2.0]).show(ui, |ui| {
        for (entry, count) in class_entries().into_iter().zip(counts.classes) {
            row(ui, Some(entry), entry.name, entry.tooltip, count);
        }
        let tip = "Windows with too few pixels to be believed for a class (section 5.2.1).";
        row(ui, None, "without a class", tip, counts.unclassed);
        let tip = "Windows without a single pixel to be believed: background and shadow (section 4).";
        row(ui, None, "empty", tip, counts.empty);
        row(
            ui,
            None,
            "not looked at yet",
            "Windows that come after the cursor (section 5.2.1).",
            counts.waiting,
        );
        let tip = "Neighboring windows of one class whose union is of that class too (section 5.2.2).";
        row(ui, None, "areas so far", tip, counts.areas);
    });
}
