//! Section 7.2: Phoenix, recursive region splitting by histograms (Shafer & Kanade 1982; Ohlander, Price & Reddy 1978).
//!
//! The whole picture is the first region. For every feature the histogram of a region is searched for prominent valleys (`histogram.rs`).
//! The features with the best scores (`absscore`, `relscore`, `isetsmax`) are tried on the picture: the region is cut into connected
//! patches of one interval each, and the feature wins that leaves the fewest pixels in patches smaller than `noise`. These are absorbed by the
//! patches around them. Every patch is a region, and is searched in its turn, until no feature has a valley, the region is smaller than
//! `splitmin`, or `depth` is reached.
//!
//! Clipped and bloomed pixels take part: the system knows no camera. Deviation: dark pixels (`min_intensity`) take no part, as in the paper's
//! own method. Their hue and saturation are noise, and on rendered scenes the noise of a black background decides everything: with dark
//! pixels, the first feature that leaves two patches cuts specks out of the background until no two patches of 10 px are left (adjusted Rand
//! index .00 on three scenes).
//!
//! Measured with the defaults: adjusted Rand index .81 on eight plastic objects and .91 on three cups (docs/baselines.md).

use super::histogram::{CODES, Intervals};
use super::patches::{Buffers, Patch, Patches};
use super::region_list::RegionList;
use crate::params::{Feature, PhoenixSettings};
use crate::raster::HypothesisId;
use crate::segment::AnalysisInput;
use crate::trace::{
    CodeInterval, FeatureHistogram, FeatureVerdict, HistogramsSearched, Measured, PatchMade, Recorder,
};
use rayon::prelude::*;

/// Splits the picture into regions. `regions` holds no region yet.
pub fn phoenix<R: Recorder>(input: &AnalysisInput, settings: &PhoenixSettings, regions: &mut RegionList<R>) {
    let codes = settings.features.iter().map(|feature| FeatureImage::new(input, feature)).collect();
    let (width, height) = (input.pixels.width(), input.pixels.height());
    let mut splitter = Splitter { settings, images: codes, buffers: Buffers::new(width, height), regions };
    let is_lit = |&pixel: &u32| !input.masks.dark(pixel as usize);
    let whole: Vec<u32> = (0..input.pixels.len() as u32).filter(is_lit).collect();
    if whole.is_empty() {
        return;
    }
    let made = PatchMade {
        hypothesis: HypothesisId::from_index(0),
        of: None,
        pixels: whole.len() as u32,
        absorbed: 0,
        interval: None,
    };
    splitter.regions.add(input, made, &whole);
    let mut waiting =
        std::collections::VecDeque::from([Region { hypothesis: made.hypothesis, pixels: whole, depth: 0 }]);
    while let Some(region) = waiting.pop_front() {
        if input.stopped() {
            return;
        }
        splitter.split(input, &region, &mut waiting);
    }
}

/// The codes of a feature, one per pixel.
struct FeatureImage {
    feature: Feature,
    codes: Vec<u8>,
}

impl FeatureImage {
    fn new(input: &AnalysisInput, feature: Feature) -> Self {
        Self {
            feature,
            codes: input.pixels.as_slice().par_iter().map(|&color| feature.code(color)).collect(),
        }
    }

    /// Number of a region's pixels with each code.
    fn counts(&self, pixels: &[u32]) -> [u32; CODES] {
        let mut counts = [0; CODES];
        for &pixel in pixels {
            counts[usize::from(self.codes[pixel as usize])] += 1;
        }
        counts
    }
}

/// A region that waits to be searched.
struct Region {
    hypothesis: HypothesisId,
    /// Its pixels, ascending.
    pixels: Vec<u32>,
    /// Number of splits between the picture and the region.
    depth: u32,
}

/// A feature of a region, on its way through the tests.
struct Candidate {
    /// Place of the feature among the images.
    image: usize,
    intervals: Intervals,
    least_score: f32,
    patches: Option<Patches>,
    verdict: FeatureVerdict,
}

struct Splitter<'a, 'r, R: Recorder> {
    settings: &'a PhoenixSettings,
    images: Vec<FeatureImage>,
    buffers: Buffers,
    regions: &'a mut RegionList<'r, R>,
}

impl<R: Recorder> Splitter<'_, '_, R> {
    /// Searches one region, and divides it where a feature has a prominent valley; the parts are appended to `waiting`.
    fn split(
        &mut self,
        input: &AnalysisInput,
        region: &Region,
        waiting: &mut std::collections::VecDeque<Region>,
    ) {
        let settings = self.settings;
        if region.depth >= settings.depth || region.pixels.len() < settings.splitmin as usize {
            return;
        }
        let mut candidates: Vec<Candidate> =
            (0..self.images.len()).map(|image| self.search(image, region)).collect();
        self.select(&mut candidates);
        for candidate in &mut candidates {
            self.try_on_picture(candidate, region);
        }
        let chosen = choose(&mut candidates);
        if R::KEEPS {
            self.record(region, &candidates);
        }
        let Some(Candidate { image, intervals, patches: Some(patches), .. }) =
            chosen.map(|place| candidates.swap_remove(place))
        else {
            return;
        };
        let feature = self.images[image].feature;
        for patch in self.buffers.absorbed(patches, settings.noise) {
            let Some(hypothesis) = self.regions.next_id() else { return };
            let Patch { interval, pixels, absorbed } = patch;
            let [low, high] = intervals.codes(usize::from(interval));
            let made = PatchMade {
                hypothesis,
                of: Some(region.hypothesis),
                pixels: pixels.len() as u32,
                absorbed,
                interval: Some(CodeInterval { feature, low, high }),
            };
            self.regions.add(input, made, &pixels);
            waiting.push_back(Region { hypothesis, pixels, depth: region.depth + 1 });
        }
    }

    /// The intervals of one feature in a region.
    fn search(&self, image: usize, region: &Region) -> Candidate {
        let intervals = Intervals::of(&self.images[image].counts(&region.pixels), self.settings);
        let least_score = self.settings.absscore as f32;
        let verdict = if intervals.cuts.is_empty() {
            FeatureVerdict::NoValley
        } else if intervals.score < least_score {
            FeatureVerdict::LowScore
        } else {
            FeatureVerdict::NotTried
        };
        Candidate { image, intervals, least_score, patches: None, verdict }
    }

    /// Leaves the verdict [`FeatureVerdict::NotTried`] to the features that are to be tried, and to those beyond `isetsmax`.
    fn select(&self, candidates: &mut [Candidate]) {
        let open = |candidate: &&mut Candidate| candidate.verdict == FeatureVerdict::NotTried;
        let best =
            candidates.iter_mut().filter(open).map(|candidate| candidate.intervals.score).reduce(f32::max);
        let least = best.unwrap_or(0.0) * self.settings.relscore as f32 / 100.0;
        for candidate in candidates.iter_mut().filter(open) {
            candidate.least_score = candidate.least_score.max(least);
            if candidate.intervals.score < least {
                candidate.verdict = FeatureVerdict::BelowBest;
            }
        }
        let mut order: Vec<&mut Candidate> = candidates.iter_mut().filter(open).collect();
        order.sort_by(|a, b| b.intervals.score.total_cmp(&a.intervals.score));
        for candidate in order.into_iter().take(self.settings.isetsmax as usize) {
            candidate.verdict = FeatureVerdict::Noisier;
        }
    }

    /// Cuts the region by a feature that is to be tried, and judges the patches.
    fn try_on_picture(&mut self, candidate: &mut Candidate, region: &Region) {
        if candidate.verdict != FeatureVerdict::Noisier {
            return;
        }
        let (codes, of_code) = (&self.images[candidate.image].codes, candidate.intervals.of_code());
        let interval_of = |pixel: u32| of_code[usize::from(codes[pixel as usize])];
        let patches = self.buffers.patches(&region.pixels, interval_of, self.settings.noise);
        let all = region.pixels.len() as u64;
        let retained = all - u64::from(patches.noise_px);
        if retained * 100 < all * u64::from(self.settings.retain) {
            candidate.verdict = FeatureVerdict::TooNoisy;
        } else if patches.large < 2 {
            candidate.verdict = FeatureVerdict::OnePatch;
        }
        candidate.patches = Some(patches);
    }

    fn record(&mut self, region: &Region, candidates: &[Candidate]) {
        let histogram = |candidate: &Candidate| FeatureHistogram {
            feature: self.images[candidate.image].feature,
            smoothed: candidate.intervals.smoothed.clone(),
            cuts: candidate.intervals.cuts.clone(),
            score: Measured::new(candidate.intervals.score, candidate.least_score),
            noise_px: candidate.patches.as_ref().map(|patches| patches.noise_px),
            verdict: candidate.verdict,
        };
        let features = candidates.iter().map(histogram).collect();
        let (hypothesis, pixels) = (region.hypothesis, region.pixels.len() as u32);
        self.regions.record(HistogramsSearched { hypothesis, pixels, features });
    }
}

/// The place of the feature that leaves the fewest pixels in small patches, of equals the one with the best score; its verdict becomes
/// [`FeatureVerdict::Chosen`].
fn choose(candidates: &mut [Candidate]) -> Option<usize> {
    let key = |candidate: &Candidate| {
        let noise_px = candidate.patches.as_ref().map(|patches| patches.noise_px);
        (candidate.verdict == FeatureVerdict::Noisier).then_some((noise_px?, candidate.intervals.score))
    };
    let tried = candidates.iter().enumerate().filter_map(|(place, candidate)| Some((place, key(candidate)?)));
    let better =
        |a: &(usize, (u32, f32)), b: &(usize, (u32, f32))| a.1.0.cmp(&b.1.0).then(b.1.1.total_cmp(&a.1.1));
    let (place, _) = tried.min_by(better)?;
    candidates[place].verdict = FeatureVerdict::Chosen;
    Some(place)
}
