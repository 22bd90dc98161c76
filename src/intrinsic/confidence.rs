//! Confidence in the split of each pixel, 0…1.
//!
//! Where a region's skewed T explains the pixel, confidence falls with the misfit of the region's plane, with a small angle between
//! body and surface vector, and with the pixel's distance from the plane. Restored pixels keep 60 % of that, lost pixels 10 %.
//! Elsewhere the confidence of the local split falls with texture. Where nothing was split, the body image is the input and
//! confidence is 0.

use super::RegionReflection;
use crate::raster::{LabelMap, Mask, Raster, RegionId};
use crate::segment::RegionFit;
use crate::trace::PixelKind;
use rayon::prelude::*;

/// Distance from the plane from which on confidence in a pixel or region is 0, standard deviations of noise
/// and coding.
const ZERO_CONFIDENCE_SIGMAS: f64 = 3.0;
/// Angle between body and surface vector from which on the angle does not lower confidence, degrees.
const WIDE_DEG: f64 = 14.0;
/// Share of the region's confidence that restored pixels have.
const RESTORED: f32 = 0.6;
/// Share of the region's confidence that pixels without any good band have.
const LOST: f32 = 0.1;
/// Largest confidence of a pixel of the local split.
pub const LOCAL: f32 = 0.5;

/// Confidence in a region: 1 where the pixels differ from the plane by noise only, 0 where `model_fits` is false. `angle_deg`: angle
/// between body and surface vector; none without a plane.
pub fn of_region(fit: &RegionFit, model_fits: bool, angle_deg: Option<f64>) -> f64 {
    if !model_fits {
        return 0.0;
    }
    let fitting = ((ZERO_CONFIDENCE_SIGMAS - fit.rms_counts / fit.sigma_counts.max(1e-9))
        / (ZERO_CONFIDENCE_SIGMAS - 1.0))
        .clamp(0.0, 1.0);
    let apart = angle_deg
        .map_or(1.0, |angle| (angle.to_radians().sin() / WIDE_DEG.to_radians().sin()).clamp(0.0, 1.0));
    // The maximum of NaN and 0 is 0.
    (fitting * apart * (1.0 - fit.texture.clamp(0.0, 1.0))).max(0.0)
}

/// The data from which the confidence of the pixels is computed.
pub struct ConfidenceInput<'a> {
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// The pixels that the skewed T of their region explains.
    pub explained_mask: &'a Mask,
    /// The kind of each pixel.
    pub kinds: &'a Raster<PixelKind>,
    /// Distance from the plane, counts.
    pub noise: &'a Raster<f32>,
    /// The regions.
    pub regions: &'a [RegionReflection],
    /// What noise and coding explain of the distance of a pixel from the plane of each region (σ), counts, by
    /// [`RegionId::index`].
    pub pixel_sigmas: &'a [f32],
}

impl ConfidenceInput<'_> {
    /// The confidence of each pixel. `local`: the confidence of the local split, 0 where it found no surface reflection; none where
    /// it did not run.
    pub fn confidence(&self, local: Option<Raster<f32>>) -> Raster<f32> {
        let width = self.labels.width();
        let mut confidence = local.unwrap_or_else(|| Raster::filled(width, self.labels.height(), 0.0));
        confidence.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            let explained =
                self.explained_mask.row(y).iter().enumerate().filter(|(_, is_explained)| **is_explained);
            for (x, _) in explained {
                row[x] = self.by_plane(y * width + x);
            }
        });
        confidence
    }

    /// The confidence of a pixel that its region explains.
    fn by_plane(&self, pixel: usize) -> f32 {
        let Some(region) = RegionId::from_label(self.labels[pixel]) else { return 0.0 };
        let of_region = self.regions.get(region.index()).map_or(0.0, |region| region.confidence as f32);
        let of_kind = match self.kinds[pixel] {
            PixelKind::Restored => RESTORED,
            PixelKind::Lost => LOST,
            _ => {
                let sigma = self.pixel_sigmas.get(region.index()).copied().unwrap_or(0.0);
                let off = self.noise[pixel].abs() / sigma.max(1e-9);
                (2.0 - off / ZERO_CONFIDENCE_SIGMAS as f32).clamp(0.0, 1.0)
            }
        };
        of_region * of_kind
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn confidence_is_one_for_noise_and_zero_where_the_model_does_not_fit() {
        let fit = |rms_counts| RegionFit { rms_counts, sigma_counts: 1.25, ..RegionFit::default() };
        assert!((of_region(&fit(1.25), true, Some(30.0)) - 1.0).abs() < 1e-9);
        assert!((of_region(&fit(1.25), true, Some(5.0)) - 0.36).abs() < 0.01);
        let worse = of_region(&fit(1.8), true, Some(30.0));
        assert!(worse < 0.8 && worse > 0.5, "{worse}");
        assert!(of_region(&fit(1.0), false, Some(30.0)).abs() < 1e-9);
        assert!(of_region(&fit(f64::NAN), true, None).abs() < 1e-9, "NaN gives confidence 0");
    }
}
