//! Tests of files that are opened together: their order, files that cannot be read, pictures of another program, and workspaces.

use super::{reduce, reduce_report};
use crate::app::awaited::AfterPin;
use crate::app::report::{Report, WrittenWorkspace};
use crate::app::{
    Application, Edit, Effect, Executor, ExportKind, JobCommand, Question, Severity, State, Switching,
};
use crate::export::png_of_gray;
use crate::params::{Parameter, Params, Setting};
use crate::raster::PixelIndex;
use crate::view::testing::{gray, tiny};
use crate::view::{Elsewhere, ElsewhereKind, ElsewherePaths, Layer, Origin};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

/// A folder with copies of a photograph, and a label map and a diffuse picture of its size.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["first.png", "a.png", "b.png", "diffuse.png"] {
        std::fs::copy(TINY, folder.path().join(name)).unwrap();
    }
    let (width, height) = opened(&[PathBuf::from(TINY)]).state().picture.as_ref().unwrap().size();
    let labels = png_of_gray(&crate::raster::Raster::filled(width, height, 1u8));
    std::fs::write(folder.path().join("labels.png"), labels).unwrap();
    std::fs::write(folder.path().join("letter.png"), "dear all").unwrap();
    folder
}

/// An application in which files were opened together.
fn opened(paths: &[PathBuf]) -> Application {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    open(&mut application, paths);
    application
}

fn open(application: &mut Application, paths: &[PathBuf]) {
    application.apply(JobCommand::OpenFiles(paths.iter().cloned().map(Origin::File).collect()));
}

/// The names of the open photographs: the one that is shown, and then the others in the order of the circle.
fn names(state: &State) -> Vec<String> {
    let others = state.others.iter().map(|other| &other.picture);
    state.picture.iter().chain(others).map(|picture| picture.origin.name()).collect()
}

/// Whether a notice contains these words.
fn tells(state: &State, words: &str) -> bool {
    state.notices.iter().any(|notice| notice.text.contains(words))
}

#[test]
fn of_more_photographs_than_can_be_open_the_first_is_shown_too() {
    let names: Vec<String> = (1..=11).map(|number| format!("{number}.png")).collect();
    let origins = names.iter().map(|name| Origin::File(name.into())).collect();
    let mut state = State::default();
    let effects = reduce(&mut state, JobCommand::OpenFilesFirstShown(origins));
    let [Effect::ReadTogether(files)] = effects.as_slice() else { panic!("{effects:?}") };
    let opened: Vec<String> = files.photographs.iter().map(Origin::name).collect();
    assert!(opened.len() == 8 && opened[0] == "1.png" && files.shows_first);
    assert!(state.notices.iter().any(|notice| notice.text.starts_with("3 photographs (from 9.png on)")));
}

#[test]
fn of_several_files_the_first_that_can_be_read_is_shown_and_the_reason_for_the_other_stays() {
    let folder = folder();
    let files =
        ["letter.png", "a.png", "b.png", "first.png"].map(|name| Origin::File(folder.path().join(name)));
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::OpenFilesFirstShown(files.into()));
    assert_eq!(names(application.state()), ["a.png", "b.png", "first.png"]);
    assert!(tells(application.state(), "letter.png"));
}

#[test]
fn the_photographs_in_a_folder_are_opened_and_the_first_that_can_be_read_is_shown() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    let open = |application: &mut Application, path: &Path| {
        application.apply(JobCommand::OpenFolders(vec![Origin::File(path.to_path_buf())]));
    };
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    open(&mut application, folder.path());
    let state = application.state();
    assert_eq!(names(state), ["a.png", "b.png", "first.png"]);
    assert!(tells(state, "letter.png") && tells(state, "labels.png is taken for a label map"));
    open(&mut application, &folder.path().join("empty"));
    let state = application.state();
    assert!(tells(state, "no photograph lies in this folder") && state.jobs.reading.is_none());
    assert_eq!(names(state), ["a.png", "b.png", "first.png"], "nothing else happened");
}

#[test]
fn every_photograph_is_opened_in_order_and_the_pictures_of_another_program_belong_to_the_last() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let mut application = opened(&[path("first.png")]);
    open(&mut application, &["labels.png", "a.png", "diffuse.png", "b.png"].map(path));
    let state = application.state();
    assert_eq!(names(state), ["b.png", "first.png", "a.png"]);
    assert!(state.is_current() && state.jobs.reading.is_none());
    let elsewhere = state.elsewhere.as_ref().unwrap();
    assert!(ElsewhereKind::ALL.into_iter().all(|kind| elsewhere.has(kind)));
    assert_eq!(state.view.image.layer, Layer::OtherBody, "the picture that was read last is shown");
    for name in ["labels.png is taken for a label map", "diffuse.png is taken for a diffuse picture"] {
        assert!(tells(state, name), "told after the photographs were opened: {:?}", state.notices);
    }
    application.apply(JobCommand::Switch(Switching::Previous));
    let state = application.state();
    assert!(names(state)[0] == "a.png" && state.elsewhere.is_none());
}

#[test]
fn pictures_of_another_program_alone_belong_to_the_photograph_that_is_open() {
    let folder = folder();
    let mut application = opened(&[folder.path().join("a.png")]);
    open(&mut application, &["labels.png", "diffuse.png"].map(|name| folder.path().join(name)));
    let state = application.state();
    assert_eq!(names(state), ["a.png"]);
    assert!(ElsewhereKind::ALL.into_iter().all(|kind| state.elsewhere.as_ref().unwrap().has(kind)));
}

#[test]
fn a_file_that_cannot_be_read_does_not_keep_the_others_from_being_opened() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let application = opened(&["a.png", "letter.png", "b.png"].map(path));
    assert_eq!(names(application.state()), ["b.png", "a.png"]);
    assert!(tells(application.state(), "letter.png"));
    // A label map is not compared with a photograph that it does not belong to.
    let application = opened(&["a.png", "labels.png", "letter.png"].map(path));
    let state = application.state();
    assert!(names(state) == ["a.png"] && state.elsewhere.is_none());
    let error = state.notices.iter().find(|notice| notice.severity == Severity::Error).unwrap();
    let label_map = format!("without it, the label map {} cannot be compared", path("labels.png").display());
    assert!(error.text.contains("letter.png") && error.text.contains(&label_map), "{}", error.text);
}

#[test]
fn a_workspace_saves_the_document_that_was_written_of_the_photograph_that_was_written() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let mut application = opened(&[path("a.png")]);
    let set_noise = |counts: f64| Edit::SetParameter(Parameter::CameraNoise, Setting::Value(counts), None);
    application.apply(set_noise(4.0));
    let written = |state: &State| WrittenWorkspace {
        path: path("w.dichroscope"),
        picture: Arc::clone(state.picture.as_ref().unwrap()),
        document: state.document.clone(),
    };
    let report = |written: WrittenWorkspace| Report::Exported {
        outcome: Ok("written".to_owned()),
        workspace: Some(Box::new(written)),
    };
    let early = written(application.state());
    application.apply(set_noise(5.0));
    application.take_report(report(early));
    assert!(
        application.state().is_unsaved(),
        "what was changed while the file was written is not in the file"
    );
    let late = written(application.state());
    open(&mut application, &[path("b.png")]);
    application.apply(set_noise(6.0));
    application.take_report(report(late));
    let state = application.state();
    assert!(state.is_unsaved() && state.workspace_path.is_none(), "another photograph is shown meanwhile");
    let other = &state.others[0];
    assert!(!other.is_unsaved() && other.workspace_path == Some(path("w.dichroscope")));
}

#[test]
fn a_workspace_is_opened_after_the_photographs_with_the_pictures_of_another_program() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let mut application = opened(&[path("b.png")]);
    application.apply(Edit::SetParameter(Parameter::CameraNoise, Setting::Value(4.0), None));
    application.apply(JobCommand::Export(ExportKind::Workspace.to(path("w.dichroscope"))));
    let application = opened(&["w.dichroscope", "labels.png", "a.png", "letter.png"].map(path));
    let state = application.state();
    assert_eq!(names(state), ["b.png", "a.png"]);
    assert_eq!(state.document.params.camera_noise, Setting::Value(4.0));
    assert_eq!(state.workspace_path, Some(path("w.dichroscope")));
    assert!(state.elsewhere.as_ref().is_some_and(|elsewhere| elsewhere.has(ElsewhereKind::Labels)));
    assert!(tells(state, "letter.png: "), "told after the workspace was opened: {:?}", state.notices);
    std::fs::write(path("w.dichroscope"), "{").unwrap();
    let application = opened(&["labels.png", "w.dichroscope", "a.png"].map(path));
    let state = application.state();
    assert!(names(state) == ["a.png"] && state.elsewhere.is_none());
    assert!(tells(state, "is no workspace") && tells(state, "labels.png cannot be compared"));
}

#[test]
fn a_label_map_waits_for_its_own_photograph_and_not_for_another_one_that_is_read_at_the_same_time() {
    let mut state = State::default();
    reduce(&mut state, JobCommand::Open(Origin::File("slow.png".into())));
    let files = ["a.png", "labels.png"].map(|name| Origin::File(name.into()));
    let effects = reduce(&mut state, JobCommand::OpenFiles(files.to_vec()));
    let [Effect::ReadTogether(files)] = effects.as_slice() else { panic!("{effects:?}") };
    let labels = ElsewherePaths::default().with(ElsewhereKind::Labels, "labels.png".into());
    assert_eq!(files.elsewhere, labels);
    let reads_labels = |effects: &[Effect]| {
        let of_labels = |effect: &Effect| matches!(effect, Effect::ReadElsewhere { path, shows: true, .. } if path == Path::new("labels.png"));
        effects.iter().any(of_labels)
    };
    let slow = reduce_report(&mut state, Report::Opened(gray(&[".."], 9)));
    assert!(!reads_labels(&slow), "the label map is not of this photograph");
    let mut picture = Arc::into_inner(gray(&[".."], 9)).unwrap();
    picture.origin = Origin::File("a.png".into());
    let read = Report::OpenedTogether {
        photographs: vec![Ok(Arc::new(picture))],
        elsewhere: files.elsewhere.clone(),
        workspace: None,
    };
    assert!(reads_labels(&reduce_report(&mut state, read)));
    assert_eq!(state.picture.unwrap().origin.name(), "a.png");
}

#[test]
fn the_photographs_that_are_closed_because_no_more_can_be_open_are_named() {
    let mut state = State::default();
    let mut open = |name: &str| {
        let mut picture = Arc::into_inner(gray(&[".."], 9)).unwrap();
        picture.origin = Origin::File(name.into());
        reduce_report(&mut state, Report::Opened(Arc::new(picture)));
        state
            .notices
            .iter()
            .map(|notice| notice.text.clone())
            .filter(|text| text.contains("closed"))
            .collect()
    };
    for number in 1..=8 {
        let told: Vec<String> = open(&format!("{number}.png"));
        assert!(told.is_empty(), "{told:?}");
    }
    assert_eq!(open("9.png"), ["1.png was closed: 8 photographs can be open at once"]);
    assert_eq!(open("9.png").len(), 1, "a photograph that is read again closes none");
}

#[test]
fn a_photograph_that_is_read_again_with_others_keeps_its_label_map() {
    let picture = |name: &str| {
        let mut picture = Arc::into_inner(gray(&[".."], 9)).unwrap();
        picture.origin = Origin::File(name.into());
        Arc::new(picture)
    };
    let mut state = State::default();
    reduce_report(&mut state, Report::Opened(picture("a.png")));
    let labels = ElsewherePaths::default().with(ElsewhereKind::Labels, "labels.png".into());
    let elsewhere = Arc::new(Elsewhere { paths: labels.clone(), ..Elsewhere::default() });
    state.elsewhere = Some(elsewhere);
    let photographs = ["a.png", "b.png"].map(|name| Ok(picture(name)));
    let read = Report::OpenedTogether {
        photographs: photographs.into(),
        elsewhere: ElsewherePaths::default(),
        workspace: None,
    };
    reduce_report(&mut state, Report::Opened(picture("b.png")));
    reduce_report(&mut state, read);
    assert_eq!(names(&state), ["b.png", "a.png"]);
    assert!(state.elsewhere.is_none(), "b.png has none");
    let of_a = state.others[0].elsewhere.as_ref().expect("the label map of a.png");
    assert_eq!(of_a.paths, labels);
}

#[test]
fn what_a_photograph_waits_for_comes_also_after_another_one_was_shown() {
    let result = tiny();
    let mut state = State::default();
    reduce_report(&mut state, Report::Opened(Arc::clone(&result.picture)));
    reduce_report(&mut state, Report::Opened(gray(&[".."], 9)));
    reduce(&mut state, JobCommand::Switch(Switching::Next));
    state.generation = result.generation;
    reduce_report(&mut state, Report::Analyzed(Arc::clone(&result)));
    assert!(state.selected_region().is_some(), "the largest region is selected by the first result");
    let pixel = PixelIndex::from_index(5);
    reduce(&mut state, Question::Why(pixel));
    for _ in 0..2 {
        reduce(&mut state, JobCommand::Switch(Switching::Next));
    }
    assert_eq!(state.explained_pixel(), Some(pixel), "the clicked pixel is kept with its photograph");
}

#[test]
fn a_workspace_whose_pinned_result_is_being_computed_is_saved_and_left_whole() {
    let mut picture = Arc::into_inner(gray(&[".."], 9)).unwrap();
    picture.origin = Origin::File("a.png".into());
    let mut state = State::default();
    reduce_report(&mut state, Report::Opened(Arc::new(picture)));
    let (pinned, params) = (Params::paper(), Params::default());
    state.document.params = pinned;
    state.awaited.after_pin = Some(AfterPin { params, item: None, show_pinned: true });
    let is_whole = |state: &State| {
        let saved = state.workspace().unwrap();
        (saved.params, saved.pinned) == (params, Some(pinned)) && saved.view.show_pinned
    };
    assert!(is_whole(&state));
    reduce_report(&mut state, Report::Opened(gray(&[".."], 8)));
    reduce(&mut state, JobCommand::Switch(Switching::Next));
    assert!(is_whole(&state), "after another photograph was shown");
}

#[test]
fn a_photograph_that_is_opened_again_is_shown_as_it_was_left_unless_its_file_has_changed() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    let mut application = opened(&[path("a.png")]);
    application.apply(Edit::InvertMarked);
    for others in [0, 1] {
        if others == 1 {
            open(&mut application, &[path("b.png")]);
            assert!(application.state().document.selection.marked.is_none());
        }
        open(&mut application, &[path("a.png")]);
        let state = application.state();
        assert_eq!(names(state)[0], "a.png");
        assert!(state.others.len() == others && state.is_current() && state.history.can_undo());
        assert!(state.document.selection.marked.is_some() && tells(state, "a.png is open already"));
    }
    std::fs::write(path("a.png"), std::fs::read(path("labels.png")).unwrap()).unwrap();
    open(&mut application, &[path("a.png")]);
    let state = application.state();
    assert!(state.document.selection.marked.is_none() && state.others.len() == 1, "another picture");
}
