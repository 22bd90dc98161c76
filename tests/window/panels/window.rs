//! Helpers that open the window without a screen, find widgets by name, and simulate pointer and keys.

use dichroscope::app::{Application, Command, Edit, Executor, JobCommand, State, ViewCommand};
use dichroscope::gui::App;
use dichroscope::params::{Parameter, Setting};
use dichroscope::raster::RegionId;
use dichroscope::truth::sample;
use dichroscope::view::{Item, Origin, ResultSnapshot, Selection};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::wgpu::WgpuTestRenderer;
use egui_kittest::{Harness, HarnessBuilder, Node};
use egui_wgpu::{RenderState, RendererOptions, WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

pub type Window = Harness<'static, App>;

/// Size of the window at the first start, points.
pub const SIZE: Vec2 = vec2(1440.0, 900.0);

/// Number of frames after which menus and dialogs that a click opened have their final position.
const FRAMES: usize = 3;

/// A photograph that is read, analyzed and traced once for all tests; each window starts with a copy of that state.
#[derive(Clone, Copy)]
pub enum Fixture {
    /// The small photograph of [`tiny`].
    Tiny,
    /// The photograph of `Tiny`, with the camera's noise set to 2.5 counts, so that pictures do not
    /// depend on the estimate.
    TinyFixedNoise,
    /// The sample scene that the program opens at its start.
    Sample,
}

impl Fixture {
    fn state(self) -> State {
        static STATES: [OnceLock<State>; 3] = [const { OnceLock::new() }; 3];
        STATES[self as usize].get_or_init(|| self.analyze()).clone()
    }

    fn analyze(self) -> State {
        let mut application = Application::new(Executor::Inline, || ()).unwrap();
        if matches!(self, Self::TinyFixedNoise) {
            application.apply(Edit::SetParameter(Parameter::CameraNoise, Setting::Value(2.5), None));
        }
        application.apply(JobCommand::Open(match self {
            Self::Tiny | Self::TinyFixedNoise => Origin::File(tiny()),
            Self::Sample => Origin::Sample(sample::NAME.to_owned()),
        }));
        let state = application.state();
        assert!(state.is_current() && state.debugger.trace().is_some(), "{:?}", state.notices);
        let mut state = state.clone();
        // The largest region is selected at first; most tests begin with nothing selected.
        state.document.selection = Selection::default();
        state
    }
}

/// A window without a photograph and without a graphics adapter.
pub fn window() -> Window {
    undrawn(State::default())
}

fn undrawn(state: State) -> Window {
    builder(SIZE).build_eframe(|cc| App::with_state(&cc.egui_ctx, None, Executor::Inline, state).unwrap())
}

/// A window with a graphics adapter. Without an adapter, the result is `None` and the test is skipped with a message;
/// it fails if `DICHROSCOPE_REQUIRE_GPU` is set.
pub fn with_gpu(size: Vec2, fixture: Fixture) -> Option<Window> {
    Some(with_device(size, fixture)?.0)
}

/// Like [`with_gpu`]; also returns the device, with which images can be read back.
pub fn with_device(size: Vec2, fixture: Fixture) -> Option<(Window, RenderState)> {
    match render_state() {
        Ok(gpu) => Some((drawn_by(gpu.clone(), size, fixture), gpu)),
        Err(reason) => skip(&format!("no graphics adapter ({reason})")),
    }
}

/// Like [`with_gpu`], with Mesa's software driver, which drew the stored pictures: graphics cards draw
/// edges differently.
pub fn with_software_driver(size: Vec2, fixture: Fixture) -> Option<Window> {
    let gpu = match render_state() {
        Ok(gpu) => gpu,
        Err(reason) => return skip(&format!("no graphics adapter ({reason})")),
    };
    let info = gpu.adapter.get_info();
    if info.device_type == wgpu::DeviceType::Cpu {
        Some(drawn_by(gpu, size, fixture))
    } else {
        skip(&format!("the pictures are of the software driver, not of {}", info.name))
    }
}

/// Like [`with_gpu`], with any state.
pub fn with_state(size: Vec2, state: State) -> Option<Window> {
    match render_state() {
        Ok(gpu) => Some(state_drawn_by(gpu, size, state)),
        Err(reason) => skip(&format!("no graphics adapter ({reason})")),
    }
}

fn drawn_by(gpu: RenderState, size: Vec2, fixture: Fixture) -> Window {
    state_drawn_by(gpu, size, fixture.state())
}

fn state_drawn_by(gpu: RenderState, size: Vec2, state: State) -> Window {
    let builder = builder(size).renderer(WgpuTestRenderer::from_render_state(gpu.clone()));
    builder.build_eframe(move |cc| App::with_state(&cc.egui_ctx, Some(gpu), Executor::Inline, state).unwrap())
}

fn skip<T>(why: &str) -> Option<T> {
    assert!(!gpu_required(), "a graphics adapter is required: {why}");
    eprintln!("SKIP: {why}");
    None
}

fn gpu_required() -> bool {
    std::env::var_os("DICHROSCOPE_REQUIRE_GPU").is_some_and(|value| !value.is_empty() && value != "0")
}

fn builder(size: Vec2) -> HarnessBuilder<App> {
    Harness::builder().with_size(size).with_pixels_per_point(1.0).with_max_steps(32).with_render_cursor(false)
}

/// Options that allow Vulkan only: other graphics interfaces give slightly different pictures.
fn render_state() -> Result<RenderState, String> {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = wgpu::Backends::VULKAN;
    let config =
        WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..WgpuConfiguration::default() };
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::VULKAN,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(RenderState::create(&config, &instance, None, RendererOptions::PREDICTABLE))
        .map_err(|error| error.to_string())
}

/// Path of a small photograph with three highlights.
pub fn tiny() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .expect("this package lies in the repository");
    root.join("assets/tiny/camera8.png")
}

/// A window with the small photograph.
pub fn tiny_window() -> Window {
    undrawn(Fixture::Tiny.state())
}

pub fn apply(window: &mut Window, command: impl Into<Command>) {
    window.state_mut().apply(command);
    window.run_steps(FRAMES);
}

pub fn state(window: &Window) -> &State {
    window.state().state()
}

pub fn shown(window: &Window) -> Arc<ResultSnapshot> {
    Arc::clone(state(window).shown().expect("a result is shown"))
}

pub fn item(window: &Window) -> Option<Item> {
    state(window).document.selection.item
}

/// Number of marked pixels.
pub fn marked(window: &Window) -> usize {
    let mask = &state(window).document.selection.marked;
    mask.as_ref().map_or(0, |mask| mask.as_slice().iter().filter(|&&on| on).count())
}

pub fn sigma(window: &Window) -> Setting {
    state(window).document.params.get(Parameter::CameraNoise)
}

/// The text of the newest notice.
#[track_caller]
pub fn notice(window: &Window) -> String {
    state(window).notices.last().expect("there is a notice").text.clone()
}

/// The widget with this role and a name that begins with `name`; entries of menus append their keys to the name.
#[track_caller]
pub fn named<'w>(window: &'w Window, role: Role, name: &str) -> Node<'w> {
    let fits = |node: &Node<'w>| {
        node.accesskit_node().role() == role && words(node).is_some_and(|words| words.starts_with(name))
    };
    let mut found: Vec<Node<'w>> = window.root().children_recursive().filter(fits).collect();
    assert_eq!(found.len(), 1, "{role:?}: {found:#?}");
    found.remove(0)
}

/// The accessible name of a widget; of a label its text.
pub fn words(node: &Node<'_>) -> Option<String> {
    let node = node.accesskit_node();
    if node.role() == Role::Label { node.value().or(node.label()) } else { node.label() }
}

/// Whether the name of any shown widget contains these words.
pub fn says(window: &Window, words: &str) -> bool {
    let holds = |text: Option<String>| text.is_some_and(|text| text.contains(words));
    window.root().children_recursive().any(|node| {
        let node = node.accesskit_node();
        holds(node.label()) || holds(node.value())
    })
}

#[track_caller]
pub fn click(window: &mut Window, role: Role, name: &str) {
    named(window, role, name).click();
    window.run_steps(FRAMES);
}

/// Opens a menu of the menu bar and clicks an entry.
#[track_caller]
pub fn choose(window: &mut Window, menu: &str, entry: &str) {
    window.get_by_role_and_label(Role::Button, menu).click();
    window.run_steps(FRAMES);
    // A panel's tab may have the same name as the entry.
    let roles = [Role::CheckBox, Role::RadioButton, Role::Button];
    let found = roles.iter().find_map(|&role| {
        let fits = |node: &Node<'_>| {
            node.accesskit_node().role() == role && words(node).is_some_and(|words| words.starts_with(entry))
        };
        window.root().children_recursive().filter(fits).last()
    });
    found.unwrap_or_else(|| panic!("{menu} has no {entry}")).click();
    window.run_steps(FRAMES);
}

/// Opens a bundled scene from the menu.
pub fn open_sample(window: &mut Window, name: &str) {
    choose(window, "File", "Sample scenes");
    click(window, Role::Button, name);
    assert_eq!(state(window).picture.as_ref().unwrap().origin, Origin::Sample(name.to_owned()));
}

pub fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(FRAMES);
}

pub fn undo(window: &mut Window) {
    press(window, Modifiers::COMMAND, Key::Z);
}

/// Replaces the text of the dialog that asks for a path, and confirms.
#[track_caller]
pub fn answer(window: &mut Window, path: &Path) {
    let field = named(window, Role::TextInput, "Path");
    field.focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.event(Event::Text(path.display().to_string()));
    window.run_steps(2);
    press(window, Modifiers::NONE, Key::Enter);
}

pub fn pointer(window: &mut Window, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    let button = PointerButton::Primary;
    window.event_modifiers(Event::PointerButton { pos, button, pressed, modifiers }, modifiers);
    window.run_steps(1);
}

/// Drags: presses the primary button at the first point, moves through the others, and releases the button.
pub fn drag(window: &mut Window, points: &[Pos2], modifiers: Modifiers) {
    let (first, last) = (points[0], points[points.len() - 1]);
    window.hover_at(first);
    window.run_steps(1);
    pointer(window, first, true, modifiers);
    for &point in &points[1..] {
        window.hover_at(point);
        window.run_steps(1);
    }
    pointer(window, last, false, modifiers);
    window.run_steps(2);
}

/// A click with the secondary button of the pointer, which opens a menu.
pub fn secondary_click(window: &mut Window, pos: Pos2) {
    window.hover_at(pos);
    window.run_steps(2);
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Secondary, Modifiers::NONE);
        window.event(Event::PointerButton { pos, button, pressed, modifiers });
    }
    window.run_steps(3);
}

/// A click with press and release in one frame.
pub fn tap(window: &mut Window, pos: Pos2) {
    window.hover_at(pos);
    window.run_steps(1);
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        window.input_mut().events.push(Event::PointerButton { pos, button, pressed, modifiers });
    }
    window.run_steps(FRAMES);
}

/// A double click, in one frame because a frame of the harness takes a quarter of a second.
pub fn double_click(window: &mut Window, pos: Pos2) {
    window.hover_at(pos);
    window.run_steps(4);
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        window.input_mut().events.push(Event::PointerButton { pos, button, pressed, modifiers });
    }
    window.run_steps(FRAMES);
}

/// Sets the zoom to two screen points per pixel, with the picture's middle in the view's middle, as [`at`] requires.
pub fn zoom_in(window: &mut Window) {
    let (width, height) = size(window);
    let mut image = state(window).view.image.clone();
    (image.zoom, image.center_px) = (Some(2.0), Some([width as f32 / 2.0, height as f32 / 2.0]));
    apply(window, ViewCommand::Image(image));
}

/// Screen position of a point of the picture after [`zoom_in`].
pub fn at(window: &Window, x: f32, y: f32) -> Pos2 {
    let (width, height) = size(window);
    let view = window.get_by_role_and_label(Role::Image, "Picture").rect();
    view.center() + 2.0 * vec2(x - width as f32 / 2.0, y - height as f32 / 2.0)
}

/// Number of columns and rows of the picture.
pub fn size(window: &Window) -> (usize, usize) {
    state(window).picture.as_ref().expect("a picture is open").size()
}

/// The region with a number, as an item.
pub fn region(number: u16) -> Item {
    Item::Region(RegionId::from_label(number).expect("regions count from 1"))
}

/// Column and row of a pixel of a region, away from the region's border.
pub fn inside(window: &Window, region: u16) -> (usize, usize) {
    let shown = shown(window);
    let labels = shown.labels();
    let all = |x: usize, y: usize| {
        (y - 3..=y + 3).all(|y| (x - 3..=x + 3).all(|x| labels.get(x, y) == Some(&region)))
    };
    (3..labels.height() - 3)
        .flat_map(|y| (3..labels.width() - 3).map(move |x| (x, y)))
        .find(|&(x, y)| all(x, y))
        .expect("the region has an inside")
}
