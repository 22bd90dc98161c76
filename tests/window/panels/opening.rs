//! Tests of opening photographs by menu, path, drop, paste and list of recent files, and of the messages about errors.

use crate::window::{
    Window, answer, apply, choose, click, notice, open_sample, press, region, says, shown, sigma, size,
    state, tiny, tiny_window, window,
};
use dichroscope::app::{Edit, JobCommand, Severity};
use dichroscope::params::Setting;
use dichroscope::truth::sample;
use dichroscope::view::{Layer, Origin};
use egui::accesskit::Role;
use egui::{Color32, ColorImage, Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[test]
fn nothing_is_open_and_every_panel_says_so() {
    let window = window();
    for sentence in [
        "Open a photograph: Ctrl+O, drop a file here, or paste",
        "Open a photograph to see its colors.",
        "Regions appear when a photograph has been analyzed.",
        "Select a region to see its dichromatic plane.",
    ] {
        assert!(says(&window, sentence), "{sentence}");
    }
}

#[test]
fn without_a_graphics_adapter_one_panel_says_so_and_all_else_works() {
    let window = tiny_window();
    assert!(says(&window, "There is no graphics adapter"));
    assert!(says(&window, "color of region 1"));
}

#[test]
fn each_sample_opens_from_the_menu_with_its_accuracy() {
    let mut window = window();
    for sample in &sample::SAMPLES {
        open_sample(&mut window, sample.name);
        assert!(says(&window, "off by") && says(&window, "color of region 1"), "{}", sample.name);
        assert!(shown(&window).coverage > 0.8, "{}", sample.name);
    }
}

#[test]
fn a_typed_path_opens_and_a_bad_one_leaves_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("cups of mine.png");
    std::fs::copy(tiny(), &copy).unwrap();
    let mut window = window();
    choose(&mut window, "File", "Open\u{2026}");
    answer(&mut window, &copy);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin, Origin::File(copy.clone()));
    assert_eq!(state(&window).recent, [copy]);
    let result = shown(&window);
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, &folder.path().join("gone.png"));
    assert!(says(&window, "gone.png: there is no such file"), "the dialog says so and stays");
    let typed = window.get_by_role_and_label(Role::TextInput, "Path").value();
    assert!(typed.is_some_and(|text| text.ends_with("gone.png")), "the text stays");
    assert!(state(&window).notices.is_empty());
    let letter = folder.path().join("letter.png");
    std::fs::write(&letter, "dear all").unwrap();
    answer(&mut window, &letter);
    window.run_steps(3);
    let typed = window.get_by_role_and_label(Role::TextInput, "Path").value();
    assert!(typed.is_some_and(|text| text.ends_with("letter.png")), "dialog and text stay");
    assert!(says(&window, "letter.png: ") || says(&window, "letter.png is"), "the dialog says what is wrong");
    assert!(Arc::ptr_eq(&result, &shown(&window)));
    assert!(state(&window).notices.is_empty(), "the error is told once");
    answer(&mut window, &letter);
    window.run_steps(3);
    assert!(window.query_by_role(Role::TextInput).is_some(), "again");
    answer(&mut window, &tiny());
    window.run_steps(3);
    assert!(window.query_by_role(Role::TextInput).is_none(), "a photograph closes the dialog");
    apply(&mut window, JobCommand::Open(Origin::File(letter)));
    assert_eq!(state(&window).notices[0].severity, Severity::Error);
    assert!(notice(&window).contains("letter.png") && says(&window, "letter.png"));
    click(&mut window, Role::Button, "Dismiss");
    assert!(state(&window).notices.is_empty());
}

#[test]
fn what_was_opened_before_is_on_the_shelf() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::O);
    click(&mut window, Role::Link, sample::NAME);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin.name(), sample::NAME);
    press(&mut window, Modifiers::COMMAND, Key::O);
    click(&mut window, Role::Link, "camera8.png");
    assert_eq!(state(&window).picture.as_ref().unwrap().origin, Origin::File(tiny()));
}

#[test]
fn a_second_photograph_keeps_the_parameters() {
    let mut window = tiny_window();
    crate::window::named(&window, Role::Slider, "camera noise \u{3c3}0").set_value_accesskit(4.0);
    window.run_steps(3);
    apply(&mut window, Edit::Select(Some(region(1))));
    open_sample(&mut window, sample::NAME);
    assert_eq!(sigma(&window), Setting::Value(4.0));
    assert_eq!(crate::window::item(&window), Some(region(1)), "the largest region of the new photograph");
}

#[derive(Debug)]
struct Dropped(PathBuf, Vec<u8>);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        if self.1.is_empty() { Err("it is gone".to_owned()) } else { Ok(self.1.clone()) }
    }
}

fn drop_file(window: &mut Window, path: &Path, bytes: &[u8]) {
    window.input_mut().dropped_files.push(Arc::new(Dropped(path.to_path_buf(), bytes.to_vec())));
    window.run_steps(3);
}

#[test]
fn a_contrast_is_typed_into_the_menu_and_a_choice_closes_it() {
    let mut window = tiny_window();
    let contrast = |window: &Window| {
        let reading = state(window).picture.as_ref().unwrap().reading;
        reading.encoding.contrast()
    };
    choose(&mut window, "File", "Read as");
    click(&mut window, Role::SpinButton, "contrast");
    assert!(says(&window, "gamma 2.2"), "the menu stays open");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(Event::Text("1.5".to_owned()));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(3);
    assert_eq!(contrast(&window), Some(1.5));
    assert!(!says(&window, "gamma 2.2"), "the menu is closed");
    choose(&mut window, "File", "Read as");
    click(&mut window, Role::RadioButton, "sRGB");
    assert!(contrast(&window).is_none() && !says(&window, "gamma 2.2"));
}

#[test]
fn files_dragged_over_the_window_are_told_what_a_drop_does() {
    let mut window = window();
    let hover = |window: &mut Window, names: &[&str]| {
        let file = |name: &&str| egui::HoveredFile { path: Some(PathBuf::from(name)), ..Default::default() };
        window.input_mut().hovered_files = names.iter().map(file).collect();
        window.run_steps(3);
    };
    hover(&mut window, &["/a/cups.png"]);
    assert!(says(&window, "Drop to open cups.png"));
    hover(&mut window, &["/a/cups.png", "/a/pans.png"]);
    assert!(says(&window, "Drop to open 2 files"));
    hover(&mut window, &[]);
    assert!(!says(&window, "Drop to open"));
    hover(&mut window, &["/a/cups.png"]);
    window.hover_at(egui::pos2(300.0, 300.0));
    window.run_steps(2);
    assert!(!says(&window, "Drop to open"), "a drag that ended without a message");
    hover(&mut window, &[]);
    drop_file(&mut window, &tiny(), &[]);
    choose(&mut window, "File", "Open label map");
    hover(&mut window, &["/a/map.png"]);
    assert!(says(&window, "Drop for \u{201c}Open a label map of another program\u{201d}: map.png"));
}

#[test]
fn a_dropped_file_opens_by_its_path_or_its_bytes() {
    let mut window = window();
    drop_file(&mut window, &tiny(), &[]);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin, Origin::File(tiny()));
    let bytes = std::fs::read(tiny()).unwrap();
    drop_file(&mut window, Path::new("from the mail.png"), &bytes);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin.name(), "from the mail.png");
    assert_eq!(size(&window), (178, 150));
    drop_file(&mut window, Path::new("vanished.png"), &[]);
    assert!(notice(&window).contains("vanished.png") && notice(&window).contains("it is gone"));
    drop_file(&mut window, Path::new("letter.txt"), b"dear all");
    assert!(notice(&window).contains("letter.txt"), "{}", notice(&window));
    assert_eq!(state(&window).picture.as_ref().unwrap().origin.name(), "from the mail.png");
}

#[test]
fn a_file_dropped_while_a_dialog_is_open_is_the_dialogs_or_ends_it() {
    let folder = tempfile::tempdir().unwrap();
    let labels = folder.path().join("mine.png");
    let mut window = tiny_window();
    let own = shown(&window).labels().map(|&label| label as u8 * 9);
    let map = image::GrayImage::from_raw(own.width() as u32, own.height() as u32, own.as_slice().to_vec());
    map.unwrap().save(&labels).unwrap();
    choose(&mut window, "File", "Open label map of another program");
    drop_file(&mut window, &labels, &[]);
    window.run_steps(3);
    assert_eq!(state(&window).view.image.layer, Layer::OtherRegions, "it is not taken for a photograph");
    assert!(window.query_by_role(Role::TextInput).is_none(), "the dialog is closed");
    for (modifiers, key) in [(Modifiers::COMMAND, Key::O), (Modifiers::COMMAND, Key::P)] {
        press(&mut window, modifiers, key);
        assert!(window.query_by_role(Role::TextInput).is_some());
        let bytes = std::fs::read(tiny()).unwrap();
        let name = format!("{key:?}.png");
        drop_file(&mut window, Path::new(&name), &bytes);
        window.run_steps(3);
        assert_eq!(state(&window).picture.as_ref().unwrap().origin.name(), name);
        assert!(window.query_by_role(Role::TextInput).is_none(), "the dialog is closed");
    }
}

#[test]
fn an_error_that_is_shown_already_is_said_by_the_dialog_too() {
    let folder = tempfile::tempdir().unwrap();
    let letter = folder.path().join("letter.png");
    std::fs::write(&letter, "dear all").unwrap();
    let mut window = tiny_window();
    drop_file(&mut window, &letter, &[]);
    assert!(notice(&window).contains("letter.png"));
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, &letter);
    window.run_steps(3);
    assert!(window.query_by_role(Role::TextInput).is_some(), "the dialog stays");
    assert!(says(&window, "letter.png: ") && state(&window).notices.is_empty(), "told once");
}

#[test]
fn a_pasted_path_and_a_pasted_picture_open() {
    let mut window = window();
    window.event(Event::Paste(format!("file://{}\n", tiny().display())));
    window.run_steps(3);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin, Origin::File(tiny()));
    let copied = format!("x-special/nautilus-clipboard\ncopy\nfile://localhost{}", tiny().display());
    for pasted in [copied, format!("\"{}\"", tiny().display())] {
        open_sample(&mut window, sample::NAME);
        window.event(Event::Paste(pasted));
        window.run_steps(3);
        assert_eq!(state(&window).picture.as_ref().unwrap().origin, Origin::File(tiny()));
    }
    let pixels =
        (0..64 * 48).map(|i| Color32::from_rgb((i % 64) as u8 * 4, (i / 64) as u8 * 5, 90)).collect();
    let picture = ColorImage::new([64, 48], pixels);
    window.event(Event::PasteImage(Arc::new(picture)));
    window.run_steps(3);
    assert_eq!(state(&window).picture.as_ref().unwrap().origin.name(), "clipboard");
    assert_eq!(size(&window), (64, 48));
}

/// A folder with copies of the small photograph under these names.
fn copies(names: &[&str]) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().unwrap();
    let paths: Vec<PathBuf> = names.iter().map(|name| folder.path().join(name)).collect();
    for path in &paths {
        std::fs::copy(tiny(), path).unwrap();
    }
    (folder, paths)
}

/// The names of the open photographs: the one that is shown, and then the others in the order in which Ctrl+Tab shows them.
fn open_names(window: &Window) -> Vec<String> {
    let others = state(window).others.iter().map(|other| &other.picture);
    state(window).picture.iter().chain(others).map(|picture| picture.origin.name()).collect()
}

#[test]
fn of_several_dropped_files_every_photograph_and_its_diffuse_picture_are_opened() {
    let (_folder, paths) = copies(&["a.png", "diffuse.png", "b.png", "c.png"]);
    let mut window = tiny_window();
    for path in &paths {
        let file = Dropped(path.clone(), Vec::new());
        window.input_mut().dropped_files.push(Arc::new(file));
    }
    window.run_steps(3);
    assert_eq!(open_names(&window), ["c.png", "camera8.png", "a.png", "b.png"]);
    assert_eq!(state(&window).view.image.layer, Layer::OtherBody);
    assert!(says(&window, "diffuse.png is taken for a diffuse picture of another program"));
}

#[test]
fn the_photographs_in_a_folder_are_opened_when_it_is_dropped_or_its_path_is_typed() {
    let (folder, _) = copies(&["b.png", "a.png"]);
    let mut window = window();
    drop_file(&mut window, folder.path(), &[]);
    assert_eq!(open_names(&window), ["a.png", "b.png"]);
    let (folder, _) = copies(&["c.png"]);
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, folder.path());
    assert_eq!(open_names(&window)[0], "c.png");
    assert!(!says(&window, "path of a file"), "the dialog is closed");
    let empty = tempfile::tempdir().unwrap();
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, empty.path());
    assert!(says(&window, "no photograph lies in this folder"), "the dialog says so and stays");
}

#[test]
fn of_several_pasted_paths_those_that_can_be_open_are_opened_and_the_rest_is_told() {
    let names: Vec<String> = (1..=10).map(|number| format!("{number}.png")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (_folder, paths) = copies(&names);
    let mut window = window();
    let lines: Vec<String> = paths.iter().map(|path| format!("file://{}", path.display())).collect();
    window.event(Event::Paste(lines.join("\n")));
    window.run_steps(3);
    assert_eq!(open_names(&window), ["8.png", "1.png", "2.png", "3.png", "4.png", "5.png", "6.png", "7.png"]);
    assert!(says(&window, "2 photographs (from 9.png on) were not opened: 8 can be open at once"));
}

#[test]
fn a_path_pasted_into_a_field_stays_there() {
    let mut window = tiny_window();
    press(&mut window, Modifiers::COMMAND, Key::O);
    window.event(Event::Paste("elsewhere.png".to_owned()));
    window.run_steps(3);
    assert!(state(&window).notices.is_empty(), "it is not opened yet");
    assert!(says(&window, "elsewhere.png"));
}

/// A PPM with one color per column.
fn plain(name: &str, color: impl Fn(usize) -> [u8; 3]) -> Origin {
    let (width, height) = (96, 64);
    let mut bytes = format!("P6 {width} {height} 255\n").into_bytes();
    bytes.extend((0..width * height).flat_map(|pixel| color(pixel % width)));
    Origin::Bytes { name: name.to_owned(), bytes: bytes.into() }
}

#[test]
fn without_a_highlight_the_light_is_unknown() {
    let mut window = window();
    let shade = |x: usize| [1.0, 0.55, 0.3].map(|band: f32| (band * (60 + x) as f32) as u8);
    apply(&mut window, JobCommand::Open(plain("matte.ppm", shade)));
    assert!(!shown(&window).analysis.intrinsic.regions.is_empty());
    assert!(says(&window, "unknown: no highlight was found"));
    assert!(says(&window, "Dichromatic plane of region 1"), "its matte line is shown nevertheless");
}

#[test]
fn a_picture_without_regions_says_why() {
    let mut window = window();
    apply(&mut window, JobCommand::Open(plain("night.ppm", |_| [1, 1, 1])));
    assert!(shown(&window).analysis.intrinsic.regions.is_empty());
    let reason = shown(&window).analysis.warnings[0].to_string();
    // The verdict begins with a capital letter, and is the only place that says so.
    assert!(says(&window, &reason[1..]), "{reason}");
}
