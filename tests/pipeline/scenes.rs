//! Accuracy that the pipeline must reach on scenes with ground truth.

use crate::common::{analyze, assert_valid, scores_of, truth_of};
use crate::synthetic::{Ball, Scene, unit};
use dichroscope::describe::Scores;
use dichroscope::params::{Params, Refine};
use dichroscope::photo::{ReadOptions, read};
use dichroscope::truth::GroundTruth;
use proptest::prelude::*;
use std::path::Path;

fn scores(scene: &Scene) -> Scores {
    let rendered = scene.render();
    let params = Params::default();
    let analysis = analyze(&rendered.image, &params);
    assert_valid(&rendered.image, &analysis, "scene");
    scores_of(&truth_of(scene, &rendered), &rendered.image, &analysis, &params)
}

/// Fails unless each score is at least as good as its limit, and the body image is clearly better than the input.
#[track_caller]
fn assert_reaches(found: &Scores, least: &Scores) {
    let at_least = |name, found: Option<f64>, least: Option<f64>| {
        if let Some(least) = least {
            assert!(found.is_some_and(|found| found >= least), "{name}: {found:?} < {least}");
        }
    };
    at_least("ari", Some(found.ari), Some(least.ari));
    at_least("iou", found.iou, least.iou);
    at_least("iou_min", found.iou_min, least.iou_min);
    at_least("cover", found.cover, least.cover);
    at_least("psnr_body", found.psnr_body, least.psnr_body);
    at_least("psnr_surface", found.psnr_surface, least.psnr_surface);
    at_least("psnr_restored", found.psnr_restored, least.psnr_restored);
    at_least("what was gained", found.psnr_body, found.psnr_nothing.map(|nothing| nothing + 10.0));
    assert_eq!(found.objects, least.objects, "objects");
    assert!(found.regions <= least.regions, "{} regions", found.regions);
    assert!(found.body_deg <= least.body_deg, "body vectors off by {:?}\u{b0}", found.body_deg);
    assert!(found.illum_deg <= least.illum_deg, "the light is off by {}\u{b0}", found.illum_deg);
}

#[test]
fn the_tiny_scene() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/tiny");
    let truth = GroundTruth::read(&folder).unwrap();
    let image = read(&folder.join("camera8.png"), &ReadOptions::default()).unwrap().image;
    let params = Params::default();
    let analysis = analyze(&image, &params);
    assert_valid(&image, &analysis, "tiny");
    let found = scores_of(&truth, &image, &analysis, &params);
    assert_reaches(
        &found,
        &Scores {
            ari: 0.985,
            iou: Some(0.985),
            iou_min: Some(0.98),
            cover: Some(0.99),
            regions: 4,
            objects: 4,
            body_deg: Some(0.06),
            illum_deg: 0.6,
            psnr_body: Some(47.0),
            psnr_surface: Some(51.0),
            psnr_restored: Some(35.0),
            ..Scores::default()
        },
    );
}

#[test]
fn one_ball_without_noise() {
    let found = scores(&Scene::one_ball([120, 100], [0.2, 0.9, 0.3]));
    assert_reaches(
        &found,
        &Scores {
            ari: 1.0,
            iou: Some(1.0),
            iou_min: Some(1.0),
            cover: Some(1.0),
            regions: 1,
            objects: 1,
            body_deg: Some(0.03),
            illum_deg: 1.0,
            psnr_body: Some(58.0),
            psnr_surface: Some(57.0),
            psnr_restored: Some(42.0),
            ..Scores::default()
        },
    );
}

#[test]
fn one_noisy_ball() {
    let scene = Scene { noise_sigma: 1.25, eight_bit: true, ..Scene::one_ball([120, 100], [0.9, 0.5, 0.1]) };
    let found = scores(&scene);
    assert_reaches(
        &found,
        &Scores {
            ari: 1.0,
            iou: Some(0.995),
            iou_min: Some(0.995),
            cover: Some(0.995),
            regions: 1,
            objects: 1,
            body_deg: Some(0.04),
            illum_deg: 1.0,
            psnr_body: Some(47.0),
            psnr_surface: Some(49.5),
            psnr_restored: Some(38.0),
            ..Scores::default()
        },
    );
}

#[test]
fn six_balls_in_yellow_light() {
    let scene = Scene { illuminant: unit([0.7, 0.6, 0.4]), ..Scene::grid_of_balls([240, 160], 3, 2, 7) };
    let found = scores(&scene);
    assert_reaches(
        &found,
        &Scores {
            ari: 0.995,
            iou: Some(0.995),
            iou_min: Some(0.99),
            cover: Some(0.995),
            regions: 6,
            objects: 6,
            body_deg: Some(0.07),
            illum_deg: 0.3,
            psnr_body: Some(46.5),
            psnr_surface: Some(49.0),
            psnr_restored: Some(33.0),
            ..Scores::default()
        },
    );
}

/// Figure 11: under white light, a red and a cyan object have the same dichromatic plane, so that the slice of each
/// contains
/// the colors of the other.
#[test]
fn coplanar_neighbors_keep_their_pixels() {
    let mut scene = Scene::one_ball([150, 100], [0.9, 0.25, 0.25]);
    let red = Ball { center_px: [50.0, 50.0], body: unit([0.9, 0.25, 0.25]), ..scene.balls[0] };
    let cyan = Ball { center_px: [102.0, 50.0], radius_px: 36.0, body: unit([0.2, 0.8, 0.8]), ..red };
    scene = Scene { balls: vec![red, cyan], noise_sigma: 1.25, eight_bit: true, ..scene };
    let rendered = scene.render();
    // With slices of unlimited length, only the provision for coplanar neighbors (section 5.4.2) separates the
    // objects.
    let refine = Refine { slice_bounds: false, ..Refine::default() };
    for params in [Params::default(), Params { refine, ..Params::default() }] {
        let analysis = analyze(&rendered.image, &params);
        let found = scores_of(&truth_of(&scene, &rendered), &rendered.image, &analysis, &params);
        assert!(found.iou_min > Some(0.98) && found.ari > 0.98, "{found:#?}");
        assert_eq!(found.regions, 2);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn every_ball_is_found(seed in any::<u64>(), columns in 2usize..=3, rows in 1usize..=2) {
        let scene = Scene::grid_of_balls([80 * columns, 80 * rows], columns, rows, seed);
        let found = scores(&scene);
        let balls = scene.balls.len();
        prop_assert_eq!(found.objects, balls);
        prop_assert!(found.regions <= balls + 1, "{} regions of {} balls", found.regions, balls);
        prop_assert!(found.iou_min.unwrap() > 0.9, "{:?}", found.iou_min);
        prop_assert!(found.body_deg.unwrap() < 0.5, "{:?}", found.body_deg);
        prop_assert!(found.illum_deg < 2.0, "{}", found.illum_deg);
    }
}
