//! The panel in a harness.

use crate::app::Command;
use crate::gui::App;
use crate::gui::testing::{harness, open_sample};
use crate::view::Item;
use egui::accesskit::Role;
use egui::{Event, Modifiers, PointerButton, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

fn opened() -> Option<Harness<'static, App>> {
    let (mut harness, _) = harness()?;
    open_sample(&mut harness);
    Some(harness)
}

#[test]
fn a_region_is_asked_for_and_shown() {
    let Some(mut harness) = opened() else { return };
    harness.get_by_label("Select a region to see its dichromatic plane.");
    harness.state_mut().apply(Command::Select(Some(Item::Region(1))));
    harness.run_steps(3);
    let rect = harness.get_by_role_and_label(Role::Canvas, "Dichromatic plane of region 1").rect();
    let panel = &harness.state().panels().plane;
    let (plane, chart) = (panel.plane.as_ref().unwrap(), panel.chart.unwrap());
    assert!(plane.has_plane && !plane.points.is_empty());
    let places =
        plane.points.iter().map(|point| chart.screen(plane.oblique(point.body, point.surface), rect));
    assert!(places.into_iter().all(|at| rect.contains(at)), "all points are inside the view");
    // Figure 2's angle between both lines is seen as it is.
    let [start, end] =
        plane.highlight_lines().next().unwrap().map(|[b, s]| chart.screen(plane.oblique(b, s), rect));
    let seen_deg = (start.y - end.y).atan2(end.x - start.x).to_degrees();
    assert!((seen_deg - plane.angle_deg).abs() < 0.1, "{seen_deg} {}", plane.angle_deg);
}

#[test]
fn hovering_a_point_hovers_its_pixel_and_a_drag_pans() {
    let Some(mut harness) = opened() else { return };
    harness.state_mut().apply(Command::Select(Some(Item::Region(1))));
    harness.run_steps(3);
    let rect = harness.get_by_role_and_label(Role::Canvas, "Dichromatic plane of region 1").rect();
    let panel = &harness.state().panels().plane;
    let (plane, chart) = (panel.plane.clone().unwrap(), panel.chart.unwrap());
    let at = chart.screen(plane.oblique(0.5 * plane.matte_length, 0.0), rect);
    harness.hover_at(at);
    harness.run_steps(2);
    let Some(Item::Pixel(pixel)) = harness.state().state().hover else { panic!("a pixel is hovered") };
    let shown = harness.state().state().shown().unwrap().clone();
    assert_eq!(shown.labels()[pixel as usize], 1);
    let amounts = plane.amounts(shown.picture.photo.image.pixels[pixel as usize]);
    assert!((amounts.body - 0.5 * plane.matte_length).abs() < 8.0, "{amounts:?}");
    for (to, pressed) in [(at, true), (at + vec2(30.0, 12.0), true), (at + vec2(30.0, 12.0), false)] {
        harness.hover_at(to);
        let button = PointerButton::Primary;
        if to == at || !pressed {
            harness.event(Event::PointerButton { pos: to, button, pressed, modifiers: Modifiers::NONE });
        }
        harness.run_steps(2);
    }
    let moved = harness.state().panels().plane.chart.unwrap();
    assert!((moved.center[0] - chart.center[0] + 30.0 * chart.counts_per_pt).abs() < 0.5);
    assert!((moved.center[1] - chart.center[1] - 12.0 * chart.counts_per_pt).abs() < 0.5);
}
