//! Tests of the skewed T of marked pixels: the button, the key, the menu of the pixel, what the panels show, undo, and the method's button.

use crate::window::{apply, click, item, marked, press, says, shown, state, tiny_window, undo};
use dichroscope::analysis::RunWarning;
use dichroscope::app::{Combine, Edit};
use dichroscope::gui::Pane;
use dichroscope::params::Method;
use dichroscope::raster::RegionId;
use dichroscope::trace::Event as TraceEvent;
use dichroscope::view::Item;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use std::sync::Arc;

#[test]
fn the_marked_pixels_get_a_skewed_t_in_one_step_that_undo_takes_back() {
    let mut window = tiny_window();
    let labels = shown(&window).labels().clone();
    let before = (state(&window).document.params, shown(&window).labels().clone());
    window.state_mut().show_alone(Some(Pane::Selection));
    apply(&mut window, Edit::Mark(Arc::new(labels.map(|&label| label == 1)), Combine::Replace, None));
    let pixels = marked(&window);
    click(&mut window, Role::Button, "Fit skewed T to the marked");
    assert_eq!(state(&window).document.params.method, Method::ByHand);
    let analysis = &shown(&window).analysis;
    assert_eq!(analysis.intrinsic.regions.len(), 1);
    assert!(analysis.intrinsic.regions[0].pixels <= pixels, "exactly the marked pixels that are lit");
    assert_eq!(item(&window), Some(Item::Region(RegionId::from_index(0))), "the region is selected");
    assert_eq!(marked(&window), pixels, "the marks stay");
    window.state_mut().show_alone(Some(Pane::Plane));
    window.run_steps(3);
    assert!(says(&window, "Dichromatic plane of region 1"));
    undo(&mut window);
    assert_eq!((state(&window).document.params, shown(&window).labels().clone()), before);
    assert!(state(&window).document.area.is_none());
}

#[test]
fn a_key_and_the_method_s_button_fit_it_and_without_marks_a_sentence_says_what_to_do() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::T);
    assert!(says(&window, "mark the pixels of one object first: a skewed T is fitted to them"));
    assert_eq!(state(&window).document.params.method, Method::Refined);
    let labels = shown(&window).labels().clone();
    apply(&mut window, Edit::Mark(Arc::new(labels.map(|&label| label == 2)), Combine::Replace, None));
    press(&mut window, Modifiers::COMMAND, Key::T);
    assert_eq!(state(&window).document.params.method, Method::ByHand);
    undo(&mut window);
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    click(&mut window, Role::Button, "by-hand");
    assert!(state(&window).document.area.is_some(), "the marked pixels are the area");
    apply(&mut window, Edit::RestrictTo(None));
    let told = shown(&window).analysis.warnings.contains(&RunWarning::NothingMarked);
    assert!(told, "{:?}", shown(&window).analysis.warnings);
}

#[test]
fn the_debugger_steps_through_the_line_fits_the_t_and_the_plane() {
    let mut window = tiny_window();
    let labels = shown(&window).labels().clone();
    apply(&mut window, Edit::Mark(Arc::new(labels.map(|&label| label == 1)), Combine::Replace, None));
    press(&mut window, Modifiers::COMMAND, Key::T);
    let replay = state(&window).debugger.replay.as_ref().unwrap();
    let kinds: Vec<&str> =
        replay.trace().events().map(|(_, event): (_, &TraceEvent)| event.kind().name()).collect();
    assert!(kinds.contains(&"line of the marked") && kinds.contains(&"marked pixels"), "{kinds:?}");
    for kind in ["candidate", "slice"] {
        let has_t = shown(&window).analysis.illuminant.is_some();
        assert_eq!(kinds.contains(&kind), has_t, "{kind}: {kinds:?}");
    }
}
