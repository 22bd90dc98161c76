//! The answers of the debugger, as notices where the timeline, which tells them, is hidden, behind another tab or too small.

use crate::app::{Application, Command, DebugCommand, Severity, State, ViewCommand};

/// Applies a command. What the debugger answers to the command becomes a notice, unless the timeline tells it (`is_told`).
pub fn apply_answered(application: &mut Application, command: Command, is_told: bool) {
    let Command::Debug(debug_command) = &command else { return application.apply(command) };
    let (asked, before) = (Asked::of(debug_command), Before::of(application.state()));
    application.apply(command);
    let answer = asked.filter(|_| !is_told).and_then(|asked| asked.answer(before, application.state()));
    if let Some(text) = answer {
        application.apply(ViewCommand::Notify(Severity::Answer, text));
    }
}

/// What a command of the debugger may be answered by.
#[derive(Clone, Copy)]
enum Asked {
    /// What the move did not find, or the breakpoint that stopped the cursor.
    Move,
    /// The breakpoint that ended playing.
    Tick,
    /// Whether decisions are recorded from now on.
    Settings,
}

/// The state of the debugger before a command.
#[derive(Clone, Copy)]
struct Before {
    is_playing: bool,
    is_recording: bool,
}

impl Before {
    fn of(state: &State) -> Self {
        Self { is_playing: state.debugger.playing.is_some(), is_recording: state.view.debug.open }
    }
}

impl Asked {
    /// What is asked by a command; none by a command that other panels answer.
    const fn of(command: &DebugCommand) -> Option<Self> {
        match command {
            DebugCommand::Settings(_) => Some(Self::Settings),
            DebugCommand::Tick(_) => Some(Self::Tick),
            DebugCommand::Seek(_)
            | DebugCommand::Step(..)
            | DebugCommand::Into
            | DebugCommand::RunTo(..)
            | DebugCommand::Play(_) => Some(Self::Move),
            DebugCommand::Choose(_) | DebugCommand::Compare => None,
        }
    }

    /// The answer in the state after the command; none where the views show what the command did.
    fn answer(self, before: Before, state: &State) -> Option<String> {
        let debugger = &state.debugger;
        let stopped_by = || debugger.stopped_by.map(|index| format!("stopped by breakpoint {}", index + 1));
        match self {
            Self::Move => debugger.missed.map(crate::app::Missed::text).or_else(stopped_by),
            Self::Tick => stopped_by().filter(|_| before.is_playing && debugger.playing.is_none()),
            Self::Settings => match (before.is_recording, state.view.debug.open) {
                (true, false) => Some("decisions are recorded no more: D records them".to_owned()),
                (false, true) => Some("decisions are recorded".to_owned()),
                _ => None,
            },
        }
    }
}
