//! Dilation and erosion of masks by squares.

use super::grid::{Mask, Raster};
use rayon::prelude::*;

/// Least number of rows that one task dilates along the columns; the task reads twice the radius in addition.
const BAND_ROWS: usize = 64;

/// The mask of every pixel within `radius_px` columns and rows of a set pixel: dilation by a square of side
/// `2·radius_px + 1`, computed by a pass along the rows and a pass along the columns.
pub fn dilate(mask: &Mask, radius_px: usize) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let mut across = Raster::filled(width, height, false);
    let rows = across.as_mut_slice().par_chunks_mut(width.max(1)).enumerate();
    rows.with_min_len(BAND_ROWS).for_each(|(y, row)| dilate_row(mask.row(y), row, radius_px));
    let mut result = Raster::filled(width, height, false);
    let band_rows = BAND_ROWS.max(2 * radius_px);
    let bands = result.as_mut_slice().par_chunks_mut((width * band_rows).max(1)).enumerate();
    bands.for_each(|(band, rows)| dilate_columns(&across, rows, band * band_rows, radius_px));
    result
}

/// The mask of every pixel with nothing but set pixels within `radius_px` columns and rows: erosion by a square of side
/// `2·radius_px + 1`. What lies outside of the picture counts as set.
pub fn erode(mask: &Mask, radius_px: usize) -> Mask {
    dilate(&mask.par_map(|&is_set| !is_set), radius_px).par_map(|&is_near_unset| !is_near_unset)
}

/// Dilates the row `from` by `radius_px` and sets the result in `to`, whose pixels are not set.
fn dilate_row(from: &[bool], to: &mut [bool], radius_px: usize) {
    // The values before this place are final.
    let mut reached = 0;
    for (place, _) in from.iter().enumerate().filter(|(_, is_set)| **is_set) {
        let end = from.len().min(place + radius_px + 1);
        to[reached.max(place.saturating_sub(radius_px)).min(end)..end].fill(true);
        reached = end;
    }
}

/// Dilates the columns of `from` by `radius_px` in the rows from `top` on that `to` holds.
fn dilate_columns(from: &Mask, to: &mut [bool], top: usize, radius_px: usize) {
    let (width, height) = (from.width(), from.height());
    // The number of set pixels of each column within reach of the current row.
    let mut counts = vec![0u32; width];
    let add = |counts: &mut [u32], y: usize| {
        counts.iter_mut().zip(from.row(y)).for_each(|(count, &is_set)| *count += u32::from(is_set));
    };
    (top.saturating_sub(radius_px)..height.min(top + radius_px)).for_each(|y| add(&mut counts, y));
    for (y, row) in (top..).zip(to.chunks_mut(width)) {
        if y + radius_px < height {
            add(&mut counts, y + radius_px);
        }
        if y > top && y > radius_px {
            let gone = from.row(y - radius_px - 1);
            counts.iter_mut().zip(gone).for_each(|(count, &is_set)| *count -= u32::from(is_set));
        }
        row.iter_mut().zip(&counts).for_each(|(is_near, &count)| *is_near = count > 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Mask {
        let data = rows.iter().flat_map(|row| row.bytes().map(|b| b == b'#')).collect();
        Raster::from_vec(rows[0].len(), rows.len(), data).unwrap()
    }

    #[test]
    fn a_point_becomes_a_square() {
        let point = mask(&[".....", ".....", "..#..", ".....", "....."]);
        assert_eq!(dilate(&point, 1), mask(&[".....", ".###.", ".###.", ".###.", "....."]));
        assert_eq!(dilate(&point, 0), point);
        assert_eq!(dilate(&point, 9), Raster::filled(5, 5, true));
    }

    #[test]
    fn a_square_becomes_a_point_and_the_border_does_not_shrink() {
        assert_eq!(
            erode(&mask(&[".....", ".###.", ".###.", ".###.", "....."]), 1),
            mask(&[".....", ".....", "..#..", ".....", "....."])
        );
        assert_eq!(erode(&mask(&["###..", "###..", "###.."]), 1), mask(&["##...", "##...", "##..."]));
    }

    #[test]
    fn squares_end_at_the_border_and_overlap() {
        assert_eq!(dilate(&mask(&["#...", "...#"]), 1), mask(&["####", "####"]));
        assert_eq!(dilate(&mask(&["#....#"]), 2), mask(&["######"]));
        assert_eq!(dilate(&Raster::filled(0, 0, true), 3).len(), 0);
    }
}
