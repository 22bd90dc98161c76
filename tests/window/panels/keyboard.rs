//! Tests of keyboard shortcuts, the help window, and the theme.

use crate::window::{Window, apply, choose, press, says, state, tiny_window, window};
use dichroscope::app::{Edit, Severity, ViewCommand};
use dichroscope::params::{Parameter, Setting};
use dichroscope::view::{Theme, Tool};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

const LISTED: &str = "Mark the pixels of the selected region";

#[test]
fn a_question_mark_opens_the_list_of_keys_and_escape_closes_it() {
    let mut window = tiny_window();
    assert!(!says(&window, LISTED));
    press(&mut window, Modifiers::SHIFT, Key::Questionmark);
    assert!(says(&window, LISTED) && says(&window, "zoom at the pointer"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!says(&window, LISTED));
    press(&mut window, Modifiers::NONE, Key::F1);
    assert!(says(&window, LISTED));
    press(&mut window, Modifiers::NONE, Key::F1);
    choose(&mut window, "Help", "Keyboard and pointer");
    assert!(says(&window, LISTED));
}

#[test]
fn the_theme_is_toggled_by_key_and_by_menu() {
    let mut window = tiny_window();
    // The whole menu has room.
    window.set_size(egui::vec2(900.0, 900.0));
    let dark = window.ctx.global_style().visuals.clone();
    press(&mut window, Modifiers::NONE, Key::T);
    assert_eq!(state(&window).view.theme, Theme::Light);
    assert_ne!(window.ctx.global_style().visuals.panel_fill, dark.panel_fill);
    choose(&mut window, "View", "Dark");
    assert_eq!(state(&window).view.theme, Theme::Dark);
    assert_eq!(window.ctx.global_style().visuals.panel_fill, dark.panel_fill);
}

#[test]
fn keys_are_letters_while_somebody_types() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::O);
    assert!(is_asked(&window));
    for (key, letter) in [(Key::T, "t"), (Key::K, "k"), (Key::R, "r"), (Key::Num3, "3")] {
        window.event(Event::Text(letter.to_owned()));
        press(&mut window, Modifiers::NONE, key);
    }
    let view = &state(&window).view;
    assert_eq!((view.theme, view.image.tool), (Theme::Dark, Tool::Pointer));
    assert!(state(&window).pinned.is_none());
    assert_eq!(window.get_by_role(Role::TextInput).value().as_deref(), Some("tkr3"));
}

#[test]
fn a_dialog_owns_the_keyboard_and_gives_the_focus_back() {
    let mut window = tiny_window();
    crate::window::click(&mut window, Role::SpinButton, "camera_noise");
    press(&mut window, Modifiers::COMMAND, Key::E);
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, Modifiers::COMMAND, Key::E);
    crate::window::click(&mut window, Role::RadioButton, "Regions table");
    assert!(window.get_by_role_and_label(Role::TextInput, "Path").is_focused(), "the field has the focus");
    crate::window::click(&mut window, Role::RadioButton, "Everything, as a folder");
    crate::window::click(&mut window, Role::CheckBox, "replace the folder whatever it holds");
    let before = state(&window).clone();
    for (key, letter) in
        [(Key::T, "t"), (Key::K, "k"), (Key::CloseBracket, "]"), (Key::Num3, "3"), (Key::D, "d")]
    {
        window.event(Event::Text(letter.to_owned()));
        press(&mut window, Modifiers::NONE, key);
        press(&mut window, Modifiers::COMMAND, key);
    }
    for _ in 0..30 {
        press(&mut window, Modifiers::NONE, Key::Tab);
        let focused = window.root().children_recursive().find(egui_kittest::Node::is_focused);
        if let Some(name) = focused.as_ref().and_then(crate::window::words) {
            assert!(!name.contains("camera") && name != "Picture" && name != "Timeline", "{name}");
        }
    }
    assert_eq!(state(&window).view, before.view);
    assert!(state(&window).document == before.document && state(&window).pinned.is_none());
}

fn is_asked(window: &Window) -> bool {
    window.query_by_role(Role::TextInput).is_some()
}

#[test]
fn escape_closes_a_window_that_asks_and_leaves_the_selection() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::NONE, Key::CloseBracket);
    for leaves_the_field in [false, true] {
        press(&mut window, Modifiers::COMMAND, Key::O);
        assert!(is_asked(&window));
        if leaves_the_field {
            press(&mut window, Modifiers::NONE, Key::Tab);
        }
        press(&mut window, Modifiers::NONE, Key::Escape);
        assert!(!is_asked(&window), "left the field: {leaves_the_field}");
        assert!(crate::window::item(&window).is_some(), "left the field: {leaves_the_field}");
    }
}

#[test]
fn escape_closes_a_menu_or_gives_typing_up_and_leaves_the_selection() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::NONE, Key::CloseBracket);
    window.get_by_role_and_label(Role::Button, "Edit").click();
    window.run_steps(3);
    assert!(says(&window, "Invert marked"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!says(&window, "Invert marked"));
    assert!(crate::window::item(&window).is_some(), "a menu");
    let before = crate::window::sigma(&window);
    crate::window::click(&mut window, Role::SpinButton, "camera_noise");
    window.event(Event::Text("7".to_owned()));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(crate::window::item(&window).is_some(), "typing");
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(crate::window::item(&window), None, "nothing was open any more");
    crate::window::undo(&mut window);
    crate::window::undo(&mut window);
    assert_eq!(crate::window::sigma(&window), before, "what was typed is a step");
}

#[test]
fn menus_are_opened_walked_and_chosen_from_by_keys() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::NONE, Key::F10);
    assert!(says(&window, "Sample scenes"), "the first menu");
    press(&mut window, Modifiers::NONE, Key::ArrowRight);
    assert!(says(&window, "Invert marked") && !says(&window, "Sample scenes"), "the next menu");
    press(&mut window, Modifiers::NONE, Key::ArrowDown);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!says(&window, "Analyze only the marked pixels"), "the menu is closed");
    assert!(crate::window::marked(&window) > 0, "the first row that can be chosen inverts the marked pixels");
    press(&mut window, Modifiers::ALT, Key::V);
    assert!(says(&window, "Arrange as at first"));
    press(&mut window, Modifiers::NONE, Key::ArrowLeft);
    assert!(says(&window, "Invert marked") && !says(&window, "Arrange as at first"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!says(&window, "Invert marked"));
}

#[test]
fn a_submenu_is_entered_and_left_by_arrows() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::ALT, Key::F);
    for _ in 0..4 {
        press(&mut window, Modifiers::NONE, Key::ArrowDown);
    }
    let name = dichroscope::truth::sample::SAMPLES[0].name;
    assert!(says(&window, name), "the submenu of samples opens as the focus reaches it");
    press(&mut window, Modifiers::NONE, Key::ArrowRight);
    press(&mut window, Modifiers::NONE, Key::ArrowLeft);
    assert!(!says(&window, name) && says(&window, "Sample scenes"), "left again, and in the same menu");
    press(&mut window, Modifiers::NONE, Key::ArrowRight);
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(3);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin.name(), name);
    assert!(!says(&window, "Sample scenes"));
}

#[test]
fn letters_reach_no_command_while_a_menu_is_open() {
    let mut window = tiny_window();
    let before = state(&window).view.clone();
    for opens in [Modifiers::NONE, Modifiers::ALT] {
        let key = if opens.alt { Key::A } else { Key::F10 };
        press(&mut window, opens, key);
        for key in [Key::T, Key::K, Key::R, Key::Num3, Key::D, Key::Minus, Key::C] {
            press(&mut window, Modifiers::NONE, key);
            // With Ctrl, this key makes all texts smaller, wherever the keyboard is.
            if key != Key::Minus {
                press(&mut window, Modifiers::COMMAND, key);
            }
        }
        assert_eq!(state(&window).view, before);
        assert!(state(&window).pinned.is_none() && state(&window).notices.is_empty());
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
    press(&mut window, Modifiers::NONE, Key::T);
    assert_eq!(state(&window).view.theme, Theme::Light, "the menu is closed");
}

#[test]
fn a_notice_stays_until_it_is_dismissed() {
    let mut window = window();
    apply(&mut window, ViewCommand::Notify(Severity::Warning, "The moon is full.".to_owned()));
    assert!(says(&window, "The moon is full."));
    crate::window::click(&mut window, Role::Button, "Dismiss");
    assert!(!says(&window, "The moon is full.") && state(&window).notices.is_empty());
}

#[test]
fn panels_are_hidden_shown_and_arranged_as_at_first() {
    let mut window = tiny_window();
    let first = state(&window).view.layout.clone();
    assert!(says(&window, "camera noise"));
    choose(&mut window, "View", "Parameters");
    press(&mut window, Modifiers::NONE, Key::V);
    assert_ne!(state(&window).view.layout, first, "the arrangement is kept with the view");
    assert!(!says(&window, "camera noise"));
    choose(&mut window, "View", "Arrange as at first");
    assert!(says(&window, "camera noise"));
    assert_eq!(state(&window).view.layout, first);
}

#[test]
fn a_key_that_is_pressed_twice_within_a_frame_counts_twice() {
    let mut window = tiny_window();
    let defaults = state(&window).document.clone();
    for value in [3.0, 4.0] {
        apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(value), None));
    }
    press_within_a_frame(&mut window, &[(Modifiers::COMMAND, Key::Z); 2]);
    assert_eq!(state(&window).document.params, defaults.params);
}

#[test]
fn what_is_typed_ahead_of_a_list_that_opens_is_no_command() {
    let mut window = tiny_window();
    let before = state(&window).view.clone();
    let typed = [(Modifiers::COMMAND, Key::P), (Modifiers::NONE, Key::T), (Modifiers::NONE, Key::Num7)];
    press_within_a_frame(&mut window, &typed);
    assert!(is_asked(&window));
    assert_eq!(state(&window).view, before);
}

#[test]
fn what_is_typed_ahead_of_a_field_is_in_the_field() {
    for opens in [Key::O, Key::E] {
        let mut window = tiny_window();
        // The first time, a dialog is invisible for a frame, in which it is measured; the second time it is known.
        for _ in 0..2 {
            let key = Event::Key {
                key: opens,
                physical_key: Some(opens),
                pressed: true,
                repeat: false,
                modifiers: Modifiers::COMMAND,
            };
            window.input_mut().events.extend([key, Event::Text("a".to_owned())]);
            window.step();
            window.input_mut().events.push(Event::Text("b".to_owned()));
            window.run_steps(3);
            let path = window.get_by_role_and_label(Role::TextInput, "Path").value().unwrap();
            // An export proposes a name, of which all but the extension is replaced.
            let name = std::path::Path::new(&path).file_stem().unwrap();
            assert_eq!(name, "ab", "{path} after {opens:?}");
            press(&mut window, Modifiers::NONE, Key::Escape);
        }
    }
}

fn press_within_a_frame(window: &mut Window, keys: &[(Modifiers, Key)]) {
    for &(modifiers, key) in keys {
        let pressed = Event::Key { key, physical_key: Some(key), pressed: true, repeat: false, modifiers };
        window.input_mut().events.push(pressed);
    }
    window.step();
    window.run_steps(2);
}

#[test]
fn the_list_of_keys_takes_the_room_of_the_window_that_has_grown() {
    let mut window = tiny_window();
    let list_height = |window: &mut Window, height: f32| {
        window.set_size(egui::vec2(900.0, height));
        window.run_steps(3);
        let list = window.query_all_by_role(Role::Window).next().expect("the list is open");
        list.rect().height()
    };
    press(&mut window, Modifiers::SHIFT, Key::Questionmark);
    let low = list_height(&mut window, 600.0);
    let high = list_height(&mut window, 900.0);
    assert!(high > low + 200.0, "{low} in a room of 600 points, {high} in one of 900");
}

#[test]
fn a_key_that_finds_nothing_to_undo_to_show_or_to_close_says_so() {
    let mut window = tiny_window();
    for (modifiers, key, answer) in [
        (Modifiers::COMMAND, Key::Z, "nothing to undo"),
        (Modifiers::COMMAND, Key::Y, "nothing to redo"),
        (Modifiers::COMMAND, Key::PageDown, "no other photograph is open"),
        (Modifiers::COMMAND, Key::W, "the only photograph stays open"),
    ] {
        press(&mut window, modifiers, key);
        assert!(says(&window, answer), "{answer}: {:?}", state(&window).notices);
    }
    assert!(state(&window).picture.is_some());
}

#[test]
fn the_size_of_all_texts_is_changed_by_keys_and_the_menu_and_kept() {
    let mut window = tiny_window();
    let percent = |size: f32| (size * 100.0).round() as u32;
    let now = |window: &Window| percent(window.ctx.zoom_factor());
    let kept = |window: &Window| state(window).view.text_size.map(percent);
    press(&mut window, Modifiers::COMMAND, Key::Plus);
    assert_eq!((now(&window), kept(&window)), (110, Some(110)));
    press(&mut window, Modifiers::COMMAND, Key::Minus);
    choose(&mut window, "View", "Larger text and controls");
    press(&mut window, Modifiers::COMMAND, Key::Plus);
    assert_eq!(now(&window), 120);
    press(&mut window, Modifiers::COMMAND, Key::Num0);
    assert_eq!((now(&window), kept(&window)), (100, Some(100)));
    apply(&mut window, ViewCommand::TextSize(1.5));
    window.run_steps(2);
    assert_eq!(now(&window), 150, "as saved settings restore it");
}
