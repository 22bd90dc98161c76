//! A trace can be replayed forward and backward, ends in the result, and recording does not change the result.

use crate::common::{analyze, any_readings, fingerprint};
use crate::synthetic::Scene;
use dichroscope::analysis::{Analysis, Observer, Session};
use dichroscope::params::{Baseline, Method, PaperMethod, Params, Setting};
use dichroscope::raster::{HypothesisId, RegionId};
use dichroscope::trace::{Class, Event, PassBegan, PixelKind, Replay, Stage, StageBegan, Trace};
use proptest::prelude::*;
use std::sync::Arc;

fn random_params() -> impl Strategy<Value = Params> {
    let numbers = (4u32..14, 1f64..8.0, 1f64..8.0, 60u32..800, 1f64..6.0);
    let method = prop_oneof![
        3 => Just(Method::Refined),
        3 => Just(Method::Paper),
        1 => Just(Method::Phoenix),
        1 => Just(Method::TopDown),
        1 => Just(Method::ByHand),
    ];
    (method, any::<bool>(), numbers, any_readings()).prop_map(|(method, default, numbers, readings)| {
        if default {
            return Params::of(method);
        }
        let (window, cylinder, slice, area, noise) = numbers;
        Params {
            paper: PaperMethod { readings, ..PaperMethod::default() },
            window_size: Setting::Value(f64::from(window)),
            cylinder_width: Setting::Value(cylinder),
            slice_width: Setting::Value(slice),
            min_area: Setting::Value(f64::from(area)),
            camera_noise: Setting::Value(noise),
            ..Params::of(method)
        }
    })
}

/// Trace and result of a random scene.
fn traced(seed: u64, params: &Params) -> (Analysis, Arc<Trace>) {
    let image = Scene::grid_of_balls([140, 70], 2, 1, seed).render().image;
    let (analysis, trace) = Session::new(Arc::new(image)).run_traced(params, &mut ()).unwrap();
    (analysis, Arc::new(trace))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn the_last_state_is_the_result(seed in any::<u64>(), params in random_params()) {
        let (analysis, trace) = traced(seed, &params);
        let mut replay = Replay::new(Arc::clone(&trace));
        replay.seek(trace.len());
        let finals = replay.labels().map(|&label| {
            RegionId::label(HypothesisId::from_label(label).and_then(|hypothesis| replay.region_of(hypothesis)))
        });
        prop_assert!(finals == analysis.finals.labels, "regions differ");
        for (hypothesis, _) in replay.numbered_hypotheses() {
            let pixels = replay.size(hypothesis);
            let held = replay.labels().as_slice().iter().filter(|&&label| label == hypothesis.get()).count();
            prop_assert_eq!(pixels as usize, held, "size of hypothesis {}", hypothesis);
        }
        let kinds: Vec<PixelKind> = (0..finals.len()).map(|pixel| replay.kind(pixel)).collect();
        prop_assert!(kinds == analysis.intrinsic.kinds.as_slice(), "kinds differ");
        prop_assert_eq!(replay.light(), analysis.illuminant.map(|light| light.direction));

        let is_baseline = params.baseline().is_some();
        prop_assert_eq!(replay.first_grid().is_none(), is_baseline, "the earlier methods know no windows");
        if let Some(grid) = replay.first_grid() {
            let classes: Vec<Option<Class>> = grid.classes.as_slice().iter().map(|class| class.flatten()).collect();
            prop_assert!(classes == analysis.windows.classes.as_slice(), "classes differ");
            replay.seek(trace.steps_of(Stage::Merge).end);
            let areas = replay.grid().unwrap().areas();
            let width = finals.width();
            let merged: Vec<u32> = (0..finals.len())
                .map(|pixel| {
                    let window = replay.grid().unwrap().window_of(pixel, width);
                    if classes[areas[window] as usize].is_some() { areas[window] + 1 } else { 0 }
                })
                .collect();
            prop_assert!(merged == analysis.areas.as_slice(), "areas differ");
        }

        replay.seek(trace.steps_of(Stage::Linear).end);
        prop_assert!(*replay.labels() == analysis.matte.labels, "matte regions differ");
        for (id, hypothesis) in HypothesisId::all(analysis.matte.hypotheses.len()).zip(&analysis.matte.hypotheses) {
            let line = replay.hypothesis(id).unwrap().line();
            let has_lines = !params.baseline().is_some_and(Baseline::finds_regions_alone);
            prop_assert_eq!(line, Some(&hypothesis.line).filter(|_| has_lines));
            prop_assert_eq!(replay.hypothesis(id).unwrap().end().is_none(), hypothesis.alive);
        }
        replay.seek(trace.steps_of(Stage::Planar).end);
        prop_assert!(*replay.labels() == analysis.planar.labels, "planar regions differ");
    }

    #[test]
    fn recording_changes_nothing(seed in any::<u64>(), params in random_params()) {
        let image = Scene::grid_of_balls([140, 70], 2, 1, seed).render().image;
        let (recorded, _) = Session::new(Arc::new(image.clone())).run_traced(&params, &mut ()).unwrap();
        prop_assert!(fingerprint(&recorded) == fingerprint(&analyze(&image, &params)));
    }

    #[test]
    fn forward_then_back_is_where_one_was(
        seed in any::<u64>(), params in random_params(), places in prop::collection::vec(0f64..1.0, 1..8),
    ) {
        let (_, trace) = traced(seed, &params);
        let mut replay = Replay::new(Arc::clone(&trace));
        for place in places {
            replay.seek((place * trace.len() as f64) as usize);
            let before = replay.clone();
            if replay.forward() {
                prop_assert!(replay.back());
                prop_assert!(replay == before, "forward, back at {}", before.at());
            }
            if replay.back() {
                prop_assert!(replay.forward());
                prop_assert!(replay == before, "back, forward at {}", before.at());
            }
        }
    }

    #[test]
    fn wherever_one_comes_from_a_place_is_the_same(
        seed in any::<u64>(), params in random_params(), places in prop::collection::vec(0f64..1.05, 2..8),
    ) {
        let (_, trace) = traced(seed, &params);
        let mut prepared = Replay::new(Arc::clone(&trace));
        prepared.prepare();
        for place in places {
            let n = (place * trace.len() as f64) as usize;
            prepared.seek(n);
            let mut fresh = Replay::new(Arc::clone(&trace));
            while fresh.at() < n && fresh.forward() {}
            prop_assert!(prepared == fresh, "step {n} of {}", trace.len());
        }
    }

    #[test]
    fn a_step_is_the_same_by_number_and_in_order(seed in any::<u64>(), params in random_params()) {
        let (_, trace) = traced(seed, &params);
        let mut steps = 0;
        for (n, step) in trace.steps() {
            prop_assert_eq!(n, steps);
            if n % 37 == 0 {
                prop_assert_eq!(trace.step(n), Some(step));
            }
            steps += 1;
        }
        prop_assert_eq!(steps, trace.len());
        prop_assert_eq!(trace.step(steps), None);
        prop_assert!(trace.bytes() <= 48 * 140 * 70, "{} bytes a pixel", trace.bytes() / (140 * 70));
    }
}

#[test]
fn every_stage_announces_itself_once_and_in_order() {
    let (_, trace) = traced(5, &Params::default());
    let begun = |event: &Event| match event {
        Event::StageBegan(StageBegan { stage }) => Some(*stage),
        _ => None,
    };
    let begun: Vec<Stage> = trace.events().filter_map(|(_, event)| begun(event)).collect();
    assert_eq!(begun, Stage::ALL);
    for (stage, steps) in trace.stages() {
        assert_eq!(trace.event(steps.start), Some(&Event::StageBegan(StageBegan { stage })));
    }
}

/// An observer that records which stages ran.
#[derive(Default)]
struct Ran(Vec<Stage>);

impl Observer for Ran {
    fn finished(&mut self, stage: Stage, reused: bool) {
        if !reused {
            self.0.push(stage);
        }
    }
}

#[test]
fn a_record_is_kept_beside_its_output() {
    let image = Arc::new(Scene::grid_of_balls([140, 70], 2, 1, 5).render().image);
    let mut session = Session::new(image);
    let params = Params::default();
    let plain = session.run(&params, &mut ()).unwrap();
    let ran = |session: &mut Session, params: &Params| {
        let mut ran = Ran::default();
        let found = session.run_traced(params, &mut ran).unwrap();
        (ran.0, found)
    };
    let (stages, (analysis, first)) = ran(&mut session, &params);
    assert_eq!(stages, Stage::ALL, "nothing had a record");
    assert!(Arc::ptr_eq(&analysis.finals, &plain.finals), "the same output, not an equal one");
    let (stages, (_, second)) = ran(&mut session, &params);
    assert!(stages.is_empty(), "every stage has a record: {stages:?}");
    assert_eq!(first.first_difference(&second), None);
    let wider = Params { slice_width: Setting::Value(6.0), ..params };
    let (stages, (_, third)) = ran(&mut session, &wider);
    assert_eq!(stages, [Stage::Planar, Stage::Clipping, Stage::Split]);
    let differs = first.first_difference(&third).unwrap();
    assert!(first.steps_of(Stage::Planar).contains(&differs), "{differs}");
    assert_ne!(first.step(differs), third.step(differs));
}

#[test]
fn passes_and_blocks_lie_in_order_within_their_stages() {
    let (_, trace) = traced(8, &Params::default());
    let mut end = 0;
    for span in trace.passes() {
        assert!(span.steps.start >= end && span.steps.start < span.steps.end, "{span:?}");
        end = span.steps.end;
        assert_eq!(trace.pass_at(span.steps.start), Some(span.clone()));
        assert_eq!(trace.event(span.steps.start), Some(&Event::PassBegan(PassBegan { pass: span.pass })));
    }
    let mut end = 0;
    for block in trace.blocks() {
        assert!(block.steps.start >= end && block.steps.start < block.steps.end, "{block:?}");
        end = block.steps.end;
        assert_eq!(trace.block_at(block.steps.end - 1), Some(block));
    }
    assert!(end > 0, "there are blocks");
}
