//! Two lamps of different colors, each of which lights a half of the scene (section 7.5).

use crate::common::{analyze, assert_valid, fingerprint, report};
use crate::synthetic::{Scene, dot, unit};
use dichroscope::analysis::{Analysis, RunWarning, Session};
use dichroscope::describe::Names;
use dichroscope::params::{IlluminantSetting, Params, Refine};
use dichroscope::photo::LinearImage;
use dichroscope::raster::Raster;
use dichroscope::trace::{Event, Kind, LampOfRegion, Replay};
use std::sync::Arc;

/// The colors of a lamp on the left and of a lamp on the right, 12.6° apart.
const LAMPS: [[f64; 3]; 2] = [[0.68, 0.58, 0.45], [0.54, 0.57, 0.62]];

/// Ten balls; the first lamp lights the six on the left, the second the four on the right. The picture and its body reflection, counts.
fn half_and_half(seed: u64) -> (LinearImage, Raster<[f32; 3]>) {
    let scene = Scene::grid_of_balls([400, 160], 5, 2, seed);
    let [left, right] = LAMPS.map(|lamp| Scene { illuminant: unit(lamp), ..scene.clone() }.render());
    let width = left.body.width();
    let colors = left.image.pixels.as_slice().iter().zip(right.image.pixels.as_slice()).enumerate();
    let colors = colors.map(|(pixel, (left, right))| if pixel % width < 240 { *left } else { *right });
    let pixels = Raster::from_vec(width, left.body.height(), colors.collect()).unwrap();
    (LinearImage::new(pixels, Some(255.0)), left.body)
}

/// Peak signal to noise ratio of a picture of the body reflection, dB.
fn psnr(body: &Raster<[f32; 3]>, truth: &Raster<[f32; 3]>) -> f64 {
    let error =
        |(a, b): (&[f32; 3], &[f32; 3])| (0..3).map(|band| f64::from(a[band] - b[band]).powi(2)).sum::<f64>();
    let sum: f64 = body.as_slice().iter().zip(truth.as_slice()).map(error).sum();
    10.0 * (255.0 * 255.0 * 3.0 * truth.len() as f64 / sum).log10()
}

fn angle_deg(a: [f64; 3], b: [f64; 3]) -> f64 {
    dot(a, unit(b)).clamp(-1.0, 1.0).acos().to_degrees()
}

/// The lamps that an analysis found, the first and the second.
fn lamps_of(analysis: &Analysis) -> [Option<[f64; 3]>; 2] {
    let light = analysis.finals.light;
    [light.direction, light.second.map(|second| second.direction)]
}

#[test]
fn each_region_is_split_with_the_lamp_of_its_own_highlights() {
    for seed in [4, 9] {
        let (image, truth) = half_and_half(seed);
        let params = Params::default();
        let analysis = analyze(&image, &params);
        assert_valid(&image, &analysis, "two lamps");
        let [Some(first), Some(second)] = lamps_of(&analysis) else { panic!("seed {seed}: no second lamp") };
        assert!(
            angle_deg(first, LAMPS[0]) < 1.0 && angle_deg(second, LAMPS[1]) < 2.0,
            "{first:?} {second:?}"
        );
        let facts = report(&analysis, &params).illuminant.second.unwrap();
        assert!(
            facts.objects >= 2
                && facts.interval_deg.is_some_and(|degrees| degrees < 5.0)
                && (facts.angle_deg - 12.6).abs() < 3.0,
            "{facts:?}"
        );
        let one = Params { refine: Refine { second_lamp: false, ..Refine::default() }, ..params };
        let with_one = psnr(&analyze(&image, &one).intrinsic.body, &truth);
        let with_two = psnr(&analysis.intrinsic.body, &truth);
        let nothing = psnr(&image.pixels, &truth);
        assert!(with_two > with_one + 5.0 && with_one > nothing, "{with_two} {with_one} {nothing} dB");
    }
}

#[test]
fn one_lamp_is_no_two() {
    for (seed, lamp) in (0..6).zip(LAMPS.iter().cycle()) {
        let scene = Scene { illuminant: unit(*lamp), ..Scene::grid_of_balls([400, 160], 5, 2, seed) };
        assert_eq!(
            analyze(&scene.render().image, &Params::default()).finals.light.second,
            None,
            "seed {seed}"
        );
    }
}

#[test]
fn the_record_tells_of_both_lamps_and_changes_nothing() {
    let (image, _) = half_and_half(4);
    let (image, params) = (Arc::new(image), Params::default());
    let (analysis, trace) = Session::new(Arc::clone(&image)).run_traced(&params, &mut ()).unwrap();
    assert!(fingerprint(&analysis) == fingerprint(&analyze(&image, &params)));
    let trace = Arc::new(trace);
    let compared: Vec<&Event> =
        trace.events().map(|(_, event)| event).filter(|event| event.kind() == Kind::Lamps).collect();
    let [Event::LampsCompared(lamps)] = compared[..] else { panic!("{compared:?}") };
    let [first, second] = lamps_of(&analysis);
    assert_eq!([Some(lamps.first), lamps.second], [first, second]);
    assert!(lamps.agreeing >= 2 && lamps.regions.iter().any(LampOfRegion::is_second), "{lamps:?}");
    let sentence = Names::of(&trace).event(compared[0]);
    assert!(
        sentence.starts_with("a second lamp, ") && sentence.contains("contradict the first"),
        "{sentence}"
    );
    let mut replay = Replay::new(Arc::clone(&trace));
    replay.seek(trace.len());
    assert_eq!(replay.light(), first, "the first light remains the light of the scene");
}

/// The default parameters with lights given or left to be found.
fn with_lights(first: Option<[f64; 3]>, second: Option<[f64; 3]>) -> Params {
    let setting = |light: Option<[f64; 3]>| light.map_or(IlluminantSetting::Auto, IlluminantSetting::Given);
    Params { illuminant: setting(first), second_illuminant: setting(second), ..Params::default() }
}

/// The unit direction of a given light.
fn given(light: [f64; 3]) -> Option<[f64; 3]> {
    IlluminantSetting::Given(light).direction()
}

/// How many regions have the color of each lamp as surface reflection vector, exactly.
fn regions_of_lamps(analysis: &Analysis) -> [usize; 2] {
    let surfaces = || analysis.intrinsic.regions.iter().filter_map(|region| region.surface);
    LAMPS.map(|lamp| surfaces().filter(|&surface| angle_deg(surface, lamp) < 1e-3).count())
}

#[test]
fn given_lamps_are_used_as_they_are_and_divide_the_regions_as_the_halves_of_the_scene_do() {
    for seed in [4, 9, 21] {
        let (image, truth) = half_and_half(seed);
        let params = with_lights(Some(LAMPS[0]), Some(LAMPS[1].map(|band| 7.0 * band)));
        let analysis = analyze(&image, &params);
        assert_valid(&image, &analysis, "two given lamps");
        for (used, lamp) in lamps_of(&analysis).into_iter().zip(LAMPS) {
            assert!(
                angle_deg(used.unwrap(), lamp) < 1e-5,
                "seed {seed}: {used:?} of {lamp:?}, of any length"
            );
        }
        assert_eq!(regions_of_lamps(&analysis), [6, 4], "seed {seed}: balls of the left and of the right");
        let lamp_of =
            |region: usize| angle_deg(analysis.intrinsic.regions[region].surface.unwrap(), LAMPS[0]) > 1.0;
        let labels = &analysis.finals.labels;
        let is_right = |pixel: usize| pixel % labels.width() >= 240;
        let wrong = (0..labels.len())
            .filter(|&pixel| labels[pixel] > 0 && lamp_of(usize::from(labels[pixel]) - 1) != is_right(pixel));
        assert!(wrong.count() < labels.len() / 500, "seed {seed}");
        let with_one = analyze(&image, &with_lights(Some(LAMPS[0]), None));
        let [one, two] = [&with_one, &analysis].map(|analysis| psnr(&analysis.intrinsic.body, &truth));
        assert!(two > one + 5.0, "seed {seed}: {one} and {two} dB");
        let facts = report(&analysis, &params);
        assert_eq!(
            facts.params.second_illuminant.used,
            analysis.finals.light.second.map(|second| second.direction)
        );
        let second = facts.illuminant.second.unwrap();
        assert!(second.given && second.interval_deg.is_none() && second.objects >= 2, "{second:?}");
    }
}

#[test]
fn a_given_second_lamp_lights_a_single_ball_beside_a_light_that_is_found() {
    // One ball alone is not enough for a lamp to be found.
    let scene = Scene::grid_of_balls([400, 160], 5, 2, 4);
    let [left, right] = LAMPS.map(|lamp| Scene { illuminant: unit(lamp), ..scene.clone() }.render());
    let (width, height) = (left.body.width(), left.body.height());
    let is_second = |pixel: usize| pixel % width >= 320 && pixel / width < 80;
    let color =
        |pixel: usize| if is_second(pixel) { right.image.pixels[pixel] } else { left.image.pixels[pixel] };
    let pixels = Raster::from_vec(width, height, (0..width * height).map(color).collect()).unwrap();
    let image = LinearImage::new(pixels, Some(255.0));
    assert_eq!(analyze(&image, &Params::default()).finals.light.second, None);
    for search in [true, false] {
        let refine = Refine { second_lamp: search, ..Refine::default() };
        let analysis = analyze(&image, &Params { refine, ..with_lights(None, Some(LAMPS[1])) });
        let [first, second] = lamps_of(&analysis);
        assert!(angle_deg(first.unwrap(), LAMPS[0]) < 1.0, "{first:?} is found as ever");
        assert_eq!(second, given(LAMPS[1]));
        assert_eq!(regions_of_lamps(&analysis)[1], 1, "the switch is for the search");
        let mask = analysis.finals.second_lamp_mask.as_ref().unwrap();
        assert!(mask[40 * width + 360] && !mask[120 * width + 360] && !mask[40 * width + 40]);
    }
}

#[test]
fn a_given_lamp_that_lights_nothing_is_a_warning() {
    let scene = Scene { illuminant: unit(LAMPS[0]), ..Scene::grid_of_balls([400, 160], 5, 2, 4) };
    let image = scene.render().image;
    let one = analyze(&image, &with_lights(Some(LAMPS[0]), None));
    let idle = analyze(&image, &with_lights(Some(LAMPS[0]), Some([0.2, 0.4, 0.9])));
    assert!(idle.warnings.contains(&RunWarning::SecondLampIdle), "{:?}", idle.warnings);
    assert_eq!((idle.finals.light.second.unwrap().regions, &idle.intrinsic.body), (0, &one.intrinsic.body));
    let same = analyze(&image, &with_lights(None, Some(LAMPS[0])));
    assert_eq!(same.finals.light.second, None, "the light found is that lamp");
    assert!(
        same.warnings.iter().any(|warning| matches!(warning, RunWarning::SecondLampIsFirst { .. })),
        "{:?}",
        same.warnings
    );
}

#[test]
fn the_record_of_given_lamps_tells_that_they_were_given_and_changes_nothing() {
    let (image, _) = half_and_half(4);
    let (image, params) = (Arc::new(image), with_lights(Some(LAMPS[0]), Some(LAMPS[1])));
    let (analysis, trace) = Session::new(Arc::clone(&image)).run_traced(&params, &mut ()).unwrap();
    assert!(fingerprint(&analysis) == fingerprint(&analyze(&image, &params)));
    let trace = Arc::new(trace);
    let names = Names::of(&trace);
    let of_kind =
        |kind: Kind| trace.events().map(|(_, event)| event).filter(move |event| event.kind() == kind);
    let compared: Vec<&Event> = of_kind(Kind::Lamps).collect();
    let [Event::LampsCompared(lamps)] = compared[..] else { panic!("{compared:?}") };
    assert!(lamps.given && lamps.regions.iter().any(LampOfRegion::is_second), "{lamps:?}");
    let sentence = names.event(compared[0]);
    assert!(sentence.starts_with("the second lamp was given, ") && sentence.contains("beside"), "{sentence}");
    let mut replay = Replay::new(Arc::clone(&trace));
    replay.seek(trace.len());
    assert_eq!(replay.light(), given(LAMPS[0]));
    assert_eq!(trace.events().filter(|(_, event)| matches!(event, Event::IlluminantEstimated(_))).count(), 0);
}
