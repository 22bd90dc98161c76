//! How far the split of each pixel is to be believed, 0…1.
//!
//! Where its region holds: how well the region's plane fits, how far body and surface vector are apart, and how far the pixel
//! itself lies off the plane. Restored pixels are believed less, lost ones hardly. Elsewhere the local split is believed by how
//! little its surface reflection looks like texture, and what was left alone not at all: there, body is the input.

use super::RegionReflection;
use crate::raster::{LabelMap, Mask, Raster};
use crate::segment::{POOR_FIT, RegionFit};
use crate::trace::PixelKind;
use rayon::prelude::*;

/// Distance from the plane from which on the split of a pixel or region is not believed at all, σ.
const HOPELESS: f64 = 2.0 * POOR_FIT;
/// Angle between body and surface vector from which on noise is no trouble, degrees.
const WIDE_DEG: f64 = 14.0;
/// What restored pixels and those without any good band keep of their region's confidence.
const RESTORED: f32 = 0.6;
const LOST: f32 = 0.1;
/// Most that a pixel of the local split has.
pub const LOCAL: f32 = 0.5;

/// Of a region: 1 where all is noise, 0 where it does not hold.
pub fn of_region(fit: &RegionFit, holds: bool, angle_deg: Option<f64>, sigma: f64) -> f64 {
    if !holds {
        return 0.0;
    }
    let fitting = ((HOPELESS - fit.rms_counts / sigma.max(1e-9)) / (HOPELESS - 1.0)).clamp(0.0, 1.0);
    let apart = angle_deg
        .map_or(1.0, |angle| (angle.to_radians().sin() / WIDE_DEG.to_radians().sin()).clamp(0.0, 1.0));
    // The maximum of a number and none is the number.
    (fitting * apart * (1.0 - fit.texture.clamp(0.0, 1.0))).max(0.0)
}

/// What the confidence of pixels is made from.
pub struct ConfidenceInput<'a> {
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// Where the plane was used.
    pub explained_mask: &'a Mask,
    /// What each pixel is to its region.
    pub kinds: &'a Raster<PixelKind>,
    /// Distance from the plane, counts.
    pub noise: &'a Raster<f32>,
    /// The regions.
    pub regions: &'a [RegionReflection],
    /// Standard deviation of a band's noise, counts.
    pub sigma: f32,
}

impl ConfidenceInput<'_> {
    /// Of each pixel. `local`: that of the local split where it found surface reflection, else 0.
    pub fn confidence(&self, local: Option<&Raster<f32>>) -> Raster<f32> {
        let width = self.labels.width();
        let mut confidence = Raster::filled(width, self.labels.height(), 0.0f32);
        confidence.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            for (x, confidence) in row.iter_mut().enumerate() {
                let pixel = y * width + x;
                *confidence = if self.explained_mask[pixel] {
                    self.by_plane(pixel)
                } else {
                    local.map_or(0.0, |local| local[pixel])
                };
            }
        });
        confidence
    }

    fn by_plane(&self, pixel: usize) -> f32 {
        let region = self.regions.get(usize::from(self.labels[pixel]).wrapping_sub(1));
        let of_region = region.map_or(0.0, |region| region.confidence as f32);
        let of_kind = match self.kinds[pixel] {
            PixelKind::Restored => RESTORED,
            PixelKind::Lost => LOST,
            _ => {
                let off = self.noise[pixel].abs() / self.sigma.max(1e-9);
                (2.0 - off / HOPELESS as f32).clamp(0.0, 1.0)
            }
        };
        of_region * of_kind
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_trusted_and_what_does_not_hold_is_not() {
        let fit = |rms_counts| RegionFit { rms_counts, ..RegionFit::default() };
        assert!((of_region(&fit(1.25), true, Some(30.0), 1.25) - 1.0).abs() < 1e-9);
        assert!((of_region(&fit(1.25), true, Some(5.0), 1.25) - 0.36).abs() < 0.01);
        let worse = of_region(&fit(1.8), true, Some(30.0), 1.25);
        assert!(worse < 0.8 && worse > 0.5, "{worse}");
        assert!(of_region(&fit(1.0), false, Some(30.0), 1.25).abs() < 1e-9);
        assert!(of_region(&fit(f64::NAN), true, None, 0.0).abs() < 1e-9, "no number is no confidence");
    }
}
