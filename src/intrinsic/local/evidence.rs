//! Rule `highlight_evidence`: the odds that what is paler than its hue is a highlight, and no white print.
//!
//! Chromaticity alone cannot tell a highlight from white print: both add to the mean of J and leave its chromatic part. Four
//! observations can; each adds to the log odds of a pixel.
//! - Chroma: a highlight leaves the chromatic part c as it is, print lowers it. 3·clip(ln c − μ + d/2, −2.3, 1), μ and
//!   d the mean and the standard deviation of ln c of the pixels without strong surface reflection under a Gaussian of 24
//!   px.
//! - Independence: the body reflection under a highlight does not vary against the surface reflection. 4ρ, ρ the
//!   correlation of m_s and κc under a Gaussian of 7 px, after their means under a Gaussian of 5 px are subtracted.
//! - Brightness: a highlight is brighter than the body around. 2·ln clip(m / M, .5, 5), m the largest band of J, M its
//!   mean over the pixels without strong surface reflection under a Gaussian of 24 px.
//! - Edges: a highlight has edges where the body has none. ln clip(gradient of m_s / gradient of κc, .2, 20), both
//!   means under a Gaussian of 5 px.
//!
//! The sum and a constant of .8 are averaged under a Gaussian of 3 px, weighted by m_s². The odds of the picture are
//! added: among prints a doubtful blob is print, among fruit a highlight.

use super::desaturation_map::DesaturationMap;
use crate::raster::{Mask, Raster, blur};
use crate::trace::{HighlightTerms, LocalLimits, PictureOddsFound};
use rayon::prelude::*;

/// Width of the Gaussian of a pixel's surroundings, pixels.
const SURROUNDINGS_PX: f64 = 24.0;
/// Width of the Gaussian of the means that the observation of independence subtracts, pixels.
const SHADING_PX: f64 = 5.0;
/// Width of the Gaussian under which the correlation is computed, pixels.
const PRODUCTS_PX: f64 = 7.0;
/// Width of the Gaussian before the gradient is taken, pixels.
const GRADIENT_SMOOTHING_PX: f64 = 1.0;
/// Width of the Gaussian of the mean gradient, pixels.
const GRADIENT_MEAN_PX: f64 = 5.0;
/// Width of the Gaussian that averages the log odds, pixels.
const AVERAGE_PX: f64 = 3.0;
/// Least amount or gradient that is divided by or weighted with, counts.
const LEAST_AMOUNT: f32 = 0.0255;
/// Sum of weights below which there is no mean.
const LEAST_WEIGHT: f32 = 1e-4;
/// Log odds before any observation.
const PRIOR: f32 = 0.8;
/// Share of the variance of the noise that is added to the variances of body and surface reflection.
const NOISE: f32 = 0.3;
/// Number of pixels whose probabilities one task sums.
const CHUNK: usize = 1 << 12;
/// Number of iterations by which the share of highlights and the odds of the picture are found.
const ROUNDS: usize = 3;
/// Least and largest share of highlights in the surface reflection of a picture.
const PICTURE_SHARE: (f64, f64) = (0.02, 0.98);

/// The log odds of a highlight in each pixel of a window.
pub struct Evidence {
    /// The four observations of each pixel, log odds.
    pub terms: Raster<HighlightTerms>,
    /// Log odds of each pixel: the observations around, averaged, without the odds of the picture.
    pub log_odds: Raster<f32>,
}

/// What the observations are computed from: the desaturation map of the window.
struct Source<'a> {
    map: &'a DesaturationMap<'a>,
}

impl Evidence {
    /// The evidence in the window of `map`.
    pub fn new(limits: &LocalLimits, map: &DesaturationMap) -> Self {
        let source = Source { map };
        let (chroma, brightness) = source.against_surroundings(limits.sigma);
        let independence = source.independence(limits.sigma);
        let edges = source.edges();
        let terms = map.raster(|index| HighlightTerms {
            chroma: chroma[index],
            independence: independence[index],
            brightness: brightness[index],
            edges: edges[index],
        });
        let log_odds = source.averaged(&terms);
        Self { terms, log_odds }
    }

    /// The log odds of the picture: half the log odds of the share of highlights in the squared surface reflection, over the
    /// usable pixels of the window of `map` whose excess is above the noise and that are `unexplained`, the lit pixels of the
    /// picture that no region explains. Share and odds depend on each other and are found by [`ROUNDS`] iterations.
    pub fn picture_odds(&self, map: &DesaturationMap, unexplained: &Mask) -> PictureOddsFound {
        let takes_part = |index: &usize| {
            map.points[*index].exceeds_noise()
                && map.usable[*index] > 0.0
                && unexplained[map.roi.pixel(*index)]
        };
        let members: Vec<(f64, f64)> = (0..self.log_odds.len())
            .into_par_iter()
            .filter(takes_part)
            .map(|index| (f64::from(map.points[index].surface).powi(2), f64::from(self.log_odds[index])))
            .collect();
        let total: f64 = members.iter().map(|(weight, _)| weight).sum();
        let mut log_odds = 0.0f64;
        for _ in 0..if total > 0.0 { ROUNDS } else { 0 } {
            let probable = |&(weight, odds): &(f64, f64)| weight / (1.0 + (-(odds + log_odds)).exp());
            let of_chunk = |chunk: &[(f64, f64)]| chunk.iter().map(probable).sum::<f64>();
            // The sums of chunks of a fixed size do not depend on the number of threads.
            let sums: Vec<f64> = members.par_chunks(CHUNK).map(of_chunk).collect();
            let share = (sums.iter().sum::<f64>() / total).clamp(PICTURE_SHARE.0, PICTURE_SHARE.1);
            log_odds = 0.5 * (share / (1.0 - share)).ln();
        }
        PictureOddsFound { pixels: members.len() as u32, log_odds: log_odds as f32 }
    }
}

impl Source<'_> {
    /// The observations of chroma and of brightness.
    fn against_surroundings(&self, sigma: f32) -> (Raster<f32>, Raster<f32>) {
        let log_chroma = |index: usize| self.map.colors[index].chroma.max(1.5 * sigma).max(1e-3).ln();
        let largest = |index: usize| self.map.colors[index].largest;
        let sums = blur(
            &self.map.raster(|index| {
                let point = &self.map.points[index];
                let quiet = point.is_judged() && !point.is_strong() && self.map.usable[index] > 0.0;
                let weight = if quiet { 1.0 } else { 0.0 };
                let l = log_chroma(index);
                [weight, weight * l, weight * l * l, weight * largest(index)]
            }),
            SURROUNDINGS_PX,
        );
        let chroma = self.map.raster(|index| {
            let [weight, first, second, _] = sums[index];
            if weight < LEAST_WEIGHT {
                return 0.0;
            }
            let mean = first / weight;
            let deviation = (second / weight - mean * mean).max(0.0).sqrt();
            3.0 * (log_chroma(index) - mean + deviation / 2.0).clamp(-2.3, 1.0)
        });
        let brightness = self.map.raster(|index| {
            let [weight, .., around] = sums[index];
            if weight < LEAST_WEIGHT {
                return 0.0;
            }
            2.0 * (largest(index) / (around / weight).max(0.5)).clamp(0.5, 5.0).ln()
        });
        (chroma, brightness)
    }

    /// The observation of independence.
    fn independence(&self, sigma: f32) -> Raster<f32> {
        let amounts = |index: usize| [self.map.points[index].surface, self.map.points[index].body];
        let smooth = blur(
            &self.map.raster(|index| {
                let (weight, [surface, body]) = (self.map.usable[index], amounts(index));
                [weight, weight * surface, weight * body]
            }),
            SHADING_PX,
        );
        let products = blur(
            &self.map.raster(|index| {
                let [weight, surface, body] = smooth[index];
                if weight < LEAST_WEIGHT || self.map.usable[index] == 0.0 {
                    return [0.0; 4];
                }
                let [s, b] = amounts(index);
                let (s, b) = (s - surface / weight, b - body / weight);
                [1.0, s * b, s * s, b * b]
            }),
            PRODUCTS_PX,
        );
        let floor = NOISE * sigma * sigma;
        self.map.raster(|index| {
            let [weight, both, surface, body] = products[index];
            if weight < LEAST_WEIGHT {
                return 0.0;
            }
            let scale = ((surface / weight).max(0.0) + floor) * ((body / weight).max(0.0) + floor);
            4.0 * (both / weight) / scale.sqrt().max(1e-6)
        })
    }

    /// The observation of edges.
    fn edges(&self) -> Raster<f32> {
        let smooth = blur(
            &self.map.raster(|index| [self.map.points[index].surface, self.map.points[index].body]),
            GRADIENT_SMOOTHING_PX,
        );
        let (width, height) = (smooth.width(), smooth.height());
        let gradient = |x: usize, y: usize| -> [f32; 2] {
            let at = |x: usize, y: usize| smooth[y * width + x];
            let across = [at((x + 1).min(width - 1), y), at(x.saturating_sub(1), y)];
            let down = [at(x, (y + 1).min(height - 1)), at(x, y.saturating_sub(1))];
            std::array::from_fn(|k| (across[0][k] - across[1][k]).hypot(down[0][k] - down[1][k]) / 2.0)
        };
        let gradients = blur(&self.map.roi.raster_by_place(gradient), GRADIENT_MEAN_PX);
        self.map.raster(|index| {
            let [surface, body] = gradients[index];
            (surface / body.max(LEAST_AMOUNT)).clamp(0.2, 20.0).ln()
        })
    }

    /// The mean of the log odds of near pixels, weighted by the square of the surface reflection.
    fn averaged(&self, terms: &Raster<HighlightTerms>) -> Raster<f32> {
        let sums = blur(
            &self.map.raster(|index| {
                let amount = self.map.points[index].surface.max(LEAST_AMOUNT);
                let weight = self.map.usable[index] * amount * amount;
                [weight, weight * (PRIOR + terms[index].sum())]
            }),
            AVERAGE_PX,
        );
        self.map.raster(|index| {
            let [weight, sum] = sums[index];
            if weight > 1e-9 { sum / weight } else { 0.0 }
        })
    }
}
