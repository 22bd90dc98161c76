//! The linear image, the input of all stages.

use super::coding::CodingError;
use crate::color::ContrastCurve;
use crate::raster::{Mask, Raster, Roi};
use rayon::prelude::*;

/// Pixels of one parallel task: enough that the cost of starting a task does not matter.
const PIXELS_PER_TASK: usize = 1 << 14;

/// Largest value of a pixel, counts: four billion times full scale, brighter than the sun in a photograph of a room. The squares
/// and sums of larger values would not be finite.
pub const LARGEST_COUNTS: f32 = 1e12;

/// A photograph in linear light: three bands in counts, 255 = full scale, whatever the sample depth of the file.
///
/// A pixel with a value in the file that is not finite, negative or above [`LARGEST_COUNTS`] is black here and true in `invalid`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearImage {
    /// R, G and B in linear counts.
    pub pixels: Raster<[f32; 3]>,
    /// Pixels with a value in the file that is not finite, negative or above [`LARGEST_COUNTS`].
    pub invalid: Mask,
    /// Counts at which the file saturates: the largest value of an integer format, or the largest value of floats where many are equal to it; else
    /// `None`.
    pub saturation: Option<f32>,
    /// Error of the values that the file's way of storing them causes; `None`: none but what the measured noise contains.
    pub coding: Option<CodingError>,
    /// The camera's contrast curve with which integer values were read, that of contrast 1 for the curve of sRGB alone; `None`: the file has
    /// other values.
    pub contrast: Option<ContrastCurve>,
}

impl LinearImage {
    /// Takes decoded linear counts. Pixels with a value that is not finite, negative or above [`LARGEST_COUNTS`] become black and
    /// invalid.
    pub fn new(mut pixels: Raster<[f32; 3]>, saturation: Option<f32>) -> Self {
        let mut invalid = Mask::filled(pixels.width(), pixels.height(), false);
        let both = pixels.as_mut_slice().par_iter_mut().zip(invalid.as_mut_slice());
        both.with_min_len(PIXELS_PER_TASK).for_each(|(pixel, invalid)| {
            if pixel.iter().any(|v| !(0.0..=LARGEST_COUNTS).contains(v)) {
                (*pixel, *invalid) = ([0.0; 3], true);
            }
        });
        Self { pixels, invalid, saturation, coding: None, contrast: None }
    }

    /// The same image, stored in a way that makes `coding` of error.
    #[must_use]
    pub fn with_coding(self, coding: Option<CodingError>) -> Self {
        Self { coding, ..self }
    }

    /// The same image, read with a camera's contrast curve; see [`Self::contrast`].
    #[must_use]
    pub fn with_contrast(self, contrast: Option<ContrastCurve>) -> Self {
        Self { contrast, ..self }
    }

    /// The part of the image in a rectangle.
    #[must_use]
    pub(crate) fn cropped(&self, roi: &Roi) -> Self {
        let Self { pixels, invalid, saturation, coding, contrast } = self;
        Self {
            pixels: roi.crop(pixels),
            invalid: roi.crop(invalid),
            saturation: *saturation,
            coding: coding.clone(),
            contrast: *contrast,
        }
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

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "exactness is what is tested")]
mod tests {
    use super::*;

    #[test]
    fn values_that_are_no_light_are_masked() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e-9];
        let mut counts: Vec<[f32; 3]> = bad.iter().map(|&v| [1.0, v, 2.0]).collect();
        counts.extend([[0.0, 1.0, 1e30], [-0.0; 3], [0.0, 1.0, LARGEST_COUNTS]]);
        let image = LinearImage::new(Raster::from_vec(7, 1, counts).unwrap(), None);
        assert_eq!(image.invalid.as_slice(), [true, true, true, true, true, false, false]);
        assert_eq!([image.pixels[0], image.pixels[4]], [[0.0; 3]; 2]);
        assert_eq!(image.pixels[6], [0.0, 1.0, LARGEST_COUNTS]);
    }
}
