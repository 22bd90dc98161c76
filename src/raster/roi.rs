//! A rectangle of a picture, for work that concerns only a part of it.

use super::grid::Raster;

/// Columns and rows of a picture that are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Roi {
    /// First column and row.
    pub left: usize,
    /// First row.
    pub top: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Columns of the picture.
    picture_width: usize,
}

impl Roi {
    /// The smallest that holds every pixel of a picture `width` wide and `height` high for which `wanted` holds, grown by
    /// `margin_px`; none where there is no such pixel.
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

    /// Pixels in it.
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Whether it holds no pixel.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The picture's index of the pixel at `column` and `row` of the window.
    #[inline]
    pub fn at(&self, column: usize, row: usize) -> usize {
        (self.top + row) * self.picture_width + self.left + column
    }

    /// The picture's index of pixel `index` of the window.
    #[inline]
    pub fn pixel(&self, index: usize) -> usize {
        self.at(index % self.width.max(1), index / self.width.max(1))
    }

    /// The window's index of one of the picture's pixels; none outside.
    pub fn index(&self, pixel: usize) -> Option<usize> {
        let (x, y) = (pixel % self.picture_width.max(1), pixel / self.picture_width.max(1));
        let (column, row) = (x.checked_sub(self.left)?, y.checked_sub(self.top)?);
        (column < self.width && row < self.height).then_some(row * self.width + column)
    }

    /// A raster of its size, from the picture's indices.
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
    fn it_holds_what_is_wanted_and_ends_at_the_border() {
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
