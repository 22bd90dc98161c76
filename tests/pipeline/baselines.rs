//! The earlier methods on the bundled pictures and on small ones: what section 7.2 says of Phoenix, and section 5.1 of clusters of the
//! whole histogram.

use crate::common::{analyze, assert_valid, picture, scores_of};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::describe::Scores;
use dichroscope::params::{Feature, FeatureSet, Method, Params, PhoenixSettings};
use dichroscope::photo::{LinearImage, ReadOptions, read};
use dichroscope::raster::UNASSIGNED;
use dichroscope::segment::LightBasis;
use dichroscope::trace::{Event, FeatureVerdict, HistogramsSearched};
use dichroscope::truth::GroundTruth;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The bundled picture of eight plastic objects with its ground truth.
struct Plastic {
    truth: GroundTruth,
    image: Arc<LinearImage>,
}

impl Plastic {
    fn read() -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/plastic8_white");
        Self {
            truth: GroundTruth::read(&folder).unwrap(),
            image: read(&folder.join("camera8.png"), &ReadOptions::default()).unwrap().image,
        }
    }

    fn analyzed(&self, method: Method) -> (Analysis, Scores) {
        let params = Params::of(method);
        let analysis = analyze(&self.image, &params);
        assert_valid(&self.image, &analysis, method.name());
        let scores = scores_of(&self.truth, &self.image, &analysis, &params);
        (analysis, scores)
    }

    /// For each object, the number of pixels and the mean intensity of each region on its pixels for which `member` is true, the
    /// largest region first.
    fn parts(
        &self,
        analysis: &Analysis,
        member: impl Fn(usize) -> bool,
    ) -> BTreeMap<u16, Vec<(u16, usize, f64)>> {
        let mut sums: BTreeMap<(u16, u16), (usize, f64)> = BTreeMap::new();
        for (pixel, &object) in self.truth.labels.as_slice().iter().enumerate() {
            if object != UNASSIGNED && !analysis.masks.dark(pixel) && member(pixel) {
                let sum = sums.entry((object, analysis.finals.labels[pixel])).or_default();
                sum.0 += 1;
                sum.1 += f64::from(self.image.pixels[pixel].iter().sum::<f32>()) / 3.0;
            }
        }
        let mut parts: BTreeMap<u16, Vec<(u16, usize, f64)>> = BTreeMap::new();
        for ((object, region), (pixels, sum)) in sums {
            parts.entry(object).or_default().push((region, pixels, sum / pixels as f64));
        }
        for parts in parts.values_mut() {
            parts.sort_by_key(|part| std::cmp::Reverse(part.1));
        }
        parts
    }

    /// Length of the true surface reflection at a pixel, counts.
    fn surface(&self, pixel: usize) -> f32 {
        self.truth.surface[pixel].iter().map(|band| band * band).sum::<f32>().sqrt()
    }
}

#[test]
fn phoenix_breaks_matte_areas_and_separates_some_highlights() {
    let plastic = Plastic::read();
    let (analysis, scores) = plastic.analyzed(Method::Phoenix);
    let refined = plastic.analyzed(Method::Refined).1.ari;
    assert!((0.7..0.9).contains(&scores.ari) && refined > 0.99, "{} against {refined}", scores.ari);
    assert!(analysis.illuminant.is_none() && analysis.intrinsic.body == plastic.image.pixels);
    assert_eq!(analysis.finals.light.basis, LightBasis::NotSought);
    let matte = plastic.parts(&analysis, |pixel| plastic.surface(pixel) < 3.0);
    let broken = matte.values().filter(|parts| {
        let second = parts.get(1).filter(|second| second.1 > 1000);
        second.is_some_and(|second| (second.2 / parts[0].2).ln().abs() > 0.5)
    });
    assert!(broken.count() >= 1, "no matte area is broken into dark and bright: {matte:?}");
    let bright = plastic.parts(&analysis, |pixel| plastic.surface(pixel) > 150.0);
    let is_separate = |object: &u16| bright[object][0].0 != matte[object][0].0;
    let separate = bright.keys().filter(|object| is_separate(object)).count();
    assert!(
        separate >= 2 && separate < bright.len(),
        "{separate} of {} highlights are separate",
        bright.len()
    );
}

#[test]
fn clusters_of_the_whole_histogram_mix_objects_and_break_them() {
    let plastic = Plastic::read();
    let (analysis, scores) = plastic.analyzed(Method::TopDown);
    assert!(scores.ari < 0.8, "{}", scores.ari);
    let parts = plastic.parts(&analysis, |_| true);
    let mut objects_of: BTreeMap<u16, usize> = BTreeMap::new();
    for (region, pixels, _) in parts.values().flatten() {
        *objects_of.entry(*region).or_default() += usize::from(*pixels > 500);
    }
    assert!(objects_of.values().any(|&objects| objects > 1), "no cluster holds two objects: {parts:?}");
    assert!(parts.values().any(|parts| parts[1..].iter().any(|part| part.1 > 500)), "no object is broken");
}

/// The searches of a run of Phoenix with these settings.
fn searches(image: &LinearImage, settings: PhoenixSettings) -> (Analysis, Vec<HistogramsSearched>) {
    let params = Params { phoenix: settings, ..Params::of(Method::Phoenix) };
    let (analysis, trace) = Session::new(Arc::new(image.clone())).run_traced(&params, &mut ()).unwrap();
    let searches = trace.events().filter_map(|(_, event)| match event {
        Event::HistogramsSearched(searched) => Some(HistogramsSearched::clone(searched)),
        _ => None,
    });
    (analysis, searches.collect())
}

#[test]
fn two_colors_are_split_by_the_feature_in_which_they_differ() {
    // Two halves of one intensity and saturation, red and green, with a gradient of 12 %.
    let halves = picture(40, 30, |x, y| {
        let gain = 1.0 + 0.004 * y as f32;
        if x < 20 {
            [120.0 * gain, 60.0 * gain, 60.0 * gain]
        } else {
            [60.0 * gain, 120.0 * gain, 60.0 * gain]
        }
    });
    let (analysis, found) = searches(&halves, PhoenixSettings::default());
    assert_eq!(analysis.intrinsic.regions.len(), 2);
    assert_eq!(found[0].chosen().unwrap().feature, Feature::Hue);
    assert!(found[1..].iter().all(|searched| searched.chosen().is_none()), "both halves are homogeneous");
    let intensity: FeatureSet = "I".parse().unwrap();
    let (analysis, found) =
        searches(&halves, PhoenixSettings { features: intensity, ..PhoenixSettings::default() });
    assert_eq!((analysis.intrinsic.regions.len(), found.len()), (1, 1), "of one intensity");
    let band: FeatureSet = "R".parse().unwrap();
    let strict =
        PhoenixSettings { features: band, absscore: 1000, height: 100, ..PhoenixSettings::default() };
    let (_, found) = searches(&halves, strict);
    assert_eq!(found[0].features[0].verdict, FeatureVerdict::Chosen, "an empty valley has the full score");
}

#[test]
fn specks_are_absorbed_and_too_many_specks_forbid_a_split() {
    let speckled = |every: usize| {
        picture(40, 40, move |x, y| {
            let bright = (x < 20) != (x % every == 0 && y % every == 0);
            if bright { [160.0, 150.0, 140.0] } else { [60.0, 57.0, 53.0] }
        })
    };
    let (analysis, _) = searches(&speckled(7), PhoenixSettings::default());
    assert_eq!(analysis.intrinsic.regions.len(), 2, "specks of one pixel are absorbed");
    let picky = PhoenixSettings { retain: 100, ..PhoenixSettings::default() };
    let (analysis, found) = searches(&speckled(7), picky);
    assert_eq!(analysis.intrinsic.regions.len(), 1);
    let intensity = found[0].features.iter().find(|feature| feature.feature == Feature::Intensity).unwrap();
    assert_eq!(intensity.verdict, FeatureVerdict::TooNoisy);
}

#[test]
fn a_larger_scale_finds_the_same_halves() {
    let halves = picture(80, 60, |x, _| if x < 40 { [140.0, 70.0, 60.0] } else { [60.0, 70.0, 140.0] });
    for method in [Method::Phoenix, Method::TopDown] {
        let params = Params { scale: dichroscope::params::Setting::Value(4.0), ..Params::of(method) };
        let analysis = analyze(&halves, &params);
        assert_valid(&halves, &analysis, method.name());
        assert_eq!(analysis.intrinsic.regions.len(), 2, "{}", method.name());
        assert_ne!(analysis.finals.labels[0], analysis.finals.labels[79]);
    }
}
