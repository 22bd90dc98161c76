//! The menu bar: every action by its name, and the status line.

#[cfg(test)]
pub mod testing;

use super::action::{Action, CubeAction, DebugAction, TextStep, ViewStep};
use super::cube_choices::{COLORINGS, NamedView};
use super::dock::Dock;
use super::lacking_result::ANALYZE_NOW;
use super::menu_keys::{MenuKeys, submenu, submenu_with_fields};
use super::move_cursor::selected_goal;
use super::pane::Pane;
use super::shortcuts::keys_of;
use super::typed_path::unique_names;
use super::widgets::capitalized;
use super::{PanelContext, status};
use crate::app::{JobCommand, StepUnit, Switching};
use crate::color::ContrastCurve;
use crate::params::{Method, Params, Preset};
use crate::photo::{EncodingChoice, FULL_SCALE_COUNTS, ReadOptions};
use crate::truth::sample::{SAMPLES, THREE_LAMPS};
use crate::view::{ArrangementKind, ColorSpace, ElsewhereKind, Origin, Theme};
use egui::accesskit::Role;
use egui::{Button, Checkbox, RadioButton, Response, Ui, Widget, WidgetInfo};

/// A way to read the photograph's file, which the menu offers.
pub struct Reading {
    /// The encoding.
    pub encoding: EncodingChoice,
    /// The encoding's name.
    pub name: &'static str,
    tip: &'static str,
}

/// The ways to read a file that declares no encoding or a wrong one.
pub const READINGS: [Reading; 4] = [
    Reading {
        encoding: EncodingChoice::Auto,
        name: "as the file says",
        tip: "sRGB for integers and linear for floats that say nothing.",
    },
    Reading {
        encoding: EncodingChoice::Linear,
        name: "linear light",
        tip: "The values are proportional to light.",
    },
    Reading { encoding: EncodingChoice::Srgb, name: "sRGB", tip: "The values carry sRGB's tone curve." },
    Reading { encoding: EncodingChoice::Gamma(2.2), name: "gamma 2.2", tip: "linear = value ^ 2.2" },
];

/// The themes with their names.
pub const THEMES: [(Theme, &str); 2] = [(Theme::Dark, "Dark"), (Theme::Light, "Light")];

/// The name of a method.
pub const fn method_name(method: Method) -> &'static str {
    match method {
        Method::Refined => "Refined method",
        Method::Paper => "Paper's method",
        Method::Phoenix => "Phoenix",
        Method::TopDown => "Top-down clusters",
        Method::ByHand => "Skewed T by hand",
    }
}

/// Shows the menu bar and the status line.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, keys: &mut MenuKeys, dock: &mut Dock) {
    keys.begin();
    egui::MenuBar::new().ui(ui, |ui| {
        keys.menu(ui, "File", |ui| file(ui, cx));
        keys.menu(ui, "Edit", |ui| edit(ui, cx));
        keys.menu(ui, "View", |ui| view(ui, cx, dock));
        keys.menu(ui, "Analyze", |ui| analyze(ui, cx));
        keys.menu(ui, "Decisions", |ui| decisions(ui, cx));
        keys.menu(ui, "Help", |ui| help(ui, cx));
        status::show(ui, cx);
    });
    keys.close_after_choice(ui.ctx());
}

/// Shows a row of a menu with the keys of its action. The action is carried out when the row is chosen.
fn item(ui: &mut Ui, cx: &mut PanelContext, text: &str, action: Action, enabled: bool) -> Response {
    let keys = keys_of(ui.ctx(), action);
    row(ui, cx, Button::new(text).shortcut_text(keys), action, enabled)
}

/// Shows a row of a menu whose action makes one choice of several. Returns the row.
fn choice(
    ui: &mut Ui,
    cx: &mut PanelContext,
    text: &str,
    action: Action,
    [on, enabled]: [bool; 2],
) -> Response {
    row(ui, cx, RadioButton::new(on, text), action, enabled)
}

/// Shows a widget as a row of a menu, and carries its action out when it is chosen.
fn row(ui: &mut Ui, cx: &mut PanelContext, widget: impl Widget, action: Action, enabled: bool) -> Response {
    let row = ui.add_enabled(enabled, widget);
    #[cfg(test)]
    testing::note(ui, row.id, action);
    if row.clicked() {
        cx.act(action);
    }
    row
}

/// The menu of files, exports and workspaces.
fn file(ui: &mut Ui, cx: &mut PanelContext) {
    item(ui, cx, "Open\u{2026}", Action::Open, true);
    submenu(ui, "Open recent", |ui| recent(ui, cx));
    if cx.state.picture.is_some() {
        submenu(ui, "Open photographs", |ui| open_photographs(ui, cx));
    }
    submenu(ui, "Sample scenes", |ui| samples(ui, cx));
    submenu_with_fields(ui, "Read as", |ui| read_as(ui, cx));
    elsewhere(ui, cx);
    ui.separator();
    item(ui, cx, "Open workspace\u{2026}", Action::OpenWorkspace, true);
    let open = cx.state.picture.is_some();
    // Without a file, saving asks for one.
    let save = if cx.state.workspace_path.is_some() { "Save workspace" } else { "Save workspace\u{2026}" };
    item(ui, cx, save, Action::Save, open);
    item(ui, cx, "Save workspace as\u{2026}", Action::SaveWorkspaceAs, open);
    item(ui, cx, "Export\u{2026}", Action::Export, cx.state.shown().is_some());
    ui.separator();
    item(ui, cx, "Quit", Action::Quit, true);
}

/// The submenu of photographs that were opened before.
fn recent(ui: &mut Ui, cx: &mut PanelContext) {
    for (path, name) in cx.state.recent.iter().zip(unique_names(&cx.state.recent)) {
        if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
            cx.send(JobCommand::Open(Origin::File(path.clone())));
        }
    }
    ui.separator();
    item(ui, cx, "Forget these", Action::ForgetRecent, !cx.state.recent.is_empty());
}

/// The submenu of the bundled scenes.
fn samples(ui: &mut Ui, cx: &mut PanelContext) {
    for (index, sample) in SAMPLES.iter().enumerate() {
        item(ui, cx, sample.name, Action::Sample(index), true).on_hover_text(sample.about);
    }
    ui.separator();
    item(ui, cx, THREE_LAMPS.name, Action::ThreeLamps, true).on_hover_text(THREE_LAMPS.about);
}

/// The rows that open and close pictures that another program made of the photograph.
fn elsewhere(ui: &mut Ui, cx: &mut PanelContext) {
    ui.separator();
    for kind in ElsewhereKind::ALL {
        let tip = "Holds it against the result: layers, scores and values under the pointer (section 7).";
        let text = format!("Open {} of another program\u{2026}", kind.name());
        item(ui, cx, &text, Action::OpenElsewhere(kind), cx.state.picture.is_some()).on_hover_text(tip);
        let paths = cx.state.elsewhere.as_ref().map(|all| all.paths.clone()).unwrap_or_default();
        let Some(path) = paths.get(kind) else { continue };
        let text = format!("Close {} {}", kind.name(), file_name(path));
        item(ui, cx, &text, Action::CloseElsewhere(kind), true).on_hover_text(path.display().to_string());
    }
}

/// The name of a file without its folder.
fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The submenu of the photographs that are open.
fn open_photographs(ui: &mut Ui, cx: &mut PanelContext) {
    let name = cx.state.picture.as_ref().map(|picture| picture.origin.name());
    let _ = ui.selectable_label(true, name.unwrap_or_default());
    for (index, other) in cx.state.others.iter().enumerate() {
        if ui.selectable_label(false, other.picture.origin.name()).clicked() {
            cx.commands.push(JobCommand::Switch(Switching::To(index)).into());
        }
    }
    ui.separator();
    let several = !cx.state.others.is_empty();
    item(ui, cx, "Next photograph", Action::Switch(Switching::Next), several);
    item(ui, cx, "Photograph before", Action::Switch(Switching::Previous), several);
    let compares = cx.state.compares_photographs;
    let text = if compares { "No longer compare" } else { "Compare with the next beside" };
    item(ui, cx, text, Action::ComparePhotographs, several);
    item(ui, cx, "Close this photograph", Action::ClosePhotograph, several);
}

/// Gives fields in a menu the ground of fields; egui draws them like the rows of the menu, as text alone.
fn fill_fields(ui: &mut Ui) {
    let ground = ui.visuals().extreme_bg_color;
    ui.visuals_mut().widgets.inactive.weak_bg_fill = ground;
}

/// The menu of the encodings, for files that declare no encoding or a wrong one.
fn read_as(ui: &mut Ui, cx: &mut PanelContext) {
    let open = cx.state.picture.is_some();
    let now = cx.state.picture.as_ref().map_or_else(ReadOptions::default, |picture| picture.reading);
    for (index, reading) in READINGS.iter().enumerate() {
        let states = [now.encoding == reading.encoding, open];
        let row = choice(ui, cx, reading.name, Action::ReadAs(index), states).on_hover_text(reading.tip);
        if row.clicked() {
            ui.close();
        }
    }
    ui.horizontal(|ui| {
        fill_fields(ui);
        let tip = "sRGB after the contrast curve of a camera: its slope in the middle. Above 1 shadows are darker and lights brighter; 1 is sRGB alone.";
        ui.label("sRGB with contrast").on_hover_text(tip);
        let mut contrast = now.encoding.contrast().unwrap_or(1.0);
        // The value is typed and not dragged, because each value reads the file again.
        let field = egui::DragValue::new(&mut contrast).range(ContrastCurve::CONTRASTS).speed(0.0).update_while_editing(false);
        let field = ui.add(field.fixed_decimals(2)).on_hover_text(tip);
        field.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, "contrast"));
        if field.changed() {
            ui.close();
            cx.send(JobCommand::ReadAs(ReadOptions { encoding: EncodingChoice::of_contrast(contrast), ..now }));
        }
    });
    ui.separator();
    ui.horizontal(|ui| {
        fill_fields(ui);
        let tip = "Counts that an integer's maximum or a float's 1.0 stands for; 255 unless the file has head-room.";
        ui.label("full scale").on_hover_text(tip);
        let mut counts = now.full_scale.unwrap_or(FULL_SCALE_COUNTS);
        // The value is typed and not dragged, because each value reads the file again.
        let field = egui::DragValue::new(&mut counts).range(1.0..=1e6).speed(0.0).update_while_editing(false);
        let field = ui.add(field.max_decimals(3).suffix(" counts")).on_hover_text(tip);
        field.widget_info(|| WidgetInfo::labeled(Role::SpinButton, true, "full scale"));
        if field.changed() {
            ui.close();
            cx.send(JobCommand::ReadAs(ReadOptions { full_scale: Some(counts), ..now }));
        }
    });
}

/// The menu of undo, selection and area.
fn edit(ui: &mut Ui, cx: &mut PanelContext) {
    let state = cx.state;
    let has_marked = state.document.selection.marked.is_some();
    item(ui, cx, "Undo", Action::Undo, state.history.can_undo());
    item(ui, cx, "Redo", Action::Redo, state.history.can_redo());
    ui.separator();
    item(ui, cx, "Invert marked", Action::Invert, state.picture.is_some());
    let can_keep = has_marked && state.document.selection.named.active.is_none();
    item(ui, cx, "Keep as a named mark", Action::KeepMark, can_keep);
    item(ui, cx, "Select nothing", Action::Escape, !state.document.selection.is_empty());
    ui.separator();
    item(ui, cx, "Analyze only the marked pixels", Action::AnalyzeMarked, has_marked)
        .on_hover_text("Pixels outside are left out of every stage and stay as they are.");
    item(ui, cx, "Fit skewed T to the marked", Action::FitSkewedT, has_marked);
    item(ui, cx, "Analyze the whole picture", Action::AnalyzeAll, state.document.area.is_some());
}

/// The menu of panels, zoom, one or two layers, and themes.
fn view(ui: &mut Ui, cx: &mut PanelContext, dock: &mut Dock) {
    for pane in Pane::ALL {
        let mut visible = dock.is_visible(pane);
        let checkbox = ui.add(Checkbox::new(&mut visible, pane.title()));
        #[cfg(test)]
        testing::note(ui, checkbox.id, Action::Show(pane));
        if checkbox.changed() {
            dock.set_visible(pane, visible);
        }
    }
    item(ui, cx, "Arrange as at first", Action::ShowAll, true);
    ui.separator();
    let open = cx.state.picture.is_some();
    for (text, action) in [
        ("Zoom in", Action::View(ViewStep::ZoomIn)),
        ("Zoom out", Action::View(ViewStep::ZoomOut)),
        ("Zoom to fit", Action::Fit),
        ("Zoom to 100 %", Action::OneToOne),
    ] {
        item(ui, cx, text, action, open);
    }
    ui.separator();
    let now = cx.state.view.image.arrangement.kind();
    for kind in ArrangementKind::ALL {
        choice(ui, cx, kind.name(), Action::Arrange(kind), [kind == now, open]).on_hover_text(kind.meaning());
    }
    submenu(ui, "Color space settings", |ui| color_space(ui, cx));
    ui.separator();
    for (text, step) in [
        ("Larger text and controls", TextStep::Larger),
        ("Smaller text and controls", TextStep::Smaller),
        ("Text and controls as at first", TextStep::AsAtFirst),
    ] {
        item(ui, cx, text, Action::TextSize(step), true);
    }
    ui.separator();
    for (theme, name) in THEMES {
        choice(ui, cx, name, Action::UseTheme(theme), [cx.state.view.theme == theme, true]);
    }
}

/// The submenu of colorings, spaces and named views of the color space view.
fn color_space(ui: &mut Ui, cx: &mut PanelContext) {
    let (cube, open) = (&cx.state.view.cube, cx.state.picture.is_some());
    for (color_by, name, tip) in COLORINGS {
        let text = format!("Color by {}", name.to_lowercase());
        let action = Action::Cube(CubeAction::ColorBy(color_by));
        choice(ui, cx, &text, action, [cube.color_by == color_by, open]).on_hover_text(tip);
    }
    ui.separator();
    for space in ColorSpace::ALL {
        let action = Action::Cube(CubeAction::Space(space));
        choice(ui, cx, space.name(), action, [cube.space == space, open]).on_hover_text(space.meaning());
    }
    ui.separator();
    for (view, _, name, tip) in NamedView::ALL {
        item(ui, cx, name, Action::Cube(CubeAction::View(view)), open).on_hover_text(tip);
    }
    item(ui, cx, "Perspective or not", Action::Cube(CubeAction::Perspective), open);
}

/// The menu that moves the debugger's cursor.
fn decisions(ui: &mut Ui, cx: &mut PanelContext) {
    use crate::app::Direction::{Back, Forward};
    let (traced, playing) = (cx.state.debugger.replay.is_some(), cx.state.debugger.playing);
    let any_breakpoint = cx.state.view.debug.breakpoints.iter().any(|breakpoint| breakpoint.enabled);
    let goal = traced && selected_goal(cx.state).is_some();
    let record = if cx.state.view.debug.open { "Stop recording" } else { "Record" };
    let play = if playing.is_some() { "Pause" } else { "Play" };
    let back = if playing == Some(Back) { "Pause" } else { "Play backwards" };
    let mut row = |ui: &mut Ui, text: &str, action: DebugAction, enabled: bool| {
        item(ui, cx, text, Action::Debug(action), enabled);
    };
    row(ui, record, DebugAction::Record, true);
    ui.separator();
    row(ui, play, DebugAction::Play(Forward), traced);
    row(ui, back, DebugAction::Play(Back), traced);
    row(ui, "Into the next hypothesis", DebugAction::Into, traced);
    ui.separator();
    for unit in [StepUnit::Stage, StepUnit::Hypothesis, StepUnit::Event, StepUnit::Step] {
        for (direction, text) in [(Forward, "forward"), (Back, "back")] {
            let text = format!("{} {text}", capitalized(unit.name()));
            row(ui, &text, DebugAction::Step(unit, direction), traced);
        }
    }
    row(ui, "To the beginning", DebugAction::Start, traced);
    row(ui, "To the result", DebugAction::End, traced);
    ui.separator();
    row(ui, "Next breakpoint", DebugAction::Breakpoint(Forward), traced && any_breakpoint);
    row(ui, "Breakpoint before", DebugAction::Breakpoint(Back), traced && any_breakpoint);
    row(ui, "Breakpoint for what is selected, or no longer", DebugAction::ToggleBreakpoint, traced);
    row(ui, "Next change of what is selected", DebugAction::Change(Forward), goal);
    row(ui, "Change before, of what is selected", DebugAction::Change(Back), goal);
}

/// The menu of methods, presets, parameter files and pinning.
fn analyze(ui: &mut Ui, cx: &mut PanelContext) {
    let method = cx.state.document.params.method;
    for other in Method::ALL {
        choice(ui, cx, method_name(other), Action::Method(other), [method == other, true])
            .on_hover_text(other.meaning());
    }
    submenu(ui, "Presets of table 6", |ui| {
        for preset in Preset::ALL {
            let tip = "The paper's method with the numbers of this column of table 6 (section 7.3).";
            item(ui, cx, preset.title(), Action::Preset(preset), true).on_hover_text(tip);
        }
    });
    let changed = cx.state.document.params != Params::of(method);
    item(ui, cx, "Reset parameters", Action::ResetParameters, changed)
        .on_hover_text("Every parameter and switch to this method's default.");
    item(ui, cx, "Load parameters\u{2026}", Action::LoadParameters, true);
    item(ui, cx, "Save parameters\u{2026}", Action::SaveParameters, true);
    ui.separator();
    if cx.state.jobs.analysis.is_some() {
        item(ui, cx, "Cancel the analysis", Action::CancelAnalysis, true)
            .on_hover_text("The result before stays.");
    } else if cx.state.jobs.recording.is_some() {
        item(ui, cx, "Cancel the recording", Action::CancelAnalysis, true)
            .on_hover_text("The result stays, without the decisions that led to it.");
    } else {
        item(ui, cx, ANALYZE_NOW, Action::Analyze, cx.state.picture.is_some())
            .on_hover_text("Analyze the photograph with the present parameters.");
    }
    ui.separator();
    let pinned = cx.state.pinned.is_some();
    let text = if pinned { "Let the pinned result go" } else { "Pin this result to compare with" };
    item(ui, cx, text, Action::Pin, cx.state.newest.is_some());
    item(ui, cx, "Show the other of the two", Action::Swap, pinned);
    ui.separator();
    item(ui, cx, "Copy as command line", Action::CopyCommandLine, cx.state.picture.is_some())
        .on_hover_text("The `dichroscope analyze` call that reproduces what is on the screen.");
}

/// The menu of the lists of commands and keys, and what the program is.
fn help(ui: &mut Ui, cx: &mut PanelContext) {
    item(ui, cx, "All commands\u{2026}", Action::Palette, true);
    item(ui, cx, "Keyboard and pointer", Action::Help, true);
    ui.separator();
    ui.label(format!("Dichroscope {}", env!("CARGO_PKG_VERSION")));
    ui.hyperlink_to("Klinker, Shafer & Kanade 1990", "https://doi.org/10.1007/BF00126399");
}
