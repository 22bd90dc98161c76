//! The picture that every later stage works on.

use crate::raster::{Mask, Raster};

/// A photograph in linear light: three bands in counts, 255 = full scale, whatever the depth of the file.
///
/// Pixels that carried a non-finite or negative value are black here and set in `invalid`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    /// R, G and B in linear counts.
    pub pixels: Raster<[f32; 3]>,
    /// Pixels whose values could not be used.
    pub invalid: Mask,
    /// Counts at which the file itself saturates: the largest value of an integer format; none for floats.
    pub saturation: Option<f32>,
}

impl LinearImage {
    /// Takes linear counts as they come from a decoder; non-finite and negative pixels become invalid.
    pub fn new(mut pixels: Raster<[f32; 3]>, saturation: Option<f32>) -> Self {
        let invalid = pixels.map(|c| c.iter().any(|v| !v.is_finite() || *v < 0.0));
        for (pixel, &bad) in pixels.as_mut_slice().iter_mut().zip(invalid.as_slice()) {
            if bad {
                *pixel = [0.0; 3];
            }
        }
        Self { pixels, invalid, saturation }
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.pixels.width()
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        self.pixels.height()
    }
}
