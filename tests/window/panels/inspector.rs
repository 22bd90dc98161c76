//! Tests of the inspector: verdict, values against thresholds and actions of what is selected, marked, hovered or stepped to.

use crate::window::{
    SIZE, Window, apply, click, marked, named, region, says, shown, state, tiny_window, with_state,
};
use dichroscope::app::{Combine, Command, DebugCommand, Edit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::intrinsic::Reason;
use dichroscope::params::{Method, Parameter, Setting};
use dichroscope::raster::PixelIndex;
use dichroscope::trace::{Event, Kind};
use dichroscope::view::Item;
use egui::accesskit::Role;
use std::sync::Arc;

/// A window with the small photograph in which the inspector is alone.
fn inspector() -> Window {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Inspector));
    window.run_steps(3);
    window
}

/// Moves the cursor behind the first event that is wanted.
fn go_to(window: &mut Window, wanted: impl Fn(&Event) -> bool) {
    let trace = Arc::clone(state(window).debugger.trace().unwrap());
    let (step, _) = trace.events().find(|(_, event)| wanted(event)).unwrap();
    apply(window, Command::Debug(DebugCommand::Seek(step + 1)));
}

#[test]
fn a_region_has_its_verdict_first_then_values_against_limits_and_actions() {
    let mut window = inspector();
    apply(&mut window, Edit::Select(Some(region(1))));
    assert!(says(&window, "Verdict: Holds") && says(&window, "Region 1 \u{b7} section 6"));
    assert!(says(&window, "passed: rms from the plane") && says(&window, "passed: new edges"));
    let verdict = named(&window, Role::Label, "Verdict: Holds").rect();
    click(&mut window, Role::Button, "Mark its pixels");
    assert!(marked(&window) > 0 && says(&window, "Marked pixels"));
    let marked_block = named(&window, Role::Label, "Marked pixels \u{b7} section 5.2.1").rect();
    assert!(marked_block.top() > verdict.bottom());
    click(&mut window, Role::Button, "Restrict to them");
    assert!(state(&window).document.area.is_some());
}

#[test]
fn a_region_of_the_papers_method_is_not_judged() {
    let mut window = inspector();
    apply(&mut window, Edit::SetMethod(Method::Paper));
    apply(&mut window, Edit::Select(Some(region(1))));
    assert_eq!(shown(&window).params.method, Method::Paper);
    assert!(says(&window, "Verdict: Not judged") && !says(&window, "rms from the plane"));
}

#[test]
fn the_step_that_fits_vectors_is_not_judged_under_the_papers_method() {
    let mut window = inspector();
    go_to(&mut window, |event| matches!(event, Event::VectorsFitted(_)));
    assert!(says(&window, "Verdict: Holds"));
    apply(&mut window, Edit::SetMethod(Method::Paper));
    window.run_steps(2);
    go_to(&mut window, |event| matches!(event, Event::VectorsFitted(_)));
    assert!(says(&window, "Verdict: Not judged") && !says(&window, "Verdict: Holds"));
    assert!(says(&window, "whether it holds is not asked"));
}

#[test]
fn a_selected_pixel_has_the_values_of_the_readout_and_its_distances_from_the_hypotheses() {
    let mut window = inspector();
    let labels = shown(&window).labels().clone();
    let inside = labels.as_slice().iter().position(|&label| label == 1).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(inside)))));
    window.run_steps(2);
    let amounts =
        dichroscope::view::PixelAmounts::of(&shown(&window), PixelIndex::from_index(inside)).unwrap();
    assert!(says(&window, &format!("m_b {:.1}", amounts.result.body)), "the amounts of the readout");
    let distance = state(&window).watched().unwrap().pixel.unwrap().distances.remove(0);
    let text = format!("{:.1} / {:.1}", distance.axis[0], distance.axis[1]);
    assert!(says(&window, &text) && says(&window, "Distances from the hypotheses, counts"), "{text}");
    apply(&mut window, ViewCommand::Pin(true));
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(7.0), None));
    assert!(says(&window, "Distances from the hypotheses, counts"), "of the newest result");
    apply(&mut window, ViewCommand::ShowPinned(true));
    window.run_steps(2);
    for of_newest in ["Distances from the hypotheses, counts", "Run to its next change", "Break here"] {
        assert!(
            !says(&window, of_newest),
            "{of_newest} is about the newest result, and the pinned one is shown"
        );
    }
}

#[test]
fn a_step_of_phoenix_has_its_histograms_and_scores() {
    let mut window = inspector();
    apply(&mut window, Edit::SetMethod(Method::Phoenix));
    go_to(
        &mut window,
        |event| matches!(event, Event::HistogramsSearched(searched) if searched.chosen().is_some()),
    );
    assert!(says(&window, "Verdict: Split") && says(&window, "section 7.2"));
    assert!(says(&window, "Histogram of hue: chosen, valley at"), "the histogram that decided is drawn");
    assert!(says(&window, "passed: hue"), "its score has its limit");
    go_to(
        &mut window,
        |event| matches!(event, Event::HistogramsSearched(searched) if searched.chosen().is_none()),
    );
    assert!(says(&window, "Verdict: Homogeneous"));
}

#[test]
fn a_hovered_pixel_takes_the_place_of_the_selected_one_and_moves_nothing_below() {
    let mut window = inspector();
    let labels = shown(&window).labels().clone();
    let reasons = shown(&window).analysis.intrinsic.reasons.clone();
    let explained = |pixel: &usize| labels[*pixel] == 1 && reasons[*pixel] == Reason::Explained;
    let inside = (0..labels.len()).find(explained).unwrap();
    let outside = labels.as_slice().iter().position(|&label| label == 0).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(inside)))));
    assert!(says(&window, "Verdict: Explained") && says(&window, "passed: from black"));
    assert!(says(&window, "from the matte line"));
    let history = named(&window, Role::Label, "History").rect();
    apply(&mut window, ViewCommand::Hover(Some(Item::Pixel(PixelIndex::from_index(outside)))));
    assert!(says(&window, "Verdict: Not explained") && says(&window, "pointed at"));
    assert!(!says(&window, "Select its region"), "the pointer is elsewhere");
    assert_eq!(named(&window, Role::Label, "History").rect(), history);
}

#[test]
fn at_the_cursor_nothing_of_the_end_is_told() {
    let mut window = inspector();
    apply(&mut window, Edit::Select(Some(region(1))));
    assert!(says(&window, "Verdict: Holds") || says(&window, "Verdict: Does not hold"));
    apply(&mut window, Command::Debug(DebugCommand::Seek(0)));
    assert!(says(&window, "Verdict: Nothing is decided yet") && says(&window, "Verdict: Not begun"));
    assert!(!says(&window, "Verdict: Holds") && !says(&window, "Verdict: Does not hold"));
    let inside = shown(&window).labels().as_slice().iter().position(|&label| label == 1).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(inside)))));
    assert!(says(&window, "Verdict: In no hypothesis so far"));
    let trace = Arc::clone(state(&window).debugger.trace().unwrap());
    apply(&mut window, Command::Debug(DebugCommand::Seek(trace.len() - 1)));
    assert!(says(&window, "Verdict: In hypothesis"));
    apply(&mut window, Command::Debug(DebugCommand::Seek(trace.len())));
    assert!(!says(&window, "Verdict: In hypothesis"), "the result again");
}

#[test]
fn a_pixel_outside_of_the_analyzed_area_is_called_so() {
    let mut window = inspector();
    let labels = shown(&window).labels().clone();
    let area = labels.map(|&label| label == 1);
    let outside = labels.as_slice().iter().position(|&label| label == 2).unwrap();
    apply(&mut window, Edit::RestrictTo(Some(Arc::new(area))));
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(outside)))));
    let is_left_out =
        |window: &Window| says(window, "Verdict: Left out: outside the area") && !says(window, "shadow");
    assert!(is_left_out(&window));
    apply(&mut window, Edit::Select(None));
    assert!(!is_left_out(&window));
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(outside)))));
    apply(&mut window, Command::Debug(DebugCommand::Seek(0)));
    assert!(is_left_out(&window), "the masks are there from the beginning on");
}

#[test]
fn a_step_has_its_verdict_and_can_be_run_to_and_stopped_at_again() {
    let mut window = inspector();
    go_to(&mut window, |event| matches!(event, Event::CandidateTested(test) if !test.verdict.accepted()));
    assert!(says(&window, "Verdict: No skewed T") && says(&window, "section 5.4"));
    assert!(says(&window, "failed: ") && says(&window, "gap"));
    click(&mut window, Role::Button, "Break here");
    assert_eq!(state(&window).view.debug.breakpoints.len(), 1);
    let before = state(&window).debugger.replay.as_ref().unwrap().at();
    click(&mut window, Role::Button, "Run to the next one");
    let replay = state(&window).debugger.replay.as_ref().unwrap();
    assert!(replay.at() > before);
    assert_eq!(replay.last().unwrap().kind(), Kind::Candidate);
    go_to(&mut window, |event| matches!(event, Event::HypothesisChosen(_)));
    assert!(says(&window, "Verdict: Taken") && says(&window, "passed: line from black"));
}

#[test]
fn the_verdict_of_a_step_stands_in_the_timeline_at_every_width() {
    let mut window = tiny_window();
    go_to(&mut window, |event| matches!(event, Event::MergeTried(tried) if tried.class != tried.union));
    for width in [900.0, 1280.0, 1900.0] {
        window.set_size(egui::vec2(width, 700.0));
        window.run_steps(4);
        let verdict = named(&window, Role::Label, "Stay apart").rect();
        assert!(verdict.right() <= width && verdict.width() > 50.0, "{width}: {verdict}");
    }
}

#[test]
fn the_plane_shows_the_clusters_of_a_window_and_of_two_areas() {
    let mut window = tiny_window();
    window.state_mut().show_alone(Some(Pane::Plane));
    go_to(&mut window, |event| matches!(event, Event::WindowClassified(found) if found.class.is_some()));
    assert!(says(&window, "Clusters of window") && says(&window, "dashed: noise"));
    assert!(says(&window, "a point"));
    go_to(&mut window, |event| matches!(event, Event::MergeTried(tried) if tried.class == tried.union));
    assert!(says(&window, "they merge") && says(&window, "union") && says(&window, "merged"));
    go_to(&mut window, |event| matches!(event, Event::MergeTried(tried) if tried.class != tried.union));
    assert!(says(&window, "they stay apart") && says(&window, "stays apart"));
}

#[test]
fn marked_pixels_have_a_block_of_their_own() {
    let mut window = inspector();
    apply(&mut window, Edit::ClearSelection);
    let labels = shown(&window).labels().clone();
    let mask = Arc::new(labels.map(|&label| label == 2));
    apply(&mut window, Edit::Mark(mask, Combine::Replace, None));
    assert!(says(&window, "region 2 100 %"));
    apply(&mut window, Command::Debug(DebugCommand::Seek(0)));
    assert!(says(&window, "no hypothesis 100 %") && !says(&window, "region 2"), "nothing is decided yet");
    let steps = state(&window).debugger.trace().unwrap().len();
    apply(&mut window, Command::Debug(DebugCommand::Seek(steps - 1)));
    assert!(says(&window, "hypothesis ") && !says(&window, "no hypothesis 100 %"));
    apply(&mut window, Command::Debug(DebugCommand::Seek(steps)));
    assert!(says(&window, "region 2 100 %"), "the result again");
    click(&mut window, Role::Button, "Copy");
}

#[test]
fn a_hovered_item_keeps_no_room_for_what_is_selected_no_more() {
    let mut window = inspector();
    let labels = shown(&window).labels().clone();
    let inside = labels.as_slice().iter().position(|&label| label == 1).unwrap();
    // The block of a pixel has the distances from all hypotheses.
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(inside)))));
    window.run_steps(3);
    apply(&mut window, ViewCommand::Hover(Some(region(2))));
    apply(&mut window, Edit::Select(Some(region(1))));
    window.run_steps(1);
    let history = |window: &Window| named(window, Role::Label, "Region 1 is made of").rect().top();
    let while_hovered = history(&window);
    apply(&mut window, ViewCommand::Hover(None));
    window.run_steps(3);
    assert!((while_hovered - history(&window)).abs() < 60.0, "{while_hovered} and {}", history(&window));
}

#[test]
fn the_history_of_a_region_is_not_told_from_the_record_of_another_result() {
    let mut earlier = state(&tiny_window()).clone();
    earlier.document.selection.item = Some(region(1));
    let mut recorded = earlier.clone();
    // The record is of a result in which the region may have had another number.
    earlier.debugger.generation += 1;
    for (state, tells) in [(&mut recorded, true), (&mut earlier, false)] {
        let Some(mut window) = with_state(SIZE, std::mem::take(state)) else { return };
        window.run_steps(3);
        assert_eq!(says(&window, "Region 1 is made of"), tells);
        assert_eq!(says(&window, "The decisions are being recorded"), !tells);
    }
}
