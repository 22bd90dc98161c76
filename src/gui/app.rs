//! The application: the app, the panels over it, and what comes in from the keyboard and the desktop.

use super::dock::{Dock, Pane, Panels};
use super::files::{Dialogs, is_workspace};
use super::theme::{self, Tones};
use super::view_export::ViewExporter;
use super::{PanelContext, menu, notices, perform, shortcuts, timeline_panel};
use crate::app::{Application, Command, DebugCommand, Executor, JobCommand, Settings, State, ViewCommand};
use crate::view::{Origin, Theme};
use egui::{Event, Ui};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// The window's content. It needs no window: tests show it in a harness.
pub struct App {
    application: Application,
    front: Front,
    gpu: Option<egui_wgpu::RenderState>,
    dressed: Option<Theme>,
    /// Where the workers ring when they have finished.
    bell: Arc<Mutex<egui::Context>>,
}

/// What stands before the app: panels and what opens over them.
#[derive(Default)]
struct Front {
    dock: Dock,
    /// The arrangement as it was last kept.
    layout: String,
    /// The camera as it was last kept.
    camera: String,
    panels: Panels,
    dialogs: Dialogs,
    view_exporter: ViewExporter,
    help: bool,
    tap: shortcuts::SpaceTap,
    /// Whether somebody typed in the last frame.
    typing: bool,
    /// The one panel that is shown, if not all.
    alone: Option<Pane>,
}

impl App {
    /// An application in which nothing is open. `gpu` draws the color space; without it that panel says why it is empty.
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
        let bell = Arc::new(Mutex::new(ctx.clone()));
        let rung = Arc::clone(&bell);
        let ring = move || rung.lock().unwrap_or_else(PoisonError::into_inner).request_repaint();
        let application = Application::with_state(executor, state, ring)?;
        Ok(Self { application, front: Front::default(), gpu, dressed: None, bell })
    }

    /// Moves to another window, where the graphics device of the first was lost: all stays but what was uploaded.
    pub fn move_to(&mut self, ctx: &egui::Context, gpu: Option<egui_wgpu::RenderState>) {
        theme::load_fonts(ctx);
        *self.bell.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
        let cube = self.front.panels.cube.clone_view();
        self.front.panels = Panels { cube, ..Panels::default() };
        (self.gpu, self.dressed) = (gpu, None);
    }

    /// Puts back what was remembered from another session.
    pub fn remember(&mut self, settings: Settings) {
        self.application.remember(settings.view, settings.recent);
    }

    /// Applies a command, as a panel would.
    pub fn apply(&mut self, command: impl Into<Command>) {
        self.application.apply(command);
    }

    /// Shows one panel alone, without menu and docking, or all of them again.
    pub fn show_alone(&mut self, pane: Option<Pane>) {
        self.front.alone = pane;
    }

    /// All that is shown.
    pub fn state(&self) -> &State {
        self.application.state()
    }

    /// What the panels keep.
    pub(super) fn panels(&self) -> &Panels {
        &self.front.panels
    }

    /// Shows everything, and obeys.
    pub fn show(&mut self, ui: &mut Ui) {
        self.application.poll();
        self.play(ui);
        let theme = self.application.state().view.theme;
        if self.dressed != Some(theme) {
            theme::apply(ui.ctx(), theme);
            self.dressed = Some(theme);
        }
        let tones = Tones::of(theme);
        let mut out = Vec::new();
        let mut cx = PanelContext {
            state: self.application.state(),
            tones: &tones,
            gpu: self.gpu.as_ref(),
            bare: false,
            out: &mut out,
        };
        self.front.show(ui, &mut cx);
        self.front.keep_layout(&mut cx);
        self.front.keep_camera(&mut cx);
        if !out.is_empty() {
            // What a command changes is seen at once, not when the pointer next moves.
            ui.ctx().request_repaint();
        }
        for command in out {
            self.application.apply(command);
        }
        title(ui, self.application.state());
    }

    /// Playing goes on with the time that has passed; nothing else moves by itself.
    fn play(&mut self, ui: &Ui) {
        if self.application.state().debugger.playing.is_some() {
            let seconds = f64::from(ui.input(|input| input.stable_dt));
            self.application.apply(Command::Debug(DebugCommand::Tick(seconds)));
            ui.ctx().request_repaint();
        }
    }
}

impl Front {
    /// The panels' arrangement follows the view's, where a workspace brings another, and is kept there.
    fn keep_layout(&mut self, cx: &mut PanelContext) {
        let wanted = &cx.state.view.layout;
        if *wanted != self.layout {
            if let Some(dock) = Dock::from_text(wanted) {
                self.dock = dock;
            }
            self.layout.clone_from(wanted);
            return;
        }
        let now = self.dock.to_text();
        if now != self.layout {
            self.layout.clone_from(&now);
            cx.send(ViewCommand::Layout(now));
        }
    }

    /// The cube's camera likewise.
    fn keep_camera(&mut self, cx: &mut PanelContext) {
        let wanted = &cx.state.view.camera;
        if *wanted != self.camera {
            if let Ok(camera) = serde_json::from_str(wanted) {
                self.panels.cube.set_camera(camera);
            }
            self.camera.clone_from(wanted);
            return;
        }
        let now = serde_json::to_string(&self.panels.cube.camera()).unwrap_or_default();
        if now != self.camera {
            self.camera.clone_from(&now);
            cx.send(ViewCommand::Camera(now));
        }
    }

    fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        come_in(ui, cx);
        self.dialogs.close_on_escape(ui.ctx());
        self.panels.image.take_escape(ui.ctx());
        self.panels.cube.take_escape(ui.ctx());
        // egui takes the focus from what is typed in when Escape comes: the frame before tells who had it.
        let typed = std::mem::replace(&mut self.typing, false);
        let escape_is_meant = !typed && !egui::Popup::is_any_open(ui.ctx());
        let listeners =
            shortcuts::Listeners::of(cx.state, self.panels.colors.take(), timeline_panel::track_id());
        for action in shortcuts::pressed(ui.ctx(), escape_is_meant, listeners, &mut self.tap) {
            // A window that opens is measured unseen in its first frame.
            ui.ctx().request_repaint();
            perform::carry_out(action, cx, &mut self.dialogs, &mut self.help);
        }
        if let Some(pane) = self.alone {
            let frame = egui::Frame::new().fill(cx.tones.panel);
            egui::CentralPanel::default().frame(frame).show(ui, |ui| self.panels.show(pane, ui, cx));
            return;
        }
        let bar = egui::Frame::new().fill(cx.tones.panel).inner_margin(egui::Margin::symmetric(8, 3));
        egui::Panel::top("menu").frame(bar).show(ui, |ui| {
            menu::show(ui, cx, &mut self.dock, &mut self.dialogs, &mut self.help);
        });
        let frame = egui::Frame::new().fill(cx.tones.line);
        egui::CentralPanel::default().frame(frame).show(ui, |ui| self.dock.show(ui, &mut self.panels, cx));
        if let Some(view_export) = self.dialogs.show(ui, cx) {
            self.view_exporter.begin(ui.ctx(), view_export, cx, &self.panels.cube);
        }
        if let Some(command) = self.view_exporter.done() {
            cx.send(command);
        }
        notices::show(ui, cx);
        shortcuts::show_help(ui, cx, &mut self.help);
        self.typing = ui.ctx().text_edit_focused();
    }
}

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}

/// Files dropped on the window, and what is pasted.
fn come_in(ui: &Ui, cx: &mut PanelContext) {
    let typing = ui.ctx().text_edit_focused();
    let (dropped, pasted) = ui.input(|input| {
        let pastes = |event: &&Event| matches!(event, Event::Paste(_) | Event::PasteImage(_));
        let pasted: Vec<Event> =
            if typing { Vec::new() } else { input.events.iter().filter(pastes).cloned().collect() };
        (input.raw.dropped_files.clone(), pasted)
    });
    // The last of several files wins: one photograph is open at a time.
    if let Some(file) = dropped.last() {
        let path = file.path().to_path_buf();
        if path.is_file() || path.parent().is_some_and(|parent| !parent.as_os_str().is_empty()) {
            open_path(cx, path);
        } else {
            match file.bytes() {
                Ok(bytes) => {
                    let name = path.display().to_string();
                    cx.send(JobCommand::Open(Origin::Bytes { name, bytes: bytes.into() }));
                }
                Err(reason) => {
                    let text = format!("{}: what was dropped cannot be read: {reason}", path.display());
                    cx.send(ViewCommand::Notify(crate::app::Severity::Error, text));
                }
            }
        }
    }
    for event in pasted {
        match event {
            Event::Paste(text) => {
                let text = text.trim().trim_start_matches("file://").to_owned();
                if !text.is_empty() && !text.contains('\n') {
                    open_path(cx, PathBuf::from(text));
                }
            }
            Event::PasteImage(image) => {
                let size = [image.size[0] as u32, image.size[1] as u32];
                let rgba: Vec<u8> =
                    image.pixels.iter().flat_map(egui::Color32::to_srgba_unmultiplied).collect();
                let bytes: Arc<[u8]> = crate::export::png_of_rgba(size, &rgba).into();
                cx.send(JobCommand::Open(Origin::Bytes { name: "clipboard".to_owned(), bytes }));
            }
            _ => {}
        }
    }
}

fn open_path(cx: &mut PanelContext, path: PathBuf) {
    cx.send(if is_workspace(&path) {
        JobCommand::OpenWorkspace(path)
    } else {
        JobCommand::Open(Origin::File(path))
    });
}

fn title(ui: &Ui, state: &State) {
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
