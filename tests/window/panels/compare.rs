//! Tests of the comparison of a pinned result with the newest one.

use crate::window::{apply, click, named, press, says, shown, state, tiny_window, words};
use dichroscope::app::{Edit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::params::{Parameter, Setting};
use dichroscope::view::Layer;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Node;
use egui_kittest::kittest::NodeT as _;
use std::sync::Arc;

#[test]
fn a_narrow_panel_shows_all_that_differs() {
    let mut window = tiny_window();
    apply(&mut window, ViewCommand::Pin(true));
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(7.0), None));
    window.state_mut().show_alone(Some(Pane::Compare));
    for width in [800.0, 540.0, 340.0] {
        window.set_size(egui::vec2(width, 900.0));
        window.run_steps(4);
        for text in ["Unpin", "B \u{2212} A", "largest change", " counts", "Regions that are not the same"] {
            let ends = |node: &Node<'_>| words(node).is_some_and(|words| words.ends_with(text));
            let found: Vec<_> = window.root().children_recursive().filter(ends).collect();
            assert!(!found.is_empty(), "{text} at {width}");
            for node in found {
                assert!(node.rect().right() <= width, "{text} ends at {} of {width}", node.rect().right());
            }
        }
    }
}

#[test]
fn every_row_has_words_a_unit_and_a_sentence() {
    let mut window = tiny_window();
    apply(&mut window, ViewCommand::Pin(true));
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(7.0), None));
    window.state_mut().show_alone(Some(Pane::Compare));
    window.set_size(egui::vec2(800.0, 900.0));
    window.run_steps(4);
    assert!(!says(&window, "psnr") && !says(&window, "_deg"), "keys of files are no words");
    for (name, sentence) in [
        ("body image (dB)", "against the true one"),
        ("light off by (\u{b0})", "Angle between the true color of the light"),
        ("overlap with objects, mean (%)", "Intersection over union"),
        ("fit error (counts)", "root mean square"),
        ("pixels gained", "have a region in B and none in A"),
        ("camera noise", "oise"),
    ] {
        let starts = |node: &Node<'_>| words(node).is_some_and(|words| words == name);
        let place = window.root().children_recursive().find(starts).unwrap_or_else(|| panic!("{name}"));
        let place = place.rect().center();
        window.hover_at(egui::pos2(790.0, 890.0));
        window.run_steps(4);
        window.hover_at(place);
        window.run_steps(8);
        assert!(says(&window, sentence), "the tooltip of {name}");
    }
}

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
