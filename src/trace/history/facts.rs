//! What is known of a pixel without looking at the order of events: its mask, its region's vectors, its amounts.

use super::MaskVerdict;
use super::growth::brightness;
use crate::photo::{LinearImage, MaskLimits, Masks};
use crate::raster::RegionId;
use crate::reflection::{AmountRule, Amounts};
use crate::trace::{Event, Renumbered, Trace, VectorsFitted};

/// The vectors of each hypothesis's region, by [`HypothesisId::index`](crate::raster::HypothesisId::index); none for a
/// hypothesis that is in no region.
pub(super) fn final_vectors(trace: &Trace) -> Vec<Option<&VectorsFitted>> {
    let mut vectors: Vec<&VectorsFitted> = Vec::new();
    let mut regions: &[Option<RegionId>] = &[];
    for (_, event) in trace.events() {
        match event {
            Event::VectorsFitted(fitted) => vectors.push(fitted),
            Event::Renumbered(Renumbered { regions: found }) => regions = found,
            _ => {}
        }
    }
    let of = |region: &Option<RegionId>| region.and_then(|region| vectors.get(region.index()).copied());
    regions.iter().map(of).collect()
}

/// Everything that is said of a pixel's mask.
pub(super) fn verdicts(
    image: &LinearImage,
    masks: &Masks,
    limits: &MaskLimits,
    pixel: usize,
) -> Vec<MaskVerdict> {
    let color = image.pixels[pixel];
    let brightness = [f64::from(brightness(color)), limits.min_intensity];
    let largest = [f64::from(color[0].max(color[1]).max(color[2])), limits.clip_threshold];
    let clipped_neighbors = masks.clipped_neighbors(pixel);
    let mut found = Vec::new();
    if masks.outside(pixel) {
        found.push(MaskVerdict::Outside);
    }
    if masks.invalid(pixel) {
        found.push(MaskVerdict::Invalid);
    } else if limits.is_dark(color) {
        found.push(MaskVerdict::Dark { brightness });
    }
    if limits.is_clipped(color) {
        found.push(MaskVerdict::Clipped { largest });
    } else if limits.is_bloomed(clipped_neighbors) {
        found.push(MaskVerdict::Bloomed { neighbors: [clipped_neighbors, limits.bloom_density] });
    }
    if found.is_empty() {
        found.push(MaskVerdict::Believed { brightness, largest });
    }
    found
}

/// The amounts of a believed color (equation 13), by the rule of the split.
pub(super) fn amounts(fitted: &VectorsFitted, color: [f32; 3]) -> Amounts {
    let color = std::array::from_fn(|band| color[band] - fitted.origin[band] as f32);
    AmountRule::new(&fitted.body, fitted.surface.as_ref(), fitted.least_offset).amounts(color)
}
