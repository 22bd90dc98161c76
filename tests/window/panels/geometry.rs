//! Tests of the geometry panel: sliders, drag, numbers of section 3, the selected region, and the cluster in the plane.

use crate::window::{Window, apply, click, named, press, region, says, state, tiny_window};
use dichroscope::app::{Edit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::view::GeometrySettings;
use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};

/// A window in which the geometry panel is alone.
fn geometry() -> Window {
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    window.set_size(vec2(560.0, 620.0));
    window.state_mut().show_alone(Some(Pane::Geometry));
    window.run_steps(3);
    window
}

#[test]
fn sliders_set_the_sphere_and_the_numbers_are_those_of_section_3() {
    let mut window = geometry();
    named(&window, Role::Slider, "phase angle g").set_value_accesskit(145.3);
    named(&window, Role::Slider, "distance d/r").set_value_accesskit(5.0);
    window.run_steps(3);
    assert!((state(&window).view.geometry.phase_deg - 145.3).abs() < 0.06);
    assert!(says(&window, "0.4973"), "the smallest q at five radii");
    named(&window, Role::Slider, "phase angle g").set_value_accesskit(0.0);
    window.run_steps(3);
    assert!(says(&window, "Figure 6: the highlight line starts at 100.0 % of the matte line"));
    named(&window, Role::Slider, "phase angle g").set_value_accesskit(1000.0);
    window.run_steps(3);
    let phase_deg = state(&window).view.geometry.phase_deg;
    assert!(phase_deg < 156.93, "no more than g_max: {phase_deg}");
}

#[test]
fn every_quantity_of_equations_3_to_11_is_listed_and_follows_the_sliders() {
    let mut window = geometry();
    let rows = [
        ("(3) half of the sphere's angle \u{3b3}", "11.5\u{b0}", "30.0\u{b0}"),
        ("(4) largest phase angle", "156.9\u{b0}", "120.0\u{b0}"),
        ("(5) incidence at the highlight", "54.4\u{b0}", "73.7\u{b0}"),
        ("(6) m_b under the highlight", "0.5828", "0.2811"),
        ("(7) normal of the brightest point \u{3b1}", "11.5\u{b0}", "30.0\u{b0}"),
        ("(8) incidence at the brightest point", "14.4\u{b0}", "53.8\u{b0}"),
        ("(9) m_b of the brightest point", "0.9686", "0.5907"),
        ("(10) start of the highlight line q", "0.6016", "0.4759"),
        ("(11) q at an infinite distance", "0.7071", "0.7071"),
    ];
    for (distance, which) in [(5.0, 0), (2.0, 1)] {
        named(&window, Role::Slider, "phase angle g").set_value_accesskit(90.0);
        named(&window, Role::Slider, "distance d/r").set_value_accesskit(distance);
        window.run_steps(3);
        for (name, near, far) in rows {
            let value = if which == 0 { near } else { far };
            assert!(says(&window, name), "{name}");
            assert!(says(&window, value), "{name}: {value} at {distance} radii");
        }
    }
}

#[test]
fn a_drag_of_the_light_sets_phase_angle_and_distance() {
    let mut window = geometry();
    let name = "Sphere, light and camera: distance 5.0 radii, phase angle 60 degrees";
    let rect = named(&window, Role::Image, name).rect();
    let center = rect.center_top() + vec2(0.0, 0.66 * rect.height());
    let before = state(&window).view.geometry;
    let light = center + vec2(40.0, -40.0);
    window.drag_at(center + vec2(20.0, -60.0));
    window.run_steps(1);
    window.hover_at(light);
    window.run_steps(1);
    window.drop_at(light);
    window.run_steps(2);
    let after = state(&window).view.geometry;
    assert!((after.phase_deg - 90.0).abs() < 3.0, "{after:?}");
    assert!((after.distance - before.distance).abs() > 0.05, "{after:?}");
}

#[test]
fn the_selected_region_is_compared_and_the_cluster_is_drawn_in_the_plane() {
    let mut window = geometry();
    assert!(says(&window, "The highlight line of region 1 starts at "));
    click(&mut window, Role::CheckBox, "Draw it in color space and plane");
    assert!(state(&window).view.geometry.is_drawn);
    window.state_mut().show_alone(Some(Pane::Plane));
    window.run_steps(3);
    assert!(says(&window, "sphere"), "the legend of the plane names the cluster");
    apply(
        &mut window,
        ViewCommand::Geometry(GeometrySettings { phase_deg: 1e9, ..GeometrySettings::default() }),
    );
    window.run_steps(2);
    assert!(!says(&window, "sphere") && state(&window).view.geometry.phase_deg < 180.0);
}

#[test]
fn the_command_palette_brings_the_panel_to_the_front() {
    let mut window = tiny_window();
    window.set_size(vec2(1440.0, 900.0));
    press(&mut window, Modifiers::COMMAND, Key::P);
    window.event(egui::Event::Text("show geometry".to_owned()));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(3);
    assert!(says(&window, "Figure 6"), "the panel is in front of plane and profile");
}
