//! Ambient light (section 7.5): equal in every pixel, estimated from the point where the matte lines meet, and added to the body
//! image after the split.

use crate::common::{analyze, assert_valid, scores_of, truth_of};
use crate::prints::photograph;
use crate::synthetic::{Rendered, Scene};
use dichroscope::analysis::Session;
use dichroscope::params::{AmbientSetting, Params};
use dichroscope::raster::PixelIndex;
use dichroscope::trace::{AmbientVerdict, HistoryKind, pixel_history};
use std::sync::Arc;

/// The ambient light of the scenes, counts.
const AMBIENT: [f32; 3] = [5.0, 7.0, 9.0];

fn balls(seed: u64) -> Scene {
    Scene::grid_of_balls([320, 240], 2, 2, seed)
}

/// The scene with ambient light added to all pixels; the ambient light belongs to the body reflection.
fn with_ambient_light(scene: &Scene) -> Rendered {
    let mut rendered = scene.render();
    for body in rendered.body.as_mut_slice() {
        *body = std::array::from_fn(|band| body[band] + AMBIENT[band]);
    }
    rendered.image = photograph(&rendered, scene.noise_sigma);
    rendered
}

#[test]
fn ambient_light_is_found_and_the_body_image_is_as_good_as_without() {
    for seed in [51, 52, 53] {
        let scene = balls(seed);
        let (clear, hazy) = (scene.render(), with_ambient_light(&scene));
        let params = Params::default();
        let score = |rendered: &Rendered, params: &Params| {
            let analysis = analyze(&rendered.image, params);
            assert_valid(&rendered.image, &analysis, "ambient");
            let ambient = analysis.intrinsic.ambient;
            (scores_of(&truth_of(&scene, rendered), &rendered.image, &analysis, params), ambient)
        };
        let (without, none) = score(&clear, &params);
        assert_eq!(none.subtracted, None, "seed {seed}: {none:?}");
        let (found, ambient) = score(&hazy, &params);
        let subtracted = ambient.subtracted.unwrap();
        for band in 0..3 {
            let off = (subtracted[band] - f64::from(AMBIENT[band])).abs();
            assert!(off < 1.0, "seed {seed}: {ambient:?}");
        }
        assert!(found.psnr_body.unwrap() > without.psnr_body.unwrap() - 1.0, "{found:?}, {without:?}");
        let (left, off) = score(&hazy, &Params { ambient: AmbientSetting::Off, ..params });
        assert_eq!(off.verdict, AmbientVerdict::Off);
        assert!(found.psnr_body.unwrap() > left.psnr_body.unwrap() + 2.0, "{found:?}, {left:?}");
    }
}

#[test]
fn the_history_of_a_pixel_counts_from_the_ambient_light() {
    let image = Arc::new(with_ambient_light(&balls(51)).image);
    let params = Params { ambient: AmbientSetting::Given(AMBIENT.map(f64::from)), ..Params::default() };
    let (analysis, trace) = Session::new(image.clone()).run_traced(&params, &mut ()).unwrap();
    let matte = (0..image.pixels.len()).find(|&pixel| {
        let [body, surface] =
            [&analysis.intrinsic.body, &analysis.intrinsic.surface].map(|image| image[pixel]);
        analysis.finals.labels[pixel] > 0 && body[0] > 60.0 && surface == [0.0; 3]
    });
    let pixel = matte.unwrap();
    let history = pixel_history(&trace, &image, &analysis.masks, PixelIndex::from_index(pixel));
    let split = history.iter().find_map(|happening| match &happening.what {
        HistoryKind::Split(story) => Some(**story),
        _ => None,
    });
    let story = split.unwrap();
    assert_eq!(story.ambient, AMBIENT.map(f64::from));
    let body = analysis.intrinsic.body[pixel];
    let above_ambient: [f32; 3] = std::array::from_fn(|band| body[band] - AMBIENT[band]);
    let length = above_ambient.iter().map(|band| band * band).sum::<f32>().sqrt();
    assert!((story.amounts.unwrap().body - length).abs() < 0.1, "{story:?} {length}");
}
