//! Rectangles that cover the pixels of a mask.

use super::components::{ComponentSearch, Connectivity};
use super::grid::{Mask, Raster};
use super::roi::Roi;

/// Side of a cell, pixels. Pixels in neighboring cells lie in one rectangle.
const CELL_PX: usize = 16;

/// Rectangles without a common pixel that contain every true pixel of the mask and `margin_px` around, cut at the border of the
/// picture, by their first rows. True pixels that are far from each other mostly lie in different rectangles.
pub fn disjoint_rectangles(mask: &Mask, margin_px: usize) -> Vec<Roi> {
    let (width, height) = (mask.width(), mask.height());
    let groups = Groups::of(mask);
    let mut rectangles: Vec<Option<Roi>> = vec![None; groups.count];
    for y in 0..height {
        for (x, _) in mask.row(y).iter().enumerate().filter(|(_, is_true)| **is_true) {
            let around = Roi::around_pixel((width, height), margin_px, [x, y]);
            let rectangle = &mut rectangles[groups.of_cells[groups.cell_of(x, y)]];
            *rectangle = Some(rectangle.map_or(around, |rectangle| rectangle.joined(&around)));
        }
    }
    let mut rectangles = joined_where_overlapping(rectangles.into_iter().flatten());
    rectangles.sort_by_key(|rectangle| (rectangle.top, rectangle.left));
    rectangles
}

/// The cells with a true pixel, in groups of neighboring cells.
struct Groups {
    /// Number of the group of each cell, from 0; 0 also for a cell without a true pixel.
    of_cells: Raster<usize>,
    /// Number of groups.
    count: usize,
}

impl Groups {
    fn of(mask: &Mask) -> Self {
        let of_cells = Raster::filled(mask.width().div_ceil(CELL_PX), mask.height().div_ceil(CELL_PX), 0);
        let mut groups = Self { of_cells, count: 0 };
        let mut occupied = groups.of_cells.map(|_| false);
        for y in 0..mask.height() {
            for (x, _) in mask.row(y).iter().enumerate().filter(|(_, is_true)| **is_true) {
                occupied[groups.cell_of(x, y)] = true;
            }
        }
        let mut search = ComponentSearch::new(occupied.width(), occupied.height(), Connectivity::Eight);
        for start in 0..occupied.len() {
            let Some(cells) = search.component_at(start, |cell| occupied[cell]) else { continue };
            for &cell in cells {
                groups.of_cells[cell] = groups.count;
            }
            groups.count += 1;
        }
        groups
    }

    fn cell_of(&self, x: usize, y: usize) -> usize {
        y / CELL_PX * self.of_cells.width() + x / CELL_PX
    }
}

/// The rectangles, of which those that overlap are joined until none do.
fn joined_where_overlapping(rectangles: impl Iterator<Item = Roi>) -> Vec<Roi> {
    let mut disjoint: Vec<Roi> = Vec::new();
    for mut rectangle in rectangles {
        while let Some(other) = disjoint.iter().position(|other| other.overlaps(&rectangle)) {
            rectangle = rectangle.joined(&disjoint.swap_remove(other));
        }
        disjoint.push(rectangle);
    }
    disjoint
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn mask(side: usize, pixels: &[[usize; 2]]) -> Mask {
        let mut mask = Mask::filled(side, side, false);
        for &[x, y] in pixels {
            mask[y * side + x] = true;
        }
        mask
    }

    #[test]
    fn pixels_far_from_each_other_lie_in_different_rectangles() {
        let rectangles = disjoint_rectangles(&mask(100, &[[3, 2], [90, 95], [10, 20]]), 2);
        let bounds = rectangles.iter().map(|roi| [roi.left, roi.top, roi.width, roi.height]);
        assert_eq!(bounds.collect::<Vec<_>>(), [[1, 0, 12, 23], [88, 93, 5, 5]]);
        assert!(disjoint_rectangles(&mask(100, &[]), 2).is_empty());
        assert!(disjoint_rectangles(&Mask::default(), 2).is_empty());
    }

    #[test]
    fn an_object_inside_of_a_ring_lies_in_the_rectangle_of_the_ring() {
        let ring = (0..100).flat_map(|at| [[at, 0], [at, 99], [0, at], [99, at]]);
        let pixels: Vec<[usize; 2]> = ring.chain([[50, 50]]).collect();
        let rectangles = disjoint_rectangles(&mask(100, &pixels), 1);
        assert_eq!(rectangles.len(), 1);
        assert_eq!(rectangles[0].len(), 100 * 100);
    }

    proptest! {
        #[test]
        fn rectangles_contain_all_true_pixels_and_no_pixel_twice(
            pixels in prop::collection::vec([0usize..120, 0usize..120], 0..40),
            margin in 0usize..4,
        ) {
            let mask = mask(120, &pixels);
            let rectangles = disjoint_rectangles(&mask, margin);
            for pixel in 0..mask.len() {
                let containing = rectangles.iter().filter(|roi| roi.index(pixel).is_some()).count();
                prop_assert!(containing <= 1 && (containing == 1 || !mask[pixel]));
            }
        }
    }
}
