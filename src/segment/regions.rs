//! From labels to final regions: regions that are too small are dropped, separate parts become regions, and regions are
//! numbered by size.
//!
//! `split_components`: the separate parts of a region become regions where they are objects of their own by the rule of `object_parts`.
//! Separate regions of one matte line are joined by the same rule (`merge_regions`).

use super::input::AnalysisInput;
use super::light::LightFindings;
use super::object_parts::{Outline, parts, same_object};
use super::planar_hypothesis::{PlanarHypothesis, PlanarRegions};
use super::recorded_labels::{Members, Pixels, RecordedLabels};
use super::unite::{MAX_ANGLE_DEG, matte_cluster, one_line};
use crate::color::{Moments, axis_angle_deg};
use crate::raster::{HypothesisId, LabelMap, Mask, RegionId};
use crate::trace::{ComponentSplit, Dropped, Pass, Recorder, RegionsMerged, Renumbered};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Fewest pixels of a region and of a part that becomes a region. A smaller region is dropped, except under the reading
/// `small_regions`; a smaller part stays in its region.
const MIN_REGION_PX: usize = 60;

/// The final regions.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FinalRegions {
    /// Region of each pixel, numbered from 1 by decreasing size.
    pub labels: LabelMap,
    /// Hypothesis of region `id` at index `id − 1`. Separate parts of one linear hypothesis have the same
    /// [`origin`](PlanarHypothesis::origin).
    pub hypotheses: Vec<PlanarHypothesis>,
    /// Both estimates of the light, and the evidence for each.
    pub light: LightFindings,
    /// The pixels that the second lamp lights; `None` with one lamp.
    pub second_lamp_mask: Option<Arc<Mask>>,
}

/// Joins, separates, drops and numbers the regions of `labels`, whose hypotheses are those of `planar`.
pub fn final_regions<R: Recorder>(
    input: &AnalysisInput,
    labels: LabelMap,
    planar: &PlanarRegions,
    recorder: &mut R,
) -> FinalRegions {
    let mut hypotheses = planar.hypotheses.clone();
    let mut recorded_labels = RecordedLabels::new(labels, recorder);
    if input.refine.merge_regions {
        recorded_labels.begin(Pass::Joining);
        join_across(input, &hypotheses, &mut recorded_labels);
    }
    if input.refine.split_components {
        recorded_labels.begin(Pass::Separating);
        let members = recorded_labels.members(hypotheses.len());
        for id in HypothesisId::all(hypotheses.len()) {
            if input.stopped() {
                break;
            }
            separate(id, members.region(id), &mut hypotheses, &mut recorded_labels);
        }
    }
    recorded_labels.begin(Pass::Numbering);
    let members = recorded_labels.members(hypotheses.len());
    let mut order: Vec<HypothesisId> = HypothesisId::all(hypotheses.len()).collect();
    order.sort_by_key(|&id| std::cmp::Reverse(members.region(id).len()));
    let mut region_of: Vec<Option<RegionId>> = vec![None; hypotheses.len()];
    let mut kept = Vec::new();
    for id in order {
        let pixels = members.region(id);
        let least_px = if input.readings.small_regions { 1 } else { MIN_REGION_PX };
        if pixels.len() >= least_px {
            region_of[id.index()] = Some(RegionId::from_index(kept.len()));
            kept.push(hypotheses[id.index()]);
        } else if !pixels.is_empty() {
            if R::KEEPS {
                recorded_labels.recorder.record(Dropped { hypothesis: id, pixels: pixels.len() as u32 });
            }
            for pixel in pixels.iter() {
                recorded_labels.assign(pixel as usize, None);
            }
        }
    }
    let mut labels = recorded_labels.labels;
    for label in labels.as_mut_slice() {
        let region = HypothesisId::from_label(*label).and_then(|hypothesis| region_of[hypothesis.index()]);
        *label = RegionId::label(region);
    }
    if R::KEEPS {
        recorder.record(Renumbered { regions: region_of.into() });
    }
    FinalRegions {
        labels,
        hypotheses: kept,
        light: planar.light,
        second_lamp_mask: planar.second_lamp_mask.clone(),
    }
}

/// Joins regions of one matte line that an occluder or a shadow divides, smaller into larger.
fn join_across<R: Recorder>(
    input: &AnalysisInput,
    hypotheses: &[PlanarHypothesis],
    recorded_labels: &mut RecordedLabels<R>,
) {
    let members = recorded_labels.members(hypotheses.len());
    let mut order: Vec<HypothesisId> =
        HypothesisId::all(hypotheses.len()).filter(|&id| members.region(id).len() >= MIN_REGION_PX).collect();
    order.sort_by_key(|&id| std::cmp::Reverse(members.region(id).len()));
    let line = |id: HypothesisId| &hypotheses[id.index()].matte;
    let mut outlines: BTreeMap<HypothesisId, Outline> = BTreeMap::new();
    let mut clusters: BTreeMap<HypothesisId, Moments> = BTreeMap::new();
    let mut into_of: Vec<HypothesisId> = HypothesisId::all(hypotheses.len()).collect();
    for (i, &into) in order.iter().enumerate() {
        if input.stopped() {
            break;
        }
        for &from in &order[i + 1..] {
            let unjoined = into_of[from.index()] == from && into_of[into.index()] == into;
            let angle_deg = axis_angle_deg(&line(from).direction, &line(into).direction);
            if !unjoined || angle_deg >= MAX_ANGLE_DEG {
                continue;
            }
            for id in [from, into] {
                outlines
                    .entry(id)
                    .or_insert_with(|| Outline::new(&recorded_labels.labels, members.region(id).iter()));
            }
            if !same_object(&recorded_labels.labels, &outlines[&into], &outlines[&from]) {
                continue;
            }
            let cluster = clusters
                .entry(from)
                .or_insert_with(|| matte_cluster(input, line(from), members.region(from)));
            if let Some(rms) = one_line(input, cluster, line(from), line(into)) {
                into_of[from.index()] = into;
                if R::KEEPS {
                    recorded_labels.recorder.record(RegionsMerged { hypothesis: from, into, angle_deg, rms });
                }
            }
        }
    }
    for &from in order.iter().filter(|&&from| into_of[from.index()] != from) {
        for pixel in members.region(from).iter() {
            recorded_labels.assign(pixel as usize, Some(into_of[from.index()]));
        }
    }
}

/// Makes regions of the parts of region `id` that are separate objects, with new numbers at the end of `hypotheses`.
fn separate<R: Recorder>(
    id: HypothesisId,
    pixels: Pixels,
    hypotheses: &mut Vec<PlanarHypothesis>,
    recorded_labels: &mut RecordedLabels<R>,
) {
    let mut parts = parts(recorded_labels.labels.width(), pixels);
    parts.sort_by_key(|part| std::cmp::Reverse(part.len()));
    // Groups of parts of one object; the largest part of each group is the first.
    let mut groups: Vec<Vec<Vec<u32>>> = Vec::new();
    let mut outlines: Vec<Vec<Outline>> = Vec::new();
    for part in parts {
        let labels = &recorded_labels.labels;
        let outline = Outline::new(labels, part.iter().copied());
        let is_small = part.len() < MIN_REGION_PX;
        let is_of_group =
            |group: &Vec<Outline>| is_small || group.iter().any(|other| same_object(labels, other, &outline));
        if let Some(group) = outlines.iter().position(is_of_group) {
            groups[group].push(part);
            outlines[group].push(outline);
        } else {
            groups.push(vec![part]);
            outlines.push(vec![outline]);
        }
    }
    for group in groups.into_iter().skip(1) {
        if hypotheses.len() >= HypothesisId::MOST {
            return;
        }
        let part = HypothesisId::from_index(hypotheses.len());
        hypotheses.push(hypotheses[id.index()]);
        if R::KEEPS {
            let pixels = group.iter().map(Vec::len).sum::<usize>() as u32;
            recorded_labels.recorder.record(ComponentSplit { hypothesis: id, part, pixels });
        }
        for pixel in group.into_iter().flatten() {
            recorded_labels.assign(pixel as usize, Some(part));
        }
    }
}

/// The regions that touch each region, in ascending order; the list of a region is at [`RegionId::index`].
pub fn neighbors(labels: &LabelMap, regions: usize) -> Vec<Vec<RegionId>> {
    let mut lists = vec![Vec::new(); regions];
    for (a, b) in super::borders::near_pairs(labels, 1) {
        if let (Some(a), Some(b)) = (RegionId::from_label(a), RegionId::from_label(b)) {
            lists[a.index()].push(b);
            lists[b.index()].push(a);
        }
    }
    for list in &mut lists {
        list.sort_unstable();
    }
    lists
}

/// The pixels of each final region.
pub fn members(regions: &FinalRegions) -> Members {
    Members::of(&regions.labels, regions.hypotheses.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Line, Vec3};
    use crate::raster::{Raster, UNASSIGNED};
    use crate::segment::testing::Drawing;
    use crate::trace::NoopRecorder;

    const SIZE_PX: [usize; 2] = [360, 60];

    /// Makes final regions of a picture of [`SIZE_PX`], whose regions are given as rectangles: left, top, width, height, region.
    /// Each region has a matte line of its own. Returns the final region of each rectangle.
    fn finals(rectangles: &[[usize; 5]]) -> Vec<u16> {
        let mut labels: LabelMap = Raster::filled(SIZE_PX[0], SIZE_PX[1], UNASSIGNED);
        for &[left, top, width, height, region] in rectangles {
            for y in top..top + height {
                labels.as_mut_slice()[y * SIZE_PX[0]..][left..left + width].fill(region as u16);
            }
        }
        let lines = [Vec3::new(1.0, 0.2, 0.2), Vec3::new(0.2, 1.0, 0.2), Vec3::new(0.2, 0.2, 1.0)];
        let hypothesis = |(origin, direction): (HypothesisId, &Vec3)| PlanarHypothesis {
            origin,
            matte: Line::new(direction * 50.0, *direction),
            matte_length: 90.0,
            plane: None,
            start: direction * 50.0,
            highlight: None,
            alive: true,
        };
        let planar = PlanarRegions {
            labels: labels.clone(),
            hypotheses: HypothesisId::all(lines.len()).zip(&lines).map(hypothesis).collect(),
            illuminant: None,
            light: LightFindings::default(),
            second_lamp_mask: None,
        };
        let row = ".".repeat(SIZE_PX[0]);
        let drawing = Drawing::new(&[row.as_str(); SIZE_PX[1]], |_| Vec3::zeros());
        let found = final_regions(&drawing.input(), labels, &planar, &mut NoopRecorder);
        rectangles.iter().map(|&[left, top, ..]| found.labels[top * SIZE_PX[0] + left]).collect()
    }

    #[test]
    fn numbers_go_by_size_and_what_is_too_small_goes() {
        assert_eq!(finals(&[[0, 0, 10, 9, 1], [20, 0, 20, 10, 2], [50, 0, 7, 8, 3]]), [2, 1, 0]);
    }

    #[test]
    fn parts_with_background_between_them_are_objects_of_their_own() {
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [40, 0, 10, 10, 1]]), [1, 2]);
    }

    #[test]
    fn parts_behind_another_object_are_one_unless_far_for_their_size() {
        let in_front = [13, 0, 14, 20, 2];
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [28, 0, 10, 10, 1], in_front]), [2, 2, 1]);
        let wide = [13, 0, 26, 20, 2];
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [40, 0, 10, 10, 1], wide]), [2, 3, 1]);
    }

    #[test]
    fn parts_across_a_shadow_are_one_and_crumbs_stay() {
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [19, 0, 10, 10, 1]]), [1, 1], "7 px apart, 10 px in size");
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [60, 0, 5, 5, 1]]), [1, 1], "25 px are no object");
    }
}
