//! Rule `plausibility`: does this picture have highlights at all, under this light?
//!
//! White paper, gray metal and black print have no hue to be told by, and a light that was guessed wrong makes highlights of
//! whole surfaces. Doing nothing is then the better answer.

use super::shade::Shades;
use crate::raster::{Mask, Raster};
use crate::segment::{AnalysisInput, LIGHT_LIMITS, LightBasis, LightFindings};
use crate::trace::{PlausibilityLimits, PlausibilityTested, RejectReason};

/// Most surface reflection, as a share of all light there.
const MOST_SURFACE: f64 = 0.18;
/// Most of the strong highlights that may outshine the body under them.
const MOST_OUTSHINING: f64 = 0.6;

/// Asks for one reason for doubt after the other, until one is found.
pub fn test(
    input: &AnalysisInput,
    light: &LightFindings,
    shades: &Shades,
    weights: &Raster<f32>,
    outside: &Mask,
) -> PlausibilityTested {
    let limits =
        PlausibilityLimits { share: LIGHT_LIMITS.share, surface: MOST_SURFACE, outshining: MOST_OUTSHINING };
    let vouched_for = light.basis == LightBasis::Given || light.support >= LIGHT_LIMITS.support;
    let asked = input.refine.vote_light && !vouched_for;
    let tested = PlausibilityTested {
        share: asked.then_some(light.share),
        surface: None,
        outshining: None,
        limits,
        reject_reason: None,
    };
    if tested.share.is_some_and(|share| share < limits.share) {
        return PlausibilityTested { reject_reason: Some(RejectReason::NoVote), ..tested };
    }
    let Found { surface, total, strong, outshining } = Found::of(input, shades, weights, outside);
    let (share, white) = (surface / total.max(1.0), f64::from(outshining) / f64::from(strong.max(1)));
    let reject_reason = if share > MOST_SURFACE {
        Some(RejectReason::TooMuch)
    } else {
        (white > MOST_OUTSHINING).then_some(RejectReason::Outshining)
    };
    PlausibilityTested { surface: Some(share), outshining: Some((white, strong)), reject_reason, ..tested }
}

/// What would be split.
#[derive(Default)]
struct Found {
    /// Surface reflection, and all light there, counts.
    surface: f64,
    total: f64,
    /// Strong highlight pixels, and those of them that outshine the body.
    strong: u32,
    outshining: u32,
}

impl Found {
    fn of(input: &AnalysisInput, shades: &Shades, weights: &Raster<f32>, outside: &Mask) -> Self {
        let mut found = Self::default();
        for (index, point) in shades.points.as_slice().iter().enumerate() {
            let pixel = shades.roi.pixel(index);
            if !outside[pixel] {
                continue;
            }
            found.total += f64::from(input.pixels[pixel].iter().sum::<f32>()) / 3.0;
            if weights[index] <= 0.0 {
                continue;
            }
            found.surface += f64::from(weights[index] * point.surface);
            if point.surface > point.high {
                found.strong += u32::from(point.surface > 0.3 * point.body);
                found.outshining += u32::from(point.surface > point.body);
            }
        }
        found
    }
}
