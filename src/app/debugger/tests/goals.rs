//! Runs to goals and to breakpoints.

use super::*;
use crate::raster::PixelIndex;
use crate::trace::{Event, Kind, Step, WindowClassified};

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
