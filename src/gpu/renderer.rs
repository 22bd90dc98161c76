//! Draws a scene from the view of a camera, when the scene, the camera or the size has changed.

use super::camera::Orbit;
use super::pipelines::Pipelines;
use super::scene::{Mesh, Scene};
use super::target::{Target, within_limits};
use super::upload::{Chunk, Globals, Uploads, revisions};
use nalgebra::Vector3;
use std::ops::Range;

const CORNERS_OF_A_DOT: u32 = 3;
const CORNERS_OF_A_LINE: u32 = 4;

/// Draws scenes into a texture, on a device with or without a window.
pub struct Renderer {
    pipelines: Pipelines,
    uploads: Uploads,
    target: Target,
    generation: u64,
    drawn: Option<Frame>,
}

/// Everything that a picture depends on.
#[derive(PartialEq)]
struct Frame {
    camera: Orbit,
    size_px: [u32; 2],
    scale: f32,
    background: [u8; 4],
    revisions: Vec<u64>,
}

impl Renderer {
    /// Compiles the shaders; the picture is one transparent pixel until [`Self::draw`].
    pub fn new(device: &wgpu::Device) -> Self {
        Self {
            pipelines: Pipelines::new(device),
            uploads: Uploads::default(),
            target: Target::new(device, [1, 1]),
            generation: 0,
            drawn: None,
        }
    }

    /// Draws the picture if anything has changed; returns whether the picture was drawn.
    ///
    /// `size_px` is in physical pixels; a logical pixel has `pixels_per_point` physical pixels. A size larger than the device's
    /// largest texture is reduced to that size with the same aspect ratio, see [`Self::size_px`]. At a size of 0 the picture does not
    /// change.
    pub fn draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        camera: &Orbit,
        size_px: [u32; 2],
        pixels_per_point: f32,
    ) -> bool {
        if size_px.contains(&0) {
            return false;
        }
        let (size_px, shrink) = within_limits(size_px, device.limits().max_texture_dimension_2d);
        let frame = Frame {
            camera: *camera,
            size_px,
            scale: pixels_per_point * shrink,
            background: scene.background,
            revisions: revisions(scene),
        };
        if self.drawn.as_ref() == Some(&frame) {
            return false;
        }
        if self.target.size_px != size_px {
            self.target = Target::new(device, size_px);
            self.generation += 1;
        }
        self.uploads.update(device, scene);
        let globals = Globals::new(camera, size_px, frame.scale);
        queue.write_buffer(&self.pipelines.globals, 0, bytemuck::bytes_of(&globals));
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.encode(&mut encoder, scene, camera);
        queue.submit([encoder.finish()]);
        self.drawn = Some(frame);
        true
    }

    /// The picture: format `Rgba8Unorm`, sRGB, premultiplied alpha.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.target.color_view
    }

    /// A number that rises by one when [`Self::view`] returns another view, which then has to be registered again.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Width and height of the picture, physical pixels.
    pub fn size_px(&self) -> [u32; 2] {
        self.target.size_px
    }

    /// The picture as rows from the top, sRGB bytes RGBA with straight alpha. Waits for the device; `None` when the device was
    /// lost.
    pub fn read_back(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Vec<u8>> {
        let mut bytes = self.target.read_back(device, queue)?;
        for [rgb @ .., alpha] in bytes.as_chunks_mut::<4>().0 {
            if !matches!(alpha, 0 | 255) {
                let alpha = u16::from(*alpha);
                *rgb = rgb.map(|c| ((u16::from(c) * 255 + alpha / 2) / alpha).min(255) as u8);
            }
        }
        Some(bytes)
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene, camera: &Orbit) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("color space"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.target.color_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(clear_color(scene.background)),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.target.depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        });
        let Pipelines { points, lines, faint_lines, over_lines, bind_group, .. } = &self.pipelines;
        pass.set_bind_group(0, bind_group, &[]);
        pass.set_pipeline(points);
        for Chunk { buffer, items } in scene.points.iter().flat_map(|batch| self.uploads.chunks(batch)) {
            pass.set_vertex_buffer(0, buffer.slice(..));
            pass.draw(0..CORNERS_OF_A_DOT, 0..*items);
        }
        let of_lines = &self.uploads.lines;
        // The hidden parts are drawn first, because the visible parts write depth and would hide parts of the same line.
        self.encode_lines(&mut pass, faint_lines, of_lines.faint.clone());
        self.encode_lines(&mut pass, lines, of_lines.hidden.start..of_lines.faint.end);
        self.encode_solids(&mut pass, &scene.meshes, camera);
        self.encode_lines(&mut pass, over_lines, of_lines.over.clone());
    }

    fn encode_lines(&self, pass: &mut wgpu::RenderPass, pipeline: &wgpu::RenderPipeline, which: Range<u32>) {
        if let Some(buffer) = self.uploads.lines.buffer.as_ref().filter(|_| !which.is_empty()) {
            pass.set_pipeline(pipeline);
            pass.set_vertex_buffer(0, buffer.slice(..));
            pass.draw(0..CORNERS_OF_A_LINE, which);
        }
    }

    /// Draws far solids before near ones, and the far side of each solid before the near side.
    fn encode_solids(&self, pass: &mut wgpu::RenderPass, meshes: &[Mesh], camera: &Orbit) {
        let [_, _, forward] = camera.right_up_forward();
        let depth = |mesh: &Mesh| Vector3::from(mesh.center).dot(&Vector3::from(forward));
        let mut far_to_near: Vec<&Mesh> = meshes.iter().collect();
        far_to_near.sort_by(|one, other| depth(other).total_cmp(&depth(one)));
        for mesh in far_to_near {
            for pipeline in [&self.pipelines.back_faces, &self.pipelines.front_faces] {
                pass.set_pipeline(pipeline);
                for Chunk { buffer, items } in self.uploads.chunks(&mesh.triangles) {
                    pass.set_vertex_buffer(0, buffer.slice(..));
                    pass.draw(0..*items, 0..1);
                }
            }
        }
    }
}

/// The color of the background with premultiplied alpha, like the picture.
fn clear_color([r, g, b, a]: [u8; 4]) -> wgpu::Color {
    let a = f64::from(a) / 255.0;
    let [r, g, b] = [r, g, b].map(|c| f64::from(c) / 255.0 * a);
    wgpu::Color { r, g, b, a }
}
