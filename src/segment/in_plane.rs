//! Where in its dichromatic plane does an object put the illuminant? (refinement `robust_illuminant`)
//!
//! Within a plane, colour alone cannot tell a highlight from brighter body reflection of another colour; position can:
//! body reflection varies smoothly over the surface, a highlight does not. Around each highlight the coordinate along the
//! matte line is regressed on a polynomial of the position, for the body, plus cotθ times the in-plane offset, for the
//! highlight. cotθ is where the illuminant lies. The offset is noisy itself, which would pull cotθ towards zero: its share
//! σ²Σw is subtracted from the offset's sum of squares after partialling out the polynomial.
//!
//! The polynomial is a quartic over the highlight and a ring as wide as its radius. Pixels count fully or not at all: weights
//! that fall with the residual, like Tukey's, prefer pixels whose two noises happen to agree, which alone is worth up to
//! 1.6° (median error over 42 highlights .32° → .18°). How far a cubic differs is taken as the error of the model. Where the
//! quartic leaves of the offset little but noise, a cubic over a ring twice as wide is tried.

use super::ledger::Pixels;
use super::scene::Scene;
use crate::raster::{LabelMap, Mask, Raster, UNASSIGNED, dilate};
use crate::reflection::DichromaticPlane;
use nalgebra::{SMatrix, SVector};
use std::ops::Range;

/// Fewest pixels of a highlight.
const MIN_BLOB_PX: usize = 12;
/// Most highlights of one region that are looked at, the largest.
const MAX_BLOBS: usize = 6;
/// Regressors: the terms of a polynomial of two variables of degree 4, 3 or 2, and the offset.
const QUARTIC: usize = 16;
const CUBIC: usize = 11;
const QUADRATIC: usize = 7;
/// Residuals beyond this many times their scale are left out.
const CUT: f64 = 3.5;
/// A highlight whose offsets are noise to more than this share says nothing.
const MAX_NOISE_SHARE: f64 = 0.5;
/// How far off the noise variance that is subtracted may be, as a share of it.
const NOISE_ERROR: f64 = 0.04;

/// One object's estimate of the angle between body and surface vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InPlane {
    /// cot θ.
    pub cotangent: f64,
    /// Variance of θ, radians².
    pub variance_rad2: f64,
}

/// A pixel as the regression sees it.
#[derive(Clone, Copy, Debug)]
struct Sample {
    x: f64,
    y: f64,
    along: f64,
    offset: f64,
}

/// A region and the plane in which its highlights are sought.
#[derive(Clone, Copy)]
pub struct Branches<'a> {
    /// The picture.
    pub scene: &'a Scene<'a>,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// The region.
    pub region: u16,
    /// Its dichromatic plane.
    pub plane: &'a DichromaticPlane,
    /// Length of its matte line from black, counts.
    pub matte_length: f64,
    /// Pixels that the region's fits may look at together.
    pub budget: usize,
}

impl Branches<'_> {
    /// Estimates cotθ from the region's highlights; `None` without a highlight that says anything.
    pub fn estimate(&self, pixels: Pixels) -> Option<InPlane> {
        let mut sum = (0.0, 0.0);
        let blobs = self.highlights(pixels);
        let most = self.budget / blobs.len().max(1);
        for blob in blobs {
            let radius_px = (blob.len() as f64 / std::f64::consts::PI).sqrt().clamp(3.0, 24.0) as usize;
            let blob = Blob::new(&blob, 2 * radius_px, self.labels.width(), self.labels.height());
            let sigma = self.scene.sigma();
            let near = || regress::<QUARTIC, CUBIC>(&self.samples(&blob, radius_px, most), sigma);
            let wide = || regress::<CUBIC, QUADRATIC>(&self.samples(&blob, 2 * radius_px, most), sigma);
            if let Some((cotangent, variance)) = near().or_else(wide) {
                sum.0 += cotangent / variance;
                sum.1 += 1.0 / variance;
            }
        }
        if sum.1 <= 0.0 {
            return None;
        }
        let cotangent = sum.0 / sum.1;
        let sine2 = 1.0 / (1.0 + cotangent * cotangent);
        Some(InPlane { cotangent, variance_rad2: sine2 * sine2 / sum.1 })
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
                bright.for_each_neighbour(local, |near| {
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
        let Self { scene, labels, region, .. } = *self;
        let axes = self.plane.coordinates();
        let least = scene.used.radius_counts() as f32;
        let width = labels.width();
        let bright = |pixel: usize| {
            let label = labels[pixel];
            if label != region && label != UNASSIGNED {
                return false;
            }
            scene.masks.distorted(pixel) || (label == region && axes.of(scene.pixels[pixel]).offset > least)
        };
        let data = (rows.start * width..rows.end * width).map(bright).collect();
        Raster::from_vec(width, rows.len(), data).unwrap_or_default()
    }

    /// The believable pixels of the region within `radius_px` of a highlight, at most about `most`, evenly chosen.
    fn samples(&self, blob: &Blob, radius_px: usize, most: usize) -> Vec<Sample> {
        let Self { scene, labels, region, .. } = *self;
        let axes = self.plane.coordinates();
        let thickness = scene.used.radius_counts() as f32;
        let least_along = (0.3 * self.matte_length) as f32;
        let near = dilate(&blob.mask, radius_px);
        let width = near.width();
        let mut samples = Vec::new();
        for (index, _) in near.as_slice().iter().enumerate().filter(|&(_, &inside)| inside) {
            let (x, y) = (index % width + blob.left, index / width + blob.top);
            let pixel = y * labels.width() + x;
            if labels[pixel] != region || scene.masks.distorted(pixel) {
                continue;
            }
            let point = axes.of(scene.pixels[pixel]);
            if point.height.abs() < thickness && point.along > least_along {
                let (along, offset) = (f64::from(point.along), f64::from(point.offset));
                samples.push(Sample { x: x as f64, y: y as f64, along, offset });
            }
        }
        let step = samples.len().div_ceil(most.max(1)).max(1);
        samples.into_iter().step_by(step).collect()
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

/// cotθ and its variance from one highlight's surroundings, with `N` regressors; how far `M` differ counts as error.
fn regress<const N: usize, const M: usize>(samples: &[Sample], sigma: f64) -> Option<(f64, f64)> {
    if samples.len() < 4 * N {
        return None;
    }
    let samples = centred(samples);
    let mut sums = Sums::default();
    for sample in &samples {
        sums.add(sample, 1.0);
    }
    let mut taken = vec![true; samples.len()];
    let mut residuals = vec![0.0; samples.len()];
    let mut sizes = residuals.clone();
    let mut answer: Option<(f64, f64)> = None;
    for _ in 0..5 {
        let fit = sums.solve::<N>(sigma)?;
        let check = sums.solve::<M>(sigma)?;
        for (residual, sample) in residuals.iter_mut().zip(&samples) {
            *residual = fit.residual(sample).abs();
        }
        sizes.copy_from_slice(&residuals);
        let middle = sizes.len() / 2;
        let (_, &mut median, _) = sizes.select_nth_unstable_by(middle, f64::total_cmp);
        let cotangent = fit.cotangent();
        let scale = (1.4826 * median).max(sigma * (1.0 + cotangent.powi(2)).sqrt());
        let settled = answer.is_some_and(|(before, _)| (before - cotangent).abs() < 1e-4);
        let of_model = (cotangent - check.cotangent()).powi(2);
        let of_noise = (NOISE_ERROR * fit.noise / fit.information * cotangent).powi(2);
        answer = Some((cotangent, scale * scale / fit.information + of_model + of_noise));
        if settled {
            break;
        }
        // Few pixels come or go, so the sums are kept and corrected.
        for ((sample, &residual), taken) in samples.iter().zip(&residuals).zip(&mut taken) {
            let take = residual < CUT * scale;
            if take != *taken {
                *taken = take;
                sums.add(sample, if take { 1.0 } else { -1.0 });
            }
        }
    }
    answer
}

/// The samples with positions from −1 to 1 about their mean, which keeps the normal equations well conditioned.
fn centred(samples: &[Sample]) -> Vec<Sample> {
    let n = samples.len() as f64;
    let centre = samples.iter().fold((0.0, 0.0), |c, s| (c.0 + s.x / n, c.1 + s.y / n));
    let from_centre = |s: &Sample| (s.x - centre.0, s.y - centre.1);
    let spread = samples.iter().map(from_centre).map(|(x, y)| x.abs().max(y.abs())).fold(1.0, f64::max);
    let scaled = |s: &Sample| Sample { x: (s.x - centre.0) / spread, y: (s.y - centre.1) / spread, ..*s };
    samples.iter().map(scaled).collect()
}

/// Terms of a polynomial of degree 4 in x and y, and of degree 8: of the products of two of those.
const TERMS: usize = QUARTIC - 1;
const PRODUCTS: usize = 45;

/// Exponent of y and degree of each term, degree after degree.
const fn exponents() -> [(usize, usize); TERMS] {
    let mut list = [(0, 0); TERMS];
    let (mut at, mut degree) = (0, 0);
    while degree <= 4 {
        let mut of_y = 0;
        while of_y <= degree {
            list[at] = (of_y, degree);
            at += 1;
            of_y += 1;
        }
        degree += 1;
    }
    list
}

const EXPONENTS: [(usize, usize); TERMS] = exponents();

/// The first `K` terms of a polynomial in x and y, degree after degree: 1, x, y, x², xy, y², …
fn monomials<const K: usize>(x: f64, y: f64) -> [f64; K] {
    let mut terms = [1.0; K];
    let (mut at, mut degree) = (1, 1);
    while at < K {
        let before = at - degree;
        for of_y in 0..=degree {
            terms[at + of_y] = if of_y == 0 { terms[before] * x } else { terms[before + of_y - 1] * y };
        }
        at += degree + 1;
        degree += 1;
    }
    terms
}

/// What the normal equations of the samples taken are made of. Products of two terms of a polynomial are terms themselves, so
/// that 45 sums do for 120 entries.
struct Sums {
    /// Σ of the terms up to degree 8.
    terms: [f64; PRODUCTS],
    /// Σ offset · term, and Σ offset².
    offset: [f64; TERMS],
    offset_square: f64,
    /// Σ along · term, and Σ along · offset.
    along: [f64; TERMS],
    along_offset: f64,
}

impl Default for Sums {
    fn default() -> Self {
        let terms = [0.0; PRODUCTS];
        let none = [0.0; TERMS];
        Self { terms, offset: none, offset_square: 0.0, along: none, along_offset: 0.0 }
    }
}

/// Coefficients of the first `N` − 1 polynomial terms and of the offset; the offset's sum of squares beyond the polynomial,
/// without its noise, and that of its noise.
struct Solution<const N: usize> {
    coefficients: SVector<f64, N>,
    information: f64,
    noise: f64,
}

impl<const N: usize> Solution<N> {
    fn cotangent(&self) -> f64 {
        self.coefficients[N - 1]
    }

    fn residual(&self, sample: &Sample) -> f64 {
        let terms = monomials::<TERMS>(sample.x, sample.y);
        let smooth: f64 = terms[..N - 1].iter().zip(self.coefficients.iter()).map(|(t, c)| t * c).sum();
        sample.along - smooth - self.cotangent() * sample.offset
    }
}

impl Sums {
    /// Adds a sample `count` times.
    fn add(&mut self, sample: &Sample, count: f64) {
        let terms = monomials::<PRODUCTS>(sample.x, sample.y);
        let (offset, along) = (count * sample.offset, count * sample.along);
        for (sum, term) in self.terms.iter_mut().zip(&terms) {
            *sum += count * term;
        }
        for (sum, term) in self.offset.iter_mut().zip(&terms) {
            *sum += offset * term;
        }
        for (sum, term) in self.along.iter_mut().zip(&terms) {
            *sum += along * term;
        }
        self.offset_square += offset * sample.offset;
        self.along_offset += along * sample.offset;
    }

    /// An entry of the normal matrix with `n` regressors, the offset last.
    fn entry(&self, n: usize, i: usize, j: usize) -> f64 {
        match (i + 1 == n, j + 1 == n) {
            (true, true) => self.offset_square,
            (true, false) => self.offset[j],
            (false, true) => self.offset[i],
            (false, false) => {
                let degree = EXPONENTS[i].1 + EXPONENTS[j].1;
                self.terms[degree * (degree + 1) / 2 + EXPONENTS[i].0 + EXPONENTS[j].0]
            }
        }
    }

    /// Least squares with the first `N` − 1 terms, corrected for the noise of the offset: nσ² is taken from its square.
    ///
    /// What that leaves of the offset beyond the polynomial is the information in it, the Schur complement of the corrected
    /// normal matrix.
    fn solve<const N: usize>(&self, sigma: f64) -> Option<Solution<N>> {
        let mut normal = SMatrix::<f64, N, N>::from_fn(|i, j| self.entry(N, i, j));
        let right =
            SVector::<f64, N>::from_fn(|i, _| if i + 1 == N { self.along_offset } else { self.along[i] });
        let noise = sigma * sigma * self.terms[0];
        normal[(N - 1, N - 1)] -= noise;
        let factor = normal.cholesky()?;
        let mut last = SVector::<f64, N>::zeros();
        last[N - 1] = 1.0;
        let information = 1.0 / factor.solve(&last)[N - 1];
        if noise > MAX_NOISE_SHARE * (information + noise) {
            return None;
        }
        Some(Solution { coefficients: factor.solve(&right), information, noise })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_highlight_on_a_curved_body_gives_its_angle() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                let body = 150.0 + 2.0 * x - 0.05 * (x - 10.0).powi(2) - 0.03 * y * y + 0.001 * x * y * y;
                let offset = 60.0 * (-((x - 15.0).powi(2) + (y - 14.0).powi(2)) / 30.0).exp();
                Sample { x, y, along: body + 1.7 * offset, offset }
            })
            .collect();
        let (cotangent, variance) = regress::<QUARTIC, CUBIC>(&samples, 0.01).unwrap();
        assert!((cotangent - 1.7).abs() < 1e-3 && variance < 1e-4, "{cotangent} {variance}");
    }

    #[test]
    fn offsets_that_are_noise_say_nothing() {
        let samples: Vec<Sample> = (0..900)
            .map(|i| {
                let (x, y) = (f64::from(i % 30), f64::from(i / 30));
                Sample { x, y, along: 100.0 + x, offset: f64::from(i * 7919 % 11) / 11.0 }
            })
            .collect();
        assert!(regress::<QUARTIC, CUBIC>(&samples, 1.25).is_none());
    }
}
