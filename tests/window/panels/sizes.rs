//! No panel panics at any size in any state. A panic of a panel is caught and becomes a notice, so the tests look for notices.

use crate::window::{
    Fixture, Window, apply, named, open_sample, press, region, says, shown, state, tiny_window, window,
    with_gpu,
};
use dichroscope::app::{
    Breakpoint, CandidateCheck, Command, Condition, DebugCommand, DebugSettings, Edit, JobCommand,
    ViewCommand,
};
use dichroscope::gui::Pane;
use dichroscope::trace::{Event, Topic};
use dichroscope::view::{Arrangement, Item, Layer, Origin, Theme};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Vec2, vec2};
use egui_kittest::kittest::NodeT as _;

/// Lengths of a side, points.
const SIDES: [f32; 9] = [1.0, 7.0, 17.0, 33.0, 49.0, 96.0, 170.0, 500.0, 9000.0];

/// All sizes: each side long beside each side short.
fn sizes() -> impl Iterator<Item = Vec2> {
    SIDES.into_iter().flat_map(|width| SIDES.into_iter().map(move |height| vec2(width, height)))
}

/// Shows each panel alone, and all panels, at each size.
#[track_caller]
fn check_all_sizes(window: &mut Window, panes: &[Option<Pane>], what: &str) {
    for &pane in panes {
        window.state_mut().show_alone(pane);
        for size in sizes() {
            window.set_size(size);
            window.run_steps(1);
            let failed =
                state(window).notices.iter().find(|notice| notice.text.contains("error of the program"));
            assert!(failed.is_none(), "{what}, {pane:?} at {size}: {failed:?}");
        }
    }
}

fn all_panes() -> Vec<Option<Pane>> {
    Pane::ALL.into_iter().map(Some).chain([None]).collect()
}

/// Number of steps after which a skewed-T test has been made.
fn after_test(window: &Window) -> usize {
    let trace = state(window).debugger.trace().unwrap();
    let tests = trace.events().find(|(_, event)| matches!(event, Event::CandidateTested(_)));
    tests.expect("a candidate is tested").0 + 1
}

#[test]
fn nothing_open() {
    check_all_sizes(&mut window(), &all_panes(), "nothing open");
}

#[test]
fn a_result_with_a_selected_region() {
    let mut window = tiny_window();
    check_all_sizes(&mut window, &all_panes(), "nothing selected");
    apply(&mut window, Edit::Select(Some(region(1))));
    apply(&mut window, ViewCommand::Pin(true));
    check_all_sizes(&mut window, &all_panes(), "a region selected");
}

#[test]
fn a_pixel_and_two_layers() {
    let mut window = tiny_window();
    let pixel = shown(&window).labels().as_slice().iter().position(|&label| label == 1).unwrap();
    let pixel = dichroscope::raster::PixelIndex::from_index(pixel);
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    apply(&mut window, ViewCommand::Hover(Some(Item::Pixel(pixel))));
    apply(&mut window, ViewCommand::Theme(Theme::Light));
    for arrangement in [Arrangement::Wipe(0.3), Arrangement::SideBySide] {
        let mut image = state(&window).view.image.clone();
        (image.arrangement, image.layer, image.zoom) = (arrangement, Layer::Regions, Some(60.0));
        apply(&mut window, ViewCommand::Image(image));
        check_all_sizes(&mut window, &all_panes(), "two layers");
    }
}

#[test]
fn the_cursor_in_every_stage() {
    let mut window = tiny_window();
    let trace = state(&window).debugger.trace().unwrap().clone();
    let stages: Vec<usize> =
        trace.stages().map(|(_, steps)| usize::midpoint(steps.start, steps.end)).collect();
    let slice = trace.blocks().find(|block| matches!(block.topic, Topic::Slice(_)));
    let slice = slice.expect("the scene has a slice").steps;
    let places = stages.into_iter().chain([after_test(&window), usize::midpoint(slice.start, slice.end), 0]);
    let panes =
        [Pane::Image, Pane::Plane, Pane::Regions, Pane::Timeline, Pane::Inspector, Pane::Watch].map(Some);
    for n in places {
        apply(&mut window, Command::Debug(DebugCommand::Seek(n)));
        check_all_sizes(&mut window, &panes, &format!("after {n} steps"));
    }
    check_all_sizes(&mut window, &all_panes(), "before the first step");
}

#[test]
fn pictures_of_one_pixel_and_without_regions() {
    let mut window = window();
    for (width, height) in [(1, 1), (1, 300), (2000, 1)] {
        let mut bytes = format!("P6 {width} {height} 255\n").into_bytes();
        bytes.extend((0..width * height).flat_map(|_| [90u8, 60, 30]));
        let name = format!("{width} by {height}.ppm");
        apply(&mut window, JobCommand::Open(Origin::Bytes { name: name.clone(), bytes: bytes.into() }));
        let panes = [Pane::Image, Pane::Profile, Pane::Regions, Pane::Selection].map(Some);
        check_all_sizes(&mut window, &panes, &name);
    }
}

#[test]
fn the_color_space_at_every_size() {
    let Some(mut window) = with_gpu(vec2(900.0, 600.0), Fixture::Tiny) else { return };
    apply(&mut window, Edit::Select(Some(region(1))));
    check_all_sizes(&mut window, &[Some(Pane::Colors)], "a region selected");
    let n = after_test(&window);
    apply(&mut window, Command::Debug(DebugCommand::Seek(n)));
    check_all_sizes(&mut window, &[Some(Pane::Colors)], "a test");
}

#[test]
fn an_ended_panel_is_told_with_where_the_workspace_was_saved() {
    let mut window = tiny_window();
    open_sample(&mut window, dichroscope::truth::sample::NAME);
    apply(&mut window, JobCommand::Rescue("the panel Plane was ended".to_owned()));
    assert!(crate::window::says(&window, "the panel Plane was ended"));
    assert!(crate::window::says(&window, "the workspace was saved to"));
}

#[test]
fn a_small_room_shows_all_panels_as_tabs_and_the_arrangement_comes_back_with_the_room() {
    let mut window = tiny_window();
    window.set_size(vec2(1280.0, 800.0));
    window.run_steps(2);
    apply(&mut window, Edit::Select(Some(region(1))));
    let arranged = state(&window).view.layout.clone();
    window.set_size(vec2(450.0, 350.0));
    window.run_steps(3);
    let picture = named(&window, Role::Image, "Picture").rect();
    assert!(picture.height() > 120.0, "the picture has room: {picture}");
    choose(&mut window, "show inspector");
    assert!(
        says(&window, "Verdict: Holds") || says(&window, "Verdict: Does not hold"),
        "the inspector is in front"
    );
    window.set_size(vec2(1280.0, 800.0));
    window.run_steps(3);
    assert!(named(&window, Role::Image, "Picture").rect().height() > 200.0);
    assert_eq!(state(&window).view.layout, arranged, "the small room changed no arrangement");
}

/// Carries out the command of the palette that has these letters.
fn choose(window: &mut Window, letters: &str) {
    press(window, Modifiers::COMMAND, Key::P);
    window.event(egui::Event::Text(letters.to_owned()));
    window.run_steps(2);
    press(window, Modifiers::NONE, Key::Enter);
    window.run_steps(2);
}

/// Fails where a widget ends beyond the right edge of a window of this width.
#[track_caller]
fn assert_ends_within(window: &Window, width: f32, what: &str) {
    for node in window.root().children_recursive() {
        let Some(words) = crate::window::words(&node).filter(|words| !words.is_empty()) else { continue };
        let right = node.rect().right();
        assert!(right <= width + 0.5, "{what}: {words} ends at {right} of {width}");
    }
}

#[test]
fn lists_end_within_a_panel_that_was_wider_before() {
    let mut window = tiny_window();
    let conditions = [
        Condition::HypothesisRejected,
        Condition::CandidateFails(CandidateCheck::Any),
        Condition::Conflict(None, None),
        Condition::PixelChangesOwner(dichroscope::raster::PixelIndex::from_index(0)),
    ];
    let breakpoints = conditions.map(|condition| Breakpoint { enabled: true, condition }).to_vec();
    let settings = DebugSettings { breakpoints, ..state(&window).view.debug.clone() };
    apply(&mut window, Command::Debug(DebugCommand::Settings(settings)));
    let steps = state(&window).debugger.trace().unwrap().len();
    for (pane, step, narrow) in
        [(Pane::Regions, steps, 500.0), (Pane::Regions, steps - 1, 500.0), (Pane::Breakpoints, steps, 280.0)]
    {
        apply(&mut window, Command::Debug(DebugCommand::Seek(step)));
        window.state_mut().show_alone(Some(pane));
        for width in [1400.0, narrow, 900.0, narrow + 30.0, narrow] {
            window.set_size(vec2(width, 500.0));
            window.run_steps(4);
            assert_ends_within(&window, width, &format!("{pane:?} after {step} steps"));
        }
    }
}
