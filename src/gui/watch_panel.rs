//! The watch panel: values at the debugger's cursor, with a mark on each value that changed since the cursor last stopped.

use super::theme::{SMALL_PT, ThemeColors};
use super::{PanelContext, lacking_result};
use crate::color::Vec3;
use crate::view::{CurrentHypothesis, Watch, WatchedPixel};
use egui::{Align, Label, Layout, RichText, ScrollArea, Ui, vec2};

/// Width of the names, points.
const NAME_PT: f32 = 84.0;
/// Width of all columns of numbers together, points.
const NUMBERS_PT: f32 = 126.0;
/// Width of a unit with the distance before it, points.
const UNIT_PT: f32 = 50.0;
/// Width of a line of name, numbers and unit, points. A narrower panel has the units in the tooltips.
const GROUP_PT: f32 = NAME_PT + NUMBERS_PT + UNIT_PT;
/// Height of a line, points.
const LINE_PT: f32 = 18.0;

/// The watch panel.
#[derive(Default)]
pub struct WatchPanel {
    now: Option<CursorValues>,
    /// The lines at the earlier position of rest, which new lines are compared with.
    lines_before: Vec<Vec<Line>>,
}

/// The values at one position of the cursor.
struct CursorValues {
    /// Generation of the trace, and number of steps taken.
    at: (u64, usize),
    is_at_rest: bool,
    groups: Vec<Vec<Line>>,
}

/// A line of the table.
#[derive(Clone, Debug, PartialEq)]
struct Line {
    name: &'static str,
    tip: &'static str,
    /// One or three values, shown in as many columns.
    values: Vec<String>,
    unit: &'static str,
}

impl WatchPanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let (state, debugger) = (cx.state, &cx.state.debugger);
        let (Some(replay), Some(picture)) = (&debugger.replay, &state.picture) else {
            let text = "Values at the cursor appear when the decisions of an analysis are recorded (D).";
            return lacking_result::placeholder(ui, cx, text);
        };
        let Some(found) = state.watched() else { return };
        let mut groups = vec![run_lines(&found)];
        groups.extend(found.current.as_ref().map(hypothesis_lines));
        groups.extend(found.pixel.as_ref().map(|pixel| pixel_lines(pixel, picture.size().0)));
        self.store_values((debugger.generation, replay.at()), debugger.playing.is_none(), groups);
        let Some(now) = &self.now else { return };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(8).show(ui, |ui| {
                ui.spacing_mut().item_spacing = vec2(4.0, 1.0);
                table(ui, cx.palette, &now.groups, |line| self.has_changed(line));
                if found.pixel.is_none() {
                    let text = "Select a pixel (Alt + click) to watch it; the inspector has its distances to every axis and plane.";
                    ui.add(Label::new(RichText::new(text).size(SMALL_PT).color(cx.palette.secondary)).wrap());
                }
            });
        });
    }

    /// Stores the values of this frame. When the cursor leaves a position of rest, the values at that position are kept, so
    /// that new values are compared with them.
    fn store_values(&mut self, at: (u64, usize), is_at_rest: bool, groups: Vec<Vec<Line>>) {
        let before = self.now.replace(CursorValues { at, is_at_rest, groups });
        if let Some(before) = before.filter(|before| before.at != at && before.is_at_rest) {
            self.lines_before = before.groups;
        }
    }

    /// Whether a line has other values than at the earlier position of rest.
    fn has_changed(&self, line: &Line) -> bool {
        self.lines_before.iter().flatten().any(|old| old.tip == line.tip && old.values != line.values)
    }
}

impl Line {
    fn new(name: &'static str, tip: &'static str, values: Vec<String>, unit: &'static str) -> Self {
        Self { name, tip, values, unit }
    }

    fn one(name: &'static str, tip: &'static str, value: String, unit: &'static str) -> Self {
        Self::new(name, tip, vec![value], unit)
    }
}

/// The text of a value that does not exist.
fn dash() -> String {
    "\u{2013}".to_owned()
}

/// Lines about the progress of the analysis.
fn run_lines(watch: &Watch) -> Vec<Line> {
    let stage = watch.stage.map_or_else(dash, |stage| stage.name().to_owned());
    let pass = watch.pass.map_or_else(dash, |pass| pass.name().to_owned());
    let [active, all] = watch.regions.map(crate::describe::grouped);
    let regions = format!("{active} of {all}");
    let unassigned = crate::describe::grouped(watch.unassigned);
    let light = watch.light.map_or_else(|| vec![dash()], |light| light.map(|v| format!("{v:.3}")).to_vec());
    vec![
        Line::one("stage", "The stage of the step taken last (5.2 to 6).", stage, ""),
        Line::one("pass", "The part of that stage.", pass, ""),
        Line::one("regions", "Regions that stand, of all that were begun so far.", regions, ""),
        Line::one("unassigned", "Pixels that are in no region yet.", unassigned, "px"),
        Line::new("light", "Unit direction of the light as estimated so far (5.4.1).", light, ""),
    ]
}

/// Lines about the hypothesis that the step at the cursor concerns.
fn hypothesis_lines(current: &CurrentHypothesis) -> Vec<Line> {
    let number = match current.region {
        None => current.hypothesis.to_string(),
        Some(region) => format!("{} (region {region})", current.hypothesis),
    };
    let pixels = crate::describe::grouped(current.pixels);
    let vector = |v: &Vec3, digits: usize| v.iter().map(|v| format!("{v:.digits$}")).collect();
    let (mean, direction) = (vector(&current.line.mean, 1), vector(&current.line.direction, 3));
    let half = current.half_width.map_or_else(dash, |half| format!("{half:.2}"));
    let tip = "The one that the cursor is about, and what it is in the result.";
    vec![
        Line::one("hypothesis", tip, number, ""),
        Line::one("pixels", "Pixels that it holds.", pixels, "px"),
        Line::new("mean", "Mean color of its line (5.3.1).", mean, "counts"),
        Line::new("direction", "Unit direction of its cylinder's axis (5.3.1).", direction, ""),
        Line::one("radius", "Radius of its cylinder (5.3.2).", format!("{:.2}", current.radius), "counts"),
        Line::one("half width", "Half the thickness of its slice, once it has one (5.4.2).", half, "counts"),
    ]
}

/// Lines about the selected pixel; `width` is the photograph's, pixels.
fn pixel_lines(pixel: &WatchedPixel, width: usize) -> Vec<Line> {
    let [x, y] = pixel.pixel.position(width);
    let class = match pixel.class {
        None => dash(),
        Some(None) => "too few pixels".to_owned(),
        Some(Some(class)) => class.name().to_owned(),
    };
    let owner = pixel.hypothesis.map_or_else(dash, |hypothesis| format!("hypothesis {hypothesis}"));
    let color = pixel.color.map(|v| format!("{v:.1}")).to_vec();
    let role = pixel.kind.name().to_owned();
    vec![
        Line::one("pixel", "The selected pixel: column, row.", format!("{x}, {y}"), ""),
        Line::new("color", "Linear counts, red green blue.", color, "counts"),
        Line::one("class", "Class of its window, once it is known (5.2.1).", class, ""),
        Line::one("held by", "The region that has claimed it.", owner, ""),
        Line::one("role", "Matte, highlight, restored: once it is labeled (6).", role, ""),
    ]
}

/// Shows groups of lines, in two columns if there is room.
fn table(ui: &mut Ui, palette: &ThemeColors, groups: &[Vec<Line>], changed: impl Fn(&Line) -> bool) {
    let line_pt = ui.available_width().min(GROUP_PT);
    let groups_per_row = if ui.available_width() >= 2.0 * GROUP_PT + 8.0 { 2 } else { 1 };
    for row in groups.chunks(groups_per_row) {
        ui.horizontal_top(|ui| {
            for group in row {
                ui.vertical(|ui| {
                    ui.set_width(line_pt);
                    for line in group {
                        show_line(ui, palette, line, changed(line));
                    }
                });
            }
        });
        ui.add_space(4.0);
    }
}

/// Shows a line: mark, name, values and unit.
fn show_line(ui: &mut Ui, palette: &ThemeColors, line: &Line, changed: bool) {
    ui.horizontal(|ui| {
        name(ui, palette, line, changed);
        let text_color = if changed { palette.accent } else { palette.text };
        let has_units = ui.available_width() >= NUMBERS_PT + UNIT_PT - 8.0;
        let numbers_pt = if has_units { NUMBERS_PT } else { ui.available_width().min(NUMBERS_PT) };
        for value in &line.values {
            cell(ui, numbers_pt / line.values.len() as f32 - 4.0, RichText::new(value).color(text_color));
        }
        if has_units {
            ui.label(RichText::new(line.unit).color(palette.secondary));
        }
    });
}

/// Shows the name of a line, with a mark on changed values.
fn name(ui: &mut Ui, palette: &ThemeColors, line: &Line, changed: bool) {
    let size = vec2(NAME_PT, LINE_PT);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
        ui.set_min_size(size);
        let (rect, _) = ui.allocate_exact_size(vec2(3.0, LINE_PT - 4.0), egui::Sense::hover());
        if changed {
            ui.painter().rect_filled(rect, 1.0, palette.accent);
        }
        let text = RichText::new(line.name).color(palette.secondary);
        let label = ui.add(Label::new(text).truncate().show_tooltip_when_elided(false));
        let unit =
            if line.unit.is_empty() { String::new() } else { format!(" In {}.", unit_name(line.unit)) };
        label.on_hover_text(format!("{}{unit}", line.tip));
    });
}

/// The name of a unit in a sentence.
fn unit_name(unit: &str) -> &str {
    if unit == "px" { "pixels" } else { unit }
}

/// Shows a value, aligned to the right.
fn cell(ui: &mut Ui, width: f32, text: RichText) {
    let size = vec2(width.max(0.0), LINE_PT);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_size(size);
        ui.add(Label::new(text).extend());
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(value: &str) -> Vec<Vec<Line>> {
        vec![vec![Line::one("pixels", "Pixels that it holds.", value.to_owned(), "px")]]
    }

    #[test]
    fn values_that_changed_since_the_last_rest_are_marked() {
        let mut panel = WatchPanel::default();
        let marked =
            |panel: &WatchPanel| panel.now.as_ref().is_some_and(|now| panel.has_changed(&now.groups[0][0]));
        panel.store_values((1, 10), true, line("5"));
        assert!(!marked(&panel), "nothing came before");
        panel.store_values((1, 11), true, line("6"));
        assert!(marked(&panel));
        panel.store_values((1, 11), true, line("6"));
        assert!(marked(&panel), "as long as the cursor rests");
        for at in 12..20 {
            panel.store_values((1, at), false, line(&at.to_string()));
        }
        panel.store_values((1, 19), true, line("6"));
        assert!(!marked(&panel), "playing is one move");
        panel.store_values((1, 20), true, line("6"));
        assert!(!marked(&panel));
    }
}
