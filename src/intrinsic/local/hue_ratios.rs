//! Rule `local_split`: the ratio of mean to chromatic part that body reflection has, by place and hue.
//!
//! J = I / (√3 s) makes the light s white. a is the mean of J, c the length of the chromatic part of J, and the angle
//! of that part is the hue. Surface reflection adds to a alone. A histogram of ln(a/c) over (cells × hues), smoothed
//! over neighboring cells and hues, gives the ratio a/c of body reflection: κ, the 30 % quantile. Then m_s = max(a −
//! κc, 0), and m_b = κc. The difference of the median from κ is the variation of a/c without any highlight.
//!
//! Cells are 20 px wide (in pictures beyond a megapixel proportionally wider) and smoothed by 1.4 cells. There are 72 hues, of
//! which nearly all are empty in any one cell: only the others take time. Without the local split, printed scenes lose 8 dB
//! and more; with one κ for all hues of a cell 10 dB.

use super::linear_weights::linear_weights;
use crate::photo::Masks;
use crate::raster::Raster;
use crate::reflection::WhitenedColor;
use crate::segment::AnalysisInput;
use crate::trace::{LocalLimits, LocalPoint};
use rayon::prelude::*;

/// Side of a cell in pictures of up to [`MEGAPIXEL`], pixels.
const CELL_PX: f64 = 20.0;
/// Size of the picture from which on cells grow, pixels.
const MEGAPIXEL: f64 = 1e6;
/// Number of hues.
const HUES: usize = 72;
/// Number of bins of ln(a/c).
const BINS: usize = 40;
/// The least and the greatest a/c of the bins.
const RATIOS: (f32, f32) = LocalPoint::RATIOS;
/// Weights of the cells around a cell: a running mean of three, applied three times.
const CELL_WEIGHTS: [f32; 7] = [1.0, 3.0, 6.0, 7.0, 6.0, 3.0, 1.0];
/// Number of cells on each side that have a weight.
const CELL_REACH: usize = CELL_WEIGHTS.len() / 2;
/// Sum of the weights of all cells around a cell, and of a hue and its neighbors.
const TOTAL_WEIGHT: f32 = 27.0 * 27.0 * 4.0;
/// Share of the picture's mean histogram that is added to the histogram of each cell.
const PICTURE_SHARE: f32 = 0.2;
/// Quantile of a/c that is taken for body reflection.
const QUANTILE: f32 = 0.3;

/// ln κ and the logarithm of the median of a/c, by cell and hue.
pub struct HueRatios {
    cell_px: f32,
    /// Number of cells in a row, and number of rows of cells.
    columns: usize,
    rows: usize,
    /// The ratios, cell by cell and hue by hue; none where no pixel of the picture has the hue.
    of: Vec<Option<Ratio>>,
}

/// The ratios of one hue in one cell.
#[derive(Clone, Copy)]
struct Ratio {
    /// ln κ, and the logarithm of the median of a/c.
    logarithms: [f32; 2],
    /// Number of pixels, at most 1: how far the ratios of a cell with few pixels count.
    weight: f32,
}

impl HueRatios {
    /// The ratios of a picture, whose pixels have the `colors` under white light.
    pub fn new(input: &AnalysisInput, limits: &LocalLimits, colors: &Raster<WhitenedColor>) -> Self {
        let histogram = Histogram::new(input, limits, colors);
        let picture = histogram.mean();
        histogram.smoothed().ratios(&picture)
    }

    /// κ and the median of a/c at the pixel (x, y) for a hue in turns, interpolated between the nearest cells and hues;
    /// `None` where no counted pixel of the picture has the hue or a neighboring hue.
    pub fn at(&self, x: usize, y: usize, hue_turns: f32) -> Option<[f32; 2]> {
        let columns = linear_weights((x as f32 + 0.5) / self.cell_px, self.columns);
        let rows = linear_weights((y as f32 + 0.5) / self.cell_px, self.rows);
        let turned = hue_place(hue_turns) - 0.5 + HUES as f32;
        let (first, rest) = (turned as usize, turned.fract());
        let hues = [(first % HUES, 1.0 - rest), ((first + 1) % HUES, rest)];
        let (mut sums, mut total) = ([0.0f32; 2], 0.0f32);
        for (row, by_row) in rows {
            for (column, by_column) in columns {
                for (hue, by_hue) in hues {
                    if let Some(ratio) = self.of[(row * self.columns + column) * HUES + hue] {
                        let weight = by_row * by_column * by_hue * ratio.weight;
                        sums[0] += weight * ratio.logarithms[0];
                        sums[1] += weight * ratio.logarithms[1];
                        total += weight;
                    }
                }
            }
        }
        (total > 1e-6).then(|| sums.map(|sum| (sum / total).exp()))
    }
}

/// The place of a hue among [`HUES`], from 0 to less than [`HUES`].
fn hue_place(hue_turns: f32) -> f32 {
    (hue_turns * HUES as f32).min(HUES as f32 - 0.001)
}

/// The place of a color's ln(a/c) among [`BINS`], from 0 to less than [`BINS`].
fn bin_place(color: WhitenedColor) -> f32 {
    let (low, high) = (RATIOS.0.ln(), RATIOS.1.ln());
    let ratio = (color.mean / color.chroma).ln();
    ((ratio - low) / (high - low) * BINS as f32).clamp(0.0, BINS as f32 - 0.001)
}

/// Counts of pixels by cell, hue and bin of ln(a/c).
struct Histogram {
    cell_px: usize,
    columns: usize,
    /// The rows of cells, from the top.
    rows: Vec<HistogramRow>,
}

/// One row of cells. Only the hues that occur in a cell have counts.
struct HistogramRow {
    /// Place of the counts in `counts`, cell by cell and hue by hue; [`NO_COUNTS`] where the hue does not occur.
    place: Vec<u32>,
    counts: Vec<[f32; BINS]>,
}

const NO_COUNTS: u32 = u32::MAX;

impl HistogramRow {
    fn empty(columns: usize) -> Self {
        Self { place: vec![NO_COUNTS; columns * HUES], counts: Vec::new() }
    }

    fn get(&self, cell: usize, hue: usize) -> Option<&[f32; BINS]> {
        self.counts.get(self.place[cell * HUES + hue] as usize)
    }

    fn get_mut(&mut self, cell: usize, hue: usize) -> &mut [f32; BINS] {
        let place = &mut self.place[cell * HUES + hue];
        if *place == NO_COUNTS {
            *place = self.counts.len() as u32;
            self.counts.push([0.0; BINS]);
        }
        &mut self.counts[*place as usize]
    }

    /// Adds `weight` times the counts of `other_cell` of `other` to the counts of `cell`.
    fn add(&mut self, cell: usize, weight: f32, other: &Self, other_cell: usize) {
        for hue in 0..HUES {
            if let Some(counts) = other.get(other_cell, hue) {
                self.get_mut(cell, hue).iter_mut().zip(counts).for_each(|(sum, n)| *sum += weight * n);
            }
        }
    }
}

impl Histogram {
    /// Counts the pixels that have a hue, are not dark, and are neither clipped nor next to a clipped pixel.
    fn new(input: &AnalysisInput, limits: &LocalLimits, colors: &Raster<WhitenedColor>) -> Self {
        let (width, height) = (input.pixels.width(), input.pixels.height());
        let scale = ((width * height) as f64 / MEGAPIXEL).sqrt().max(1.0);
        let cell_px = (CELL_PX * scale).round() as usize;
        let columns = width.div_ceil(cell_px);
        // A pixel counts in the two nearest cells of a row, and in the two nearest rows of cells, by its distance.
        let shares = |at: usize, count: usize| linear_weights((at as f32 + 0.5) / cell_px as f32, count);
        let row_count = height.div_ceil(cell_px);
        let bins = counted_bins(input, limits, colors);
        let in_columns: Vec<[(usize, f32); 2]> = (0..width).map(|x| shares(x, columns)).collect();
        let counted = |row: usize| {
            let mut counts = HistogramRow::empty(columns);
            let first = (row * cell_px).saturating_sub(cell_px / 2 + 1);
            for y in first..((row + 1) * cell_px + cell_px / 2 + 1).min(height) {
                let by_row: f32 = shares(y, row_count)
                    .into_iter()
                    .filter(|share| share.0 == row)
                    .map(|share| share.1)
                    .sum();
                if by_row <= 0.0 {
                    continue;
                }
                let of_row = bins.row(y).iter().zip(&in_columns).filter(|(bin, _)| **bin != NOT_COUNTED);
                for (&bin, in_columns) in of_row {
                    let (hue, bin) = (usize::from(bin) / BINS, usize::from(bin) % BINS);
                    for &(cell, by_cell) in in_columns.iter().filter(|(_, by_cell)| *by_cell > 0.0) {
                        counts.get_mut(cell, hue)[bin] += by_row * by_cell;
                    }
                }
            }
            counts
        };
        let rows = (0..row_count).into_par_iter().map(counted).collect();
        Self { cell_px, columns, rows }
    }

    /// This histogram, smoothed over neighboring cells. Cells outside of the picture count nothing.
    fn smoothed(self) -> Self {
        let across = |row: &HistogramRow| {
            let mut sums = HistogramRow::empty(self.columns);
            for cell in 0..self.columns {
                for (near, weight) in (cell..).zip(CELL_WEIGHTS) {
                    if let Some(near) = near.checked_sub(CELL_REACH).filter(|&near| near < self.columns) {
                        sums.add(cell, weight, row, near);
                    }
                }
            }
            sums
        };
        let rows: Vec<HistogramRow> = self.rows.par_iter().map(across).collect();
        let down = |row: usize| {
            let mut sums = HistogramRow::empty(self.columns);
            for (near, weight) in (row..).zip(CELL_WEIGHTS) {
                if let Some(near) = near.checked_sub(CELL_REACH).and_then(|near| rows.get(near)) {
                    (0..self.columns).for_each(|cell| sums.add(cell, weight, near, cell));
                }
            }
            sums
        };
        let rows = (0..rows.len()).into_par_iter().map(down).collect();
        Self { rows, ..self }
    }

    /// The mean counts of all cells, by hue.
    fn mean(&self) -> Vec<[f32; BINS]> {
        let cells = (self.rows.len() * self.columns).max(1) as f32;
        let mut mean = vec![[0.0f32; BINS]; HUES];
        for row in &self.rows {
            for cell in 0..self.columns {
                for (hue, sum) in mean.iter_mut().enumerate() {
                    if let Some(counts) = row.get(cell, hue) {
                        sum.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count / cells);
                    }
                }
            }
        }
        mean
    }

    /// κ and the median of each hue of each cell, smoothed over neighboring hues. `picture`: the mean counts of all cells.
    fn ratios(&self, picture: &[[f32; BINS]]) -> HueRatios {
        let of_cell = |row: &HistogramRow, cell: usize, hue: usize| {
            let mut bins = [0.0f32; BINS];
            for (near, weight) in [hue + HUES - 1, hue, hue + 1].into_iter().zip([1.0, 2.0, 1.0]) {
                if let Some(counts) = row.get(cell, near % HUES) {
                    bins.iter_mut().zip(counts).for_each(|(sum, count)| *sum += weight * count);
                }
                let share = weight * PICTURE_SHARE * TOTAL_WEIGHT / 4.0;
                bins.iter_mut().zip(&picture[near % HUES]).for_each(|(sum, count)| *sum += share * count);
            }
            let total: f32 = bins.iter().sum();
            (total > 0.0).then(|| Ratio {
                logarithms: [QUANTILE, 0.5].map(|share| quantile(&bins, share * total)),
                weight: (total / TOTAL_WEIGHT).min(1.0),
            })
        };
        let of_row = |row: &HistogramRow| -> Vec<_> {
            let cells = (0..self.columns).flat_map(|cell| (0..HUES).map(move |hue| (cell, hue)));
            cells.map(|(cell, hue)| of_cell(row, cell, hue)).collect()
        };
        let of = self.rows.par_iter().flat_map_iter(of_row).collect();
        HueRatios { cell_px: self.cell_px as f32, columns: self.columns, rows: self.rows.len(), of }
    }
}

/// Of a pixel that is not counted.
const NOT_COUNTED: u16 = u16::MAX;

/// The hue and the bin of ln(a/c) in which each pixel is counted, hue by hue; [`NOT_COUNTED`] for other pixels.
fn counted_bins(input: &AnalysisInput, limits: &LocalLimits, colors: &Raster<WhitenedColor>) -> Raster<u16> {
    let (width, height) = (input.pixels.width(), input.pixels.height());
    let near_clipped = NearClipped { masks: input.masks, width, height };
    let mut bins = Raster::filled(width, height, NOT_COUNTED);
    bins.as_mut_slice().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, (counted, &color)) in row.iter_mut().zip(colors.row(y)).enumerate() {
            let pixel = y * width + x;
            if input.masks.dark(pixel) || near_clipped.at(x, y) {
                continue;
            }
            if limits.has_hue(color) {
                let (hue, bin) = (hue_place(color.hue_turns) as usize, bin_place(color) as usize);
                *counted = (hue * BINS + bin) as u16;
            }
        }
    });
    bins
}

/// Which pixels are clipped, or next to a clipped pixel.
struct NearClipped<'a> {
    masks: &'a Masks,
    width: usize,
    height: usize,
}

impl NearClipped<'_> {
    fn at(&self, x: usize, y: usize) -> bool {
        let rows = y.saturating_sub(1)..(y + 2).min(self.height);
        rows.into_iter().any(|v| {
            (x.saturating_sub(1)..(x + 2).min(self.width)).any(|u| self.masks.clipped(v * self.width + u))
        })
    }
}

/// The ln(a/c) below which `wanted` of the counts lie.
fn quantile(bins: &[f32; BINS], wanted: f32) -> f32 {
    let (low, high) = (RATIOS.0.ln(), RATIOS.1.ln());
    let mut below = 0.0;
    for (bin, &count) in bins.iter().enumerate() {
        if count > 0.0 && below + count >= wanted {
            let place = bin as f32 + (wanted - below) / count;
            return low + place * (high - low) / BINS as f32;
        }
        below += count;
    }
    high
}
