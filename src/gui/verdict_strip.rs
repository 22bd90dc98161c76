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
use egui::text::LayoutJob;
use egui::{Align2, Area, FontId, Frame, Label, Link, Order, RichText, Sense, Ui};

/// Largest width of the sentence over the picture, points.
const OVER_PICTURE_PT: f32 = 520.0;
/// Gap between two clauses in a line, points.
const CLAUSE_GAP_PT: f32 = 5.0;
/// Gap between two lines of clauses, points.
const LINE_GAP_PT: f32 = 2.0;

/// Height of so many lines of the sentence, points.
pub fn height_of(ui: &Ui, rows: usize) -> f32 {
    let row_pt = ui.fonts_mut(|fonts| fonts.row_height(&FontId::proportional(BODY_PT)));
    rows as f32 * (row_pt + LINE_GAP_PT)
}

/// The clauses of the sentence about a result, with their texts.
fn clauses_with_texts(shown: &ResultSnapshot) -> (Vec<Clause>, Vec<String>) {
    let clauses = verdict(shown);
    let last = clauses.len().saturating_sub(1);
    let texts = clauses.iter().enumerate().map(|(index, clause)| {
        let text = if index == 0 { widgets::capitalized(&clause.text) } else { clause.text.clone() };
        text + if index == last { "." } else { ";" }
    });
    let texts = texts.collect();
    (clauses, texts)
}

/// Shows the sentence about a result in at most `rows` lines. What does not fit is shown over the picture, while the pointer or the focus of
/// the keyboard is on the lines or on the whole sentence.
pub fn show_within(ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot, rows: usize) {
    let (clauses, texts) = clauses_with_texts(shown);
    if rows_needed(ui, &texts) <= rows {
        return show(ui, cx, shown);
    }
    let is_bad = clauses.iter().any(|clause| clause.is_bad);
    let color = if is_bad { cx.palette.warning } else { cx.palette.text };
    let font = FontId::proportional(BODY_PT);
    let mut job = LayoutJob::simple(texts.join(" "), font, color, ui.available_width());
    job.wrap.max_rows = rows;
    let label = Label::new(job).show_tooltip_when_elided(false).selectable(false).sense(Sense::click());
    let lines = ui.add(label);
    let id = ui.scope_id().with("whole verdict");
    let area_before = ui.ctx().memory(|memory| memory.area_rect(id));
    let was_shown = ui.data(|data| data.get_temp::<bool>(id)).unwrap_or(false);
    let pointer = ui.ctx().pointer_hover_pos().filter(|_| was_shown);
    let is_over = pointer.zip(area_before).is_some_and(|(at, area)| area.expand(2.0).contains(at));
    let is_shown = lines.hovered() || lines.has_focus() || is_over;
    ui.data_mut(|data| data.insert_temp(id, is_shown));
    if !is_shown {
        return;
    }
    let area = Area::new(id).order(Order::Middle).pivot(Align2::LEFT_BOTTOM);
    area.fixed_pos(lines.rect.left_bottom() + egui::vec2(-8.0, 4.0)).constrain(true).show(ui.ctx(), |ui| {
        Frame::popup(ui.style()).show(ui, |ui| {
            ui.set_max_width(OVER_PICTURE_PT.min(lines.rect.width().max(240.0)));
            show(ui, cx, shown);
        });
    });
}

/// Number of lines that the clauses need in the available width.
fn rows_needed(ui: &Ui, texts: &[String]) -> usize {
    let (full, mut rows, mut left) = (ui.available_width(), 0, 0.0);
    let widths: Vec<f32> = texts.iter().map(|text| clause_width(ui, text)).collect();
    if widths.iter().any(|&width| width > full) {
        let font = FontId::proportional(BODY_PT);
        let rows_of = |text: &String| {
            let job = LayoutJob::simple(text.clone(), font.clone(), egui::Color32::WHITE, full);
            ui.painter().layout_job(job).rows.len()
        };
        return texts.iter().map(rows_of).sum();
    }
    for width in widths {
        if width > left {
            (rows, left) = (rows + 1, full);
        }
        left -= width + CLAUSE_GAP_PT;
    }
    rows
}

/// Width of a clause in one line, points.
fn clause_width(ui: &Ui, text: &str) -> f32 {
    let font = FontId::proportional(BODY_PT);
    ui.painter().layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE).size().x
}

/// Shows the sentence about a result, in as many lines as needed.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot) {
    let (clauses, texts) = clauses_with_texts(shown);
    // A clause is one widget and does not break into lines; where one is too long for that, each clause has lines of its own.
    let fits = texts.iter().all(|text| clause_width(ui, text) <= ui.available_width());
    let contents = |ui: &mut Ui| {
        for (clause, text) in clauses.iter().zip(texts) {
            show_clause(ui, cx, shown, clause, text);
        }
    };
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = egui::vec2(CLAUSE_GAP_PT, LINE_GAP_PT);
        // A line is as high as its letters.
        ui.spacing_mut().interact_size.y = 0.0;
        ui.style_mut().wrap_mode = fits.then_some(egui::TextWrapMode::Extend);
        if fits { ui.horizontal_wrapped(contents) } else { ui.vertical(contents) }
    });
}

/// The sentence about the step at the debugger's cursor, computed once for each place of the cursor.
#[derive(Default)]
pub struct StepSentence {
    /// Generation of the trace, number of steps taken, and the sentence.
    shown: Option<(u64, usize, String)>,
}

impl StepSentence {
    /// Shows the sentence in place of the verdict, in the height of `ui`; what does not fit is in the tooltip.
    pub fn show(&mut self, ui: &mut Ui, cx: &PanelContext, replay: &Replay) {
        let (generation, at) = (cx.state.debugger.generation, replay.at());
        let known = self.shown.as_ref().is_some_and(|(of, step, _)| (*of, *step) == (generation, at));
        if !known {
            let sentence = replay.last().map_or_else(
                || "Nothing is decided yet".to_owned(),
                |step| widgets::unbroken(&widgets::capitalized(&Names::of(replay.trace()).step(&step))),
            );
            self.shown = Some((generation, at, sentence));
        }
        let Some((_, _, sentence)) = &self.shown else { return };
        let (font, color) = (FontId::proportional(BODY_PT), cx.palette.text);
        let row_pt = ui.fonts_mut(|fonts| fonts.row_height(&font));
        let mut job = LayoutJob::simple(sentence.clone(), font, color, ui.available_width());
        // As many whole rows as there is height for: a row is not cut through its letters.
        job.wrap.max_rows = ((ui.available_height() / row_pt) as usize).max(1);
        ui.add(Label::new(job).show_tooltip_when_elided(false)).on_hover_text(sentence);
    }
}

/// Shows one clause as a link.
fn show_clause(ui: &mut Ui, cx: &mut PanelContext, shown: &ResultSnapshot, clause: &Clause, text: String) {
    let color = if clause.is_bad { cx.palette.warning } else { cx.palette.text };
    let link = ui.add(Link::new(RichText::new(text).size(BODY_PT).color(color)));
    if link.clicked() {
        go_to(cx, clause.subject, shown);
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

/// Shows what a clause about a result is about.
fn go_to(cx: &mut PanelContext, subject: ClauseSubject, shown: &ResultSnapshot) {
    match subject {
        ClauseSubject::Regions => {
            show_layer(cx, Layer::Regions);
            cx.act(Action::Show(Pane::Regions));
        }
        ClauseSubject::Region(region) => {
            // The regions of a preview have other numbers than those of the result, in which the region is selected.
            let selected =
                if shown.is_of_working_picture() { cx.state.region_of_preview(region) } else { Some(region) };
            if let Some(region) = selected {
                cx.send(Edit::Select(Some(Item::Region(region))));
            }
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
