//! Section 6: the components of clipped and bloomed pixels, from their undistorted bands.
//!
//! The paper assumes that the smallest band is undistorted, and takes the color on the matte or highlight line with that value.
//!
//! Refined (`restore_prior`, 22 → 31 dB on clipped pixels): a band is good when neither the pixel nor any of
//! the 8 neighbors clips there; where no band is good, the unclipped bands are used. The result is the most probable m_b and m_s
//! given all good bands and the body reflection of the surroundings as prior (standard deviation 10 %). The prior is interpolated into each blob
//! of distorted pixels from the undistorted pixels of the region beside it; carried inward pixel by pixel it left shards of one shade (37 rendered
//! scenes: .79 dB on average over the whole picture, together with the rule about highlights without body in `explained_mask`; one loses .64 dB). With one good band, the
//! result is that of the paper's rule. Where every band clips, m_b is the prior and m_s the least amount that reaches the clipped
//! values; such pixels are marked as lost. A pixel beside clipped ones that
//! does not clip itself and whose color fits the plane of its region is split like an undistorted pixel (`images`).

use crate::photo::Masks;
use crate::raster::{LabelMap, Raster, Roi, pull_push, relax};
use crate::reflection::{Components, HighlightTest, ReflectionTransform};

/// Relative standard deviation of the prior for body reflection.
const PRIOR_SD: f32 = 0.1;
/// Largest number of updates of all values of a blob by which the interpolation is made harmonic.
const MOST_UPDATES: usize = 1_000_000;

/// The picture whose distorted pixels are restored.
pub struct Distorted<'a> {
    /// Colors, counts.
    pub pixels: &'a Raster<[f32; 3]>,
    /// The marks of each pixel: distorted pixels are restored.
    pub masks: &'a Masks,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// Value from which on each band is clipped, counts.
    pub clip_thresholds: [f32; 3],
    /// Standard deviation of the noise, counts.
    pub sigma: f32,
}

/// A restored pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restored {
    /// The components; ε is 0.
    pub components: Components,
    /// Whether every band is clipped.
    pub lost: bool,
}

impl Distorted<'_> {
    /// The paper's rule: the point of the matte or highlight line that has the pixel's value in the pixel's smallest band.
    /// `start_body`: amount of body reflection where the highlight line starts, counts.
    pub fn smallest_band(
        &self,
        pixel: usize,
        transform: &ReflectionTransform,
        test: Option<&HighlightTest>,
        start_body: f32,
    ) -> Restored {
        let color = self.pixels[pixel];
        let band = (0..3).min_by(|&a, &b| color[a].total_cmp(&color[b])).unwrap_or(0);
        let lost = color[band] >= self.clip_thresholds[band];
        let (body, surface) = (transform.body()[band], transform.surface()[band]);
        let on_highlight = test.is_some_and(|test| test.is_highlight(color));
        let components = if on_highlight && surface.abs() > 1e-3 {
            let amount = (color[band] - start_body * body) / surface;
            Components { body: start_body, surface: amount.max(0.0), noise: 0.0 }
        } else if body.abs() > 1e-3 {
            Components { body: color[band] / body, surface: 0.0, noise: 0.0 }
        } else {
            Components { body: start_body, surface: 0.0, noise: 0.0 }
        };
        Restored { components, lost }
    }

    /// The most probable components, given the good bands and the amount of body reflection around the pixel, `prior_body`, counts.
    pub fn most_probable(&self, pixel: usize, transform: &ReflectionTransform, prior_body: f32) -> Restored {
        let color = self.pixels[pixel];
        let good = self.good_bands(pixel);
        let (b, s) = (transform.body(), transform.surface());
        if good == [false; 3] {
            let needed = (0..3).filter(|&j| s[j] > 1e-3).map(|j| (color[j] - prior_body * b[j]) / s[j]);
            let surface = needed.fold(0.0, f32::max);
            return Restored { components: Components { body: prior_body, surface, noise: 0.0 }, lost: true };
        }
        let variance = self.sigma * self.sigma;
        let prior = 1.0 / (PRIOR_SD * prior_body).max(1.0).powi(2);
        // The prior of surface reflection has a standard deviation of 1000 counts, so that one good band is enough.
        let (mut bb, mut bs, mut ss) = (prior, 0.0, 1e-6);
        let (mut rb, mut rs) = (prior * prior_body, 0.0);
        for j in (0..3).filter(|&j| good[j]) {
            bb += b[j] * b[j] / variance;
            bs += b[j] * s[j] / variance;
            ss += s[j] * s[j] / variance;
            rb += b[j] * color[j] / variance;
            rs += s[j] * color[j] / variance;
        }
        let determinant = bb * ss - bs * bs;
        let surface = (bb * rs - bs * rb) / determinant;
        let components = if surface > 0.0 {
            Components { body: (ss * rb - bs * rs) / determinant, surface, noise: 0.0 }
        } else {
            Components { body: rb / bb, surface: 0.0, noise: 0.0 }
        };
        Restored { components: Components { body: components.body.max(0.0), ..components }, lost: false }
    }

    /// The bands in which neither the pixel nor any of its 8 neighbors clips; where there is none, the bands in which the pixel
    /// itself does not clip.
    fn good_bands(&self, pixel: usize) -> [bool; 3] {
        let mut good = [true; 3];
        for near in self.pixels.around(pixel) {
            for (band, good) in good.iter_mut().enumerate() {
                *good &= self.pixels[near][band] < self.clip_thresholds[band];
            }
        }
        if good == [false; 3] {
            return std::array::from_fn(|band| self.pixels[pixel][band] < self.clip_thresholds[band]);
        }
        good
    }

    /// The amount of body reflection around each distorted pixel of a region, counts: interpolated into each blob of distorted pixels from
    /// the undistorted pixels of the region beside the blob. `body` computes the amount of an undistorted color. NaN where no
    /// undistorted pixel of the region is beside the blob. `distorted`: the distorted pixels of the region, ascending.
    pub fn priors(&self, distorted: &[u32], body: impl Fn([f32; 3]) -> f32) -> Vec<f32> {
        let mut priors = vec![f32::NAN; distorted.len()];
        let (Some(&first), Some(&last)) = (distorted.first(), distorted.last()) else { return priors };
        let width = self.pixels.width();
        // Index in `distorted`, plus 1, of each pixel from the first row of these on; 0 for other pixels and for those whose blob was found.
        let top = first as usize / width * width;
        let mut waiting = vec![0u32; last as usize + 1 - top];
        for (index, &pixel) in distorted.iter().enumerate() {
            waiting[pixel as usize - top] = index as u32 + 1;
        }
        let mut blob: Vec<u32> = Vec::new();
        for start in 0..distorted.len() as u32 {
            blob.clear();
            let mut take = |pixel: usize, blob: &mut Vec<u32>| {
                let place = pixel.checked_sub(top).and_then(|place| waiting.get_mut(place));
                if let Some(index) = place.map(std::mem::take).and_then(|index| index.checked_sub(1)) {
                    blob.push(index);
                }
            };
            take(distorted[start as usize] as usize, &mut blob);
            let mut next = 0;
            while let Some(&index) = blob.get(next) {
                self.pixels.around(distorted[index as usize] as usize).for_each(|near| take(near, &mut blob));
                next += 1;
            }
            self.interpolate(distorted, &blob, &body, &mut priors);
        }
        priors
    }

    /// Interpolates the amount of body reflection into one `blob`, indices in `distorted`, from the undistorted pixels of its region beside it.
    fn interpolate(
        &self,
        distorted: &[u32],
        blob: &[u32],
        body: impl Fn([f32; 3]) -> f32,
        priors: &mut [f32],
    ) {
        let size = (self.pixels.width(), self.pixels.height());
        let pixel_of = |index: u32| distorted[index as usize] as usize;
        let pixels = blob.iter().map(|&index| pixel_of(index));
        let Some(roi) = Roi::around_pixels(size, 1, pixels.clone()) else { return };
        let mut known = Raster::filled(roi.width, roi.height, [0.0f32; 2]);
        let mut is_known = false;
        for &index in blob {
            let region = self.labels[pixel_of(index)];
            for near in self.pixels.around(pixel_of(index)) {
                let is_beside = self.labels[near] == region && !self.masks.distorted(near);
                if let Some(place) = roi.index(near).filter(|_| is_beside) {
                    known[place] = [body(self.pixels[near]), 1.0];
                    is_known = true;
                }
            }
        }
        if !is_known {
            return;
        }
        let is_beside = known.map(|[_, weight]| *weight > 0.0);
        let mut filled = pull_push(known).map(|value| [*value]);
        let places: Vec<usize> = pixels.filter_map(|pixel| roi.index(pixel)).collect();
        relax(&mut filled, &is_beside, &places, MOST_UPDATES);
        for &index in blob {
            if let Some(place) = roi.index(pixel_of(index)) {
                [priors[index as usize]] = filled[place];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::photo::{LinearImage, MaskLimits};

    const CLIP: f32 = 240.0;

    /// The restored center of nine pixels of one color, where the prior of body reflection is 100 counts.
    fn restore(color: [f32; 3], transform: &ReflectionTransform) -> Restored {
        let image = LinearImage::new(Raster::filled(3, 3, color), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: f64::from(CLIP), bloom_density: 1 };
        let masks = Masks::new(&image, &limits);
        let labels = LabelMap::filled(3, 3, 1);
        let distorted = Distorted {
            pixels: &image.pixels,
            masks: &masks,
            labels: &labels,
            clip_thresholds: [CLIP; 3],
            sigma: 1.25,
        };
        distorted.most_probable(4, transform, 100.0)
    }

    fn transform() -> ReflectionTransform {
        let body = Vec3::new(0.9, 0.3, 0.2).normalize();
        ReflectionTransform::new(&body, &Vec3::repeat(1.0).normalize()).unwrap()
    }

    #[test]
    fn one_good_band_gives_the_papers_rule_with_the_body_around() {
        let t = transform();
        let Restored { components, lost } = restore([255.0, 255.0, 140.0], &t);
        let expected = (140.0 - 100.0 * t.body()[2]) / t.surface()[2];
        assert!(!lost);
        assert!((components.body - 100.0).abs() < 0.1, "{components:?}");
        assert!((components.surface - expected).abs() < 0.1, "{components:?}, expected {expected}");
    }

    #[test]
    fn good_bands_outvote_the_surroundings() {
        let body = Vec3::new(0.4, 0.9, 0.1).normalize();
        let t = ReflectionTransform::new(&body, &Vec3::repeat(1.0).normalize()).unwrap();
        let made = t.join(Components { body: 130.0, surface: 180.0, noise: 0.0 });
        let Restored { components, lost } = restore([255.0, made[1], made[2]], &t);
        assert!(made[1] < CLIP && made[2] < CLIP && !lost, "{made:?}");
        // Two good bands determine body reflection to 2 counts, the prior to 10.
        assert!((components.body - 130.0).abs() < 3.0, "{components:?}");
        assert!((components.surface - 180.0).abs() < 3.0, "{components:?}");
    }

    #[test]
    fn without_a_good_band_a_pixel_is_lost_and_reaches_the_clipped_values() {
        let t = transform();
        let Restored { components, lost } = restore([255.0; 3], &t);
        assert!(lost);
        assert!((components.body - 100.0).abs() < 1e-3);
        let seen = t.join(components);
        let darkest = seen.into_iter().fold(f32::MAX, f32::min);
        assert!(
            (darkest - 255.0).abs() < 0.1,
            "the least surface reflection that reaches the clipped values: {seen:?}"
        );
    }

    #[test]
    fn the_papers_rule_takes_the_point_of_the_line_with_the_smallest_bands_value() {
        let t = transform();
        let image = LinearImage::new(Raster::filled(1, 1, [255.0, 80.0, 50.0]), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let masks = Masks::new(&image, &limits);
        let labels = LabelMap::filled(1, 1, 1);
        let distorted = Distorted {
            pixels: &image.pixels,
            masks: &masks,
            labels: &labels,
            clip_thresholds: [CLIP; 3],
            sigma: 1.25,
        };
        let Restored { components, lost } = distorted.smallest_band(0, &t, None, 0.0);
        assert!(!lost && components.surface.abs() < f32::EPSILON);
        assert!((t.join(components)[2] - 50.0).abs() < 1e-3);
    }

    #[test]
    fn priors_go_inward_and_stop_at_other_regions() {
        let row: Vec<[f32; 3]> = [50.0, 255.0, 255.0, 255.0, 255.0].map(|v: f32| [v, 30.0, 30.0]).to_vec();
        let image = LinearImage::new(Raster::from_vec(5, 1, row).unwrap(), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let masks = Masks::new(&image, &limits);
        let labels = LabelMap::from_vec(5, 1, vec![1, 1, 1, 1, 2]).unwrap();
        let distorted = Distorted {
            pixels: &image.pixels,
            masks: &masks,
            labels: &labels,
            clip_thresholds: [CLIP; 3],
            sigma: 1.25,
        };
        let priors = distorted.priors(&[1, 2, 3], |color| color[0]);
        assert_eq!(priors, [50.0; 3]);
        assert!(
            distorted.priors(&[4], |_| 50.0)[0].is_nan(),
            "no undistorted pixel of its region reaches it"
        );
    }
}
