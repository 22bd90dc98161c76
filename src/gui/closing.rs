//! The question before the window or a photograph is closed whose work is in no workspace.

use super::action::Action;
use super::theme::{BODY_PT, heading_font};
use super::{PanelContext, dialog_room};
use crate::app::{JobCommand, Severity, State, ViewCommand};
use crate::view::Picture;
use egui::{Id, Label, Modal, RichText, Ui, ViewportCommand};
use std::sync::Arc;

/// What is to be closed.
#[derive(Clone)]
enum Closed {
    Window,
    /// The photograph that was shown when a person wanted to close it. Another one may be shown meanwhile.
    Photograph(Arc<Picture>),
}

impl Closed {
    /// Whether there is work on the photograph to be closed, or with the window on the photograph that is shown, that is not saved.
    fn is_unsaved(&self, state: &State) -> bool {
        match self {
            Self::Window => state.is_unsaved(),
            Self::Photograph(picture) => state.is_photograph_unsaved(picture),
        }
    }
}

/// What is closed once the workspace is saved.
struct Saving {
    closed: Closed,
    /// Number of frames in which a dialog for the file or the writing may still begin.
    frames_left: u8,
}

/// Largest share of the window's height that the names of the photographs take; the buttons stay below them.
const TEXT_SHARE: f32 = 0.3;

/// Number of frames without a dialog and without writing after which a saving that was chosen has been canceled.
const FRAMES_TO_BEGIN: u8 = 4;

/// The question whether to close without saving.
#[derive(Default)]
pub struct Closing {
    /// What is asked about; none while nothing is asked.
    asked: Option<Closed>,
    /// What is saved before it is closed; none while nothing is.
    saving: Option<Saving>,
    /// Whether a person has chosen to close the window without saving.
    is_confirmed: bool,
}

impl Closing {
    /// Whether the question is shown. It owns the keyboard.
    pub const fn is_open(&self) -> bool {
        self.asked.is_some()
    }

    /// Keeps the window open that the desktop or a person wants to close, and asks, where the work on a photograph is not saved.
    pub fn hold_window(&mut self, ctx: &egui::Context, state: &State) {
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && !self.is_confirmed && !state.unsaved_names().is_empty() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.asked = Some(Closed::Window);
            // The question is measured in this frame and shown in the next one.
            ctx.request_repaint();
        }
    }

    /// Closes the photograph that is shown, or asks where the work on it is not saved.
    pub fn close_photograph(&mut self, cx: &mut PanelContext) {
        let Some(picture) = cx.state.picture.clone() else { return };
        if cx.state.others.is_empty() {
            let text = "the only photograph stays open until another one is opened";
            cx.send(ViewCommand::Notify(Severity::Answer, text.to_owned()));
        } else if cx.state.is_unsaved() {
            self.asked = Some(Closed::Photograph(picture));
        } else {
            cx.send(JobCommand::ClosePhotograph(picture));
        }
    }

    /// Shows the question, where it is asked.
    pub fn show(&mut self, ui: &Ui, cx: &mut PanelContext) {
        let Some(closed) = self.asked.clone() else { return };
        let names = match &closed {
            Closed::Window => cx.state.unsaved_names().join(", "),
            Closed::Photograph(picture) => picture.origin.name(),
        };
        let modal = Modal::new(Id::unique("close without saving")).show(ui.ctx(), |ui| {
            ui.set_max_width(dialog_room::width_within(ui.ctx(), 420.0));
            ui.label(RichText::new("Close without saving?").font(heading_font(BODY_PT)));
            let text = format!("Parameters, marks or area of {names} were changed, and are in no workspace.");
            let room_pt = TEXT_SHARE * ui.ctx().content_rect().height();
            dialog_room::scrolling(ui, "unsaved photographs", room_pt, |ui| {
                ui.add(Label::new(RichText::new(text).color(cx.palette.secondary)).wrap());
            });
            ui.add_space(6.0);
            ui.horizontal_wrapped(|ui| {
                if closed.is_unsaved(cx.state) && ui.button("Save workspace\u{2026}").clicked() {
                    self.asked = None;
                    self.saving = Some(Saving { closed: closed.clone(), frames_left: FRAMES_TO_BEGIN });
                    cx.act(Action::Save);
                }
                if ui.button("Close without saving").clicked() {
                    self.asked = None;
                    self.is_confirmed = matches!(closed, Closed::Window);
                    close(ui, cx, closed);
                }
                if ui.button("Cancel").clicked() {
                    self.asked = None;
                }
            });
        });
        if modal.should_close() {
            self.asked = None;
        }
    }

    /// Closes what was to be saved before, once it is saved. `is_saving`: whether a dialog is open or a file is being written. A dialog that was
    /// canceled, and a file that could not be written, close nothing.
    pub fn close_when_saved(&mut self, ui: &Ui, cx: &mut PanelContext, is_saving: bool) {
        let Some(Saving { closed, frames_left }) = self.saving.take() else { return };
        if is_saving {
            self.saving = Some(Saving { closed, frames_left: 1 });
        } else if closed.is_unsaved(cx.state) {
            self.saving = frames_left.checked_sub(1).map(|frames_left| Saving { closed, frames_left });
            ui.ctx().request_repaint();
        } else {
            close(ui, cx, closed);
        }
    }
}

/// Closes a photograph, or the window: at once, unless the work on another photograph is not saved.
fn close(ui: &Ui, cx: &mut PanelContext, closed: Closed) {
    match closed {
        Closed::Window => ui.ctx().send_viewport_cmd(ViewportCommand::Close),
        Closed::Photograph(picture) => cx.send(JobCommand::ClosePhotograph(picture)),
    }
}
