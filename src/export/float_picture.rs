//! A picture of floats as the bytes of one file, OpenEXR or NumPy, as the files of a result have them: 1.0 is full scale.

use super::{arrays, floats};
use crate::raster::Raster;

/// A picture of floats, counts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum FloatPicture {
    /// Red, green and blue.
    Rgb(Raster<[f32; 3]>),
    /// One value a pixel.
    Single(Raster<f32>),
}

impl FloatPicture {
    /// The bytes of an OpenEXR file with channels R, G and B, or Y.
    pub(crate) fn exr(&self) -> Vec<u8> {
        match self {
            Self::Rgb(counts) => floats::rgb_bytes(counts),
            Self::Single(counts) => floats::single_bytes(counts),
        }
    }

    /// The bytes of a NumPy file of rows, columns and bands, or of rows and columns.
    pub(crate) fn npy(&self) -> Vec<u8> {
        match self {
            Self::Rgb(counts) => arrays::rgb_bytes(counts),
            Self::Single(counts) => arrays::single_bytes(counts),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bytes_are_those_of_the_files_of_a_result() {
        let folder = tempfile::tempdir().unwrap();
        let colors = Raster::from_vec(3, 20, (0..60).map(|at| [at as f32, 255.0, -1.0]).collect()).unwrap();
        let single = colors.map(|color| color[0]);
        let written = |write: &dyn Fn(&std::path::Path)| {
            let path = folder.path().join("file");
            write(&path);
            std::fs::read(&path).unwrap()
        };
        let (rgb, gray) = (FloatPicture::Rgb(colors.clone()), FloatPicture::Single(single.clone()));
        assert_eq!(rgb.exr(), written(&|path| floats::write_rgb(path, &colors).unwrap()));
        assert_eq!(gray.exr(), written(&|path| floats::write_single(path, &single).unwrap()));
        assert_eq!(rgb.npy(), written(&|path| arrays::write_rgb(path, &colors).unwrap()));
        assert_eq!(gray.npy(), written(&|path| arrays::write_single(path, &single).unwrap()));
    }
}
