//! Correlation of the noise between neighboring pixels, from which demosaicing and lossy compression are recognized.
//!
//! In a window on one material the component of the color along the axis of least variance is noise and slow shading; a
//! polynomial of second degree in the position is fitted and subtracted. The correlation of the residuals at distances
//! of one and two pixels, over the half of the windows with the smaller largest variance, is −.06…−.05 for white noise
//! at distance one (the polynomial takes a part). A Bayer mosaic gives .36 and −.12…−.09, JPEG without chroma
//! subsampling .31–.39 and .00–.03, JPEG with it .30–.43 and .04–.20.

use super::{LinearImage, Masks};
use crate::color::{Moments, principal_axes, rgb};
use rayon::prelude::*;

/// Side of a window, pixels.
const WINDOW_PX: usize = 10;
const WINDOW_PIXELS: usize = WINDOW_PX * WINDOW_PX;
/// Fewest windows for a measurement.
const MIN_WINDOWS: usize = 16;
/// Largest number of windows that are looked at, evenly chosen.
const MAX_WINDOWS: usize = 4000;
/// Least correlation at a distance of one pixel of noise that extends over neighboring pixels.
const EXTENDED_NEXT: f64 = 0.15;
/// Correlation at a distance of two pixels above which extended noise is that of lossy compression, not of a mosaic.
const COMPRESSED_SECOND: f64 = -0.03;

/// Correlation of the noise of neighboring pixels of a row or a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseCorrelation {
    /// At a distance of one pixel, −1…1.
    pub next: f64,
    /// At a distance of two pixels, −1…1.
    pub second: f64,
}

impl NoiseCorrelation {
    /// Measures an image; `None` where fewer than 16 windows consist of usable pixels, or the residuals of the chosen
    /// half are 0.
    pub fn measure(image: &LinearImage, masks: &Masks) -> Option<Self> {
        let (columns, rows) = (image.width() / WINDOW_PX, image.height() / WINDOW_PX);
        let step = (columns * rows).div_ceil(MAX_WINDOWS).max(1);
        let polynomials = polynomials();
        let mut windows: Vec<WindowSums> = (0..columns * rows)
            .into_par_iter()
            .with_min_len(64)
            .filter(|window| window % step == 0)
            .filter_map(|window| {
                let corner = (window % columns * WINDOW_PX, window / columns * WINDOW_PX);
                WindowSums::of_window(image, masks, corner, &polynomials)
            })
            .collect();
        if windows.len() < MIN_WINDOWS {
            return None;
        }
        let half = windows.len() / 2;
        windows
            .select_nth_unstable_by(half, |a, b| a.spread.total_cmp(&b.spread).then(a.place.cmp(&b.place)));
        windows.truncate(half);
        // The order of the sum must not depend on the selection.
        windows.sort_unstable_by_key(|window| window.place);
        let total = |part: fn(&WindowSums) -> f64| windows.iter().map(part).sum::<f64>();
        let variance = total(|window| window.square);
        (variance > 0.0).then(|| Self {
            next: total(|window| window.next) / variance,
            second: total(|window| window.second) / variance,
        })
    }

    /// Whether the noise extends over neighboring pixels: after lossy compression or demosaicing.
    pub fn is_extended(&self) -> bool {
        self.next >= EXTENDED_NEXT
    }

    /// Whether the noise extends over neighboring pixels as that of lossy compression does.
    pub fn is_compressed(&self) -> bool {
        self.is_extended() && self.second > COMPRESSED_SECOND
    }
}

/// Mean products of the residuals of one window.
struct WindowSums {
    /// Number of the window's first pixel, which orders windows.
    place: usize,
    /// Largest variance of the colors, counts².
    spread: f64,
    /// Of a residual with itself, with that of the next pixel and with that of the pixel after the next, counts².
    square: f64,
    next: f64,
    second: f64,
}

impl WindowSums {
    /// Of the window at a corner; `None` where a pixel is unusable.
    fn of_window(
        image: &LinearImage,
        masks: &Masks,
        (left, top): (usize, usize),
        polynomials: &[[f32; WINDOW_PIXELS]; 6],
    ) -> Option<Self> {
        let place = |at: usize| (top + at / WINDOW_PX) * image.width() + left + at % WINDOW_PX;
        if !(0..WINDOW_PIXELS).all(|at| masks.usable(place(at))) {
            return None;
        }
        let moments: Moments = (0..WINDOW_PIXELS).map(|at| image.pixels[place(at)]).collect();
        let (variances, axes) = principal_axes(&moments.covariance());
        let (mean, axis) = (rgb(&moments.mean()), rgb(&axes[2]));
        let mut residual: [f32; WINDOW_PIXELS] = std::array::from_fn(|at| {
            let color = image.pixels[place(at)];
            (0..3).map(|band| (color[band] - mean[band]) * axis[band]).sum()
        });
        for polynomial in polynomials {
            let amount: f32 = polynomial.iter().zip(&residual).map(|(p, r)| p * r).sum();
            residual.iter_mut().zip(polynomial).for_each(|(r, p)| *r -= amount * p);
        }
        let product = |distance: usize| {
            let along_row = (0..WINDOW_PIXELS).filter(|at| at % WINDOW_PX + distance < WINDOW_PX);
            let row: f32 = along_row.map(|at| residual[at] * residual[at + distance]).sum();
            let below = distance * WINDOW_PX;
            let column: f32 = (0..WINDOW_PIXELS - below).map(|at| residual[at] * residual[at + below]).sum();
            f64::from(row + column) / (2 * (WINDOW_PIXELS - below)) as f64
        };
        Some(Self {
            place: place(0),
            spread: variances[0],
            square: product(0),
            next: product(1),
            second: product(2),
        })
    }
}

/// Polynomials of at most the second degree in the position within a window, orthonormal.
fn polynomials() -> [[f32; WINDOW_PIXELS]; 6] {
    let position = |at: usize| at as f64 - (WINDOW_PX - 1) as f64 / 2.0;
    let mean_square = (0..WINDOW_PX).map(|at| position(at).powi(2)).sum::<f64>() / WINDOW_PX as f64;
    let degrees = [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2)];
    let term = |at: usize, degree: i32| match degree {
        2 => position(at).powi(2) - mean_square,
        _ => position(at).powi(degree),
    };
    degrees.map(|(across, down)| {
        let values: [f64; WINDOW_PIXELS] =
            std::array::from_fn(|at| term(at % WINDOW_PX, across) * term(at / WINDOW_PX, down));
        let length = values.iter().map(|value| value * value).sum::<f64>().sqrt();
        values.map(|value| (value / length) as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photo::MaskLimits;
    use crate::raster::Raster;

    /// The correlation of the noise of a shaded picture whose noise is the mean over `side` × `side` places of white noise.
    fn correlation(side: usize) -> NoiseCorrelation {
        let mut state = 7u64;
        let mut white = || {
            // A linear congruential generator is random enough for a test, and the same everywhere.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1u64 << 24) as f32 - 0.5
        };
        let (width, height) = (120, 120);
        let noise: Vec<[f32; 3]> =
            (0..(width + 4) * (height + 4)).map(|_| [white(), white(), white()]).collect();
        let pixels = (0..width * height).map(|pixel| {
            let (x, y) = (pixel % width, pixel / width);
            std::array::from_fn(|band| {
                let places =
                    (0..side * side).map(|at| noise[(y + at / side) * (width + 4) + x + at % side][band]);
                80.0 + [0.4, 0.2, 0.1][band] * (x + y) as f32
                    + 8.0 * places.sum::<f32>() / (side * side) as f32
            })
        });
        let image = LinearImage::new(Raster::from_vec(width, height, pixels.collect()).unwrap(), None);
        let limits = MaskLimits { min_intensity: 1.0, clip_threshold: f64::INFINITY, bloom_density: 9 };
        NoiseCorrelation::measure(&image, &Masks::new(&image, &limits)).unwrap()
    }

    #[test]
    fn white_noise_does_not_extend_over_neighbors_and_smoothed_noise_does() {
        let white = correlation(1);
        assert!(white.next.abs() < 0.1 && !white.is_extended() && !white.is_compressed(), "{white:?}");
        let pairs = correlation(2);
        assert!(pairs.is_extended() && !pairs.is_compressed(), "like a mosaic: {pairs:?}");
        let smoothed = correlation(3);
        assert!(smoothed.is_extended() && smoothed.is_compressed(), "{smoothed:?}");
    }

    #[test]
    fn polynomials_are_orthonormal() {
        let polynomials = polynomials();
        for (i, a) in polynomials.iter().enumerate() {
            for (j, b) in polynomials.iter().enumerate() {
                let product: f32 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                assert!((product - f32::from(i == j)).abs() < 1e-5, "{i} {j}: {product}");
            }
        }
    }

    #[test]
    fn a_picture_without_noise_or_without_windows_says_nothing() {
        let flat = LinearImage::new(Raster::filled(100, 100, [90.0; 3]), None);
        let limits = MaskLimits { min_intensity: 1.0, clip_threshold: f64::INFINITY, bloom_density: 9 };
        assert_eq!(NoiseCorrelation::measure(&flat, &Masks::new(&flat, &limits)), None);
        let small = LinearImage::new(Raster::filled(20, 20, [90.0; 3]), None);
        assert_eq!(NoiseCorrelation::measure(&small, &Masks::new(&small, &limits)), None);
    }
}
