//! The row above the track: playback controls, rate, the cursor's position, and a sentence about the last step.

use super::icons::{self, PlaybackIcon};
use super::run_to;
use crate::app::{Command, DebugCommand, DebugSettings, Direction, Missed, StepUnit};
use crate::describe::Names;
use crate::describe::grouped;
use crate::gui::PanelContext;
use crate::gui::action::{Action, DebugAction};
use crate::gui::glossary::Term;
use crate::gui::move_cursor::move_cursor;
use crate::gui::shortcuts::keys_of;
use crate::gui::theme::{BODY_PT, SMALL_PT, heading_font};
use crate::gui::widgets::{capitalized, keep_unless_edited};
use crate::trace::{Replay, Step};
use crate::view::{Tone, step_verdict};
use Direction::{Back, Forward};
use egui::accesskit::Role;
use egui::{ComboBox, DragValue, Label, Rect, RichText, Slider, Ui, WidgetInfo, vec2};

/// Width that the sentence needs beside the controls, points; with less, the sentence is shown below the controls.
const SENTENCE_PT: f32 = 130.0;
/// Width of a row that has room for words beside the cursor's position, points.
const WORDS_PT: f32 = 800.0;
/// Smallest height of a panel with room for a second row above the track, points.
const TWO_ROWS_PT: f32 = 88.0;

/// Width of a panel with one row whose sentence is not cut where it answers a key, points.
const ANSWERS_PT: f32 = 1100.0;

/// Whether a timeline panel has room for what the debugger answers to a key.
pub fn has_room_for_answers(panel: Rect) -> bool {
    panel.width() >= ANSWERS_PT || panel.height() - 8.0 >= TWO_ROWS_PT
}

/// A button: icon, accessible name, action and tooltip.
type Control = (PlaybackIcon, &'static str, DebugAction, &'static str);

const LEFT: [Control; 4] = [
    (PlaybackIcon::Limit(Back), "To the beginning", DebugAction::Start, "Before the first decision"),
    (
        PlaybackIcon::Stage(Back),
        "Stage back",
        DebugAction::Step(StepUnit::Stage, Back),
        "Back to where a stage begins (5.2 to 6)",
    ),
    (
        PlaybackIcon::Hypothesis(Back),
        "Hypothesis back",
        DebugAction::Step(StepUnit::Hypothesis, Back),
        "Back to where a hypothesis, slice or hole begins (5.3 to 5.5)",
    ),
    (
        PlaybackIcon::Event(Back),
        "Event back",
        DebugAction::Step(StepUnit::Event, Back),
        "Back by a decision that is more than a pixel's claim",
    ),
];

const RIGHT: [Control; 5] = [
    (
        PlaybackIcon::Event(Forward),
        "Event forward",
        DebugAction::Step(StepUnit::Event, Forward),
        "On by a decision that is more than a pixel's claim",
    ),
    (
        PlaybackIcon::Hypothesis(Forward),
        "Hypothesis forward",
        DebugAction::Step(StepUnit::Hypothesis, Forward),
        "On to where a hypothesis, slice or hole ends (5.3 to 5.5)",
    ),
    (
        PlaybackIcon::Stage(Forward),
        "Stage forward",
        DebugAction::Step(StepUnit::Stage, Forward),
        "On to where a stage ends (5.2 to 6)",
    ),
    (PlaybackIcon::Limit(Forward), "To the result", DebugAction::End, "After the last decision: the result"),
    (
        PlaybackIcon::Into,
        "Into the next hypothesis",
        DebugAction::Into,
        "Into the next hypothesis or slice, whose growth plays ring by ring (5.3.2)",
    ),
];

/// Shows the playback controls and the sentence about the last step. `missed`: what the last move of the cursor did not find, to be told.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, replay: &Replay, names: &Names, missed: Option<Missed>) {
    ui.spacing_mut().item_spacing = vec2(2.0, 3.0);
    ui.spacing_mut().interact_size.y = icons::SIDE_PT;
    let has_two_rows = ui.available_height() >= TWO_ROWS_PT;
    let is_narrow = !has_two_rows && ui.available_width() < WORDS_PT;
    let beside = ui
        .horizontal_wrapped(|ui| {
            controls(ui, cx, &LEFT);
            play_buttons(ui, cx);
            controls(ui, cx, &RIGHT);
            ui.add_space(4.0);
            playback_settings(ui, cx);
            run_to::show(ui, cx);
            // A wrapped row does not split the widgets of an area of known width.
            let size = vec2(step_width(replay.trace().len(), is_narrow), ui.spacing().interact_size.y);
            let layout = egui::Layout::left_to_right(egui::Align::Center);
            ui.allocate_ui_with_layout(size, layout, |ui| step_field(ui, cx, replay, is_narrow));
            let beside = !has_two_rows || ui.available_size_before_wrap().x >= SENTENCE_PT;
            // At the result the sentence tells no verdict: a rest of it would only be cut off.
            let tells = cx.state.debugger.stopped().is_some() || missed.is_some();
            let is_needed = tells || ui.available_size_before_wrap().x >= SENTENCE_PT;
            if beside && is_needed {
                sentence(ui, cx, replay, names, missed);
            }
            beside
        })
        .inner;
    if !beside {
        ui.horizontal(|ui| sentence(ui, cx, replay, names, missed));
    }
}

/// Shows buttons that move the cursor.
fn controls(ui: &mut Ui, cx: &mut PanelContext, controls: &[Control]) {
    for &(icon, name, action, tip) in controls {
        let keys = keys_of(ui.ctx(), Action::Debug(action));
        if icons::button(ui, cx.palette, icon, false, name, &format!("{tip} ({keys})")).clicked() {
            move_cursor(action, cx);
        }
    }
}

/// Shows the buttons that play and pause.
fn play_buttons(ui: &mut Ui, cx: &mut PanelContext) {
    let playing = cx.state.debugger.playing;
    ui.add_space(4.0);
    for (direction, name, tip) in [
        (Some(Back), "Play backwards", "Take the decisions back, one after the other (Shift+Space)"),
        (None, "Pause", "Stop here (Space)"),
        (Some(Forward), "Play", "Play the decisions one after the other (Space)"),
    ] {
        let icon = direction.map_or(PlaybackIcon::Pause, PlaybackIcon::Play);
        let on = direction.is_some() && playing == direction;
        if icons::button(ui, cx.palette, icon, on, name, tip).clicked() {
            cx.send(Command::Debug(DebugCommand::Play(direction)));
        }
    }
    ui.add_space(4.0);
}

/// Smallest, largest and default rate of a unit, units per second.
fn rates(unit: StepUnit) -> [f64; 3] {
    match unit {
        StepUnit::Step => [1.0, 1e6, 5e3],
        StepUnit::Event => [1.0, 1e4, 50.0],
        StepUnit::Ring => [1.0, 1e3, 30.0],
        StepUnit::Hypothesis => [0.5, 60.0, 4.0],
        StepUnit::Pass | StepUnit::Stage => [0.2, 20.0, 1.0],
    }
}

/// The plural of a unit.
fn plural(unit: StepUnit) -> &'static str {
    match unit {
        StepUnit::Step => "claims",
        StepUnit::Event => "events",
        StepUnit::Ring => "rings",
        StepUnit::Hypothesis => "hypotheses",
        StepUnit::Pass => "passes",
        StepUnit::Stage => "stages",
    }
}

/// The tooltip of a unit.
fn unit_tip(unit: StepUnit) -> &'static str {
    match unit {
        StepUnit::Step => "Each single step: a pixel's claim, a window's class.",
        StepUnit::Event => "Each decision that is more than a pixel's claim.",
        StepUnit::Ring => "Each ring of pixels around what a region has claimed (5.3.2).",
        StepUnit::Hypothesis => "Each hypothesis, slice or hole as a whole (5.3 to 5.5).",
        StepUnit::Pass => "Each part of a stage.",
        StepUnit::Stage => "Each stage (5.2 to 6).",
    }
}

/// Shows the controls of playing: step size, rate, loop, and the button that stops recording.
fn playback_settings(ui: &mut Ui, cx: &mut PanelContext) {
    let before = &cx.state.view.debug;
    let mut settings = before.clone();
    let combo = ComboBox::from_id_salt("grain").width(78.0).selected_text(plural(settings.unit));
    let combo = combo.show_ui(ui, |ui| {
        for unit in StepUnit::ALL {
            let choice = ui.selectable_label(settings.unit == unit, plural(unit));
            let is_clicked = choice.clicked();
            if unit == StepUnit::Step {
                Term::Claim.card(choice, cx.palette);
            } else {
                choice.on_hover_text(unit_tip(unit));
            }
            if is_clicked {
                (settings.unit, settings.per_second) = (unit, rates(unit)[2]);
            }
        }
    });
    combo.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Grain"));
    combo.response.on_hover_text(format!("What playing advances by. {}", unit_tip(before.unit)));
    let [least, most, _] = rates(settings.unit);
    ui.spacing_mut().slider_width = 64.0;
    let slider = Slider::new(&mut settings.per_second, least..=most).logarithmic(true).suffix(" /s");
    let mut slider = ui.add(slider.custom_formatter(|rate, _| rate_text(rate)));
    keep_unless_edited(&mut slider, before.per_second, &mut settings.per_second, rate_text);
    slider.widget_info(|| WidgetInfo::slider(true, before.per_second, "Rate"));
    slider.on_hover_text("How many of these a second while playing.");
    let tip = "Begin anew when the end is reached.";
    if icons::button(ui, cx.palette, PlaybackIcon::Loop, settings.looped, "Loop", tip).clicked() {
        settings.looped = !settings.looped;
    }
    let tip = "Decisions are recorded. Click to stop that, and to free their memory (D).";
    if icons::button(ui, cx.palette, PlaybackIcon::Record, false, "Stop recording", tip).clicked() {
        settings.open = false;
    }
    send_settings(cx, settings);
}

/// Sends changed settings of the debugger.
fn send_settings(cx: &mut PanelContext, settings: DebugSettings) {
    if settings != cx.state.view.debug {
        cx.send(Command::Debug(DebugCommand::Settings(settings)));
    }
}

/// A rate as text.
fn rate_text(rate: f64) -> String {
    if rate >= 1e3 {
        grouped(rate.round() as usize)
    } else if rate >= 10.0 {
        format!("{rate:.0}")
    } else {
        format!("{rate:.1}")
    }
}

/// Width of a field for numbers up to `len`, points.
fn number_width(len: usize) -> f32 {
    12.0 + 7.4 * grouped(len).chars().count() as f32
}

/// Width of the cursor's position with its words, points.
fn step_width(len: usize, is_narrow: bool) -> f32 {
    if is_narrow { number_width(len) + 8.0 } else { 2.0 * number_width(len) + 50.0 }
}

/// Shows the cursor's position; a typed number moves the cursor.
fn step_field(ui: &mut Ui, cx: &mut PanelContext, replay: &Replay, is_narrow: bool) {
    let secondary_text = |text: String| RichText::new(text).color(cx.palette.secondary);
    let len = replay.trace().len();
    ui.add_space(6.0);
    if !is_narrow {
        ui.label(secondary_text("step".to_owned()));
    }
    let mut at = replay.at();
    let field = DragValue::new(&mut at)
        .range(0..=len)
        .speed((len as f64 / 2000.0).max(0.1))
        .update_while_editing(false)
        .custom_formatter(|at, _| grouped(at as usize))
        .custom_parser(|text| text.replace(|c: char| c.is_whitespace(), "").parse().ok());
    let width = number_width(len);
    let field = ui.add_sized(vec2(width, ui.spacing().interact_size.y - 2.0), field);
    field.widget_info(|| WidgetInfo {
        label: Some("Step".to_owned()),
        ..WidgetInfo::drag_value(true, replay.at() as f64)
    });
    if field.changed() && at != replay.at() {
        cx.send(Command::Debug(DebugCommand::Seek(at)));
    }
    let tip = format!("Decisions taken so far, of {}. Type a number to go there.", grouped(len));
    field.on_hover_text(tip);
    if !is_narrow {
        ui.label(secondary_text(format!("/ {}", grouped(len))));
        ui.add_space(8.0);
    }
}

/// Shows the state of the cursor (playing, stopped), or what its last move did not find, and a sentence about the last step.
fn sentence(ui: &mut Ui, cx: &PanelContext, replay: &Replay, names: &Names, missed: Option<Missed>) {
    let debugger = &cx.state.debugger;
    let text = match replay.last() {
        // The last step is about some pixel of the split, and says nothing about the result.
        Some(_) if debugger.stopped().is_none() => "every decision is taken".to_owned(),
        Some(step) => names.step(&step),
        None => "nothing is decided yet".to_owned(),
    };
    // The sentence is truncated where it does not fit, as the space below belongs to the track; the verdict never is.
    let size = vec2(ui.available_size_before_wrap().x.max(1.0), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Center), |ui| {
        status(ui, cx, missed);
        ui.add_space(6.0);
        if let Some(step) = replay.last().filter(|_| debugger.stopped().is_some()) {
            verdict(ui, cx, &step);
        }
        ui.add(Label::new(&text).truncate().show_tooltip_when_elided(false)).on_hover_text(&text)
    });
}

/// Shows the state of the cursor in a word, or what its last move did not find.
fn status(ui: &mut Ui, cx: &PanelContext, missed: Option<Missed>) {
    let debugger = &cx.state.debugger;
    if let Some(missed) = missed {
        let text = capitalized(&missed.text());
        let label = Label::new(RichText::new(&text).size(SMALL_PT).color(cx.palette.warning));
        ui.add(label.truncate().show_tooltip_when_elided(false)).on_hover_text(text);
        return;
    }
    let stale = cx.state.newest.as_ref().is_some_and(|newest| newest.generation != debugger.generation);
    let (status, tone) = match (debugger.playing, debugger.stopped_by) {
        (Some(Forward), _) => ("playing".to_owned(), cx.palette.accent),
        (Some(Back), _) => ("playing back".to_owned(), cx.palette.accent),
        (None, Some(index)) => (format!("breakpoint {}", index + 1), cx.palette.accent),
        (None, None) if cx.state.lacks_trace() => ("of an earlier result".to_owned(), cx.palette.secondary),
        (None, None) if stale => ("recording\u{2026}".to_owned(), cx.palette.secondary),
        (None, None) if debugger.stopped().is_none() => ("result".to_owned(), cx.palette.secondary),
        (None, None) => ("stopped".to_owned(), cx.palette.secondary),
    };
    ui.add(Label::new(RichText::new(status).size(SMALL_PT).color(tone)).extend());
}

/// Shows the verdict of a step, which is never cut off.
fn verdict(ui: &mut Ui, cx: &PanelContext, step: &Step) -> egui::Response {
    let (word, tone) = step_verdict(step);
    let color = match tone {
        Tone::Good => cx.palette.accent,
        Tone::Bad => cx.palette.warning,
        Tone::Neutral => cx.palette.text,
    };
    let label = ui.add(Label::new(RichText::new(word).font(heading_font(BODY_PT)).color(color)).extend());
    ui.add_space(4.0);
    label.on_hover_text("The verdict of this step; the inspector has its values and limits.")
}
