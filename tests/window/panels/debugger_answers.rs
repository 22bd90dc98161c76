//! Tests of what the window answers to a key of the debugger that finds nothing.

use crate::debugger::{cursor, plain, seek, settings, trace};
use crate::window::{Window, apply, choose, press, says, state, tiny_window};
use dichroscope::app::{Breakpoint, Command, Condition, DebugCommand, Direction, Goal};
use dichroscope::trace::Kind;
use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;

/// Lets the time pass after which an answer goes by itself.
fn wait(window: &mut Window) {
    window.input_mut().time = Some(1e4);
    window.run_steps(3);
}

#[test]
fn a_move_that_finds_nothing_says_so_in_the_timeline() {
    let mut window = tiny_window();
    let end = trace(&window).len();
    plain(&mut window, Key::ArrowRight);
    assert!(says(&window, "Nothing follows the result") && cursor(&window) == end);
    plain(&mut window, Key::Enter);
    assert!(says(&window, "No hypothesis follows: the cursor stays"));
    plain(&mut window, Key::Home);
    assert!(!says(&window, "No hypothesis follows"), "the next move has an answer of its own");
    plain(&mut window, Key::Comma);
    assert!(says(&window, "Nothing comes before the beginning"));
    plain(&mut window, Key::N);
    assert!(says(&window, "No breakpoint is set: add one in Breakpoints") && cursor(&window) == 0);
    let last = trace(&window).blocks().last().unwrap().steps.end;
    seek(&mut window, last);
    press(&mut window, Modifiers::SHIFT, Key::ArrowRight);
    assert!(says(&window, "No hypothesis follows: at the end of the stage") && cursor(&window) > last);
    let breakpoint = |enabled| Breakpoint { enabled, condition: Condition::HypothesisRejected };
    settings(&mut window, |settings| settings.breakpoints = vec![breakpoint(false)]);
    plain(&mut window, Key::N);
    assert!(says(&window, "Every breakpoint is off") && cursor(&window) < end);
    settings(&mut window, |settings| settings.breakpoints = vec![breakpoint(true)]);
    plain(&mut window, Key::N);
    assert!(says(&window, "No stop at a breakpoint follows: at the result") && cursor(&window) == end);
}

#[test]
fn an_answer_in_the_timeline_goes_by_itself_and_is_told_again_when_the_key_is_pressed_again() {
    let mut window = tiny_window();
    plain(&mut window, Key::ArrowRight);
    assert!(says(&window, "Nothing follows the result"));
    wait(&mut window);
    assert!(!says(&window, "Nothing follows the result") && says(&window, "result"));
    plain(&mut window, Key::ArrowRight);
    assert!(says(&window, "Nothing follows the result"), "the cursor stayed, and the key has its answer");
}

#[test]
fn run_to_a_goal_that_is_not_there_ends_at_the_end() {
    let mut window = tiny_window();
    plain(&mut window, Key::End);
    let last = trace(&window).blocks().last().unwrap().steps.end;
    seek(&mut window, last);
    let goal = Command::Debug(DebugCommand::RunTo(Goal::Kind(Kind::Window), Direction::Forward));
    apply(&mut window, goal);
    assert_eq!(cursor(&window), trace(&window).len());
    let missed = format!("No step \u{201c}{}\u{201d} follows: at the result", Kind::Window.name());
    assert!(says(&window, &missed), "{missed}");
}

#[test]
fn a_move_that_finds_nothing_says_so_where_the_timeline_is_not_seen() {
    let mut hidden = tiny_window();
    choose(&mut hidden, "View", "Timeline");
    press(&mut hidden, Modifiers::NONE, Key::Escape);
    let mut compact = tiny_window();
    compact.set_size(vec2(600.0, 400.0));
    for window in [&mut hidden, &mut compact] {
        window.run_steps(3);
        assert!(!says(window, "To the beginning"), "the timeline is not seen");
        plain(window, Key::ArrowRight);
        assert!(says(window, "nothing follows the result"), "{:?}", state(window).notices);
        wait(window);
        assert!(state(window).notices.is_empty(), "an answer goes by itself");
        plain(window, Key::Home);
        assert!(state(window).notices.is_empty(), "the views show where the cursor is");
        plain(window, Key::N);
        assert!(says(window, "no breakpoint is set"));
        let condition = Condition::HypothesisRejected;
        settings(window, |settings| settings.breakpoints = vec![Breakpoint { enabled: true, condition }]);
        plain(window, Key::N);
        assert!(says(window, "stopped by breakpoint 1") || says(window, "no stop at a breakpoint follows"));
    }
}

#[test]
fn an_answer_that_has_no_room_in_the_timeline_is_a_notice() {
    let mut window = tiny_window();
    window.set_size(vec2(900.0, 600.0));
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::Button, "To the beginning").is_some());
    plain(&mut window, Key::ArrowRight);
    let notices = &state(&window).notices;
    assert!(notices.iter().any(|notice| notice.text == "nothing follows the result"), "{notices:?}");
    assert!(
        !says(&window, "Nothing follows the result"),
        "the timeline, which would cut the answer, has none"
    );
}

#[test]
fn the_timeline_alone_answers_where_it_is_seen() {
    let mut window = tiny_window();
    plain(&mut window, Key::ArrowRight);
    plain(&mut window, Key::D);
    plain(&mut window, Key::D);
    assert!(state(&window).notices.is_empty(), "{:?}", state(&window).notices);
}

#[test]
fn recording_that_is_switched_off_unseen_is_told() {
    let mut window = tiny_window();
    choose(&mut window, "View", "Timeline");
    press(&mut window, Modifiers::NONE, Key::Escape);
    plain(&mut window, Key::D);
    assert!(says(&window, "decisions are recorded no more: D records them"));
    plain(&mut window, Key::ArrowRight);
    assert!(says(&window, "no decisions are recorded: D records them"));
    plain(&mut window, Key::D);
    assert!(says(&window, "decisions are recorded"));
    plain(&mut window, Key::Home);
    assert_eq!(cursor(&window), 0);
}
