//! Rule `belief`: does this picture have highlights at all, under this light?
//!
//! White paper, grey metal and black print have no hue to be told by, and a light that was guessed wrong makes highlights of
//! whole surfaces. Doing nothing is then the better answer.

use super::shade::Shades;
use crate::raster::{Mask, Raster};
use crate::segment::{LIGHT_LIMITS, LightBasis, LightFindings, Scene};
use crate::trace::{BeliefLimits, BeliefTested, Doubt};

/// Most surface reflection, as a share of all light there.
const MOST_SURFACE: f64 = 0.18;
/// Most of the strong highlights that may outshine the body under them.
const MOST_OUTSHINING: f64 = 0.6;

/// Asks for one reason for doubt after the other, until one is found.
pub fn test(
    scene: &Scene,
    light: &LightFindings,
    shades: &Shades,
    weights: &Raster<f32>,
    outside: &Mask,
) -> BeliefTested {
    let limits =
        BeliefLimits { share: LIGHT_LIMITS.share, surface: MOST_SURFACE, outshining: MOST_OUTSHINING };
    let vouched_for = light.basis == LightBasis::Given || light.support >= LIGHT_LIMITS.support;
    let asked = scene.refine.vote_light && !vouched_for;
    let tested = BeliefTested {
        share: asked.then_some(light.share),
        surface: None,
        outshining: None,
        limits,
        doubt: None,
    };
    if tested.share.is_some_and(|share| share < limits.share) {
        return BeliefTested { doubt: Some(Doubt::NoVote), ..tested };
    }
    let Found { surface, total, strong, outshining } = Found::of(scene, shades, weights, outside);
    let (share, white) = (surface / total.max(1.0), f64::from(outshining) / f64::from(strong.max(1)));
    let doubt = if share > MOST_SURFACE {
        Some(Doubt::TooMuch)
    } else {
        (white > MOST_OUTSHINING).then_some(Doubt::Outshining)
    };
    BeliefTested { surface: Some(share), outshining: Some((white, strong)), doubt, ..tested }
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
    fn of(scene: &Scene, shades: &Shades, weights: &Raster<f32>, outside: &Mask) -> Self {
        let mut found = Self::default();
        for (index, point) in shades.points.as_slice().iter().enumerate() {
            let pixel = shades.window.pixel(index);
            if !outside[pixel] {
                continue;
            }
            found.total += f64::from(scene.pixels[pixel].iter().sum::<f32>()) / 3.0;
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
