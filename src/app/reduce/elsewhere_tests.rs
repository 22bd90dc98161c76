//! Tests of label maps and diffuse pictures of other programs: opening, errors, closing, other photographs, and workspaces.

use crate::app::{Application, Executor, ExportKind, JobCommand, Severity, ViewCommand};
use crate::export::{png_of_gray, png_of_rgb};
use crate::photo::{EncodingChoice, ReadOptions};
use crate::raster::Raster;
use crate::truth::sample;
use crate::view::{ElsewhereKind, ElsewherePaths, Layer, Origin};
use std::path::{Path, PathBuf};

const TINY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/tiny/camera8.png");

/// A folder with a photograph, a label map and a diffuse picture of its size, and an application in which the photograph is open.
struct Scene {
    folder: tempfile::TempDir,
    application: Application,
}

impl Scene {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::copy(TINY, folder.path().join("photo.png")).unwrap();
        let application = Application::new(Executor::Inline, || ()).unwrap();
        let mut scene = Self { folder, application };
        scene.application.apply(JobCommand::Open(Origin::File(scene.path("photo.png"))));
        let shown = scene.application.state().shown().unwrap();
        let labels = shown.labels().map(|&label| label as u8 * 20);
        scene.write("labels.png", &png_of_gray(&labels));
        let (width, height) = (labels.width(), labels.height());
        scene.write("diffuse.png", &png_of_rgb(&Raster::filled(width, height, [90, 60, 30])));
        scene.write("small.png", &png_of_gray(&Raster::filled(3, 2, 1u8)));
        scene
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        std::fs::write(self.path(name), bytes).unwrap();
    }

    /// The file of a workspace that was saved now.
    fn saved_workspace(&mut self) -> PathBuf {
        let file = self.path("work.dichroscope");
        self.application.apply(JobCommand::Export(ExportKind::Workspace.to(file.clone())));
        file
    }

    fn open(&mut self, kind: ElsewhereKind, name: &str) {
        self.application.apply(JobCommand::OpenElsewhere(kind, self.path(name)));
    }

    fn has(&self, kind: ElsewhereKind) -> bool {
        self.application.state().elsewhere.as_ref().is_some_and(|elsewhere| elsewhere.has(kind))
    }

    fn layers(&self) -> [Layer; 2] {
        let image = &self.application.state().view.image;
        [image.layer, image.other]
    }

    #[track_caller]
    fn assert_error(&self, expected: &str) {
        let notices = &self.application.state().notices;
        let error = notices.iter().rfind(|notice| notice.severity == Severity::Error);
        assert!(error.is_some_and(|error| error.text.contains(expected)), "{expected}: {notices:?}");
    }
}

use ElsewhereKind::{Diffuse, Labels};

#[test]
fn pictures_of_another_program_are_opened_shown_and_closed() {
    let mut scene = Scene::new();
    scene.open(Labels, "labels.png");
    assert_eq!(scene.layers(), [Layer::OtherRegions, Layer::Regions]);
    assert!(scene.application.state().jobs.reading.is_none());
    scene.open(Diffuse, "diffuse.png");
    assert_eq!(scene.layers(), [Layer::OtherBody, Layer::Body]);
    let state = scene.application.state();
    let at = state.reading_of(crate::raster::PixelIndex::from_index(0)).unwrap().elsewhere.unwrap();
    let [red, green, blue] = at.diffuse.unwrap();
    assert!(red > green && green > blue && at.label.is_some());
    assert_eq!(state.lacks(Layer::OtherBorders), None);
    scene.application.apply(ViewCommand::CloseElsewhere(Diffuse));
    assert!(scene.has(Labels) && !scene.has(Diffuse));
    assert_eq!(scene.layers(), [Layer::Body; 2]);
    scene.application.apply(ViewCommand::CloseElsewhere(Labels));
    let state = scene.application.state();
    assert!(state.elsewhere.is_none() && state.lacks(Layer::OtherRegions).unwrap().contains("label map"));
}

#[test]
fn what_is_wrong_with_a_file_is_said_and_changes_nothing() {
    let mut scene = Scene::new();
    scene.open(Labels, "small.png");
    scene.assert_error("the label map is 3\u{d7}2 pixels and the photograph photo.png is ");
    scene.open(Diffuse, "small.png");
    scene.assert_error("the diffuse picture is 3\u{d7}2 pixels");
    scene.open(Labels, "gone.png");
    scene.assert_error("gone.png: the label map of another program is not there");
    scene.write("broken.png", b"no picture");
    scene.open(Labels, "broken.png");
    scene.assert_error("cannot decode ");
    assert!(scene.application.state().elsewhere.is_none());
    assert!(scene.application.state().jobs.reading.is_none());
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(JobCommand::OpenElsewhere(Labels, scene.path("labels.png")));
    assert!(application.state().notices[0].text.contains("open the photograph first"));
}

#[test]
fn a_label_picture_of_the_ground_truth_that_cannot_be_used_is_told_once() {
    let other_size = png_of_gray(&Raster::filled(3, 2, 1u8));
    for (labels, reason) in
        [(&b"no picture"[..], "cannot decode "), (&other_size, "the label map is 3\u{d7}2 pixels")]
    {
        let scene = Scene::new();
        let assets = Path::new(TINY).parent().unwrap();
        for name in ["truth.json", "body.exr", "surface.exr"] {
            std::fs::copy(assets.join(name), scene.path(name)).unwrap();
        }
        scene.write("labels.png", labels);
        let mut application = Application::new(Executor::Inline, || ()).unwrap();
        let paths = ElsewherePaths { labels: Some(scene.path("labels.png")), diffuse: None };
        application.apply(JobCommand::OpenBeside(Origin::File(scene.path("photo.png")), paths));
        let about: Vec<_> = application.state().notices.iter().map(|notice| notice.text.as_str()).collect();
        let [told] = about[..] else { panic!("{about:?}") };
        assert!(told.contains(reason) && told.contains("labels.png"), "{told}");
        assert!(told.ends_with("the ground truth, of which it is a part, is not used either"), "{told}");
    }
}

#[test]
fn an_error_that_is_shown_already_is_the_newest_notice_again() {
    let mut scene = Scene::new();
    scene.open(Labels, "small.png");
    let before = scene.application.state().notices.clone();
    scene.open(Labels, "small.png");
    let after = &scene.application.state().notices;
    assert!(after.len() == 1 && before[0].text == after[0].text && before[0].id < after[0].id, "{after:?}");
}

#[test]
fn the_pictures_belong_to_their_photograph() {
    let mut scene = Scene::new();
    scene.open(Labels, "labels.png");
    // Another encoding reads the photograph and its pictures again.
    let options = ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() };
    scene.application.apply(JobCommand::ReadAs(options));
    assert!(scene.has(Labels));
    scene.application.apply(JobCommand::Open(Origin::Sample(sample::NAME.to_owned())));
    assert!(!scene.has(Labels));
    assert_eq!(scene.layers(), [Layer::Regions; 2], "there is nothing that the layer could show");
    scene.application.apply(JobCommand::Switch(crate::app::Switching::Next));
    assert!(scene.has(Labels));
}

#[test]
fn files_that_are_named_with_the_photograph_are_opened_after_it() {
    let scene = Scene::new();
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    let paths =
        ElsewherePaths { labels: Some(scene.path("labels.png")), diffuse: Some(scene.path("diffuse.png")) };
    application.apply(JobCommand::OpenBeside(Origin::File(scene.path("photo.png")), paths));
    let elsewhere = application.state().elsewhere.clone().unwrap();
    assert!(elsewhere.has(Labels) && elsewhere.has(Diffuse));
    let paths = ElsewherePaths { labels: Some(scene.path("labels.png")), diffuse: None };
    application.apply(JobCommand::OpenBeside(Origin::File(scene.path("gone.png")), paths));
    application.apply(JobCommand::Open(Origin::Sample(sample::NAME.to_owned())));
    assert!(application.state().elsewhere.is_none(), "the photograph was not there");
}

#[test]
fn a_workspace_remembers_the_files_and_opens_without_a_missing_one() {
    let mut scene = Scene::new();
    scene.open(Labels, "labels.png");
    scene.open(Diffuse, "diffuse.png");
    let file = scene.saved_workspace();
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("\"labels\": \"labels.png\""), "paths are relative: {text}");
    let opened = |file: &Path| {
        let mut application = Application::new(Executor::Inline, || ()).unwrap();
        application.apply(JobCommand::OpenWorkspace(file.to_owned()));
        application
    };
    let application = opened(&file);
    let elsewhere = application.state().elsewhere.clone().unwrap();
    assert!(elsewhere.has(Labels) && elsewhere.has(Diffuse));
    assert_eq!(application.state().view.image.layer, Layer::OtherBody, "the views are as they were");
    std::fs::remove_file(scene.path("labels.png")).unwrap();
    let application = opened(&file);
    assert!(application.state().is_current(), "the photograph is open");
    assert!(application.state().elsewhere.as_ref().is_some_and(|rest| rest.has(Diffuse)));
    let text = &application.state().notices.last().unwrap().text;
    assert!(text.contains("labels.png: the label map of another program is not there"), "{text}");
    assert_eq!(application.state().view.image.layer, Layer::OtherBody, "the layer of the file that is there");
}

#[test]
fn a_layer_of_a_missing_file_gives_way_to_the_layer_of_the_result_and_the_file_is_named() {
    let mut scene = Scene::new();
    scene.open(Diffuse, "diffuse.png");
    scene.open(Labels, "labels.png");
    let file = scene.saved_workspace();
    for (name, kept) in [("labels.png", Some(Diffuse)), ("diffuse.png", None)] {
        std::fs::remove_file(scene.path(name)).unwrap();
        scene.application = Application::new(Executor::Inline, || ()).unwrap();
        scene.application.apply(JobCommand::OpenWorkspace(file.clone()));
        assert_eq!(scene.layers(), [Layer::Regions; 2], "without {name}");
        let notices = &scene.application.state().notices;
        let tells = |words: &str| notices.iter().any(|notice| notice.text.contains(words));
        assert!(tells("the layer Other regions shows nothing until then, and Regions is shown in its place"));
        assert!(tells(&format!("{}: the ", scene.path(name).display())), "{notices:?}");
        assert_eq!(scene.has(Diffuse), kept.is_some());
    }
}

#[test]
fn a_layer_of_a_file_of_another_size_gives_way_too() {
    let mut scene = Scene::new();
    scene.open(Labels, "labels.png");
    let file = scene.saved_workspace();
    std::fs::copy(scene.path("small.png"), scene.path("labels.png")).unwrap();
    scene.application = Application::new(Executor::Inline, || ()).unwrap();
    scene.application.apply(JobCommand::OpenWorkspace(file));
    assert_eq!(scene.layers(), [Layer::Regions; 2]);
    scene.assert_error("the label map is 3\u{d7}2 pixels");
}
