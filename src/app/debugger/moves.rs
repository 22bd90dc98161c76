//! Moves of the debugger's cursor, and playing.

use super::breakpoint::next_stop;
use super::cursor::{hypothesis_edge, next_place, place_after_unit};
use super::{Breakpoint, DebugSettings, Debugger, Direction, Goal, Missed, StepUnit};
use crate::trace::Replay;
use crate::view::rings;
use std::sync::Arc;

/// Upper limit of the time of one tick, seconds, so that the cursor does not jump after the window was hidden.
const LONGEST_TICK: f64 = 0.25;

impl Debugger {
    /// Number of steps before the cursor; 0 without a trace.
    fn at(&self) -> usize {
        self.replay.as_ref().map_or(0, Replay::at)
    }

    /// Number of steps of the trace; 0 without a trace.
    fn len(&self) -> usize {
        self.replay.as_ref().map_or(0, |replay| replay.trace().len())
    }

    /// Ends playing, and forgets how the last move ended.
    fn stop_playing(&mut self) {
        (self.playing, self.play_until, self.unit_fraction) = (None, None, 0.0);
        (self.stopped_by, self.missed) = (None, None);
        self.moves = self.moves.wrapping_add(1);
    }

    /// The end of the trace that the cursor would leave by a move in a direction; none inside the trace.
    fn beyond_end(&self, direction: Direction) -> Option<Missed> {
        let is_at_end = match direction {
            Direction::Forward => self.at() >= self.len(),
            Direction::Back => self.at() == 0,
        };
        is_at_end.then_some(Missed::Beyond(direction))
    }

    /// Moves to `n` and ends playing.
    pub(in crate::app) fn stop_and_seek(&mut self, n: usize) {
        self.stop_playing();
        self.seek(n);
    }

    /// Moves the cursor to `n`.
    fn seek(&mut self, n: usize) {
        if let Some(replay) = &mut self.replay {
            replay.seek(n);
        }
    }

    /// The place one unit from `at`.
    fn place_after_unit(&mut self, at: usize, unit: StepUnit, direction: Direction) -> usize {
        if unit == StepUnit::Ring {
            return self.end_of_ring(at, direction);
        }
        self.replay.as_ref().map_or(at, |replay| place_after_unit(replay.trace(), at, unit, direction))
    }

    /// The nearest end of a ring; outside of growths, of an event.
    fn end_of_ring(&mut self, at: usize, direction: Direction) -> usize {
        let Some(replay) = &mut self.replay else { return at };
        let inside = match direction {
            Direction::Forward => Some(at),
            Direction::Back => at.checked_sub(1),
        };
        let Some(block) = inside.and_then(|n| replay.trace().block_at(n)) else {
            return place_after_unit(replay.trace(), at, StepUnit::Event, direction);
        };
        let ends = match &self.rings {
            Some((steps, ends)) if *steps == block.steps => Arc::clone(ends),
            _ => {
                let ends: Arc<[usize]> = rings(replay, &block).into();
                self.rings = Some((block.steps.clone(), Arc::clone(&ends)));
                ends
            }
        };
        match direction {
            Direction::Forward => ends.iter().copied().find(|&end| end > at).unwrap_or(block.steps.end),
            Direction::Back => ends.iter().rev().copied().find(|&end| end < at).unwrap_or(block.steps.start),
        }
    }

    /// Enters the next block, and plays it ring by ring to its end.
    pub(in crate::app) fn enter_block(&mut self) {
        self.stop_playing();
        let at = self.at();
        let next = self.trace().and_then(|trace| trace.blocks().find(|block| block.steps.start >= at));
        let Some(block) = next else {
            self.missed = Some(Missed::Into);
            return;
        };
        self.seek(block.steps.start + 1);
        (self.playing, self.play_until) = (Some(Direction::Forward), Some(block.steps.end));
    }

    /// Moves to the next step that fits `goal`; to the end of the trace in that direction where none does. Without an enabled
    /// breakpoint the cursor does not run to one.
    pub(in crate::app) fn run_to(&mut self, goal: Goal, direction: Direction, breakpoints: &[Breakpoint]) {
        self.stop_playing();
        let Some(replay) = &self.replay else { return };
        let lacks_breakpoint =
            (goal == Goal::Breakpoint).then(|| Missed::of_breakpoints(breakpoints)).flatten();
        if let Some(missed) = lacks_breakpoint.or_else(|| self.beyond_end(direction)) {
            self.missed = Some(missed);
            return;
        }
        let end = match (goal, direction) {
            (Goal::StepCount(n), _) => n.min(self.len()),
            (_, Direction::Forward) => self.len(),
            (_, Direction::Back) => 0,
        };
        let (place, stopped_by) = if matches!(goal, Goal::Breakpoint | Goal::StepCount(_)) {
            next_stop(replay, end, breakpoints).unzip()
        } else {
            (next_place(replay.trace(), replay.at(), goal, direction), None)
        };
        self.seek(place.unwrap_or(end));
        self.stopped_by = stopped_by;
        if place.is_none() && !matches!(goal, Goal::StepCount(_)) {
            self.missed = Some(Missed::Goal(goal, direction));
        }
    }

    /// Starts to play in a direction; none: stops playing.
    pub(in crate::app) fn play(&mut self, direction: Option<Direction>) {
        self.stop_playing();
        if let Some(direction) = direction {
            self.playing = Some(direction);
            self.rewind_if_over(direction);
        }
    }

    /// Moves the cursor by one unit and ends playing.
    pub(in crate::app) fn step(&mut self, unit: StepUnit, direction: Direction) {
        let missed = self.beyond_end(direction).or_else(|| self.missed_unit(unit, direction));
        let n = self.place_after_unit(self.at(), unit, direction);
        self.stop_and_seek(n);
        self.missed = missed;
    }

    /// The unit whose edge a move does not find, and that the edge of a longer unit stands for.
    fn missed_unit(&self, unit: StepUnit, direction: Direction) -> Option<Missed> {
        let trace = self.trace().filter(|_| unit == StepUnit::Hypothesis)?;
        let is_missed = hypothesis_edge(trace, self.at(), direction).is_none();
        is_missed.then_some(Missed::Hypothesis(direction))
    }

    /// Moves to the opposite end of the trace, if the cursor has reached the end that it plays towards.
    fn rewind_if_over(&mut self, direction: Direction) {
        match direction {
            Direction::Forward if self.at() >= self.len() => self.seek(0),
            Direction::Back if self.at() == 0 => self.seek(self.len()),
            _ => {}
        }
    }

    /// Advances playing by `seconds`.
    pub(in crate::app) fn tick(&mut self, seconds: f64, settings: &DebugSettings) {
        let Some(direction) = self.playing else { return };
        self.unit_fraction += seconds.clamp(0.0, LONGEST_TICK) * settings.per_second.max(0.0);
        let units = self.unit_fraction.floor();
        self.unit_fraction -= units;
        let (at, units) = (self.at(), units as usize);
        let mut n = at;
        match (settings.unit, direction) {
            (StepUnit::Step, Direction::Forward) => n = (n + units).min(self.len()),
            (StepUnit::Step, Direction::Back) => n = n.saturating_sub(units),
            (unit, direction) => {
                for _ in 0..units {
                    n = self.place_after_unit(n, unit, direction);
                }
            }
        }
        if n != at {
            self.play_to(n, direction, settings);
        }
    }

    /// Plays to `n`, or to a breakpoint before.
    fn play_to(&mut self, n: usize, direction: Direction, settings: &DebugSettings) {
        let n = self.play_until.map_or(n, |until| n.min(until));
        let stop = self.replay.as_ref().and_then(|replay| next_stop(replay, n, &settings.breakpoints));
        self.seek(stop.map_or(n, |stop| stop.0));
        if stop.is_some() {
            self.stop_playing();
            self.stopped_by = stop.map(|stop| stop.1);
        } else if self.play_until == Some(n) {
            self.stop_playing();
        } else if n == 0 || n == self.len() {
            if settings.looped {
                self.rewind_if_over(direction);
            } else {
                self.stop_playing();
            }
        }
    }
}
