//! Rule `belief`: whether the picture has highlights at all under this light.
//!
//! White paper, gray metal and black print have no hue by which highlights could be found, and a wrong light makes highlights of
//! whole surfaces. In such pictures, no local split at all gives the better result.

use super::desaturation_map::DesaturationMap;
use crate::raster::{Mask, Raster};
use crate::segment::{AnalysisInput, LIGHT_LIMITS, LightBasis, LightFindings};
use crate::trace::{PlausibilityLimits, PlausibilityTested, RejectReason};

/// Support of the planes' light from which on no vote is needed.
const CERTAIN_SUPPORT: f64 = 0.3;
/// Most surface reflection of a plausible picture, as a share of all light of the unexplained pixels.
const MOST_SURFACE: f64 = 0.18;
/// Most strong highlight pixels with more surface than body reflection, as a share of all strong highlight pixels.
const MOST_OUTSHINING: f64 = 0.6;

/// Tests whether the highlights found are plausible: the light's votes first, then the amount of surface reflection, then the
/// share of highlights that outshine the body. The first test that fails ends the series; figures of later tests stay none.
/// `weights`: the share of ms that is surface reflection, of the pixels of the window.
pub fn test(
    input: &AnalysisInput,
    light: &LightFindings,
    map: &DesaturationMap,
    weights: &Raster<f32>,
    unexplained: &Mask,
) -> PlausibilityTested {
    let limits =
        PlausibilityLimits { share: LIGHT_LIMITS.share, surface: MOST_SURFACE, outshining: MOST_OUTSHINING };
    let is_light_certain = light.basis == LightBasis::Given || light.support >= CERTAIN_SUPPORT;
    let needs_votes = input.refine.vote_light && !is_light_certain;
    let tested = PlausibilityTested {
        share: needs_votes.then_some(light.share),
        surface: None,
        outshining: None,
        limits,
        reject_reason: None,
    };
    if tested.share.is_some_and(|share| share < limits.share) {
        return PlausibilityTested { reject_reason: Some(RejectReason::NoVote), ..tested };
    }
    let Totals { surface, all_light, strong, outshining } = Totals::of(input, map, weights, unexplained);
    let surface_share = surface / all_light.max(1.0);
    let outshining_share = f64::from(outshining) / f64::from(strong.max(1));
    let reject_reason = if surface_share > limits.surface {
        Some(RejectReason::TooMuch)
    } else {
        (outshining_share > limits.outshining).then_some(RejectReason::Outshining)
    };
    PlausibilityTested {
        surface: Some(surface_share),
        outshining: Some((outshining_share, strong)),
        reject_reason,
        ..tested
    }
}

/// Totals over the unexplained pixels of the window.
#[derive(Default)]
struct Totals {
    /// Sum of the surface reflection, counts.
    surface: f64,
    /// Sum of all light, as the mean of the bands, counts.
    all_light: f64,
    /// Number of strong highlight pixels with more surface reflection than 30 % of the body reflection.
    strong: u32,
    /// Number of strong highlight pixels with more surface than body reflection.
    outshining: u32,
}

impl Totals {
    fn of(input: &AnalysisInput, map: &DesaturationMap, weights: &Raster<f32>, unexplained: &Mask) -> Self {
        let mut totals = Self::default();
        for (index, point) in map.points.as_slice().iter().enumerate() {
            let pixel = map.roi.pixel(index);
            if !unexplained[pixel] {
                continue;
            }
            totals.all_light += f64::from(input.pixels[pixel].iter().sum::<f32>()) / 3.0;
            if weights[index] <= 0.0 {
                continue;
            }
            totals.surface += f64::from(weights[index] * point.surface);
            if point.surface > point.variation_limit {
                totals.strong += u32::from(point.surface > 0.3 * point.body);
                totals.outshining += u32::from(point.surface > point.body);
            }
        }
        totals
    }
}
