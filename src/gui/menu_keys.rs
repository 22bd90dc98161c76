//! The menu bar by the keyboard: F10, and Alt with the first letter of a menu, open menus; the arrow keys to the left and right go on
//! to the next menu. Within a menu, egui moves the focus by the arrow keys.

use super::popup_scroll::{menu_button, scrolling, scrolling_within};
use egui::containers::menu::{MenuButton, MenuConfig, MenuState, SubMenuButton, is_in_menu};
use egui::{Context, FocusDirection, Id, Key, Memory, Modifiers, Popup, PopupCloseBehavior, Ui};

/// Height of what lies between the bar and the last row of a menu that is as high as the window, points.
const BELOW_BAR_PT: f32 = 24.0;

/// The menu bar's state between frames.
#[derive(Default)]
pub struct MenuKeys {
    /// Popups and buttons of the menus of the last frame, from left to right.
    menus: Vec<Menu>,
    /// Whether a key opened the menu that is open.
    is_open_by_key: bool,
    /// The widget that had the focus before a key opened the menu.
    focus_before: Option<Id>,
}

/// A menu of the bar.
struct Menu {
    popup: Id,
    button: Id,
    first_letter: Option<Key>,
}

/// What a key does to the menu bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum BarStep {
    /// Opens a menu, by its index.
    Open(usize),
    /// Closes the open menu.
    Close,
}

impl MenuKeys {
    /// Takes the keys of the menu bar, before the bar is shown, unless a text is being edited.
    pub fn handle(&mut self, ctx: &Context) {
        let open = self.menus.iter().position(|menu| Popup::is_id_open(ctx, menu.popup));
        if open.is_none() {
            self.give_focus_back(ctx);
        }
        if ctx.text_edit_focused() {
            return;
        }
        match self.pressed(ctx, open) {
            Some(BarStep::Open(index)) => self.open(ctx, index),
            Some(BarStep::Close) => Popup::close_all(ctx),
            None => {}
        }
    }

    /// Opens the first menu, or closes the open one.
    pub fn toggle(&mut self, ctx: &Context) {
        if self.is_open(ctx) {
            Popup::close_all(ctx);
        } else {
            self.open(ctx, 0);
        }
    }

    /// Whether a menu of the bar is open.
    pub fn is_open(&self, ctx: &Context) -> bool {
        self.menus.iter().any(|menu| Popup::is_id_open(ctx, menu.popup))
    }

    /// Begins a frame, in which [`MenuKeys::menu`] shows each menu.
    pub fn begin(&mut self) {
        self.menus.clear();
    }

    /// Shows a menu of the bar.
    pub fn menu(&mut self, ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
        // The menu lies below its bar.
        let room = ui.ctx().content_rect().bottom() - ui.max_rect().bottom() - BELOW_BAR_PT;
        let (response, _) = MenuButton::new(name).ui(ui, |ui| scrolling_within(ui, room, content));
        let first_letter = name.get(..1).and_then(Key::from_name);
        self.menus.push(Menu {
            popup: Popup::default_response_id(&response),
            button: response.id,
            first_letter,
        });
    }

    /// Closes the menu whose entry was chosen by Enter or Space; egui closes a menu after a click only. To be called after the bar is shown.
    pub fn close_after_choice(&self, ctx: &Context) {
        let is_pressed = ctx.input(|input| input.key_pressed(Key::Enter) || input.key_pressed(Key::Space));
        if !is_pressed || !self.is_open(ctx) || ctx.text_edit_focused() {
            return;
        }
        let focused = ctx.memory(Memory::focused);
        let is_entry =
            focused.is_some_and(|id| !is_submenu(ctx, id) && self.menus.iter().all(|menu| menu.button != id));
        if is_entry {
            Popup::close_all(ctx);
        }
    }

    /// What the keys of this frame do. `open`: the index of the open menu.
    fn pressed(&self, ctx: &Context, open: Option<usize>) -> Option<BarStep> {
        let takes = |modifiers, key| ctx.input_mut(|input| input.consume_key(modifiers, key));
        let is_letter = |menu: &Menu| menu.first_letter.is_some_and(|letter| takes(Modifiers::ALT, letter));
        if let Some(index) = self.menus.iter().position(is_letter) {
            return Some(BarStep::Open(index));
        }
        let open = open?;
        if takes(Modifiers::NONE, Key::F10) {
            return Some(BarStep::Close);
        }
        let (focused, count) = (ctx.memory(Memory::focused), self.menus.len());
        // In a submenu the arrow keys lead into it and out of it.
        let is_in_submenu =
            MenuState::from_id(ctx, self.menus[open].popup, |state| state.open_item.is_some());
        let leads_on = focused.is_some_and(|id| is_submenu(ctx, id));
        if is_in_submenu || leads_on && ctx.input(|input| input.key_pressed(Key::ArrowRight)) {
            return None;
        }
        [(Key::ArrowRight, 1), (Key::ArrowLeft, count - 1)]
            .into_iter()
            .find(|&(key, _)| takes(Modifiers::NONE, key))
            .map(|(_, by)| BarStep::Open((open + by) % count))
    }

    /// Opens a menu and gives its button the focus, from where the arrow keys go on.
    fn open(&mut self, ctx: &Context, index: usize) {
        let Some(menu) = self.menus.get(index) else { return };
        if !std::mem::replace(&mut self.is_open_by_key, true) {
            self.focus_before = ctx.memory(Memory::focused);
        }
        Popup::open_id(ctx, menu.popup);
        ctx.memory_mut(|memory| {
            memory.move_focus(FocusDirection::None);
            memory.request_focus(menu.button);
        });
        ctx.request_repaint();
    }

    /// Gives the focus back, after a menu that a key opened was closed.
    fn give_focus_back(&mut self, ctx: &Context) {
        if !std::mem::take(&mut self.is_open_by_key) {
            return;
        }
        let before = self.focus_before.take();
        ctx.memory_mut(|memory| match (before, memory.focused()) {
            (Some(id), _) => memory.request_focus(id),
            (None, Some(id)) => memory.surrender_focus(id),
            (None, None) => {}
        });
    }
}

/// Shows an entry of a menu that opens a further menu.
pub fn submenu(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    let id = menu_button(ui, name, content).response.id;
    ui.data_mut(|data| data.insert_temp(id.with(SUBMENU), true));
}

/// As [`submenu`], for a menu with fields: a click into a field leaves the menu open, and a row that is chosen is to close the menu.
pub fn submenu_with_fields(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    if !is_in_menu(ui) {
        return submenu(ui, name, content);
    }
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (button, _) = SubMenuButton::new(name).config(config).ui(ui, |ui| scrolling(ui, content));
    ui.data_mut(|data| data.insert_temp(button.id.with(SUBMENU), true));
}

/// The mark of a widget that opens a further menu.
const SUBMENU: &str = "opens a further menu";

/// Whether a widget is an entry that opens a further menu.
fn is_submenu(ctx: &Context, id: Id) -> bool {
    ctx.data(|data| data.get_temp::<bool>(id.with(SUBMENU))).unwrap_or(false)
}
