//! Every reading of the paper changes what its row says, and the figures of its row hold on bundled pictures.

use crate::common::{analyze, assert_valid, picture, report, scores_of};
use crate::synthetic::{Random, Scene, unit};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::color::{Line, Moments, axis_angle_deg};
use dichroscope::describe::Scores;
use dichroscope::intrinsic::RegionWarning;
use dichroscope::params::{IlluminantSetting, Params, Preset, Reading, Setting};
use dichroscope::photo::{LinearImage, ReadOptions, read};
use dichroscope::raster::{HypothesisId, UNASSIGNED};
use dichroscope::segment::LightBasis;
use dichroscope::trace::{
    CandidateChosen, CandidateTested, Event, HighlightsAveraged, MatteAreasUnited, PixelKind, lineage,
};
use dichroscope::truth::GroundTruth;
use std::path::Path;
use std::sync::Arc;

/// The paper's method with one reading on or off.
fn reading(reading: Reading, on: bool) -> Params {
    let mut params = Params::paper();
    params.paper.readings.set(reading, on);
    params
}

/// The results with a reading on, and with the reading off.
fn on_and_off(image: &LinearImage, which: Reading) -> [Analysis; 2] {
    [true, false].map(|on| {
        let analysis = analyze(image, &reading(which, on));
        assert_valid(image, &analysis, which.name());
        analysis
    })
}

/// What `of` selects from the events of a recorded run.
fn events<T>(image: &LinearImage, params: &Params, of: impl Fn(&Event) -> Option<T>) -> Vec<T> {
    let (_, trace) = Session::new(Arc::new(image.clone())).run_traced(params, &mut ()).unwrap();
    trace.events().filter_map(|(_, event)| of(event)).collect()
}

/// The tests of candidates with a reading on, and with the reading off.
fn candidate_tests(image: &LinearImage, which: Reading) -> [Vec<CandidateTested>; 2] {
    [true, false].map(|on| {
        let found = events(image, &reading(which, on), |event| match event {
            Event::CandidateTested(test) => Some((**test).clone()),
            _ => None,
        });
        assert!(found.len() > 3, "{} candidates", found.len());
        found
    })
}

/// Six shiny balls.
fn balls() -> LinearImage {
    Scene::grid_of_balls([240, 160], 3, 2, 11).render().image
}

/// A ball of 24 000 pixels, more than a sample holds.
fn large_ball() -> LinearImage {
    let scene = Scene { noise_sigma: 1.25, eight_bit: true, ..Scene::one_ball([220, 220], [0.9, 0.3, 0.2]) };
    scene.render().image
}

/// A ball without a highlight.
fn matt_ball() -> LinearImage {
    let mut scene =
        Scene { noise_sigma: 1.25, eight_bit: true, ..Scene::one_ball([120, 120], [0.9, 0.3, 0.2]) };
    scene.balls[0].surface_counts = 0.0;
    scene.render().image
}

#[test]
fn every_pixel_takes_more_than_a_sample() {
    let truth = unit([0.9, 0.3, 0.2]).into();
    let lines = on_and_off(&large_ball(), Reading::EveryPixel).map(|analysis| {
        assert!(analysis.intrinsic.regions[0].pixels > 10_000);
        analysis.matte.hypotheses[0].line
    });
    assert_ne!(lines[0], lines[1]);
    assert!(lines.iter().all(|line| axis_angle_deg(&line.direction, &truth) < 0.5), "{lines:?}");
}

#[test]
fn brightest_pixel_ends_the_matte_line_beyond_the_quantile() {
    let [on, off] = on_and_off(&large_ball(), Reading::BrightestPixel)
        .map(|analysis| analysis.planar.hypotheses[0].matte_length);
    assert!(on > off + 0.5 && on < off + 20.0, "{on} and {off} counts");
}

#[test]
fn grown_matte_line_is_that_of_all_pixels_of_the_region() {
    let image = large_ball();
    let [on, off] = on_and_off(&image, Reading::GrownMatteLine);
    let labels = on.matte.labels.as_slice();
    let colors = image.pixels.as_slice().iter().zip(labels).filter(|(_, label)| **label == 1);
    let cluster: Moments = colors.map(|(color, _)| *color).collect();
    assert_eq!(on.planar.hypotheses[0].matte, Line::principal(&cluster).unwrap());
    assert_eq!(off.planar.hypotheses[0].matte, off.matte.hypotheses[0].line);
    assert_ne!(on.planar.hypotheses[0].matte, off.planar.hypotheses[0].matte);
}

#[test]
fn distorted_candidates_are_larger() {
    let image = Scene::grid_of_balls([240, 160], 3, 2, 13).render().image;
    let [on, off] = candidate_tests(&image, Reading::DistortedCandidates);
    let pixels = |tests: &[CandidateTested]| tests.iter().map(|test| test.pixels).sum::<u32>();
    assert!(on.iter().all(|test| test.with_distorted) && !off.iter().any(|test| test.with_distorted));
    assert!(pixels(&on) > pixels(&off), "{} and {} pixels", pixels(&on), pixels(&off));
}

#[test]
fn all_neighbors_are_candidates_however_small() {
    let [on, off] = candidate_tests(&balls(), Reading::AllNeighbors);
    let least = |tests: &[CandidateTested]| tests.iter().map(|test| test.pixels).min();
    assert!(least(&on) < Some(10) && least(&off) >= Some(10), "{:?} {:?}", least(&on), least(&off));
}

#[test]
fn gap_within_noise_and_strict_upper_half_are_narrower_limits() {
    let image = balls();
    let [on, off] = candidate_tests(&image, Reading::GapWithinNoise);
    assert!(on.iter().all(|test| (test.gap.limit - 2.5).abs() < 1e-9));
    assert!(off.iter().all(|test| (test.gap.limit - 10.0).abs() < 1e-9));
    let met = |tests: &[CandidateTested]| tests.iter().filter(|test| test.verdict.lines_meet).count();
    assert!(met(&on) < met(&off), "{} and {} pass", met(&on), met(&off));

    let [on, off] = candidate_tests(&image, Reading::StrictUpperHalf);
    assert!(on.iter().all(|test| test.position_limits == [50.0, 100.0]));
    assert!(off.iter().all(|test| test.position_limits[1] > 110.0));
}

#[test]
fn beyond_meeting_point_refuses_candidates_on_the_wrong_side() {
    let side = ((1.0f64 - 0.85 * 0.85) / 2.0).sqrt();
    let scene = Scene { light: [-side, -side, 0.85], ..Scene::grid_of_balls([240, 160], 3, 2, 5) };
    let [on, off] = candidate_tests(&scene.render().image, Reading::BeyondMeetingPoint);
    let refused = |tests: &[CandidateTested]| tests.iter().filter(|test| !test.verdict.beyond).count();
    assert!(refused(&on) > 0 && refused(&off) == 0, "{} refused", refused(&on));
}

#[test]
fn gershon_test_decides_by_the_angle_and_not_by_the_place() {
    // The balls of the other tests do not touch; the lines of touching objects meet in the dark.
    let photograph = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/plastic8_white/camera8.png");
    let image = read(&photograph, &ReadOptions::default()).unwrap().image;
    let [on, off] = candidate_tests(&image, Reading::GershonTest);
    let differs =
        |test: &&CandidateTested| test.verdict.accepted_by_gershon() != test.verdict.accepted_by_position();
    assert!(on.iter().filter(differs).count() > 0, "both tests decide alike");
    assert!(on.iter().all(|test| test.verdict.accepted() == test.verdict.accepted_by_gershon()));
    assert!(off.iter().all(|test| test.verdict.accepted() == test.verdict.accepted_by_position()));
}

#[test]
fn chosen_start_is_a_meeting_point_and_not_the_mean_of_all() {
    let image = balls();
    let [on, off] = [true, false].map(|on| {
        let params = reading(Reading::ChosenStart, on);
        let mut means: Vec<CandidateChosen> = events(&image, &params, |event| match event {
            Event::CandidateChosen(chosen) => Some((**chosen).clone()),
            _ => None,
        });
        means.sort_by_key(|chosen| chosen.hypothesis.index());
        let hypotheses = analyze(&image, &params).planar.hypotheses.clone();
        let distance = |chosen: &CandidateChosen| {
            (hypotheses[chosen.hypothesis.index()].start - chosen.meeting_point).norm()
        };
        means.iter().map(distance).fold(0.0, f64::max)
    });
    assert!(on > 0.1 && off < 1e-9, "farthest start from the mean: {on} and {off} counts");
}

/// A cylinder with vertical axis, whose highlight runs along the axis from end to end.
fn striped_cylinder() -> LinearImage {
    let (body, light) = (unit([0.9, 0.3, 0.2]), unit([1.0; 3]));
    let mut random = Random::new(5);
    let mut image = picture(200, 120, |x, y| {
        let across = (x as f64 - 99.5) / 90.0;
        if across.abs() >= 1.0 || !(8..112).contains(&y) {
            return [0.0; 3];
        }
        let angle = across.asin();
        let shade = 190.0 * (angle + 0.5).cos().max(0.0);
        let gloss = 120.0 * (-((angle + 0.1) / 0.05).powi(2)).exp();
        [0, 1, 2].map(|band| (body[band] * shade + light[band] * gloss) as f32)
    });
    for value in image.pixels.as_mut_slice().as_flattened_mut() {
        *value = (*value + (1.25 * random.normal()) as f32).clamp(0.0, 255.0).round();
    }
    image
}

#[test]
fn single_matte_cluster_unites_both_sides_of_a_highlight() {
    let image = striped_cylinder();
    // The highlight has 1689 pixels, and is no large area.
    let params = |on| Params { min_area: Setting::Value(3000.0), ..reading(Reading::SingleMatteCluster, on) };
    let [on, off] = [true, false].map(|on| analyze(&image, &params(on)));
    assert_eq!(on.matte.hypotheses.len(), 2, "the highlight divides the matte area");
    let sizes = |analysis: &Analysis| -> Vec<usize> {
        analysis.intrinsic.regions.iter().map(|region| region.pixels).collect()
    };
    let [one, two] = [sizes(&on), sizes(&off)];
    assert!(one.iter().filter(|&&pixels| pixels > 500).count() == 1, "{one:?}");
    assert!(two.iter().filter(|&&pixels| pixels > 500).count() == 2, "{two:?}");
    let united = events(&image, &params(true), |event| match event {
        Event::MatteAreasUnited(united) => Some(*united),
        _ => None,
    });
    let [MatteAreasUnited { hypothesis, into, taken_px, area_px, .. }] = united[..] else {
        panic!("one union: {united:?}")
    };
    assert!(hypothesis != into && 2 * taken_px > area_px);
    let (analysis, trace) = Session::new(Arc::new(image.clone())).run_traced(&params(true), &mut ()).unwrap();
    let largest = analysis.intrinsic.regions[0].id;
    let ancestors: Vec<HypothesisId> = lineage(&trace, largest).iter().map(|one| one.hypothesis).collect();
    assert_eq!(ancestors, [into, hypothesis], "the lineage of the region tells both");
}

#[test]
fn the_light_is_the_average_of_the_recorded_highlight_directions() {
    let image = balls();
    let averages: Vec<HighlightsAveraged> = events(&image, &Params::paper(), |event| match event {
        Event::HighlightsAveraged(averaged) => Some((**averaged).clone()),
        _ => None,
    });
    let [average] = &averages[..] else { panic!("one average: {averages:?}") };
    assert!(average.contributions.len() > 2, "{average:?}");
    let mut sum = [0.0; 3];
    for contribution in &average.contributions {
        (0..3).for_each(|band| sum[band] += contribution.direction[band]);
        let angle_deg = axis_angle_deg(&contribution.direction.into(), &average.direction.into());
        assert!((angle_deg - contribution.angle_deg).abs() < 1e-6);
    }
    let mean = unit(sum);
    assert!((0..3).all(|band| (mean[band] - average.direction[band]).abs() < 1e-9));
    let analysis = analyze(&image, &Params::paper());
    let light = &analysis.planar.light;
    assert_eq!((light.basis, light.interval_deg), (LightBasis::Average, None));
    assert_eq!((light.planes, light.votes), (None, None));
    assert_eq!(analysis.illuminant.unwrap().objects, average.contributions.len());
    let json = report(&analysis, &Params::paper()).to_json().unwrap();
    for word in ["support", "vote_share", "not asked for"] {
        assert!(!json.contains(word), "{word}");
    }
}

#[test]
fn fill_holes_takes_in_what_no_growth_reached() {
    let mut image = large_ball();
    let width = image.pixels.width();
    for y in 120..126 {
        for x in 120..126 {
            image.pixels.as_mut_slice()[y * width + x] = [20.0, 60.0, 90.0];
        }
    }
    let [on, off] = on_and_off(&image, Reading::FillHoles).map(|analysis| {
        let labels = analysis.finals.labels.as_slice();
        (120..126).flat_map(|y| y * width + 120..y * width + 126).filter(|&p| labels[p] != UNASSIGNED).count()
    });
    assert_eq!((on, off), (36, 0));
}

#[test]
fn small_regions_stay() {
    // A ramp of 7 × 7 pixels before black.
    let image = picture(40, 40, |x, y| {
        let inside = (11..18).contains(&x) && (11..18).contains(&y);
        let shade = if inside { 20.0 + 6.0 * x as f32 } else { 0.0 };
        [shade, 0.4 * shade, 0.3 * shade]
    });
    let [on, off] = [true, false].map(|on| {
        let params = Params { min_area: Setting::Value(20.0), ..reading(Reading::SmallRegions, on) };
        analyze(&image, &params).intrinsic.regions.iter().map(|region| region.pixels).collect::<Vec<_>>()
    });
    assert_eq!((on, off), (vec![49], vec![]));
}

#[test]
fn a_region_without_a_highlight_is_not_split_and_its_noise_is_the_distance_from_its_line() {
    let image = matt_ball();
    let matte = |analysis: &Analysis| -> Vec<usize> {
        let kinds = analysis.intrinsic.kinds.as_slice();
        (0..kinds.len()).filter(|&pixel| kinds[pixel] == PixelKind::Matte).collect()
    };
    let [on, off] = on_and_off(&image, Reading::UnsplitWithoutHighlight);
    let pixels = matte(&on);
    assert!(pixels.len() > 3000 && pixels == matte(&off));
    assert!(pixels.iter().all(|&pixel| on.intrinsic.body[pixel] == image.pixels[pixel]));
    assert!(pixels.iter().any(|&pixel| off.intrinsic.body[pixel] != image.pixels[pixel]));
    let warns = |analysis: &Analysis, keeps_color| {
        analysis.intrinsic.regions[0].warnings.contains(&RegionWarning::NoPlane { keeps_color })
    };
    assert!(warns(&on, true) && warns(&off, false));
    assert!(on.intrinsic.regions[0].fit_rms_counts < 1.5, "{}", on.intrinsic.regions[0].fit_rms_counts);

    let [on, off] = on_and_off(&image, Reading::CylinderNoise);
    let rms = |analysis: &Analysis| {
        let squares: f32 = pixels.iter().map(|&pixel| analysis.intrinsic.noise[pixel].powi(2)).sum();
        (squares / pixels.len() as f32).sqrt()
    };
    // The camera's noise has a standard deviation of 1.25 counts along each of two axes.
    assert!((rms(&on) - 1.8).abs() < 0.2 && rms(&off) == 0.0, "{} and {}", rms(&on), rms(&off));
}

#[test]
fn angle_by_width_needs_a_larger_angle_for_a_wider_cylinder() {
    // A pale body, 7° from the light.
    let scene = Scene { noise_sigma: 1.25, eight_bit: true, ..Scene::one_ball([160, 160], [1.0, 0.9, 0.78]) };
    let image = scene.render().image;
    let separable = |which: bool, width: f64| {
        let mut params = Params {
            cylinder_width: Setting::Value(width),
            slice_width: Setting::Value(width),
            illuminant: IlluminantSetting::Given([1.0; 3]),
            ..reading(Reading::AngleByWidth, which)
        };
        params.paper.with.extend_planes = true;
        let analysis = analyze(&image, &params);
        let region = &analysis.intrinsic.regions[0];
        assert!((region.angle_deg.unwrap() - 5.8).abs() < 2.0, "{:?}", region.angle_deg);
        region.separable
    };
    assert!(separable(true, 3.0) && !separable(true, 9.0));
    assert!(separable(false, 3.0) && separable(false, 9.0));
}

/// The scores of a bundled picture of the paper with its column of table 6 and one reading changed.
fn scores(name: &str, preset: Preset, changed: Option<(Reading, bool)>) -> Scores {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(name);
    let truth = GroundTruth::read(&folder).unwrap();
    let image = read(&folder.join("camera8.png"), &ReadOptions::default()).unwrap().image;
    let mut params = preset.params();
    if let Some((reading, on)) = changed {
        assert_ne!(params.paper.readings.get(reading), on, "{} is the default", reading.name());
        params.paper.readings.set(reading, on);
    }
    scores_of(&truth, &image, &analyze(&image, &params), &params)
}

#[test]
fn the_figures_of_the_table_hold_on_the_bundled_pictures_of_the_paper() {
    let eight = |changed| scores("plastic8_white", Preset::Plastic, changed);
    let yellow = |changed| scores("cups3_yellow", Preset::CupsYellow, changed);
    let assert_near = |what: &str, found: f64, expected: f64, tolerance: f64| {
        assert!((found - expected).abs() <= tolerance, "{what}: {found}, expected {expected}");
    };
    let default = eight(None);
    assert_near("eight objects, ARI", default.ari, 0.998, 0.001);
    assert_near("eight objects, light", default.illum_deg, 0.63, 0.05);
    assert_near("eight objects, body", default.psnr_body.unwrap(), 37.54, 0.1);
    let mean_start = eight(Some((Reading::ChosenStart, false)));
    assert_near("mean start, body", mean_start.psnr_body.unwrap(), 37.01, 0.1);
    let own_cylinder = eight(Some((Reading::OwnCylinderOnly, true)));
    assert_near("own cylinder only, ARI", own_cylinder.ari, 0.953, 0.005);
    let radius = eight(Some((Reading::GapWithinNoise, false)));
    assert_near("gap within the radius, light", radius.illum_deg, 0.47, 0.05);
    let distorted = eight(Some((Reading::DistortedCandidates, true)));
    assert_near("distorted candidates, light", distorted.illum_deg, 3.34, 0.1);

    let default = yellow(None);
    assert_near("yellow cups, light", default.illum_deg, 7.11, 0.1);
    let few = yellow(Some((Reading::AllNeighbors, false)));
    assert_near("candidates of 10 pixels, light", few.illum_deg, 9.86, 0.1);
    let distorted = yellow(Some((Reading::DistortedCandidates, true)));
    assert_near("distorted candidates, light", distorted.illum_deg, 23.48, 0.2);
}
