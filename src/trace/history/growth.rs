//! One region's growth, as far as it concerns one pixel.

use super::{Barrier, Reach};
use crate::color::{Cylinder, Line, dot};
use crate::raster::HypothesisId;
use crate::reflection::HighlightTest;
use crate::trace::{ComponentSplit, Event, SliceMade, VectorsFitted};

/// What is known of a region at some step.
#[derive(Clone, Copy, Default)]
pub(super) struct Known<'a> {
    line: Option<Line>,
    radius: f64,
    slice: Option<&'a SliceMade>,
}

/// The regions so far; region `id` at index `id − 1`.
#[derive(Default)]
pub(super) struct Regions<'a>(Vec<Known<'a>>);

impl<'a> Regions<'a> {
    pub(super) fn hear(&mut self, event: &'a Event) {
        match event {
            Event::HypothesisChosen(chosen) => {
                self.0.push(Known { line: Some(chosen.line), radius: chosen.radius, slice: None });
            }
            Event::ComponentSplit(ComponentSplit { hypothesis, .. }) => self.0.push(self.of(*hypothesis)),
            Event::LineRefitted(refitted) => {
                if let Some(known) = self.slot(refitted.hypothesis) {
                    known.line = Some(refitted.line);
                }
            }
            Event::SliceMade(made) => {
                if let Some(known) = self.slot(made.hypothesis) {
                    known.slice = Some(made);
                }
            }
            _ => {}
        }
    }

    /// The cylinder of a region and its radius, counts.
    pub(super) fn cylinder(&self, hypothesis: HypothesisId) -> Option<(Cylinder, f64)> {
        let known = self.of(hypothesis);
        known.line.map(|line| (Cylinder::new(&line, known.radius), known.radius))
    }

    pub(super) fn slice(&self, hypothesis: HypothesisId) -> Option<&'a SliceMade> {
        self.of(hypothesis).slice
    }

    fn of(&self, hypothesis: HypothesisId) -> Known<'a> {
        self.0.get(hypothesis.index()).copied().unwrap_or_default()
    }

    fn slot(&mut self, hypothesis: HypothesisId) -> Option<&mut Known<'a>> {
        self.0.get_mut(hypothesis.index())
    }
}

/// What a growing region accepts.
#[derive(Clone, Copy)]
pub(super) enum Reaching<'a> {
    Cylinder(Cylinder, f64),
    Slice(&'a SliceMade),
    /// Anything brighter than this, counts.
    Brighter(f32),
}

impl Reaching<'_> {
    /// How far inside a color lies.
    pub(super) fn reach(&self, color: [f32; 3]) -> Reach {
        match *self {
            Self::Cylinder(cylinder, radius) => {
                Reach::Axis { distance: cylinder.distance2(color).sqrt(), radius }
            }
            Self::Slice(made) => {
                Reach::Plane { distance: made.slice.distance(color), half_width: made.half_width }
            }
            Self::Brighter(start) => Reach::Brightness { brightness: brightness(color), start },
        }
    }

    /// What keeps a color out; none where it lies inside.
    pub(super) fn barrier(&self, color: [f32; 3]) -> Option<Barrier> {
        match *self {
            Self::Cylinder(cylinder, radius) => (!cylinder.contains(color))
                .then(|| Barrier::Cylinder { distance: cylinder.distance2(color).sqrt(), radius }),
            Self::Slice(made) => made.slice.miss(color).map(Barrier::Slice),
            // The trace keeps the root of what was compared, so that a tie can round either way: the caller knows that the
            // pixel was not taken.
            Self::Brighter(start) => Some(Barrier::Darker { brightness: brightness(color), start }),
        }
    }
}

/// Distance of a color from black, counts.
pub(super) fn brightness(color: [f32; 3]) -> f32 {
    dot(color, color).sqrt()
}

/// What tells a growing region's highlight pixels, from which growth by brightness starts.
pub(super) fn growing_test(fitted: &VectorsFitted) -> Option<HighlightTest> {
    fitted.highlight.map(|surface| HighlightTest::of_lines(&fitted.matte, &[fitted.start], &surface))
}

/// What tells the final region's highlight pixels.
pub(super) fn highlight_test(fitted: &VectorsFitted) -> Option<HighlightTest> {
    fitted.highlight.map(|surface| HighlightTest::of_lines(&fitted.matte, &fitted.starts, &surface))
}

/// A region that grows.
#[derive(Clone, Copy)]
pub(super) struct Growth<'a> {
    pub(super) hypothesis: HypothesisId,
    pub(super) reaching: Reaching<'a>,
    /// The first step at which it came to the pixel.
    pub(super) visited: Option<usize>,
    /// Whether what became of that is in the trace.
    pub(super) settled: bool,
}
