//! Section 5.4.1: the light by the dichromatic planes of the regions.
//!
//! The paper averages the directions of the highlight lines. Refined (`robust_illuminant`): the planes of the regions are
//! intersected robustly (`illuminant`), at first with the unclaimed pixels just outside the matte regions, then with the
//! pixels of the grown regions and what their highlights say (`in_plane`, `two_lights`).

use super::candidates::HighlightLine;
use super::evidence::{nearby_highlight, plane_constraint};
use super::illuminant::{Constraint, Prior, average_direction, intersect, weighted_direction};
use super::in_plane::InPlaneSearch;
use super::planar_hypothesis::PlanarHypothesis;
use super::planar_state::PlanarState;
use super::recorded_labels::Members;
use super::two_lights::{Evidence, light_of};
use crate::color::{Vec3, axis_angle_deg};
use crate::raster::HypothesisId;
use crate::reflection::DichromaticPlane;
use crate::trace::{AveragedDirection, Contribution, Recorder, TwoLightTest};
use rayon::prelude::*;

/// Number of pixels that the in-plane fits of all regions look at together: their cost does not grow with the picture.
const IN_PLANE_SAMPLES: usize = 16_000;
/// Standard deviation of a prior from highlight lines, and of the prior white, degrees.
const LINES_PRIOR_SD_DEG: f64 = 8.0;
const WHITE_PRIOR_SD_DEG: f64 = 12.0;
/// Standard deviation of a prior that is the estimate of the round before, degrees.
const ROUND_BEFORE_PRIOR_SD_DEG: f64 = 30.0;
/// The interval of a direction of unknown error, degrees: every direction.
const UNKNOWN_INTERVAL_DEG: f64 = 90.0;

/// An estimate of the light's direction by the dichromatic planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneLight {
    /// Unit direction; `None` where no region gives evidence of the light.
    pub direction: Option<Vec3>,
    /// Number of regions that the estimate rests on.
    pub regions: usize,
    /// Angle within which the light lies, by the planes alone, degrees.
    pub interval_deg: f64,
    /// Two standard deviations of the direction as far as it depends on single regions, degrees
    /// ([`Intersection`](super::illuminant::Intersection)).
    pub spread_deg: f64,
    /// Whether the estimate rests on the planes of the highlights alone, because faint surface reflection has another color
    /// (section 7.5).
    pub highlights_alone: bool,
}

impl PlaneLight {
    /// The estimate of a scene without evidence: no direction.
    pub fn none() -> Self {
        Self {
            direction: None,
            regions: 0,
            interval_deg: UNKNOWN_INTERVAL_DEG,
            spread_deg: 0.0,
            highlights_alone: false,
        }
    }

    /// The direction, where at least one region supports it.
    pub fn known_direction(&self) -> Option<Vec3> {
        self.direction.filter(|_| self.regions > 0)
    }
}

/// An estimate with the record of how it was made.
pub struct PlaneEstimate {
    /// The estimate.
    pub light: PlaneLight,
    /// Residual and weight of each region's evidence; empty for the paper's average.
    pub contributions: Vec<Contribution>,
    /// Each highlight direction of the paper's average; empty for the robust estimate.
    pub averaged: Vec<AveragedDirection>,
    /// The test for a second light; `None` where it was not made.
    pub two_light_test: Option<TwoLightTest>,
    /// What each grown region tells of the light; empty for the paper's average and for the first estimate.
    pub evidence: Vec<Evidence>,
}

impl PlaneEstimate {
    /// An estimate without a record of how it was made.
    pub fn of_light(light: PlaneLight) -> Self {
        Self {
            light,
            contributions: Vec::new(),
            averaged: Vec::new(),
            two_light_test: None,
            evidence: Vec::new(),
        }
    }
}

/// The paper's estimate: the average direction of all highlight lines.
pub fn average_of_lines<R: Recorder>(state: &PlanarState<R>) -> PlaneEstimate {
    let light = PlaneLight {
        direction: average_direction(&state.lines),
        regions: state.lines.iter().flatten().count(),
        ..PlaneLight::none()
    };
    let contribution = |(hypothesis, line): (HypothesisId, &Option<HighlightLine>)| {
        let (line, average) = (line.as_ref()?, light.direction.as_ref()?);
        let angle_deg = axis_angle_deg(&line.direction, average);
        Some(AveragedDirection { hypothesis, direction: line.direction.into(), angle_deg })
    };
    let averaged = HypothesisId::all(state.lines.len()).zip(&state.lines).filter_map(contribution).collect();
    PlaneEstimate { averaged, ..PlaneEstimate::of_light(light) }
}

/// The first estimate, from the unclaimed pixels just outside the matte regions, whose pixels are `members`; `None` where
/// there is neither such evidence nor a highlight line.
pub fn estimate_beside_matte_regions<R: Recorder>(
    state: &PlanarState<R>,
    members: &Members,
) -> Option<PlaneEstimate> {
    // The recorder cannot be shared between threads: the closures borrow what they need, not the state.
    let (input, labels, matte, lengths) = (state.input, &state.matte_labels, &state.matte, &state.lengths);
    let by_lines = weighted_direction(&state.lines);
    let start = by_lines.unwrap_or(Vec3::repeat(1.0).normalize());
    let constraints: Vec<Constraint> = (0..matte.len())
        .into_par_iter()
        .map(HypothesisId::from_index)
        .filter(|&id| matte[id.index()].alive && !input.stopped())
        .filter_map(|id| {
            let line = &matte[id.index()].line;
            let plane = DichromaticPlane::new(line, &start)?;
            let length = lengths[id.index()];
            let nearby = nearby_highlight(input, labels, &plane, length, members.region(id));
            plane_constraint(input, id, &plane, length, nearby.into_iter())
        })
        .collect();
    if constraints.is_empty() && by_lines.is_none() {
        return None;
    }
    let sd_deg = if by_lines.is_some() { LINES_PRIOR_SD_DEG } else { WHITE_PRIOR_SD_DEG };
    let found = intersect(&constraints, &Prior { direction: start, sd_deg });
    let light = PlaneLight {
        direction: Some(found.direction),
        regions: constraints.len().max(state.lines.iter().flatten().count()),
        interval_deg: found.interval_deg,
        spread_deg: found.spread_deg,
        highlights_alone: false,
    };
    let contributions = found.contributions;
    Some(PlaneEstimate { contributions, ..PlaneEstimate::of_light(light) })
}

/// What each grown region tells of the light.
pub fn evidence_of_grown_regions<R: Recorder>(
    state: &PlanarState<R>,
    hypotheses: &[PlanarHypothesis],
) -> Vec<Evidence> {
    // The recorder cannot be shared between threads: the closure borrows what it needs, not the state.
    let (input, labels) = (state.input, &state.recorded_labels.labels);
    let members = Members::of(labels, hypotheses.len());
    let planes = hypotheses.iter().filter(|hypothesis| hypothesis.plane.is_some()).count();
    let budget = IN_PLANE_SAMPLES / planes.max(1);
    (0..hypotheses.len())
        .into_par_iter()
        .map(HypothesisId::from_index)
        .filter_map(|id| {
            let hypothesis = &hypotheses[id.index()];
            let wanted = hypothesis.alive && !input.stopped();
            let plane = hypothesis.plane.filter(|_| wanted)?;
            let (pixels, matte_length) = (members.region(id), hypothesis.matte_length);
            let lies_in = plane_constraint(input, id, &plane, matte_length, pixels.iter())?;
            let search = InPlaneSearch { input, labels, hypothesis: id, plane: &plane, matte_length, budget };
            Some(Evidence { plane, lies_in, highlights: search.estimate(pixels) })
        })
        .collect()
}

/// The next estimate, from the grown regions. `before`: the direction under which the slices of `hypotheses` grew. The
/// estimate always has a direction.
pub fn estimate_from_grown_regions<R: Recorder>(
    state: &PlanarState<R>,
    hypotheses: &[PlanarHypothesis],
    before: &Vec3,
) -> PlaneEstimate {
    let evidence = evidence_of_grown_regions(state, hypotheses);
    let has_highlights = evidence.iter().any(|evidence| evidence.highlights.is_some());
    let prior = match weighted_direction(&state.lines) {
        Some(direction) if !has_highlights => Prior { direction, sd_deg: LINES_PRIOR_SD_DEG },
        _ => Prior { direction: *before, sd_deg: ROUND_BEFORE_PRIOR_SD_DEG },
    };
    let (found, two_light_test) = light_of(state.input, &evidence, &prior);
    let light = PlaneLight {
        direction: Some(found.direction),
        regions: evidence.len(),
        interval_deg: found.interval_deg,
        spread_deg: found.spread_deg,
        highlights_alone: two_light_test.is_some_and(|test| test.taken),
    };
    let contributions = found.contributions;
    PlaneEstimate { contributions, two_light_test, evidence, ..PlaneEstimate::of_light(light) }
}
