//! The drawing of the plane panel as plain data, for tests.

use super::Chart;
use crate::gui::App;
use crate::view::RegionPlane;
use egui::{Pos2, Rect};

/// The plane panel's last drawing.
#[derive(Clone, Debug)]
pub struct PlaneDrawing {
    /// The region's dichromatic plane and the pixels in it.
    pub plane: RegionPlane,
    /// The point in the middle of the panel, counts along the matte line and across it.
    pub center: [f32; 2],
    /// Scale, counts per screen point.
    pub counts_per_pt: f32,
    chart: Chart,
}

impl PlaneDrawing {
    /// The drawing in this application's window; `None` when no region is selected.
    pub fn of(app: &App) -> Option<Self> {
        let panel = &app.panels().plane;
        let (plane, chart) = (panel.plane.clone()?, panel.chart?);
        Some(Self { plane, center: chart.center, counts_per_pt: chart.counts_per_pt, chart })
    }

    /// Screen position of amounts of body and surface reflection, counts, where `canvas` is the panel's
    /// rectangle on the screen.
    pub fn screen(&self, [body, surface]: [f32; 2], canvas: Rect) -> Pos2 {
        self.chart.screen(self.plane.oblique(body, surface), canvas)
    }
}
