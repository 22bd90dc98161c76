//! Masks from shapes drawn in the picture, and from items that can be selected.
//!
//! Places are in pixels of the picture: pixel (x, y) covers x…x+1, y…y+1, and its center is at x + ½, y + ½. A shape marks the
//! pixels whose centers lie in the shape. Parts of a shape outside the picture are ignored.

use super::{Histogram, Item, Picture, ResultSnapshot};
use crate::raster::{LabelMap, Mask, PixelIndex, Raster, RegionId};

/// Columns and rows of a picture.
pub type Size = (usize, usize);

/// The pixels in the rectangle with these opposite corners.
pub fn rectangle(size: Size, from: [f32; 2], to: [f32; 2]) -> Mask {
    let columns = centers_within(from[0], to[0], size.0);
    let mut mask = Mask::filled(size.0, size.1, false);
    for y in centers_within(from[1], to[1], size.1) {
        mask.as_mut_slice()[y * size.0..][columns.clone()].fill(true);
    }
    mask
}

/// The pixels inside a closed outline, by the even–odd rule: a lasso or a polygon.
pub fn outline(size: Size, corners: &[[f32; 2]]) -> Mask {
    let mut mask = Mask::filled(size.0, size.1, false);
    let mut crossings = Vec::new();
    for y in 0..size.1 {
        let center = y as f32 + 0.5;
        crossings.clear();
        for (i, a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            // Half open, so that a corner on the row is crossed once.
            if (a[1] <= center) != (b[1] <= center) {
                crossings.push(a[0] + (center - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
            }
        }
        crossings.sort_by(f32::total_cmp);
        for pair in crossings.chunks_exact(2) {
            mask.as_mut_slice()[y * size.0..][centers_within(pair[0], pair[1], size.0)].fill(true);
        }
    }
    mask
}

/// The pixels that a round brush covers on its way along `path`; at least those that the path itself goes through.
pub fn brush(size: Size, path: &[[f32; 2]], radius_px: f32) -> Mask {
    let mut mask = Mask::filled(size.0, size.1, false);
    let ends = path.windows(2).map(|ends| (ends[0], ends[1]));
    for (a, b) in ends.chain(path.last().map(|&end| (end, end))) {
        for pixel in line(size, a, b) {
            mask[pixel as usize] = true;
        }
        let span = |k: usize| (a[k].min(b[k]) - radius_px, a[k].max(b[k]) + radius_px);
        let (columns, rows) = (span(0), span(1));
        for y in centers_within(rows.0, rows.1, size.1) {
            for x in centers_within(columns.0, columns.1, size.0) {
                let center = [x as f32 + 0.5, y as f32 + 0.5];
                if off_segment2(center, a, b) <= radius_px * radius_px {
                    mask[y * size.0 + x] = true;
                }
            }
        }
    }
    mask
}

/// The pixels along a straight line, in order: one per column where the line crosses more columns than rows, else one per row.
pub fn line(size: Size, from: [f32; 2], to: [f32; 2]) -> Vec<u32> {
    if !from.iter().chain(&to).all(|v| v.is_finite()) {
        return Vec::new();
    }
    let Some([from, to]) = clipped(size, from, to) else { return Vec::new() };
    let cell = |v: f32, end: usize| (v.max(0.0) as usize).min(end - 1);
    let [first, last] = [from, to].map(|p| [cell(p[0], size.0) as i64, cell(p[1], size.1) as i64]);
    let steps = (last[0] - first[0]).abs().max((last[1] - first[1]).abs());
    let along = |i: i64, k: usize| {
        let t = if steps == 0 { 0.0 } else { i as f64 / steps as f64 };
        (first[k] as f64 + (last[k] - first[k]) as f64 * t).round() as usize
    };
    (0..=steps).map(|i| (along(i, 1) * size.0 + along(i, 0)) as u32).collect()
}

/// The pixels of an item; none where the result or the picture has no such item.
pub fn mask_of(item: Item, shown: &ResultSnapshot) -> Option<Mask> {
    let (width, height) = shown.picture.size();
    let mut mask = Mask::filled(width, height, false);
    match item {
        Item::Pixel(pixel) => *mask.as_mut_slice().get_mut(pixel.index())? = true,
        Item::Window(window) => {
            let windows = &shown.analysis.windows;
            let (columns, size_px) = (windows.classes.width(), windows.size_px);
            let window = window as usize;
            if window >= windows.classes.len() {
                return None;
            }
            let (left, top) = (window % columns * size_px, window / columns * size_px);
            for y in top..(top + size_px).min(height) {
                mask.as_mut_slice()[y * width + left..y * width + (left + size_px).min(width)].fill(true);
            }
        }
        Item::Region(region) => return of_region(shown.labels(), region),
        Item::Bin(bin) => return of_bins(&shown.picture, &[bin]),
    }
    Some(mask)
}

/// The pixels of a region; none where it has no pixels.
pub fn of_region(labels: &LabelMap, region: RegionId) -> Option<Mask> {
    let region = region.get();
    let mask = labels.map(|&label| label == region);
    mask.as_slice().contains(&true).then_some(mask)
}

/// The pixels whose colors are in any of these bins; none where there are none.
pub fn of_bins(picture: &Picture, bins: &[u32]) -> Option<Mask> {
    let (width, height) = picture.size();
    let histogram = &picture.histogram;
    let mut chosen = vec![false; histogram.bins.len()];
    for &bin in bins {
        if let Some(chosen) = chosen.get_mut(bin as usize) {
            *chosen = true;
        }
    }
    let is_chosen = |pixel| histogram.bin_of(pixel).is_some_and(|bin| chosen[bin as usize]);
    let mask = Raster::from_vec(width, height, (0..width * height).map(is_chosen).collect())?;
    mask.as_slice().contains(&true).then_some(mask)
}

/// The pixels of one color around a pixel: the pixels of the same bin that are 4-connected to the pixel.
pub fn flood(size: Size, histogram: &Histogram, pixel: PixelIndex) -> Option<Mask> {
    let pixel = pixel.index();
    let bin = histogram.bin_of(pixel)?;
    let mut mask = Mask::filled(size.0, size.1, false);
    *mask.as_mut_slice().get_mut(pixel)? = true;
    let mut front = vec![pixel];
    let mut found = Vec::with_capacity(4);
    while let Some(pixel) = front.pop() {
        mask.for_each_neighbor(pixel, |near| found.push(near));
        for near in found.drain(..) {
            if !mask[near] && histogram.bin_of(near) == Some(bin) {
                mask[near] = true;
                front.push(near);
            }
        }
    }
    Some(mask)
}

/// The columns (or rows) below `end` whose centers lie between two places.
fn centers_within(a: f32, b: f32, end: usize) -> std::ops::Range<usize> {
    let first = |place: f32| ((place - 0.5).ceil().max(0.0) as usize).min(end);
    let (low, high) = (first(a.min(b)), (a.max(b) - 0.5).floor());
    // A comparison with NaN is false.
    if high >= 0.0 { low..((high as usize).saturating_add(1)).clamp(low, end.max(low)) } else { low..low }
}

/// Squared distance of a point from a segment.
fn off_segment2(p: [f32; 2], a: [f32; 2], b: [f32; 2]) -> f32 {
    let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length2 = ab[0] * ab[0] + ab[1] * ab[1];
    let t = if length2 > 0.0 { ((ap[0] * ab[0] + ap[1] * ab[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (ap[0] - t * ab[0]).powi(2) + (ap[1] - t * ab[1]).powi(2)
}

/// The part of a segment inside the picture (Liang & Barsky 1984); none where the segment lies outside.
fn clipped(size: Size, a: [f32; 2], b: [f32; 2]) -> Option<[[f32; 2]; 2]> {
    let mut range = [0.0f32, 1.0];
    for (k, end) in [size.0 as f32, size.1 as f32].into_iter().enumerate() {
        let step = b[k] - a[k];
        for (towards, room) in [(-step, a[k]), (step, end - a[k])] {
            if towards > 0.0 {
                range[1] = range[1].min(room / towards);
            } else if towards < 0.0 {
                range[0] = range[0].max(room / towards);
            } else if room < 0.0 {
                return None;
            }
        }
    }
    let at = |t: f32| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
    (range[0] <= range[1] && size.0 > 0 && size.1 > 0).then(|| [at(range[0]), at(range[1])])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::LinearImage;
    use crate::view::testing::tiny;
    use proptest::prelude::*;

    #[track_caller]
    fn check(mask: &Mask, rows: &[&str]) {
        let drawn: Vec<String> = (0..mask.height())
            .map(|y| mask.row(y).iter().map(|&on| if on { '#' } else { '.' }).collect())
            .collect();
        assert_eq!(drawn, rows);
    }

    #[test]
    fn a_rectangle_marks_the_centers_inside_whichever_way_it_is_drawn() {
        let rows = ["......", ".###..", ".###.."];
        check(&rectangle((6, 3), [1.5, 1.2], [3.9, 9.0]), &rows);
        check(&rectangle((6, 3), [3.9, 9.0], [1.5, 1.2]), &rows);
        check(&rectangle((6, 3), [2.6, 1.2], [3.4, 1.4]), &["......"; 3]);
        check(&rectangle((3, 2), [-9.0, -9.0], [99.0, 99.0]), &["###"; 2]);
        check(&rectangle((3, 2), [-9.0, 0.0], [-1.0, 2.0]), &["..."; 2]);
        check(&rectangle((3, 2), [f32::NAN, 0.0], [f32::NAN, 2.0]), &["..."; 2]);
    }

    #[test]
    fn an_outline_is_even_odd() {
        let diamond = [[3.5, 0.0], [7.0, 3.5], [3.5, 7.0], [0.0, 3.5]];
        check(
            &outline((7, 7), &diamond),
            &["...#...", "..###..", ".#####.", "#######", ".#####.", "..###..", "...#..."],
        );
        // The inner square is drawn on from the outer one.
        let ring = [
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 5.0],
            [0.0, 5.0],
            [0.0, 0.0],
            [2.0, 2.0],
            [3.0, 2.0],
            [3.0, 3.0],
            [2.0, 3.0],
            [2.0, 2.0],
        ];
        check(&outline((5, 5), &ring), &["#####", "#####", "##.##", "#####", "#####"]);
        check(&outline((3, 1), &[]), &["..."]);
    }

    #[test]
    fn a_brush_sweeps_a_disc() {
        check(&brush((7, 5), &[[2.5, 2.5]], 1.0), &[".......", "..#....", ".###...", "..#....", "......."]);
        check(&brush((7, 3), &[[1.5, 1.5], [5.5, 1.5]], 1.0), &[".#####.", "#######", ".#####."]);
        check(&brush((5, 1), &[[0.1, 0.1], [3.2, 0.4]], 0.0), &["####."]);
        check(&brush((3, 1), &[[-99.0, 0.0]], 2.0), &["..."]);
    }

    #[test]
    fn a_line_has_one_pixel_a_step() {
        assert_eq!(line((10, 4), [0.5, 0.5], [3.5, 3.5]), [0, 11, 22, 33]);
        assert_eq!(line((4, 2), [3.5, 0.5], [0.5, 0.5]), [3, 2, 1, 0]);
        assert_eq!(line((4, 2), [-8.0, 1.5], [99.0, 1.5]), [4, 5, 6, 7]);
        assert_eq!(line((4, 2), [1.2, 1.2], [1.3, 1.3]), [5]);
        assert!(line((4, 2), [-8.0, -1.5], [99.0, -1.5]).is_empty());
        assert!(line((4, 2), [f32::NAN, 0.0], [1.0, 1.0]).is_empty());
    }

    #[test]
    fn a_flood_stays_in_its_bin() {
        let rows = ["aab.a", "ab..a", "aaaba"];
        let colors =
            rows.iter().flat_map(|row| row.bytes()).map(|c| [f32::from(c - b'.'), 9.0, 9.0]).collect();
        let image = LinearImage::new(Raster::from_vec(5, 3, colors).unwrap(), Some(63.0));
        let histogram = Histogram::of(&image);
        check(&flood((5, 3), &histogram, PixelIndex::new(0)).unwrap(), &["##...", "#....", "###.."]);
        assert!(flood((5, 3), &histogram, PixelIndex::new(15)).is_none());
    }

    #[test]
    fn things_have_their_pixels() {
        let shown = tiny();
        let count = |item| mask_of(item, &shown).map(|mask| mask.count());
        assert_eq!(count(Item::Pixel(PixelIndex::new(7))), Some(1));
        assert_eq!(count(Item::Pixel(PixelIndex::new(u32::MAX))), None);
        assert_eq!(
            count(Item::Region(RegionId::from_index(0))),
            Some(shown.analysis.intrinsic.regions[0].pixels)
        );
        assert_eq!(count(Item::Region(RegionId::from_index(998))), None);
        let size_px = shown.analysis.windows.size_px;
        assert_eq!(count(Item::Window(0)), Some(size_px * size_px));
        assert_eq!(count(Item::Window(u32::MAX)), None);
        let bin = shown.picture.histogram.bins[3];
        assert_eq!(count(Item::Bin(3)), Some(bin.count as usize));
        assert_eq!(count(Item::Bin(u32::MAX)), None);
        let all: Vec<u32> = (0..shown.picture.histogram.bins.len() as u32).collect();
        let whole = of_bins(&shown.picture, &all).unwrap();
        assert!(whole.as_slice().iter().all(|&on| on));
    }

    proptest! {
        #[test]
        fn a_rectangle_is_the_outline_of_its_corners(
            a in prop::array::uniform2(-5f32..25.0), b in prop::array::uniform2(-5f32..25.0),
        ) {
            let corners = [a, [b[0], a[1]], b, [a[0], b[1]]];
            prop_assert_eq!(rectangle((20, 16), a, b), outline((20, 16), &corners));
        }

        #[test]
        fn a_brush_is_as_far_from_its_path_as_it_is_wide(
            path in prop::collection::vec(prop::array::uniform2(-5f32..25.0), 1..6), radius in 0.8f32..6.0,
        ) {
            let mask = brush((20, 16), &path, radius);
            for pixel in 0..mask.len() {
                let center = [(pixel % 20) as f32 + 0.5, (pixel / 20) as f32 + 0.5];
                let mut off2 = off_segment2(center, path[0], path[0]);
                for ends in path.windows(2) {
                    off2 = off2.min(off_segment2(center, ends[0], ends[1]));
                }
                // The path's own pixels have centers within half a diagonal of it, plus rounding of its slope.
                prop_assert!(mask[pixel] == (off2 <= radius * radius) || off2.sqrt() < 1.5, "{}", off2.sqrt());
            }
        }
    }
}
