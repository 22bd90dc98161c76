//! Turns a picture upright according to its EXIF orientation.

use super::source::Samples;
use image::metadata::Orientation;

/// The samples of the upright picture, and its width and height. `samples` holds `channels` samples per pixel in rows
/// of `width` pixels.
pub(super) fn upright(
    samples: Samples,
    (width, height): (usize, usize),
    channels: usize,
    orientation: Orientation,
) -> (Samples, (usize, usize)) {
    if orientation == Orientation::NoTransforms {
        return (samples, (width, height));
    }
    let turn = Turn { width, height, channels, orientation };
    let samples = match samples {
        Samples::U8(v) => Samples::U8(turn.apply(&v)),
        Samples::U16(v) => Samples::U16(turn.apply(&v)),
        Samples::U32(v) => Samples::U32(turn.apply(&v)),
        Samples::F32(v) => Samples::F32(turn.apply(&v)),
    };
    (samples, turn.size())
}

/// Marks of the pixels of the upright picture, from those of the stored one.
pub(super) fn upright_marks(
    marks: &[bool],
    (width, height): (usize, usize),
    orientation: Orientation,
) -> Vec<bool> {
    Turn { width, height, channels: 1, orientation }.apply(marks)
}

/// Whether the upright picture is as wide as the stored one is high.
pub(super) const fn turns_by_a_quarter(orientation: Orientation) -> bool {
    match orientation {
        Orientation::NoTransforms
        | Orientation::FlipHorizontal
        | Orientation::FlipVertical
        | Orientation::Rotate180 => false,
        Orientation::Rotate90
        | Orientation::Rotate270
        | Orientation::Rotate90FlipH
        | Orientation::Rotate270FlipH => true,
    }
}

/// The orientation and the size of a stored picture of `width × height` pixels.
struct Turn {
    width: usize,
    height: usize,
    channels: usize,
    orientation: Orientation,
}

impl Turn {
    /// Width and height of the upright picture.
    fn size(&self) -> (usize, usize) {
        if turns_by_a_quarter(self.orientation) {
            (self.height, self.width)
        } else {
            (self.width, self.height)
        }
    }

    /// Column and row in the stored picture of the pixel at column `x` and row `y` of the upright picture.
    fn stored_from_upright(&self, x: usize, y: usize) -> (usize, usize) {
        let (right, bottom) = (self.width - 1, self.height - 1);
        match self.orientation {
            Orientation::NoTransforms => (x, y),
            Orientation::FlipHorizontal => (right - x, y),
            Orientation::Rotate180 => (right - x, bottom - y),
            Orientation::FlipVertical => (x, bottom - y),
            Orientation::Rotate90FlipH => (y, x),
            Orientation::Rotate90 => (y, bottom - x),
            Orientation::Rotate270FlipH => (right - y, bottom - x),
            Orientation::Rotate270 => (right - y, x),
        }
    }

    fn apply<T: Copy>(&self, samples: &[T]) -> Vec<T> {
        let (upright_width, upright_height) = self.size();
        let mut turned = Vec::with_capacity(samples.len());
        for y in 0..upright_height {
            for x in 0..upright_width {
                let (stored_x, stored_y) = self.stored_from_upright(x, y);
                let first = (stored_y * self.width + stored_x) * self.channels;
                turned.extend_from_slice(&samples[first..first + self.channels]);
            }
        }
        turned
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The picture `abc/def` as stored with each EXIF orientation (1 to 8); every one must become `abc/def`.
    #[test]
    fn all_eight_orientations_come_out_upright() {
        let stored: [(&str, usize); 8] = [
            ("abcdef", 3),
            ("cbafed", 3),
            ("fedcba", 3),
            ("defabc", 3),
            ("adbecf", 2),
            ("cfbead", 2),
            ("fcebda", 2),
            ("daebfc", 2),
        ];
        for (exif, (text, width)) in (1..).zip(stored) {
            let orientation = Orientation::from_exif(exif).unwrap();
            let samples = Samples::U8(text.bytes().flat_map(|b| [b, b + 1]).collect());
            let (turned, size) = upright(samples, (width, 6 / width), 2, orientation);
            assert_eq!(size, (3, 2), "orientation {exif}");
            assert_eq!(turned, Samples::U8(b"abbccddeeffg".to_vec()), "orientation {exif}");
        }
    }
}
