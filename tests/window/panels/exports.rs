//! Files exported from the window equal those that the library writes. `tests/cli` tests the same of the command line.

use crate::window::{
    Window, answer, apply, choose, click, marked, named, notice, open_sample, press, region, shown, sigma,
    state, tiny, tiny_window,
};
use dichroscope::app::Edit;
use dichroscope::export::{WholeResult, read_report, write_matte};
use dichroscope::params::Setting;
use dichroscope::truth::sample;
use dichroscope::view::{Layer, Separator, regions_text};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use std::fs;
use std::path::Path;

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
    assert!(notice(&window).contains("letters"), "{}", notice(&window));
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
