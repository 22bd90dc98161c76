//! Tests of the question before unsaved work is closed.

use crate::window::{
    Window, answer, apply, click, open_sample, press, region, says, state, tiny_window, undo,
};
use dichroscope::app::{Edit, JobCommand, Switching};
use dichroscope::params::{Parameter, Setting};
use dichroscope::truth::sample;
use egui::accesskit::Role;
use egui::{Key, Modifiers, ViewportCommand, ViewportEvent, ViewportId};

const QUESTION: &str = "Close without saving?";

/// Closes the window, as the button of the desktop does. Returns whether the window stays open.
pub fn close_window(window: &mut Window) -> bool {
    let root = window.input_mut().viewports.entry(ViewportId::ROOT).or_default();
    root.events.push(ViewportEvent::Close);
    window.step();
    let commands = &window.output().viewport_output[&ViewportId::ROOT].commands;
    let is_held = commands.contains(&ViewportCommand::CancelClose);
    window.input_mut().viewports.entry(ViewportId::ROOT).or_default().events.clear();
    window.run_steps(3);
    is_held
}

fn change(window: &mut Window) {
    apply(window, Edit::SetParameter(Parameter::CylinderWidth, Setting::Value(5.0), None));
}

#[test]
fn a_window_without_changes_closes_at_once() {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    assert!(!close_window(&mut window) && !says(&window, QUESTION), "looking is no work");
    change(&mut window);
    undo(&mut window);
    assert!(!close_window(&mut window), "what is taken back is no work");
}

#[test]
fn unsaved_work_is_asked_about_until_it_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    change(&mut window);
    assert!(close_window(&mut window) && says(&window, QUESTION) && says(&window, "camera8.png"));
    press(&mut window, Modifiers::NONE, Key::D);
    assert!(state(&window).view.debug.open, "no key reaches the panels");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!says(&window, QUESTION));
    assert!(close_window(&mut window), "Escape confirms nothing");
    click(&mut window, Role::Button, "Save workspace");
    assert!(!says(&window, QUESTION));
    answer(&mut window, &folder.path().join("work.dichroscope"));
    assert!(state(&window).unsaved_names().is_empty(), "{:?}", state(&window).notices);
    assert!(!close_window(&mut window));
    change(&mut window);
    apply(&mut window, Edit::SetParameter(Parameter::SliceWidth, Setting::Value(5.0), None));
    assert!(close_window(&mut window));
    apply(&mut window, JobCommand::OpenWorkspace(folder.path().join("work.dichroscope")));
    assert!(state(&window).unsaved_names().is_empty(), "as saved");
}

#[test]
fn a_window_that_is_to_close_without_saving_closes() {
    let mut window = tiny_window();
    change(&mut window);
    open_sample(&mut window, sample::NAME);
    assert!(close_window(&mut window) && says(&window, "camera8.png"), "a photograph that is not shown");
    click(&mut window, Role::Button, "Close without saving");
    assert!(!close_window(&mut window));
}

#[test]
fn a_photograph_with_unsaved_work_is_closed_when_that_is_confirmed() {
    let mut window = tiny_window();
    open_sample(&mut window, sample::NAME);
    change(&mut window);
    for (button, others) in [("Cancel", 1), ("Close without saving", 0)] {
        press(&mut window, Modifiers::COMMAND, Key::W);
        assert!(says(&window, QUESTION) && says(&window, sample::NAME));
        click(&mut window, Role::Button, button);
        assert!(!says(&window, QUESTION));
        assert_eq!(state(&window).others.len(), others, "{button}");
    }
}

/// Asks to close the photograph that is shown, and answers that its workspace is to be saved: the dialog for its path opens.
fn save_and_close(window: &mut Window) {
    press(window, Modifiers::COMMAND, Key::W);
    click(window, Role::Button, "Save workspace");
    window.run_steps(8);
}

#[test]
fn a_photograph_is_closed_once_its_workspace_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    open_sample(&mut window, sample::NAME);
    change(&mut window);
    save_and_close(&mut window);
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(8);
    press(&mut window, Modifiers::COMMAND, Key::S);
    answer(&mut window, &folder.path().join("work.dichroscope"));
    window.run_steps(8);
    assert!(!state(&window).is_unsaved(), "{:?}", state(&window).notices);
    assert_eq!(state(&window).others.len(), 1, "a dialog that was canceled closes nothing, also later");
    apply(&mut window, Edit::SetParameter(Parameter::SliceWidth, Setting::Value(5.0), None));
    save_and_close(&mut window);
    assert_eq!(state(&window).others.len(), 0, "{:?}", state(&window).notices);
}

#[test]
fn the_photograph_that_was_asked_about_is_closed_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    open_sample(&mut window, sample::NAME);
    change(&mut window);
    let shown = |window: &Window| state(window).picture.as_ref().map(|picture| picture.origin.name());
    let ask_and_switch = |window: &mut Window| {
        save_and_close(window);
        apply(window, JobCommand::Switch(Switching::Next));
    };
    ask_and_switch(&mut window);
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(8);
    assert_eq!(shown(&window).as_deref(), Some("camera8.png"), "the photograph without changes stays");
    assert_eq!(
        state(&window).others.len(),
        1,
        "the photograph with changes, whose workspace was not saved, stays"
    );
    apply(&mut window, JobCommand::Switch(Switching::Next));
    ask_and_switch(&mut window);
    answer(&mut window, &folder.path().join("work.dichroscope"));
    window.run_steps(8);
    assert_eq!(state(&window).others.len(), 1, "the workspace of another photograph was saved");
}
