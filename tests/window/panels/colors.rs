//! Tests of the color space panel on the small photograph, which need a graphics adapter.

use crate::window::{
    Fixture, SIZE, Window, apply, click, drag, item, marked, named, press, region, says, shown, size, state,
    undo, with_gpu,
};
use dichroscope::app::Edit;
use dichroscope::view::{ColorBy, ColorSpace, Item, Tool};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, Rect};

/// A window with the small photograph; `None` without a graphics adapter.
fn opened() -> Option<Window> {
    with_gpu(SIZE, Fixture::Tiny)
}

fn view(window: &Window) -> Rect {
    named(window, Role::Canvas, "Color space view").rect()
}

/// A closed path along the border of a part of a rectangle; the part is given in shares of the sides.
fn around(view: Rect, [left, top, right, bottom]: [f32; 4]) -> Vec<Pos2> {
    let corner = |x, y| view.lerp_inside(egui::vec2(x, y));
    vec![
        corner(left, top),
        corner(right, top),
        corner(right, bottom),
        corner(left, bottom),
        corner(left, top),
    ]
}

#[test]
fn a_lasso_around_all_colors_marks_the_picture_and_around_half_of_them_less() {
    let Some(mut window) = opened() else { return };
    click(&mut window, Role::Button, "Color space: lasso");
    assert_eq!(state(&window).view.cube.tool, Tool::Lasso);
    let view = view(&window);
    drag(&mut window, &around(view, [0.01, 0.01, 0.99, 0.99]), Modifiers::NONE);
    let (width, height) = size(&window);
    assert_eq!(marked(&window), width * height, "the whole cube is in sight");
    let path = around(view, [0.5, 0.01, 0.99, 0.99]);
    drag(&mut window, &path, Modifiers::NONE);
    let right = marked(&window);
    assert!(right > 0 && right < width * height, "{right}");
    drag(&mut window, &around(view, [0.01, 0.01, 0.5, 0.99]), Modifiers::SHIFT);
    let both = marked(&window);
    assert!(both > right, "{both}: Shift adds");
    drag(&mut window, &path, Modifiers::ALT);
    assert!(marked(&window) < both, "Alt takes away");
    for _ in 0..4 {
        undo(&mut window);
    }
    assert_eq!(marked(&window), 0);
}

#[test]
fn a_region_is_claimed_by_its_cylinder_and_colors_are_hovered() {
    let Some(mut window) = opened() else { return };
    apply(&mut window, Edit::Select(Some(region(1))));
    let rect = view(&window);
    // At some point of a fine grid over the view there is a color.
    let places = (0..40).flat_map(|y| (0..40).map(move |x| (x, y)));
    let mut found = None;
    for (x, y) in places {
        let place = rect.lerp_inside(egui::vec2((x as f32 + 0.5) / 40.0, (y as f32 + 0.5) / 40.0));
        window.hover_at(place);
        window.run_steps(1);
        if let Some(Item::Bin(bin)) = state(&window).hover {
            found = Some((place, bin));
            break;
        }
    }
    let (place, bin) = found.expect("some color is under the pointer");
    let of = shown(&window).picture.histogram.bins[bin as usize];
    assert!(of.count > 0);
    drag(&mut window, &[place], Modifiers::ALT);
    assert_eq!(item(&window), Some(Item::Bin(bin)), "Alt + click selects the colors alone");
}

#[test]
fn spaces_and_colorings_are_chosen_by_name() {
    let Some(mut window) = opened() else { return };
    for space in ColorSpace::ALL {
        click(&mut window, Role::ComboBox, "Color space shown");
        click(&mut window, Role::Button, space.name());
        assert_eq!(state(&window).view.cube.space, space);
    }
    for (name, by) in [("Region", ColorBy::Region), ("Density", ColorBy::Density), ("Class", ColorBy::Class)]
    {
        click(&mut window, Role::ComboBox, "Color by");
        let choice = window_choice(&window, name);
        drag(&mut window, &[choice], Modifiers::NONE);
        assert_eq!(state(&window).view.cube.color_by, by);
    }
    click(&mut window, Role::Button, "Lock the view");
    assert!(state(&window).view.cube.locked);
    assert!(says(&window, "Color space view"));
}

/// The middle of a button with this name; the last one, because a tab before it may have the same name.
fn window_choice(window: &Window, name: &str) -> Pos2 {
    use egui_kittest::kittest::Queryable;
    window.query_all_by_role_and_label(Role::Button, name).last().unwrap().rect().center()
}

#[test]
fn a_drag_turns_the_view_and_keys_bring_it_back() {
    let Some(mut window) = opened() else { return };
    let rect = view(&window);
    let before = window.render().unwrap();
    let middle = rect.center();
    drag(
        &mut window,
        &[middle, middle + egui::vec2(40.0, 0.0), middle + egui::vec2(90.0, 30.0)],
        Modifiers::NONE,
    );
    window.remove_cursor();
    window.run_steps(4);
    let turned = window.render().unwrap();
    assert!(difference(&before, &turned, rect) > 0.02, "{}", difference(&before, &turned, rect));
    press(&mut window, Modifiers::NONE, Key::T);
    press(&mut window, Modifiers::NONE, Key::T);
    let again = window.render().unwrap();
    assert!(difference(&turned, &again, rect) < 0.001, "looking at another theme and back changes nothing");
}

/// Share of the pixels that differ between two images, within `part`.
fn difference(a: &image::RgbaImage, b: &image::RgbaImage, part: Rect) -> f32 {
    let inside = |x: u32, y: u32| part.contains(Pos2::new(x as f32, y as f32));
    let pixels = a.enumerate_pixels().filter(|(x, y, _)| inside(*x, *y));
    let (mut all, mut other) = (0u32, 0u32);
    for (x, y, pixel) in pixels {
        all += 1;
        other += u32::from(pixel.0.iter().zip(b.get_pixel(x, y).0).any(|(a, b)| a.abs_diff(b) > 8));
    }
    other as f32 / all.max(1) as f32
}
