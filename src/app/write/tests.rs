use super::*;
use crate::app::{Application, Executor, JobCommand, State};
use crate::truth::sample;
use crate::view::testing::{divided, gray};
use crate::view::{ImageSettings, Item, Origin};
use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const ROWS: [&str; 3] = ["1111", "1122", ".222"];

/// A bench with a gray picture and two regions, the second selected.
fn input() -> ExportInput {
    let picture = gray(&ROWS, 120);
    let shown = Arc::new(divided(&picture, &ROWS));
    let mut state = State { picture: Some(picture), newest: Some(shown), ..State::default() };
    state.document.selection.item = Some(Item::Region(2));
    ExportInput::of(&state)
}

fn write_one(export: &Export, input: &ExportInput) -> Result<String, String> {
    write(export, input, &Stop::default(), &|_, _| ())
}

#[test]
fn every_file_is_written_and_said() {
    let root = tempfile::tempdir().unwrap();
    let at = |name: &str| root.path().join(name);
    let rgba: Arc<[u8]> = vec![255; 16].into();
    let exports = [
        (Export::Matte { path: at("m.png"), keep_surface: 0.25 }, "25 % of its surface"),
        (Export::Selection { path: at("s.png") }, "as a mask"),
        (Export::Selection { path: at("s.csv") }, "as a table"),
        (Export::Selection { path: at("s.PLY") }, "as points"),
        (Export::Regions { path: at("r.tsv") }, "regions table"),
        (Export::Profile { path: at("p.csv") }, "profile"),
        (Export::Layer { path: at("l.png"), settings: ImageSettings::default() }, "\u{201c}Input\u{201d}"),
        (Export::Picture { path: at("v.png"), size: [2, 2], rgba }, "2 \u{d7} 2 pixels"),
        (Export::Parameters { path: at("p.toml") }, "parameters"),
    ];
    for (export, word) in exports {
        let said = write_one(&export, &input()).unwrap();
        assert!(said.starts_with("wrote ") && said.contains(word), "{said}");
        assert!(said.ends_with(&export.path().display().to_string()), "{said}");
        assert!(fs::metadata(export.path()).unwrap().len() > 0);
    }
    let mask = crate::photo::read(&at("s.png"), &crate::photo::ReadOptions::default()).unwrap();
    let white = mask.image.pixels.as_slice().iter().filter(|color| color[0] > 254.0).count();
    assert_eq!(white, 5);
    let params: crate::params::Params = toml::from_str(&fs::read_to_string(at("p.toml")).unwrap()).unwrap();
    assert_eq!(params, crate::params::Params::default());
    assert_eq!(fs::read_to_string(at("p.csv")).unwrap().lines().count(), 5);
}

#[test]
fn what_cannot_be_written_is_said_with_what_to_do() {
    let root = tempfile::tempdir().unwrap();
    let fails = |export: Export, input: &ExportInput, expected: &str| {
        let error = write_one(&export, input).unwrap_err();
        assert!(error.contains(expected), "{error}");
    };
    let nothing = ExportInput::of(&State::default());
    let path = root.path().join("x.csv");
    fails(Export::Regions { path: path.clone() }, &nothing, "open a photograph first");
    fails(Export::Workspace { path: path.clone() }, &nothing, "open a photograph first");
    fails(Export::Area { path: path.clone() }, &input(), "not restricted");
    fails(Export::Selection { path: root.path().join("x.txt") }, &input(), ".png (mask), .csv (table)");
    let unselected = ExportInput { document: crate::app::Document::default(), ..input() };
    fails(Export::Selection { path: path.clone() }, &unselected, "nothing is selected");
    let analyzing = ExportInput { shown: None, ..input() };
    fails(Export::Matte { path: path.clone(), keep_surface: 0.0 }, &analyzing, "still under way");
    fs::write(&path, "a file").unwrap();
    fails(Export::Regions { path: path.join("below") }, &input(), "choose another place");
    fails(Export::Result { folder: path.clone(), force: true }, &input(), "is a file");
    fails(Export::Result { folder: root.path().into(), force: false }, &input(), "something else");
    assert_eq!(fs::read_to_string(&path).unwrap(), "a file");
}

#[test]
fn the_matte_file_has_an_extension_that_fits() {
    let root = tempfile::tempdir().unwrap();
    let export = Export::Matte { path: root.path().join("m.jpg"), keep_surface: 0.0 };
    let said = write_one(&export, &input()).unwrap();
    assert!(said.ends_with("m.png"), "a PNM becomes a PNG: {said}");
}

#[test]
fn a_result_tells_its_progress_and_can_be_stopped() {
    let root = tempfile::tempdir().unwrap();
    let (folder, input, stop) = (root.path().join("result"), input(), Stop::default());
    let files = AtomicUsize::new(0);
    let export = Export::Result { folder: folder.clone(), force: false };
    let halt = |done: usize, total: usize| {
        assert!((1..=total).contains(&done) && total == 15);
        if done == 3 {
            stop.stop();
        }
    };
    let said = write(&export, &input, &stop, &halt).unwrap();
    assert!(said.starts_with("stopped") && !folder.exists(), "{said}");
    assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
    let count = |_, _| {
        files.fetch_add(1, Ordering::Relaxed);
    };
    write(&export, &input, &Stop::default(), &count).unwrap();
    assert_eq!(files.into_inner(), 15);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 16);
}

#[test]
fn the_workbench_exports_and_says_so() {
    let root = tempfile::tempdir().unwrap();
    let mut app = Application::new(Executor::Inline, || ()).unwrap();
    app.apply(JobCommand::Open(Origin::Sample(sample::NAME.into())));
    app.apply(JobCommand::Export(Export::Result { folder: root.path().join("r"), force: false }));
    let state = app.state();
    assert!(state.jobs.export.is_none());
    assert!(
        state.notices.iter().any(|notice| notice.text.starts_with("wrote the result")),
        "{:?}",
        state.notices
    );
    let report = crate::export::read_report(&root.path().join("r")).unwrap();
    assert!(report.scores.is_some() && report.timings_ms.split.is_some());
}
