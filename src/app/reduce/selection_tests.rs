//! Tests of the number of the selected region, which differs between results.

use super::{reduce, reduce_report};
use crate::app::awaited::AfterPin;
use crate::app::report::Report;
use crate::app::{Edit, State};
use crate::params::{Parameter, Params, Setting};
use crate::raster::RegionId;
use crate::view::testing::{divided, gray};
use crate::view::{Item, ResultSnapshot};
use std::sync::Arc;

/// The regions of the result before and of the result after a change: the same, numbered the other way round.
const BEFORE: [&str; 2] = ["1122", "1122"];
const AFTER: [&str; 2] = ["2211", "2211"];

fn region(number: u16) -> Option<Item> {
    RegionId::from_label(number).map(Item::Region)
}

/// A result with these regions for the parameters that the state has.
fn report(state: &mut State, rows: &[&str]) {
    let shown = divided(state.picture.as_ref().unwrap(), rows);
    let shown = ResultSnapshot { generation: state.generation, ..shown };
    reduce_report(state, Report::Analyzed(Arc::new(shown)));
}

/// A state with a result in which the left region is selected.
fn left_selected() -> State {
    let mut state = State { picture: Some(gray(&BEFORE, 120)), ..State::default() };
    report(&mut state, &BEFORE);
    reduce(&mut state, Edit::Select(region(1)));
    state
}

#[test]
fn undo_and_redo_select_the_region_by_its_number_in_their_result() {
    let mut state = left_selected();
    reduce(&mut state, Edit::SetParameter(Parameter::SliceWidth, Setting::Value(3.0), None));
    report(&mut state, &AFTER);
    assert_eq!(state.document.selection.item, region(2), "followed by overlap");
    for (edit, rows, number) in [(Edit::Undo, BEFORE, 1), (Edit::Redo, AFTER, 2)] {
        reduce(&mut state, edit);
        report(&mut state, &rows);
        assert_eq!(state.document.selection.item, region(number));
    }
}

#[test]
fn a_region_that_is_selected_while_an_undo_is_computed_is_followed() {
    let mut state = left_selected();
    reduce(&mut state, Edit::SetParameter(Parameter::SliceWidth, Setting::Value(3.0), None));
    report(&mut state, &AFTER);
    reduce(&mut state, Edit::Undo);
    reduce(&mut state, Edit::Select(region(1)));
    report(&mut state, &BEFORE);
    assert_eq!(state.document.selection.item, region(2), "the right region");
}

#[test]
fn a_workspace_with_a_pinned_result_selects_the_region_by_its_number_in_the_newest() {
    let mut state = left_selected();
    let after = AfterPin { params: Params::default(), item: region(1), show_pinned: false };
    state.awaited.after_pin = Some(after);
    report(&mut state, &BEFORE);
    report(&mut state, &AFTER);
    assert_eq!(state.document.selection.item, region(1));
    assert_eq!(state.pinned.as_ref().map(|pinned| pinned.labels()[0]), Some(1));
}
