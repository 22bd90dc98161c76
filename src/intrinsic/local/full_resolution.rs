//! The local split of the photograph by the local split of its working picture (no counterpart in the paper).
//!
//! What is a highlight is decided in the working picture, whose colors are less noisy. There the amount of surface
//! reflection around each working pixel is a linear function p·a + q of a, the mean of J (rule `guided_amount`). The
//! functions, interpolated between the working pixels, give the amounts of the photograph's pixels, so that the edges
//! of the photograph's highlights are where the photograph has them. Interpolated likewise are
//! the change of chromaticity (rule `chromaticity_prior`), as a share of the length of body reflection, and the body reflection with
//! which the working picture was filled, which a clipped pixel takes. Where the working picture was not filled, a clipped pixel takes the
//! surface reflection of the pixels around it.

use super::chromaticity::changed;
use super::guided::AmountLine;
use super::hue_restoration::{by_hue, only_clipped_band};
use super::lamps::Lamp;
use super::linear_weights::linear_weights;
use super::repair::CONFIDENCE;
use super::{LocalSplit, Moved, undo_unexplained};
use crate::intrinsic::detail::Detail;
use crate::intrinsic::images::Images;
use crate::raster::{Mask, Raster, dilate};
use crate::trace::PixelKind;
use rayon::prelude::*;

/// What the local split found in the working picture.
pub struct LocalWorkingSplit<'a> {
    /// What the local split found; none where it did not run.
    pub local: Option<&'a LocalSplit>,
    /// The working pixels in which another color replaces the body reflection of their region; none where there is no such pixel.
    pub replaced: Option<&'a Mask>,
    /// Body reflection of the working pixels with the ambient light, counts.
    pub body: &'a Raster<[f32; 3]>,
    /// The ambient light, counts.
    pub origin: [f64; 3],
}

/// Undoes the split of the pixels of the photograph that their region does not explain, and splits these pixels by what
/// the working picture found. Returns the confidence of each pixel, 0 for those that were not split locally; `None`
/// where the working picture was not split locally: then the split by regions is undone all the same. `explained_mask`
/// has the pixels that the skewed T of their region explains. `is_split`: whether a pixel was split by its region.
pub fn split_locally_at_full_resolution(
    detail: &Detail,
    working: &LocalWorkingSplit,
    explained_mask: &Mask,
    is_split: impl Fn(usize) -> bool + Sync,
    images: &mut Images,
) -> Option<Raster<f32>> {
    let unexplained = undo_unexplained(&detail.input, explained_mask, is_split, images);
    let local = working.local?;
    let (width, height) = (unexplained.width(), unexplained.height());
    let mut confidence = Raster::filled(width, height, 0.0);
    let rows = (
        images.body.as_mut_slice().par_chunks_mut(width.max(1)),
        images.surface.as_mut_slice().par_chunks_mut(width.max(1)),
        images.kinds.as_mut_slice().par_chunks_mut(width.max(1)),
        confidence.as_mut_slice().par_chunks_mut(width.max(1)),
    );
    let by_working_picture = ByWorkingPicture::new(detail, working, local);
    let blocks = &detail.blocks;
    let columns: Vec<_> = (0..width).map(|x| nearest_of(x, blocks.side(), blocks.columns())).collect();
    rows.into_par_iter().enumerate().for_each(|(y, (body, surface, kinds, confidence))| {
        if detail.input.stopped() {
            return;
        }
        let nearest_rows = nearest_of(y, blocks.side(), blocks.rows());
        for column in 0..blocks.columns() {
            let working_pixel = (y / blocks.side()) * blocks.columns() + column;
            if working.replaced.is_some_and(|replaced| replaced[working_pixel]) {
                continue;
            }
            let is_near_amount = by_working_picture.near_amount[working_pixel];
            for x in blocks.pixel_columns(column) {
                let pixel = y * width + x;
                let is_clipped = detail.input.masks.clipped(pixel);
                if !unexplained[pixel] || !(is_near_amount || is_clipped) {
                    continue;
                }
                let nearest = Nearest::new(columns[x], nearest_rows, blocks.columns());
                let color = detail.input.pixels[pixel];
                let found = if is_clipped {
                    by_working_picture
                        .restored(color, working_pixel, &nearest)
                        .or_else(|| by_working_picture.filled(color, &nearest))
                        .or_else(|| by_working_picture.like_around(color, working_pixel, &nearest))
                } else {
                    by_working_picture.split(color, color, working_pixel, &nearest)
                };
                let Some(found) = found else { continue };
                (body[x], surface[x], confidence[x]) = (found.body, found.surface, found.confidence);
                if kinds[x] != PixelKind::Unassigned && found.confidence > 0.0 {
                    kinds[x] = if is_clipped { PixelKind::Restored } else { PixelKind::Highlight };
                }
            }
        }
    });
    Some(confidence)
}

/// The split of a pixel of the photograph.
struct PixelSplit {
    /// Body reflection, counts.
    body: [f32; 3],
    /// Surface reflection, counts.
    surface: [f32; 3],
    /// Confidence in the split, 0…1.
    confidence: f32,
}

/// What the local split found at a working pixel.
#[derive(Clone, Copy, Default)]
struct Cell {
    /// The amount of surface reflection; none far from usable pixels.
    line: Option<AmountLine>,
    /// Confidence in the split, 0…1.
    confidence: f32,
    /// Change of body reflection as a share of its length; none where the chromaticity was not sought.
    change: Option<[f32; 3]>,
}

/// What the working picture tells of the pixels of the photograph.
struct ByWorkingPicture<'a> {
    working: &'a LocalWorkingSplit<'a>,
    local: &'a LocalSplit,
    /// What was found at each working pixel.
    cells: Raster<Cell>,
    /// The working pixels that have surface reflection for some color, or are next to one: no pixel in the block of another has any.
    near_amount: Mask,
    /// Value from which on each band is clipped, counts above the ambient light.
    thresholds: [f32; 3],
}

impl<'a> ByWorkingPicture<'a> {
    fn new(detail: &Detail, working: &'a LocalWorkingSplit<'a>, local: &'a LocalSplit) -> Self {
        let LocalSplit { lines, confidence, chromaticity, .. } = local;
        let (width, height) = (working.body.width(), working.body.height());
        let mut cells = Raster::filled(width, height, Cell::default());
        cells.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
            for (x, cell) in row.iter_mut().enumerate() {
                let pixel = y * width + x;
                *cell = Cell {
                    line: lines.roi.index(pixel).and_then(|index| lines.line(index)),
                    confidence: confidence[pixel],
                    change: chromaticity.at(pixel),
                };
            }
        });
        let has_amount = cells.par_map(|cell| cell.line.is_some_and(|line| !line.is_none()));
        let near_amount = dilate(&has_amount, 1);
        let thresholds = detail.input.clip_thresholds(&working.origin);
        Self { working, local, cells, near_amount, thresholds }
    }

    /// The split of a pixel whose only clipped band is restored by the hue of the nearest working pixels; none where the band cannot be
    /// restored, or there is no surface reflection.
    fn restored(&self, color: [f32; 3], working_pixel: usize, nearest: &Nearest) -> Option<PixelSplit> {
        let hues = self.local.hues.as_ref()?;
        let band = only_clipped_band(color, &self.thresholds)?;
        let hue = nearest.mean(|pixel| hues.at(pixel))?;
        let mut whole = color;
        whole[band] = by_hue(color, band, hue, self.local.lamps.of(working_pixel))?;
        self.split(whole, color, working_pixel, nearest)
    }

    /// The split of a pixel in the block of `working_pixel` by the lines of the nearest working pixels; none where there is no
    /// surface reflection. `color`: with a restored band, else that of the file, which is the `limit` of body reflection.
    fn split(
        &self,
        color: [f32; 3],
        limit: [f32; 3],
        working_pixel: usize,
        nearest: &Nearest,
    ) -> Option<PixelSplit> {
        let lamp = self.local.lamps.of(working_pixel);
        let [amount, confidence] = self.amount(color, lamp, nearest)?;
        let moved = Moved::new(color, amount, &lamp.per_amount);
        let mut body = moved.body_below(limit);
        if let Some(change) = nearest.mean(|pixel| self.cells[pixel].change) {
            body = changed(body, change, limit);
        }
        Some(PixelSplit { body, surface: moved.surface, confidence })
    }

    /// The amount of surface reflection of a color under a lamp by the lines of the nearest working pixels, counts of J, and the confidence in
    /// it; none where there is no surface reflection.
    fn amount(&self, color: [f32; 3], lamp: &Lamp, nearest: &Nearest) -> Option<[f32; 2]> {
        let a = lamp.gain.mean(color);
        let found = |cell: &Cell| Some([cell.line?.amount(a), cell.confidence]);
        nearest.mean(|pixel| found(&self.cells[pixel])).filter(|[amount, _]| *amount > 0.0)
    }

    /// The split of a clipped pixel that is neither restored nor filled, by the surface reflection around it: a guess without confidence.
    /// None where there is no surface reflection.
    fn like_around(&self, color: [f32; 3], working_pixel: usize, nearest: &Nearest) -> Option<PixelSplit> {
        let lamp = self.local.lamps.of(working_pixel);
        let [amount, _] = self.amount(color, lamp, nearest)?;
        let Moved { surface, body } = Moved::of_clipped(color, amount, lamp);
        Some(PixelSplit { body, surface, confidence: 0.0 })
    }

    /// The split of a clipped pixel by the body reflection with which the working picture was filled; none where it was not filled.
    fn filled(&self, color: [f32; 3], nearest: &Nearest) -> Option<PixelSplit> {
        let is_filled = |pixel: usize| self.local.filled.as_slice().get(pixel) == Some(&true);
        let LocalWorkingSplit { body, origin, .. } = self.working;
        let body = |pixel: usize| std::array::from_fn(|band| body[pixel][band] - origin[band] as f32);
        let fill: [f32; 3] = nearest.mean(|pixel| is_filled(pixel).then(|| body(pixel)))?;
        let body: [f32; 3] = std::array::from_fn(|band| fill[band].clamp(0.0, color[band].max(0.0)));
        let surface = std::array::from_fn(|band| color[band] - body[band]);
        Some(PixelSplit { body, surface, confidence: CONFIDENCE })
    }
}

/// The two blocks of `side` pixels, of `count`, that are nearest to column or row `at` of the photograph, each with its weight.
fn nearest_of(at: usize, side: usize, count: usize) -> [(usize, f32); 2] {
    linear_weights((at as f32 + 0.5) / side as f32, count)
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
    /// The working pixels in the two nearest columns and rows, each with its weight, of a working picture of `width` columns.
    fn new([left, right]: [(usize, f32); 2], [top, bottom]: [(usize, f32); 2], width: usize) -> Self {
        let share = |column: (usize, f32), row: (usize, f32)| Share {
            working_pixel: row.0 * width + column.0,
            weight: row.1 * column.1,
        };
        Self { shares: [share(left, top), share(right, top), share(left, bottom), share(right, bottom)] }
    }

    /// The weighted mean of the values of the four working pixels that have a value; `None` if none of the four has one.
    fn mean<const N: usize>(&self, value: impl Fn(usize) -> Option<[f32; N]>) -> Option<[f32; N]> {
        let (mut sum, mut total) = ([0.0f32; N], 0.0f32);
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
    use crate::raster::Blocks;

    #[test]
    fn a_pixel_between_working_pixels_takes_from_both() {
        let blocks = Blocks::new(2, 8, 4);
        let value = |place: usize| Some([place as f32; 3]);
        let nearest = |x: usize, y: usize| {
            let columns = nearest_of(x, blocks.side(), blocks.columns());
            Nearest::new(columns, nearest_of(y, blocks.side(), blocks.rows()), blocks.columns())
        };
        let mean = |x, y| nearest(x, y).mean(value).unwrap()[0];
        assert!((mean(0, 0) - 0.0).abs() < 1e-6, "the picture's corner");
        assert!((mean(1, 0) - 0.25).abs() < 1e-6 && (mean(2, 0) - 0.75).abs() < 1e-6);
        assert!((mean(0, 2) - 3.0).abs() < 1e-6 && (mean(7, 3) - 7.0).abs() < 1e-6);
        let only = nearest(1, 0).mean(|place| (place == 1).then_some([9.0; 3]));
        assert_eq!(only, Some([9.0; 3]), "working pixels without a value do not count");
        assert_eq!(nearest(1, 0).mean(|_| None::<[f32; 1]>), None);
    }
}
