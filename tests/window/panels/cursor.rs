//! Tests of panels at the debugger's cursor: image, plane and tables show the state at the cursor.

use crate::window::{
    Fixture, Window, apply, at, choose, click, inside, item, named, says, shown, state, tiny_window,
    with_software_driver, zoom_in,
};
use dichroscope::app::{Command, DebugCommand};
use dichroscope::gui::Pane;
use dichroscope::raster::HypothesisId;
use dichroscope::trace::{Block, Event, Stage, Topic, Trace};
use dichroscope::view::{ArrangementKind, Item};
use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::SnapshotOptions;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

fn trace(window: &Window) -> Arc<Trace> {
    Arc::clone(state(window).debugger.trace().expect("decisions are recorded"))
}

fn seek(window: &mut Window, n: usize) {
    apply(window, Command::Debug(DebugCommand::Seek(n)));
}

/// The first block with a topic that `wanted` accepts.
fn block(window: &Window, wanted: impl Fn(Topic) -> bool) -> Block {
    trace(window).blocks().find(|block| wanted(block.topic)).expect("there is one")
}

/// Number of steps after which the first highlight candidate has passed.
fn accepted(window: &Window) -> usize {
    let trace = trace(window);
    let passed = trace
        .events()
        .find(|(_, event)| matches!(event, Event::CandidateTested(test) if test.verdict.accepted()));
    passed.expect("the scene has a highlight").0 + 1
}

#[test]
fn the_instant_at_the_cursor_is_not_wiped_and_a_wipe_turns_back_to_the_result() {
    let wipe = ArrangementKind::Wipe.name();
    let mut window = tiny_window();
    choose(&mut window, "View", wipe);
    window.get_by_role_and_label(Role::ComboBox, "Second layer");
    seek(&mut window, 12_000);
    assert!(says(&window, "at step"));
    assert!(window.query_by_role_and_label(Role::ComboBox, "Second layer").is_none(), "nothing is wiped");
    click(&mut window, Role::Button, wipe);
    assert!(!says(&window, "at step") && !state(&window).view.debug.follow);
    window.get_by_role_and_label(Role::ComboBox, "Second layer");

    click(&mut window, Role::Button, "Follow");
    click(&mut window, Role::Button, ArrangementKind::Single.name());
    assert!(says(&window, "at step"), "one layer is what the instant is");
    choose(&mut window, "View", wipe);
    window.run_steps(2);
    assert!(!says(&window, "at step") && !state(&window).view.debug.follow);
}

#[test]
fn the_picture_tells_where_the_cursor_stands_and_can_turn_back_to_the_result() {
    let mut window = tiny_window();
    assert!(!says(&window, "at step") && !says(&window, "Follow"));
    let block = block(&window, |topic| topic == Topic::Hypothesis(HypothesisId::from_index(0)));
    seek(&mut window, block.steps.start + 200);
    assert!(says(&window, "linear \u{b7} hypothesis 1"));
    click(&mut window, Role::Button, "Follow");
    assert!(!state(&window).view.debug.follow && !says(&window, "linear \u{b7} hypothesis 1"));
    click(&mut window, Role::Button, "Follow");
    assert!(says(&window, "linear \u{b7} hypothesis 1"));
    click(&mut window, Role::ComboBox, "Layer");
    click(&mut window, Role::Button, "Body");
    assert!(!state(&window).view.debug.follow, "a layer of the result was asked for");
    let end = trace(&window).len();
    seek(&mut window, end);
    assert!(!says(&window, "Follow"), "at the end there is nothing to follow");
}

#[test]
fn a_pixel_tells_who_had_it_then() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = inside(&window, 1);
    let place = at(&window, x as f32 + 0.5, y as f32 + 0.5);
    let readout = |window: &mut Window| -> String {
        window.hover_at(place);
        window.run_steps(3);
        let found = named(window, Role::Label, &format!("x {x}, y {y}"));
        crate::window::words(&found).unwrap()
    };
    assert!(readout(&mut window).contains("m_b"));
    let merge = trace(&window).steps_of(Stage::Merge);
    seek(&mut window, merge.start);
    let then = readout(&mut window);
    assert!(!then.contains("m_b") && then.matches(',').count() == 5, "a class, no region yet: {then}");
    let linear = trace(&window).steps_of(Stage::Linear);
    seek(&mut window, linear.end);
    let pixel = y * shown(&window).labels().width() + x;
    let owner = shown(&window).linear_labels()[pixel];
    let then = readout(&mut window);
    assert!(then.contains(&format!(",  {owner}")), "{then}");
}

#[test]
fn the_table_lists_windows_then_hypotheses() {
    let mut window = tiny_window();
    let merge = trace(&window).steps_of(Stage::Merge);
    seek(&mut window, merge.start + 20);
    assert!(says(&window, "areas so far") && says(&window, "not looked at yet"));
    assert!(says(&window, "not estimated yet"));
    let block = block(&window, |topic| topic == Topic::Hypothesis(HypothesisId::from_index(1)));
    seek(&mut window, block.steps.end - 1);
    assert!(says(&window, "color of hypothesis 2") && says(&window, "growing now"));
    assert!(!says(&window, "color of hypothesis 3") && !says(&window, "color of region 1"));
    click(&mut window, Role::Label, "color of hypothesis 1");
    let names = Arc::clone(&state(&window).debugger.names);
    assert_eq!(state(&window).debugger.chosen, HypothesisId::from_label(1));
    assert_eq!(item(&window), names.region_of(HypothesisId::from_index(0)).map(Item::Region));
    for heading in ["pixels", "direction", "radius", "status", "result", "#"] {
        click(&mut window, Role::Button, heading);
    }
    assert!(says(&window, "color of hypothesis 1"));
}

#[test]
fn a_skewed_t_test_is_drawn_with_its_checks() {
    let mut window = tiny_window();
    let n = accepted(&window);
    seek(&mut window, n);
    assert!(says(&window, "Skewed-T test of hypothesis"));
    assert!(says(&window, "passed: gap") && says(&window, "passed: meets at"));
    assert!(says(&window, "brightest") || says(&window, "matte line"));
    let failed = trace(&window).events().find_map(|(n, event)| match event {
        Event::CandidateTested(test) if !test.verdict.lines_meet => Some(n + 1),
        _ => None,
    });
    if let Some(n) = failed {
        seek(&mut window, n);
        assert!(says(&window, "failed: gap"));
    }
}

#[test]
fn the_color_space_shows_what_the_step_looks_at() {
    let Some(mut window) = with_software_driver(vec2(700.0, 500.0), Fixture::Tiny) else { return };
    window.state_mut().show_alone(Some(Pane::Colors));
    window.run_steps(3);
    let n = accepted(&window);
    seek(&mut window, n);
    for name in ["candidate", "upper 50 %", "gap ", "passed: gap"] {
        assert!(says(&window, name), "{name}");
    }
    let slice = block(&window, |topic| matches!(topic, Topic::Slice(_)));
    seek(&mut window, slice.steps.end - 1);
    assert!(says(&window, "slice") && says(&window, "illuminant so far"));
    let hypothesis = block(&window, |topic| matches!(topic, Topic::Hypothesis(_)));
    seek(&mut window, hypothesis.steps.end - 1);
    assert!(says(&window, "cylinder") && !says(&window, "illuminant"));
}

#[test]
fn what_an_instant_looks_like() {
    let Some(mut window) = with_software_driver(vec2(420.0, 300.0), Fixture::Tiny) else { return };
    window.state_mut().show_alone(Some(Pane::Image));
    window.run_steps(3);
    let block = block(&window, |topic| topic == Topic::Hypothesis(HypothesisId::from_index(1)));
    seek(&mut window, block.steps.start + block.steps.len() * 3 / 5);
    window.run_steps(6);
    let options = SnapshotOptions::new().output_path("panels/snapshots").max_failed_pixels(60);
    window.snapshot_options("cursor-hypothesis", &options);
}
