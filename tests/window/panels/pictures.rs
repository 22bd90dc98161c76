//! Pictures of panels are compared with stored ones; a few pixels may differ.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test -p dichroscope-window-tests` writes the stored pictures anew. No
//! picture shows a time.

use crate::window::{Fixture, Window, apply, named, region, with_software_driver};
use dichroscope::app::{Command, DebugCommand, Edit, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::params::Method;
use dichroscope::trace::Event;
use dichroscope::view::{Arrangement, ColorBy, Fill, ImageSettings, Layer, ProfileLine, Theme};
use egui::accesskit::Role;
use egui::{Rect, Vec2, pos2, vec2};
use egui_kittest::{SnapshotOptions, image_snapshot_options};
use image::imageops::{FilterType, resize};

/// Size of a picture of a single panel, points.
const PANEL: Vec2 = vec2(420.0, 300.0);

/// Number of pixels that may differ: versions of a driver round differently on a few edges.
const EDGES_PX: usize = 60;

fn opened(size: Vec2, pane: Option<Pane>) -> Option<Window> {
    let mut window = with_software_driver(size, Fixture::TinyFixedNoise)?;
    window.state_mut().show_alone(pane);
    window.run_steps(3);
    Some(window)
}

fn compare(window: &mut Window, name: &str) {
    window.run_steps(6);
    window.snapshot_options(name, &options());
}

fn options() -> SnapshotOptions {
    SnapshotOptions::new().output_path("panels/snapshots").max_failed_pixels(EDGES_PX)
}

fn look(window: &mut Window, change: impl FnOnce(&mut ImageSettings)) {
    let mut image = window.state().state().view.image.clone();
    change(&mut image);
    apply(window, ViewCommand::Image(image));
}

#[test]
fn the_histograms_of_phoenix() {
    let Some(mut window) = opened(vec2(320.0, 430.0), Some(Pane::Inspector)) else { return };
    apply(&mut window, Edit::SetMethod(Method::Phoenix));
    let trace = std::sync::Arc::clone(window.state().state().debugger.trace().unwrap());
    let splits =
        |event: &Event| matches!(event, Event::HistogramsSearched(searched) if searched.chosen().is_some());
    let (step, _) = trace.events().find(|(_, event)| splits(event)).unwrap();
    apply(&mut window, Command::Debug(DebugCommand::Seek(step + 1)));
    compare(&mut window, "inspector-histograms");
}

#[test]
fn the_image_view() {
    let Some(mut window) = opened(PANEL, Some(Pane::Image)) else { return };
    compare(&mut window, "image-input");
    look(&mut window, |image| image.layer = Layer::Classes);
    compare(&mut window, "image-classes");
    look(&mut window, |image| (image.layer, image.fill) = (Layer::Regions, Fill::Outline));
    apply(&mut window, Edit::Select(Some(region(2))));
    compare(&mut window, "image-regions");
    look(&mut window, |image| {
        (image.layer, image.other) = (Layer::Body, Layer::Surface);
        image.arrangement = Arrangement::Wipe(0.5);
    });
    apply(&mut window, ViewCommand::Theme(Theme::Light));
    compare(&mut window, "image-wipe-light");
}

#[test]
fn the_color_space_view() {
    let Some(mut window) = opened(PANEL, Some(Pane::Colors)) else { return };
    compare(&mut window, "colors");
    apply(&mut window, Edit::Select(Some(region(1))));
    compare(&mut window, "colors-region");
    let mut cube = window.state().state().view.cube.clone();
    cube.color_by = ColorBy::Density;
    apply(&mut window, ViewCommand::Cube(cube));
    apply(&mut window, Edit::Select(None));
    apply(&mut window, ViewCommand::Theme(Theme::Light));
    compare(&mut window, "colors-density-light");
}

#[test]
fn the_plots() {
    let Some(mut window) = opened(PANEL, Some(Pane::Plane)) else { return };
    apply(&mut window, Edit::Select(Some(region(1))));
    compare(&mut window, "plane");
    apply(&mut window, ViewCommand::Profile(ProfileLine::Between([10.5, 75.5], [167.5, 75.5])));
    window.state_mut().show_alone(Some(Pane::Profile));
    compare(&mut window, "profile");
}

#[test]
fn sliders_and_tables() {
    let Some(mut window) = opened(vec2(330.0, 520.0), Some(Pane::Parameters)) else { return };
    compare(&mut window, "parameters");
    window.set_size(PANEL);
    apply(&mut window, Edit::Select(Some(region(2))));
    window.state_mut().show_alone(Some(Pane::Regions));
    compare(&mut window, "regions");
    window.state_mut().show_alone(Some(Pane::Selection));
    compare(&mut window, "selection");
}

#[test]
fn the_timeline() {
    let Some(mut window) = opened(vec2(900.0, 96.0), Some(Pane::Timeline)) else { return };
    apply(&mut window, Command::Debug(DebugCommand::Seek(1500)));
    compare(&mut window, "timeline");
    window.set_size(vec2(640.0, 150.0));
    apply(&mut window, Edit::Select(Some(region(1))));
    apply(&mut window, ViewCommand::Theme(Theme::Light));
    compare(&mut window, "timeline-light");
}

#[test]
fn the_whole_window() {
    let Some(mut window) = opened(vec2(1280.0, 800.0), None) else { return };
    apply(&mut window, Edit::Select(Some(region(1))));
    look(&mut window, |image| image.layer = Layer::Regions);
    window.run_steps(6);
    // The status line shows the time of the analysis, and its layout depends on the number of digits.
    let help = named(&window, Role::Button, "Help").rect();
    window.mask(Rect::from_min_max(help.right_top(), pos2(1280.0, help.bottom())));
    let picture = window.render().unwrap();
    let small = resize(&picture, 426, 266, FilterType::Triangle);
    image_snapshot_options(&small, "window", &options());
}
