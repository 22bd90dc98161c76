//! Tests of the command that cancels an analysis.

use super::{reduce, reduce_report};
use crate::analysis::Stage;
use crate::app::report::Report;
use crate::app::{
    Application, Command, DebugCommand, DebugSettings, Edit, Effect, Executor, Job, JobCommand, Preview,
    State, Switching,
};
use crate::params::{Parameter, Setting};
use crate::view::{Origin, ResultSnapshot};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

/// An application with workers, and the bell that they ring.
fn application() -> (Application, Receiver<()>) {
    let (ring, woken) = mpsc::channel();
    (Application::new(Executor::Threads, move || _ = ring.send(())).unwrap(), woken)
}

/// Polls whenever the workers say that there is something, until `done`.
fn wait(application: &mut Application, woken: &Receiver<()>, done: impl Fn(&State) -> bool) {
    while !done(application.state()) {
        woken.recv_timeout(Duration::from_mins(2)).expect("the workers have something to say");
        application.poll();
    }
}

fn set_noise(value: f64) -> Edit {
    Edit::SetParameter(Parameter::CameraNoise, Setting::Value(value), None)
}

/// A result of the present request, some of whose stages are still to be computed.
fn partial(state: &State) -> Arc<ResultSnapshot> {
    let before = state.newest.as_ref().unwrap();
    let (picture, analysis) = (Arc::clone(&before.picture), before.analysis.clone());
    let whole = ResultSnapshot::new(picture, state.document.params, analysis, before.region_colors.clone());
    Arc::new(ResultSnapshot { generation: state.generation, stale_from: Some(Stage::Clipping), ..whole })
}

#[test]
fn the_last_complete_result_stays_after_a_cancellation_and_the_next_analysis_replaces_it() {
    let (mut application, woken) = application();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    wait(&mut application, &woken, State::is_current);
    let complete = Arc::clone(application.state().newest.as_ref().unwrap());
    application.apply(set_noise(4.0));
    let late = partial(application.state());
    application.take_report(Report::Analyzed(Arc::clone(&late)));
    assert!(application.state().newest.as_ref().is_some_and(|newest| Arc::ptr_eq(newest, &late)));
    application.apply(JobCommand::CancelAnalysis);
    let is_complete = |state: &State| Arc::ptr_eq(state.newest.as_ref().unwrap(), &complete);
    let state = application.state();
    assert!(is_complete(state) && state.lacks_result() && state.shows_other_parameters());
    assert!(state.jobs.analysis.is_none() && !state.is_current());
    let blocks = complete.analysis.working.blocks;
    application.take_report(Report::Preview(Preview { shown: Arc::clone(&late), blocks }));
    application.take_report(Report::Analyzed(late));
    assert!(application.state().preview.is_none() && is_complete(application.state()), "too late");

    application.apply(JobCommand::Analyze);
    wait(&mut application, &woken, State::is_current);
    let state = application.state();
    assert_eq!(state.newest.as_ref().unwrap().params.camera_noise, Setting::Value(4.0));
    assert!(!state.lacks_result() && !state.lacks_trace());
    wait(&mut application, &woken, |state| state.debugger.generation == state.generation);
}

#[test]
fn a_photograph_without_a_result_stays_open_after_a_cancellation_and_a_change_analyzes_it() {
    let (mut application, woken) = application();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    wait(&mut application, &woken, |state| state.picture.is_some());
    application.apply(JobCommand::CancelAnalysis);
    let state = application.state();
    assert!(state.picture.is_some() && state.newest.is_none() && state.lacks_result() && state.lacks_trace());
    assert!(!state.shows_other_parameters(), "nothing is shown of a result");
    assert_eq!(state.lacks(crate::view::Layer::Body), Some(crate::app::NOT_ANALYZED));
    application.apply(set_noise(3.0));
    wait(&mut application, &woken, State::is_current);
    assert!(application.state().document.selection.item.is_some(), "the largest region is selected");
}

#[test]
fn the_preview_of_a_photograph_without_a_result_stays_after_a_cancellation() {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    let mut state = application.state().clone();
    let complete = state.newest.take().unwrap();
    (state.generation, state.jobs.analysis) = (state.generation + 1, Some(Job::now()));
    let result_of = |generation| {
        let (picture, analysis) = (Arc::clone(&complete.picture), complete.analysis.clone());
        let shown = ResultSnapshot::new(picture, complete.params, analysis, complete.region_colors.clone());
        Arc::new(ResultSnapshot { generation, ..shown })
    };
    let shown = result_of(state.generation);
    let blocks = shown.analysis.working.blocks;
    reduce_report(&mut state, Report::Preview(Preview { shown, blocks }));
    reduce(&mut state, JobCommand::CancelAnalysis);
    assert!(state.preview.is_some() && state.lacks_result() && state.shown_preview().is_some());
    reduce(&mut state, JobCommand::Analyze);
    state.jobs.analysis = Some(Job::now());
    assert!(!state.lacks_result());
    let whole = result_of(state.generation);
    reduce_report(&mut state, Report::Analyzed(whole));
    assert!(state.preview.is_none() && state.is_current());
}

#[test]
fn a_canceled_analysis_of_parameters_that_have_a_result_leaves_that_result_in_force() {
    let (mut application, woken) = application();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    wait(&mut application, &woken, State::is_current);
    let sample = Origin::Sample(crate::truth::sample::NAME.into());
    application.apply(JobCommand::Open(sample));
    wait(&mut application, &woken, |state| state.others.len() == 1 && state.is_current());
    application.apply(JobCommand::Switch(Switching::Next));
    assert!(application.state().jobs.analysis.is_some(), "the decisions are recorded anew");
    application.apply(JobCommand::CancelAnalysis);
    let state = application.state();
    assert!(state.is_current() && !state.lacks_result() && state.lacks_trace());
}

#[test]
fn a_canceled_recording_is_told_to_be_missing_and_can_be_begun_again() {
    let (mut application, woken) = application();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    wait(&mut application, &woken, |state| state.debugger.replay.is_some());
    let record = |open: bool| DebugCommand::Settings(DebugSettings { open, ..DebugSettings::default() });
    application.apply(Command::Debug(record(false)));
    application.apply(Command::Debug(record(true)));
    application.apply(JobCommand::CancelAnalysis);
    let state = application.state();
    assert!(state.is_current() && state.lacks_trace() && state.jobs.analysis.is_none());
    application.apply(Command::Debug(record(false)));
    application.apply(Command::Debug(record(true)));
    wait(&mut application, &woken, |state| state.debugger.replay.is_some());
    assert!(application.state().jobs.analysis.is_none() && !application.state().lacks_trace());
}

#[test]
fn the_recording_of_a_result_that_is_there_can_be_canceled_and_the_result_stays() {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    let settings = DebugSettings { open: false, ..DebugSettings::default() };
    application.apply(Command::Debug(DebugCommand::Settings(settings)));
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    let generation = application.state().generation;
    let begins = |generation| Report::Recording { generation, stage: Stage::Planar };
    application.take_report(begins(generation + 1));
    assert!(application.state().jobs.recording.is_none(), "no such result");
    application.take_report(begins(generation));
    let job = application.state().jobs.recording.unwrap();
    assert!(job.stage == Some(Stage::Planar) && !application.state().lacks_trace());
    application.apply(JobCommand::CancelAnalysis);
    application.take_report(begins(generation));
    let state = application.state();
    assert!(state.jobs.recording.is_none() && state.is_current() && !state.lacks_result());
    assert!(state.lacks_trace() && state.newest.as_ref().unwrap().generation == generation);
    application.apply(JobCommand::Analyze);
    assert!(application.state().is_current() && !application.state().lacks_trace());
}

#[test]
fn a_change_and_the_end_of_recording_end_what_is_told_of_it() {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::File(TINY.into())));
    let begin = |application: &mut Application| {
        let generation = application.state().generation;
        application.take_report(Report::Recording { generation, stage: Stage::Planar });
        assert!(application.state().jobs.recording.is_some());
    };
    begin(&mut application);
    application.apply(set_noise(4.0));
    assert!(application.state().jobs.recording.is_none() && application.state().debugger.replay.is_some());
    begin(&mut application);
    let settings = DebugSettings { open: false, ..DebugSettings::default() };
    application.apply(Command::Debug(DebugCommand::Settings(settings)));
    assert!(application.state().jobs.recording.is_none() && application.state().is_current());
}

#[test]
fn a_canceled_export_is_told_to_be_canceled_until_it_has_ended() {
    let mut state = State::default();
    reduce(&mut state, JobCommand::CancelExport);
    assert!(!state.jobs.cancels_export, "nothing is written");
    state.jobs.export = Some(Job::now());
    assert_eq!(reduce(&mut state, JobCommand::CancelExport), [Effect::StopWriting]);
    assert!(state.jobs.cancels_export && state.jobs.export.is_some());
    reduce_report(&mut state, Report::Exported { outcome: Ok("stopped".into()), workspace: None });
    assert!(!state.jobs.cancels_export && state.jobs.export.is_none());
}

#[test]
fn without_an_analysis_there_is_nothing_to_cancel() {
    let mut state = State::default();
    assert!(reduce(&mut state, JobCommand::CancelAnalysis).is_empty());
    assert!(reduce(&mut state, JobCommand::Analyze).is_empty(), "nothing is open");
    state.jobs.analysis = Some(Job::now());
    assert_eq!(reduce(&mut state, JobCommand::CancelAnalysis), [Effect::CancelAnalysis]);
}
