//! Tests of the comparison of a pinned result with the newest one.

use crate::window::{click, named, press, says, shown, state, tiny_window};
use dichroscope::view::Layer;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use std::sync::Arc;

#[test]
fn a_pinned_result_is_compared_and_swapped_by_key() {
    let mut window = tiny_window();
    click(&mut window, Role::Button, "Compare");
    assert!(says(&window, "Pin this result, change a slider, and see what changed."));
    click(&mut window, Role::Button, "Pin this result");
    let pinned = Arc::clone(state(&window).pinned.as_ref().unwrap());
    named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(7.0);
    window.run_steps(3);
    assert!(!Arc::ptr_eq(&shown(&window), &pinned));
    assert!(says(&window, "camera noise") && says(&window, "Regions that are not the same"));
    press(&mut window, Modifiers::NONE, Key::A);
    assert!(Arc::ptr_eq(&shown(&window), &pinned), "A");
    press(&mut window, Modifiers::NONE, Key::A);
    assert!(!Arc::ptr_eq(&shown(&window), &pinned), "B");
    click(&mut window, Role::Button, "A pinned");
    assert!(state(&window).view.show_pinned);
    click(&mut window, Role::Button, "Difference image");
    assert_eq!(state(&window).view.image.layer, Layer::Difference);
    press(&mut window, Modifiers::NONE, Key::K);
    assert!(state(&window).pinned.is_none() && !state(&window).view.show_pinned);
}
