//! The debugger's keys, and the widgets that take these keys before the debugger does.

use super::shortcut::Shortcut;
use crate::app::{Direction, State, StepUnit};
use crate::gui::action::{Action, DebugAction};
use crate::gui::work_shown::is_cancelable_work_shown;
use crate::view::Tool;
use Direction::{Back, Forward};
use egui::{Context, Event, Id, Key, Modifiers, Rect};

/// A key of the group "Decisions".
const fn key(modifiers: Modifiers, key: Key, action: DebugAction, description: &'static str) -> Shortcut {
    Shortcut::new("Decisions", modifiers, key, Action::Debug(action), description)
}

/// The debugger's keys.
pub const KEYS: &[Shortcut] = &[
    key(Modifiers::SHIFT, Key::Space, DebugAction::Play(Back), "Play backwards, or rest"),
    key(Modifiers::NONE, Key::Space, DebugAction::Play(Forward), "Play, or rest"),
    key(Modifiers::COMMAND, Key::ArrowLeft, DebugAction::Step(StepUnit::Stage, Back), "A stage back"),
    key(Modifiers::COMMAND, Key::ArrowRight, DebugAction::Step(StepUnit::Stage, Forward), "A stage forward"),
    key(Modifiers::SHIFT, Key::ArrowLeft, DebugAction::Step(StepUnit::Hypothesis, Back), "A hypothesis back"),
    key(
        Modifiers::SHIFT,
        Key::ArrowRight,
        DebugAction::Step(StepUnit::Hypothesis, Forward),
        "A hypothesis forward",
    ),
    key(Modifiers::NONE, Key::Comma, DebugAction::Step(StepUnit::Step, Back), "A claim back"),
    key(Modifiers::NONE, Key::Period, DebugAction::Step(StepUnit::Step, Forward), "A claim forward"),
    key(Modifiers::ALT, Key::ArrowLeft, DebugAction::Step(StepUnit::Step, Back), "A claim back"),
    key(Modifiers::ALT, Key::ArrowRight, DebugAction::Step(StepUnit::Step, Forward), "A claim forward"),
    key(Modifiers::NONE, Key::ArrowLeft, DebugAction::Step(StepUnit::Event, Back), "An event back"),
    key(Modifiers::NONE, Key::ArrowRight, DebugAction::Step(StepUnit::Event, Forward), "An event forward"),
    key(Modifiers::NONE, Key::Enter, DebugAction::Into, "Into the next hypothesis"),
    key(Modifiers::NONE, Key::Home, DebugAction::Start, "To the beginning"),
    key(Modifiers::NONE, Key::End, DebugAction::End, "To the result"),
    key(Modifiers::SHIFT, Key::N, DebugAction::Breakpoint(Back), "The breakpoint before"),
    key(Modifiers::NONE, Key::N, DebugAction::Breakpoint(Forward), "The next breakpoint"),
    key(
        Modifiers::NONE,
        Key::F9,
        DebugAction::ToggleBreakpoint,
        "A breakpoint for what is selected, or no longer",
    ),
    key(Modifiers::SHIFT, Key::J, DebugAction::Change(Back), "The change before, of what is selected"),
    key(Modifiers::NONE, Key::J, DebugAction::Change(Forward), "The next change of what is selected"),
    key(Modifiers::NONE, Key::D, DebugAction::Record, "Record decisions, or do not"),
];

/// Height of the lowest view, points; sliders and fields are lower.
const LOWEST_VIEW_PT: f32 = 40.0;

/// Widgets and views that take keys before the debugger does.
#[derive(Clone, Copy, Debug)]
pub struct KeyListeners {
    /// The rectangle of the color space, which has keys of its own; none if the color space is not shown.
    pub color_space_rect: Option<Rect>,
    /// The id of the timeline's track. While the track has the focus, the debugger's keys still work.
    pub track: Id,
    /// Whether a photograph is open, whose decisions are or can be recorded.
    pub has_photograph: bool,
    /// Whether Enter closes an outline.
    pub draws_polygon: bool,
    /// Whether Escape cancels the analysis or the recording, which is told to be under way.
    pub cancels_analysis: bool,
}

impl KeyListeners {
    /// The listeners of a state, the color space being shown at `color_space_rect`.
    pub fn of(state: &State, color_space_rect: Option<Rect>, track: Id) -> Self {
        let draws_polygon = [state.view.image.tool, state.view.cube.tool].contains(&Tool::Polygon);
        let cancels_analysis = is_cancelable_work_shown(&state.jobs);
        let has_photograph = state.picture.is_some();
        Self { color_space_rect, track, has_photograph, draws_polygon, cancels_analysis }
    }

    /// Whether no listener takes the key of a shortcut, so that the shortcut's action is done.
    pub fn allows(&self, ctx: &Context, shortcut: &Shortcut) -> bool {
        match shortcut.action {
            Action::Debug(_) | Action::View(_) => {}
            Action::CancelAnalysis => return self.cancels_analysis,
            Action::Escape => return !self.cancels_analysis,
            _ => return true,
        }
        let focused = ctx.memory(egui::Memory::focused).filter(|&id| id != self.track);
        let focused_widget = focused.and_then(|id| ctx.read_response(id));
        // A large widget that senses clicks and drags is a view: the image or the color space. A key does not press a view as it
        // presses a button, and changes no value as it does on a slider.
        let on_view = focused_widget.as_ref().is_none_or(|widget| {
            widget.sense.senses_click() && widget.sense.senses_drag() && widget.rect.height() > LOWEST_VIEW_PT
        });
        let focused_center = focused_widget.map(|widget| widget.rect.center());
        let places = [ctx.pointer_hover_pos(), focused_center];
        let in_color_space =
            places.iter().flatten().any(|&at| self.color_space_rect.is_some_and(|rect| rect.contains(at)));
        let Action::Debug(action) = shortcut.action else {
            // The color space is zoomed by the same keys.
            return !in_color_space || !shortcut.keys.modifiers.is_none();
        };
        let turns_color_space =
            self.color_space_rect.zip(focused_center).is_some_and(|(rect, at)| rect.contains(at));
        let is_free = match shortcut.keys.logical_key {
            // A view without a use of its own for the arrow keys leaves them to the debugger.
            Key::ArrowLeft | Key::ArrowRight if shortcut.keys.modifiers.is_none() => {
                on_view && !turns_color_space
            }
            Key::ArrowLeft | Key::ArrowRight | Key::Space | Key::End => on_view,
            Key::Enter => on_view && !self.draws_polygon,
            Key::Home | Key::D => on_view && !in_color_space,
            _ => true,
        };
        is_free && (self.has_photograph || action == DebugAction::Record)
    }
}

/// Distinguishes a tap of Space, which plays, from Space held while the pointer drags, which pans a view.
#[derive(Default)]
pub struct SpaceTap {
    /// The direction to play in when Space is released; none once the pointer is pressed, and while Space is up.
    direction: Option<Direction>,
}

impl SpaceTap {
    /// The direction to play in, when Space was tapped. `space_plays`: whether a press of Space in this frame
    /// belongs to the debugger.
    pub fn released(&mut self, ctx: &Context, space_plays: bool) -> Option<Direction> {
        let mut released = None;
        ctx.input_mut(|input| {
            let down = input.pointer.any_down();
            input.events.retain(|event| match event {
                Event::Key { key: Key::Space, pressed: true, repeat, modifiers, .. } => {
                    if space_plays && !repeat && !down && !modifiers.command && !modifiers.alt {
                        self.direction = Some(if modifiers.shift { Back } else { Forward });
                    }
                    !space_plays
                }
                Event::Key { key: Key::Space, pressed: false, .. } => {
                    released = self.direction.take().or(released);
                    true
                }
                Event::PointerButton { pressed: true, .. } => {
                    self.direction = None;
                    true
                }
                _ => true,
            });
        });
        released
    }
}
