//! The unclipped pixels around blobs of clipped pixels, and the harmonic fill of a blob: the smoothest that is continuous with them.

use crate::photo::Masks;
use crate::raster::{Mask, Raster, Roi, relax};

/// Finds the unclipped pixels around blobs of clipped pixels, ring by ring.
pub struct Surroundings<'a> {
    masks: &'a Masks,
    /// The pixels that are already in a ring of the current blob; all false between two blobs.
    in_ring: Mask,
}

impl<'a> Surroundings<'a> {
    /// The surroundings in a picture with these masks.
    pub fn new(masks: &'a Masks) -> Self {
        let (width, height) = masks.shape();
        Self { masks, in_ring: Raster::filled(width, height, false) }
    }

    /// The first two rings around a blob: the known pixels next to the blob, and those next to these; see [`is_known`]. `is_enlarged` is
    /// given the number of each ring, from 1, and its pixels; from the second ring on, the next is found as long as it returns true.
    pub fn rings(
        &mut self,
        blob: &[usize],
        mut is_enlarged: impl FnMut(usize, &[usize]) -> bool,
    ) -> [Vec<usize>; 2] {
        let mut rings: Vec<Vec<usize>> = Vec::new();
        loop {
            let ring = self.ring(rings.last().map_or(blob, Vec::as_slice));
            let goes_on = is_enlarged(rings.len() + 1, &ring) || rings.is_empty();
            let is_last = ring.is_empty() && !rings.is_empty();
            rings.push(ring);
            if is_last || (rings.len() >= 2 && !goes_on) {
                break;
            }
        }
        rings.iter().flatten().for_each(|&pixel| self.in_ring[pixel] = false);
        let mut rings = rings.into_iter();
        std::array::from_fn(|_| rings.next().unwrap_or_default())
    }

    /// The known pixels next to the pixels `from` that are in no ring yet.
    fn ring(&mut self, from: &[usize]) -> Vec<usize> {
        let mut ring = Vec::new();
        for &pixel in from {
            for near in self.in_ring.around(pixel) {
                if !self.in_ring[near] && is_known(self.masks, near) {
                    self.in_ring[near] = true;
                    ring.push(near);
                }
            }
        }
        ring
    }
}

/// Whether the value of a pixel can be used: the pixel is neither clipped nor invalid nor outside of the analyzed area.
fn is_known(masks: &Masks, pixel: usize) -> bool {
    !masks.clipped(pixel) && masks.has_value(pixel)
}

/// The harmonic fill of a blob by the `value` of the pixels of its `rings`: colors, each the mean of its neighbors in the blob and in the inner ring,
/// by successive over-relaxation that begins with the mean of both rings. `size`: columns and rows of the picture. The fill is black where the rings
/// are empty.
pub fn harmonic(
    size: (usize, usize),
    blob: &[usize],
    rings: &[Vec<usize>; 2],
    value: impl Fn(usize) -> [f32; 3],
) -> Vec<[f32; 3]> {
    let ring = || rings.iter().flatten().map(|&pixel| value(pixel));
    let count = ring().count().max(1) as f32;
    let sum = ring().fold([0.0f32; 3], |sum, color| std::array::from_fn(|band| sum[band] + color[band]));
    let Some(roi) = Roi::around_pixels(size, 1, blob.iter().copied()) else { return Vec::new() };
    let mut values = Raster::filled(roi.width, roi.height, sum.map(|sum| sum / count));
    let mut is_beside = Mask::filled(roi.width, roi.height, false);
    for &pixel in &rings[0] {
        if let Some(place) = roi.index(pixel) {
            values[place] = value(pixel);
            is_beside[place] = true;
        }
    }
    let places: Vec<usize> = blob.iter().filter_map(|&pixel| roi.index(pixel)).collect();
    relax(&mut values, &is_beside, &places, usize::MAX);
    places.into_iter().map(|place| values[place]).collect()
}
