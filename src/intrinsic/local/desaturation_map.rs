//! Rule `local_split`: the desaturation of each pixel against the pixels of the same hue around it.

use super::hue_ratios::HueRatios;
use crate::color::Vec3;
use crate::raster::{Raster, Roi};
use crate::reflection::{Desaturation, WhiteningGain};
use crate::segment::AnalysisInput;
use crate::trace::LocalLimits;
use rayon::prelude::*;

/// The desaturation of the pixels of a window.
pub struct DesaturationMap {
    /// The window.
    pub roi: Roi,
    /// The desaturation of each pixel; zeros for dark pixels and for pixels without others of their hue around them.
    pub points: Raster<Desaturation>,
    gain: WhiteningGain,
    ratios: HueRatios,
}

impl DesaturationMap {
    /// The desaturation under the light `light`, unit; none where the light lacks a band.
    pub fn new(input: &AnalysisInput, limits: &LocalLimits, light: &Vec3, roi: Roi) -> Option<Self> {
        let gain = WhiteningGain::new(light)?;
        let ratios = HueRatios::new(input, limits, &gain);
        let mut points = Raster::filled(roi.width, roi.height, Desaturation::default());
        points.as_mut_slice().par_chunks_mut(roi.width).enumerate().for_each(|(row, points)| {
            if input.stopped() {
                return;
            }
            for (column, point) in points.iter_mut().enumerate() {
                let pixel = roi.at(column, row);
                if input.masks.dark(pixel) {
                    continue;
                }
                let color = gain.whitened(input.pixels[pixel]);
                let (x, y) = (roi.left + column, roi.top + row);
                let Some(ratios) = ratios.at(x, y, color.hue_turns) else { continue };
                *point = limits.desaturation(color, ratios, input.masks.clipped(pixel));
            }
        });
        Some(Self { roi, points, gain, ratios })
    }

    /// κ and the median of a/c around the pixel at `index` of the window; none where no pixel around has the pixel's hue.
    pub fn ratios(&self, input: &AnalysisInput, index: usize) -> Option<[f32; 2]> {
        let (x, y) = (self.roi.left + index % self.roi.width, self.roi.top + index / self.roi.width);
        let color = self.gain.whitened(input.pixels[self.roi.pixel(index)]);
        self.ratios.at(x, y, color.hue_turns)
    }
}
