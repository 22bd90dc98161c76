//! Targets of the cursor's moves.

use crate::raster::{HypothesisId, PixelIndex};
use crate::trace::{Event, Kind, LocalPoint, Stage, Step, Trace, WindowClassified, region_of};
use serde::{Deserialize, Serialize};

/// A direction in the trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Towards the result.
    Forward,
    /// Towards the beginning.
    Back,
}

/// The unit of a move of the cursor. The variants stand in the order of their lengths, the shortest first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum StepUnit {
    /// One step of the trace: a change of a pixel's owner, or an event such as the class of a window.
    #[serde(rename = "Claim")]
    Step,
    /// All steps up to the next event, that is the next decision about more than one pixel.
    Event,
    /// All pixels at the same distance, in claims, from the pixels with which the region of a block began to grow.
    #[default]
    Ring,
    /// A block of the trace: a hypothesis, a slice, or the highlight candidates of a region.
    Hypothesis,
    /// A pass: a part of a stage.
    Pass,
    /// A stage of the analysis.
    Stage,
}

impl StepUnit {
    /// All units, finest first.
    pub const ALL: [Self; 6] =
        [Self::Step, Self::Event, Self::Ring, Self::Hypothesis, Self::Pass, Self::Stage];

    /// The unit's name in menus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Step => "claim",
            Self::Event => "event",
            Self::Ring => "ring",
            Self::Hypothesis => "hypothesis",
            Self::Pass => "pass",
            Self::Stage => "stage",
        }
    }
}

/// A goal to run to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Goal {
    /// A step of this kind.
    Kind(Kind),
    /// A step about this pixel of the photograph.
    Pixel(PixelIndex),
    /// A step about this hypothesis, or the region that the hypothesis became.
    Hypothesis(HypothesisId),
    /// The next breakpoint.
    Breakpoint,
    /// The position after this many steps of the trace, or a breakpoint before that position.
    StepCount(usize),
}

/// The place after one unit from `at`. Rings are resolved by the caller.
pub fn place_after_unit(trace: &Trace, at: usize, unit: StepUnit, direction: Direction) -> usize {
    let len = trace.len();
    match (unit, direction) {
        (StepUnit::Step | StepUnit::Ring, Direction::Forward) => (at + 1).min(len),
        (StepUnit::Step | StepUnit::Ring, Direction::Back) => at.saturating_sub(1),
        (StepUnit::Event, direction) => next_event(trace, at, direction),
        (StepUnit::Hypothesis, direction) => hypothesis_edge(trace, at, direction)
            .unwrap_or_else(|| place_after_unit(trace, at, StepUnit::Stage, direction)),
        (StepUnit::Pass, direction) => {
            let passes = trace.passes().map(|span| span.steps);
            let stages = trace.stages().map(|(_, steps)| steps);
            nearest_edge(passes.chain(stages), at, direction).unwrap_or(at)
        }
        (StepUnit::Stage, direction) => {
            nearest_edge(trace.stages().map(|(_, steps)| steps), at, direction).unwrap_or(at)
        }
    }
}

/// The nearest edge of a hypothesis in a direction; none where no hypothesis is left in it.
pub fn hypothesis_edge(trace: &Trace, at: usize, direction: Direction) -> Option<usize> {
    nearest_edge(trace.blocks().map(|block| block.steps), at, direction)
}

/// The nearest end after `at`, or the nearest beginning before it.
fn nearest_edge(
    spans: impl Iterator<Item = std::ops::Range<usize>>,
    at: usize,
    direction: Direction,
) -> Option<usize> {
    match direction {
        Direction::Forward => spans.map(|span| span.end).filter(|&end| end > at).min(),
        Direction::Back => spans.map(|span| span.start).filter(|&start| start < at).max(),
    }
}

/// The place after the next event in a direction; the end of the trace where there is none.
fn next_event(trace: &Trace, at: usize, direction: Direction) -> usize {
    let next = match direction {
        Direction::Forward => {
            place_after_first(trace.steps_in(at..trace.len()), |_, step| matches!(step, Step::Event(_)))
        }
        Direction::Back => place_after_first(trace.steps_in(0..at.saturating_sub(1)).rev(), |_, step| {
            matches!(step, Step::Event(_))
        }),
    };
    next.unwrap_or(match direction {
        Direction::Forward => trace.len(),
        Direction::Back => 0,
    })
}

/// The place after the first of these steps for which `test` holds.
fn place_after_first<'a>(
    mut steps: impl Iterator<Item = (usize, Step<'a>)>,
    test: impl Fn(usize, &Step) -> bool,
) -> Option<usize> {
    steps.find(|(n, step)| test(*n, step)).map(|(n, _)| n + 1)
}

/// The place after the next step that fits a goal, or the last one before; none where no step fits. Breakpoints are
/// resolved by the caller.
pub fn next_place(trace: &Trace, at: usize, goal: Goal, direction: Direction) -> Option<usize> {
    let goal = match goal {
        Goal::Pixel(pixel) => Goal::Pixel(trace.working_pixel(pixel)),
        other => other,
    };
    let judgments = match goal {
        Goal::Pixel(pixel) => steps_about_pixel(trace, pixel),
        _ => Vec::new(),
    };
    let region = match goal {
        Goal::Hypothesis(hypothesis) => region_of(trace, hypothesis),
        _ => None,
    };
    let fits_goal = |n: usize, step: &Step| match goal {
        Goal::Kind(kind) => step.kind() == kind,
        Goal::Pixel(pixel) => step.pixel() == Some(pixel) || judgments.binary_search(&n).is_ok(),
        Goal::Hypothesis(hypothesis) => step.concerns(hypothesis, region),
        Goal::Breakpoint | Goal::StepCount(_) => false,
    };
    match direction {
        Direction::Forward => place_after_first(trace.steps_in(at..trace.len()), fits_goal),
        Direction::Back => place_after_first(trace.steps_in(0..at.saturating_sub(1)).rev(), fits_goal),
    }
}

/// The steps at which windows and blobs that hold a working pixel were judged, ascending.
fn steps_about_pixel(trace: &Trace, pixel: PixelIndex) -> Vec<usize> {
    let mut window_of_pixel = None;
    let local = trace.stage_trace(Stage::Split).and_then(|stage_trace| stage_trace.local());
    let own_blob = local.and_then(|local| local.point(pixel.index())).map(LocalPoint::blob);
    let mut steps = Vec::new();
    for (n, event) in trace.events() {
        match event {
            Event::WindowsLaid(laid) => {
                window_of_pixel = Some(laid.window_of(pixel.index(), trace.width()) as u32);
            }
            Event::WindowClassified(WindowClassified { window, .. }) if window_of_pixel == Some(*window) => {
                steps.push(n);
            }
            event if event.blob().is_some_and(|blob| Some(blob) == own_blob) => steps.push(n),
            _ => {}
        }
    }
    steps
}
