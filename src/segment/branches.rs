//! Section 7.4, figure 13: does a region's cluster have more than one highlight branch? (refinement `second_branch`)
//!
//! The paper assumes one branch. A convex object may show several highlights, and the body reflection under each highlight
//! depends on the angle at which the light falls there, or on the distance of a lamp that is near. In the dichromatic plane
//! each highlight is a line of its own, parallel to the surface vector, that leaves the matte line at another place.
//!
//! Colors alone do not show whether there are two branches: under a single highlight of a curved surface the body reflection
//! covers a part of the matte line. So each highlight has to be separate in the picture too. The core of a highlight is the
//! pixels with more than half of the highlight's strength, and the distorted pixels inside. In a core the body reflection
//! varies little, and its variance is measured; a core in which the body reflection varies by more than a tenth of the matte
//! line has no line of its own (the sheen of ambient light at rims). Two cores belong to two branches if their body
//! reflections differ by more than noise and variation of both cores explain (so that a valley lies between the two
//! distributions), by more than the error of the light's direction explains, and by a tenth of the matte line.

use super::input::AnalysisInput;
use super::recorded_labels::Pixels;
use crate::raster::{ComponentSearch, Connectivity, LabelMap, Raster, RegionId};
use crate::reflection::{MOST_BRANCHES, ReflectionTransform};
use crate::trace::{HighlightCore, Measured};

/// Least distance of a highlight pixel from the matte line, σ.
const LEAST_OFFSET: f32 = 8.0;
/// Pixels with more than this share of a highlight's strength are the highlight's core.
const CORE_SHARE: f32 = 0.5;
/// Fewest pixels of a core. The strength of a highlight is the surface reflection that as many of its pixels reach.
const LEAST_PX: usize = 20;
/// Fewest pixels of a core as a share of the pixels of all cores of the region.
const LEAST_PX_SHARE: f64 = 0.01;
/// Fewest undistorted pixels of a core with distorted pixels, as a multiple of the square root of the number of distorted
/// pixels. A complete ring one pixel wide has 3.5.
const LEAST_RING: f64 = 0.75;
/// Least strength of a highlight, as a share of the strength of the region's strongest: a weaker one is a reflection of the
/// surroundings and not of the lamp.
const LEAST_STRENGTH: f32 = 0.4;
/// Least difference of two modes with a valley between them, in units of the root of the sum of both variances: √2 times the
/// limit of Ashman, Bird & Zepf 1994 (D > 2, which is √2 of these units).
const VALLEY: f32 = 2.0;
/// Least difference of the body reflection of two branches, and largest deviation within a core, as shares of the matte
/// line's length.
const LEAST_GAP: f32 = 0.1;
/// Least error of the light's direction that is assumed, degrees.
const LEAST_LIGHT_ERROR_DEG: f64 = 0.5;

/// A search for the highlight branches of one region.
pub struct BranchSearch<'a> {
    /// The image, its masks and the parameters.
    pub input: &'a AnalysisInput<'a>,
    /// Region of each pixel.
    pub labels: &'a LabelMap,
    /// Number of the region.
    pub region: RegionId,
    /// Transform T of the region (equation 13).
    pub transform: &'a ReflectionTransform,
    /// Length of the region's matte line from black, counts.
    pub matte_length: f64,
    /// Angle within which the light lies, degrees; `None` where the angle is not known.
    pub light_interval_deg: Option<f64>,
}

/// A region's highlights, and which of them belong to one branch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branches {
    /// The cores of the highlights, by ascending body reflection.
    pub cores: Vec<HighlightCore>,
    /// For each core and the next one: the difference of their body reflections, and the difference from which on the two
    /// cores belong to two branches, counts.
    pub gaps: Vec<Measured<f32>>,
}

/// A pixel of a highlight.
#[derive(Clone, Copy)]
struct HighlightPixel {
    /// Index of the pixel in the picture.
    pixel: u32,
    /// m_b, m_s and ε, counts; `None` for a distorted pixel.
    amounts: Option<[f32; 3]>,
}

impl BranchSearch<'_> {
    /// Finds the cores of the region's highlights and groups them into branches. `pixels`: the region's pixels.
    pub fn run(&self, pixels: Pixels) -> Branches {
        let strong = self.highlight_pixels(pixels);
        let zero = vec![0.0; strong.len()];
        // Surface reflection from which on each pixel belongs to a core; infinite in a highlight without a strength.
        let mut half = vec![f32::INFINITY; strong.len()];
        for blob in self.components(&strong, &zero) {
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

    /// Pixels of the region with clear surface reflection and distorted pixels, without the region's border pixels, whose
    /// colors are mixed; row-major.
    fn highlight_pixels(&self, pixels: Pixels) -> Vec<HighlightPixel> {
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
            HighlightPixel { pixel, amounts }
        };
        pixels.iter().filter(|&p| clear(p as usize) && inside(p as usize)).map(of).collect()
    }

    /// Components of the pixels whose surface reflection reaches their value in `least` (counts) and of the distorted pixels,
    /// as indices into `strong`. Pixels whose value in `least` is infinite belong to no component.
    fn components(&self, strong: &[HighlightPixel], least: &[f32]) -> Vec<Vec<u32>> {
        let (Some(first), Some(last)) = (strong.first(), strong.last()) else { return Vec::new() };
        let width = self.labels.width();
        let top = first.pixel as usize / width;
        let rows = last.pixel as usize / width + 1 - top;
        // Index in `strong` plus 1 of each pixel that reaches `least`; 0 for all others.
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

    /// The strength and the measures of a core; `None` for a core that is too small, or whose distorted pixels have too few
    /// undistorted ones around them.
    fn core(&self, strong: &[HighlightPixel], core: &[u32]) -> Option<(f32, HighlightCore)> {
        let known: Vec<[f32; 3]> = core.iter().filter_map(|&index| strong[index as usize].amounts).collect();
        let distorted = core.len() - known.len();
        if core.len() < LEAST_PX || (known.len() as f64) < LEAST_RING * (distorted as f64).sqrt() {
            return None;
        }
        let count = known.len() as f32;
        let mean = |of: fn(&[f32; 3]) -> f32| known.iter().map(of).sum::<f32>() / count;
        let (mean_body, surface) = (mean(|amounts| amounts[0]), mean(|amounts| amounts[1]));
        let variance = known.iter().map(|amounts| (amounts[0] - mean_body).powi(2)).sum::<f32>() / count;
        // Under a light with an error the highlight's colors leave the plane. They may leave the highlight line by as much
        // within the plane, which is added to the deviation.
        let sigma = self.input.sigma() as f32;
        let off_plane = (mean(|amounts| amounts[2] * amounts[2]) - sigma * sigma).max(0.0);
        let mut bodies: Vec<f32> = known.iter().map(|amounts| amounts[0]).collect();
        let middle = bodies.len() / 2;
        let body = *bodies.select_nth_unstable_by(middle, f32::total_cmp).1;
        let deviation = (variance + off_plane / self.transform.sine().powi(2)).sqrt();
        let span_px =
            span(core.iter().map(|&index| strong[index as usize].pixel), self.labels.width() as u32);
        let measures =
            HighlightCore { body, deviation, surface, pixels: core.len() as u32, span_px, branch: 0 };
        let amounts = core.iter().map(|&index| self.surface(strong[index as usize], body));
        Some((strength(amounts)?, measures))
    }

    /// Amount of surface reflection of a pixel, counts. The amount of a distorted pixel is computed from its smallest band,
    /// with the body reflection `body` of the undistorted pixels of the core.
    fn surface(&self, at: HighlightPixel, body: f32) -> f32 {
        if let Some([_, surface, _]) = at.amounts {
            return surface;
        }
        let color = self.input.pixels[at.pixel as usize];
        let band = (0..3).min_by(|&a, &b| color[a].total_cmp(&color[b])).unwrap_or(0);
        (color[band] - body * self.transform.body()[band]) / self.transform.surface()[band].max(1e-3)
    }

    /// Difference of the body reflections of two cores, and the limit above which the cores belong to two branches, counts.
    fn gap(&self, low: &HighlightCore, high: &HighlightCore) -> Measured<f32> {
        let valley = VALLEY * low.deviation.hypot(high.deviation);
        let least = LEAST_GAP * self.matte_length as f32;
        let light_error_deg = self.light_interval_deg.unwrap_or(0.0).max(LEAST_LIGHT_ERROR_DEG);
        let light_error_sine = light_error_deg.to_radians().sin() as f32;
        let by_light_error = light_error_sine * (high.surface - low.surface).abs() / self.transform.sine();
        Measured::new(high.body - low.body, valley.max(least) + by_light_error)
    }
}

/// The surface reflection that [`LEAST_PX`] pixels reach, or all pixels where there are fewer; `None` without a pixel.
fn strength(surface: impl Iterator<Item = f32>) -> Option<f32> {
    let mut surface: Vec<f32> = surface.collect();
    let rank = surface.len().min(LEAST_PX).checked_sub(1)?;
    Some(*surface.select_nth_unstable_by(rank, |a, b| b.total_cmp(a)).1)
}

/// First column, first row, last column and last row of pixels of a picture `width` pixels wide.
fn span(pixels: impl Iterator<Item = u32>, width: u32) -> [u32; 4] {
    pixels.fold([u32::MAX, u32::MAX, 0, 0], |[left, top, right, bottom], pixel| {
        let (x, y) = (pixel % width, pixel / width);
        [left.min(x), top.min(y), right.max(x), bottom.max(y)]
    })
}

/// Sets the branch of each core. Successive cores whose gaps stay below their limits are one branch; branches are numbered by
/// decreasing number of pixels. Where there are more than [`MOST_BRANCHES`], the branch with fewest pixels is united with the
/// neighbor across the smaller gap, until the number is reached.
fn number_branches(cores: &mut [HighlightCore], gaps: &[Measured<f32>]) {
    // Index of the first core of every group but the first one.
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
    /// Amount of body reflection under the highlights of each branch, counts, in the order of the branches' numbers; empty
    /// without a highlight.
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

    /// The branch whose highlight lies nearest to column `x`, row `y` of the picture; 0 where there is none.
    pub fn nearest(&self, x: u32, y: u32) -> usize {
        let distance2 = |core: &&HighlightCore| {
            let [left, top, right, bottom] = core.span_px;
            let outside =
                |at: u32, low: u32, high: u32| u64::from(low.saturating_sub(at) + at.saturating_sub(high));
            (outside(x, left, right).pow(2) + outside(y, top, bottom).pow(2), core.branch)
        };
        self.cores.iter().min_by_key(distance2).map_or(0, |core| core.branch)
    }
}

#[cfg(test)]
mod tests;
