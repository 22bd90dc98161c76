//! Smoothing by running means. Three running means approximate a Gaussian to a few percent, at a cost that does not depend on
//! the width of the Gaussian.

use super::grid::Raster;
use rayon::prelude::*;

/// Least number of rows that one task smooths along the columns: fixed, so that sums do not depend on the number of threads.
const BAND_ROWS: usize = 64;
/// Number of rows that one task smooths at least, for each row of the radius: a task reads twice the radius in addition.
const BAND_ROWS_PER_RADIUS: usize = 6;

/// Smooths by a Gaussian with a standard deviation of `sigma_px`; at the border the mean is over the pixels inside.
pub fn blur<const N: usize>(image: &Raster<[f32; N]>, sigma_px: f64) -> Raster<[f32; N]> {
    let (width, height) = (image.width(), image.height());
    if image.is_empty() {
        return image.clone();
    }
    let radii_px = radii(sigma_px).into_iter().filter(|&radius| radius > 0);
    // Means along rows and along columns commute: all means along a row are computed while the row is in the cache.
    let mut smooth = Raster::filled(width, height, [0.0; N]);
    let rows = smooth.as_mut_slice().par_chunks_mut(width).enumerate();
    rows.for_each_init(
        || vec![[0.0; N]; width],
        |from, (y, row)| {
            row.copy_from_slice(image.row(y));
            for radius_px in radii_px.clone() {
                from.copy_from_slice(row);
                mean_along_row(from, row, radius_px);
            }
        },
    );
    let mut spare = Raster::filled(width, height, [0.0; N]);
    for radius_px in radii_px {
        mean_along_columns(&smooth, &mut spare, radius_px);
        std::mem::swap(&mut smooth, &mut spare);
    }
    smooth
}

/// Radii of three successive running means whose total variance is nearest to that of the Gaussian. A mean over 2r + 1 pixels
/// has the variance r(r + 1)/3.
fn radii(sigma_px: f64) -> [usize; 3] {
    let wanted = 3.0 * sigma_px * sigma_px;
    let small = (((1.0 + 4.0 * sigma_px * sigma_px).sqrt() - 1.0) / 2.0).floor().max(0.0) as usize;
    let tried = |larger: usize| [0, 1, 2].map(|i| small + usize::from(i < larger));
    let miss = |radii: [usize; 3]| (radii.iter().map(|r| r * (r + 1)).sum::<usize>() as f64 - wanted).abs();
    (0..=3).map(tried).min_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap_or([small; 3])
}

/// Writes the running means of a row with `2·radius_px + 1` values each.
fn mean_along_row<const N: usize>(from: &[[f32; N]], to: &mut [[f32; N]], radius_px: usize) {
    let width = from.len();
    let mut sum = [0.0f32; N];
    let mut count = 0.0f32;
    for value in &from[..radius_px.min(width)] {
        add(&mut sum, value);
        count += 1.0;
    }
    for x in 0..width {
        if let Some(value) = from.get(x + radius_px) {
            add(&mut sum, value);
            count += 1.0;
        }
        if x > radius_px {
            subtract(&mut sum, &from[x - radius_px - 1]);
            count -= 1.0;
        }
        let share = 1.0 / count;
        to[x] = sum.map(|sum| sum * share);
    }
}

/// Writes the running means along the columns with `2·radius_px + 1` values each; bands of rows in parallel.
fn mean_along_columns<const N: usize>(from: &Raster<[f32; N]>, to: &mut Raster<[f32; N]>, radius_px: usize) {
    let (width, height) = (from.width(), from.height());
    let band_rows = BAND_ROWS.max(BAND_ROWS_PER_RADIUS * radius_px);
    to.as_mut_slice().par_chunks_mut(width * band_rows).enumerate().for_each(|(band, to)| {
        let top = band * band_rows;
        let first = top.saturating_sub(radius_px);
        let mut sums = vec![[0.0f32; N]; width];
        let mut count = 0.0f32;
        for y in first..(top + radius_px).min(height) {
            sums.iter_mut().zip(from.row(y)).for_each(|(sum, value)| add(sum, value));
            count += 1.0;
        }
        for (y, to) in (top..).zip(to.chunks_mut(width)) {
            if y + radius_px < height {
                sums.iter_mut().zip(from.row(y + radius_px)).for_each(|(sum, value)| add(sum, value));
                count += 1.0;
            }
            if y > top && y > radius_px {
                let gone = from.row(y - radius_px - 1);
                sums.iter_mut().zip(gone).for_each(|(sum, value)| subtract(sum, value));
                count -= 1.0;
            }
            let share = 1.0 / count;
            to.iter_mut().zip(&sums).for_each(|(to, sum)| *to = sum.map(|sum| sum * share));
        }
    });
}

#[inline]
fn add<const N: usize>(sum: &mut [f32; N], value: &[f32; N]) {
    sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value);
}

#[inline]
fn subtract<const N: usize>(sum: &mut [f32; N], value: &[f32; N]) {
    sum.iter_mut().zip(value).for_each(|(sum, value)| *sum -= value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_have_the_gaussians_variance() {
        for sigma in [1.0, 3.0, 5.0, 7.0, 12.5] {
            let variance: f64 = radii(sigma).iter().map(|&r| (r * (r + 1)) as f64 / 3.0).sum();
            assert!((variance.sqrt() / sigma - 1.0).abs() < 0.2, "{sigma}: {:?}", radii(sigma));
        }
        assert_eq!(radii(0.0), [0; 3]);
    }

    #[test]
    fn a_constant_stays_and_a_point_spreads_evenly() {
        let flat = blur(&Raster::filled(30, 150, [7.0f32, -2.0]), 3.0);
        assert!(flat.as_slice().iter().all(|v| (v[0] - 7.0).abs() < 1e-4 && (v[1] + 2.0).abs() < 1e-4));
        let mut point = Raster::filled(61, 141, [0.0f32]);
        point[70 * 61 + 30] = [1.0];
        let spread = blur(&point, 3.0);
        let at = |x: usize, y: usize| spread[y * 61 + x][0];
        let total: f32 = spread.as_slice().iter().map(|v| v[0]).sum();
        assert!((total - 1.0).abs() < 1e-4, "{total}");
        assert!((at(30, 70) - 0.0177).abs() < 0.002, "1 / 2πσ²: {}", at(30, 70));
        for d in 1..9 {
            let around = [at(30 - d, 70), at(30 + d, 70), at(30, 70 - d), at(30, 70 + d)];
            assert!(around.iter().all(|v| (v - around[0]).abs() < 1e-6), "{d}: {around:?}");
        }
    }

    #[test]
    fn empty_and_small_pictures_are_no_error() {
        assert!(blur(&Raster::filled(0, 5, [1.0f32]), 4.0).is_empty());
        assert_eq!(blur(&Raster::filled(1, 1, [4.0f32]), 40.0).as_slice(), [[4.0]]);
        let tall = blur(&Raster::filled(2, 300, [1.0f32]), 90.0);
        assert!(tall.as_slice().iter().all(|v| (v[0] - 1.0).abs() < 1e-3));
    }
}
