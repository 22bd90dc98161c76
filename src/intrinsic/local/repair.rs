//! Rule `clip_repair`: the clipped core of a highlight takes the body reflection of the pixels around it.
//!
//! A blob of clipped pixels is filled where at least 40 % of the ring of 2 px around the blob are highlight and surface
//! reflection rises towards the blob. The fill is harmonic: the smoothest that is continuous with the ring. Other
//! clipped pixels (white paper, the sky) do not change. Worth 8 dB inside highlights of printed scenes, nothing elsewhere.

use crate::intrinsic::images::Images;
use crate::raster::{ComponentSearch, Connectivity, Mask, PixelIndex, Raster};
use crate::segment::AnalysisInput;
use crate::trace::{Measured, PixelKind, RepairTried, RepairVerdict};

/// Least share of highlight pixels in the ring around a blob that is filled.
const LEAST_HIGHLIGHT: f64 = 0.4;
/// Most pixels of a blob that is filled: larger blobs are windows and skies.
const MOST_PX: usize = 40_000;
/// Confidence of a repaired pixel.
pub(super) const CONFIDENCE: f32 = 0.3;

/// Fills the clipped blobs among the `unexplained` pixels that are highlights, sets the `confidence` of their pixels, and returns
/// these pixels. `record` receives each blob's verdict and pixels.
pub fn repair(
    input: &AnalysisInput,
    unexplained: &Mask,
    images: &mut Images,
    confidence: &mut Raster<f32>,
    mut record: impl FnMut(RepairTried, &[usize]),
) -> Mask {
    let mut all_filled = Mask::filled(unexplained.width(), unexplained.height(), false);
    let mut search = ComponentSearch::new(unexplained.width(), unexplained.height(), Connectivity::Eight);
    let mut surroundings = Surroundings { input, in_ring: unexplained.map(|_| false) };
    let clipped = |pixel: usize| unexplained[pixel] && input.masks.clipped(pixel);
    for start in 0..unexplained.len() {
        let Some(blob) = search.component_at(start, clipped) else { continue };
        if input.stopped() {
            break;
        }
        let rings = surroundings.rings(blob);
        let tried = tried(blob, &rings, &images.surface);
        record(tried, blob);
        if tried.verdict != RepairVerdict::Filled {
            continue;
        }
        let filled = surroundings.harmonic(blob, &rings, &images.body);
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

/// The verdict on a blob by the rings around the blob: whether enough of their pixels are highlight, and whether the inner ring
/// has more surface reflection than the outer one.
fn tried(blob: &[usize], [inner, outer]: &[Vec<usize>; 2], surface: &Raster<[f32; 3]>) -> RepairTried {
    let amount = |&pixel: &usize| surface[pixel].iter().sum::<f32>();
    let mean = |ring: &[usize]| ring.iter().map(amount).sum::<f32>() / ring.len().max(1) as f32;
    let count = inner.len() + outer.len();
    let highlight = inner.iter().chain(outer).filter(|pixel| amount(pixel) > 0.0).count();
    let rise = [mean(inner), mean(outer)];
    let verdict = if blob.len() > MOST_PX {
        RepairVerdict::TooLarge
    } else if inner.is_empty() || outer.is_empty() {
        RepairVerdict::NoRing
    } else if (highlight as f64) < LEAST_HIGHLIGHT * count as f64 {
        RepairVerdict::NoHighlight
    } else if rise[0] > rise[1] {
        RepairVerdict::Filled
    } else {
        RepairVerdict::NoRise
    };
    RepairTried {
        blob: 0,
        pixel: PixelIndex::from_index(blob.first().copied().unwrap_or(0)),
        pixels: blob.len() as u32,
        ring: Measured::new(highlight as f32 / count.max(1) as f32, LEAST_HIGHLIGHT as f32),
        inner: rise[0] / 3.0,
        outer: rise[1] / 3.0,
        verdict,
    }
}

/// Finds the unclipped pixels around blobs of clipped pixels.
struct Surroundings<'a> {
    input: &'a AnalysisInput<'a>,
    /// The pixels that are already in a ring of the current blob; all false between two blobs.
    in_ring: Mask,
}

impl Surroundings<'_> {
    /// The inner ring, the unclipped pixels next to a blob, and the outer ring, the unclipped pixels next to the inner ring.
    fn rings(&mut self, blob: &[usize]) -> [Vec<usize>; 2] {
        let inner = self.ring(blob);
        let outer = self.ring(&inner);
        inner.iter().chain(&outer).for_each(|&pixel| self.in_ring[pixel] = false);
        [inner, outer]
    }

    /// Whether the value of a pixel can be used: the pixel is neither clipped nor invalid nor outside of the analyzed area.
    fn known(&self, pixel: usize) -> bool {
        let masks = self.input.masks;
        !masks.clipped(pixel) && !masks.invalid(pixel) && !masks.outside(pixel)
    }

    /// The usable pixels next to the pixels `from` that are in no ring yet.
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
        // Of each pixel: the neighbors inside the blob, and the sum and number of the usable neighbors outside.
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
