//! Body, surface and noise add up to the input.

use crate::common::{METHODS, analyze, largest_gap, may_be_cut};
use crate::synthetic::Scene;
use dichroscope::analysis::Analysis;
use dichroscope::params::{Params, Refine};
use dichroscope::raster::RegionId;
use dichroscope::trace::PixelKind;

/// Whether an undistorted pixel lies in a region with a plane; with `unclamped`, and has surface reflection so far off the body line
/// that nothing of it was cut or fades.
fn is_whole(analysis: &Analysis, pixel: usize, unclamped: bool) -> bool {
    let intrinsic = &analysis.intrinsic;
    let region = RegionId::from_label(analysis.finals.labels[pixel]);
    let has_plane = region.is_some_and(|region| intrinsic.regions[region.index()].plane_normal.is_some());
    let undistorted = matches!(intrinsic.kinds[pixel], PixelKind::Matte | PixelKind::Highlight);
    has_plane && undistorted && !(unclamped && may_be_cut(analysis, pixel))
}

#[test]
fn body_and_surface_and_noise_are_the_input() {
    for seed in [1, 2, 3] {
        let image = Scene::grid_of_balls([240, 80], 3, 1, seed).render().image;
        // The earlier methods have no planes.
        for method in METHODS.into_iter().filter(|&method| Params::of(method).baseline().is_none()) {
            let params = Params::of(method);
            let unclamped = params.refinements().no_negative_surface;
            let analysis = analyze(&image, &params);
            let (gap, looked_at) =
                largest_gap(&image, &analysis, |pixel| is_whole(&analysis, pixel, unclamped));
            assert!(gap < 1e-2, "seed {seed}, {method:?}: {gap} counts");
            assert!(looked_at > 500, "seed {seed}, {method:?}: only {looked_at} pixels");
        }
        let refine = Refine { no_negative_surface: false, ..Refine::default() };
        let all = analyze(&image, &Params { refine, ..Params::default() });
        let (gap, looked_at) = largest_gap(&image, &all, |pixel| is_whole(&all, pixel, false));
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
