//! The scores of a result against the ground truth.

use serde::{Deserialize, Serialize};

/// The scores of one result, as `truth::score` computes them.
///
/// A score for which the ground truth has no pixels or vectors is none. For each PSNR (decibels on the 0–255 scale) there is the
/// PSNR of the trivial result on the same pixels: body = input, surface = 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Adjusted Rand index of objects and regions over the objects' lit pixels; 1 for a single object.
    pub ari: f64,
    /// Mean over objects of the best region's intersection over union.
    pub iou: Option<f64>,
    /// The least of these.
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
    /// PSNR of the body image on unclipped pixels of objects.
    pub psnr_body: Option<f64>,
    /// PSNR of the surface image on unclipped pixels of objects.
    pub psnr_surface: Option<f64>,
    /// PSNR of the body image on partly clipped pixels of objects.
    pub psnr_restored: Option<f64>,
    /// PSNR of the input as the body image on unclipped pixels of objects.
    pub psnr_nothing: Option<f64>,
    /// PSNR of black as the surface image on unclipped pixels of objects.
    pub psnr_surface_nothing: Option<f64>,
    /// PSNR of the input as the body image on partly clipped pixels of objects.
    pub psnr_restored_nothing: Option<f64>,
}

impl Scores {
    /// All scores with their names, each PSNR followed by that of the trivial result.
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
