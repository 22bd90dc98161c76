//! Tests of the preview: the result for the working picture of a large photograph, which is shown until the whole result is there.

use crate::window::{
    SIZE, Window, apply, at, click, named, region, says, shown, size, state, tiny, with_state, words, zoom_in,
};
use dichroscope::analysis::{Analysis, ContrastFinding, Observer, RunWarning, Session, Stage};
use dichroscope::app::{Application, Debugger, Edit, Executor, JobCommand, Preview, State, ViewCommand};
use dichroscope::gui::Pane;
use dichroscope::params::{Parameter, Params, Setting};
use dichroscope::photo::EncodingChoice;
use dichroscope::raster::{Blocks, PixelIndex, Raster};
use dichroscope::view::{
    ACCENT, Arrangement, ImageSettings, Item, Layer, Origin, Picture, ResultSnapshot, Selection, paint,
    verdict,
};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;

/// Side of a block of the working picture, pixels. The photograph has 178 × 150 pixels: the last block of each row and of each
/// column is cut to 2 pixels.
const SIDE: usize = 4;

/// The parameters of a result whose working picture has blocks of [`SIDE`] pixels.
fn params() -> Params {
    let mut params = Params { scale: Setting::Value(SIDE as f64), ..Params::default() };
    // The working picture has 45 × 38 pixels.
    (params.window_size, params.min_area) = (Setting::Value(4.0), Setting::Value(40.0));
    params.camera_noise = Setting::Value(2.5);
    params
}

/// Keeps the result for the working picture.
#[derive(Default)]
struct Working(Option<(Analysis, Blocks)>);

impl Observer for Working {
    fn working_made(&mut self, analysis: &Analysis, blocks: &Blocks) {
        self.0 = Some((analysis.clone(), *blocks));
    }
}

/// The result of a photograph's working picture, with colors of regions that no other result has.
fn preview(picture: &Arc<Picture>, generation: u64) -> Preview {
    let mut working = Working::default();
    let mut session = Session::new(Arc::clone(&picture.photo.image));
    session.run(&params(), &mut working).unwrap();
    let (analysis, blocks) = working.0.expect("the working picture is not the photograph");
    let colors = (0..analysis.intrinsic.regions.len()).map(|id| [200, 40 * id as u8, 90]).collect();
    let mut snapshot = ResultSnapshot::new(Arc::clone(picture), params(), analysis, colors);
    snapshot.generation = generation;
    Preview { shown: Arc::new(snapshot), blocks }
}

/// The small photograph with its result, at the moment at which the preview of the next result was reported. The photograph has no
/// ground truth here, whose scores would make the verdict on the whole result longer.
fn state_with_preview() -> State {
    let mut application = Application::new(Executor::Inline, || ()).unwrap();
    application.apply(Edit::SetParams(Box::new(params())));
    let bytes = std::fs::read(tiny()).unwrap().into();
    application.apply(JobCommand::Open(Origin::Bytes { name: "tiny.png".to_owned(), bytes }));
    let mut state = application.state().clone();
    state.document.selection = Selection::default();
    state.generation += 1;
    state.preview = state.picture.as_ref().map(|picture| preview(picture, state.generation));
    state
}

#[test]
fn panels_that_show_the_result_before_say_so() {
    let before = "the result before";
    let Some(mut window) = with_state(SIZE, state_with_preview()) else { return };
    window.run_steps(2);
    assert!(says(&window, before));
    finish(&mut window);
    assert!(!says(&window, before), "the whole result is there");
}

#[test]
fn the_time_of_an_analysis_is_told_when_all_of_its_stages_are_there() {
    let time = "7.7 s";
    for (stale_from, is_told) in [(Some(Stage::Clipping), false), (None, true)] {
        let mut state_before = state_with_preview();
        state_before.preview = None;
        let before = state_before.newest.take().unwrap();
        let (picture, analysis) = (Arc::clone(&before.picture), before.analysis.clone());
        let colors = before.region_colors.clone();
        let mut newest = ResultSnapshot::new(picture, before.params, analysis, colors);
        (newest.generation, newest.stale_from) = (state_before.generation, stale_from);
        newest.took_ms[0] = Some(7654.3);
        state_before.newest = Some(Arc::new(newest));
        let Some(mut window) = with_state(SIZE, state_before) else { return };
        window.run_steps(2);
        assert_eq!(says(&window, time), is_told, "{stale_from:?}");
    }
}

/// The window with a result that has a warning.
fn with_warning(warning: RunWarning) -> Option<Window> {
    let mut state_before = state_with_preview();
    state_before.preview = None;
    let before = state_before.newest.take().unwrap();
    let mut analysis = before.analysis.clone();
    analysis.warnings = vec![warning];
    let picture = Arc::clone(&before.picture);
    let mut newest = ResultSnapshot::new(picture, before.params, analysis, before.region_colors.clone());
    newest.generation = state_before.generation;
    state_before.newest = Some(Arc::new(newest));
    let mut window = with_state(SIZE, state_before)?;
    window.run_steps(2);
    Some(window)
}

#[test]
fn the_note_about_a_contrast_curve_reads_the_file_with_it() {
    let found = ContrastFinding { contrast: 1.318, sd: 0.02, read_with: 1.0, regions: 5 };
    let Some(mut window) = with_warning(RunWarning::Contrast(found)) else { return };
    click(&mut window, Role::Button, "Read the file as contrast:1.32");
    window.run_steps(4);
    let reading = state(&window).picture.as_ref().unwrap().reading;
    assert_eq!(reading.encoding, EncodingChoice::Contrast(1.32));
    assert!(window.query_by_role_and_label(Role::Button, "Read the file as contrast:1.32").is_none());
}

#[test]
fn a_note_over_the_picture_can_be_dismissed() {
    let Some(mut window) = with_warning(RunWarning::SecondLampIdle) else { return };
    let image = state(&window).view.image.clone();
    apply(
        &mut window,
        ViewCommand::Image(ImageSettings { arrangement: Arrangement::SideBySide, ..image.clone() }),
    );
    window.run_steps(2);
    let buttons = window.query_all_by_role_and_label(Role::Button, "Dismiss the note").count();
    assert_eq!(buttons, 2, "each view has a button of its own");
    apply(&mut window, ViewCommand::Image(image));
    window.run_steps(2);
    click(&mut window, Role::Button, "Dismiss the note");
    assert!(window.query_by_role_and_label(Role::Button, "Dismiss the note").is_none());
}

/// The preview of a state.
fn preview_of(window: &Window) -> Preview {
    state(window).preview.clone().expect("the preview is shown")
}

/// Shows a layer in the image view.
fn show_layer(window: &mut Window, layer: Layer) {
    let image = ImageSettings { layer, ..state(window).view.image.clone() };
    apply(window, ViewCommand::Image(image));
}

/// The picture of a layer of a result, sRGB, as the library paints it.
fn painted(window: &Window, layer: Layer, result: &ResultSnapshot) -> Raster<[u8; 4]> {
    let look = state(window).view.image.look(None);
    paint(layer, state(window).picture.as_ref().unwrap(), Some(result), None, &look)
}

/// Checks that the window draws each pixel of the photograph, two points wide and high, in the color that `expected` has for its column
/// and row, and nothing beyond the photograph's right and lower edges.
#[track_caller]
fn assert_drawn(window: &mut Window, what: &str, expected: impl Fn(usize, usize) -> [u8; 4]) {
    let drawn = window.render().unwrap();
    let (width, height) = size(window);
    let mut wrong = Vec::new();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let place = at(window, x as f32 + 0.5, y as f32 + 0.5);
        let color = drawn.get_pixel(place.x as u32, place.y as u32).0;
        let apart = |band: usize| color[band].abs_diff(expected(x, y)[band]);
        if (0..3).any(|band| apart(band) > 2) {
            wrong.push(((x, y), color, expected(x, y)));
        }
    }
    let color_at = |x: f32, y: f32| {
        let place = at(window, x, y);
        drawn.get_pixel(place.x as u32, place.y as u32).0
    };
    let (right, bottom) = (width as f32, height as f32);
    let background = color_at(right + 10.5, bottom + 10.5);
    for beyond in [0.5, 1.5] {
        for y in 0..height {
            assert_eq!(color_at(right + beyond, y as f32 + 0.5), background, "{what}: right of row {y}");
        }
        for x in 0..width {
            assert_eq!(color_at(x as f32 + 0.5, bottom + beyond), background, "{what}: below column {x}");
        }
    }
    assert!(wrong.is_empty(), "{what}: {} of {} pixels, {:?}", wrong.len(), width * height, wrong.first());
}

/// Analyzes the photograph anew, with hardly more camera noise than the preview: the whole result.
fn finish(window: &mut Window) {
    apply(window, Edit::SetParameter(Parameter::CameraNoise, Setting::Value(2.51), None));
    assert!(state(window).preview.is_none() && state(window).is_current());
    assert!(!shown(window).is_of_working_picture() && shown(window).params.scale == params().scale);
}

#[test]
fn a_preview_covers_the_photograph_block_by_block_until_the_whole_result_takes_its_place() {
    let Some(mut window) = with_state(SIZE, state_with_preview()) else { return };
    let preview = preview_of(&window);
    let blocks = (preview.blocks.side(), preview.blocks.columns(), preview.blocks.rows());
    assert_eq!((size(&window), blocks), ((178, 150), (SIDE, 45, 38)));
    assert!(preview.shown.analysis.intrinsic.regions.len() >= 2, "the layers are not all the same");
    zoom_in(&mut window);
    let mut frames = Vec::new();
    for layer in [Layer::Body, Layer::Regions] {
        show_layer(&mut window, layer);
        let of_blocks = painted(&window, layer, &preview.shown);
        assert_eq!((of_blocks.width(), of_blocks.height()), (45, 38));
        assert_drawn(&mut window, layer.name(), |x, y| of_blocks[y / SIDE * 45 + x / SIDE]);
        frames.push(named(&window, Role::Image, "Picture").rect());
    }
    // A layer of the photograph alone has no preview.
    show_layer(&mut window, Layer::Input);
    let photograph = painted(&window, Layer::Input, &shown(&window));
    assert_drawn(&mut window, "Input", |x, y| photograph[y * 178 + x]);
    finish(&mut window);
    for layer in [Layer::Body, Layer::Regions] {
        show_layer(&mut window, layer);
        let whole = painted(&window, layer, &shown(&window));
        assert_drawn(&mut window, layer.name(), |x, y| whole[y * 178 + x]);
        frames.push(named(&window, Role::Image, "Picture").rect());
    }
    frames.dedup();
    assert_eq!(frames.len(), 1, "the view stays where it is");
}

#[test]
fn hovering_a_preview_reads_the_pixel_of_the_photograph() {
    let Some(mut window) = with_state(SIZE, state_with_preview()) else { return };
    zoom_in(&mut window);
    show_layer(&mut window, Layer::Body);
    for (x, y) in [(0, 0), (101, 75), (177, 40), (176, 149), (177, 149)] {
        window.hover_at(at(&window, x as f32 + 0.5, y as f32 + 0.5));
        window.run_steps(3);
        let pixel = PixelIndex::from_index(y * 178 + x);
        assert_eq!(state(&window).hover, Some(Item::Pixel(pixel)));
        let [r, g, b] = state(&window).picture.as_ref().unwrap().photo.image.pixels[pixel.index()];
        let readout = words(&named(&window, Role::Label, &format!("x {x}, y {y}"))).unwrap();
        assert!(readout.contains(&format!("R {r:.1}, G {g:.1}, B {b:.1}")), "{readout}");
    }
}

#[test]
fn the_regions_panel_says_that_the_picture_shows_a_preview() {
    let mut state_before = state_with_preview();
    (state_before.newest, state_before.debugger) = (None, Debugger::default());
    let Some(mut window) = with_state(SIZE, state_before) else { return };
    window.state_mut().show_alone(Some(Pane::Regions));
    window.run_steps(3);
    assert!(says(&window, "The picture shows a preview. Regions appear when the analysis is finished."));
}

#[test]
fn the_preview_of_a_photograph_without_a_result_is_shown_and_the_view_stays_when_the_result_comes() {
    let mut state_before = state_with_preview();
    (state_before.newest, state_before.debugger) = (None, Debugger::default());
    let Some(mut window) = with_state(SIZE, state_before) else { return };
    zoom_in(&mut window);
    show_layer(&mut window, Layer::Body);
    let of_blocks = painted(&window, Layer::Body, &preview_of(&window).shown);
    assert_drawn(&mut window, "preview", |x, y| of_blocks[y / SIDE * 45 + x / SIDE]);
    let used_by_panel = state(&window).newest_run().map(|shown| shown.analysis.used);
    assert_eq!(used_by_panel, Some(preview_of(&window).shown.analysis.used));
    // The window size in pixels of the photograph.
    named(&window, Role::Label, "of working pixels of 4 \u{d7} 4; in the photograph 16 px");
    let before = named(&window, Role::Image, "Picture").rect();
    finish(&mut window);
    let whole = painted(&window, Layer::Body, &shown(&window));
    assert_drawn(&mut window, "result", |x, y| whole[y * 178 + x]);
    assert_eq!(named(&window, Role::Image, "Picture").rect(), before);
}

/// The state with a preview of which some regions are as in the result before.
fn state_with_regions(change: impl FnOnce(&mut Analysis)) -> State {
    let mut state = state_with_preview();
    let Preview { shown, blocks } = state.preview.take().unwrap();
    let (picture, mut analysis) = (Arc::clone(&shown.picture), shown.analysis.clone());
    change(&mut analysis);
    let colors = state.newest.as_ref().unwrap().region_colors.clone();
    let mut snapshot = ResultSnapshot::new(picture, shown.params, analysis, colors);
    snapshot.generation = shown.generation;
    state.preview = Some(Preview { shown: Arc::new(snapshot), blocks });
    state
}

#[test]
fn the_verdict_is_about_the_preview_while_the_picture_shows_it() {
    let Some(mut window) = with_state(
        SIZE,
        state_with_regions(|analysis| {
            Arc::make_mut(&mut analysis.intrinsic).regions.truncate(1);
        }),
    ) else {
        return;
    };
    window.run_steps(2);
    let first = |shown: &ResultSnapshot| verdict(shown)[0].text.to_lowercase();
    let [of_preview, of_result] = [first(&preview_of(&window).shown), first(&shown(&window))];
    assert_ne!(of_preview, of_result);
    let links = |window: &Window| -> Vec<String> {
        let links = window.query_all_by_role(Role::Link);
        links.filter_map(|link| words(&link)).map(|words| words.to_lowercase()).collect()
    };
    assert!(links(&window).iter().any(|link| link.starts_with(&of_preview)), "{:?}", links(&window));
    assert!(!links(&window).iter().any(|link| link.starts_with(&of_result)), "{:?}", links(&window));
}

#[test]
fn the_selected_region_is_outlined_in_the_preview_as_the_preview_has_it() {
    let Some(mut window) = with_state(SIZE, state_with_preview()) else { return };
    zoom_in(&mut window);
    apply(&mut window, Edit::Select(Some(region(1))));
    show_layer(&mut window, Layer::Input);
    let photograph = painted(&window, Layer::Input, &shown(&window));
    assert_drawn(&mut window, "no region of this color", |x, y| photograph[y * 178 + x]);

    let Some(mut window) = with_state(SIZE, state_with_regions(|_| ())) else { return };
    zoom_in(&mut window);
    apply(&mut window, Edit::Select(Some(region(1))));
    let (preview, selected) = {
        let (preview, selected) = state(&window).outlined_in_preview().expect("it is in the preview");
        (preview.clone(), selected.get())
    };
    let labels = preview.shown.labels();
    let mut is_outlined = 0;
    show_layer(&mut window, Layer::Input);
    let drawn = window.render().unwrap();
    for row in 1..37 {
        for column in 1..44 {
            let label = |x: usize, y: usize| *labels.get(x, y).unwrap();
            let is_border = label(column, row) == selected && label(column - 1, row) != selected;
            let place = at(&window, (column * SIDE + 2) as f32, (row * SIDE + 2) as f32);
            let color = drawn.get_pixel(place.x as u32, place.y as u32).0;
            let is_accent = (0..3).all(|band| color[band].abs_diff(ACCENT[band]) <= 2);
            assert!(is_accent || !is_border, "column {column} of row {row}: {color:?}");
            is_outlined += usize::from(is_border);
        }
    }
    assert!(is_outlined > 5, "the region has a border");
}

#[test]
fn the_status_line_is_about_the_result_that_the_verdict_is_about() {
    let mut state_before = state_with_preview();
    let mut preview = state_before.preview.take().unwrap();
    let mut analysis = preview.shown.analysis.clone();
    analysis.used.camera_noise = 7.77;
    let (picture, colors) = (Arc::clone(&preview.shown.picture), preview.shown.region_colors.clone());
    let mut shown = ResultSnapshot::new(picture, params(), analysis, colors);
    shown.generation = state_before.generation;
    preview.shown = Arc::new(shown);
    state_before.preview = Some(preview);
    let Some(mut window) = with_state(SIZE, state_before) else { return };
    window.run_steps(2);
    let [of_preview, of_whole] = ["\u{3c3}0 7.77", "\u{3c3}0 2.5"];
    assert!(says(&window, of_preview) && !says(&window, of_whole));
    finish(&mut window);
    assert!(!says(&window, of_preview) && says(&window, of_whole));
}
