//! Section 5.5: colours that clipping and blooming have moved out of the slices.
//!
//! Their colour cannot be used, so position is: from highlight pixels (nearer to the highlight line than to the matte line)
//! a region grows into unassigned neighbours that are brighter than the meeting point of both lines. Then holes are
//! filled: clipped components that a region nearly surrounds, and unassigned ones that lie wholly inside it.

use super::ledger::Ledger;
use super::planar::{PlanarHypothesis, PlanarRegions};
use super::scene::Scene;
use crate::color::{Line, Vec3, dot, rgb};
use crate::raster::{LabelMap, Raster, UNASSIGNED, label_components};
use crate::trace::{Event, Recorder};
use std::collections::BTreeMap;

/// A clipped component joins the region that holds this share of its assigned border.
const SURROUNDED: f64 = 0.7;

/// Grows the planar regions into what clipping and blooming have distorted.
pub fn clipping_regions<R: Recorder>(scene: &Scene, planar: &PlanarRegions, recorder: &mut R) -> LabelMap {
    let mut ledger = Ledger::new(planar.labels.clone(), recorder);
    let members = ledger.members(planar.hypotheses.len());
    for (index, hypothesis) in planar.hypotheses.iter().enumerate() {
        let Some(highlight) = HighlightTest::new(hypothesis) else { continue };
        let id = index as u16 + 1;
        let is_highlight = |&&pixel: &&u32| highlight.is_highlight(scene.pixels[pixel as usize]);
        let mut front: Vec<u32> = members.region(id).iter().filter(is_highlight).copied().collect();
        let start2 = hypothesis.start.norm_squared() as f32;
        ledger.grow(id, &mut front, |_, pixel, holder| {
            let color = scene.pixels[pixel];
            holder == UNASSIGNED && !scene.masks.dark(pixel) && dot(color, color) > start2
        });
    }
    let clipped = |pixel: usize| scene.masks.distorted(pixel) && !scene.masks.dark(pixel);
    fill(&mut ledger, clipped, |hole| hole.share >= SURROUNDED);
    let largest_px = scene.used.min_area as usize;
    let lit = |pixel: usize| !scene.masks.dark(pixel);
    fill(&mut ledger, lit, |hole| hole.closed && hole.share >= 1.0 && hole.pixels <= largest_px);
    ledger.labels
}

/// Tells highlight from matte pixels: which of the two lines is nearer? (section 6)
#[derive(Clone, Copy, Debug)]
pub struct HighlightTest {
    mean: [f32; 3],
    direction: [f32; 3],
    start: [f32; 3],
    surface: [f32; 3],
}

impl HighlightTest {
    /// The test of a region; `None` when it has no plane.
    pub fn new(hypothesis: &PlanarHypothesis) -> Option<Self> {
        let plane = hypothesis.plane.as_ref()?;
        Some(Self::of_lines(&hypothesis.matte, &hypothesis.start, &plane.surface))
    }

    /// The test of a matte line and a highlight line from `start` on.
    pub fn of_lines(matte: &Line, start: &Vec3, surface: &Vec3) -> Self {
        Self {
            mean: rgb(&matte.mean),
            direction: rgb(&matte.direction),
            start: rgb(start),
            surface: rgb(surface),
        }
    }

    /// Whether a colour is nearer to the highlight line.
    #[inline]
    pub fn is_highlight(&self, color: [f32; 3]) -> bool {
        let from = |point: [f32; 3]| [color[0] - point[0], color[1] - point[1], color[2] - point[2]];
        let v = from(self.mean);
        let matte2 = dot(v, v) - dot(v, self.direction).powi(2);
        let w = from(self.start);
        let highlight2 = dot(w, w) - dot(w, self.surface).max(0.0).powi(2);
        highlight2 < matte2
    }
}

/// A component of unassigned pixels, and who holds its border.
struct Hole {
    pixels: usize,
    /// Share of the assigned border that the main holder has.
    share: f64,
    /// Whether nothing but regions borders it.
    closed: bool,
}

/// Gives components of unassigned pixels for which `member` holds to the region with most of their border, where `fits`.
fn fill<R: Recorder>(ledger: &mut Ledger<R>, member: impl Fn(usize) -> bool, fits: impl Fn(&Hole) -> bool) {
    let (width, height) = (ledger.labels.width(), ledger.labels.height());
    let inside = (0..ledger.labels.len()).map(|p| ledger.labels[p] == UNASSIGNED && member(p)).collect();
    let inside = Raster::from_vec(width, height, inside).unwrap_or_default();
    let components = label_components(&inside, |&hole| hole);
    let count = components.sizes.len();
    let mut borders: Vec<BTreeMap<u16, usize>> = vec![BTreeMap::new(); count];
    let mut closed = vec![true; count];
    for pixel in 0..inside.len() {
        let component = components.labels[pixel] as usize;
        if component == 0 {
            continue;
        }
        let (x, y) = (pixel % width, pixel / width);
        closed[component] &= x > 0 && y > 0 && x + 1 < width && y + 1 < height;
        inside.for_each_neighbour(pixel, |near| {
            if !inside[near] {
                let label = ledger.labels[near];
                closed[component] &= label != UNASSIGNED;
                if label != UNASSIGNED {
                    *borders[component].entry(label).or_default() += 1;
                }
            }
        });
    }
    let holders: Vec<u16> = (0..count)
        .map(|component| {
            let border = &borders[component];
            let total: usize = border.values().sum();
            let Some((&region, &most)) = border.iter().max_by_key(|&(&id, &n)| (n, u16::MAX - id)) else {
                return UNASSIGNED;
            };
            let share = most as f64 / total as f64;
            let pixels = components.sizes[component];
            if component == 0 || !fits(&Hole { pixels, share, closed: closed[component] }) {
                return UNASSIGNED;
            }
            if R::KEEPS {
                let pixels = pixels as u32;
                ledger.recorder.record(Event::HoleFilled { region, pixels, border_share: share });
            }
            region
        })
        .collect();
    for pixel in 0..inside.len() {
        let region = holders[components.labels[pixel] as usize];
        if region != UNASSIGNED {
            ledger.assign(pixel, region);
        }
    }
}
