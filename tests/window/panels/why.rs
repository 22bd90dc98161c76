//! Tests of the why panel: the pixel's history as links, and the changes of parameters that change the result.

use crate::window::{Window, apply, click, named, region, says, state, tiny_window};
use dichroscope::app::{Command, Edit, Question};
use dichroscope::gui::Pane;
use dichroscope::raster::PixelIndex;
use dichroscope::trace::Stage;
use dichroscope::view::{Item, why};
use egui::accesskit::Role;

/// A pixel of the largest region.
fn pixel(window: &Window) -> PixelIndex {
    let labels = state(window).newest.as_ref().unwrap().labels();
    PixelIndex::from_index(labels.as_slice().iter().position(|&label| label == 1).unwrap())
}

/// Shows the panel alone in the window, so that no test has to scroll.
fn alone(window: &mut Window) {
    window.state_mut().show_alone(Some(Pane::Inspector));
    window.run_steps(3);
}

#[test]
fn a_clicked_region_tells_the_pixels_history_and_each_sentence_leads_to_its_step() {
    let mut window = tiny_window();
    assert!(says(&window, "Click a pixel or a region"));
    let pixel = pixel(&window);
    apply(&mut window, Edit::Select(Some(region(1))));
    assert!(says(&window, "Region 1 is made of"), "a region has a story too");
    apply(&mut window, Command::Ask(Question::Why(pixel)));
    alone(&mut window);
    let debugger = &state(&window).debugger;
    let (trace, shown) = (debugger.trace().unwrap(), state(&window).newest.as_ref().unwrap());
    let (_, history) = why(shown, trace, &debugger.names, Some(pixel), None, None).pixel.unwrap();
    let split = history.iter().find(|account| account.stage == Stage::Split).unwrap().clone();
    let masks = history.iter().find(|account| account.stage == Stage::Masks).unwrap().clone();
    for account in [split, masks] {
        click(&mut window, Role::Link, &account.text);
        let replay = state(&window).debugger.replay.as_ref().unwrap();
        assert_eq!(Some(replay.at()), account.step.map(|step| step + 1), "{}", account.text);
    }
    apply(&mut window, Edit::Select(Some(region(2))));
    assert_eq!(state(&window).explained_pixel(), None, "another region, another question");
}

#[test]
fn what_would_change_a_pixel_is_found_and_a_click_sets_it() {
    let mut window = tiny_window();
    let pixel = pixel(&window);
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    alone(&mut window);
    click(&mut window, Role::Button, "Find what would change it");
    let found = state(&window).what_if_job.as_ref().unwrap().found.clone().unwrap();
    let first = found[0];
    let sentence = dichroscope::describe::what_if_sentence(&first);
    named(&window, Role::Link, &sentence);
    click(&mut window, Role::Link, &sentence);
    let params = &state(&window).document.params;
    assert_eq!(params.get(first.parameter).value(), Some(first.at));
    assert!(state(&window).is_current());
}
