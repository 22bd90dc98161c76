//! Tests of the parameters panel: dragging, typing, resetting, switching, and undoing.

use crate::window::{
    Window, apply, choose, click, double_click, drag, named, press, says, shown, sigma, state, tiny,
    tiny_window, undo,
};
use dichroscope::app::{ExportKind, JobCommand};
use dichroscope::gui::Pane;
use dichroscope::params::{AmbientSetting, Method, Parameter, Params, Preset, Setting};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Rect};
use egui_kittest::kittest::Queryable;

const SIGMA: &str = "camera noise \u{3c3}0";

fn rail(window: &Window) -> Rect {
    named(window, Role::Slider, SIGMA).rect()
}

fn typed(window: &mut Window, name: &str, text: &str) {
    click(window, Role::SpinButton, name);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(Event::Text(text.to_owned()));
    press(window, Modifiers::NONE, Key::Enter);
}

#[test]
fn a_drag_of_the_slider_is_one_step_and_is_analyzed_all_along() {
    let mut window = tiny_window();
    let (before, generation) = (sigma(&window), state(&window).generation);
    let rail = rail(&window);
    let points: Vec<_> =
        (0..6).map(|i| rail.left_center().lerp(rail.right_center(), 0.3 + 0.08 * i as f32)).collect();
    drag(&mut window, &points, Modifiers::NONE);
    let Setting::Value(after) = sigma(&window) else { panic!("a drag sets a value") };
    assert!((3.0..8.0).contains(&after), "{after}");
    assert!(state(&window).generation >= generation + 4, "each movement is analyzed");
    assert!(state(&window).is_current());
    assert!((shown(&window).analysis.used.camera_noise - after).abs() < 1e-9);
    undo(&mut window);
    assert_eq!(sigma(&window), before);
    assert!(!state(&window).history.can_undo() && state(&window).is_current());
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(sigma(&window), Setting::Value(after));
}

#[test]
fn every_slider_listens_to_assistive_technology() {
    let mut window = tiny_window();
    for parameter in Parameter::ALL {
        let spec = parameter.spec();
        let title = spec.title;
        let value = spec.slider.range[0] + 2.0 * spec.slider.step;
        let before = state(&window).document.params.get(parameter);
        named(&window, Role::Slider, title).set_value_accesskit(value);
        window.run_steps(3);
        let after = state(&window).document.params.get(parameter).value();
        assert!(after.is_some_and(|after| (after - value).abs() < 1e-9), "{title}: {after:?}, not {value}");
        assert!(state(&window).is_current());
        undo(&mut window);
        assert_eq!(state(&window).document.params.get(parameter), before, "{title}");
    }
}

#[test]
fn a_value_is_typed_and_one_out_of_range_goes_as_far_as_it_can() {
    let mut window = tiny_window();
    typed(&mut window, "camera_noise", "4.5");
    assert_eq!(sigma(&window), Setting::Value(4.5));
    typed(&mut window, "camera_noise", "900");
    let most = Parameter::CameraNoise.spec().range[1];
    assert_eq!(sigma(&window), Setting::Value(most));
    undo(&mut window);
    assert_eq!(sigma(&window), Setting::Value(4.5));
    undo(&mut window);
    assert_eq!(sigma(&window), Params::default().camera_noise);
}

#[test]
fn a_slider_that_is_dragged_ends_the_editing_of_a_field_and_is_undone_by_its_key() {
    let mut window = tiny_window();
    let before = state(&window).document.params;
    click(&mut window, Role::SpinButton, "illuminant red");
    let rail = named(&window, Role::Slider, "camera noise \u{3c3}0").rect();
    let points: Vec<_> = (0..6).map(|k| rail.center() + egui::vec2(8.0 * k as f32, 0.0)).collect();
    drag(&mut window, &points, Modifiers::NONE);
    assert_ne!(sigma(&window), before.camera_noise);
    undo(&mut window);
    assert_eq!(state(&window).document.params, before, "one drag is one step");

    click(&mut window, Role::SpinButton, "camera_noise");
    drag(&mut window, &points, Modifiers::NONE);
    assert_ne!(sigma(&window), before.camera_noise);
    undo(&mut window);
    assert_eq!(state(&window).document.params, before, "also with the focus in its own field");
}

#[test]
fn a_field_that_is_only_looked_at_changes_nothing() {
    let mut window = tiny_window();
    let (before, generation) = (state(&window).document.clone(), state(&window).generation);
    let names = ["camera_noise", "illuminant red", "illuminant blue", "ambient green"];
    for leave in [None, Some(Key::Tab), Some(Key::Enter), Some(Key::Escape)] {
        for name in names {
            click(&mut window, Role::SpinButton, name);
            if let Some(key) = leave {
                press(&mut window, Modifiers::NONE, key);
            } else {
                let corner = named(&window, Role::Image, "Picture").rect().left_top();
                drag(&mut window, &[corner + egui::vec2(3.0, 3.0)], Modifiers::NONE);
            }
            window.run_steps(2);
            assert!(state(&window).document.params == before.params, "{name} left by {leave:?}");
            assert_eq!(state(&window).generation, generation, "{name} left by {leave:?}");
        }
    }
    for _ in 0..60 {
        press(&mut window, Modifiers::NONE, Key::Tab);
    }
    assert!(state(&window).document.params == before.params, "Tab through the window");
    assert_eq!(state(&window).view.image.zoom, None, "the whole picture stays fitted");
    typed(&mut window, "illuminant red", "0.9");
    assert!(state(&window).document.params.illuminant.direction().is_some(), "what is typed is taken");
}

#[test]
fn two_clicks_bring_the_default_back() {
    let mut window = tiny_window();
    let default = sigma(&window);
    named(&window, Role::Slider, SIGMA).set_value_accesskit(6.0);
    window.run_steps(3);
    let rail = rail(&window);
    double_click(&mut window, rail.center());
    assert_eq!(sigma(&window), default, "on the slider");
    named(&window, Role::Slider, SIGMA).set_value_accesskit(6.0);
    window.run_steps(3);
    let name = named(&window, Role::Label, SIGMA).rect();
    double_click(&mut window, name.center());
    assert_eq!(sigma(&window), default, "on its name");
    window.run_steps(4);
    drag(&mut window, &[rail.center()], Modifiers::NONE);
    window.run_steps(4);
    drag(&mut window, &[rail.center() + egui::vec2(20.0, 0.0)], Modifiers::NONE);
    assert_ne!(sigma(&window), default, "one click moves the handle");
    undo(&mut window);
    undo(&mut window);
    assert_eq!(sigma(&window), default, "two clicks at two places are two steps");
}

#[test]
fn auto_keeps_what_was_found_when_it_is_let_go() {
    let mut window = tiny_window();
    let used = shown(&window).analysis.used.camera_noise;
    click(&mut window, Role::CheckBox, "camera noise \u{3c3}0 auto");
    let Setting::Value(value) = sigma(&window) else { panic!("it is a value now") };
    assert!((value - used).abs() < 1e-9);
    click(&mut window, Role::CheckBox, "camera noise \u{3c3}0 auto");
    assert_eq!(sigma(&window), Setting::Auto);
}

#[test]
fn the_papers_method_shows_its_readings_and_takes_refinements() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    click(&mut window, Role::Button, "paper");
    for name in ["fill holes", "edge body"] {
        // The panel has more rows than fit into the window.
        named(&window, Role::CheckBox, name).scroll_to_me();
        window.run_steps(4);
        click(&mut window, Role::CheckBox, name);
    }
    let params = state(&window).document.params;
    assert!(params.paper.readings.fill_holes && params.rules().refine.edge_body);
    assert_eq!(params.refine, Params::default().refine, "the refined method keeps its own switches");
    named(&window, Role::Button, "Reset").scroll_to_me();
    window.run_steps(4);
    click(&mut window, Role::Button, "Reset");
    assert_eq!(state(&window).document.params, Params::paper());
    click(&mut window, Role::Button, "refined");
    let has_readings =
        |window: &Window| window.query_by_role_and_label(Role::CheckBox, "fill holes").is_some();
    assert!(!has_readings(&window), "the readings belong to the paper's method");
}

#[test]
fn phoenix_has_features_and_numbers_of_its_own() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    click(&mut window, Role::Button, "phoenix");
    assert_eq!(state(&window).document.params.method, Method::Phoenix);
    let features = |window: &Window| state(window).document.params.phoenix.features.to_string();
    assert_eq!(features(&window), "I,H,S");
    click(&mut window, Role::CheckBox, "hue");
    assert_eq!(features(&window), "I,S");
    assert!(says(&window, "absscore") && !says(&window, "edge body"), "no refinement of the refined method");
    window.state_mut().show_alone(Some(Pane::Regions));
    window.run_steps(2);
    assert!(says(&window, "the method finds regions alone and seeks no light"), "no highlight was missed");
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    click(&mut window, Role::Button, "top-down");
    assert!(!says(&window, "absscore") && state(&window).document.params.method == Method::TopDown);
}

#[test]
fn methods_and_switches_are_chosen_and_reset() {
    let mut window = tiny_window();
    let switch = |window: &Window| state(window).document.params.refine.edge_body;
    let before = switch(&window);
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    click(&mut window, Role::CheckBox, "edge body");
    assert_eq!(switch(&window), !before);
    click(&mut window, Role::Button, "paper");
    assert_eq!(state(&window).document.params.method, Method::Paper);
    assert_eq!(sigma(&window), Setting::Value(2.5), "table 6");
    click(&mut window, Role::Button, "Reset");
    assert_eq!(state(&window).document.params, Params::paper());
    click(&mut window, Role::Button, "refined");
    assert_eq!(state(&window).document.params.method, Method::Refined);
    for _ in 0..4 {
        undo(&mut window);
    }
    assert_eq!(state(&window).document.params, Params::default());
}

#[test]
fn presets_are_in_the_menu_and_parameters_travel_through_a_file() {
    let mut window = tiny_window();
    let preset = Preset::ALL[1];
    choose(&mut window, "Analyze", "Presets of table 6");
    click(&mut window, Role::Button, preset.title());
    assert_eq!(state(&window).document.params, preset.params());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.toml");
    apply(&mut window, JobCommand::Export(ExportKind::Parameters.to(path.clone())));
    undo(&mut window);
    assert_eq!(state(&window).document.params, Params::default());
    choose(&mut window, "Analyze", "Load parameters");
    crate::window::answer(&mut window, &path);
    assert_eq!(state(&window).document.params, preset.params());
    std::fs::write(&path, "window_size = \n").unwrap();
    choose(&mut window, "Analyze", "Load parameters");
    crate::window::answer(&mut window, &path);
    assert!(says(&window, "p.toml:1: "), "the dialog stays and says what is wrong");
    assert_eq!(state(&window).document.params, preset.params());
}

#[test]
fn the_light_is_pinned_and_let_go() {
    let mut window = tiny_window();
    let found = shown(&window).analysis.illuminant.unwrap().direction;
    click(&mut window, Role::CheckBox, "pin illuminant");
    let pinned = state(&window).document.params.illuminant.direction().unwrap();
    assert!((0..3).all(|band| (pinned[band] - found[band]).abs() < 1e-12), "{pinned:?}, {found:?}");
    assert!(shown(&window).analysis.illuminant.unwrap().given);
    click(&mut window, Role::SpinButton, "illuminant green");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    for digit in ["0", ".", "9"] {
        window.event(Event::Text(digit.to_owned()));
        window.run_steps(2);
    }
    press(&mut window, Modifiers::NONE, Key::Enter);
    let given = state(&window).document.params.illuminant.direction().unwrap();
    assert!((given[1] / given[0] - 0.9 / found[0]).abs() < 1e-9, "a direction: {found:?}, {given:?}");
    click(&mut window, Role::CheckBox, "pin illuminant");
    assert_eq!(state(&window).document.params.illuminant.direction(), None);
}

#[test]
fn the_call_of_what_is_shown_can_be_copied() {
    let mut window = tiny_window();
    named(&window, Role::Slider, SIGMA).set_value_accesskit(4.0);
    window.run_steps(3);
    window.get_by_role_and_label(Role::Button, "Analyze").click();
    window.run_steps(3);
    named(&window, Role::Button, "Copy as command line").click();
    let mut copied = Vec::new();
    // Each event has a frame of its own, because the copied text is in the output of one frame only.
    for _ in 0..4 {
        window.run_steps(1);
        copied.extend(window.output().platform_output.commands.iter().filter_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        }));
    }
    let call = copied.concat();
    assert!(call.starts_with("dichroscope analyze ") && call.contains("--camera-noise 4"), "{call:?}");
    assert!(call.contains(&tiny().display().to_string()), "{call:?}");
}

#[test]
fn ambient_light_is_given_switched_off_and_found_again() {
    let mut window = tiny_window();
    // Alone, the panel shows all rows without scrolling.
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    assert_eq!(state(&window).document.params.ambient, AmbientSetting::Auto);
    click(&mut window, Role::CheckBox, "ambient automatic");
    assert_eq!(state(&window).document.params.ambient, AmbientSetting::Off);
    click(&mut window, Role::SpinButton, "ambient blue");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(Event::Text("6".to_owned()));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(state(&window).document.params.ambient, AmbientSetting::Given([0.0, 0.0, 6.0]));
    assert_eq!(shown(&window).analysis.intrinsic.ambient.subtracted, Some([0.0, 0.0, 6.0]));
    click(&mut window, Role::CheckBox, "ambient automatic");
    assert_eq!(state(&window).document.params.ambient, AmbientSetting::Auto);
    undo(&mut window);
    assert_eq!(state(&window).document.params.ambient, AmbientSetting::Given([0.0, 0.0, 6.0]));
}

#[test]
fn a_drag_within_one_frame_ends_where_the_slider_was_let_go() {
    let mut window = tiny_window();
    let slider = named(&window, Role::Slider, "slice width").rect();
    let width = |window: &Window| state(window).document.params.get(Parameter::SliceWidth);
    let before = width(&window);
    let [from, to] = [0.2, 0.5].map(|share| slider.lerp_inside(egui::vec2(share, 0.5)));
    let button = |pos, pressed| {
        let modifiers = Modifiers::NONE;
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers }
    };
    let away = Event::PointerMoved(egui::pos2(300.0, 700.0));
    let drag =
        [Event::PointerMoved(from), button(from, true), Event::PointerMoved(to), button(to, false), away];
    window.input_mut().events.extend(drag);
    window.run_steps(8);
    let Setting::Value(value) = width(&window) else { panic!("the slider has moved") };
    let [least, most] = Parameter::SliceWidth.spec().slider.range;
    assert!(width(&window) != before && value > least && value < most, "{value}");
    undo(&mut window);
    assert_eq!(width(&window), before, "a drag is one step");
}
