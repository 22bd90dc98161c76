//! From labels to final regions: what is too small goes, what lies apart is separated, numbers are given by size.
//!
//! `split_components`: two parts of a region that lie apart are two objects of one colour when background lies between
//! them, and one object behind another when the other's pixels do (a cup seen through a handle stays one). Shadow is dark
//! like background; a part that lies nearer than its own size is taken to lie behind a shadow.

use super::ledger::{Ledger, Members, Pixels};
use super::planar::{PlanarHypothesis, PlanarRegions};
use super::scene::Scene;
use crate::raster::{LabelMap, UNASSIGNED};
use crate::trace::{Event, Recorder};
use std::collections::BTreeMap;

/// Regions and separated parts below this many pixels are dropped, or stay with their region.
const MIN_REGION_PX: usize = 60;
/// Parts of a region at most this far apart are one part, pixels.
const APART_PX: usize = 4;
/// Widest shadow that may part an object, pixels.
const MAX_SHADOW_PX: f64 = 30.0;
/// Border pixels looked at when the gap between two parts is judged.
const BORDER_SAMPLES: usize = 300;

/// The final regions.
#[derive(Clone, Debug, PartialEq)]
pub struct FinalRegions {
    /// Region of each pixel, numbered from 1 by decreasing size.
    pub labels: LabelMap,
    /// Region `id` at index `id − 1`.
    pub hypotheses: Vec<PlanarHypothesis>,
}

/// Drops, separates and numbers the regions.
pub fn final_regions<R: Recorder>(
    scene: &Scene,
    labels: LabelMap,
    planar: &PlanarRegions,
    recorder: &mut R,
) -> FinalRegions {
    let mut hypotheses = planar.hypotheses.clone();
    let mut ledger = Ledger::new(labels, recorder);
    if scene.refine.split_components {
        let members = ledger.members(hypotheses.len());
        for id in 1..=hypotheses.len() as u16 {
            separate(id, members.region(id), &mut hypotheses, &mut ledger);
        }
    }
    let members = ledger.members(hypotheses.len());
    let mut order: Vec<u16> = (1..=hypotheses.len() as u16).collect();
    order.sort_by_key(|&id| std::cmp::Reverse(members.region(id).len()));
    let mut finals = vec![UNASSIGNED; hypotheses.len()];
    let mut kept = Vec::new();
    for id in order {
        let pixels = members.region(id);
        if pixels.len() >= MIN_REGION_PX {
            kept.push(hypotheses[usize::from(id) - 1]);
            finals[usize::from(id) - 1] = kept.len() as u16;
        } else if !pixels.is_empty() {
            if R::KEEPS {
                ledger.recorder.record(Event::Dropped { region: id, pixels: pixels.len() as u32 });
            }
            for pixel in pixels.iter() {
                ledger.assign(pixel as usize, UNASSIGNED);
            }
        }
    }
    let mut labels = ledger.labels;
    for label in labels.as_mut_slice().iter_mut().filter(|label| **label != UNASSIGNED) {
        *label = finals[usize::from(*label) - 1];
    }
    if R::KEEPS {
        recorder.record(Event::Renumbered { finals });
    }
    FinalRegions { labels, hypotheses: kept }
}

/// Gives the parts of a region that are objects of their own new numbers.
fn separate<R: Recorder>(
    id: u16,
    pixels: Pixels,
    hypotheses: &mut Vec<PlanarHypothesis>,
    ledger: &mut Ledger<R>,
) {
    let mut parts = parts(ledger.labels.width(), pixels);
    if parts.len() < 2 {
        return;
    }
    parts.sort_by_key(|part| std::cmp::Reverse(part.len()));
    // Parts that belong together, the largest of each group first.
    let mut groups: Vec<Vec<Vec<u32>>> = Vec::new();
    for part in parts {
        let home = groups.iter().position(|group| {
            part.len() < MIN_REGION_PX
                || group.iter().any(|other| same_object(&ledger.labels, other, &part, id))
        });
        match home {
            Some(home) => groups[home].push(part),
            None => groups.push(vec![part]),
        }
    }
    for group in groups.into_iter().skip(1) {
        if hypotheses.len() >= usize::from(u16::MAX) {
            return;
        }
        hypotheses.push(hypotheses[usize::from(id) - 1]);
        let part = hypotheses.len() as u16;
        if R::KEEPS {
            let pixels = group.iter().map(Vec::len).sum::<usize>() as u32;
            ledger.recorder.record(Event::ComponentSplit { region: id, part, pixels });
        }
        for pixel in group.into_iter().flatten() {
            ledger.assign(pixel as usize, part);
        }
    }
}

/// Groups of a region's pixels of which each is more than [`APART_PX`] from the next along rows or columns.
fn parts(width: usize, pixels: Pixels) -> Vec<Vec<u32>> {
    let runs = pixels.runs();
    let reach = APART_PX as u32;
    let row = |run: (u32, u32)| run.0 / width as u32;
    let column = |run: (u32, u32)| run.0 % width as u32;
    let mut parent: Vec<usize> = (0..runs.len()).collect();
    // Runs are row-major, so everything within reach above a run lies from `above` on.
    let mut above = 0;
    for i in 0..runs.len() {
        while row(runs[above]) + reach < row(runs[i]) {
            above += 1;
        }
        let (left, right) = (column(runs[i]), column(runs[i]) + runs[i].1);
        for (j, &run) in runs.iter().enumerate().take(i).skip(above) {
            let other = (column(run), column(run) + run.1);
            if other.0 <= right + reach && left <= other.1 + reach {
                let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    let mut parts: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    for (i, &(first, length)) in runs.iter().enumerate() {
        parts.entry(root(&mut parent, i)).or_default().extend(first..first + length);
    }
    parts.into_values().collect()
}

fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}

/// Whether two parts are one object: near one another for their size, or parted mostly by other regions, by an object in
/// front.
fn same_object(labels: &LabelMap, one: &[u32], other: &[u32], id: u16) -> bool {
    let width = labels.width();
    let border = |part: &[u32]| -> Vec<(i64, i64)> {
        let mut found = Vec::new();
        for &pixel in part {
            let mut edge = false;
            labels.for_each_neighbour(pixel as usize, |near| edge |= labels[near] != id);
            if edge {
                found.push(((pixel as usize % width) as i64, (pixel as usize / width) as i64));
            }
        }
        let step = found.len().div_ceil(BORDER_SAMPLES).max(1);
        found.into_iter().step_by(step).collect()
    };
    let far = border(other);
    let closest = border(one)
        .into_iter()
        .flat_map(|a| far.iter().map(move |&b| (a, b)))
        .min_by_key(|(a, b)| (a.0 - b.0).pow(2) + (a.1 - b.1).pow(2));
    let Some((a, b)) = closest else { return false };
    let gap_px = ((a.0 - b.0).pow(2) + (a.1 - b.1).pow(2)) as f64;
    let size_px = (one.len().min(other.len()) as f64).sqrt();
    if gap_px.sqrt() < size_px.min(MAX_SHADOW_PX) {
        return true;
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

/// Which regions touch each region: ascending lists, region `id` at index `id − 1`.
pub fn neighbours(labels: &LabelMap, regions: usize) -> Vec<Vec<u16>> {
    let mut lists = vec![Vec::new(); regions];
    for (a, b) in super::borders::near_pairs(labels, 1) {
        lists[usize::from(a) - 1].push(b);
        lists[usize::from(b) - 1].push(a);
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
    use crate::trace::Silent;

    /// Numbers and drops the regions of a picture 90 pixels wide and 20 high, given as rectangles: left, top, width, height,
    /// region. Returns the final region of each rectangle.
    fn finals(rectangles: &[[usize; 5]]) -> Vec<u16> {
        let mut labels: LabelMap = Raster::filled(90, 20, UNASSIGNED);
        for &[left, top, width, height, region] in rectangles {
            for pixel in (top..top + height).flat_map(|y| y * 90 + left..y * 90 + left + width) {
                labels[pixel] = region as u16;
            }
        }
        let line = Line::new(Vec3::repeat(50.0), Vec3::repeat(1.0));
        let hypothesis = PlanarHypothesis {
            matte: line,
            matte_length: 90.0,
            plane: None,
            start: line.mean,
            highlight: None,
            alive: true,
        };
        let regions = rectangles.iter().map(|r| r[4]).max().unwrap_or(0);
        let planar =
            PlanarRegions { labels: labels.clone(), hypotheses: vec![hypothesis; regions], illuminant: None };
        let drawing = Drawing::new(&["."], |_| Vec3::zeros());
        let found = final_regions(&drawing.scene(), labels, &planar, &mut Silent);
        rectangles.iter().map(|&[left, top, ..]| found.labels[top * 90 + left]).collect()
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
    fn parts_behind_another_object_are_one() {
        let in_front = [13, 0, 26, 20, 2];
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [40, 0, 10, 10, 1], in_front]), [2, 2, 1]);
    }

    #[test]
    fn parts_across_a_shadow_are_one_and_crumbs_stay() {
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [19, 0, 10, 10, 1]]), [1, 1], "7 px apart, 10 px in size");
        assert_eq!(finals(&[[0, 0, 12, 12, 1], [60, 0, 5, 5, 1]]), [1, 1], "25 px are no object");
    }
}
