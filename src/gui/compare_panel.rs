//! The comparison panel: parameters, scores and regions of the pinned result (A) and of the newest (B).

use super::background_value::{BackgroundValue, SYNCHRONOUS_PX};
use super::theme::SMALL_PT;
use super::{PanelContext, elsewhere_section::ElsewhereSection, lacking_result, widgets};
use crate::app::{Command, DebugCommand, Difference, Edit, NOT_ANALYZED, ViewCommand};
use crate::describe::Names;
use crate::raster::RegionId;
use crate::view::{
    Comparison, FigureWords, ImageSettings, Item, Layer, RegionChange, compare, setting_meaning,
};
use egui::{Grid, RichText, ScrollArea, Ui};
use std::sync::Arc;

/// Width of a panel in which both tables stand side by side, points.
const SIDE_BY_SIDE_PT: f32 = 640.0;

/// The words of the angle between the lights of both results.
const BETWEEN_LIGHTS: FigureWords = FigureWords {
    name: "between both lights",
    meaning: "Angle between the light's color in A and in B.",
    unit: "\u{b0}",
    factor: 1.0,
};

/// The comparison panel.
#[derive(Default)]
pub struct ComparePanel {
    /// The subject is the address of the photograph and the generation of the pinned result, the version that of the newest.
    comparison: BackgroundValue<(usize, u64), u64, Option<Comparison>>,
    elsewhere: ElsewhereSection,
}

impl ComparePanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let (pinned, newest) = (cx.state.pinned.clone(), cx.state.newest.clone());
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            let (Some(pinned), Some(newest)) = (pinned, newest) else {
                let contents = |ui: &mut Ui| {
                    pin_hint(ui, cx);
                    self.elsewhere.show(ui, cx);
                };
                ScrollArea::vertical().auto_shrink(false).show(ui, contents);
                return;
            };
            let key = ((Arc::as_ptr(&newest.picture) as usize, pinned.generation), newest.generation);
            let synchronous = newest.labels().len() <= SYNCHRONOUS_PX;
            // A result whose stages belong to different runs is not compared.
            if newest.stale_from.is_some() {
                return buttons(ui, cx);
            }
            let found = self.comparison.get(ui.ctx(), key, synchronous, move || compare(&pinned, &newest));
            buttons(ui, cx);
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                if let Some(Some(found)) = found {
                    found_tables(ui, cx, found);
                }
                self.elsewhere.show(ui, cx);
            });
        });
    }
}

/// Shows what differs: scores and parameters beside the changed pixels and regions, or one below the other in a narrow panel.
fn found_tables(ui: &mut Ui, cx: &mut PanelContext, found: &Comparison) {
    let grid = |name| Grid::new(name).num_columns(4).spacing([14.0, 2.0]);
    let room = ui.available_width();
    if room < SIDE_BY_SIDE_PT {
        let width = widgets::width_of_names(room, 3);
        grid("scores").show(ui, |ui| scores(ui, cx, found, width));
        ui.add_space(8.0);
        regions(ui, cx, found);
        widgets::heading(ui, cx.palette, "Parameters that are not the same");
        grid("settings").show(ui, |ui| {
            titles(ui, cx, &["", "A", "B"]);
            settings(ui, cx, found);
        });
        return;
    }
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            grid("figures").show(ui, |ui| {
                scores(ui, cx, found, widgets::width_of_names(0.6 * room, 3));
                settings(ui, cx, found);
            });
        });
        ui.add_space(16.0);
        ui.vertical(|ui| regions(ui, cx, found));
    });
}

/// Shows, while no result is pinned, a sentence about the panel and the button that pins a result.
fn pin_hint(ui: &mut Ui, cx: &mut PanelContext) {
    let text = if lacking_result::has_none(cx.state) {
        NOT_ANALYZED
    } else {
        "Pin this result, change a slider, and see what changed."
    };
    ui.label(RichText::new(text).color(cx.palette.secondary));
    let ready = cx.state.newest.is_some();
    if ui.add_enabled(ready, egui::Button::new("Pin this result (K)")).clicked() {
        cx.send(ViewCommand::Pin(true));
    }
}

/// Shows the buttons for both results, and the first decision that differs.
fn buttons(ui: &mut Ui, cx: &mut PanelContext) {
    ui.horizontal_wrapped(|ui| {
        let pinned = cx.state.view.show_pinned;
        for (choice, name) in [(true, "A pinned"), (false, "B newest")] {
            if ui
                .selectable_label(pinned == choice, name)
                .on_hover_text("Which of both every panel shows (A).")
                .clicked()
            {
                cx.send(ViewCommand::ShowPinned(choice));
            }
        }
        if ui
            .button("Difference image")
            .on_hover_text("The newest body reflection minus the pinned one, gray = none.")
            .clicked()
        {
            cx.send(ViewCommand::Image(ImageSettings {
                layer: Layer::Difference,
                ..cx.state.view.image.clone()
            }));
        }
        if ui.button("Pin anew").on_hover_text("The newest result takes the pinned one's place.").clicked() {
            cx.send(ViewCommand::Pin(true));
        }
        if ui.button("Unpin").on_hover_text("Compare with nothing.").clicked() {
            cx.send(ViewCommand::Pin(false));
        }
    });
    decisions(ui, cx);
}

/// Shows the first decision in which the two analyses differ, and the button that finds that decision.
fn decisions(ui: &mut Ui, cx: &mut PanelContext) {
    ui.horizontal_wrapped(|ui| {
        let find = egui::Button::new("First decision that differs");
        let find = ui.add_enabled(cx.state.debugger.replay.is_some(), find).on_hover_text(
            "Go to the first step of the newest analysis at which the pinned one went another way.",
        );
        if find.clicked() {
            cx.send(Command::Debug(DebugCommand::Compare));
        }
        match cx.state.debugger.difference {
            None => {}
            Some(Difference::None) => {
                ui.label(secondary_text(cx, "both took the same decisions"));
            }
            Some(Difference::NotRecorded) => {
                ui.label(secondary_text(cx, "the pinned result's decisions were not recorded: pin it anew"));
            }
            Some(Difference::At(step)) => decisions_at(ui, cx, step),
        }
    });
}

/// Shows the decision of each analysis at a step.
fn decisions_at(ui: &mut Ui, cx: &PanelContext, step: usize) {
    let pinned = cx.state.pinned.as_ref().and_then(|pinned| pinned.trace());
    ui.vertical(|ui| {
        for (name, trace) in [("A", pinned), ("B", cx.state.debugger.trace())] {
            let Some(trace) = trace else { continue };
            let decision =
                trace.step(step).map_or_else(|| "has ended".to_owned(), |n| Names::of(trace).step(&n));
            let stage = trace.stage_at(step).map_or("", crate::trace::Stage::name);
            ui.label(
                RichText::new(format!(
                    "{name}  step {}, {stage}: {decision}",
                    crate::describe::grouped(step + 1)
                ))
                .size(SMALL_PT),
            );
        }
    });
}

/// Small text in the secondary color.
fn secondary_text(cx: &PanelContext, text: impl Into<String>) -> RichText {
    RichText::new(text).size(SMALL_PT).color(cx.palette.secondary)
}

/// Shows a row with the titles of columns.
fn titles(ui: &mut Ui, cx: &PanelContext, titles: &[&str]) {
    for title in titles {
        ui.label(secondary_text(cx, *title));
    }
    ui.end_row();
}

/// Shows a row with the titles, and one for each score. `width`: that of the names, points.
fn scores(ui: &mut Ui, cx: &PanelContext, found: &Comparison, width: f32) {
    titles(ui, cx, &["", "A", "B", "B \u{2212} A"]);
    for figure in &found.figures {
        widgets::figure_name(ui, width, figure.words);
        let text = |value: Option<f64>| value.map_or("\u{2013}".to_owned(), shortened);
        ui.label(text(figure.pinned));
        ui.label(text(figure.newest));
        let (text, differs) = difference(figure.pinned, figure.newest);
        let tone = if differs { cx.palette.accent } else { cx.palette.secondary };
        ui.label(RichText::new(text).color(tone));
        ui.end_row();
    }
    if let Some(angle) = found.illuminant_deg {
        widgets::figure_name(ui, width, BETWEEN_LIGHTS);
        ui.label("");
        ui.label("");
        ui.label(format!("{angle:.2}"));
        ui.end_row();
    }
}

/// Shows a row for each parameter that differs. A change of the method changes several dozen of them.
fn settings(ui: &mut Ui, cx: &PanelContext, found: &Comparison) {
    for change in &found.settings {
        let name = ui.label(RichText::new(change.name.replace('_', " ")).color(cx.palette.accent));
        if let Some(meaning) = setting_meaning(change.name) {
            name.on_hover_text(meaning);
        }
        ui.label(&change.pinned);
        ui.label(&change.newest);
        ui.end_row();
    }
}

/// The difference of two figures as text, and whether it is more than what the text leaves out. Figures whose texts differ although the
/// difference is too small to be shown are nearly the same.
fn difference(pinned: Option<f64>, newest: Option<f64>) -> (String, bool) {
    let (pinned, newest) = match (pinned, newest) {
        (Some(pinned), Some(newest)) => (pinned, newest),
        (None, None) => return ("=".to_owned(), false),
        _ => return ("\u{2013}".to_owned(), true),
    };
    let text = shortened(newest - pinned);
    match (is_zero(&text), shortened(pinned) == shortened(newest)) {
        (false, _) => (format!("{}{text}", if newest > pinned { "+" } else { "" }), true),
        (true, true) => ("=".to_owned(), false),
        (true, false) => ("\u{2248}".to_owned(), false),
    }
}

/// A number with three decimals, or none for whole and large numbers.
fn shortened(value: f64) -> String {
    widgets::signed(value, if value.abs() >= 1000.0 || value.fract() == 0.0 { 0 } else { 3 })
}

/// Whether a number in text is zero.
fn is_zero(text: &str) -> bool {
    text.chars().all(|letter| matches!(letter, '0' | '.'))
}

/// Shows the numbers of changed pixels, and the regions that differ.
fn regions(ui: &mut Ui, cx: &mut PanelContext, found: &Comparison) {
    let (pixels, body) = (&found.pixels, &found.body);
    let all = (pixels.kept + pixels.gained + pixels.lost + pixels.changed).max(1) as f64;
    let percent = |n: usize| format!("{:.2} %", 100.0 * n as f64 / all);
    Grid::new("pixels").num_columns(2).spacing([14.0, 2.0]).show(ui, |ui| {
        for (name, value, meaning) in [
            (
                "pixels gained",
                percent(pixels.gained),
                "Share of all pixels that have a region in B and none in A.",
            ),
            (
                "pixels lost",
                percent(pixels.lost),
                "Share of all pixels that have a region in A and none in B.",
            ),
            (
                "pixels of another region",
                percent(pixels.changed),
                "Share of all pixels whose region in B is not the one of A.",
            ),
            (
                "body changed by > 1 count",
                format!("{:.2} %", 100.0 * body.share),
                "Share of all pixels whose body reflection differs by more than 1 count in a band.",
            ),
            (
                "largest change",
                format!("{:.1} counts", body.most_counts),
                "Largest difference of the body reflection in a band.",
            ),
        ] {
            ui.label(secondary_text(cx, name)).on_hover_text(meaning);
            ui.label(value);
            ui.end_row();
        }
    });
    widgets::heading(ui, cx.palette, "Regions that are not the same");
    let changed: Vec<_> = found.regions.iter().filter(|region| region.change != RegionChange::Kept).collect();
    if changed.is_empty() {
        ui.label(secondary_text(cx, "none"));
    }
    for region in changed {
        let id = |id: Option<RegionId>| id.map_or("\u{2013}".to_owned(), |id| id.to_string());
        let change_text = match region.change {
            RegionChange::Gained => "gained",
            RegionChange::Lost => "lost",
            RegionChange::Changed | RegionChange::Kept => "changed",
        };
        let sign = if region.pixels_newest < region.pixels_pinned { "\u{2212}" } else { "+" };
        let pixels = crate::describe::grouped(region.pixels_newest.abs_diff(region.pixels_pinned));
        let (pinned, newest) = (id(region.pinned), id(region.newest));
        let text = format!("{change_text}  A {pinned} \u{2192} B {newest}  {sign}{pixels} px");
        let row = ui.selectable_label(false, text);
        let target = if cx.state.view.show_pinned { region.pinned } else { region.newest };
        if row.clicked()
            && let Some(region) = target
        {
            cx.send(Edit::Select(Some(Item::Region(region))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_that_is_shown_as_zero_is_none() {
        assert!(is_zero(&shortened(-0.0004)) && is_zero(&shortened(0.0)));
        assert!(!is_zero(&shortened(-0.0006)) && !is_zero(&shortened(1000.0)));
    }

    #[test]
    fn figures_with_other_texts_are_not_told_to_be_the_same() {
        let of = |pinned, newest| difference(Some(pinned), Some(newest));
        assert_eq!(of(0.5, 0.5), ("=".to_owned(), false));
        assert_eq!(of(0.99755, 0.99745), ("\u{2248}".to_owned(), false));
        assert_eq!(of(1.0, 1.25), ("+0.250".to_owned(), true));
        assert_eq!(
            (difference(None, None).0, difference(None, Some(1.0)).0),
            ("=".into(), "\u{2013}".into())
        );
    }
}
