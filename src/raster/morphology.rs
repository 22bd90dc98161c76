//! Growing masks by squares.

use super::grid::{Mask, Raster};

/// Every pixel within `radius_px` columns and rows of a set pixel: a square of side `2·radius_px + 1`, as a pass along
/// the rows and one along the columns.
pub fn dilate(mask: &Mask, radius_px: usize) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let mut across = Raster::filled(width, height, false);
    let mut result = across.clone();
    for y in 0..height {
        spread(mask.as_slice(), across.as_mut_slice(), (y * width, 1, width), radius_px);
    }
    for x in 0..width {
        spread(across.as_slice(), result.as_mut_slice(), (x, width, height), radius_px);
    }
    result
}

/// Along one line of values, given as its first index, the stride and the length.
fn spread(from: &[bool], to: &mut [bool], (first, stride, length): (usize, usize, usize), radius_px: usize) {
    // All before this place on the line have been set as far as they will be.
    let mut reached = 0;
    for place in (0..length).filter(|place| from[first + place * stride]) {
        let end = length.min(place + radius_px + 1);
        for near in reached.max(place.saturating_sub(radius_px))..end {
            to[first + near * stride] = true;
        }
        reached = reached.max(end);
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
    fn squares_end_at_the_border_and_join_one_another() {
        assert_eq!(dilate(&mask(&["#...", "...#"]), 1), mask(&["####", "####"]));
        assert_eq!(dilate(&mask(&["#....#"]), 2), mask(&["######"]));
        assert_eq!(dilate(&Raster::filled(0, 0, true), 3).len(), 0);
    }
}
