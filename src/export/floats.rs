//! Writes pictures as `OpenEXR` with 32-bit floats, compressed by ZIP in blocks of 16 lines.

use super::ExportError;
use crate::raster::Raster;
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
};
use std::path::Path;

/// Counts that the value 1.0 stands for.
const COUNTS_PER_UNIT: f32 = 255.0;

/// Writes counts as channels R, G and B.
pub(super) fn write_rgb(path: &Path, counts: &Raster<[f32; 3]>) -> Result<(), ExportError> {
    let band = |band: usize| counts.as_slice().iter().map(|c| c[band] / COUNTS_PER_UNIT).collect();
    write(path, (counts.width(), counts.height()), [("R", band(0)), ("G", band(1)), ("B", band(2))])
}

/// Writes counts as the single channel Y.
pub(super) fn write_single(path: &Path, counts: &Raster<f32>) -> Result<(), ExportError> {
    let values = counts.as_slice().iter().map(|v| v / COUNTS_PER_UNIT).collect();
    write(path, (counts.width(), counts.height()), [("Y", values)])
}

fn write<const N: usize>(
    path: &Path,
    size: (usize, usize),
    channels: [(&str, Vec<f32>); N],
) -> Result<(), ExportError> {
    let channels = channels.map(|(name, values)| AnyChannel::new(name, FlatSamples::F32(values)));
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let layer = Layer::new(size, LayerAttributes::default(), Encoding::SMALL_LOSSLESS, channels);
    // The files of a result are written in parallel already, so that more threads within a file would gain nothing.
    Image::from_layer(layer).write().non_parallel().to_file(path).map_err(|source| match source {
        // An error of the system is reported as that of any other file.
        exr::error::Error::Io(source) => ExportError::Io { path: path.to_owned(), source },
        source => ExportError::Exr { path: path.to_owned(), source },
    })
}
