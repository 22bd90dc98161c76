//! The clean aperture (ISO/IEC 14496-12, 12.1.4): the part of the coded picture that a HEIF asks to show. Writers use it to cut
//! off the columns and rows that fill the last blocks of the coder.

use hpvcd::{CleanAperture, Orientation};

/// A part of a picture, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    pub left: usize,
    pub top: usize,
    pub width: usize,
    pub height: usize,
}

impl Part {
    /// The part of a stored picture of `width × height` pixels that `aperture` asks for, or `None` where the statement makes no
    /// sense or leaves the picture.
    pub fn of_aperture(aperture: CleanAperture, (width, height): (usize, usize)) -> Option<Self> {
        let shown = [aperture.width_pixels()?, aperture.height_pixels()?].map(|length| length as usize);
        let offset = |over: i32, under: u32| f64::from(over) / f64::from(under);
        let left = first_shown(width, shown[0], offset(aperture.horiz_off_n, aperture.horiz_off_d))?;
        let top = first_shown(height, shown[1], offset(aperture.vert_off_n, aperture.vert_off_d))?;
        let part = Self { left, top, width: shown[0], height: shown[1] };
        let is_inside = part.left + part.width <= width && part.top + part.height <= height;
        (is_inside && part.width > 0 && part.height > 0).then_some(part)
    }

    /// The same part of the picture after `orientation` has turned it upright. `width × height`: size of the stored picture.
    pub fn upright(self, (width, height): (usize, usize), orientation: Orientation) -> Self {
        let Self { left, top, width: across, height: down } = self;
        let (from_right, from_bottom) = (width - left - across, height - top - down);
        let (left, top) = match orientation {
            Orientation::Normal => (left, top),
            Orientation::FlipH => (from_right, top),
            Orientation::Rotate180 => (from_right, from_bottom),
            Orientation::FlipV => (left, from_bottom),
            Orientation::Transpose => (top, left),
            Orientation::Rotate90 => (from_bottom, left),
            Orientation::Transverse => (from_bottom, from_right),
            Orientation::Rotate270 => (top, from_right),
        };
        let (width, height) = if is_quarter_turn(orientation) { (down, across) } else { (across, down) };
        Self { left, top, width, height }
    }

    /// The samples of the part. `samples`: those of a picture of `columns` columns, `channels` each pixel.
    pub fn of<T: Copy>(self, samples: &[T], columns: usize, channels: usize) -> Vec<T> {
        let rows = samples.chunks_exact(columns * channels).skip(self.top).take(self.height);
        let across = self.left * channels..(self.left + self.width) * channels;
        rows.flat_map(|row| &row[across.clone()]).copied().collect()
    }
}

/// Whether the upright picture is as wide as the stored one is high.
pub(super) fn is_quarter_turn(orientation: Orientation) -> bool {
    orientation.irot_steps() % 2 == 1
}

/// The first of `shown` pixels of `length`, whose center is `offset` pixels away from that of all; none outside of them.
fn first_shown(length: usize, shown: usize, offset: f64) -> Option<usize> {
    let center = (length as f64 - 1.0) / 2.0 + offset;
    let first = (center - (shown as f64 - 1.0) / 2.0).round();
    (0.0..length as f64).contains(&first).then_some(first as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn aperture(size: (u32, u32), offset: (i32, i32)) -> CleanAperture {
        CleanAperture {
            width_n: size.0,
            width_d: 1,
            height_n: size.1,
            height_d: 1,
            horiz_off_n: offset.0,
            horiz_off_d: 2,
            vert_off_n: offset.1,
            vert_off_d: 2,
        }
    }

    #[test]
    fn columns_and_rows_that_fill_the_last_blocks_are_cut_off() {
        let part = Part::of_aperture(aperture((61, 48), (-3, -16)), (64, 64));
        assert_eq!(part, Some(Part { left: 0, top: 0, width: 61, height: 48 }));
        let middle = Part::of_aperture(aperture((4, 2), (0, 0)), (8, 8));
        assert_eq!(middle, Some(Part { left: 2, top: 3, width: 4, height: 2 }));
    }

    #[test]
    fn a_statement_without_sense_is_none() {
        assert_eq!(Part::of_aperture(aperture((65, 48), (0, 0)), (64, 64)), None, "wider than the picture");
        assert_eq!(Part::of_aperture(aperture((60, 48), (9, 0)), (64, 64)), None, "beyond the right");
        assert_eq!(Part::of_aperture(aperture((60, 48), (-9, 0)), (64, 64)), None, "beyond the left");
        assert_eq!(Part::of_aperture(aperture((0, 48), (0, 0)), (64, 64)), None, "no column");
        let undefined = CleanAperture { horiz_off_d: 0, ..aperture((60, 48), (0, 0)) };
        assert_eq!(Part::of_aperture(undefined, (64, 64)), None, "0 over 0");
        let undefined = CleanAperture { horiz_off_n: 1, horiz_off_d: 0, ..aperture((60, 48), (0, 0)) };
        assert_eq!(Part::of_aperture(undefined, (64, 64)), None, "1 over 0");
        let undefined = CleanAperture { width_d: 0, ..aperture((60, 48), (0, 0)) };
        assert_eq!(Part::of_aperture(undefined, (64, 64)), None, "no width");
    }

    /// Place in the stored picture of 5 × 3 pixels that the upright pixel shows, by the definition of EXIF.
    fn source_of((x, y): (usize, usize), orientation: Orientation) -> usize {
        let (column, row) = match orientation {
            Orientation::Normal => (x, y),
            Orientation::FlipH => (4 - x, y),
            Orientation::Rotate180 => (4 - x, 2 - y),
            Orientation::FlipV => (x, 2 - y),
            Orientation::Transpose => (y, x),
            Orientation::Rotate90 => (y, 2 - x),
            Orientation::Transverse => (4 - y, 2 - x),
            Orientation::Rotate270 => (4 - y, x),
        };
        row * 5 + column
    }

    /// The part of a turned picture is the turned part: each pixel that the part holds is the same.
    #[test]
    fn the_part_turns_with_the_picture() {
        let (width, height) = (5, 3);
        let part = Part { left: 1, top: 0, width: 3, height: 2 };
        let stored: Vec<usize> = (0..width * height).collect();
        let kept = part.of(&stored, width, 1);
        for orientation in (1..=8).map(Orientation::from_exif) {
            let (columns, rows) =
                if is_quarter_turn(orientation) { (height, width) } else { (width, height) };
            let turned: Vec<usize> =
                (0..columns * rows).map(|at| source_of((at % columns, at / columns), orientation)).collect();
            let mut of_turned = part.upright((width, height), orientation).of(&turned, columns, 1);
            of_turned.sort_unstable();
            assert_eq!(of_turned, kept, "{orientation:?}");
        }
    }
}
