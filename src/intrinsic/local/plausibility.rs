//! Rule `belief`: whether highlights under this light are plausible at all.
//!
//! A wrong light turns whole surfaces into highlights. A light that was given, one with a support of at least 0.3, and
//! every light with the switch `vote_light` off need no votes; for other lights at least `LIGHT_LIMITS.share` of the
//! votes has to be for the light. In other pictures no local split at all gives the better result.

use crate::segment::{AnalysisInput, LIGHT_LIMITS, LightBasis, LightFindings};
use crate::trace::PlausibilityTested;

/// Support of the planes' light, a share of 0…1, from which on no votes are needed.
const CERTAIN_SUPPORT: f64 = 0.3;

/// Tests whether highlights under the light are plausible.
pub fn test(input: &AnalysisInput, light: &LightFindings) -> PlausibilityTested {
    let is_light_certain = light.basis == LightBasis::Given || light.support >= CERTAIN_SUPPORT;
    let needs_votes = input.refine.vote_light && !is_light_certain;
    PlausibilityTested { share: needs_votes.then_some(light.share), least_share: LIGHT_LIMITS.share }
}
