//! Section 5.5: colors that clipping and blooming have moved out of the slices.
//!
//! Their color cannot be used, so position is: from highlight pixels (nearer to the highlight line than to the matte line)
//! a region grows into unassigned neighbors that are brighter than the meeting point of both lines. Then holes are
//! filled: clipped components that a region nearly surrounds, and unassigned ones that lie wholly inside it.

use super::input::AnalysisInput;
use super::planar::PlanarRegions;
use super::recorded_labels::RecordedLabels;
use crate::color::dot;
use crate::raster::{LabelMap, Mask, Raster, UNASSIGNED};
use crate::trace::{GrowthBegan, HoleFilled, Pass, Recorder};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A clipped component joins the region that holds this share of its assigned border.
const SURROUNDED: f64 = 0.7;

/// Grows the planar regions into what clipping and blooming have distorted.
pub fn clipping_regions<R: Recorder>(
    input: &AnalysisInput,
    planar: &PlanarRegions,
    recorder: &mut R,
) -> LabelMap {
    let mut recorded_labels = RecordedLabels::new(planar.labels.clone(), recorder);
    recorded_labels.begin(Pass::Brightness);
    let members = recorded_labels.members(planar.hypotheses.len());
    let fronts: Vec<Vec<u32>> = planar
        .hypotheses
        .par_iter()
        .enumerate()
        .map(|(index, hypothesis)| {
            let Some(highlight) = hypothesis.highlight_test() else { return Vec::new() };
            let is_highlight = |&pixel: &u32| highlight.is_highlight(input.pixels[pixel as usize]);
            members.region(index as u16 + 1).iter().filter(is_highlight).collect()
        })
        .collect();
    for ((id, hypothesis), mut front) in (1..).zip(&planar.hypotheses).zip(fronts) {
        if input.stopped() {
            return recorded_labels.labels;
        }
        let start2 = hypothesis.start.norm_squared() as f32;
        if R::KEEPS && !front.is_empty() {
            recorded_labels.recorder.record(GrowthBegan { region: id, limit: start2.sqrt() });
        }
        recorded_labels.grow(
            id,
            &mut front,
            || input.stopped(),
            |_, pixel, holder| {
                let color = input.pixels[pixel];
                holder == UNASSIGNED && !input.masks.dark(pixel) && dot(color, color) > start2
            },
        );
    }
    recorded_labels.begin(Pass::ClippedHoles);
    let clipped = |pixel: usize| input.masks.distorted(pixel) && !input.masks.dark(pixel);
    fill(&mut recorded_labels, clipped, |_, share| share >= SURROUNDED);
    if input.stopped() {
        return recorded_labels.labels;
    }
    recorded_labels.begin(Pass::SmallHoles);
    let largest_px = input.used.min_area as usize;
    let lit = |pixel: usize| !input.masks.dark(pixel);
    fill(&mut recorded_labels, lit, |hole, share| {
        !hole.open && share >= 1.0 && hole.pixels.len() <= largest_px
    });
    recorded_labels.labels
}

/// A component of unassigned pixels, and who holds its border.
#[derive(Default)]
struct Hole {
    pixels: Vec<u32>,
    /// Border pixels that each region holds, counted once per side.
    border: BTreeMap<u16, usize>,
    /// Whether something that is no region borders it.
    open: bool,
}

impl Hole {
    /// The region that holds most of the border, and its share of the assigned border.
    fn holder(&self) -> Option<(u16, f64)> {
        let total: usize = self.border.values().sum();
        let (&region, &most) = self.border.iter().max_by_key(|&(&id, &n)| (n, u16::MAX - id))?;
        Some((region, most as f64 / total as f64))
    }
}

/// Gives components of unassigned pixels for which `member` holds to the region with most of their border, where `fits`
/// accepts the hole and that share.
fn fill<R: Recorder>(
    recorded_labels: &mut RecordedLabels<R>,
    member: impl Fn(usize) -> bool,
    fits: impl Fn(&Hole, f64) -> bool,
) {
    let mut seen: Mask =
        Raster::filled(recorded_labels.labels.width(), recorded_labels.labels.height(), false);
    for start in 0..seen.len() {
        if recorded_labels.labels[start] != UNASSIGNED || seen[start] || !member(start) {
            continue;
        }
        let hole = hole_at(start, &recorded_labels.labels, &member, &mut seen);
        let Some((region, border_share)) = hole.holder().filter(|&(_, share)| fits(&hole, share)) else {
            continue;
        };
        if R::KEEPS {
            let (pixel, pixels) = (start as u32, hole.pixels.len() as u32);
            recorded_labels.recorder.record(HoleFilled { region, pixel, pixels, border_share });
        }
        for pixel in hole.pixels {
            recorded_labels.assign(pixel as usize, region);
        }
    }
}

/// The component of unassigned members around `start`.
fn hole_at(start: usize, labels: &LabelMap, member: impl Fn(usize) -> bool, seen: &mut Mask) -> Hole {
    let (width, height) = (labels.width(), labels.height());
    let mut hole = Hole { pixels: vec![start as u32], ..Hole::default() };
    seen[start] = true;
    let mut next = 0;
    while let Some(&pixel) = hole.pixels.get(next) {
        next += 1;
        let (x, y) = (pixel as usize % width, pixel as usize / width);
        hole.open |= x == 0 || y == 0 || x + 1 == width || y + 1 == height;
        labels.for_each_neighbor(pixel as usize, |near| {
            if labels[near] != UNASSIGNED {
                *hole.border.entry(labels[near]).or_default() += 1;
            } else if !member(near) {
                hole.open = true;
            } else if !seen[near] {
                seen[near] = true;
                hole.pixels.push(near as u32);
            }
        });
    }
    hole
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Line, Vec3};
    use crate::reflection::DichromaticPlane;
    use crate::segment::testing::{Drawing, check, labels};
    use crate::segment::{LightFindings, PlanarHypothesis};
    use crate::trace::NoopRecorder;

    fn body() -> Vec3 {
        Vec3::new(0.9, 0.3, 0.2).normalize()
    }

    /// `m`atte, `h`ighlight, `w`hite and clipped, `d`im and of another color.
    fn drawing(rows: &[&str]) -> Drawing {
        Drawing::new(rows, |c| match c {
            'm' => body() * 120.0,
            'h' => body() * 130.0 + Vec3::repeat(60.0),
            'w' => Vec3::repeat(255.0),
            _ => Vec3::new(20.0, 60.0, 40.0),
        })
    }

    /// Regions whose highlight line leaves the matte line at 120 counts, or that have no plane.
    fn fill_in(drawing: &Drawing, before: &[&str], with_plane: bool, after: &[&str]) {
        let matte = Line::new(body() * 80.0, body());
        let hypothesis = PlanarHypothesis {
            origin: 1,
            matte,
            matte_length: 150.0,
            plane: DichromaticPlane::new(&matte, &Vec3::repeat(1.0)).filter(|_| with_plane),
            start: body() * 120.0,
            highlight: None,
            alive: true,
        };
        let planar = PlanarRegions {
            labels: labels(before),
            hypotheses: vec![hypothesis; 2],
            illuminant: None,
            light: LightFindings::default(),
        };
        check(&clipping_regions(&drawing.input(), &planar, &mut NoopRecorder), after);
    }

    #[test]
    fn highlights_grow_into_what_is_brighter_than_the_meeting_point() {
        let picture = drawing(&["mmmmmm", "mhwwdd", "mmwwdm", "mmmmd."]);
        let before = ["111111", "11....", "11...1", "1111.."];
        fill_in(&picture, &before, true, &["111111", "1111..", "1111.1", "1111.."]);
    }

    #[test]
    fn a_clipped_hole_joins_whoever_holds_most_of_its_border() {
        let picture = drawing(&["mmmmmmmm", "mwwmmwwm", "mmmmmmmm"]);
        // The second hole has two equal neighbors.
        let most = ["11111122", "1..11..2", "11111122"];
        fill_in(&picture, &most, false, &["11111122", "11111..2", "11111122"]);
    }

    #[test]
    fn an_unexplained_hole_is_filled_when_it_is_small_and_wholly_inside() {
        let picture = drawing(&["mmmmmmmm", "mddmm.dm", "mmmmmmmm", "mmddddmm", "mmdddmmm", "mmmmmmmd"]);
        let before = ["11111111", "1..11..1", "11111111", "11....11", "11...111", "1111111."];
        // The second touches darkness, the third exceeds the minimal area of 4, the fourth the picture's border.
        let after = ["11111111", "11111..1", "11111111", "11....11", "11...111", "1111111."];
        fill_in(&picture, &before, false, &after);
    }
}
