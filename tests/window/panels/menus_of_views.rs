//! Tests of the pointer in the color space, the plane and the profile: menus of the secondary button, hovering and clicks.

use crate::window::{
    Fixture, SIZE, Window, apply, click, item, marked, named, region, says, secondary_click, state, tap,
    with_gpu,
};
use dichroscope::app::Edit;
use dichroscope::gui::Pane;
use dichroscope::gui::testing::PlaneDrawing;
use dichroscope::view::Item;
use egui::accesskit::Role;
use egui::{Pos2, vec2};

/// A panel alone, with region 1 of the sample scene selected.
fn alone(pane: Pane) -> Option<Window> {
    let mut window = with_gpu(SIZE, Fixture::Sample)?;
    apply(&mut window, Edit::Select(Some(region(1))));
    window.state_mut().show_alone(Some(pane));
    window.run_steps(3);
    Some(window)
}

/// A place in the color space at which a color is hovered.
fn at_a_color(window: &mut Window) -> Pos2 {
    let rect = named(window, Role::Canvas, "Color space view").rect();
    for step in 0..40 {
        let at = rect.center() + vec2(0.0, 6.0 * step as f32);
        window.hover_at(at);
        window.run_steps(2);
        if matches!(state(window).hover, Some(Item::Bin(_))) {
            return at;
        }
    }
    panic!("there is no color below the middle");
}

#[test]
fn the_menu_of_the_color_space_is_about_the_color_its_region_and_the_views() {
    let Some(mut window) = alone(Pane::Colors) else { return };
    let at = at_a_color(&mut window);
    secondary_click(&mut window, at);
    click(&mut window, Role::Button, "Select this color");
    assert!(matches!(item(&window), Some(Item::Bin(_))), "{:?}", item(&window));
    secondary_click(&mut window, at);
    click(&mut window, Role::Button, "Mark its pixels");
    assert!(marked(&window) > 0);
    let corner = named(&window, Role::Canvas, "Color space view").rect().left_top() + vec2(4.0, 4.0);
    secondary_click(&mut window, corner);
    assert!(!says(&window, "Select this color"), "there is no color");
    let before = state(&window).view.camera.clone();
    click(&mut window, Role::Button, "Along red");
    window.run_steps(2);
    assert_ne!(state(&window).view.camera, before);
}

#[test]
fn the_menu_of_the_plane_is_about_the_pixel_at_the_pointer() {
    let Some(mut window) = alone(Pane::Plane) else { return };
    let rect = named(&window, Role::Canvas, "Dichromatic plane").rect();
    let drawing = PlaneDrawing::of(window.state()).unwrap();
    let point = &drawing.plane.points[0];
    let at = drawing.screen([point.body, point.surface], rect);
    secondary_click(&mut window, at);
    assert!(says(&window, "Region 1") && says(&window, "Fit the plane"));
    click(&mut window, Role::Button, "Why is this pixel what it is?");
    assert!(matches!(item(&window), Some(Item::Pixel(_))));
}

#[test]
fn the_profile_hovers_and_selects_its_pixels_also_along_a_row_that_no_pixel_fixes() {
    let Some(mut window) = alone(Pane::Profile) else { return };
    let rect = named(&window, Role::Canvas, "Profile along the line").rect();
    let mut rows = Vec::new();
    for share in [0.3, 0.5, 0.7] {
        window.hover_at(rect.left_center().lerp(rect.right_center(), share));
        window.run_steps(3);
        let Some(Item::Pixel(pixel)) = state(&window).hover else { panic!("nothing is hovered at {share}") };
        rows.push(pixel.index() / crate::window::size(&window).0);
    }
    assert!(rows.iter().all(|row| *row == rows[0]), "the row stays: {rows:?}");
    tap(&mut window, rect.center());
    assert!(matches!(item(&window), Some(Item::Pixel(_))));
    secondary_click(&mut window, rect.center());
    assert!(says(&window, "Copy place and color"));
}
