//! Every event of the table has a sentence, objects and subjects that agree with one another.

use super::{Describe, LineObjects, line_objects};
use crate::describe::Names;
use crate::raster::RegionId;
use crate::trace::{self, Event, EventData, Kind, Subject};
use serde_json::Value;
use std::collections::BTreeSet;

/// One example of each event. A new row of the table needs an example before this compiles.
fn examples() -> Vec<Event> {
    macro_rules! made {
        ($($data:path,)*) => { vec![$(Event::from(<$data as Describe>::example())),*] };
    }
    trace::all_events!(made)
}

#[test]
fn every_kind_is_listed_once_under_a_name_of_its_own() {
    let names: BTreeSet<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    assert_eq!(names.len(), Kind::ALL.len(), "names differ");
    let made: BTreeSet<Kind> = examples().iter().map(Event::kind).collect();
    let of_pixels = [Kind::Claim, Kind::Refusal, Kind::Label];
    let listed: BTreeSet<Kind> = Kind::ALL.into_iter().filter(|kind| !of_pixels.contains(kind)).collect();
    assert_eq!(made, listed, "every kind but those of pixels is the kind of an event");
}

#[test]
fn every_event_has_a_sentence_of_its_own() {
    let names = Names::default();
    let sentences: BTreeSet<String> = examples().iter().map(|event| names.event(event)).collect();
    assert_eq!(sentences.len(), examples().len(), "{sentences:#?}");
    for sentence in sentences {
        assert!(sentence.len() > 10 && !sentence.ends_with('.'), "{sentence:?}");
    }
}

/// Numbers of the hypotheses, regions and blobs that the `ids` of a trace line name, by the keys that name them.
fn named(ids: &Value) -> BTreeSet<(&'static str, u64)> {
    let id = |key: &str| ids.get(key).and_then(Value::as_u64);
    let hypotheses = ["region", "into", "by", "part"].into_iter().filter_map(id);
    let regions = id("final").into_iter();
    let blobs = id("blob").into_iter();
    hypotheses
        .map(|id| ("hypothesis", id))
        .chain(regions.map(|id| ("region", id)))
        .chain(blobs.map(|id| ("blob", id)))
        .collect()
}

#[test]
fn what_an_event_is_about_is_what_its_trace_line_names() {
    for event in examples() {
        let LineObjects { ids, values, thresholds } = line_objects(&Names::default(), &event);
        for object in [&ids, &values, &thresholds] {
            assert!(object.is_object(), "{event:?}: {object}");
        }
        let has_keys = [&ids, &values, &thresholds].iter().any(|object| object != &&super::nothing());
        assert!(has_keys || event.kind() == Kind::Stage, "{event:?} says nothing");
        let about: BTreeSet<(&str, u64)> = event
            .subjects()
            .into_iter()
            .flatten()
            .map(|subject| match subject {
                Subject::Hypothesis(id) => ("hypothesis", u64::from(id.get())),
                Subject::Region(id) => ("region", u64::from(id.get())),
                Subject::Blob(id) => ("blob", u64::from(id)),
            })
            .collect();
        // The areas of a merge are areas, not hypotheses.
        let ids = if event.kind() == Kind::Merge { super::nothing() } else { ids };
        assert_eq!(about, named(&ids), "{event:?}: {ids}");
    }
}

#[test]
fn large_numbers_are_in_groups_in_sentences_and_plain_in_trace_lines() {
    let chosen = trace::HypothesisChosen { pixels: 14_452, ..trace::HypothesisChosen::example() };
    let sentence = chosen.sentence(&Names::default());
    assert!(sentence.contains("14\u{2009}452 unclaimed pixels"), "{sentence}");
    assert_eq!(chosen.line_objects(&Names::default()).values["pixels"], 14_452);
    let classified =
        trace::WindowClassified { eigenvalues: [16_256.25, 2.0, -0.1], ..trace::WindowClassified::example() };
    let sentence = classified.sentence(&Names::default());
    assert!(sentence.contains("variances 16\u{2009}256.2, 2.0, 0.0 counts"), "{sentence}");
    assert_eq!(classified.line_objects(&Names::default()).values["eigenvalues"][0], 16_256.25);
}

#[test]
fn an_event_on_the_heap_counts_its_structure() {
    for event in examples() {
        let inline = size_of::<Event>();
        assert!(inline <= 64, "events are kept by the hundred thousand: {inline} bytes each");
        let boxed = matches!(event.kind(), Kind::Masks | Kind::Slice | Kind::Vectors | Kind::Candidate);
        assert!(!boxed || event.heap_bytes() > inline, "{event:?}");
    }
    let list = trace::Renumbered { regions: vec![None; 100].into() };
    assert_eq!(list.heap_bytes(), 200);
    let boxed = Event::from(trace::BranchesSought {
        region: RegionId::from_index(0),
        cores: Vec::new(),
        gaps: Vec::new(),
    });
    assert_eq!(boxed.heap_bytes(), size_of::<trace::BranchesSought>());
}
