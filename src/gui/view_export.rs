//! One view drawn off screen as a picture of any size.

use super::PanelContext;
use super::cube_panel::CubePanel;
use super::dock::Panels;
use super::offscreen::OffscreenContext;
use super::pane::Pane;
use super::task::Task;
use super::theme::{self, ThemeColors};
use crate::app::{
    Command, DrawnPicture, Export, ExportKind, ExportOptions, JobCommand, Severity, State, ViewCommand,
};
use egui_wgpu::{RenderState, WgpuSetupExisting};
use std::path::PathBuf;

/// A view to be drawn and written.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewExport {
    /// The panel to draw.
    pub pane: Pane,
    /// Columns and rows.
    pub size_px: [u32; 2],
    /// The file to write.
    pub path: PathBuf,
}

/// Draws views on a thread, so that the window stays responsive.
#[derive(Default)]
pub struct ViewExporter {
    drawing: Option<Task<Command>>,
}

impl ViewExporter {
    /// Begins to draw. A later [`ViewExporter::take_command`] returns the command that writes the picture.
    pub fn begin(
        &mut self,
        ctx: &egui::Context,
        view_export: ViewExport,
        cx: &PanelContext,
        cube: &CubePanel,
    ) {
        let Some(gpu) = cx.gpu.cloned() else { return };
        let (state, cube) = (cx.state.clone(), cube.clone_with_camera());
        let draw = move || draw(&view_export, &state, cube, &gpu);
        self.drawing = Task::start(ctx, "view export", draw);
    }

    /// The command that writes the picture, once the picture is drawn; none before.
    pub fn take_command(&mut self) -> Option<Command> {
        Task::take(&mut self.drawing)
    }
}

/// Pictures of at most this many columns have one pixel for each point; in wider pictures, text and lines grow with the size.
const COLUMNS_AT_SCALE_ONE: f32 = 900.0;

/// Draws a view off screen; returns the command that writes the picture, or the notice of a failure.
fn draw(view_export: &ViewExport, state: &State, cube: CubePanel, gpu: &RenderState) -> Command {
    let RenderState { instance, adapter, device, queue, .. } = gpu.clone();
    let device_setup = WgpuSetupExisting { instance, adapter, device, queue };
    let pixels_per_point = (view_export.size_px[0] as f32 / COLUMNS_AT_SCALE_ONE).max(1.0);
    let drawn = OffscreenContext::new(device_setup, view_export.size_px, pixels_per_point).and_then(
        |mut offscreen_context| {
            theme::load_fonts(offscreen_context.ctx());
            theme::apply(offscreen_context.ctx(), state.view.theme);
            let (palette, gpu) = (ThemeColors::of(state.view.theme), offscreen_context.gpu());
            let mut panels = Panels { cube, ..Panels::default() };
            offscreen_context.picture(|ui| {
                let (mut ignored, mut ignored_actions) = (Vec::new(), Vec::new());
                let mut cx = PanelContext {
                    gpu: Some(&gpu),
                    is_export: true,
                    ..PanelContext::new(state, &palette, &mut ignored, &mut ignored_actions)
                };
                let frame = egui::Frame::new().fill(palette.background);
                egui::CentralPanel::default()
                    .frame(frame)
                    .show(ui, |ui| panels.show(view_export.pane, ui, &mut cx));
            })
        },
    );
    match drawn {
        Ok(rgba) => JobCommand::Export(Export {
            options: ExportOptions {
                drawn: Some(DrawnPicture { size: view_export.size_px, rgba: rgba.into() }),
                ..ExportOptions::default()
            },
            ..ExportKind::View.to(view_export.path.clone())
        })
        .into(),
        Err(error) => {
            let text = format!("{}: {error}", view_export.path.display());
            ViewCommand::Notify(Severity::Error, text).into()
        }
    }
}
