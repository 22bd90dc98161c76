//! Pictures that the model does not explain: printed objects, and pictures without highlights.

use crate::common::{analyze, assert_valid, scores_of, truth_of};
use crate::synthetic::{FULL_SCALE, Random, Rendered, Scene};
use dichroscope::params::{IlluminantSetting, Params, Refine};
use dichroscope::photo::LinearImage;
use dichroscope::raster::Raster;
use dichroscope::segment::LightBasis;

/// The scene with a checkerboard of 9 px squares printed on the balls: in every other square, the bands of the body
/// reflection
/// are permuted and scaled by 0.7.
pub fn printed(scene: &Scene) -> Rendered {
    let mut rendered = scene.render();
    let width = rendered.body.width();
    for (pixel, body) in rendered.body.as_mut_slice().iter_mut().enumerate() {
        if (pixel % width / 9 + pixel / width / 9).is_multiple_of(2) {
            *body = [0.7 * body[1], 0.7 * body[2], 0.7 * body[0]];
        }
    }
    rendered.image = photograph(&rendered, scene.noise_sigma);
    rendered
}

pub fn photograph(rendered: &Rendered, noise_sigma: f64) -> LinearImage {
    let mut noise = Random::new(5);
    let both = rendered.body.as_slice().iter().zip(rendered.surface.as_slice());
    let mut seen = |counts: f32| {
        (f64::from(counts) + noise_sigma * noise.normal()).round().clamp(0.0, FULL_SCALE) as f32
    };
    let pixels = both.map(|(body, surface)| [0, 1, 2].map(|band| seen(body[band] + surface[band]))).collect();
    let raster = Raster::from_vec(rendered.body.width(), rendered.body.height(), pixels).unwrap();
    LinearImage::new(raster, Some(FULL_SCALE as f32))
}

/// Peak signal-to-noise ratio, dB: 10·log10(255² / mean squared difference).
fn psnr_db(a: &Raster<[f32; 3]>, b: &Raster<[f32; 3]>) -> f64 {
    let pairs = a.as_slice().iter().flatten().zip(b.as_slice().iter().flatten());
    let squares: f64 = pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum();
    10.0 * (FULL_SCALE * FULL_SCALE * (3 * a.len()) as f64 / squares.max(1e-9)).log10()
}

#[test]
fn a_printed_scene_is_never_worse_than_its_photograph() {
    for seed in [31, 32, 33] {
        let scene = Scene {
            illuminant: crate::synthetic::unit([1.1, 1.0, 0.9]),
            ..Scene::grid_of_balls([320, 160], 2, 1, seed)
        };
        let rendered = printed(&scene);
        let params = Params::default();
        let analysis = analyze(&rendered.image, &params);
        assert_valid(&rendered.image, &analysis, "printed");
        let [nothing, found] =
            [&rendered.image.pixels, &analysis.intrinsic.body].map(|b| psnr_db(b, &rendered.body));
        assert!(found >= nothing - 0.01, "seed {seed}: {found} dB, doing nothing {nothing} dB");
        let scores = scores_of(&truth_of(&scene, &rendered), &rendered.image, &analysis, &params);
        assert!(scores.psnr_body >= scores.psnr_nothing, "seed {seed}: {scores:?}");
        let planes_alone =
            Refine { region_holds: false, far_colors: false, vote_light: false, ..Refine::default() };
        let before = analyze(&rendered.image, &Params { refine: planes_alone, ..params });
        let before = psnr_db(&before.intrinsic.body, &rendered.body);
        assert!(found >= before - 0.01, "seed {seed}: {found} dB, planes alone {before} dB");
    }
}

#[test]
fn print_that_lies_far_from_the_plane_of_its_region_is_not_split_by_that_plane() {
    let scene = Scene {
        illuminant: crate::synthetic::unit([1.1, 1.0, 0.9]),
        ..Scene::grid_of_balls([320, 160], 2, 1, 31)
    };
    let rendered = printed(&scene);
    let body_db = |far_colors: bool| {
        let refine = Refine { region_holds: false, vote_light: false, far_colors, ..Refine::default() };
        let analysis = analyze(&rendered.image, &Params { refine, ..Params::default() });
        psnr_db(&analysis.intrinsic.body, &rendered.body)
    };
    let [with, without] = [true, false].map(body_db);
    assert!(with > without + 3.0, "{with} dB with far colors left to the local split, {without} dB without");
}

#[test]
fn a_picture_of_body_reflection_stays_as_it_is() {
    for seed in [41, 42] {
        let scene = Scene { noise_sigma: 0.0, ..Scene::grid_of_balls([320, 160], 2, 1, seed) };
        for print in [false, true] {
            let mut rendered = if print { printed(&scene) } else { scene.render() };
            rendered.surface = Raster::filled(rendered.body.width(), rendered.body.height(), [0.0; 3]);
            let image = photograph(&rendered, 0.0);
            let analysis = analyze(&image, &Params::default());
            let left = psnr_db(&analysis.intrinsic.body, &image.pixels);
            assert!(left > 45.0, "seed {seed}, print {print}: {left} dB between input and body");
        }
    }
}

const LAMP: [f64; 3] = [1.1, 1.0, 0.9];

/// The photograph of two balls under [`LAMP`], plain or printed.
fn two_balls(seed: u64, print: bool) -> LinearImage {
    let illuminant = crate::synthetic::unit(LAMP);
    let scene = Scene { illuminant, ..Scene::grid_of_balls([320, 160], 2, 1, seed) };
    if print { printed(&scene).image } else { scene.render().image }
}

/// Two balls, printed or not, and parameters with which highlights are taken off them: nothing tells the light of a picture of prints
/// alone, so that the light of these is given.
fn with_highlights() -> impl Iterator<Item = (LinearImage, Params, Raster<[f32; 3]>, String)> {
    [(31, false), (32, false), (31, true), (32, true), (33, true)].into_iter().map(|(seed, print)| {
        let image = two_balls(seed, print);
        let given = IlluminantSetting::Given(crate::synthetic::unit(LAMP));
        let params =
            if print { Params { illuminant: given, ..Params::default() } } else { Params::default() };
        let body = analyze(&image, &params).intrinsic.body.clone();
        let taken_off = psnr_db(&body, &image.pixels);
        assert!(taken_off < 40.0, "seed {seed}, print {print}: {taken_off} dB between input and body");
        (image, params, body, format!("seed {seed}, print {print}"))
    })
}

#[test]
fn the_body_image_as_input_stays_as_it_is() {
    for (_, params, body, scene) in with_highlights() {
        let coded = body.map(|color| color.map(|band| band.round().clamp(0.0, FULL_SCALE as f32)));
        let again = analyze(&LinearImage::new(coded.clone(), Some(FULL_SCALE as f32)), &params);
        let left = psnr_db(&again.intrinsic.body, &coded);
        assert!(left > 45.0, "{scene}: {left} dB between input and body");
    }
}

/// The worst similarity of the result of each scene to that of the scene shifted by 1 to 11 px, decibels, with the refinements that `with` leaves on.
fn worst_similarity_after_a_shift(with: impl Fn(Params) -> Params) -> f64 {
    let mut worst = f64::INFINITY;
    for (image, params, ..) in with_highlights() {
        let params = with(params);
        let body = analyze(&image, &params).intrinsic.body.clone();
        for shift in [1, 4, 7, 11] {
            let shifted = |raster: &Raster<[f32; 3]>| {
                let rows = (shift..raster.height()).flat_map(|y| raster.row(y)[shift..].to_vec());
                Raster::from_vec(raster.width() - shift, raster.height() - shift, rows.collect()).unwrap()
            };
            let found = analyze(&LinearImage::new(shifted(&image.pixels), Some(FULL_SCALE as f32)), &params);
            worst = worst.min(psnr_db(&found.intrinsic.body, &shifted(&body)));
        }
    }
    worst
}

#[test]
fn a_shift_of_the_picture_hardly_changes_the_result() {
    let without = worst_similarity_after_a_shift(|params| Params {
        refine: Refine { hue_restoration: false, ..params.refine },
        ..params
    });
    assert!(without > 60.0, "without bands restored by hue: {without} dB");
    // A clipped check of a print, whose hue is taken from the checks around, changes by less than the noise.
    let with = worst_similarity_after_a_shift(|params| params);
    assert!(with > 50.0, "{with} dB");
}

#[test]
fn plain_balls_hold_and_their_planes_tell_of_the_light() {
    let image = Scene::grid_of_balls([240, 160], 3, 2, 8).render().image;
    let analysis = analyze(&image, &Params::default());
    assert!(analysis.intrinsic.regions.iter().all(|region| region.model_fits() && region.confidence > 0.3));
    let light = analysis.planar.light;
    assert!(light.basis == LightBasis::Planes && light.support > 0.9, "{light:?}");
    assert!(light.interval_deg.is_some_and(|interval| interval > 0.0 && interval < 5.0), "{light:?}");
    let sure = analysis.intrinsic.confidence.as_slice().iter().filter(|&&share| share > 0.5).count();
    let assigned = analysis.finals.labels.as_slice().iter().filter(|&&label| label != 0).count();
    assert!(sure * 10 > assigned * 8, "{sure} of {assigned}");
}
