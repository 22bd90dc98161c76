//! The colors of a photograph in 64³ bins, the pixels of each bin, and the bin of each pixel.

use crate::photo::LinearImage;
use crate::raster::{LabelMap, Mask};
use crate::segment::Windows;
use crate::trace::Class;
use rayon::prelude::*;

/// Bins along each band.
pub const BINS_PER_BAND: usize = 64;

const CELLS: usize = BINS_PER_BAND.pow(3);
/// Levels of a band within a bin: the error of a mean is at most half a level, 1/512 of a bin.
const LEVELS: f32 = 256.0;
/// Levels of a band within a bin that [`Histogram::unique`] distinguishes: 1024 in all, more than 8-bit files have.
const UNIQUE_LEVELS: usize = 16;
/// Fewest items of a parallel task, so that starting a task costs little in comparison.
const PIXELS_PER_TASK: usize = 1 << 16;
/// Largest number of counters that are kept at once; where more would be needed, pixels are sorted instead.
const MOST_COUNTERS: usize = 1 << 22;

/// The colors of a photograph, binned; only bins that hold pixels are kept.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// Counts that the bins of each band span, from 0; brighter colors are in the last bin.
    pub full_counts: f32,
    /// The bins, in the order of their place in the cube.
    pub bins: Vec<ColorBin>,
    /// Cell of the cube that each pixel is in.
    of_pixel: Vec<u32>,
    /// Bin of each cell; for a cell without pixels, a number that is no bin.
    of_cell: Vec<u32>,
}

/// One bin that holds pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorBin {
    /// Mean color of the pixels, linear counts, exact to 1/512 of the bin.
    pub mean: [f32; 3],
    /// Number of pixels.
    pub count: u32,
    /// Place of the bin in the cube.
    cell: u32,
}

/// A color that some pixels have, to 10 bits a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniqueColor {
    /// The color, linear counts.
    pub color: [f32; 3],
    /// Number of pixels of this color.
    pub count: u32,
    /// The bin of the color.
    pub bin: u32,
}

/// The pixels of a cell: their number, and the sums of their levels above the corner of the cell.
#[derive(Clone, Copy, Default)]
struct Cell {
    count: u32,
    levels: [u32; 3],
}

impl Histogram {
    /// Bins the colors of `image`.
    pub fn of(image: &LinearImage) -> Self {
        let colors = image.pixels.as_slice();
        let full_counts = image.saturation.unwrap_or(0.0).max(brightest(colors)).max(1.0);
        let scale = Scale::new(full_counts);
        let mut of_pixel = vec![0u32; colors.len()];
        // Whole numbers add up to the same in any order.
        let length = colors.len().div_ceil(rayon::current_num_threads()).clamp(PIXELS_PER_TASK, 1 << 23);
        let parts = of_pixel.par_chunks_mut(length).zip(colors.par_chunks(length)).map(|(cells, colors)| {
            let mut counts = vec![Cell::default(); CELLS];
            for (cell, &color) in cells.iter_mut().zip(colors) {
                let (place, levels) = scale.place(color);
                *cell = place;
                let counts = &mut counts[place as usize];
                counts.count += 1;
                for (sum, level) in counts.levels.iter_mut().zip(levels) {
                    *sum += level;
                }
            }
            counts
        });
        let parts: Vec<Vec<Cell>> = parts.collect();
        let mut of_cell = vec![u32::MAX; CELLS];
        let mut bins = Vec::new();
        for (cell, number) in of_cell.iter_mut().enumerate() {
            let count: u32 = parts.iter().map(|part| part[cell].count).sum();
            if count == 0 {
                continue;
            }
            let levels =
                |band: usize| parts.iter().map(|part| u64::from(part[cell].levels[band])).sum::<u64>();
            let corner = corner(cell);
            let mean = std::array::from_fn(|band| {
                let inside = (levels(band) as f64 / f64::from(count) + 0.5) / f64::from(LEVELS);
                ((corner[band] as f64 + inside) / f64::from(scale.per_count)) as f32
            });
            *number = bins.len() as u32;
            bins.push(ColorBin { mean, count, cell: cell as u32 });
        }
        Self { full_counts, bins, of_pixel, of_cell }
    }

    /// The bin that a pixel is in.
    pub fn bin_of(&self, pixel: usize) -> Option<u32> {
        self.of_pixel.get(pixel).map(|&cell| self.of_cell[cell as usize])
    }

    /// The bin that holds a color of linear counts; none where the bin would hold no pixel.
    pub fn bin_at(&self, color: [f32; 3]) -> Option<u32> {
        let (cell, _) = Scale::new(self.full_counts).place(color);
        self.of_cell.get(cell as usize).copied().filter(|&bin| bin != u32::MAX)
    }

    /// The pixels of a bin, in row order; none where there is no such bin. Takes one pass over all pixels.
    pub fn pixels_of(&self, bin: u32) -> Vec<u32> {
        let Some(bin) = self.bins.get(bin as usize) else { return Vec::new() };
        let cells = self.of_pixel.par_iter().with_min_len(PIXELS_PER_TASK).enumerate();
        cells.filter(|(_, cell)| **cell == bin.cell).map(|(pixel, _)| pixel as u32).collect()
    }

    /// The pixels of several bins, ascending; bins that do not exist have none.
    pub fn pixels_of_all(&self, bins: &[u32]) -> Vec<u32> {
        let mut is_wanted = vec![false; CELLS];
        for bin in bins.iter().filter_map(|&bin| self.bins.get(bin as usize)) {
            is_wanted[bin.cell as usize] = true;
        }
        let cells = self.of_pixel.par_iter().with_min_len(PIXELS_PER_TASK).enumerate();
        cells.filter(|(_, cell)| is_wanted[**cell as usize]).map(|(pixel, _)| pixel as u32).collect()
    }

    /// Number of pixels of a mask in each bin; 0 for all bins where the mask is of another size.
    pub fn bins_of(&self, mask: &Mask) -> Vec<u32> {
        let mut counts = vec![0; CELLS];
        if mask.len() == self.of_pixel.len() {
            for (&cell, _) in self.of_pixel.iter().zip(mask.as_slice()).filter(|(_, on)| **on) {
                counts[cell as usize] += 1;
            }
        }
        self.bins.iter().map(|bin| counts[bin.cell as usize]).collect()
    }

    /// The label of most pixels of each bin, of equals the smallest; 0 for all bins where the map is of another size.
    pub fn majority(&self, labels: &LabelMap) -> Vec<u16> {
        if labels.len() != self.of_pixel.len() {
            return vec![0; self.bins.len()];
        }
        let labels = labels.as_slice();
        let largest = labels.par_iter().with_min_len(PIXELS_PER_TASK).copied().max().unwrap_or(0);
        self.majority_of(usize::from(largest) + 1, |pixel| labels[pixel])
    }

    /// The class of the windows of most pixels of each bin; none where most have no class. `width` is the width of
    /// the picture, pixels.
    pub fn majority_class(&self, windows: &Windows, width: usize) -> Vec<Option<Class>> {
        const CLASSES: [Class; 4] = [Class::Point, Class::Line, Class::Plane, Class::Volume];
        let number = |class: &Option<Class>| class.map_or(0, |class| class as u16 + 1);
        let of_window: Vec<u16> = windows.classes.as_slice().iter().map(number).collect();
        let height = self.of_pixel.len() / width.max(1);
        let (columns, size_px) = (windows.classes.width(), windows.size_px);
        if (columns, windows.classes.height()) != (width.div_ceil(size_px), height.div_ceil(size_px)) {
            return vec![None; self.bins.len()];
        }
        let most = self.majority_of(5, |pixel| of_window[windows.window_of(pixel, width)]);
        most.into_iter().map(|number| usize::from(number).checked_sub(1).map(|i| CLASSES[i])).collect()
    }

    /// For each bin the number of most of its pixels; all numbers are below `numbers`.
    fn majority_of(&self, numbers: usize, number: impl Fn(usize) -> u16 + Sync) -> Vec<u16> {
        if self.bins.len() * numbers > MOST_COUNTERS {
            return self.majority_by_sorting(number);
        }
        let tasks = if self.of_pixel.len() < 4 * PIXELS_PER_TASK { 1 } else { rayon::current_num_threads() };
        let length = self.of_pixel.len().div_ceil(tasks).max(1);
        let counted = self.of_pixel.par_chunks(length).enumerate().map(|(part, cells)| {
            let mut counts = vec![0u32; self.bins.len() * numbers];
            for (pixel, &cell) in (part * length..).zip(cells) {
                counts[self.of_cell[cell as usize] as usize * numbers + usize::from(number(pixel))] += 1;
            }
            counts
        });
        let sum = |mut a: Vec<u32>, b: Vec<u32>| {
            for (a, b) in a.iter_mut().zip(b) {
                *a += b;
            }
            a
        };
        let counts = counted.reduce_with(sum).unwrap_or_default();
        let most =
            |counts: &[u32]| (0..counts.len()).rev().max_by_key(|&number| counts[number]).unwrap_or(0) as u16;
        counts.chunks_exact(numbers).map(most).collect()
    }

    fn majority_by_sorting(&self, number: impl Fn(usize) -> u16 + Sync) -> Vec<u16> {
        let cells = self.of_pixel.par_iter().with_min_len(PIXELS_PER_TASK).enumerate();
        let mut pairs: Vec<u64> = cells
            .map(|(pixel, &cell)| u64::from(self.of_cell[cell as usize]) << 16 | u64::from(number(pixel)))
            .collect();
        pairs.par_sort_unstable();
        let mut most = vec![(0usize, 0u16); self.bins.len()];
        for run in pairs.chunk_by(|a, b| a == b) {
            let (bin, number) = ((run[0] >> 16) as usize, (run[0] & 0xffff) as u16);
            if run.len() > most[bin].0 {
                most[bin] = (run.len(), number);
            }
        }
        most.into_iter().map(|(_, number)| number).collect()
    }

    /// The colors of `image`, which is the image of the histogram, to 10 bits a band, in the order of their bins.
    /// Sorts all pixels.
    pub fn unique(&self, image: &LinearImage) -> Vec<UniqueColor> {
        let colors = image.pixels.as_slice();
        if colors.len() != self.of_pixel.len() {
            return Vec::new();
        }
        let scale = Scale::new(self.full_counts);
        let key = |(&color, &cell): (&[f32; 3], &u32)| {
            let (_, levels) = scale.place(color);
            let [r, g, b] = levels.map(|level| level as usize * UNIQUE_LEVELS / LEVELS as usize);
            cell << 12 | ((r * UNIQUE_LEVELS + g) * UNIQUE_LEVELS + b) as u32
        };
        let pairs = colors.par_iter().zip(&self.of_pixel).with_min_len(PIXELS_PER_TASK);
        let mut keys: Vec<u32> = pairs.map(key).collect();
        keys.par_sort_unstable();
        let runs = keys.chunk_by(|a, b| a == b);
        runs.map(|run| {
            let (cell, levels) = ((run[0] >> 12) as usize, run[0] as usize & 0xfff);
            let inside = [levels >> 8, levels >> 4 & 15, levels & 15];
            let corner = corner(cell);
            let color = std::array::from_fn(|band| {
                let share = (inside[band] as f32 + 0.5) / UNIQUE_LEVELS as f32;
                (corner[band] as f32 + share) / scale.per_count
            });
            UniqueColor { color, count: run.len() as u32, bin: self.of_cell[cell] }
        })
        .collect()
    }
}

/// The grid of cells in the color cube.
#[derive(Clone, Copy)]
struct Scale {
    /// Cells per count.
    per_count: f32,
}

impl Scale {
    fn new(full_counts: f32) -> Self {
        Self { per_count: BINS_PER_BAND as f32 / full_counts }
    }

    /// The cell of a color, and the level of each band in it.
    #[inline]
    fn place(self, color: [f32; 3]) -> (u32, [u32; 3]) {
        let most = (BINS_PER_BAND * LEVELS as usize - 1) as u32;
        let [r, g, b] = color.map(|v| ((v * (self.per_count * LEVELS)) as u32).min(most));
        let levels = LEVELS as u32;
        let bins = BINS_PER_BAND as u32;
        let cell = ((r / levels) * bins + g / levels) * bins + b / levels;
        (cell, [r % levels, g % levels, b % levels])
    }
}

/// Bins below a cell along each band.
fn corner(cell: usize) -> [usize; 3] {
    [cell / BINS_PER_BAND / BINS_PER_BAND, cell / BINS_PER_BAND % BINS_PER_BAND, cell % BINS_PER_BAND]
}

/// The largest value of any band, counts; 0 without pixels. No band is negative, so that the order of the bits is the
/// order of the values.
fn brightest(colors: &[[f32; 3]]) -> f32 {
    let largest = |values: &[f32]| values.iter().fold(0i32, |most, v| most.max(v.to_bits() as i32));
    let parts = colors.as_flattened().par_chunks(3 * PIXELS_PER_TASK).map(largest);
    f32::from_bits(parts.max().unwrap_or(0) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    fn image(colors: Vec<[f32; 3]>) -> LinearImage {
        LinearImage::new(Raster::from_vec(colors.len(), 1, colors).unwrap(), Some(255.0))
    }

    #[test]
    fn colors_lie_in_their_bins_and_bins_know_their_pixels() {
        let picture = image(vec![[255.0, 0.0, 3.9], [0.0; 3], [255.0, 0.0, 0.1], [128.0, 64.0, 32.0]]);
        let histogram = Histogram::of(&picture);
        assert_eq!(histogram.bins.len(), 3);
        let counts: Vec<u32> = histogram.bins.iter().map(|bin| bin.count).collect();
        assert_eq!(counts, [1, 1, 2]);
        assert_eq!(histogram.pixels_of(2), [0, 2]);
        assert_eq!((histogram.bin_of(3), histogram.bin_of(4)), (Some(1), None));
        assert!((histogram.bins[2].mean[2] - 2.0).abs() < 0.01, "{:?}", histogram.bins[2]);
        assert_eq!((histogram.bin_at([254.0, 1.0, 1.0]), histogram.bin_at([9.0; 3])), (Some(2), None));
        assert!(histogram.pixels_of(3).is_empty());
        let mask = Raster::from_vec(4, 1, vec![true, true, false, false]).unwrap();
        assert_eq!(histogram.bins_of(&mask), [1, 0, 1]);
    }

    #[test]
    fn the_brightest_color_widens_the_cube_and_no_picture_has_no_bins() {
        let bright = LinearImage::new(Raster::filled(1, 1, [2.0, 900.0, 3.0]), Some(255.0));
        assert!((Histogram::of(&bright).full_counts - 900.0).abs() < 1e-6);
        let nothing = Histogram::of(&LinearImage::new(Raster::filled(0, 0, [0.0; 3]), None));
        assert!(nothing.bins.is_empty() && nothing.majority(&LabelMap::default()).is_empty());
        assert!((nothing.full_counts - 1.0).abs() < 1e-6);
    }

    #[test]
    fn windows_give_their_class_to_the_bins_of_their_pixels() {
        let picture = Raster::from_vec(4, 1, vec![[9.0; 3], [9.0; 3], [99.0; 3], [9.0; 3]]).unwrap();
        let histogram = Histogram::of(&LinearImage::new(picture, Some(255.0)));
        let classes = Raster::from_vec(2, 1, vec![Some(Class::Line), Some(Class::Plane)]).unwrap();
        let windows =
            Windows { size_px: 2, moments: Raster::filled(2, 1, crate::color::Moments::default()), classes };
        assert_eq!(histogram.majority_class(&windows, 4), [Some(Class::Line), Some(Class::Plane)]);
        assert_eq!(histogram.majority_class(&windows, 2), [None; 2], "another picture's windows");
    }

    fn colors() -> impl Strategy<Value = Vec<[f32; 3]>> {
        // Few colors, so that bins hold many pixels.
        let band = || (0u16..40).prop_map(|level| f32::from(level) * 6.5);
        prop::collection::vec((band(), 40f32..60.0, 40f32..50.0).prop_map(|(r, g, b)| [r, g, b]), 1..300)
    }

    proptest! {
        #[test]
        fn every_number_is_what_looking_at_every_pixel_says(
            colors in colors(), seed in prop::collection::vec(0u16..5, 300),
        ) {
            let picture = image(colors.clone());
            let histogram = Histogram::of(&picture);
            let labels = Raster::from_vec(colors.len(), 1, seed[..colors.len()].to_vec()).unwrap();
            let majority = histogram.majority(&labels);
            prop_assert_eq!(&majority, &histogram.majority_by_sorting(|pixel| labels[pixel]));
            prop_assert_eq!(histogram.bins.iter().map(|bin| bin.count as usize).sum::<usize>(), colors.len());
            for (bin, found) in histogram.bins.iter().enumerate() {
                let pixels = histogram.pixels_of(bin as u32);
                prop_assert_eq!(pixels.len(), found.count as usize);
                prop_assert!(pixels.iter().all(|&pixel| histogram.bin_of(pixel as usize) == Some(bin as u32)));
                prop_assert_eq!(histogram.bin_at(found.mean), Some(bin as u32));
                for (band, mean) in found.mean.iter().enumerate() {
                    let sum: f32 = pixels.iter().map(|&pixel| colors[pixel as usize][band]).sum();
                    prop_assert!((sum / pixels.len() as f32 - mean).abs() < 0.01);
                }
                let mut votes: BTreeMap<u16, usize> = BTreeMap::new();
                for &pixel in &pixels {
                    *votes.entry(labels[pixel as usize]).or_default() += 1;
                }
                prop_assert_eq!(votes[&majority[bin]], *votes.values().max().unwrap());
            }
        }

        #[test]
        fn unique_colors_are_those_of_the_picture(colors in colors()) {
            let picture = image(colors.clone());
            let histogram = Histogram::of(&picture);
            let unique = histogram.unique(&picture);
            prop_assert_eq!(unique.iter().map(|color| color.count as usize).sum::<usize>(), colors.len());
            for found in &unique {
                prop_assert_eq!(histogram.bin_at(found.color), Some(found.bin));
                // 1024 levels of 255 counts.
                let level = |v: f32| (v * (64.0 / 255.0 * 256.0)) as u32 / 16;
                let near = colors.iter().filter(|c| (0..3).all(|k| level(c[k]) == level(found.color[k])));
                prop_assert_eq!(near.count(), found.count as usize);
            }
        }
    }
}
