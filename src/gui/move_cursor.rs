//! Actions on the debugger, as commands.

use super::PanelContext;
use super::action::DebugAction;
use crate::app::Direction::Forward;
use crate::app::{DebugCommand, DebugSettings, Goal, Severity, State, ViewCommand};
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
