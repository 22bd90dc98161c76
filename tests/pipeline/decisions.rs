//! The decisions of the local split, where the model does not explain a region, are recorded and replayed like all
//! others.

use crate::common::{analyze, fingerprint, picture};
use crate::marbled;
use crate::prints::printed;
use crate::synthetic::{Scene, unit};
use dichroscope::analysis::{Analysis, Session};
use dichroscope::describe::{Names, trace_line};
use dichroscope::params::{Params, Refine};
use dichroscope::photo::LinearImage;
use dichroscope::raster::PixelIndex;
use dichroscope::segment::LightBasis;
use dichroscope::trace::{
    Event, HistoryKind, Kind, LocalFate, PixelKind, RepairVerdict, Replay, Stage, Step, Trace, pixel_history,
};
use std::collections::BTreeSet;
use std::sync::Arc;

fn is_local(event: &Event) -> bool {
    matches!(event.kind(), Kind::LocalSplit | Kind::PictureOdds | Kind::Plausibility | Kind::Repair)
}

struct Traced {
    image: Arc<LinearImage>,
    analysis: Analysis,
    trace: Arc<Trace>,
}

impl Traced {
    fn new(image: LinearImage, params: &Params) -> Self {
        let image = Arc::new(image);
        let (analysis, trace) = Session::new(Arc::clone(&image)).run_traced(params, &mut ()).unwrap();
        Self { image, analysis, trace: Arc::new(trace) }
    }

    fn printed(seed: u64, params: &Params) -> Self {
        let scene =
            Scene { illuminant: unit([1.1, 1.0, 0.9]), ..Scene::grid_of_balls([320, 160], 2, 1, seed) };
        Self::new(printed(&scene).image, params)
    }

    fn marbled(params: &Params, body_share: f64) -> Self {
        let [width, height] = marbled::SIZE_PX;
        let colors = marbled::marbled(body_share);
        Self::new(picture(width, height, |x, y| colors[y * width + x].map(f32::from)), params)
    }

    /// The recorded decisions of the local split.
    fn decisions(&self) -> impl Iterator<Item = &Event> {
        self.trace.events().map(|(_, event)| event).filter(|event| is_local(event))
    }

    fn history(&self, pixel: usize) -> Vec<HistoryKind> {
        let history =
            pixel_history(&self.trace, &self.image, &self.analysis.masks, PixelIndex::from_index(pixel));
        history.into_iter().map(|happening| happening.what).collect()
    }

    /// Length of a pixel's surface reflection, counts.
    fn surface(&self, pixel: usize) -> f32 {
        self.analysis.intrinsic.surface[pixel].iter().map(|band| band * band).sum::<f32>().sqrt()
    }
}

#[test]
fn the_light_that_is_chosen_is_the_results_and_its_figures_decide() {
    let of_prints = (31..35).map(|seed| Traced::printed(seed, &Params::default()));
    let mut bases = BTreeSet::new();
    for traced in of_prints.chain([1.0, 0.4].map(|share| Traced::marbled(&Params::default(), share))) {
        let chosen = traced.trace.events().find_map(|(_, event)| match event {
            Event::LightChosen(chosen) => Some(chosen),
            _ => None,
        });
        let chosen = chosen.unwrap();
        let light = traced.analysis.planar.light;
        assert_eq!(
            (chosen.basis, chosen.direction, chosen.support),
            (light.basis, light.direction, light.support)
        );
        let limits = chosen.limits;
        let within = |offsets: [f64; 2], most: [f64; 2]| (0..2).all(|axis| offsets[axis].abs() <= most[axis]);
        let votes_could_be = |least_share: f64| {
            chosen.votes.is_some_and(|votes| {
                within(votes.offsets_deg, limits.offsets_deg) && votes.share >= least_share
            })
        };
        match (chosen.odds, chosen.basis) {
            (Some(odds), basis) => {
                assert!(chosen.planes.is_some() && votes_could_be(limits.share), "{chosen:?}");
                let expected =
                    if odds.sum() > limits.log_odds { LightBasis::Votes } else { LightBasis::Planes };
                assert_eq!(basis, expected, "{chosen:?}");
            }
            (None, LightBasis::Votes) => assert!(votes_could_be(limits.share_without_planes), "{chosen:?}"),
            (None, LightBasis::Planes) => {
                assert!(chosen.planes.is_some() && !votes_could_be(limits.share), "{chosen:?}");
            }
            (None, _) => {
                assert!(
                    chosen.direction.is_none() && !votes_could_be(limits.share_without_planes),
                    "{chosen:?}"
                );
            }
        }
        bases.insert(chosen.basis.name());
    }
    assert!(bases.len() > 1, "{bases:?}");
}

#[test]
fn a_clipped_blob_is_filled_by_its_figures_and_has_its_pixels() {
    let traced = Traced::marbled(&Params::default(), 1.0);
    let record = traced.trace.stage_trace(Stage::Split).unwrap().local().unwrap();
    let mut filled = 0;
    for decision in traced.decisions() {
        let Event::RepairTried(tried) = decision else { continue };
        let pixels = record.blob(tried.blob);
        assert_eq!((pixels.len(), pixels[0]), (tried.pixels as usize, tried.pixel.get()));
        let passes = tried.ring.value >= tried.ring.limit
            && tried.inner > tried.outer
            && tried.spread.value <= tried.spread.limit
            && tried.around.value >= tried.around.limit;
        assert_eq!(tried.verdict == RepairVerdict::Filled, passes, "{tried:?}");
        filled += usize::from(passes);
    }
    assert!(filled > 0);
}

#[test]
fn what_is_told_of_a_pixel_is_what_it_got() {
    let traced = Traced::marbled(&Params::default(), 1.0);
    let record = traced.trace.stage_trace(Stage::Split).unwrap().local().unwrap();
    let mut fates = BTreeSet::new();
    for pixel in (0..traced.image.pixels.len()).step_by(3) {
        let history = traced.history(pixel);
        let story = history.iter().find_map(|what| match what {
            HistoryKind::Surroundings(story) => Some(**story),
            _ => None,
        });
        let unfit = history.iter().find_map(|what| match what {
            HistoryKind::Split(split) => split.unfit,
            _ => None,
        });
        let assigned = traced.analysis.finals.labels[pixel] != 0;
        assert_eq!(
            (story.is_some(), unfit.is_some()),
            (record.outside(pixel), record.outside(pixel) && assigned)
        );
        let Some(story) = story else { continue };
        fates.insert(format!("{:?}", story.fate));
        let filled = history.iter().any(|what| match what {
            HistoryKind::Decided(event) => matches!(
                &**event,
                Event::RepairTried(tried) if tried.verdict == RepairVerdict::Filled
            ),
            _ => false,
        });
        if filled {
            assert_eq!(
                (story.fate, unfit.is_none_or(|unfit| unfit.surface.is_none())),
                (LocalFate::Clipped, true)
            );
            continue;
        }
        let got = traced.surface(pixel);
        assert!((story.surface - got).abs() < 0.05 + 1e-3 * got, "pixel {pixel}: {got}, {story:?}");
        assert!(unfit.is_none_or(|unfit| unfit.surface == Some(story.surface)));
        let expected = if story.surface > 0.0 { 0.5 * story.weight } else { 0.0 };
        let confidence = traced.analysis.intrinsic.confidence[pixel];
        assert!((expected - confidence).abs() < 2e-3, "pixel {pixel}: {confidence}, {story:?}");
        assert_eq!(story.weight > 0.0, story.fate == LocalFate::Taken, "{story:?}");
    }
    for fate in ["Faint", "Taken", "Clipped", "Print"] {
        assert!(fates.contains(fate), "{fate} of {fates:?}");
    }
}

#[test]
fn a_record_of_prints_is_played_forward_and_back_and_ends_in_the_result() {
    for refine in
        [Refine::default(), Refine { highlight_evidence: false, belief: false, ..Refine::default() }]
    {
        let params = Params { refine, ..Params::default() };
        let traced = Traced::marbled(&params, 1.0);
        assert!(fingerprint(&traced.analysis) == fingerprint(&analyze(&traced.image, &params)));
        let (trace, split) = (&traced.trace, traced.trace.steps_of(Stage::Split));
        let mut replay = Replay::new(Arc::clone(trace));
        replay.seek(trace.len());
        let kinds: Vec<PixelKind> = (0..traced.image.pixels.len()).map(|pixel| replay.kind(pixel)).collect();
        assert!(kinds == traced.analysis.intrinsic.kinds.as_slice());
        assert_eq!(replay.light(), traced.analysis.illuminant.map(|light| light.direction));
        let local = |(n, event): (usize, &Event)| {
            let of_light = matches!(event.kind(), Kind::LightChoice | Kind::Votes);
            (is_local(event) || of_light).then_some(n)
        };
        let steps: Vec<usize> = trace.events().filter_map(local).collect();
        assert!(steps.iter().filter(|n| split.contains(n)).count() > 3);
        let mut prepared = Replay::new(Arc::clone(trace));
        prepared.prepare();
        for &n in steps.iter().step_by(steps.len().div_ceil(12)) {
            prepared.seek(n);
            let before = prepared.clone();
            assert!(prepared.forward() && prepared.back() && prepared == before, "step {n}");
            let mut fresh = Replay::new(Arc::clone(trace));
            fresh.seek(n);
            assert!(prepared == fresh, "step {n}");
        }
        let pixels = traced.image.pixels.len();
        assert!(trace.bytes() <= 48 * pixels, "{} bytes a pixel", trace.bytes() / pixels);
    }
}

#[test]
fn a_light_that_is_not_known_after_all_is_none_in_the_last_state() {
    // Shaded noise of many colors: planes that no material causes, and votes that agree on no light.
    let image = picture(160, 120, |x, y| {
        let hue = (x / 20 * 7 + y / 20 * 13) as f32;
        let shade = 40.0 + (x % 20) as f32 * 6.0 + ((x * 31 + y * 17) % 11) as f32;
        [1.0 + (hue * 1.3).sin(), 1.0 + (hue * 2.1).cos(), 1.0 + (hue * 0.7).sin()]
            .map(|band| band * shade * 0.45 + 10.0)
    });
    let traced = Traced::new(image, &Params::default());
    let mut replay = Replay::new(Arc::clone(&traced.trace));
    replay.seek(traced.trace.len());
    assert_eq!(replay.light(), traced.analysis.illuminant.map(|light| light.direction));
}

#[test]
fn every_decision_is_a_sentence_and_a_line() {
    let mut seen = BTreeSet::new();
    let unsplit = Params { refine: Refine { local_split: false, ..Refine::default() }, ..Params::default() };
    for traced in [
        Traced::marbled(&Params::default(), 1.0),
        Traced::marbled(&unsplit, 1.0),
        Traced::printed(31, &Params::default()),
    ] {
        let names = Names::of(&traced.trace);
        for (n, event) in traced.trace.events() {
            let kind = event.kind();
            seen.insert(kind);
            let sentence = names.event(event);
            assert!(sentence.len() > 3 && !sentence.contains("  "), "{kind:?}: {sentence:?}");
            let mut line = String::new();
            let stage = traced.trace.stage_at(n).unwrap();
            trace_line(&names, n, stage, &Step::Event(event), &mut line);
            let value: serde_json::Value = serde_json::from_str(&line).unwrap();
            let says =
                ["values", "thresholds"].iter().any(|part| !value[part].as_object().unwrap().is_empty());
            assert!(says || kind == Kind::Stage || kind == Kind::Growth || kind == Kind::Pass, "{line}");
        }
    }
    let new = [
        Kind::Votes,
        Kind::LightChoice,
        Kind::LocalSplit,
        Kind::PictureOdds,
        Kind::Plausibility,
        Kind::Repair,
    ];
    assert!(new.iter().all(|kind| seen.contains(kind)), "{seen:?}");
}
