//! From labels to final regions: regions that are too small are dropped, separate parts become regions, and regions are
//! numbered by size.
//!
//! `split_components`: two separate parts of a region are two objects of one color if background lies between them, and one
//! object if another region lies between them (a cup behind its handle stays one region). A shadow is dark like background:
//! two parts at a distance below the size of the smaller part are taken for one object with a shadow across it, and two parts
//! at a distance above twice that size for two objects. Separate regions of one matte line are joined by the same rule
//! (`merge_regions`).

use super::input::AnalysisInput;
use super::light::LightFindings;
use super::planar_hypothesis::{PlanarHypothesis, PlanarRegions};
use super::recorded_labels::{Members, Pixels, RecordedLabels};
use super::unite::{MAX_ANGLE_DEG, matte_cluster, one_line};
use crate::color::{Moments, axis_angle_deg};
use crate::raster::{HypothesisId, LabelMap, Mask, RegionId, UNASSIGNED};
use crate::trace::{ComponentSplit, Dropped, Pass, Recorder, RegionsMerged, Renumbered};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Fewest pixels of a region and of a part that becomes a region. A smaller region is dropped, except under the reading
/// `small_regions`; a smaller part stays in its region.
const MIN_REGION_PX: usize = 60;
/// Largest distance along rows or columns between pixels of one part, pixels.
const APART_PX: usize = 4;
/// Widest shadow across an object, as a share of the picture's diagonal.
const MAX_SHADOW: f64 = 0.045;
/// Widest occluder in front of an object, as a share of the picture's diagonal.
const MAX_OCCLUDER: f64 = 0.12;
/// Largest number of border pixels of a part from which the distance between two parts is measured.
const BORDER_SAMPLES: usize = 300;

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

/// The parts of a region in an image `width` pixels wide: groups of pixels between which the distance along rows or along columns is
/// larger than [`APART_PX`]. An empty list where the region is one part.
pub fn parts(width: usize, pixels: Pixels) -> Vec<Vec<u32>> {
    let runs = pixels.runs();
    let reach = APART_PX as u32;
    let row = |run: (u32, u32)| run.0 / width as u32;
    let column = |run: (u32, u32)| run.0 % width as u32;
    let mut parent: Vec<usize> = (0..runs.len()).collect();
    // Runs are row-major: all runs within reach above a run have an index of at least `above`.
    let mut above = 0;
    for i in 0..runs.len() {
        while row(runs[above]) + reach < row(runs[i]) {
            above += 1;
        }
        let (left, right) = (column(runs[i]), column(runs[i]) + runs[i].1);
        for (j, &run) in runs.iter().enumerate().take(i).skip(above) {
            let other = (column(run), column(run) + run.1);
            if other.0 < right + reach && left < other.1 + reach {
                let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    if (0..runs.len()).all(|i| root(&mut parent, i) == 0) {
        return Vec::new();
    }
    let mut parts: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    for (i, &(first, length)) in runs.iter().enumerate() {
        parts.entry(root(&mut parent, i)).or_default().extend(first..first + length);
    }
    parts.into_values().collect()
}

/// The root of a set in a disjoint-set forest; shortens the path to it.
fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}

/// The outline of a part of a region.
struct Outline {
    /// Number of pixels of the part.
    size: usize,
    /// First and last column of the part.
    columns: [i64; 2],
    /// First and last row of the part.
    rows: [i64; 2],
    /// Column and row of border pixels, evenly chosen.
    border: Vec<(i64, i64)>,
}

impl Outline {
    /// The outline of `pixels`, which belong to one region of `labels`.
    fn new(labels: &LabelMap, pixels: impl Iterator<Item = u32>) -> Self {
        let width = labels.width();
        let mut outline =
            Self { size: 0, columns: [i64::MAX, i64::MIN], rows: [i64::MAX, i64::MIN], border: Vec::new() };
        for pixel in pixels {
            let own = labels[pixel as usize];
            let (x, y) = ((pixel as usize % width) as i64, (pixel as usize / width) as i64);
            outline.size += 1;
            outline.columns = [outline.columns[0].min(x), outline.columns[1].max(x)];
            outline.rows = [outline.rows[0].min(y), outline.rows[1].max(y)];
            let mut edge = false;
            labels.for_each_neighbor(pixel as usize, |near| edge |= labels[near] != own);
            if edge {
                outline.border.push((x, y));
            }
        }
        let step = outline.border.len().div_ceil(BORDER_SAMPLES).max(1);
        outline.border = outline.border.into_iter().step_by(step).collect();
        outline
    }

    /// Distance between the bounding boxes of two parts, pixels: a lower bound of the distance between the parts.
    fn least_gap_px(&self, other: &Self) -> f64 {
        let gap = |a: [i64; 2], b: [i64; 2]| (a[0] - b[1]).max(b[0] - a[1]).max(0);
        (gap(self.columns, other.columns) as f64).hypot(gap(self.rows, other.rows) as f64)
    }
}

/// Whether two parts are one object: their distance is small compared with their sizes, or most pixels between them belong to
/// other regions, those of an object in front.
fn same_object(labels: &LabelMap, one: &Outline, other: &Outline) -> bool {
    let width = labels.width();
    let size_px = (one.size.min(other.size) as f64).sqrt();
    let diagonal_px = (width as f64).hypot(labels.height() as f64);
    let largest_gap_px = (2.0 * size_px).min(MAX_OCCLUDER * diagonal_px);
    if one.least_gap_px(other) > largest_gap_px {
        return false;
    }
    let closest = one
        .border
        .iter()
        .flat_map(|&a| other.border.iter().map(move |&b| (a, b)))
        .min_by_key(|(a, b)| (a.0 - b.0).pow(2) + (a.1 - b.1).pow(2));
    let Some((a, b)) = closest else { return false };
    let gap_px = ((a.0 - b.0) as f64).hypot((a.1 - b.1) as f64);
    if gap_px < size_px.min(MAX_SHADOW * diagonal_px) {
        return true;
    }
    if gap_px > largest_gap_px {
        return false;
    }
    let steps = (a.0 - b.0).abs().max((a.1 - b.1).abs()).max(1);
    let between = (1..steps).map(|i| {
        let at = |from: i64, to: i64| (from + (to - from) * i / steps) as usize;
        labels[at(a.1, b.1) * width + at(a.0, b.0)]
    });
    let (assigned, total) =
        between.fold((0, 0), |(assigned, total), l| (assigned + i64::from(l != UNASSIGNED), total + 1));
    assigned * 2 > total
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
    use crate::raster::Raster;
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
    fn the_distance_between_parts_is_the_same_along_rows_and_columns() {
        let count = |rectangles: [[usize; 4]; 2], turned: bool| {
            let width = 40;
            let mut labels = LabelMap::filled(width, width, UNASSIGNED);
            for [left, top, columns, rows] in rectangles {
                for (x, y) in (left..left + columns).flat_map(|x| (top..top + rows).map(move |y| (x, y))) {
                    let pixel = if turned { x * width + y } else { y * width + x };
                    labels[pixel] = 1;
                }
            }
            parts(width, Members::of(&labels, 1).region(RegionId::from_index(0))).len()
        };
        for turned in [false, true] {
            assert_eq!(
                count([[2, 3, 10, 8], [15, 3, 9, 8]], turned),
                0,
                "4 pixels from one to the next: one part"
            );
            assert_eq!(count([[2, 3, 10, 8], [16, 3, 9, 8]], turned), 2, "5 pixels from one to the next");
        }
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
