//! Which of two lamps lights each region and each pixel (section 7.5).
//!
//! A region whose highlights tell of a lamp has that lamp, a region without highlights that of the nearest region. A pixel that no
//! region explains has the lamp of the nearest highlight.

use super::input::AnalysisInput;
use super::light::SecondLampFindings;
use super::planar_hypothesis::PlanarHypothesis;
use crate::color::Vec3;
use crate::raster::{HypothesisId, LabelMap, Mask, Raster};
use crate::reflection::PlaneAxes;
use rayon::prelude::*;

/// Distance from the matte line beyond which a pixel is a highlight, radii of the cylinder.
const HIGHLIGHT_RADII: f64 = 2.0;

/// The second lamp, and the regions that it lights.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondLamp {
    /// Unit direction of the lamp's color.
    pub direction: Vec3,
    /// Two standard deviations of the direction, degrees; `None` for a lamp that was given.
    pub interval_deg: Option<f64>,
    /// Number of regions whose highlights agree with the lamp.
    pub regions: usize,
    /// Whether the second lamp lights each region, by [`HypothesisId::index`].
    pub lights: Vec<bool>,
}

impl SecondLamp {
    /// What the result tells of the lamp.
    pub fn findings(&self) -> SecondLampFindings {
        SecondLampFindings {
            direction: self.direction.into(),
            interval_deg: self.interval_deg,
            regions: self.regions,
            given: self.interval_deg.is_none(),
        }
    }

    /// The pixels that the second lamp lights: those whose nearest highlight is in a region of that lamp. `labels`: region of each pixel, with
    /// the planes of `hypotheses`.
    pub fn lit_pixels(
        &self,
        input: &AnalysisInput,
        labels: &LabelMap,
        hypotheses: &[PlanarHypothesis],
    ) -> Mask {
        let planes: Vec<Option<PlaneAxes>> =
            hypotheses.iter().map(|hypothesis| hypothesis.plane.map(|plane| plane.coordinates())).collect();
        let least_offset = (HIGHLIGHT_RADII * input.used.radius_counts()) as f32;
        let seed = |pixel: usize| {
            let id = HypothesisId::from_label(labels[pixel]).filter(|_| input.masks.usable(pixel))?;
            let axes = planes.get(id.index()).copied().flatten()?;
            (axes.of(input.pixels[pixel]).offset > least_offset)
                .then(|| self.lights.get(id.index()).copied())?
        };
        let seeds = (0..labels.len()).into_par_iter().map(seed).collect();
        nearest_lamp(&Raster::from_vec(labels.width(), labels.height(), seeds).unwrap_or_default())
    }
}

/// Whether the second lamp lights each region: as far as `known`, and else as it lights most of the region's pixels by the nearest region
/// that is known.
pub fn lights_of_regions(labels: &LabelMap, known: &[Option<bool>]) -> Vec<bool> {
    let seeds = labels.map(|&label| {
        HypothesisId::from_label(label).and_then(|id| known.get(id.index()).copied().flatten())
    });
    let nearest = nearest_lamp(&seeds);
    let mut votes = vec![0i64; known.len()];
    for (&label, &second) in labels.as_slice().iter().zip(nearest.as_slice()) {
        if let Some(vote) = HypothesisId::from_label(label).and_then(|id| votes.get_mut(id.index())) {
            *vote += if second { 1 } else { -1 };
        }
    }
    known.iter().zip(votes).map(|(known, votes)| known.unwrap_or(votes > 0)).collect()
}

/// The pixels that the second lamp lights: those whose nearest seed is one of the second lamp. `seeds`: the pixels known to be lit by the first
/// lamp (`Some(false)`) and by the second (`Some(true)`). The distance counts steps to pixels that share a side.
fn nearest_lamp(seeds: &Raster<Option<bool>>) -> Mask {
    let mut lit = seeds.clone();
    let mut front: Vec<u32> =
        (0..lit.len()).filter(|&pixel| lit[pixel].is_some()).map(|pixel| pixel as u32).collect();
    while !front.is_empty() {
        let mut next = Vec::new();
        for pixel in front {
            let lamp = lit[pixel as usize];
            lit.for_each_neighbor(pixel as usize, |near| next.push((near, lamp)));
        }
        next.retain(|&(near, lamp)| {
            let is_new = lit[near].is_none();
            if is_new {
                lit[near] = lamp;
            }
            is_new
        });
        front = next.into_iter().map(|(near, _)| near as u32).collect();
    }
    lit.map(|lamp| *lamp == Some(true))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_pixel_is_lit_by_the_lamp_of_the_nearest_seed() {
        let seeds = [Some(false), None, None, None, None, Some(true), None].to_vec();
        let lit = nearest_lamp(&Raster::from_vec(7, 1, seeds).unwrap());
        assert_eq!(lit.as_slice(), [false, false, false, true, true, true, true]);
        assert_eq!(nearest_lamp(&Raster::filled(2, 2, None)).count(), 0, "without a seed");
    }
}
