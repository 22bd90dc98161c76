//! Tests of the history panel: every step in words, and jumps by click and key.

use crate::window::{apply, click, named, press, region, says, sigma, state, tiny_window, undo};
use dichroscope::app::{Edit, Gesture};
use dichroscope::gui::Pane;
use dichroscope::params::{Parameter, Setting};
use egui::accesskit::Role;
use egui::{Key, Modifiers};

#[test]
fn every_step_is_listed_and_a_click_or_an_arrow_goes_there() {
    let mut window = tiny_window();
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(3.0), None));
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(4.0), None));
    apply(&mut window, Edit::Select(Some(region(2))));
    window.state_mut().show_alone(Some(Pane::History));
    window.run_steps(3);
    assert!(says(&window, "camera8.png opened") && says(&window, "region 2 selected"));
    let steps = state(&window).history.entries(&state(&window).document).0.len();
    let first = (0..steps).find(|step| says(&window, &format!("Step {step}: camera_noise: auto"))).unwrap();
    let name = format!("Step {first}: camera_noise: auto \u{2192} 3");
    click(&mut window, Role::ListBoxOption, &name);
    assert_eq!(sigma(&window), Setting::Value(3.0));
    assert!(state(&window).history.can_redo(), "later steps stay");
    assert!(state(&window).is_current(), "the result follows");
    named(&window, Role::ListBoxOption, &name).focus();
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::ArrowDown);
    assert_eq!(sigma(&window), Setting::Value(4.0), "an arrow goes on");
    apply(&mut window, Edit::GoTo(steps - 1));
    assert_eq!(state(&window).document.selection.item, Some(region(2)));
    assert!(!state(&window).history.can_redo());
    apply(&mut window, Edit::GoTo(10_000));
    undo(&mut window);
    assert_ne!(state(&window).document.selection.item, Some(region(2)));
    apply(&mut window, Edit::GoTo(0));
    assert!(!state(&window).history.can_undo());
}

#[test]
fn the_last_value_of_a_gesture_is_listed_where_the_gesture_ends_in_the_same_frame() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::History));
    let gesture = Gesture::Parameter(Parameter::CameraNoise);
    let to = |value| Edit::SetParameter(Parameter::CameraNoise, Setting::Value(value), Some(gesture));
    apply(&mut window, to(3.0));
    assert!(says(&window, "camera_noise: auto \u{2192} 3"));
    window.state_mut().apply(to(4.0));
    apply(&mut window, Edit::EndGesture(gesture));
    assert!(says(&window, "camera_noise: auto \u{2192} 4"));
}
