//! The skewed T of marked pixels (section 6, first paragraph): exact scenes, areas without a skewed T, and the bundled picture.

use crate::common::{analyze, assert_valid, fingerprint, picture};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::baseline::{LEAST_MARKED_PX, MarkedSkewedT, NoSkewedT, no_skewed_t};
use dichroscope::describe::sentences;
use dichroscope::params::{IlluminantSetting, Method, Params, Setting};
use dichroscope::photo::{LinearImage, ReadOptions, read};
use dichroscope::raster::{Mask, Raster};
use dichroscope::segment::LightBasis;
use dichroscope::trace::PixelKind;
use dichroscope::truth::GroundTruth;
use std::path::Path;
use std::sync::Arc;

fn unit(vector: [f64; 3]) -> [f64; 3] {
    let norm = vector.iter().map(|band| band * band).sum::<f64>().sqrt();
    vector.map(|band| band / norm)
}

fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    let cosine: f64 = unit(a).iter().zip(unit(b)).map(|(a, b)| a * b).sum();
    cosine.abs().min(1.0).acos().to_degrees()
}

const BODY: [f64; 3] = [0.9, 0.3, 0.2];
const LIGHT: [f64; 3] = [0.5, 0.6, 0.55];
/// Amount of body reflection under the highlight, counts.
const START: f64 = 110.0;

/// Amounts of body and surface reflection of a pixel of the object: a ramp of 40 to 140 counts from left to right, and a highlight in the
/// columns of 110 counts, which gets stronger from the first row to the last.
fn amounts(x: usize, y: usize) -> [f64; 2] {
    let body = 40.0 + 2.5 * x as f64;
    if (26..31).contains(&x) && y >= 8 { [START, 3.0 * (y - 7) as f64] } else { [body, 0.0] }
}

/// An object of 40 × 40 pixels in the middle of a picture of 60 × 50 pixels whose other pixels are green.
fn exact_scene() -> (LinearImage, Arc<Mask>) {
    let inside = |x: usize, y: usize| (10..50).contains(&x) && (5..45).contains(&y);
    let image = picture(60, 50, |x, y| {
        if !inside(x, y) {
            return [30.0, 120.0, 40.0];
        }
        let [body, surface] = amounts(x - 10, y - 5);
        let (b, s) = (unit(BODY), unit(LIGHT));
        std::array::from_fn(|band| (body * b[band] + surface * s[band]) as f32)
    });
    let mask = (0..60 * 50).map(|pixel| inside(pixel % 60, pixel / 60)).collect();
    (image, Arc::new(Raster::from_vec(60, 50, mask).unwrap()))
}

fn by_hand(image: &LinearImage, area: &Arc<Mask>, params: &Params) -> Analysis {
    let mut session = Session::new(Arc::new(image.clone()));
    session.restrict(Some(Arc::clone(area))).unwrap();
    session.run(params, &mut ()).unwrap()
}

fn params() -> Params {
    Params::of(Method::ByHand)
}

fn why_not(analysis: &Analysis) -> Option<NoSkewedT> {
    no_skewed_t(&analysis.working.masks, &analysis.matte, &analysis.planar)
}

#[test]
fn an_exact_skewed_t_gives_its_vectors_its_meeting_point_and_the_exact_split_of_the_marked_pixels_alone() {
    let (image, area) = exact_scene();
    let analysis = by_hand(&image, &area, &params());
    assert_valid(&image, &analysis, "by hand");
    assert_eq!(sentences(&analysis.warnings).iter().filter(|text| text.contains("skewed T")).count(), 0);
    let [region] = analysis.intrinsic.regions.as_slice() else { panic!("one region") };
    assert!(region.model_fits() && region.fit_rms_counts < 0.05, "{region:?}");
    assert!(angle_deg(region.body, BODY) < 0.05 && angle_deg(region.surface.unwrap(), LIGHT) < 0.1);
    let light = analysis.illuminant.unwrap();
    assert!(angle_deg(light.direction, LIGHT) < 0.1 && light.objects == 1);
    assert_eq!(analysis.finals.light.basis, LightBasis::ByHand);
    let found = MarkedSkewedT::of(&analysis.matte, &analysis.planar).unwrap();
    let meeting = unit(BODY).map(|band| band * START);
    for (found, true_value) in found.meeting_point.into_iter().zip(meeting) {
        assert!((found - true_value).abs() < 0.5, "{found} {true_value}");
    }
    // The matte line ends at 137.5 counts.
    assert!((found.position_percent - 100.0 * START / 137.5).abs() < 1.5, "{}", found.position_percent);
    assert!(found.gap_counts < 0.1 && found.highlight_rms_counts < 0.1);
    for pixel in 0..image.pixels.len() {
        let (x, y) = (pixel % 60, pixel / 60);
        if !area[pixel] {
            assert_eq!(analysis.intrinsic.body[pixel], image.pixels[pixel], "outside of the area");
            assert_eq!(analysis.intrinsic.kinds[pixel], PixelKind::Unassigned);
            continue;
        }
        let [_, surface] = amounts(x - 10, y - 5);
        let split =
            analysis.intrinsic.surface[pixel].iter().map(|band| f64::from(*band).powi(2)).sum::<f64>();
        assert!((split.sqrt() - surface).abs() < 0.5, "{x},{y}: {} {surface}", split.sqrt());
        assert_eq!(analysis.finals.labels[pixel], 1);
    }
}

#[test]
fn the_result_depends_on_the_set_of_pixels_alone() {
    let (image, area) = exact_scene();
    let before = fingerprint(&by_hand(&image, &area, &params()));
    // Pixels outside of the area may have any color.
    let mut other = image.clone();
    for pixel in 0..other.pixels.len() {
        if !area[pixel] {
            other.pixels.as_mut_slice()[pixel] = [150.0, 10.0, 99.0];
        }
    }
    let changed = by_hand(&other, &area, &params());
    let same = by_hand(&image, &area, &params());
    assert_eq!(before, fingerprint(&same));
    assert_eq!(changed.intrinsic.regions, same.intrinsic.regions);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let alone = one_thread.install(|| by_hand(&image, &area, &params()));
    assert_eq!(before, fingerprint(&alone));
}

#[test]
fn areas_without_a_skewed_t_are_told_in_a_sentence() {
    let body = unit(BODY);
    let ramp = picture(40, 40, |x, _| body.map(|band| (band * (50.0 + 2.0 * x as f64)) as f32));
    let all = Arc::new(Mask::filled(40, 40, true));
    let check =
        |image: &LinearImage, area: &Arc<Mask>, expected: NoSkewedT, sentence: &str, regions: usize| {
            let analysis = by_hand(image, area, &params());
            assert_valid(image, &analysis, sentence);
            assert_eq!((why_not(&analysis), analysis.intrinsic.regions.len()), (Some(expected), regions));
            let told = sentences(&analysis.warnings).iter().any(|text| text.contains(sentence));
            assert!(told && analysis.illuminant.is_none(), "{:?}", analysis.warnings);
            assert_eq!(analysis.intrinsic.body, image.pixels, "nothing is split");
        };
    check(&ramp, &all, NoSkewedT::Line, "lie on one line: there is no highlight", 1);
    let flat = picture(40, 40, |_, _| [120.0, 60.0, 40.0]);
    check(&flat, &all, NoSkewedT::Point, "vary no more than the noise does", 0);
    let few = (0..1600).map(|pixel| pixel < LEAST_MARKED_PX - 1).collect();
    let few = Arc::new(Raster::from_vec(40, 40, few).unwrap());
    check(&ramp, &few, NoSkewedT::TooFew(LEAST_MARKED_PX - 1), "needs 20", 0);
    let none = Arc::new(Mask::filled(40, 40, false));
    check(&ramp, &none, NoSkewedT::TooFew(0), "only 0 of the marked pixels", 0);
    let black = picture(40, 40, |_, _| [2.0, 2.0, 2.0]);
    check(&black, &all, NoSkewedT::TooFew(0), "only 0 of the marked pixels", 0);
    // A highlight line that gets darker in a band: two matte objects.
    let two = picture(40, 40, |x, y| {
        let along = 60.0 + 3.0 * y as f32;
        if x < 20 { [along, along * 0.3, along * 0.2] } else { [along * 0.2, along * 0.3, along] }
    });
    let analysis = by_hand(&two, &all, &params());
    assert_eq!(analysis.intrinsic.body, two.pixels, "two objects are not split: {:?}", analysis.warnings);
    assert!(
        sentences(&analysis.warnings).iter().any(|text| text.contains("skewed T")),
        "{:?}",
        analysis.warnings
    );
}

#[test]
fn lines_that_are_nearly_parallel_are_not_split() {
    // Under pink light the highlights of two cups are nearly in line with their bodies.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/cups3_pink");
    let truth = GroundTruth::read(&folder).unwrap();
    let image = read(&folder.join("camera8.png"), &ReadOptions::default()).unwrap().image;
    for id in [1, 2] {
        let analysis = by_hand(&image, &Arc::new(truth.labels.map(|&label| label == id)), &params());
        assert_eq!(why_not(&analysis), Some(NoSkewedT::Parallel), "{id}");
        assert!(sentences(&analysis.warnings).iter().any(|text| text.contains("less than 3\u{b0} apart")));
        assert_eq!(analysis.intrinsic.body, image.pixels, "never worse than the photograph");
    }
}

#[test]
fn several_hues_do_not_hold_and_no_area_is_the_whole_picture() {
    let hues = [[200.0, 60.0, 40.0], [40.0, 180.0, 60.0], [50.0, 60.0, 190.0], [180.0, 170.0, 40.0]];
    let image = picture(60, 60, |x, y| {
        let light = 0.4 + 0.6 * (y as f32 / 60.0);
        hues[x / 15].map(|band| band * light)
    });
    let analysis = analyze(&image, &params());
    assert_valid(&image, &analysis, "hues");
    let said = sentences(&analysis.warnings).join("; ");
    assert!(said.contains("no pixels were marked") && said.contains("skewed T"), "{said}");
    assert!(analysis.intrinsic.regions.iter().all(|region| !region.model_fits()));
    assert_eq!(analysis.intrinsic.body, image.pixels, "never worse than the photograph");
}

#[test]
fn a_given_light_is_the_surface_vector_and_a_larger_scale_splits_exactly_the_marked_pixels() {
    let (image, area) = exact_scene();
    let given = Params { illuminant: IlluminantSetting::Given([1.0, 1.0, 1.0]), ..params() };
    let analysis = by_hand(&image, &area, &given);
    assert!(angle_deg(analysis.intrinsic.regions[0].surface.unwrap(), [1.0; 3]) < 1e-6);
    assert!(analysis.illuminant.unwrap().given);
    let coarse = Params { scale: Setting::Value(2.0), ..params() };
    let analysis = by_hand(&image, &area, &coarse);
    assert_valid(&image, &analysis, "coarse");
    let labels = analysis.finals.labels.as_slice();
    assert!(labels.iter().zip(area.as_slice()).all(|(&label, &marked)| label == u16::from(marked)));
    assert!(angle_deg(analysis.intrinsic.regions[0].body, BODY) < 0.3);
}

#[test]
fn on_the_plastic_objects_it_is_as_good_as_the_papers_method_where_the_highlight_is_clear() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/plastic8_white");
    let truth = GroundTruth::read(&folder).unwrap();
    let image = read(&folder.join("camera8.png"), &ReadOptions::default()).unwrap().image;
    let body_vector = |id: u16| truth.objects.iter().find(|object| object.id == id).unwrap().body_vector;
    let (mut bodies, mut lights) = (Vec::new(), Vec::new());
    for id in 1..=8 {
        let area = Arc::new(truth.labels.map(|&label| label == id));
        let analysis = by_hand(&image, &area, &params());
        assert_valid(&image, &analysis, "plastic");
        let [region] = analysis.intrinsic.regions.as_slice() else { panic!("one region of object {id}") };
        bodies.push(angle_deg(region.body, body_vector(id).unwrap()));
        lights.push(region.surface.map_or(90.0, |surface| angle_deg(surface, truth.illuminant)));
    }
    assert!(bodies.iter().all(|&degrees| degrees < 0.3), "{bodies:?}");
    lights.sort_by(f64::total_cmp);
    assert!(lights[2] < 5.0 && lights[4] < 10.0, "{lights:?}");
}
