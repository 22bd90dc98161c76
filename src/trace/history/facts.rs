//! What is known of a pixel whatever the order of events: the verdicts of the masks, and the amounts of its color.

use super::MaskVerdict;
use super::growth::brightness;
use crate::color::Cylinder;
use crate::photo::{LinearImage, MaskLimits, Masks};
use crate::reflection::{AmountRule, Amounts};
use crate::trace::VectorsFitted;

/// The verdicts of the masks on a pixel, but that on a clipped object: the numbers that decided are in its event.
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
    if found.is_empty() && !masks.in_clipped_object(pixel) {
        found.push(MaskVerdict::Believed { brightness, largest });
    }
    found
}

/// The amounts of an undistorted color (equation 13), by the rule of the split.
pub(super) fn amounts(fitted: &VectorsFitted, color: [f32; 3]) -> Amounts {
    let color = std::array::from_fn(|band| color[band] - fitted.origin[band] as f32);
    // The event has a surface vector only where the angle to the body vector was large enough for a split.
    AmountRule::with_least_angle(&fitted.body, fitted.surface.as_ref(), fitted.least_offset, 0.0)
        .with_noise_line(fitted.noise_line.map(|line| Cylinder::new(&line, 0.0)))
        .amounts(color)
}
