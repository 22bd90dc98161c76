//! Where a file of floating-point numbers clips: such a file does not state a largest value.
//!
//! A camera that clips gives the same largest value to all brighter pixels. The largest value of a file is taken for that value
//! where many values are equal to it, and more than lie in the range below it: in a picture that does not clip, few
//! pixels are as bright as the brightest.

use super::linear::LARGEST_COUNTS;
use crate::raster::Raster;
use rayon::prelude::*;

/// Fewest values that are equal to the largest one, for the picture to clip there.
const LEAST_VALUES: usize = 32;
/// Largest share of the values: a picture of which most is equal, such as a plain background, does not clip.
const MOST_SHARE: f64 = 0.5;
/// Lower end of the range in which fewer values lie, as a share of the largest value.
const RANGE_BELOW: f32 = 0.98;

/// The value at which the bands of the picture clip, in the unit of its values; none where the picture does not clip.
/// Values that are not finite or above [`LARGEST_COUNTS`] do not count.
pub fn clipping_value(pixels: &Raster<[f32; 3]>) -> Option<f32> {
    let rows = || pixels.as_slice().par_chunks(pixels.width().max(1));
    let largest_of = |row: &[[f32; 3]]| {
        row.as_flattened().iter().copied().filter(|&value| value <= LARGEST_COUNTS).fold(0.0, f32::max)
    };
    let largest = rows().map(largest_of).reduce(|| 0.0, f32::max);
    if largest <= 0.0 {
        return None;
    }
    let count = |row: &[[f32; 3]]| {
        let values = row.as_flattened().iter();
        values.fold([0usize; 2], |[equal, below], &value| {
            let is_equal = value >= largest && value <= LARGEST_COUNTS;
            let is_below = value < largest && value >= RANGE_BELOW * largest;
            [equal + usize::from(is_equal), below + usize::from(is_below)]
        })
    };
    let [equal, below] = rows().map(count).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    let share = equal as f64 / (3 * pixels.len()) as f64;
    (equal >= LEAST_VALUES && equal > below && share <= MOST_SHARE).then_some(largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope of brightness with a highlight, clipped at `clip`.
    fn picture(clip: f32) -> Raster<[f32; 3]> {
        let value = |x: usize, y: usize| {
            let from_center = ((x as f32 - 32.0).powi(2) + (y as f32 - 32.0).powi(2)) / 60.0;
            let bright = 0.2 + 0.004 * x as f32 + 1.5 * (-from_center).exp();
            [bright, 0.8 * bright, 0.6 * bright].map(|band| band.min(clip))
        };
        let data = (0..64 * 64).map(|pixel| value(pixel % 64, pixel / 64)).collect();
        Raster::from_vec(64, 64, data).unwrap()
    }

    #[test]
    fn a_clipped_highlight_tells_where_the_picture_clips() {
        assert_eq!(clipping_value(&picture(1.0)), Some(1.0));
        assert_eq!(clipping_value(&picture(0.71)), Some(0.71));
    }

    #[test]
    fn a_picture_whose_brightest_pixels_differ_does_not_clip() {
        assert_eq!(clipping_value(&picture(f32::MAX)), None);
    }

    #[test]
    fn plain_and_dark_pictures_and_values_that_are_none_do_not_clip() {
        assert_eq!(clipping_value(&Raster::filled(64, 64, [0.5; 3])), None);
        assert_eq!(clipping_value(&Raster::filled(64, 64, [0.0; 3])), None);
        assert_eq!(clipping_value(&Raster::filled(64, 64, [f32::NAN; 3])), None);
        assert_eq!(clipping_value(&Raster::default()), None);
        let mut pixels = picture(1.0);
        pixels[0] = [f32::INFINITY; 3];
        pixels[1] = [1e30; 3];
        assert_eq!(clipping_value(&pixels), Some(1.0));
    }
}
