//! Tests of a second lamp in the window: its row of the parameters panel, the white patch, the layer and the readout.

use crate::synthetic::{Scene, unit};
use crate::window::{
    Window, apply, at, click, drag, inside, named, press, says, shown, state, tiny_window, undo, window,
    zoom_in,
};
use dichroscope::app::{Edit, JobCommand, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::params::{IlluminantSetting, Method};
use dichroscope::photo::{EncodingChoice, ReadOptions};
use dichroscope::view::{Lamp, Layer, Look, Origin, PixelReading, legend, paint};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::NodeT;

/// The colors of a lamp on the left and of a lamp on the right.
const LAMPS: [[f64; 3]; 2] = [[0.68, 0.58, 0.45], [0.54, 0.57, 0.62]];
/// Columns of the picture that the first lamp lights.
const LEFT_PX: usize = 240;

/// A window with ten balls under two lamps, analyzed.
fn two_lamps() -> Window {
    let scene = Scene::grid_of_balls([400, 160], 5, 2, 4);
    let halves = LAMPS.map(|lamp| Scene { illuminant: unit(lamp), ..scene.clone() }.render().image.pixels);
    let width = halves[0].width();
    let mut bytes = format!("P6 {width} {} 255\n", halves[0].height()).into_bytes();
    for (pixel, colors) in halves[0].as_slice().iter().zip(halves[1].as_slice()).enumerate() {
        let color = if pixel % width >= LEFT_PX { colors.1 } else { colors.0 };
        bytes.extend(color.map(|band| band as u8));
    }
    let mut window = window();
    let origin = Origin::Bytes { name: "two-lamps.ppm".into(), bytes: bytes.as_slice().into() };
    apply(&mut window, JobCommand::Open(origin));
    let options = ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() };
    apply(&mut window, JobCommand::ReadAs(options));
    assert!(state(&window).is_current() && shown(&window).analysis.finals.light.second.is_some());
    window
}

/// The settings of the light and of the second lamp.
fn settings(window: &Window) -> [IlluminantSetting; 2] {
    let params = state(window).document.params;
    [params.illuminant, params.second_illuminant]
}

#[test]
fn a_second_lamp_is_typed_kept_and_let_go() {
    let mut window = tiny_window();
    // Alone, the panel shows all rows without scrolling.
    window.state_mut().show_alone(Some(Pane::Parameters));
    window.run_steps(2);
    let generation = state(&window).generation;
    click(&mut window, Role::SpinButton, "second lamp blue");
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(state(&window).generation, generation, "a field that is looked at gives no lamp");
    click(&mut window, Role::SpinButton, "second lamp blue");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    for digit in ["0", ".", "9"] {
        window.event(Event::Text(digit.to_owned()));
        window.run_steps(2);
        assert_eq!(settings(&window)[1], IlluminantSetting::Auto, "a lamp is given when it is typed");
    }
    press(&mut window, Modifiers::NONE, Key::Enter);
    window.run_steps(2);
    let first = shown(&window).analysis.illuminant.unwrap().direction;
    let IlluminantSetting::Given(typed) = settings(&window)[1] else { panic!("{:?}", settings(&window)) };
    assert!(
        (typed[2] - 0.9).abs() < 1e-9 && (typed[0] - first[0]).abs() < 1e-9,
        "{typed:?} beside {first:?}"
    );
    assert!(shown(&window).analysis.finals.light.second.unwrap().given);
    click(&mut window, Role::CheckBox, "pin second lamp");
    assert_eq!(settings(&window)[1], IlluminantSetting::Auto);
    undo(&mut window);
    assert_eq!(settings(&window)[1], IlluminantSetting::Given(typed));
    apply(&mut window, Edit::SetMethod(Method::Paper));
    assert!(says(&window, "pin illuminant") && !says(&window, "pin second lamp"), "only the refined method");
}

#[test]
fn pinning_the_light_that_was_found_keeps_the_second_lamp_that_was_found() {
    let mut window = two_lamps();
    let lamps = |window: &Window| {
        let light = shown(window).analysis.finals.light;
        [light.direction, light.second.map(|second| second.direction)].map(Option::unwrap)
    };
    let found = lamps(&window);
    click(&mut window, Role::CheckBox, "pin illuminant");
    let apart = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let kept = lamps(&window);
    assert!(apart(found[0], kept[0]) < 1e-9 && apart(found[1], kept[1]) < 1e-9, "{found:?} {kept:?}");
    assert!(shown(&window).analysis.finals.light.second.unwrap().given);
    assert!(says(&window, "given, lights"), "over the table of regions");
    undo(&mut window);
    assert_eq!(settings(&window), [IlluminantSetting::Auto; 2], "one step of the history");
}

#[test]
fn a_white_patch_with_shift_pins_the_second_lamp() {
    let mut window = tiny_window();
    zoom_in(&mut window);
    let (x, y) = inside(&window, 1);
    click(&mut window, Role::Button, "White patch");
    let (x, y) = (x as f32, y as f32);
    let (from, to) = (at(&window, x - 1.8, y - 1.8), at(&window, x + 2.2, y + 2.2));
    drag(&mut window, &[from, to], Modifiers::SHIFT);
    let [first, second] = settings(&window);
    assert_eq!(first, IlluminantSetting::Auto);
    let body = shown(&window).analysis.intrinsic.regions[0].body;
    let cosine: f64 = second.direction().unwrap().iter().zip(body).map(|(a, b)| a * b).sum();
    assert!(cosine > 0.95, "the mean of a matte patch lies near its body color: {second:?}, {body:?}");
}

#[test]
fn the_layer_shows_which_lamp_each_pixel_is_split_with() {
    let mut window = two_lamps();
    click(&mut window, Role::ComboBox, "Layer");
    click(&mut window, Role::Button, "Lamps");
    assert_eq!(state(&window).view.image.layer, Layer::Lamps);
    assert!(!says(&window, "One lamp"));
    let result = shown(&window);
    let opaque = Look { opacity: 1.0, ..Look::default() };
    let painted = paint(Layer::Lamps, &result.picture, Some(&result), None, &opaque);
    let colors: Vec<[u8; 3]> = legend(Layer::Lamps).iter().map(|entry| entry.color).collect();
    let color_of = |pixel: usize| [painted[pixel][0], painted[pixel][1], painted[pixel][2]];
    let lamp_of = |pixel: usize| colors.iter().position(|&color| color == color_of(pixel));
    let labels = result.labels();
    let is_split = |pixel: &usize| labels[*pixel] > 0 && lamp_of(*pixel).is_some();
    let split: Vec<usize> = (0..labels.len()).filter(is_split).collect();
    assert!(split.len() > labels.len() / 4, "{} of {} pixels", split.len(), labels.len());
    let expected = |pixel: usize| usize::from(pixel % labels.width() >= LEFT_PX);
    let wrong = split.iter().filter(|&&pixel| lamp_of(pixel) != Some(expected(pixel))).count();
    assert!(wrong * 100 < split.len(), "{wrong} of {} pixels", split.len());
    for half in [0, 1] {
        let is_inside = |pixel: &&usize| expected(**pixel) == half && lamp_of(**pixel) == Some(half);
        let pixel = *split.iter().find(is_inside).unwrap();
        let reading = PixelReading::of(&result.picture, Some(&result), pixel).unwrap();
        let lamp = reading.analyzed.unwrap().lamp.map(Lamp::name);
        assert_eq!(lamp, Some(["first", "second"][half]), "the readout");
    }
}

#[test]
fn with_one_lamp_the_layer_says_so() {
    let mut window = tiny_window();
    let image = dichroscope::view::ImageSettings { layer: Layer::Lamps, ..state(&window).view.image.clone() };
    apply(&mut window, ViewCommand::Image(image));
    assert!(says(&window, "One lamp: no second lamp was found or given"));
    assert!(!says(&window, "lamp first"), "the readout has no lamp");
    click(&mut window, Role::ComboBox, "Layer");
    let row = named(&window, Role::Button, "Lamps");
    assert!(row.accesskit_node().is_disabled());
}
