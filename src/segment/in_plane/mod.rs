//! The direction of the illuminant within the dichromatic plane of one object (refinement `robust_illuminant`).
//!
//! Within a plane, color alone cannot tell a highlight from brighter body reflection of another color, but position can:
//! body reflection varies smoothly over the surface, a highlight does not. Around each highlight the coordinate along the
//! matte line is regressed on a polynomial of the position (for the body reflection) plus cotθ times the in-plane offset (for
//! the highlight). θ is the angle between matte line and illuminant. The offset is noisy itself, which would bias cotθ towards
//! zero: the noise's share σ²Σw is subtracted from the offset's sum of squares after partialling out the polynomial.
//!
//! The polynomial is a quartic over the highlight and a ring as wide as its radius. Pixels count fully or not at all: weights
//! that fall with the residual, like Tukey's, prefer pixels whose two noises happen to agree, which causes errors of up to
//! 1.6° (median error over 42 highlights .32° → .18° without such weights). The difference from the result of a cubic is
//! taken as the error of the model. Where the quartic leaves little but noise of the offset, a cubic over a ring twice as wide
//! is fitted instead.
//!
//! The height above the plane is regressed in the same way. The surface also reflects ambient light, faintly and everywhere.
//! The plane through all pixels off the matte line therefore turns towards the color of the ambient light (7° on a rendered
//! cup); the plane in which the highlight rises above its surroundings does not turn.

mod regress;

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::raster::{HypothesisId, LabelMap, Mask, Raster, UNASSIGNED, dilate};
use crate::reflection::DichromaticPlane;
use regress::{CUBIC, QUADRATIC, QUARTIC, Sample, regress};
use std::ops::Range;

/// Least coordinate along the matte line of a pixel that is looked at, as a share of the length of the matte line.
pub const LEAST_ALONG_SHARE: f64 = 0.3;
/// Largest height above the plane of a pixel that is looked at, as a share of its offset from the matte line. A plane with an error loses
/// the strongest pixels first; therefore the limit is an angle.
pub const MOST_HEIGHT_PER_OFFSET: f32 = 0.5;
/// Least and largest radius of the ring around a highlight, pixels: the radius of a circle with the area of the highlight.
const RING_RANGE_PX: (f64, f64) = (3.0, 24.0);
/// Factor of the radius of the ring where a cubic is fitted instead of a quartic.
const WIDE_RING: usize = 2;
/// Fewest pixels of a highlight.
const MIN_BLOB_PX: usize = 12;
/// Largest number of highlights of one region that are used; the largest highlights are.
const MAX_BLOBS: usize = 6;
/// Offset from the matte line beyond which a pixel is outshone: most of its color is that of the light. σ.
const STRONG: f64 = 24.0;

/// The estimate of the illuminant's direction by one object's highlights.
#[derive(Clone, Debug, PartialEq)]
pub struct InPlane {
    /// cot θ, θ the angle between body and surface vector.
    pub cotangent: f64,
    /// Variance of θ, radians².
    pub variance_rad2: f64,
    /// Angle between the dichromatic plane and the plane in which the highlights rise.
    pub rise: Rise,
    /// Offset and height of the outshone pixels in the dichromatic plane, counts.
    pub strong: Vec<[f64; 2]>,
}

/// Angle between two planes through the matte line: height above the first plane per offset in the first plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rise {
    /// Tangent of the angle between both planes.
    pub tangent: f64,
    /// Variance of the tangent.
    pub variance: f64,
}

/// A region and the dichromatic plane in which its highlights are regressed.
#[derive(Clone, Copy)]
pub struct InPlaneSearch<'a> {
    /// The image, its masks and the parameters.
    pub input: &'a AnalysisInput<'a>,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// Hypothesis whose pixels are searched.
    pub hypothesis: HypothesisId,
    /// Dichromatic plane of the hypothesis.
    pub plane: &'a DichromaticPlane,
    /// Length of the region's matte line from black, counts.
    pub matte_length: f64,
    /// Largest number of pixels that all fits of the region use together.
    pub budget: usize,
}

impl InPlaneSearch<'_> {
    /// Estimates cotθ from the region's highlights, whose pixels are among `pixels`; `None` where no regression succeeds.
    pub fn estimate(&self, pixels: Pixels) -> Option<InPlane> {
        let (mut along, mut height, mut strong) = (Mean::default(), Mean::default(), Vec::new());
        let blobs = self.highlights(pixels);
        let most = self.budget / blobs.len().max(1);
        for blob in blobs {
            let radius_px = (blob.len() as f64 / std::f64::consts::PI)
                .sqrt()
                .clamp(RING_RANGE_PX.0, RING_RANGE_PX.1) as usize;
            let blob = Blob::new(&blob, WIDE_RING * radius_px, self.labels.width(), self.labels.height());
            let sigma = self.input.sigma();
            let around = self.samples(&blob, radius_px);
            let outshone = around.iter().filter(|sample| sample.offset > STRONG * sigma);
            strong.extend(outshone.map(|sample| [sample.offset, sample.height]));
            let near = || regress::<QUARTIC, CUBIC>(&thinned(&around, most), sigma);
            let wide = || {
                regress::<CUBIC, QUADRATIC>(
                    &thinned(&self.samples(&blob, WIDE_RING * radius_px), most),
                    sigma,
                )
            };
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

    /// The highlights: components of the region's pixels whose offset from the matte line exceeds the cylinder's radius, and of
    /// distorted pixels; the largest first.
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

    /// For the rows `rows`: whether a pixel is a highlight pixel of the region, or is distorted and belongs to no other region.
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

    /// The usable pixels of the region within `radius_px` of a highlight.
    fn samples(&self, blob: &Blob, radius_px: usize) -> Vec<Sample> {
        let Self { input, labels, hypothesis, .. } = *self;
        let own_label = hypothesis.get();
        let axes = self.plane.coordinates();
        let thickness = input.used.radius_counts() as f32;
        let least_along = (LEAST_ALONG_SHARE * self.matte_length) as f32;
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
            let inside = point.height.abs() < (MOST_HEIGHT_PER_OFFSET * point.offset).max(thickness);
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

/// A mean of values, weighted by the inverses of their variances.
#[derive(Default)]
struct Mean {
    sum: f64,
    weight: f64,
}

impl Mean {
    /// Adds a value with its variance.
    fn add(&mut self, (value, variance): (f64, f64)) {
        self.sum += value / variance;
        self.weight += 1.0 / variance;
    }

    /// The mean and its variance; `None` without a value.
    fn value(&self) -> Option<(f64, f64)> {
        (self.weight > 0.0).then(|| (self.sum / self.weight, 1.0 / self.weight))
    }
}

/// A highlight as a mask over a rectangle of the picture.
struct Blob {
    /// First column and first row of the rectangle in the picture.
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
