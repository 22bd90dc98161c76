//! Marks the pixels that are not used (section 4): dark, clipped, bloomed and invalid pixels, and pixels outside an
//! area that the analysis is restricted to.

use super::LinearImage;
use crate::color::dot;
use crate::raster::{Blocks, Mask, Raster, Roi};
use rayon::prelude::*;

/// Thresholds of the masks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaskLimits {
    /// Radius of the sphere around black that contains the dark colors, counts.
    pub min_intensity: f64,
    /// A pixel with a band at or above this value is clipped, counts; infinite: no pixel is clipped.
    pub clip_threshold: f64,
    /// Number of clipped 8-neighbors from which on a pixel is bloomed.
    pub bloom_density: usize,
}

impl MaskLimits {
    /// Whether a color is dark: inside the sphere around black.
    #[inline]
    pub fn is_dark(&self, color: [f32; 3]) -> bool {
        dot(color, color) < (self.min_intensity * self.min_intensity) as f32
    }

    /// Whether a color is clipped: a band reaches the clip threshold.
    #[inline]
    pub fn is_clipped(&self, color: [f32; 3]) -> bool {
        color[0].max(color[1]).max(color[2]) >= self.clip_threshold as f32
    }

    /// Whether an unclipped pixel with this number of clipped 8-neighbors is bloomed.
    pub fn is_bloomed(&self, clipped_neighbors: usize) -> bool {
        clipped_neighbors > 0 && clipped_neighbors >= self.bloom_density
    }
}

/// The marks of each pixel: dark, clipped, bloomed, invalid, outside, clipped object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Masks {
    flags: Raster<u8>,
}

const DARK: u8 = 1;
const CLIPPED: u8 = 2;
const BLOOMED: u8 = 4;
const INVALID: u8 = 8;
const OUTSIDE: u8 = 16;
const OBJECT: u8 = 32;

impl Masks {
    /// Computes the masks of `image`.
    pub fn new(image: &LinearImage, limits: &MaskLimits) -> Self {
        let (width, height) = (image.width(), image.height());
        let mut flags = Raster::filled(width, height, 0u8);
        if flags.is_empty() {
            return Self { flags };
        }
        flags.as_mut_slice().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            let pixels = image.pixels.row(y).iter().zip(image.invalid.row(y));
            for (flag, (&color, &invalid)) in row.iter_mut().zip(pixels) {
                let (clipped, dark) = (limits.is_clipped(color), limits.is_dark(color));
                *flag =
                    (u8::from(dark) * DARK) | (u8::from(clipped) * CLIPPED) | (u8::from(invalid) * INVALID);
            }
        });
        let mut masks = Self { flags };
        masks.mark_bloomed(limits);
        masks
    }

    /// The marks of `image` under other `limits` that differ in the minimal intensity alone: only the dark pixels are found again.
    #[must_use]
    pub fn with_dark_pixels(mut self, image: &LinearImage, limits: &MaskLimits) -> Self {
        let width = image.width().max(1);
        self.flags.as_mut_slice().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (flag, &color) in row.iter_mut().zip(image.pixels.row(y)) {
                *flag = (*flag & !DARK) | (u8::from(limits.is_dark(color)) * DARK);
            }
        });
        self
    }

    /// Marks the bloomed pixels. Only the neighbors of clipped pixels are visited, because clipped pixels are few.
    fn mark_bloomed(&mut self, limits: &MaskLimits) {
        if !(1..=8).any(|neighbors| limits.is_bloomed(neighbors)) {
            return;
        }
        let clipped: Vec<usize> =
            (0..self.flags.len()).into_par_iter().filter(|&pixel| self.clipped(pixel)).collect();
        for pixel in clipped {
            for near in self.flags.around(pixel) {
                if !self.distorted(near) && limits.is_bloomed(self.clipped_neighbors(near)) {
                    self.flags[near] |= BLOOMED;
                }
            }
        }
    }

    /// Marks the pixels outside `area`, a mask of the image's size, as excluded from the analysis. Clipped pixels
    /// outside the area still make pixels inside bloomed.
    #[must_use]
    pub fn within(mut self, area: &Mask) -> Self {
        debug_assert_eq!(area.len(), self.flags.len(), "the caller checks the size of the area");
        for (flag, &inside) in self.flags.as_mut_slice().iter_mut().zip(area.as_slice()) {
            *flag |= u8::from(!inside) * OUTSIDE;
        }
        self
    }

    /// The masks of a working picture: `means` holds the mean of each of `blocks`, whose pixels have the masks `members`. A working
    /// pixel is clipped where its own value is, and distorted where any usable pixel of the block is. The pixel is dark where its
    /// mean is, invalid where no pixel inside of the area has a value, outside where no pixel is inside of the area, and that of a clipped
    /// object where any usable pixel is.
    pub(super) fn of_blocks(
        members: &Self,
        means: &LinearImage,
        limits: &MaskLimits,
        blocks: &Blocks,
    ) -> Self {
        let (width, columns) = (members.flags.width(), means.width());
        let mut flags = Raster::filled(columns, means.height(), 0u8);
        flags.as_mut_slice().par_chunks_mut(columns.max(1)).enumerate().for_each(|(row, flags)| {
            // Of each block: the marks of the usable pixels together, and the marks that all pixels have.
            let mut marks = vec![(0u8, u8::MAX); columns];
            for y in blocks.pixel_rows(row) {
                for (column, (any, all)) in marks.iter_mut().enumerate() {
                    for x in blocks.pixel_columns(column) {
                        let flag = members.flags[y * width + x];
                        *any |= if flag & (INVALID | OUTSIDE) == 0 { flag } else { 0 };
                        *all &= flag;
                    }
                }
            }
            let working = means.pixels.row(row).iter().zip(means.invalid.row(row));
            for ((flag, (any, all)), (&color, &empty)) in flags.iter_mut().zip(marks).zip(working) {
                let (clipped, dark) = (limits.is_clipped(color), limits.is_dark(color));
                let bloomed = !clipped && any & (CLIPPED | BLOOMED) != 0;
                let outside = all & OUTSIDE;
                *flag = (u8::from(dark) * DARK)
                    | (u8::from(clipped) * CLIPPED)
                    | (u8::from(bloomed) * BLOOMED)
                    | (u8::from(empty && outside == 0) * INVALID)
                    | (any & OBJECT)
                    | outside;
            }
        });
        Self { flags }
    }

    /// Marks `pixels` as those of clipped objects (rule `clipped_objects`).
    #[must_use]
    pub fn with_objects(mut self, pixels: impl Iterator<Item = usize>) -> Self {
        pixels.for_each(|pixel| self.flags[pixel] |= OBJECT);
        self
    }

    /// The marks of the pixels in a rectangle.
    #[must_use]
    pub(crate) fn cropped(&self, roi: &Roi) -> Self {
        Self { flags: roi.crop(&self.flags) }
    }

    /// The same marks with `pixels` marked as neither clipped nor bloomed, because their clipped bands were restored.
    #[must_use]
    pub fn with_restored(&self, pixels: impl Iterator<Item = usize>) -> Self {
        let mut flags = self.flags.clone();
        pixels.for_each(|pixel| flags[pixel] &= !(CLIPPED | BLOOMED));
        Self { flags }
    }

    /// Calls `visit` with the 4-neighbors of a pixel, in the order up, left, right, down.
    #[inline]
    pub fn for_each_neighbor(&self, pixel: usize, visit: impl FnMut(usize)) {
        self.flags.for_each_neighbor(pixel, visit);
    }

    /// Number of columns and rows.
    pub fn shape(&self) -> (usize, usize) {
        (self.flags.width(), self.flags.height())
    }

    /// Whether the color of the pixel is used: the pixel has no mark at all.
    #[inline]
    pub fn usable(&self, pixel: usize) -> bool {
        self.flags[pixel] == 0
    }

    /// Whether the pixel is excluded from the analysis: dark, invalid, outside the area, or of a clipped object. All other pixels are
    /// called lit.
    #[inline]
    pub fn dark(&self, pixel: usize) -> bool {
        self.flags[pixel] & (DARK | INVALID | OUTSIDE | OBJECT) != 0
    }

    /// Whether the pixel lies outside the area that the analysis is restricted to.
    #[inline]
    pub fn outside(&self, pixel: usize) -> bool {
        self.flags[pixel] & OUTSIDE != 0
    }

    /// Whether the pixel is that of a clipped object or of the edge of one (rule `clipped_objects`).
    #[inline]
    pub fn in_clipped_object(&self, pixel: usize) -> bool {
        self.flags[pixel] & OBJECT != 0
    }

    /// Whether one of the 8 neighbors of the pixel lies outside the area. The border of the picture is no edge of the area.
    pub fn is_at_area_edge(&self, pixel: usize) -> bool {
        self.flags.around(pixel).any(|near| self.outside(near))
    }

    /// Whether the pixel has a value and lies inside of the area.
    #[inline]
    pub fn has_value(&self, pixel: usize) -> bool {
        self.flags[pixel] & (INVALID | OUTSIDE) == 0
    }

    /// Whether a band of the pixel is clipped.
    #[inline]
    pub fn clipped(&self, pixel: usize) -> bool {
        self.flags[pixel] & CLIPPED != 0
    }

    /// Number of clipped pixels among the 8 neighbors of the pixel.
    pub fn clipped_neighbors(&self, pixel: usize) -> usize {
        self.flags.around(pixel).filter(|&near| near != pixel && self.clipped(near)).count()
    }

    /// Whether a region may claim the pixel by its color: the pixel is lit and, if `distorted_wait`, neither clipped nor
    /// bloomed (distorted pixels then wait for the clipping stage).
    #[inline]
    pub fn claimable_by_color(&self, pixel: usize, distorted_wait: bool) -> bool {
        if distorted_wait { self.usable(pixel) } else { !self.dark(pixel) }
    }

    /// Whether a region may claim the pixel by its brightness (section 5.5): the pixel is lit.
    #[inline]
    pub fn claimable_by_brightness(&self, pixel: usize) -> bool {
        !self.dark(pixel)
    }

    /// Whether the pixel is clipped or bloomed.
    #[inline]
    pub fn distorted(&self, pixel: usize) -> bool {
        self.flags[pixel] & (CLIPPED | BLOOMED) != 0
    }

    /// Whether the file held a non-finite or negative value at the pixel.
    #[inline]
    pub fn invalid(&self, pixel: usize) -> bool {
        self.flags[pixel] & INVALID != 0
    }

    /// A mask that is true at the pixels for which `test`, one of the methods above, returns true.
    pub fn mask(&self, test: impl Fn(&Self, usize) -> bool + Sync) -> Mask {
        let data = (0..self.flags.len()).into_par_iter().map(|pixel| test(self, pixel)).collect();
        Raster::from_vec(self.flags.width(), self.flags.height(), data).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(values: &[f32], width: usize) -> LinearImage {
        let pixels = values.iter().map(|&v| [v; 3]).collect();
        LinearImage::new(Raster::from_vec(width, values.len() / width, pixels).unwrap(), Some(255.0))
    }

    fn limits(bloom_density: usize) -> MaskLimits {
        MaskLimits { min_intensity: 23.0, clip_threshold: 240.0, bloom_density }
    }

    #[test]
    fn dark_is_a_sphere_around_black() {
        let masks = Masks::new(&image(&[13.0, 14.0, f32::NAN], 3), &limits(1));
        assert_eq!([0, 1, 2].map(|i| masks.dark(i)), [true, false, true]);
        assert!(masks.invalid(2) && !masks.usable(2));
    }

    #[test]
    fn dark_pixels_under_another_limit_are_those_of_new_masks() {
        let image = image(&[10.0, 20.0, 250.0, 60.0, f32::NAN, 30.0], 3);
        let darker = MaskLimits { min_intensity: 40.0, ..limits(1) };
        let masks = Masks::new(&image, &limits(1));
        assert_ne!(masks, Masks::new(&image, &darker));
        assert_eq!(masks.with_dark_pixels(&image, &darker), Masks::new(&image, &darker));
    }

    #[test]
    fn outside_the_area_nothing_is_lit_but_clipped_pixels_bloom_into_it() {
        let area = Mask::from_vec(4, 1, vec![false, true, true, true]).unwrap();
        let masks = Masks::new(&image(&[255.0, 99.0, 99.0, 5.0], 4), &limits(1)).within(&area);
        assert_eq!([0, 1, 2, 3].map(|i| masks.outside(i)), [true, false, false, false]);
        assert_eq!([0, 1, 2, 3].map(|i| masks.dark(i)), [true, false, false, true]);
        assert_eq!([0, 1, 2, 3].map(|i| masks.usable(i)), [false, false, true, false]);
        assert!(masks.clipped(0) && masks.distorted(1));
    }

    #[test]
    fn bloomed_pixels_have_enough_clipped_neighbors() {
        let picture = image(&[99.0, 255.0, 99.0, 99.0, 99.0, 255.0, 99.0, 99.0], 4);
        let row = |masks: &Masks| -> Vec<bool> {
            (0..8).map(|i| masks.distorted(i) && !masks.clipped(i)).collect()
        };
        let all = [true, false, true, false, true, false, true, false];
        assert_eq!(row(&Masks::new(&picture, &limits(1))), all);
        assert_eq!(row(&Masks::new(&picture, &limits(2))), all);
        assert_eq!(row(&Masks::new(&picture, &limits(3))), [false; 8]);
        assert_eq!(row(&Masks::new(&picture, &limits(9))), [false; 8]);
    }

    #[test]
    fn pixels_of_clipped_objects_are_excluded_under_every_minimal_intensity() {
        let picture = image(&[99.0, 255.0, 99.0], 3);
        let masks = Masks::new(&picture, &limits(9)).with_objects([1, 2].into_iter());
        assert_eq!([0, 1, 2].map(|i| masks.dark(i)), [false, true, true]);
        assert_eq!([0, 1, 2].map(|i| masks.in_clipped_object(i)), [false, true, true]);
        assert!(masks.clipped(1) && masks.has_value(1));
        let brighter = masks.with_dark_pixels(&picture, &limits(9));
        assert!(brighter.in_clipped_object(2) && brighter.dark(2) && brighter.usable(0));
    }

    #[test]
    fn an_infinite_threshold_clips_nothing_and_no_picture_is_no_problem() {
        let open = MaskLimits { clip_threshold: f64::INFINITY, ..limits(1) };
        assert!(!Masks::new(&image(&[9e9], 1), &open).clipped(0));
        let nothing = LinearImage::new(Raster::filled(0, 0, [0.0; 3]), None);
        assert_eq!(Masks::new(&nothing, &limits(1)).mask(Masks::dark).len(), 0);
    }
}
