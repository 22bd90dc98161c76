//! Tests of the command palette, the context menus, and of a layout that does not move while the debugger's cursor does.

use crate::window::{
    Fixture, Window, answer, apply, at, choose, click, inside, item, marked, notice, open_sample, press,
    region, says, secondary_click, state, tap, tiny, tiny_window, window, with_gpu, zoom_in,
};
use dichroscope::app::{Command, DebugCommand, Edit};
use dichroscope::params::{Parameter, Setting};
use dichroscope::truth::sample;
use dichroscope::view::{Arrangement, ArrangementKind, ColorBy, ColorSpace, Item, Layer, Theme};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, pos2};
use egui_kittest::kittest::Queryable;

fn type_text(window: &mut Window, text: &str) {
    window.event(Event::Text(text.to_owned()));
    window.run_steps(3);
}

#[test]
fn a_command_is_found_by_letters_and_done_by_enter() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::P);
    assert!(says(&window, "Image: Body reflection") && says(&window, "Show: Inspector"));
    type_text(&mut window, "refl body");
    assert!(says(&window, "Image: Body reflection") && !says(&window, "Image: Noise"));
    assert_eq!(state(&window).view.image.layer, Layer::Input, "letters reach no panel");
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(2);
    assert_eq!(state(&window).view.image.layer, Layer::Body);
    assert!(!says(&window, "Image: Body reflection"), "the palette is closed");
}

#[test]
fn a_command_is_chosen_by_arrows_or_the_pointer_and_escape_chooses_none() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::P);
    type_text(&mut window, "image layer");
    press(&mut window, Modifiers::NONE, Key::ArrowDown);
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(2);
    let second = state(&window).view.image.layer;
    press(&mut window, Modifiers::COMMAND, Key::P);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!says(&window, "Light or dark theme"));
    assert_eq!(state(&window).view.image.layer, second);
    press(&mut window, Modifiers::COMMAND, Key::P);
    type_text(&mut window, "light");
    click(&mut window, Role::Button, "Window: Light or dark theme");
    assert_eq!(state(&window).view.theme, Theme::Light);
    press(&mut window, Modifiers::COMMAND, Key::P);
    type_text(&mut window, "no such thing");
    assert!(says(&window, "No command has these letters."));
}

#[test]
fn presses_of_an_arrow_within_one_frame_all_count() {
    let layer_after = |frames: [usize; 2]| {
        let mut window = tiny_window();
        press(&mut window, Modifiers::COMMAND, Key::P);
        type_text(&mut window, "image layer");
        for presses in frames {
            let event = |pressed| Event::Key {
                key: Key::ArrowDown,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            };
            for _ in 0..presses {
                window.input_mut().events.extend([event(true), event(false)]);
            }
            window.step();
        }
        press(&mut window, Modifiers::NONE, Key::Enter);
        window.run_steps(2);
        state(&window).view.image.layer
    };
    let (in_two_frames, in_one) = (layer_after([1, 1]), layer_after([2, 0]));
    assert_eq!(in_one, in_two_frames);
    assert_ne!(in_one, layer_after([1, 0]));
}

#[test]
fn the_context_menu_of_the_picture_is_about_the_pixel_and_its_region() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = inside(&window, 2);
    let place = at(&window, x as f32 + 0.5, y as f32 + 0.5);
    secondary_click(&mut window, place);
    assert!(says(&window, "Region 2") && says(&window, "Copy place and color"));
    click(&mut window, Role::Button, "Mark its pixels");
    assert!(marked(&window) > 0);
    secondary_click(&mut window, place);
    click(&mut window, Role::Button, "Why is this pixel what it is?");
    assert!(matches!(item(&window), Some(Item::Pixel(_))));
}

#[test]
fn the_context_menu_of_a_row_is_about_its_region() {
    let mut window = tiny_window();
    let chip = window.get_by_role_and_label(Role::Label, "color of region 2").rect().center();
    secondary_click(&mut window, chip);
    click(&mut window, Role::Button, "Select the region");
    assert_eq!(item(&window), Some(Item::Region(dichroscope::raster::RegionId::from_index(1))));
}

#[test]
fn what_the_pointer_has_left_is_hovered_no_more() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = inside(&window, 2);
    let on_pixel = at(&window, x as f32 + 0.5, y as f32 + 0.5);
    let on_row = window.get_by_role_and_label(Role::Label, "color of region 2").rect().center();
    let on_menus = window.get_by_role_and_label(Role::Button, "Help").rect().center();
    for place in [on_pixel, on_row] {
        window.hover_at(place);
        window.run_steps(3);
        assert!(state(&window).hover.is_some(), "{place}");
        window.hover_at(on_menus);
        window.run_steps(3);
        assert_eq!(state(&window).hover, None, "{place}");
    }
}

#[test]
fn the_zoom_is_found_in_the_palette() {
    let mut window = tiny_window();
    for (name, zoom) in
        [("zoom 100", Some(1.0)), ("zoom in", Some(1.25)), ("zoom out", Some(1.0)), ("zoom fit", None)]
    {
        press(&mut window, Modifiers::COMMAND, Key::P);
        type_text(&mut window, name);
        press(&mut window, Modifiers::NONE, Key::Enter);
        window.run_steps(3);
        assert_eq!(state(&window).view.image.zoom, zoom, "{name}");
    }
}

#[test]
fn one_layer_or_two_are_arranged_from_the_palette_and_the_menu() {
    let mut window = tiny_window();
    let by_palette = |window: &mut Window, letters: &str| {
        press(window, Modifiers::COMMAND, Key::P);
        type_text(window, letters);
        press(window, Modifiers::NONE, Key::Enter);
        window.run_steps(3);
        let image = &state(window).view.image;
        (image.arrangement, image.layer, image.other)
    };
    assert_eq!(by_palette(&mut window, "wipe"), (Arrangement::Wipe(0.5), Layer::Input, Layer::Body));
    assert_eq!(by_palette(&mut window, "one layer"), (Arrangement::Single, Layer::Input, Layer::Body));
    let beside = by_palette(&mut window, "second layer noise");
    assert_eq!(beside, (Arrangement::SideBySide, Layer::Input, Layer::Noise));
    choose(&mut window, "View", ArrangementKind::Single.name());
    choose(&mut window, "View", ArrangementKind::SideBySide.name());
    assert_eq!(state(&window).view.image.arrangement, Arrangement::SideBySide);
    by_palette(&mut window, "one layer");
    by_palette(&mut window, "image: noise");
    let wiped = by_palette(&mut window, "wipe");
    assert_eq!(wiped, (Arrangement::Wipe(0.5), Layer::Noise, Layer::Input), "never a layer beside itself");
}

#[test]
fn the_picture_does_not_move_while_the_cursor_does() {
    let mut window = tiny_window();
    let picture = |window: &Window| window.get_by_role_and_label(Role::Image, "Picture").rect();
    let rest = picture(&window);
    for n in [12_000, 3, 30_000] {
        apply(&mut window, Command::Debug(DebugCommand::Seek(n)));
        assert!((picture(&window).height() - rest.height()).abs() < 0.5, "after {n} steps");
    }
    click(&mut window, Role::Button, "Follow");
    assert!((picture(&window).height() - rest.height()).abs() < 0.5, "not followed");
}

#[test]
fn a_file_that_cannot_be_read_leaves_the_dialog_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let letter = folder.path().join("letter.dichroscope");
    std::fs::write(&letter, "dear all").unwrap();
    let mut window = window();
    open_sample(&mut window, sample::NAME);
    apply(&mut window, Edit::Select(Some(region(2))));
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, &letter);
    window.run_steps(3);
    assert!(says(&window, "letter.dichroscope: "));
    let typed = window.get_by_role_and_label(Role::TextInput, "Path").value();
    assert!(typed.is_some_and(|text| text.ends_with("letter.dichroscope")));
    answer(&mut window, &tiny());
    window.run_steps(3);
    assert!(window.query_by_role(Role::TextInput).is_none());
}

/// Does the first command that has these letters.
fn by_palette(window: &mut Window, letters: &str) {
    press(window, Modifiers::COMMAND, Key::P);
    type_text(window, letters);
    press(window, Modifiers::NONE, Key::Enter);
    window.run_steps(3);
}

#[test]
fn the_color_space_is_colored_turned_and_reset_from_the_palette_and_the_menu() {
    let Some(mut window) = with_gpu(egui::vec2(1440.0, 900.0), Fixture::Tiny) else { return };
    for (letters, color_by) in
        [("color space: color region", ColorBy::Region), ("color space: color density", ColorBy::Density)]
    {
        by_palette(&mut window, letters);
        assert_eq!(state(&window).view.cube.color_by, color_by);
    }
    choose(&mut window, "View", "Color space settings");
    click(&mut window, Role::RadioButton, "Color by class");
    assert_eq!(state(&window).view.cube.color_by, ColorBy::Class);
    by_palette(&mut window, "ghost");
    assert!(!state(&window).view.cube.ghost_rest);
    by_palette(&mut window, "show hsv");
    assert_eq!(state(&window).view.cube.space, ColorSpace::Hsv);
    by_palette(&mut window, "show rgb");
    let home = state(&window).view.camera.clone();
    by_palette(&mut window, "along red");
    assert_ne!(state(&window).view.camera, home);
    by_palette(&mut window, "color space reset");
    assert_eq!(state(&window).view.camera, home);
    by_palette(&mut window, "face-on");
    assert_eq!(state(&window).view.camera, home, "no region is selected");
    assert!(notice(&window).contains("Select a region that has a dichromatic plane"));
}

#[test]
fn the_parameters_are_reset_from_the_palette_and_the_menu() {
    let mut window = tiny_window();
    let defaults = state(&window).document.params;
    for by_menu in [false, true] {
        by_palette(&mut window, "ambient found");
        assert_ne!(state(&window).document.params, defaults);
        if by_menu {
            choose(&mut window, "Analyze", "Reset parameters");
        } else {
            by_palette(&mut window, "reset parameters");
        }
        assert_eq!(state(&window).document.params, defaults);
    }
}

#[test]
fn a_click_beside_the_palette_closes_it() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::P);
    let field =
        |window: &Window| window.query_by_role_and_label(Role::TextInput, "Command").map(|node| node.rect());
    let inside = field(&window).expect("the palette is open").center();
    tap(&mut window, inside);
    assert!(field(&window).is_some(), "a click into the palette is for the palette");
    tap(&mut window, pos2(200.0, 700.0));
    assert!(field(&window).is_none());
    press(&mut window, Modifiers::NONE, Key::Num8);
    assert_eq!(state(&window).view.image.layer, Layer::Body, "keys are commands again");
}

#[test]
fn of_two_keys_that_fit_the_one_with_more_modifiers_is_meant() {
    let mut window = tiny_window();
    let before = state(&window).document.params;
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(3.0), None));
    let changed = state(&window).document.params;
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(state(&window).document.params, before);
    press(&mut window, Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert_eq!(state(&window).document.params, changed);
}

#[test]
fn a_key_without_an_effect_says_why() {
    let mut without_photograph = window();
    press(&mut without_photograph, Modifiers::NONE, Key::K);
    assert!(says(&without_photograph, "there is no result to pin yet"));
    let mut window = tiny_window();
    press(&mut window, Modifiers::NONE, Key::A);
    assert!(says(&window, "no result is pinned: K pins the newest one"));
    press(&mut window, Modifiers::COMMAND, Key::A);
    assert!(says(&window, "select a region first"));
    press(&mut window, Modifiers::NONE, Key::K);
    press(&mut window, Modifiers::NONE, Key::A);
    assert!(state(&window).shows_pinned());
}
