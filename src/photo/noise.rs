//! Estimates the camera noise from a single image.
//!
//! The paper measures the noise from repeated photographs of a white board (section 7.3). A single image suffices,
//! because within a small window on one material the colors spread along at most two directions (shading, highlight),
//! so that only noise remains along the third. The smallest eigenvalue of a window of n×n pixels is biased low, and
//! textured windows are biased high. A low quantile over all windows and the factor 1 − 1.63/n (from a simulation of
//! pure noise) correct both biases.

use super::{LinearImage, Masks};
use crate::color::{Moments, eigenvalues};
use rayon::prelude::*;

const WINDOW_PX: usize = 10;
const QUANTILE: f64 = 0.4;
const MIN_WINDOWS: usize = 8;

/// Standard deviation σ of the noise of a band, counts; `None` when fewer than 8 windows have enough usable pixels.
pub fn estimate_sigma(image: &LinearImage, masks: &Masks) -> Option<f64> {
    estimate_sigma_sparsely(image, masks, 1)
}

/// As [`estimate_sigma`], from every `step`-th window of each row of windows, in the next row beginning one window later. In a
/// large picture fewer windows are enough, and cost less.
pub fn estimate_sigma_sparsely(image: &LinearImage, masks: &Masks, step: usize) -> Option<f64> {
    let step = step.max(1);
    let (width, height) = (image.width(), image.height());
    let mut smallest: Vec<f64> = (0..height / WINDOW_PX)
        .into_par_iter()
        .flat_map_iter(|row| {
            (row % step..width / WINDOW_PX).step_by(step).filter_map(move |column| {
                let mut moments = Moments::default();
                for y in row * WINDOW_PX..(row + 1) * WINDOW_PX {
                    let start = y * width + column * WINDOW_PX;
                    for pixel in (start..start + WINDOW_PX).filter(|&pixel| masks.usable(pixel)) {
                        moments.add(image.pixels[pixel]);
                    }
                }
                let enough = moments.n >= (WINDOW_PX * WINDOW_PX) as f64 / 2.0;
                enough.then(|| eigenvalues(&moments.covariance())[2])
            })
        })
        .collect();
    if smallest.len() < MIN_WINDOWS {
        return None;
    }
    let rank = (smallest.len() as f64 * QUANTILE) as usize;
    let (_, &mut variance, _) = smallest.select_nth_unstable_by(rank, f64::total_cmp);
    Some((variance.max(0.0) / (1.0 - 1.63 / WINDOW_PX as f64)).sqrt())
}
