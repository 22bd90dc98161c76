//! Section 5.4: planar hypotheses. Matte line and illuminant span each object's dichromatic plane; extended by the noise
//! into a slice it segments the image anew, now with the highlights.
//!
//! Special provision for coplanar colors: pixels that were recognized as another region's matte pixels are only taken
//! inside the own matte cylinder and nearer to the own axis. Where two slices hold a pixel, the nearer plane wins.
//!
//! Refined: the illuminant from `illuminant` and `in_plane`, then slices, then both again from the grown regions until it rests
//! (`robust_illuminant`); regions without a highlight candidate get a slice too (`extend_planes`); slices end where body or
//! surface reflection would be negative (`slice_bounds`).
//!
//! A light that was given is not estimated, whatever the method: every plane turns to it.

use super::candidates::{Found, HighlightLine, highlight_lines};
use super::choice::ByPlanes;
use super::classify::Windows;
use super::evidence::{nearby_highlight, plane_constraint};
use super::illuminant::{Constraint, Prior, average_direction, intersect, weighted_direction};
use super::in_plane::InPlaneSearch;
use super::input::AnalysisInput;
use super::light::{Illuminant, LightFindings};
use super::linear::{Hypothesis, cylinders, matte_length};
use super::matte::MatteRegions;
use super::merge::Areas;
use super::recorded_labels::{Members, RecordedLabels};
use super::two_lights::{Evidence, light_of};
use super::unite::merge_regions;
use crate::color::{Cylinder, Line, Vec3, axis_angle_deg};
use crate::raster::{HypothesisId, LabelMap, PixelIndex, UNASSIGNED};
use crate::reflection::{DichromaticPlane, HighlightTest, MIN_ANGLE_DEG, Slice};
use crate::trace::{
    Contest, Contribution, GrowthBegan, IlluminantEstimated, IlluminantGiven, Measure, Pass, PassBegan,
    Recorder, SliceMade, TwoLightTest,
};
use rayon::prelude::*;

/// Without a candidate the highlight is taken to start here on the matte line.
const DEFAULT_START: f64 = 0.75;
/// How often illuminant and slices are found again from the grown regions, at most.
const ROUNDS: usize = 3;
/// A light that has turned by less moves no highlight by more than a count across its slice, degrees.
const SETTLED_DEG: f64 = 0.5;
/// Pixels that all in-plane fits look at together: what they cost does not grow with the picture.
const BRANCH_SAMPLES: usize = 16_000;

/// A region's skewed T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarHypothesis {
    /// The linear hypothesis that it came from: its label in [`MatteRegions`].
    pub origin: HypothesisId,
    /// Matte line, the axis of that hypothesis's cylinder.
    pub matte: Line,
    /// Length of the matte line from black, counts.
    pub matte_length: f64,
    /// Plane of matte line and illuminant, where there is one.
    pub plane: Option<DichromaticPlane>,
    /// Where the highlight line leaves the matte line, counts.
    pub start: Vec3,
    /// The region's own highlight direction, from its chosen candidate.
    pub highlight: Option<Vec3>,
    /// Whether the region still stands.
    pub alive: bool,
}

impl PlanarHypothesis {
    /// The same with colors measured from `origin`, counts.
    #[must_use]
    pub fn from_origin(&self, origin: &Vec3) -> Self {
        let moved = |line: Line| Line { mean: line.mean - origin, ..line };
        let matte_length = self.matte_length - self.matte.direction.dot(origin);
        let plane = self.plane.map(|plane| DichromaticPlane { matte: moved(plane.matte), ..plane });
        Self { matte: moved(self.matte), matte_length, plane, start: self.start - origin, ..*self }
    }

    /// What tells its highlight pixels from its matte ones (section 6); `None` without a plane.
    pub fn highlight_test(&self) -> Option<HighlightTest> {
        let plane = self.plane.as_ref()?;
        Some(HighlightTest::of_lines(&self.matte, &[self.start], &plane.surface))
    }
}

/// What the planar stage found.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarRegions {
    /// Region of each pixel.
    pub labels: LabelMap,
    /// One per linear hypothesis.
    pub hypotheses: Vec<PlanarHypothesis>,
    /// The light, where a highlight gave evidence of it.
    pub illuminant: Option<Illuminant>,
    /// What it rests on.
    pub light: LightFindings,
}

/// Grows matte regions into planar ones.
pub fn planar_regions<R: Recorder>(
    input: &AnalysisInput,
    windows: &Windows,
    areas: &Areas,
    matte: &MatteRegions,
    recorder: &mut R,
) -> PlanarRegions {
    let members = Members::of(&matte.labels, matte.hypotheses.len());
    let lengths: Vec<f64> = (0..matte.hypotheses.len())
        .into_par_iter()
        .map(|index| {
            let pixels = members.region(HypothesisId::from_index(index));
            matte_length(input, &matte.hypotheses[index].line, pixels)
        })
        .collect();
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Candidates });
    }
    let found = Found { windows, areas, labels: &matte.labels, hypotheses: &matte.hypotheses };
    let lines = highlight_lines(input, &found, &members, &lengths, recorder);
    let mut stage = PlanarState {
        input,
        matte_labels: matte.labels.clone(),
        matte: matte.hypotheses.clone(),
        lengths,
        lines,
        recorded_labels: RecordedLabels::new(matte.labels.clone(), recorder),
    };
    if let Some(direction) = input.used.illuminant {
        return stage.under_given_light(direction);
    }
    if !input.refine.robust_illuminant {
        let objects = stage.lines.iter().flatten().count();
        let direction = average_direction(&stage.lines);
        stage.announce(direction, Vec::new(), None);
        let hypotheses = stage.slices(direction);
        return stage.choose(
            hypotheses,
            ByPlanes { direction, objects, interval_deg: 90.0, highlights_alone: false },
        );
    }
    let mut found = stage.first_illuminant(&members);
    let mut hypotheses = stage.slices(found.direction);
    for _ in 0..ROUNDS {
        let Some(before) = found.direction.filter(|_| !input.stopped()) else { break };
        let next;
        (next, found) = stage.illuminant_again(&hypotheses, &before);
        stage.unite();
        if axis_angle_deg(&next, &before) < SETTLED_DEG {
            hypotheses = stage.hypotheses(found.direction);
            break;
        }
        stage.reset();
        hypotheses = stage.slices(found.direction);
    }
    stage.choose(hypotheses, found)
}

pub(super) struct PlanarState<'a, 's, R: Recorder> {
    pub(super) input: &'a AnalysisInput<'s>,
    matte_labels: LabelMap,
    matte: Vec<Hypothesis>,
    /// Lengths of the matte lines from black, counts.
    lengths: Vec<f64>,
    lines: Vec<Option<HighlightLine>>,
    pub(super) recorded_labels: RecordedLabels<'a, R>,
}

impl<R: Recorder> PlanarState<'_, '_, R> {
    /// Slices that all turn to a light that is known: nothing is estimated, and one round settles it.
    fn under_given_light(mut self, direction: [f64; 3]) -> PlanarRegions {
        self.recorded_labels.begin(Pass::Illuminant);
        if R::KEEPS {
            self.recorded_labels.recorder.record(IlluminantGiven { direction });
        }
        let given = Some(Vec3::from(direction));
        let mut hypotheses = self.slices(given);
        if self.input.refine.robust_illuminant {
            self.unite();
            hypotheses = self.hypotheses(given);
        }
        let illuminant = Some(Illuminant { direction, objects: 0, given: true });
        let light = LightFindings::given(direction);
        PlanarRegions { labels: self.recorded_labels.labels, hypotheses, illuminant, light }
    }

    pub(super) fn announce(
        &mut self,
        direction: Option<Vec3>,
        contributions: Vec<Contribution>,
        outshone: Option<TwoLightTest>,
    ) {
        self.recorded_labels.begin(Pass::Illuminant);
        if R::KEEPS
            && let Some(direction) = direction
        {
            let estimated = IlluminantEstimated { direction: direction.into(), contributions, outshone };
            self.recorded_labels.recorder.record(estimated);
        }
    }

    /// The illuminant from what lies just outside the matte regions.
    fn first_illuminant(&mut self, members: &Members) -> ByPlanes {
        let candidates = weighted_direction(&self.lines);
        let white = Vec3::repeat(1.0).normalize();
        let start = candidates.unwrap_or(white);
        let constraints: Vec<Constraint> = (0..self.matte.len())
            .into_par_iter()
            .map(HypothesisId::from_index)
            .filter(|&id| self.matte[id.index()].alive && !self.input.stopped())
            .filter_map(|id| {
                let line = &self.matte[id.index()].line;
                let plane = DichromaticPlane::new(line, &start)?;
                let length = self.lengths[id.index()];
                let nearby =
                    nearby_highlight(self.input, &self.matte_labels, &plane, length, members.region(id));
                plane_constraint(self.input, id, &plane, length, nearby.into_iter())
            })
            .collect();
        if constraints.is_empty() && candidates.is_none() {
            return ByPlanes { direction: None, objects: 0, interval_deg: 90.0, highlights_alone: false };
        }
        let sd_deg = if candidates.is_some() { 8.0 } else { 12.0 };
        let found = intersect(&constraints, &Prior { direction: start, sd_deg });
        self.announce(Some(found.direction), found.contributions, None);
        let objects = constraints.len().max(self.lines.iter().flatten().count());
        ByPlanes {
            direction: Some(found.direction),
            objects,
            interval_deg: found.interval_deg,
            highlights_alone: false,
        }
    }

    /// The illuminant from the grown regions.
    fn illuminant_again(&mut self, hypotheses: &[PlanarHypothesis], before: &Vec3) -> (Vec3, ByPlanes) {
        let members = Members::of(&self.recorded_labels.labels, hypotheses.len());
        let budget = BRANCH_SAMPLES / hypotheses.iter().filter(|h| h.plane.is_some()).count().max(1);
        let evidence: Vec<Evidence> = (0..hypotheses.len())
            .into_par_iter()
            .map(HypothesisId::from_index)
            .filter_map(|id| {
                let hypothesis = &hypotheses[id.index()];
                let wanted = hypothesis.alive && !self.input.stopped();
                let plane = hypothesis.plane.filter(|_| wanted)?;
                let (pixels, length) = (members.region(id), hypothesis.matte_length);
                let lies_in = plane_constraint(self.input, id, &plane, length, pixels.iter())?;
                let search = InPlaneSearch {
                    input: self.input,
                    labels: &self.recorded_labels.labels,
                    hypothesis: id,
                    plane: &plane,
                    matte_length: length,
                    budget,
                };
                Some(Evidence { plane, lies_in, highlights: search.estimate(pixels) })
            })
            .collect();
        let objects = evidence.len();
        let branches = evidence.iter().filter(|evidence| evidence.highlights.is_some()).count();
        let prior = match weighted_direction(&self.lines) {
            Some(direction) if branches == 0 => Prior { direction, sd_deg: 8.0 },
            _ => Prior { direction: *before, sd_deg: 30.0 },
        };
        let (found, outshone) = light_of(self.input, &evidence, &prior);
        let highlights_alone = outshone.is_some_and(|outshone| outshone.taken);
        self.announce(Some(found.direction), found.contributions, outshone);
        let direction = Some(found.direction);
        let interval_deg = found.interval_deg;
        (found.direction, ByPlanes { direction, objects, interval_deg, highlights_alone })
    }

    /// Joins parts that have grown together.
    pub(super) fn unite(&mut self) {
        if !self.input.refine.merge_regions {
            return;
        }
        self.recorded_labels.begin(Pass::Uniting);
        let into = merge_regions(self.input, &mut self.matte, &mut self.recorded_labels);
        if HypothesisId::all(into.len()).eq(into.iter().copied()) {
            return;
        }
        for label in self.matte_labels.as_mut_slice() {
            let owner = HypothesisId::from_label(*label).map(|id| into[id.index()]);
            *label = HypothesisId::label(owner);
        }
        let members = Members::of(&self.matte_labels, self.matte.len());
        for (id, hypothesis) in HypothesisId::all(self.matte.len()).zip(&self.matte) {
            self.lengths[id.index()] = matte_length(self.input, &hypothesis.line, members.region(id));
        }
    }

    /// Takes the labels back to the matte regions.
    pub(super) fn reset(&mut self) {
        self.recorded_labels.begin(Pass::Reset);
        for pixel in 0..self.matte_labels.len() {
            let owner = HypothesisId::from_label(self.matte_labels[pixel]);
            self.recorded_labels.assign(pixel, owner);
        }
    }

    /// Each region's skewed T under a light.
    pub(super) fn hypotheses(&self, illuminant: Option<Vec3>) -> Vec<PlanarHypothesis> {
        (0..self.matte.len()).map(|index| self.hypothesis(index, illuminant)).collect()
    }

    /// Makes each region's skewed T and grows it, larger regions first.
    pub(super) fn slices(&mut self, illuminant: Option<Vec3>) -> Vec<PlanarHypothesis> {
        let members = Members::of(&self.matte_labels, self.matte.len());
        let hypotheses = self.hypotheses(illuminant);
        let slices: Vec<Option<Slice>> = hypotheses.iter().map(|h| self.slice(h)).collect();
        let cylinders = cylinders(self.input, &self.matte);
        self.recorded_labels.begin(Pass::Slices);
        let mut order: Vec<HypothesisId> = HypothesisId::all(hypotheses.len()).collect();
        order.sort_by_key(|&id| std::cmp::Reverse(members.region(id).len()));
        for id in order {
            if self.input.stopped() {
                break;
            }
            if let (Some(slice), Some(plane)) = (&slices[id.index()], &hypotheses[id.index()].plane) {
                if R::KEEPS {
                    self.recorded_labels.recorder.record(SliceMade {
                        hypothesis: id,
                        plane: *plane,
                        matte_length: self.lengths[id.index()],
                        start: hypotheses[id.index()].start,
                        half_width: self.input.used.slice_half_width_counts(),
                        slice: *slice,
                    });
                }
                self.grow_slice(id, slice, (&slices, &cylinders), &members);
            }
        }
        hypotheses
    }

    fn hypothesis(&self, index: usize, illuminant: Option<Vec3>) -> PlanarHypothesis {
        let Hypothesis { line, alive, .. } = self.matte[index];
        let matte_length = self.lengths[index];
        let own = self.lines[index];
        let plane = illuminant
            .filter(|_| alive && (own.is_some() || self.input.refine.extend_planes))
            .and_then(|light| DichromaticPlane::new(&line, &light))
            .filter(|plane| plane.angle_deg() >= MIN_ANGLE_DEG || !self.input.refine.extend_planes);
        let start = own.map_or(line.foot() + line.direction * (DEFAULT_START * matte_length), |o| o.start);
        PlanarHypothesis {
            origin: HypothesisId::from_index(index),
            matte: line,
            matte_length,
            plane,
            start,
            highlight: own.map(|o| o.direction),
            alive,
        }
    }

    fn slice(&self, hypothesis: &PlanarHypothesis) -> Option<Slice> {
        let plane = hypothesis.plane?;
        let half_width = self.input.used.slice_half_width_counts();
        Some(if self.input.refine.slice_bounds {
            Slice::bounded(&plane, half_width, self.input.used.radius_counts(), hypothesis.matte_length)
        } else {
            Slice::unbounded(&plane, half_width)
        })
    }

    fn grow_slice(
        &mut self,
        id: HypothesisId,
        slice: &Slice,
        (slices, cylinders): (&[Option<Slice>], &[Cylinder]),
        members: &Members,
    ) {
        let input = self.input;
        let own = cylinders[id.index()];
        let matte_labels = &self.matte_labels;
        let mut front = self.recorded_labels.border(id, members.region(id));
        if R::KEEPS {
            let limit = input.used.slice_half_width_counts() as f32;
            self.recorded_labels.recorder.record(GrowthBegan { hypothesis: id, limit });
        }
        self.recorded_labels.grow(
            id,
            &mut front,
            || input.stopped(),
            |recorder, pixel, holder| {
                let color = input.pixels[pixel];
                if !input.claimable(pixel) || !slice.contains(color) {
                    return false;
                }
                let Some(holder) = holder else { return true };
                let matte = matte_labels[pixel];
                let foreign = matte != UNASSIGNED && matte != id.get();
                if foreign && !own.contains(color) {
                    if R::KEEPS {
                        let contest = Contest {
                            measure: Measure::ForeignMatte,
                            challenger: own.distance2(color).sqrt(),
                            holder: input.used.radius_counts() as f32,
                        };
                        recorder.contest(PixelIndex::from_index(pixel), holder, id, false, contest);
                    }
                    return false;
                }
                let theirs = &slices[holder.index()];
                let (measure, mine, held) = match theirs {
                    Some(theirs) if !foreign => {
                        (Measure::Plane, slice.distance(color), theirs.distance(color))
                    }
                    _ => {
                        let axis = &cylinders[holder.index()];
                        (Measure::Axis, own.distance2(color).sqrt(), axis.distance2(color).sqrt())
                    }
                };
                if R::KEEPS {
                    let contest = Contest { measure, challenger: mine, holder: held };
                    recorder.contest(PixelIndex::from_index(pixel), holder, id, mine < held, contest);
                }
                mine < held
            },
        );
    }
}
