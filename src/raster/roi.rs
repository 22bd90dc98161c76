//! A rectangle of a picture, for operations on a part of the picture.

use super::blocks::Blocks;
use super::grid::Raster;
use rayon::prelude::*;

/// A rectangular region of interest of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Roi {
    /// First column in the picture.
    pub left: usize,
    /// First row in the picture.
    pub top: usize,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Number of columns of the picture.
    picture_width: usize,
}

impl Roi {
    /// The smallest rectangle that contains every pixel for which `wanted` is true, extended by `margin_px` on each side and
    /// cut at the border of the picture of `width × height` pixels; `None` where there is no such pixel.
    pub fn around(
        (width, height): (usize, usize),
        margin_px: usize,
        wanted: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let row_wanted = |y: usize| (y * width..(y + 1) * width).any(&wanted);
        let top = (0..height).find(|&y| row_wanted(y))?;
        let bottom = (top..height).rev().find(|&y| row_wanted(y))?;
        let (mut left, mut right) = (width, 0);
        for y in top..=bottom {
            let at = |x: usize| wanted(y * width + x);
            left = (0..left).find(|&x| at(x)).unwrap_or(left);
            right = (right..width).rev().find(|&x| at(x)).unwrap_or(right);
        }
        let (left, top) = (left.saturating_sub(margin_px), top.saturating_sub(margin_px));
        let (right, bottom) = ((right + 1 + margin_px).min(width), (bottom + 1 + margin_px).min(height));
        Some(Self { left, top, width: right - left, height: bottom - top, picture_width: width })
    }

    /// The pixels whose column and row differ from those of pixel `[x, y]` by at most `margin_px`, in a picture of `width × height`
    /// pixels.
    pub fn around_pixel((width, height): (usize, usize), margin_px: usize, [x, y]: [usize; 2]) -> Self {
        let (left, top) = (x.saturating_sub(margin_px), y.saturating_sub(margin_px));
        let (right, bottom) = ((x + 1 + margin_px).min(width), (y + 1 + margin_px).min(height));
        Self { left, top, width: right - left, height: bottom - top, picture_width: width }
    }

    /// The smallest rectangle that contains `pixels`, extended like [`Self::around`]; `None` without a pixel.
    pub fn around_pixels(
        size: (usize, usize),
        margin_px: usize,
        pixels: impl IntoIterator<Item = usize>,
    ) -> Option<Self> {
        let boxes = pixels
            .into_iter()
            .map(|pixel| Self::around_pixel(size, margin_px, [pixel % size.0.max(1), pixel / size.0.max(1)]));
        boxes.reduce(|all, one| all.joined(&one))
    }

    /// The rectangle of the pixels in the blocks of `self`, which is a rectangle of blocks.
    pub fn of_pixels(&self, blocks: &Blocks) -> Self {
        let side = blocks.side();
        let [picture_width, picture_height] = blocks.picture();
        let (left, top) = (self.left * side, self.top * side);
        let right = ((self.left + self.width) * side).min(picture_width);
        let bottom = ((self.top + self.height) * side).min(picture_height);
        Self { left, top, width: right - left, height: bottom - top, picture_width }
    }

    /// The smallest rectangle that contains both.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        let (left, top) = (self.left.min(other.left), self.top.min(other.top));
        let right = (self.left + self.width).max(other.left + other.width);
        let bottom = (self.top + self.height).max(other.top + other.height);
        Self { left, top, width: right - left, height: bottom - top, ..*self }
    }

    /// Whether the rectangles have a pixel in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        let share = |start: usize, length: usize, other: usize, other_length: usize| {
            start < other + other_length && other < start + length
        };
        share(self.left, self.width, other.left, other.width)
            && share(self.top, self.height, other.top, other.height)
    }

    /// Number of pixels.
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Whether the rectangle has no pixel.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Index in the picture of the pixel at `column` and `row` of the rectangle.
    #[inline]
    pub fn at(&self, column: usize, row: usize) -> usize {
        (self.top + row) * self.picture_width + self.left + column
    }

    /// Index in the picture of pixel `index` of the rectangle.
    #[inline]
    pub fn pixel(&self, index: usize) -> usize {
        self.at(index % self.width.max(1), index / self.width.max(1))
    }

    /// Index in the rectangle of pixel `pixel` of the picture; `None` outside the rectangle.
    pub fn index(&self, pixel: usize) -> Option<usize> {
        let (x, y) = (pixel % self.picture_width.max(1), pixel / self.picture_width.max(1));
        let (column, row) = (x.checked_sub(self.left)?, y.checked_sub(self.top)?);
        (column < self.width && row < self.height).then_some(row * self.width + column)
    }

    /// Like [`Self::crop`], of a raster that nothing else needs: no copy where the rectangle is the picture.
    pub fn cropped<T: Copy + Default>(&self, of_picture: Raster<T>) -> Raster<T> {
        let is_whole = (of_picture.width(), of_picture.height()) == (self.width, self.height);
        if is_whole { of_picture } else { self.crop(&of_picture) }
    }

    /// The part of a raster of the picture's size that lies in the rectangle.
    pub fn crop<T: Copy + Default>(&self, of_picture: &Raster<T>) -> Raster<T> {
        let mut values = Vec::with_capacity(self.len());
        for row in 0..self.height {
            let first = self.at(0, row);
            values.extend_from_slice(&of_picture.as_slice()[first..first + self.width]);
        }
        // The lengths agree by construction.
        Raster::from_vec(self.width, self.height, values).unwrap_or_default()
    }

    /// A raster of the rectangle's size whose values are `of` the pixels' indices in the picture, computed in parallel.
    pub fn raster<T: Clone + Default + Send>(&self, of: impl Fn(usize) -> T + Sync) -> Raster<T> {
        self.raster_by_place(|column, row| of(self.at(column, row)))
    }

    /// A raster of the rectangle's size whose values are `of` the column and the row in the rectangle, computed in parallel.
    pub fn raster_by_place<T: Clone + Default + Send>(
        &self,
        of: impl Fn(usize, usize) -> T + Sync,
    ) -> Raster<T> {
        let mut raster = Raster::filled(self.width, self.height, T::default());
        let rows = raster.as_mut_slice().par_chunks_mut(self.width.max(1)).enumerate();
        rows.for_each(|(row, values)| {
            values.iter_mut().enumerate().for_each(|(column, value)| *value = of(column, row));
        });
        raster
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_contains_the_wanted_pixels_and_ends_at_the_border() {
        let wanted = |pixel: usize| pixel == 12 || pixel == 27;
        let tight = Roi::around((10, 5), 0, wanted).unwrap();
        assert_eq!((tight.left, tight.top, tight.width, tight.height), (2, 1, 6, 2));
        assert_eq!((tight.pixel(0), tight.pixel(11), tight.at(0, 1)), (12, 27, 22));
        assert_eq!(
            [11, 12, 27, 28, 33].map(|pixel| tight.index(pixel)),
            [None, Some(0), Some(11), None, None]
        );
        let grown = Roi::around((10, 5), 3, wanted).unwrap();
        assert_eq!((grown.left, grown.top, grown.width, grown.height), (0, 0, 10, 5));
        assert_eq!(Roi::around((10, 5), 3, |_| false), None);
        assert_eq!(Roi::around_pixels((10, 5), 0, [27, 12]), Some(tight));
        assert_eq!(Roi::around_pixels((10, 5), 3, [27, 12]), Some(grown));
        assert_eq!(Roi::around_pixels((10, 5), 3, []), None);
        assert_eq!(Roi::around((0, 0), 3, |_| true), None);
        assert_eq!(tight.raster(|pixel| pixel).as_slice()[5..7], [17, 22]);
        let picture = Raster::from_vec(10, 5, (0..50).collect()).unwrap();
        assert_eq!(tight.crop(&picture), tight.raster(|pixel| pixel));
        assert_eq!(tight.cropped(picture.clone()), tight.crop(&picture));
    }

    #[test]
    fn a_rectangle_of_blocks_contains_their_pixels_as_far_as_the_picture_goes() {
        let blocks = Blocks::new(3, 10, 8);
        let roi = Roi::around_pixel((4, 3), 1, [3, 2]);
        assert_eq!((roi.left, roi.top, roi.width, roi.height), (2, 1, 2, 2));
        let pixels = roi.of_pixels(&blocks);
        assert_eq!((pixels.left, pixels.top, pixels.width, pixels.height), (6, 3, 4, 5));
        assert_eq!(pixels.pixel(0), 36);
    }

    #[test]
    fn rectangles_overlap_where_they_have_a_pixel_in_common() {
        let at = |x: usize, y: usize| Roi::around_pixel((20, 20), 1, [x, y]);
        assert!(at(5, 5).overlaps(&at(7, 7)) && at(7, 7).overlaps(&at(5, 5)));
        assert!(!at(5, 5).overlaps(&at(8, 5)) && !at(5, 5).overlaps(&at(5, 8)));
        let joined = at(5, 5).joined(&at(9, 12));
        assert_eq!((joined.left, joined.top, joined.width, joined.height), (4, 4, 7, 10));
    }
}
