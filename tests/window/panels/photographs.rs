//! Tests of several open photographs: opened, switched by keys and menu, compared, closed.

use crate::window::{
    apply, choose, click, named, open_sample, press, region, says, sigma, state, tiny_window,
};
use dichroscope::app::{Edit, JobCommand, ViewCommand};
use dichroscope::params::{Parameter, Setting};
use dichroscope::truth::sample;
use dichroscope::view::{Arrangement, Item, Layer, Origin};
use egui::accesskit::Role;
use egui::{Key, Modifiers};

fn name(window: &crate::window::Window) -> String {
    state(window).picture.as_ref().unwrap().origin.name()
}

#[test]
fn photographs_stay_open_and_keys_go_from_one_to_the_other_and_back() {
    let mut window = tiny_window();
    let first = name(&window);
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(3.0), None));
    apply(&mut window, Edit::Select(Some(region(2))));
    open_sample(&mut window, sample::NAME);
    assert_eq!((name(&window).as_str(), state(&window).others.len()), (sample::NAME, 1));
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(5.0), None));
    press(&mut window, Modifiers::CTRL, Key::Tab);
    assert_eq!((name(&window), sigma(&window)), (first.clone(), Setting::Value(3.0)));
    assert_eq!(state(&window).document.selection.item, Some(region(2)), "its selection is back");
    assert!(state(&window).is_current() && state(&window).history.can_undo(), "and its result and history");
    press(&mut window, Modifiers::COMMAND, Key::PageUp);
    assert_eq!((name(&window).as_str(), sigma(&window)), (sample::NAME, Setting::Value(5.0)));
    press(&mut window, Modifiers::CTRL.plus(Modifiers::SHIFT), Key::Tab);
    assert_eq!(name(&window), first);
    press(&mut window, Modifiers::COMMAND, Key::W);
    click(&mut window, Role::Button, "Close without saving");
    assert_eq!((name(&window).as_str(), state(&window).others.len()), (sample::NAME, 0));
    press(&mut window, Modifiers::COMMAND, Key::W);
    assert_eq!(name(&window), sample::NAME, "the only one stays");
}

#[test]
fn the_three_lamps_are_opened_together_from_the_menu() {
    let mut window = tiny_window();
    choose(&mut window, "File", "Sample scenes");
    click(&mut window, Role::Button, sample::THREE_LAMPS.name);
    for lamp in sample::THREE_LAMPS.scenes {
        assert_eq!((name(&window).as_str(), state(&window).others.len()), (*lamp, 3));
        // The photograph that was open before comes between the last lamp and the first.
        press(&mut window, Modifiers::CTRL, Key::Tab);
        if name(&window) == "camera8.png" {
            press(&mut window, Modifiers::CTRL, Key::Tab);
        }
    }
}

#[test]
fn a_photograph_that_is_opened_again_is_open_once_and_two_are_compared_beside() {
    let mut window = tiny_window();
    let origin = state(&window).picture.as_ref().unwrap().origin.clone();
    open_sample(&mut window, sample::NAME);
    apply(&mut window, JobCommand::Open(origin.clone()));
    assert_eq!(state(&window).others.len(), 1, "the first is shown again and not twice open");
    let copy = std::fs::read(origin.path().unwrap()).unwrap();
    apply(&mut window, JobCommand::Open(Origin::Bytes { name: "copy.png".into(), bytes: copy.into() }));
    press(&mut window, Modifiers::CTRL, Key::Tab);
    assert_eq!(name(&window), sample::NAME);
    press(&mut window, Modifiers::COMMAND, Key::W);
    assert_eq!(name(&window), origin.name(), "the next one in the circle");
    press(&mut window, Modifiers::COMMAND, Key::D);
    assert_eq!(state(&window).view.image.arrangement, Arrangement::SideBySide);
    assert!(says(&window, "Layer shown: copy.png: "), "the second view shows the other photograph");
    press(&mut window, Modifiers::COMMAND, Key::D);
    assert!(!says(&window, "Layer shown: copy.png: "));
}

#[test]
fn the_views_are_as_before_when_two_photographs_are_compared_no_more() {
    let mut window = tiny_window();
    open_sample(&mut window, sample::NAME);
    let mut image = state(&window).view.image.clone();
    for arrangement in [Arrangement::Wipe(0.5), Arrangement::Single, Arrangement::SideBySide] {
        (image.arrangement, image.layer, image.other) = (arrangement, Layer::Input, Layer::Body);
        apply(&mut window, ViewCommand::Image(image.clone()));
        let arranged = |window: &crate::window::Window| {
            let image = &state(window).view.image;
            (image.arrangement, image.layer, image.other)
        };
        let before = arranged(&window);
        press(&mut window, Modifiers::COMMAND, Key::D);
        assert_ne!(arranged(&window), before);
        press(&mut window, Modifiers::COMMAND, Key::D);
        assert_eq!(arranged(&window), before);
    }
    let before = state(&window).view.image.other;
    press(&mut window, Modifiers::COMMAND, Key::D);
    press(&mut window, Modifiers::COMMAND, Key::W);
    assert!(!state(&window).compares_photographs, "there is no other photograph");
    assert_eq!(state(&window).view.image.other, before);
    let before = state(&window).view.image.clone();
    press(&mut window, Modifiers::COMMAND, Key::D);
    assert!(says(&window, "there is no second photograph to compare with"));
    assert_eq!(state(&window).view.image, before);
}

#[test]
fn two_photographs_of_different_sizes_are_compared_beside_with_linked_zoom() {
    let mut window = tiny_window();
    let (width, height) = state(&window).picture.as_ref().unwrap().size();
    open_sample(&mut window, sample::NAME);
    assert_ne!(state(&window).picture.as_ref().unwrap().size(), (width, height));
    window.set_size(egui::vec2(1280.0, 900.0));
    press(&mut window, Modifiers::COMMAND, Key::D);
    window.run_steps(3);
    assert!(says(&window, "Layer shown: "), "both views have names");
    let [first, second] = ["Picture", "Second picture"].map(|name| named(&window, Role::Image, name).rect());
    assert!(first.width() > 100.0 && second.width() > 100.0);
    window.hover_at(second.center());
    window.run_steps(2);
    let hovered = state(&window).hover;
    let size = state(&window).picture.as_ref().unwrap().size();
    let Some(Item::Pixel(pixel)) = hovered else { panic!("{hovered:?}") };
    let [x, y] = pixel.position(size.0).map(|place| place as f32);
    assert!(
        (x / size.0 as f32 - 0.5).abs() < 0.02 && (y / size.1 as f32 - 0.5).abs() < 0.02,
        "{x} {y} of {size:?}"
    );
    window.drag_at(second.center());
    window.run_steps(1);
    window.hover_at(second.center() + egui::vec2(20.0, 10.0));
    window.run_steps(1);
    window.drop_at(second.center() + egui::vec2(20.0, 10.0));
    window.run_steps(2);
    let image = &state(&window).view.image;
    assert!(image.zoom.is_some() && image.center_px.is_some(), "the first view is panned too");
    let [center_x, _] = image.center_px.unwrap();
    assert!(center_x < size.0 as f32 / 2.0, "the picture went to the right: {center_x}");
}
