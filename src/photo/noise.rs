//! Estimates the camera noise from a single image.
//!
//! The paper measures the noise from repeated photographs of a white board (section 7.3). A single image suffices,
//! because within a small window on one material the colors spread along at most two directions (shading, highlight),
//! so that only noise remains along the third. The smallest eigenvalue of a window of n×n pixels is biased low, and
//! textured windows are biased high. A low quantile over all windows and division by 1 − 1.63/n (from a simulation of
//! pure noise) correct both biases.
//!
//! The variance of a real sensor's noise grows with the light, because photons are counted (shot noise). The windows
//! show this too: the same quantile of windows of like intensity lies on a line of the intensity. On 48 rendered scenes
//! whose noise has the variance .72 + .0245 I (counts², I in counts) the line found is .62–.97 + (.0178–.0299) I; on 25
//! demosaiced scenes whose noise does not grow, 2 are wrongly given a line.

use super::{LinearImage, Masks};
use crate::color::{Moments, principal_axes};
use crate::raster::Blocks;
use rayon::prelude::*;

/// Side of a window, pixels.
const WINDOW_PX: usize = 10;
/// The quantile of the smallest eigenvalues that is taken for noise.
const QUANTILE: f64 = 0.4;
/// Share of the variance that the smallest eigenvalue of a window has in pure noise.
const SMALLEST_EIGENVALUE_SHARE: f64 = 1.0 - 1.63 / WINDOW_PX as f64;
/// Fewest windows for an estimate.
const MIN_WINDOWS: usize = 8;
/// Largest number of groups of windows of similar intensity.
const MAX_GROUPS: usize = 8;
/// Fewest windows of a group.
const MIN_GROUP_WINDOWS: usize = 15;
/// Fewest groups for a line.
const MIN_GROUPS: usize = 3;
/// Least ratio of the variances at both ends of the line.
const MIN_RISE: f64 = 1.4;
/// Largest median over the groups of the relative deviation of a group's variance from the line.
const MAX_DEVIATION: f64 = 0.12;

/// The noise of a band of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseEstimate {
    /// Standard deviation of a typical window, counts.
    pub sigma: f64,
    /// The variance as a function of the intensity; `None`: the windows do not show that it grows.
    pub shot: Option<ShotNoise>,
}

/// Noise whose variance grows with the intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShotNoise {
    /// Variance without light, counts².
    pub dark_variance: f64,
    /// Variance per count of intensity, counts.
    pub variance_per_count: f64,
}

impl ShotNoise {
    /// Standard deviation of a band at an intensity in counts, counts.
    pub fn sigma_at(&self, intensity: f64) -> f64 {
        (self.dark_variance + self.variance_per_count * intensity.max(0.0)).max(0.0).sqrt()
    }
}

/// The noise of one window.
struct WindowNoise {
    /// Mean of the bands, weighted by the squared components of the axis of least variance, counts.
    intensity: f64,
    /// Smallest eigenvalue of the covariance of the colors, counts².
    variance: f64,
}

impl NoiseEstimate {
    /// The noise of an image; `None` when fewer than 8 windows have enough usable pixels.
    pub fn measure(image: &LinearImage, masks: &Masks) -> Option<Self> {
        Self::measure_sparsely(image, masks, &Blocks::new(1, image.width(), image.height()), 1)
    }

    /// The noise of the means of the `blocks` of an image, from every `step`-th window of each row of windows, in the next row beginning
    /// one window later. In a large picture fewer windows are enough, and cost less. The mean of a block is used where all of its pixels
    /// are.
    pub fn measure_sparsely(
        image: &LinearImage,
        masks: &Masks,
        blocks: &Blocks,
        step: usize,
    ) -> Option<Self> {
        let step = step.max(1);
        let (rows, columns) = (blocks.rows() / WINDOW_PX, blocks.columns() / WINDOW_PX);
        let mut windows: Vec<WindowNoise> = (0..rows)
            .into_par_iter()
            .flat_map_iter(|row| {
                let columns = (row % step..columns).step_by(step);
                columns.filter_map(move |column| WindowNoise::of_window(image, masks, blocks, [column, row]))
            })
            .collect();
        if windows.len() < MIN_WINDOWS {
            return None;
        }
        let shot = shot_noise(&mut windows);
        Some(Self { sigma: noise_variance(&mut windows).sqrt(), shot })
    }
}

impl WindowNoise {
    /// Of the window at a column and row of windows; `None` where fewer than half of the pixels are usable.
    fn of_window(
        image: &LinearImage,
        masks: &Masks,
        blocks: &Blocks,
        [column, row]: [usize; 2],
    ) -> Option<Self> {
        let mut moments = Moments::default();
        for y in row * WINDOW_PX..(row + 1) * WINDOW_PX {
            for x in column * WINDOW_PX..(column + 1) * WINDOW_PX {
                if let Some(color) = block_mean(image, masks, blocks, [x, y]) {
                    moments.add(color);
                }
            }
        }
        if moments.n < (WINDOW_PX * WINDOW_PX) as f64 / 2.0 {
            return None;
        }
        let (variances, axes) = principal_axes(&moments.covariance());
        let weights = axes[2].component_mul(&axes[2]);
        Some(Self { intensity: weights.dot(&moments.mean()), variance: variances[2] })
    }
}

/// The mean of the block at a column and row of blocks, counts; `None` where a pixel of the block is not usable.
fn block_mean(
    image: &LinearImage,
    masks: &Masks,
    blocks: &Blocks,
    [column, row]: [usize; 2],
) -> Option<[f32; 3]> {
    let mut sum = [0.0f32; 3];
    let mut count = 0.0f32;
    for y in blocks.pixel_rows(row) {
        for x in blocks.pixel_columns(column) {
            let pixel = y * image.width() + x;
            if !masks.usable(pixel) {
                return None;
            }
            sum = std::array::from_fn(|band| sum[band] + image.pixels[pixel][band]);
            count += 1.0;
        }
    }
    Some(sum.map(|band| band / count))
}

/// The variance of the noise of a band in `windows`, counts²: the quantile [`QUANTILE`] of the smallest eigenvalues,
/// corrected for their bias.
fn noise_variance(windows: &mut [WindowNoise]) -> f64 {
    let rank = (windows.len() as f64 * QUANTILE) as usize;
    let (_, window, _) = windows.select_nth_unstable_by(rank, |a, b| a.variance.total_cmp(&b.variance));
    window.variance.max(0.0) / SMALLEST_EIGENVALUE_SHARE
}

/// The line on which the variances of groups of windows of like intensity lie; `None` where there are too few windows, or the
/// variance does not rise, or the groups are off the line.
fn shot_noise(windows: &mut [WindowNoise]) -> Option<ShotNoise> {
    let groups = (windows.len() / MIN_GROUP_WINDOWS).min(MAX_GROUPS);
    if groups < MIN_GROUPS {
        return None;
    }
    let order = |a: &WindowNoise, b: &WindowNoise| {
        a.intensity.total_cmp(&b.intensity).then(a.variance.total_cmp(&b.variance))
    };
    windows.sort_unstable_by(order);
    let count = windows.len();
    let points: Vec<(f64, f64)> = (0..groups)
        .map(|group| {
            let group = &mut windows[count * group / groups..count * (group + 1) / groups];
            let intensity = group.iter().map(|window| window.intensity).sum::<f64>() / group.len() as f64;
            (intensity, noise_variance(group))
        })
        .collect();
    let line = rising_line(&points)?;
    let variance = |intensity: f64| line.sigma_at(intensity).powi(2);
    let (first, last) = (points.first()?, points.last()?);
    let mut deviations: Vec<f64> =
        points.iter().map(|&(intensity, found)| (found / variance(intensity) - 1.0).abs()).collect();
    let middle = deviations.len() / 2;
    let (_, &mut deviation, _) = deviations.select_nth_unstable_by(middle, f64::total_cmp);
    let rises = variance(last.0) >= MIN_RISE * variance(first.0);
    (rises && deviation <= MAX_DEVIATION).then_some(line)
}

/// The rising line through points of (intensity, variance), by least squares of relative errors; the variance at
/// intensity 0 is at least 0. `None` where the line does not rise or a variance is 0.
fn rising_line(points: &[(f64, f64)]) -> Option<ShotNoise> {
    let mut weights: Vec<f64> = points.iter().map(|&(_, variance)| variance.powi(-2)).collect();
    let mut line = ShotNoise { dark_variance: 0.0, variance_per_count: 0.0 };
    for _ in 0..3 {
        let sum = |part: &dyn Fn(f64, f64) -> f64| -> f64 {
            points.iter().zip(&weights).map(|(&(x, y), weight)| weight * part(x, y)).sum()
        };
        let (w, x, y) = (sum(&|_, _| 1.0), sum(&|x, _| x), sum(&|_, y| y));
        let (xx, xy) = (sum(&|x, _| x * x), sum(&|x, y| x * y));
        let slope = (w * xy - x * y) / (w * xx - x * x);
        let at_dark = (y - slope * x) / w;
        line = if at_dark < 0.0 {
            ShotNoise { dark_variance: 0.0, variance_per_count: xy / xx }
        } else {
            ShotNoise { dark_variance: at_dark, variance_per_count: slope }
        };
        if !(line.variance_per_count > 0.0 && line.variance_per_count.is_finite()) {
            return None;
        }
        for (weight, &(intensity, _)) in weights.iter_mut().zip(points) {
            *weight = line.sigma_at(intensity).powi(-4);
        }
    }
    line.dark_variance.is_finite().then_some(line)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::MaskLimits;
    use crate::raster::Raster;

    #[test]
    fn a_line_through_exact_points_is_found_and_a_falling_one_is_not() {
        let points = |dark: f64, slope: f64| [10.0, 40.0, 90.0, 150.0].map(|x| (x, dark + slope * x));
        let line = rising_line(&points(0.7, 0.02)).unwrap();
        assert!((line.dark_variance - 0.7).abs() < 1e-9 && (line.variance_per_count - 0.02).abs() < 1e-9);
        assert_eq!(rising_line(&points(9.0, -0.02)), None);
        let through_black = rising_line(&points(-0.1, 0.02)).unwrap();
        assert!(through_black.dark_variance == 0.0 && through_black.variance_per_count > 0.015);
        assert_eq!(rising_line(&points(0.0, 0.0)), None);
    }

    /// Windows with the variances that pure noise gives, 30 at each of eight intensities.
    fn windows(variance: impl Fn(f64) -> f64) -> Vec<WindowNoise> {
        (0..240)
            .map(|window| {
                let intensity = 20.0 * f64::from(1 + window / 30);
                let spread = 0.8 + 0.4 * f64::from(window % 30) / 30.0;
                WindowNoise { intensity, variance: variance(intensity) * spread }
            })
            .collect()
    }

    #[test]
    fn shot_noise_is_found_where_the_variance_rises_and_only_there() {
        let found = shot_noise(&mut windows(|intensity| 0.6 + 0.03 * intensity)).unwrap();
        assert!((found.sigma_at(100.0).powi(2) * SMALLEST_EIGENVALUE_SHARE - 3.6).abs() < 0.4, "{found:?}");
        assert_eq!(shot_noise(&mut windows(|_| 2.0)), None);
        // Variances that jump between 1 and 20 from group to group are no shot noise: the groups lie off any line.
        let pattern =
            |intensity: f64| if ((intensity / 40.0) as usize).is_multiple_of(2) { 1.0 } else { 20.0 };
        assert_eq!(shot_noise(&mut windows(pattern)), None);
        assert_eq!(shot_noise(&mut windows(|intensity| intensity)[..30]), None, "too few windows");
    }

    #[test]
    fn the_mean_of_a_block_has_the_noise_of_one_pixel_over_its_side() {
        let mut state = 1u32;
        let mut uniform = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        // The sum of twelve uniform values has variance 1.
        let mut noisy = || (100.0 + 3.0 * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0)) as f32;
        let pixels = (0..240 * 240).map(|_| [noisy(), noisy(), noisy()]).collect();
        let image = LinearImage::new(Raster::from_vec(240, 240, pixels).unwrap(), None);
        let limits = MaskLimits { min_intensity: 5.0, clip_threshold: f64::INFINITY, bloom_density: 1 };
        let masks = Masks::new(&image, &limits);
        for side in [1, 2, 3] {
            let found =
                NoiseEstimate::measure_sparsely(&image, &masks, &Blocks::new(side, 240, 240), 1).unwrap();
            let expected = 3.0 / side as f64;
            assert!(
                (found.sigma / expected - 1.0).abs() < 0.08,
                "{side}: {} instead of {expected}",
                found.sigma
            );
        }
    }
}
