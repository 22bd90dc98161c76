//! Body, surface and noise add up to the input.

use crate::common::{METHODS, analyze};
use crate::synthetic::Scene;
use dichroscope::analysis::Analysis;
use dichroscope::params::{Params, Refine};
use dichroscope::photo::LinearImage;
use dichroscope::raster::UNASSIGNED;
use dichroscope::trace::PixelKind;

/// Largest difference between input and body + surface + ε·n, counts, over the undistorted pixels of regions with a
/// plane,
/// and the number of these pixels. With `unclamped`, only pixels with surface reflection count.
fn largest_gap(image: &LinearImage, analysis: &Analysis, unclamped: bool) -> (f32, usize) {
    let intrinsic = &analysis.intrinsic;
    let (mut gap, mut looked_at) = (0f32, 0);
    for (pixel, &label) in analysis.finals.labels.as_slice().iter().enumerate() {
        let undistorted = matches!(intrinsic.kinds[pixel], PixelKind::Matte | PixelKind::Highlight);
        if label == UNASSIGNED || !undistorted || (unclamped && intrinsic.surface[pixel] == [0.0; 3]) {
            continue;
        }
        let region = &intrinsic.regions[usize::from(label) - 1];
        let Some(normal) = region.plane_normal else { continue };
        looked_at += 1;
        for (band, along) in normal.into_iter().enumerate() {
            let noise = intrinsic.noise[pixel] * along as f32;
            let sum = intrinsic.body[pixel][band] + intrinsic.surface[pixel][band] + noise;
            gap = gap.max((sum - image.pixels[pixel][band]).abs());
        }
    }
    (gap, looked_at)
}

#[test]
fn body_and_surface_and_noise_are_the_input() {
    for seed in [1, 2, 3] {
        let image = Scene::grid_of_balls([240, 80], 3, 1, seed).render().image;
        for method in METHODS {
            let params = Params::of(method);
            let unclamped = params.refinements().no_negative_surface;
            let (gap, looked_at) = largest_gap(&image, &analyze(&image, &params), unclamped);
            assert!(gap < 1e-2, "seed {seed}, {method:?}: {gap} counts");
            assert!(looked_at > 500, "seed {seed}, {method:?}: only {looked_at} pixels");
        }
        let refine = Refine { no_negative_surface: false, ..Refine::default() };
        let all = analyze(&image, &Params { refine, ..Params::default() });
        let (gap, looked_at) = largest_gap(&image, &all, false);
        assert!(gap < 1e-2 && looked_at > 4000, "seed {seed}: {gap} counts in {looked_at} pixels");
    }
}

#[test]
fn a_clamped_pixel_is_all_body_and_never_brighter_than_its_input() {
    let image = Scene::grid_of_balls([160, 80], 2, 1, 9).render().image;
    let analysis = analyze(&image, &Params::default());
    let mut clamped = 0;
    for (pixel, &kind) in analysis.intrinsic.kinds.as_slice().iter().enumerate() {
        if kind == PixelKind::Matte && analysis.intrinsic.surface[pixel] == [0.0; 3] {
            clamped += 1;
            let length = |color: [f32; 3]| color.iter().map(|v| v * v).sum::<f32>().sqrt();
            let (body, input) = (analysis.intrinsic.body[pixel], image.pixels[pixel]);
            assert!(length(body) <= length(input) + 1e-3, "{body:?} of {input:?}");
        }
    }
    assert!(clamped > 1000, "only {clamped} clamped pixels: most of a ball is matte");
}

#[test]
fn surface_reflection_is_never_negative() {
    let image = Scene::grid_of_balls([160, 80], 2, 1, 10).render().image;
    let analysis = analyze(&image, &Params::default());
    assert!(analysis.intrinsic.surface.as_slice().iter().flatten().all(|&v| v >= 0.0));
}
