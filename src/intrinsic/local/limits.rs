//! The limits of the local split that the history of a pixel uses as well.

use crate::segment::AnalysisInput;
use crate::trace::{LocalLimits, Ramp};

/// Least mean of J at which a color has a hue, counts.
const LEAST_MEAN: f32 = 5.1;
/// Least chromatic part of J at which a color has a hue, standard deviations of the noise.
const LEAST_CHROMA: f32 = 3.0;
/// Log odds of a highlight over which the weight of surface reflection rises.
const ODDS: Ramp = Ramp { start: -1.5, end: 1.5 };
/// κ over which the weight of surface reflection falls.
const RATIO: Ramp = Ramp { start: 5.0, end: 9.0 };

/// The limits for a picture with the noise of `input`.
pub fn limits(input: &AnalysisInput) -> LocalLimits {
    let sigma = input.sigma() as f32;
    LocalLimits { mean: LEAST_MEAN, chroma: LEAST_CHROMA * sigma, odds: ODDS, ratio: RATIO, sigma }
}
