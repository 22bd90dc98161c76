//! The verdict under the picture: one sentence, each clause of which is a link to what the clause is about. While the debugger's
//! cursor is followed, the sentence about the step at the cursor.

use super::action::Action;
use super::glossary::Term;
use super::pane::Pane;
use super::theme::BODY_PT;
use super::{PanelContext, widgets};
use crate::app::{Edit, ViewCommand};
use crate::describe::Names;
use crate::trace::Replay;
use crate::view::{Clause, ClauseSubject, CubeSettings, ImageSettings, Item, Layer, ResultSnapshot, verdict};
use egui::{Label, Link, RichText, ScrollArea, Ui};

/// Shows the sentence about a result, in as many lines as needed.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot) {
    let clauses = verdict(shown);
    let last = clauses.len().saturating_sub(1);
    let texts: Vec<String> = clauses
        .iter()
        .enumerate()
        .map(|(index, clause)| {
            let text = if index == 0 { widgets::capitalized(&clause.text) } else { clause.text.clone() };
            text + if index == last { "." } else { ";" }
        })
        .collect();
    let font = egui::FontId::proportional(BODY_PT);
    let width =
        |text: &String| ui.painter().layout_no_wrap(text.clone(), font.clone(), cx.palette.text).size().x;
    // A clause is one widget and does not break into lines; where one is too long for that, each clause has lines of its own.
    let fits = texts.iter().map(width).all(|width| width <= ui.available_width());
    let contents = |ui: &mut Ui| {
        ui.spacing_mut().item_spacing = egui::vec2(5.0, 2.0);
        ui.spacing_mut().interact_size.y = 0.0;
        ui.style_mut().wrap_mode = fits.then_some(egui::TextWrapMode::Extend);
        for (clause, text) in clauses.iter().zip(texts) {
            show_clause(ui, cx, clause, text);
        }
    };
    if fits {
        ui.horizontal_wrapped(contents)
    } else {
        ui.vertical(contents)
    };
}

/// The sentence about the step at the debugger's cursor, computed once for each place of the cursor.
#[derive(Default)]
pub struct StepSentence {
    /// Generation of the trace, number of steps taken, and the sentence.
    shown: Option<(u64, usize, String)>,
}

impl StepSentence {
    /// Shows the sentence in place of the verdict, in the height of `ui`.
    pub fn show(&mut self, ui: &mut Ui, cx: &PanelContext, replay: &Replay) {
        let (generation, at) = (cx.state.debugger.generation, replay.at());
        let known = self.shown.as_ref().is_some_and(|(of, step, _)| (*of, *step) == (generation, at));
        if !known {
            let sentence = replay.last().map_or_else(
                || "Nothing is decided yet".to_owned(),
                |step| widgets::capitalized(&Names::of(replay.trace()).step(&step)),
            );
            self.shown = Some((generation, at, sentence));
        }
        let Some((_, _, sentence)) = &self.shown else { return };
        ScrollArea::vertical().max_height(ui.available_height()).show(ui, |ui| {
            ui.add(Label::new(RichText::new(sentence).size(BODY_PT)).wrap());
        });
    }
}

/// Shows one clause as a link.
fn show_clause(ui: &mut Ui, cx: &mut PanelContext, clause: &Clause, text: String) {
    let color = if clause.is_bad { cx.palette.warning } else { cx.palette.text };
    let link = ui.add(Link::new(RichText::new(text).size(BODY_PT).color(color)));
    if link.clicked() {
        go_to(cx, clause.subject);
    }
    if clause.subject == ClauseSubject::Regions {
        Term::Holds.card(link, cx.palette);
    } else {
        link.on_hover_text(tip(clause));
    }
}

/// What a click on a clause does.
fn tip(clause: &Clause) -> String {
    match clause.subject {
        ClauseSubject::Regions => "Shows the regions in the picture and in the table.".to_owned(),
        ClauseSubject::Region(region) => format!("Selects region {region}."),
        ClauseSubject::Light => "Shows the light's color in the color space (section 5.4).".to_owned(),
        ClauseSubject::Layer(Layer::Body) => {
            "Nearer to the ground truth than the photograph, peak signal to noise ratio. Shows the layer Body.".to_owned()
        }
        ClauseSubject::Layer(layer) => format!("Shows the layer {} in the picture.", layer.name()),
    }
}

/// Shows what a clause is about.
fn go_to(cx: &mut PanelContext, subject: ClauseSubject) {
    match subject {
        ClauseSubject::Regions => {
            show_layer(cx, Layer::Regions);
            cx.act(Action::Show(Pane::Regions));
        }
        ClauseSubject::Region(region) => {
            cx.send(Edit::Select(Some(Item::Region(region))));
            cx.act(Action::Show(Pane::Regions));
        }
        ClauseSubject::Light => {
            let cube = CubeSettings { show_illuminant: true, ..cx.state.view.cube.clone() };
            cx.send(ViewCommand::Cube(cube));
            cx.act(Action::Show(Pane::Colors));
        }
        ClauseSubject::Layer(layer) => show_layer(cx, layer),
    }
}

/// Shows a layer in the image view, in place of the first layer.
fn show_layer(cx: &mut PanelContext, layer: Layer) {
    let before = &cx.state.view.image;
    let arrangement = crate::view::Arrangement::Single;
    cx.send(ViewCommand::Image(ImageSettings { layer, arrangement, ..before.clone() }));
}
