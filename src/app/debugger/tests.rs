use super::cursor::place_after_unit;
use super::*;
use crate::app::{Application, Command, Edit, Executor, JobCommand, State, ViewCommand};
use crate::params::{Parameter, Setting};
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::trace::{Event, Kind, Stage, Step, Topic, WindowClassified};
use crate::view::Origin;
use crate::view::{Item, Why, growth, rings, watch, why};
use proptest::prelude::*;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

/// A pixel outside of every picture.
const OUTSIDE: PixelIndex = PixelIndex::new(u32::MAX);

/// An application that does all work inline, with the tiny scene open and its decisions recorded.
fn application() -> Application {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    application
}

fn debug(application: &mut Application, command: DebugCommand) {
    application.apply(Command::Debug(command));
}

fn settings(application: &mut Application, change: impl FnOnce(&mut DebugSettings)) {
    let mut settings = application.state().view.debug.clone();
    change(&mut settings);
    debug(application, DebugCommand::Settings(settings));
}

fn replay(state: &State) -> &Replay {
    state.debugger.replay.as_ref().unwrap()
}

fn at(application: &Application) -> usize {
    replay(application.state()).at()
}

fn trace(application: &Application) -> Arc<Trace> {
    Arc::clone(application.state().debugger.trace().unwrap())
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
    let application = application();
    let state = application.state();
    assert_eq!(at(&application), trace(&application).len());
    assert!(state.debugger.stopped().is_none(), "the panels show the result");
    assert!(Arc::ptr_eq(state.newest.as_ref().unwrap().trace().unwrap(), &trace(&application)));
    let finals = &state.newest.as_ref().unwrap().analysis.finals.labels;
    for (pixel, &label) in replay(state).labels().as_slice().iter().enumerate() {
        let region = HypothesisId::from_label(label).and_then(|id| state.debugger.names.region_of(id));
        assert_eq!(RegionId::label(region), finals[pixel]);
    }
    for (index, &color) in state.newest.as_ref().unwrap().region_colors.iter().enumerate() {
        let region = RegionId::from_index(index);
        let hypothesis = state.debugger.names.hypotheses_of(region).next().unwrap();
        assert_eq!(state.debugger.names.color(hypothesis), color);
    }
}

#[test]
fn a_closed_debugger_records_nothing_and_an_opened_one_records_the_result() {
    let mut application = application();
    settings(&mut application, |settings| settings.open = false);
    assert!(application.state().debugger.replay.is_none());
    application.apply(Edit::SetParameter(Parameter::CylinderWidth, Setting::Value(3.0), None));
    assert!(application.state().newest.as_ref().unwrap().trace().is_none());
    let generation = application.state().generation;
    settings(&mut application, |settings| settings.open = true);
    assert_eq!(application.state().generation, generation, "nothing was asked anew");
    assert_eq!(at(&application), trace(&application).len());
}

#[test]
fn each_grain_goes_from_edge_to_edge_and_back() {
    let mut application = application();
    let trace = trace(&application);
    debug(&mut application, DebugCommand::Seek(0));
    for (stage, steps) in trace.stages() {
        debug(&mut application, DebugCommand::Step(StepUnit::Stage, Direction::Forward));
        assert_eq!(at(&application), steps.end, "{stage:?}");
    }
    for (stage, steps) in trace.stages().collect::<Vec<_>>().into_iter().rev() {
        debug(&mut application, DebugCommand::Step(StepUnit::Stage, Direction::Back));
        assert_eq!(at(&application), steps.start, "{stage:?}");
    }
    let first = block(&trace, grows);
    debug(&mut application, DebugCommand::Seek(first.steps.start));
    debug(&mut application, DebugCommand::Step(StepUnit::Hypothesis, Direction::Forward));
    assert_eq!(at(&application), first.steps.end);
    debug(&mut application, DebugCommand::Step(StepUnit::Hypothesis, Direction::Back));
    assert_eq!(at(&application), first.steps.start);
    debug(&mut application, DebugCommand::Step(StepUnit::Event, Direction::Forward));
    assert!(matches!(replay(application.state()).last(), Some(Step::Event(Event::HypothesisChosen(_)))));
    debug(&mut application, DebugCommand::Step(StepUnit::Step, Direction::Back));
    assert_eq!(at(&application), first.steps.start);
}

#[test]
fn every_grain_ends_at_both_ends() {
    let mut application = application();
    let len = trace(&application).len();
    for unit in StepUnit::ALL {
        let mut turns = 0;
        debug(&mut application, DebugCommand::Seek(0));
        while at(&application) < len {
            let before = at(&application);
            debug(&mut application, DebugCommand::Step(unit, Direction::Forward));
            assert!(at(&application) > before, "{unit:?} stands still at {before}");
            turns += 1;
        }
        while at(&application) > 0 {
            let before = at(&application);
            debug(&mut application, DebugCommand::Step(unit, Direction::Back));
            assert!(at(&application) < before, "{unit:?} stands still at {before}");
        }
        assert!(turns >= 7, "{unit:?}");
    }
}

#[test]
fn rings_are_what_one_more_step_from_the_region_reaches() {
    let mut application = application();
    let trace = trace(&application);
    for first in trace.blocks().filter(|block| matches!(block.topic, Topic::Hypothesis(_) | Topic::Slice(_)))
    {
        let hypothesis = first.topic.hypothesis();
        let mut cursor = replay(application.state()).clone();
        let ends = rings(&mut cursor, &first);
        assert_eq!(cursor.at(), at(&application), "the cursor comes back");
        assert_eq!(ends.last(), Some(&first.steps.end));
        let mut from = first.steps.start;
        for &end in &ends {
            cursor.seek(from);
            let labels = cursor.labels().clone();
            let seeds = matches!(trace.event(from), Some(Event::SeedsPlaced(_)));
            for (n, step) in trace.steps_in(from..end) {
                let Step::Claim { pixel, after, .. } = step else { continue };
                if after != Some(hypothesis) || seeds {
                    continue;
                }
                let mut reached = false;
                labels.for_each_neighbor(pixel.index(), |near| reached |= labels[near] == hypothesis.get());
                assert!(reached, "step {n} is not of the ring that ends at {end}");
            }
            from = end;
        }
    }
    debug(&mut application, DebugCommand::Seek(block(&trace, grows).steps.start + 1));
    debug(&mut application, DebugCommand::Step(StepUnit::Ring, Direction::Forward));
    let ring = at(&application);
    debug(&mut application, DebugCommand::Step(StepUnit::Ring, Direction::Forward));
    debug(&mut application, DebugCommand::Step(StepUnit::Ring, Direction::Back));
    assert_eq!(at(&application), ring);
}

#[test]
fn playing_goes_on_with_time_stops_at_the_end_and_may_begin_anew() {
    let mut application = application();
    let len = trace(&application).len();
    settings(&mut application, |settings| (settings.unit, settings.per_second) = (StepUnit::Step, 100.0));
    debug(&mut application, DebugCommand::Play(Some(Direction::Forward)));
    assert_eq!(at(&application), 0, "from the end it plays from the beginning");
    debug(&mut application, DebugCommand::Tick(0.015));
    debug(&mut application, DebugCommand::Tick(0.015));
    assert_eq!(at(&application), 3, "fractions add up");
    debug(&mut application, DebugCommand::Play(None));
    debug(&mut application, DebugCommand::Tick(0.1));
    assert_eq!(at(&application), 3);
    settings(&mut application, |settings| (settings.unit, settings.per_second) = (StepUnit::Stage, 100.0));
    debug(&mut application, DebugCommand::Play(Some(Direction::Forward)));
    debug(&mut application, DebugCommand::Tick(0.2));
    assert_eq!((at(&application), application.state().debugger.playing), (len, None));
    settings(&mut application, |settings| settings.looped = true);
    debug(&mut application, DebugCommand::Play(Some(Direction::Back)));
    debug(&mut application, DebugCommand::Tick(0.2));
    assert_eq!(
        (at(&application), application.state().debugger.playing),
        (len, Some(Direction::Back)),
        "over and over"
    );
}

#[test]
fn the_command_into_plays_one_hypothesis() {
    let mut application = application();
    let first = block(&trace(&application), grows);
    let linear = trace(&application).steps_of(Stage::Linear);
    debug(&mut application, DebugCommand::Seek(linear.start));
    debug(&mut application, DebugCommand::Into);
    assert_eq!(at(&application), first.steps.start + 1);
    for _ in 0..1000 {
        debug(&mut application, DebugCommand::Tick(0.2));
    }
    assert_eq!((at(&application), application.state().debugger.playing), (first.steps.end, None));
}

#[test]
fn goals_are_found_in_both_directions() {
    let mut application = application();
    let trace = trace(&application);
    let run = |application: &mut Application, goal, direction| {
        debug(application, DebugCommand::RunTo(goal, direction));
        at(application)
    };
    let slices: Vec<usize> =
        trace.events().filter(|(_, event)| event.kind() == Kind::Slice).map(|(n, _)| n + 1).collect();
    debug(&mut application, DebugCommand::Seek(0));
    for &slice in &slices {
        assert_eq!(run(&mut application, Goal::Kind(Kind::Slice), Direction::Forward), slice);
    }
    for &slice in slices.iter().rev().skip(1) {
        assert_eq!(run(&mut application, Goal::Kind(Kind::Slice), Direction::Back), slice);
    }
    assert_eq!(
        run(&mut application, Goal::Kind(Kind::Slice), Direction::Back),
        0,
        "none before: the beginning"
    );

    let labels = &application.state().newest.as_ref().unwrap().analysis.finals.labels;
    let pixel = labels.as_slice().iter().position(|&label| label != 0).unwrap();
    let pixel = PixelIndex::from_index(pixel);
    let mut owners = Vec::new();
    loop {
        let n = run(&mut application, Goal::Pixel(pixel), Direction::Forward);
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
    let mut application = application();
    let trace = trace(&application);
    let first = block(&trace, grows);
    let hypothesis = first.topic.hypothesis();
    let condition = Condition::RegionExceeds { hypothesis: Some(hypothesis), pixels: 40 };
    settings(&mut application, |settings| {
        settings.breakpoints = vec![
            Breakpoint { enabled: false, condition: Condition::HypothesisRejected },
            Breakpoint { enabled: true, condition },
        ];
        (settings.unit, settings.per_second) = (StepUnit::Stage, 100.0);
    });
    debug(&mut application, DebugCommand::Play(Some(Direction::Forward)));
    debug(&mut application, DebugCommand::Tick(0.2));
    let debugger = &application.state().debugger;
    assert_eq!((debugger.playing, debugger.stopped_by), (None, Some(1)));
    assert_eq!(replay(application.state()).size(hypothesis), 41, "right after it has outgrown it");
    let stopped = at(&application);
    for (place, arrives) in [(stopped - 5, stopped - 5), (first.steps.end, stopped)] {
        debug(&mut application, DebugCommand::Seek(0));
        debug(&mut application, DebugCommand::RunTo(Goal::StepCount(place), Direction::Forward));
        assert_eq!(at(&application), arrives, "a breakpoint on the way stops it, one beyond does not");
    }
    debug(&mut application, DebugCommand::Seek(first.steps.end));
    debug(&mut application, DebugCommand::RunTo(Goal::Breakpoint, Direction::Back));
    assert_eq!(at(&application), stopped);
    debug(&mut application, DebugCommand::Seek(stopped - 1));
    debug(&mut application, DebugCommand::RunTo(Goal::Breakpoint, Direction::Forward));
    assert_eq!(at(&application), stopped);
}

#[test]
fn each_condition_stops_where_it_holds() {
    let mut application = application();
    let trace = trace(&application);
    let all_classes = [SavedClass::Point, SavedClass::Line, SavedClass::Plane, SavedClass::Volume];
    let mut conditions: Vec<Condition> = all_classes.map(Condition::ClassIs).to_vec();
    conditions.extend(CandidateCheck::ALL.map(Condition::CandidateFails));
    conditions.extend([
        Condition::PixelChangesOwner(PixelIndex::new(700)),
        Condition::HypothesisRejected,
        Condition::Conflict(None, None),
        Condition::RegionExceeds { hypothesis: None, pixels: 60 },
    ]);
    let mut stopped = 0;
    for condition in conditions {
        settings(&mut application, |s| s.breakpoints = vec![Breakpoint { enabled: true, condition }]);
        debug(&mut application, DebugCommand::Seek(0));
        loop {
            debug(&mut application, DebugCommand::RunTo(Goal::Breakpoint, Direction::Forward));
            if application.state().debugger.stopped_by.is_none() {
                assert_eq!(at(&application), trace.len());
                break;
            }
            stopped += 1;
            let step = replay(application.state()).last().unwrap();
            let fits = match (condition, step) {
                (
                    Condition::ClassIs(class),
                    Step::Event(Event::WindowClassified(WindowClassified { class: found, .. })),
                ) => *found == Some(class.into()),
                (Condition::CandidateFails(check), Step::Event(Event::CandidateTested(test))) => {
                    let verdict = test.verdict;
                    !match check {
                        CandidateCheck::Any => verdict.accepted(),
                        CandidateCheck::LinesMeet => verdict.lines_meet,
                        CandidateCheck::UpperHalf => verdict.upper_half || verdict.by_gershon,
                        CandidateCheck::NotParallel => verdict.not_parallel || !verdict.by_gershon,
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
                (Condition::RegionExceeds { .. }, Step::Claim { after: Some(after), .. }) => {
                    replay(application.state()).size(after) == 61
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
    let mut application = application();
    let trace_before = trace(&application);
    for wanted in [
        block(&trace_before, grows),
        block(&trace_before, |topic| matches!(topic, Topic::Slice(_))),
        trace_before.blocks().filter(|block| matches!(block.topic, Topic::Hypothesis(_))).nth(1).unwrap(),
    ] {
        application.apply(Edit::SetParameter(Parameter::CylinderWidth, Setting::Value(4.0), None));
        let before = trace(&application);
        let start = block(&before, |topic| topic == wanted.topic).steps;
        debug(&mut application, DebugCommand::Seek(start.start + start.len() / 2));
        let object = application.state().debugger.names.region_of(wanted.topic.hypothesis());
        let labels = application.state().newest.as_ref().unwrap().analysis.finals.clone();
        application.apply(Edit::SetParameter(Parameter::CylinderWidth, Setting::Value(3.5), None));
        let state = application.state();
        assert!(state.debugger.stopped().is_some(), "still stopped");
        let now = trace(&application).block_at(at(&application) - 1).unwrap();
        assert_eq!(std::mem::discriminant(&now.topic), std::mem::discriminant(&wanted.topic));
        let best_overlaps =
            anchor::best_overlaps(&labels.labels, &state.newest.as_ref().unwrap().analysis.finals.labels);
        let object = usize::from(RegionId::label(object));
        assert_eq!(state.debugger.names.region_of(now.topic.hypothesis()), best_overlaps[object]);
    }
}

#[test]
fn two_results_are_compared_by_the_first_decision_that_differs() {
    let mut application = application();
    debug(&mut application, DebugCommand::Compare);
    assert_eq!(application.state().debugger.difference, Some(Difference::NotRecorded), "nothing is pinned");
    application.apply(ViewCommand::Pin(true));
    debug(&mut application, DebugCommand::Compare);
    assert_eq!(application.state().debugger.difference, Some(Difference::None));
    let before = trace(&application);
    application.apply(Edit::SetParameter(Parameter::SliceWidth, Setting::Value(1.0), None));
    debug(&mut application, DebugCommand::Compare);
    let Some(Difference::At(n)) = application.state().debugger.difference else { panic!("they differ") };
    assert_eq!(at(&application), n + 1);
    let after = trace(&application);
    assert!(before.steps_in(0..n).eq(after.steps_in(0..n)), "the same up to there");
    assert_ne!(before.step(n), after.step(n));
}

#[test]
fn another_picture_closes_the_trace() {
    let mut application = application();
    debug(&mut application, DebugCommand::Seek(10));
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    assert!(application.state().debugger.stopped().is_none(), "the cursor is at the end of the new one");
    assert_eq!(application.state().debugger.generation, application.state().generation);
}

#[test]
fn the_watch_list_holds_the_values_at_the_cursor() {
    let mut application = application();
    let picture = Arc::clone(application.state().picture.as_ref().unwrap());
    let first = block(&trace(&application), grows);
    debug(&mut application, DebugCommand::Seek(first.steps.end));
    let cursor = replay(application.state());
    let hypothesis = first.topic.hypothesis();
    let pixel = cursor.labels().as_slice().iter().position(|&label| label == hypothesis.get()).unwrap();
    let pixel = PixelIndex::from_index(pixel);
    let names = &application.state().debugger.names;
    let watched = watch(cursor, names, &picture.photo.image.pixels, Some(pixel));
    assert_eq!(watched.stage, Some(Stage::Linear));
    assert_eq!(watched.regions, [1, 1]);
    let current = watched.current.unwrap();
    assert_eq!((current.hypothesis, current.pixels), (hypothesis, cursor.size(hypothesis)));
    let of_pixel = watched.pixel.unwrap();
    assert_eq!(of_pixel.hypothesis, Some(hypothesis));
    let [distance, radius] = of_pixel.distances[0].axis;
    assert!(distance <= radius, "a claimed pixel lies inside the cylinder");
    assert_eq!(watch(cursor, names, &picture.photo.image.pixels, Some(OUTSIDE)).pixel, None);
}

#[test]
fn the_watch_list_of_an_averaged_photograph_holds_the_kind_of_the_working_pixel() {
    let mut application = application();
    application.apply(Edit::SetParameter(Parameter::Scale, Setting::Value(2.0), None));
    let state = application.state();
    let cursor = replay(state);
    let colors = &state.newest.as_ref().unwrap().analysis.working.image.pixels;
    assert_eq!(cursor.trace().pixel_blocks().side(), 2);
    let size = state.picture.as_ref().unwrap().size();
    for index in 0..size.0 * size.1 {
        let pixel = PixelIndex::from_index(index);
        let watched = watch(cursor, &state.debugger.names, colors, Some(pixel)).pixel.unwrap();
        assert_eq!(watched.kind, cursor.kind(cursor.trace().working_pixel(pixel).index()), "{index}");
    }
}

#[test]
fn pixels_of_a_growth_belong_to_the_hypothesis_and_its_surroundings_do_not() {
    let mut application = application();
    let first = block(&trace(&application), grows);
    debug(&mut application, DebugCommand::Seek(first.steps.end));
    let cursor = replay(application.state());
    let found = growth(cursor).unwrap();
    assert_eq!(found.claimed.len(), cursor.size(found.hypothesis) as usize, "all of it has grown here");
    assert!(found.around.iter().all(|&pixel| cursor.labels()[pixel as usize] != found.hypothesis.get()));
    debug(&mut application, DebugCommand::Seek(1));
    assert_eq!(growth(replay(application.state())), None);
}

#[test]
fn the_history_of_a_pixel_is_newest_first_with_hypothesis_and_region() {
    let application = application();
    let (state, trace) = (application.state(), trace(&application));
    let shown = state.newest.as_ref().unwrap();
    let names = &state.debugger.names;
    let pixel = shown.labels().as_slice().iter().position(|&label| label == 1).unwrap();
    let pixel = PixelIndex::from_index(pixel);
    let answers = why(shown, &trace, names, Some(pixel), None, None);
    let (about, history) = answers.pixel.unwrap();
    assert_eq!(about, pixel);
    assert_eq!(history.first().map(|account| account.stage), Some(Stage::Split), "{history:?}");
    assert_eq!(history.last().map(|account| account.stage), Some(Stage::Masks), "{history:?}");
    assert!(history.is_sorted_by(|a, b| a.step >= b.step));
    let (hypothesis, story) = answers.hypothesis.unwrap();
    assert_eq!(names.region_of(hypothesis), RegionId::from_label(1));
    assert!(matches!(trace.event(story[0].step.unwrap()), Some(Event::HypothesisChosen(_))));
    let (region, made_of) = answers.region.unwrap();
    assert_eq!((region.get(), made_of[0].depth), (1, 0));
    assert!(made_of.iter().all(|account| trace.event(account.step.unwrap()).is_some()));

    let of_hypothesis = why(shown, &trace, names, None, Some(hypothesis), None);
    assert_eq!((of_hypothesis.pixel, of_hypothesis.hypothesis.unwrap().1), (None, story));
    assert_eq!(
        why(shown, &trace, names, Some(OUTSIDE), Some(HypothesisId::from_index(u16::MAX.into())), None),
        Why::default()
    );
}

#[test]
fn a_selection_ends_the_question_about_a_hypothesis() {
    let mut application = application();
    let chosen = HypothesisId::from_index(0);
    for edit in [Edit::Select(Some(Item::Region(RegionId::from_index(1)))), Edit::ClearSelection] {
        debug(&mut application, DebugCommand::Choose(Some(chosen)));
        assert_eq!(application.state().debugger.chosen, Some(chosen));
        application.apply(edit);
        assert_eq!(application.state().debugger.chosen, None);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_step_leads_out_of_the_trace(place in 0f64..1.0, unit in 0usize..6, forward in any::<bool>()) {
        let application = application();
        let trace = trace(&application);
        let from = (place * trace.len() as f64) as usize;
        let direction = if forward { Direction::Forward } else { Direction::Back };
        let to = place_after_unit(&trace, from, StepUnit::ALL[unit], direction);
        prop_assert!(to <= trace.len());
        let moved = if forward { to > from } else { to < from || from == 0 };
        prop_assert!(moved, "{} leads to {}", from, to);
    }
}
