//! The debugger's keys: when they are meant, and what they do.

use super::{Action, Shortcut};
use crate::app::{Command, DebugCommand, DebugSettings, Direction, Goal, Grain, Severity, State};
use crate::gui::{Cx, timeline_panel};
use crate::view::{Item, Tool};
use Direction::{Back, Forward};
use egui::{Context, Event, Key, KeyboardShortcut, Modifiers, Rect};

/// What a key does to the debugger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DebugDeed {
    /// Play this way, or rest.
    Play(Direction),
    /// Go one unit.
    Step(Grain, Direction),
    /// To before the first step.
    Start,
    /// To the result.
    End,
    /// Into the next hypothesis or slice.
    Into,
    /// To the next breakpoint, or the last one.
    Breakpoint(Direction),
    /// To the next change of what is selected, or the last one.
    Change(Direction),
    /// Record decisions, or do not.
    Record,
}

const fn key(modifiers: Modifiers, key: Key, action: DebugDeed, words: &'static str) -> Shortcut {
    let keys = KeyboardShortcut::new(modifiers, key);
    Shortcut { group: "Decisions", keys, action: Action::Debug(action), words }
}

/// All of them, those with modifiers first.
pub const KEYS: &[Shortcut] = &[
    key(Modifiers::SHIFT, Key::Space, DebugDeed::Play(Back), "Play backwards, or rest"),
    key(Modifiers::NONE, Key::Space, DebugDeed::Play(Forward), "Play, or rest"),
    key(Modifiers::COMMAND, Key::ArrowLeft, DebugDeed::Step(Grain::Stage, Back), "A stage back"),
    key(Modifiers::COMMAND, Key::ArrowRight, DebugDeed::Step(Grain::Stage, Forward), "A stage forward"),
    key(Modifiers::SHIFT, Key::ArrowLeft, DebugDeed::Step(Grain::Hypothesis, Back), "A hypothesis back"),
    key(
        Modifiers::SHIFT,
        Key::ArrowRight,
        DebugDeed::Step(Grain::Hypothesis, Forward),
        "A hypothesis forward",
    ),
    key(Modifiers::NONE, Key::Comma, DebugDeed::Step(Grain::Claim, Back), "A claim back"),
    key(Modifiers::NONE, Key::Period, DebugDeed::Step(Grain::Claim, Forward), "A claim forward"),
    key(Modifiers::ALT, Key::ArrowLeft, DebugDeed::Step(Grain::Claim, Back), "A claim back"),
    key(Modifiers::ALT, Key::ArrowRight, DebugDeed::Step(Grain::Claim, Forward), "A claim forward"),
    key(Modifiers::NONE, Key::ArrowLeft, DebugDeed::Step(Grain::Event, Back), "An event back"),
    key(Modifiers::NONE, Key::ArrowRight, DebugDeed::Step(Grain::Event, Forward), "An event forward"),
    key(Modifiers::NONE, Key::Enter, DebugDeed::Into, "Into the next hypothesis"),
    key(Modifiers::NONE, Key::Home, DebugDeed::Start, "To the beginning"),
    key(Modifiers::NONE, Key::End, DebugDeed::End, "To the result"),
    key(Modifiers::SHIFT, Key::N, DebugDeed::Breakpoint(Back), "The breakpoint before"),
    key(Modifiers::NONE, Key::N, DebugDeed::Breakpoint(Forward), "The next breakpoint"),
    key(Modifiers::SHIFT, Key::J, DebugDeed::Change(Back), "The change before, of what is selected"),
    key(Modifiers::NONE, Key::J, DebugDeed::Change(Forward), "The next change of what is selected"),
    key(Modifiers::NONE, Key::D, DebugDeed::Record, "Record decisions, or do not"),
];

/// Who else may mean a key.
#[derive(Clone, Copy, Debug)]
pub struct Listeners {
    /// Where the color space is: it has keys of its own.
    pub colors: Option<Rect>,
    /// Whether there is a trace to move in.
    pub traced: bool,
    /// Whether Enter closes an outline.
    pub outlining: bool,
}

impl Listeners {
    /// The listeners of a state, the color space being shown at `colors`.
    pub fn of(state: &State, colors: Option<Rect>) -> Self {
        let outlining = [state.view.image.tool, state.view.cube.tool].contains(&Tool::Polygon);
        Self { colors, traced: state.debugger.replay.is_some(), outlining }
    }

    /// Whether a key is the debugger's now.
    pub fn leave(&self, ctx: &Context, shortcut: &Shortcut) -> bool {
        let Action::Debug(action) = shortcut.action else { return true };
        if ctx.text_edit_focused() || egui::Popup::is_any_open(ctx) {
            return false;
        }
        let focused = ctx.memory(egui::Memory::focused).filter(|&id| id != timeline_panel::track_id());
        let holder = focused.and_then(|id| ctx.read_response(id));
        // What hears clicks and drags is a view: the image, the color space. It is not pressed by a key, as a button is.
        let on_view = holder.as_ref().is_none_or(|it| it.sense.senses_click() && it.sense.senses_drag());
        let held = holder.map(|holder| holder.rect.center());
        let spots = [ctx.pointer_hover_pos(), held];
        let in_colors = spots.iter().flatten().any(|&at| self.colors.is_some_and(|rect| rect.contains(at)));
        let free = match shortcut.keys.logical_key {
            Key::ArrowLeft | Key::ArrowRight if shortcut.keys.modifiers.is_none() => focused.is_none(),
            Key::ArrowLeft | Key::ArrowRight | Key::Space | Key::End => on_view,
            Key::Enter => on_view && !self.outlining,
            Key::Home | Key::D => on_view && !in_colors,
            _ => true,
        };
        free && (self.traced || action == DebugDeed::Record)
    }
}

/// Space: a tap plays, but held while the pointer drags it pans a view.
#[derive(Default)]
pub struct SpaceTap {
    /// Whether Space is down and nothing was dragged since; with Shift, backwards.
    held: Option<Direction>,
}

impl SpaceTap {
    /// The way to play, when Space was tapped. `ours`: whether a press that comes now is the debugger's.
    pub fn heard(&mut self, ctx: &Context, ours: bool) -> Option<Direction> {
        let mut tapped = None;
        ctx.input_mut(|input| {
            let down = input.pointer.any_down();
            input.events.retain(|event| match event {
                Event::Key { key: Key::Space, pressed: true, repeat, modifiers, .. } => {
                    if ours && !repeat && !down && !modifiers.command && !modifiers.alt {
                        self.held = Some(if modifiers.shift { Back } else { Forward });
                    }
                    !ours
                }
                Event::Key { key: Key::Space, pressed: false, .. } => {
                    tapped = self.held.take().or(tapped);
                    true
                }
                Event::PointerButton { pressed: true, .. } => {
                    self.held = None;
                    true
                }
                _ => true,
            });
        });
        tapped
    }
}

/// Does it.
pub fn move_cursor(action: DebugDeed, cx: &mut Cx) {
    let state = cx.state;
    let command = match action {
        DebugDeed::Play(direction) => {
            let rests = state.debugger.playing.is_some_and(|way| way == direction || direction == Forward);
            DebugCommand::Play((!rests).then_some(direction))
        }
        DebugDeed::Step(grain, direction) => DebugCommand::Step(grain, direction),
        DebugDeed::Start => DebugCommand::Seek(0),
        DebugDeed::End => DebugCommand::Seek(usize::MAX),
        DebugDeed::Into => DebugCommand::Into,
        DebugDeed::Breakpoint(direction) => DebugCommand::RunTo(Goal::Breakpoint, direction),
        DebugDeed::Change(direction) => {
            let Some(goal) = selected(state) else {
                let text = "changes of what: select a region, or with Alt + click a pixel".to_owned();
                return cx.send(Command::Notify(Severity::Warning, text));
            };
            DebugCommand::RunTo(goal, direction)
        }
        DebugDeed::Record => {
            let open = !state.view.debug.open;
            DebugCommand::Settings(DebugSettings { open, ..state.view.debug.clone() })
        }
    };
    cx.send(Command::Debug(command));
}

/// What is selected, as something to run to.
pub fn selected(state: &State) -> Option<Goal> {
    let names = &state.debugger.names;
    if let Some(pixel) = state.asked_pixel() {
        return Some(Goal::Pixel(pixel));
    }
    match state.document.selection.item {
        Some(Item::Region(region)) => names.births_of(region).next().map(Goal::Region),
        _ => state.debugger.chosen.map(Goal::Region),
    }
}
