use super::*;
use crate::app::export_input::DrawnPicture;
use crate::app::{Application, Executor, JobCommand};
use crate::truth::sample;
use crate::view::testing::{divided, gray};
use crate::view::{Item, Origin};
use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const ROWS: [&str; 3] = ["1111", "1122", ".222"];

/// The input of a gray picture and two regions, the second selected.
fn input() -> ExportInput {
    let picture = gray(&ROWS, 120);
    let shown = Arc::new(divided(&picture, &ROWS));
    let generation = shown.generation;
    let mut state = State { picture: Some(picture), newest: Some(shown), generation, ..State::default() };
    state.document.selection.item = Some(Item::Region(crate::raster::RegionId::from_index(1)));
    ExportInput::of(&state)
}

/// The photograph with a share of its surface reflection.
fn matte_with_surface(keep_surface: f64, path: &Path) -> Export {
    let options = ExportOptions { keep_surface, ..ExportOptions::default() };
    Export { options, ..ExportKind::Matte.to(path) }
}

fn write_one(export: &Export, input: &ExportInput) -> Result<String, String> {
    write_export(export, input, &Stop::default(), &|_, _| ())
}

#[test]
fn every_kind_of_file_is_written_and_named() {
    let root = tempfile::tempdir().unwrap();
    let at = |name: &str| root.path().join(name);
    let drawn = Some(DrawnPicture { size: [2, 2], rgba: vec![255; 16].into() });
    let options = ExportOptions { drawn, ..ExportOptions::default() };
    let picture = Export { options, ..ExportKind::View.to(at("v.png")) };
    let exports = [
        (matte_with_surface(0.25, &at("m.png")), "25 % of its surface"),
        (ExportKind::Selection.to(at("s.png")), "as a mask"),
        (ExportKind::Selection.to(at("s.csv")), "as a table"),
        (ExportKind::Selection.to(at("s.PLY")), "as points"),
        (ExportKind::Regions.to(at("r.tsv")), "regions table"),
        (ExportKind::Regions.to(at("r.csv")), "regions table"),
        (ExportKind::Profile.to(at("p.csv")), "profile"),
        (ExportKind::Layer.to(at("l.png")), "\u{201c}Input\u{201d}"),
        (ExportKind::Figures.to(at("f.html")), "figures and tables"),
        (picture, "2 \u{d7} 2 pixels"),
        (ExportKind::Parameters.to(at("p.toml")), "parameters"),
    ];
    for (export, word) in exports {
        let text = write_one(&export, &input()).unwrap();
        assert!(text.starts_with("wrote ") && text.contains(word), "{text}");
        assert!(text.ends_with(&export.path.display().to_string()), "{text}");
        assert!(fs::metadata(&export.path).unwrap().len() > 0);
    }
    let mask = crate::photo::read(&at("s.png"), &crate::photo::ReadOptions::default()).unwrap();
    let white = mask.image.pixels.as_slice().iter().filter(|color| color[0] > 254.0).count();
    assert_eq!(white, 5);
    let params: crate::params::Params = toml::from_str(&fs::read_to_string(at("p.toml")).unwrap()).unwrap();
    assert_eq!(params, crate::params::Params::default());
    assert_eq!(fs::read_to_string(at("p.csv")).unwrap().lines().count(), 5);
    let first_heading = |name: &str| fs::read_to_string(at(name)).unwrap().chars().nth("region".len());
    assert_eq!((first_heading("r.tsv"), first_heading("r.csv")), (Some('\t'), Some(',')));
    let page = fs::read_to_string(at("f.html")).unwrap();
    assert!(page.contains("Figure 7.") && page.contains("2\u{a0}regions") && page.contains("Along row 1 "));
}

#[test]
fn an_export_that_fails_says_why_and_what_to_do() {
    let root = tempfile::tempdir().unwrap();
    let fails = |export: Export, input: &ExportInput, expected: &str| {
        let error = write_one(&export, input).unwrap_err();
        assert!(error.contains(expected), "{error}");
    };
    let nothing = ExportInput::of(&State::default());
    let path = root.path().join("x.csv");
    fails(ExportKind::Regions.to(path.clone()), &nothing, "open a photograph first");
    fails(ExportKind::Workspace.to(path.clone()), &nothing, "open a photograph first");
    fails(ExportKind::Area.to(path.clone()), &input(), "not restricted");
    fails(ExportKind::Selection.to(root.path().join("x.txt")), &input(), ".png (mask), .csv (table)");
    let unselected = ExportInput { document: crate::app::Document::default(), ..input() };
    fails(ExportKind::Selection.to(path.clone()), &unselected, "nothing is selected");
    let failed = ExportInput { shown: None, ..input() };
    fails(ExportKind::Matte.to(path.clone()), &failed, "no result for the present parameters");
    let canceled = ExportInput { lacks_result: true, ..input() };
    fails(ExportKind::Regions.to(path.clone()), &canceled, "no result for the present parameters");
    let analyzing = ExportInput { is_analyzing: true, ..failed };
    fails(ExportKind::Matte.to(path.clone()), &analyzing, "still under way");
    let anew = ExportInput { is_analyzing: true, ..input() };
    fails(ExportKind::Regions.to(path.clone()), &anew, "still under way");
    fails(ExportKind::View.to(path.clone()), &input(), "no view was drawn");
    let options = ExportOptions {
        drawn: Some(DrawnPicture { size: [0, 0], rgba: Vec::new().into() }),
        ..ExportOptions::default()
    };
    fails(Export { options, ..ExportKind::View.to(path.clone()) }, &input(), "has no pixels");
    fs::write(&path, "a file").unwrap();
    let options = ExportOptions { force: true, ..ExportOptions::default() };
    let forced = Export { options, ..ExportKind::Result.to(path.clone()) };
    fails(ExportKind::Regions.to(path.join("below")), &input(), "choose another place");
    fails(forced, &input(), "is a file");
    fails(ExportKind::Result.to(root.path()), &input(), "something else");
    assert_eq!(fs::read_to_string(&path).unwrap(), "a file");
}

#[test]
fn the_matte_file_has_an_extension_that_fits() {
    let root = tempfile::tempdir().unwrap();
    let export = ExportKind::Matte.to(root.path().join("m.jpg"));
    let text = write_one(&export, &input()).unwrap();
    assert!(text.ends_with("m.png"), "a PNM becomes a PNG: {text}");
    let text = write_one(&ExportKind::Matte.to(root.path().join("photo.v2")), &input()).unwrap();
    assert!(text.ends_with("photo.v2.png"), "{text}");
    fs::write(root.path().join("b.png"), "a file").unwrap();
    let error = write_one(&ExportKind::Matte.to(root.path().join("b.jpg")), &input()).unwrap_err();
    assert!(error.contains("b.png: exists"), "{error}");
    assert_eq!(fs::read(root.path().join("b.png")).unwrap(), b"a file");
    write_one(&ExportKind::Matte.to(root.path().join("b.png")), &input()).unwrap();
}

#[test]
fn a_small_share_of_surface_reflection_is_named_in_both_kinds() {
    let root = tempfile::tempdir().unwrap();
    let text = write_one(&matte_with_surface(0.004, &root.path().join("m.png")), &input()).unwrap();
    assert!(text.contains("with 0.4 % of its surface"), "{text}");
    let text = write_one(&matte_with_surface(1e-9, &root.path().join("n.png")), &input()).unwrap();
    assert!(text.contains("with 0.001 %"), "{text}");
    let options = ExportOptions { keep_surface: 1.0, ..ExportOptions::default() };
    let folder = Export { options, ..ExportKind::Result.to(root.path().join("r")) };
    let text = write_one(&folder, &input()).unwrap();
    assert!(text.ends_with("with 100 % of the surface reflection"), "{text}");
    let whole = matte_with_surface(1.0, &root.path().join("w.png"));
    write_one(&whole, &input()).unwrap();
    assert_eq!(
        fs::read(root.path().join("r/matte.png")).unwrap(),
        fs::read(root.path().join("w.png")).unwrap()
    );
}

#[test]
fn an_export_of_a_folder_reports_progress_and_can_be_stopped() {
    let root = tempfile::tempdir().unwrap();
    let (folder, input, stop) = (root.path().join("result"), input(), Stop::default());
    let files = AtomicUsize::new(0);
    let export = ExportKind::Result.to(folder.clone());
    let stop_at_third = |done: usize, total: usize| {
        assert!((1..=total).contains(&done) && total == 15);
        if done == 3 {
            stop.stop();
        }
    };
    let text = write_export(&export, &input, &stop, &stop_at_third).unwrap();
    assert!(text.starts_with("stopped") && !folder.exists(), "{text}");
    assert_eq!(fs::read_dir(root.path()).unwrap().count(), 0);
    let count = |_, _| {
        files.fetch_add(1, Ordering::Relaxed);
    };
    write_export(&export, &input, &Stop::default(), &count).unwrap();
    assert_eq!(files.into_inner(), 15);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 16);
}

#[test]
fn an_export_ends_with_a_notice() {
    let root = tempfile::tempdir().unwrap();
    let mut app = Application::new(Executor::Inline, || ()).unwrap();
    app.apply(JobCommand::Open(Origin::Sample(sample::NAME.into())));
    app.apply(JobCommand::Export(ExportKind::Result.to(root.path().join("r"))));
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

#[test]
fn every_kind_that_is_offered_has_a_title_and_a_file_name_of_its_own() {
    let offered: Vec<ExportKind> = ExportKind::ALL.into_iter().filter(|kind| kind.is_offered()).collect();
    for (index, kind) in offered.iter().enumerate() {
        assert!(!kind.title().is_empty() && !kind.tip().is_empty(), "{kind:?}");
        let before = &offered[..index];
        assert!(before.iter().all(|other| other.title() != kind.title()), "{kind:?}");
        assert!(before.iter().all(|other| other.file() != kind.file()), "{kind:?}");
    }
    let state = State::default();
    assert!(!ExportKind::Selection.is_available(&state) && !ExportKind::Area.is_available(&state));
}

#[test]
fn an_open_file_is_not_replaced_by_an_export() {
    let folder = tempfile::tempdir().unwrap();
    let photo = folder.path().join("photo.png");
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png"), &photo).unwrap();
    let before = fs::read(&photo).unwrap();
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::Open(Origin::File(photo.clone())));
    application.apply(JobCommand::Open(Origin::Sample(sample::NAME.to_owned())));
    let input = ExportInput::of(application.state());
    let around = folder.path().join(".").join("photo.jpg").with_file_name("photo.png");
    let whole = ExportOptions { force: true, ..ExportOptions::default() };
    for export in [
        ExportKind::Matte.to(photo.clone()),
        ExportKind::Layer.to(around),
        Export { options: whole, ..ExportKind::Result.to(folder.path()) },
    ] {
        let reason = write_one(&export, &input).unwrap_err();
        assert!(reason.contains("photo.png is open, and is not replaced"), "{reason}");
        assert_eq!(fs::read(&photo).unwrap(), before, "the photograph that stays open beside the shown one");
    }
    let beside = ExportKind::Layer.to(folder.path().join("layer.png"));
    assert!(write_one(&beside, &input).is_ok());
}
