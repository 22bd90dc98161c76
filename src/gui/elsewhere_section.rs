//! The part of the comparison panel about another program's label map and diffuse picture: how they agree with the result, and the scores
//! of both against the ground truth.

use super::action::Action;
use super::background_value::{BackgroundValue, SYNCHRONOUS_PX};
use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::ViewCommand;
use crate::view::{
    Elsewhere, ElsewhereKind, Held, HeldFigure, ImageSettings, Layer, LayerNeed, ResultSnapshot,
    held_against, label_count,
};
use egui::{Grid, Label, RichText, Ui};
use std::sync::{Arc, Weak};

/// What the figures belong to: the pictures, the result, and whether the result's accuracy was measured.
#[derive(Clone)]
struct HeldKey {
    elsewhere: Weak<Elsewhere>,
    shown: Weak<ResultSnapshot>,
    is_measured: bool,
}

impl PartialEq for HeldKey {
    fn eq(&self, other: &Self) -> bool {
        Weak::ptr_eq(&self.elsewhere, &other.elsewhere)
            && Weak::ptr_eq(&self.shown, &other.shown)
            && self.is_measured == other.is_measured
    }
}

/// The figures that were computed last.
#[derive(Default)]
pub struct ElsewhereSection {
    /// The subject is the address of the pictures.
    held: BackgroundValue<usize, HeldKey, Result<Held, String>>,
}

impl ElsewhereSection {
    /// Shows the part: the files with buttons for their layers, and the tables.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        widgets::heading(ui, cx.palette, "Another program's result");
        let Some(elsewhere) = cx.state.elsewhere.clone() else { return hint(ui, cx) };
        for kind in ElsewhereKind::ALL {
            file(ui, cx, &elsewhere, kind);
        }
        let Some(shown) = cx.state.shown().filter(|shown| shown.stale_from.is_none()).cloned() else {
            return;
        };
        let subject = Arc::as_ptr(&elsewhere) as usize;
        let version = HeldKey {
            elsewhere: Arc::downgrade(&elsewhere),
            shown: Arc::downgrade(&shown),
            is_measured: shown.accuracy().is_some(),
        };
        let synchronous = shown.labels().len() <= SYNCHRONOUS_PX;
        let hold = move || held_against(&elsewhere, &shown).map_err(|error| error.to_string());
        match self.held.get(ui.ctx(), (subject, version), synchronous, hold) {
            None => drop(ui.label(secondary(cx, "comparing\u{2026}"))),
            Some(Err(reason)) => drop(ui.label(RichText::new(reason).color(cx.palette.error))),
            Some(Ok(held)) => {
                table(ui, cx, "agreement with this result", &held.agreement);
                if !held.scores.is_empty() {
                    table(ui, cx, "compared with the ground truth", &held.scores);
                }
            }
        }
    }
}

/// Shows what the part is for, and the buttons that open files.
fn hint(ui: &mut Ui, cx: &mut PanelContext) {
    ui.label(secondary(
        cx,
        "A label map or a diffuse picture of another program is compared with this result.",
    ));
    ui.horizontal_wrapped(|ui| {
        for (kind, text) in [
            (ElsewhereKind::Labels, "Open a label map\u{2026}"),
            (ElsewhereKind::Diffuse, "Open a diffuse picture\u{2026}"),
        ] {
            if ui.add_enabled(cx.state.picture.is_some(), egui::Button::new(text)).clicked() {
                cx.act(Action::OpenElsewhere(kind));
            }
        }
    });
}

/// Shows the file of a kind with the buttons of its layers, or the button that opens one.
fn file(ui: &mut Ui, cx: &mut PanelContext, elsewhere: &Elsewhere, kind: ElsewhereKind) {
    ui.horizontal_wrapped(|ui| {
        let Some(path) = elsewhere.paths.get(kind) else {
            if ui.button(format!("Open a {}\u{2026}", kind.name())).clicked() {
                cx.act(Action::OpenElsewhere(kind));
            }
            return;
        };
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let count = elsewhere.pictures.labels.as_ref().filter(|_| kind == ElsewhereKind::Labels);
        let count = count.map_or_else(String::new, |labels| {
            format!(", {}", crate::describe::counted(label_count(labels), "label"))
        });
        ui.label(format!("{} {name}{count}", kind.name())).on_hover_text(path.display().to_string());
        let layers = Layer::ALL.into_iter().filter(|layer| layer.need() == Some(LayerNeed::Elsewhere(kind)));
        for layer in layers {
            let is_shown = cx.state.view.image.layer == layer;
            if ui.selectable_label(is_shown, layer.name()).on_hover_text(layer.tip()).clicked() {
                cx.send(ViewCommand::Image(ImageSettings { layer, ..cx.state.view.image.clone() }));
            }
        }
        if ui
            .button("Close")
            .on_hover_text(format!("No longer compare this {} with results.", kind.name()))
            .clicked()
        {
            cx.send(ViewCommand::CloseElsewhere(kind));
        }
    });
}

/// Shows figures of the other program, of the result and of doing nothing.
fn table(ui: &mut Ui, cx: &PanelContext, title: &str, figures: &[HeldFigure]) {
    ui.add_space(4.0);
    let width = widgets::width_of_names(ui.available_width(), 3);
    Grid::new(title).num_columns(4).spacing([14.0, 2.0]).show(ui, |ui| {
        for title in [title, "other program", "this result", "doing nothing"] {
            ui.label(secondary(cx, title));
        }
        ui.end_row();
        for figure in figures {
            widgets::figure_name(ui, width, figure.words);
            for value in [figure.elsewhere, figure.result, figure.nothing] {
                ui.add(Label::new(
                    value.map_or_else(|| "\u{2013}".to_owned(), |value| text(value, figure.words.unit)),
                ));
            }
            ui.end_row();
        }
    });
}

/// A figure with the digits that its unit deserves.
fn text(value: f64, unit: &str) -> String {
    match unit {
        "dB" | "%" => format!("{value:.1}"),
        _ if value.fract() == 0.0 && value.abs() > 1.0 => format!("{value:.0}"),
        _ => format!("{value:.3}"),
    }
}

/// Small text in the secondary color.
fn secondary(cx: &PanelContext, text: &str) -> RichText {
    RichText::new(text).size(SMALL_PT).color(cx.palette.secondary)
}
