//! A pixel's history is complete, in order, and agrees with the trace.

use crate::common::any_readings;
use crate::synthetic::Scene;
use dichroscope::analysis::{Analysis, Session};
use dichroscope::describe::{Names, condense, trace_line};
use dichroscope::params::{Method, PaperMethod, Params, Setting};
use dichroscope::photo::LinearImage;
use dichroscope::raster::{HypothesisId, PixelIndex, RegionId};
use dichroscope::reflection::{SliceBound, SliceMiss};
use dichroscope::trace::{
    Barrier, Birth, Event, GrowthBegan, HistoryEntry, HistoryKind, JoinedHow, Pass, PixelKind, Reach, Replay,
    Stage, Step, Trace, lineage, pixel_history, story,
};
use proptest::prelude::*;
use std::sync::Arc;

struct Traced {
    image: Arc<LinearImage>,
    analysis: Analysis,
    trace: Arc<Trace>,
}

impl Traced {
    fn new(seed: u64, params: &Params) -> Self {
        let image = Arc::new(Scene::grid_of_balls([140, 70], 2, 1, seed).render().image);
        let (analysis, trace) = Session::new(Arc::clone(&image)).run_traced(params, &mut ()).unwrap();
        Self { image, analysis, trace: Arc::new(trace) }
    }

    fn history(&self, pixel: usize) -> Vec<HistoryEntry> {
        pixel_history(&self.trace, &self.image, &self.analysis.masks, PixelIndex::from_index(pixel))
    }

    /// The pixels whose histories are tested: spread over the picture, and on the borders of regions.
    fn pixels(&self) -> Vec<usize> {
        let labels = &self.analysis.finals.labels;
        let mut border = Vec::new();
        for pixel in 0..labels.len() {
            let mut edge = false;
            labels.for_each_neighbor(pixel, |near| edge |= labels[near] != labels[pixel]);
            if edge {
                border.push(pixel);
            }
        }
        let step = border.len().div_ceil(40).max(1);
        (0..labels.len()).step_by(401).chain(border.into_iter().step_by(step)).collect()
    }
}

fn random_params() -> impl Strategy<Value = Params> {
    let method = prop_oneof![
        3 => Just(Method::Refined),
        3 => Just(Method::Paper),
        1 => Just(Method::Phoenix),
        1 => Just(Method::TopDown),
        1 => Just(Method::ByHand),
    ];
    let numbers = (1.5f64..6.0, 1.5f64..6.0, 60u32..600);
    (method, numbers, any_readings()).prop_map(|(method, (cylinder, slice, area), readings)| Params {
        cylinder_width: Setting::Value(cylinder),
        slice_width: Setting::Value(slice),
        min_area: Setting::Value(f64::from(area)),
        paper: PaperMethod { readings, ..PaperMethod::default() },
        ..Params::of(method)
    })
}

/// The owner of the pixel after a history entry; `None` when the entry does not change the owner.
#[allow(clippy::option_option, reason = "no owner is an owner too")]
fn owner_after(what: &HistoryKind) -> Option<Option<HypothesisId>> {
    match *what {
        HistoryKind::Seeded { hypothesis, .. }
        | HistoryKind::Claimed { hypothesis, .. }
        | HistoryKind::Voted { hypothesis, .. }
        | HistoryKind::Filled { hypothesis, .. }
        | HistoryKind::Patched { hypothesis, .. }
        | HistoryKind::Marked { hypothesis, .. } => Some(Some(hypothesis)),
        HistoryKind::Released { .. } => Some(None),
        HistoryKind::Merged { into, .. } => Some(Some(into)),
        HistoryKind::Reset { to, .. } => Some(to),
        HistoryKind::Separated { part, .. } => Some(Some(part)),
        _ => None,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    #[test]
    fn every_change_of_hands_is_told_and_leads_to_the_result(seed in any::<u64>(), params in random_params()) {
        let traced = Traced::new(seed, &params);
        let pixels = traced.pixels();
        let mut claims = vec![Vec::new(); traced.image.pixels.len()];
        for (n, step) in traced.trace.steps() {
            if let Step::Claim { pixel, after, .. } = step {
                claims[pixel.index()].push((n, after));
            }
        }
        for pixel in pixels {
            let history = traced.history(pixel);
            prop_assert!(history.is_sorted_by_key(|happening| happening.step));
            let told: Vec<(usize, Option<HypothesisId>)> =
                history.iter().filter_map(|h| Some((h.step, owner_after(&h.what)?))).collect();
            prop_assert_eq!(&told, &claims[pixel], "pixel {}", pixel);
            let split = history.iter().find_map(|h| match &h.what {
                HistoryKind::Split(story) => Some((story.region, story.kind)),
                _ => None,
            });
            let label = traced.analysis.finals.labels[pixel];
            let kind = traced.analysis.intrinsic.kinds[pixel];
            let expected = RegionId::from_label(label).map(|region| (region, kind));
            prop_assert_eq!(split, expected, "pixel {}", pixel);
        }
    }

    #[test]
    fn the_numbers_told_are_those_that_decided(seed in any::<u64>(), params in random_params()) {
        let traced = Traced::new(seed, &params);
        for pixel in traced.pixels() {
            for HistoryEntry { step, what, .. } in traced.history(pixel) {
                let holds = match &what {
                    HistoryKind::Seeded { reach, .. } | HistoryKind::Claimed { reach, .. } => match *reach {
                        Reach::Axis { distance, radius } => f64::from(distance) <= radius + 1e-3,
                        Reach::Plane { distance, half_width } => f64::from(distance) <= half_width + 1e-3,
                        Reach::Brightness { brightness, start } => brightness >= start - 1e-3,
                    },
                    HistoryKind::Refused { barrier, .. } => match *barrier {
                        Barrier::Cylinder { distance, radius } => f64::from(distance) >= radius - 1e-3,
                        Barrier::Slice(SliceMiss { bound: SliceBound::Surface | SliceBound::Black, value, limit }) => {
                            value < limit
                        }
                        Barrier::Slice(SliceMiss { value, limit, .. }) => value > limit,
                        Barrier::OtherBands { distance, limit } => distance > limit,
                        Barrier::Darker { brightness, start } => brightness <= start + 1e-3,
                    },
                    HistoryKind::Split(story) => {
                        let nearer = story.lines.is_none_or(|[matte, highlight]| {
                            (story.kind == PixelKind::Highlight) == (highlight < matte) || (highlight - matte).abs() < 1e-2
                        });
                        let intrinsic = &traced.analysis.intrinsic;
                        let length = |c: [f32; 3]| c.iter().map(|v| v * v).sum::<f32>().sqrt();
                        // Near another region only a part of the surface reflection stays, and the rest is body reflection.
                        let kept = story.border.map_or(1.0, |border| border.kept);
                        // Where the plane is not used, the amounts are those that the plane would give, and nothing of the color is lost.
                        let color = traced.image.pixels[pixel];
                        let is_whole = (0..3).all(|band| {
                            (intrinsic.body[pixel][band] + intrinsic.surface[pixel][band] - color[band]).abs() < 0.05
                        });
                        let is_believed = matches!(story.kind, PixelKind::Matte | PixelKind::Highlight);
                        (story.unfit.is_some() && (is_whole || !is_believed)) || (nearer || kept <= 0.0) && story.amounts.is_none_or(|amounts| {
                            let body = length(intrinsic.body[pixel]);
                            let is_body = (amounts.body.abs() - body).abs() < 0.05;
                            (if story.border.is_none() { is_body } else { body >= amounts.body - 0.05 })
                                && (kept * amounts.surface.abs() - length(intrinsic.surface[pixel])).abs() < 0.05
                                && (amounts.noise - intrinsic.noise[pixel]).abs() < 0.05
                        })
                    }
                    HistoryKind::Window(story) => {
                        let directions = story.trials.iter().filter(|trial| !trial.is_noise()).count();
                        story.class.is_none_or(|class| class as usize == directions)
                    }
                    _ => true,
                };
                prop_assert!(holds, "pixel {}, step {}: {:?}", pixel, step, what);
            }
        }
    }

    #[test]
    fn a_region_that_grew_beside_a_pixel_took_it_or_there_is_a_reason(
        seed in any::<u64>(), params in random_params(),
    ) {
        let traced = Traced::new(seed, &params);
        let pixels: Vec<usize> = traced.pixels().into_iter().step_by(7).collect();
        let histories: Vec<Vec<HistoryEntry>> = pixels.iter().map(|&pixel| traced.history(pixel)).collect();
        let mut replay = Replay::new(Arc::clone(&traced.trace));
        let events: Vec<(usize, &Event)> = traced.trace.events().collect();
        for (index, &(step, event)) in events.iter().enumerate() {
            let Event::GrowthBegan(GrowthBegan { hypothesis, .. }) = *event else { continue };
            if traced.trace.pass_at(step).map(|span| span.pass) == Some(Pass::Brightness) {
                continue;
            }
            let end = events.get(index + 1).map_or(traced.trace.len(), |&(next, _)| next);
            // The claims that a rejected hypothesis gives back follow its growth without an event of their own.
            replay.seek(end);
            for (&pixel, history) in pixels.iter().zip(&histories) {
                let labels = replay.labels();
                let mut beside = false;
                labels.for_each_neighbor(pixel, |near| beside |= labels[near] == hypothesis.get());
                if !beside || labels[pixel] == hypothesis.get() {
                    continue;
                }
                let stage = traced.trace.stage_at(step);
                let told = history.iter().any(|happening| {
                    let here = (step..end).contains(&happening.step);
                    match &happening.what {
                        HistoryKind::Refused { hypothesis: by, .. } => here && *by == hypothesis,
                        HistoryKind::Kept { challenger, .. } => here && *challenger == hypothesis,
                        HistoryKind::Unclaimable { hypotheses } => {
                            Some(happening.stage) == stage && hypotheses.contains(&hypothesis)
                        }
                        _ => false,
                    }
                });
                prop_assert!(told, "pixel {}, hypothesis {} at {}: {:#?}", pixel, hypothesis, step, history);
            }
        }
    }

    #[test]
    fn everything_has_words_and_a_line(seed in any::<u64>(), params in random_params()) {
        let traced = Traced::new(seed, &params);
        let names = Names::of(&traced.trace);
        let mut line = String::new();
        for (n, step) in traced.trace.steps().filter(|(n, step)| n % 17 == 0 || matches!(step, Step::Event(_))) {
            prop_assert!(!names.step(&step).is_empty(), "{:?}", step);
            line.clear();
            trace_line(&names, n, traced.trace.stage_at(n).unwrap(), &step, &mut line);
            let parsed: serde_json::Value = serde_json::from_str(&line).unwrap();
            prop_assert_eq!(parsed.as_object().unwrap().len(), 6, "{}", line);
        }
        for pixel in traced.pixels() {
            let history = traced.history(pixel);
            let condensed = condense(&history);
            prop_assert_eq!(condensed.iter().map(|line| line.times).sum::<usize>(), history.len());
            prop_assert!(history.iter().all(|happening| !names.history_entry(happening).is_empty()));
        }
    }

    #[test]
    fn a_region_descends_from_every_hypothesis_that_joined_it(seed in any::<u64>(), params in random_params()) {
        let traced = Traced::new(seed, &params);
        let regions = traced.analysis.intrinsic.regions.len();
        for region in RegionId::all(regions) {
            let ancestors = lineage(&traced.trace, region);
            prop_assert_eq!((ancestors[0].depth, ancestors[0].joined), (0, None));
            for ancestor in &ancestors {
                let told = story(&traced.trace, ancestor.hypothesis).unwrap();
                prop_assert_eq!(told.chosen.is_some(), matches!(ancestor.birth, Birth::Area { .. }));
                let Some(joined) = ancestor.joined else {
                    prop_assert!(told.end.is_none() && told.region == Some(region));
                    continue;
                };
                prop_assert!(ancestors.iter().any(|other| other.hypothesis == joined.to));
                if joined.how != JoinedHow::Whole {
                    prop_assert_eq!(told.end.map(|(step, _)| step), Some(joined.step));
                }
            }
        }
        let last = HypothesisId::from_index(HypothesisId::MOST);
        prop_assert!(lineage(&traced.trace, RegionId::from_index(regions)).is_empty());
        prop_assert!(story(&traced.trace, last).is_none());
    }
}

#[test]
fn a_dark_pixel_has_a_short_history() {
    let traced = Traced::new(5, &Params::default());
    let dark = (0..traced.image.pixels.len()).find(|&pixel| traced.analysis.masks.dark(pixel)).unwrap();
    let history = traced.history(dark);
    assert!(matches!(history[0].what, HistoryKind::Masked(_)) && history[0].stage == Stage::Masks);
    assert!(history.len() < 4, "{history:?}");
}
