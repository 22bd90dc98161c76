//! Tests of canceling an analysis: by its button, by Escape and by its command, and of what the window says and offers afterwards.

use crate::window::{
    Fixture, SIZE, Window, apply, choose, click, named, press, says, sigma, state, tiny_window, with_gpu,
    with_state,
};
use dichroscope::app::{Edit, Job, State};
use dichroscope::gui::Pane;
use dichroscope::params::{Parameter, Setting};
use dichroscope::view::Layer;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use std::time::{Duration, Instant};

const CANCEL: &str = "Cancel the analysis";
const ANALYZE: &str = "Analyze now";
const OTHER_PARAMETERS: &str = "of other parameters";
const NOT_ANALYZED: &str = "Not analyzed";

/// An analysis that began a second ago.
fn long_analysis() -> Option<Job> {
    let since = Instant::now().checked_sub(Duration::from_secs(1))?;
    Some(Job { since, stage: Some(dichroscope::analysis::Stage::Planar), files: None })
}

/// The small photograph with its result, while an analysis with another camera noise has been under way for a second.
fn analyzing() -> State {
    let mut state = state(&tiny_window()).clone();
    state.document.params.camera_noise = Setting::Value(4.0);
    state.generation += 1;
    state.jobs.analysis = long_analysis();
    state
}

/// The small photograph before its first result.
fn opening() -> State {
    let mut state = analyzing();
    (state.newest, state.debugger) = (None, dichroscope::app::Debugger::default());
    state
}

fn offers(window: &Window, name: &str) -> bool {
    window.query_by_role_and_label(Role::Button, name).is_some()
}

#[test]
fn a_canceled_analysis_leaves_the_result_before_which_says_so_and_can_be_run_again() {
    let Some(mut window) = with_state(SIZE, analyzing()) else { return };
    window.run_steps(3);
    assert!(says(&window, "analyzing: planar") && !offers(&window, ANALYZE));
    let before = state(&window).newest.clone().unwrap();
    click(&mut window, Role::Button, CANCEL);
    assert!(state(&window).jobs.analysis.is_none() && state(&window).lacks_result());
    assert_eq!(state(&window).newest.as_ref().unwrap().generation, before.generation);
    assert_eq!(sigma(&window), Setting::Value(4.0), "the parameters stay");
    assert!(!offers(&window, CANCEL));
    let marked = window.get_all_by_label_contains(OTHER_PARAMETERS).count();
    assert!(marked >= 5, "the panels, the status line and the place of the verdict: {marked}");
    click(&mut window, Role::Button, ANALYZE);
    assert!(state(&window).is_current() && !says(&window, OTHER_PARAMETERS) && !offers(&window, ANALYZE));
    assert_eq!(state(&window).newest.as_ref().unwrap().params.camera_noise, Setting::Value(4.0));
}

#[test]
fn escape_cancels_the_analysis_before_it_takes_the_selection_away() {
    let Some(mut window) = with_state(SIZE, analyzing()) else { return };
    apply(&mut window, Edit::Select(Some(crate::window::region(1))));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Questionmark);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(state(&window).jobs.analysis.is_some(), "it closes the list of keys first");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(state(&window).jobs.analysis.is_none() && state(&window).selected_region().is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(state(&window).selected_region().is_none());
    press(&mut window, Modifiers::NONE, Key::F5);
    assert!(state(&window).is_current());
}

#[test]
fn the_menu_cancels_the_analysis_and_runs_it_again() {
    let Some(mut window) = with_state(SIZE, analyzing()) else { return };
    window.run_steps(2);
    choose(&mut window, "Analyze", CANCEL);
    assert!(state(&window).jobs.analysis.is_none() && state(&window).lacks_result());
    choose(&mut window, "Analyze", ANALYZE);
    assert!(state(&window).is_current());
}

#[test]
fn a_photograph_that_was_never_analyzed_is_shown_and_the_panels_say_so() {
    let Some(mut window) = with_state(SIZE, opening()) else { return };
    window.run_steps(3);
    click(&mut window, Role::Button, CANCEL);
    assert!(state(&window).picture.is_some() && state(&window).newest.is_none());
    assert!(says(&window, "This photograph is not analyzed."));
    for pane in [Pane::Regions, Pane::Selection, Pane::Plane, Pane::Timeline, Pane::Inspector, Pane::Compare]
    {
        window.state_mut().show_alone(Some(pane));
        window.run_steps(3);
        assert!(says(&window, NOT_ANALYZED), "{}", pane.title());
    }
    window.state_mut().show_alone(None);
    window.run_steps(2);
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(5.0), None));
    assert!(state(&window).is_current() && !says(&window, NOT_ANALYZED), "a change analyzes as usual");
}

#[test]
fn a_layer_of_a_result_says_that_there_is_none() {
    let Some(mut window) = with_state(SIZE, opening()) else { return };
    window.run_steps(3);
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::NONE, Key::Num8);
    assert_eq!(state(&window).view.image.layer, Layer::Body);
    assert!(says(&window, NOT_ANALYZED));
}

#[test]
fn a_window_with_a_result_offers_nothing_to_cancel_and_nothing_to_run_again() {
    let Some(mut window) = with_gpu(SIZE, Fixture::Tiny) else { return };
    window.run_steps(2);
    assert!(!offers(&window, CANCEL) && !offers(&window, ANALYZE));
    choose(&mut window, "Analyze", ANALYZE);
    assert!(state(&window).is_current(), "it may be run again all the same");
    assert!(named(&window, Role::Image, "Picture").rect().width() > 100.0);
}

/// The small photograph with its result, whose decisions have been recorded for a second.
fn recording() -> State {
    let mut state = state(&tiny_window()).clone();
    state.debugger = dichroscope::app::Debugger::default();
    state.jobs.recording = long_analysis();
    state
}

#[test]
fn a_recording_shows_its_stage_and_can_be_canceled_and_the_result_stays() {
    let Some(mut window) = with_state(SIZE, recording()) else { return };
    window.run_steps(3);
    assert!(says(&window, "recording: planar") && !offers(&window, CANCEL));
    click(&mut window, Role::Button, "Cancel the recording");
    assert!(state(&window).jobs.recording.is_none() && state(&window).is_current());
    assert!(
        says(&window, "are not recorded") && !says(&window, OTHER_PARAMETERS) && !offers(&window, ANALYZE)
    );
    press(&mut window, Modifiers::NONE, Key::F5);
    assert!(state(&window).debugger.replay.is_some() && !says(&window, "are not recorded"));
}

#[test]
fn escape_and_the_menu_cancel_a_recording() {
    let Some(mut window) = with_state(SIZE, recording()) else { return };
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(state(&window).jobs.recording.is_none() && says(&window, "are not recorded"));
    let Some(mut window) = with_state(SIZE, recording()) else { return };
    window.run_steps(2);
    choose(&mut window, "Analyze", "Cancel the recording");
    assert!(state(&window).jobs.recording.is_none() && state(&window).is_current());
}

#[test]
fn the_export_dialog_offers_to_analyze_what_has_no_result_by_its_button_and_by_f5() {
    for by_key in [false, true] {
        let Some(mut window) = with_state(SIZE, analyzing()) else { return };
        window.run_steps(2);
        press(&mut window, Modifiers::NONE, Key::Escape);
        assert!(state(&window).lacks_result());
        press(&mut window, Modifiers::COMMAND, Key::E);
        assert!(says(&window, "present parameters have no result"));
        if by_key {
            press(&mut window, Modifiers::NONE, Key::F5);
        } else {
            let button = window.get_all_by_role_and_label(Role::Button, ANALYZE).last().unwrap();
            button.click();
            window.run_steps(3);
        }
        assert!(state(&window).is_current() && !says(&window, "present parameters have no result"));
        assert!(says(&window, "Path"), "the dialog stays");
    }
}

#[test]
fn a_panel_whose_contents_need_more_room_says_inside_of_it_that_its_result_is_older() {
    let Some(mut window) = with_state(SIZE, analyzing()) else { return };
    for pane in [Pane::Regions, Pane::Inspector, Pane::Plane] {
        window.state_mut().show_alone(Some(pane));
        let size = egui::vec2(320.0, 90.0);
        window.set_size(size);
        window.run_steps(3);
        let note = window.get_by_label_contains("the result before").rect();
        assert!(egui::Rect::from_min_size(egui::Pos2::ZERO, size).contains_rect(note), "{pane:?}: {note}");
    }
}
