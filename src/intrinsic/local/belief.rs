//! Rule `belief`: does this picture have highlights at all, under this light?
//!
//! White paper, grey metal and black print have no hue to be told by, and a light that was guessed wrong makes highlights of
//! whole surfaces. Doing nothing is then the better answer.

use super::shade::Shades;
use crate::raster::{Mask, Raster};
use crate::segment::{LightBasis, LightFindings, Scene, white_offsets_deg};

/// Least share of the votes for the light, unless regions that hold so large a part of what is lit vouch for it.
const LEAST_SHARE: f64 = 0.02;
const SUPPORTED: f64 = 0.3;
/// How far from white a voted light is believed: blue to yellow, green to magenta, degrees.
const USUAL_DEG: [f64; 2] = [20.0, 8.0];
/// Most surface reflection, as a share of all light there.
const MOST_SURFACE: f64 = 0.18;
/// Most of the strong highlights that may outshine the body under them.
const MOST_OUTSHINING: f64 = 0.6;

/// Why nothing is split locally.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// Small highlights do not speak for the light: the share of them that does.
    NoVote(f64),
    /// The light would be unusual: degrees between blue and yellow, and between green and magenta.
    UnusualLight([f64; 2]),
    /// So large a share of the picture's light would be surface reflection.
    TooMuch(f64),
    /// So many highlights outshine the body: they are white things.
    Outshining(f64),
}

impl Doubt {
    /// The first reason for doubt; none where highlights are believed.
    pub fn about(
        scene: &Scene,
        light: &LightFindings,
        shades: &Shades,
        weights: &Raster<f32>,
        outside: &Mask,
    ) -> Option<Self> {
        let vouched_for = light.basis == LightBasis::Given || light.support >= SUPPORTED;
        if scene.refine.vote_light && !vouched_for && light.share < LEAST_SHARE {
            return Some(Self::NoVote(light.share));
        }
        let direction = light.direction?;
        let offsets = white_offsets_deg(&direction.into());
        if light.basis == LightBasis::Votes && (0..2).any(|i| offsets[i].abs() > USUAL_DEG[i]) {
            return Some(Self::UnusualLight(offsets));
        }
        let (mut surface, mut total) = (0.0f64, 0.0f64);
        let (mut strong, mut outshining) = (0usize, 0usize);
        for (index, point) in shades.points.as_slice().iter().enumerate() {
            let pixel = shades.window.pixel(index);
            if !outside[pixel] {
                continue;
            }
            total += f64::from(scene.pixels[pixel].iter().sum::<f32>()) / 3.0;
            if weights[index] <= 0.0 {
                continue;
            }
            surface += f64::from(weights[index] * point.surface);
            if point.surface > point.high {
                strong += usize::from(point.surface > 0.3 * point.body);
                outshining += usize::from(point.surface > point.body);
            }
        }
        let (share, white) = (surface / total.max(1.0), outshining as f64 / strong.max(1) as f64);
        if share > MOST_SURFACE {
            return Some(Self::TooMuch(share));
        }
        (white > MOST_OUTSHINING).then_some(Self::Outshining(white))
    }
}
