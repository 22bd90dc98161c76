//! The command palette: every action by its name, found by typing some of its letters, with its key.

use super::command_list::{Entry, entries};
use super::shortcuts::keys_of;
use super::theme::SMALL_PT;
use super::{PanelContext, dialog_room, widgets};
use egui::{Button, Id, Key, Modifiers, RichText, TextEdit, Ui};

/// Width of the list, points.
const WIDTH_PT: f32 = 420.0;

/// Height of the field over the list, points.
const FIELD_PT: f32 = 28.0;

/// Least and largest height of the list, points.
const LIST_PT: [f32; 2] = [40.0, 320.0];

/// Whether a name contains every word of a query, in any order and case.
fn matches(name: &str, query: &str) -> bool {
    let name = name.to_lowercase();
    query.to_lowercase().split_whitespace().all(|word| name.contains(word))
}

/// The palette: what was typed, and which of the found actions is chosen.
#[derive(Default)]
pub struct CommandPalette {
    is_open: bool,
    query: String,
    /// Index of the chosen action among the found ones.
    chosen: usize,
    /// Whether the field takes the focus in the next frame.
    focus: bool,
    /// The widget that had the focus before the palette opened, and has it again afterwards.
    focus_before: Option<Id>,
}

impl CommandPalette {
    /// Opens the palette, or closes it.
    pub fn toggle(&mut self, ctx: &egui::Context) {
        if self.is_open {
            return self.close(ctx);
        }
        let focus_before = ctx.memory(egui::Memory::focused);
        *self = Self { is_open: true, focus: true, focus_before, ..Self::default() };
    }

    /// Whether the palette is open. An open palette owns the keyboard.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Closes the palette, and gives the focus back.
    pub fn close(&mut self, ctx: &egui::Context) {
        if let Some(id) = self.focus_before.take() {
            ctx.memory_mut(|memory| memory.request_focus(id));
        }
        *self = Self::default();
    }

    /// Closes the palette on Escape and on a second Ctrl+P, before these keys reach anything else.
    pub fn close_on_keys(&mut self, ctx: &egui::Context) {
        let keys = [(Modifiers::NONE, Key::Escape), (Modifiers::COMMAND, Key::P)];
        if self.is_open
            && keys
                .into_iter()
                .any(|(modifiers, key)| ctx.input_mut(|input| input.consume_key(modifiers, key)))
        {
            self.close(ctx);
        }
    }

    /// Shows the palette, if it is open. The chosen action is carried out in the next frame.
    pub fn show(&mut self, ui: &Ui, cx: &mut PanelContext) {
        if !self.is_open {
            return;
        }
        let found: Vec<Entry> =
            entries().into_iter().filter(|entry| matches(&entry.name, &self.query)).collect();
        let [up, down, enter] = [Key::ArrowUp, Key::ArrowDown, Key::Enter]
            .map(|key| ui.ctx().input_mut(|input| input.count_and_consume_key(Modifiers::NONE, key)));
        let last = found.len().saturating_sub(1);
        // A slow frame can hold several presses of a key.
        self.chosen = (self.chosen + down).saturating_sub(up).min(last);
        let mut confirmed = found.get(self.chosen).filter(|_| enter > 0).map(|entry| entry.action);
        let is_moved = up + down > 0;
        let window = dialog_room::placed(egui::Window::new("Commands"), ui.ctx(), WIDTH_PT);
        let shown = window.show(ui.ctx(), |ui| {
            self.field(ui);
            if found.is_empty() {
                ui.label(RichText::new("No command has these letters.").color(cx.palette.secondary));
            }
            let room = (dialog_room::height(ui.ctx()) - FIELD_PT).clamp(LIST_PT[0], LIST_PT[1]);
            dialog_room::scrolling(ui, "commands", room, |ui| {
                for (index, entry) in found.iter().enumerate() {
                    let row = row(ui, entry, index == self.chosen);
                    if index == self.chosen && is_moved {
                        row.scroll_to_me(None);
                    }
                    if row.clicked() {
                        confirmed = Some(entry.action);
                    }
                }
            });
        });
        if let Some(shown) = &shown {
            // Tab stays inside the palette.
            ui.ctx().memory_mut(|memory| memory.set_modal_layer(shown.response.layer_id));
        }
        let is_left = shown.is_some_and(|shown| shown.response.clicked_elsewhere());
        if let Some(action) = confirmed {
            cx.act(action);
            self.close(ui.ctx());
        } else if is_left {
            // What was clicked may have taken the focus.
            *self = Self::default();
        }
    }

    /// Shows the field for the letters.
    fn field(&mut self, ui: &mut Ui) {
        let field = TextEdit::singleline(&mut self.query).id(Id::unique("query of the command palette"));
        let field = ui.add(field.desired_width(f32::INFINITY).hint_text("some letters of a command"));
        field.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, "Command"));
        if field.changed() {
            self.chosen = 0;
        }
        if std::mem::take(&mut self.focus) || !field.has_focus() {
            field.request_focus();
        }
    }
}

/// Shows an action with its key.
fn row(ui: &mut Ui, entry: &Entry, is_chosen: bool) -> egui::Response {
    let keys = RichText::new(keys_of(ui.ctx(), entry.action)).size(SMALL_PT);
    let button = Button::selectable(is_chosen, widgets::capitalized(&entry.name)).shortcut_text(keys);
    ui.add_sized(egui::vec2(ui.available_width(), 20.0), button.truncate())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::State;
    use crate::gui::action::Action;
    use crate::gui::menu::testing::shown_rows;
    use crate::gui::pane::Pane;
    use crate::gui::shortcuts::named_actions;
    use crate::view::{ArrangementKind, Layer};

    #[test]
    fn every_action_is_listed_once_under_a_name_of_its_own() {
        let entries = entries();
        for (index, entry) in entries.iter().enumerate() {
            let earlier = &entries[..index];
            assert!(earlier.iter().all(|other| other.action != entry.action), "{}", entry.name);
            assert!(earlier.iter().all(|other| other.name != entry.name), "{}", entry.name);
        }
        assert!(entries.iter().any(|entry| entry.action == Action::Show(Pane::Inspector)));
        assert!(entries.iter().any(|entry| entry.action == Action::Layer(Layer::Confidence)));
    }

    #[test]
    fn every_row_of_the_menus_and_every_key_is_listed() {
        let (shown, unnamed) = shown_rows(&State::default());
        let entries = entries();
        let keyed = named_actions().map(|(_, _, action)| action);
        let arrangements = ArrangementKind::ALL.map(Action::Arrange);
        let is_missing = |action: &Action| {
            let opens_a_list = matches!(action, Action::Palette | Action::Menus);
            !opens_a_list && entries.iter().all(|entry| entry.action != *action)
        };
        let missing: Vec<_> =
            shown.iter().copied().chain(keyed).chain(arrangements).filter(is_missing).collect();
        assert!(missing.is_empty(), "actions without an entry: {missing:?}");
        // Submenus, and the name of the photograph.
        let no_commands =
            ["Open recent", "Sample scenes", "Read as", "Presets of table 6", "Color space settings", ""];
        let forgotten: Vec<_> = unnamed.iter().filter(|name| !no_commands.contains(&name.as_str())).collect();
        assert!(forgotten.is_empty(), "rows without an action: {forgotten:?}");
        assert!(shown.len() > 60, "{}", shown.len());
    }

    #[test]
    fn words_are_found_in_any_order_and_case() {
        assert!(matches("Image: Body reflection", "refl body"));
        assert!(matches("Image: Body reflection", ""));
        assert!(!matches("Image: Body reflection", "body table"));
    }
}
