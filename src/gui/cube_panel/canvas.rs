//! The color space drawn into a texture, and the texture shown in the window.

use crate::gpu::{Orbit, Renderer, Scene};
use egui::{Rect, TextureId, Ui};
use egui_wgpu::RenderState;

/// The renderer, and egui's texture id of the renderer's image; both are made at the first drawing.
#[derive(Default)]
pub struct Canvas {
    renderer: Option<DeviceRenderer>,
}

/// The renderer of one graphics device, and egui's texture of its image.
struct DeviceRenderer {
    device: wgpu::Device,
    renderer: Renderer,
    texture: Option<(TextureId, u64)>,
}

impl Canvas {
    /// Draws the scene if scene, camera or size have changed, and shows the image in `rect`.
    pub fn show(&mut self, ui: &Ui, gpu: &RenderState, rect: Rect, scene: &Scene, camera: &Orbit) {
        let renderer = self.renderer(gpu);
        let scale = ui.ctx().pixels_per_point();
        let size_px = [rect.width(), rect.height()].map(|length| (length * scale).round().max(1.0) as u32);
        renderer.renderer.draw(&gpu.device, &gpu.queue, scene, camera, size_px, scale);
        let uv = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
        ui.painter().image(renderer.texture(gpu), rect, uv, egui::Color32::WHITE);
    }

    /// The image: columns and rows, then sRGB bytes with alpha, row-major. `None` before the first drawing.
    pub fn read_back(&self, gpu: &RenderState) -> Option<([u32; 2], Vec<u8>)> {
        let renderer = &self.renderer.as_ref()?.renderer;
        Some((renderer.size_px(), renderer.read_back(&gpu.device, &gpu.queue)?))
    }

    /// The renderer of the graphics device. A device that replaces a lost one gets a new renderer.
    fn renderer(&mut self, gpu: &RenderState) -> &mut DeviceRenderer {
        if self.renderer.as_ref().is_some_and(|renderer| renderer.device != gpu.device) {
            self.renderer = None;
        }
        self.renderer.get_or_insert_with(|| DeviceRenderer {
            device: gpu.device.clone(),
            renderer: Renderer::new(&gpu.device),
            texture: None,
        })
    }
}

impl DeviceRenderer {
    /// The texture of the image; registered again when the image has another size.
    fn texture(&mut self, gpu: &RenderState) -> TextureId {
        let (view, generation) = (self.renderer.view(), self.renderer.generation());
        let filter = wgpu::FilterMode::Nearest;
        match self.texture {
            Some((id, uploaded)) if uploaded == generation => id,
            Some((id, _)) => {
                let mut window = gpu.renderer.write();
                window.update_egui_texture_from_wgpu_texture(&gpu.device, view, filter, id);
                self.texture = Some((id, generation));
                id
            }
            None => {
                let id = gpu.renderer.write().register_native_texture(&gpu.device, view, filter);
                self.texture = Some((id, generation));
                id
            }
        }
    }
}
