//! What the panels tell of the place of the cursor: the watch list, the pixels of a growth, and the history of a pixel.

use super::*;
use crate::raster::PixelIndex;
use crate::trace::{Event, Stage};
use crate::view::{Why, growth, watch, why};

/// A pixel outside of every picture.
const OUTSIDE: PixelIndex = PixelIndex::new(u32::MAX);

#[test]
fn the_watch_list_holds_the_values_at_the_cursor() {
    let mut application = application();
    let picture = Arc::clone(application.state().picture.as_ref().unwrap());
    let first = block(&trace(&application), grows);
    debug(&mut application, DebugCommand::Seek(first.steps.end));
    let cursor = replay(application.state());
    let hypothesis = first.topic.hypothesis();
    let pixel = cursor.labels().as_slice().iter().position(|&label| label == hypothesis.get()).unwrap();
    let pixel = PixelIndex::from_index(pixel);
    let names = &application.state().debugger.names;
    let watched = watch(cursor, names, &picture.photo.image.pixels, Some(pixel));
    assert_eq!(watched.stage, Some(Stage::Linear));
    assert_eq!(watched.regions, [1, 1]);
    let current = watched.current.unwrap();
    assert_eq!((current.hypothesis, current.pixels), (hypothesis, cursor.size(hypothesis)));
    let of_pixel = watched.pixel.unwrap();
    assert_eq!(of_pixel.hypothesis, Some(hypothesis));
    let [distance, radius] = of_pixel.distances[0].axis;
    assert!(distance <= radius, "a claimed pixel lies inside the cylinder");
    assert_eq!(watch(cursor, names, &picture.photo.image.pixels, Some(OUTSIDE)).pixel, None);
}

#[test]
fn the_watch_list_of_an_averaged_photograph_holds_the_kind_of_the_working_pixel() {
    let mut application = application();
    application.apply(Edit::SetParameter(Parameter::Scale, Setting::Value(2.0), None));
    let state = application.state();
    let cursor = replay(state);
    let colors = &state.newest.as_ref().unwrap().analysis.working.image.pixels;
    assert_eq!(cursor.trace().pixel_blocks().side(), 2);
    let size = state.picture.as_ref().unwrap().size();
    for index in 0..size.0 * size.1 {
        let pixel = PixelIndex::from_index(index);
        let watched = watch(cursor, &state.debugger.names, colors, Some(pixel)).pixel.unwrap();
        assert_eq!(watched.kind, cursor.kind(cursor.trace().working_pixel(pixel).index()), "{index}");
    }
}

#[test]
fn pixels_of_a_growth_belong_to_the_hypothesis_and_its_surroundings_do_not() {
    let mut application = application();
    let first = block(&trace(&application), grows);
    debug(&mut application, DebugCommand::Seek(first.steps.end));
    let cursor = replay(application.state());
    let found = growth(cursor).unwrap();
    assert_eq!(found.claimed.len(), cursor.size(found.hypothesis) as usize, "all of it has grown here");
    assert!(found.around.iter().all(|&pixel| cursor.labels()[pixel as usize] != found.hypothesis.get()));
    debug(&mut application, DebugCommand::Seek(1));
    assert_eq!(growth(replay(application.state())), None);
}

#[test]
fn the_history_of_a_pixel_is_newest_first_with_hypothesis_and_region() {
    let application = application();
    let (state, trace) = (application.state(), trace(&application));
    let shown = state.newest.as_ref().unwrap();
    let names = &state.debugger.names;
    let pixel = shown.labels().as_slice().iter().position(|&label| label == 1).unwrap();
    let pixel = PixelIndex::from_index(pixel);
    let answers = why(shown, &trace, names, Some(pixel), None, None);
    let (about, history) = answers.pixel.unwrap();
    assert_eq!(about, pixel);
    assert_eq!(history.first().map(|account| account.stage), Some(Stage::Split), "{history:?}");
    assert_eq!(history.last().map(|account| account.stage), Some(Stage::Masks), "{history:?}");
    assert!(history.is_sorted_by(|a, b| a.step >= b.step));
    let (hypothesis, story) = answers.hypothesis.unwrap();
    assert_eq!(names.region_of(hypothesis), RegionId::from_label(1));
    assert!(matches!(trace.event(story[0].step.unwrap()), Some(Event::HypothesisChosen(_))));
    let (region, made_of) = answers.region.unwrap();
    assert_eq!((region.get(), made_of[0].depth), (1, 0));
    assert!(made_of.iter().all(|account| trace.event(account.step.unwrap()).is_some()));

    let of_hypothesis = why(shown, &trace, names, None, Some(hypothesis), None);
    assert_eq!((of_hypothesis.pixel, of_hypothesis.hypothesis.unwrap().1), (None, story));
    assert_eq!(
        why(shown, &trace, names, Some(OUTSIDE), Some(HypothesisId::from_index(u16::MAX.into())), None),
        Why::default()
    );
}
