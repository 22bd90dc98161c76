//! Tests of habits that hold for the whole window: notices, focus, keys of other keyboards, saving, and bad values that are marked.

use crate::window::{
    Window, answer, apply, choose, click, named, open_sample, press, region, says, state, tiny_window, window,
};
use dichroscope::app::{Edit, JobCommand, Severity, ViewCommand};
use dichroscope::truth::sample;
use dichroscope::view::{Arrangement, ImageSettings, Layer, Origin, ProfileLine, Tool};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

fn notify(window: &mut Window, severity: Severity, text: &str) {
    apply(window, ViewCommand::Notify(severity, text.to_owned()));
}

#[test]
fn a_success_goes_by_itself_and_an_error_stays() {
    let mut window = tiny_window();
    notify(&mut window, Severity::Done, "It is written.");
    notify(&mut window, Severity::Error, "It is broken.");
    assert!(says(&window, "It is written.") && says(&window, "It is broken."));
    window.run_steps(40);
    assert!(!says(&window, "It is written.") && says(&window, "It is broken."));
}

#[test]
fn notices_stand_over_the_views_and_move_no_panel() {
    let mut window = tiny_window();
    window.set_size(vec2(900.0, 700.0));
    window.run_steps(3);
    let timeline_before = named(&window, Role::Slider, "Timeline").rect();
    let picture_before = named(&window, Role::Image, "Picture").rect();
    for text in [
        "One.",
        "Two.",
        "A sentence that is so long that a window of 900 points has no room for all of it in one \
                  line, so that the sentence takes a second line below the first one.",
    ] {
        notify(&mut window, Severity::Error, text);
    }
    let timeline = named(&window, Role::Slider, "Timeline").rect();
    let dismiss: Vec<_> =
        window.get_all_by_role_and_label(Role::Button, "Dismiss").map(|node| node.rect()).collect();
    assert_eq!(dismiss.len(), 3);
    for button in dismiss {
        assert!(
            button.top() > 300.0 && button.bottom() < timeline.top() && button.right() <= 900.0,
            "{button}"
        );
    }
    assert_eq!(timeline, timeline_before);
    assert_eq!(named(&window, Role::Image, "Picture").rect(), picture_before);
}

#[test]
fn the_notices_of_a_photograph_end_with_it() {
    let mut window = window();
    notify(&mut window, Severity::Warning, "The settings are broken.");
    open_sample(&mut window, sample::NAME);
    notify(&mut window, Severity::Error, "This photograph is odd.");
    open_sample(&mut window, sample::SAMPLES[1].name);
    assert!(!says(&window, "This photograph is odd.") && says(&window, "The settings are broken."));
}

#[test]
fn parameters_that_stay_in_force_are_named_once() {
    let mut window = tiny_window();
    open_sample(&mut window, sample::NAME);
    assert!(state(&window).notices.is_empty(), "defaults need no word");
    crate::window::named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(4.0);
    window.run_steps(3);
    open_sample(&mut window, sample::SAMPLES[1].name);
    window.run_steps(3);
    assert!(says(&window, "stay in force"));
    open_sample(&mut window, sample::SAMPLES[2].name);
    assert!(says(&window, "stay in force"), "a photograph that follows at once does not hide it");
    click(&mut window, Role::Button, "Dismiss");
    open_sample(&mut window, sample::SAMPLES[3].name);
    assert!(!says(&window, "stay in force"), "it was told");
    choose(&mut window, "Analyze", "Reset parameters");
    crate::window::named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(4.0);
    window.run_steps(3);
    let bytes = std::fs::read(crate::window::tiny()).unwrap().into();
    apply(&mut window, JobCommand::Open(Origin::Bytes { name: "another.png".to_owned(), bytes }));
    assert!(says(&window, "stay in force"), "parameters were changed anew");
    choose(&mut window, "Analyze", "Reset parameters");
    assert!(!says(&window, "stay in force"), "none is changed any more");
}

#[test]
fn every_stop_of_tab_is_visible_and_named() {
    let mut window = tiny_window();
    let mut names = Vec::new();
    for _ in 0..150 {
        press(&mut window, Modifiers::NONE, Key::Tab);
        let Some(node) = window.root().children_recursive().find(egui_kittest::Node::is_focused) else {
            continue;
        };
        let rect = node.rect();
        let name = crate::window::words(&node).unwrap_or_default();
        assert!(!name.trim().is_empty(), "{:?} at {rect}", node.accesskit_node().role());
        assert!(rect.width() >= 6.0 && rect.height() >= 6.0, "{name} at {rect}");
        names.push(name);
    }
    let picture = names.iter().position(|name| name == "Picture").expect("the picture is a stop");
    let again = names[picture + 1..].iter().position(|name| name == "Picture");
    assert!(again.is_none_or(|stops| stops < 110), "{names:#?}");
    let table = names.iter().filter(|name| name.starts_with("color of region")).count();
    assert_eq!(table, 0, "cells of a table are no stops");
}

#[test]
fn the_menu_shows_the_key_that_quits() {
    let mut window = tiny_window();
    window.get_by_role_and_label(Role::Button, "File").click();
    window.run_steps(3);
    assert!(says(&window, "Quit") && says(&window, "Ctrl+Q"));
}

#[test]
fn digits_are_found_by_their_place_where_the_layout_has_other_signs() {
    let mut window = tiny_window();
    for (key, place, layer) in [
        (Key::Quote, Key::Num4, Layer::Areas),
        (Key::Minus, Key::Num6, Layer::Planar),
        (Key::Num8, Key::Num8, Layer::Body),
    ] {
        for pressed in [true, false] {
            let (physical_key, repeat, modifiers) = (Some(place), false, Modifiers::NONE);
            window.event(Event::Key { key, physical_key, pressed, repeat, modifiers });
        }
        window.run_steps(2);
        assert_eq!(state(&window).view.image.layer, layer, "{key:?}");
    }
}

#[test]
fn a_workspace_is_saved_again_without_a_question() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::S);
    answer(&mut window, &folder.path().join("mine"));
    let file = folder.path().join("mine.dichroscope");
    let first = std::fs::read_to_string(&file).expect("the extension is added");
    apply(&mut window, Edit::Select(Some(region(2))));
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(window.query_by_role(Role::TextInput).is_none(), "no dialog opens");
    assert_ne!(std::fs::read_to_string(&file).unwrap(), first);
    choose(&mut window, "File", "Save workspace as");
    assert!(window.query_by_role(Role::TextInput).is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    open_sample(&mut window, sample::NAME);
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(window.query_by_role(Role::TextInput).is_some(), "another photograph has no file yet");
}

#[test]
fn a_given_light_says_how_far_it_lies_from_the_light_found() {
    let mut window = tiny_window();
    assert!(!says(&window, "from the light found"));
    apply(&mut window, Edit::PinIlluminant(Some([1.0, 0.0, 0.0]), None));
    assert!(says(&window, "from the light found"));
    apply(&mut window, Edit::PinIlluminant(None, None));
    assert!(!says(&window, "from the light found"));
}

#[test]
fn a_wipe_begins_with_two_layers_and_a_drawn_profile_is_raised() {
    let mut window = tiny_window();
    let mut image = state(&window).view.image.clone();
    (image.layer, image.other) = (Layer::Body, Layer::Body);
    apply(&mut window, ViewCommand::Image(image));
    click(&mut window, Role::Button, "Wipe");
    let image = state(&window).view.image.clone();
    assert!(matches!(image.arrangement, Arrangement::Wipe(_)));
    assert_eq!([image.layer, image.other], [Layer::Body, Layer::Input]);
    apply(&mut window, ViewCommand::Image(dichroscope::view::ImageSettings { tool: Tool::Profile, ..image }));
    assert!(!says(&window, "body m_b"));
    apply(&mut window, ViewCommand::Profile(ProfileLine::Between([10.0, 10.0], [90.0, 90.0])));
    window.run_steps(3);
    assert!(window.query_by_role_and_label(Role::Button, "column").is_some(), "the profile is in front");
}

#[test]
fn the_result_shown_and_the_copied_command_line_are_named() {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    let whose_history = "The history is that of the newest result, which the key A shows again.";
    apply(&mut window, ViewCommand::Pin(true));
    assert!(!says(&window, "A: the pinned result") && !says(&window, whose_history));
    assert!(!says(&window, "Parameters (B)"));
    apply(&mut window, ViewCommand::ShowPinned(true));
    assert!(says(&window, "A: the pinned result"));
    assert!(says(&window, "Parameters (B)") && says(&window, "Regions (A)"), "the tabs");
    assert!(says(&window, whose_history), "instead of the history of the region");
    choose(&mut window, "Analyze", "Copy as command line");
    window.run_steps(3);
    assert!(says(&window, "the command line is in the clipboard"));
}

#[test]
fn controls_stay_inside_a_narrow_window_and_a_large_interface() {
    for (size, zoom) in [(vec2(900.0, 700.0), 1.0), (vec2(1440.0, 900.0), 1.25), (vec2(1440.0, 900.0), 1.6)] {
        let mut window = tiny_window();
        window.set_size(size / zoom);
        window.run_steps(4);
        let width = size.x / zoom;
        for node in window.root().children_recursive() {
            let role = node.accesskit_node().role();
            let name = crate::window::words(&node).unwrap_or_default();
            if [Role::CheckBox, Role::SpinButton].contains(&role) {
                let rect = node.rect();
                assert!(
                    rect.right() <= width + 0.5 && rect.width() > 12.0,
                    "{size} at {zoom}: {name} at {rect}"
                );
                assert!(rect.height() < 30.0, "{size} at {zoom}: {name} breaks into lines: {rect}");
            }
        }
    }
}

#[test]
fn a_layer_is_exported_alone_from_its_menu_as_floats() {
    let mut window = tiny_window();
    let folder = tempfile::tempdir().unwrap();
    for (entry, name, magic) in [
        ("Export body as OpenEXR\u{2026}", "body.exr", &b"\x76\x2f\x31\x01"[..]),
        ("Export body as NumPy array\u{2026}", "body.npy", &b"\x93NUMPY"[..]),
        ("Export body as PNG\u{2026}", "body.png", &b"\x89PNG"[..]),
    ] {
        apply(&mut window, ViewCommand::Image(ImageSettings { layer: Layer::Body, ..Default::default() }));
        click(&mut window, Role::ComboBox, "Layer");
        named(&window, Role::Button, entry).scroll_to_me();
        window.run_steps(6);
        click(&mut window, Role::Button, entry);
        window.run_steps(3);
        assert!(says(&window, "Body: .png as shown"), "{entry}");
        let path = folder.path().join(name);
        crate::window::answer(&mut window, &path);
        let bytes = std::fs::read(&path).unwrap();
        assert!(bytes.starts_with(magic), "{entry}");
    }
}

#[test]
fn the_photograph_is_shown_while_c_is_held() {
    let mut window = tiny_window();
    apply(&mut window, ViewCommand::Image(ImageSettings { layer: Layer::Body, ..Default::default() }));
    let before = state(&window).view.image.clone();
    let c = |pressed| egui::Event::Key {
        key: Key::C,
        physical_key: Some(Key::C),
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    window.event(c(true));
    window.run_steps(3);
    assert!(says(&window, "Layer shown: Input"), "the photograph in place of the body reflection");
    assert_eq!(state(&window).view.image, before, "the settings stay");
    window.event(c(false));
    window.run_steps(3);
    assert!(!says(&window, "Layer shown:"));
}
