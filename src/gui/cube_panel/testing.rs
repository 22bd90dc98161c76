//! The drawing of the color space panel as plain data, for tests.

use super::{CubePanel, frame};
use crate::gpu::Orbit;
use crate::gui::App;
use crate::raster::RegionId;
use egui::{Pos2, Rect};
use egui_wgpu::RenderState;

/// The color space panel's last drawing.
#[derive(Clone, Debug)]
pub struct ColorSpaceDrawing {
    /// The camera that the scene was drawn with.
    pub orbit: Orbit,
    /// Position of each bin of the color histogram, world units (counts / 255).
    pub bins: Vec<[f32; 3]>,
    /// The region that most pixels of each bin are in.
    pub bin_regions: Vec<Option<RegionId>>,
    /// Number of points in focus, and number of points drawn faint behind them.
    pub points: [usize; 2],
    /// Vertices of each solid, three a triangle, world units.
    pub solids: Vec<Vec<[f32; 3]>>,
}

impl ColorSpaceDrawing {
    /// The drawing in this application's window.
    pub fn of(app: &App) -> Self {
        let CubePanel { camera_controller, cloud, figure, .. } = &app.panels().cube;
        let vertices =
            |mesh: &crate::gpu::Mesh| mesh.triangles().iter().map(|vertex| vertex.position).collect();
        Self {
            orbit: camera_controller.orbit,
            bins: cloud.bins.iter().map(|bin| bin.position).collect(),
            bin_regions: (0..cloud.bins.len() as u32).map(|bin| cloud.region_of(bin)).collect(),
            points: cloud.drawn.each_ref().map(|batch| batch.len()),
            solids: figure.meshes.iter().map(vertices).collect(),
        }
    }

    /// Screen position of a point in world units, where `canvas` is the panel's rectangle on the screen; `None`
    /// behind the camera.
    pub fn screen(&self, canvas: Rect, world: [f32; 3]) -> Option<Pos2> {
        frame::screen_from_world(&self.orbit.projector(canvas.size().into()), canvas, world)
    }
}

/// The panel's image as the graphics device holds it: columns and rows, then sRGB bytes with alpha, row-major. `None`
/// before the first frame.
pub fn color_space_pixels(app: &App, gpu: &RenderState) -> Option<([u32; 2], Vec<u8>)> {
    app.panels().cube.canvas.read_back(gpu)
}
