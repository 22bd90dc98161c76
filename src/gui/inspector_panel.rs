//! The inspector: one panel for what is hovered, selected, marked or stepped to. Each thing has a block: the verdict first, then
//! each value against its threshold, the section, and what can be done. The history of the pixel or region follows.

mod actions;
mod answers;
mod block;
mod distances;
mod histograms;

use super::background_value::{BackgroundValue, SYNCHRONOUS_PX};
use super::cursor_owners::{CursorOwners, CursorPlace};
use super::{PanelContext, lacking_result, widgets};
use crate::app::State;
use crate::describe::Names;
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::view::{
    Inspection, Item, Why, histograms_at_cursor, inspect_beginning, inspect_item, inspect_item_at,
    inspect_marked, inspect_step, why,
};
use actions::Subject;
use egui::{Label, RichText, ScrollArea, Ui};
use std::sync::Arc;

/// Subject of the answers: address of the photograph, pixel, hypothesis, and selected region.
type WhySubject = (usize, Option<PixelIndex>, Option<HypothesisId>, Option<RegionId>);

/// Version of the findings about the marked pixels: generation of the result, address of the mask, and place of the debugger's cursor,
/// where that is followed.
type MarkedVersion = (u64, usize, Option<CursorPlace>);

/// Opacity of answers from the record of the result before.
const FAINT: f32 = 0.5;

/// The inspector, with the answers and findings that were computed last.
#[derive(Default)]
pub struct InspectorPanel {
    /// The version is the generation of the trace.
    show_answers: BackgroundValue<WhySubject, u64, Why>,
    /// The subject whose answers were asked for last.
    asked: Option<WhySubject>,
    /// The subject is the address of the photograph.
    marked: BackgroundValue<usize, MarkedVersion, Option<Inspection>>,
    owners: CursorOwners,
    /// The findings about the step at the cursor: generation of the trace, number of steps taken, findings.
    step: Option<(u64, usize, Option<Inspection>)>,
    /// The selected item whose block was shown last, and the height of that block, points. A hovered item keeps the height, so that nothing
    /// below moves with the pointer.
    selected_block: (Option<Item>, f32),
}

impl InspectorPanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        if cx.state.picture.is_none() {
            let text = "Open a photograph, then click a pixel to learn why it is what it is.";
            return widgets::placeholder(ui, cx.palette, text);
        }
        let step = self.inspected_step(cx.state);
        let (item, is_hovered) = inspected_item(cx.state);
        let found = item.and_then(|item| inspected(cx.state, item));
        let marked = self.inspected_marked(ui, cx.state);
        let has_answers = cx.state.explained_pixel().is_some()
            || cx.state.selected_region().is_some()
            || cx.state.debugger.chosen.is_some();
        if step.is_none() && found.is_none() && marked.is_none() && !has_answers {
            let text = "Click a pixel or a region: its verdict and its history appear here, and the reason for every refusal.";
            let frame = egui::Frame::new().inner_margin(12);
            frame.show(ui, |ui| lacking_result::placeholder(ui, cx, text));
            return;
        }
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                if let Some(step) = &step {
                    block::show(ui, cx, step, Subject::Step);
                    if let Some(searched) = cx.state.followed().and_then(histograms_at_cursor) {
                        histograms::show(ui, cx.palette, searched);
                    }
                }
                if let Some((item, found)) = item.zip(found.as_ref()) {
                    self.show_item(ui, cx, item, found, is_hovered);
                }
                if let Some(marked) = &marked {
                    block::show(ui, cx, marked, Subject::Marked);
                }
                self.show_history(ui, cx);
            });
        });
    }

    /// Shows the block of an item. A hovered item takes the height of the selected item.
    fn show_item(
        &mut self,
        ui: &mut Ui,
        cx: &mut PanelContext,
        item: Item,
        found: &Inspection,
        is_hovered: bool,
    ) {
        let selected = selected_item(cx.state);
        // The block of an item that is selected no more may be much higher than all that is shown now.
        let kept = if is_hovered && self.selected_block.0 == selected { self.selected_block.1 } else { 0.0 };
        let subject = if is_hovered { Subject::Hovered(item) } else { Subject::Selected(item) };
        let shown = ui.scope(|ui| {
            ui.set_min_height(kept);
            block::show(ui, cx, found, subject);
        });
        if !is_hovered {
            self.selected_block = (selected, shown.response.rect.height());
        }
    }

    /// The findings about the step at the cursor, where the cursor stands before the end; computed once for each place.
    fn inspected_step(&mut self, state: &State) -> Option<Inspection> {
        let (Some(replay), Some(shown)) = (state.followed(), &state.newest) else {
            self.step = None;
            return None;
        };
        let place = (state.debugger.generation, replay.at());
        if self.step.as_ref().is_none_or(|(generation, at, _)| (*generation, *at) != place) {
            let colors = &shown.analysis.working.image.pixels;
            let found = inspect_step(replay, &Names::of(replay.trace()), colors)
                .or_else(|| Some(inspect_beginning(replay.trace().len())));
            self.step = Some((place.0, place.1, found));
        }
        self.step.as_ref().and_then(|(_, _, found)| found.clone())
    }

    /// The findings about the marked pixels.
    fn inspected_marked(&mut self, ui: &Ui, state: &State) -> Option<Inspection> {
        let (mask, shown) = (state.document.selection.marked.clone()?, state.shown().cloned()?);
        let (place, cursor) = self.owners.get(state).unzip();
        let version = (shown.generation, Arc::as_ptr(&mask) as usize, place);
        let key = (Arc::as_ptr(&shown.picture) as usize, version);
        let synchronous = mask.len() <= SYNCHRONOUS_PX;
        let make = move || inspect_marked(&shown, &mask, cursor.as_deref());
        self.marked.get(ui.ctx(), key, synchronous, make).cloned().flatten()
    }

    /// Shows the history of the selected pixel or region.
    fn show_history(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let debugger = &cx.state.debugger;
        if cx.state.shows_pinned() {
            let text = "The history is that of the newest result, which the key A shows again.";
            ui.add(Label::new(RichText::new(text).color(cx.palette.secondary)).wrap());
            return;
        }
        let (Some(trace), Some(shown)) = (debugger.trace().cloned(), cx.state.newest.clone()) else {
            return answers::not_recorded(ui, cx);
        };
        let pixel = cx.state.explained_pixel();
        let picture = Arc::as_ptr(&shown.picture) as usize;
        if debugger.generation != shown.generation {
            return self.show_former_history(ui, cx, (picture, pixel));
        }
        let selected = cx.state.selected_region().filter(|_| pixel.is_none());
        let of_region = selected.and_then(|region| debugger.names.hypotheses_of(region).next());
        let hypothesis = debugger.chosen.filter(|_| pixel.is_none()).or(of_region);
        if pixel.is_none() && hypothesis.is_none() && selected.is_none() {
            return;
        }
        let (names, generation) = (Arc::clone(&debugger.names), debugger.generation);
        let synchronous = shown.labels().len() <= SYNCHRONOUS_PX;
        let subject = (picture, pixel, hypothesis, selected);
        self.asked = Some(subject);
        let key = (subject, generation);
        let compute = move || why(&shown, &trace, &names, pixel, hypothesis, selected);
        if let Some(found) = self.show_answers.get(ui.ctx(), key, synchronous, compute) {
            answers::show(ui, cx, found);
        }
    }

    /// Shows, while the decisions about a new result are being recorded, the answers from the record before, faint: numbers of regions differ
    /// between two results. `of`: the address of the photograph, and the pixel, that the answers must be about.
    fn show_former_history(&self, ui: &mut Ui, cx: &mut PanelContext, of: (usize, Option<PixelIndex>)) {
        let asked = self.asked.filter(|&(picture, pixel, ..)| (picture, pixel) == of);
        let former =
            asked.and_then(|subject| self.show_answers.known(&(subject, cx.state.debugger.generation)));
        match former {
            Some(found) => {
                ui.multiply_opacity(FAINT);
                answers::show(ui, cx, found);
            }
            None => answers::not_recorded(ui, cx),
        }
    }
}

/// The findings about an item: at the debugger's cursor where that is followed, otherwise in the result that is shown.
fn inspected(state: &State, item: Item) -> Option<Inspection> {
    match (state.followed(), &state.newest) {
        (Some(replay), Some(newest)) => inspect_item_at(replay, &state.debugger.names, newest, item),
        _ => inspect_item(state.shown()?, item),
    }
}

/// The item that the inspector is about: the hovered one, otherwise the clicked pixel or the selected item; and whether the item is
/// hovered.
fn inspected_item(state: &State) -> (Option<Item>, bool) {
    if state.hover.is_some() {
        return (state.hover, true);
    }
    (selected_item(state), false)
}

/// The clicked pixel, otherwise the selected item.
fn selected_item(state: &State) -> Option<Item> {
    state.explained_pixel().map(Item::Pixel).or(state.document.selection.item)
}
