//! The list of the named marks in the selection panel: each with color, name, number of pixels, and buttons.

use super::theme::SMALL_PT;
use super::{PanelContext, widgets};
use crate::app::{Edit, NamedMarkEdit};
use egui::accesskit::Role;
use egui::{Button, RichText, TextEdit, Ui, WidgetInfo};

/// The name that is being typed: index of the mark, and the text.
#[derive(Default)]
pub struct NamedMarksList {
    typed: Option<(usize, String)>,
}

impl NamedMarksList {
    /// Shows the list, and the button that keeps the marked pixels under a name.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let selection = &cx.state.document.selection;
        let named = std::sync::Arc::clone(&selection.named);
        let can_keep = selection.marked.is_some() && named.active.is_none();
        if named.marks.is_empty() && !can_keep {
            return;
        }
        ui.horizontal_wrapped(|ui| {
            let keep = ui.add_enabled(can_keep, Button::new("Keep as a named mark").small());
            let tip =
                "Keeps the marked pixels under a name and in a color of their own; saved with the workspace.";
            if keep.on_hover_text(tip).on_disabled_hover_text("Mark pixels with a tool first.").clicked() {
                cx.send(Edit::NamedMark(NamedMarkEdit::Keep));
            }
            if named.active.is_some() {
                let tip = "The tools leave the mark as it is and mark anew.";
                if ui.small_button("Mark something else").on_hover_text(tip).clicked() {
                    cx.send(Edit::NamedMark(NamedMarkEdit::Release));
                }
            }
        });
        for index in 0..named.marks.len() {
            ui.push_id(("named mark", index), |ui| ui.horizontal(|ui| self.row(ui, cx, index)));
        }
        ui.add_space(4.0);
    }

    /// Shows one mark.
    fn row(&mut self, ui: &mut Ui, cx: &mut PanelContext, index: usize) {
        let named = &cx.state.document.selection.named;
        let Some(mark) = named.marks.get(index).cloned() else { return };
        let is_active = named.active == Some(index);
        let chip =
            widgets::chip(ui, cx.palette, widgets::color(mark.color), &format!("color of {}", mark.name));
        let chip = chip.interact(egui::Sense::click());
        chip.widget_info(|| {
            WidgetInfo::labeled(Role::Button, true, format!("Another color for {}", mark.name))
        });
        if chip.on_hover_text("Another color.").clicked() {
            cx.send(Edit::NamedMark(NamedMarkEdit::Recolor(index)));
        }
        let mut name = match &self.typed {
            Some((typed, text)) if *typed == index => text.clone(),
            _ => mark.name.clone(),
        };
        let field = ui.add(TextEdit::singleline(&mut name).desired_width(110.0));
        field.widget_info(|| {
            WidgetInfo::labeled(Role::TextInput, true, format!("Name of mark {}", index + 1))
        });
        if field.has_focus() {
            self.typed = Some((index, name.clone()));
        }
        if field.lost_focus() {
            self.typed = None;
            let name = name.trim().to_owned();
            if !name.is_empty() && name != mark.name {
                cx.send(Edit::NamedMark(NamedMarkEdit::Rename(index, name)));
            }
        }
        let count = format!("{} px", crate::describe::grouped(mark.pixels));
        ui.label(RichText::new(count).size(SMALL_PT).color(cx.palette.secondary));
        let edit = ui.add(Button::selectable(is_active, format!("Edit {}", mark.name)).small());
        let tip = "The tools change the outline of this mark: Shift adds, Alt takes away.";
        if edit.on_hover_text(tip).clicked() {
            let edit = if is_active { NamedMarkEdit::Release } else { NamedMarkEdit::Activate(index) };
            cx.send(Edit::NamedMark(edit));
        }
        let remove = ui.small_button("\u{d7}");
        remove.widget_info(|| WidgetInfo::labeled(Role::Button, true, format!("Remove {}", mark.name)));
        if remove.on_hover_text("Removes this mark (Ctrl+Z brings it back).").clicked() {
            cx.send(Edit::NamedMark(NamedMarkEdit::Remove(index)));
        }
    }
}
