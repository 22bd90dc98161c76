//! Label maps and linear pictures from files.

use super::TruthError;
use crate::photo::{COUNTS_PER_UNIT, believable_pixels};
use crate::raster::{LabelMap, Raster};
use exr::prelude::{ReadChannels, ReadLayers, read};
use image::DynamicImage;
use std::io::Cursor;
use std::path::Path;

/// The pictures of a result folder from which scores are computed.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultPictures {
    /// Region of each pixel, 0 = unassigned.
    pub regions: LabelMap,
    /// Body reflection, counts.
    pub body: Raster<[f32; 3]>,
    /// Surface reflection, counts.
    pub surface: Raster<[f32; 3]>,
}

impl ResultPictures {
    /// Reads `regions.png`, `body.exr` and `surface.exr` of a result folder.
    ///
    /// # Errors
    /// When a file is missing, cannot be decoded, or differs in size from the regions.
    pub fn read(folder: &Path) -> Result<Self, TruthError> {
        let path = folder.join("regions.png");
        let regions = decode_labels(&read_file(&path)?, &path)?;
        let picture = |name| {
            let path = folder.join(name);
            let picture = decode_rgb_exr(&read_file(&path)?, &path)?;
            expect_size(&picture, &regions, &path)?;
            Ok(picture)
        };
        Ok(Self { body: picture("body.exr")?, surface: picture("surface.exr")?, regions })
    }

    /// Body and surface reflection together: the photograph that was analyzed, but for noise and clipped pixels.
    pub fn sum(&self) -> Raster<[f32; 3]> {
        let mut sum = self.body.clone();
        let both = sum.as_mut_slice().iter_mut().flatten().zip(self.surface.as_slice().as_flattened());
        both.for_each(|(sum, surface)| *sum += surface);
        sum
    }
}

/// The bytes of a file.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, TruthError> {
    std::fs::read(path).map_err(|source| TruthError::Io { path: path.to_owned(), source })
}

/// An RGB picture in counts, whatever the depth of the file's samples.
pub(super) fn decode_rgb_exr(bytes: &[u8], path: &Path) -> Result<Raster<[f32; 3]>, TruthError> {
    expect_plausible(bytes, path)?;
    let picture = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Raster::filled(size.width(), size.height(), [0.0f32; 3]),
            |picture, at, (r, g, b): (f32, f32, f32)| {
                let index = at.y() * picture.width() + at.x();
                picture[index] = [r, g, b].map(|unit| unit * COUNTS_PER_UNIT);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|source| TruthError::Exr { path: path.to_owned(), source })?;
    Ok(picture.layer_data.channel_data.pixels)
}

/// Fails where a file declares more pixels than its bytes can hold, before memory is taken for them.
fn expect_plausible(bytes: &[u8], path: &Path) -> Result<(), TruthError> {
    let header = exr::meta::MetaData::read_from_buffered(Cursor::new(bytes), false);
    let header = header.map_err(|source| TruthError::Exr { path: path.to_owned(), source })?;
    let believed = believable_pixels(bytes.len());
    let fits = |size: exr::math::Vec2<usize>| {
        size.width().checked_mul(size.height()).is_some_and(|pixels| pixels as u64 <= believed)
    };
    if header.headers.iter().all(|header| fits(header.layer_size)) {
        return Ok(());
    }
    let source = exr::error::Error::Invalid("size: more pixels than its bytes can hold".into());
    Err(TruthError::Exr { path: path.to_owned(), source })
}

/// Integer labels of a gray picture, or of the red band of a color picture.
pub(super) fn decode_labels(bytes: &[u8], path: &Path) -> Result<LabelMap, TruthError> {
    let picture = image::load_from_memory(bytes)
        .map_err(|source| TruthError::Labels { path: path.to_owned(), source })?;
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let bytes = |samples: Vec<u8>, bands| samples.into_iter().step_by(bands).map(u16::from).collect();
    let words = |samples: Vec<u16>, bands| samples.into_iter().step_by(bands).collect();
    let labels = match picture {
        DynamicImage::ImageLuma8(p) => bytes(p.into_raw(), 1),
        DynamicImage::ImageLumaA8(p) => bytes(p.into_raw(), 2),
        DynamicImage::ImageRgb8(p) => bytes(p.into_raw(), 3),
        DynamicImage::ImageRgba8(p) => bytes(p.into_raw(), 4),
        DynamicImage::ImageLuma16(p) => words(p.into_raw(), 1),
        DynamicImage::ImageLumaA16(p) => words(p.into_raw(), 2),
        DynamicImage::ImageRgb16(p) => words(p.into_raw(), 3),
        DynamicImage::ImageRgba16(p) => words(p.into_raw(), 4),
        other => {
            return Err(TruthError::LabelType {
                path: path.to_owned(),
                found: format!("{:?}", other.color()),
            });
        }
    };
    Ok(Raster::from_vec(width, height, labels).expect("invariant: a decoded picture holds all its pixels"))
}

/// An error where a picture differs in size from the labels.
pub(super) fn expect_size<T>(picture: &Raster<T>, labels: &LabelMap, path: &Path) -> Result<(), TruthError> {
    let (found, labels) = ((picture.width(), picture.height()), (labels.width(), labels.height()));
    if found == labels { Ok(()) } else { Err(TruthError::Size { path: path.to_owned(), found, labels }) }
}
