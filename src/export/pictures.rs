//! Writes the pictures of a result folder.

use super::png::{code_from_linear, code_with_contrast};
use super::{ExportError, arrays, floats, png, stages};
use crate::analysis::Analysis;
use crate::color::ContrastCurve;
use crate::photo::{COUNTS_PER_UNIT, LinearImage};
use crate::raster::{LabelMap, Raster};
use rayon::prelude::*;
use std::path::Path;

/// The data from which the pictures are made.
pub(super) struct PictureInput<'a> {
    image: &'a LinearImage,
    analysis: &'a Analysis,
}

pub(super) type Writer = fn(&PictureInput, &Path) -> Result<(), ExportError>;

/// Number of pictures in a usual result folder, without the matte photograph.
const PICTURE_COUNT: usize = 14;

/// Name and writer of every picture. The largest pictures come first, so that no large picture is started last.
pub(super) const PICTURES: [(&str, Writer); PICTURE_COUNT] = [
    ("body.exr", |s, path| floats::write_rgb(path, &s.analysis.intrinsic.body)),
    ("residual.exr", |s, path| floats::write_rgb(path, &residual(s))),
    ("surface.exr", |s, path| floats::write_rgb(path, &s.analysis.intrinsic.surface)),
    ("noise.exr", |s, path| floats::write_single(path, &s.analysis.intrinsic.noise)),
    ("body.png", |s, path| png::write_rgb(path, &viewable(&s.analysis.intrinsic.body, s.image.contrast))),
    ("surface.png", |s, path| {
        png::write_rgb(path, &viewable(&s.analysis.intrinsic.surface, s.image.contrast))
    }),
    ("noise.png", |s, path| png::write_gray(path, &viewable_noise(s.analysis))),
    ("confidence.png", |s, path| png::write_gray(path, &viewable_share(&s.analysis.intrinsic.confidence))),
    ("regions.png", |s, path| png::write_labels(path, &s.analysis.finals.labels)),
    ("stage-1-classification.png", |s, path| png::write_rgb(path, &stages::classification(s.analysis))),
    ("stage-2-merged.png", |s, path| png::write_rgb(path, &stages::colored(&s.analysis.areas))),
    ("stage-3-linear.png", |s, path| png::write_rgb(path, &in_final_colors(s, &s.analysis.matte.labels))),
    ("stage-4-planar.png", |s, path| png::write_rgb(path, &in_final_colors(s, &s.analysis.planar.labels))),
    ("stage-5-clipping.png", |s, path| png::write_rgb(path, &stages::colored(&s.analysis.finals.labels))),
];

/// Name and writer of the arrays, which a result folder holds where they are asked for.
pub(super) const ARRAYS: [(&str, Writer); 4] = [
    ("body.npy", |s, path| arrays::write_rgb(path, &s.analysis.intrinsic.body)),
    ("residual.npy", |s, path| arrays::write_rgb(path, &residual(s))),
    ("surface.npy", |s, path| arrays::write_rgb(path, &s.analysis.intrinsic.surface)),
    ("noise.npy", |s, path| arrays::write_single(path, &s.analysis.intrinsic.noise)),
];

/// Writes the pictures of a result into `folder`, in parallel: all files but the report and the matte photograph.
///
/// # Errors
/// The first file that could not be written.
pub fn write_pictures(folder: &Path, image: &LinearImage, analysis: &Analysis) -> Result<(), ExportError> {
    let is_array = |name: &str| ARRAYS.iter().any(|(array, _)| *array == name);
    write_pictures_watched(folder, image, analysis, &|name| !is_array(name), &|| Ok(()))
}

/// As [`write_pictures`], the pictures and arrays that `is_wanted` names; an error of `file_done`, which is called after each file, ends the writing.
pub(super) fn write_pictures_watched(
    folder: &Path,
    image: &LinearImage,
    analysis: &Analysis,
    is_wanted: &(dyn Fn(&str) -> bool + Sync),
    file_done: &(dyn Fn() -> Result<(), ExportError> + Sync),
) -> Result<(), ExportError> {
    let input = PictureInput { image, analysis };
    let wanted: Vec<_> = PICTURES.iter().chain(&ARRAYS).filter(|(name, _)| is_wanted(name)).collect();
    wanted.par_iter().with_max_len(1).try_for_each(|(name, write)| {
        write(&input, &folder.join(name))?;
        file_done()
    })
}

/// The regions of a stage in the colors of the final regions.
fn in_final_colors(input: &PictureInput, labels: &LabelMap) -> Raster<[u8; 3]> {
    stages::colored_like(labels, &input.analysis.finals.labels)
}

/// Input − body − surface, counts.
fn residual(input: &PictureInput) -> Raster<[f32; 3]> {
    let intrinsic = &input.analysis.intrinsic;
    let mut rest = input.image.pixels.clone();
    let explained = intrinsic.body.as_slice().iter().zip(intrinsic.surface.as_slice());
    for (rest, (body, surface)) in rest.as_mut_slice().iter_mut().zip(explained) {
        *rest = std::array::from_fn(|band| rest[band] - body[band] - surface[band]);
    }
    rest
}

/// Linear counts as sRGB values, with the contrast curve with which the photograph was read; 255 counts and more are white.
pub(super) fn viewable(counts: &Raster<[f32; 3]>, contrast: Option<ContrastCurve>) -> Raster<[u8; 3]> {
    match contrast.filter(|curve| !curve.is_straight()) {
        None => counts.map(|color| color.map(|value| code_from_linear(value / COUNTS_PER_UNIT))),
        Some(curve) => {
            counts.map(|color| color.map(|value| code_with_contrast(value / COUNTS_PER_UNIT, &curve)))
        }
    }
}

/// Shares as gray values, 0…1 as 0…255.
fn viewable_share(shares: &Raster<f32>) -> Raster<u8> {
    shares.map(|share| (255.0 * share).round() as u8)
}

/// ε as gray values: 128 where it is zero, 1 and 255 at the faces of the slice.
fn viewable_noise(analysis: &Analysis) -> Raster<u8> {
    let half_width = analysis.used.slice_half_width_counts() as f32;
    analysis.intrinsic.noise.map(|epsilon| (128.0 + 127.0 * epsilon / half_width).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Session;
    use crate::color::linear_from_srgb;
    use crate::intrinsic::Intrinsic;
    use crate::params::Params;
    use crate::trace::Class;
    use std::sync::Arc;

    const SIZE: (usize, usize) = (20, 10);

    #[test]
    fn pictures_have_the_values_of_a_file_that_was_read_with_a_contrast_curve() {
        let curve = ContrastCurve::new(1.3);
        let counts = |code: u8| 255.0 * linear_from_srgb(curve.undo(f64::from(code) / 255.0)) as f32;
        let colors = (0..=255).map(|code: u8| [counts(code); 3]).collect();
        let shown = viewable(&Raster::from_vec(256, 1, colors).unwrap(), Some(curve));
        assert!(shown.as_slice().iter().enumerate().all(|(code, shown)| shown.map(usize::from) == [code; 3]));
    }

    /// An image and its analysis with one region, surface reflection of 20 counts, and noise outside of the slice at one pixel.
    fn image_and_analysis() -> (Arc<LinearImage>, Analysis) {
        let image =
            Arc::new(LinearImage::new(Raster::filled(SIZE.0, SIZE.1, [90.0, 60.5, 33.0]), Some(255.0)));
        let mut analysis = Session::new(Arc::clone(&image)).run(&Params::paper(), &mut ()).unwrap();
        let mut noise = Raster::filled(SIZE.0, SIZE.1, 0.0);
        noise[1] = 10.0;
        noise[2] = -5.0;
        noise[3] = -99.0;
        analysis.intrinsic = Arc::new(Intrinsic {
            body: Raster::filled(SIZE.0, SIZE.1, [70.0, 40.0, 13.0]),
            surface: Raster::filled(SIZE.0, SIZE.1, [20.0; 3]),
            noise,
            ..Intrinsic::clone(&analysis.intrinsic)
        });
        Arc::make_mut(&mut analysis.finals).labels = Raster::filled(SIZE.0, SIZE.1, 300);
        Arc::make_mut(&mut analysis.windows).classes =
            Raster::from_vec(2, 1, vec![Some(Class::Line), None]).unwrap();
        (image, analysis)
    }

    #[test]
    fn the_residual_is_the_input_minus_body_and_surface() {
        let (image, analysis) = image_and_analysis();
        let rest = residual(&PictureInput { image: &image, analysis: &analysis });
        assert_eq!(rest[7].map(|counts| counts.to_string()), ["0", "0.5", "0"]);
    }

    /// The paper's slices are 4 × 2.5 = 10 counts to either side.
    #[test]
    fn noise_is_gray_within_the_slice() {
        let (_, analysis) = image_and_analysis();
        assert_eq!(viewable_noise(&analysis).row(0)[..4], [128, 255, 65, 0]);
    }

    #[test]
    fn windows_have_the_papers_colors() {
        let (_, analysis) = image_and_analysis();
        let picture = stages::classification(&analysis);
        assert_eq!((picture[9], picture[10]), ([255, 0, 0], [0, 0, 0]));
    }
}
