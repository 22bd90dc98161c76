//! The whole window drawn into a texture without a desktop, for screenshots.

use super::App;
use super::offscreen::{OffscreenContext, OffscreenError};
use crate::app::Executor;
use crate::gpu::Headless;
use egui_wgpu::WgpuSetupExisting;

/// An application that is drawn without a window.
pub struct OffscreenApp {
    /// The application.
    pub app: App,
    offscreen_context: OffscreenContext,
}

impl OffscreenApp {
    /// An application without a photograph, in an image of `size_px` columns and rows.
    ///
    /// # Errors
    /// When there is no graphics adapter, not even a software one.
    pub fn new(size_px: [u32; 2], pixels_per_point: f32) -> Result<Self, OffscreenError> {
        let Headless { instance, adapter, device, queue } = Headless::new()?;
        let offscreen_context = OffscreenContext::new(
            WgpuSetupExisting { instance, adapter, device, queue },
            size_px,
            pixels_per_point,
        )?;
        let app = App::new(offscreen_context.ctx(), Some(offscreen_context.gpu()), Executor::Inline)?;
        Ok(Self { app, offscreen_context })
    }

    /// Sets the size of the image, columns and rows, from the next frame on.
    pub fn resize(&mut self, size_px: [u32; 2]) {
        self.offscreen_context.resize(size_px);
    }

    /// Shows frames until the application requests no more, and returns the last as sRGB bytes with alpha, row-major.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn picture(&mut self) -> Result<Vec<u8>, OffscreenError> {
        let app = &mut self.app;
        self.offscreen_context.picture(|ui| app.show(ui))
    }
}
