//! Section 5.4.2: what a planar growth does with the matte areas of other hypotheses.
//!
//! A pixel of another matte area joins a growing region only if its color lies in the region's matte cylinder. The text can be read
//! in three ways about what else is asked. By the proximity heuristic the pixel joins only if its color is nearer to the own axis
//! than to the other axis; then two matte areas of one object, which a highlight divides, stay two regions. Under the reading
//! `own_cylinder_only` nothing else is asked; then the dark pixels of a neighbor join as well. Under the reading
//! `single_matte_cluster` nothing else is asked where both areas form a single matte cluster: at least [`CLUSTER_SHARE`] of the other
//! area lie in the own cylinder.

use super::input::AnalysisInput;
use super::recorded_labels::{Members, Pixels};
use crate::color::Cylinder;
use crate::raster::{HypothesisId, LabelMap};
use crate::trace::{MatteAreasUnited, Recorder};
use std::collections::BTreeMap;

/// Two matte areas form a single cluster, if at least this share of one area lies in the cylinder of the other one.
const CLUSTER_SHARE: f64 = 0.9;

/// The matte areas of other hypotheses that one growth meets.
pub struct MatteAreas<'a> {
    input: &'a AnalysisInput<'a>,
    /// The hypothesis that grows.
    hypothesis: HypothesisId,
    /// The matte cylinder of this hypothesis.
    cylinder: Cylinder,
    /// The pixels of all matte areas.
    members: &'a Members,
    /// Of each area met: whether its pixels join by the own cylinder alone, and the number of pixels that did.
    met: BTreeMap<HypothesisId, (bool, u32)>,
}

impl<'a> MatteAreas<'a> {
    /// The areas before the growth of `hypothesis`, whose matte cylinder is `cylinder`.
    pub fn new(
        input: &'a AnalysisInput<'a>,
        hypothesis: HypothesisId,
        cylinder: Cylinder,
        members: &'a Members,
    ) -> Self {
        Self { input, hypothesis, cylinder, members, met: BTreeMap::new() }
    }

    /// Whether a pixel of the area of `other`, whose color lies in the own cylinder, joins without another test. A pixel that joins is
    /// counted.
    pub fn takes_from(&mut self, other: HypothesisId) -> bool {
        let readings = self.input.readings;
        if !(readings.own_cylinder_only || readings.single_matte_cluster) {
            return false;
        }
        let area = self.members.region(other);
        let joins = || {
            let colors = area.iter().map(|pixel| self.input.pixels[pixel as usize]);
            let inside = colors.filter(|&color| self.cylinder.contains(color)).count();
            readings.own_cylinder_only || inside as f64 >= CLUSTER_SHARE * area.len() as f64
        };
        let (joins, taken) = self.met.entry(other).or_insert_with(|| (joins(), 0));
        *taken += u32::from(*joins);
        *joins
    }

    /// Records the areas of which the growth took more than half.
    pub fn record_united<R: Recorder>(&self, recorder: &mut R) {
        for (&other, &(_, taken_px)) in &self.met {
            let area_px = self.members.region(other).len() as u32;
            if R::KEEPS && 2 * taken_px > area_px {
                let into = self.hypothesis;
                recorder.record(MatteAreasUnited { hypothesis: other, into, taken_px, area_px });
            }
        }
    }
}

/// Whether the matte area `area` of hypothesis `id` was united with another region: more than half of its pixels belong to other
/// regions by now. Its hypothesis is not applied any more, because its area is no large area of its own.
pub fn is_united(input: &AnalysisInput, labels: &LabelMap, id: HypothesisId, area: Pixels) -> bool {
    if !(input.readings.own_cylinder_only || input.readings.single_matte_cluster) {
        return false;
    }
    let kept = area.iter().filter(|&pixel| labels[pixel as usize] == id.get()).count();
    2 * kept < area.len()
}
