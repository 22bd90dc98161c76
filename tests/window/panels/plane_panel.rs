//! Tests of the plane panel on the sample scene.

use crate::window::{
    Fixture, SIZE, Window, apply, click, drag, item, marked, named, region, shown, tiny_window, undo,
    with_gpu,
};
use dichroscope::app::{Command, DebugCommand, Edit};
use dichroscope::gui::Pane;
use dichroscope::gui::testing::PlaneDrawing;
use dichroscope::view::Item;
use egui::accesskit::Role;
use egui::{Event, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable;

/// A window with the sample scene; `None` without a graphics adapter.
fn opened() -> Option<Window> {
    with_gpu(SIZE, Fixture::Sample)
}

#[test]
fn a_region_is_asked_for_and_shown() {
    let Some(mut harness) = opened() else { return };
    harness.get_by_label("Select a region to see its dichromatic plane.");
    harness.state_mut().apply(Edit::Select(Some(region(1))));
    harness.run_steps(3);
    let rect = harness.get_by_role_and_label(Role::Canvas, "Dichromatic plane of region 1").rect();
    let drawing = PlaneDrawing::of(harness.state()).unwrap();
    let plane = &drawing.plane;
    assert!(plane.has_plane && !plane.points.is_empty());
    let places = plane.points.iter().map(|point| drawing.screen([point.body, point.surface], rect));
    assert!(places.into_iter().all(|at| rect.contains(at)), "all points are inside the view");
    // The angle between matte and highlight line (figure 2) is the same on the screen as in color space.
    let [start, end] = plane.highlight_lines().next().unwrap().map(|amounts| drawing.screen(amounts, rect));
    let seen_deg = (start.y - end.y).atan2(end.x - start.x).to_degrees();
    assert!((seen_deg - plane.angle_deg).abs() < 0.1, "{seen_deg} {}", plane.angle_deg);
}

#[test]
fn the_plane_stays_fitted_until_a_person_pans() {
    let Some(mut harness) = opened() else { return };
    let trace = harness.state().state().debugger.trace().unwrap().clone();
    let block = trace.blocks().find(|block| block.steps.len() > 200).expect("a hypothesis grows");
    let all_are_inside = |harness: &Window| {
        let canvas = harness
            .query_all_by_role(Role::Canvas)
            .find(|node| crate::window::words(node).is_some_and(|name| name.contains("of hypothesis")));
        let rect = canvas.expect("the plane is shown").rect();
        let drawing = PlaneDrawing::of(harness.state()).unwrap();
        let at = |point: &dichroscope::view::PlanePixel| drawing.screen([point.body, point.surface], rect);
        assert!(!drawing.plane.points.is_empty());
        drawing.plane.points.iter().all(|point| rect.contains(at(point)))
    };
    for share in [0.02, 0.3, 0.99] {
        let n = block.steps.start + (block.steps.len() as f64 * share) as usize;
        harness.state_mut().apply(Command::Debug(DebugCommand::Seek(n)));
        harness.run_steps(3);
        assert!(all_are_inside(&harness), "after {share} of the growth");
    }
}

#[test]
fn hovering_a_point_hovers_its_pixel_and_a_drag_pans() {
    let Some(mut harness) = opened() else { return };
    harness.state_mut().apply(Edit::Select(Some(region(1))));
    harness.run_steps(3);
    let rect = harness.get_by_role_and_label(Role::Canvas, "Dichromatic plane of region 1").rect();
    let drawing = PlaneDrawing::of(harness.state()).unwrap();
    let plane = &drawing.plane;
    let at = drawing.screen([0.5 * plane.matte_length, 0.0], rect);
    harness.hover_at(at);
    harness.run_steps(2);
    let Some(Item::Pixel(pixel)) = harness.state().state().hover else { panic!("a pixel is hovered") };
    let shown = harness.state().state().shown().unwrap().clone();
    assert_eq!(shown.labels()[pixel.index()], 1);
    let amounts = plane.amounts(shown.picture.photo.image.pixels[pixel.index()]);
    assert!((amounts.body - 0.5 * plane.matte_length).abs() < 8.0, "{amounts:?}");
    for (to, pressed) in [(at, true), (at + vec2(30.0, 12.0), true), (at + vec2(30.0, 12.0), false)] {
        harness.hover_at(to);
        let button = PointerButton::Primary;
        if to == at || !pressed {
            harness.event(Event::PointerButton { pos: to, button, pressed, modifiers: Modifiers::NONE });
        }
        harness.run_steps(2);
    }
    let moved = PlaneDrawing::of(harness.state()).unwrap();
    assert!((moved.center[0] - drawing.center[0] + 30.0 * drawing.counts_per_pt).abs() < 0.5);
    assert!((moved.center[1] - drawing.center[1] - 12.0 * drawing.counts_per_pt).abs() < 0.5);
}

#[test]
fn a_lasso_in_the_plane_marks_pixels_of_the_region_and_a_click_selects_none() {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    window.state_mut().show_alone(Some(Pane::Plane));
    window.run_steps(3);
    click(&mut window, Role::Button, "Plane: lasso");
    let canvas = named(&window, Role::Canvas, "Dichromatic plane of region 1").rect();
    let corner = |x, y| canvas.lerp_inside(egui::vec2(x, y));
    let around = [corner(0.02, 0.02), corner(0.98, 0.02), corner(0.98, 0.98), corner(0.02, 0.98)];
    drag(&mut window, &around, Modifiers::NONE);
    let all = marked(&window);
    let pixels = shown(&window).analysis.intrinsic.regions[0].pixels;
    assert!(all > pixels / 2 && all <= pixels, "{all} of {pixels}");
    let half = [corner(0.02, 0.02), corner(0.5, 0.02), corner(0.5, 0.98), corner(0.02, 0.98)];
    drag(&mut window, &half, Modifiers::ALT);
    assert!(marked(&window) < all, "Alt takes away");
    assert_eq!(item(&window), Some(region(1)), "a drag selects nothing");
    undo(&mut window);
    assert_eq!(marked(&window), all);
    click(&mut window, Role::Button, "Plane: pointer");
}
