//! What can be done with the subject of the inspector: run to, break here, select, export, copy.

use crate::app::Direction::Forward;
use crate::app::{Breakpoint, Combine, Command, Condition, DebugCommand, DebugSettings, Edit, Goal};
use crate::gui::PanelContext;
use crate::gui::action::{Action, PixelSet};
use crate::gui::pane::Pane;
use crate::raster::{PixelIndex, RegionId};
use crate::view::{Inspection, Item};
use egui::{Button, RichText, Ui};
use std::sync::Arc;

/// The subject of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subject {
    /// The step at the debugger's cursor.
    Step,
    /// The item under the pointer. The pointer cannot reach buttons of such a block.
    Hovered(Item),
    /// The selected item.
    Selected(Item),
    /// The marked pixels.
    Marked,
}

/// Shows the actions as small buttons in lines that wrap.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, found: &Inspection, subject: Subject) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = egui::vec2(4.0, 3.0);
        match subject {
            Subject::Step => of_step(ui, cx),
            Subject::Hovered(_) => return,
            Subject::Selected(Item::Pixel(pixel)) => of_pixel(ui, cx, pixel),
            Subject::Selected(Item::Region(region)) => of_region(ui, cx, region),
            Subject::Selected(Item::Window(_) | Item::Bin(_)) => {}
            Subject::Marked => of_marked(ui, cx),
        }
        if button(ui, "Copy", "Copies subject, verdict and values as text.") {
            ui.ctx().copy_text(as_text(found));
        }
    });
}

/// Shows a small button; returns whether it was clicked.
fn button(ui: &mut Ui, text: &str, tip: &str) -> bool {
    ui.add(Button::new(RichText::new(text)).small()).on_hover_text(tip).clicked()
}

fn of_step(ui: &mut Ui, cx: &mut PanelContext) {
    let Some(replay) = cx.state.followed() else { return };
    let Some(step) = replay.last() else { return };
    let goal = Goal::Kind(step.kind());
    if button(ui, "Run to the next one", "Goes to the next step of this kind (5.2 to 6).") {
        cx.send(Command::Debug(DebugCommand::RunTo(goal, Forward)));
    }
    if let Some(condition) = Condition::for_step(&step, replay.trace()) {
        break_here(ui, cx, condition, "Stops playing and running at steps like this one.");
    }
}

/// Shows the button that adds a breakpoint; dimmed where there is such a breakpoint.
fn break_here(ui: &mut Ui, cx: &mut PanelContext, condition: Condition, tip: &str) {
    let settings = &cx.state.view.debug;
    let is_new = settings.breakpoints.iter().all(|breakpoint| breakpoint.condition != condition);
    let add = ui.add_enabled(is_new, Button::new("Break here").small()).on_hover_text(tip);
    if add.on_disabled_hover_text("There is such a breakpoint.").clicked() {
        let mut breakpoints = settings.breakpoints.clone();
        breakpoints.push(Breakpoint { enabled: true, condition });
        let settings = DebugSettings { breakpoints, ..settings.clone() };
        cx.send(Command::Debug(DebugCommand::Settings(settings)));
    }
}

/// Whether the debugger's cursor is about what the inspector shows. The cursor is the newest result's, and a region of the pinned result is
/// another one there.
fn has_cursor(cx: &PanelContext) -> bool {
    cx.state.debugger.replay.is_some() && !cx.state.shows_pinned()
}

fn of_pixel(ui: &mut Ui, cx: &mut PanelContext, pixel: PixelIndex) {
    if let Some(region) = cx.state.region_of(Item::Pixel(pixel))
        && button(ui, "Select its region", "Selects the region that the pixel is in.")
    {
        cx.send(Edit::Select(Some(Item::Region(region))));
    }
    if has_cursor(cx) {
        if button(ui, "Run to its next change", "Goes to the next decision about this pixel (J).") {
            cx.send(Command::Debug(DebugCommand::RunTo(Goal::Pixel(pixel), Forward)));
        }
        break_here(ui, cx, Condition::PixelChangesOwner(pixel), "Stops where the pixel changes its owner.");
    }
}

fn of_region(ui: &mut Ui, cx: &mut PanelContext, region: RegionId) {
    if button(ui, "Show its plane", "Shows the region's dichromatic plane (section 3.2).") {
        cx.act(Action::Show(Pane::Plane));
    }
    if let Some(shown) = cx.state.shown()
        && button(ui, "Mark its pixels", "Marks the pixels of the region.")
    {
        let mask = shown.labels().map(|&label| label == region.get());
        cx.send(Edit::Mark(Arc::new(mask), Combine::Replace, None));
    }
    let hypothesis = cx.state.debugger.names.hypotheses_of(region).next();
    if let Some(hypothesis) = hypothesis.filter(|_| has_cursor(cx))
        && button(ui, "Run to its next change", "Goes to the next decision about this region (J).")
    {
        cx.send(Command::Debug(DebugCommand::RunTo(Goal::Hypothesis(hypothesis), Forward)));
    }
    export(ui, cx, PixelSet::Region(region));
}

fn of_marked(ui: &mut Ui, cx: &mut PanelContext) {
    if button(ui, "Statistics", "Shows the statistics of the marked pixels.") {
        cx.act(Action::Show(Pane::Selection));
    }
    if button(ui, "Restrict to them", "Analyzes the marked pixels alone.") {
        cx.send(Edit::RestrictTo(cx.state.document.selection.marked.clone()));
    }
    export(ui, cx, PixelSet::Marked);
}

/// Shows the button that exports the pixels which the block is about.
fn export(ui: &mut Ui, cx: &mut PanelContext, pixels: PixelSet) {
    let tip = "Writes these pixels as a mask (.png), a table (.csv) or points (.ply); a mask is an area for `--area`.";
    if button(ui, "Export\u{2026}", tip) {
        cx.act(Action::ExportPixels(pixels));
    }
}

/// Subject, verdict, sentence and values, a line each.
fn as_text(found: &Inspection) -> String {
    let head = format!("{}: {} (section {})", found.subject, found.verdict, found.section);
    let of_region = found.of_region.iter().flat_map(|(_, tests)| tests);
    let tests = found
        .tests
        .iter()
        .chain(of_region)
        .map(|test| format!("{}: {}", if test.passed { "passed" } else { "failed" }, test.text()));
    let sentence = Some(found.sentence.clone()).filter(|sentence| !sentence.is_empty());
    std::iter::once(head).chain(sentence).chain(tests).collect::<Vec<_>>().join("\n")
}
