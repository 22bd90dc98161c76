//! The contrast curve of a camera, found from the regions (beyond the paper).
//!
//! A dichromatic plane passes through black and is flat in linear light alone. A camera's contrast curve ([`ContrastCurve`])
//! that was not undone bends all planes of a picture alike. For each contrast of the curve the colors of every region are brought back
//! to linear light, and a plane through black is fitted to them. The contrast under which the colors lie nearest to their planes, in
//! errors of the file's values, is that of the camera. Its error is found by leaving out each region (jackknife).

use super::Analysis;
use crate::color::{ContrastCurve, Vec3, linear_from_srgb, principal_axes, srgb_from_linear};
use crate::photo::EncodingChoice;
use crate::raster::{LabelMap, RegionId};
use nalgebra::Matrix3;
use rayon::prelude::*;

/// Contrasts that are tried, equally spaced.
const CONTRASTS: [f64; CONTRAST_COUNT] = [0.7, 0.85, 1.0, 1.15, 1.3, 1.45, 1.6, 1.75, 1.9];
const CONTRAST_COUNT: usize = 9;
const CONTRAST_STEP: f64 = 0.15;
/// Fewest usable pixels of a region that counts.
const LEAST_PIXELS: usize = 300;
/// Most pixels of a region that are looked at, evenly spread over the region.
const MOST_PIXELS: usize = 1000;
/// Most regions that are looked at, the largest.
const MOST_REGIONS: usize = 12;
/// Coded values of the largest band between which a pixel is used: darker ones are noise, brighter ones may be clipped in part.
const USED_CODES: std::ops::Range<f64> = 0.1..0.93;
/// Passes of the reweighted fit of a plane.
const FIT_PASSES: usize = 3;
/// Squared distance, as a multiple of the usual one, from which on a pixel counts no more.
const FAR: f64 = 9.0;
/// Median of the χ² distribution with one degree of freedom.
const MEDIAN_CHI_SQUARE: f64 = 0.455;
/// Largest logarithm of the ratio of two misfits that a region can contribute.
const MOST_GAIN: f64 = 0.3;
/// Fewest regions, least gain, largest standard deviation and least change of a contrast that is told.
const LEAST_REGIONS: usize = 3;
const LEAST_GAIN: f64 = 0.1;
const MOST_SD: f64 = 0.08;
const LEAST_CHANGE: f64 = 0.1;
/// Cells of the table of linear light over the coded values.
const CELLS: usize = 1024;

/// The contrast curve that explains the regions better than the curve with which the file was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContrastFinding {
    /// Contrast of the curve, see [`ContrastCurve`].
    pub contrast: f64,
    /// Standard deviation of the contrast by leaving out each region.
    pub sd: f64,
    /// Contrast with which the file was read.
    pub read_with: f64,
    /// Number of regions whose planes tell of it.
    pub regions: usize,
}

impl ContrastFinding {
    /// The encoding that undoes the curve, with two decimals of its contrast.
    pub fn encoding(&self) -> EncodingChoice {
        EncodingChoice::of_contrast((100.0 * self.contrast).round() / 100.0)
    }
}

/// The contrast curve of the camera, where the regions of `analysis` tell clearly that it is not the one with which the file was read.
/// `curve`: that one. `white`: counts of the coded value 1.
pub(super) fn contrast_finding(
    analysis: &Analysis,
    curve: ContrastCurve,
    white: f32,
) -> Option<ContrastFinding> {
    let regions = codes_of_regions(analysis, curve, white);
    if regions.len() < LEAST_REGIONS {
        return None;
    }
    let read_with = curve.contrast();
    let tables = CONTRASTS.map(LinearTable::new);
    let evidence: Vec<_> = regions.par_iter().map(|codes| Evidence::of(codes, &tables)).collect();
    let Best { contrast, gain } = Best::of(evidence.iter(), read_with);
    let without = |left_out: usize| {
        let others = evidence.iter().enumerate().filter(|(index, _)| *index != left_out);
        Best::of(others.map(|(_, evidence)| evidence), read_with).contrast
    };
    let sd = jackknife_sd(&(0..evidence.len()).map(without).collect::<Vec<_>>());
    let change = (contrast - read_with).abs();
    // The end of the range is no minimum: such colors bend in another way.
    let is_minimum = CONTRASTS[0] < contrast && contrast < CONTRASTS[CONTRAST_COUNT - 1];
    let is_clear = gain >= LEAST_GAIN && sd <= MOST_SD && change >= LEAST_CHANGE && change > 2.0 * sd;
    (is_minimum && is_clear).then_some(ContrastFinding { contrast, sd, read_with, regions: evidence.len() })
}

/// Coded values of three bands, as the file has them, 0…1.
type Codes = [f64; 3];

/// The coded values of usable pixels of each large region with a plane.
fn codes_of_regions(analysis: &Analysis, curve: ContrastCurve, white: f32) -> Vec<Vec<Codes>> {
    let (image, masks, labels) =
        (&analysis.working.image, &analysis.working.masks, &analysis.working_finals.labels);
    let code = |counts: f32| curve.apply(f64::from(srgb_from_linear((counts / white).max(0.0))));
    let codes = |pixel: usize| image.pixels[pixel].map(code);
    let is_usable = |pixel: &usize| {
        !masks.dark(*pixel) && !masks.clipped(*pixel) && {
            let [red, green, blue] = image.pixels[*pixel];
            USED_CODES.contains(&code(red.max(green).max(blue)))
        }
    };
    let planes = analysis.intrinsic.regions.iter().filter(|region| region.plane_normal.is_some());
    let mut pixels = pixels_of_regions(labels, planes.map(|region| region.id));
    pixels.par_iter_mut().for_each(|pixels| pixels.retain(is_usable));
    pixels.retain(|pixels| pixels.len() >= LEAST_PIXELS);
    pixels.sort_by_key(|pixels| std::cmp::Reverse(pixels.len()));
    pixels.truncate(MOST_REGIONS);
    let spread = |pixels: &Vec<usize>| {
        let used = pixels.len().min(MOST_PIXELS);
        (0..used).map(|index| codes(pixels[index * pixels.len() / used])).collect()
    };
    pixels.iter().map(spread).collect()
}

/// The pixels of each of the regions `wanted`.
fn pixels_of_regions(labels: &LabelMap, wanted: impl Iterator<Item = RegionId>) -> Vec<Vec<usize>> {
    let mut place_of_label = Vec::new();
    let mut count = 0;
    for id in wanted {
        let label = id.index() + 1;
        place_of_label.resize(place_of_label.len().max(label + 1), None);
        place_of_label[label] = Some(count);
        count += 1;
    }
    let mut pixels = vec![Vec::new(); count];
    for (pixel, &label) in labels.as_slice().iter().enumerate() {
        if let Some(&Some(place)) = place_of_label.get(usize::from(label)) {
            pixels[place].push(pixel);
        }
    }
    pixels
}

/// Linear light of coded values under one contrast curve, white = 1, and its slope.
struct LinearTable {
    /// Linear light and slope at equally spaced coded values.
    cells: Vec<[f64; 2]>,
}

impl LinearTable {
    fn new(contrast: f64) -> Self {
        let curve = ContrastCurve::new(contrast);
        let linear = |step: usize| linear_from_srgb(curve.undo(step as f64 / CELLS as f64));
        let values: Vec<f64> = (0..=CELLS).map(linear).collect();
        let cell = |step: usize| {
            let (below, above) = (step.saturating_sub(1), (step + 1).min(CELLS));
            [values[step], (values[above] - values[below]) * CELLS as f64 / (above - below) as f64]
        };
        Self { cells: (0..=CELLS).map(cell).collect() }
    }

    /// Linear light of a coded value, and its slope.
    fn at(&self, code: f64) -> [f64; 2] {
        let position = code.clamp(0.0, 1.0) * CELLS as f64;
        let below = (position as usize).min(CELLS - 1);
        let share = position - below as f64;
        let [low, high] = [self.cells[below], self.cells[below + 1]];
        std::array::from_fn(|part| low[part] + share * (high[part] - low[part]))
    }
}

/// What one region tells of each contrast.
struct Evidence {
    /// Logarithm of the misfit over the least one of all contrasts, at most [`MOST_GAIN`].
    misfits: [f64; CONTRAST_COUNT],
    weight: f64,
}

impl Evidence {
    fn of(codes: &[Codes], tables: &[LinearTable; CONTRAST_COUNT]) -> Self {
        let misfits = tables.each_ref().map(|table| misfit(codes, table).max(f64::MIN_POSITIVE).ln());
        let least = misfits.iter().copied().fold(f64::INFINITY, f64::min);
        Self {
            misfits: misfits.map(|misfit| (misfit - least).min(MOST_GAIN)),
            weight: (codes.len() as f64).sqrt(),
        }
    }
}

/// Mean squared distance of colors from a plane through black that is fitted to them, in squared errors of one coded value; far colors count
/// alike.
fn misfit(codes: &[Codes], table: &LinearTable) -> f64 {
    let points: Vec<(Vec3, Vec3)> = codes
        .iter()
        .map(|codes| {
            let [red, green, blue] = codes.map(|code| table.at(code));
            let variance = |slope: f64| slope * slope;
            (
                Vec3::new(red[0], green[0], blue[0]),
                Vec3::new(variance(red[1]), variance(green[1]), variance(blue[1])),
            )
        })
        .collect();
    let mut weights: Vec<f64> = points.iter().map(|(_, variance)| 3.0 / variance.sum()).collect();
    let mut squares = vec![0.0; points.len()];
    let mut usual = 0.0;
    for _ in 0..FIT_PASSES {
        let mut moments = Matrix3::zeros();
        for ((color, _), weight) in points.iter().zip(&weights) {
            moments += color * color.transpose() * *weight;
        }
        let normal = principal_axes(&moments).1[2];
        let normal_squared = normal.component_mul(&normal);
        for (((color, variance), weight), square) in points.iter().zip(&mut weights).zip(&mut squares) {
            let explained = normal_squared.dot(variance).max(f64::MIN_POSITIVE);
            *square = color.dot(&normal).powi(2) / explained;
            *weight = 1.0 / explained;
        }
        usual = median(&squares) / MEDIAN_CHI_SQUARE;
        for (weight, square) in weights.iter_mut().zip(&squares) {
            *weight /= 1.0 + square / (FAR * usual).max(f64::MIN_POSITIVE);
        }
    }
    squares.iter().map(|square| square.min(FAR * usual)).sum::<f64>() / squares.len().max(1) as f64
}

/// Median of values; 0 of none.
fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    let middle = sorted.len() / 2;
    if sorted.is_empty() { 0.0 } else { *sorted.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// The contrast with the least misfit.
struct Best {
    contrast: f64,
    /// How much larger the logarithm of the misfit is under the curve with which the file was read.
    gain: f64,
}

impl Best {
    fn of<'a>(evidence: impl Iterator<Item = &'a Evidence>, read_with: f64) -> Self {
        let (mut sums, mut total) = ([0.0; CONTRAST_COUNT], 0.0);
        for Evidence { misfits, weight } in evidence {
            sums.iter_mut().zip(misfits).for_each(|(sum, misfit)| *sum += weight * misfit);
            total += weight;
        }
        let means = sums.map(|sum| sum / f64::max(total, f64::MIN_POSITIVE));
        let best = (0..CONTRAST_COUNT).min_by(|&a, &b| means[a].total_cmp(&means[b])).unwrap_or(0);
        let mut contrast = CONTRASTS[best];
        if let [below, least, above] = means[best.saturating_sub(1)..CONTRAST_COUNT.min(best + 2)] {
            // The vertex of the parabola through the three means.
            let bend = below - 2.0 * least + above;
            if bend > 0.0 {
                contrast += CONTRAST_STEP * 0.5 * (below - above) / bend;
            }
        }
        let position = ((read_with - CONTRASTS[0]) / CONTRAST_STEP).clamp(0.0, (CONTRAST_COUNT - 1) as f64);
        let below = (position as usize).min(CONTRAST_COUNT - 2);
        let share = position - below as f64;
        let read = means[below] + share * (means[below + 1] - means[below]);
        Self { contrast, gain: read - means[best] }
    }
}

/// Standard deviation of an estimate by its values when each part of the data is left out in turn.
fn jackknife_sd(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    ((count - 1.0) / count * values.iter().map(|value| (value - mean).powi(2)).sum::<f64>()).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The coded values of colors m_b·body + m_s·(white light) after a contrast curve, a highlight in every fourth.
    fn coded_plane(body: [f64; 3], contrast: f64) -> Vec<Codes> {
        let curve = ContrastCurve::new(contrast);
        let color = |index: usize| {
            let shade = 0.08 + 0.6 * (index % 37) as f64 / 36.0;
            let highlight = if index.is_multiple_of(4) { 0.3 * (index % 53) as f64 / 52.0 } else { 0.0 };
            body.map(|band| {
                let linear = (shade * band + highlight * shade) as f32;
                curve.apply(f64::from(srgb_from_linear(linear)))
            })
        };
        (0..800).map(color).collect()
    }

    fn best(contrast: f64, read_with: f64, bodies: &[[f64; 3]]) -> Best {
        let tables = CONTRASTS.map(LinearTable::new);
        let evidence: Vec<_> =
            bodies.iter().map(|&body| Evidence::of(&coded_plane(body, contrast), &tables)).collect();
        Best::of(evidence.iter(), read_with)
    }

    proptest! {
        #[test]
        fn the_contrast_of_the_curve_is_found_from_planes_through_black(contrast in 0.8f64..1.7) {
            let bodies = [[0.9, 0.3, 0.2], [0.2, 0.7, 0.3], [0.25, 0.35, 0.9]];
            let found = best(contrast, 1.0, &bodies);
            // Without noise the nearest contrast that is tried wins: half a step, and what rounding adds.
            prop_assert!((found.contrast - contrast).abs() < 0.55 * CONTRAST_STEP, "{} instead of {contrast}", found.contrast);
            prop_assert!(found.gain >= 0.0);
        }
    }

    #[test]
    fn nothing_is_gained_over_the_curve_with_which_the_file_was_read() {
        let bodies = [[0.9, 0.3, 0.2], [0.2, 0.7, 0.3]];
        assert!(best(1.3, 1.3, &bodies).gain < 1e-9);
        assert!(best(1.3, 1.0, &bodies).gain > LEAST_GAIN);
    }

    #[test]
    fn a_plane_through_black_has_no_misfit_and_the_spread_of_equal_values_is_nothing() {
        let straight = LinearTable::new(1.0);
        assert!(misfit(&coded_plane([0.9, 0.3, 0.2], 1.0), &straight) < 1e-8);
        assert!(misfit(&coded_plane([0.9, 0.3, 0.2], 1.3), &straight) > 1e-6);
        assert!(jackknife_sd(&[0.5; 4]) < 1e-12);
        // The standard error of the mean of 1, 2, 3 is 1/√3; the means without each are 2.5, 2, 1.5.
        assert!((jackknife_sd(&[2.5, 2.0, 1.5]) - 3f64.sqrt().recip()).abs() < 1e-12);
        assert!(jackknife_sd(&[]).abs() < 1e-12);
    }
}
