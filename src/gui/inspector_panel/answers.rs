//! The history of the selected pixel, of its hypothesis and of its region, and which changes of a parameter would change the
//! pixel's result.

use crate::analysis::WhatIf;
use crate::app::{Command, DebugCommand, Edit, Question, WhatIfJob};
use crate::describe::what_if_sentence;
use crate::gui::glossary::Term;
use crate::gui::theme::SMALL_PT;
use crate::gui::{PanelContext, widgets};
use crate::params::Setting;
use crate::raster::PixelIndex;
use crate::view::{Why, WhySentence};
use egui::{FontId, Response, RichText, Sense, Ui, Widget, WidgetInfo, pos2, vec2};
use std::cmp::Ordering;
use std::sync::Arc;

/// Shows, while no decisions are recorded, a hint or the button that starts recording.
pub fn not_recorded(ui: &mut Ui, cx: &mut PanelContext) {
    if cx.state.view.debug.open {
        let text = "The decisions are being recorded\u{2026}";
        ui.label(RichText::new(text).color(cx.palette.secondary));
        return;
    }
    ui.vertical(|ui| {
        let record = egui::Button::new("Record the decisions").ui(ui);
        if record
            .on_hover_text("Keeps every decision of the analysis, so that each can be asked for.")
            .clicked()
        {
            let settings = crate::app::DebugSettings { open: true, ..cx.state.view.debug.clone() };
            cx.send(Command::Debug(DebugCommand::Settings(settings)));
        }
    });
}

/// Shows the histories of pixel, hypothesis and region.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, found: &Why) {
    if let Some((pixel, history)) = &found.pixel {
        what_if(ui, cx, *pixel);
        let [x, y] = pixel.position(found_width(cx));
        let heading = widgets::heading(ui, cx.palette, &format!("History of pixel {x}, {y}"));
        heading.on_hover_text("What was decided about the pixel, newest first; each line leads to its step.");
        show_sentences(ui, cx, history);
    }
    if let Some((hypothesis, sentences)) = &found.hypothesis {
        let of = cx.state.debugger.names.region_of(*hypothesis);
        let of = of.map_or_else(String::new, |region| format!(", region {region}"));
        let heading = widgets::heading(ui, cx.palette, &format!("Hypothesis {hypothesis}{of}"));
        Term::Hypothesis.card(heading, cx.palette);
        show_sentences(ui, cx, sentences);
    }
    if let Some((number, sentences)) = &found.region {
        let heading = widgets::heading(ui, cx.palette, &format!("Region {number} is made of"));
        heading.on_hover_text(
            "The hypotheses, absorptions and merges that made it, each under what it became part of.",
        );
        show_sentences(ui, cx, sentences);
    }
}

/// Number of columns of the photograph.
fn found_width(cx: &PanelContext) -> usize {
    cx.state.picture.as_ref().map_or(1, |picture| picture.size().0)
}

/// What the pointer tells of a sentence of the second look.
const OF_SECOND_LOOK_TIP: &str = "Decided in the finer picture of a patch that the working picture leaves unexplained. The timeline \
     shows the steps of the working picture alone.";

/// Shows sentences, each a link that moves the cursor to the sentence's step, if that is a step of the trace.
fn show_sentences(ui: &mut Ui, cx: &mut PanelContext, sentences: &[WhySentence]) {
    if sentences.is_empty() {
        ui.label(RichText::new("nothing was decided about it").color(cx.palette.secondary));
    }
    let at = cx.state.debugger.replay.as_ref().map(crate::trace::Replay::at);
    for sentence in sentences {
        let place = match (at, sentence.step) {
            (Some(at), Some(step)) => (step + 1).cmp(&at),
            _ => Ordering::Less,
        };
        let response = show_sentence(ui, cx, sentence, place);
        let Some(step) = sentence.step else {
            response.on_hover_text(OF_SECOND_LOOK_TIP);
            continue;
        };
        if response.on_hover_text("Go to this step.").clicked() {
            cx.send(Command::Debug(DebugCommand::Seek(step + 1)));
        }
    }
}

/// Width of the stage's name before a sentence, points.
const STAGE_PT: f32 = 58.0;
/// Indentation per level of the tree of merged hypotheses, points.
const INDENT_PT: f32 = 12.0;

/// Shows a sentence with its stage. `place`: whether its step lies before, at or after the cursor; the sentence at the cursor is marked, those
/// after it are faint.
fn show_sentence(ui: &mut Ui, cx: &PanelContext, sentence: &WhySentence, place: Ordering) -> Response {
    let is_current = place == Ordering::Equal;
    let width = ui.available_width();
    let left = STAGE_PT + INDENT_PT * sentence.depth as f32;
    let font = FontId::proportional(SMALL_PT);
    let color = match place {
        Ordering::Less => cx.palette.text,
        Ordering::Equal => cx.palette.accent,
        Ordering::Greater => cx.palette.secondary,
    };
    let text = widgets::unbroken(&sentence.text);
    let galley = ui.painter().layout(text, font.clone(), color, (width - left - 4.0).max(40.0));
    let size = vec2(width, galley.size().y + 4.0);
    let (sense, role) = match sentence.step {
        Some(_) => (Sense::click(), egui::accesskit::Role::Link),
        None => (Sense::hover(), egui::accesskit::Role::Label),
    };
    let (rect, response) = ui.allocate_exact_size(size, sense);
    if sentence.step.is_some() && (response.hovered() || response.has_focus()) {
        ui.painter().rect_filled(rect, 2.0, cx.palette.line);
    }
    if is_current {
        let bar = egui::Rect::from_min_size(rect.min, vec2(2.0, rect.height()));
        ui.painter().rect_filled(bar, 0.0, cx.palette.accent);
    }
    let top = rect.top() + 2.0;
    let stage = ui.painter().layout_no_wrap(sentence.stage.name().to_owned(), font, cx.palette.secondary);
    ui.painter().galley(pos2(rect.left() + 6.0, top), stage, cx.palette.secondary);
    ui.painter().galley(pos2(rect.left() + left, top), galley, color);
    response.widget_info(|| WidgetInfo::labeled(role, true, &sentence.text));
    response
}

/// Shows how far each parameter would have to move for the pixel's result to change, the progress of that search, or
/// the button that starts the search.
fn what_if(ui: &mut Ui, cx: &mut PanelContext, pixel: PixelIndex) {
    let heading = widgets::heading(ui, cx.palette, "What if");
    heading.on_hover_text(
        "How far each parameter would have to move for this pixel to end otherwise, tried by analyzing again.",
    );
    let what_if_job = cx.state.what_if_job.as_ref().filter(|what_if_job| what_if_job.request.pixel == pixel);
    match what_if_job {
        None => {
            let ask = ui.button("Find what would change it");
            let ask =
                ask.on_hover_text("Analyses the picture again and again, each parameter moved up and down.");
            if ask.clicked() {
                cx.send(Command::Ask(Question::WhatIf(Some(pixel))));
            }
        }
        Some(WhatIfJob { found: None, done, total, .. }) => {
            let share = *done as f32 / (*total).max(1) as f32;
            ui.horizontal(|ui| {
                ui.add(egui::ProgressBar::new(share).desired_width(160.0));
                if ui.button("Stop").clicked() {
                    cx.send(Command::Ask(Question::WhatIf(None)));
                }
            });
        }
        Some(WhatIfJob { found: Some(found), .. }) => {
            let found = Arc::clone(found);
            alternatives(ui, cx, &found);
        }
    }
}

/// Shows the changes of parameters that were found, each a link that sets the parameter.
fn alternatives(ui: &mut Ui, cx: &mut PanelContext, found: &[WhatIf]) {
    if found.is_empty() {
        let text = "No value of any single parameter that was tried changes what this pixel is.";
        ui.label(RichText::new(text).color(cx.palette.secondary));
    }
    for what_if in found {
        let text = what_if_sentence(what_if);
        let origin = if what_if.predicted { "from the recorded numbers" } else { "by search" };
        let hover =
            format!("Found {origin}, and confirmed by analyzing again. Click to set the parameter so.");
        let link = egui::Link::new(RichText::new(text).size(SMALL_PT));
        if ui.add(link).on_hover_text(hover).clicked() {
            cx.send(Edit::SetParameter(what_if.parameter, Setting::Value(what_if.at), None));
        }
    }
}
