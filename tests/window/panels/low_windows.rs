//! Tests of menus and lists in a window that is too low for them: every row can be reached, by the wheel and by keys.

use crate::closing::close_window;
use crate::window::{Fixture, Window, answer, apply, click, named, press, says, state, tiny, with_gpu};
use dichroscope::app::{Edit, JobCommand, Severity, ViewCommand};
use dichroscope::params::{Parameter, Setting};
use dichroscope::view::Origin;
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

/// Whether the widget with this role and name lies within the window.
#[track_caller]
fn is_within(window: &Window, role: Role, name: &str) -> bool {
    window.ctx.content_rect().contains_rect(named(window, role, name).rect())
}

#[test]
fn the_export_dialog_keeps_its_path_and_button_within_a_small_window_with_large_text() {
    let Some(mut window) = with_gpu(SMALLEST, Fixture::Tiny) else { return };
    for factor in [1.0, 1.5, 2.0] {
        window.ctx.set_zoom_factor(factor);
        window.run_steps(3);
        press(&mut window, Modifiers::COMMAND, Key::E);
        window.run_steps(6);
        for (role, name) in [
            (Role::Button, "Export"),
            (Role::Button, "Browse"),
            (Role::TextInput, "Path"),
            (Role::RadioButton, "Photograph without highlights"),
        ] {
            assert!(is_within(&window, role, name), "{name} at {factor}");
        }
        named(&window, Role::RadioButton, "Figures and tables").focus();
        window.run_steps(2);
        named(&window, Role::RadioButton, "Figures and tables").scroll_to_me();
        window.run_steps(30);
        assert!(is_within(&window, Role::RadioButton, "Figures and tables"), "the last kind at {factor}");
        press(&mut window, Modifiers::NONE, Key::Escape);
        window.run_steps(3);
    }
}

#[test]
fn the_question_before_closing_keeps_its_buttons_within_a_small_window_with_large_text() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = with_gpu(SMALLEST, Fixture::Tiny) else { return };
    for number in 0..6u8 {
        let name =
            format!("a photograph with a long name, as those of a scanner have it, number {number}.png");
        std::fs::copy(tiny(), folder.path().join(&name)).unwrap();
        apply(&mut window, JobCommand::Open(Origin::File(folder.path().join(name))));
        let width = Setting::Value(5.0 + f64::from(number));
        apply(&mut window, Edit::SetParameter(Parameter::CylinderWidth, width, None));
    }
    for factor in [1.0, 1.5, 2.0] {
        window.ctx.set_zoom_factor(factor);
        window.run_steps(3);
        assert!(close_window(&mut window), "the window is held at {factor}");
        window.run_steps(4);
        assert!(says(&window, "number 5.png"), "at {factor}");
        for button in ["Save workspace", "Close without saving", "Cancel"] {
            assert!(is_within(&window, Role::Button, button), "{button} at {factor}");
        }
        press(&mut window, Modifiers::NONE, Key::Escape);
        window.run_steps(2);
    }
}

#[test]
fn the_other_windows_over_the_panels_stay_within_a_small_window_with_large_text() {
    let Some(mut window) = with_gpu(SMALLEST, Fixture::Tiny) else { return };
    for factor in [1.0, 1.5, 2.0] {
        window.ctx.set_zoom_factor(factor);
        window.run_steps(3);
        press(&mut window, Modifiers::COMMAND, Key::O);
        window.run_steps(4);
        assert!(is_within(&window, Role::TextInput, "Path") && is_within(&window, Role::Button, "Browse"));
        let below = std::path::PathBuf::from("/a folder that is not there/".repeat(6));
        answer(&mut window, &below);
        window.run_steps(4);
        assert!(says(&window, "there is no such file") && is_within(&window, Role::TextInput, "Path"));
        press(&mut window, Modifiers::NONE, Key::Escape);
        press(&mut window, Modifiers::COMMAND, Key::P);
        window.run_steps(4);
        assert!(is_within(&window, Role::TextInput, "Command"), "the field at {factor}");
        for _ in 0..12 {
            press(&mut window, Modifiers::NONE, Key::ArrowDown);
        }
        window.run_steps(30);
        assert!(is_within(&window, Role::Button, "Edit: Redo"), "the chosen command at {factor}");
        press(&mut window, Modifiers::NONE, Key::Escape);
        press(&mut window, Modifiers::NONE, Key::F1);
        window.run_steps(6);
        assert!(is_within(&window, Role::Button, "Close window"), "the list of keys at {factor}");
        press(&mut window, Modifiers::NONE, Key::F1);
        for number in 0..5 {
            let text = format!("{number}: {}", "a long notice with many words ".repeat(5));
            apply(&mut window, ViewCommand::Notify(Severity::Error, text));
        }
        window.run_steps(6);
        let dismiss: Vec<_> = window.get_all_by_role_and_label(Role::Button, "Dismiss").collect();
        let last = dismiss.last().expect("there are notices").rect();
        assert!(window.ctx.content_rect().contains_rect(last), "{last:?}");
        press(&mut window, Modifiers::NONE, Key::Escape);
        for notice in state(&window).notices.clone() {
            apply(&mut window, ViewCommand::Dismiss(notice.id));
        }
    }
}
