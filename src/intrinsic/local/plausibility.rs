//! Rule `belief`: whether highlights under this light are plausible at all.
//!
//! A wrong light makes highlights of whole surfaces. Where explained regions support the light, or the light was given, no vote is needed;
//! elsewhere a share of the votes has to be for the light. In other pictures no local split at all gives the better result.

use crate::segment::{AnalysisInput, LIGHT_LIMITS, LightBasis, LightFindings};
use crate::trace::PlausibilityTested;

/// Support of the planes' light from which on no vote is needed.
const CERTAIN_SUPPORT: f64 = 0.3;

/// Tests whether highlights under the light are plausible.
pub fn test(input: &AnalysisInput, light: &LightFindings) -> PlausibilityTested {
    let is_light_certain = light.basis == LightBasis::Given || light.support >= CERTAIN_SUPPORT;
    let needs_votes = input.refine.vote_light && !is_light_certain;
    PlausibilityTested { share: needs_votes.then_some(light.share), least_share: LIGHT_LIMITS.share }
}
