//! The working picture: a large photograph is averaged, and split at full resolution by what its mean tells.

use crate::common::{analyze, faults, fingerprint, largest_gap, may_be_cut, report, scores_of, truth_of};
use crate::synthetic::{Scene, dot};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::params::{Method, Params, Setting};
use dichroscope::raster::{PixelIndex, UNASSIGNED};
use dichroscope::trace::PixelKind;
use std::sync::Arc;

fn scaled(factor: usize) -> Params {
    Params { scale: Setting::Value(factor as f64), ..Params::default() }
}

/// A scene of six balls whose picture has a size that is no multiple of 2 or 3.
fn scene(seed: u64) -> Scene {
    Scene::grid_of_balls([619, 421], 3, 2, seed)
}

/// A scene as a camera with `times` as many pixels a side sees it.
fn enlarged(scene: &Scene, times: usize) -> Scene {
    let mut larger = scene.clone();
    larger.size_px = scene.size_px.map(|side| side * times);
    for ball in &mut larger.balls {
        ball.center_px = ball.center_px.map(|at| at * times as f64);
        ball.radius_px *= times as f64;
    }
    larger
}

/// Whether a pixel was not restored, and has surface reflection or is in no region: then nothing of its color was cut off.
fn is_whole(analysis: &Analysis, pixel: usize) -> bool {
    let intrinsic = &analysis.intrinsic;
    let is_cut = analysis.finals.labels[pixel] != UNASSIGNED && may_be_cut(analysis, pixel);
    !is_cut && !matches!(intrinsic.kinds[pixel], PixelKind::Restored | PixelKind::Lost)
}

#[test]
fn body_surface_and_noise_are_the_input_at_full_resolution() {
    for (seed, factor) in [(1, 2), (2, 3), (3, 3), (4, 5)] {
        let image = scene(seed).render().image;
        let analysis = analyze(&image, &scaled(factor));
        assert_eq!(analysis.working.blocks.side(), factor);
        let (gap, looked_at) = largest_gap(&image, &analysis, |pixel| is_whole(&analysis, pixel));
        assert!(gap < 1e-2, "seed {seed}, scale {factor}: {gap} counts");
        assert!(looked_at > 100_000, "seed {seed}, scale {factor}: {looked_at} pixels");
        // Numbers go by the size in the working picture, which may differ at full resolution by a few pixels.
        let mut faults = faults(&image, &analysis);
        faults.retain(|fault| !fault.contains("sorted by size"));
        assert!(faults.is_empty(), "seed {seed}, scale {factor}: {faults:?}");
    }
}

#[test]
fn an_automatic_scale_leaves_small_pictures_alone() {
    let image = Scene::grid_of_balls([240, 160], 3, 2, 5).render().image;
    let [automatic, one] = [Params::default(), scaled(1)].map(|params| analyze(&image, &params));
    assert_eq!(fingerprint(&automatic), fingerprint(&one));
    assert!(Arc::ptr_eq(&one.finals, &one.working_finals), "nothing is computed twice");
    assert_eq!(one.pixel_place(PixelIndex::from_index(0)), None);
}

#[test]
fn one_thread_and_four_find_the_same_with_and_without_a_record() {
    let image = scene(7).render().image;
    let of = |threads: usize, traced: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut session = Session::new(Arc::new(image.clone()));
        let params = scaled(2);
        let analysis = pool.install(|| {
            if traced {
                session.run_traced(&params, &mut ()).unwrap().0
            } else {
                session.run(&params, &mut ()).unwrap()
            }
        });
        (fingerprint(&analysis), report(&analysis, &params).to_json().unwrap())
    };
    let alone = of(1, false);
    assert!(alone == of(4, false), "threads change the result");
    assert!(alone == of(2, true), "a record changes the result");
}

#[test]
fn a_scene_is_the_same_at_every_size_of_its_picture() {
    for seed in [11, 12] {
        let small = Scene::grid_of_balls([288, 192], 3, 2, seed);
        let mut lights = Vec::new();
        for times in [1, 2, 4] {
            let scene = enlarged(&small, times);
            let rendered = scene.render();
            let params = scaled(times);
            let analysis = analyze(&rendered.image, &params);
            let light = analysis.illuminant.unwrap().direction;
            let error_deg = dot(light, scene.illuminant).min(1.0).acos().to_degrees();
            let scores = scores_of(&truth_of(&scene, &rendered), &rendered.image, &analysis, &params);
            assert_eq!(scores.regions, 6, "seed {seed}, {times} times");
            assert!(scores.ari > 0.99, "seed {seed}, {times} times: ARI {}", scores.ari);
            lights.push(light);
            assert!(error_deg < 1.0, "seed {seed}, {times} times: {error_deg} degrees");
        }
        for light in &lights[1..] {
            let apart_deg = dot(*light, lights[0]).min(1.0).acos().to_degrees();
            assert!(apart_deg < 0.3, "seed {seed}: {apart_deg} degrees from the small picture");
        }
    }
}

#[test]
fn borders_and_counts_are_those_of_the_photograph() {
    let scene = enlarged(&Scene::grid_of_balls([288, 192], 3, 2, 11), 2);
    let rendered = scene.render();
    let truth = truth_of(&scene, &rendered);
    let scores = [1, 2].map(|factor| {
        let params = scaled(factor);
        scores_of(&truth, &rendered.image, &analyze(&rendered.image, &params), &params)
    });
    assert!(scores[1].ari > scores[0].ari - 0.003, "ARI {} averaged, {} not", scores[1].ari, scores[0].ari);
    assert_eq!([scores[0].regions, scores[1].regions], [6, 6]);
}

#[test]
fn an_area_and_a_picture_without_light_are_no_trouble() {
    let image = scene(10).render().image;
    let inside = (0..image.pixels.len()).map(|pixel| pixel % 619 > 100 && pixel % 619 < 401).collect();
    let area = dichroscope::raster::Mask::from_vec(619, 421, inside).unwrap();
    let mut session = Session::new(Arc::new(image));
    session.restrict(Some(Arc::new(area.clone()))).unwrap();
    let analysis = session.run(&scaled(3), &mut ()).unwrap();
    let labels = analysis.finals.labels.as_slice();
    assert!(labels.iter().zip(area.as_slice()).all(|(&label, &inside)| inside || label == UNASSIGNED));
    assert!(labels.iter().filter(|&&label| label != UNASSIGNED).count() > 10_000);
    let black = crate::common::picture(7, 5, |_, _| [0.0; 3]);
    for factor in [2, 3, 16] {
        let analysis = analyze(&black, &scaled(factor));
        assert!(faults(&black, &analysis).is_empty());
    }
}

#[test]
fn the_papers_method_is_not_averaged_unless_told() {
    let image = Scene::grid_of_balls([1600, 1200], 2, 2, 3).render().image;
    let paper = analyze(&image, &Params::of(Method::Paper));
    assert_eq!(paper.working.blocks.side(), 1);
    let told = Params { scale: Setting::Auto, ..Params::of(Method::Paper) };
    assert_eq!(analyze(&image, &told).working.blocks.side(), 2);
}

#[test]
fn the_history_is_that_of_the_working_pixel_and_the_place_says_what_the_pixel_took() {
    let image = scene(13).render().image;
    let mut session = Session::new(Arc::new(image.clone()));
    let (analysis, trace) = session.run_traced(&scaled(3), &mut ()).unwrap();
    assert_eq!((trace.width(), trace.height()), (207, 141));
    for pixel in [0, 100 * 619 + 103, 210 * 619 + 300, image.pixels.len() - 1] {
        let pixel = PixelIndex::from_index(pixel);
        let place = analysis.pixel_place(pixel).unwrap();
        assert_eq!(place.side, 3);
        assert_eq!(
            place.region,
            dichroscope::raster::RegionId::from_label(analysis.finals.labels[pixel.index()])
        );
        assert!(!analysis.pixel_history(&trace, pixel).is_empty());
    }
    assert!(analysis.pixel_history(&trace, PixelIndex::from_index(image.pixels.len())).is_empty());
}
