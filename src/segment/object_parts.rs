//! The separate parts of a region: are they one object, or several of one color?
//!
//! Two separate parts of a region are two objects of one color if background lies between them, and one object if another region lies
//! between them (a cup behind its handle stays one region). A shadow is dark like background: two parts at a distance below the size of
//! the smaller part are taken for one object with a shadow across it, and two parts at a distance above twice that size for two objects.

use super::recorded_labels::Pixels;
use crate::raster::{LabelMap, UNASSIGNED};
use std::collections::BTreeMap;

/// Largest distance along rows or columns between pixels of one part, pixels.
const APART_PX: usize = 4;
/// Widest shadow across an object, as a share of the picture's diagonal.
const MAX_SHADOW: f64 = 0.045;
/// Widest occluder in front of an object, as a share of the picture's diagonal.
const MAX_OCCLUDER: f64 = 0.12;
/// Largest number of border pixels of a part from which the distance between two parts is measured.
const BORDER_SAMPLES: usize = 300;

/// The parts of a region in an image `width` pixels wide: groups of pixels between which the distance along rows or along columns is
/// larger than [`APART_PX`]. An empty list where the region is one part.
pub fn parts(width: usize, pixels: Pixels) -> Vec<Vec<u32>> {
    let runs = pixels.runs();
    let reach = APART_PX as u32;
    let row = |run: (u32, u32)| run.0 / width as u32;
    let column = |run: (u32, u32)| run.0 % width as u32;
    let mut parent: Vec<usize> = (0..runs.len()).collect();
    // Runs are row-major: all runs within reach above a run have an index of at least `above`.
    let mut above = 0;
    for i in 0..runs.len() {
        while row(runs[above]) + reach < row(runs[i]) {
            above += 1;
        }
        let (left, right) = (column(runs[i]), column(runs[i]) + runs[i].1);
        for (j, &run) in runs.iter().enumerate().take(i).skip(above) {
            let other = (column(run), column(run) + run.1);
            if other.0 < right + reach && left < other.1 + reach {
                let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    if (0..runs.len()).all(|i| root(&mut parent, i) == 0) {
        return Vec::new();
    }
    let mut parts: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    for (i, &(first, length)) in runs.iter().enumerate() {
        parts.entry(root(&mut parent, i)).or_default().extend(first..first + length);
    }
    parts.into_values().collect()
}

/// The root of a set in a disjoint-set forest; shortens the path to it.
fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}

/// The outline of a part of a region.
pub(super) struct Outline {
    /// Number of pixels of the part.
    size: usize,
    /// First and last column of the part.
    columns: [i64; 2],
    /// First and last row of the part.
    rows: [i64; 2],
    /// Column and row of border pixels, evenly chosen.
    border: Vec<(i64, i64)>,
}

impl Outline {
    /// The outline of `pixels`, which belong to one region of `labels`.
    pub(super) fn new(labels: &LabelMap, pixels: impl Iterator<Item = u32>) -> Self {
        let width = labels.width();
        let mut outline =
            Self { size: 0, columns: [i64::MAX, i64::MIN], rows: [i64::MAX, i64::MIN], border: Vec::new() };
        for pixel in pixels {
            let own = labels[pixel as usize];
            let (x, y) = ((pixel as usize % width) as i64, (pixel as usize / width) as i64);
            outline.size += 1;
            outline.columns = [outline.columns[0].min(x), outline.columns[1].max(x)];
            outline.rows = [outline.rows[0].min(y), outline.rows[1].max(y)];
            let mut edge = false;
            labels.for_each_neighbor(pixel as usize, |near| edge |= labels[near] != own);
            if edge {
                outline.border.push((x, y));
            }
        }
        let step = outline.border.len().div_ceil(BORDER_SAMPLES).max(1);
        outline.border = outline.border.into_iter().step_by(step).collect();
        outline
    }

    /// Distance between the bounding boxes of two parts, pixels: a lower bound of the distance between the parts.
    fn least_gap_px(&self, other: &Self) -> f64 {
        let gap = |a: [i64; 2], b: [i64; 2]| (a[0] - b[1]).max(b[0] - a[1]).max(0);
        (gap(self.columns, other.columns) as f64).hypot(gap(self.rows, other.rows) as f64)
    }
}

/// Whether two parts are one object: their distance is small compared with their sizes, or most pixels between them belong to
/// other regions, those of an object in front.
pub(super) fn same_object(labels: &LabelMap, one: &Outline, other: &Outline) -> bool {
    let width = labels.width();
    let size_px = (one.size.min(other.size) as f64).sqrt();
    let diagonal_px = (width as f64).hypot(labels.height() as f64);
    let largest_gap_px = (2.0 * size_px).min(MAX_OCCLUDER * diagonal_px);
    if one.least_gap_px(other) > largest_gap_px {
        return false;
    }
    let closest = one
        .border
        .iter()
        .flat_map(|&a| other.border.iter().map(move |&b| (a, b)))
        .min_by_key(|(a, b)| (a.0 - b.0).pow(2) + (a.1 - b.1).pow(2));
    let Some((a, b)) = closest else { return false };
    let gap_px = ((a.0 - b.0) as f64).hypot((a.1 - b.1) as f64);
    if gap_px < size_px.min(MAX_SHADOW * diagonal_px) {
        return true;
    }
    if gap_px > largest_gap_px {
        return false;
    }
    let steps = (a.0 - b.0).abs().max((a.1 - b.1).abs()).max(1);
    let between = (1..steps).map(|i| {
        let at = |from: i64, to: i64| (from + (to - from) * i / steps) as usize;
        labels[at(a.1, b.1) * width + at(a.0, b.0)]
    });
    let (assigned, total) =
        between.fold((0, 0), |(assigned, total), l| (assigned + i64::from(l != UNASSIGNED), total + 1));
    assigned * 2 > total
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::RegionId;
    use crate::segment::Members;

    #[test]
    fn the_distance_between_parts_is_the_same_along_rows_and_columns() {
        let count = |rectangles: [[usize; 4]; 2], turned: bool| {
            let width = 40;
            let mut labels = LabelMap::filled(width, width, UNASSIGNED);
            for [left, top, columns, rows] in rectangles {
                for (x, y) in (left..left + columns).flat_map(|x| (top..top + rows).map(move |y| (x, y))) {
                    let pixel = if turned { x * width + y } else { y * width + x };
                    labels[pixel] = 1;
                }
            }
            parts(width, Members::of(&labels, 1).region(RegionId::from_index(0))).len()
        };
        for turned in [false, true] {
            assert_eq!(
                count([[2, 3, 10, 8], [15, 3, 9, 8]], turned),
                0,
                "4 pixels from one to the next: one part"
            );
            assert_eq!(count([[2, 3, 10, 8], [16, 3, 9, 8]], turned), 2, "5 pixels from one to the next");
        }
    }
}
