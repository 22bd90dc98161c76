//! The menu bar: every action by its name, and the status line.

use super::action::{Action, DebugAction};
use super::dock::Dock;
use super::files::{Dialog, Dialogs};
use super::move_cursor::{move_cursor, selected_goal};
use super::pane::Pane;
use super::shortcuts::keys_of;
use super::typed_path::unique_names;
use super::widgets::capitalized;
use super::{PanelContext, perform, status};
use crate::app::{Edit, JobCommand, NamedMarkEdit, Severity, StepUnit, Switching, ViewCommand, analyze_call};
use crate::params::{Method, Preset};
use crate::photo::{EncodingChoice, FULL_SCALE_COUNTS, ReadOptions};
use crate::truth::sample::{SAMPLES, THREE_LAMPS};
use crate::view::{ElsewhereKind, Origin, Theme};
use egui::{Button, RadioButton, Ui};

/// Shows the menu bar and the status line.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, dock: &mut Dock, dialogs: &mut Dialogs, help: &mut bool) {
    egui::MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file(ui, cx, dialogs));
        ui.menu_button("Edit", |ui| edit(ui, cx));
        ui.menu_button("View", |ui| view(ui, cx, dock));
        ui.menu_button("Analyze", |ui| analyze(ui, cx, dialogs));
        ui.menu_button("Decisions", |ui| decisions(ui, cx));
        ui.menu_button("Help", |ui| {
            if item(ui, "All commands\u{2026}", Action::Palette, true) {
                cx.act(Action::Palette);
            }
            if item(ui, "Keyboard and pointer", Action::Help, true) {
                *help = true;
            }
            ui.separator();
            ui.label(format!("Dichroscope {}", env!("CARGO_PKG_VERSION")));
            ui.hyperlink_to("Klinker, Shafer & Kanade 1990", "https://doi.org/10.1007/BF00126399");
        });
        status::show(ui, cx);
    });
}

/// Shows a row of a menu with the keys of its action. Returns whether the row was chosen.
fn item(ui: &mut Ui, text: &str, action: Action, enabled: bool) -> bool {
    let keys = keys_of(ui.ctx(), action);
    ui.add_enabled(enabled, Button::new(text).shortcut_text(keys)).clicked()
}

/// The menu of files, exports and workspaces.
fn file(ui: &mut Ui, cx: &mut PanelContext, dialogs: &mut Dialogs) {
    if item(ui, "Open\u{2026}", Action::Open, true) {
        dialogs.open(Dialog::Open);
    }
    ui.menu_button("Open recent", |ui| {
        for (path, name) in cx.state.recent.iter().zip(unique_names(&cx.state.recent)) {
            if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                cx.send(JobCommand::Open(Origin::File(path.clone())));
            }
        }
        ui.separator();
        if ui.add_enabled(!cx.state.recent.is_empty(), Button::new("Forget these")).clicked() {
            cx.send(ViewCommand::ForgetRecent);
        }
    });
    open_photographs(ui, cx);
    ui.menu_button("Sample scenes", |ui| {
        for sample in &SAMPLES {
            if ui.button(sample.name).on_hover_text(sample.about).clicked() {
                cx.send(JobCommand::Open(Origin::Sample(sample.name.to_owned())));
            }
        }
        ui.separator();
        if ui.button(THREE_LAMPS.name).on_hover_text(THREE_LAMPS.about).clicked() {
            cx.send(JobCommand::open_samples(&THREE_LAMPS));
        }
    });
    ui.menu_button("Read as", |ui| read_as(ui, cx));
    elsewhere(ui, cx, dialogs);
    ui.separator();
    if ui.button("Open workspace\u{2026}").clicked() {
        dialogs.open(Dialog::OpenWorkspace);
    }
    let open = cx.state.picture.is_some();
    // Without a file, saving asks for one.
    let save = if cx.state.workspace_path.is_some() { "Save workspace" } else { "Save workspace\u{2026}" };
    if item(ui, save, Action::Save, open) {
        perform::carry_out(Action::Save, cx, dialogs, &mut false);
    }
    if ui.add_enabled(open, Button::new("Save workspace as\u{2026}")).clicked() {
        dialogs.open(Dialog::SaveWorkspace);
    }
    if item(ui, "Export\u{2026}", Action::Export, cx.state.shown().is_some()) {
        dialogs.open(Dialog::Export);
    }
    ui.separator();
    if item(ui, "Quit", Action::Quit, true) {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
    }
}

/// The rows that open and close pictures that another program made of the photograph.
fn elsewhere(ui: &mut Ui, cx: &mut PanelContext, dialogs: &mut Dialogs) {
    ui.separator();
    for kind in ElsewhereKind::ALL {
        let open = Button::new(format!("Open {} of another program\u{2026}", kind.name()));
        let open = ui.add_enabled(cx.state.picture.is_some(), open);
        let tip = "Holds it against the result: layers, scores and values under the pointer (section 7).";
        if open.on_hover_text(tip).clicked() {
            dialogs.open(Dialog::OpenElsewhere(kind));
        }
        let paths = cx.state.elsewhere.as_ref().map(|all| all.paths.clone()).unwrap_or_default();
        let Some(path) = paths.get(kind) else { continue };
        let close = ui.button(format!("Close {} {}", kind.name(), file_name(path)));
        if close.on_hover_text(path.display().to_string()).clicked() {
            cx.send(ViewCommand::CloseElsewhere(kind));
        }
    }
}

/// The name of a file without its folder.
fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The submenu of the photographs that are open.
fn open_photographs(ui: &mut Ui, cx: &mut PanelContext) {
    let Some(picture) = cx.state.picture.clone() else { return };
    ui.menu_button("Open photographs", |ui| {
        let _ = ui.selectable_label(true, picture.origin.name());
        for (index, other) in cx.state.others.iter().enumerate() {
            if ui.selectable_label(false, other.picture.origin.name()).clicked() {
                cx.commands.push(JobCommand::Switch(Switching::To(index)).into());
            }
        }
        ui.separator();
        let several = !cx.state.others.is_empty();
        for (text, switching) in
            [("Next photograph", Switching::Next), ("Photograph before", Switching::Previous)]
        {
            if item(ui, text, Action::Switch(switching), several) {
                cx.send(JobCommand::Switch(switching));
            }
        }
        let text =
            if cx.state.compares_photographs { "No longer compare" } else { "Compare with the next beside" };
        if item(ui, text, Action::ComparePhotographs, several) {
            cx.send(ViewCommand::ComparePhotographs(!cx.state.compares_photographs));
        }
        if item(ui, "Close this photograph", Action::ClosePhotograph, several) {
            cx.send(JobCommand::ClosePhotograph);
        }
    });
}

/// The menu of the encodings, for files that declare no encoding or a wrong one.
fn read_as(ui: &mut Ui, cx: &mut PanelContext) {
    let now = cx.state.picture.as_ref().map_or_else(ReadOptions::default, |picture| picture.reading);
    for (choice, name, tip) in [
        (
            EncodingChoice::Auto,
            "as the file says",
            "sRGB for integers and linear for floats that say nothing.",
        ),
        (EncodingChoice::Linear, "linear light", "The values are proportional to light."),
        (EncodingChoice::Srgb, "sRGB", "The values carry sRGB's tone curve."),
        (EncodingChoice::Gamma(2.2), "gamma 2.2", "linear = value ^ 2.2"),
    ] {
        let radio =
            ui.add_enabled(cx.state.picture.is_some(), RadioButton::new(now.encoding == choice, name));
        if radio.on_hover_text(tip).clicked() {
            cx.send(JobCommand::ReadAs(ReadOptions { encoding: choice, ..now }));
        }
    }
    ui.separator();
    ui.horizontal(|ui| {
        let tip = "Counts that an integer's maximum or a float's 1.0 stands for; 255 unless the file has head-room.";
        ui.label("full scale").on_hover_text(tip);
        let mut counts = now.full_scale.unwrap_or(FULL_SCALE_COUNTS);
        // The value is typed and not dragged, because each value reads the file again.
        let field = egui::DragValue::new(&mut counts).range(1.0..=1e6).speed(0.0).update_while_editing(false);
        let field = ui.add(field.max_decimals(3).suffix(" counts")).on_hover_text(tip);
        field.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, "full scale")
        });
        if field.changed() {
            cx.send(JobCommand::ReadAs(ReadOptions { full_scale: Some(counts), ..now }));
        }
    });
}

/// The menu of undo, selection and area.
fn edit(ui: &mut Ui, cx: &mut PanelContext) {
    let state = cx.state;
    let marked = state.document.selection.marked.as_ref();
    if item(ui, "Undo", Action::Undo, state.history.can_undo()) {
        cx.send(Edit::Undo);
    }
    if item(ui, "Redo", Action::Redo, state.history.can_redo()) {
        cx.send(Edit::Redo);
    }
    ui.separator();
    if item(ui, "Invert marked", Action::Invert, state.picture.is_some()) {
        cx.send(Edit::InvertMarked);
    }
    let can_keep = marked.is_some() && state.document.selection.named.active.is_none();
    if item(ui, "Keep as a named mark", Action::KeepMark, can_keep) {
        cx.send(Edit::NamedMark(NamedMarkEdit::Keep));
    }
    if item(ui, "Select nothing", Action::Escape, !state.document.selection.is_empty()) {
        cx.send(Edit::ClearSelection);
    }
    ui.separator();
    let restrict = ui.add_enabled(marked.is_some(), Button::new("Analyze only the marked pixels"));
    if restrict.on_hover_text("Pixels outside are left out of every stage and stay as they are.").clicked() {
        cx.send(Edit::RestrictTo(marked.cloned()));
    }
    if item(ui, "Fit skewed T to the marked", Action::FitSkewedT, marked.is_some()) {
        cx.act(Action::FitSkewedT);
    }
    if ui.add_enabled(state.document.area.is_some(), Button::new("Analyze the whole picture")).clicked() {
        cx.send(Edit::RestrictTo(None));
    }
}

/// The menu of panels and themes.
fn view(ui: &mut Ui, cx: &mut PanelContext, dock: &mut Dock) {
    for pane in Pane::ALL {
        let mut visible = dock.is_visible(pane);
        if ui.checkbox(&mut visible, pane.title()).changed() {
            dock.set_visible(pane, visible);
        }
    }
    if ui.button("Arrange as at first").clicked() {
        dock.reset();
    }
    ui.separator();
    for (theme, name) in [(Theme::Dark, "Dark"), (Theme::Light, "Light")] {
        if ui.radio(cx.state.view.theme == theme, name).clicked() {
            cx.send(ViewCommand::Theme(theme));
        }
    }
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
        if item(ui, text, Action::Debug(action), enabled) {
            move_cursor(action, cx);
        }
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
    row(ui, "Next change of what is selected", DebugAction::Change(Forward), goal);
    row(ui, "Change before, of what is selected", DebugAction::Change(Back), goal);
}

/// The menu of methods, presets, parameter files and pinning.
fn analyze(ui: &mut Ui, cx: &mut PanelContext, dialogs: &mut Dialogs) {
    let method = cx.state.document.params.method;
    for choice in Method::ALL {
        let name = match choice {
            Method::Refined => "Refined method",
            Method::Paper => "Paper's method",
            Method::Phoenix => "Phoenix",
            Method::TopDown => "Top-down clusters",
            Method::ByHand => "Skewed T by hand",
        };
        if ui.radio(method == choice, name).on_hover_text(choice.meaning()).clicked() {
            cx.send(Edit::SetMethod(choice));
        }
    }
    ui.menu_button("Presets of table 6", |ui| {
        for preset in Preset::ALL {
            let tip = "The paper's method with the numbers of this column of table 6 (section 7.3).";
            if ui.button(preset.title()).on_hover_text(tip).clicked() {
                cx.send(Edit::SetParams(Box::new(preset.params())));
            }
        }
    });
    if ui.button("Load parameters\u{2026}").clicked() {
        dialogs.open(Dialog::LoadParameters);
    }
    if ui.button("Save parameters\u{2026}").clicked() {
        dialogs.open(Dialog::SaveParameters);
    }
    ui.separator();
    let pinned = cx.state.pinned.is_some();
    let text = if pinned { "Let the pinned result go" } else { "Pin this result to compare with" };
    if item(ui, text, Action::Pin, cx.state.newest.is_some()) {
        cx.send(ViewCommand::Pin(!pinned));
    }
    if item(ui, "Show the other of the two", Action::Swap, pinned) {
        cx.send(ViewCommand::ShowPinned(!cx.state.view.show_pinned));
    }
    ui.separator();
    let copy = ui.add_enabled(cx.state.picture.is_some(), Button::new("Copy as command line"));
    if copy.on_hover_text("The `dichroscope analyze` call that reproduces what is on the screen.").clicked() {
        ui.ctx().copy_text(analyze_call(cx.state));
        let text = "the command line is in the clipboard".to_owned();
        cx.send(ViewCommand::Notify(Severity::Done, text));
    }
}
