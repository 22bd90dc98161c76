//! The columns of the parameters panel: label, slider, value, unit and the button `auto`, in one line or in two.

use egui::{Align, Layout, Ui, vec2};

/// Width of the labels' column, points.
pub const LABEL_PT: f32 = 108.0;
/// Width of the field of a value, points.
pub const VALUE_PT: f32 = 46.0;
/// Width of a value's unit, points.
const UNIT_PT: f32 = 38.0;
/// Width of the button `auto`, points.
const AUTO_PT: f32 = 38.0;
/// Height of a row, points.
pub const ROW_PT: f32 = 20.0;
/// Width below which a panel is narrow, points.
pub const NARROW_PT: f32 = 284.0;
/// Width below which a row has two lines, points.
const STACKED_PT: f32 = 260.0;
/// Width below which a label has a line of its own, points.
const LABEL_ALONE_PT: f32 = 184.0;
/// Width of the labels' column in a narrow panel, points.
const NARROW_LABEL_PT: f32 = 90.0;
/// Distance between two columns, points.
pub const GAP_PT: f32 = 4.0;

/// Shows the label of a row.
pub fn label(ui: &mut Ui, text: &str, tip: &str) -> egui::Response {
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
pub struct Columns {
    /// The parameter's title.
    pub label: Cell,
    /// The slider.
    pub slider: Cell,
    /// The field in which the value is typed.
    pub value: Cell,
    /// The unit; without width in a narrow panel.
    pub unit: Cell,
    /// The button `auto`.
    pub auto: Cell,
}

/// A cell of a row: its rectangle.
pub struct Cell(pub egui::Rect);

impl Cell {
    /// Shows a widget in the cell.
    pub fn show(&self, ui: &mut Ui, widget: impl egui::Widget) -> egui::Response {
        let layout = Layout::left_to_right(Align::Center);
        let builder = egui::UiBuilder::new().max_rect(self.0).layout(layout);
        ui.scope_builder(builder, |ui| ui.add(widget)).inner
    }
}

impl Columns {
    /// The cells of the next row of `ui`.
    pub fn of(ui: &mut Ui) -> Self {
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
        // The label has a line of its own where a value and a button beside it would cut it off.
        let is_label_alone = ui.available_width() < LABEL_ALONE_PT;
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
        if is_label_alone {
            return Self {
                label: cell(0.0, width, 0.0),
                slider: cell(0.0, (value - GAP_PT).max(20.0), 1.0),
                value: cell(value, value + VALUE_PT, 1.0),
                unit: cell(width, width, 0.0),
                auto: cell(auto, auto + AUTO_PT, 1.0),
            };
        }
        Self {
            label: cell(0.0, value - GAP_PT, 0.0),
            slider: cell(0.0, width, 1.0),
            value: cell(value, value + VALUE_PT, 0.0),
            unit: cell(width, width, 0.0),
            auto: cell(auto, auto + AUTO_PT, 0.0),
        }
    }
}
