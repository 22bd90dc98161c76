//! Section 5.1: the way that the paper rejects. The whole picture is projected into the color space, and the clusters found there are the
//! regions.
//!
//! The histogram of all pixels but the dark ones (`min_intensity`) has 32 bins per band and is smoothed by the mean of 3 × 3 × 3 bins. From each bin that holds pixels the
//! search climbs to the highest neighboring bin until none is higher; the bins that lead to one peak are a cluster. A cluster of fewer than
//! half a percent of the pixels joins the nearest larger one. Section 5.1 says where this fails: "when several objects with very similar
//! colors exist in the scene, such that color clusters from different objects overlap", as all do in the dark; and an elongated cluster has
//! several peaks.
//!
//! Measured: adjusted Rand index .48 on eight plastic objects and .52 on three cups (docs/baselines.md).

use super::region_list::RegionList;
use crate::raster::HypothesisId;
use crate::segment::AnalysisInput;
use crate::trace::{ColorPeak, ColorPeaksFound, PatchMade, Recorder};

/// Bins per band.
const SIDE: usize = 32;
/// Side of a bin, counts.
const BIN_COUNTS: f32 = 8.0;
/// Least share of the pixels in a cluster that remains.
const LEAST_SHARE: f64 = 0.005;

/// Makes a region of each cluster. `regions` holds no region yet.
pub fn top_down<R: Recorder>(input: &AnalysisInput, regions: &mut RegionList<R>) {
    let pixels: Vec<usize> = (0..input.pixels.len()).filter(|&pixel| !input.masks.dark(pixel)).collect();
    if pixels.is_empty() {
        return;
    }
    let bins = Bins::of(pixels.iter().map(|&pixel| input.pixels[pixel]));
    let clusters = bins.clusters((pixels.len() as f64 * LEAST_SHARE).ceil() as u32);
    if R::KEEPS {
        regions.record(ColorPeaksFound {
            bin_counts: BIN_COUNTS,
            pixels: pixels.len() as u32,
            absorbed: clusters.absorbed,
            least: clusters.least,
            peaks: clusters
                .peaks
                .iter()
                .map(|&(bin, pixels)| ColorPeak { color: middle(bin), pixels })
                .collect(),
        });
    }
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); clusters.peaks.len()];
    for pixel in pixels {
        members[clusters.of_bin[bin_of(input.pixels[pixel])] as usize].push(pixel as u32);
    }
    for (index, pixels) in members.iter().enumerate() {
        if input.stopped() {
            return;
        }
        let hypothesis = HypothesisId::from_index(index);
        let made =
            PatchMade { hypothesis, of: None, pixels: pixels.len() as u32, absorbed: 0, interval: None };
        regions.add(input, made, pixels);
    }
}

/// The bin of a color.
fn bin_of(color: [f32; 3]) -> usize {
    let [r, g, b] = color.map(|band| ((band / BIN_COUNTS) as usize).min(SIDE - 1));
    (r * SIDE + g) * SIDE + b
}

/// The place of a bin along each band.
fn place(bin: usize) -> [usize; 3] {
    [bin / (SIDE * SIDE), bin / SIDE % SIDE, bin % SIDE]
}

/// The color in the middle of a bin, counts.
fn middle(bin: usize) -> [f32; 3] {
    place(bin).map(|at| (at as f32 + 0.5) * BIN_COUNTS)
}

/// The bins beside a bin, itself among them, in their order.
fn around(bin: usize) -> impl Iterator<Item = usize> {
    let [r, g, b] = place(bin).map(|at| at.saturating_sub(1)..(at + 2).min(SIDE));
    r.flat_map(move |r| {
        let (g, b) = (g.clone(), b.clone());
        g.flat_map(move |g| b.clone().map(move |b| (r * SIDE + g) * SIDE + b))
    })
}

/// The histogram of the picture.
struct Bins {
    /// Number of pixels of each bin.
    counts: Vec<u32>,
    /// Sum over each bin and the bins around it.
    smoothed: Vec<u32>,
}

/// The clusters of the histogram.
struct Clusters {
    /// Number of the cluster of each bin that holds pixels.
    of_bin: Vec<u32>,
    /// The peak and the number of pixels of each cluster, the largest cluster first.
    peaks: Vec<(usize, u32)>,
    /// Number of clusters that were too small.
    absorbed: u32,
    /// Fewest pixels of a cluster that remains.
    least: u32,
}

impl Bins {
    fn of(colors: impl Iterator<Item = [f32; 3]>) -> Self {
        let mut counts = vec![0u32; SIDE * SIDE * SIDE];
        colors.for_each(|color| counts[bin_of(color)] += 1);
        let smoothed = (0..counts.len()).map(|bin| around(bin).map(|near| counts[near]).sum()).collect();
        Self { counts, smoothed }
    }

    /// The highest of the bins around a bin; of equals the first.
    fn higher(&self, bin: usize) -> usize {
        around(bin).max_by_key(|&near| (self.smoothed[near], std::cmp::Reverse(near))).unwrap_or(bin)
    }

    /// The peak that the search reaches from a bin.
    fn peak(&self, bin: usize) -> usize {
        let mut at = bin;
        loop {
            let next = self.higher(at);
            if next == at {
                return at;
            }
            at = next;
        }
    }

    /// The clusters of at least `least` pixels; the largest cluster remains in any case.
    fn clusters(&self, least: u32) -> Clusters {
        let filled: Vec<usize> = (0..self.counts.len()).filter(|&bin| self.counts[bin] > 0).collect();
        let peak_of: Vec<usize> = filled.iter().map(|&bin| self.peak(bin)).collect();
        let mut sizes = vec![0u32; self.counts.len()];
        for (&bin, &peak) in filled.iter().zip(&peak_of) {
            sizes[peak] += self.counts[bin];
        }
        let mut order: Vec<usize> = (0..sizes.len()).filter(|&bin| sizes[bin] > 0).collect();
        order.sort_by_key(|&peak| (std::cmp::Reverse(sizes[peak]), peak));
        let kept = order.iter().filter(|&&peak| sizes[peak] >= least).count().max(1);
        let absorbed = (order.len() - kept) as u32;
        order.truncate(kept);
        let mut peaks: Vec<(usize, u32)> = order.iter().map(|&peak| (peak, 0)).collect();
        let mut of_bin = vec![0; self.counts.len()];
        for (&bin, peak) in filled.iter().zip(peak_of) {
            let cluster = nearest(&order, peak);
            of_bin[bin] = cluster as u32;
            peaks[cluster].1 += self.counts[bin];
        }
        Clusters { of_bin, peaks, absorbed, least }
    }
}

/// The place in `peaks` of the peak nearest to `peak`; of equally near ones the first.
fn nearest(peaks: &[usize], peak: usize) -> usize {
    let from = place(peak);
    let distance2 =
        |&other: &usize| -> usize { place(other).iter().zip(from).map(|(&a, b)| a.abs_diff(b).pow(2)).sum() };
    (0..peaks.len()).min_by_key(|&index| distance2(&peaks[index])).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distant_colors_are_two_clusters_and_a_small_cluster_joins_the_nearest() {
        let colors = || {
            let two = std::iter::repeat_n([40.0, 40.0, 200.0], 300)
                .chain(std::iter::repeat_n([200.0, 40.0, 40.0], 200));
            two.chain(std::iter::repeat_n([200.0, 90.0, 40.0], 3))
        };
        let clusters = Bins::of(colors()).clusters(10);
        let sizes: Vec<u32> = clusters.peaks.iter().map(|peak| peak.1).collect();
        assert_eq!((sizes, clusters.absorbed), (vec![300, 203], 1));
        assert_eq!(clusters.of_bin[bin_of([200.0, 90.0, 40.0])], 1);
        assert_eq!(Bins::of(colors()).clusters(1).peaks.len(), 3);
    }
}
