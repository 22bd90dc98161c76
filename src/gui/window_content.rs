//! The content of the window: the menu, the panels, what lies over the panels, and the actions of keys and menus.

use super::action::{Action, CubeAction};
use super::closing::Closing;
use super::command_palette::CommandPalette;
use super::compact_dock::CompactDock;
use super::cube_choices::{NEEDS_PLANE, NamedView};
use super::dock::{Dock, Panels, TAB_BAR_PT};
use super::dropped_files::{DropHint, open_dropped, open_pasted};
use super::files::Dialogs;
use super::keyboard_focus::KeyboardFocus;
use super::menu_keys::MenuKeys;
use super::pane::Pane;
use super::panel_context::LastHover;
use super::popup_scroll::limit_lists;
use super::text_size::TextSize;
use super::view_export::ViewExporter;
use super::{
    PanelContext, copied_texts, menu, notices, perform, shortcuts, text_size, theme, timeline_panel, widgets,
};
use crate::app::{Severity, State, ViewCommand};
use crate::view::{ProfileLine, Tool};
use egui::{Context, Event, Key, LayerId, Modifiers, Order, PointerState, Popup, RichText, Ui};

/// The panels, and the dialogs that open over the panels.
#[derive(Default)]
pub struct WindowContent {
    dock: Dock,
    compact_dock: CompactDock,
    /// The arrangement that was last sent to the state.
    layout: String,
    /// The camera that was last sent to the state.
    camera: String,
    text_size: TextSize,
    panels: Panels,
    dialogs: Dialogs,
    closing: Closing,
    command_palette: CommandPalette,
    view_exporter: ViewExporter,
    notices: notices::Notices,
    keyboard_focus: KeyboardFocus,
    menu_keys: MenuKeys,
    last_hover: LastHover,
    drop_hint: DropHint,
    /// The line of the profile in the last frame.
    profile: ProfileLine,
    /// Whether a font for further scripts was looked for.
    has_further_fonts: bool,
    /// Whether the list of keys is shown.
    help: bool,
    space_tap: shortcuts::SpaceTap,
    /// What was typed in the last frame after the key that opened a dialog or the palette.
    typed_ahead: Vec<Event>,
    /// Whether a text field had the focus in the last frame.
    is_text_edited: bool,
    /// Actions that panels asked for in the last frame.
    actions: Vec<Action>,
    /// The panel that is shown alone; none: all panels.
    single_pane: Option<Pane>,
}

impl WindowContent {
    /// Forgets what was uploaded to a graphics device, which fonts were loaded, and the size of the texts in the window before.
    pub fn forget_uploads(&mut self) {
        self.has_further_fonts = false;
        self.text_size = TextSize::default();
        let cube = self.panels.cube.clone_with_camera();
        self.panels = Panels { cube, ..Panels::default() };
    }

    /// Shows one panel alone, without menu and docking, or all of them again.
    pub fn show_alone(&mut self, pane: Option<Pane>) {
        self.single_pane = pane;
    }

    /// The panels.
    pub fn panels(&self) -> &Panels {
        &self.panels
    }

    /// Closes the dialogs, the palette and the list of keys.
    pub fn close_dialogs(&mut self) {
        (self.dialogs, self.help) = (Dialogs::default(), false);
        self.command_palette = CommandPalette::default();
    }

    /// Keeps the actions that panels asked for until the next frame carries them out. Returns whether there are any.
    pub fn keep_actions(&mut self, mut actions: Vec<Action>) -> bool {
        self.actions.append(&mut actions);
        !self.actions.is_empty()
    }

    /// Takes arrangement, camera and size of the texts from the state where they have changed there, or sends them to the state.
    pub fn sync(&mut self, ctx: &Context, cx: &mut PanelContext) {
        self.sync_layout(cx);
        self.sync_camera(cx);
        self.text_size.sync(ctx, cx);
    }

    /// Takes the arrangement of the state where that has changed (a workspace was opened); otherwise sends the panels'
    /// arrangement to the state.
    fn sync_layout(&mut self, cx: &mut PanelContext) {
        let saved = &cx.state.view.layout;
        if *saved != self.layout {
            if let Some(dock) = Dock::from_text(saved) {
                self.dock = dock;
            }
            self.layout.clone_from(saved);
            return;
        }
        let current = self.dock.to_text();
        if current != self.layout {
            self.layout.clone_from(&current);
            cx.send(ViewCommand::Layout(current));
        }
    }

    /// Takes the camera of the state where that has changed (a workspace was opened); otherwise sends the camera of the color
    /// space view to the state.
    fn sync_camera(&mut self, cx: &mut PanelContext) {
        let saved = &cx.state.view.camera;
        if *saved != self.camera {
            if let Ok(camera) = serde_json::from_str(saved) {
                self.panels.cube.set_camera(camera);
            }
            self.camera.clone_from(saved);
            return;
        }
        let current = serde_json::to_string(&self.panels.cube.camera()).unwrap_or_default();
        if current != self.camera {
            self.camera.clone_from(&current);
            cx.send(ViewCommand::Camera(current));
        }
    }

    /// Carries out the actions of keys and menus, and shows the menu, the panels and what lies over the panels.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        self.keyboard_focus.skip_splitters(ui.ctx());
        limit_lists(ui);
        self.closing.hold_window(ui.ctx(), cx.state);
        self.take_dropped_and_pasted(ui, cx);
        let mut held_keys = self.handle_keys(ui, cx);
        if let Some(pane) = self.single_pane {
            let frame = egui::Frame::new().fill(cx.palette.panel);
            egui::CentralPanel::default().frame(frame).show(ui, |ui| self.panels.show(pane, ui, cx));
            self.last_hover.end(cx);
            return;
        }
        let menu_frame =
            egui::Frame::new().fill(cx.palette.panel).inner_margin(egui::Margin::symmetric(8, 3));
        egui::Panel::top("menu").frame(menu_frame).show(ui, |ui| {
            menu::show(ui, cx, &mut self.menu_keys, &mut self.dock);
        });
        // The keys of an open menu were for the menu.
        if self.menu_keys.is_open(ui.ctx()) {
            held_keys.get_or_insert_default().extend(take_keys(ui.ctx()));
        }
        self.raise_drawn_profile(cx);
        let covered = self.take_covered_pointer(ui.ctx());
        let frame = egui::Frame::new().fill(cx.palette.line);
        egui::CentralPanel::default().frame(frame).show(ui, |ui| {
            if self.dock.is_empty() {
                all_panels_hidden(ui, cx);
            } else {
                self.show_panels(ui, cx);
            }
        });
        if let Some(pointer) = covered {
            ui.ctx().input_mut(|input| input.pointer = pointer);
        }
        if let Some(keys) = held_keys {
            ui.ctx().input_mut(|input| input.events.extend(keys));
        }
        self.last_hover.end(cx);
        self.show_over_panels(ui, cx);
        self.is_text_edited = ui.ctx().text_edit_focused();
        self.keyboard_focus.show(ui.ctx(), cx.palette);
    }

    /// Takes the pointer out of the input of the panels while a dialog lies under the pointer, and returns the pointer. Otherwise the tooltip of a
    /// widget under a dialog that has just opened would stay, over the dialog.
    fn take_covered_pointer(&self, ctx: &Context) -> Option<PointerState> {
        let is_covered =
            self.dialogs.is_open() || self.command_palette.is_open() || self.closing.is_open() || self.help;
        let at = ctx.pointer_hover_pos().filter(|_| is_covered && !Popup::is_any_open(ctx))?;
        let is_over_panels = |layer: LayerId| layer.order == Order::Background;
        if ctx.input(|input| input.pointer.any_down()) || ctx.layer_id_at(at).is_none_or(is_over_panels) {
            return None;
        }
        Some(ctx.input_mut(|input| std::mem::take(&mut input.pointer)))
    }

    /// Carries out the actions of the pressed keys, of the menus and of the palette. Returns the keys that are kept from the panels, where a dialog
    /// or the palette owns the keyboard.
    fn handle_keys(&mut self, ui: &Ui, cx: &mut PanelContext) -> Option<Vec<egui::Event>> {
        let typed_ahead = std::mem::take(&mut self.typed_ahead);
        if self.dialogs.is_open() || self.command_palette.is_open() {
            ui.ctx().input_mut(|input| drop(input.events.splice(0..0, typed_ahead)));
        }
        self.dialogs.close_on_escape(ui.ctx());
        self.command_palette.close_on_keys(ui.ctx());
        self.panels.image.cancel_on_escape(ui.ctx());
        self.panels.cube.cancel_on_escape(ui.ctx());
        self.panels.plane.cancel_on_escape(ui.ctx());
        // egui removes the focus from a text field on Escape, so the focus of the last frame decides.
        let was_text_edited = std::mem::replace(&mut self.is_text_edited, false);
        let escape_is_action = !was_text_edited && !egui::Popup::is_any_open(ui.ctx());
        let color_space_rect = self.panels.color_space_rect.take();
        let mut listeners =
            shortcuts::KeyListeners::of(cx.state, color_space_rect, timeline_panel::track_id());
        // Escape closes the list of keys before it cancels anything.
        listeners.cancels_analysis &= !self.help;
        let owns_keyboard =
            self.dialogs.is_open() || self.command_palette.is_open() || self.closing.is_open();
        if !owns_keyboard {
            self.menu_keys.handle(ui.ctx());
        }
        // An export of the result may be refused until the present parameters are analyzed.
        if self.dialogs.is_open() && ui.ctx().input_mut(|input| input.consume_key(Modifiers::NONE, Key::F5)) {
            self.actions.push(Action::Analyze);
        }
        let held_keys = owns_keyboard.then(|| take_keys(ui.ctx()));
        let (pressed, typed_ahead) =
            shortcuts::pressed(ui.ctx(), escape_is_action, listeners, &mut self.space_tap);
        self.typed_ahead = typed_ahead;
        for action in std::mem::take(&mut self.actions).into_iter().chain(pressed) {
            // A dialog is invisible in its first frame, in which egui measures the dialog.
            ui.ctx().request_repaint();
            match action {
                Action::Quit => ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close),
                Action::ClosePhotograph => self.closing.close_photograph(cx),
                Action::Show(pane) => self.raise(pane),
                Action::ShowAll => self.dock.reset(),
                Action::Palette => self.command_palette.toggle(ui.ctx()),
                Action::Menus => self.menu_keys.toggle(ui.ctx()),
                Action::CopyCommandLine => copied_texts::copy_command_line(ui, cx),
                Action::CopyRegions => copied_texts::copy_regions(ui, cx),
                Action::CopyProfile => copied_texts::copy_profile(ui, cx),
                Action::Cube(CubeAction::View(view)) => self.turn_cube(cx, view),
                Action::Cube(CubeAction::Perspective) => self.panels.cube.toggle_projection(),
                Action::TextSize(step) => text_size::change(ui.ctx(), step),
                Action::View(step) => self.panels.image.step_view(ui.ctx(), cx, step),
                _ => perform::carry_out(action, cx, &mut self.dialogs, &mut self.help),
            }
        }
        held_keys
    }

    /// Shows what lies over the panels: notices, palette, dialogs and the list of keys.
    fn show_over_panels(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let timeline = self.dock.rect_of(Pane::Timeline).filter(|_| !self.compact_dock.is_in_use);
        let floor = timeline.map_or(ui.ctx().content_rect().bottom(), |timeline| timeline.top() - TAB_BAR_PT);
        self.notices.show(ui, cx, floor);
        self.command_palette.show(ui, cx);
        self.closing.show(ui, cx);
        if let Some(view_export) = self.dialogs.show(ui, cx) {
            self.view_exporter.begin(ui.ctx(), view_export, cx, &self.panels.cube);
        }
        if let Some(drawn) = self.view_exporter.take_drawn() {
            self.dialogs.take_drawn(drawn, cx);
        }
        let is_saving = self.dialogs.is_open() || cx.state.jobs.export.is_some();
        self.closing.close_when_saved(ui, cx, is_saving);
        shortcuts::show_help(ui, cx, &mut self.help);
        self.drop_hint.show(ui, cx.palette, self.dialogs.asked_file());
    }

    /// Opens what is dropped and pasted. A file that is dropped while a dialog asks for a label map, a workspace or the like is the dialog's;
    /// any other is opened, and ends the dialog. A dialog has a field for what is pasted.
    fn take_dropped_and_pasted(&mut self, ui: &Ui, cx: &mut PanelContext) {
        if !self.dialogs.take_dropped(ui.ctx()) && open_dropped(ui, cx) {
            self.dialogs.close(ui.ctx());
            self.command_palette.close(ui.ctx());
        }
        if !self.dialogs.is_open() && !self.command_palette.is_open() {
            open_pasted(ui, cx);
        }
    }

    /// Shows the panels as they are arranged, or where there is no room for that, as tabs of one group.
    fn show_panels(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        self.compact_dock.is_in_use = CompactDock::is_needed(ui.available_size());
        if self.compact_dock.is_in_use {
            self.compact_dock.show(ui, &self.dock, &mut self.panels, cx);
        } else {
            self.dock.show(ui, &mut self.panels, cx);
        }
    }

    /// Shows the color space from a named view.
    fn turn_cube(&mut self, cx: &mut PanelContext, view: NamedView) {
        self.raise(Pane::Colors);
        if !self.panels.cube.go_to_view(cx.state, view) {
            cx.send(ViewCommand::Notify(Severity::Warning, NEEDS_PLANE.to_owned()));
        }
    }

    /// Whether the timeline told in the last frame what the debugger answers: neither hidden, nor behind another tab, nor too small.
    pub fn tells_answers(&self) -> bool {
        match self.single_pane {
            Some(single) => single == Pane::Timeline,
            None if self.compact_dock.is_in_use => self.compact_dock.is_in_front(Pane::Timeline),
            None => self.dock.rect_of(Pane::Timeline).is_some_and(timeline_panel::has_room_for_answers),
        }
    }

    /// Shows a panel in front of the other tabs.
    fn raise(&mut self, pane: Pane) {
        self.dock.set_visible(pane, true);
        self.compact_dock.activate(pane);
    }

    /// Brings the profile to the front when a person draws its line.
    fn raise_drawn_profile(&mut self, cx: &PanelContext) {
        let line = cx.state.view.profile;
        let is_drawn = matches!(line, ProfileLine::Between(..)) && cx.state.view.image.tool == Tool::Profile;
        if std::mem::replace(&mut self.profile, line) != line && is_drawn {
            self.dock.activate(Pane::Profile);
            self.compact_dock.activate(Pane::Profile);
        }
    }

    /// Loads fonts of the system for other scripts, once a name that is shown has characters of such a script.
    pub fn load_further_fonts(&mut self, ctx: &egui::Context, state: &State) {
        if self.has_further_fonts {
            return;
        }
        let name = state.picture.as_ref().map(|picture| picture.origin.name());
        let recent = state.recent.iter().map(|path| path.to_string_lossy().into_owned());
        if name.into_iter().chain(recent).any(|name| theme::needs_further_fonts(&name)) {
            theme::load_further_fonts(ctx);
            self.has_further_fonts = true;
        }
    }
}

/// Shows, while every panel is hidden, the ways back.
fn all_panels_hidden(ui: &mut Ui, cx: &mut PanelContext) {
    egui::Frame::new().fill(cx.palette.panel).inner_margin(24).show(ui, |ui| {
        ui.set_min_size(ui.available_size());
        let title = RichText::new("All panels are hidden").font(theme::heading_font(theme::TITLE_PT));
        ui.label(title);
        ui.add_space(8.0);
        if ui.button(RichText::new("Arrange as at first").color(cx.palette.accent)).clicked() {
            cx.act(Action::ShowAll);
        }
        widgets::heading(ui, cx.palette, "Show one panel");
        ui.horizontal_wrapped(|ui| {
            for pane in Pane::ALL {
                if ui.button(pane.title()).clicked() {
                    cx.act(Action::Show(pane));
                }
            }
        });
    });
}

/// Takes the keys, the typed text and the clipboard's events out of the input of this frame.
fn take_keys(ctx: &egui::Context) -> Vec<Event> {
    ctx.input_mut(|input| {
        let events = std::mem::take(&mut input.events).into_iter();
        let (keys, others) = events.partition(shortcuts::is_of_keyboard);
        input.events = others;
        keys
    })
}
