//! The history panel: every step of undo and redo in words, the present one marked; a click goes there.

use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::{Document, Edit, document_change};
use egui::accesskit::Role;
use egui::{Align, Button, Key, RichText, ScrollArea, Ui, WidgetInfo};

/// The history panel, with the sentences computed last.
#[derive(Default)]
pub struct HistoryPanel {
    /// Number of entries, index of the present one, the present document, and the sentences.
    shown: Option<(usize, usize, Document, Vec<String>)>,
    /// Index of the present entry in the last frame; the list scrolls to the present entry where the index changed.
    present: Option<usize>,
}

impl HistoryPanel {
    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let Some(picture) = &cx.state.picture else {
            let text = "The steps that can be undone appear here when a photograph is open.";
            return widgets::placeholder(ui, cx.palette, text);
        };
        let (entries, present) = cx.state.history.entries(&cx.state.document);
        let document = &cx.state.document;
        let is_known = self
            .shown
            .as_ref()
            .is_some_and(|(len, at, shown, _)| (*len, *at) == (entries.len(), present) && shown == document);
        if !is_known {
            let width = picture.size().0;
            let changes = entries.windows(2).map(|pair| document_change(pair[0], pair[1], width));
            let sentences = std::iter::once(format!("{} opened", picture.origin.name())).chain(changes);
            self.shown = Some((entries.len(), present, document.clone(), sentences.collect()));
        }
        let has_moved = self.present.replace(present) != Some(present);
        let Some((.., sentences)) = &self.shown else { return };
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(8).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 1.0;
                for (index, sentence) in sentences.iter().enumerate() {
                    let response = entry(ui, cx, sentence, index, present);
                    if index == present && has_moved {
                        response.scroll_to_me(Some(Align::Center));
                    }
                    if let Some(target) = target(ui, &response, index, sentences.len()) {
                        cx.send(Edit::GoTo(target));
                    }
                }
            });
        });
    }
}

/// Shows an entry of the list.
fn entry(ui: &mut Ui, cx: &PanelContext, sentence: &str, index: usize, present: usize) -> egui::Response {
    // Undone steps are dimmed.
    let tone = if index > present { cx.palette.secondary } else { cx.palette.text };
    let text = RichText::new(format!("{index}  {}", widgets::unbroken(sentence))).size(SMALL_PT).color(tone);
    let button =
        Button::selectable(index == present, text).wrap().min_size(egui::vec2(ui.available_width(), 0.0));
    let response = ui.add(button);
    let is_present = index == present;
    let name = format!("Step {index}: {sentence}");
    response.widget_info(|| WidgetInfo::selected(Role::ListBoxOption, true, is_present, name.clone()));
    let tip = match index.cmp(&present) {
        std::cmp::Ordering::Less => "Go back to right after this step.",
        std::cmp::Ordering::Equal => "The present state.",
        std::cmp::Ordering::Greater => "This step was undone; go on to right after it.",
    };
    response.on_hover_text(tip)
}

/// The entry that a click on an entry, or an arrow key while the entry has the focus, goes to.
fn target(ui: &Ui, response: &egui::Response, index: usize, len: usize) -> Option<usize> {
    if response.clicked() {
        return Some(index);
    }
    if !response.has_focus() {
        return None;
    }
    // A slow frame can hold several presses of a key.
    let presses = |key| ui.input(|input| input.num_presses(key));
    let target =
        (index + presses(Key::ArrowDown)).saturating_sub(presses(Key::ArrowUp)).min(len.saturating_sub(1));
    (target != index).then_some(target)
}
