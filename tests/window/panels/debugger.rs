//! Tests of the debugger: playing, seeking, stepping, breakpoints, and the texts about the step at the cursor.

use crate::window::{
    Window, apply, at, choose, click, drag, item, named, notice, press, region, says, state, tap,
    tiny_window, with_gpu, words, zoom_in,
};
use dichroscope::app::{
    Breakpoint, Command, Condition, DebugCommand, DebugSettings, Direction, Edit, StepUnit, ViewCommand,
};
use dichroscope::gui::Pane;
use dichroscope::raster::HypothesisId;
use dichroscope::trace::{Kind, Replay, Step, Subject, Topic, Trace};
use dichroscope::view::{Item, watch};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, pos2, vec2};
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

fn replay(window: &Window) -> &Replay {
    state(window).debugger.replay.as_ref().expect("decisions are recorded")
}

pub fn trace(window: &Window) -> Arc<Trace> {
    Arc::clone(replay(window).trace())
}

pub fn cursor(window: &Window) -> usize {
    replay(window).at()
}

pub fn seek(window: &mut Window, n: usize) {
    apply(window, Command::Debug(DebugCommand::Seek(n)));
}

pub fn settings(window: &mut Window, change: impl FnOnce(&mut DebugSettings)) {
    let mut settings = state(window).view.debug.clone();
    change(&mut settings);
    apply(window, Command::Debug(DebugCommand::Settings(settings)));
}

/// The first hypothesis on the timeline that is a region of the result.
fn hypothesis(window: &Window) -> (HypothesisId, std::ops::Range<usize>) {
    let names = &state(window).debugger.names;
    let found = trace(window).blocks().find_map(|block| match block.topic {
        Topic::Hypothesis(id) => names.region_of(id).map(|_| (id, block.steps)),
        _ => None,
    });
    found.expect("there is a hypothesis")
}

pub fn plain(window: &mut Window, key: Key) {
    press(window, Modifiers::NONE, key);
}

#[test]
fn keys_go_where_the_trace_says() {
    let mut window = tiny_window();
    let trace = trace(&window);
    assert_eq!(cursor(&window), trace.len(), "at first the result is shown");
    assert!(says(&window, "result"));
    plain(&mut window, Key::Home);
    assert_eq!(cursor(&window), 0);
    assert!(says(&window, "nothing is decided yet"));
    plain(&mut window, Key::ArrowRight);
    assert_eq!(cursor(&window), 1);
    for end in trace.stages().map(|(_, steps)| steps.end) {
        let reached = cursor(&window);
        if end > reached {
            press(&mut window, Modifiers::COMMAND, Key::ArrowRight);
            assert_eq!(cursor(&window), end);
        }
    }
    let (_, steps) = hypothesis(&window);
    seek(&mut window, steps.start + 2);
    press(&mut window, Modifiers::SHIFT, Key::ArrowRight);
    assert_eq!(cursor(&window), steps.end);
    press(&mut window, Modifiers::SHIFT, Key::ArrowLeft);
    assert_eq!(cursor(&window), steps.start);
    plain(&mut window, Key::Period);
    plain(&mut window, Key::Period);
    assert_eq!(cursor(&window), steps.start + 2);
    plain(&mut window, Key::Comma);
    press(&mut window, Modifiers::ALT, Key::ArrowLeft);
    assert_eq!(cursor(&window), steps.start);
    plain(&mut window, Key::End);
    assert_eq!(cursor(&window), trace.len());
}

#[test]
fn arrows_step_the_decisions_also_after_a_click_into_the_picture() {
    let mut window = tiny_window();
    plain(&mut window, Key::Home);
    let view = window.get_by_role_and_label(Role::Image, "Picture").rect();
    drag(&mut window, &[view.center(), view.center() + vec2(9.0, 0.0)], Modifiers::NONE);
    let center = |window: &Window| state(window).view.image.center_px;
    let before = center(&window);
    plain(&mut window, Key::ArrowRight);
    assert_eq!((cursor(&window), center(&window)), (1, before), "a step, and the picture stays");
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::ArrowRight);
    assert_eq!(cursor(&window), 1);
    assert_ne!(center(&window), before, "with Ctrl and Shift the picture moves");
    named(&window, Role::Slider, "camera noise").focus();
    window.run_steps(1);
    plain(&mut window, Key::ArrowRight);
    assert_eq!(cursor(&window), 1, "the arrow key belongs to the slider");
    let track = named(&window, Role::Slider, "Timeline").rect();
    tap(&mut window, track.center());
    let before = cursor(&window);
    plain(&mut window, Key::ArrowRight);
    assert!(cursor(&window) > before, "the timeline has the focus");
}

#[test]
fn a_tap_on_space_plays_and_space_held_pans() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    plain(&mut window, Key::Home);
    window.key_press(Key::Space);
    window.run_steps(3);
    assert_eq!(state(&window).debugger.playing, Some(Direction::Forward));
    assert!(cursor(&window) > 0 && says(&window, "playing"));
    plain(&mut window, Key::Space);
    assert_eq!(state(&window).debugger.playing, None);
    let rested = cursor(&window);
    window.run_steps(3);
    assert_eq!(cursor(&window), rested, "nothing moves by itself");
    press(&mut window, Modifiers::SHIFT, Key::Space);
    assert_eq!(state(&window).debugger.playing, Some(Direction::Back));
    window.run_steps(4);
    assert!(cursor(&window) < rested);
    click(&mut window, Role::Button, "Pause");
    assert_eq!(state(&window).debugger.playing, None);

    let from = at(&window, 60.0, 60.0);
    window.key_down(Key::Space);
    window.run_steps(1);
    drag(&mut window, &[from, from + vec2(20.0, 0.0), from + vec2(40.0, 0.0)], Modifiers::NONE);
    window.key_up(Key::Space);
    window.run_steps(2);
    assert_eq!(state(&window).debugger.playing, None, "Space was held to pan");
}

#[test]
fn playing_goes_by_the_clock_and_turns_or_ends_at_the_end() {
    let mut window = tiny_window();
    settings(&mut window, |debug| (debug.unit, debug.per_second) = (StepUnit::Step, 100.0));
    let len = trace(&window).len();
    seek(&mut window, len - 60);
    let play = Command::Debug(DebugCommand::Play(Some(Direction::Forward)));
    window.state_mut().apply(play.clone());
    window.state_mut().apply(Command::Debug(DebugCommand::Tick(0.2)));
    assert_eq!(cursor(&window), len - 40);
    window.run_steps(8);
    assert_eq!((cursor(&window), state(&window).debugger.playing), (len, None));
    click(&mut window, Role::Button, "Loop");
    seek(&mut window, len - 5);
    apply(&mut window, play);
    assert!(cursor(&window) < len - 5 && state(&window).debugger.playing.is_some());
}

#[test]
fn the_track_is_dragged_clicked_and_zoomed() {
    let mut window = tiny_window();
    let track = named(&window, Role::Slider, "Timeline").rect();
    let spot = |share: f32, height: f32| {
        pos2(track.left() + share * track.width(), track.top() + height * track.height())
    };
    let path: Vec<Pos2> = [0.95, 0.6, 0.3, 0.1].map(|share| spot(share, 0.1)).to_vec();
    drag(&mut window, &path, Modifiers::NONE);
    let low = cursor(&window);
    assert!(low > 0 && low < trace(&window).len() / 2, "{low}");
    drag(
        &mut window,
        &[spot(0.1, 0.1), spot(0.3, 0.1), pos2(track.left() - 30.0, track.top())],
        Modifiers::NONE,
    );
    assert_eq!(cursor(&window), 0, "to the left of the line is the beginning");

    // A click on a block selects the block's region and moves the cursor to the block's first decision.
    let (id, steps) = hypothesis(&window);
    let region = state(&window).debugger.names.region_of(id).map(Item::Region);
    let axis = dichroscope::view::TimelineAxis::of(&trace(&window));
    let share = axis.place_of(usize::midpoint(steps.start, steps.end)) as f32;
    let block = spot(share, 0.8);
    window.hover_at(block);
    window.run_steps(6);
    assert_eq!(state(&window).hover, region, "to hover a block is to hover its region");
    assert!(says(&window, &format!("hypothesis {id}")), "and it says what it is");
    tap(&mut window, block);
    assert_eq!((item(&window), cursor(&window)), (region, steps.start + 1));

    // At a large zoom, a click moves the cursor to the exact step.
    let place = spot(share, 0.1);
    let wanted = axis.taken_at(f64::from((place.x - track.left()) / track.width()));
    window.hover_at(place);
    for _ in 0..60 {
        let (unit, delta) = (egui::MouseWheelUnit::Point, vec2(0.0, 60.0));
        let (phase, modifiers) = (egui::TouchPhase::Move, Modifiers::NONE);
        window.event(Event::MouseWheel {
            unit,
            delta,
            phase,
            source: egui::MouseWheelSource::Unknown,
            modifiers,
        });
        window.run_steps(1);
    }
    tap(&mut window, place);
    assert!(cursor(&window).abs_diff(wanted) <= 1, "{} for {wanted}", cursor(&window));
}

#[test]
fn a_number_is_typed_and_a_step_is_set_by_those_who_do_not_see() {
    let mut window = tiny_window();
    click(&mut window, Role::SpinButton, "Step");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(Event::Text("1 234".to_owned()));
    window.run_steps(1);
    plain(&mut window, Key::Enter);
    assert_eq!(cursor(&window), 1234);
    named(&window, Role::Slider, "Timeline").set_value_accesskit(77.0);
    window.run_steps(3);
    assert_eq!(cursor(&window), 77);
}

#[test]
fn it_runs_to_kinds_and_to_changes_of_what_is_selected() {
    let mut window = tiny_window();
    plain(&mut window, Key::J);
    assert!(crate::window::notice(&window).contains("select a region"), "nothing is selected");
    plain(&mut window, Key::Home);
    click(&mut window, Role::Button, "Run to");
    click(&mut window, Role::Button, "Linear hypotheses");
    click(&mut window, Role::Button, "hypothesis");
    let last = replay(&window).last().map(|step| step.kind());
    assert_eq!(last, Some(Kind::Hypothesis));
    let (_, steps) = hypothesis(&window);
    let claimed = trace(&window).steps_in(steps).find_map(|(n, step)| match step {
        Step::Claim { pixel, .. } => Some((n, pixel)),
        _ => None,
    });
    let (n, pixel) = claimed.expect("a hypothesis claims");
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    seek(&mut window, n);
    plain(&mut window, Key::J);
    assert_eq!(cursor(&window), n + 1);
    press(&mut window, Modifiers::SHIFT, Key::J);
    assert!(cursor(&window) <= n, "its window was classified before");
}

#[test]
fn a_breakpoint_without_arguments_takes_one_line() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Breakpoints));
    window.set_size(egui::vec2(320.0, 400.0));
    window.run_steps(2);
    for _ in 0..2 {
        click(&mut window, Role::Button, "Add breakpoint");
    }
    let [first, second] = [1, 2].map(|number| {
        named(&window, Role::CheckBox, &format!("Breakpoint {number} enabled")).rect().center().y
    });
    assert!(second - first < 28.0, "the second is {} points below the first", second - first);
}

#[test]
fn a_breakpoint_made_with_the_controls_stops_playing() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Breakpoints));
    window.run_steps(2);
    click(&mut window, Role::Button, "Add breakpoint");
    click(&mut window, Role::ComboBox, "Condition of breakpoint 1");
    click(&mut window, Role::Button, "region exceeds");
    let made = state(&window).view.debug.breakpoints.clone();
    let condition = Condition::RegionExceeds { hypothesis: None, pixels: 1000 };
    assert_eq!(made, [Breakpoint { enabled: true, condition }]);
    window.state_mut().show_alone(None);
    settings(&mut window, |debug| (debug.unit, debug.per_second) = (StepUnit::Hypothesis, 60.0));
    plain(&mut window, Key::Home);
    plain(&mut window, Key::Space);
    window.run_steps(4);
    let debugger = &state(&window).debugger;
    assert_eq!((debugger.playing, debugger.stopped_by), (None, Some(0)));
    let Some(Step::Claim { after: Some(after), .. }) = replay(&window).last() else {
        panic!("a claim stops it")
    };
    assert_eq!(replay(&window).size(after), 1001);
    assert!(says(&window, "breakpoint 1"), "the timeline says which one");
    window.state_mut().show_alone(Some(Pane::Breakpoints));
    window.run_steps(2);
    assert!(says(&window, "stopped here"));
    click(&mut window, Role::CheckBox, "Breakpoint 1 enabled");
    assert!(!state(&window).view.debug.breakpoints[0].enabled);
    click(&mut window, Role::Button, "Remove breakpoint 1");
    assert!(state(&window).view.debug.breakpoints.is_empty());
}

#[test]
fn a_breakpoint_on_the_selected_pixel_is_found_by_its_key() {
    let mut window = tiny_window();
    let (_, steps) = hypothesis(&window);
    let pixel = trace(&window).steps_in(steps).find_map(|(_, step)| step.pixel()).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    window.state_mut().show_alone(Some(Pane::Breakpoints));
    window.run_steps(2);
    click(&mut window, Role::Button, "Add breakpoint");
    let condition = Condition::PixelChangesOwner(pixel);
    assert_eq!(state(&window).view.debug.breakpoints[0].condition, condition);
    apply(&mut window, Edit::Select(None));
    click(&mut window, Role::Button, "Breakpoint 1");
    assert_eq!(item(&window), Some(Item::Pixel(pixel)), "a click selects what it is about");
    window.state_mut().show_alone(None);
    plain(&mut window, Key::Home);
    plain(&mut window, Key::N);
    assert!(matches!(replay(&window).last(), Some(Step::Claim { pixel: found, .. }) if found == pixel));
}

#[test]
fn a_key_sets_a_breakpoint_for_what_is_selected_and_takes_it_away() {
    let mut window = tiny_window();
    plain(&mut window, Key::F9);
    assert!(notice(&window).starts_with("a breakpoint for what"), "{}", notice(&window));
    let (_, steps) = hypothesis(&window);
    let pixel = trace(&window).steps_in(steps).find_map(|(_, step)| step.pixel()).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    plain(&mut window, Key::F9);
    assert_eq!(state(&window).view.debug.breakpoints[0].condition, Condition::PixelChangesOwner(pixel));
    assert!(notice(&window).starts_with("breakpoint 1 stops where pixel"), "{}", notice(&window));
    plain(&mut window, Key::Home);
    plain(&mut window, Key::N);
    assert!(matches!(replay(&window).last(), Some(Step::Claim { pixel: found, .. }) if found == pixel));
    plain(&mut window, Key::F9);
    assert!(state(&window).view.debug.breakpoints.is_empty() && notice(&window).ends_with("was taken away"));
    apply(&mut window, Edit::Select(Some(region(1))));
    plain(&mut window, Key::F9);
    let condition = state(&window).view.debug.breakpoints[0].condition;
    assert!(matches!(condition, Condition::RegionExceeds { hypothesis: Some(_), .. }), "{condition:?}");
}

#[test]
fn the_watch_shows_the_replays_values() {
    let mut window = tiny_window();
    let (id, steps) = hypothesis(&window);
    let pixel = trace(&window).steps_in(steps.clone()).find_map(|(_, step)| step.pixel()).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    seek(&mut window, steps.end);
    window.state_mut().show_alone(Some(Pane::Watch));
    window.run_steps(2);
    let state = state(&window);
    let colors = &state.picture.as_ref().unwrap().photo.image.pixels;
    let watch = watch(replay(&window), &state.debugger.names, colors, Some(pixel));
    let current = watch.current.unwrap();
    assert_eq!(current.hypothesis, id);
    let distance = watch.pixel.unwrap().distances.remove(0);
    for shown in [
        format!("{} of {}", watch.regions[0], watch.regions[1]),
        grouped(watch.unassigned),
        grouped(current.pixels),
        format!("{:.1}", current.line.mean.x),
        format!("{:.3}", current.line.direction.y),
        format!("{:.2}", current.radius),
    ] {
        assert!(says(&window, &shown), "{shown}");
    }
    window.state_mut().show_alone(Some(Pane::Inspector));
    window.run_steps(2);
    let shown = format!("{:.1} / {:.1}", distance.axis[0], distance.axis[1]);
    assert!(says(&window, &shown), "{shown}");
}

fn grouped(number: u32) -> String {
    let digits = number.to_string();
    let parts: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|part| std::str::from_utf8(part).unwrap()).collect();
    parts.join("\u{2009}")
}

#[test]
fn recording_is_switched_off_and_on() {
    let mut window = tiny_window();
    click(&mut window, Role::Button, "Stop recording");
    assert!(!state(&window).view.debug.open && state(&window).debugger.replay.is_none());
    assert!(says(&window, "Nothing is recorded"));
    click(&mut window, Role::Button, "Record decisions");
    assert_eq!(cursor(&window), trace(&window).len());
    plain(&mut window, Key::D);
    assert!(!state(&window).view.debug.open);
    choose(&mut window, "Decisions", "Record");
    assert!(state(&window).view.debug.open && state(&window).debugger.replay.is_some());
    assert!(says(&crate::window::window(), "The timeline appears when a photograph is open."));
}

#[test]
fn keys_of_the_color_space_stay_its_own() {
    let Some(mut window) = with_gpu(vec2(1200.0, 800.0), crate::window::Fixture::Tiny) else { return };
    seek(&mut window, 500);
    let view = window.get_by_role_and_label(Role::Canvas, "Color space view").rect();
    window.hover_at(view.center());
    window.run_steps(3);
    plain(&mut window, Key::D);
    plain(&mut window, Key::Home);
    assert!(state(&window).view.debug.open);
    assert_eq!(cursor(&window), 500);
    plain(&mut window, Key::End);
    assert_eq!(cursor(&window), trace(&window).len());
}

#[test]
fn a_saved_arrangement_without_a_panel_gains_the_panel() {
    let mut window = tiny_window();
    let first = state(&window).view.layout.clone();
    let without = first.replace("\"Timeline\"", "\"Image\"");
    apply(&mut window, ViewCommand::Layout(without.clone()));
    window.run_steps(3);
    let layout = &state(&window).view.layout;
    assert!(layout.contains("\"Timeline\"") && *layout != without, "{layout}");
    assert!(says(&window, "Timeline") && state(&window).notices.is_empty());
}

#[test]
fn a_narrow_window_clips_nothing() {
    let mut window = tiny_window();
    for (width, height) in [(900.0, 600.0), (640.0, 900.0)] {
        window.set_size(vec2(width, height));
        window.run_steps(4);
        for name in ["To the beginning", "Play", "To the result", "Loop", "Stop recording", "Run to"] {
            let rect = window.get_by_role_and_label(Role::Button, name).rect();
            assert!(rect.left() >= 0.0 && rect.right() <= width, "{name} at {rect} of {width}");
            assert!(rect.bottom() <= height, "{name} at {rect}");
        }
        let track = named(&window, Role::Slider, "Timeline").rect();
        assert!(track.height() > 20.0 && track.bottom() <= height, "{track} at {width}");
    }
}

#[test]
fn a_step_about_a_region_or_a_pixel_of_a_region_shows_the_plane_of_the_region() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Plane));
    let trace = trace(&window);
    let is_about_region = |step: &Step| match step {
        Step::Event(event) => {
            event.subjects().into_iter().flatten().any(|subject| matches!(subject, Subject::Region(_)))
        }
        _ => false,
    };
    let event = trace.steps().find(|(_, step)| is_about_region(step)).expect("a region is split").0;
    let label =
        trace.steps().find(|(_, step)| matches!(step, Step::Label { .. })).expect("pixels have kinds").0;
    for step in [event, label] {
        seek(&mut window, step + 1);
        assert!(state(&window).debugger.focus().is_some());
        let planes = window.query_all_by_role(Role::Canvas).filter_map(|node| words(&node));
        let planes: Vec<String> = planes.collect();
        assert!(planes.iter().any(|name| name.starts_with("Growth of hypothesis")), "{step}: {planes:?}");
    }
}
