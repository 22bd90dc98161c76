//! The local split of the photograph, guided by the local split of its working picture (no counterpart in the paper).
//!
//! The pixels that no region explains are split locally at full resolution, where highlights are many pixels wide and their edges
//! are seen. Whether highlights are plausible at all was decided in the working picture, whose colors are less noisy. A clipped blob
//! that was not repaired at full resolution takes the body reflection with which the working picture was filled, interpolated between
//! the working pixels.
//!
//! Measured without refinement `coding_error` on ten scenes of 2048 × 1920 pixels, mean body over PNG files and over JPEG files of a mosaic sensor
//! (doing nothing: 22.5 dB):
//! - this rule: 37.3 and 35.2 dB,
//! - weights and ratios of the working picture, applied to single pixels: 37.4 and 32.9 dB,
//! - plausibility and fill at full resolution only: 36.0 and 34.7 dB,
//! - no working picture: 34.6 and 33.8 dB.

use super::repair::CONFIDENCE;
use super::{LocalInput, LocalSplit, LocalTraceWriter, split_unexplained, undo_unexplained};
use crate::intrinsic::detail::{Detail, WorkingSplit};
use crate::intrinsic::images::Images;
use crate::raster::{Blocks, Mask, Raster};
use crate::trace::{NoopRecorder, PixelKind};
use rayon::prelude::*;

/// Undoes the split of the pixels of the photograph that their region does not explain, and splits these pixels locally. Returns
/// the confidence of each pixel, 0 for those that were not split locally; none where no pixel was split locally, or `local` is none. `local` is what
/// the local split of the working picture found. `explained_mask` has the pixels that the skewed T of their region explains.
pub fn split_locally_at_full_resolution(
    detail: &Detail,
    working: &WorkingSplit,
    local: Option<&LocalSplit>,
    explained_mask: &Mask,
    images: &mut Images,
) -> Option<Raster<f32>> {
    let unexplained = undo_unexplained(&detail.input, explained_mask, images);
    let local = local?;
    // The highlights of the working picture passed the plausibility test, so that the photograph needs none.
    let mut input = detail.input;
    input.refine.belief = false;
    let photograph = LocalInput { input: &input, light: working.regions.light, explained_mask };
    let mut recorder = NoopRecorder;
    let mut trace_writer = LocalTraceWriter::new(&mut recorder, working.origin);
    let found = split_unexplained(&photograph, &unexplained, images, &mut trace_writer)?;
    let mut confidence = found.confidence;
    fill_from_working_picture(detail, working, local, &unexplained, images, &mut confidence);
    Some(confidence)
}

/// Gives clipped pixels of confidence 0, which were not repaired at full resolution, the body reflection with which the working picture was filled.
fn fill_from_working_picture(
    detail: &Detail,
    working: &WorkingSplit,
    local: &LocalSplit,
    unexplained: &Mask,
    images: &mut Images,
    confidence: &mut Raster<f32>,
) {
    let filled = |working_pixel: usize| local.filled.as_slice().get(working_pixel) == Some(&true);
    let width = unexplained.width();
    let rows = (
        images.body.as_mut_slice().par_chunks_mut(width.max(1)),
        images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
        images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        confidence.as_mut_slice().par_chunks_mut(width.max(1)),
    );
    rows.into_par_iter().enumerate().for_each(|(y, (body, surface, kinds, confidence))| {
        for x in 0..width {
            let pixel = y * width + x;
            if !unexplained[pixel] || !detail.input.masks.clipped(pixel) || confidence[x] > 0.0 {
                continue;
            }
            let nearest = Nearest::new(&detail.blocks, x, y);
            let Some(fill) = nearest.mean(|pixel| filled(pixel).then(|| working.images.body[pixel])) else {
                continue;
            };
            let color = detail.input.pixels[pixel];
            body[x] = std::array::from_fn(|band| fill[band].clamp(0.0, color[band].max(0.0)));
            surface[x] = std::array::from_fn(|band| color[band] - body[x][band]);
            if kinds[x] != PixelKind::Unassigned {
                kinds[x] = PixelKind::Restored;
            }
            confidence[x] = CONFIDENCE;
        }
    });
}

/// A working pixel, and its share in a bilinear interpolation.
struct Share {
    working_pixel: usize,
    weight: f32,
}

/// The working pixels nearest to a pixel of the photograph.
struct Nearest {
    /// The four nearest working pixels.
    shares: [Share; 4],
}

impl Nearest {
    fn new(blocks: &Blocks, x: usize, y: usize) -> Self {
        let side = blocks.side() as f32;
        let place = [(x as f32 + 0.5) / side, (y as f32 + 0.5) / side];
        let between = |at: f32, count: usize| {
            let at = (at - 0.5).clamp(0.0, count.saturating_sub(1) as f32);
            let first = at as usize;
            [(first, 1.0 - at.fract()), ((first + 1).min(count.saturating_sub(1)), at.fract())]
        };
        let [left, right] = between(place[0], blocks.columns());
        let [top, bottom] = between(place[1], blocks.rows());
        let share = |column: (usize, f32), row: (usize, f32)| Share {
            working_pixel: row.0 * blocks.columns() + column.0,
            weight: row.1 * column.1,
        };
        Self { shares: [share(left, top), share(right, top), share(left, bottom), share(right, bottom)] }
    }

    /// The weighted mean of the values of the four working pixels that have a value; `None` if none of the four has one.
    fn mean(&self, value: impl Fn(usize) -> Option<[f32; 3]>) -> Option<[f32; 3]> {
        let (mut sum, mut total) = ([0.0f32; 3], 0.0f32);
        for &Share { working_pixel, weight } in self.shares.iter().filter(|share| share.weight > 0.0) {
            if let Some(value) = value(working_pixel) {
                sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * value);
                total += weight;
            }
        }
        (total > 0.0).then(|| sum.map(|sum| sum / total))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_between_working_pixels_takes_from_both() {
        let blocks = Blocks::new(2, 8, 4);
        let value = |place: usize| Some([place as f32; 3]);
        let mean = |x, y| Nearest::new(&blocks, x, y).mean(value).unwrap()[0];
        assert!((mean(0, 0) - 0.0).abs() < 1e-6, "the picture's corner");
        assert!((mean(1, 0) - 0.25).abs() < 1e-6 && (mean(2, 0) - 0.75).abs() < 1e-6);
        assert!((mean(0, 2) - 3.0).abs() < 1e-6 && (mean(7, 3) - 7.0).abs() < 1e-6);
        let only = Nearest::new(&blocks, 1, 0).mean(|place| (place == 1).then_some([9.0; 3]));
        assert_eq!(only, Some([9.0; 3]), "working pixels without a value do not count");
        assert_eq!(Nearest::new(&blocks, 1, 0).mean(|_| None), None);
    }
}
