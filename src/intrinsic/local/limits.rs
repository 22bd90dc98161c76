//! The limits of the local split that the history of a pixel uses as well.

use crate::segment::AnalysisInput;
use crate::trace::{LocalLimits, TextureFade};

/// Least mean of J at which a color has a hue, counts.
const LEAST_MEAN: f32 = 5.1;
/// Least chromatic part of J at which a color has a hue, standard deviations of the noise.
const LEAST_CHROMA: f32 = 3.0;
/// Texture at which surface reflection begins to lose weight.
const TEXTURE_START: f32 = 0.1;
/// How far texture rises from there until surface reflection has no weight.
const TEXTURE_WIDTH: f32 = 0.2;
/// Texture from which on a pixel is no part of the core of a highlight.
const CORE_TEXTURE: f32 = 0.15;

/// The limits for a picture with the noise of `input`.
pub fn limits(input: &AnalysisInput) -> LocalLimits {
    let sigma = input.sigma() as f32;
    LocalLimits {
        mean: LEAST_MEAN,
        chroma: LEAST_CHROMA * sigma,
        texture: TextureFade { start: TEXTURE_START, width: TEXTURE_WIDTH },
        core_texture: CORE_TEXTURE,
        sigma,
    }
}
