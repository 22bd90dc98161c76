//! Tests of label maps and diffuse pictures of other programs: menu, dialog, layers, tables, readout, drop and closing.

use crate::window::{Window, answer, apply, choose, click, named, says, shown, state, tiny_window};
use dichroscope::app::{Edit, ViewCommand};
use dichroscope::raster::{PixelIndex, Raster};
use dichroscope::view::{ImageSettings, Item, Layer};
use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::NodeT;
use std::path::{Path, PathBuf};

/// Writes a gray picture of 8 bits.
fn write_gray(path: &Path, values: &Raster<u8>) {
    let [width, height] = [values.width() as u32, values.height() as u32];
    image::GrayImage::from_raw(width, height, values.as_slice().to_vec()).unwrap().save(path).unwrap();
}

/// A window with the small photograph, and a folder with a label map and a diffuse picture of its size.
fn scene() -> (Window, tempfile::TempDir) {
    let window = tiny_window();
    let folder = tempfile::tempdir().unwrap();
    let labels = shown(&window).labels().map(|&label| if label == 0 { 0 } else { 200 - label as u8 });
    write_gray(&folder.path().join("labels.png"), &labels);
    let flat = Raster::filled(labels.width(), labels.height(), [90, 60, 30]);
    let size = [flat.width() as u32, flat.height() as u32];
    let bytes: Vec<u8> = flat.as_slice().concat();
    let diffuse = image::RgbImage::from_raw(size[0], size[1], bytes).unwrap();
    diffuse.save(folder.path().join("diffuse.png")).unwrap();
    write_gray(&folder.path().join("small.png"), &Raster::filled(3, 2, 1));
    (window, folder)
}

#[test]
fn a_label_map_is_opened_from_the_menu_and_compared_in_every_place() {
    let (mut window, folder) = scene();
    choose(&mut window, "File", "Open label map of another program");
    assert!(says(&window, "gray of 8 or 16 bits with 0 for no label"));
    answer(&mut window, &folder.path().join("small.png"));
    assert!(
        says(&window, "the label map is 3\u{d7}2 pixels and the photograph"),
        "the dialog stays and says why"
    );
    answer(&mut window, &folder.path().join("labels.png"));
    window.run_steps(3);
    assert_eq!(state(&window).view.image.layer, Layer::OtherRegions);
    click(&mut window, Role::Button, "Compare");
    let mut labels: Vec<u16> = shown(&window).labels().as_slice().to_vec();
    labels.sort_unstable();
    labels.dedup();
    let count = labels.iter().filter(|label| **label != 0).count();
    assert!(says(&window, &format!("label map labels.png, {count} label")));
    assert!(says(&window, "agreement with this result") && says(&window, "1.000") && says(&window, "100.0"));
    assert!(says(&window, "compared with the ground truth") && says(&window, "doing nothing"));
    assert!(!says(&window, "as the body image"), "there is no diffuse picture");
    click(&mut window, Role::Button, "Other borders");
    assert_eq!(state(&window).view.image.layer, Layer::OtherBorders);
    let pixel = shown(&window).labels().as_slice().iter().position(|&label| label == 1).unwrap();
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::from_index(pixel)))));
    assert!(says(&window, "other, label 199"), "the readout");
    choose(&mut window, "File", "Close label map labels.png");
    assert_eq!(state(&window).view.image.layer, Layer::Regions);
    assert!(!says(&window, "other, label") && says(&window, "Open a label map"));
}

#[test]
fn a_diffuse_picture_has_layers_scores_and_values() {
    let (mut window, folder) = scene();
    click(&mut window, Role::Button, "Compare");
    click(&mut window, Role::Button, "Open a diffuse picture");
    answer(&mut window, &folder.path().join("diffuse.png"));
    window.run_steps(3);
    assert_eq!(state(&window).view.image.layer, Layer::OtherBody);
    assert!(says(&window, "diffuse picture diffuse.png") && says(&window, "as the body image (dB)"));
    assert!(says(&window, "surface image (dB)"), "the tiny scene has a ground truth");
    apply(&mut window, Edit::Select(Some(Item::Pixel(PixelIndex::new(0)))));
    assert!(says(&window, "other, R 26.1, G 11.5, B 3.3"), "linear counts");
    click(&mut window, Role::Button, "Other difference");
    assert_eq!(state(&window).view.image.layer, Layer::OtherDifference);
    click(&mut window, Role::Button, "Close");
    assert!(state(&window).elsewhere.is_none());
    assert_eq!(state(&window).view.image.layer, Layer::Body);
}

#[test]
fn layers_without_their_file_are_offered_but_cannot_be_chosen() {
    let (mut window, _folder) = scene();
    window.set_size(vec2(900.0, 700.0));
    click(&mut window, Role::ComboBox, "Layer");
    for layer in [Layer::OtherRegions, Layer::OtherBorders, Layer::OtherBody, Layer::OtherDifference] {
        let row = named(&window, Role::Button, layer.name());
        assert!(row.accesskit_node().is_disabled(), "{layer:?}");
    }
}

#[test]
fn a_dropped_file_is_a_label_map_by_its_name() {
    let (mut window, folder) = scene();
    let drop = |window: &mut Window, path: PathBuf| {
        window.event(egui::Event::Paste(path.display().to_string()));
        window.run_steps(4);
    };
    drop(&mut window, folder.path().join("labels.png"));
    assert_eq!(state(&window).view.image.layer, Layer::OtherRegions);
    assert!(state(&window).notices.iter().any(|notice| notice.text.contains("because of its name")));
    drop(&mut window, folder.path().join("small.png"));
    assert!(state(&window).elsewhere.is_none(), "any other name is a photograph");
    // A view of another photograph has no layer of another program.
    let image = ImageSettings { layer: Layer::OtherBody, ..state(&window).view.image.clone() };
    apply(&mut window, ViewCommand::Image(image));
    window.run_steps(2);
}
