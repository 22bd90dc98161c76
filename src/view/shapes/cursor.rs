//! The shapes at the debugger's cursor: the colors that the hypothesis in focus accepts, and the axes of all active hypotheses.

use super::{ellipsoid_of, full, slice_body};
use crate::color::Moments;
use crate::raster::HypothesisId;
use crate::trace::{Event, Replay, Step};
use crate::view::solid::Tube;
use crate::view::{Point, ResultSnapshot, Solid};

/// Shapes at an instant, in counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CursorShapes {
    /// The cylinder of the hypothesis in focus (5.3.2), as long as there is no slice.
    pub cylinder: Option<Solid>,
    /// The slice of the hypothesis in focus (5.4.2), once there is one.
    pub slice: Option<Solid>,
    /// The axis of the hypothesis in focus, from the dark sphere to the side of the cube.
    pub axis: Option<[Point; 2]>,
    /// The point where the highlight line leaves the matte line, once the point is known.
    pub start: Option<Point>,
    /// The axes of the other active hypotheses.
    pub others: Vec<(HypothesisId, [Point; 2])>,
    /// The line from black along the light as it is estimated so far.
    pub light: Option<[Point; 2]>,
    /// The lines from black along the highlight directions that the step taken last averaged (5.4.1).
    pub averaged: Vec<(HypothesisId, [Point; 2])>,
}

/// The shapes at the cursor; `focus` is the hypothesis whose shapes are shown in full.
pub fn cursor_shapes(replay: &Replay, focus: Option<HypothesisId>, shown: &ResultSnapshot) -> CursorShapes {
    let full = full(shown);
    let tube = |id: HypothesisId| {
        let hypothesis = replay.hypothesis(id)?;
        let line = hypothesis.line()?;
        Some(Tube {
            mean: line.mean.into(),
            direction: line.direction.into(),
            radius: hypothesis.radius,
            dark: shown.analysis.used.min_intensity,
            full,
        })
    };
    let own = focus.and_then(tube);
    let made = focus.and_then(|focus| replay.slice(focus));
    let slice = made.map(|made| {
        let bounded = shown.params.refinements().slice_bounds;
        let bounds = bounded.then(|| [shown.analysis.used.radius_counts(), made.matte_length]);
        slice_body(&made.plane, made.half_width, bounds, full)
    });
    let standing = replay.numbered_hypotheses().filter(|(_, hypothesis)| hypothesis.end().is_none());
    let others = standing.map(|(id, _)| id).filter(|id| Some(*id) != focus);
    // The line from black along a direction to the side of the cube.
    let from_black = |direction: [f64; 3]| {
        let largest = direction.iter().fold(0.0f64, |most, v| most.max(*v));
        let scale = full / largest;
        (largest > 0.0).then(|| [[0.0; 3], direction.map(|v| (v * scale) as f32)])
    };
    let averaged = match replay.last() {
        Some(Step::Event(Event::HighlightsAveraged(averaged))) => averaged.contributions.as_slice(),
        _ => &[],
    };
    CursorShapes {
        cylinder: own.as_ref().filter(|_| slice.is_none()).and_then(Tube::solid),
        slice,
        axis: own.as_ref().and_then(Tube::axis),
        start: made.map(|made| crate::color::rgb(&made.start)),
        others: others.filter_map(|id| Some((id, tube(id)?.axis()?))).collect(),
        light: replay.light().and_then(from_black),
        averaged: averaged
            .iter()
            .filter_map(|one| Some((one.hypothesis, from_black(one.direction)?)))
            .collect(),
    }
}

/// The ellipsoid of these colors at two standard deviations; none without at least two.
pub fn cluster_ellipsoid(colors: impl Iterator<Item = [f32; 3]>) -> Option<Solid> {
    ellipsoid_of(&colors.collect::<Moments>())
}
