//! The panel in a harness: opened, turned, pointed at, drawn in.

use super::CubePanel;
use crate::app::Command;
use crate::gpu::{Point, Projector};
use crate::gui::App;
use crate::gui::testing::{harness, open_sample};
use crate::trace::Class;
use crate::view::{ColorSpace, Item, Picture, Tool};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use egui_wgpu::RenderState;
use std::sync::Arc;

fn opened() -> Option<(Harness<'static, App>, RenderState)> {
    let (mut harness, gpu) = harness()?;
    open_sample(&mut harness);
    Some((harness, gpu))
}

fn panel<'a>(harness: &'a Harness<'_, App>) -> &'a CubePanel {
    &harness.state().panels().cube
}

fn picture(harness: &Harness<App>) -> Arc<Picture> {
    Arc::clone(harness.state().state().picture.as_ref().unwrap())
}

fn canvas(harness: &Harness<App>) -> Rect {
    harness.get_by_role_and_label(Role::Canvas, "Color space view").rect()
}

fn projector(harness: &Harness<App>) -> Projector {
    panel(harness).camera_controller.orbit.projector(canvas(harness).size().into())
}

/// Where each bin is seen.
fn places(harness: &Harness<App>) -> Vec<Pos2> {
    let (projector, rect) = (projector(harness), canvas(harness));
    let place = |bin: &Point| super::frame::screen(&projector, rect, bin.position).expect("in view");
    panel(harness).cloud.bins.iter().map(place).collect()
}

fn place_of(harness: &Harness<App>, bin: usize) -> Pos2 {
    places(harness)[bin]
}

fn hover(harness: &mut Harness<App>, at: Pos2) {
    harness.hover_at(at);
    harness.run_steps(2);
}

fn press(harness: &mut Harness<App>, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    let button = PointerButton::Primary;
    harness.event_modifiers(Event::PointerButton { pos, button, pressed, modifiers }, modifiers);
    // Held for long it would be no click.
    harness.run_steps(1);
}

fn click(harness: &mut Harness<App>, at: Pos2, modifiers: Modifiers) {
    hover(harness, at);
    press(harness, at, true, modifiers);
    press(harness, at, false, modifiers);
}

fn tool(harness: &mut Harness<App>, tool: Tool) {
    let mut cube = harness.state().state().view.cube.clone();
    cube.tool = tool;
    harness.state_mut().apply(Command::Cube(cube));
    harness.run_steps(2);
}

/// The bin that most of a region's pixels are in.
fn fullest_bin(harness: &Harness<App>, region: u16) -> usize {
    let cloud = &panel(harness).cloud;
    let bins = &picture(harness).histogram.bins;
    let of_region = (0..bins.len()).filter(|&bin| cloud.region_of(bin as u32) == Some(region));
    of_region.max_by_key(|&bin| bins[bin].count).expect("the region has bins")
}

#[test]
fn the_sample_is_seen_and_fills_the_view() {
    let Some((harness, gpu)) = opened() else { return };
    let ([width, height], rgba) = panel(&harness).canvas.read_back(&gpu).expect("drawn");
    let size = canvas(&harness).size().round();
    assert_eq!([width, height], [size.x as u32, size.y as u32]);
    let background: [u8; 4] = rgba[..4].try_into().unwrap();
    let drawn = rgba.as_chunks::<4>().0.iter().filter(|pixel| **pixel != background).count();
    assert!(drawn > 4000, "{drawn} pixels of points and lines");
    let bins = panel(&harness).cloud.bins.len();
    let view = canvas(&harness).shrink(8.0);
    let inside = places(&harness).into_iter().filter(|at| view.contains(*at));
    assert_eq!(inside.count(), bins, "every point is inside the view");
}

#[test]
fn hovering_a_bin_tells_everybody_and_leaving_it_too() {
    let Some((mut harness, _)) = opened() else { return };
    let bin = fullest_bin(&harness, 1);
    let at = place_of(&harness, bin);
    hover(&mut harness, at);
    let Some(Item::Bin(found)) = harness.state().state().hover else { panic!("a bin is hovered") };
    // Another one may lie in front.
    assert!(place_of(&harness, found as usize).distance(at) < 8.0);
    let beside = canvas(&harness).right_top() + vec2(-30.0, 12.0);
    hover(&mut harness, beside);
    assert_eq!(harness.state().state().hover, None);
}

#[test]
fn a_click_selects_the_region_and_with_alt_the_color() {
    let Some((mut harness, _)) = opened() else { return };
    let at = place_of(&harness, fullest_bin(&harness, 2));
    hover(&mut harness, at);
    let Some(Item::Bin(bin)) = harness.state().state().hover else { panic!("a bin is hovered") };
    let region = panel(&harness).cloud.region_of(bin);
    click(&mut harness, at, Modifiers::NONE);
    assert_eq!(harness.state().state().selected_region(), region);
    assert!(region.is_some());
    let [looked_at, ghosts] = &panel(&harness).cloud.drawn;
    assert!(!looked_at.is_empty() && !ghosts.is_empty(), "the rest is ghosted, not hidden");
    assert_eq!(looked_at.len() + ghosts.len(), panel(&harness).cloud.bins.len());
    harness.run_steps(60);
    click(&mut harness, at, Modifiers::ALT);
    assert_eq!(harness.state().state().document.selection.item, Some(Item::Bin(bin)));
}

#[test]
fn views_have_names() {
    let Some((mut harness, _)) = opened() else { return };
    let forward = |harness: &Harness<App>| panel(harness).camera_controller.orbit.right_up_forward()[2];
    harness.get_by_label("Views").click();
    harness.run_steps(3);
    harness.get_by_label_contains("Along blue").click();
    harness.run_steps(3);
    assert!((forward(&harness)[2] + 1.0).abs() < 1e-4, "{:?}", forward(&harness));
    harness.state_mut().apply(Command::Select(Some(Item::Region(1))));
    harness.run_steps(3);
    harness.get_by_label("Views").click();
    harness.run_steps(3);
    harness.get_by_label_contains("Face-on to the plane").click();
    harness.run_steps(3);
    let normal = |harness: &Harness<App>, region: usize| {
        let shown = harness.state().state().shown().unwrap().clone();
        shown.analysis.intrinsic.regions[region - 1].plane_normal.unwrap()
    };
    let facing = |harness: &Harness<App>, region| {
        let (forward, normal) = (forward(harness), normal(harness, region));
        -(0..3).map(|i| f64::from(forward[i]) * normal[i]).sum::<f64>()
    };
    assert!(facing(&harness, 1) > 0.9999);
    // The view goes with the selection, until it is locked.
    harness.state_mut().apply(Command::Select(Some(Item::Region(2))));
    harness.run_steps(3);
    assert!(facing(&harness, 2) > 0.9999);
    harness.get_by_label("Lock the view").click();
    harness.run_steps(3);
    harness.state_mut().apply(Command::Select(Some(Item::Region(1))));
    harness.run_steps(3);
    assert!(facing(&harness, 2) > 0.9999);
}

#[test]
fn the_camera_is_kept_in_the_view_and_comes_back_from_there() {
    let Some((mut harness, _)) = opened() else { return };
    harness.run_steps(3);
    let before = harness.state().state().view.camera.clone();
    assert_eq!(
        serde_json::from_str::<crate::gpu::Orbit>(&before).unwrap(),
        panel(&harness).camera_controller.orbit
    );
    let mut turned = panel(&harness).camera_controller.orbit;
    turned.orbit([90.0, 20.0]);
    harness.state_mut().apply(Command::Camera(serde_json::to_string(&turned).unwrap()));
    harness.run_steps(3);
    assert_eq!(panel(&harness).camera_controller.orbit, turned);
    harness.state_mut().apply(Command::Camera("nonsense".to_owned()));
    harness.run_steps(3);
    assert_eq!(panel(&harness).camera_controller.orbit, turned, "what is no camera moves nothing");
}

#[test]
fn a_drag_orbits_and_home_comes_back() {
    let Some((mut harness, _)) = opened() else { return };
    let home = panel(&harness).camera_controller.orbit;
    let middle = canvas(&harness).center() + vec2(0.0, -20.0);
    hover(&mut harness, middle);
    press(&mut harness, middle, true, Modifiers::NONE);
    hover(&mut harness, middle + vec2(80.0, 10.0));
    press(&mut harness, middle + vec2(80.0, 10.0), false, Modifiers::NONE);
    assert_ne!(panel(&harness).camera_controller.orbit, home);
    assert_eq!(harness.state().state().document.selection.item, None, "a drag is not a click");
    harness.key_press(Key::Home);
    harness.run_steps(2);
    assert_eq!(panel(&harness).camera_controller.orbit, home);
}

#[test]
fn a_lasso_marks_the_pixels_whose_colors_are_inside() {
    let Some((mut harness, _)) = opened() else { return };
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
    // An ellipse that the lasso follows to a point or two.
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
    // With Alt the same outline takes its pixels away again.
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
    let Some((mut harness, gpu)) = opened() else { return };
    harness.state_mut().apply(Command::Select(Some(Item::Region(1))));
    for space in ColorSpace::ALL {
        let mut cube = harness.state().state().view.cube.clone();
        cube.space = space;
        harness.state_mut().apply(Command::Cube(cube));
        harness.run_steps(2);
        let figure = &panel(&harness).figure;
        assert!(figure.meshes.len() >= 3, "{space:?}: cylinder, dark sphere and slice");
        let (_, rgba) = panel(&harness).canvas.read_back(&gpu).expect("drawn");
        let background: [u8; 4] = rgba[..4].try_into().unwrap();
        let drawn = rgba.as_chunks::<4>().0.iter().filter(|pixel| **pixel != background).count();
        assert!(drawn > 3000, "{space:?}: {drawn}");
    }
}

#[test]
fn at_rest_every_color_is_drawn_where_that_is_asked_for() {
    let Some((mut harness, _)) = opened() else { return };
    let drawn =
        |harness: &Harness<App>| panel(harness).cloud.drawn.iter().map(|batch| batch.len()).sum::<usize>();
    let bins = drawn(&harness);
    let mut cube = harness.state().state().view.cube.clone();
    cube.full_detail = true;
    harness.state_mut().apply(Command::Cube(cube));
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
    let Some((mut harness, _)) = opened() else { return };
    let shown = Arc::clone(harness.state().state().shown().unwrap());
    let windows = &shown.analysis.windows;
    let plane = |&window: &usize| windows.classes[window] == Some(Class::Plane);
    let window = (0..windows.classes.len()).find(plane).expect("a window of class plane");
    harness.state_mut().apply(Command::Select(Some(Item::Window(window as u32))));
    harness.run_steps(2);
    let [ellipsoid] = panel(&harness).figure.meshes.as_slice() else { panic!("one body") };
    let vertices = ellipsoid.triangles();
    let mean = windows.moments[window].mean() / 255.0;
    for axis in 0..3 {
        let ends = vertices.iter().map(|vertex| vertex.position[axis]);
        let (low, high) = (ends.clone().fold(1.0, f32::min), ends.fold(0.0, f32::max));
        let middle = f64::from(f32::midpoint(low, high));
        assert!((middle - mean[axis]).abs() < 2e-3 && high > low, "{axis}: {low} {high} {}", mean[axis]);
    }
}
