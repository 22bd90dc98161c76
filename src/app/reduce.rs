//! The functions that change the state: a reducer for each kind of command, and a reducer of what workers report.

mod debugger;
mod edits;
mod elsewhere;
mod jobs;
mod named_marks;
mod photographs;
mod questions;
mod reports;
mod views;

pub(super) use reports::reduce_report;

use super::{Command, Effect, State};

/// Applies `command` to `state` and returns the work that is to be done.
pub fn reduce(state: &mut State, command: impl Into<Command>) -> Vec<Effect> {
    match command.into() {
        Command::Edit(edit) => edits::reduce(state, edit),
        Command::View(command) => {
            views::reduce(state, command);
            Vec::new()
        }
        Command::Job(command) => jobs::reduce(state, command),
        Command::Ask(question) => questions::reduce(state, question),
        Command::Debug(command) => debugger::reduce(state, command),
    }
}

#[cfg(test)]
mod cancel_tests;
#[cfg(test)]
mod elsewhere_tests;
#[cfg(test)]
mod files_tests;
#[cfg(test)]
mod selection_tests;
#[cfg(test)]
mod tests;
