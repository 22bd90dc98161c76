//! Section 6: the components of clipped and bloomed pixels, from the bands that still tell the truth.
//!
//! The paper assumes that the smallest band does, and takes the pixel on the matte or highlight line with that value.
//!
//! Refined (`restore_prior`, 22 → 31 dB on clipped pixels): a band is good when none of the 8 neighbours and not the pixel
//! itself clips there. All good bands count, with the body reflection of the surroundings as prior (standard deviation
//! 10 %): the most probable m_b and m_s. One good band is the paper's rule. Without any, m_b is the prior and m_s the least
//! that clips as seen; such pixels are flagged as lost.

use crate::photo::Masks;
use crate::raster::{LabelMap, Raster};
use crate::reflection::{Components, ReflectionTransform};
use crate::segment::HighlightTest;
use std::collections::BTreeMap;

/// Relative standard deviation of the prior for body reflection.
const PRIOR_SD: f32 = 0.1;

/// What restoration needs to know of the picture.
pub struct Distorted<'a> {
    /// Colours, counts.
    pub pixels: &'a Raster<[f32; 3]>,
    /// Which are distorted.
    pub masks: &'a Masks,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// A band at or above it is clipped, counts.
    pub clip_threshold: f32,
    /// Standard deviation of the noise, counts.
    pub sigma: f32,
}

/// A restored pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restored {
    /// Its components; no noise.
    pub components: Components,
    /// Whether no band could be believed.
    pub lost: bool,
}

impl Distorted<'_> {
    /// The paper's rule: the point of matte or highlight line that has the pixel's value in its smallest band.
    pub fn smallest_band(
        &self,
        pixel: usize,
        transform: &ReflectionTransform,
        test: Option<&HighlightTest>,
        start_body: f32,
    ) -> Restored {
        let color = self.pixels[pixel];
        let band = (0..3).min_by(|&a, &b| color[a].total_cmp(&color[b])).unwrap_or(0);
        let lost = color[band] >= self.clip_threshold;
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

    /// The most probable components, given the good bands and the body reflection around.
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
        // Surface reflection is unknown by as much as a picture can hold, which keeps one band solvable.
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

    /// Bands in which neither the pixel nor any of its 8 neighbours clips.
    fn good_bands(&self, pixel: usize) -> [bool; 3] {
        let (width, height) = (self.pixels.width(), self.pixels.height());
        let (x, y) = (pixel % width, pixel / width);
        let mut good = [true; 3];
        for v in y.saturating_sub(1)..(y + 2).min(height) {
            for u in x.saturating_sub(1)..(x + 2).min(width) {
                let near = self.pixels[v * width + u];
                for band in 0..3 {
                    good[band] &= near[band] < self.clip_threshold;
                }
            }
        }
        good
    }

    /// Body reflection to expect at each distorted pixel of a region: that of its undistorted surroundings (by `body`, from
    /// their colours), carried inward ring by ring. Pixels that no undistorted one reaches are left out.
    pub fn priors(&self, distorted: &[u32], body: impl Fn([f32; 3]) -> f32) -> BTreeMap<u32, f32> {
        let mut priors: BTreeMap<u32, f32> = BTreeMap::new();
        let mut waiting = distorted.to_vec();
        while !waiting.is_empty() {
            let ring: Vec<(u32, f32)> = waiting
                .iter()
                .filter_map(|&pixel| self.mean_around(pixel, &priors, &body).map(|mean| (pixel, mean)))
                .collect();
            if ring.is_empty() {
                break;
            }
            priors.extend(ring);
            waiting.retain(|pixel| !priors.contains_key(pixel));
        }
        priors
    }

    fn mean_around(
        &self,
        pixel: u32,
        priors: &BTreeMap<u32, f32>,
        body: impl Fn([f32; 3]) -> f32,
    ) -> Option<f32> {
        let (width, height) = (self.pixels.width(), self.pixels.height());
        let (x, y) = (pixel as usize % width, pixel as usize / width);
        let region = self.labels[pixel as usize];
        let (mut sum, mut count) = (0.0, 0.0);
        for v in y.saturating_sub(1)..(y + 2).min(height) {
            for u in x.saturating_sub(1)..(x + 2).min(width) {
                let near = v * width + u;
                let known = if self.labels[near] != region {
                    None
                } else if self.masks.distorted(near) {
                    priors.get(&(near as u32)).copied()
                } else {
                    Some(body(self.pixels[near]))
                };
                if let Some(value) = known {
                    sum += value;
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| sum / count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::photo::{LinearImage, MaskLimits};

    const CLIP: f32 = 240.0;

    /// Restores the middle of nine pixels of one colour, with a body reflection of 100 counts around it.
    fn restore(color: [f32; 3], transform: &ReflectionTransform) -> Restored {
        let image = LinearImage::new(Raster::filled(3, 3, color), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: f64::from(CLIP), bloom_density: 1 };
        let masks = Masks::new(&image, &limits);
        let labels = LabelMap::filled(3, 3, 1);
        let distorted = Distorted {
            pixels: &image.pixels,
            masks: &masks,
            labels: &labels,
            clip_threshold: CLIP,
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
        // Two bands know the body to 2 counts, the surroundings to 10.
        assert!((components.body - 130.0).abs() < 3.0, "{components:?}");
        assert!((components.surface - 180.0).abs() < 3.0, "{components:?}");
    }

    #[test]
    fn without_a_good_band_it_is_lost_and_clips_as_seen() {
        let t = transform();
        let Restored { components, lost } = restore([255.0; 3], &t);
        assert!(lost);
        assert!((components.body - 100.0).abs() < 1e-3);
        let seen = t.join(components);
        let darkest = seen.into_iter().fold(f32::MAX, f32::min);
        assert!((darkest - 255.0).abs() < 0.1, "the least surface reflection that clips as seen: {seen:?}");
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
            clip_threshold: CLIP,
            sigma: 1.25,
        };
        let Restored { components, lost } = distorted.smallest_band(0, &t, None, 0.0);
        assert!(!lost && components.surface.abs() < f32::EPSILON);
        assert!((t.join(components)[2] - 50.0).abs() < 1e-3);
    }

    #[test]
    fn priors_go_inward_ring_by_ring_and_stop_at_other_regions() {
        let row: Vec<[f32; 3]> = [50.0, 255.0, 255.0, 255.0, 90.0].map(|v: f32| [v, 30.0, 30.0]).to_vec();
        let image = LinearImage::new(Raster::from_vec(5, 1, row).unwrap(), Some(255.0));
        let limits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 9 };
        let masks = Masks::new(&image, &limits);
        let labels = LabelMap::from_vec(5, 1, vec![1, 1, 1, 1, 2]).unwrap();
        let distorted = Distorted {
            pixels: &image.pixels,
            masks: &masks,
            labels: &labels,
            clip_threshold: CLIP,
            sigma: 1.25,
        };
        let priors = distorted.priors(&[1, 2, 3], |color| color[0]);
        assert_eq!(priors.into_iter().collect::<Vec<_>>(), [(1, 50.0), (2, 50.0), (3, 50.0)]);
    }
}
