//! The case study of section 7.3: too low and too high a value of each control parameter on the bundled pictures
//! (`docs/case-study.md`).

use crate::common::{analyze, scores_of};
use dichroscope::analysis::{Analysis, RunWarning};
use dichroscope::describe::Scores;
use dichroscope::params::{Parameter, Params, Preset, Setting};
use dichroscope::photo::{LinearImage, ReadOptions, read};
use dichroscope::truth::GroundTruth;
use std::path::Path;
use std::sync::Arc;

/// A bundled picture of the paper with its column of table 6.
struct Case {
    truth: GroundTruth,
    image: Arc<LinearImage>,
    params: Params,
}

impl Case {
    fn new(name: &str, preset: Preset) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(name);
        Self {
            truth: GroundTruth::read(&folder).unwrap(),
            image: read(&folder.join("camera8.png"), &ReadOptions::default()).unwrap().image,
            params: preset.params(),
        }
    }

    /// The eight plastic objects.
    fn eight() -> Self {
        Self::new("plastic8_white", Preset::Plastic)
    }

    /// The three cups under yellow light.
    fn yellow() -> Self {
        Self::new("cups3_yellow", Preset::CupsYellow)
    }

    /// The result and its scores with some parameters changed.
    fn with(&self, changes: &[(Parameter, f64)]) -> (Analysis, Scores) {
        let mut params = self.params;
        for &(parameter, value) in changes {
            *params.slot(parameter) = Setting::Value(value);
        }
        let analysis = analyze(&self.image, &params);
        let scores = scores_of(&self.truth, &self.image, &analysis, &params);
        (analysis, scores)
    }
}

/// Sizes of the regions, largest first.
fn sizes(analysis: &Analysis) -> Vec<usize> {
    analysis.intrinsic.regions.iter().map(|region| region.pixels).collect()
}

/// Number of regions with a dichromatic plane.
fn planes(analysis: &Analysis) -> usize {
    analysis.intrinsic.regions.iter().filter(|region| region.surface.is_some()).count()
}

#[test]
fn camera_noise_below_the_cameras_leaves_no_region_and_above_it_joins_objects() {
    let eight = Case::eight();
    let (low, _) = eight.with(&[(Parameter::CameraNoise, 1.0)]);
    assert!(sizes(&low).is_empty() && low.warnings[0] == RunWarning::NoLinearArea, "{:?}", low.warnings);
    let (high, scores) = eight.with(&[(Parameter::CameraNoise, 5.0)]);
    assert!(sizes(&high).len() == 7 && scores.ari < 0.9, "{:?}", sizes(&high));
    let (low, _) = Case::yellow().with(&[(Parameter::CameraNoise, 1.0)]);
    assert!(sizes(&low).is_empty());
}

#[test]
fn without_a_minimal_intensity_the_background_joins_and_with_a_high_one_objects_lose_their_shade() {
    let eight = Case::eight();
    let (low, scores) = eight.with(&[(Parameter::MinIntensity, 0.0)]);
    assert!(sizes(&low)[0] > 150_000 && scores.ari < 0.8, "{:?}", sizes(&low));
    let (_, scores) = eight.with(&[(Parameter::MinIntensity, 100.0)]);
    assert!(scores.cover.unwrap() < 0.45, "{:?}", scores.cover);
    let (low, _) = Case::yellow().with(&[(Parameter::MinIntensity, 0.0)]);
    assert!(sizes(&low)[0] > 190_000, "{:?}", sizes(&low));
}

#[test]
fn thin_cylinders_lose_pixels_and_thick_cylinders_lose_objects() {
    let eight = Case::eight();
    let width = |width: f64| [(Parameter::CylinderWidth, width), (Parameter::SliceWidth, width)];
    let (_, scores) = eight.with(&width(1.0));
    assert!(scores.cover.unwrap() < 0.95 && scores.illum_deg > 6.0, "{scores:?}");
    let (thick, scores) = eight.with(&width(8.0));
    assert!(sizes(&thick)[0] > 18_000 && scores.ari < 0.9, "{:?}", sizes(&thick));
}

#[test]
fn large_windows_join_objects_and_lose_highlights() {
    let eight = Case::eight();
    let (small, scores) = eight.with(&[(Parameter::WindowSize, 4.0)]);
    assert!(sizes(&small).len() == 8 && scores.ari > 0.99, "{:?}", sizes(&small));
    let (large, scores) = eight.with(&[(Parameter::WindowSize, 40.0)]);
    assert!(sizes(&large)[0] > 18_000 && scores.ari < 0.9, "{:?}", sizes(&large));
    let (large, _) = Case::yellow().with(&[(Parameter::WindowSize, 15.0)]);
    assert_eq!((sizes(&large).len(), planes(&large)), (3, 2), "no cup is lost, but the highlight of one");
}

#[test]
fn a_small_minimal_area_takes_highlights_for_matte_areas_and_a_large_one_loses_objects() {
    let eight = Case::eight();
    let (small, scores) = eight.with(&[(Parameter::MinArea, 50.0)]);
    let highlights = sizes(&small).into_iter().filter(|&pixels| (500..1000).contains(&pixels)).count();
    assert!(sizes(&small).len() == 12 && highlights == 4, "{:?}", sizes(&small));
    assert!(scores.psnr_restored.unwrap() < 12.0, "{:?}", scores.psnr_restored);
    let (large, scores) = eight.with(&[(Parameter::MinArea, 6000.0)]);
    assert!(sizes(&large).len() == 5 && scores.ari < 0.85, "{:?}", sizes(&large));
    let yellow = Case::yellow();
    let regions = |area: f64| sizes(&yellow.with(&[(Parameter::MinArea, area)]).0).len();
    assert_eq!([50.0, 500.0, 2000.0].map(regions), [6, 4, 3], "a broad highlight of 1036 pixels");
}

#[test]
fn a_low_clipping_threshold_leaves_no_highlight() {
    let (low, _) = Case::eight().with(&[(Parameter::ClipThreshold, 120.0)]);
    assert_eq!(planes(&low), 1);
    let (low, _) = Case::yellow().with(&[(Parameter::ClipThreshold, 120.0)]);
    assert!(low.illuminant.is_none());
}
