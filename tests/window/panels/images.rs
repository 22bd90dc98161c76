//! Tests of the image panel on the small photograph: layers, marked pixels, and the area that an analysis
//! is restricted to.

use crate::window::{
    apply, at, click, drag, marked, named, press, says, shown, size, state, tiny_window, undo, zoom_in,
};
use dichroscope::app::{Command, DebugCommand, Edit};
use dichroscope::raster::{PixelIndex, RegionId};
use dichroscope::view::{Arrangement, Fill, Item, Layer, Tool};
use egui::accesskit::Role;
use egui::{Key, Modifiers};

#[test]
fn layers_are_chosen_by_key() {
    let mut window = tiny_window();
    for (key, layer) in [
        (Key::Num2, Layer::Masks),
        (Key::Num3, Layer::Classes),
        (Key::Num4, Layer::Areas),
        (Key::Num5, Layer::Linear),
        (Key::Num6, Layer::Planar),
        (Key::Num7, Layer::Regions),
        (Key::Num8, Layer::Body),
        (Key::Num9, Layer::Surface),
        (Key::Num0, Layer::Noise),
        (Key::Num1, Layer::Input),
    ] {
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(state(&window).view.image.layer, layer);
    }
    assert!(!state(&window).history.can_undo(), "looking is no step");
}

#[test]
fn layers_are_chosen_by_name_one_or_two_of_them() {
    let mut window = tiny_window();
    for (name, layer) in [("Merged areas", Layer::Areas), ("Surface", Layer::Surface)] {
        click(&mut window, Role::ComboBox, "Layer");
        click(&mut window, Role::Button, name);
        assert_eq!(state(&window).view.image.layer, layer);
    }
    click(&mut window, Role::Button, "Side by side");
    assert_eq!(state(&window).view.image.arrangement, Arrangement::SideBySide);
    named(&window, Role::Image, "Second picture");
    click(&mut window, Role::ComboBox, "Second layer");
    click(&mut window, Role::Button, "Classification");
    assert_eq!(state(&window).view.image.other, Layer::Classes);
    click(&mut window, Role::Button, "Wipe");
    assert_eq!(state(&window).view.image.arrangement, Arrangement::Wipe(0.5));
    let line = named(&window, Role::Slider, "Wipe line").rect().center();
    drag(&mut window, &[line, line + egui::vec2(20.0, 0.0), line + egui::vec2(60.0, 0.0)], Modifiers::NONE);
    let Arrangement::Wipe(share) = state(&window).view.image.arrangement else { panic!("still a wipe") };
    assert!(share > 0.55, "{share}");
    press(&mut window, Modifiers::NONE, Key::O);
    assert_eq!(state(&window).view.image.fill, Fill::Outline);
}

#[test]
fn a_rectangle_is_marked_inverted_analyzed_alone_and_all_of_it_taken_back() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    press(&mut window, Modifiers::NONE, Key::R);
    assert_eq!(state(&window).view.image.tool, Tool::Rectangle);
    let (from, to) = (at(&window, 40.2, 30.2), at(&window, 100.2, 90.2));
    drag(&mut window, &[from, from.lerp(to, 0.5), to], Modifiers::NONE);
    assert_eq!(marked(&window), 60 * 60);
    let (width, height) = size(&window);
    press(&mut window, Modifiers::COMMAND, Key::I);
    assert_eq!(marked(&window), width * height - 60 * 60);
    // The button lies below the sliders, at the lower end of the panel.
    named(&window, Role::Button, "To marked").scroll_to_me();
    window.run_steps(20);
    click(&mut window, Role::Button, "To marked");
    let area = state(&window).document.area.clone().unwrap();
    assert!(state(&window).is_current());
    let restricted = shown(&window);
    let labels = restricted.labels();
    assert!((0..labels.len()).all(|pixel| area[pixel] || labels[pixel] == 0));
    assert!(!area.get(70, 60).unwrap() && *area.get(10, 10).unwrap());
    named(&window, Role::Button, "Lift").scroll_to_me();
    window.run_steps(20);
    click(&mut window, Role::Button, "Lift");
    assert!(state(&window).document.area.is_none());
    undo(&mut window);
    assert!(state(&window).document.area.is_some());
    for _ in 0..3 {
        undo(&mut window);
    }
    assert!(state(&window).document.area.is_none() && marked(&window) == 0);
    assert!(state(&window).is_current() && !state(&window).history.can_undo());
}

#[test]
fn marks_of_the_image_show_in_the_statistics() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    click(&mut window, Role::Button, "Selection");
    click(&mut window, Role::Button, "Lasso");
    let corners = [[60.2, 40.2], [100.2, 40.2], [100.2, 80.2], [60.2, 80.2], [60.2, 40.2]];
    let path: Vec<_> = corners.iter().map(|&[x, y]| at(&window, x, y)).collect();
    drag(&mut window, &path, Modifiers::NONE);
    assert_eq!(marked(&window), 1600);
    assert!(says(&window, "Marked pixels") && says(&window, "1\u{2009}600"));
    click(&mut window, Role::Button, "Invert");
    let (width, height) = size(&window);
    assert_eq!(marked(&window), width * height - 1600);
    click(&mut window, Role::Button, "Deselect");
    assert_eq!(marked(&window), 0);
}

#[test]
fn the_statistics_are_those_of_the_cursor() {
    let mut window = tiny_window();
    click(&mut window, Role::Button, "Selection");
    apply(&mut window, Edit::Select(Some(Item::Region(RegionId::from_index(0)))));
    assert!(says(&window, "regions 1: 100.0 %"));
    apply(&mut window, Command::Debug(DebugCommand::Seek(0)));
    assert!(says(&window, "No pixel of the picture is in it so far."));
    let steps = state(&window).debugger.trace().unwrap().len();
    apply(&mut window, Command::Debug(DebugCommand::Seek(steps - 1)));
    assert!(says(&window, "hypotheses ") && !says(&window, "regions 1"));
    let pixel = (0..shown(&window).labels().len()).find(|&pixel| shown(&window).labels()[pixel] == 1);
    let pixel = Item::Pixel(PixelIndex::from_index(pixel.unwrap()));
    apply(&mut window, Edit::Select(Some(pixel)));
    assert!(says(&window, "hypotheses ") && !says(&window, "none: "));
    apply(&mut window, Command::Debug(DebugCommand::Seek(0)));
    assert!(says(&window, "hypotheses none: 100.0 %"), "its color is known, its owner is not");
}

#[test]
fn the_selected_region_is_marked_by_key() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::NONE, Key::CloseBracket);
    press(&mut window, Modifiers::COMMAND, Key::A);
    assert_eq!(marked(&window), shown(&window).analysis.intrinsic.regions[0].pixels);
}

#[test]
fn a_white_patch_pins_the_light() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = crate::window::inside(&window, 1);
    click(&mut window, Role::Button, "White patch");
    let (x, y) = (x as f32, y as f32);
    let (from, to) = (at(&window, x - 1.8, y - 1.8), at(&window, x + 2.2, y + 2.2));
    drag(&mut window, &[from, to], Modifiers::NONE);
    let light = state(&window).document.params.illuminant.direction().unwrap();
    let body = shown(&window).analysis.intrinsic.regions[0].body;
    let cosine = |light: [f64; 3]| light.iter().zip(body).map(|(a, b)| a * b).sum::<f64>();
    assert!(cosine(light) > 0.95, "the mean of a matte patch lies near its body color: {light:?}, {body:?}");
    undo(&mut window);
    assert_eq!(state(&window).document.params.illuminant.direction(), None);
    let center = at(&window, x + 0.5, y + 0.5);
    drag(&mut window, &[center, center], Modifiers::NONE);
    let clicked = state(&window).document.params.illuminant.direction().unwrap();
    assert!(cosine(clicked) > 0.95, "a click takes the patch around its pixel: {clicked:?}");
}
