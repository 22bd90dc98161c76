//! Smooth interpolation between scattered values: pull–push (Gortler et al. 1996, "The Lumigraph", section 3.4), at a cost that does not
//! depend on the size of the gaps.

use super::grid::Raster;

/// A value and its weight: 1 where the value is known, 0 where it is not.
type Weighted = [f32; 2];

/// The known values (weight 1), and between them values that are interpolated: each gap is filled by the means of larger and larger blocks around.
/// Zeros without a known value.
pub fn pull_push(known: Raster<Weighted>) -> Raster<f32> {
    let mut levels = vec![known];
    while let Some(finest) = levels.last().filter(|level| level.len() > 1) {
        let coarser = pulled(finest);
        levels.push(coarser);
    }
    let mut filled = Raster::default();
    while let Some(level) = levels.pop() {
        filled = pushed(&level, &filled);
    }
    filled
}

/// The means of blocks of 2 × 2 values; the weight of a mean is the sum of the weights, at most 1.
fn pulled(fine: &Raster<Weighted>) -> Raster<Weighted> {
    let (width, height) = (fine.width().div_ceil(2), fine.height().div_ceil(2));
    let mut coarse = Raster::filled(width, height, [0.0f32; 2]);
    for y in 0..fine.height() {
        for (x, &[value, weight]) in fine.row(y).iter().enumerate() {
            let sum = &mut coarse[(y / 2) * width + x / 2];
            sum[0] += weight * value;
            sum[1] += weight;
        }
    }
    for [value, weight] in coarse.as_mut_slice() {
        *value /= weight.max(f32::MIN_POSITIVE);
        *weight = weight.min(1.0);
    }
    coarse
}

/// The values of a level, where their weight is below 1 with those of the next coarser level, `coarse`, which is empty above the coarsest level.
fn pushed(level: &Raster<Weighted>, coarse: &Raster<f32>) -> Raster<f32> {
    let mut filled = Raster::filled(level.width(), level.height(), 0.0f32);
    let rows = filled.as_mut_slice().chunks_mut(level.width().max(1));
    for (y, row) in rows.enumerate() {
        for (x, (filled, &[value, weight])) in row.iter_mut().zip(level.row(y)).enumerate() {
            let is_known = weight >= 1.0 || coarse.is_empty();
            *filled = if is_known { value } else { weight * value + (1.0 - weight) * between(coarse, x, y) };
        }
    }
    filled
}

/// The value of the coarser level at the value (x, y) of the finer level, interpolated between the four nearest.
fn between(coarse: &Raster<f32>, x: usize, y: usize) -> f32 {
    // The middle of a block lies between its two columns: each is a quarter of a block away, and three quarters from the next block.
    let nearest = |at: usize, count: usize| {
        let own = at / 2;
        let next = if at.is_multiple_of(2) { own.saturating_sub(1) } else { (own + 1).min(count - 1) };
        [(own, 0.75), (next, 0.25)]
    };
    let mut sum = 0.0;
    for (row, by_row) in nearest(y, coarse.height()) {
        for (column, by_column) in nearest(x, coarse.width()) {
            sum += by_row * by_column * coarse[row * coarse.width() + column];
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(width: usize, height: usize, known: impl Fn(usize, usize) -> Option<f32>) -> Raster<f32> {
        let values = (0..width * height).map(|i| known(i % width, i / width).map_or([0.0; 2], |v| [v, 1.0]));
        pull_push(Raster::from_vec(width, height, values.collect()).unwrap())
    }

    #[test]
    fn known_values_stay_and_a_constant_fills_every_gap() {
        let found = filled(37, 21, |x, y| (x % 11 == 3 && y % 7 == 2).then_some(5.0));
        assert!(found.as_slice().iter().all(|value| (value - 5.0).abs() < 1e-4));
        let found = filled(5, 1, |x, _| [Some(1.0), None, None, None, Some(9.0)][x]);
        assert!((found[0] - 1.0).abs() < 1e-6 && (found[4] - 9.0).abs() < 1e-6, "{found:?}");
        assert!(found.as_slice().is_sorted(), "{found:?}");
        assert!(filled(4, 4, |_, _| None).as_slice().iter().all(|value| value.abs() < 1e-9));
        assert!(filled(0, 3, |_, _| None).is_empty());
    }

    #[test]
    fn a_gap_in_a_slope_is_filled_without_steps() {
        let side = 64;
        let inside = |at: usize| (16..48).contains(&at);
        let found = filled(side, side, |x, y| (!(inside(x) && inside(y))).then_some(x as f32));
        for y in 16..48 {
            let row = found.row(y);
            let steps = row.windows(2).map(|pair| (pair[1] - pair[0]).abs());
            assert!(steps.fold(0.0, f32::max) < 6.0, "{row:?}");
            assert!((16..48).all(|x| (row[x] - x as f32).abs() < 12.0), "{row:?}");
        }
    }
}
