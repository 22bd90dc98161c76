//! The why panel: the history of the selected pixel, of its hypothesis and of its region, and which changes of a
//! parameter would change the pixel's result.

use super::background_value::{BackgroundValue, SYNCHRONOUS_PX};
use super::glossary::Term;
use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::analysis::WhatIf;
use crate::app::{Command, DebugCommand, Edit, Question, WhatIfJob};
use crate::describe::what_if_sentence;
use crate::params::Setting;
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::view::{Amounts, PixelAmounts, ResultSnapshot, Why, WhySentence, why};
use egui::{FontId, Response, RichText, ScrollArea, Sense, Ui, Widget, WidgetInfo, pos2, vec2};
use std::sync::Arc;

/// Identity of the answers: generation of the trace, pixel, and hypothesis id.
type WhyKey = (u64, Option<PixelIndex>, Option<HypothesisId>);

/// The why panel: the answers that were computed last.
#[derive(Default)]
pub struct WhyPanel {
    show_answers: BackgroundValue<WhyKey, Why>,
}

impl WhyPanel {
    /// Shows the panel, for the selected pixel or region.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let debugger = &cx.state.debugger;
        let (Some(trace), Some(shown)) = (debugger.trace().cloned(), cx.state.newest.clone()) else {
            return not_recorded(ui, cx);
        };
        let pixel = cx.state.explained_pixel();
        let selected = cx.state.selected_region().filter(|_| pixel.is_none());
        let of_region = selected.and_then(|region| debugger.names.hypotheses_of(region).next());
        let hypothesis = debugger.chosen.filter(|_| pixel.is_none()).or(of_region);
        if pixel.is_none() && hypothesis.is_none() {
            let text =
                "Click a pixel or a region: its history appears here, and the reason for every refusal.";
            let frame = egui::Frame::new().inner_margin(12);
            frame.show(ui, |ui| widgets::placeholder(ui, cx.palette, text));
            return;
        }
        let (names, generation) = (Arc::clone(&debugger.names), debugger.generation);
        let synchronous = shown.labels().len() <= SYNCHRONOUS_PX;
        let key = (generation, pixel, hypothesis);
        let compute = move || why(&shown, &trace, &names, pixel, hypothesis);
        let Some(found) = self.show_answers.get(ui.ctx(), key, synchronous, compute) else { return };
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| show_answers(ui, cx, found));
        });
    }
}

/// Shows, while no decisions are recorded, a hint or the button that starts recording.
fn not_recorded(ui: &mut Ui, cx: &mut PanelContext) {
    if cx.state.picture.is_none() {
        return widgets::placeholder(
            ui,
            cx.palette,
            "Open a photograph, then click a pixel to learn why it is what it is.",
        );
    }
    if cx.state.view.debug.open {
        return widgets::placeholder(ui, cx.palette, "The decisions are being recorded\u{2026}");
    }
    ui.centered_and_justified(|ui| {
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
fn show_answers(ui: &mut Ui, cx: &mut PanelContext, found: &Why) {
    if let Some((pixel, history)) = &found.pixel {
        about_pixel(ui, cx, *pixel);
        show_sentences(ui, cx, history);
        what_if(ui, cx, *pixel);
    }
    if let Some((hypothesis, sentences)) = &found.hypothesis {
        let heading = widgets::heading(ui, cx.palette, &format!("Hypothesis {hypothesis}"));
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

/// Shows the pixel's position, color, region and kind.
fn about_pixel(ui: &mut Ui, cx: &PanelContext, pixel: PixelIndex) {
    let (Some(picture), Some(shown)) = (&cx.state.picture, &cx.state.newest) else { return };
    let [x, y] = pixel.position(picture.size().0);
    let color = picture.photo.image.pixels[pixel.index()];
    let region = RegionId::from_label(shown.labels()[pixel.index()]);
    ui.horizontal_wrapped(|ui| {
        widgets::chip(ui, cx.palette, widgets::own_color(color), "the pixel's color");
        ui.label(format!("Pixel {x}, {y}"));
        let [r, g, b] = color;
        ui.label(RichText::new(format!("{r:.0} {g:.0} {b:.0} counts")).color(cx.palette.secondary));
        let kind = shown.analysis.intrinsic.kinds[pixel.index()].name();
        let change = region.map_or_else(|| kind.to_owned(), |region| format!("region {region}, {kind}"));
        ui.label(change);
    });
    amounts(ui, cx, shown, pixel);
}

/// Shows the pixel's amounts of body and surface reflection in the result, and as measured where the two differ.
fn amounts(ui: &mut Ui, cx: &PanelContext, shown: &ResultSnapshot, pixel: PixelIndex) {
    let Some(amounts) = PixelAmounts::of(shown, pixel) else { return };
    let text = |of: &Amounts| {
        let counts = |value: f32| widgets::signed(f64::from(value), 1);
        let surface = of.surface.map_or_else(String::new, |surface| format!(", m_s {}", counts(surface)));
        format!("m_b {}{surface}", counts(of.body))
    };
    let mut sentence = format!("result {}", text(&amounts.result));
    if let Some(measured) = amounts.different_measured() {
        sentence = format!("{sentence}; measured {}, before the cut at noise", text(&measured));
    }
    ui.label(widgets::with_subscripts(&sentence, SMALL_PT, cx.palette.secondary));
}

/// Shows sentences, each a link that moves the cursor to the sentence's step.
fn show_sentences(ui: &mut Ui, cx: &mut PanelContext, sentences: &[WhySentence]) {
    if sentences.is_empty() {
        ui.label(RichText::new("nothing was decided about it").color(cx.palette.secondary));
    }
    let at = cx.state.debugger.replay.as_ref().map(crate::trace::Replay::at);
    for sentence in sentences {
        let is_current = at == Some(sentence.step + 1);
        let response = show_sentence(ui, cx, sentence, is_current);
        if response.on_hover_text("Go to this step.").clicked() {
            cx.send(Command::Debug(DebugCommand::Seek(sentence.step + 1)));
        }
    }
}

/// Width of the stage's name before a sentence, points.
const STAGE_PT: f32 = 58.0;
/// Indentation per level of the tree of merged hypotheses, points.
const INDENT_PT: f32 = 12.0;

/// Shows a sentence with its stage; `is_current` marks the sentence at the cursor.
fn show_sentence(ui: &mut Ui, cx: &PanelContext, sentence: &WhySentence, is_current: bool) -> Response {
    let width = ui.available_width();
    let left = STAGE_PT + INDENT_PT * sentence.depth as f32;
    let font = FontId::proportional(SMALL_PT);
    let color = if is_current { cx.palette.accent } else { cx.palette.text };
    let galley =
        ui.painter().layout(sentence.text.clone(), font.clone(), color, (width - left - 4.0).max(40.0));
    let size = vec2(width, galley.size().y + 4.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    if response.hovered() || response.has_focus() {
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
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Link, true, &sentence.text));
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
