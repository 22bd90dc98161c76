//! A rectangle of a picture, for operations on a part of the picture.

use super::grid::Raster;

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

    /// A raster of the rectangle's size whose values are `of` the pixels' indices in the picture.
    pub fn raster<T: Default>(&self, of: impl Fn(usize) -> T) -> Raster<T> {
        let rows = (0..self.height).map(|row| self.at(0, row));
        let data = rows.flat_map(|first| first..first + self.width).map(of).collect();
        // The lengths agree by construction.
        Raster::from_vec(self.width, self.height, data).unwrap_or_default()
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
        assert_eq!(Roi::around((0, 0), 3, |_| true), None);
        assert_eq!(tight.raster(|pixel| pixel).as_slice()[5..7], [17, 22]);
    }
}
