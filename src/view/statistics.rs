//! Figures about a set of pixels: their number, colors, places and owners.

use super::owners::Owners;
use super::{Item, OwnerKind, OwnersAtCursor, ResultSnapshot, marking};
use crate::color::{Moments, principal_axes};
use crate::raster::{Mask, UNASSIGNED};
use crate::segment::Classifier;
use crate::trace::Class;
use rayon::prelude::*;

/// Bins of a band's histogram.
pub const STATISTICS_BINS: usize = 64;
/// Largest number of parts in which pixels are added up, whatever the number of threads, so that sums are identical bit for bit.
const MOST_PARTS: usize = 16;
/// Number of bins by the upper 15 bits of a float that is not negative, for the first step of a median.
const COARSE_BINS: usize = 1 << 15;
/// Number of bins by the lower 16 bits, for the second step: each bin is one float.
const FINE_BINS: usize = 1 << 16;

/// Figures about a set of pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Statistics {
    /// Number of pixels.
    pub pixels: usize,
    /// Number of pixels with finite values. `mean` and `bands` are figures about these pixels.
    pub valid: usize,
    /// Mean color, counts.
    pub mean: [f64; 3],
    /// The figures of each band.
    pub bands: [Band; 3],
    /// Number of pixels that the class is computed from: as in the classification of windows, with refinement `tail_test` only pixels without any mark.
    pub counted: usize,
    /// Variances along the principal axes, largest first, counts².
    pub variances: [f64; 3],
    /// The principal axes, unit vectors.
    pub axes: [[f64; 3]; 3],
    /// Class by the χ² test at the camera noise in force (5.2.1); none below two pixels.
    pub class: Option<Class>,
    /// The smallest rectangle that holds the pixels.
    pub bounds: Bounds,
    /// What the owners of the pixels are.
    pub owner_kind: OwnerKind,
    /// The labels of the owners, each with its number of pixels, the largest number first; of equal numbers, pixels of no owner (label 0) come last.
    pub owners: Vec<(u16, usize)>,
    /// Number of pixels with a clipped band.
    pub clipped: usize,
    /// Number of pixels that take no part: too dark, invalid, or outside of the area of the analysis.
    pub dark: usize,
}

/// One band of a set of pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Smallest value, counts.
    pub min: f32,
    /// Exact median, counts; of an even number of values the smaller of the two in the middle.
    pub median: f32,
    /// Largest value, counts.
    pub max: f32,
    /// Number of values in each of [`STATISTICS_BINS`] equal parts of 0 to full scale.
    pub histogram: Vec<u32>,
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// The leftmost column.
    pub left: usize,
    /// The topmost row.
    pub top: usize,
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
}

/// The figures about the pixels of an item; none where the item has no pixels. Pixels and owners are those at the debugger's cursor
/// where `cursor` is given, otherwise those of the result.
pub fn statistics_of(
    shown: &ResultSnapshot,
    item: Item,
    cursor: Option<&OwnersAtCursor>,
) -> Option<Statistics> {
    let mask = match cursor {
        Some(cursor) => cursor.mask_of(item, shown),
        None => marking::mask_of(item, shown),
    };
    statistics(shown, &mask?, cursor)
}

/// The figures about the pixels of a mask; none where the mask holds no pixel, or is not of the picture's size. The owners are those at
/// the debugger's cursor where `cursor` is given, otherwise the regions of the result.
pub fn statistics(
    shown: &ResultSnapshot,
    mask: &Mask,
    cursor: Option<&OwnersAtCursor>,
) -> Option<Statistics> {
    let (width, height) = shown.picture.size();
    if (mask.width(), mask.height()) != (width, height) || mask.is_empty() {
        return None;
    }
    let full_counts = shown.picture.histogram.full_counts;
    let owners = Owners::new(shown, cursor);
    let scan = PixelScan { shown, mask, owners, per_count: STATISTICS_BINS as f32 / full_counts };
    let rows = height.div_ceil(MOST_PARTS);
    let firsts: Vec<usize> = (0..height).step_by(rows).collect();
    let parts: Vec<PartialSums> =
        firsts.par_iter().map(|&first| scan.sums_of_rows(first..(first + rows).min(height))).collect();
    let whole = parts.into_iter().reduce(PartialSums::merged_with)?;
    if whole.pixels == 0 {
        return None;
    }
    let medians = scan.medians(&whole);
    let refined = shown.params.refinements().tail_test;
    let mut classifier = Classifier::new(shown.analysis.used.camera_noise, refined);
    let (variances, axes) = principal_axes(&whole.counted.covariance());
    let mut counted: Vec<(u16, usize)> = (0..).zip(whole.owners).filter(|(_, n)| *n > 0).collect();
    counted.sort_by_key(|&(label, n)| (std::cmp::Reverse(n), label == UNASSIGNED, label));
    let [columns, rows] = [whole.columns, whole.rows];
    Some(Statistics {
        pixels: whole.pixels,
        valid: whole.valid,
        mean: whole.sum.map(|sum| sum / (whole.valid.max(1)) as f64),
        bands: std::array::from_fn(|k| Band {
            min: if whole.valid == 0 { 0.0 } else { whole.min[k] },
            median: medians[k],
            max: whole.max[k],
            histogram: whole.bands[k].histogram.clone(),
        }),
        counted: whole.counted.n as usize,
        variances: variances.map(|variance| variance.max(0.0)),
        axes: axes.map(Into::into),
        class: (whole.counted.n >= 2.0).then(|| classifier.classify(&whole.counted).0),
        bounds: Bounds {
            left: columns[0],
            top: rows[0],
            width: columns[1] + 1 - columns[0],
            height: rows[1] + 1 - rows[0],
        },
        owner_kind: owners.kind,
        owners: counted,
        clipped: whole.clipped,
        dark: whole.dark,
    })
}

/// The pixels that the figures are about.
struct PixelScan<'a> {
    shown: &'a ResultSnapshot,
    mask: &'a Mask,
    owners: Owners<'a>,
    /// Bins of the histogram per count.
    per_count: f32,
}

/// The sums of some rows.
struct PartialSums {
    pixels: usize,
    valid: usize,
    sum: [f64; 3],
    min: [f32; 3],
    max: [f32; 3],
    bands: [BandCounts; 3],
    counted: Moments,
    /// First and last column.
    columns: [usize; 2],
    /// First and last row.
    rows: [usize; 2],
    owners: Vec<usize>,
    clipped: usize,
    dark: usize,
}

struct BandCounts {
    histogram: Vec<u32>,
    /// Number of values of each range of floats, for the median.
    coarse: Vec<u32>,
}

impl PixelScan<'_> {
    fn sums_of_rows(&self, rows: std::ops::Range<usize>) -> PartialSums {
        let image = &self.shown.picture.photo.image;
        let masks = &self.shown.analysis.masks;
        let refined = self.shown.params.refinements().tail_test;
        let mut part = PartialSums::new(self.owners.count);
        for y in rows {
            let first = y * image.width();
            for (x, _) in self.mask.row(y).iter().enumerate().filter(|(_, on)| **on) {
                let pixel = first + x;
                part.pixels += 1;
                part.columns = [part.columns[0].min(x), part.columns[1].max(x)];
                part.rows = [part.rows[0].min(y), part.rows[1].max(y)];
                if let Some(count) = part.owners.get_mut(usize::from(self.owners.label(pixel))) {
                    *count += 1;
                }
                part.clipped += usize::from(masks.clipped(pixel));
                part.dark += usize::from(masks.dark(pixel));
                if masks.invalid(pixel) {
                    continue;
                }
                part.add(image.pixels[pixel], self.per_count);
                if !refined || masks.usable(pixel) {
                    part.counted.add(image.pixels[pixel]);
                }
            }
        }
        part
    }

    /// The median of each band: the coarse counts give the range of floats, a second pass gives the value.
    fn medians(&self, whole: &PartialSums) -> [f32; 3] {
        if whole.valid == 0 {
            return [0.0; 3];
        }
        let rank = ((whole.valid - 1) / 2) as u64;
        let found: [(usize, u64); 3] =
            std::array::from_fn(|k| bin_of_rank(whole.bands[k].coarse.iter().map(|&n| u64::from(n)), rank));
        let masks = &self.shown.analysis.masks;
        let pixels = self.shown.picture.photo.image.pixels.as_slice();
        let length = pixels.len().div_ceil(MOST_PARTS);
        let fine = |(part, colors): (usize, &[[f32; 3]])| {
            let mut fine: [Vec<u32>; 3] = std::array::from_fn(|_| vec![0; FINE_BINS]);
            for (pixel, color) in (part * length..).zip(colors) {
                if !self.mask[pixel] || masks.invalid(pixel) {
                    continue;
                }
                for (k, fine) in fine.iter_mut().enumerate() {
                    let bits = ordered_bits(color[k]);
                    if bits >> 16 == found[k].0 {
                        fine[bits & (FINE_BINS - 1)] += 1;
                    }
                }
            }
            fine
        };
        let fine = pixels.par_chunks(length).enumerate().map(fine).reduce_with(|mut a, b| {
            for (a, b) in a.iter_mut().zip(&b) {
                add(a, b);
            }
            a
        });
        let fine = fine.unwrap_or_default();
        std::array::from_fn(|k| {
            let (coarse, rest) = found[k];
            let (low, _) = bin_of_rank(fine[k].iter().map(|&n| u64::from(n)), rest);
            f32::from_bits((coarse << 16 | low) as u32)
        })
    }
}

impl PartialSums {
    fn new(owners: usize) -> Self {
        let counts = || BandCounts { histogram: vec![0; STATISTICS_BINS], coarse: vec![0; COARSE_BINS] };
        Self {
            pixels: 0,
            valid: 0,
            sum: [0.0; 3],
            min: [f32::INFINITY; 3],
            max: [0.0; 3],
            bands: [counts(), counts(), counts()],
            counted: Moments::default(),
            columns: [usize::MAX, 0],
            rows: [usize::MAX, 0],
            owners: vec![0; owners + 1],
            clipped: 0,
            dark: 0,
        }
    }

    #[inline]
    fn add(&mut self, color: [f32; 3], per_count: f32) {
        self.valid += 1;
        for (k, value) in color.into_iter().enumerate() {
            self.sum[k] += f64::from(value);
            self.min[k] = self.min[k].min(value);
            self.max[k] = self.max[k].max(value);
            let band = &mut self.bands[k];
            band.histogram[((value * per_count) as usize).min(STATISTICS_BINS - 1)] += 1;
            band.coarse[ordered_bits(value) >> 16] += 1;
        }
    }

    fn merged_with(mut self, other: Self) -> Self {
        self.pixels += other.pixels;
        self.valid += other.valid;
        self.clipped += other.clipped;
        self.dark += other.dark;
        self.counted = self.counted.merged(&other.counted);
        self.columns = span(self.columns, other.columns);
        self.rows = span(self.rows, other.rows);
        for k in 0..3 {
            self.sum[k] += other.sum[k];
            self.min[k] = self.min[k].min(other.min[k]);
            self.max[k] = self.max[k].max(other.max[k]);
            add(&mut self.bands[k].histogram, &other.bands[k].histogram);
            add(&mut self.bands[k].coarse, &other.bands[k].coarse);
        }
        for (count, more) in self.owners.iter_mut().zip(other.owners) {
            *count += more;
        }
        self
    }
}

/// Bits of a value that is not negative, in the order of the values; −0 is 0.
#[inline]
fn ordered_bits(value: f32) -> usize {
    (value.to_bits() & (u32::MAX >> 1)) as usize
}

/// The bin that holds the value of a rank (from 0), and the rank of the value within the bin.
fn bin_of_rank(counts: impl Iterator<Item = u64>, rank: u64) -> (usize, u64) {
    let mut rest = rank;
    for (bin, count) in counts.enumerate() {
        if rest < count {
            return (bin, rest);
        }
        rest -= count;
    }
    (0, 0)
}

fn span(a: [usize; 2], b: [usize; 2]) -> [usize; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

fn add(counts: &mut [u32], more: &[u32]) {
    for (count, more) in counts.iter_mut().zip(more) {
        *count += more;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::RegionId;
    use crate::view::testing::tiny;

    #[test]
    fn the_figures_of_a_region_are_those_of_its_report() {
        let shown = tiny();
        let reflection = &shown.analysis.intrinsic.regions[0];
        let found = statistics_of(&shown, Item::Region(RegionId::from_index(0)), None).unwrap();
        assert_eq!(
            (found.pixels, found.owners.as_slice()),
            (reflection.pixels, [(1, reflection.pixels)].as_slice())
        );
        assert_eq!(found.clipped, reflection.clipped_pixels);
        assert!(statistics_of(&shown, Item::Region(RegionId::from_index(998)), None).is_none());
        let other = Mask::filled(1, 1, true);
        assert!(statistics(&shown, &other, None).is_none(), "a mask of another size");
    }

    #[test]
    fn counts_means_medians_and_extremes_are_those_of_the_sorted_values() {
        let shown = tiny();
        let (width, height) = shown.picture.size();
        for step in [1, 2, 7, width * height - 1] {
            let on = (0..width * height).map(|pixel| pixel % step == 0).collect();
            let mask = Mask::from_vec(width, height, on).unwrap();
            let found = statistics(&shown, &mask, None).unwrap();
            let pixels = &shown.picture.photo.image.pixels;
            let chosen: Vec<usize> = (0..pixels.len()).filter(|&pixel| mask[pixel]).collect();
            assert_eq!((found.pixels, found.valid), (chosen.len(), chosen.len()));
            for k in 0..3 {
                let mut values: Vec<f32> = chosen.iter().map(|&pixel| pixels[pixel][k]).collect();
                values.sort_by(f32::total_cmp);
                let band = &found.bands[k];
                let expected = (values[0], values[(values.len() - 1) / 2], values[values.len() - 1]);
                assert_eq!((band.min, band.median, band.max), expected);
                assert_eq!(band.histogram.iter().sum::<u32>() as usize, chosen.len());
                let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / values.len() as f64;
                assert!((found.mean[k] - mean).abs() < 1e-6);
            }
            assert_eq!(found.owners.iter().map(|r| r.1).sum::<usize>(), chosen.len());
            assert!(found.owners.is_sorted_by(|a, b| a.1 >= b.1));
            let masks = &shown.analysis.masks;
            assert_eq!(found.dark, chosen.iter().filter(|&&pixel| masks.dark(pixel)).count());
        }
    }

    #[test]
    fn statistics_of_a_window_have_its_class() {
        let shown = tiny();
        let windows = &shown.analysis.windows;
        for window in 0..windows.classes.len() {
            let found = statistics_of(&shown, Item::Window(window as u32), None).unwrap();
            let moments = &windows.moments[window];
            assert_eq!(found.counted, moments.n as usize);
            if windows.classes[window].is_some() {
                assert_eq!(found.class, windows.classes[window]);
            }
            let column = window % windows.classes.width() * windows.size_px;
            assert_eq!(found.bounds.left, column);
        }
    }

    #[test]
    fn a_rank_is_found_in_counted_bins_and_bits_keep_the_order() {
        assert_eq!(bin_of_rank([0u64, 2, 0, 3].into_iter(), 0), (1, 0));
        assert_eq!(bin_of_rank([0u64, 2, 0, 3].into_iter(), 2), (3, 0));
        assert_eq!(bin_of_rank([0u64, 2, 0, 3].into_iter(), 4), (3, 2));
        assert_eq!((ordered_bits(-0.0), f32::from_bits(ordered_bits(1.5) as u32)), (0, 1.5));
    }
}
