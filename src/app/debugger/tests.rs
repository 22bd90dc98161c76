//! The trace of a result, its cursor, and what becomes of both with another result. The submodules test the moves of the cursor, its goals,
//! and the values at its place.

mod goals;
mod moves;
mod values;

use super::*;
use crate::app::{Application, Command, Edit, Executor, JobCommand, State, ViewCommand};
use crate::params::{Parameter, Setting};
use crate::raster::{HypothesisId, RegionId};
use crate::trace::Topic;
use crate::view::{Item, Origin};

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

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
    let bytes = std::fs::read(TINY).unwrap().into();
    application.apply(JobCommand::Open(Origin::Bytes { name: "another.png".to_owned(), bytes }));
    assert!(application.state().debugger.stopped().is_none(), "the cursor is at the end of the new one");
    assert_eq!(application.state().debugger.generation, application.state().generation);
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
