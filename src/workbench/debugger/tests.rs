use super::cursor::stepped;
use super::*;
use crate::segment::{Parameter, Setting};
use crate::trace::{Event, Kind, Stage, Step, Topic};
use crate::workbench::{Command, Executor, Origin, State, Workbench};
use proptest::prelude::*;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

/// A bench in whose calls all work is done, with the tiny scene open and recorded.
fn bench() -> Workbench {
    let mut bench = Workbench::new(Executor::Inline, || ()).unwrap();
    bench.apply(Command::Open(Origin::File(TINY.into())));
    bench
}

fn debug(bench: &mut Workbench, command: DebugCommand) {
    bench.apply(Command::Debug(command));
}

fn settings(bench: &mut Workbench, change: impl FnOnce(&mut DebugSettings)) {
    let mut settings = bench.state().view.debug.clone();
    change(&mut settings);
    debug(bench, DebugCommand::Settings(settings));
}

fn replay(state: &State) -> &Replay {
    state.debugger.replay.as_ref().unwrap()
}

fn at(bench: &Workbench) -> usize {
    replay(bench.state()).at()
}

fn trace(bench: &Workbench) -> Arc<Trace> {
    Arc::clone(bench.state().debugger.trace().unwrap())
}

/// The block about this that comes first.
fn block(trace: &Trace, wanted: impl Fn(Topic) -> bool) -> crate::trace::Block {
    trace.blocks().find(|block| wanted(block.topic)).unwrap()
}

fn grows(topic: Topic) -> bool {
    matches!(topic, Topic::Hypothesis(_))
}

#[test]
fn a_result_comes_with_its_trace_and_the_cursor_at_its_end() {
    let bench = bench();
    let state = bench.state();
    assert_eq!(at(&bench), trace(&bench).len());
    assert!(state.debugger.stopped().is_none(), "the panels show the result");
    assert!(Arc::ptr_eq(state.newest.as_ref().unwrap().trace().unwrap(), &trace(&bench)));
    let finals = &state.newest.as_ref().unwrap().analysis.finals.labels;
    for (pixel, &label) in replay(state).labels().as_slice().iter().enumerate() {
        assert_eq!(state.debugger.names.final_number(label), finals[pixel]);
    }
    for (index, &colour) in state.newest.as_ref().unwrap().region_colours.iter().enumerate() {
        let birth = state.debugger.names.births_of(index as u16 + 1).next().unwrap();
        assert_eq!(state.debugger.names.colour(birth), colour);
    }
}

#[test]
fn without_the_debugger_nothing_is_recorded_and_opening_it_records_what_is_there() {
    let mut bench = bench();
    settings(&mut bench, |settings| settings.open = false);
    assert!(bench.state().debugger.replay.is_none());
    bench.apply(Command::SetParameter(Parameter::CylinderWidth, Setting::Value(3.0), None));
    assert!(bench.state().newest.as_ref().unwrap().trace().is_none());
    let generation = bench.state().generation;
    settings(&mut bench, |settings| settings.open = true);
    assert_eq!(bench.state().generation, generation, "nothing was asked anew");
    assert_eq!(at(&bench), trace(&bench).len());
}

#[test]
fn each_grain_goes_from_edge_to_edge_and_back() {
    let mut bench = bench();
    let trace = trace(&bench);
    debug(&mut bench, DebugCommand::Seek(0));
    for (stage, steps) in trace.stages() {
        debug(&mut bench, DebugCommand::Step(Grain::Stage, Direction::Forward));
        assert_eq!(at(&bench), steps.end, "{stage:?}");
    }
    for (stage, steps) in trace.stages().collect::<Vec<_>>().into_iter().rev() {
        debug(&mut bench, DebugCommand::Step(Grain::Stage, Direction::Back));
        assert_eq!(at(&bench), steps.start, "{stage:?}");
    }
    let first = block(&trace, grows);
    debug(&mut bench, DebugCommand::Seek(first.steps.start));
    debug(&mut bench, DebugCommand::Step(Grain::Hypothesis, Direction::Forward));
    assert_eq!(at(&bench), first.steps.end);
    debug(&mut bench, DebugCommand::Step(Grain::Hypothesis, Direction::Back));
    assert_eq!(at(&bench), first.steps.start);
    debug(&mut bench, DebugCommand::Step(Grain::Event, Direction::Forward));
    assert!(matches!(replay(bench.state()).last(), Some(Step::Event(Event::HypothesisChosen(_)))));
    debug(&mut bench, DebugCommand::Step(Grain::Claim, Direction::Back));
    assert_eq!(at(&bench), first.steps.start);
}

#[test]
fn every_grain_ends_at_both_ends() {
    let mut bench = bench();
    let len = trace(&bench).len();
    for grain in Grain::ALL {
        let mut turns = 0;
        debug(&mut bench, DebugCommand::Seek(0));
        while at(&bench) < len {
            let before = at(&bench);
            debug(&mut bench, DebugCommand::Step(grain, Direction::Forward));
            assert!(at(&bench) > before, "{grain:?} stands still at {before}");
            turns += 1;
        }
        while at(&bench) > 0 {
            let before = at(&bench);
            debug(&mut bench, DebugCommand::Step(grain, Direction::Back));
            assert!(at(&bench) < before, "{grain:?} stands still at {before}");
        }
        assert!(turns >= 7, "{grain:?}");
    }
}

#[test]
fn rings_are_what_one_more_step_from_the_region_reaches() {
    let mut bench = bench();
    let trace = trace(&bench);
    for first in trace.blocks().filter(|block| matches!(block.topic, Topic::Hypothesis(_) | Topic::Slice(_)))
    {
        let region = first.topic.region();
        let mut cursor = replay(bench.state()).clone();
        let ends = rings(&mut cursor, &first);
        assert_eq!(cursor.at(), at(&bench), "the cursor comes back");
        assert_eq!(ends.last(), Some(&first.steps.end));
        let mut from = first.steps.start;
        for &end in &ends {
            cursor.seek(from);
            let held = cursor.labels().clone();
            let seeds = matches!(trace.event(from), Some(Event::SeedsPlaced { .. }));
            for (n, step) in trace.steps_in(from..end) {
                let Step::Claim { pixel, after, .. } = step else { continue };
                if after != region || seeds {
                    continue;
                }
                let mut reached = false;
                held.for_each_neighbour(pixel as usize, |near| reached |= held[near] == region);
                assert!(reached, "step {n} is not of the ring that ends at {end}");
            }
            from = end;
        }
    }
    debug(&mut bench, DebugCommand::Seek(block(&trace, grows).steps.start + 1));
    debug(&mut bench, DebugCommand::Step(Grain::Ring, Direction::Forward));
    let ring = at(&bench);
    debug(&mut bench, DebugCommand::Step(Grain::Ring, Direction::Forward));
    debug(&mut bench, DebugCommand::Step(Grain::Ring, Direction::Back));
    assert_eq!(at(&bench), ring);
}

#[test]
fn playing_goes_on_with_time_stops_at_the_end_and_may_begin_anew() {
    let mut bench = bench();
    let len = trace(&bench).len();
    settings(&mut bench, |settings| (settings.grain, settings.per_second) = (Grain::Claim, 100.0));
    debug(&mut bench, DebugCommand::Play(Some(Direction::Forward)));
    assert_eq!(at(&bench), 0, "from the end it plays from the beginning");
    debug(&mut bench, DebugCommand::Tick(0.015));
    debug(&mut bench, DebugCommand::Tick(0.015));
    assert_eq!(at(&bench), 3, "fractions add up");
    debug(&mut bench, DebugCommand::Play(None));
    debug(&mut bench, DebugCommand::Tick(0.1));
    assert_eq!(at(&bench), 3);
    settings(&mut bench, |settings| (settings.grain, settings.per_second) = (Grain::Stage, 100.0));
    debug(&mut bench, DebugCommand::Play(Some(Direction::Forward)));
    debug(&mut bench, DebugCommand::Tick(0.2));
    assert_eq!((at(&bench), bench.state().debugger.playing), (len, None));
    settings(&mut bench, |settings| settings.looped = true);
    debug(&mut bench, DebugCommand::Play(Some(Direction::Back)));
    debug(&mut bench, DebugCommand::Tick(0.2));
    assert_eq!((at(&bench), bench.state().debugger.playing), (len, Some(Direction::Back)), "over and over");
}

#[test]
fn into_plays_one_hypothesis() {
    let mut bench = bench();
    let first = block(&trace(&bench), grows);
    let linear = trace(&bench).steps_of(Stage::Linear);
    debug(&mut bench, DebugCommand::Seek(linear.start));
    debug(&mut bench, DebugCommand::Into);
    assert_eq!(at(&bench), first.steps.start + 1);
    for _ in 0..1000 {
        debug(&mut bench, DebugCommand::Tick(0.2));
    }
    assert_eq!((at(&bench), bench.state().debugger.playing), (first.steps.end, None));
}

#[test]
fn goals_are_found_in_both_directions() {
    let mut bench = bench();
    let trace = trace(&bench);
    let run = |bench: &mut Workbench, goal, direction| {
        debug(bench, DebugCommand::RunTo(goal, direction));
        at(bench)
    };
    let slices: Vec<usize> =
        trace.events().filter(|(_, event)| event.kind() == Kind::Slice).map(|(n, _)| n + 1).collect();
    debug(&mut bench, DebugCommand::Seek(0));
    for &slice in &slices {
        assert_eq!(run(&mut bench, Goal::Kind(Kind::Slice), Direction::Forward), slice);
    }
    for &slice in slices.iter().rev().skip(1) {
        assert_eq!(run(&mut bench, Goal::Kind(Kind::Slice), Direction::Back), slice);
    }
    assert_eq!(run(&mut bench, Goal::Kind(Kind::Slice), Direction::Back), 0, "none before: the beginning");

    let labels = &bench.state().newest.as_ref().unwrap().analysis.finals.labels;
    let pixel = labels.as_slice().iter().position(|&label| label != 0).unwrap() as u32;
    let mut owners = Vec::new();
    loop {
        let n = run(&mut bench, Goal::Pixel(pixel), Direction::Forward);
        if n == trace.len() {
            break;
        }
        owners.push(n);
    }
    let moves = trace.steps().filter(|(_, step)| step.pixel() == Some(pixel)).map(|(n, _)| n + 1);
    let expected: Vec<usize> = moves.collect();
    let missing = expected.iter().find(|n| **n < trace.len() && !owners.contains(n));
    assert_eq!(missing, None, "every claim of the pixel is stopped at");
    assert!(owners.iter().any(|&n| trace.event(n - 1).is_some_and(|e| e.kind() == Kind::Window)));
}

#[test]
fn breakpoints_stop_playing_and_running_in_both_directions() {
    let mut bench = bench();
    let trace = trace(&bench);
    let first = block(&trace, grows);
    let region = first.topic.region();
    let condition = Condition::RegionExceeds { region: Some(region), pixels: 40 };
    settings(&mut bench, |settings| {
        settings.breakpoints = vec![
            Breakpoint { enabled: false, condition: Condition::HypothesisRejected },
            Breakpoint { enabled: true, condition },
        ];
        (settings.grain, settings.per_second) = (Grain::Stage, 100.0);
    });
    debug(&mut bench, DebugCommand::Play(Some(Direction::Forward)));
    debug(&mut bench, DebugCommand::Tick(0.2));
    let debugger = &bench.state().debugger;
    assert_eq!((debugger.playing, debugger.stopped_by), (None, Some(1)));
    assert_eq!(replay(bench.state()).size(region), 41, "right after it has outgrown it");
    let stopped = at(&bench);
    for (place, arrives) in [(stopped - 5, stopped - 5), (first.steps.end, stopped)] {
        debug(&mut bench, DebugCommand::Seek(0));
        debug(&mut bench, DebugCommand::RunTo(Goal::Place(place), Direction::Forward));
        assert_eq!(at(&bench), arrives, "a breakpoint on the way stops it, one beyond does not");
    }
    debug(&mut bench, DebugCommand::Seek(first.steps.end));
    debug(&mut bench, DebugCommand::RunTo(Goal::Breakpoint, Direction::Back));
    assert_eq!(at(&bench), stopped);
    debug(&mut bench, DebugCommand::Seek(stopped - 1));
    debug(&mut bench, DebugCommand::RunTo(Goal::Breakpoint, Direction::Forward));
    assert_eq!(at(&bench), stopped);
}

#[test]
fn each_condition_stops_where_it_holds() {
    let mut bench = bench();
    let trace = trace(&bench);
    let all_classes = [SavedClass::Point, SavedClass::Line, SavedClass::Plane, SavedClass::Volume];
    let mut conditions: Vec<Condition> = all_classes.map(Condition::ClassIs).to_vec();
    conditions.extend(CandidateCheck::ALL.map(Condition::CandidateFails));
    conditions.extend([
        Condition::PixelChangesOwner(700),
        Condition::HypothesisRejected,
        Condition::Conflict(None, None),
        Condition::RegionExceeds { region: None, pixels: 60 },
    ]);
    let mut stopped = 0;
    for condition in conditions {
        settings(&mut bench, |s| s.breakpoints = vec![Breakpoint { enabled: true, condition }]);
        debug(&mut bench, DebugCommand::Seek(0));
        loop {
            debug(&mut bench, DebugCommand::RunTo(Goal::Breakpoint, Direction::Forward));
            if bench.state().debugger.stopped_by.is_none() {
                assert_eq!(at(&bench), trace.len());
                break;
            }
            stopped += 1;
            let step = replay(bench.state()).last().unwrap();
            let fits = match (condition, step) {
                (Condition::ClassIs(class), Step::Event(Event::WindowClassified { class: found, .. })) => {
                    *found == Some(class.into())
                }
                (Condition::CandidateFails(check), Step::Event(Event::CandidateTested(test))) => {
                    let verdict = test.verdict;
                    !match check {
                        CandidateCheck::Any => verdict.accepted(),
                        CandidateCheck::LinesMeet => verdict.lines_meet,
                        CandidateCheck::UpperHalf => verdict.upper_half,
                        CandidateCheck::Positive => verdict.positive,
                        CandidateCheck::Beyond => verdict.beyond,
                    }
                }
                (Condition::PixelChangesOwner(wanted), Step::Claim { pixel, .. }) => pixel == wanted,
                (Condition::HypothesisRejected, Step::Event(event)) => {
                    matches!(event.kind(), Kind::PassedOver | Kind::Absorbed | Kind::Dropped)
                }
                (Condition::Conflict(..), Step::Refusal { .. } | Step::Claim { contest: Some(_), .. }) => {
                    true
                }
                (Condition::RegionExceeds { .. }, Step::Claim { after, .. }) => {
                    replay(bench.state()).size(after) == 61
                }
                _ => false,
            };
            assert!(fits, "{condition:?} stopped at {step:?}");
        }
    }
    assert!(stopped > 20, "{stopped} stops");
}

#[test]
fn a_moved_slider_leaves_the_cursor_at_the_same_hypothesis() {
    let mut bench = bench();
    let trace_before = trace(&bench);
    for wanted in [
        block(&trace_before, grows),
        block(&trace_before, |topic| matches!(topic, Topic::Slice(_))),
        trace_before.blocks().filter(|block| matches!(block.topic, Topic::Hypothesis(_))).nth(1).unwrap(),
    ] {
        bench.apply(Command::SetParameter(Parameter::CylinderWidth, Setting::Value(4.0), None));
        let before = trace(&bench);
        let start = block(&before, |topic| topic == wanted.topic).steps;
        debug(&mut bench, DebugCommand::Seek(start.start + start.len() / 2));
        let object = bench.state().debugger.names.final_number(wanted.topic.region());
        let labels = bench.state().newest.as_ref().unwrap().analysis.finals.clone();
        bench.apply(Command::SetParameter(Parameter::CylinderWidth, Setting::Value(3.5), None));
        let state = bench.state();
        assert!(state.debugger.stopped().is_some(), "still stopped");
        let now = trace(&bench).block_at(at(&bench) - 1).unwrap();
        assert_eq!(std::mem::discriminant(&now.topic), std::mem::discriminant(&wanted.topic));
        let heirs = anchor::heirs(&labels.labels, &state.newest.as_ref().unwrap().analysis.finals.labels);
        assert_eq!(state.debugger.names.final_number(now.topic.region()), heirs[usize::from(object)]);
    }
}

#[test]
fn two_results_are_compared_by_the_first_decision_that_differs() {
    let mut bench = bench();
    debug(&mut bench, DebugCommand::Compare);
    assert_eq!(bench.state().debugger.difference, Some(Difference::NotRecorded), "nothing is pinned");
    bench.apply(Command::Pin(true));
    debug(&mut bench, DebugCommand::Compare);
    assert_eq!(bench.state().debugger.difference, Some(Difference::None));
    let before = trace(&bench);
    bench.apply(Command::SetParameter(Parameter::SliceWidth, Setting::Value(1.0), None));
    debug(&mut bench, DebugCommand::Compare);
    let Some(Difference::At(n)) = bench.state().debugger.difference else { panic!("they differ") };
    assert_eq!(at(&bench), n + 1);
    let after = trace(&bench);
    assert!(before.steps_in(0..n).eq(after.steps_in(0..n)), "the same up to there");
    assert_ne!(before.step(n), after.step(n));
}

#[test]
fn another_picture_closes_the_trace() {
    let mut bench = bench();
    debug(&mut bench, DebugCommand::Seek(10));
    bench.apply(Command::Open(Origin::File(TINY.into())));
    assert!(bench.state().debugger.stopped().is_none(), "the cursor is at the end of the new one");
    assert_eq!(bench.state().debugger.generation, bench.state().generation);
}

#[test]
fn what_is_watched_is_what_stands_at_the_cursor() {
    let mut bench = bench();
    let picture = Arc::clone(bench.state().picture.as_ref().unwrap());
    let first = block(&trace(&bench), grows);
    debug(&mut bench, DebugCommand::Seek(first.steps.end));
    let cursor = replay(bench.state());
    let pixel = cursor.labels().as_slice().iter().position(|&label| label == first.topic.region()).unwrap();
    let names = &bench.state().debugger.names;
    let watched = watch(cursor, names, &picture.photo.image.pixels, Some(pixel as u32));
    assert_eq!(watched.stage, Some(Stage::Linear));
    assert_eq!(watched.regions, [1, 1]);
    let current = watched.current.unwrap();
    assert_eq!((current.region, current.pixels), (first.topic.region(), cursor.size(first.topic.region())));
    let of_pixel = watched.pixel.unwrap();
    assert_eq!(of_pixel.region, first.topic.region());
    let [distance, radius] = of_pixel.distances[0].axis;
    assert!(distance <= radius, "a claimed pixel lies inside the cylinder");
    assert_eq!(watch(cursor, names, &picture.photo.image.pixels, Some(u32::MAX)).pixel, None);
}

#[test]
fn the_growth_at_the_cursor_is_the_regions_and_its_surroundings_are_not() {
    let mut bench = bench();
    let first = block(&trace(&bench), grows);
    debug(&mut bench, DebugCommand::Seek(first.steps.end));
    let cursor = replay(bench.state());
    let found = growth(cursor).unwrap();
    assert_eq!(found.claimed.len(), cursor.size(found.region) as usize, "all of it has grown here");
    assert!(found.around.iter().all(|&pixel| cursor.labels()[pixel as usize] != found.region));
    debug(&mut bench, DebugCommand::Seek(1));
    assert_eq!(growth(replay(bench.state())), None);
}

#[test]
fn a_pixel_is_told_newest_first_with_its_hypothesis_and_its_region() {
    let bench = bench();
    let (state, trace) = (bench.state(), trace(&bench));
    let shown = state.newest.as_ref().unwrap();
    let names = &state.debugger.names;
    let pixel = shown.labels().as_slice().iter().position(|&label| label == 1).unwrap() as u32;
    let told = why(shown, &trace, names, Some(pixel), None);
    let (about, history) = told.pixel.unwrap();
    assert_eq!(about, pixel);
    assert_eq!(history.first().map(|account| account.stage), Some(Stage::Split), "{history:?}");
    assert_eq!(history.last().map(|account| account.stage), Some(Stage::Masks), "{history:?}");
    assert!(history.is_sorted_by(|a, b| a.step >= b.step));
    let (birth, story) = told.hypothesis.unwrap();
    assert_eq!(names.final_number(birth), 1);
    assert!(matches!(trace.event(story[0].step), Some(Event::HypothesisChosen(_))));
    let (number, made_of) = told.region.unwrap();
    assert_eq!((number, made_of[0].depth), (1, 0));
    assert!(made_of.iter().all(|account| trace.event(account.step).is_some()));

    let of_hypothesis = why(shown, &trace, names, None, Some(birth));
    assert_eq!((of_hypothesis.pixel, of_hypothesis.hypothesis.unwrap().1), (None, story));
    assert_eq!(why(shown, &trace, names, Some(u32::MAX), Some(u16::MAX)), Why::default());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_step_leads_out_of_the_trace(place in 0f64..1.0, grain in 0usize..6, forward in any::<bool>()) {
        let bench = bench();
        let trace = trace(&bench);
        let from = (place * trace.len() as f64) as usize;
        let direction = if forward { Direction::Forward } else { Direction::Back };
        let to = stepped(&trace, from, Grain::ALL[grain], direction);
        prop_assert!(to <= trace.len());
        let moved = if forward { to > from } else { to < from || from == 0 };
        prop_assert!(moved, "{} leads to {}", from, to);
    }
}
