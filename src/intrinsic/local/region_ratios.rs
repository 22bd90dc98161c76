//! The ratio of mean to chromatic part of a region that is one material (refinement `region_ratio`, beyond the paper).
//!
//! κ by place and hue (`hue_ratios`) is that of the more saturated of two materials with the same hue: a pale green ball before a
//! green wall is taken for a highlight on the wall, and comes out as green as the wall. A region tells both apart where its
//! pixels are one material: its matte line passes black within 6 counts, as the line of a highlight hardly does, half of its
//! pixels have a hue, and between the 10 % quantile and the median of ln(a/c) there is less than .15. Such a region has a ratio
//! of its own. The ratio replaces κ where it is at least 1.5 times κ; closer ratios are left to the histogram, which follows
//! what changes from place to place.
//!
//! Of 328 rendered pictures (82 scenes as they are, at JPEG 95, at JPEG 92, demosaiced with JPEG 92) six change by more than
//! .05 dB: a scene with a pale ball before a green wall 34.5 → 43.1, 34.1 → 42.8 and 33.8 → 41.1 dB (doing nothing: 33.9), one
//! with limits of the model 19.1 → 20.8 dB, a print 36.5 → 38.4 dB as it is and 40.8 → 38.5 dB at JPEG 95. Without the factor of
//! 1.5 the photograph with measured truth `animals` loses .6 dB inside highlights. With the factor four photographs of 20
//! change, none so that it is seen: the PSNR between before and after is 58 dB for one and above 80 dB for three.

use super::lamps::Lamps;
use crate::color::Line;
use crate::raster::{LabelMap, RegionId};
use crate::segment::{AnalysisInput, Members, Pixels};
use crate::trace::LocalLimits;
use std::f64::consts::TAU;

/// Largest distance of the matte line from black, counts.
const MOST_MISS_COUNTS: f64 = 6.0;
/// Largest difference between the 10 % quantile and the median of ln(a/c).
const MOST_SPREAD: f32 = 0.15;
/// Least ratio of the region's own ratio and κ.
const LEAST_FACTOR: f32 = 1.5;
/// Quantiles of ln(a/c): the spread is measured from the first, the second is taken for body reflection, the third is the median.
const QUANTILES: [f64; 3] = [0.1, 0.3, 0.5];
/// Fewest pixels with a hue.
const LEAST_PIXELS: usize = 60;
/// Largest number of pixels that are looked at, evenly chosen.
const SAMPLES: usize = 6000;
/// Largest difference of a pixel's hue from the mean hue of its region, turns.
const HUE_REACH_TURNS: f32 = 1.0 / 36.0;

/// The regions of a picture.
#[derive(Clone, Copy)]
pub struct Regions<'a> {
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// The pixels of each region.
    pub members: &'a Members,
    /// The matte line of each region, by [`RegionId::index`], counts above the ambient light.
    pub matte: &'a [Line],
}

/// The ratios of the regions that are one material.
pub struct RegionRatios<'a> {
    labels: &'a LabelMap,
    /// By [`RegionId::index`].
    of: Vec<Option<RegionRatio>>,
}

/// The ratio of one region.
#[derive(Clone, Copy, Debug, PartialEq)]
struct RegionRatio {
    /// Mean hue, turns.
    hue_turns: f32,
    /// a/c of body reflection, and the median of a/c.
    ratios: [f32; 2],
}

impl<'a> RegionRatios<'a> {
    /// The ratios of `regions`; none of any region without refinement `region_ratio`.
    pub fn new(input: &AnalysisInput, limits: &LocalLimits, lamps: &Lamps, regions: &Regions<'a>) -> Self {
        let is_wanted = |line: &Line| input.refine.region_ratio && line.foot().norm() < MOST_MISS_COUNTS;
        let of = regions.matte.iter().enumerate().map(|(index, line)| {
            let pixels = regions.members.region(RegionId::from_index(index));
            is_wanted(line).then(|| RegionRatio::of(input, limits, lamps, pixels)).flatten()
        });
        Self { labels: regions.labels, of: of.collect() }
    }

    /// κ and the median of a/c of a pixel with a hue: `around`, those of the hue around the pixel, or those of the pixel's region.
    pub fn or_around(&self, pixel: usize, hue_turns: f32, around: [f32; 2]) -> [f32; 2] {
        let own = RegionId::from_label(self.labels[pixel])
            .and_then(|id| self.of.get(id.index()).copied().flatten());
        own.and_then(|own| own.instead_of(hue_turns, around)).unwrap_or(around)
    }
}

impl RegionRatio {
    /// The ratio of a region with the pixels `pixels`; none for a region of several materials, and for one without a hue.
    fn of(input: &AnalysisInput, limits: &LocalLimits, lamps: &Lamps, pixels: Pixels) -> Option<Self> {
        let (mut logarithms, mut count) = (Vec::new(), 0usize);
        let (mut sine, mut cosine) = (0.0f64, 0.0f64);
        let sample = pixels.sample(SAMPLES).map(|pixel| pixel as usize);
        for pixel in sample.filter(|&pixel| input.masks.usable(pixel)) {
            count += 1;
            let color = lamps.of(pixel).gain.whitened(input.pixels[pixel]);
            if limits.has_hue(color) {
                logarithms.push((color.mean / color.chroma).ln());
                let (sin, cos) = (f64::from(color.hue_turns) * TAU).sin_cos();
                sine += sin;
                cosine += cos;
            }
        }
        if logarithms.len() < LEAST_PIXELS || 2 * logarithms.len() < count {
            return None;
        }
        let [low, body, median] = QUANTILES.map(|share| quantile(&mut logarithms, share));
        let hue_turns = (sine.atan2(cosine) / TAU).rem_euclid(1.0) as f32;
        (median - low < MOST_SPREAD).then(|| Self { hue_turns, ratios: [body, median].map(f32::exp) })
    }

    /// The region's ratios for a pixel with a hue, where they are clearly paler than those `around` the pixel.
    fn instead_of(&self, hue_turns: f32, around: [f32; 2]) -> Option<[f32; 2]> {
        let turned = (hue_turns - self.hue_turns).rem_euclid(1.0);
        let is_of_hue = turned.min(1.0 - turned) < HUE_REACH_TURNS;
        (is_of_hue && self.ratios[0] >= LEAST_FACTOR * around[0]).then_some(self.ratios)
    }
}

/// The quantile `share` (0…1) of at least one value.
fn quantile(values: &mut [f32], share: f64) -> f32 {
    let rank = ((values.len() - 1) as f64 * share) as usize;
    *values.select_nth_unstable_by(rank, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::intrinsic::local::desaturation_map::DesaturationMap;
    use crate::intrinsic::local::limits::limits;
    use crate::raster::Roi;
    use crate::segment::testing::Drawing;

    const SIDE_PX: usize = 64;

    /// The ratio of a region: the right half of a picture with the colors `color` at (x, y), whose matte line misses black by
    /// `miss_counts`.
    fn ratio_of_right_half(miss_counts: f64, color: impl Fn(f64, f64) -> Vec3) -> Option<RegionRatio> {
        let drawing = Drawing::by_place(SIDE_PX, color);
        let input = drawing.input();
        let lamps = Lamps::one(&Vec3::repeat(1.0).normalize()).unwrap();
        let labels = (0..SIDE_PX * SIDE_PX).map(|pixel| u16::from(pixel % SIDE_PX >= SIDE_PX / 2));
        let labels = LabelMap::from_vec(SIDE_PX, SIDE_PX, labels.collect()).unwrap();
        let members = Members::of(&labels, 1);
        let matte = [Line::new(Vec3::new(miss_counts, 0.0, 100.0), Vec3::z())];
        let regions = Regions { labels: &labels, members: &members, matte: &matte };
        RegionRatios::new(&input, &limits(&input), &lamps, &regions).of[0]
    }

    fn pale(x: f64, y: f64) -> Vec3 {
        Vec3::new(0.5, 0.8, 0.5) * (120.0 + x + 0.5 * y)
    }

    #[test]
    fn a_region_of_one_material_has_a_ratio_and_a_line_beside_black_has_none() {
        let found = ratio_of_right_half(0.0, pale).unwrap();
        // J = I under white light: a is .6, the chromatic part (−.1, .2, −.1) has the length .245.
        assert!((found.ratios[0] - 2.449).abs() < 0.05, "{found:?}");
        assert_eq!(ratio_of_right_half(6.1, pale), None, "a line that misses black");
        let gray = |x: f64, _: f64| Vec3::repeat(100.0 + x);
        assert_eq!(ratio_of_right_half(0.0, gray), None, "no hue");
        let two = |x: f64, y: f64| {
            if (x as usize / 4).is_multiple_of(4) { Vec3::new(0.2, 0.8, 0.2) * 150.0 } else { pale(x, y) }
        };
        assert_eq!(ratio_of_right_half(0.0, two), None, "two materials");
    }

    #[test]
    fn a_pale_body_beside_a_saturated_one_of_the_same_hue_has_no_excess() {
        let excess_of_pale_body = |region_ratio: bool| {
            let right = |x: f64| x >= (SIDE_PX / 2) as f64;
            let color = |x, y| if right(x) { pale(x, y) } else { Vec3::new(0.2, 0.8, 0.2) * 150.0 };
            let mut drawing = Drawing::by_place(SIDE_PX, color);
            drawing.refine.region_ratio = region_ratio;
            let input = drawing.input();
            let labels = (0..SIDE_PX * SIDE_PX).map(|pixel| u16::from(right((pixel % SIDE_PX) as f64)));
            let labels = LabelMap::from_vec(SIDE_PX, SIDE_PX, labels.collect()).unwrap();
            let members = Members::of(&labels, 1);
            let body = Vec3::new(0.5, 0.8, 0.5);
            let regions =
                Regions { labels: &labels, members: &members, matte: &[Line::new(body * 200.0, body)] };
            let roi = Roi::around((SIDE_PX, SIDE_PX), 0, |_| true).unwrap();
            let lamps = Lamps::one(&Vec3::repeat(1.0).normalize()).unwrap();
            let map = DesaturationMap::new(&input, &limits(&input), &lamps, roi, &regions);
            map.points[SIDE_PX * SIDE_PX / 2 + SIDE_PX / 2 + 8].surface
        };
        assert!(excess_of_pale_body(true) < 1.0, "its own ratio: {}", excess_of_pale_body(true));
        let without = excess_of_pale_body(false);
        assert!(
            without > 40.0,
            "the ratio of the saturated body is taken for that of the pale one: {without}"
        );
    }

    #[test]
    fn only_a_clearly_paler_region_of_the_same_hue_replaces_the_ratio_around() {
        let own = RegionRatio { hue_turns: 0.99, ratios: [1.9, 2.0] };
        assert_eq!(
            own.instead_of(0.005, [0.8, 0.85]),
            Some([1.9, 2.0]),
            "across the end of the circle of hues"
        );
        assert_eq!(own.instead_of(0.05, [0.8, 0.85]), None, "another hue");
        assert_eq!(own.instead_of(0.99, [1.3, 1.4]), None, "nearly as pale");
    }
}
