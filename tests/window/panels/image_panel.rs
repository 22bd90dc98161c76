//! Tests of the image panel on the sample scene: layers, clicks, and marking with tools.

use crate::window::{
    Fixture, SIZE, Window, apply, at, named, region, state, tap, tiny_window, with_gpu, zoom_in,
};
use dichroscope::app::{Edit, ViewCommand, ViewSettings};
use dichroscope::gui::testing::Placement;
use dichroscope::raster::PixelIndex;
use dichroscope::view::{
    Arrangement, ArrangementKind, ImageSettings, Item, Layer, Picture, ProfileLine, Tool, marking,
};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchPhase, pos2, vec2};
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

/// A window with the sample scene; `None` without a graphics adapter.
fn opened() -> Option<Window> {
    with_gpu(SIZE, Fixture::Sample)
}

fn view(harness: &Window) -> ViewSettings {
    harness.state().state().view.clone()
}

fn picture(harness: &Window) -> Arc<Picture> {
    Arc::clone(harness.state().state().picture.as_ref().unwrap())
}

fn look(harness: &mut Window, change: impl FnOnce(&mut ImageSettings)) {
    let mut settings = view(harness).image;
    change(&mut settings);
    harness.state_mut().apply(ViewCommand::Image(settings));
    harness.run_steps(3);
}

fn place(harness: &Window) -> Placement {
    let (width, height) = picture(harness).size();
    let rect = harness.get_by_role_and_label(Role::Image, "Picture").rect();
    Placement::new(rect, vec2(width as f32, height as f32), &view(harness).image)
}

/// Screen position of a point of the picture.
fn screen(harness: &Window, x: f32, y: f32) -> Pos2 {
    place(harness).screen_from_image(pos2(x, y))
}

fn press(harness: &mut Window, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    harness.event_modifiers(
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers },
        modifiers,
    );
    harness.run_steps(1);
}

fn move_to(harness: &mut Window, pos: Pos2) {
    harness.hover_at(pos);
    harness.run_steps(1);
}

fn click(harness: &mut Window, pos: Pos2, modifiers: Modifiers) {
    move_to(harness, pos);
    press(harness, pos, true, modifiers);
    press(harness, pos, false, modifiers);
    // Time passes, so that the next click is not the second of a double click.
    harness.run_steps(30);
}

fn drag(harness: &mut Window, points: &[Pos2], modifiers: Modifiers) {
    move_to(harness, points[0]);
    press(harness, points[0], true, modifiers);
    for &point in &points[1..] {
        move_to(harness, point);
    }
    press(harness, points[points.len() - 1], false, modifiers);
    harness.run_steps(2);
}

fn marked(harness: &Window) -> usize {
    let mask = &harness.state().state().document.selection.marked;
    mask.as_ref().map_or(0, |mask| mask.as_slice().iter().filter(|&&on| on).count())
}

/// The middle of a long run of a region's pixels in one row, away from the border.
fn inside(harness: &Window, region: u16) -> PixelIndex {
    let shown = harness.state().state().newest.as_ref().unwrap();
    let labels = shown.labels();
    let width = labels.width();
    let all = |pixel: usize| (pixel - 6..pixel + 7).all(|near| labels[near] == region);
    let found = (6..labels.len() - 6).find(|&pixel| pixel % width > 6 && all(pixel));
    PixelIndex::from_index(found.unwrap())
}

#[test]
fn a_layer_is_chosen_by_name_and_every_layer_is_drawn() {
    let Some(mut harness) = opened() else { return };
    harness.get_by_role_and_label(Role::ComboBox, "Layer").click();
    harness.run_steps(3);
    harness.get_by_label_contains("Classification").click();
    harness.run_steps(3);
    assert_eq!(view(&harness).image.layer, Layer::Classes);
    assert_eq!(view(&harness).image.zoom, None, "looking changes nothing");
    for layer in Layer::ALL {
        for arrangement in [Arrangement::Single, Arrangement::Wipe(0.3), Arrangement::SideBySide] {
            look(&mut harness, |settings| (settings.layer, settings.arrangement) = (layer, arrangement));
        }
    }
    harness.get_by_label(ArrangementKind::Wipe.name()).click();
    harness.run_steps(3);
    assert!(matches!(view(&harness).image.arrangement, Arrangement::Wipe(_)));
}

#[test]
fn scrolling_zooms_at_the_pointer_and_keys_travel() {
    let Some(mut harness) = opened() else { return };
    let pointer = screen(&harness, 300.0, 200.0);
    let under = place(&harness).image_from_screen(pointer);
    let before = place(&harness).zoom;
    move_to(&mut harness, pointer);
    harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, 240.0),
        phase: TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    harness.run_steps(30);
    let after = place(&harness);
    assert!(after.zoom > 2.0 * before, "{} {}", after.zoom, before);
    assert!((after.image_from_screen(pointer) - under).length() < 0.1);
    harness.key_press(Key::Minus);
    harness.run_steps(3);
    assert!((place(&harness).zoom - after.zoom / 1.25).abs() < 1e-3);
    let center = place(&harness).center;
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::ArrowRight);
    harness.run_steps(3);
    assert!(place(&harness).center.x > center.x);
    harness.get_by_label("Fit").click();
    harness.run_steps(3);
    assert_eq!(view(&harness).image.zoom, None);
}

#[test]
fn a_click_selects_a_region_a_pixel_or_nothing() {
    let Some(mut harness) = opened() else { return };
    let pixel = inside(&harness, 2);
    let at = place(&harness).screen_rect_of(place(&harness).square_of(pixel)).center();
    move_to(&mut harness, at);
    harness.run_steps(2);
    assert_eq!(harness.state().state().hover, Some(Item::Pixel(pixel)));
    harness.event(Event::PointerGone);
    harness.run_steps(2);
    assert_eq!(harness.state().state().hover, None, "the pointer has left the window");
    click(&mut harness, at, Modifiers::NONE);
    let item = |harness: &Window| harness.state().state().document.selection.item;
    assert_eq!(item(&harness), Some(region(2)));
    click(&mut harness, at, Modifiers::ALT);
    assert_eq!(item(&harness), Some(Item::Pixel(pixel)));
    look(&mut harness, |settings| settings.layer = Layer::Classes);
    click(&mut harness, at, Modifiers::NONE);
    assert!(matches!(item(&harness), Some(Item::Window(_))), "{:?}", item(&harness));
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(item(&harness), None);
    harness.remove_cursor();
    harness.run_steps(2);
    assert_eq!(harness.state().state().hover, None);
}

#[test]
fn dragging_pans_and_two_clicks_fit() {
    let Some(mut harness) = opened() else { return };
    look(&mut harness, |settings| settings.zoom = Some(3.0));
    let before = place(&harness).center;
    let at = screen(&harness, before.x, before.y);
    drag(&mut harness, &[at, at + vec2(20.0, 0.0), at + vec2(60.0, 30.0)], Modifiers::NONE);
    let moved = before - place(&harness).center;
    assert!((moved - vec2(20.0, 10.0)).length() < 0.1, "{moved:?}");
    move_to(&mut harness, at);
    harness.run_steps(8);
    // All four events are in one frame, because a frame of the harness takes a quarter of a second.
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        harness.input_mut().events.push(Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    harness.run_steps(3);
    assert_eq!(view(&harness).image.zoom, None);
}

#[test]
fn a_rectangle_marks_the_pixels_in_it() {
    let Some(mut harness) = opened() else { return };
    harness.get_by_label("Rectangle").click();
    harness.run_steps(2);
    assert_eq!(view(&harness).image.tool, Tool::Rectangle);
    let corner = |harness: &Window, x, y| screen(harness, x, y);
    let (a, b) = (corner(&harness, 100.2, 80.2), corner(&harness, 150.2, 110.2));
    drag(&mut harness, &[a, a.lerp(b, 0.5), b], Modifiers::NONE);
    assert_eq!(marked(&harness), 50 * 30);
    let (c, d) = (corner(&harness, 200.2, 80.2), corner(&harness, 210.2, 90.2));
    drag(&mut harness, &[c, d], Modifiers::SHIFT);
    assert_eq!(marked(&harness), 50 * 30 + 100);
    let (e, f) = (corner(&harness, 100.2, 80.2), corner(&harness, 110.2, 90.2));
    drag(&mut harness, &[e, f], Modifiers::ALT);
    assert_eq!(marked(&harness), 50 * 30);
    click(&mut harness, c, Modifiers::NONE);
    assert_eq!(marked(&harness), 0);
}

#[test]
fn a_polygon_is_closed_by_enter_and_given_up_by_escape() {
    let Some(mut harness) = opened() else { return };
    look(&mut harness, |settings| settings.tool = Tool::Polygon);
    let corners = [[100.2, 100.2], [160.2, 100.2], [160.2, 140.2], [100.2, 140.2]];
    for [x, y] in corners {
        let at = screen(&harness, x, y);
        click(&mut harness, at, Modifiers::NONE);
    }
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    let expected = marking::outline(picture(&harness).size(), &corners);
    assert_eq!(marked(&harness), expected.as_slice().iter().filter(|&&on| on).count());
    let at = screen(&harness, 30.0, 30.0);
    click(&mut harness, at, Modifiers::NONE);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(marked(&harness), 60 * 40, "Escape gives up the polygon first");
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(marked(&harness), 0);
}

#[test]
fn a_stroke_of_the_brush_is_one_step() {
    let Some(mut harness) = opened() else { return };
    look(&mut harness, |settings| (settings.tool, settings.brush_px) = (Tool::Brush, 5.0));
    let path: Vec<Pos2> = (0..5).map(|i| screen(&harness, 100.0 + 10.0 * i as f32, 100.0)).collect();
    drag(&mut harness, &path, Modifiers::NONE);
    let swept = marked(&harness);
    assert!((430..560).contains(&swept), "{swept}");
    harness.state_mut().apply(Edit::Undo);
    assert_eq!(marked(&harness), 0);
}

#[test]
fn a_profile_line_is_drawn_and_kept_straight() {
    let Some(mut harness) = opened() else { return };
    look(&mut harness, |settings| settings.tool = Tool::Profile);
    let (a, b) = (screen(&harness, 50.0, 60.0), screen(&harness, 200.0, 80.0));
    drag(&mut harness, &[a, b], Modifiers::SHIFT);
    let ProfileLine::Between(from, to) = view(&harness).profile else { panic!("no line") };
    assert!((from[0] - 50.0).abs() < 0.1 && (to[0] - 200.0).abs() < 0.1, "{from:?} {to:?}");
    assert!((from[1] - to[1]).abs() < 1e-6);
}

#[test]
fn the_read_out_tells_the_pixel() {
    let Some(mut harness) = opened() else { return };
    let pixel = inside(&harness, 1);
    harness.state_mut().apply(ViewCommand::Hover(Some(Item::Pixel(pixel))));
    harness.run_steps(2);
    let [x, y] = pixel.position(picture(&harness).size().0);
    let words = format!("x {x}, y {y}, R ");
    assert!(harness.query_by_label_contains(&words).is_some(), "{words}");
}

#[test]
fn a_locked_readout_stays_with_the_selected_pixel() {
    let Some(mut harness) = opened() else { return };
    let [selected, other] = [1, 2].map(|region| inside(&harness, region));
    let width = picture(&harness).size().0;
    let words = |pixel: PixelIndex| {
        let [x, y] = pixel.position(width);
        format!("x {x}, y {y}, R ")
    };
    let at =
        |harness: &Window, pixel| place(harness).screen_rect_of(place(harness).square_of(pixel)).center();
    let place_of_selected = at(&harness, selected);
    click(&mut harness, place_of_selected, Modifiers::ALT);
    harness.key_press(Key::H);
    harness.run_steps(2);
    assert!(view(&harness).image.readout_locked);
    let place_of_other = at(&harness, other);
    move_to(&mut harness, place_of_other);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains(&words(selected)).is_some(), "the selected pixel is read");
    assert_eq!(harness.state().state().hover, None);
    harness.get_by_label("Lock the readout").click();
    harness.run_steps(2);
    move_to(&mut harness, place_of_other);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains(&words(other)).is_some(), "the pointer is followed again");
}

#[test]
fn a_tap_within_a_frame_is_a_gesture_of_the_tool() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let place = at(&window, 60.5, 75.5);
    let choose = |window: &mut Window, tool: Tool| {
        let image = ImageSettings { tool, ..view(window).image };
        apply(window, ViewCommand::Image(image));
    };
    choose(&mut window, Tool::Brush);
    tap(&mut window, place);
    assert!(marked(&window) > 0, "a dab of the brush");
    choose(&mut window, Tool::Rectangle);
    tap(&mut window, place);
    assert_eq!(marked(&window), 0, "a click with a marking tool ends the marks");
    let before = state(&window).document.params.illuminant;
    choose(&mut window, Tool::WhitePatch);
    tap(&mut window, place);
    assert_ne!(state(&window).document.params.illuminant, before, "{:?}", state(&window).notices);
}

#[test]
fn every_tool_is_in_view_in_a_small_window() {
    let mut window = tiny_window();
    for (height, tool) in [(600.0, Tool::Pointer), (560.0, Tool::Brush), (900.0, Tool::Brush)] {
        window.set_size(vec2(900.0, height));
        let image = ImageSettings { tool, ..view(&window).image };
        apply(&mut window, ViewCommand::Image(image));
        window.run_steps(3);
        let picture = named(&window, Role::Image, "Picture").rect();
        for name in ["Pointer", "Rectangle", "Lasso", "Polygon", "Brush", "Profile line", "White patch"] {
            let rect = window.get_by_role_and_label(Role::Button, name).rect();
            assert!(rect.top() >= picture.top() && rect.bottom() <= picture.bottom(), "{name} at {height}");
            assert!(rect.right() <= picture.left(), "{name} is no part of the picture");
        }
    }
}
