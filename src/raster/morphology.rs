//! Growing and shrinking masks by squares, as two passes of running counts.

use super::grid::{Mask, Raster};

/// Every pixel within `radius` columns and rows of a set pixel (a square of side `2·radius + 1`).
pub fn dilate(mask: &Mask, radius: usize) -> Mask {
    window_any(mask, radius, true)
}

/// Every pixel whose whole square of side `2·radius + 1` is set; beyond the border counts as set.
pub fn erode(mask: &Mask, radius: usize) -> Mask {
    window_any(mask, radius, false)
}

/// `sought` wherever the square holds at least one `sought`, `!sought` elsewhere.
fn window_any(mask: &Mask, radius: usize, sought: bool) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let mut across = Raster::filled(width, height, !sought);
    let mut result = across.clone();
    spread(mask.as_slice(), across.as_mut_slice(), width, height, (1, width), radius, sought);
    spread(across.as_slice(), result.as_mut_slice(), height, width, (width, 1), radius, sought);
    result
}

/// Along `lines` lines of `length` values, `strides` = (within a line, between lines).
fn spread(
    from: &[bool],
    to: &mut [bool],
    length: usize,
    lines: usize,
    strides: (usize, usize),
    radius: usize,
    sought: bool,
) {
    for line in 0..lines {
        let at = |i: usize| line * strides.1 + i * strides.0;
        // First index that no sought value has reached yet.
        let mut reached = 0;
        for i in 0..length {
            if from[at(i)] == sought {
                for j in reached.max(i.saturating_sub(radius))..length.min(i + radius + 1) {
                    to[at(j)] = sought;
                }
                reached = reached.max(length.min(i + radius + 1));
            }
        }
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
    fn dilation_paints_a_square_and_erosion_takes_it_back() {
        let point = mask(&[".....", ".....", "..#..", ".....", "....."]);
        let square = mask(&[".....", ".###.", ".###.", ".###.", "....."]);
        assert_eq!(dilate(&point, 1), square);
        assert_eq!(erode(&square, 1), point);
        assert_eq!(dilate(&point, 9), Raster::filled(5, 5, true));
    }

    #[test]
    fn the_border_does_not_erode() {
        let full = Raster::filled(4, 3, true);
        assert_eq!(erode(&full, 2), full);
        assert_eq!(dilate(&mask(&["#...", "...#"]), 1), mask(&["####", "####"]));
    }
}
