//! Section 5.2.1: the color variation in each window of the image, in four classes.
//!
//! The test is [`crate::color::ClusterTest`]. In the paper dark and clipped pixels count.
//!
//! Refined (`tail_test`): only usable pixels count, and a window gets a class only if at least half of its pixels are usable.

use crate::color::{ClusterTest, Moments, eigenvalues};
use crate::raster::Raster;
use crate::trace::{Class, Measured, Recorder, WindowClassified, WindowsLaid};
use rayon::prelude::*;

/// The classes of color clusters, by the number of directions in which a cluster varies beyond the noise.
#[derive(Clone, Debug)]
pub struct Classifier(ClusterTest);

impl Classifier {
    /// A classifier for camera noise σ0 (counts); `tail_test`: by the tail test instead of the paper's test.
    pub fn new(camera_noise: f64, tail_test: bool) -> Self {
        Self(ClusterTest::new(camera_noise, tail_test))
    }

    /// Class of a cluster, and the eigenvalues of its covariance (counts², largest first).
    pub fn classify(&mut self, cluster: &Moments) -> (Class, [f64; 3]) {
        let lambda = eigenvalues(&cluster.covariance());
        let significant = self.0.directions(cluster.n, lambda);
        ([Class::Point, Class::Line, Class::Plane, Class::Volume][significant], lambda)
    }

    /// Statistic and threshold of the last test that decided the class of `pixels` colors with these variances (counts²), for
    /// the record.
    pub fn decided_by(&mut self, pixels: f64, eigenvalues: [f64; 3]) -> Measured<f32> {
        let trials = self.0.trials(pixels, eigenvalues);
        trials.last().map_or_else(Measured::default, |trial| {
            Measured::new(trial.statistic() as f32, trial.threshold() as f32)
        })
    }
}

/// The windows of an image: a grid of squares, the last column and row cut off by the border.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Windows {
    /// Side of a window, pixels.
    pub size_px: usize,
    /// Moments of the valid pixels of each window.
    pub moments: Raster<Moments>,
    /// Class of each window; `None` where too few pixels are valid.
    pub classes: Raster<Option<Class>>,
}

impl Windows {
    /// Index of the window that contains a pixel of an image `width` pixels wide.
    #[inline]
    pub fn window_of(&self, pixel: usize, width: usize) -> usize {
        // The function is called for every pixel that a region claims, and divisions of 32 bits are faster than those of 64.
        let (pixel, width, size) = (pixel as u32, width as u32, self.size_px as u32);
        let (column, row) = (pixel % width / size, pixel / width / size);
        row as usize * self.classes.width() + column as usize
    }
}

/// Divides an image into windows of `size_px` and classifies each window by its pixels for which `valid` is true. A window
/// with fewer than `min_valid` of them has no class.
pub fn classify<R: Recorder>(
    image: &Raster<[f32; 3]>,
    valid: impl Fn(usize) -> bool + Sync,
    size_px: usize,
    min_valid: usize,
    classifier: &mut Classifier,
    recorder: &mut R,
) -> Windows {
    let moments = window_moments(image, valid, size_px);
    let mut classes = Raster::filled(moments.width(), moments.height(), None);
    if R::KEEPS {
        recorder.record(WindowsLaid {
            size_px: size_px as u32,
            columns: moments.width() as u32,
            rows: moments.height() as u32,
            least_pixels: min_valid.max(1) as u32,
            camera_noise: classifier.0.camera_noise(),
            tail_test: classifier.0.is_tail_test(),
        });
    }
    for (window, cluster) in moments.as_slice().iter().enumerate() {
        let pixels = cluster.n as usize;
        // The record leaves out windows without a valid pixel, but contains windows with too few of them.
        if pixels < if R::KEEPS { 1 } else { min_valid } {
            continue;
        }
        let (class, eigenvalues) = classifier.classify(cluster);
        let class = (pixels >= min_valid.max(1)).then_some(class);
        classes[window] = class;
        if R::KEEPS {
            let (window, pixels) = (window as u32, pixels as u32);
            let chi_square = classifier.decided_by(cluster.n, eigenvalues);
            let eigenvalues = eigenvalues.map(|variance| variance as f32);
            recorder.record(WindowClassified { window, pixels, eigenvalues, chi_square, class });
        }
    }
    Windows { size_px, moments, classes }
}

/// Moments of the valid pixels of each window; rows of windows in parallel.
fn window_moments(
    image: &Raster<[f32; 3]>,
    valid: impl Fn(usize) -> bool + Sync,
    size_px: usize,
) -> Raster<Moments> {
    let (width, height) = (image.width(), image.height());
    let (columns, rows) = (width.div_ceil(size_px), height.div_ceil(size_px));
    let mut moments = Raster::filled(columns, rows, Moments::default());
    if moments.is_empty() {
        return moments;
    }
    moments.as_mut_slice().par_chunks_mut(columns).enumerate().for_each(|(row, windows)| {
        for y in row * size_px..((row + 1) * size_px).min(height) {
            for (column, window) in windows.iter_mut().enumerate() {
                let (from, to) = (column * size_px, ((column + 1) * size_px).min(width));
                for pixel in y * width + from..y * width + to {
                    if valid(pixel) {
                        window.add(image[pixel]);
                    }
                }
            }
        }
    });
    moments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::NoopRecorder;

    /// A 10×10 window whose pixels spread by `amplitude` counts along the first `directions` of three fixed axes.
    fn window(directions: usize, amplitude: f32) -> Raster<[f32; 3]> {
        let axes = [[0.9f32, 0.3, 0.3], [-0.3, 0.9, 0.0], [-0.3, -0.1, 0.95]];
        let data = (0..100)
            .map(|i| {
                let wave = [i % 10, i / 10, (i * 7) % 10].map(|k| amplitude * (k as f32 - 4.5) / 4.5);
                let mut color = [100.0; 3];
                for (axis, w) in axes.iter().zip(wave).take(directions) {
                    for band in 0..3 {
                        color[band] += w * axis[band];
                    }
                }
                color
            })
            .collect();
        Raster::from_vec(10, 10, data).unwrap()
    }

    #[test]
    fn a_window_has_as_many_directions_as_it_spreads_in() {
        for tail_test in [false, true] {
            for (directions, class) in
                [Class::Point, Class::Line, Class::Plane, Class::Volume].into_iter().enumerate()
            {
                let mut classifier = Classifier::new(2.5, tail_test);
                let found =
                    classify(&window(directions, 20.0), |_| true, 10, 50, &mut classifier, &mut NoopRecorder);
                assert_eq!(found.classes.as_slice(), [Some(class)], "tail test {tail_test}");
            }
        }
    }

    #[test]
    fn variation_below_the_noise_is_a_point() {
        let mut classifier = Classifier::new(2.5, false);
        let found = classify(&window(3, 2.5), |_| true, 10, 50, &mut classifier, &mut NoopRecorder);
        assert_eq!(found.classes[0], Some(Class::Point));
    }

    #[test]
    fn windows_at_the_border_are_cut_and_sparse_ones_have_no_class() {
        let image = Raster::filled(25, 13, [50.0; 3]);
        let mut classifier = Classifier::new(2.5, true);
        let found = classify(&image, |pixel| pixel % 25 < 14, 10, 50, &mut classifier, &mut NoopRecorder);
        assert_eq!((found.classes.width(), found.classes.height()), (3, 2));
        assert_eq!(
            found.moments.as_slice().iter().map(|m| m.n as u32).collect::<Vec<_>>(),
            [100, 40, 0, 30, 12, 0]
        );
        assert_eq!(found.classes.as_slice().iter().filter(|c| c.is_some()).count(), 1);
        assert_eq!(found.window_of(12 * 25 + 24, 25), 5);
    }
}
