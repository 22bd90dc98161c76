//! Uploads the lists of a scene to buffers on the graphics device, each list once.

use super::camera::{Orbit, Projection};
use super::scene::{Batch, Line, Overlay, Scene};
use bytemuck::{Pod, Zeroable};
use std::collections::HashMap;
use std::ops::Range;
use wgpu::util::DeviceExt;

/// The data that all shaders read; `globals.wgsl` has the same layout.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Globals {
    clip_from_world: [[f32; 4]; 4],
    size_px: [f32; 2],
    scale: f32,
    padding: f32,
    viewer: [f32; 4],
}

impl Globals {
    pub(super) fn new(camera: &Orbit, size_px: [u32; 2], scale: f32) -> Self {
        let size_px = size_px.map(|length| length as f32);
        let [_, _, forward] = camera.right_up_forward();
        let (viewer, w) = match camera.projection {
            Projection::Perspective => (camera.eye(), 1.0),
            Projection::Orthographic => (forward.map(|f| -f), 0.0),
        };
        Self {
            clip_from_world: camera.view_projection(size_px[0] / size_px[1]).into(),
            size_px,
            scale,
            padding: 0.0,
            viewer: [viewer[0], viewer[1], viewer[2], w],
        }
    }
}

/// A [`Line`] in the layout of `lines.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Segment {
    a: [f32; 3],
    b: [f32; 3],
    color: [u8; 4],
    width_px: f32,
    dash_px: f32,
}

impl From<&Line> for Segment {
    fn from(line: &Line) -> Self {
        let Line { a, b, color, width_px, dash_px, overlay: _ } = *line;
        Self { a, b, color, width_px, dash_px }
    }
}

/// A buffer and the number of items in it.
pub(super) struct Chunk {
    pub(super) buffer: wgpu::Buffer,
    pub(super) items: u32,
}

/// All lines in one buffer, ordered by [`Overlay`], with the range of each kind.
#[derive(Default)]
pub(super) struct Lines {
    revision: u64,
    pub(super) buffer: Option<wgpu::Buffer>,
    pub(super) hidden: Range<u32>,
    pub(super) faint: Range<u32>,
    pub(super) over: Range<u32>,
}

/// The data on the device.
#[derive(Default)]
pub(super) struct Uploads {
    /// The buffers of points and triangles by revision. A long list is divided among several buffers.
    batches: HashMap<u64, Vec<Chunk>>,
    pub(super) lines: Lines,
}

impl Uploads {
    /// Uploads the new lists of the scene and deletes the buffers of lists that are not in the scene.
    pub(super) fn update(&mut self, device: &wgpu::Device, scene: &Scene) {
        let revisions = revisions(scene);
        self.batches.retain(|revision, _| revisions.contains(revision));
        for points in &scene.points {
            self.add(device, points, "points");
        }
        for mesh in &scene.meshes {
            self.add(device, &mesh.triangles, "solid");
        }
        if self.lines.revision != scene.lines.revision() {
            self.lines = Lines::new(device, &scene.lines);
        }
    }

    /// The buffers of a list of the scene that was passed to [`Self::update`].
    pub(super) fn chunks<T>(&self, batch: &Batch<T>) -> &[Chunk] {
        self.batches.get(&batch.revision()).map_or(&[], Vec::as_slice)
    }

    fn add<T: Pod>(&mut self, device: &wgpu::Device, batch: &Batch<T>, label: &str) {
        self.batches.entry(batch.revision()).or_insert_with(|| {
            let most = device.limits().max_buffer_size / size_of::<T>() as u64;
            // The length of a buffer is a multiple of three items, so that no triangle is divided.
            let most = usize::try_from(most - most % 3).unwrap_or(usize::MAX - 2).max(3);
            let chunks = batch.chunks(most);
            chunks
                .map(|items| Chunk { buffer: upload(device, items, label), items: items.len() as u32 })
                .collect()
        });
    }
}

impl Lines {
    fn new(device: &wgpu::Device, lines: &Batch<Line>) -> Self {
        let of = |overlay| lines.iter().filter(move |line| line.overlay == overlay).map(Segment::from);
        let mut segments: Vec<Segment> = of(Overlay::Hidden).collect();
        let hidden_end = segments.len() as u32;
        segments.extend(of(Overlay::Faint));
        let faint_end = segments.len() as u32;
        segments.extend(of(Overlay::Over));
        Self {
            revision: lines.revision(),
            buffer: (!segments.is_empty()).then(|| upload(device, &segments, "lines")),
            hidden: 0..hidden_end,
            faint: hidden_end..faint_end,
            over: faint_end..segments.len() as u32,
        }
    }
}

/// The revisions of all lists of the scene, in the order of drawing.
pub(super) fn revisions(scene: &Scene) -> Vec<u64> {
    let points = scene.points.iter().map(Batch::revision);
    let meshes = scene.meshes.iter().map(|mesh| mesh.triangles.revision());
    points.chain(meshes).chain([scene.lines.revision()]).collect()
}

fn upload<T: Pod>(device: &wgpu::Device, items: &[T], label: &str) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some(label),
        contents: bytemuck::cast_slice(items),
        usage: wgpu::BufferUsages::VERTEX,
    })
}
