//! How far a result is from the ground truth, in numbers.

use serde::{Deserialize, Serialize};

/// The scores of one result, as `truth::score` computes them.
///
/// A figure that the truth offers no pixels or vectors for is none. Each PSNR (decibels on the 0–255 scale) has a
/// partner that says what doing nothing scores on the same pixels: body = input, surface = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Adjusted Rand index of objects and regions over the objects' lit pixels; 1 for a single object.
    pub ari: f64,
    /// Mean over objects of the best region's intersection over union.
    pub iou: Option<f64>,
    /// The worst of them.
    pub iou_min: Option<f64>,
    /// Share of the objects' lit pixels that are in a region.
    pub cover: Option<f64>,
    /// Number of regions.
    pub regions: usize,
    /// Number of objects with more than 200 lit pixels.
    pub objects: usize,
    /// Mean angle between the body vectors of objects and their best regions, degrees.
    pub body_deg: Option<f64>,
    /// Angle between the true and the found illuminant, degrees; 90 where none was found.
    pub illum_deg: f64,
    /// Body image inside objects, unclipped.
    pub psnr_body: Option<f64>,
    /// Surface image inside objects, unclipped.
    pub psnr_surface: Option<f64>,
    /// Body image on partly clipped pixels of objects.
    pub psnr_restored: Option<f64>,
    /// What the input itself scores as body image inside objects.
    pub psnr_nothing: Option<f64>,
    /// What black scores as surface image inside objects.
    pub psnr_surface_nothing: Option<f64>,
    /// What the input itself scores as body image on partly clipped pixels.
    pub psnr_restored_nothing: Option<f64>,
}

impl Scores {
    /// Every figure with its name, each PSNR followed by what doing nothing scores.
    pub fn figures(&self) -> [(&'static str, Option<f64>); 14] {
        [
            ("ari", Some(self.ari)),
            ("iou", self.iou),
            ("iou_min", self.iou_min),
            ("cover", self.cover),
            ("regions", Some(self.regions as f64)),
            ("objects", Some(self.objects as f64)),
            ("body_deg", self.body_deg),
            ("illum_deg", Some(self.illum_deg)),
            ("psnr_body", self.psnr_body),
            ("psnr_nothing", self.psnr_nothing),
            ("psnr_surface", self.psnr_surface),
            ("psnr_surface_nothing", self.psnr_surface_nothing),
            ("psnr_restored", self.psnr_restored),
            ("psnr_restored_nothing", self.psnr_restored_nothing),
        ]
    }
}
