use super::*;
use crate::app::report::Report;
use crate::app::{
    Application, Combine, Edit, Executor, ExportKind, Gesture, JobCommand, Preview, Question, Severity,
    ViewCommand,
};
use crate::params::{IlluminantSetting, Method, Parameter, Params, Setting};
use crate::photo::ReadOptions;
use crate::raster::{Mask, PixelIndex, Raster, RegionId};
use crate::truth::sample;
use crate::view::{Item, MaskRuns, Origin, ResultSnapshot};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");
const SIGMA: Parameter = Parameter::CameraNoise;
const DRAG: Option<Gesture> = Some(Gesture::Parameter(SIGMA));

fn tiny() -> Origin {
    Origin::File(TINY.into())
}

/// An application that does all work inline, with the tiny scene open.
fn opened_tiny() -> Application {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(tiny()));
    application
}

fn sigma(application: &Application) -> Setting {
    application.state().document.params.camera_noise
}

fn set_sigma(value: f64) -> Edit {
    Edit::SetParameter(SIGMA, Setting::Value(value), DRAG)
}

#[test]
fn a_sample_opens_and_is_analyzed() {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::Sample(sample::NAME.into())));
    let state = application.state();
    let shown = state.shown().unwrap();
    assert!(state.is_current() && state.jobs.reading.is_none() && state.jobs.analysis.is_none());
    assert!(shown.analysis.intrinsic.regions.len() >= 8 && shown.coverage > 0.9);
    assert_eq!(shown.region_colors.len(), shown.analysis.intrinsic.regions.len());
    assert!(shown.accuracy().unwrap().scores.illum_deg < 2.0);
    assert!(state.recent.is_empty(), "a sample is no file");
}

#[test]
fn photographs_that_are_opened_together_follow_one_another_in_their_order() {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::open_samples(&sample::THREE_LAMPS));
    for name in ["cups3_yellow", "cups3_white", "cups3_pink", "cups3_yellow"] {
        let state = application.state();
        assert_eq!((state.picture.as_ref().unwrap().origin.name().as_str(), state.others.len()), (name, 2));
        assert!(state.is_current() && state.jobs.reading.is_none());
        application.apply(JobCommand::Switch(crate::app::Switching::Next));
    }
    let missing = vec![tiny(), Origin::Sample("nothing".into())];
    application.apply(JobCommand::OpenFiles(missing));
    assert!(
        application.state().notices.iter().any(|notice| notice.text.starts_with("nothing: there is no such"))
    );
    assert_eq!(application.state().picture.as_ref().unwrap().origin, tiny(), "the other one is opened");
}

#[test]
fn recent_photographs_are_absolute_and_listed_once() {
    let mut application = opened_tiny();
    let relative = PathBuf::from("assets/tiny/../tiny/./camera8.png");
    application.apply(JobCommand::Open(Origin::File(relative)));
    assert_eq!(application.state().recent, [PathBuf::from(TINY)]);
    let old = vec![PathBuf::from("a.png"), PathBuf::from("/b.png")];
    application.restore_settings(crate::app::ViewSettings::default(), old);
    assert_eq!(application.state().recent, [PathBuf::from("/b.png")]);
}

#[test]
fn a_drag_is_one_step() {
    let mut application = opened_tiny();
    let before = sigma(&application);
    for value in [3.0, 3.5, 4.0] {
        application.apply(set_sigma(value));
    }
    application.apply(Edit::EndGesture(Gesture::Brush));
    application.apply(set_sigma(4.5));
    application.apply(set_sigma(4.0));
    application.apply(Edit::EndGesture(Gesture::Parameter(Parameter::CameraNoise)));
    application.apply(set_sigma(5.0));
    assert!(application.state().is_current());
    application.apply(Edit::Undo);
    assert_eq!(sigma(&application), Setting::Value(4.0));
    application.apply(Edit::Undo);
    assert_eq!(sigma(&application), before);
    assert!(application.state().is_current() && !application.state().history.can_undo());
    application.apply(Edit::Redo);
    assert_eq!(sigma(&application), Setting::Value(4.0));
    assert!((application.state().shown().unwrap().analysis.used.camera_noise - 4.0).abs() < 1e-12);
    application.apply(set_sigma(6.0));
    assert!(!application.state().history.can_redo(), "what was undone is gone after a change");
}

#[test]
fn a_value_out_of_range_changes_nothing_and_gives_one_notice() {
    let mut application = opened_tiny();
    let before = application.state().document.clone();
    for _ in 0..2 {
        application.apply(set_sigma(-1.0));
    }
    assert_eq!(application.state().document, before);
    let notices = &application.state().notices;
    assert_eq!(notices.len(), 1);
    assert!(notices[0].text.contains("camera_noise"));
    let id = notices[0].id;
    application.apply(ViewCommand::Dismiss(id));
    assert!(application.state().notices.is_empty());
}

#[test]
fn a_selected_region_becomes_the_region_that_overlaps_it_most() {
    let mut application = opened_tiny();
    let shown = Arc::clone(application.state().shown().unwrap());
    assert!(!shown.analysis.intrinsic.regions.is_empty());
    application.apply(Edit::Select(Some(Item::Region(RegionId::from_index(0)))));
    application.apply(Edit::SetMethod(Method::Paper));
    let after = application.state().shown().unwrap();
    let best_overlap = crate::view::best_overlap(shown.labels(), after.labels(), RegionId::from_index(0));
    assert_eq!(application.state().document.selection.item, best_overlap.map(Item::Region));
    assert_eq!(application.state().selected_region(), best_overlap);
}

#[test]
fn marks_are_added_taken_away_and_inverted() {
    let mut application = opened_tiny();
    let (width, height) = application.state().picture.as_ref().unwrap().size();
    let of = |test: &dyn Fn(usize) -> bool| -> Arc<Mask> {
        Arc::new(Raster::from_vec(width, height, (0..width * height).map(test).collect()).unwrap())
    };
    let marked = |application: &Application| application.state().document.selection.marked.clone();
    let count = |application: &Application| marked(application).map_or(0, |m| m.count());
    application.apply(Edit::Mark(of(&|i| i < 10), Combine::Replace, None));
    application.apply(Edit::Mark(of(&|i| (5..20).contains(&i)), Combine::Union, None));
    assert_eq!(count(&application), 20);
    application.apply(Edit::Mark(of(&|i| i < 4), Combine::Subtract, None));
    assert_eq!(count(&application), 16);
    application.apply(Edit::InvertMarked);
    assert_eq!(count(&application), width * height - 16);
    application.apply(Edit::Undo);
    application.apply(Edit::Mark(of(&|_| true), Combine::Subtract, None));
    assert_eq!(marked(&application), None, "an empty mask is no mask");
    application.apply(Edit::InvertMarked);
    assert_eq!(count(&application), width * height);
    let generation = application.state().generation;
    application.apply(Edit::ClearSelection);
    assert!(application.state().document.selection.is_empty());
    assert_eq!(application.state().generation, generation, "nothing of this needs an analysis");
}

#[test]
fn an_area_restricts_the_analysis_and_undo_lifts_it() {
    let mut application = opened_tiny();
    let (width, height) = application.state().picture.as_ref().unwrap().size();
    let left: Vec<bool> = (0..width * height).map(|i| i % width < width / 2).collect();
    let area = Arc::new(Raster::from_vec(width, height, left).unwrap());
    application.apply(Edit::RestrictTo(Some(Arc::clone(&area))));
    let labels = application.state().shown().unwrap().labels();
    assert!((0..labels.len()).all(|pixel| area[pixel] || labels[pixel] == 0));
    application.apply(Edit::Undo);
    assert!(application.state().document.area.is_none() && application.state().is_current());
    assert!(application.state().shown().unwrap().area.is_none());
}

#[test]
fn a_pinned_illuminant_is_a_parameter() {
    let mut application = opened_tiny();
    application.apply(Edit::PinIlluminant(Some([1.0, 1.0, 1.0]), None));
    let light = application.state().shown().unwrap().analysis.illuminant.unwrap();
    assert!((light.direction[0] - 3f64.sqrt().recip()).abs() < 1e-9);
    application.apply(Edit::PinIlluminant(Some([0.0; 3]), None));
    assert_eq!(application.state().notices.len(), 1, "no light is no color");
    application.apply(Edit::Undo);
    assert_eq!(application.state().document.params.illuminant, IlluminantSetting::Auto);
}

#[test]
fn a_pinned_second_lamp_is_a_parameter_of_the_refined_method() {
    let mut application = opened_tiny();
    let lamp = |application: &Application| application.state().document.params.second_illuminant;
    application.apply(Edit::PinSecondIlluminant(Some([0.5, 0.8, 1.0]), None));
    assert_eq!(lamp(&application), IlluminantSetting::Given([0.5, 0.8, 1.0]));
    let second = application.state().shown().unwrap().analysis.finals.light.second.unwrap();
    assert!(second.given && (second.direction[0] - 0.5 / 1.89f64.sqrt()).abs() < 1e-9, "{second:?}");
    application.apply(Edit::PinSecondIlluminant(Some([0.5, 0.0, 1.0]), None));
    assert_eq!(application.state().notices.len(), 1, "a lamp lacks no band");
    application.apply(Edit::SetMethod(Method::Paper));
    assert_eq!(lamp(&application), IlluminantSetting::Auto);
    assert!(application.state().notices[1].text.contains("is let go: paper splits with one lamp"));
    application.apply(Edit::Undo);
    assert_eq!(lamp(&application), IlluminantSetting::Given([0.5, 0.8, 1.0]), "undo brings it back");
    application.apply(Edit::PinSecondIlluminant(None, None));
    assert_eq!(lamp(&application), IlluminantSetting::Auto);
}

#[test]
fn a_second_photograph_keeps_the_parameters_and_forgets_the_rest() {
    let mut application = opened_tiny();
    application.apply(set_sigma(4.0));
    application.apply(Edit::Select(Some(Item::Region(RegionId::from_index(0)))));
    application.apply(Edit::InvertMarked);
    application.apply(ViewCommand::Pin(true));
    application.apply(JobCommand::Open(Origin::Sample(sample::NAME.into())));
    let state = application.state();
    assert_eq!(state.picture.as_ref().unwrap().origin.name(), sample::NAME);
    assert_eq!(sigma(&application), Setting::Value(4.0));
    assert!(state.document.selection.marked.is_none() && state.pinned.is_none() && !state.history.can_undo());
    assert_eq!(state.recent, [PathBuf::from(TINY)]);
}

#[test]
fn a_photograph_that_cannot_be_opened_changes_nothing() {
    let mut application = opened_tiny();
    application.apply(Edit::Select(Some(Item::Region(RegionId::from_index(0)))));
    let (document, newest) =
        (application.state().document.clone(), application.state().newest.clone().unwrap());
    for origin in [Origin::File("nowhere.png".into()), Origin::Sample("nothing".into())] {
        let name = origin.name();
        application.apply(JobCommand::Open(origin));
        let notice = application.state().notices.last().unwrap();
        assert!(notice.severity == Severity::Error && notice.text.contains(&name), "{}", notice.text);
    }
    let state = application.state();
    assert_eq!(state.document, document);
    assert!(Arc::ptr_eq(state.newest.as_ref().unwrap(), &newest) && state.jobs.reading.is_none());
}

#[test]
fn a_pinned_result_stays_while_parameters_change() {
    let mut application = opened_tiny();
    application.apply(ViewCommand::ShowPinned(true));
    assert!(!application.state().view.show_pinned, "there is nothing to show");
    application.apply(ViewCommand::Pin(true));
    let pinned = Arc::clone(application.state().pinned.as_ref().unwrap());
    application.apply(set_sigma(6.0));
    assert!(!Arc::ptr_eq(application.state().shown().unwrap(), &pinned));
    application.apply(ViewCommand::ShowPinned(true));
    assert!(Arc::ptr_eq(application.state().shown().unwrap(), &pinned));
    let found = crate::view::compare(&pinned, application.state().newest.as_ref().unwrap()).unwrap();
    assert_eq!(found.settings.len(), 1);
    application.apply(ViewCommand::Pin(false));
    assert!(application.state().pinned.is_none() && !application.state().view.show_pinned);
}

#[test]
fn a_photograph_is_read_again_in_another_encoding() {
    let mut application = opened_tiny();
    let before = application.state().picture.as_ref().unwrap().photo.image.pixels[0];
    let options = ReadOptions { full_scale: Some(510.0), ..ReadOptions::default() };
    application.apply(JobCommand::ReadAs(options));
    let picture = application.state().picture.as_ref().unwrap();
    assert_eq!(picture.reading, options);
    assert!((picture.photo.image.pixels[0][0] - 2.0 * before[0]).abs() < 1e-3);
}

#[test]
fn a_workspace_restores_all_that_it_saved() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("a.dichroscope");
    let mut application = opened_tiny();
    application.apply(ViewCommand::Pin(true));
    application.apply(set_sigma(4.0));
    application.apply(Edit::Select(Some(Item::Pixel(PixelIndex::new(5)))));
    application.apply(Edit::InvertMarked);
    application.apply(ViewCommand::Layout("three columns".into()));
    application.apply(ViewCommand::ShowPinned(true));
    let (document, view) = (application.state().document.clone(), application.state().view.clone());
    application.apply(JobCommand::Export(ExportKind::Workspace.to(path.clone())));
    assert!(path.is_file(), "{:?}", application.state().notices);

    let mut again = Application::new(Executor::Inline, || ()).unwrap();
    again.apply(JobCommand::OpenWorkspace(path.clone()));
    let state = again.state();
    assert_eq!((&state.document, &state.view), (&document, &view), "{:?}", state.notices);
    assert!(state.is_current() && !state.history.can_undo());
    let pinned = state.pinned.as_ref().unwrap();
    assert_eq!(pinned.params, Params::default());
    assert_eq!(pinned.labels(), application.state().pinned.as_ref().unwrap().labels());

    std::fs::write(&path, "{").unwrap();
    again.apply(JobCommand::OpenWorkspace(path));
    assert_eq!(again.state().document, document);
    assert!(again.state().notices.last().unwrap().text.contains("is no workspace"));
}

#[test]
fn a_mask_of_another_size_is_left_out_of_a_workspace() {
    let mut application = opened_tiny();
    let mut workspace = application.state().workspace().unwrap();
    workspace.marked = Some(MaskRuns::of(&Raster::filled(3, 3, true)));
    application
        .take_report(Report::WorkspaceRead { workspace: Box::new(workspace), path: "w.dichroscope".into() });
    application.poll();
    assert_eq!(application.state().document.selection.marked, None);
    assert!(application.state().notices[0].text.contains("another size"));
}

#[test]
fn one_export_at_a_time() {
    let mut state = State::default();
    state.jobs.export = Some(crate::app::Job::now());
    let effects = reduce(&mut state, JobCommand::Export(ExportKind::Regions.to("a")));
    assert!(effects.is_empty() && state.notices[0].text.contains("under way"));
    reduce_report(&mut state, Report::Exporting { done: 2, total: 5 });
    assert_eq!(state.jobs.export.unwrap().files, Some((2, 5)));
    reduce_report(&mut state, Report::Exported { outcome: Ok("wrote it".into()), workspace: None });
    assert!(state.jobs.export.is_none());
}

/// Polls whenever the workers say that there is something, until `done`.
fn wait(application: &mut Application, woken: &Receiver<()>, done: impl Fn(&State) -> bool) {
    while !done(application.state()) {
        woken.recv_timeout(Duration::from_mins(2)).expect("the workers have something to say");
        application.poll();
    }
}

#[test]
fn on_threads_the_newest_request_wins() {
    let (ring, woken) = mpsc::channel();
    let mut application = Application::new(Executor::Threads, move || _ = ring.send(())).unwrap();
    application.apply(JobCommand::Open(tiny()));
    assert!(application.state().picture.is_none(), "the caller does not wait");
    wait(&mut application, &woken, State::is_current);
    for step in 0..20 {
        application.apply(set_sigma(2.0 + 0.1 * f64::from(step)));
    }
    let newest = application.state().generation;
    assert!(application.state().jobs.analysis.is_some() && !application.state().is_current());
    wait(&mut application, &woken, State::is_current);
    let shown = application.state().shown().unwrap();
    assert_eq!((shown.generation, shown.params.camera_noise), (newest, Setting::Value(2.0 + 0.1 * 19.0)));
    assert!(application.state().jobs.analysis.is_none());
    // What an overtaken request still has to say is not heard.
    let late = Arc::clone(shown);
    application.apply(set_sigma(3.0));
    wait(&mut application, &woken, State::is_current);
    application.take_report(Report::Analyzed(late));
    assert!(application.state().is_current());
    // The scores come after the result, without holding it up.
    wait(&mut application, &woken, |state| state.shown().is_some_and(|shown| shown.accuracy().is_some()));
}

#[test]
fn a_preview_is_shown_until_the_result_is_there() {
    let mut application = opened_tiny();
    application.apply(Edit::SetParameter(Parameter::Scale, Setting::Value(2.0), None));
    assert!(application.state().preview.is_none(), "the result has replaced the preview");
    let shown = Arc::clone(application.state().shown().unwrap());
    assert!(!shown.is_of_working_picture());
    let preview_of = |generation: u64| {
        let (picture, analysis) = (Arc::clone(&shown.picture), shown.analysis.clone());
        let mut working = ResultSnapshot::new(picture, shown.params, analysis, shown.region_colors.clone());
        working.generation = generation;
        Report::Preview(Preview { shown: Arc::new(working), blocks: shown.analysis.working.blocks })
    };
    application.take_report(preview_of(shown.generation));
    assert!(application.state().preview.is_none(), "late: its result is shown");
    application.apply(Edit::Select(None));
    application.take_report(preview_of(shown.generation + 1));
    let selected = |application: &Application| {
        application.state().shown_preview().map(|(preview, region)| (preview.shown.generation, region))
    };
    assert_eq!(selected(&application), Some((shown.generation + 1, None)));
    let region = RegionId::from_index(1);
    application.apply(Edit::Select(Some(Item::Region(region))));
    assert_eq!(selected(&application), Some((shown.generation + 1, Some(region))), "found by its color");
    application.apply(ViewCommand::Pin(true));
    application.apply(ViewCommand::ShowPinned(true));
    assert_eq!(selected(&application), None, "the pinned result is shown");
}

#[test]
fn a_what_if_job_runs_in_the_background_and_ends_with_its_result() {
    let mut application = opened_tiny();
    let labels = application.state().shown().unwrap().labels().clone();
    let pixel = labels.as_slice().iter().position(|&label| label == 1).unwrap();
    let pixel = PixelIndex::from_index(pixel);
    let kind_of = |application: &Application| {
        application.state().shown().unwrap().analysis.intrinsic.kinds[pixel.index()]
    };
    let before = kind_of(&application);
    application.apply(Question::WhatIf(Some(pixel)));
    let what_if_job = application.state().what_if_job.clone().unwrap();
    let found = what_if_job.found.expect("inline it has ended");
    assert!(what_if_job.done == what_if_job.total && !found.is_empty());
    let first = found[0];
    application.apply(Edit::SetParameter(first.parameter, Setting::Value(first.at), None));
    assert!(application.state().what_if_job.is_none(), "another result, another question");
    let now = application.state().shown().unwrap().labels();
    let stayed = crate::view::best_overlaps(&labels, now)[1] == RegionId::from_label(now[pixel.index()]);
    assert_eq!(kind_of(&application), first.after.kind, "what was foretold has come");
    assert!(!stayed || kind_of(&application) != before, "and it is another fate");
    application.apply(Question::WhatIf(Some(PixelIndex::new(u32::MAX))));
    assert!(application.state().what_if_job.is_none(), "no such pixel");
}
