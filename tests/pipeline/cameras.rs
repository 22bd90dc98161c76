//! What cameras do to a picture: compression, a tone curve, and a wall behind the objects.

use crate::common::{analyze, srgb};
use crate::synthetic::{Random, Rendered, Scene};
use dichroscope::analysis::{Analysis, RunWarning, Session};
use dichroscope::color::ContrastCurve;
use dichroscope::describe::sentences;
use dichroscope::params::Params;
use dichroscope::photo::{CodingCause, EncodingChoice, LinearImage, ReadOptions, decode};
use dichroscope::segment::LightBasis;
use dichroscope::trace::{Event, HistoryKind};
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use std::sync::Arc;

fn jpeg(image: &LinearImage, quality: u8) -> Vec<u8> {
    let mut file = Vec::new();
    let (width, height) = (image.width() as u32, image.height() as u32);
    JpegEncoder::new_with_quality(&mut file, quality)
        .write_image(&srgb(image), width, height, ExtendedColorType::Rgb8)
        .unwrap();
    file
}

/// The image of a file, linear.
fn reread(file: &[u8]) -> LinearImage {
    Arc::unwrap_or_clone(decode(file, "photo", &ReadOptions::default()).unwrap().image)
}

/// Angle between the light that was found and white, degrees.
fn off_white_deg(analysis: &Analysis) -> f64 {
    let light = analysis.illuminant.unwrap().direction;
    (light.iter().sum::<f64>() / 3f64.sqrt()).clamp(-1.0, 1.0).acos().to_degrees()
}

fn balls() -> Scene {
    Scene::grid_of_balls([480, 320], 3, 2, 8)
}

/// The scene with a matt wall of the light's color behind the balls, 140 counts a band.
fn before_a_wall(scene: &Scene) -> Rendered {
    let mut rendered = scene.render();
    let mut noise = Random::new(3);
    let pixels = rendered.image.pixels.as_mut_slice().iter_mut().zip(rendered.labels.as_slice());
    for (color, _) in pixels.filter(|(_, label)| **label == 0) {
        *color = [0; 3].map(|_| (140.0 + scene.noise_sigma * noise.normal()).round() as f32);
    }
    rendered
}

#[test]
fn the_model_fits_plain_objects_in_compressed_files() {
    let image = reread(&jpeg(&balls().render().image, 90));
    assert_eq!(image.coding.as_ref().unwrap().cause, CodingCause::Compression);
    let analysis = analyze(&image, &Params::default());
    let regions = &analysis.intrinsic.regions;
    let fits = regions.iter().filter(|region| region.model_fits()).count();
    assert!(regions.len() == 6 && fits == 6, "{fits} of {}", regions.len());
    let off_deg = off_white_deg(&analysis);
    assert!(off_deg < 1.0, "the light is {off_deg} degrees off");
    // The error of the file explains the distance from the plane, which the noise of the windows alone does not.
    let unexplained = |analysis: &Analysis| {
        let regions = &analysis.intrinsic.regions;
        let ratios = regions.iter().map(|region| region.fit_rms_counts / region.fit_sigma_counts);
        ratios.sum::<f64>() / regions.len() as f64
    };
    let mut noise_alone = Params::default();
    noise_alone.refine.coding_error = false;
    let (both, noise_alone) = (unexplained(&analysis), unexplained(&analyze(&image, &noise_alone)));
    assert!(both > 0.7 && both < 1.3 && noise_alone > 1.4, "{both} and {noise_alone} standard deviations");
}

#[test]
fn fits_are_judged_by_the_noise_at_their_intensity_where_photons_are_counted() {
    let scene = Scene { noise_sigma: 0.0, ..balls() };
    let mut image = scene.render().image;
    let mut noise = Random::new(5);
    for color in image.pixels.as_mut_slice() {
        *color = color.map(|counts| {
            let sigma = (0.6 + 0.05 * f64::from(counts)).sqrt();
            (f64::from(counts) + sigma * noise.normal()).round().clamp(0.0, 255.0) as f32
        });
    }
    let analysis = analyze(&image, &Params::default());
    let shot = analysis.noise.shot.unwrap();
    // Rounding adds 1/12 counts².
    assert!((shot.sigma_at(0.0).powi(2) - 0.68).abs() < 0.3, "{shot:?}");
    assert!((shot.variance_per_count - 0.05).abs() < 0.01, "{shot:?}");
    // The distance from the plane in standard deviations, largest of all regions.
    let worst = |analysis: &Analysis| {
        let regions = analysis.intrinsic.regions.iter();
        regions.map(|region| region.fit_rms_counts / region.fit_sigma_counts).fold(0.0, f64::max)
    };
    let mut constant = Params::default();
    constant.refine.shot_noise = false;
    let (by_intensity, constant) = (worst(&analysis), worst(&analyze(&image, &constant)));
    assert!(
        by_intensity < 1.3 && by_intensity < constant,
        "{by_intensity} and {constant} standard deviations"
    );
    assert_eq!(analyze(&balls().render().image, &Params::default()).noise.shot, None);
}

#[test]
fn a_picture_that_was_compressed_before_is_recognized_in_a_lossless_file() {
    let rendered = balls().render().image;
    let png = |image: &LinearImage| {
        let mut file = Vec::new();
        PngEncoder::new(&mut file)
            .write_image(&srgb(image), image.width() as u32, image.height() as u32, ExtendedColorType::Rgb8)
            .unwrap();
        reread(&file)
    };
    let cause = |image: &LinearImage| {
        analyze(image, &Params::default()).noise.coding.as_ref().map(|coding| coding.cause)
    };
    assert_eq!(cause(&png(&rendered)), Some(CodingCause::Rounding));
    assert_eq!(cause(&png(&reread(&jpeg(&rendered, 80)))), Some(CodingCause::EarlierCompression));
    assert_eq!(cause(&rendered), None, "linear values have no error of their own");
}

#[test]
fn a_wall_of_the_lights_color_does_not_vote_the_objects_down() {
    let rendered = before_a_wall(&balls());
    for image in [rendered.image.clone(), reread(&jpeg(&rendered.image, 92))] {
        let analysis = analyze(&image, &Params::default());
        assert_eq!(analysis.planar.light.basis, LightBasis::Planes);
        let (off_deg, interval_deg) = (off_white_deg(&analysis), analysis.planar.light.interval_deg.unwrap());
        assert!(off_deg < 1.0 && off_deg < interval_deg, "{off_deg} degrees off, claimed {interval_deg}");
    }
}

/// The default parameters, but regions that reach beyond their object keep their split.
fn keeping_parts() -> Params {
    let mut params = Params::default();
    params.refine.border_edges = false;
    params.refine.plane_evidence = false;
    params
}

#[test]
fn the_rims_of_objects_before_a_wall_are_no_highlights() {
    let rendered = before_a_wall(&balls());
    let image = reread(&jpeg(&rendered.image, 92));
    // Surface reflection of the wall and of the rims that are mixed with the wall, which has none, sum of the bands over all pixels.
    let on_the_wall = |params: &Params| {
        let analysis = analyze(&image, params);
        let surface = analysis.intrinsic.surface.as_slice().iter().zip(rendered.labels.as_slice());
        surface.filter(|(_, label)| **label == 0).map(|(color, _)| color.iter().sum::<f32>()).sum::<f32>()
    };
    let (with, mut without) = (keeping_parts(), keeping_parts());
    without.refine.border_mixtures = false;
    let (limited, unlimited) = (on_the_wall(&with), on_the_wall(&without));
    assert!(unlimited > 100_000.0 && limited < 0.5 * unlimited, "{limited} of {unlimited} counts");
    let by_default = on_the_wall(&Params::default());
    assert!(
        by_default < limited,
        "{by_default} counts where parts of objects are recognized, {limited} where not"
    );
}

#[test]
fn the_history_of_a_mixed_pixel_tells_why_its_surface_reflection_is_limited() {
    let image = reread(&jpeg(&before_a_wall(&balls()).image, 92));
    let (analysis, trace) = Session::new(Arc::new(image)).run_traced(&keeping_parts(), &mut ()).unwrap();
    let limited = trace.events().find_map(|(_, event)| match event {
        Event::BordersLimited(limited) => limited.pixels.first(),
        _ => None,
    });
    let first = limited.unwrap();
    let history = analysis.pixel_history(&trace, first.pixel);
    let told = history.iter().find_map(|entry| match &entry.what {
        HistoryKind::Split(split) => split.border,
        _ => None,
    });
    assert_eq!(told.map(|border| border.kept), Some(first.kept));
}

#[test]
fn strong_compression_and_few_pixels_are_warned_of() {
    let warned = |image: &LinearImage, part: &str| {
        sentences(&analyze(image, &Params::default()).warnings).iter().any(|text| text.contains(part))
    };
    let rendered = balls().render().image;
    assert!(warned(&reread(&jpeg(&rendered, 40)), "compressed so strongly"));
    assert!(!warned(&reread(&jpeg(&rendered, 90)), "compressed so strongly"));
    let small = Scene::grid_of_balls([90, 60], 1, 1, 8).render().image;
    assert!(warned(&small, "has only 5400 pixels") && !warned(&rendered, "pixels: windows"));
}

/// The 8-bit picture of a camera with a contrast curve, read with another one.
fn contrasted(image: &LinearImage, camera: f64, read_with: EncodingChoice) -> LinearImage {
    let curve = ContrastCurve::new(camera);
    let curved = |code: u8| (255.0 * curve.apply(f64::from(code) / 255.0)).round() as u8;
    let codes: Vec<u8> = srgb(image).into_iter().map(curved).collect();
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(&codes, image.width() as u32, image.height() as u32, ExtendedColorType::Rgb8)
        .unwrap();
    let options = ReadOptions { encoding: read_with, ..ReadOptions::default() };
    Arc::unwrap_or_clone(decode(&file, "photo.png", &options).unwrap().image)
}

/// The contrasts that the warnings of a run tell of.
fn told_contrasts(analysis: &Analysis) -> Vec<f64> {
    let told = |warning: &RunWarning| match warning {
        RunWarning::Contrast(found) => Some(found.contrast),
        _ => None,
    };
    analysis.warnings.iter().filter_map(told).collect()
}

#[test]
fn the_contrast_curve_of_a_camera_is_told_and_undone_where_it_is_given() {
    let image = balls().render().image;
    let told_with = |camera, read_with| {
        let analysis = analyze(&contrasted(&image, camera, read_with), &Params::default());
        (told_contrasts(&analysis), off_white_deg(&analysis))
    };
    let (told, bent_deg) = told_with(1.3, EncodingChoice::Auto);
    assert!(told.len() == 1 && (told[0] - 1.3).abs() < 0.05, "{told:?}");
    let (told, off_deg) = told_with(1.3, EncodingChoice::Contrast(1.3));
    assert!(
        told.is_empty() && off_deg < 0.5 && off_deg < bent_deg,
        "{told:?}, {off_deg} degrees, before {bent_deg}"
    );
    assert!(told_with(1.0, EncodingChoice::Auto).0.is_empty(), "sRGB alone");
    let (told, _) = told_with(1.0, EncodingChoice::Contrast(1.3));
    assert!(
        told.len() == 1 && (told[0] - 1.0).abs() < 0.05,
        "read with a contrast that the camera has not: {told:?}"
    );
}
