//! The application and its window: each frame shows the state and applies the commands of the panels.

use super::debugger_answers::apply_answered;
use super::dock::Panels;
use super::keyboard_focus::end_editing_on_press;
use super::pane::Pane;
use super::pointer_frames::PointerFrames;
use super::theme::{self, ThemeColors};
use super::window_content::WindowContent;
use super::{PanelContext, task};
use crate::app::{Application, Command, DebugCommand, Executor, JobCommand, Settings, State, catch_panic};
use crate::view::Theme;
use egui::Ui;
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
        ctx.add_plugin(PointerFrames::default());
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
        ctx.add_plugin(PointerFrames::default());
        *self.repaint_context.lock().unwrap_or_else(PoisonError::into_inner) = ctx.clone();
        self.content.forget_uploads();
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
        self.content.show_alone(pane);
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
        self.content.panels()
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
            self.content.close_dialogs();
        }
        for sentence in task::take_panics(ui.ctx()) {
            cx.send(JobCommand::Rescue(sentence));
        }
        self.content.sync(ui.ctx(), &mut cx);
        let has_actions = self.content.keep_actions(actions);
        if !commands.is_empty() || has_actions {
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

impl eframe::App for App {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
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
    use crate::app::ViewCommand;

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
