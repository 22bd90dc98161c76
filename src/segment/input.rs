//! What every stage of the segmentation looks at.

use crate::params::{Refine, UsedParams};
use crate::photo::{LinearImage, Masks};
use crate::raster::Raster;

/// The image, its masks and the numbers to work with.
#[derive(Clone, Copy)]
pub struct AnalysisInput<'a> {
    /// Colors, linear counts.
    pub pixels: &'a Raster<[f32; 3]>,
    /// Which of them to believe.
    pub masks: &'a Masks,
    /// The control parameters.
    pub used: &'a UsedParams,
    /// The refinements in force.
    pub refine: Refine,
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> AnalysisInput<'a> {
    /// The image and its masks, with what to work with.
    pub fn new(image: &'a LinearImage, masks: &'a Masks, used: &'a UsedParams, refine: Refine) -> Self {
        Self { pixels: &image.pixels, masks, used, refine, stop: &|| false }
    }

    /// The same scene, whose stages give up with half a result soon after `stop` turns true.
    #[must_use]
    pub fn stopped_by(self, stop: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { stop, ..self }
    }

    /// The same scene with other colors, such as those without the ambient light.
    #[must_use]
    pub fn with_pixels<'b>(&self, pixels: &'b Raster<[f32; 3]>) -> AnalysisInput<'b>
    where
        'a: 'b,
    {
        AnalysisInput { pixels, ..*self }
    }

    /// Whether to give up. Asked once a hypothesis, a row, or every 64k pixels that a region grows from.
    pub fn stopped(&self) -> bool {
        (self.stop)()
    }

    /// Standard deviation of a band's noise, counts: half of σ0.
    pub fn sigma(&self) -> f64 {
        self.used.camera_noise / 2.0
    }

    /// Whether a hypothesis may claim the pixel by its color. The paper excludes only dark pixels; refined, distorted
    /// ones wait for the clipping stage.
    #[inline]
    pub fn claimable(&self, pixel: usize) -> bool {
        if self.refine.tail_test { self.masks.usable(pixel) } else { !self.masks.dark(pixel) }
    }
}
