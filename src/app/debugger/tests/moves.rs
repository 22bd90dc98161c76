//! Steps, playing, and the command into.

use super::*;
use crate::app::debugger::cursor::place_after_unit;
use crate::trace::{Event, Stage, Step};
use crate::view::rings;
use proptest::prelude::*;

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
