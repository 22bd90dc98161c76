//! Where in its dichromatic plane does an object put the illuminant? (refinement `robust_illuminant`)
//!
//! Within a plane, color alone cannot tell a highlight from brighter body reflection of another color; position can:
//! body reflection varies smoothly over the surface, a highlight does not. Around each highlight the coordinate along the
//! matte line is regressed on a polynomial of the position, for the body, plus cotθ times the in-plane offset, for the
//! highlight. cotθ is where the illuminant lies. The offset is noisy itself, which would pull cotθ towards zero: its share
//! σ²Σw is subtracted from the offset's sum of squares after partialling out the polynomial.
//!
//! The polynomial is a quartic over the highlight and a ring as wide as its radius. Pixels count fully or not at all: weights
//! that fall with the residual, like Tukey's, prefer pixels whose two noises happen to agree, which alone is worth up to
//! 1.6° (median error over 42 highlights .32° → .18°). How far a cubic differs is taken as the error of the model. Where the
//! quartic leaves of the offset little but noise, a cubic over a ring twice as wide is tried.
//!
//! The height above the plane is regressed in the same way. Ambient light is reflected by the surface too, faintly and
//! everywhere; the plane through all pixels off the matte line then turns towards its color (7° on a rendered cup), the one
//! that the highlight itself rises in does not.

mod regress;

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::raster::{HypothesisId, LabelMap, Mask, Raster, UNASSIGNED, dilate};
use crate::reflection::DichromaticPlane;
use regress::{CUBIC, QUADRATIC, QUARTIC, Sample, regress};
use std::ops::Range;

/// Fewest pixels of a highlight.
const MIN_BLOB_PX: usize = 12;
/// Most highlights of one region that are looked at, the largest.
const MAX_BLOBS: usize = 6;
/// Pixels that lie farther inside the plane show the light's color by themselves, σ.
const STRONG: f64 = 24.0;

/// Where one object's highlights put the illuminant.
#[derive(Clone, Debug, PartialEq)]
pub struct InPlane {
    /// cot θ, θ the angle between body and surface vector.
    pub cotangent: f64,
    /// Variance of θ, radians².
    pub variance_rad2: f64,
    /// Tangent of the angle between the plane and the highlights, and its variance.
    pub rise: Rise,
    /// Offset and height of the pixels that the light outshines, counts.
    pub strong: Vec<[f64; 2]>,
}

/// Height above a plane per offset in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rise {
    /// The tangent of the angle between both planes.
    pub tangent: f64,
    /// Its variance.
    pub variance: f64,
}

/// A region and the plane in which its highlights are sought.
#[derive(Clone, Copy)]
pub struct InPlaneSearch<'a> {
    /// The picture.
    pub input: &'a AnalysisInput<'a>,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Its dichromatic plane.
    pub plane: &'a DichromaticPlane,
    /// Length of its matte line from black, counts.
    pub matte_length: f64,
    /// Pixels that the region's fits may look at together.
    pub budget: usize,
}

impl InPlaneSearch<'_> {
    /// Estimates cotθ from the region's highlights; `None` without a highlight that says anything.
    pub fn estimate(&self, pixels: Pixels) -> Option<InPlane> {
        let (mut along, mut height, mut strong) = (Mean::default(), Mean::default(), Vec::new());
        let blobs = self.highlights(pixels);
        let most = self.budget / blobs.len().max(1);
        for blob in blobs {
            let radius_px = (blob.len() as f64 / std::f64::consts::PI).sqrt().clamp(3.0, 24.0) as usize;
            let blob = Blob::new(&blob, 2 * radius_px, self.labels.width(), self.labels.height());
            let sigma = self.input.sigma();
            let around = self.samples(&blob, radius_px);
            let outshone = around.iter().filter(|sample| sample.offset > STRONG * sigma);
            strong.extend(outshone.map(|sample| [sample.offset, sample.height]));
            let near = || regress::<QUARTIC, CUBIC>(&thinned(&around, most), sigma);
            let wide =
                || regress::<CUBIC, QUADRATIC>(&thinned(&self.samples(&blob, 2 * radius_px), most), sigma);
            if let Some(slopes) = near().or_else(wide) {
                along.add(slopes.along);
                height.add(slopes.height);
            }
        }
        let (cotangent, variance) = along.value()?;
        let (tangent, rise_variance) = height.value()?;
        let sine2 = 1.0 / (1.0 + cotangent * cotangent);
        let rise = Rise { tangent, variance: rise_variance };
        Some(InPlane { cotangent, variance_rad2: sine2 * sine2 * variance, rise, strong })
    }

    /// Connected pixels of the region that lie more than a radius inside the plane, distorted pixels joined in; the
    /// largest first.
    fn highlights(&self, pixels: Pixels) -> Vec<Vec<u32>> {
        let Some(bounds) = pixels.rows(self.labels.width()) else { return Vec::new() };
        let mut bright = self.bright_rows(bounds.clone());
        let first = bounds.start * self.labels.width();
        let mut blobs = Vec::new();
        for start in 0..bright.len() {
            if !std::mem::take(&mut bright[start]) {
                continue;
            }
            let mut blob = vec![(start + first) as u32];
            let mut next = 0;
            while let Some(&pixel) = blob.get(next) {
                next += 1;
                let local = pixel as usize - first;
                let mut found = [usize::MAX; 4];
                let mut count = 0;
                bright.for_each_neighbor(local, |near| {
                    if bright[near] {
                        found[count] = near;
                        count += 1;
                    }
                });
                for &near in &found[..count] {
                    bright[near] = false;
                    blob.push((near + first) as u32);
                }
            }
            if blob.len() >= MIN_BLOB_PX {
                blobs.push(blob);
            }
        }
        blobs.sort_by_key(|blob| std::cmp::Reverse(blob.len()));
        blobs.truncate(MAX_BLOBS);
        blobs
    }

    /// Which pixels of some rows are highlights of the region, or distorted and not another's.
    fn bright_rows(&self, rows: Range<usize>) -> Mask {
        let Self { input, labels, hypothesis, .. } = *self;
        let own_label = hypothesis.get();
        let axes = self.plane.coordinates();
        let least = input.used.radius_counts() as f32;
        let width = labels.width();
        let bright = |pixel: usize| {
            let label = labels[pixel];
            if label != own_label && label != UNASSIGNED {
                return false;
            }
            input.masks.distorted(pixel)
                || (label == own_label && axes.of(input.pixels[pixel]).offset > least)
        };
        let data = (rows.start * width..rows.end * width).map(bright).collect();
        Raster::from_vec(width, rows.len(), data).unwrap_or_default()
    }

    /// The believable pixels of the region within `radius_px` of a highlight.
    fn samples(&self, blob: &Blob, radius_px: usize) -> Vec<Sample> {
        let Self { input, labels, hypothesis, .. } = *self;
        let own_label = hypothesis.get();
        let axes = self.plane.coordinates();
        let thickness = input.used.radius_counts() as f32;
        let least_along = (0.3 * self.matte_length) as f32;
        let near = dilate(&blob.mask, radius_px);
        let width = near.width();
        let mut samples = Vec::new();
        for (index, _) in near.as_slice().iter().enumerate().filter(|&(_, &inside)| inside) {
            let (x, y) = (index % width + blob.left, index / width + blob.top);
            let pixel = y * labels.width() + x;
            let label = labels[pixel];
            if (label != own_label && label != UNASSIGNED) || !input.masks.usable(pixel) {
                continue;
            }
            let point = axes.of(input.pixels[pixel]);
            // A plane that is off loses the strongest pixels first: what lies inside it at a small angle is looked at too.
            let inside = point.height.abs() < (point.offset / 2.0).max(thickness);
            let own = label == own_label || point.offset > thickness;
            if own && inside && point.along > least_along {
                let [along, offset, height] = [point.along, point.offset, point.height].map(f64::from);
                samples.push(Sample { x: x as f64, y: y as f64, along, offset, height });
            }
        }
        samples
    }
}

/// At most about `most` of the samples, evenly chosen.
fn thinned(samples: &[Sample], most: usize) -> Vec<Sample> {
    let step = samples.len().div_ceil(most.max(1)).max(1);
    samples.iter().step_by(step).copied().collect()
}

/// A mean of values with variances.
#[derive(Default)]
struct Mean {
    sum: f64,
    weight: f64,
}

impl Mean {
    fn add(&mut self, (value, variance): (f64, f64)) {
        self.sum += value / variance;
        self.weight += 1.0 / variance;
    }

    /// The mean and its variance; none of nothing.
    fn value(&self) -> Option<(f64, f64)> {
        (self.weight > 0.0).then(|| (self.sum / self.weight, 1.0 / self.weight))
    }
}

/// A highlight as a mask over a rectangle around it.
struct Blob {
    left: usize,
    top: usize,
    mask: Mask,
}

impl Blob {
    /// The mask of `pixels` in their bounding box, `margin_px` wider on each side.
    fn new(pixels: &[u32], margin_px: usize, width: usize, height: usize) -> Self {
        let (mut left, mut right, mut top, mut bottom) = (width, 0, height, 0);
        for &pixel in pixels {
            let (x, y) = (pixel as usize % width, pixel as usize / width);
            (left, right) = (left.min(x), right.max(x));
            (top, bottom) = (top.min(y), bottom.max(y));
        }
        let (left, right) = (left.saturating_sub(margin_px), (right + margin_px + 1).min(width));
        let (top, bottom) = (top.saturating_sub(margin_px), (bottom + margin_px + 1).min(height));
        let mut mask = Raster::filled(right - left, bottom - top, false);
        for &pixel in pixels {
            let (x, y) = (pixel as usize % width - left, pixel as usize / width - top);
            mask[y * (right - left) + x] = true;
        }
        Self { left, top, mask }
    }
}
