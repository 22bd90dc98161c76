//! Tests of the color space panel on the sample scene: turning, hovering, and marking with tools.

use crate::window::{Fixture, SIZE, Window, apply, named, region, state, with_device, with_gpu};
use dichroscope::app::{Edit, ViewCommand};
use dichroscope::gpu::Orbit;
use dichroscope::gui::Pane;
use dichroscope::gui::testing::{ColorSpaceDrawing, color_space_pixels};
use dichroscope::raster::RegionId;
use dichroscope::trace::Class;
use dichroscope::view::{ColorSpace, CubeSettings, Item, Picture, Tool};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, vec2};
use egui_kittest::kittest::Queryable;
use egui_wgpu::RenderState;
use std::sync::Arc;

/// A window with the sample scene; `None` without a graphics adapter.
fn opened() -> Option<Window> {
    with_gpu(SIZE, Fixture::Sample)
}

fn drawing(harness: &Window) -> ColorSpaceDrawing {
    ColorSpaceDrawing::of(harness.state())
}

fn orbit(harness: &Window) -> Orbit {
    drawing(harness).orbit
}

/// Number of pixels of the panel's image that differ from the background.
fn drawn_pixels(harness: &Window, gpu: &RenderState) -> usize {
    let (_, rgba) = color_space_pixels(harness.state(), gpu).expect("drawn");
    let background: [u8; 4] = rgba[..4].try_into().unwrap();
    rgba.as_chunks::<4>().0.iter().filter(|pixel| **pixel != background).count()
}

fn picture(harness: &Window) -> Arc<Picture> {
    Arc::clone(harness.state().state().picture.as_ref().unwrap())
}

fn canvas(harness: &Window) -> Rect {
    harness.get_by_role_and_label(Role::Canvas, "Color space view").rect()
}

/// Screen position of each bin.
fn places(harness: &Window) -> Vec<Pos2> {
    let (drawing, rect) = (drawing(harness), canvas(harness));
    drawing.bins.iter().map(|&bin| drawing.screen(rect, bin).expect("in view")).collect()
}

fn place_of(harness: &Window, bin: usize) -> Pos2 {
    places(harness)[bin]
}

fn hover(harness: &mut Window, at: Pos2) {
    harness.hover_at(at);
    harness.run_steps(2);
}

#[test]
fn all_colors_near_the_pointer_are_shown_in_the_picture() {
    let Some(mut harness) = opened() else { return };
    let places = places(&harness);
    let near = |bin: usize| places.iter().filter(|place| place.distance(places[bin]) < 6.0).count();
    let crowded = (0..places.len()).max_by_key(|&bin| near(bin)).unwrap();
    assert!(near(crowded) > 3);
    hover(&mut harness, places[crowded]);
    let state = harness.state().state();
    let Some(Item::Bin(bin)) = state.hover else { panic!("a color is hovered") };
    let histogram = &state.picture.as_ref().unwrap().histogram;
    let of_one = histogram.pixels_of(bin);
    assert!(state.hover_pixels.len() > of_one.len());
    assert!(of_one.iter().all(|pixel| state.hover_pixels.contains(pixel)));
    harness.hover_at(egui::pos2(5.0, 5.0));
    harness.run_steps(3);
    assert!(harness.state().state().hover_pixels.is_empty());
}

fn press(harness: &mut Window, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    let button = PointerButton::Primary;
    harness.event_modifiers(Event::PointerButton { pos, button, pressed, modifiers }, modifiers);
    // The button is released soon, because a long press is not a click.
    harness.run_steps(1);
}

fn click(harness: &mut Window, at: Pos2, modifiers: Modifiers) {
    hover(harness, at);
    press(harness, at, true, modifiers);
    press(harness, at, false, modifiers);
}

fn tool(harness: &mut Window, tool: Tool) {
    let mut cube = harness.state().state().view.cube.clone();
    cube.tool = tool;
    harness.state_mut().apply(ViewCommand::Cube(cube));
    harness.run_steps(2);
}

/// The bin that most of a region's pixels are in.
fn fullest_bin(harness: &Window, region: u16) -> usize {
    let drawing = drawing(harness);
    let bins = &picture(harness).histogram.bins;
    let of_region =
        (0..bins.len()).filter(|&bin| drawing.bin_regions[bin].map(RegionId::get) == Some(region));
    of_region.max_by_key(|&bin| bins[bin].count).expect("the region has bins")
}

#[test]
fn the_sample_is_seen_and_fills_the_view() {
    let Some((harness, gpu)) = with_device(SIZE, Fixture::Sample) else { return };
    let ([width, height], _) = color_space_pixels(harness.state(), &gpu).expect("drawn");
    let size = canvas(&harness).size().round();
    assert_eq!([width, height], [size.x as u32, size.y as u32]);
    let drawn = drawn_pixels(&harness, &gpu);
    assert!(drawn > 4000, "{drawn} pixels of points and lines");
    let bins = drawing(&harness).bins.len();
    let view = canvas(&harness).shrink(8.0);
    let inside = places(&harness).into_iter().filter(|at| view.contains(*at));
    assert_eq!(inside.count(), bins, "every point is inside the view");
}

#[test]
fn hovering_a_bin_tells_everybody_and_leaving_it_too() {
    let Some(mut harness) = opened() else { return };
    let bin = fullest_bin(&harness, 1);
    let at = place_of(&harness, bin);
    hover(&mut harness, at);
    let Some(Item::Bin(found)) = harness.state().state().hover else { panic!("a bin is hovered") };
    // Another bin may lie in front.
    assert!(place_of(&harness, found as usize).distance(at) < 8.0);
    let beside = canvas(&harness).right_top() + vec2(-30.0, 12.0);
    hover(&mut harness, beside);
    assert_eq!(harness.state().state().hover, None);
}

#[test]
fn a_click_selects_the_region_and_with_alt_the_color() {
    let Some(mut harness) = opened() else { return };
    let at = place_of(&harness, fullest_bin(&harness, 2));
    hover(&mut harness, at);
    let Some(Item::Bin(bin)) = harness.state().state().hover else { panic!("a bin is hovered") };
    let region = drawing(&harness).bin_regions[bin as usize];
    click(&mut harness, at, Modifiers::NONE);
    assert_eq!(harness.state().state().selected_region(), region);
    assert!(region.is_some());
    let [step_pixels, pale] = drawing(&harness).points;
    assert!(step_pixels > 0 && pale > 0, "the rest is pale, not hidden");
    assert_eq!(step_pixels + pale, drawing(&harness).bins.len());
    harness.run_steps(60);
    click(&mut harness, at, Modifiers::ALT);
    assert_eq!(harness.state().state().document.selection.item, Some(Item::Bin(bin)));
}

#[test]
fn views_have_names() {
    let Some(mut harness) = opened() else { return };
    let forward = |harness: &Window| orbit(harness).right_up_forward()[2];
    harness.get_by_label("Views").click();
    harness.run_steps(3);
    harness.get_by_label_contains("Along blue").click();
    harness.run_steps(3);
    assert!((forward(&harness)[2] + 1.0).abs() < 1e-4, "{:?}", forward(&harness));
    harness.state_mut().apply(Edit::Select(Some(region(1))));
    harness.run_steps(3);
    harness.get_by_label("Views").click();
    harness.run_steps(3);
    harness.get_by_label_contains("Face-on to the plane").click();
    harness.run_steps(3);
    let normal = |harness: &Window, region: usize| {
        let shown = harness.state().state().shown().unwrap().clone();
        shown.analysis.intrinsic.regions[region - 1].plane_normal.unwrap()
    };
    let facing = |harness: &Window, region| {
        let (forward, normal) = (forward(harness), normal(harness, region));
        -(0..3).map(|i| f64::from(forward[i]) * normal[i]).sum::<f64>()
    };
    assert!(facing(&harness, 1) > 0.9999);
    // The view follows the selection until it is locked.
    harness.state_mut().apply(Edit::Select(Some(region(2))));
    harness.run_steps(3);
    assert!(facing(&harness, 2) > 0.9999);
    harness.get_by_label("Lock the view").click();
    harness.run_steps(3);
    harness.state_mut().apply(Edit::Select(Some(region(1))));
    harness.run_steps(3);
    assert!(facing(&harness, 2) > 0.9999);
}

#[test]
fn the_camera_is_kept_in_the_view_and_comes_back_from_there() {
    let Some(mut harness) = opened() else { return };
    harness.run_steps(3);
    let before = harness.state().state().view.camera.clone();
    assert_eq!(serde_json::from_str::<Orbit>(&before).unwrap(), orbit(&harness));
    let mut turned = orbit(&harness);
    turned.orbit([90.0, 20.0]);
    harness.state_mut().apply(ViewCommand::Camera(serde_json::to_string(&turned).unwrap()));
    harness.run_steps(3);
    assert_eq!(orbit(&harness), turned);
    harness.state_mut().apply(ViewCommand::Camera("nonsense".to_owned()));
    harness.run_steps(3);
    assert_eq!(orbit(&harness), turned, "what is no camera moves nothing");
}

#[test]
fn a_drag_orbits_and_home_comes_back() {
    let Some(mut harness) = opened() else { return };
    let home = orbit(&harness);
    let middle = canvas(&harness).center() + vec2(0.0, -20.0);
    hover(&mut harness, middle);
    press(&mut harness, middle, true, Modifiers::NONE);
    hover(&mut harness, middle + vec2(80.0, 10.0));
    press(&mut harness, middle + vec2(80.0, 10.0), false, Modifiers::NONE);
    assert_ne!(orbit(&harness), home);
    assert_eq!(harness.state().state().document.selection.item, None, "a drag is not a click");
    harness.key_press(Key::Home);
    harness.run_steps(2);
    assert_eq!(orbit(&harness), home);
}

#[test]
fn a_lasso_marks_the_pixels_whose_colors_are_inside() {
    let Some(mut harness) = opened() else { return };
    tool(&mut harness, Tool::Lasso);
    let center = place_of(&harness, fullest_bin(&harness, 1));
    let corners: Vec<Pos2> = (0..=24)
        .map(|i| {
            let (y, x) = (std::f32::consts::TAU * i as f32 / 24.0).sin_cos();
            center + vec2(34.0 * x, 26.0 * y)
        })
        .collect();
    hover(&mut harness, corners[0]);
    press(&mut harness, corners[0], true, Modifiers::NONE);
    for &corner in &corners {
        hover(&mut harness, corner);
    }
    press(&mut harness, corners[24], false, Modifiers::NONE);
    let marked = harness.state().state().document.selection.marked.clone().expect("pixels are marked");
    let (picture, places) = (picture(&harness), places(&harness));
    // The lasso follows an ellipse to within one or two screen points.
    let radius = |bin: usize| {
        let off = places[bin] - center;
        vec2(off.x / 34.0, off.y / 26.0).length()
    };
    let pixels_within = |most: f32| {
        let bins = picture.histogram.bins.iter().enumerate();
        bins.filter(|(bin, _)| radius(*bin) < most).map(|(_, bin)| bin.count as usize).sum::<usize>()
    };
    let found = marked.as_slice().iter().filter(|on| **on).count();
    assert!((pixels_within(0.9)..=pixels_within(1.1)).contains(&found), "{found}");
    assert!(found > 100 && found < marked.len() / 2);
    let outside = (0..marked.len())
        .filter(|&pixel| marked[pixel])
        .find(|&pixel| picture.histogram.bin_of(pixel).is_none_or(|bin| radius(bin as usize) > 1.1));
    assert_eq!(outside, None);
    // With Alt, the same outline removes the pixels from the marked ones.
    hover(&mut harness, corners[0]);
    press(&mut harness, corners[0], true, Modifiers::ALT);
    for &corner in &corners {
        hover(&mut harness, corner);
    }
    harness.event_modifiers(Event::PointerMoved(corners[24]), Modifiers::ALT);
    press(&mut harness, corners[24], false, Modifiers::ALT);
    assert_eq!(harness.state().state().document.selection.marked, None);
}

#[test]
fn other_spaces_are_drawn_with_the_shapes_that_they_become() {
    let Some((mut harness, gpu)) = with_device(SIZE, Fixture::Sample) else { return };
    harness.state_mut().apply(Edit::Select(Some(region(1))));
    for space in ColorSpace::ALL {
        let mut cube = harness.state().state().view.cube.clone();
        cube.space = space;
        harness.state_mut().apply(ViewCommand::Cube(cube));
        harness.run_steps(2);
        assert!(drawing(&harness).solids.len() >= 3, "{space:?}: cylinder, dark sphere and slice");
        let drawn = drawn_pixels(&harness, &gpu);
        assert!(drawn > 3000, "{space:?}: {drawn}");
    }
}

#[test]
fn at_rest_every_color_is_drawn_where_that_is_asked_for() {
    let Some(mut harness) = opened() else { return };
    let drawn = |harness: &Window| drawing(harness).points.iter().sum::<usize>();
    let bins = drawn(&harness);
    let mut cube = harness.state().state().view.cube.clone();
    cube.full_detail = true;
    harness.state_mut().apply(ViewCommand::Cube(cube));
    for _ in 0..200 {
        harness.run_steps(1);
        if drawn(&harness) > bins {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    panic!("still {bins} bins");
}

#[test]
fn a_window_shows_its_ellipsoid_around_its_mean() {
    let Some(mut harness) = opened() else { return };
    let shown = Arc::clone(harness.state().state().shown().unwrap());
    let windows = &shown.analysis.windows;
    let plane = |&window: &usize| windows.classes[window] == Some(Class::Plane);
    let window = (0..windows.classes.len()).find(plane).expect("a window of class plane");
    harness.state_mut().apply(Edit::Select(Some(Item::Window(window as u32))));
    harness.run_steps(2);
    let solids = drawing(&harness).solids;
    let [vertices] = solids.as_slice() else { panic!("one solid") };
    let mean = windows.moments[window].mean() / 255.0;
    for axis in 0..3 {
        let ends = vertices.iter().map(|vertex| vertex[axis]);
        let (low, high) = (ends.clone().fold(1.0, f32::min), ends.fold(0.0, f32::max));
        let middle = f64::from(f32::midpoint(low, high));
        assert!((middle - mean[axis]).abs() < 2e-3 && high > low, "{axis}: {low} {high} {}", mean[axis]);
    }
}

#[test]
fn size_opacity_and_depth_plane_change_what_is_drawn_and_are_reset_by_two_clicks() {
    let Some(mut window) = with_gpu(vec2(900.0, 600.0), Fixture::Tiny) else { return };
    window.state_mut().show_alone(Some(Pane::Colors));
    window.run_steps(3);
    let mut pictures = vec![window.render().unwrap().into_raw()];
    for change in [
        CubeSettings { point_scale: 3.0, ..CubeSettings::default() },
        CubeSettings { point_opacity: 0.2, ..CubeSettings::default() },
        CubeSettings { depth_plane: 0.6, ..CubeSettings::default() },
    ] {
        apply(&mut window, ViewCommand::Cube(change));
        window.run_steps(3);
        pictures.push(window.render().unwrap().into_raw());
        assert!(pictures[..pictures.len() - 1].iter().all(|other| other != pictures.last().unwrap()));
    }
    window.get_by_role_and_label(Role::Button, "Show").click();
    window.run_steps(3);
    let slider = named(&window, Role::Slider, "Depth plane").rect().center();
    crate::window::double_click(&mut window, slider);
    assert!(state(&window).view.cube.depth_plane.abs() < 1e-6);
}
