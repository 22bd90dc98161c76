//! Tests of menus and lists in a window that is too low for them: every row can be reached, by the wheel and by keys.

use crate::window::{Fixture, Window, click, press, with_gpu};
use egui::accesskit::Role;
use egui::{Key, Modifiers, MouseWheelUnit, TouchPhase, Vec2, pos2, vec2};
use egui_kittest::kittest::Queryable;

/// The smallest window, points.
const SMALLEST: Vec2 = vec2(640.0, 400.0);

/// Turns the wheel down over the rows of the menu.
fn scroll_down(window: &mut Window) {
    window.hover_at(pos2(150.0, 150.0));
    window.run_steps(1);
    for _ in 0..40 {
        window.input_mut().events.push(egui::Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta: vec2(0.0, -60.0),
            phase: TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        window.run_steps(1);
    }
    window.run_steps(20);
}

#[test]
fn a_menu_higher_than_the_window_scrolls_to_its_last_row_and_lies_within_the_window() {
    let Some(mut window) = with_gpu(SMALLEST, Fixture::Tiny) else { return };
    for factor in [1.0, 1.5] {
        window.ctx.set_zoom_factor(factor);
        window.run_steps(3);
        click(&mut window, Role::Button, "View");
        window.run_steps(3);
        let last = |window: &Window| window.get_by_role_and_label(Role::RadioButton, "Light").rect();
        let floor = window.ctx.content_rect().bottom();
        assert!(last(&window).bottom() > floor, "the menu is higher than the window");
        scroll_down(&mut window);
        assert!(last(&window).bottom() <= floor, "{:?} at {factor}", last(&window));
        press(&mut window, Modifiers::NONE, Key::Escape);
        window.run_steps(2);
    }
}

#[test]
fn keys_lead_to_a_row_below_the_window() {
    let Some(mut window) = with_gpu(SMALLEST, Fixture::Tiny) else { return };
    press(&mut window, Modifiers::ALT, Key::V);
    window.run_steps(3);
    press(&mut window, Modifiers::NONE, Key::ArrowUp);
    window.run_steps(40);
    let row = window.get_by_role_and_label(Role::RadioButton, "Light");
    assert!(row.is_focused() && row.rect().bottom() <= SMALLEST.y, "{:?}", row.rect());
}
