//! Every widget that can be acted on has an accessible name.

use crate::window::{Fixture, Window, apply, press, region, state, tiny_window, window, with_gpu};
use dichroscope::app::{Edit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::view::{Arrangement, ImageSettings, Tool};
use egui::accesskit::{Action, Role};
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

/// Descriptions of the widgets that can be clicked or set but have no accessible name.
fn nameless(window: &Window) -> Vec<String> {
    // Containers, windows and the handles between two panels need no name.
    let needs_none = [Role::GenericContainer, Role::Window, Role::ScrollView, Role::Pane, Role::Unknown];
    window
        .root()
        .children_recursive()
        .map(|node| node.accesskit_node())
        .filter(|node| !needs_none.contains(&node.role()) && !node.is_hidden())
        .filter(|node| {
            let data = node.data();
            [Action::Click, Action::SetValue, Action::Increment].iter().any(|&a| data.supports_action(a))
        })
        // Scroll bars need no name: they belong to the panel beside them.
        .filter(|node| node.role() != Role::ScrollBar)
        .filter(|node| {
            let named = |text: Option<String>| text.is_some_and(|text| !text.trim().is_empty());
            !(named(node.label()) || node.role() == Role::Label && named(node.value()))
        })
        .map(|node| format!("{:?} at {:?}", node.role(), node.raw_bounds()))
        .collect()
}

#[track_caller]
fn check(window: &Window, what: &str) {
    let nameless = nameless(window);
    assert!(nameless.is_empty(), "{what}: {nameless:#?}");
    let unnamed = window.unnamed_widgets();
    assert!(unnamed.is_empty(), "{what}: {unnamed:#?}");
}

#[test]
fn everything_has_a_name_in_every_panel() {
    check(&window(), "nothing open");
    let mut window = tiny_window();
    check(&window, "a photograph open");
    apply(&mut window, Edit::Select(Some(region(1))));
    apply(&mut window, ViewCommand::Pin(true));
    press(&mut window, Modifiers::COMMAND, Key::A);
    for pane in Pane::ALL {
        window.state_mut().show_alone(Some(pane));
        window.run_steps(3);
        check(&window, pane.title());
    }
    window.state_mut().show_alone(Some(Pane::Image));
    let image = state(&window).view.image.clone();
    for settings in [
        ImageSettings { arrangement: Arrangement::SideBySide, ..image.clone() },
        ImageSettings { arrangement: Arrangement::Wipe(0.4), tool: Tool::Brush, ..image },
    ] {
        apply(&mut window, ViewCommand::Image(settings));
        check(&window, "two layers");
    }
}

#[test]
fn everything_has_a_name_in_the_color_space() {
    let Some(mut window) = with_gpu(vec2(900.0, 600.0), Fixture::Tiny) else { return };
    window.state_mut().show_alone(Some(Pane::Colors));
    window.run_steps(3);
    check(&window, "color space");
    for menu in ["Show", "Views"] {
        window.get_by_role_and_label(Role::Button, menu).click();
        window.run_steps(3);
        check(&window, menu);
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn everything_has_a_name_in_menus_and_windows() {
    let mut window = tiny_window();
    for menu in ["File", "Edit", "View", "Analyze", "Help"] {
        window.get_by_role_and_label(Role::Button, menu).click();
        window.run_steps(3);
        check(&window, menu);
        window.get_by_role_and_label(Role::Button, menu).click();
        window.run_steps(3);
    }
    for key in [Key::O, Key::E, Key::S] {
        press(&mut window, Modifiers::COMMAND, key);
        check(&window, key.name());
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
    press(&mut window, Modifiers::COMMAND, Key::E);
    for ware in ["Everything, as a folder", "Marked pixels"] {
        crate::window::click(&mut window, Role::RadioButton, ware);
        check(&window, ware);
    }
}
