//! The growth of one hypothesis, as far as the growth concerns one pixel.

use super::{Barrier, Reach};
use crate::color::{Cylinder, dot};
use crate::raster::HypothesisId;
use crate::reflection::{ClippedColorTest, HighlightTest};
use crate::trace::{SliceMade, VectorsFitted};

/// The colors that a growing hypothesis accepts.
#[derive(Clone, Copy)]
pub(super) enum Reaching<'a> {
    /// Colors inside a cylinder of this radius, counts (5.3.2).
    Cylinder(Cylinder, f64),
    /// Colors inside a slice (5.4.2).
    Slice(&'a SliceMade),
    /// Colors brighter than this, counts, whose unclipped bands can be those of the region, where that is asked (5.5).
    Brighter(f32, Option<ClippedColorTest>),
}

impl Reaching<'_> {
    /// How far inside the accepted colors a color lies.
    pub(super) fn reach(&self, color: [f32; 3]) -> Reach {
        match *self {
            Self::Cylinder(cylinder, radius) => {
                Reach::Axis { distance: cylinder.distance2(color).sqrt(), radius }
            }
            Self::Slice(made) => {
                Reach::Plane { distance: made.slice.distance(color), half_width: made.half_width }
            }
            Self::Brighter(start, _) => Reach::Brightness { brightness: brightness(color), start },
        }
    }

    /// The bound that a color lies outside of; none for an accepted color.
    pub(super) fn barrier(&self, color: [f32; 3]) -> Option<Barrier> {
        match *self {
            Self::Cylinder(cylinder, radius) => (!cylinder.contains(color))
                .then(|| Barrier::Cylinder { distance: cylinder.distance2(color).sqrt(), radius }),
            Self::Slice(made) => made.slice.miss(color).map(Barrier::Slice),
            Self::Brighter(start, test) => {
                let brightness = brightness(color);
                let refusal = test.filter(|_| brightness > start).and_then(|test| test.refusal(color));
                // The trace keeps the square root of the bound that was compared, so that a tie can round either way. The
                // caller knows that the pixel was not taken.
                Some(refusal.map_or(Barrier::Darker { brightness, start }, |[distance, limit]| {
                    Barrier::OtherBands { distance, limit }
                }))
            }
        }
    }
}

/// Distance of a color from black, counts.
pub(super) fn brightness(color: [f32; 3]) -> f32 {
    dot(color, color).sqrt()
}

/// The test of the highlight pixels from which growth by brightness starts.
pub(super) fn growing_test(fitted: &VectorsFitted) -> Option<HighlightTest> {
    fitted.highlight.map(|surface| HighlightTest::of_lines(&fitted.matte, &[fitted.start], &surface))
}

/// The test of the clipped colors that growth by brightness takes. `clip_threshold`: counts.
pub(super) fn clipped_test(fitted: &VectorsFitted, clip_threshold: f64) -> Option<ClippedColorTest> {
    let VectorsFitted { matte, highlight, .. } = fitted;
    let surface = highlight.as_ref()?;
    Some(ClippedColorTest::new(&matte.foot(), &matte.direction, surface, clip_threshold as f32))
}

/// The test of the highlight pixels of a region of the result.
pub(super) fn highlight_test(fitted: &VectorsFitted) -> Option<HighlightTest> {
    fitted.highlight.map(|surface| HighlightTest::of_lines(&fitted.matte, &fitted.starts, &surface))
}

/// A growth under way.
#[derive(Clone, Copy)]
pub(super) struct Growth<'a> {
    /// The hypothesis that grows.
    pub(super) hypothesis: HypothesisId,
    /// The colors that the hypothesis accepts.
    pub(super) reaching: Reaching<'a>,
    /// The first step at which the growth reached a neighbor of the pixel; none: not yet.
    pub(super) visited: Option<usize>,
    /// Whether the trace holds the outcome: a claim or a contest of the pixel.
    pub(super) settled: bool,
}
