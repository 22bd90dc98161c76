//! What a move of the cursor was to find and did not, as a sentence: no key of the debugger is without an answer.

use super::{Breakpoint, Direction, Goal};

/// What the last move of the cursor did not find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missed {
    /// A place beyond the end of the trace at which the cursor stands: the cursor stays.
    Beyond(Direction),
    /// The edge of a hypothesis: the cursor goes to the edge of the stage.
    Hypothesis(Direction),
    /// A hypothesis to enter: the cursor stays.
    Into,
    /// A breakpoint, where none is set: the cursor stays.
    Breakpoints,
    /// A breakpoint that is enabled, where all are disabled: the cursor stays.
    EnabledBreakpoints,
    /// A step that fits a goal, or a breakpoint that stops: the cursor goes to the end of the trace in that direction.
    Goal(Goal, Direction),
}

impl Missed {
    /// Why no breakpoint can stop the cursor; none where one can.
    pub(super) fn of_breakpoints(breakpoints: &[Breakpoint]) -> Option<Self> {
        match breakpoints {
            [] => Some(Self::Breakpoints),
            all if all.iter().all(|breakpoint| !breakpoint.enabled) => Some(Self::EnabledBreakpoints),
            _ => None,
        }
    }

    /// What was not found, and where the cursor is therefore.
    pub fn text(self) -> String {
        match self {
            Self::Beyond(Direction::Forward) => "nothing follows the result".to_owned(),
            Self::Beyond(Direction::Back) => "nothing comes before the beginning".to_owned(),
            Self::Hypothesis(Direction::Forward) => {
                "no hypothesis follows: at the end of the stage".to_owned()
            }
            Self::Hypothesis(Direction::Back) => {
                "no hypothesis comes before: at the beginning of the stage".to_owned()
            }
            Self::Into => "no hypothesis follows: the cursor stays".to_owned(),
            Self::Breakpoints => "no breakpoint is set: add one in Breakpoints".to_owned(),
            Self::EnabledBreakpoints => "every breakpoint is off: switch one on in Breakpoints".to_owned(),
            Self::Goal(goal, direction) => goal_text(goal, direction),
        }
    }
}

/// That no step fits a goal.
fn goal_text(goal: Goal, direction: Direction) -> String {
    let (follows, place) = match direction {
        Direction::Forward => ("follows", "at the result"),
        Direction::Back => ("comes before", "at the beginning"),
    };
    let what = match goal {
        Goal::Kind(kind) => format!("step \u{201c}{}\u{201d}", kind.name()),
        Goal::Pixel(_) => "change of the selected pixel".to_owned(),
        Goal::Hypothesis(_) => "change of the selected region".to_owned(),
        Goal::Breakpoint => "stop at a breakpoint".to_owned(),
        Goal::StepCount(_) => "such step".to_owned(),
    };
    format!("no {what} {follows}: {place}")
}
