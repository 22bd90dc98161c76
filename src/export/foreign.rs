//! Pictures of what was made elsewhere, in the colors in which a result folder shows the same.

use super::pictures::viewable;
use super::{ExportError, png, stages};
use crate::color::ContrastCurve;
use crate::raster::{LabelMap, Raster};
use rayon::prelude::*;
use std::path::Path;

/// Difference of body reflection that is black or white, counts.
const SWING_COUNTS: f32 = 64.0;

/// Writes a label map to a PNG; each label has the color that `stage-5-clipping.png` gives the region which covers most of it.
///
/// # Errors
/// When the file cannot be written.
pub fn write_foreign_labels(path: &Path, labels: &LabelMap, regions: &LabelMap) -> Result<(), ExportError> {
    png::write_rgb(path, &stages::colored_like(labels, regions))
}

/// Writes a diffuse picture (linear counts) to a PNG, as `body.png` shows body reflection. `contrast`: the camera's contrast curve with which it
/// was read.
///
/// # Errors
/// When the file cannot be written.
pub fn write_foreign_diffuse(
    path: &Path,
    diffuse: &Raster<[f32; 3]>,
    contrast: Option<ContrastCurve>,
) -> Result<(), ExportError> {
    png::write_rgb(path, &viewable(diffuse, contrast))
}

/// Writes a diffuse picture minus the body image of a result to a PNG: gray for 0, black and white for ∓64 counts.
///
/// # Errors
/// When the file cannot be written.
pub fn write_difference(
    path: &Path,
    diffuse: &Raster<[f32; 3]>,
    body: &Raster<[f32; 3]>,
) -> Result<(), ExportError> {
    let mut gray = Raster::filled(diffuse.width(), diffuse.height(), [0u8; 3]);
    let both = diffuse.as_slice().par_iter().zip(body.as_slice());
    gray.as_mut_slice().par_iter_mut().zip(both).for_each(|(pixel, (a, b))| {
        *pixel =
            std::array::from_fn(|band| (128.0 + 127.0 * (a[band] - b[band]) / SWING_COUNTS).round() as u8);
    });
    png::write_rgb(path, &gray)
}
