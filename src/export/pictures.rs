//! The pictures of a result folder.

use super::png::srgb_from_linear;
use super::{ExportError, floats, png, stages};
use crate::analysis::Analysis;
use crate::photo::LinearImage;
use crate::raster::Raster;
use rayon::prelude::*;
use std::path::Path;

/// What the pictures are made from.
struct Subject<'a> {
    image: &'a LinearImage,
    analysis: &'a Analysis,
}

type Writer = fn(&Subject, &Path) -> Result<(), ExportError>;

/// Every picture by its name; the largest first, so that none is still at work when all others are done.
const PICTURES: [(&str, Writer); 13] = [
    ("body.exr", |s, path| floats::write_rgb(path, &s.analysis.intrinsic.body)),
    ("residual.exr", |s, path| floats::write_rgb(path, &residual(s))),
    ("surface.exr", |s, path| floats::write_rgb(path, &s.analysis.intrinsic.surface)),
    ("noise.exr", |s, path| floats::write_single(path, &s.analysis.intrinsic.noise)),
    ("body.png", |s, path| png::write_rgb(path, &viewable(&s.analysis.intrinsic.body))),
    ("surface.png", |s, path| png::write_rgb(path, &viewable(&s.analysis.intrinsic.surface))),
    ("noise.png", |s, path| png::write_grey(path, &viewable_noise(s.analysis))),
    ("regions.png", |s, path| png::write_labels(path, &s.analysis.regions)),
    ("stage-1-classification.png", |s, path| png::write_rgb(path, &stages::classification(s.analysis))),
    ("stage-2-merged.png", |s, path| png::write_rgb(path, &stages::coloured(&s.analysis.areas))),
    ("stage-3-linear.png", |s, path| png::write_rgb(path, &stages::coloured(&s.analysis.linear))),
    ("stage-4-planar.png", |s, path| png::write_rgb(path, &stages::coloured(&s.analysis.planar))),
    ("stage-5-clipping.png", |s, path| png::write_rgb(path, &stages::coloured(&s.analysis.regions))),
];

/// Writes everything of a result but the report and the matte photograph into `folder`, in parallel.
///
/// # Errors
/// The first file that could not be written.
pub fn write_pictures(folder: &Path, image: &LinearImage, analysis: &Analysis) -> Result<(), ExportError> {
    let subject = Subject { image, analysis };
    PICTURES.par_iter().with_max_len(1).try_for_each(|(name, write)| write(&subject, &folder.join(name)))
}

/// Input − body − surface, counts.
fn residual(subject: &Subject) -> Raster<[f32; 3]> {
    let intrinsic = &subject.analysis.intrinsic;
    let mut rest = subject.image.pixels.clone();
    let explained = intrinsic.body.as_slice().iter().zip(intrinsic.surface.as_slice());
    for (rest, (body, surface)) in rest.as_mut_slice().iter_mut().zip(explained) {
        *rest = std::array::from_fn(|band| rest[band] - body[band] - surface[band]);
    }
    rest
}

/// Linear counts as sRGB values; what is brighter than 255 counts is white.
fn viewable(counts: &Raster<[f32; 3]>) -> Raster<[u8; 3]> {
    counts.map(|colour| colour.map(|value| srgb_from_linear(value / 255.0)))
}

/// ε as grey values: 128 where it is zero, 1 and 255 at the faces of the slice.
fn viewable_noise(analysis: &Analysis) -> Raster<u8> {
    let half_width = analysis.used.slice_half_width_counts() as f32;
    analysis.intrinsic.noise.map(|epsilon| (128.0 + 127.0 * epsilon / half_width).round() as u8)
}
