//! The result of an analysis restricted to an area does not depend on pixels outside of the area.

use crate::common::{METHODS, analyze, assert_valid, fingerprint, report};
use crate::synthetic::Scene;
use dichroscope::analysis::{Analysis, RunWarning, Session};
use dichroscope::params::{Method, Params};
use dichroscope::photo::LinearImage;
use dichroscope::raster::{Mask, UNASSIGNED};
use proptest::prelude::*;
use std::sync::Arc;

/// A mask of the rectangle at `left, top` of `width × height` pixels.
fn rectangle(image: &LinearImage, [left, top, width, height]: [usize; 4]) -> Arc<Mask> {
    let inside = |pixel: usize| {
        let (x, y) = (pixel % image.width(), pixel / image.width());
        (left..left + width).contains(&x) && (top..top + height).contains(&y)
    };
    let data = (0..image.pixels.len()).map(inside).collect();
    Arc::new(Mask::from_vec(image.width(), image.height(), data).unwrap())
}

fn restricted(image: &LinearImage, area: &Arc<Mask>, params: &Params) -> Analysis {
    let mut session = Session::new(Arc::new(image.clone()));
    session.restrict(Some(Arc::clone(area))).unwrap();
    session.run(params, &mut ()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn nothing_outside_is_assigned_and_nothing_outside_matters(
        seed in any::<u64>(),
        rect in (0usize..100, 0usize..40, 30usize..120, 20usize..80),
        paper in any::<bool>(),
    ) {
        let mut image = Scene::grid_of_balls([160, 80], 2, 1, seed).render().image;
        let area = rectangle(&image, [rect.0, rect.1, rect.2, rect.3]);
        let params = Params::of(METHODS[usize::from(paper)]);
        let analysis = restricted(&image, &area, &params);
        assert_valid(&image, &analysis, "restricted");
        for pixel in 0..image.pixels.len() {
            prop_assert_eq!(analysis.masks.outside(pixel), !area[pixel]);
            prop_assert!(area[pixel] || analysis.finals.labels[pixel] == UNASSIGNED);
        }
        let report = report(&analysis, &params);
        let assigned: usize = report.regions.iter().map(|region| region.pixels).sum();
        let inside = area.as_slice().iter().filter(|&&inside| inside).count();
        prop_assert_eq!(assigned + report.unassigned_pixels, inside);
        // With other colors outside, the regions are the same. The colors are darker, so that none blooms into the
        // area.
        for pixel in (0..image.pixels.len()).filter(|&pixel| !area[pixel] && !analysis.masks.clipped(pixel)) {
            image.pixels[pixel] = image.pixels[pixel].map(|band| 100.0 - band / 3.0);
        }
        let other = restricted(&image, &area, &params);
        prop_assert!(other.finals == analysis.finals);
        prop_assert!(other.windows == analysis.windows && other.planar == analysis.planar);
    }
}

#[test]
fn the_whole_picture_is_no_restriction() {
    let image = Scene::grid_of_balls([160, 80], 2, 1, 4).render().image;
    let whole = rectangle(&image, [0, 0, 160, 80]);
    // The method by hand asks for an area: without one it warns, and no pixel is at the edge of an area.
    for method in METHODS.into_iter().filter(|&method| method != Method::ByHand) {
        let params = Params::of(method);
        assert!(fingerprint(&restricted(&image, &whole, &params)) == fingerprint(&analyze(&image, &params)));
    }
}

#[test]
fn an_area_may_change_and_go_and_must_have_the_shape_of_the_picture() {
    let image = Arc::new(Scene::grid_of_balls([160, 80], 2, 1, 6).render().image);
    let (left, params) = (rectangle(&image, [0, 0, 80, 80]), Params::default());
    let mut session = Session::new(Arc::clone(&image));
    let whole = session.run(&params, &mut ()).unwrap();
    assert_eq!(whole.intrinsic.regions.len(), 2, "two balls");
    session.restrict(Some(Arc::clone(&left))).unwrap();
    let half = session.run(&params, &mut ()).unwrap();
    assert_eq!(half.intrinsic.regions.len(), 1, "one ball in the left half");
    assert!(fingerprint(&half) == fingerprint(&restricted(&image, &left, &params)));
    let message = session.restrict(Some(Arc::new(Mask::filled(3, 2, true)))).unwrap_err().to_string();
    assert_eq!(message, "the area has 3 \u{d7} 2 pixels, the photograph 160 \u{d7} 80");
    session.restrict(None).unwrap();
    assert!(fingerprint(&session.run(&params, &mut ()).unwrap()) == fingerprint(&whole));
    session.restrict(Some(Arc::new(Mask::filled(160, 80, false)))).unwrap();
    let nothing = session.run(&params, &mut ()).unwrap();
    assert_eq!(nothing.warnings[0], RunWarning::Dark { is_restricted: true });
}

#[test]
fn one_thread_and_four_find_the_same_in_an_area() {
    let image = Scene::grid_of_balls([240, 160], 3, 2, 9).render().image;
    let area = rectangle(&image, [30, 20, 150, 110]);
    for method in METHODS {
        let [alone, together] = [1, 4].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| fingerprint(&restricted(&image, &area, &Params::of(method))))
        });
        assert!(alone == together, "{method:?}");
    }
}
