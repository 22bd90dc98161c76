//! Harmonic interpolation: each value the mean of its neighbors.

use super::grid::{Mask, Raster};

/// Brings the `values` at `places` nearer to the harmonic interpolation between the values of `is_known`, by successive over-relaxation: the
/// nearer, the better the values are at the beginning. At most `most_updates` values are computed, so that large gaps have fewer sweeps.
pub fn relax<const N: usize>(
    values: &mut Raster<[f32; N]>,
    is_known: &Mask,
    places: &mut [usize],
    most_updates: usize,
) {
    places.sort_unstable();
    let mut is_inside = Mask::filled(values.width(), values.height(), false);
    for &place in places.iter() {
        is_inside[place] = true;
    }
    let across = (places.len() as f32).sqrt() + 2.0;
    let relaxation = 2.0 / (1.0 + std::f32::consts::PI / across);
    let sweeps = (3.0 * across) as usize + 20;
    for _ in 0..sweeps.min(most_updates / places.len().max(1)) {
        for &place in places.iter() {
            let (mut sum, mut count) = ([0.0f32; N], 0.0f32);
            is_inside.for_each_neighbor(place, |near| {
                if is_inside[near] || is_known[near] {
                    sum.iter_mut().zip(values[near]).for_each(|(sum, value)| *sum += value);
                    count += 1.0;
                }
            });
            if count > 0.0 {
                for (value, sum) in values[place].iter_mut().zip(sum) {
                    *value += relaxation * (sum / count - *value);
                }
            }
        }
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
        let mut places: Vec<usize> = (0..width * height).filter(|&place| is_inner(place)).collect();
        let untouched = values.clone();
        relax(&mut values, &is_known, &mut places, 0);
        assert_eq!(values, untouched, "no update is allowed");
        relax(&mut values, &is_known, &mut places, usize::MAX);
        for place in 0..width * height {
            let (found, expected) = (values[place], slope(place));
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01), "{found:?} {expected:?}");
        }
    }
}
