//! Tests of white things that clip: the layer of the masks, the readout, and the debugger's step draw them.

use crate::synthetic::Scene;
use crate::window::{Window, apply, press, says, shown, state, window};
use dichroscope::app::{Command, DebugCommand, Edit, JobCommand};
use dichroscope::photo::{ClippedAreaVerdict, EncodingChoice, ReadOptions};
use dichroscope::raster::PixelIndex;
use dichroscope::trace::Event;
use dichroscope::view::{
    Instant, Item, Layer, LegendEntry, Look, Origin, Selection, instant_legend, legend, paint, paint_instant,
};
use egui::{Key, Modifiers};

/// Columns and rows of the picture.
const SIZE_PX: [usize; 2] = [480, 320];

/// A window with six balls, each with a white disk before it that clips, and the pixels inside of the disks.
fn white_disks() -> (Window, Vec<usize>) {
    let scene = Scene::grid_of_balls(SIZE_PX, 3, 2, 8);
    let mut bytes = format!("P6 {} {} 255\n", SIZE_PX[0], SIZE_PX[1]).into_bytes();
    let mut inside = Vec::new();
    for (pixel, color) in scene.render().image.pixels.as_slice().iter().enumerate() {
        let depth_px = scene.balls.iter().map(|ball| {
            let [x, y] = ball.center_px.map(|center| center + 0.35 * ball.radius_px);
            11.0 - ((pixel % SIZE_PX[0]) as f64 - x).hypot((pixel / SIZE_PX[0]) as f64 - y)
        });
        let depth_px = depth_px.fold(f64::MIN, f64::max);
        let share = (depth_px + 0.5).clamp(0.0, 1.0) as f32;
        bytes.extend(color.map(|value| (share * 320.0 + (1.0 - share) * value).round() as u8));
        inside.extend((depth_px > 0.5).then_some(pixel));
    }
    let mut window = window();
    let origin = Origin::Bytes { name: "disks.ppm".into(), bytes: bytes.as_slice().into() };
    apply(&mut window, JobCommand::Open(origin));
    let options = ReadOptions { encoding: EncodingChoice::Linear, ..ReadOptions::default() };
    apply(&mut window, JobCommand::ReadAs(options));
    assert!(state(&window).is_current());
    (window, inside)
}

/// Number of the pixels of `among` that have the color of the legend's entry `name`, and of all pixels that have it.
fn colored(painted: &[[u8; 4]], legend: &[LegendEntry], name: &str, among: &[usize]) -> [usize; 2] {
    let entry = legend.iter().find(|entry| entry.name == name).expect(name);
    let has_color = |pixel: &[u8; 4]| pixel[..3] == entry.color;
    let inside = among.iter().filter(|&&pixel| has_color(&painted[pixel])).count();
    [inside, painted.iter().filter(|pixel| has_color(pixel)).count()]
}

#[test]
fn the_layer_of_masks_draws_clipped_objects_and_the_readout_names_them() {
    let (mut window, inside) = white_disks();
    press(&mut window, Modifiers::NONE, Key::Num2);
    assert_eq!(state(&window).view.image.layer, Layer::Masks);
    assert!(says(&window, "clipped object"), "the legend");
    let look = Look { opacity: 1.0, ..Look::default() };
    let painted = paint(Layer::Masks, &shown(&window).picture, Some(&shown(&window)), None, &look);
    let [found, all] = colored(painted.as_slice(), &legend(Layer::Masks), "clipped object", &inside);
    assert_eq!(found, inside.len());
    assert!(all < 2 * inside.len(), "the disks and their edges alone: {all} of {}", inside.len());
    let pixel = PixelIndex::from_index(inside[inside.len() / 2]);
    apply(&mut window, Edit::Select(Some(Item::Pixel(pixel))));
    assert!(says(&window, "clipped object"), "the inspector");
}

#[test]
fn the_step_of_a_clipped_area_draws_its_pixels_and_says_what_it_is() {
    let (mut window, inside) = white_disks();
    let trace = state(&window).debugger.trace().unwrap().clone();
    let mut objects = Vec::new();
    for (step, event) in trace.events() {
        let Event::ClippedAreaJudged(judged) = event else { continue };
        apply(&mut window, Edit::Select(None));
        apply(&mut window, Command::Debug(DebugCommand::Seek(step + 1)));
        let is_object = judged.verdict == ClippedAreaVerdict::Object;
        let name = if is_object { "clipped object" } else { "may be a highlight" };
        assert!(says(&window, name), "the legend");
        let replay = state(&window).debugger.replay.as_ref().unwrap();
        let working = &shown(&window).analysis.working;
        let instant = Instant::of(replay, &state(&window).debugger.names, None, working);
        let look = Look { opacity: 1.0, ..Look::default() };
        let painted = paint_instant(&instant, SIZE_PX[0], SIZE_PX[1], &look);
        let [_, drawn] = colored(painted.as_slice(), &instant_legend(&instant), name, &[]);
        assert_eq!(drawn, judged.pixels.len(), "its pixels and no others");
        if is_object {
            assert!(says(&window, "Clipped object") && says(&window, "is an object that clips"));
            objects.extend(judged.pixels.iter().map(|pixel| pixel.index()));
        }
    }
    assert!(inside.iter().all(|pixel| objects.contains(pixel)), "each disk has a step");
    assert_eq!(state(&window).document.selection, Selection::default());
}
