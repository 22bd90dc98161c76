//! Rule `clip_repair`: the clipped core of a highlight takes the body reflection of the pixels around it.
//!
//! A blob of clipped pixels is filled where at least 40 % of the ring of 2 px around the blob are highlight, surface
//! reflection rises towards the blob, the body reflection of the ring is that of one material (its standard deviation
//! is at most half its mean, or that of the highlight pixels alone at most .3 of their mean, as the other pixels may have surface
//! reflection that is not known), and the highlight around the blob is at least half as large as the blob. Blobs of more
//! than 40,000 pixels are not filled. The fill is harmonic: the smoothest that is continuous with the ring. Other
//! clipped pixels (white paper, the sky) do not change, and the surface reflection around them fades out towards them,
//! so that no hole is left in the middle of what may be a highlight.

use super::desaturation_map::DesaturationMap;
use crate::intrinsic::images::Images;
use crate::raster::{ComponentSearch, Connectivity, Mask, PixelIndex, Raster, blur};
use crate::segment::AnalysisInput;
use crate::trace::{Measured, PixelKind, Ramp, RepairTried, RepairVerdict};

/// Least share of highlight pixels in the ring around a blob that is filled.
const LEAST_HIGHLIGHT: f32 = 0.4;
/// Weight from which on a pixel counts as highlight.
const HIGHLIGHT_WEIGHT: f32 = 0.5;
/// Largest standard deviation of the body reflection of the ring, as a share of its mean.
const MOST_SPREAD: f32 = 0.5;
/// The same of the highlight pixels of the ring alone; one of the two is enough.
const MOST_HIGHLIGHT_SPREAD: f32 = 0.3;
/// Least number of highlight pixels around a blob, as a share of the pixels of the blob.
const LEAST_AROUND: f32 = 0.5;
/// Distance around a blob within which highlight pixels are counted: the larger of this value and half the square root
/// of the blob's pixels, pixels.
const AROUND_PX: f32 = 3.0;
/// Most pixels of a blob that is filled. Larger blobs are usually windows or the sky.
const MOST_PIXELS: usize = 40_000;
/// Width of the Gaussian by which surface reflection fades out towards clipped pixels that are not filled, pixels.
const FADE_PX: f64 = 6.0;
/// Share of unfilled clipped pixels around a pixel over which its surface reflection fades from all to none.
const FADE: Ramp = Ramp { start: 0.0, end: 0.3 };
/// Confidence of a repaired pixel.
pub(super) const CONFIDENCE: f32 = 0.3;

/// The surface reflection around the clipped blobs of a window, by which the blobs are judged.
pub struct LocalAmounts<'a> {
    /// The desaturation of the pixels.
    pub map: &'a DesaturationMap<'a>,
    /// The share of each pixel's excess that is surface reflection, 0…1.
    pub weights: &'a Raster<f32>,
    /// Amount of surface reflection of each pixel, counts of J.
    pub amounts: &'a Raster<f32>,
}

/// A clipped blob that is filled.
pub struct Fill {
    blob: Vec<usize>,
    /// The two rings of 1 px around the blob.
    rings: [Vec<usize>; 2],
}

/// Judges the clipped blobs among the `unexplained` pixels. Returns the blobs that are filled. `record` receives each blob's verdict and pixels.
pub fn fills(
    input: &AnalysisInput,
    unexplained: &Mask,
    found: &LocalAmounts,
    mut record: impl FnMut(RepairTried, &[usize]),
) -> Vec<Fill> {
    let mut search = ComponentSearch::new(unexplained.width(), unexplained.height(), Connectivity::Eight);
    let mut surroundings = Surroundings { input, in_ring: unexplained.map(|_| false) };
    let clipped = |pixel: usize| unexplained[pixel] && input.masks.clipped(pixel);
    let mut fills = Vec::new();
    for start in 0..unexplained.len() {
        let Some(blob) = search.component_at(start, clipped) else { continue };
        if input.stopped() {
            break;
        }
        let around = surroundings.around(blob, |pixel| found.is_highlight(pixel));
        let tried = found.tried(input, blob, &around);
        record(tried, blob);
        if tried.verdict == RepairVerdict::Filled {
            fills.push(Fill { blob: blob.to_vec(), rings: around.rings });
        }
    }
    fills
}

/// The amounts of a window, faded out towards the clipped pixels of the `unexplained` that are not filled.
pub fn faded(
    input: &AnalysisInput,
    unexplained: &Mask,
    map: &DesaturationMap,
    fills: &[Fill],
    amounts: Raster<f32>,
) -> Raster<f32> {
    let roi = map.roi;
    let mut unfilled =
        roi.raster(|pixel| [if unexplained[pixel] && input.masks.clipped(pixel) { 1.0f32 } else { 0.0 }]);
    for index in fills.iter().flat_map(|fill| &fill.blob).filter_map(|&pixel| roi.index(pixel)) {
        unfilled[index] = [0.0];
    }
    if unfilled.as_slice().iter().all(|&[share]| share == 0.0) {
        return amounts;
    }
    let near = blur(&unfilled, FADE_PX);
    let faded = amounts.as_slice().iter().zip(near.as_slice());
    let data = faded.map(|(amount, &[share])| amount * (1.0 - FADE.step(share))).collect();
    Raster::from_vec(roi.width, roi.height, data).unwrap_or_default()
}

/// Fills blobs with the body reflection of their rings, sets the `confidence` of their pixels, and returns these pixels.
pub fn fill(
    input: &AnalysisInput,
    fills: &[Fill],
    images: &mut Images,
    confidence: &mut Raster<f32>,
) -> Mask {
    let mut all_filled = Mask::filled(confidence.width(), confidence.height(), false);
    let surroundings = Surroundings { input, in_ring: Mask::default() };
    for Fill { blob, rings } in fills {
        let filled = surroundings.harmonic(blob, rings, &images.body);
        for (&pixel, fill) in blob.iter().zip(filled) {
            let input = input.pixels[pixel];
            images.body[pixel] = std::array::from_fn(|band| fill[band].clamp(0.0, input[band].max(0.0)));
            images.surface[pixel] = std::array::from_fn(|band| input[band] - images.body[pixel][band]);
            if images.kinds[pixel] != PixelKind::Unassigned {
                images.kinds[pixel] = PixelKind::Restored;
            }
            confidence[pixel] = CONFIDENCE;
            all_filled[pixel] = true;
        }
    }
    all_filled
}

impl LocalAmounts<'_> {
    fn is_highlight(&self, pixel: usize) -> bool {
        self.map.roi.index(pixel).is_some_and(|index| self.weights[index] > HIGHLIGHT_WEIGHT)
    }

    fn amount(&self, pixel: usize) -> f32 {
        self.map.roi.index(pixel).map_or(0.0, |index| self.amounts[index])
    }

    /// Standard deviation of the body reflection of `ring` as a share of its mean, and the limit of it: of all pixels, or of
    /// the highlight pixels where that of all is above the limit.
    fn spread(&self, input: &AnalysisInput, ring: impl Iterator<Item = usize> + Clone) -> Measured<f32> {
        let body =
            |pixel: usize| self.map.lamps.of(pixel).gain.mean(input.pixels[pixel]) - self.amount(pixel);
        let all = Measured::new(relative_deviation(ring.clone().map(body)), MOST_SPREAD);
        if all.value <= all.limit {
            return all;
        }
        let highlights = ring.filter(|&pixel| self.is_highlight(pixel)).map(body);
        Measured::new(relative_deviation(highlights), MOST_HIGHLIGHT_SPREAD)
    }

    /// The verdict on a blob by the pixels around it.
    fn tried(&self, input: &AnalysisInput, blob: &[usize], around: &Around) -> RepairTried {
        let [inner, outer] = &around.rings;
        let ring_pixels = || inner.iter().chain(outer).copied();
        let count = ring_pixels().count().max(1) as f32;
        let mean = |pixels: &[usize]| {
            pixels.iter().map(|&pixel| self.amount(pixel)).sum::<f32>() / pixels.len().max(1) as f32
        };
        let share = ring_pixels().filter(|&pixel| self.is_highlight(pixel)).count() as f32 / count;
        let highlight_share = Measured::new(share, LEAST_HIGHLIGHT);
        let spread = self.spread(input, ring_pixels());
        let highlights = Measured::new(around.highlights as f32, LEAST_AROUND * blob.len() as f32);
        let rise = [mean(inner), mean(outer)];
        let verdict = if blob.len() > MOST_PIXELS {
            RepairVerdict::TooLarge
        } else if inner.is_empty() || outer.is_empty() {
            RepairVerdict::NoRing
        } else if highlight_share.value < highlight_share.limit {
            RepairVerdict::NoHighlight
        } else if rise[0] <= rise[1] {
            RepairVerdict::NoRise
        } else if spread.value > spread.limit {
            RepairVerdict::Uneven
        } else if highlights.value < highlights.limit {
            RepairVerdict::TooSmall
        } else {
            RepairVerdict::Filled
        };
        let pixel = PixelIndex::from_index(blob.first().copied().unwrap_or(0));
        let [inner, outer] = rise;
        RepairTried {
            blob: 0,
            pixel,
            pixels: blob.len() as u32,
            ring: highlight_share,
            inner,
            outer,
            spread,
            around: highlights,
            verdict,
        }
    }
}

/// Standard deviation of values as a share of the length of their mean; 0 for no values.
fn relative_deviation(values: impl Iterator<Item = f32> + Clone) -> f32 {
    let count = values.clone().count().max(1) as f32;
    let mean = values.clone().sum::<f32>() / count;
    let variance = values.map(|value| (value - mean).powi(2)).sum::<f32>() / count;
    variance.sqrt() / mean.abs().max(1e-3)
}

/// The unclipped pixels around a clipped blob.
struct Around {
    /// The pixels next to the blob, and the pixels next to these.
    rings: [Vec<usize>; 2],
    /// Number of highlight pixels within reach; counting ends where they are enough.
    highlights: usize,
}

/// Finds the unclipped pixels around blobs of clipped pixels.
struct Surroundings<'a> {
    input: &'a AnalysisInput<'a>,
    /// The pixels that are already in a ring of the current blob; all false between two blobs.
    in_ring: Mask,
}

impl Surroundings<'_> {
    /// The pixels around a blob.
    fn around(&mut self, blob: &[usize], is_highlight: impl Fn(usize) -> bool) -> Around {
        let reach_px = AROUND_PX.max(0.5 * (blob.len() as f32).sqrt()) as usize;
        let enough = (LEAST_AROUND * blob.len() as f32).ceil() as usize;
        let count = |ring: &[usize]| ring.iter().filter(|&&pixel| is_highlight(pixel)).count();
        let inner = self.ring(blob);
        let outer = self.ring(&inner);
        let mut highlights = count(&inner) + count(&outer);
        let mut outer_rings = vec![outer.clone()];
        while outer_rings.len() + 1 < reach_px && highlights < enough {
            let next = self.ring(outer_rings.last().map_or(&[], Vec::as_slice));
            if next.is_empty() {
                break;
            }
            highlights += count(&next);
            outer_rings.push(next);
        }
        inner.iter().chain(outer_rings.iter().flatten()).for_each(|&pixel| self.in_ring[pixel] = false);
        Around { rings: [inner, outer], highlights }
    }

    /// Whether the value of a pixel can be used: the pixel is neither clipped nor invalid nor outside of the analyzed area.
    fn known(&self, pixel: usize) -> bool {
        let masks = self.input.masks;
        !masks.clipped(pixel) && !masks.invalid(pixel) && !masks.outside(pixel)
    }

    /// The known pixels next to the pixels `from` that are in no ring yet; see [`Self::known`].
    fn ring(&mut self, from: &[usize]) -> Vec<usize> {
        let mut ring = Vec::new();
        for &pixel in from {
            for near in self.in_ring.around(pixel) {
                if !self.in_ring[near] && self.known(near) {
                    self.in_ring[near] = true;
                    ring.push(near);
                }
            }
        }
        ring
    }

    /// The harmonic fill of a blob: body colors, each the mean of its neighbors, by successive over-relaxation.
    fn harmonic(&self, blob: &[usize], rings: &[Vec<usize>; 2], body: &Raster<[f32; 3]>) -> Vec<[f32; 3]> {
        let ring = || rings.iter().flatten().map(|&pixel| body[pixel]);
        let count = ring().count() as f32;
        let sum = ring().fold([0.0f32; 3], |sum, color| std::array::from_fn(|band| sum[band] + color[band]));
        let mut values = vec![sum.map(|sum| sum / count); blob.len()];
        let mut order: Vec<usize> = (0..blob.len()).collect();
        order.sort_unstable_by_key(|&index| blob[index]);
        let place = |pixel: usize| {
            let found = order.binary_search_by_key(&pixel, |&index| blob[index]);
            found.ok().map(|at| order[at])
        };
        // Of each pixel: the neighbors inside the blob; the sum of the colors of the known neighbors outside; the
        // number of all these neighbors.
        let mut near = vec![[usize::MAX; 4]; blob.len()];
        let mut fixed = vec![([0.0f32; 3], 0.0f32); blob.len()];
        for (index, &pixel) in blob.iter().enumerate() {
            let (border, weight) = &mut fixed[index];
            let mut inside = 0;
            body.for_each_neighbor(pixel, |next| {
                if let Some(other) = place(next) {
                    near[index][inside] = other;
                    inside += 1;
                } else if self.known(next) {
                    border.iter_mut().zip(body[next]).for_each(|(sum, band)| *sum += band);
                } else {
                    return;
                }
                *weight += 1.0;
            });
        }
        let across = (blob.len() as f32).sqrt() + 2.0;
        let relaxation = 2.0 / (1.0 + std::f32::consts::PI / across);
        for _ in 0..(3.0 * across) as usize + 20 {
            for &index in &order {
                let (mut sum, weight) = fixed[index];
                for &next in near[index].iter().take_while(|&&next| next != usize::MAX) {
                    sum.iter_mut().zip(values[next]).for_each(|(sum, band)| *sum += band);
                }
                if weight > 0.0 {
                    for band in 0..3 {
                        values[index][band] += relaxation * (sum[band] / weight - values[index][band]);
                    }
                }
            }
        }
        values
    }
}
