//! Two lamps of different colors, each of which lights a half of the scene (section 7.5).

use crate::common::{analyze, assert_valid, fingerprint, report};
use crate::synthetic::{Scene, dot, unit};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::describe::Names;
use dichroscope::params::{Params, Refine};
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
            facts.objects >= 2 && facts.interval_deg < 5.0 && (facts.angle_deg - 12.6).abs() < 3.0,
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
