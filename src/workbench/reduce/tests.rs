use super::*;
use crate::segment::Setting;
use crate::truth::sample;
use crate::workbench::{Ask, Executor, Item, Workbench};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");
const SIGMA: Parameter = Parameter::CameraNoise;
const DRAG: Option<Gesture> = Some(Gesture::Parameter(SIGMA));

fn tiny() -> Origin {
    Origin::File(TINY.into())
}

/// A bench in whose calls all work is done, with the tiny scene open.
fn opened_tiny() -> Workbench {
    let mut bench = Workbench::new(Executor::Inline, || ()).unwrap();
    bench.apply(Command::Open(tiny()));
    bench
}

fn sigma(bench: &Workbench) -> Setting {
    bench.state().document.params.camera_noise
}

fn set_sigma(value: f64) -> Command {
    Command::SetParameter(SIGMA, Setting::Value(value), DRAG)
}

#[test]
fn a_sample_opens_and_is_analysed() {
    let mut bench = Workbench::new(Executor::Inline, || ()).unwrap();
    bench.apply(Command::Open(Origin::Sample(sample::NAME.into())));
    let state = bench.state();
    let shown = state.shown().unwrap();
    assert!(state.is_current() && state.jobs.reading.is_none() && state.jobs.analysis.is_none());
    assert!(shown.analysis.intrinsic.regions.len() >= 8 && shown.coverage > 0.9);
    assert_eq!(shown.region_colours.len(), shown.analysis.intrinsic.regions.len());
    assert!(shown.accuracy().unwrap().scores.illum_deg < 2.0);
    assert!(state.recent.is_empty(), "a sample is no file");
}

#[test]
fn a_drag_is_one_step() {
    let mut bench = opened_tiny();
    let before = sigma(&bench);
    for value in [3.0, 3.5, 4.0] {
        bench.apply(set_sigma(value));
    }
    bench.apply(Command::EndGesture);
    bench.apply(set_sigma(5.0));
    assert!(bench.state().is_current());
    bench.apply(Command::Undo);
    assert_eq!(sigma(&bench), Setting::Value(4.0));
    bench.apply(Command::Undo);
    assert_eq!(sigma(&bench), before);
    assert!(bench.state().is_current() && !bench.state().history.can_undo());
    bench.apply(Command::Redo);
    assert_eq!(sigma(&bench), Setting::Value(4.0));
    assert!((bench.state().shown().unwrap().analysis.used.camera_noise - 4.0).abs() < 1e-12);
    bench.apply(set_sigma(6.0));
    assert!(!bench.state().history.can_redo(), "what was undone is gone after a change");
}

#[test]
fn a_value_out_of_range_changes_nothing_and_is_said_once() {
    let mut bench = opened_tiny();
    let before = bench.state().document.clone();
    for _ in 0..2 {
        bench.apply(set_sigma(-1.0));
    }
    assert_eq!(bench.state().document, before);
    let notices = &bench.state().notices;
    assert_eq!(notices.len(), 1);
    assert!(notices[0].text.contains("camera_noise"));
    let id = notices[0].id;
    bench.apply(Command::Dismiss(id));
    assert!(bench.state().notices.is_empty());
}

#[test]
fn a_selected_region_follows_its_heir() {
    let mut bench = opened_tiny();
    let shown = Arc::clone(bench.state().shown().unwrap());
    assert!(!shown.analysis.intrinsic.regions.is_empty());
    bench.apply(Command::Select(Some(Item::Region(1))));
    bench.apply(Command::SetMethod(Method::Paper));
    let after = bench.state().shown().unwrap();
    let heir = crate::workbench::shown::heir(shown.labels(), after.labels(), 1);
    assert_eq!(bench.state().document.selection.item, heir.map(Item::Region));
    assert_eq!(bench.state().selected_region(), heir);
}

#[test]
fn masks_join_leave_and_turn_over() {
    let mut bench = opened_tiny();
    let (width, height) = bench.state().picture.as_ref().unwrap().size();
    let of = |test: &dyn Fn(usize) -> bool| -> Arc<Mask> {
        Arc::new(Raster::from_vec(width, height, (0..width * height).map(test).collect()).unwrap())
    };
    let marked = |bench: &Workbench| bench.state().document.selection.marked.clone();
    let count =
        |bench: &Workbench| marked(bench).map_or(0, |m| m.as_slice().iter().filter(|&&on| on).count());
    bench.apply(Command::Mark(of(&|i| i < 10), Combine::Replace, None));
    bench.apply(Command::Mark(of(&|i| (5..20).contains(&i)), Combine::Union, None));
    assert_eq!(count(&bench), 20);
    bench.apply(Command::Mark(of(&|i| i < 4), Combine::Subtract, None));
    assert_eq!(count(&bench), 16);
    bench.apply(Command::InvertMarked);
    assert_eq!(count(&bench), width * height - 16);
    bench.apply(Command::Undo);
    bench.apply(Command::Mark(of(&|_| true), Combine::Subtract, None));
    assert_eq!(marked(&bench), None, "an empty mask is no mask");
    bench.apply(Command::InvertMarked);
    assert_eq!(count(&bench), width * height);
    let generation = bench.state().generation;
    bench.apply(Command::ClearSelection);
    assert!(bench.state().document.selection.is_empty());
    assert_eq!(bench.state().generation, generation, "nothing of this needs an analysis");
}

#[test]
fn an_area_restricts_the_analysis_and_undo_lifts_it() {
    let mut bench = opened_tiny();
    let (width, height) = bench.state().picture.as_ref().unwrap().size();
    let left: Vec<bool> = (0..width * height).map(|i| i % width < width / 2).collect();
    let area = Arc::new(Raster::from_vec(width, height, left).unwrap());
    bench.apply(Command::RestrictTo(Some(Arc::clone(&area))));
    let labels = bench.state().shown().unwrap().labels();
    assert!((0..labels.len()).all(|pixel| area[pixel] || labels[pixel] == 0));
    bench.apply(Command::Undo);
    assert!(bench.state().document.area.is_none() && bench.state().is_current());
    assert!(bench.state().shown().unwrap().area.is_none());
}

#[test]
fn a_pinned_illuminant_is_a_parameter() {
    let mut bench = opened_tiny();
    bench.apply(Command::PinIlluminant(Some([1.0, 1.0, 1.0]), None));
    let light = bench.state().shown().unwrap().analysis.illuminant.unwrap();
    assert!((light.direction[0] - 3f64.sqrt().recip()).abs() < 1e-9);
    bench.apply(Command::PinIlluminant(Some([0.0; 3]), None));
    assert_eq!(bench.state().notices.len(), 1, "no light is no colour");
    bench.apply(Command::Undo);
    assert_eq!(bench.state().document.params.illuminant, IlluminantSetting::Auto);
}

#[test]
fn a_second_photograph_keeps_the_parameters_and_forgets_the_rest() {
    let mut bench = opened_tiny();
    bench.apply(set_sigma(4.0));
    bench.apply(Command::Select(Some(Item::Region(1))));
    bench.apply(Command::InvertMarked);
    bench.apply(Command::Pin(true));
    bench.apply(Command::Open(Origin::Sample(sample::NAME.into())));
    let state = bench.state();
    assert_eq!(state.picture.as_ref().unwrap().origin.name(), sample::NAME);
    assert_eq!(sigma(&bench), Setting::Value(4.0));
    assert!(state.document.selection.is_empty() && state.pinned.is_none() && !state.history.can_undo());
    assert_eq!(state.recent, [PathBuf::from(TINY)]);
}

#[test]
fn what_cannot_be_opened_leaves_everything_as_it_was() {
    let mut bench = opened_tiny();
    bench.apply(Command::Select(Some(Item::Region(1))));
    let (document, newest) = (bench.state().document.clone(), bench.state().newest.clone().unwrap());
    for origin in [Origin::File("nowhere.png".into()), Origin::Sample("nothing".into())] {
        let name = origin.name();
        bench.apply(Command::Open(origin));
        let notice = bench.state().notices.last().unwrap();
        assert!(notice.severity == Severity::Error && notice.text.contains(&name), "{}", notice.text);
    }
    let state = bench.state();
    assert_eq!(state.document, document);
    assert!(Arc::ptr_eq(state.newest.as_ref().unwrap(), &newest) && state.jobs.reading.is_none());
}

#[test]
fn a_pinned_result_stays_while_parameters_change() {
    let mut bench = opened_tiny();
    bench.apply(Command::ShowPinned(true));
    assert!(!bench.state().view.show_pinned, "there is nothing to show");
    bench.apply(Command::Pin(true));
    let pinned = Arc::clone(bench.state().pinned.as_ref().unwrap());
    bench.apply(set_sigma(6.0));
    assert!(!Arc::ptr_eq(bench.state().shown().unwrap(), &pinned));
    bench.apply(Command::ShowPinned(true));
    assert!(Arc::ptr_eq(bench.state().shown().unwrap(), &pinned));
    let found = crate::workbench::compare(&pinned, bench.state().newest.as_ref().unwrap()).unwrap();
    assert_eq!(found.settings.len(), 1);
    bench.apply(Command::Pin(false));
    assert!(bench.state().pinned.is_none() && !bench.state().view.show_pinned);
}

#[test]
fn a_photograph_is_read_again_in_another_encoding() {
    let mut bench = opened_tiny();
    let before = bench.state().picture.as_ref().unwrap().photo.image.pixels[0];
    let options = ReadOptions { full_scale: Some(510.0), ..ReadOptions::default() };
    bench.apply(Command::ReadAs(options));
    let picture = bench.state().picture.as_ref().unwrap();
    assert_eq!(picture.reading, options);
    assert!((picture.photo.image.pixels[0][0] - 2.0 * before[0]).abs() < 1e-3);
}

#[test]
fn a_workspace_brings_everything_back() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("a.dichroscope");
    let mut bench = opened_tiny();
    bench.apply(Command::Pin(true));
    bench.apply(set_sigma(4.0));
    bench.apply(Command::Select(Some(Item::Pixel(5))));
    bench.apply(Command::InvertMarked);
    bench.apply(Command::Layout("three columns".into()));
    bench.apply(Command::ShowPinned(true));
    let (document, view) = (bench.state().document.clone(), bench.state().view.clone());
    bench.apply(Command::Export(Export::Workspace { path: path.clone() }));
    assert!(path.is_file(), "{:?}", bench.state().notices);

    let mut again = Workbench::new(Executor::Inline, || ()).unwrap();
    again.apply(Command::OpenWorkspace(path.clone()));
    let state = again.state();
    assert_eq!((&state.document, &state.view), (&document, &view), "{:?}", state.notices);
    assert!(state.is_current() && !state.history.can_undo());
    let pinned = state.pinned.as_ref().unwrap();
    assert_eq!(pinned.params, Params::default());
    assert_eq!(pinned.labels(), bench.state().pinned.as_ref().unwrap().labels());

    std::fs::write(&path, "{").unwrap();
    again.apply(Command::OpenWorkspace(path));
    assert_eq!(again.state().document, document);
    assert!(again.state().notices.last().unwrap().text.contains("is no workspace"));
}

#[test]
fn a_mask_of_another_size_is_left_out_of_a_workspace() {
    let mut bench = opened_tiny();
    let mut workspace = Workspace::of(bench.state()).unwrap();
    workspace.marked = Some(MaskRuns::of(&Raster::filled(3, 3, true)));
    bench.apply(Command::Restore(Box::new(workspace)));
    assert_eq!(bench.state().document.selection.marked, None);
    assert!(bench.state().notices[0].text.contains("another size"));
}

#[test]
fn one_export_at_a_time() {
    let mut state = State::default();
    state.jobs.export = Some(crate::workbench::Job::now());
    let effects = reduce(&mut state, Command::Export(Export::Regions { path: "a".into() }));
    assert!(effects.is_empty() && state.notices[0].text.contains("under way"));
    reduce(&mut state, Command::Exporting { done: 2, total: 5 });
    assert_eq!(state.jobs.export.unwrap().files, Some((2, 5)));
    reduce(&mut state, Command::Exported(Ok("wrote it".into())));
    assert!(state.jobs.export.is_none());
}

/// Polls whenever the workers say that there is something, until `done`.
fn wait(bench: &mut Workbench, woken: &Receiver<()>, done: impl Fn(&State) -> bool) {
    while !done(bench.state()) {
        woken.recv_timeout(Duration::from_mins(2)).expect("the workers have something to say");
        bench.poll();
    }
}

#[test]
fn on_threads_the_newest_request_wins() {
    let (ring, woken) = mpsc::channel();
    let mut bench = Workbench::new(Executor::Threads, move || _ = ring.send(())).unwrap();
    bench.apply(Command::Open(tiny()));
    assert!(bench.state().picture.is_none(), "the caller does not wait");
    wait(&mut bench, &woken, State::is_current);
    for step in 0..20 {
        bench.apply(set_sigma(2.0 + 0.1 * f64::from(step)));
    }
    let newest = bench.state().generation;
    assert!(bench.state().jobs.analysis.is_some() && !bench.state().is_current());
    wait(&mut bench, &woken, State::is_current);
    let shown = bench.state().shown().unwrap();
    assert_eq!((shown.generation, shown.params.camera_noise), (newest, Setting::Value(2.0 + 0.1 * 19.0)));
    assert!(bench.state().jobs.analysis.is_none());
    // What an overtaken request still has to say is not heard.
    let late = Arc::clone(shown);
    bench.apply(set_sigma(3.0));
    wait(&mut bench, &woken, State::is_current);
    bench.apply(Command::Analysed(late));
    assert!(bench.state().is_current());
    // The scores come after the result, without holding it up.
    wait(&mut bench, &woken, |state| state.shown().is_some_and(|shown| shown.accuracy().is_some()));
}

#[test]
fn what_would_change_a_pixel_is_asked_in_the_background_and_forgotten_with_the_result() {
    let mut bench = opened_tiny();
    let labels = bench.state().shown().unwrap().labels().clone();
    let pixel = labels.as_slice().iter().position(|&label| label == 1).unwrap() as u32;
    let kind_of = |bench: &Workbench| bench.state().shown().unwrap().analysis.intrinsic.kinds[pixel as usize];
    let before = kind_of(&bench);
    bench.apply(Command::Ask(Ask::WhatIf(Some(pixel))));
    let inquiry = bench.state().inquiry.clone().unwrap();
    let found = inquiry.found.expect("inline it has ended");
    assert!(inquiry.done == inquiry.total && !found.is_empty());
    let first = found[0];
    bench.apply(Command::SetParameter(first.parameter, Setting::Value(first.at), None));
    assert!(bench.state().inquiry.is_none(), "another result, another question");
    let now = bench.state().shown().unwrap().labels();
    let stayed = crate::workbench::shown::heirs(&labels, now)[1] == now[pixel as usize];
    assert_eq!(kind_of(&bench), first.after.kind, "what was foretold has come");
    assert!(!stayed || kind_of(&bench) != before, "and it is another fate");
    bench.apply(Command::Ask(Ask::WhatIf(Some(u32::MAX))));
    assert!(bench.state().inquiry.is_none(), "no such pixel");
}
