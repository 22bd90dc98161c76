//! One view drawn off screen as a picture of any size.

use super::PanelContext;
use super::cube_panel::CubePanel;
use super::dock::Panels;
use super::offscreen::OffscreenContext;
use super::pane::Pane;
use super::task::Task;
use super::theme::{self, ThemeColors};
use crate::app::{DrawnPicture, Export, ExportKind, ExportOptions, State};
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
    drawing: Option<Task<Result<Export, String>>>,
    /// The file of the view that was begun, until [`ViewExporter::take_drawn`] has returned how that ended.
    begun: Option<PathBuf>,
}

impl ViewExporter {
    /// Begins to draw. A later [`ViewExporter::take_drawn`] returns the picture to be written.
    pub fn begin(
        &mut self,
        ctx: &egui::Context,
        view_export: ViewExport,
        cx: &PanelContext,
        cube: &CubePanel,
    ) {
        self.begun = Some(view_export.path.clone());
        let Some(gpu) = cx.gpu.cloned() else { return };
        let (state, cube) = (cx.state.clone(), cube.clone_with_camera());
        let draw = move || draw(&view_export, &state, cube, &gpu);
        self.drawing = Task::start(ctx, "view export", draw);
    }

    /// The picture to be written once it is drawn, or why it was not drawn; none before, and none where nothing was begun.
    pub fn take_drawn(&mut self) -> Option<Result<Export, String>> {
        let drawn = Task::take(&mut self.drawing);
        if drawn.is_none() && self.drawing.is_some() {
            return None;
        }
        let path = self.begun.take()?;
        // A task that ended by a panic, or that could not start, has no result.
        Some(drawn.unwrap_or_else(|| Err(format!("{}: the view was not drawn; try again", path.display()))))
    }
}

/// Pictures of at most this many columns have one pixel for each point; in wider pictures, text and lines grow with the size.
const COLUMNS_AT_SCALE_ONE: f32 = 900.0;

/// Draws a view off screen; returns the picture to be written, or why it was not drawn.
fn draw(
    view_export: &ViewExport,
    state: &State,
    cube: CubePanel,
    gpu: &RenderState,
) -> Result<Export, String> {
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
    let rgba = drawn.map_err(|error| {
        format!("{}: {error}; choose another size, and try again", view_export.path.display())
    })?;
    let drawn = Some(DrawnPicture { size: view_export.size_px, rgba: rgba.into() });
    let options = ExportOptions { drawn, ..ExportOptions::default() };
    Ok(Export { options, ..ExportKind::View.to(view_export.path.clone()) })
}
