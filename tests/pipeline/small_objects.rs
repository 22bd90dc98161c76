//! Small objects in a large photograph: the second look in a finer picture.

use crate::common::{analyze, assert_valid, fingerprint, report, srgb};
use crate::synthetic::{Ball, Random, Rendered, Scene, dot, unit};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::app::{Application, Edit, Executor, JobCommand};
use dichroscope::describe::{Names, second_look_line, second_look_trace_line};
use dichroscope::params::{Params, Refine, Setting};
use dichroscope::raster::{PixelIndex, Raster, RegionId, UNASSIGNED};
use dichroscope::segment::PlaceRule;
use dichroscope::trace::{HistoryEntry, lineage};
use dichroscope::view::{Origin, why};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use serde_json::Value;
use std::sync::Arc;

/// Side of a working pixel, pixels.
const SIDE: usize = 5;
/// Body color of the wall.
const WALL: [f64; 3] = [0.62, 0.58, 0.42];

/// Two balls of 360 pixels across and eight of 60 to 80, white light, an 8-bit camera with noise.
fn balls(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut ball = |center_px: [f64; 2], radius_px: f64| Ball {
        center_px,
        radius_px,
        body: random.saturated_color(),
        body_counts: random.between(130.0, 180.0),
        surface_counts: random.between(70.0, 110.0),
        roughness: random.between(0.2, 0.3),
    };
    let mut balls = vec![ball([250.0, 250.0], 180.0), ball([750.0, 250.0], 180.0)];
    for place in 0..8 {
        balls.push(ball([80.0 + 120.0 * f64::from(place), 570.0], 30.0 + 1.3 * f64::from(place)));
    }
    Scene { balls, ..Scene::grid_of_balls([1000, 640], 1, 1, seed) }
}

/// The scene before a matt wall that gets brighter from left to right, or before black.
fn rendered(scene: &Scene, has_wall: bool) -> Rendered {
    let mut rendered = scene.render();
    if !has_wall {
        return rendered;
    }
    let mut noise = Random::new(scene.seed + 1);
    let wall = unit(WALL);
    let width = scene.size_px[0];
    for pixel in (0..rendered.labels.len()).filter(|&pixel| rendered.labels[pixel] == UNASSIGNED) {
        let counts = 60.0 + 50.0 * (pixel % width) as f64 / width as f64;
        let color = wall.map(|band| band * counts);
        rendered.body[pixel] = color.map(|v| v as f32);
        rendered.image.pixels[pixel] = color.map(|v| (v + scene.noise_sigma * noise.normal()).round() as f32);
    }
    rendered
}

fn params(small_objects: bool) -> Params {
    let refine = Refine { small_objects, ..Refine::default() };
    Params { scale: Setting::Value(SIDE as f64), refine, ..Params::default() }
}

/// Peak signal to noise ratio of a picture of the body reflection on one ball, dB.
fn psnr(picture: &Raster<[f32; 3]>, rendered: &Rendered, label: u16) -> f64 {
    let pixels: Vec<usize> =
        (0..rendered.labels.len()).filter(|&pixel| rendered.labels[pixel] == label).collect();
    let error = |&pixel: &usize| {
        (0..3).map(|band| f64::from(picture[pixel][band] - rendered.body[pixel][band]).powi(2)).sum::<f64>()
    };
    10.0 * (255.0 * 255.0 * 3.0 * pixels.len() as f64 / pixels.iter().map(error).sum::<f64>()).log10()
}

/// Number of small balls of which most lit pixels are in a region that holds nothing else.
fn found(analysis: &Analysis, rendered: &Rendered) -> usize {
    let lit = |pixel: usize| !analysis.masks.dark(pixel);
    let labels = &analysis.finals.labels;
    let is_found = |&ball: &u16| {
        let own: Vec<u16> = (0..labels.len())
            .filter(|&pixel| rendered.labels[pixel] == ball && lit(pixel))
            .map(|pixel| labels[pixel])
            .collect();
        let regions = 1..=analysis.finals.hypotheses.len() as u16;
        regions.into_iter().any(|region| {
            let here = own.iter().filter(|&&label| label == region).count();
            let everywhere = labels.as_slice().iter().filter(|&&label| label == region).count();
            3 * here > 2 * own.len() && 10 * here > 9 * everywhere
        })
    };
    (3..=10).filter(is_found).count()
}

#[test]
fn balls_too_small_for_the_working_picture_become_regions_and_gain() {
    for (seed, has_wall) in [(3, false), (3, true)] {
        let rendered = rendered(&balls(seed), has_wall);
        let [with, without] = [true, false].map(|on| analyze(&rendered.image, &params(on)));
        assert_valid(&rendered.image, &with, "second look");
        let findings = with.second_look.expect("a second look");
        assert_eq!(findings.side, 2);
        assert_eq!(
            with.finals.hypotheses.len(),
            without.finals.hypotheses.len() + findings.regions,
            "the regions of the first look stay"
        );
        assert_eq!(without.second_look, None);
        let [now, before] = [&with, &without].map(|analysis| found(analysis, &rendered));
        assert!(now >= 6 && before <= 1, "seed {seed}: {before} of 8 balls without, {now} with");
        let mean = |analysis: &Analysis| {
            (3..=10).map(|ball| psnr(&analysis.intrinsic.body, &rendered, ball)).sum::<f64>() / 8.0
        };
        assert!(mean(&with) > mean(&without) + 1.0, "seed {seed}: {} and {}", mean(&with), mean(&without));
        let light = [&with, &without].map(|analysis| analysis.illuminant.unwrap().direction);
        assert!(dot(light[0], light[1]) > 1.0 - 1e-12, "the light is that of the first look");
    }
}

#[test]
fn a_pixel_of_the_second_look_says_so_and_the_report_counts_the_regions() {
    let rendered = rendered(&balls(3), false);
    let params = params(true);
    let (analysis, trace) =
        Session::new(Arc::new(rendered.image.clone())).run_traced(&params, &mut ()).unwrap();
    let first = analysis.working_finals.hypotheses.len();
    let labels = analysis.finals.labels.as_slice();
    let pixel =
        labels.iter().position(|&label| usize::from(label) > first).expect("a region of the second look");
    let pixel = PixelIndex::from_index(pixel);
    let place = analysis.pixel_place(pixel).unwrap();
    assert_eq!(place.rule, PlaceRule::SecondLook { side: 2 });
    let names = Names::of(&trace);
    let sentence = names.pixel_place(&place, true);
    assert!(sentence.contains("the second look found it"), "{sentence}");
    assert!(
        sentence.contains("all that is not of the second look is told of the working pixel"),
        "{sentence}"
    );
    assert!(!analysis.pixel_history(&trace, pixel).is_empty(), "the working pixel has a history");
    let report = report(&analysis, &params);
    let facts = report.scale.second_look.unwrap();
    assert_eq!((facts.factor, facts.regions), (2, report.regions.len() - first));
}

#[test]
fn the_record_of_the_second_look_tells_how_its_regions_were_found() {
    let rendered = rendered(&balls(3), false);
    let mut session = Session::new(Arc::new(rendered.image.clone()));
    let silent = session.run(&params(true), &mut ()).unwrap();
    assert!(silent.second_look.is_some());
    let (analysis, trace) = session.run_traced(&params(true), &mut ()).unwrap();
    assert!(fingerprint(&silent) == fingerprint(&analysis), "the record changes the result");
    let (first, labels) = (analysis.working_finals.hypotheses.len(), &analysis.finals.labels);
    for region in RegionId::all(analysis.intrinsic.regions.len()).skip(first) {
        let (record, finer) = trace.second_look_region(region).expect("a record");
        assert_eq!(record.number_in_result(finer), Some(region));
        let ancestors = lineage(&record.trace, finer);
        assert_eq!(record.region_of(ancestors[0].hypothesis), Some(region));
        let names = Names::of_second_look(record);
        let in_region = |&pixel: &usize| labels[pixel] == region.get();
        let pixels: Vec<PixelIndex> =
            (0..labels.len()).filter(in_region).step_by(97).map(PixelIndex::from_index).collect();
        let looked_at: Vec<PixelIndex> =
            pixels.iter().copied().filter(|&pixel| record.has_looked_at(pixel)).collect();
        assert!(2 * looked_at.len() > pixels.len(), "{} of {}", looked_at.len(), pixels.len());
        let number = format!("becomes region {region}");
        let is_numbered = |entry: &HistoryEntry| names.second_look_entry(entry).contains(&number);
        let told = |&&pixel: &&PixelIndex| record.pixel_history(pixel).iter().any(is_numbered);
        assert!(2 * looked_at.iter().filter(told).count() > looked_at.len(), "{number}");
        let pixel = looked_at[0];
        assert!(trace.second_look_at(pixel).is_some_and(|found| found.corner() == record.corner()));
        let [x, y] = names.position(record.finer_pixel(pixel).unwrap());
        let [column, row] = pixel.position(labels.width());
        assert!(x.abs_diff(column) < 2 && y.abs_diff(row) < 2, "({x}, {y}) of ({column}, {row})");
    }
    assert!(trace.second_look_region(RegionId::from_index(0)).is_none(), "a region of the working picture");
    let of_first =
        (0..labels.len()).position(|pixel| labels[pixel] == 1).map(PixelIndex::from_index).unwrap();
    assert!(trace.second_look_at(of_first).is_none());
}

#[test]
fn the_window_tells_what_the_second_look_decided_about_a_pixel() {
    let rendered = rendered(&balls(3), false);
    let image = &rendered.image;
    let mut file = Vec::new();
    let (width, height) = (image.width() as u32, image.height() as u32);
    PngEncoder::new(&mut file).write_image(&srgb(image), width, height, ExtendedColorType::Rgb8).unwrap();
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(Edit::SetParams(Box::new(params(true))));
    application.apply(JobCommand::Open(Origin::Bytes { name: "balls.png".to_owned(), bytes: file.into() }));
    let state = application.state();
    let shown = state.newest.as_ref().unwrap();
    let trace = state.debugger.trace().expect("the trace of the result");
    let first = shown.analysis.working_finals.hypotheses.len();
    let region = RegionId::from_index(first);
    let (record, _) = trace.second_look_region(region).expect("a region of the second look");
    let in_region = |pixel: &PixelIndex| shown.labels()[pixel.index()] == region.get();
    let pixels: Vec<PixelIndex> =
        (0..shown.labels().len()).map(PixelIndex::from_index).filter(in_region).collect();
    let pixel = pixels[pixels.len() / 2];
    assert!(record.has_looked_at(pixel));
    let answers = why(shown, trace, &state.debugger.names, Some(pixel), None, None);
    let (_, history) = answers.pixel.unwrap();
    assert!(history[0].text.contains("the second look found it"), "{}", history[0].text);
    assert!(
        history[1].text.starts_with(&format!("second look: in region {region} it is")),
        "{}",
        history[1].text
    );
    let numbered = format!("becomes region {region}");
    let is_numbered = |text: &str| text.starts_with("second look: hypothesis") && text.ends_with(&numbered);
    assert!(history.iter().any(|sentence| is_numbered(&sentence.text)));
    assert!(history.last().is_some_and(|sentence| !sentence.text.contains("second look")));
    let (of, made_of) = answers.region.unwrap();
    assert!(of == region && !made_of.is_empty());
    assert!(
        made_of.iter().all(|sentence| sentence.text.starts_with("second look: hypothesis ")),
        "{made_of:?}"
    );
    let of_region = why(shown, trace, &state.debugger.names, None, None, Some(region));
    assert!(
        of_region.region == Some((region, made_of)),
        "the same where the region is selected and no pixel"
    );
}

#[test]
fn the_lines_of_the_second_look_name_its_picture_and_are_json() {
    let rendered = rendered(&balls(3), false);
    let (analysis, trace) =
        Session::new(Arc::new(rendered.image.clone())).run_traced(&params(true), &mut ()).unwrap();
    let first = analysis.working_finals.hypotheses.len();
    let mut regions = Vec::new();
    for (index, record) in trace.second_look().iter().enumerate() {
        let head: Value = serde_json::from_str(&second_look_line(record, index + 1)).unwrap();
        assert_eq!(head["second_look"], index + 1);
        assert_eq!(head["scale"], 2);
        regions
            .extend(head["finals"].as_array().unwrap().iter().filter_map(Value::as_u64).filter(|&n| n > 0));
        let names = Names::of_second_look(record);
        let mut line = String::new();
        for (seq, step) in record.trace.steps().step_by(997) {
            line.clear();
            let stage = record.trace.stage_at(seq).unwrap();
            second_look_trace_line(&names, index + 1, seq, stage, &step, &mut line);
            let line: Value = serde_json::from_str(&line).unwrap();
            assert_eq!((&line["second_look"], &line["seq"]), (&(index + 1).into(), &seq.into()));
        }
    }
    let expected: Vec<u64> = (first as u64 + 1..=analysis.intrinsic.regions.len() as u64).collect();
    assert_eq!(regions, expected, "each region of the second look lies in one picture");
}

#[test]
fn threads_and_records_do_not_change_the_second_look() {
    let rendered = rendered(&balls(3), true);
    let of = |threads: usize, traced: bool| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut session = Session::new(Arc::new(rendered.image.clone()));
        pool.install(|| {
            let params = params(true);
            let analysis = if traced {
                session.run_traced(&params, &mut ()).unwrap().0
            } else {
                session.run(&params, &mut ()).unwrap()
            };
            fingerprint(&analysis)
        })
    };
    let alone = of(1, false);
    assert!(alone == of(3, false), "threads change the result");
    assert!(alone == of(2, true), "a record changes the result");
}

#[test]
fn a_picture_that_is_not_averaged_has_no_second_look() {
    let scene = Scene::grid_of_balls([240, 160], 3, 2, 5);
    let image = scene.render().image;
    let [with, without] = [true, false].map(|on| {
        let refine = Refine { small_objects: on, ..Refine::default() };
        analyze(&image, &Params { refine, ..Params::default() })
    });
    assert_valid(&image, &with, "small picture");
    assert_eq!(with.second_look, None);
    assert_eq!(fingerprint(&with), fingerprint(&without));
}
