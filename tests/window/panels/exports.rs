//! Files exported from the window equal those that the library writes. `tests/cli` tests the same of the command line.

use crate::window::{
    Fixture, SIZE, Window, answer, apply, choose, click, marked, named, notice, open_sample, press, region,
    says, shown, sigma, state, tiny, tiny_window, with_gpu, with_state,
};
use dichroscope::app::{Edit, Job, Severity};
use dichroscope::export::{WholeResult, read_report, write_matte};
use dichroscope::params::{Parameter, Setting};
use dichroscope::truth::sample;
use dichroscope::view::{Layer, Separator, regions_text};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use std::fs;
use std::path::Path;
use std::time::Instant;

/// Exports one kind of file with the export window.
fn export(window: &mut Window, ware: &str, path: &Path) {
    press(window, Modifiers::COMMAND, Key::E);
    click(window, Role::RadioButton, ware);
    answer(window, path);
    assert!(path.exists(), "{}", notice(window));
    assert!(notice(window).contains(&path.display().to_string()), "{}", notice(window));
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn the_photograph_without_highlights_is_that_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    let path = folder.path().join("bare.png");
    export(&mut window, "Photograph without highlights", &path);
    let result = shown(&window);
    let library = write_matte(&result.picture.photo, &result.analysis.intrinsic, 0.0, folder.path()).unwrap();
    assert!(fs::read(&path).unwrap() == fs::read(library).unwrap());

    press(&mut window, Modifiers::COMMAND, Key::E);
    named(&window, Role::Slider, "surface reflection kept").set_value_accesskit(0.5);
    window.run_steps(2);
    let half = folder.path().join("half.png");
    answer(&mut window, &half);
    let library = write_matte(&result.picture.photo, &result.analysis.intrinsic, 0.5, folder.path()).unwrap();
    assert!(fs::read(&half).unwrap() == fs::read(library).unwrap());
    assert!(fs::read(&half).unwrap() != fs::read(&path).unwrap());
}

#[test]
fn everything_is_what_the_library_writes() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    let ours = folder.path().join("window");
    export(&mut window, "Everything, as a folder", &ours);
    let result = shown(&window);
    let whole = WholeResult { photo: &result.picture.photo, analysis: &result.analysis, keep_surface: 0.0 };
    let theirs = folder.path().join("library");
    whole.write(read_report(&ours).unwrap(), &theirs, false, &|_, _| true).unwrap();
    assert_eq!(names(&ours), names(&theirs));
    for name in names(&ours).iter().filter(|name| *name != "report.json") {
        assert!(fs::read(ours.join(name)).unwrap() == fs::read(theirs.join(name)).unwrap(), "{name} differs");
    }
    // A folder that does not hold a result is not replaced.
    let letters = folder.path().join("letters");
    fs::create_dir(&letters).unwrap();
    fs::write(letters.join("love.txt"), "dear").unwrap();
    press(&mut window, Modifiers::COMMAND, Key::E);
    answer(&mut window, &letters);
    assert_eq!(names(&letters), ["love.txt"]);
    assert!(says(&window, "letters holds something else than an earlier result"));
    // The dialog offers what its sentence asks for.
    click(&mut window, Role::CheckBox, "replace the folder whatever it holds");
    answer(&mut window, &letters);
    assert_eq!(names(&letters), names(&theirs));
}

/// Whether the dialog that asks for a path is open, and what is typed in it.
fn typed(window: &Window) -> Option<String> {
    window.query_by_role(Role::TextInput).and_then(|field| field.value())
}

#[test]
fn an_export_that_fails_leaves_the_dialog_as_it_was_and_another_path_succeeds() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::E);
    named(&window, Role::Slider, "surface reflection kept").set_value_accesskit(0.5);
    window.run_steps(2);
    // No file can be made in a file.
    let wrong = file.join("half.png");
    answer(&mut window, &wrong);
    assert_eq!(typed(&window), Some(wrong.display().to_string()));
    assert!(
        says(&window, &format!("cannot write {}: ", wrong.display()))
            && says(&window, "choose another place")
    );
    assert!(state(&window).notices.iter().all(|notice| notice.severity != Severity::Error), "told once");
    for ware in ["Profile", "Photograph without highlights"] {
        click(&mut window, Role::RadioButton, ware);
        assert!(!says(&window, "cannot write "), "of another kind nothing is known");
    }
    let right = folder.path().join("half.png");
    answer(&mut window, &right);
    assert_eq!(typed(&window), None, "the dialog is closed");
    assert!(notice(&window).contains("with 50 % of its surface reflection"), "{}", notice(&window));
    assert!(right.is_file());

    for (menu, entry, name) in
        [("File", "Save workspace as", "evening.dichroscope"), ("Analyze", "Save parameters", "evening.toml")]
    {
        choose(&mut window, menu, entry);
        let wrong = file.join(name);
        answer(&mut window, &wrong);
        assert_eq!(typed(&window), Some(wrong.display().to_string()), "{entry}");
        assert!(says(&window, "cannot write "), "{entry}");
        answer(&mut window, &folder.path().join(name));
        assert_eq!(typed(&window), None, "{entry}");
        assert!(folder.path().join(name).is_file(), "{entry}");
    }
}

#[test]
fn every_dialog_that_writes_proposes_a_path_beside_the_photograph() {
    let mut window = tiny_window();
    for (menu, entry, name) in [
        ("File", "Export", "camera8-matte.png"),
        ("File", "Save workspace as", "camera8-workspace.dichroscope"),
        ("Analyze", "Save parameters", "camera8-parameters.toml"),
    ] {
        choose(&mut window, menu, entry);
        window.run_steps(2);
        assert_eq!(typed(&window), Some(tiny().with_file_name(name).display().to_string()), "{entry}");
        window.key_press_modifiers(Modifiers::COMMAND, Key::A);
        window.key_press(Key::Delete);
        window.run_steps(3);
        assert_eq!(typed(&window), Some(String::new()), "{entry}: an empty field stays empty");
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn a_file_that_exists_is_replaced_on_the_second_confirmation_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (file, other) = (folder.path().join("mine.csv"), folder.path().join("ours.csv"));
    for path in [&file, &other] {
        fs::write(path, "mine").unwrap();
    }
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::E);
    click(&mut window, Role::RadioButton, "Regions table");
    // The extension is appended before the file is looked for.
    for path in [folder.path().join("mine"), other.clone(), file.clone()] {
        answer(&mut window, &path);
        assert!(
            typed(&window).is_some() && says(&window, "exists; Export once more replaces it"),
            "{path:?}"
        );
    }
    answer(&mut window, &tiny());
    assert!(says(&window, "is open, and is not replaced"), "the photograph is not offered to be replaced");
    answer(&mut window, &file);
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(typed(&window), None, "the dialog is closed");
    assert_ne!(fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(fs::read_to_string(&other).unwrap(), "mine", "the other name was not confirmed");
}

#[test]
fn what_is_typed_replaces_the_name_that_the_dialog_proposes() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::E);
    for (ware, typed_name, name) in
        [("Photograph without highlights", "mine", "mine.png"), ("Regions table", "ours", "ours.csv")]
    {
        click(&mut window, Role::RadioButton, ware);
        window.run_steps(2);
        window.event(Event::Text(typed_name.to_owned()));
        window.run_steps(3);
        assert_eq!(typed(&window), Some(tiny().with_file_name(name).display().to_string()));
    }
}

#[test]
fn a_view_that_cannot_be_written_leaves_the_dialog_and_a_closed_dialog_leaves_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let Some(mut window) = with_gpu(egui::vec2(1280.0, 800.0), Fixture::Tiny) else { return };
    press(&mut window, Modifiers::COMMAND, Key::E);
    click(&mut window, Role::RadioButton, "A view as PNG");
    let wrong = file.join("view.png");
    answer(&mut window, &wrong);
    until(&mut window, |window| says(window, "cannot write "));
    assert_eq!(typed(&window), Some(wrong.display().to_string()));
    let right = folder.path().join("view.png");
    answer(&mut window, &right);
    until(&mut window, |window| typed(window).is_none());
    assert!(right.is_file(), "the dialog closes when the picture is written");

    press(&mut window, Modifiers::COMMAND, Key::E);
    answer(&mut window, &wrong);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(typed(&window), None);
    until(&mut window, |window| {
        state(window).notices.iter().any(|notice| notice.text.contains("cannot write "))
    });
}

/// Draws frames until a view that is drawn on a thread has come as far as `is_done` says.
#[track_caller]
fn until(window: &mut Window, is_done: impl Fn(&Window) -> bool) {
    for _ in 0..600 {
        if is_done(window) {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        window.run_steps(1);
    }
    panic!("it does not end");
}

#[test]
fn tables_layers_and_marks_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    apply(&mut window, Edit::Select(Some(region(1))));
    press(&mut window, Modifiers::COMMAND, Key::A);
    let table = folder.path().join("regions.csv");
    export(&mut window, "Regions table", &table);
    assert_eq!(fs::read_to_string(&table).unwrap(), regions_text(&shown(&window), Separator::Comma));
    let mask = folder.path().join("marked.png");
    export(&mut window, "Marked pixels", &mask);
    let white = image::open(&mask).unwrap().to_luma8().pixels().filter(|pixel| pixel.0[0] > 127).count();
    assert_eq!(white, marked(&window));
    press(&mut window, Modifiers::NONE, Key::Num8);
    assert_eq!(state(&window).view.image.layer, Layer::Body);
    let layer = folder.path().join("layer.png");
    export(&mut window, "Image view as PNG", &layer);
    assert_eq!(image::image_dimensions(&layer).unwrap(), (178, 150));
    let profile = folder.path().join("profile.csv");
    export(&mut window, "Profile", &profile);
    assert_eq!(fs::read_to_string(&profile).unwrap().lines().count(), 178 + 1);
    let page = folder.path().join("figures.html");
    export(&mut window, "Figures and tables", &page);
    let page = fs::read_to_string(&page).unwrap();
    assert!(
        page.contains("<h1>Figures of camera8.png</h1>") && page.contains("Along row 75 of the photograph")
    );
}

#[test]
fn a_workspace_is_saved_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("evening.dichroscope");
    let mut window = tiny_window();
    named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(4.0);
    window.run_steps(3);
    click(&mut window, Role::Label, "color of region 2");
    press(&mut window, Modifiers::COMMAND, Key::A);
    press(&mut window, Modifiers::NONE, Key::Num7);
    choose(&mut window, "View", "Profile");
    press(&mut window, Modifiers::NONE, Key::V);
    let (document, view) = (state(&window).document.clone(), state(&window).view.clone());
    press(&mut window, Modifiers::COMMAND, Key::S);
    answer(&mut window, &path);
    assert!(path.is_file(), "{}", notice(&window));

    open_sample(&mut window, sample::NAME);
    named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(8.0);
    window.run_steps(3);
    press(&mut window, Modifiers::NONE, Key::Num1);
    choose(&mut window, "View", "Arrange as at first");
    assert_ne!(state(&window).document, document);
    assert_eq!(sigma(&window), Setting::Value(8.0));
    assert_ne!(state(&window).view, view);

    choose(&mut window, "File", "Open workspace");
    answer(&mut window, &path);
    window.run_steps(3);
    assert_eq!(state(&window).document, document);
    assert_eq!(state(&window).view, view);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin.path(), Some(tiny().as_path()));
    assert!(state(&window).is_current());
}

#[test]
fn the_inspector_exports_the_pixels_of_the_region_that_it_is_about() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny_window();
    window.set_size(egui::vec2(1600.0, 1200.0));
    apply(&mut window, Edit::Select(Some(region(2))));
    window.run_steps(2);
    click(&mut window, Role::Button, "Export\u{2026}");
    let path = folder.path().join("region.csv");
    answer(&mut window, &path);
    assert!(notice(&window).contains("the pixels of region 2 as a table"), "{}", notice(&window));
    let pixels = shown(&window).labels().as_slice().iter().filter(|&&label| label == 2).count();
    assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), pixels + 1);
}

#[test]
fn an_export_of_the_result_waits_for_the_analysis_under_way() {
    let folder = tempfile::tempdir().unwrap();
    let mut state_before = state(&tiny_window()).clone();
    state_before.jobs.analysis = Some(Job { since: Instant::now(), stage: None, files: None });
    let Some(mut window) = with_state(SIZE, state_before) else { return };
    let [given_up, waited_for] = ["given-up.csv", "waited-for.csv"].map(|name| folder.path().join(name));
    let begin = |window: &mut Window, path: &Path| {
        press(window, Modifiers::COMMAND, Key::E);
        click(window, Role::RadioButton, "Regions table");
        answer(window, path);
    };
    begin(&mut window, &given_up);
    assert!(says(&window, "the file is written when it has ended"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    begin(&mut window, &waited_for);
    assert!(!waited_for.exists(), "the result before is not written");
    apply(&mut window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(6.0), None));
    window.run_steps(8);
    assert!(state(&window).jobs.analysis.is_none() && !says(&window, "the file is written when"));
    let written = fs::read_to_string(&waited_for).unwrap();
    assert_eq!(written, regions_text(&shown(&window), Separator::Comma));
    assert!(!given_up.exists());
}
