//! One view as a picture of any size, drawn beside the window.

use super::Cx;
use super::cube_panel::CubePanel;
use super::dock::{Pane, Panels};
use super::offscreen::OffscreenContext;
use super::theme::{self, Tones};
use crate::app::{Command, Export, Severity, State};
use egui_wgpu::{RenderState, WgpuSetupExisting};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// What is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewExport {
    /// The view.
    pub pane: Pane,
    /// Columns and rows.
    pub size_px: [u32; 2],
    /// Where the picture goes.
    pub path: PathBuf,
}

/// Draws views on a thread; the window goes on.
#[derive(Default)]
pub struct ViewExporter {
    drawing: Option<Receiver<Command>>,
}

impl ViewExporter {
    /// Begins to draw. The command that writes the picture comes with a later [`ViewExporter::done`].
    pub fn begin(&mut self, ctx: &egui::Context, view_export: ViewExport, cx: &Cx, cube: &CubePanel) {
        let Some(gpu) = cx.gpu.cloned() else { return };
        let (send, receive) = channel();
        let (ctx, state, cube) = (ctx.clone(), cx.state.clone(), cube.clone_view());
        let work = move || {
            // The window may be gone by now.
            let _ = send.send(draw(&view_export, &state, cube, &gpu));
            ctx.request_repaint();
        };
        if std::thread::Builder::new().name("portrait".to_owned()).spawn(work).is_ok() {
            self.drawing = Some(receive);
        }
    }

    /// The command that writes the picture, once it is drawn.
    pub fn done(&mut self) -> Option<Command> {
        match self.drawing.as_ref()?.try_recv() {
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                self.drawing = None;
                None
            }
            Ok(command) => {
                self.drawing = None;
                Some(command)
            }
        }
    }
}

/// A pixel a point up to this many columns; larger pictures are drawn larger, not emptier.
const COLUMNS_AT_ONE: f32 = 900.0;

fn draw(view_export: &ViewExport, state: &State, cube: CubePanel, gpu: &RenderState) -> Command {
    let RenderState { instance, adapter, device, queue, .. } = gpu.clone();
    let existing = WgpuSetupExisting { instance, adapter, device, queue };
    let pixels_per_point = (view_export.size_px[0] as f32 / COLUMNS_AT_ONE).max(1.0);
    let drawn = OffscreenContext::new(existing, view_export.size_px, pixels_per_point).and_then(
        |mut offscreen_context| {
            theme::load_fonts(offscreen_context.ctx());
            theme::apply(offscreen_context.ctx(), state.view.theme);
            let (tones, gpu) = (Tones::of(state.view.theme), offscreen_context.gpu());
            let mut panels = Panels { cube, ..Panels::default() };
            offscreen_context.picture(|ui| {
                let mut ignored = Vec::new();
                let mut cx = Cx { state, tones: &tones, gpu: Some(&gpu), bare: true, out: &mut ignored };
                let frame = egui::Frame::new().fill(tones.background);
                egui::CentralPanel::default()
                    .frame(frame)
                    .show(ui, |ui| panels.show(view_export.pane, ui, &mut cx));
            })
        },
    );
    match drawn {
        Ok(rgba) => Command::Export(Export::Picture {
            path: view_export.path.clone(),
            size: view_export.size_px,
            rgba: rgba.into(),
        }),
        Err(error) => Command::Notify(Severity::Error, format!("{}: {error}", view_export.path.display())),
    }
}
