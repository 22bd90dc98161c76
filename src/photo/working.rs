//! The working picture: a large photograph, averaged over square blocks of pixels (no counterpart in the paper).
//!
//! Windows, areas and light are found in the working picture, because a window of ten pixels in a photograph of 12 megapixels
//! contains little but noise and the errors of a lossy file. A working pixel is the mean of the linear light of the
//! pixels of a block that have a value and lie inside of the analyzed area. In a band that is clipped in any of these pixels,
//! the working pixel has their largest value: the mean of clipped and unclipped values is too small, and would not be
//! recognized as clipped.

use super::{ClippedArea, ClippedAreaVerdict, LinearImage, MaskLimits, Masks};
use crate::raster::{Blocks, Raster};
use rayon::prelude::*;
use std::sync::Arc;

/// A photograph averaged over blocks, and its masks. With blocks of one pixel it is the photograph itself.
#[derive(Clone, Debug)]
pub struct WorkingPicture {
    /// The blocks of the photograph; the working picture has a pixel for each.
    pub blocks: Blocks,
    /// The means of the blocks, linear counts.
    pub image: Arc<LinearImage>,
    /// The marks of the working pixels.
    pub masks: Arc<Masks>,
}

impl WorkingPicture {
    /// The working picture of a photograph with `masks` that were made from `limits`; its pixels are blocks of `factor` pixels.
    pub fn new(image: &Arc<LinearImage>, masks: &Arc<Masks>, limits: &MaskLimits, factor: usize) -> Self {
        let blocks = Blocks::new(factor, image.width(), image.height());
        if blocks.side() == 1 {
            return Self { blocks, image: Arc::clone(image), masks: Arc::clone(masks) };
        }
        let means = means(image, masks, limits, &blocks);
        let masks = Masks::of_blocks(masks, &means, limits, &blocks);
        Self { blocks, image: Arc::new(means), masks: Arc::new(masks) }
    }

    /// The same working picture with the dark pixels under other `limits`, which differ in the minimal intensity alone. `masks`: those of the
    /// photograph under the same limits.
    #[must_use]
    pub fn with_dark_pixels(self, masks: &Arc<Masks>, limits: &MaskLimits) -> Self {
        let masks = if self.blocks.side() == 1 {
            Arc::clone(masks)
        } else {
            Arc::new(Arc::unwrap_or_clone(self.masks).with_dark_pixels(&self.image, limits))
        };
        Self { masks, ..self }
    }

    /// The same working picture, and the `masks` of the photograph, with the pixels of those of its clipped `areas` marked that are objects.
    #[must_use]
    pub fn with_objects(self, masks: Arc<Masks>, areas: &[ClippedArea]) -> (Arc<Masks>, Self) {
        let objects = areas.iter().filter(|area| area.verdict == ClippedAreaVerdict::Object);
        let working_pixels = || objects.clone().flat_map(|object| object.pixels.iter().copied());
        if self.blocks.side() == 1 {
            // The masks of the working picture are those of the photograph; only one of the two remains, so that none is copied.
            drop(self.masks);
            let masks = Arc::new(Arc::unwrap_or_clone(masks).with_objects(working_pixels()));
            return (Arc::clone(&masks), Self { masks, ..self });
        }
        let pixels = working_pixels().flat_map(|working_pixel| self.blocks.members(working_pixel));
        let masks = Arc::new(Arc::unwrap_or_clone(masks).with_objects(pixels));
        let working = Arc::new(Arc::unwrap_or_clone(self.masks).with_objects(working_pixels()));
        (masks, Self { masks: working, ..self })
    }
}

/// The mean of each block. A block without a usable value is black and invalid.
fn means(image: &LinearImage, masks: &Masks, limits: &MaskLimits, blocks: &Blocks) -> LinearImage {
    let (width, columns) = (image.width(), blocks.columns());
    let mut pixels = Raster::filled(columns, blocks.rows(), [0.0f32; 3]);
    let mut invalid = Raster::filled(columns, blocks.rows(), false);
    let rows = pixels.as_mut_slice().par_chunks_mut(columns.max(1));
    rows.zip(invalid.as_mut_slice().par_chunks_mut(columns.max(1))).enumerate().for_each(
        |(row, (means, invalid))| {
            let mut sums = vec![Members::default(); columns];
            for y in blocks.pixel_rows(row) {
                let colors = image.pixels.row(y);
                for (column, members) in sums.iter_mut().enumerate() {
                    for x in blocks.pixel_columns(column) {
                        if masks.has_value(y * width + x) {
                            members.add(colors[x]);
                        }
                    }
                }
            }
            for (members, (mean, invalid)) in sums.into_iter().zip(means.iter_mut().zip(invalid)) {
                *invalid = members.count == 0;
                *mean = members.mean(limits.clip_threshold as f32);
            }
        },
    );
    LinearImage { pixels, invalid, saturation: image.saturation, coding: None, contrast: image.contrast }
}

/// The usable pixels of one block.
#[derive(Clone, Copy, Default)]
struct Members {
    /// Sum of the colors, counts.
    sum: [f32; 3],
    /// Largest value of each band, counts.
    largest: [f32; 3],
    /// Number of the pixels.
    count: usize,
}

impl Members {
    #[inline]
    fn add(&mut self, color: [f32; 3]) {
        for (band, value) in color.into_iter().enumerate() {
            self.sum[band] += value;
            self.largest[band] = self.largest[band].max(value);
        }
        self.count += 1;
    }

    /// The mean; of a band with a clipped value, the largest value.
    fn mean(&self, clip_threshold: f32) -> [f32; 3] {
        let count = self.count.max(1) as f32;
        std::array::from_fn(|band| {
            if self.largest[band] >= clip_threshold { self.largest[band] } else { self.sum[band] / count }
        })
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;
    use crate::raster::Mask;

    const LIMITS: MaskLimits = MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density: 1 };

    /// The working picture of gray values, `width` to a row, of which `area` are analyzed.
    fn working(values: &[f32], width: usize, factor: usize, area: Option<&Mask>) -> WorkingPicture {
        let data = values.iter().map(|&v| [v, v / 2.0, v / 4.0]).collect();
        let pixels = Raster::from_vec(width, values.len() / width, data).unwrap();
        let image = Arc::new(LinearImage::new(pixels, Some(255.0)));
        let masks = Masks::new(&image, &LIMITS);
        let masks = area.map_or_else(|| masks.clone(), |area| masks.clone().within(area));
        WorkingPicture::new(&image, &Arc::new(masks), &LIMITS, factor)
    }

    #[test]
    fn working_pixels_are_means_of_whole_and_of_cut_off_blocks() {
        let picture = working(&[10.0, 30.0, 50.0, 50.0, 70.0, 90.0, 20.0, 40.0, 60.0], 3, 2, None);
        assert_eq!((picture.image.width(), picture.image.height()), (2, 2));
        let red: Vec<f32> = picture.image.pixels.as_slice().iter().map(|color| color[0]).collect();
        assert_eq!(red, [40.0, 70.0, 30.0, 60.0]);
        assert_eq!(picture.image.pixels[0], [40.0, 20.0, 10.0]);
    }

    #[test]
    fn a_band_that_is_clipped_in_one_pixel_is_clipped_in_the_working_pixel() {
        let picture = working(&[100.0, 250.0, 60.0, 60.0], 2, 2, None);
        assert_eq!(picture.image.pixels[0], [250.0, 58.75, 29.375], "only the red band is clipped");
        assert!(picture.masks.clipped(0));
        // The clipped pixel's neighbors are bloomed, also those in the next block.
        let picture = working(&[60.0, 250.0, 60.0, 60.0, 60.0, 60.0], 6, 2, None);
        assert!(picture.masks.clipped(0) && picture.masks.distorted(1) && !picture.masks.clipped(1));
        assert!(picture.masks.usable(2));
    }

    #[test]
    fn pixels_without_a_value_and_outside_of_the_area_do_not_count() {
        let bad = f32::NAN;
        let picture = working(&[bad, 80.0, bad, bad, bad, 40.0, bad, bad], 4, 2, None);
        assert_eq!(picture.image.pixels[0][0], 60.0);
        assert!(picture.masks.usable(0) && picture.masks.invalid(1));
        let area = Mask::from_vec(4, 1, vec![false, true, false, false]).unwrap();
        let picture = working(&[250.0, 80.0, 90.0, 90.0], 4, 2, Some(&area));
        assert_eq!(picture.image.pixels[0][0], 80.0);
        assert!(picture.masks.distorted(0), "a clipped pixel outside of the area blooms into the area");
        assert!(!picture.masks.clipped(0) && !picture.masks.outside(0) && picture.masks.outside(1));
        assert!(!picture.masks.invalid(1), "a block outside of the area is outside, not invalid");
    }

    #[test]
    fn a_block_is_dark_where_its_mean_is_dark() {
        let picture = working(&[2.0, 60.0, 2.0, 24.0], 4, 2, None);
        assert!(!picture.masks.dark(0) && picture.masks.dark(1));
    }

    #[test]
    fn dark_pixels_under_another_limit_are_those_of_a_new_working_picture() {
        let colors = [10.0, 30.0, 250.0, 50.0, 20.0, 20.0, 60.0, 80.0].map(|v| [v, v / 2.0, v / 4.0]);
        let pixels = Raster::from_vec(4, 2, colors.to_vec()).unwrap();
        let image = Arc::new(LinearImage::new(pixels, Some(255.0)));
        let darker = MaskLimits { min_intensity: 40.0, ..LIMITS };
        let [before, after] = [LIMITS, darker].map(|limits| Arc::new(Masks::new(&image, &limits)));
        for factor in [1, 2] {
            let made = WorkingPicture::new(&image, &after, &darker, factor);
            let changed =
                WorkingPicture::new(&image, &before, &LIMITS, factor).with_dark_pixels(&after, &darker);
            assert_eq!((changed.masks, changed.image), (made.masks, made.image), "{factor}");
        }
    }

    #[test]
    fn objects_are_marked_in_the_working_picture_and_in_the_photograph() {
        let pixels = Raster::filled(4, 2, [60.0; 3]);
        let image = Arc::new(LinearImage::new(pixels, Some(255.0)));
        let area = |verdict| ClippedArea { pixels: vec![1], clipped: 1, left: 0.0, most_left: 0.2, verdict };
        for (factor, marked) in [(2, vec![2, 3, 6, 7]), (1, vec![1])] {
            let masks = Arc::new(Masks::new(&image, &LIMITS));
            let working = WorkingPicture::new(&image, &masks, &LIMITS, factor);
            let few = working.clone().with_objects(Arc::clone(&masks), &[area(ClippedAreaVerdict::Few)]);
            assert_eq!(few.0, masks, "areas that are no objects are not marked");
            let (masks, working) = working.with_objects(masks, &[area(ClippedAreaVerdict::Object)]);
            let of = |masks: &Masks, count: usize| -> Vec<usize> {
                (0..count).filter(|&pixel| masks.in_clipped_object(pixel)).collect()
            };
            assert_eq!(of(&masks, 8), marked);
            assert_eq!(of(&working.masks, working.blocks.columns() * working.blocks.rows()), [1]);
            let finer = Masks::of_blocks(&masks, &working.image, &LIMITS, &working.blocks);
            assert!(factor == 1 || finer.in_clipped_object(1));
        }
    }

    #[test]
    fn blocks_of_one_pixel_are_the_photograph() {
        let picture = working(&[10.0, 250.0, 60.0], 3, 1, None);
        assert_eq!(picture.image.pixels[1][0], 250.0);
        assert_eq!(picture.blocks.columns(), 3);
        assert!(picture.masks.dark(0) && picture.masks.clipped(1) && picture.masks.distorted(2));
    }
}
