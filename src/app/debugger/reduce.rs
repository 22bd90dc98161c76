//! The reducer of the debugger.

use super::anchor::{Anchor, best_overlaps};
use super::breakpoint::hit;
use super::cursor::{found, stepped};
use super::{Breakpoint, DebugCommand, DebugSettings, Debugger, Difference, Direction, Goal, Grain};
use crate::app::{Effect, State};
use crate::trace::Replay;
use crate::view::{RegionNames, rings};
use std::sync::Arc;

/// Upper limit of the time of one tick, seconds: after a window was hidden, the cursor does not leap.
const LONGEST_TICK: f64 = 0.25;

/// Applies a command to the debugger.
pub fn reduce(state: &mut State, command: DebugCommand) -> Vec<Effect> {
    match command {
        DebugCommand::Settings(settings) => {
            let opened = settings.open && !state.view.debug.open;
            if !settings.open {
                state.debugger = Debugger::default();
            }
            state.view.debug = settings;
            return if opened { vec![Effect::Trace] } else { Vec::new() };
        }
        DebugCommand::Compare => {
            compare(state);
            return Vec::new();
        }
        _ => {}
    }
    let State { debugger, view, .. } = state;
    let settings = &view.debug;
    if debugger.replay.is_none() {
        return Vec::new();
    }
    match command {
        DebugCommand::Seek(n) => debugger.go(n),
        DebugCommand::Step(grain, direction) => {
            let n = debugger.target(debugger.at(), grain, direction);
            debugger.go(n);
        }
        DebugCommand::Into => debugger.enter_block(),
        DebugCommand::RunTo(goal, direction) => debugger.run_to(goal, direction, &settings.breakpoints),
        DebugCommand::Play(direction) => {
            debugger.rest();
            if let Some(direction) = direction {
                debugger.playing = Some(direction);
                debugger.rewind_if_over(direction);
            }
        }
        DebugCommand::Choose(region) => debugger.chosen = region,
        DebugCommand::Tick(seconds) => debugger.tick(seconds, settings),
        DebugCommand::Settings(_) | DebugCommand::Compare => {}
    }
    Vec::new()
}

/// Takes the trace of a new result, and moves the cursor to the place that corresponds to its old one.
pub fn trace_arrived(state: &mut State, generation: u64, mut replay: Replay) {
    let newest = state.newest.as_ref().filter(|shown| shown.generation == generation);
    let Some(newest) = newest.filter(|_| state.view.debug.open) else { return };
    let names = RegionNames::new(&replay, &newest.region_colors);
    let before = &state.debugger;
    let finals = Arc::clone(&newest.analysis.finals);
    if let Some(anchor) = before.stopped().and_then(|old| Anchor::of(old, &before.names)) {
        let best_overlaps =
            before.finals.as_ref().map_or_else(Vec::new, |old| best_overlaps(&old.labels, &finals.labels));
        let n = anchor.find(replay.trace(), &names, &best_overlaps);
        replay.seek(n);
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

fn compare(state: &mut State) {
    let Some(trace) = state.debugger.trace().cloned() else { return };
    let pinned = state.pinned.as_ref().and_then(|pinned| pinned.trace());
    let difference = match pinned.map(|pinned| pinned.first_difference(&trace)) {
        None => Difference::NotRecorded,
        Some(None) => Difference::None,
        Some(Some(n)) => Difference::At(n),
    };
    if let Difference::At(n) = difference {
        state.debugger.go(n + 1);
    }
    state.debugger.difference = Some(difference);
}

impl Debugger {
    fn at(&self) -> usize {
        self.replay.as_ref().map_or(0, Replay::at)
    }

    fn len(&self) -> usize {
        self.replay.as_ref().map_or(0, |replay| replay.trace().len())
    }

    fn rest(&mut self) {
        (self.playing, self.until, self.due, self.stopped_by) = (None, None, 0.0, None);
    }

    /// Moves to `n` and ends playing.
    fn go(&mut self, n: usize) {
        self.rest();
        self.seek(n);
    }

    fn seek(&mut self, n: usize) {
        if let Some(replay) = &mut self.replay {
            replay.seek(n);
        }
    }

    /// The place one unit from `at`.
    fn target(&mut self, at: usize, grain: Grain, direction: Direction) -> usize {
        if grain == Grain::Ring {
            return self.ring(at, direction);
        }
        self.replay.as_ref().map_or(at, |replay| stepped(replay.trace(), at, grain, direction))
    }

    /// The nearest end of a ring; outside of growths, of an event.
    fn ring(&mut self, at: usize, direction: Direction) -> usize {
        let Some(replay) = &mut self.replay else { return at };
        let inside = match direction {
            Direction::Forward => Some(at),
            Direction::Back => at.checked_sub(1),
        };
        let Some(block) = inside.and_then(|n| replay.trace().block_at(n)) else {
            return stepped(replay.trace(), at, Grain::Event, direction);
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
    fn enter_block(&mut self) {
        self.rest();
        let at = self.at();
        let next = self.trace().and_then(|trace| trace.blocks().find(|block| block.steps.start >= at));
        let Some(block) = next else { return };
        self.seek(block.steps.start + 1);
        (self.playing, self.until) = (Some(Direction::Forward), Some(block.steps.end));
    }

    fn run_to(&mut self, goal: Goal, direction: Direction, breakpoints: &[Breakpoint]) {
        self.rest();
        let Some(replay) = &self.replay else { return };
        let far = match direction {
            Direction::Forward => self.len(),
            Direction::Back => 0,
        };
        let stops = match goal {
            Goal::Breakpoint => Some(far),
            Goal::Place(n) => Some(n.min(self.len())),
            _ => None,
        };
        if let Some(far) = stops {
            let stop = hit(replay, far, breakpoints);
            self.seek(stop.map_or(far, |stop| stop.0));
            self.stopped_by = stop.map(|stop| stop.1);
        } else {
            let n = found(replay.trace(), replay.at(), goal, direction);
            self.seek(n.unwrap_or(far));
        }
    }

    /// Moves to the opposite end of the trace, if the cursor has reached the end that it plays towards.
    fn rewind_if_over(&mut self, direction: Direction) {
        match direction {
            Direction::Forward if self.at() >= self.len() => self.seek(0),
            Direction::Back if self.at() == 0 => self.seek(self.len()),
            _ => {}
        }
    }

    fn tick(&mut self, seconds: f64, settings: &DebugSettings) {
        let Some(direction) = self.playing else { return };
        self.due += seconds.clamp(0.0, LONGEST_TICK) * settings.per_second.max(0.0);
        let units = self.due.floor();
        self.due -= units;
        let (at, units) = (self.at(), units as usize);
        let mut n = at;
        match (settings.grain, direction) {
            (Grain::Claim, Direction::Forward) => n = (n + units).min(self.len()),
            (Grain::Claim, Direction::Back) => n = n.saturating_sub(units),
            (grain, direction) => {
                for _ in 0..units {
                    n = self.target(n, grain, direction);
                }
            }
        }
        if n != at {
            self.play_to(n, direction, settings);
        }
    }

    /// Plays to `n`, or to a breakpoint before.
    fn play_to(&mut self, n: usize, direction: Direction, settings: &DebugSettings) {
        let n = self.until.map_or(n, |until| n.min(until));
        let stop = self.replay.as_ref().and_then(|replay| hit(replay, n, &settings.breakpoints));
        self.seek(stop.map_or(n, |stop| stop.0));
        if stop.is_some() {
            self.rest();
            self.stopped_by = stop.map(|stop| stop.1);
        } else if self.until == Some(n) {
            self.rest();
        } else if n == 0 || n == self.len() {
            if settings.looped {
                self.rewind_if_over(direction);
            } else {
                self.rest();
            }
        }
    }
}
