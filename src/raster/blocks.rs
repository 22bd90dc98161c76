//! A picture divided into square blocks of pixels, and the smaller picture that has a pixel for each block.

use super::grid::Raster;
use rayon::prelude::*;
use std::ops::Range;

/// Square blocks of pixels that cover a picture. The blocks at the right and at the lower edge may be cut off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blocks {
    /// Side of a block, pixels; at least 1.
    side: usize,
    /// Columns and rows of the picture, pixels.
    picture: [usize; 2],
}

impl Default for Blocks {
    fn default() -> Self {
        Self::new(1, 0, 0)
    }
}

impl Blocks {
    /// The blocks of `side` pixels (0 counts as 1) that cover a picture of `width × height` pixels.
    pub fn new(side: usize, width: usize, height: usize) -> Self {
        Self { side: side.max(1), picture: [width, height] }
    }

    /// Side of a block, pixels.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Number of blocks in a row.
    pub fn columns(&self) -> usize {
        self.picture[0].div_ceil(self.side)
    }

    /// Number of rows of blocks.
    pub fn rows(&self) -> usize {
        self.picture[1].div_ceil(self.side)
    }

    /// Columns and rows of the picture, pixels.
    pub fn picture(&self) -> [usize; 2] {
        self.picture
    }

    /// The block that contains a pixel of the picture, both as row-major indices.
    #[inline]
    pub fn block_of(&self, pixel: usize) -> usize {
        if self.side == 1 {
            return pixel;
        }
        let width = self.picture[0].max(1);
        (pixel / width / self.side) * self.columns() + pixel % width / self.side
    }

    /// Columns of the picture that the blocks of a column contain.
    #[inline]
    pub fn pixel_columns(&self, column: usize) -> Range<usize> {
        column * self.side..((column + 1) * self.side).min(self.picture[0])
    }

    /// Rows of the picture that the blocks of a row contain.
    #[inline]
    pub fn pixel_rows(&self, row: usize) -> Range<usize> {
        row * self.side..((row + 1) * self.side).min(self.picture[1])
    }

    /// The pixels of a block, row-major indices of the picture, ascending.
    pub fn members(&self, block: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, columns) = (self.picture[0], self.columns().max(1));
        let across = self.pixel_columns(block % columns);
        self.pixel_rows(block / columns).flat_map(move |y| across.clone().map(move |x| y * width + x))
    }

    /// The pixel in the middle of a block, a row-major index of the picture.
    pub fn middle(&self, block: usize) -> usize {
        if self.side == 1 {
            return block;
        }
        let columns = self.columns().max(1);
        let (x, y) = (self.pixel_columns(block % columns), self.pixel_rows(block / columns));
        usize::midpoint(y.start, y.end.saturating_sub(1)) * self.picture[0]
            + usize::midpoint(x.start, x.end.saturating_sub(1))
    }

    /// A raster of the picture's size in which every pixel has the value of its block. `of_blocks` has a value for each block.
    pub fn enlarged<T: Copy + Default + Send + Sync>(&self, of_blocks: &Raster<T>) -> Raster<T> {
        let [width, height] = self.picture;
        let mut enlarged = Raster::filled(width, height, T::default());
        let rows = enlarged.as_mut_slice().par_chunks_mut(width.max(1)).enumerate();
        rows.with_min_len(16).for_each(|(y, row)| {
            let values = of_blocks.row(y / self.side);
            row.chunks_mut(self.side).zip(values).for_each(|(pixels, &value)| pixels.fill(value));
        });
        enlarged
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_cover_every_pixel_once_and_are_cut_off_at_the_edges() {
        for (side, width, height) in [(1, 4, 3), (2, 5, 3), (3, 7, 8), (4, 3, 2), (3, 0, 0)] {
            let blocks = Blocks::new(side, width, height);
            let mut seen = vec![0; width * height];
            for block in 0..blocks.columns() * blocks.rows() {
                assert!(blocks.members(block).any(|pixel| pixel == blocks.middle(block)));
                for pixel in blocks.members(block) {
                    assert_eq!(blocks.block_of(pixel), block, "{side}: {pixel}");
                    seen[pixel] += 1;
                }
            }
            assert!(seen.iter().all(|&times| times == 1), "{side}");
        }
        assert_eq!(Blocks::new(0, 4, 4).side(), 1, "no block is empty");
    }

    #[test]
    fn an_enlarged_raster_repeats_the_value_of_each_block() {
        let of_blocks = Raster::from_vec(2, 2, vec![1, 2, 3, 4]).unwrap();
        let enlarged = Blocks::new(2, 3, 3).enlarged(&of_blocks);
        assert_eq!(enlarged.as_slice(), [1, 1, 2, 1, 1, 2, 3, 3, 4]);
    }
}
