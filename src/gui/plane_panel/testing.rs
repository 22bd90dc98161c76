//! The drawing of the plane panel as plain data, for tests.

use super::Chart;
use crate::gui::App;
use crate::view::RegionPlane;
use egui::{Pos2, Rect};

/// What the plane panel has drawn last.
#[derive(Clone, Debug)]
pub struct PlaneDrawing {
    /// The region's dichromatic plane and the pixels in it.
    pub plane: RegionPlane,
    /// The point in the middle of the panel, counts along the matte line and across it.
    pub center: [f32; 2],
    /// Scale: counts a point of the screen.
    pub counts_per_pt: f32,
    chart: Chart,
}

impl PlaneDrawing {
    /// The drawing in this application's window; none where no region is selected.
    pub fn of(app: &App) -> Option<Self> {
        let panel = &app.panels().plane;
        let (plane, chart) = (panel.plane.clone()?, panel.chart?);
        Some(Self { plane, center: chart.center, counts_per_pt: chart.counts_per_pt, chart })
    }

    /// Where amounts of body and surface reflection (counts) are on the screen, if `canvas` is the panel's rectangle there.
    pub fn screen(&self, [body, surface]: [f32; 2], canvas: Rect) -> Pos2 {
        self.chart.screen(self.plane.oblique(body, surface), canvas)
    }
}
