//! Degenerate pictures, and parameters at the ends of their ranges, give a result or a warning, but never a panic.

use crate::common::{METHODS, analyze, any_readings, assert_valid, faults, picture};
use crate::synthetic::{Random, Scene};
use dichroscope::analysis::{Analysis, RunWarning, Session};
use dichroscope::describe::sentences;
use dichroscope::params::{Method, Parameter, Params, Setting, Switch};
use dichroscope::photo::LinearImage;
use dichroscope::raster::{HypothesisId, RegionId};
use dichroscope::trace::Replay;
use proptest::prelude::*;
use std::sync::Arc;

fn noise(width: usize, height: usize, seed: u64) -> LinearImage {
    let mut random = Random::new(seed);
    let colors: Vec<[f32; 3]> =
        (0..width * height).map(|_| [0; 3].map(|_| random.between(0.0, 255.0) as f32)).collect();
    picture(width, height, |x, y| colors[y * width + x])
}

fn pictures() -> Vec<(&'static str, LinearImage)> {
    let flat = |v: f32| move |_, _| [v; 3];
    let gradient = |x: usize, y: usize| [(x * 20) as f32, (y * 9) as f32, 30.0];
    let bad = |x: usize, y: usize| match (x + y) % 5 {
        0 => [f32::NAN, 10.0, 20.0],
        1 => [f32::INFINITY; 3],
        2 => [-5.0, 3.0, f32::NEG_INFINITY],
        _ => [(x * 3) as f32, (y * 2) as f32, 40.0],
    };
    let huge = |x: usize, y: usize| [1e30 * (x as f32 + 1.0), 5e29, 1e29 * y as f32];
    let spike =
        |x: usize, y: usize| if (x, y) == (20, 20) { [f32::MAX; 3] } else { [x as f32 * 3.0, 50.0, 20.0] };
    vec![
        ("nothing", picture(0, 0, flat(0.0))),
        ("no rows", picture(7, 0, flat(0.0))),
        ("one pixel", picture(1, 1, flat(90.0))),
        ("one row", picture(57, 1, gradient)),
        ("one column", picture(1, 57, gradient)),
        ("three by three", picture(3, 3, gradient)),
        ("smaller than a window", picture(9, 8, gradient)),
        ("black", picture(40, 30, flat(0.0))),
        ("white", picture(40, 30, flat(255.0))),
        ("one color", picture(40, 30, |_, _| [120.0, 60.0, 20.0])),
        (
            "two colors",
            picture(40, 30, |x, _| if x < 20 { [120.0, 60.0, 20.0] } else { [20.0, 90.0, 150.0] }),
        ),
        ("gray ramp", picture(60, 40, |x, _| [x as f32 * 4.0; 3])),
        ("color ramp", picture(60, 40, |x, y| [x as f32 * 4.0, x as f32 * 2.0, (x + y % 2) as f32])),
        ("clipped ramp", picture(60, 40, |x, _| [200.0 + x as f32, 255.0, 255.0])),
        ("noise", noise(64, 48, 5)),
        ("nan and infinity", picture(40, 30, bad)),
        ("only nan", picture(40, 30, flat(f32::NAN))),
        ("huge", picture(40, 30, huge)),
        ("largest", picture(40, 30, flat(f32::MAX))),
        ("a spike", picture(40, 30, spike)),
        ("tiny values", picture(40, 30, |x, y| [1e-30 * x as f32, 1e-38, f32::MIN_POSITIVE * y as f32])),
        ("ball", Scene::grid_of_balls([60, 60], 1, 1, 4).render().image),
    ]
}

/// For each method: the defaults, all parameters at their smallest, all at their largest, and each parameter alone at
/// its
/// smallest and largest.
fn ends_of_ranges(method: Method) -> Vec<(String, Params)> {
    let base = Params::of(method);
    let mut all = vec![("defaults".to_owned(), base)];
    let ends: [fn([f64; 2]) -> f64; 2] = [|range| range[0], |range| range[1]];
    for (name, end) in ["smallest", "largest"].into_iter().zip(ends) {
        let mut every = base;
        for parameter in Parameter::ALL {
            let setting = Setting::Value(end(parameter.spec().range));
            *every.slot(parameter) = setting;
            let mut alone = base;
            *alone.slot(parameter) = setting;
            all.push((format!("{name} {}", parameter.spec().name), alone));
        }
        all.push((format!("everything {name}"), every));
    }
    let mut automatic = base;
    for parameter in Parameter::ALL {
        *automatic.slot(parameter) = Setting::Auto;
    }
    all.push(("everything automatic".to_owned(), automatic));
    all
}

#[test]
fn a_picture_without_a_pixel_that_can_be_used_says_whether_all_is_dark_or_clipped() {
    let first = |image: &LinearImage| analyze(image, &Params::default()).warnings[0].clone();
    let white_square = |x: usize, y: usize| if x.max(y) < 20 { [255.0; 3] } else { [0.0; 3] };
    assert_eq!(first(&picture(40, 30, |_, _| [0.0; 3])), RunWarning::Dark { is_restricted: false });
    for clipped in [picture(40, 30, |_, _| [255.0; 3]), picture(40, 30, white_square)] {
        assert_eq!(first(&clipped), RunWarning::Clipped { is_restricted: false });
    }
    let gray_square = |x: usize, y: usize| if x.max(y) < 20 { [90.0; 3] } else { [0.0; 3] };
    assert!(matches!(first(&picture(40, 30, gray_square)), RunWarning::UnknownLight(_)));
}

#[test]
fn every_picture_at_every_end_of_every_range() {
    let pictures = pictures();
    let mut not_in_vain = 0;
    for method in METHODS {
        for (params_name, params) in ends_of_ranges(method) {
            params.validate().unwrap();
            for (name, image) in &pictures {
                let analysis = analyze(image, &params);
                assert_valid(image, &analysis, &format!("{name}, {method:?}, {params_name}"));
                not_in_vain += usize::from(!analysis.intrinsic.regions.is_empty());
            }
        }
    }
    assert!(not_in_vain > 100, "only {not_in_vain} results had a region to go wrong");
}

#[test]
fn a_picture_without_anything_says_why() {
    for (name, says) in
        [("nothing", "darker"), ("black", "darker"), ("only nan", "darker"), ("noise", "no linear area")]
    {
        let image = pictures().into_iter().find(|(other, _)| *other == name).unwrap().1;
        // Phoenix and the clusters find regions in noise too.
        let finds_noise =
            |method: &Method| says == "darker" || matches!(method, Method::Refined | Method::Paper);
        for method in METHODS.into_iter().filter(finds_noise) {
            let analysis = analyze(&image, &Params::of(method));
            assert!(
                analysis.intrinsic.regions.is_empty(),
                "{name}, {method:?}: {:?}",
                analysis.intrinsic.regions
            );
            let says = if method == Method::ByHand { "neither dark nor clipped" } else { says };
            assert!(
                sentences(&analysis.warnings).iter().any(|text| text.contains(says)),
                "{name}: {:?}",
                analysis.warnings
            );
        }
    }
}

/// A small picture of a few flat or shaded patches with noise.
fn small_picture() -> impl Strategy<Value = LinearImage> {
    let patch = (
        0usize..24,
        0usize..24,
        8usize..40,
        8usize..40,
        prop::array::uniform3(0f32..300.0),
        prop::bool::weighted(0.8),
    );
    (
        prop_oneof![1 => 1usize..=8, 3 => 16usize..=48],
        prop_oneof![1 => 1usize..=8, 3 => 16usize..=48],
        prop::collection::vec(patch, 0..5),
        0f64..3.0,
        any::<u64>(),
    )
        .prop_map(|(width, height, patches, sigma, seed)| {
            let mut random = Random::new(seed);
            let mut image = picture(width, height, |x, y| {
                let inside = patches.iter().rev().find(|(left, top, w, h, ..)| {
                    (*left..left + w).contains(&x) && (*top..top + h).contains(&y)
                });
                inside.map_or([0.0; 3], |&(left, _, w, _, color, shaded)| {
                    let light = if shaded { (x - left + 1) as f32 / w as f32 } else { 1.0 };
                    color.map(|v| (v * light).min(255.0))
                })
            });
            for value in image.pixels.as_mut_slice().as_flattened_mut() {
                *value = (*value + (sigma * random.normal()) as f32).clamp(0.0, 255.0);
            }
            image
        })
}

/// Random parameters: most have the method's default, so that regions are found; the others have any value of their
/// range. Refinements and readings are random, except that half of the runs of the paper's method have no refinement.
fn any_params() -> impl Strategy<Value = Params> {
    let choice = prop_oneof![6 => Just(None), 1 => Just(Some(None)), 1 => (0f64..=1.0).prop_map(|share| Some(Some(share)))];
    let choices = prop::collection::vec(choice, Parameter::ALL.len());
    let switches = prop::collection::vec(any::<bool>(), Switch::ALL.len());
    let method = prop_oneof![
        4 => Just(Method::Refined),
        4 => Just(Method::Paper),
        1 => Just(Method::Phoenix),
        1 => Just(Method::TopDown),
        1 => Just(Method::ByHand),
    ];
    (method, any::<bool>(), choices, switches, any_readings()).prop_map(
        |(method, adds_refinements, choices, switches, readings)| {
            let mut params = Params::of(method);
            params.min_area = Setting::Value(60.0);
            for (parameter, choice) in Parameter::ALL.into_iter().zip(choices) {
                let spec = parameter.spec();
                let [low, high] = spec.range;
                // Useful values of wide ranges lie near the lower end.
                let between = |share: f64| low + (high.min(300.0) - low) * share * share;
                let whole = |value: f64| if spec.whole { value.round() } else { value };
                match choice {
                    None => {}
                    Some(None) => *params.slot(parameter) = Setting::Auto,
                    Some(Some(share)) => *params.slot(parameter) = Setting::Value(whole(between(share))),
                }
            }
            for (switch, on) in Switch::ALL.into_iter().zip(switches) {
                params.refine.set(switch, on);
                params.paper.with.set(switch, on && adds_refinements);
            }
            params.paper.readings = readings;
            params
        },
    )
}

/// More cases where a whole night is free.
fn cases() -> u32 {
    if std::env::var_os("DICHROSCOPE_LONG_TESTS").is_some() { 100_000 } else { 2048 }
}

/// The fault of a recorded run, if there is one: another result than without a record, or a replay that ends in another.
fn fault_of_record(image: &LinearImage, params: &Params, plain: &Analysis) -> Option<&'static str> {
    let (analysis, trace) = Session::new(Arc::new(image.clone())).run_traced(params, &mut ()).ok()?;
    if analysis.finals.labels != plain.finals.labels || analysis.intrinsic.body != plain.intrinsic.body {
        return Some("recording changes the result");
    }
    let mut replay = Replay::new(Arc::new(trace));
    let end = replay.trace().len();
    replay.seek(end);
    let finals = replay.labels().map(|&label| {
        RegionId::label(HypothesisId::from_label(label).and_then(|hypothesis| replay.region_of(hypothesis)))
    });
    (finals != analysis.working_finals.labels).then_some("the replay ends in another result")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn any_small_picture_with_any_parameters_gives_a_valid_result(
        image in small_picture(),
        params in any_params(),
        recorded in any::<bool>(),
    ) {
        prop_assert!(params.validate().is_ok());
        let analysis = analyze(&image, &params);
        let faults = faults(&image, &analysis);
        prop_assert!(faults.is_empty(), "{:?}", faults);
        if recorded {
            prop_assert_eq!(fault_of_record(&image, &params, &analysis), None);
        }
    }
}
