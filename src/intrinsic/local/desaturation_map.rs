//! Rule `local_split`: the desaturation of each pixel against the pixels of the same hue around it.

use super::hue_ratios::HueRatios;
use super::lamps::Lamps;
use super::region_ratios::{RegionRatios, Regions};
use crate::raster::{Raster, Roi};
use crate::reflection::{Desaturation, WhitenedColor};
use crate::segment::AnalysisInput;
use crate::trace::LocalLimits;
use rayon::prelude::*;

/// The desaturation of the pixels of a window.
pub struct DesaturationMap<'a> {
    /// The window.
    pub roi: Roi,
    /// The desaturation of each pixel; zeros for dark pixels.
    pub points: Raster<Desaturation>,
    /// 1 for a pixel that is neither dark nor clipped, else 0.
    pub usable: Raster<f32>,
    /// The whitened color of each pixel; zeros for dark pixels.
    pub colors: Raster<WhitenedColor>,
    /// The lamps.
    pub lamps: Lamps,
    ratios: HueRatios,
    region_ratios: RegionRatios<'a>,
}

impl<'a> DesaturationMap<'a> {
    /// The desaturation under the light of `lamps`.
    pub fn new(
        input: &AnalysisInput,
        limits: &LocalLimits,
        lamps: &Lamps,
        roi: Roi,
        regions: &Regions<'a>,
    ) -> Self {
        let colors = whitened_colors(input, lamps);
        let ratios = HueRatios::new(input, limits, &colors);
        let colors = roi.cropped(colors);
        let region_ratios = RegionRatios::new(input, limits, lamps, regions);
        let mut points = Raster::filled(roi.width, roi.height, Desaturation::default());
        points.as_mut_slice().par_chunks_mut(roi.width).enumerate().for_each(|(row, points)| {
            if input.stopped() {
                return;
            }
            for (column, (point, &color)) in points.iter_mut().zip(colors.row(row)).enumerate() {
                let pixel = roi.at(column, row);
                if input.masks.dark(pixel) {
                    continue;
                }
                let (x, y) = (roi.left + column, roi.top + row);
                *point = match ratios.at(x, y, color.hue_turns) {
                    Some(around) => {
                        let ratios = region_ratios.or_around(pixel, color.hue_turns, around);
                        limits.desaturation(color, ratios, input.masks.clipped(pixel))
                    }
                    None => Desaturation::unjudged(color, 1.0),
                };
            }
        });
        let usable =
            roi.raster(|pixel| if input.masks.dark(pixel) || input.masks.clipped(pixel) { 0.0 } else { 1.0 });
        Self { roi, points, usable, colors, lamps: lamps.clone(), ratios, region_ratios }
    }

    /// A raster of the window whose values are `of` the indices of the pixels, computed in parallel.
    pub fn raster<T: Send + Default>(&self, of: impl Fn(usize) -> T + Sync + Send) -> Raster<T> {
        let data = (0..self.points.len()).into_par_iter().with_min_len(1 << 12).map(of).collect();
        // The lengths agree by construction.
        Raster::from_vec(self.roi.width, self.roi.height, data).unwrap_or_default()
    }

    /// κ and the median of a/c around the pixel at `index` of the window, or those of its region; `None` where no counted pixel of
    /// the picture has the hue or a neighboring hue.
    pub fn ratios(&self, input: &AnalysisInput, index: usize) -> Option<[f32; 2]> {
        let (x, y) = (self.roi.left + index % self.roi.width, self.roi.top + index / self.roi.width);
        let pixel = self.roi.pixel(index);
        let hue_turns = self.lamps.of(pixel).gain.whitened(input.pixels[pixel]).hue_turns;
        let around = self.ratios.at(x, y, hue_turns)?;
        Some(self.region_ratios.or_around(pixel, hue_turns, around))
    }
}

/// The colors of a picture under white light; zeros for dark pixels.
fn whitened_colors(input: &AnalysisInput, lamps: &Lamps) -> Raster<WhitenedColor> {
    let width = input.pixels.width();
    let mut colors = Raster::filled(width, input.pixels.height(), WhitenedColor::default());
    colors.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, (whitened, &color)) in row.iter_mut().zip(input.pixels.row(y)).enumerate() {
            let pixel = y * width + x;
            if !input.masks.dark(pixel) {
                *whitened = lamps.of(pixel).gain.whitened(color);
            }
        }
    });
    colors
}
