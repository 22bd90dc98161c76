//! Refinements of the proximity heuristic (section 5.3.2): regions of one object are merged, and pixels in the wrong region
//! are reassigned.
//!
//! `merge_regions`: parts of one object on both sides of a highlight or a crease have the same matte line. Where neither the
//! pixels' distances from the lines nor the angle between the lines differ, the parts become one region.
//! `proximity_vote`: where two cylinders overlap, the noise decides which axis is nearer. A contested pixel therefore follows a
//! clear majority of its 5×5 surroundings (no isolated pixels at σ ≥ 2.5).

use super::borders::near_hypotheses;
use super::input::AnalysisInput;
use super::linear::{Hypothesis, cylinders};
use super::recorded_labels::{Members, Pixels, RecordedLabels};
use crate::color::{Cylinder, Line, Moments, axis_angle_deg};
use crate::raster::{HypothesisId, LabelMap, PixelIndex, UNASSIGNED};
use crate::trace::{Contest, Measure, Recorder, RegionsMerged};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Largest distance between parts of one object, pixels.
const REACH_PX: usize = 3;
/// Largest angle between the matte lines of one object, degrees.
pub const MAX_ANGLE_DEG: f64 = 4.0;
/// Largest ratio of the distances of a region's pixels from the other line and from the region's own line.
const RMS_RATIO: f64 = 1.25;
/// Least distance from the own line that is assumed, σ0.
const RMS_FLOOR: f64 = 0.6;
/// Largest distance along rows and columns of a pixel that takes part in a vote, pixels.
const VOTE_RADIUS: usize = 2;
/// Least number of rows that one task searches for contested pixels.
const ROWS_PER_TASK: usize = 64;
/// Share of the votes that wins a pixel.
const MAJORITY_PERCENT: usize = 60;

/// Merges neighboring hypotheses whose matte lines do not differ, smaller into larger. Returns the hypothesis that the pixels of
/// each hypothesis belong to now, by [`HypothesisId::index`].
pub fn merge_regions<R: Recorder>(
    input: &AnalysisInput,
    hypotheses: &mut [Hypothesis],
    recorded_labels: &mut RecordedLabels<R>,
) -> Vec<HypothesisId> {
    let mut into_of: Vec<HypothesisId> = HypothesisId::all(hypotheses.len()).collect();
    let pairs: Vec<(HypothesisId, HypothesisId)> = near_hypotheses(&recorded_labels.labels, REACH_PX)
        .into_iter()
        .filter(|&(a, b)| {
            let direction = |id: HypothesisId| &hypotheses[id.index()].line.direction;
            axis_angle_deg(direction(a), direction(b)) < MAX_ANGLE_DEG
        })
        .collect();
    if pairs.is_empty() {
        return into_of;
    }
    let members = recorded_labels.members(hypotheses.len());
    let mut clusters: BTreeMap<HypothesisId, Moments> = BTreeMap::new();
    for (a, b) in pairs {
        let (a, b) = (into_of[a.index()], into_of[b.index()]);
        if a == b {
            continue;
        }
        let line = |id: HypothesisId| hypotheses[id.index()].line;
        let mut cluster =
            |id| *clusters.entry(id).or_insert_with(|| matte_cluster(input, &line(id), members.region(id)));
        let angle_deg = axis_angle_deg(&line(a).direction, &line(b).direction);
        if angle_deg >= MAX_ANGLE_DEG {
            continue;
        }
        let (of_a, of_b) = (cluster(a), cluster(b));
        let (into, from) = if of_a.n >= of_b.n { (a, b) } else { (b, a) };
        let from_cluster = if from == a { of_a } else { of_b };
        let Some(rms) = one_line(input, &from_cluster, &line(from), &line(into)) else { continue };
        if R::KEEPS {
            recorded_labels.recorder.record(RegionsMerged { hypothesis: from, into, angle_deg, rms });
        }
        clusters.insert(into, of_a.merged(&of_b));
        let vanished = &mut hypotheses[from.index()];
        vanished.alive = false;
        let mut highlights = std::mem::take(&mut vanished.highlights);
        hypotheses[into.index()].highlights.append(&mut highlights);
        for owner in into_of.iter_mut().filter(|owner| **owner == from) {
            *owner = into;
        }
    }
    reassign(&members, &into_of, recorded_labels);
    into_of
}

/// Root mean square distance of a cluster from the line `other`, counts, if the cluster lies on that line as well as on its
/// `own`; else `None`.
pub fn one_line(input: &AnalysisInput, cluster: &Moments, own: &Line, other: &Line) -> Option<f64> {
    let angle_deg = axis_angle_deg(&own.direction, &other.direction);
    let rms = rms_from(cluster, other);
    let limit = RMS_RATIO * rms_from(cluster, own).max(RMS_FLOOR * input.used.camera_noise);
    (angle_deg < MAX_ANGLE_DEG && rms < limit).then_some(rms)
}

/// Moments of the usable colors of a region inside the cylinder around its line.
pub fn matte_cluster(input: &AnalysisInput, line: &Line, pixels: Pixels) -> Moments {
    let cylinder = Cylinder::new(line, input.used.radius_counts());
    let usable = pixels.iter().map(|pixel| pixel as usize).filter(|&pixel| input.masks.usable(pixel));
    usable.map(|pixel| input.pixels[pixel]).filter(|&color| cylinder.contains(color)).collect()
}

/// Root mean square distance of a cluster from a line, counts; infinite for an empty cluster.
fn rms_from(cluster: &Moments, line: &Line) -> f64 {
    if cluster.n <= 0.0 {
        return f64::INFINITY;
    }
    let spread = cluster.covariance() * ((cluster.n - 1.0).max(0.0) / cluster.n);
    let offset = (cluster.mean() - line.mean).cross(&line.direction).norm_squared();
    let across = spread.trace() - line.direction.dot(&(spread * line.direction));
    (across + offset).max(0.0).sqrt()
}

/// Assigns the pixels of each hypothesis to the hypothesis that `into_of` names.
fn reassign<R: Recorder>(
    members: &Members,
    into_of: &[HypothesisId],
    recorded_labels: &mut RecordedLabels<R>,
) {
    for (own, &into) in HypothesisId::all(into_of.len()).zip(into_of) {
        if into != own {
            for pixel in members.region(own).iter() {
                recorded_labels.assign(pixel as usize, Some(into));
            }
        }
    }
}

/// Assigns contested pixels to the region with the majority of their surroundings, if the pixel's color lies inside the
/// region's cylinder.
pub fn vote<R: Recorder>(
    input: &AnalysisInput,
    hypotheses: &[Hypothesis],
    recorded_labels: &mut RecordedLabels<R>,
) {
    let before = recorded_labels.labels.clone();
    let cylinders = cylinders(input, hypotheses);
    for pixel in contested(&before) {
        let (winner, count, total) = majority(&before, pixel);
        if winner != before[pixel]
            && count * 100 >= total * MAJORITY_PERCENT
            && let Some(winner) = HypothesisId::from_label(winner)
            && let Some(loser) = HypothesisId::from_label(before[pixel])
            && cylinders[winner.index()].contains(input.pixels[pixel])
        {
            if R::KEEPS {
                let (challenger, holder) = (count as f32, total as f32);
                let contest = Contest { measure: Measure::Vote, challenger, holder };
                recorded_labels.recorder.contest(PixelIndex::from_index(pixel), loser, winner, true, contest);
            }
            recorded_labels.assign(pixel, Some(winner));
        }
    }
}

/// Pixels of which a 4-neighbor belongs to another region, ascending.
fn contested(labels: &LabelMap) -> Vec<usize> {
    let rows = (0..labels.height()).into_par_iter().with_min_len(ROWS_PER_TASK);
    let mut found: Vec<usize> = rows.flat_map_iter(|y| contested_at_row(labels, y)).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// The pixels of row `y` and of the row below whose neighbor in row `y`, or above or below across both rows, belongs to another region.
fn contested_at_row(labels: &LabelMap, y: usize) -> Vec<usize> {
    let (width, row) = (labels.width(), labels.row(y));
    let differ = |a: u16, b: u16| a != b && a != UNASSIGNED && b != UNASSIGNED;
    let mut found = Vec::new();
    for (x, pair) in row.windows(2).enumerate() {
        if differ(pair[0], pair[1]) {
            found.extend([y * width + x, y * width + x + 1]);
        }
    }
    if y + 1 < labels.height() {
        for (x, (&own, &below)) in row.iter().zip(labels.row(y + 1)).enumerate() {
            if differ(own, below) {
                found.extend([y * width + x, (y + 1) * width + x]);
            }
        }
    }
    found
}

/// The region with most pixels around a pixel (the smallest number among equals), the number of these pixels, and the number of
/// surrounding pixels of all regions.
fn majority(labels: &LabelMap, pixel: usize) -> (u16, usize, usize) {
    let (width, height) = (labels.width(), labels.height());
    let (x, y) = (pixel % width, pixel / width);
    let mut counts: Vec<(u16, usize)> = Vec::with_capacity(4);
    let mut total = 0;
    for v in y.saturating_sub(VOTE_RADIUS)..(y + VOTE_RADIUS + 1).min(height) {
        for &label in &labels.row(v)[x.saturating_sub(VOTE_RADIUS)..(x + VOTE_RADIUS + 1).min(width)] {
            if label == UNASSIGNED {
                continue;
            }
            total += 1;
            match counts.iter_mut().find(|(id, _)| *id == label) {
                Some((_, count)) => *count += 1,
                None => counts.push((label, 1)),
            }
        }
    }
    let most = counts.into_iter().max_by_key(|&(id, count)| (count, u16::MAX - id));
    most.map_or((labels[pixel], 0, total), |(id, count)| (id, count, total))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Vec3;
    use crate::segment::testing::{Drawing, check, labels};
    use crate::trace::NoopRecorder;

    const RED: [f64; 3] = [0.9, 0.3, 0.2];
    const GREEN: [f64; 3] = [0.2, 0.9, 0.3];

    /// Red and green at 100 counts, and `o`range between them.
    fn drawing(rows: &[&str]) -> Drawing {
        Drawing::new(rows, |c| {
            let axis = match c {
                'r' => Vec3::from(RED),
                'g' => Vec3::from(GREEN),
                _ => Vec3::from(RED) + Vec3::from(GREEN),
            };
            axis.normalize() * 100.0
        })
    }

    fn hypotheses(axes: &[[f64; 3]]) -> Vec<Hypothesis> {
        let line = |axis: &[f64; 3]| Line::new(Vec3::from(*axis) * 100.0, Vec3::from(*axis));
        axes.iter().map(|axis| Hypothesis { line: line(axis), alive: true, highlights: Vec::new() }).collect()
    }

    #[test]
    fn a_contested_pixel_follows_a_clear_majority_whose_cylinder_contains_its_color() {
        let silent = &mut NoopRecorder;
        let isolated = ["11111", "11211", "11111"];
        let mut recorded_labels = RecordedLabels::new(labels(&isolated), silent);
        vote(&drawing(&["rrrrr"; 3]).input(), &hypotheses(&[RED, RED]), &mut recorded_labels);
        check(&recorded_labels.labels, &["11111"; 3]);
        let mut recorded_labels = RecordedLabels::new(labels(&isolated), silent);
        vote(
            &drawing(&["rrrrr", "rrgrr", "rrrrr"]).input(),
            &hypotheses(&[RED, GREEN]),
            &mut recorded_labels,
        );
        check(&recorded_labels.labels, &isolated);
    }

    #[test]
    fn half_of_the_surroundings_are_no_majority() {
        let halves = ["111222"; 5];
        let silent = &mut NoopRecorder;
        let mut recorded_labels = RecordedLabels::new(labels(&halves), silent);
        vote(&drawing(&["rrrrrr"; 5]).input(), &hypotheses(&[RED, RED]), &mut recorded_labels);
        check(&recorded_labels.labels, &halves);
    }

    #[test]
    fn near_parts_with_one_line_unite_into_the_larger() {
        let silent = &mut NoopRecorder;
        let mut recorded_labels = RecordedLabels::new(labels(&["11..2222....3", "11..2222....3"]), silent);
        let mut found = hypotheses(&[RED, RED, RED]);
        let into = merge_regions(&drawing(&["rr..rrrr....r"; 2]).input(), &mut found, &mut recorded_labels);
        check(&recorded_labels.labels, &["22..2222....3", "22..2222....3"]);
        assert_eq!(into.iter().map(|id| id.get()).collect::<Vec<_>>(), [2, 2, 3]);
        assert_eq!(found.iter().map(|h| h.alive).collect::<Vec<_>>(), [false, true, true]);
    }

    #[test]
    fn other_directions_stay_apart() {
        let silent = &mut NoopRecorder;
        let mut recorded_labels = RecordedLabels::new(labels(&["1122"; 2]), silent);
        let mut found = hypotheses(&[RED, GREEN]);
        merge_regions(&drawing(&["rrgg"; 2]).input(), &mut found, &mut recorded_labels);
        check(&recorded_labels.labels, &["1122"; 2]);
    }
}
