//! An egui context that draws into a texture without a desktop, for screenshots and exported views.

use crate::gpu::{NoAdapter, read_texture};
use egui::{FullOutput, Pos2, RawInput, Rect, vec2};
use egui_wgpu::{
    RenderState, RendererOptions, ScreenDescriptor, WgpuConfiguration, WgpuSetup, WgpuSetupExisting,
};
use std::time::Duration;

/// Largest number of frames before a picture is taken, if the interface keeps requesting repaints.
const MOST_FRAMES: usize = 200;

/// An egui context with a graphics device and the size of its image.
pub struct OffscreenContext {
    ctx: egui::Context,
    gpu: RenderState,
    size_px: [u32; 2],
    pixels_per_point: f32,
    frames: usize,
}

/// The reason why nothing can be drawn off screen.
#[derive(Debug, thiserror::Error)]
pub enum OffscreenError {
    /// There is no graphics adapter.
    #[error(transparent)]
    NoAdapter(#[from] NoAdapter),
    /// The graphics device cannot draw the interface.
    #[error("the graphics device cannot draw the window: {0}")]
    Device(#[from] egui_wgpu::WgpuError),
    /// A thread could not be started, or the image could not be read back.
    #[error("{0}")]
    Other(#[from] std::io::Error),
}

impl OffscreenContext {
    /// A context that draws with an existing graphics device.
    ///
    /// # Errors
    /// When the device cannot draw egui's interface.
    pub fn new(
        device: WgpuSetupExisting,
        size_px: [u32; 2],
        pixels_per_point: f32,
    ) -> Result<Self, OffscreenError> {
        let instance = device.instance.clone();
        let configuration =
            WgpuConfiguration { wgpu_setup: WgpuSetup::Existing(device), ..WgpuConfiguration::default() };
        let options = RendererOptions::PREDICTABLE;
        let gpu = pollster::block_on(RenderState::create(&configuration, &instance, None, options))?;
        Ok(Self { ctx: egui::Context::default(), gpu, size_px, pixels_per_point, frames: 0 })
    }

    /// Sets the size of the image, columns and rows, from the next frame on.
    pub fn resize(&mut self, size_px: [u32; 2]) {
        self.size_px = size_px;
    }

    /// The egui context.
    pub fn ctx(&self) -> &egui::Context {
        &self.ctx
    }

    /// The render state that panels draw with.
    pub fn gpu(&self) -> RenderState {
        self.gpu.clone()
    }

    /// Shows frames until the interface requests no more, and returns the last as sRGB bytes with alpha, row-major.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn picture(&mut self, mut show: impl FnMut(&mut egui::Ui)) -> Result<Vec<u8>, OffscreenError> {
        let mut output = self.frame(&mut show);
        for _ in 0..MOST_FRAMES {
            let wait = output.viewport_output.values().map(|viewport| viewport.repaint_delay).min();
            // A longer delay comes from a blinking text cursor or a tooltip.
            if wait.is_none_or(|wait| wait > Duration::from_millis(60)) {
                break;
            }
            std::thread::sleep(wait.unwrap_or_default());
            output = self.frame(&mut show);
        }
        self.draw(output)
    }

    /// Shows one frame.
    fn frame(&mut self, show: &mut impl FnMut(&mut egui::Ui)) -> FullOutput {
        self.frames += 1;
        let points = vec2(self.size_px[0] as f32, self.size_px[1] as f32) / self.pixels_per_point;
        let mut input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, points)),
            time: Some(self.frames as f64 / 60.0),
            max_texture_side: Some(self.gpu.device.limits().max_texture_dimension_2d as usize),
            ..RawInput::default()
        };
        if let Some(viewport) = input.viewports.get_mut(&input.viewport_id) {
            viewport.native_pixels_per_point = Some(self.pixels_per_point);
        }
        let mut output = self.ctx.run_ui(input, |ui| show(ui));
        self.upload(&mut output);
        output
    }

    /// Uploads changed textures of egui, and frees unused ones.
    fn upload(&self, output: &mut FullOutput) {
        let mut renderer = self.gpu.renderer.write();
        for (id, images) in output.textures_delta.set.drain() {
            for image in images {
                renderer.update_texture(&self.gpu.device, &self.gpu.queue, id, &image);
            }
        }
        for id in output.textures_delta.free.drain() {
            renderer.free_texture(&id);
        }
    }

    /// Draws a frame into a texture and reads the texture back.
    fn draw(&self, output: FullOutput) -> Result<Vec<u8>, OffscreenError> {
        let RenderState { device, queue, renderer, target_format, .. } = &self.gpu;
        let screen =
            ScreenDescriptor { size_in_pixels: self.size_px, pixels_per_point: self.pixels_per_point };
        let shapes = self.ctx.tessellate(output.shapes, self.pixels_per_point);
        let [width, height] = self.size_px;
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("window"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: *target_format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut renderer = renderer.write();
        let prepared = renderer.update_buffers(device, queue, &mut encoder, &shapes, &screen);
        let attachment = wgpu::RenderPassColorAttachment {
            view: &view,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
            depth_slice: None,
        };
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("window"),
            color_attachments: &[Some(attachment)],
            ..wgpu::RenderPassDescriptor::default()
        });
        renderer.render(&mut pass.forget_lifetime(), &shapes, &screen);
        queue.submit(prepared.into_iter().chain([encoder.finish()]));
        let lost = || std::io::Error::other("the graphics device was lost while it drew the window");
        Ok(read_texture(device, queue, &texture).ok_or_else(lost)?)
    }
}
