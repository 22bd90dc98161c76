//! The input of every stage of the segmentation.

use crate::params::{Refine, UsedParams};
use crate::photo::{LinearImage, Masks};
use crate::raster::Raster;

/// The image, its masks and the parameters.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct AnalysisInput<'a> {
    /// Colors, linear counts.
    pub pixels: &'a Raster<[f32; 3]>,
    /// The masks: which pixels are dark, clipped, bloomed, invalid or outside the area.
    pub masks: &'a Masks,
    /// The control parameters (table 6), none of them `auto`.
    pub used: &'a UsedParams,
    /// The refinements in force.
    pub refine: Refine,
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> AnalysisInput<'a> {
    /// The input of a run that is never stopped.
    pub fn new(image: &'a LinearImage, masks: &'a Masks, used: &'a UsedParams, refine: Refine) -> Self {
        Self { pixels: &image.pixels, masks, used, refine, stop: &|| false }
    }

    /// The same input with a condition that stops the stages: they return an incomplete result soon after `stop` returns true.
    #[must_use]
    pub fn stopped_by(self, stop: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { stop, ..self }
    }

    /// The same input with other colors, for example those without the ambient light. The shape must be the same.
    #[must_use]
    pub fn with_pixels<'b>(&self, pixels: &'b Raster<[f32; 3]>) -> AnalysisInput<'b>
    where
        'a: 'b,
    {
        AnalysisInput { pixels, ..*self }
    }

    /// Whether the stage is to stop. Stages ask once per hypothesis, per row, or per 64k pixels that a region grows from.
    pub fn stopped(&self) -> bool {
        (self.stop)()
    }

    /// Standard deviation of a band's noise, counts: half of σ0.
    pub fn sigma(&self) -> f64 {
        self.used.camera_noise / 2.0
    }

    /// Whether a hypothesis may claim the pixel by its color. The paper excludes only dark pixels; with `tail_test`, clipped
    /// and bloomed pixels wait for the clipping stage.
    #[inline]
    pub fn claimable(&self, pixel: usize) -> bool {
        self.masks.claimable_by_color(pixel, self.refine.tail_test)
    }
}
