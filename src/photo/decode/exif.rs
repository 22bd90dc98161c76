//! Reads what EXIF (3.0) says about a picture's geometry and values: orientation, density and color space.

use super::ifd::{Directory, IfdFile};
use crate::photo::source::{Density, DensityUnit};
use image::metadata::Orientation;

/// What an EXIF block says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Exif {
    pub orientation: Option<Orientation>,
    pub density: Option<Density>,
    /// Whether the colors are those of Adobe RGB: the color space is "uncalibrated" and the interoperability index R03
    /// (DCF 2.0, 3.2.2). Cameras write no ICC profile with these files.
    pub is_adobe_rgb: bool,
}

const COLOR_SPACE: u16 = 0xA001;
const UNCALIBRATED: u64 = 65535;

impl Exif {
    /// Reads a block that begins with the byte order. A broken block says nothing.
    pub(super) fn of_block(block: &[u8]) -> Self {
        let Ok(file) = IfdFile::of(block) else { return Self::default() };
        let directory = |at| file.directory(at).ok();
        let Some(first) = file.first().ok().and_then(directory) else { return Self::default() };
        let of_camera = first.integer(0x8769).and_then(directory);
        let index_at = of_camera.as_ref().and_then(|camera| camera.integer(0xA005));
        let interoperability = index_at.and_then(directory);
        let is_adobe_rgb = of_camera.is_some_and(|camera| camera.integer(COLOR_SPACE) == Some(UNCALIBRATED))
            && interoperability
                .is_some_and(|index| index.bytes(1).is_some_and(|text| text.starts_with(b"R03")));
        Self { orientation: orientation_of(&first), density: density_of(&first), is_adobe_rgb }
    }
}

/// Orientation of a directory's picture (tag 274).
pub(super) fn orientation_of(directory: &Directory) -> Option<Orientation> {
    directory.integer(274).and_then(|value| u8::try_from(value).ok()).and_then(Orientation::from_exif)
}

/// Pixels per unit of length of a directory's picture (tags 282, 283 and 296).
pub(super) fn density_of(directory: &Directory) -> Option<Density> {
    let unit = match directory.integer(296).unwrap_or(2) {
        2 => DensityUnit::Inch,
        3 => DensityUnit::Centimeter,
        _ => DensityUnit::Ratio,
    };
    let axis = |tag| directory.fractions(tag).first().copied();
    Density::new([axis(282)?, axis(283)?], unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_broken_block_says_nothing() {
        for block in [&b""[..], b"II*\0", b"II*\0\xFF\xFF\xFF\xFF", b"no block at all"] {
            assert_eq!(Exif::of_block(block), Exif::default());
        }
    }
}
