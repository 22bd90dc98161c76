//! Section 5.4.2: the regions while the planar stage works on them. Slices grow, parts of one object are united, and the
//! labels go back to the matte regions for slices under another illuminant.
//!
//! Larger regions grow first. Special provision for coplanar colors: a pixel that was recognized as a matte pixel of
//! another region is taken only if its color lies inside the own matte cylinder and nearer to the own axis. Where two
//! slices contain a pixel, the nearer plane wins. Two matte areas of one object, which a highlight divides, are united
//! (`matte_areas`).
//!
//! Refined: regions without a highlight candidate get a slice too (`extend_planes`); a slice ends where body or surface
//! reflection would be negative (`slice_bounds`).

use super::candidates::HighlightLine;
use super::input::AnalysisInput;
use super::linear::{Hypothesis, cylinders, matte_length};
use super::lit_regions::SecondLamp;
use super::matte::MatteRegions;
use super::matte_areas::{MatteAreas, is_united};
use super::planar_hypothesis::PlanarHypothesis;
use super::recorded_labels::{Members, RecordedLabels};
use super::unite::merge_regions;
use crate::color::{Cylinder, Vec3};
use crate::raster::{HypothesisId, LabelMap, PixelIndex, UNASSIGNED};
use crate::reflection::{DichromaticPlane, MIN_ANGLE_DEG, Slice};
use crate::trace::{Contest, GrowthBegan, Measure, Pass, Recorder, SliceMade};

/// The regions of the planar stage: what the stage starts from, and what it has grown so far.
pub struct PlanarState<'a, 's, R: Recorder> {
    /// The image, its masks and the parameters.
    pub input: &'a AnalysisInput<'s>,
    /// Matte region of each pixel; united regions share a number.
    pub matte_labels: LabelMap,
    /// The linear hypotheses.
    pub matte: Vec<Hypothesis>,
    /// Length of each matte line from black, counts.
    pub lengths: Vec<f64>,
    /// Highlight line of each region; `None` where no candidate was accepted.
    pub lines: Vec<Option<HighlightLine>>,
    /// The second lamp, and the regions that it lights; `None` where one light explains all regions.
    pub second_lamp: Option<SecondLamp>,
    /// Region of each pixel so far, and the recorder of each change.
    pub recorded_labels: RecordedLabels<'a, R>,
}

/// What bounds the growth of all regions, one entry per region.
struct Bounds {
    /// Slice of each region; `None` for a region that does not grow.
    slices: Vec<Option<Slice>>,
    /// Cylinder around each matte line.
    cylinders: Vec<Cylinder>,
}

impl Bounds {
    /// The contest for a color between a slice and that of the holder; none for a holder without a slice.
    fn by_planes(&self, slice: &Slice, holder: HypothesisId, color: [f32; 3]) -> Option<Contest> {
        let holder = self.slices[holder.index()].as_ref()?.distance(color);
        Some(Contest { measure: Measure::Plane, challenger: slice.distance(color), holder })
    }

    /// The contest for a color between the axes of the cylinders of two regions.
    fn by_axes(&self, challenger: HypothesisId, holder: HypothesisId, color: [f32; 3]) -> Contest {
        let [challenger, holder] =
            [challenger, holder].map(|id| self.cylinders[id.index()].distance2(color).sqrt());
        Contest { measure: Measure::Axis, challenger, holder }
    }
}

impl<'a, 's, R: Recorder> PlanarState<'a, 's, R> {
    /// The state before any slice has grown: the matte regions, with the length of each matte line (counts) and the
    /// highlight line of each region.
    pub fn new(
        input: &'a AnalysisInput<'s>,
        matte: &MatteRegions,
        lengths: Vec<f64>,
        lines: Vec<Option<HighlightLine>>,
        recorder: &'a mut R,
    ) -> Self {
        Self {
            input,
            matte_labels: matte.labels.clone(),
            matte: matte.hypotheses.clone(),
            lengths,
            lines,
            second_lamp: None,
            recorded_labels: RecordedLabels::new(matte.labels.clone(), recorder),
        }
    }

    /// Unites regions whose grown parts touch and whose matte lines cannot be told apart (refinement `merge_regions`).
    pub fn unite(&mut self) {
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

    /// Sets the labels back to the matte regions.
    pub fn reset(&mut self) {
        self.recorded_labels.begin(Pass::Reset);
        for pixel in 0..self.matte_labels.len() {
            let owner = HypothesisId::from_label(self.matte_labels[pixel]);
            self.recorded_labels.assign(pixel, owner);
        }
    }

    /// The planar hypothesis of each region under an illuminant (unit direction), or under the second lamp where that lamp lights the
    /// region; hypotheses without a plane under `None`.
    pub fn hypotheses(&self, illuminant: Option<Vec3>) -> Vec<PlanarHypothesis> {
        (0..self.matte.len()).map(|index| self.hypothesis(index, illuminant)).collect()
    }

    /// Makes the planar hypothesis of each region under an illuminant and grows the region into its slice, larger regions
    /// first.
    pub fn grow_slices(&mut self, illuminant: Option<Vec3>) -> Vec<PlanarHypothesis> {
        let members = Members::of(&self.matte_labels, self.matte.len());
        let hypotheses = self.hypotheses(illuminant);
        let bounds = Bounds {
            slices: hypotheses.iter().map(|hypothesis| self.slice(hypothesis)).collect(),
            cylinders: cylinders(self.input, &self.matte),
        };
        self.recorded_labels.begin(Pass::Slices);
        let mut order: Vec<HypothesisId> = HypothesisId::all(hypotheses.len()).collect();
        order.sort_by_key(|&id| std::cmp::Reverse(members.region(id).len()));
        for id in order {
            if self.input.stopped() {
                break;
            }
            if is_united(self.input, &self.recorded_labels.labels, id, members.region(id)) {
                continue;
            }
            if let (Some(slice), Some(plane)) = (&bounds.slices[id.index()], &hypotheses[id.index()].plane) {
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
                self.grow_slice(id, slice, &bounds, &members);
            }
        }
        hypotheses
    }

    fn hypothesis(&self, index: usize, illuminant: Option<Vec3>) -> PlanarHypothesis {
        let Hypothesis { line, alive, .. } = self.matte[index];
        let matte_length = self.lengths[index];
        let highlight_line = self.lines[index];
        let second = self.second_lamp.as_ref().filter(|lamp| lamp.lights.get(index) == Some(&true));
        let plane = second
            .map(|lamp| lamp.direction)
            .or(illuminant)
            .filter(|_| alive && (highlight_line.is_some() || self.input.refine.extend_planes))
            .and_then(|direction| DichromaticPlane::new(&line, &direction))
            .filter(|plane| plane.angle_deg() >= MIN_ANGLE_DEG || !self.input.refine.extend_planes);
        let default_start = PlanarHypothesis::default_start(&line, matte_length);
        PlanarHypothesis {
            origin: HypothesisId::from_index(index),
            matte: line,
            matte_length,
            plane,
            start: highlight_line.map_or(default_start, |highlight_line| highlight_line.start),
            highlight: highlight_line.map(|highlight_line| highlight_line.direction),
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

    /// Grows hypothesis `id` from its matte pixels into the pixels whose colors lie inside its slice.
    fn grow_slice(&mut self, id: HypothesisId, slice: &Slice, bounds: &Bounds, members: &Members) {
        let input = self.input;
        let own_cylinder = bounds.cylinders[id.index()];
        let mut matte_areas = MatteAreas::new(input, id, own_cylinder, members);
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
                let is_foreign_matte = matte != UNASSIGNED && matte != id.get();
                let by_cylinder = || Contest {
                    measure: Measure::ForeignMatte,
                    challenger: own_cylinder.distance2(color).sqrt(),
                    holder: input.used.radius_counts() as f32,
                };
                if is_foreign_matte && !own_cylinder.contains(color) {
                    if R::KEEPS {
                        recorder.contest(PixelIndex::from_index(pixel), holder, id, false, by_cylinder());
                    }
                    return false;
                }
                if let Some(other) = HypothesisId::from_label(matte)
                    && is_foreign_matte
                    && matte_areas.takes_from(other)
                {
                    if R::KEEPS {
                        recorder.contest(PixelIndex::from_index(pixel), holder, id, true, by_cylinder());
                    }
                    return true;
                }
                let contest = if is_foreign_matte { None } else { bounds.by_planes(slice, holder, color) };
                let contest = contest.unwrap_or_else(|| bounds.by_axes(id, holder, color));
                let taken = contest.challenger < contest.holder;
                if R::KEEPS {
                    recorder.contest(PixelIndex::from_index(pixel), holder, id, taken, contest);
                }
                taken
            },
        );
        matte_areas.record_united(self.recorded_labels.recorder);
    }
}
