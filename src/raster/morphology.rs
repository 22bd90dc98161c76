//! Dilation and erosion of masks by squares.

use super::grid::{Mask, Raster};

/// The mask of every pixel within `radius_px` columns and rows of a set pixel: dilation by a square of side
/// `2·radius_px + 1`, computed by a pass along the rows and a pass along the columns.
pub fn dilate(mask: &Mask, radius_px: usize) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let mut across = Raster::filled(width, height, false);
    let mut result = across.clone();
    for y in 0..height {
        dilate_line(
            mask.as_slice(),
            across.as_mut_slice(),
            Strided { first: y * width, stride: 1, length: width },
            radius_px,
        );
    }
    for x in 0..width {
        dilate_line(
            across.as_slice(),
            result.as_mut_slice(),
            Strided { first: x, stride: width, length: height },
            radius_px,
        );
    }
    result
}

/// The mask of every pixel with nothing but set pixels within `radius_px` columns and rows: erosion by a square of side
/// `2·radius_px + 1`. What lies outside of the picture counts as set.
pub fn erode(mask: &Mask, radius_px: usize) -> Mask {
    dilate(&mask.map(|&is_set| !is_set), radius_px).map(|&is_near_unset| !is_near_unset)
}

/// A row or a column of a raster.
#[derive(Clone, Copy)]
struct Strided {
    /// Index of the first value.
    first: usize,
    /// Difference between the indices of successive values.
    stride: usize,
    /// Number of values.
    length: usize,
}

/// Dilates a row or a column of `from` by `radius_px` and sets the result in `to`.
fn dilate_line(from: &[bool], to: &mut [bool], line: Strided, radius_px: usize) {
    let Strided { first, stride, length } = line;
    // The values before this place of the line are final.
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
