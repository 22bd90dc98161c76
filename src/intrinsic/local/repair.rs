//! Rule `clip_repair`: the clipped core of a highlight takes the body reflection of the pixels around it.
//!
//! A blob of clipped pixels is filled where at least 40 % of the ring of 2 px around the blob are highlight, surface
//! reflection rises towards the blob, the body reflection of the ring is that of one material (its standard deviation
//! is at most half its mean, or that of the highlight pixels alone at most .3 of their mean, as the other pixels may have surface
//! reflection that is not known), and the highlight around the blob is at least half as large as the blob. The standard deviation is not that of one material
//! where an object in front of the highlight, or behind its rim, is part of the ring: of a blob of at most 400 pixels, pixels that the plane of a region explains do not
//! count (100 rendered pictures, body at JPEG 92 .25 dB on average, at most 5.5 dB, none loses). Blobs of more
//! than 40,000 pixels are not filled. The fill is harmonic: the smoothest that is continuous with the ring. Other
//! clipped pixels take the surface reflection of the pixels around them, which fades out towards larger blobs (`fade`): these are white
//! paper or the sky.

use super::desaturation_map::DesaturationMap;
use super::surroundings::{Surroundings, harmonic};
use crate::intrinsic::images::Images;
use crate::raster::{ComponentSearch, Connectivity, Mask, PixelIndex, Raster, Roi, pixels_where};
use crate::segment::AnalysisInput;
use crate::trace::{Measured, PixelKind, RepairTried, RepairVerdict};

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
/// Most pixels of a blob whose ring may lie in part on another object. Larger blobs are often white things: an apron, a hubcap.
const MOST_PIXELS_BESIDE_ANOTHER_OBJECT: usize = 400;
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
///
/// Where bands were restored by hue, what remains of a blob of `original` is one or more blobs of `input`. Each is filled where the ring
/// around it or the ring around the whole blob says so, and the verdict that says so is recorded.
pub fn fills(
    original: &AnalysisInput,
    input: &AnalysisInput,
    unexplained: &Mask,
    found: &LocalAmounts,
    mut record: impl FnMut(RepairTried, &[usize]),
) -> Vec<Fill> {
    let search = || ComponentSearch::new(unexplained.width(), unexplained.height(), Connectivity::Eight);
    let (mut whole_blobs, mut blobs) = (search(), search());
    let mut around_whole = Surroundings::new(original.masks);
    let mut surroundings = Surroundings::new(input.masks);
    let clipped_before = |pixel: usize| unexplained[pixel] && original.masks.clipped(pixel);
    let clipped = |pixel: usize| unexplained[pixel] && input.masks.clipped(pixel);
    let mut fills = Vec::new();
    for start in pixels_where(unexplained.len(), clipped_before) {
        let Some(whole) = whole_blobs.component_at(start, clipped_before) else { continue };
        if input.stopped() {
            break;
        }
        let mut tried_whole = None;
        for &first in whole {
            let Some(blob) = blobs.component_at(first, clipped) else { continue };
            let around = Around::of(blob, &mut surroundings, |pixel| found.is_highlight(pixel));
            let own = found.tried(input, unexplained, blob, &around);
            let tried = if own.verdict == RepairVerdict::Filled || blob.len() == whole.len() {
                own
            } else {
                *tried_whole.get_or_insert_with(|| {
                    let around = Around::of(whole, &mut around_whole, |pixel| found.is_highlight(pixel));
                    found.tried(original, unexplained, whole, &around)
                })
            };
            record(tried, blob);
            if tried.verdict == RepairVerdict::Filled {
                fills.push(Fill { blob: blob.to_vec(), rings: around.rings });
            }
        }
    }
    fills
}

/// The clipped pixels among the `unexplained` that are not filled, and those of clipped objects, in the window `roi`.
pub fn unfilled(input: &AnalysisInput, unexplained: &Mask, roi: &Roi, fills: &[Fill]) -> Mask {
    let mut unfilled = roi.raster(|pixel| {
        input.masks.clipped(pixel) && (unexplained[pixel] || input.masks.in_clipped_object(pixel))
    });
    for index in fills.iter().flat_map(|fill| &fill.blob).filter_map(|&pixel| roi.index(pixel)) {
        unfilled[index] = false;
    }
    unfilled
}

/// Fills blobs with the body reflection of their rings, sets the `confidence` of their pixels, and returns these pixels.
pub fn fill(
    input: &AnalysisInput,
    fills: &[Fill],
    images: &mut Images,
    confidence: &mut Raster<f32>,
) -> Mask {
    let mut all_filled = Mask::filled(confidence.width(), confidence.height(), false);
    for Fill { blob, rings } in fills {
        let filled = harmonic(input.masks.shape(), blob, rings, |pixel| images.body[pixel]);
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

    /// The verdict on a blob by the pixels around it. `unexplained`: the pixels that no region explains.
    fn tried(
        &self,
        input: &AnalysisInput,
        unexplained: &Mask,
        blob: &[usize],
        around: &Around,
    ) -> RepairTried {
        let [inner, outer] = &around.rings;
        let ring_pixels = || inner.iter().chain(outer).copied();
        let count = ring_pixels().count().max(1) as f32;
        let mean = |pixels: &[usize]| {
            pixels.iter().map(|&pixel| self.amount(pixel)).sum::<f32>() / pixels.len().max(1) as f32
        };
        let share = ring_pixels().filter(|&pixel| self.is_highlight(pixel)).count() as f32 / count;
        let highlight_share = Measured::new(share, LEAST_HIGHLIGHT);
        let may_lie_on_another_object = blob.len() <= MOST_PIXELS_BESIDE_ANOTHER_OBJECT;
        let of_this_object = |pixel: &usize| !may_lie_on_another_object || unexplained[*pixel];
        let spread = self.spread(input, ring_pixels().filter(of_this_object));
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
        let pixel = PixelIndex::from_index(blob.iter().min().copied().unwrap_or(0));
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

impl Around {
    /// The pixels around `blob`.
    fn of(blob: &[usize], surroundings: &mut Surroundings, is_highlight: impl Fn(usize) -> bool) -> Self {
        let reach_px = AROUND_PX.max(0.5 * (blob.len() as f32).sqrt()) as usize;
        let enough = (LEAST_AROUND * blob.len() as f32).ceil() as usize;
        let mut highlights = 0;
        let rings = surroundings.rings(blob, |number, ring| {
            highlights += ring.iter().filter(|&&pixel| is_highlight(pixel)).count();
            number < reach_px && highlights < enough
        });
        Self { rings, highlights }
    }
}
