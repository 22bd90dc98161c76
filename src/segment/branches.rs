//! Section 7.4, figure 13: does a region's cluster have more than one highlight branch? (refinement `second_branch`)
//!
//! The paper assumes one. A convex object may show several highlights, and the body reflection under each depends on how its
//! light falls there; a lamp that is near makes as much of a difference. In the dichromatic plane each is a line of its own,
//! parallel to the surface vector, that leaves the matte line at another place.
//!
//! Colors alone cannot tell: under a single highlight of a curved surface the shading sweeps over a part of the matte line. So
//! each highlight has to stand apart in the picture too. Its core is what lies above half of its strength, with its clipped
//! heart; there the sweep is small and measured; a core that sweeps more than a tenth of the matte line has no line of its own (the
//! sheen of ambient light at rims). Two cores belong to two branches if their body reflections differ by more than
//! noise and sweep of both explain (so that a valley lies between them), by more than what the light's direction leaves open, and
//! by a tenth of the matte line.

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::raster::{ComponentSearch, Connectivity, LabelMap, Raster, RegionId};
use crate::reflection::{MOST_BRANCHES, ReflectionTransform};
use crate::trace::{HighlightCore, Measured};

/// A highlight's pixel lies at least so far off the matte line, σ.
const LEAST_OFFSET: f32 = 8.0;
/// What lies above this share of a highlight's strength is its core.
const CORE_SHARE: f32 = 0.5;
/// Fewest pixels of a core, and their least share of all cores' pixels of the region. As many reach the strength of a highlight.
const LEAST_PX: usize = 20;
const LEAST_PX_SHARE: f64 = 0.01;
/// Undistorted pixels around a distorted heart, as a multiple of the root of its pixels: a whole ring one pixel wide has 3.5.
const LEAST_RING: f64 = 0.75;
/// A highlight of a smaller share of the region's strongest is a reflection of its surroundings, not of the lamp.
const LEAST_STRENGTH: f32 = 0.4;
/// Two modes have a valley between them from this difference on, in units of the root of their variances' sum: twice Ashman's
/// D of 1.4 (Ashman, Bird & Zepf 1994 ask for D > 2, which is √2 of these units).
const VALLEY: f32 = 2.0;
/// Least difference of two branches, and largest deviation within a core, as shares of the matte line's length.
const LEAST_GAP: f32 = 0.1;
/// The direction of the light is never known better than this, degrees.
const LEAST_DOUBT_DEG: f64 = 0.5;

/// Where to look for a region's highlight branches.
pub struct BranchSearch<'a> {
    /// The picture.
    pub input: &'a AnalysisInput<'a>,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// The region.
    pub region: RegionId,
    /// Its T.
    pub transform: &'a ReflectionTransform,
    /// Length of its matte line, counts.
    pub matte_length: f64,
    /// Within how many degrees the light is known, where something tells.
    pub light_doubt_deg: Option<f64>,
}

/// A region's highlights, held against one another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branches {
    /// The cores, by ascending body reflection.
    pub cores: Vec<HighlightCore>,
    /// From each core to the next: how much their body reflection differs, and from which difference on they belong to two
    /// branches, counts.
    pub gaps: Vec<Measured<f32>>,
}

/// A pixel of a highlight.
#[derive(Clone, Copy)]
struct Strong {
    pixel: u32,
    /// m_b, m_s and ε, counts; none of a distorted pixel.
    amounts: Option<[f32; 3]>,
}

impl BranchSearch<'_> {
    /// Holds the region's highlights against one another.
    pub fn run(&self, pixels: Pixels) -> Branches {
        let strong = self.strong(pixels);
        let floor = vec![0.0; strong.len()];
        let mut half = vec![f32::INFINITY; strong.len()];
        for blob in self.components(&strong, &floor) {
            let known = blob.iter().filter_map(|&index| strong[index as usize].amounts);
            let Some(strength) = strength(known.map(|[_, surface, _]| surface)) else { continue };
            for &index in &blob {
                half[index as usize] = CORE_SHARE * strength;
            }
        }
        let mut cores: Vec<(f32, HighlightCore)> =
            self.components(&strong, &half).iter().filter_map(|core| self.core(&strong, core)).collect();
        let widest = LEAST_GAP * self.matte_length as f32;
        let strongest = cores.iter().fold(0.0f32, |most, (strength, _)| most.max(*strength));
        cores.retain(|(strength, core)| *strength >= LEAST_STRENGTH * strongest && core.deviation <= widest);
        let mut cores: Vec<HighlightCore> = cores.into_iter().map(|(_, core)| core).collect();
        let all: f64 = cores.iter().map(|core| f64::from(core.pixels)).sum();
        cores.retain(|core| f64::from(core.pixels) >= LEAST_PX_SHARE * all);
        cores.sort_by(|a, b| a.body.total_cmp(&b.body));
        let gaps: Vec<Measured<f32>> = cores.windows(2).map(|pair| self.gap(&pair[0], &pair[1])).collect();
        number_branches(&mut cores, &gaps);
        Branches { cores, gaps }
    }

    /// Pixels with clear surface reflection and distorted ones, away from the region's border, where colors mix; row-major.
    fn strong(&self, pixels: Pixels) -> Vec<Strong> {
        let Self { input, labels, transform, .. } = self;
        let least = LEAST_OFFSET * input.sigma() as f32 / transform.sine();
        let surface_row = transform.amount_rows()[1];
        let clear = |pixel: usize| {
            input.masks.distorted(pixel) || crate::color::dot(surface_row, input.pixels[pixel]) > least
        };
        let inside = |pixel: usize| labels.around(pixel).all(|near| labels[near] == self.region.get());
        let of = |pixel: u32| {
            let amounts = (!input.masks.distorted(pixel as usize)).then(|| {
                let found = transform.split(input.pixels[pixel as usize]);
                [found.body, found.surface, found.noise]
            });
            Strong { pixel, amounts }
        };
        pixels.iter().filter(|&p| clear(p as usize) && inside(p as usize)).map(of).collect()
    }

    /// Components of the pixels whose surface reflection reaches `least`, joined by distorted ones, as places in `strong`.
    fn components(&self, strong: &[Strong], least: &[f32]) -> Vec<Vec<u32>> {
        let (Some(first), Some(last)) = (strong.first(), strong.last()) else { return Vec::new() };
        let width = self.labels.width();
        let top = first.pixel as usize / width;
        let rows = last.pixel as usize / width + 1 - top;
        // Place in `strong` of each pixel that reaches `least`, from 1; 0 of all others.
        let mut place: Raster<u32> = Raster::filled(width, rows, 0);
        for (index, at) in strong.iter().enumerate() {
            if least[index].is_finite() && at.amounts.is_none_or(|[_, surface, _]| surface >= least[index]) {
                place[at.pixel as usize - top * width] = index as u32 + 1;
            }
        }
        let mut search = ComponentSearch::new(width, rows, Connectivity::Eight);
        let starts = strong.iter().map(|at| at.pixel as usize - top * width);
        starts
            .filter_map(|start| {
                let component = search.component_at(start, |pixel| place[pixel] > 0)?;
                Some(component.iter().map(|&pixel| place[pixel] - 1).collect())
            })
            .collect()
    }

    /// What a core says, and its strength; none where it is too small, or its clipped heart has no ring around it.
    fn core(&self, strong: &[Strong], core: &[u32]) -> Option<(f32, HighlightCore)> {
        let known: Vec<[f32; 3]> = core.iter().filter_map(|&index| strong[index as usize].amounts).collect();
        let distorted = core.len() - known.len();
        if core.len() < LEAST_PX || (known.len() as f64) < LEAST_RING * (distorted as f64).sqrt() {
            return None;
        }
        let count = known.len() as f32;
        let mean = |of: fn(&[f32; 3]) -> f32| known.iter().map(of).sum::<f32>() / count;
        let (mean_body, surface) = (mean(|amounts| amounts[0]), mean(|amounts| amounts[1]));
        let variance = known.iter().map(|amounts| (amounts[0] - mean_body).powi(2)).sum::<f32>() / count;
        // Where the light is a little off, a highlight leaves the plane, and may leave its line as far within the plane.
        let sigma = self.input.sigma() as f32;
        let off_plane = (mean(|amounts| amounts[2] * amounts[2]) - sigma * sigma).max(0.0);
        let mut bodies: Vec<f32> = known.iter().map(|amounts| amounts[0]).collect();
        let middle = bodies.len() / 2;
        let body = *bodies.select_nth_unstable_by(middle, f32::total_cmp).1;
        let deviation = (variance + off_plane / self.transform.sine().powi(2)).sqrt();
        let span_px =
            span(core.iter().map(|&index| strong[index as usize].pixel), self.labels.width() as u32);
        let told = HighlightCore { body, deviation, surface, pixels: core.len() as u32, span_px, branch: 0 };
        let amounts = core.iter().map(|&index| self.surface(strong[index as usize], body));
        Some((strength(amounts)?, told))
    }

    /// Amount of surface reflection, counts; that of a distorted pixel by its smallest band, with the body reflection around it.
    fn surface(&self, at: Strong, body: f32) -> f32 {
        if let Some([_, surface, _]) = at.amounts {
            return surface;
        }
        let color = self.input.pixels[at.pixel as usize];
        let band = (0..3).min_by(|&a, &b| color[a].total_cmp(&color[b])).unwrap_or(0);
        (color[band] - body * self.transform.body()[band]) / self.transform.surface()[band].max(1e-3)
    }

    /// How much two cores' body reflection differs, and from which difference on they belong to two branches, counts.
    fn gap(&self, low: &HighlightCore, high: &HighlightCore) -> Measured<f32> {
        let valley = VALLEY * low.deviation.hypot(high.deviation);
        let least = LEAST_GAP * self.matte_length as f32;
        let light_error_sine =
            self.light_doubt_deg.unwrap_or(0.0).max(LEAST_DOUBT_DEG).to_radians().sin() as f32;
        let turned = light_error_sine * (high.surface - low.surface).abs() / self.transform.sine();
        Measured::new(high.body - low.body, valley.max(least) + turned)
    }
}

/// The surface reflection that [`LEAST_PX`] pixels reach, or all where they are fewer; none without a pixel.
fn strength(surface: impl Iterator<Item = f32>) -> Option<f32> {
    let mut surface: Vec<f32> = surface.collect();
    let rank = surface.len().min(LEAST_PX).checked_sub(1)?;
    Some(*surface.select_nth_unstable_by(rank, |a, b| b.total_cmp(a)).1)
}

/// First column and row and last column and row of some pixels.
fn span(pixels: impl Iterator<Item = u32>, width: u32) -> [u32; 4] {
    pixels.fold([u32::MAX, u32::MAX, 0, 0], |[left, top, right, bottom], pixel| {
        let (x, y) = (pixel % width, pixel / width);
        [left.min(x), top.min(y), right.max(x), bottom.max(y)]
    })
}

/// Gives each core its branch: cores in a row without a gap that is wide enough are one; the one with most pixels is the first.
/// Of too many branches the weakest go to their nearest neighbor.
fn number_branches(cores: &mut [HighlightCore], gaps: &[Measured<f32>]) {
    let mut ends: Vec<usize> =
        gaps.iter().enumerate().filter(|(_, gap)| gap.value > gap.limit).map(|(i, _)| i + 1).collect();
    let groups = |ends: &[usize]| {
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let mut groups: Vec<(u32, std::ops::Range<usize>)> = starts
            .zip(ends.iter().copied().chain([cores.len()]))
            .map(|(from, to)| (cores[from..to].iter().map(|core| core.pixels).sum(), from..to))
            .collect();
        groups.sort_by_key(|(pixels, _)| std::cmp::Reverse(*pixels));
        groups
    };
    while ends.len() >= MOST_BRANCHES {
        // The weakest group goes where the gap beside it is smaller.
        let weakest = groups(&ends).pop().map_or(0..0, |(_, group)| group);
        let beside = ends.iter().enumerate().filter(|&(_, &end)| end == weakest.start || end == weakest.end);
        let Some((narrow, _)) = beside.min_by(|a, b| gaps[a.1 - 1].value.total_cmp(&gaps[b.1 - 1].value))
        else {
            break;
        };
        ends.remove(narrow);
    }
    let groups = groups(&ends);
    for (branch, (_, group)) in groups.into_iter().enumerate() {
        cores[group].iter_mut().for_each(|core| core.branch = branch);
    }
}

impl Branches {
    /// Amount of body reflection under each branch's highlights, the strongest branch first, counts; empty without a highlight.
    pub fn bodies(&self) -> Vec<f32> {
        let count = self.cores.iter().map(|core| core.branch + 1).max().unwrap_or(0);
        let mut sums = vec![(0.0f32, 0.0f32); count];
        for core in &self.cores {
            let (sum, weight) = &mut sums[core.branch];
            *sum += core.body * core.pixels as f32;
            *weight += core.pixels as f32;
        }
        sums.into_iter().map(|(sum, weight)| sum / weight).collect()
    }

    /// The branch whose highlight lies nearest to a place in the picture; the strongest one without any.
    pub fn nearest(&self, x: u32, y: u32) -> usize {
        let off2 = |core: &&HighlightCore| {
            let [left, top, right, bottom] = core.span_px;
            let apart =
                |at: u32, low: u32, high: u32| u64::from(low.saturating_sub(at) + at.saturating_sub(high));
            (apart(x, left, right).pow(2) + apart(y, top, bottom).pow(2), core.branch)
        };
        self.cores.iter().min_by_key(off2).map_or(0, |core| core.branch)
    }
}

#[cfg(test)]
mod tests;
