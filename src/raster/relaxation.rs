//! Harmonic interpolation: each value the mean of its neighbors, or of its neighbors and a value of its own.

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
    let gap = Gap::new(values, is_known, places);
    gap.relaxed_into(values, most_updates);
}

/// A value that a place is drawn to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target<const N: usize> {
    /// The value.
    pub value: [f32; N],
    /// The weight of the value, in units of the weight of a neighbor.
    pub weight: f32,
}

/// As [`relax`], but each value at `places` is brought nearer to the mean of its neighbors and of its own target: `targets` holds one for
/// each place, in the same order.
pub fn relax_towards<const N: usize>(
    values: &mut Raster<[f32; N]>,
    is_known: &Mask,
    places: &[usize],
    targets: &[Target<N>],
    most_updates: usize,
) {
    let mut of_place = Raster::filled(values.width(), values.height(), None);
    for (&place, target) in places.iter().zip(targets) {
        of_place[place] = Some(*target);
    }
    let mut gap = Gap::new(values, is_known, places);
    gap.draw_to(|place| of_place[place]);
    gap.relaxed_into(values, most_updates);
}

/// The places of a gap and the known places beside, renumbered, so that a sweep needs no test of a neighbor.
struct Gap<const N: usize> {
    /// The places: those of one color of a chessboard, then those of the other, each in the order of the picture.
    places: Vec<usize>,
    /// For each place the numbers of its neighbors; the number of [`Gap::NOTHING`] for a neighbor without a value.
    neighbors: Vec<[u32; 4]>,
    /// For each place 1 over the weights of its neighbors with a value and of its target; 0 without any.
    weights: Vec<f32>,
    /// For each place its target, times the target's weight; zeros without a target.
    targets: Vec<[f32; N]>,
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
        let targets = vec![[0.0; N]; places.len()];
        Self { places, neighbors, weights, targets, values: used }
    }

    /// Draws each place to its target.
    fn draw_to(&mut self, target: impl Fn(usize) -> Option<Target<N>>) {
        for (number, &place) in self.places.iter().enumerate() {
            let Some(Target { value, weight }) = target(place) else { continue };
            let neighbors = if self.weights[number] > 0.0 { 1.0 / self.weights[number] } else { 0.0 };
            let sum = neighbors + weight;
            self.weights[number] = if sum > 0.0 { 1.0 / sum } else { 0.0 };
            self.targets[number] = value.map(|band| band * weight);
        }
    }

    /// Relaxes the values, at most `most_updates` of them, and writes them into `values`.
    fn relaxed_into(mut self, values: &mut Raster<[f32; N]>, most_updates: usize) {
        let across = (self.places.len() as f32).sqrt() + 2.0;
        let relaxation = 2.0 / (1.0 + std::f32::consts::PI / across);
        let sweeps = (3.0 * across) as usize + 20;
        let largest = self.values.iter().flatten().fold(0.0f32, |largest, value| largest.max(value.abs()));
        for _ in 0..sweeps.min(most_updates / self.places.len().max(1)) {
            if self.sweep(relaxation) <= SETTLED * largest {
                break;
            }
        }
        for (&place, value) in self.places.iter().zip(&self.values) {
            values[place] = *value;
        }
    }

    /// Moves each value by `relaxation` times its distance from the mean of its neighbors and its target; returns the largest change.
    fn sweep(&mut self, relaxation: f32) -> f32 {
        let mut largest = 0.0f32;
        for (number, (neighbors, &weight)) in self.neighbors.iter().zip(&self.weights).enumerate() {
            if weight > 0.0 {
                let [a, b, c, d] = neighbors.map(|near| self.values[near as usize]);
                let target = self.targets[number];
                let value = &mut self.values[number];
                for band in 0..N {
                    let mean = (a[band] + b[band] + c[band] + d[band] + target[band]) * weight;
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
    #[test]
    fn targets_draw_by_their_weights() {
        // A row of five values between 0 and 60: without targets 10, 20, 30, 40, 50.
        let known = [true, false, false, false, false, false, true];
        let is_known = Mask::from_vec(7, 1, known.to_vec()).unwrap();
        let places = [1, 2, 3, 4, 5];
        let relaxed = |weight: f32| {
            let mut values =
                Raster::from_vec(7, 1, [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 60.0f32].map(|value| [value]).to_vec())
                    .unwrap();
            let targets = [Target { value: [5.0], weight }; 5];
            relax_towards(&mut values, &is_known, &places, &targets, usize::MAX);
            values.map(|[value]| *value)
        };
        let (without, strong, some) = (relaxed(0.0), relaxed(1e6), relaxed(0.5));
        for place in places {
            assert!((without[place] - 10.0 * place as f32).abs() < 0.01, "{without:?}");
            assert!((strong[place] - 5.0).abs() < 0.01, "{strong:?}");
            let mean = (some[place - 1] + some[place + 1] + 0.5 * 5.0) / 2.5;
            assert!((some[place] - mean).abs() < 0.01, "each value is the weighted mean: {some:?}");
        }
    }
}
