//! The decisions of the earlier methods: Phoenix, which splits regions by the histograms of color features (section 7.2), and the
//! clusters of the whole picture's histogram (section 5.1).

use super::{EventData, Subject};
use crate::params::Feature;
use crate::raster::HypothesisId;
use crate::trace::Measured;

/// The histograms of a region were searched for valleys, and the region was split or found homogeneous (section 7.2).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HistogramsSearched {
    /// The region.
    pub hypothesis: HypothesisId,
    /// Number of its pixels.
    pub pixels: u32,
    /// The histogram of each feature, and what became of it.
    pub features: Vec<FeatureHistogram>,
}

/// The histogram of one feature over one region.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FeatureHistogram {
    /// The feature.
    pub feature: Feature,
    /// Smoothed number of pixels with each code, 0…255.
    pub smoothed: Vec<f32>,
    /// First code of each interval but the first: the places of the valleys that were kept.
    pub cuts: Vec<u8>,
    /// Score of the least prominent valley, and the least score (`absscore` or `relscore`), of 1000; value 0 without a valley.
    pub score: Measured<f32>,
    /// Number of pixels in patches smaller than `noise`; none where the feature was not tried on the picture.
    pub noise_px: Option<u32>,
    /// What became of the feature.
    pub verdict: FeatureVerdict,
}

/// What became of a feature of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FeatureVerdict {
    /// The histogram has no valley that passes the tests of peaks and valleys.
    NoValley,
    /// The score is below `absscore`.
    LowScore,
    /// The score is below `relscore` percent of the best feature's score.
    BelowBest,
    /// `isetsmax` features have better scores.
    NotTried,
    /// Less than `retain` percent of the region lies in patches of at least `noise` pixels.
    TooNoisy,
    /// Only one patch has at least `noise` pixels.
    OnePatch,
    /// Another feature leaves fewer pixels in small patches, or as few with a better score.
    Noisier,
    /// The region is split by this feature.
    Chosen,
}

impl FeatureVerdict {
    /// The name in trace lines.
    pub const fn name(self) -> &'static str {
        match self {
            Self::NoValley => "no valley",
            Self::LowScore => "low score",
            Self::BelowBest => "below the best",
            Self::NotTried => "not tried",
            Self::TooNoisy => "too noisy",
            Self::OnePatch => "one patch",
            Self::Noisier => "noisier",
            Self::Chosen => "chosen",
        }
    }
}

impl HistogramsSearched {
    /// The feature by which the region is split; none: the region is homogeneous.
    pub fn chosen(&self) -> Option<&FeatureHistogram> {
        self.features.iter().find(|feature| feature.verdict == FeatureVerdict::Chosen)
    }
}

/// A region of an earlier method was made; the claims that follow are its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PatchMade {
    /// The new region.
    pub hypothesis: HypothesisId,
    /// The region that it is a part of; none: of the whole picture.
    pub of: Option<HypothesisId>,
    /// Number of its pixels.
    pub pixels: u32,
    /// Number of these that were small patches and were absorbed.
    pub absorbed: u32,
    /// The codes of its other pixels; none where no feature decided.
    pub interval: Option<CodeInterval>,
}

/// An interval of the codes of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeInterval {
    /// The feature.
    pub feature: Feature,
    /// Least code.
    pub low: u8,
    /// Largest code.
    pub high: u8,
}

/// The peaks of the whole picture's histogram were found; each becomes a region (section 5.1).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ColorPeaksFound {
    /// Side of a bin of the histogram, counts.
    pub bin_counts: f32,
    /// Number of pixels.
    pub pixels: u32,
    /// Number of peaks with too few pixels, which were absorbed by the nearest other peak.
    pub absorbed: u32,
    /// Least number of pixels of a peak that remains.
    pub least: u32,
    /// The peaks that remain, in the order of their regions.
    pub peaks: Vec<ColorPeak>,
}

/// A peak of the histogram of the whole picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColorPeak {
    /// Middle of the highest bin, counts.
    pub color: [f32; 3],
    /// Number of the pixels of its cluster.
    pub pixels: u32,
}

impl EventData for HistogramsSearched {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), None]
    }

    fn heap_bytes(&self) -> usize {
        let of = |feature: &FeatureHistogram| size_of_val(feature.smoothed.as_slice()) + feature.cuts.len();
        size_of_val(self.features.as_slice()) + self.features.iter().map(of).sum::<usize>()
    }
}

impl EventData for PatchMade {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Hypothesis(self.hypothesis)), self.of.map(Subject::Hypothesis)]
    }
}

impl EventData for ColorPeaksFound {
    fn heap_bytes(&self) -> usize {
        size_of_val(self.peaks.as_slice())
    }
}
