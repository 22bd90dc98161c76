//! The window's content: the application, the panels, and input from keyboard and desktop.

use super::action::{Action, CubeAction};
use super::closing::Closing;
use super::command_palette::CommandPalette;
use super::compact_dock::CompactDock;
use super::cube_choices::{NEEDS_PLANE, NamedView};
use super::debugger_answers::apply_answered;
use super::dock::{Dock, Panels, TAB_BAR_PT};
use super::dropped_files::{open_dropped, open_pasted};
use super::files::Dialogs;
use super::keyboard_focus::{KeyboardFocus, end_editing_on_press};
use super::menu_keys::MenuKeys;
use super::pane::Pane;
use super::panel_context::LastHover;
use super::theme::{self, ThemeColors};
use super::view_export::ViewExporter;
use super::{PanelContext, copied_texts, menu, notices, perform, shortcuts, task, timeline_panel, widgets};
use crate::app::{
    Application, Command, DebugCommand, Executor, JobCommand, Settings, Severity, State, ViewCommand,
    catch_panic,
};
use crate::view::{ProfileLine, Theme, Tool};
use egui::{Event, RichText, Ui};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// The window's content. The content needs no window: tests show the content in a harness.
pub struct App {
    application: Application,
    content: WindowContent,
    gpu: Option<egui_wgpu::RenderState>,
    applied_theme: Option<Theme>,
    /// The context whose repaint workers request when they report.
    repaint_context: Arc<Mutex<egui::Context>>,
}

/// The panels, and the dialogs that open over the panels.
#[derive(Default)]
struct WindowContent {
    dock: Dock,
    compact_dock: CompactDock,
    /// The arrangement that was last sent to the state.
    layout: String,
    /// The camera that was last sent to the state.
    camera: String,
    panels: Panels,
    dialogs: Dialogs,
    closing: Closing,
    command_palette: CommandPalette,
    view_exporter: ViewExporter,
    notices: notices::Notices,
    keyboard_focus: KeyboardFocus,
    menu_keys: MenuKeys,
    last_hover: LastHover,
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

impl App {
    /// An application in which nothing is open. `gpu` draws the color space; without it, that panel shows a sentence instead.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn new(
        ctx: &egui::Context,
        gpu: Option<egui_wgpu::RenderState>,
        executor: Executor,
    ) -> std::io::Result<Self> {
        Self::with_state(ctx, gpu, executor, State::default())
    }

    /// As [`App::new`], but with everything that `state` holds: an analyzed photograph is shown without another analysis.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn with_state(
        ctx: &egui::Context,
        gpu: Option<egui_wgpu::RenderState>,
        executor: Executor,
        state: State,
    ) -> std::io::Result<Self> {
        theme::load_fonts(ctx);
        end_editing_on_press(ctx);
        let repaint_context = Arc::new(Mutex::new(ctx.clone()));
        let shared = Arc::clone(&repaint_context);
        let wake = move || shared.lock().unwrap_or_else(PoisonError::into_inner).request_repaint();
        let application = Application::with_state(executor, state, wake)?;
        Ok(Self { application, content: WindowContent::default(), gpu, applied_theme: None, repaint_context })
    }

    /// Moves to another window after the graphics device was lost: everything stays but what was uploaded to the device.
    pub fn move_to(&mut self, ctx: &egui::Context, gpu: Option<egui_wgpu::RenderState>) {
        theme::load_fonts(ctx);
        end_editing_on_press(ctx);
        *self.repaint_context.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
        self.content.has_further_fonts = false;
        let cube = self.content.panels.cube.clone_with_camera();
        self.content.panels = Panels { cube, ..Panels::default() };
        (self.gpu, self.applied_theme) = (gpu, None);
    }

    /// Restores the settings of an earlier session.
    pub fn restore_settings(&mut self, settings: Settings) {
        self.application.restore_settings(settings.view, settings.recent);
    }

    /// Applies a command, as if a panel had sent it.
    pub fn apply(&mut self, command: impl Into<Command>) {
        self.application.apply(command);
    }

    /// Shows one panel alone, without menu and docking, or all of them again.
    pub fn show_alone(&mut self, pane: Option<Pane>) {
        self.content.single_pane = pane;
    }

    /// Writes the workspace beside the photograph, before the program ends by a panic, and returns its path.
    ///
    /// # Errors
    /// A sentence that says why the workspace was not written.
    pub fn rescue_workspace(&self) -> Result<PathBuf, String> {
        self.application.rescue_workspace()
    }

    /// The state that the panels show.
    pub fn state(&self) -> &State {
        self.application.state()
    }

    /// The panels, for tests that look at their drawings.
    pub(super) fn panels(&self) -> &Panels {
        &self.content.panels
    }

    /// Shows everything, and applies the commands of the panels.
    pub fn show(&mut self, ui: &mut Ui) {
        self.application.poll();
        self.play(ui);
        let theme = self.application.state().view.theme;
        if self.applied_theme != Some(theme) {
            theme::apply(ui.ctx(), theme);
            // Otherwise the first frame would have the texts of the theme before.
            ui.reset_style();
            self.applied_theme = Some(theme);
        }
        self.content.load_further_fonts(ui.ctx(), self.application.state());
        let palette = ThemeColors::of(theme);
        let (mut commands, mut actions) = (Vec::new(), Vec::new());
        let mut cx = PanelContext {
            gpu: self.gpu.as_ref(),
            ..PanelContext::new(self.application.state(), &palette, &mut commands, &mut actions)
        };
        if !draw_frame(&mut cx, |cx| self.content.show(ui, cx)) {
            // Dialogs and help may be what failed. The panels catch their own panics.
            (self.content.dialogs, self.content.help) = (Dialogs::default(), false);
            self.content.command_palette = CommandPalette::default();
        }
        for sentence in task::take_panics(ui.ctx()) {
            cx.send(JobCommand::Rescue(sentence));
        }
        self.content.sync_layout(&mut cx);
        self.content.sync_camera(&mut cx);
        self.content.actions.append(&mut actions);
        if !commands.is_empty() || !self.content.actions.is_empty() {
            // Without this request, the change would appear only when the pointer moves.
            ui.ctx().request_repaint();
        }
        let tells_answers = self.content.tells_answers();
        for command in commands {
            apply_answered(&mut self.application, command, tells_answers);
        }
        update_title(ui, self.application.state());
    }

    /// Advances playing by the time since the last frame.
    fn play(&mut self, ui: &Ui) {
        if self.application.state().debugger.playing.is_some() {
            let seconds = f64::from(ui.input(|input| input.stable_dt));
            let tick = Command::Debug(DebugCommand::Tick(seconds));
            apply_answered(&mut self.application, tick, self.content.tells_answers());
            ui.ctx().request_repaint();
        }
    }
}

impl WindowContent {
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

    fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        self.keyboard_focus.skip_splitters(ui.ctx());
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
        let frame = egui::Frame::new().fill(cx.palette.line);
        egui::CentralPanel::default().frame(frame).show(ui, |ui| {
            if self.dock.is_empty() {
                all_panels_hidden(ui, cx);
            } else {
                self.show_panels(ui, cx);
            }
        });
        if let Some(keys) = held_keys {
            ui.ctx().input_mut(|input| input.events.extend(keys));
        }
        self.last_hover.end(cx);
        self.show_over_panels(ui, cx);
        self.is_text_edited = ui.ctx().text_edit_focused();
        self.keyboard_focus.show(ui.ctx(), cx.palette);
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
        let listeners = shortcuts::KeyListeners::of(
            cx.state,
            self.panels.color_space_rect.take(),
            timeline_panel::track_id(),
        );
        let owns_keyboard =
            self.dialogs.is_open() || self.command_palette.is_open() || self.closing.is_open();
        if !owns_keyboard {
            self.menu_keys.handle(ui.ctx());
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
    fn tells_answers(&self) -> bool {
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
    fn load_further_fonts(&mut self, ctx: &egui::Context, state: &State) {
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

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
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

/// Draws a frame with `draw`. After a panic of `draw`, the result is false, and the panic becomes a notice with which the
/// workspace is saved. Commands that were sent before the panic are kept.
fn draw_frame(cx: &mut PanelContext, draw: impl FnOnce(&mut PanelContext)) -> bool {
    let Err(reason) = catch_panic(|| draw(cx)) else { return true };
    let text = format!(
        "the window was drawn incompletely because of an error of the program ({reason}); please report the error, \
         and go on"
    );
    cx.send(JobCommand::Rescue(text));
    false
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

/// Sets the title of the window, where the title has changed.
fn update_title(ui: &Ui, state: &State) {
    let title = state.picture.as_ref().map_or_else(
        || "Dichroscope".to_owned(),
        |picture| format!("{} \u{2013} Dichroscope", picture.origin.name()),
    );
    let id = egui::Id::unique("window title");
    let before: Option<String> = ui.data(|data| data.get_temp(id));
    if before.as_deref() != Some(title.as_str()) {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
        ui.data_mut(|data| data.insert_temp(id, title));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_in_a_frame_becomes_a_notice_and_keeps_the_commands_before() {
        let (state, palette) = (State::default(), ThemeColors::of(Theme::Dark));
        let (mut commands, mut actions) = (Vec::new(), Vec::new());
        let mut cx = PanelContext::new(&state, &palette, &mut commands, &mut actions);
        assert!(draw_frame(&mut cx, |cx| cx.send(ViewCommand::ForgetRecent)));
        let is_drawn = draw_frame(&mut cx, |cx| {
            cx.send(ViewCommand::Theme(Theme::Light));
            std::panic::resume_unwind(Box::new("an odd menu"));
        });
        assert!(!is_drawn);
        let [_, Command::View(ViewCommand::Theme(Theme::Light)), Command::Job(JobCommand::Rescue(text))] =
            &commands[..]
        else {
            panic!("{commands:?}");
        };
        assert!(text.contains("an odd menu") && text.contains("drawn incompletely"), "{text}");
    }
}
