//! Rule `belief`: does this picture have highlights at all, under this light?
//!
//! White paper, grey metal and black print have no hue to be told by, and a light that was guessed wrong makes highlights of
//! whole surfaces. Doing nothing is then the better answer.

use super::shade::Shades;
use crate::raster::{Mask, Raster};
use crate::segment::{LightBasis, LightFindings, Scene, white_offsets_deg};
use crate::trace::{BeliefLimits, BeliefTested, Doubt};

/// Least share of the votes for the light, unless regions that hold so large a part of what is lit vouch for it.
const LEAST_SHARE: f64 = 0.02;
const SUPPORTED: f64 = 0.3;
/// How far from white a voted light is believed: blue to yellow, green to magenta, degrees.
const USUAL_DEG: [f64; 2] = [20.0, 8.0];
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
    let limits = BeliefLimits {
        share: LEAST_SHARE,
        offsets_deg: USUAL_DEG,
        surface: MOST_SURFACE,
        outshining: MOST_OUTSHINING,
    };
    let vouched_for = light.basis == LightBasis::Given || light.support >= SUPPORTED;
    let asked = scene.refine.vote_light && !vouched_for;
    let voted = light.direction.filter(|_| light.basis == LightBasis::Votes);
    let tested = BeliefTested {
        share: asked.then_some(light.share),
        offsets_deg: voted.map(|direction| white_offsets_deg(&direction.into())),
        surface: None,
        outshining: None,
        limits,
        doubt: None,
    };
    if tested.share.is_some_and(|share| share < LEAST_SHARE) {
        return BeliefTested { doubt: Some(Doubt::NoVote), ..tested };
    }
    let unusual = |offsets: [f64; 2]| (0..2).any(|i| offsets[i].abs() > USUAL_DEG[i]);
    if tested.offsets_deg.is_some_and(unusual) {
        return BeliefTested { doubt: Some(Doubt::UnusualLight), ..tested };
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
