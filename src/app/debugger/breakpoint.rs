//! Breakpoints: conditions that stop the cursor.

use super::Direction;
use crate::raster::{HypothesisId, PixelIndex};
use crate::trace::{
    CandidateVerdict, Class, Event, HypothesisPassedOver, PassedOver, Replay, Step, Trace, WindowClassified,
};
use serde::{Deserialize, Serialize};

/// A condition that may be switched off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Breakpoint {
    /// Whether the breakpoint is on.
    pub enabled: bool,
    /// The condition that stops the cursor.
    pub condition: Condition,
}

/// The condition of a breakpoint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Condition {
    /// A pixel gets another region.
    PixelChangesOwner(PixelIndex),
    /// A hypothesis, or any, grows beyond so many pixels.
    RegionExceeds {
        /// The hypothesis; none: any.
        #[serde(rename = "region")]
        hypothesis: Option<HypothesisId>,
        /// The largest number of pixels that does not stop the cursor.
        pixels: u32,
    },
    /// A hypothesis is rejected: passed over although it was large enough, given up, absorbed or dropped.
    HypothesisRejected,
    /// A highlight candidate fails a test.
    CandidateFails(CandidateCheck),
    /// A window is of this class.
    ClassIs(SavedClass),
    /// Two hypotheses claim the same pixel; none: any hypothesis.
    Conflict(Option<HypothesisId>, Option<HypothesisId>),
}

/// A test of a highlight candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CandidateCheck {
    /// Any of the tests that decide.
    Any,
    /// The lines meet.
    LinesMeet,
    /// In the upper half of the matte line, where this decides.
    UpperHalf,
    /// Gershon's test: the lines are not nearly parallel, where this decides.
    NotParallel,
    /// The direction is positive.
    Positive,
    /// The cluster lies beyond the meeting point.
    Beyond,
}

impl CandidateCheck {
    /// Any test, and the tests in the order in which they are made.
    pub const ALL: [Self; 6] =
        [Self::Any, Self::LinesMeet, Self::UpperHalf, Self::NotParallel, Self::Positive, Self::Beyond];

    /// The test's name in lists.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Any => "any test",
            Self::LinesMeet => "lines meet",
            Self::UpperHalf => "upper 50 %",
            Self::NotParallel => "not parallel",
            Self::Positive => "positive direction",
            Self::Beyond => "beyond the meeting point",
        }
    }

    /// Whether a candidate with these verdicts fails the check.
    fn fails(self, verdict: CandidateVerdict) -> bool {
        match self {
            Self::Any => !verdict.accepted(),
            Self::LinesMeet => !verdict.lines_meet,
            Self::UpperHalf => verdict.fails_upper_half(),
            Self::NotParallel => verdict.fails_not_parallel(),
            Self::Positive => !verdict.positive,
            Self::Beyond => !verdict.beyond,
        }
    }
}

/// A class of windows, in the spelling of workspace files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs, reason = "as Class")]
pub enum SavedClass {
    Point,
    Line,
    Plane,
    Volume,
}

impl From<Class> for SavedClass {
    fn from(class: Class) -> Self {
        match class {
            Class::Point => Self::Point,
            Class::Line => Self::Line,
            Class::Plane => Self::Plane,
            Class::Volume => Self::Volume,
        }
    }
}

impl From<SavedClass> for Class {
    fn from(class: SavedClass) -> Self {
        match class {
            SavedClass::Point => Self::Point,
            SavedClass::Line => Self::Line,
            SavedClass::Plane => Self::Plane,
            SavedClass::Volume => Self::Volume,
        }
    }
}

/// The place of the first stop between the cursor and `goal`, and the index of the breakpoint that stops the cursor; none where
/// no breakpoint does.
pub fn next_stop(replay: &Replay, goal: usize, breakpoints: &[Breakpoint]) -> Option<(usize, usize)> {
    if !breakpoints.iter().any(|breakpoint| breakpoint.enabled) {
        return None;
    }
    let (trace, at) = (replay.trace(), replay.at());
    let mut sizes = Sizes { replay, gained: Vec::new() };
    let conditions: Vec<Condition> =
        breakpoints.iter().map(|breakpoint| breakpoint.condition.of_working_pixels(trace)).collect();
    let stops = |step: &Step, sizes: &Sizes| {
        let mut both = breakpoints.iter().zip(&conditions);
        both.position(|(breakpoint, condition)| breakpoint.enabled && condition.holds(step, |r| sizes.of(r)))
    };
    if goal >= at {
        trace.steps_in(at..goal).find_map(|(n, step)| {
            sizes.apply(&step, Direction::Forward);
            stops(&step, &sizes).map(|index| (n + 1, index))
        })
    } else {
        // The step taken last is excluded: it would stop the cursor at its present place.
        trace.steps_in(goal..at).rev().find_map(|(n, step)| {
            let stop = (n + 1 < at).then(|| stops(&step, &sizes)).flatten();
            sizes.apply(&step, Direction::Back);
            stop.map(|index| (n + 1, index))
        })
    }
}

impl Condition {
    /// The condition that stops the cursor at steps like `step`; none for a step that no condition is about.
    pub fn for_step(step: &Step, trace: &Trace) -> Option<Self> {
        if let Some(pixel) = step.pixel() {
            let middle = trace.pixel_blocks().middle(pixel.index());
            return Some(Self::PixelChangesOwner(PixelIndex::from_index(middle)));
        }
        match step {
            Step::Event(Event::WindowClassified(found)) => {
                found.class.map(|class| Self::ClassIs(class.into()))
            }
            Step::Event(Event::CandidateTested(_)) => Some(Self::CandidateFails(CandidateCheck::Any)),
            Step::Event(event) if rejects(event) => Some(Self::HypothesisRejected),
            _ => None,
        }
    }

    /// The condition on the pixels of a trace, which are working pixels, in place of the pixels of the photograph.
    fn of_working_pixels(self, trace: &Trace) -> Self {
        match self {
            Self::PixelChangesOwner(pixel) => Self::PixelChangesOwner(trace.working_pixel(pixel)),
            other => other,
        }
    }

    /// Whether the condition holds right after a step, at which hypotheses have `size` pixels.
    fn holds(self, step: &Step, size: impl Fn(HypothesisId) -> i64) -> bool {
        match (self, step) {
            (Self::PixelChangesOwner(wanted), Step::Claim { pixel, .. }) => *pixel == wanted,
            (Self::RegionExceeds { hypothesis, pixels }, Step::Claim { after: Some(after), .. }) => {
                hypothesis.is_none_or(|wanted| wanted == *after) && size(*after) == i64::from(pixels) + 1
            }
            (Self::HypothesisRejected, Step::Event(event)) => rejects(event),
            (Self::CandidateFails(check), Step::Event(Event::CandidateTested(test))) => {
                check.fails(test.verdict)
            }
            (
                Self::ClassIs(class),
                Step::Event(Event::WindowClassified(WindowClassified { class: found, .. })),
            ) => *found == Some(class.into()),
            (
                Self::Conflict(one, other),
                Step::Refusal { holder: a, challenger: b, .. }
                | Step::Claim { before: Some(a), after: Some(b), contest: Some(_), .. },
            ) => {
                let fits = |wanted: Option<HypothesisId>, found| wanted.is_none_or(|wanted| wanted == found);
                (fits(one, *a) && fits(other, *b)) || (fits(one, *b) && fits(other, *a))
            }
            _ => false,
        }
    }
}

/// Whether an event rejects a hypothesis.
fn rejects(event: &Event) -> bool {
    match event {
        Event::HypothesisPassedOver(HypothesisPassedOver { reason, .. }) => *reason != PassedOver::TooSmall,
        Event::Absorbed(_) | Event::Dropped(_) => true,
        _ => false,
    }
}

/// Sizes of hypotheses at later steps, computed without moving the cursor.
struct Sizes<'a> {
    replay: &'a Replay,
    /// Pixels gained since the cursor, by [`HypothesisId::index`].
    gained: Vec<i64>,
}

impl Sizes<'_> {
    fn of(&self, hypothesis: HypothesisId) -> i64 {
        let gained = self.gained.get(hypothesis.index()).copied().unwrap_or(0);
        i64::from(self.replay.size(hypothesis)) + gained
    }

    fn apply(&mut self, step: &Step, direction: Direction) {
        let Step::Claim { before, after, .. } = step else { return };
        let gain = if direction == Direction::Forward { 1 } else { -1 };
        for (hypothesis, gain) in [(before, -gain), (after, gain)] {
            let Some(index) = hypothesis.map(HypothesisId::index) else { continue };
            if self.gained.len() <= index {
                self.gained.resize(index + 1, 0);
            }
            self.gained[index] += gain;
        }
    }
}
