//! Actions on the debugger, as commands.

use super::PanelContext;
use super::action::DebugAction;
use crate::app::Direction::Forward;
use crate::app::{Breakpoint, Condition, DebugCommand, DebugSettings, Goal, Severity, State, ViewCommand};
use crate::view::Item;

/// Sends the command of an action on the debugger.
pub fn move_cursor(action: DebugAction, cx: &mut PanelContext) {
    let state = cx.state;
    let is_setting = matches!(action, DebugAction::Loop | DebugAction::Record);
    if let Some(reason) = why_no_trace(state).filter(|_| !is_setting) {
        return cx.send(ViewCommand::Notify(Severity::Answer, reason.to_owned()));
    }
    let command = match action {
        DebugAction::Play(direction) => {
            let stops =
                state.debugger.playing.is_some_and(|playing| playing == direction || direction == Forward);
            DebugCommand::Play((!stops).then_some(direction))
        }
        DebugAction::Step(unit, direction) => DebugCommand::Step(unit, direction),
        DebugAction::Start => DebugCommand::Seek(0),
        DebugAction::End => DebugCommand::Seek(usize::MAX),
        DebugAction::Into => DebugCommand::Into,
        DebugAction::Breakpoint(direction) => DebugCommand::RunTo(Goal::Breakpoint, direction),
        DebugAction::ToggleBreakpoint => {
            let Some(condition) = selected_condition(state) else {
                let text = "a breakpoint for what: select a region, or with Alt + click a pixel";
                return cx.send(ViewCommand::Notify(Severity::Answer, text.to_owned()));
            };
            let (breakpoints, text) = toggled(&state.view.debug.breakpoints, condition, state);
            cx.send(ViewCommand::Notify(Severity::Answer, text));
            DebugCommand::Settings(DebugSettings { breakpoints, ..state.view.debug.clone() })
        }
        DebugAction::Change(direction) => {
            let Some(goal) = selected_goal(state) else {
                return cx.send(ViewCommand::Notify(Severity::Warning, why_no_goal(state)));
            };
            DebugCommand::RunTo(goal, direction)
        }
        DebugAction::Next(kind) => DebugCommand::RunTo(Goal::Kind(kind), Forward),
        DebugAction::Loop => {
            let looped = !state.view.debug.looped;
            DebugCommand::Settings(DebugSettings { looped, ..state.view.debug.clone() })
        }
        DebugAction::Record => {
            let open = !state.view.debug.open;
            DebugCommand::Settings(DebugSettings { open, ..state.view.debug.clone() })
        }
    };
    cx.send(command);
}

/// Why there is no cursor to move; none where there is one.
fn why_no_trace(state: &State) -> Option<&'static str> {
    match (&state.debugger.replay, &state.picture) {
        (Some(_), _) => None,
        (None, None) => Some("open a photograph first"),
        (None, Some(_)) if !state.view.debug.open => Some("no decisions are recorded: D records them"),
        (None, Some(_)) if state.lacks_trace() => Some("no decisions are recorded: F5 analyzes now"),
        (None, Some(_)) => Some("the decisions are being recorded"),
    }
}

/// Why there is nothing to run to.
fn why_no_goal(state: &State) -> String {
    let is_of_second_look = |region| {
        let trace = state.debugger.trace();
        trace.is_some_and(|trace| trace.second_look_region(region).is_some())
    };
    match state.selected_region() {
        Some(region) if is_of_second_look(region) => format!(
            "region {region} was found by the second look, in a finer picture: its steps are not on the timeline, the inspector lists them"
        ),
        Some(region) => format!("there is no step about region {region} on the timeline"),
        None => "changes of what: select a region, or with Alt + click a pixel".to_owned(),
    }
}

/// Number of pixels beyond which a region that a key chose stops the cursor.
const MOST_PIXELS: u32 = 1000;

/// The condition of a breakpoint for what is selected: a pixel that was clicked changes its owner, or a region outgrows a size.
fn selected_condition(state: &State) -> Option<Condition> {
    match selected_goal(state)? {
        Goal::Pixel(pixel) => Some(Condition::PixelChangesOwner(pixel)),
        Goal::Hypothesis(hypothesis) => {
            Some(Condition::RegionExceeds { hypothesis: Some(hypothesis), pixels: MOST_PIXELS })
        }
        Goal::Breakpoint | Goal::Kind(_) | Goal::StepCount(_) => None,
    }
}

/// The breakpoints with one more of this condition, or without that of this condition, and the sentence that says so.
fn toggled(breakpoints: &[Breakpoint], condition: Condition, state: &State) -> (Vec<Breakpoint>, String) {
    let mut all = breakpoints.to_vec();
    let what = match condition {
        Condition::PixelChangesOwner(pixel) => {
            let [x, y] = pixel.position(state.picture.as_ref().map_or(1, |picture| picture.size().0));
            format!("where pixel {x}, {y} changes its owner")
        }
        _ => format!("where the region exceeds {} pixels", crate::describe::grouped(MOST_PIXELS)),
    };
    let is_known = |breakpoint: &Breakpoint| breakpoint.condition == condition;
    if let Some(index) = all.iter().position(is_known) {
        all.remove(index);
        return (all, format!("the breakpoint {what} was taken away"));
    }
    all.push(Breakpoint { enabled: true, condition });
    let number = all.len();
    (all, format!("breakpoint {number} stops {what}: N runs to the next, Shift+N to the one before"))
}

/// The selected item, as a goal to run to.
pub fn selected_goal(state: &State) -> Option<Goal> {
    let names = &state.debugger.names;
    if let Some(pixel) = state.explained_pixel() {
        return Some(Goal::Pixel(pixel));
    }
    match state.document.selection.item {
        Some(Item::Region(region)) => names.hypotheses_of(region).next().map(Goal::Hypothesis),
        _ => state.debugger.chosen.map(Goal::Hypothesis),
    }
}
