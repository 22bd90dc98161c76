//! The reducer of the debugger's commands, and of the trace of a new result.

use crate::analysis::Stage;
use crate::app::{DebugCommand, DebugSettings, Debugger, Difference, Effect, Job, State};
use crate::trace::Replay;
use crate::view::RegionNames;
use std::sync::Arc;

/// Applies a command to the debugger. All commands but the settings need a cursor, which exists once a trace has been recorded.
pub(super) fn reduce(state: &mut State, command: DebugCommand) -> Vec<Effect> {
    if state.debugger.replay.is_none() && !matches!(command, DebugCommand::Settings(_)) {
        return Vec::new();
    }
    let State { debugger, view, .. } = state;
    match command {
        DebugCommand::Settings(settings) => return change_settings(state, settings),
        DebugCommand::Seek(n) => debugger.stop_and_seek(n),
        DebugCommand::Step(unit, direction) => debugger.step(unit, direction),
        DebugCommand::Into => debugger.enter_block(),
        DebugCommand::RunTo(goal, direction) => debugger.run_to(goal, direction, &view.debug.breakpoints),
        DebugCommand::Play(direction) => debugger.play(direction),
        DebugCommand::Tick(seconds) => debugger.tick(seconds, &view.debug),
        DebugCommand::Choose(hypothesis) => debugger.chosen = hypothesis,
        DebugCommand::Compare => compare_with_pinned(state),
    }
    Vec::new()
}

/// Sets the settings; the decisions are recorded when the debugger opens, and are forgotten when the debugger closes.
fn change_settings(state: &mut State, settings: DebugSettings) -> Vec<Effect> {
    let opened = settings.open && !state.view.debug.open;
    let mut effects = if opened { vec![Effect::Trace] } else { Vec::new() };
    if !settings.open {
        effects.extend(state.give_up_recording());
        state.debugger = Debugger::default();
    }
    state.view.debug = settings;
    effects
}

/// Takes the progress of the recording of the newest result. What a canceled recording has still to say is not heard.
pub(super) fn take_progress(state: &mut State, generation: u64, stage: Stage) {
    let is_of_newest = generation == state.generation
        && state.jobs.analysis.is_none()
        && state.newest.as_ref().is_some_and(|newest| newest.generation == generation);
    if is_of_newest {
        let job = state.jobs.recording.unwrap_or_else(Job::now);
        state.jobs.recording = Some(Job { stage: Some(stage), ..job });
    }
}

/// Takes the trace of a new result, and moves the cursor to the place that corresponds to its old one.
pub(super) fn take_trace(state: &mut State, generation: u64, mut replay: Replay) {
    if generation == state.generation {
        state.jobs.recording = None;
    }
    let newest = state.newest.as_ref().filter(|shown| shown.generation == generation);
    let Some(newest) = newest.filter(|_| state.view.debug.open) else { return };
    let names = RegionNames::new(&replay, &newest.region_colors);
    let before = &state.debugger;
    let finals = Arc::clone(&newest.analysis.finals);
    if let Some(place) = before.corresponding_place(replay.trace(), &names, &finals) {
        replay.seek(place);
    }
    state.debugger = Debugger {
        replay: Some(replay),
        names: Arc::new(names),
        generation,
        finals: Some(finals),
        playing: before.playing,
        ..Debugger::default()
    };
}

/// Finds the first difference from the pinned result's trace, and moves there.
fn compare_with_pinned(state: &mut State) {
    let Some(trace) = state.debugger.trace().cloned() else { return };
    let pinned = state.pinned.as_ref().and_then(|pinned| pinned.trace());
    let difference = match pinned.map(|pinned| pinned.first_difference(&trace)) {
        None => Difference::NotRecorded,
        Some(None) => Difference::None,
        Some(Some(n)) => Difference::At(n),
    };
    if let Difference::At(n) = difference {
        state.debugger.stop_and_seek(n + 1);
    }
    state.debugger.difference = Some(difference);
}
