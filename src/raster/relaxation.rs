//! Harmonic interpolation: each value the mean of its neighbors.

use super::grid::{Mask, Raster};

/// Largest change of a value in a sweep after which no sweep follows, as a share of the largest value.
const SETTLED: f32 = 1e-5;

/// Brings the `values` at `places` nearer to the harmonic interpolation between the values of `is_known`, by successive over-relaxation: the
/// nearer, the better the values are at the beginning. At most `most_updates` values are computed, so that large gaps have fewer sweeps.
///
/// A sweep visits the places as the squares of one color of a chessboard, then those of the other: no value depends on the one that was
/// computed just before, which a processor would wait for.
pub fn relax<const N: usize>(
    values: &mut Raster<[f32; N]>,
    is_known: &Mask,
    places: &[usize],
    most_updates: usize,
) {
    let mut gap = Gap::new(values, is_known, places);
    let across = (places.len() as f32).sqrt() + 2.0;
    let relaxation = 2.0 / (1.0 + std::f32::consts::PI / across);
    let sweeps = (3.0 * across) as usize + 20;
    let largest = gap.values.iter().flatten().fold(0.0f32, |largest, value| largest.max(value.abs()));
    for _ in 0..sweeps.min(most_updates / places.len().max(1)) {
        if gap.sweep(relaxation) <= SETTLED * largest {
            break;
        }
    }
    for (&place, value) in gap.places.iter().zip(&gap.values) {
        values[place] = *value;
    }
}

/// The places of a gap and the known places beside, renumbered, so that a sweep needs no test of a neighbor.
struct Gap<const N: usize> {
    /// The places: those of one color of a chessboard, then those of the other, each in the order of the picture.
    places: Vec<usize>,
    /// For each place the numbers of its neighbors; the number of [`Gap::NOTHING`] for a neighbor without a value.
    neighbors: Vec<[u32; 4]>,
    /// For each place 1 over the number of its neighbors with a value; 0 without any.
    weights: Vec<f32>,
    /// The values of the places, those of the known places beside, and zeros.
    values: Vec<[f32; N]>,
}

impl<const N: usize> Gap<N> {
    /// Number of a place that is neither in the gap nor known, before the numbers of all places are known.
    const NOTHING: u32 = u32::MAX;

    fn new(values: &Raster<[f32; N]>, is_known: &Mask, places: &[usize]) -> Self {
        let width = values.width();
        let is_second = |place: &usize| (place % width + place / width) % 2 == 1;
        let mut places = places.to_vec();
        places.sort_unstable_by_key(|place| (is_second(place), *place));
        let mut numbers = Raster::filled(width, values.height(), Self::NOTHING);
        for (number, &place) in places.iter().enumerate() {
            numbers[place] = number as u32;
        }
        let mut used: Vec<[f32; N]> = places.iter().map(|&place| values[place]).collect();
        let mut neighbors = vec![[Self::NOTHING; 4]; places.len()];
        let mut weights = vec![0.0; places.len()];
        for ((&place, neighbors), weight) in places.iter().zip(&mut neighbors).zip(&mut weights) {
            let mut count = 0;
            is_known.for_each_neighbor(place, |near| {
                if numbers[near] == Self::NOTHING && is_known[near] {
                    numbers[near] = used.len() as u32;
                    used.push(values[near]);
                }
                if numbers[near] != Self::NOTHING {
                    neighbors[count] = numbers[near];
                    count += 1;
                }
            });
            *weight = if count > 0 { 1.0 / count as f32 } else { 0.0 };
        }
        let zeros = used.len() as u32;
        used.push([0.0; N]);
        for neighbor in neighbors.iter_mut().flatten().filter(|neighbor| **neighbor == Self::NOTHING) {
            *neighbor = zeros;
        }
        Self { places, neighbors, weights, values: used }
    }

    /// Moves each value by `relaxation` times its distance from the mean of its neighbors; returns the largest change.
    fn sweep(&mut self, relaxation: f32) -> f32 {
        let mut largest = 0.0f32;
        for (number, (neighbors, &weight)) in self.neighbors.iter().zip(&self.weights).enumerate() {
            if weight > 0.0 {
                let [a, b, c, d] = neighbors.map(|near| self.values[near as usize]);
                let value = &mut self.values[number];
                for band in 0..N {
                    let mean = (a[band] + b[band] + c[band] + d[band]) * weight;
                    let change = relaxation * (mean - value[band]);
                    value[band] += change;
                    largest = largest.max(change.abs());
                }
            }
        }
        largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_border_is_continued_linearly() {
        let (width, height) = (24, 17);
        let slope = |place: usize| [(place % width) as f32, -2.0 * (place / width) as f32];
        let is_inner = |place: usize| {
            let (x, y) = (place % width, place / width);
            x > 0 && y > 0 && x + 1 < width && y + 1 < height
        };
        let start = |place: usize| if is_inner(place) { [5.0; 2] } else { slope(place) };
        let mut values = Raster::from_vec(width, height, (0..width * height).map(start).collect()).unwrap();
        let known = (0..width * height).map(|place| !is_inner(place)).collect();
        let is_known = Mask::from_vec(width, height, known).unwrap();
        let places: Vec<usize> = (0..width * height).filter(|&place| is_inner(place)).collect();
        let untouched = values.clone();
        relax(&mut values, &is_known, &places, 0);
        assert_eq!(values, untouched, "no update is allowed");
        relax(&mut values, &is_known, &places, usize::MAX);
        for place in 0..width * height {
            let (found, expected) = (values[place], slope(place));
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01), "{found:?} {expected:?}");
        }
    }
}
