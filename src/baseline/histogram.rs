//! Section 7.2: the histogram of a feature, its peaks, and the valleys between them that are prominent enough to split a region.
//!
//! The steps and the names of their limits are those of Phoenix (Shafer & Kanade 1982; Laws 1982): the histogram is smoothed (`hsmooth`)
//! and cut at every valley; then the tests `maxmin`, `absarea`, `relarea`, `height`, `absmin` and `intsmax` remove valleys one by one, the
//! least prominent first, and the intervals beside a removed valley become one. Section 7.2 gives no formulas. Where the descriptions of
//! Phoenix leave a formula open (`absmin`, and the score), this file's formula stands beside the step.

use crate::params::PhoenixSettings;

/// Number of codes of a feature.
pub const CODES: usize = 256;

/// A valley between two intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Valley {
    /// First code of the interval above the valley.
    cut: usize,
    /// Smoothed height.
    height: f32,
}

/// The codes between two valleys.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval {
    /// Smoothed height of the highest code.
    peak: f32,
    /// Number of pixels.
    pixels: u32,
}

/// The intervals into which the valleys of a histogram divide the codes.
#[derive(Clone, Debug, PartialEq)]
pub struct Intervals {
    /// The histogram after smoothing, one height per code.
    pub smoothed: Vec<f32>,
    /// First code of each interval but the first, ascending.
    pub cuts: Vec<u8>,
    /// Score of the least prominent valley, 0…1000; 0 without a valley.
    pub score: f32,
}

impl Intervals {
    /// Searches the histogram of one feature: `counts` holds the number of pixels of each code.
    pub fn of(counts: &[u32; CODES], settings: &PhoenixSettings) -> Self {
        let mut search =
            Search { counts, smoothed: smoothed(counts, settings.hsmooth as usize), valleys: Vec::new() };
        search.valleys = valleys(&search.smoothed);
        search.keep_distinct_peaks(settings.maxmin as f32 / 100.0);
        let total: u32 = counts.iter().sum();
        let least =
            settings.absarea.max((u64::from(total) * u64::from(settings.relarea)).div_ceil(100) as u32);
        search.keep_large_intervals(least);
        search.keep_high_peaks(settings.height as f32 / 100.0);
        search.keep_low_valleys(settings.absmin as f32 / 100.0);
        search.keep_most_prominent(settings.intsmax as usize);
        let score = search.least_score();
        let cuts = search.valleys.iter().map(|valley| valley.cut as u8).collect();
        Self { smoothed: search.smoothed, cuts, score }
    }

    /// The number of the interval of each code, from 0.
    pub fn of_code(&self) -> [u8; CODES] {
        std::array::from_fn(|code| self.cuts.partition_point(|&cut| usize::from(cut) <= code) as u8)
    }

    /// Least and largest code of interval `number`.
    pub fn codes(&self, number: usize) -> [u8; 2] {
        let low = if number == 0 { 0 } else { self.cuts[number - 1] };
        [low, self.cuts.get(number).map_or(u8::MAX, |&cut| cut - 1)]
    }
}

/// The moving average of `width` codes, at the ends of those that exist.
fn smoothed(counts: &[u32; CODES], width: usize) -> Vec<f32> {
    let [before, after] = [(width - 1) / 2, width / 2];
    let mean = |code: usize| {
        let around = &counts[code.saturating_sub(before)..(code + after + 1).min(CODES)];
        around.iter().sum::<u32>() as f32 / around.len() as f32
    };
    (0..CODES).map(mean).collect()
}

/// Every valley: a run of codes of one height that is higher on both sides. The cut lies in the middle of the run.
fn valleys(smoothed: &[f32]) -> Vec<Valley> {
    let mut found = Vec::new();
    let mut start = 0;
    let mut falls = false;
    for run in smoothed.chunk_by(|a, b| a.to_bits() == b.to_bits()) {
        let next = smoothed.get(start + run.len());
        if falls && next.is_some_and(|next| *next > run[0]) {
            found.push(Valley { cut: start + run.len().div_ceil(2), height: run[0] });
        }
        falls = next.is_some_and(|next| *next < run[0]);
        start += run.len();
    }
    // A cut at the first code would leave an interval without codes.
    found.retain(|valley| (1..CODES).contains(&valley.cut));
    found
}

/// The search for prominent valleys.
struct Search<'a> {
    counts: &'a [u32; CODES],
    smoothed: Vec<f32>,
    /// The valleys that remain, ascending.
    valleys: Vec<Valley>,
}

impl Search<'_> {
    /// The intervals between the remaining valleys.
    fn intervals(&self) -> Vec<Interval> {
        let cuts = self.valleys.iter().map(|valley| valley.cut);
        let starts = std::iter::once(0).chain(cuts.clone());
        let ends = cuts.chain([CODES]);
        let of = |(start, end): (usize, usize)| Interval {
            peak: self.smoothed[start..end].iter().copied().fold(0.0, f32::max),
            pixels: self.counts[start..end].iter().sum(),
        };
        starts.zip(ends).map(of).collect()
    }

    /// The higher one of the valleys beside interval `number`, by its place in `valleys`; none without a valley.
    fn higher_valley(&self, number: usize) -> Option<usize> {
        let beside = [number.checked_sub(1), (number < self.valleys.len()).then_some(number)];
        let height = |&place: &usize| self.valleys[place].height;
        beside.into_iter().flatten().max_by(|a, b| height(a).total_cmp(&height(b)))
    }

    /// Removes valleys until no interval is worse than allowed: each time the higher valley beside the interval for which `badness` is
    /// largest. `badness` is none for an interval that passes.
    fn remove_while(&mut self, badness: impl Fn(&Self, usize, &Interval) -> Option<f32>) {
        loop {
            let intervals = self.intervals();
            let bad = intervals.iter().enumerate().filter_map(|(number, interval)| {
                Some((badness(self, number, interval)?, self.higher_valley(number)?))
            });
            let Some((_, valley)) = bad.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))) else {
                return;
            };
            self.valleys.remove(valley);
        }
    }

    /// `maxmin`: a peak is at least `ratio` times as high as the higher valley beside it.
    fn keep_distinct_peaks(&mut self, ratio: f32) {
        self.remove_while(|search, number, interval| {
            let valley = search.valleys[search.higher_valley(number)?].height;
            (interval.peak < ratio * valley).then(|| valley / interval.peak.max(f32::MIN_POSITIVE))
        });
    }

    /// `absarea` and `relarea`: an interval has at least `least` pixels.
    fn keep_large_intervals(&mut self, least: u32) {
        self.remove_while(|_, _, interval| (interval.pixels < least).then_some(-(interval.pixels as f32)));
    }

    /// `height`: a peak has at least this `share` of the second highest peak's height. The highest peak may be an outlier.
    fn keep_high_peaks(&mut self, share: f32) {
        self.remove_while(|search, _, interval| {
            (interval.peak < share * search.second_peak()).then_some(-interval.peak)
        });
    }

    /// `absmin`: above the lowest valley, a valley is no higher than this `share` of the second highest peak.
    fn keep_low_valleys(&mut self, share: f32) {
        let lowest = self.valleys.iter().map(|valley| valley.height).fold(f32::INFINITY, f32::min);
        let most = lowest + share * (self.second_peak() - lowest);
        self.valleys.retain(|valley| valley.height <= most);
    }

    /// `intsmax`: the valleys with the best scores remain, one fewer than `most` intervals.
    fn keep_most_prominent(&mut self, most: usize) {
        while self.valleys.len() + 1 > most {
            let scores = self.scores();
            let worst = (0..scores.len()).min_by(|&a, &b| scores[a].total_cmp(&scores[b]));
            let Some(worst) = worst else { return };
            self.valleys.remove(worst);
        }
    }

    /// Height of the second highest peak; of the only peak where there is one.
    fn second_peak(&self) -> f32 {
        let mut peaks: Vec<f32> = self.intervals().iter().map(|interval| interval.peak).collect();
        peaks.sort_by(|a, b| b.total_cmp(a));
        peaks.get(1).or(peaks.first()).copied().unwrap_or(0.0)
    }

    /// The score of each valley: 1000 × (1 − valley / lower peak beside it).
    fn scores(&self) -> Vec<f32> {
        let intervals = self.intervals();
        let score = |(place, valley): (usize, &Valley)| {
            let peak = intervals[place].peak.min(intervals[place + 1].peak);
            1000.0 * (1.0 - valley.height / peak.max(f32::MIN_POSITIVE))
        };
        self.valleys.iter().enumerate().map(score).collect()
    }

    /// The least score of the valleys; 0 without a valley.
    fn least_score(&self) -> f32 {
        self.scores().into_iter().reduce(f32::min).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A histogram of triangular peaks, each with its middle code, half width and height.
    fn peaks(peaks: &[(usize, usize, u32)]) -> [u32; CODES] {
        std::array::from_fn(|code| {
            let of = |&(middle, half, height): &(usize, usize, u32)| {
                let away = code.abs_diff(middle);
                if away >= half { 0 } else { height * (half - away) as u32 / half as u32 }
            };
            peaks.iter().map(of).sum()
        })
    }

    fn search(counts: &[u32; CODES]) -> Intervals {
        Intervals::of(counts, &PhoenixSettings::default())
    }

    #[test]
    fn one_peak_has_no_valley_and_two_have_one_in_the_middle() {
        let one = search(&peaks(&[(100, 30, 500)]));
        assert_eq!((one.cuts.len(), one.score), (0, 0.0));
        let two = search(&peaks(&[(60, 20, 500), (160, 20, 400)]));
        assert_eq!(two.cuts.len(), 1);
        assert!((100..=120).contains(&two.cuts[0]) && two.score > 999.0, "{two:?}");
        assert_eq!((two.codes(0), two.codes(1)), ([0, two.cuts[0] - 1], [two.cuts[0], 255]));
        assert_eq!([two.of_code()[60], two.of_code()[160]], [0, 1]);
        let empty = search(&[0; CODES]);
        assert!(empty.cuts.is_empty());
    }

    #[test]
    fn a_shallow_valley_a_small_interval_and_a_low_peak_do_not_count() {
        let shallow = search(&peaks(&[(100, 30, 500), (135, 30, 500)]));
        assert!(shallow.cuts.is_empty(), "maxmin: {shallow:?}");
        let small = search(&peaks(&[(60, 20, 500), (160, 4, 20)]));
        assert!(small.cuts.is_empty(), "relarea: {small:?}");
        let low = search(&peaks(&[(40, 20, 500), (110, 20, 500), (200, 20, 60)]));
        assert_eq!(low.cuts.len(), 1, "height: {low:?}");
    }

    #[test]
    fn intsmax_keeps_the_most_prominent_valleys() {
        let counts = peaks(&[(40, 28, 500), (90, 28, 500), (200, 20, 500)]);
        let two = search(&counts);
        assert_eq!(two.cuts.len(), 1);
        assert!(
            (115..=185).contains(&two.cuts[0]),
            "the empty valley, not that between overlapping peaks: {two:?}"
        );
        let three = Intervals::of(&counts, &PhoenixSettings { intsmax: 3, ..PhoenixSettings::default() });
        assert_eq!(three.cuts.len(), 2);
        assert!(three.score < two.score);
    }

    #[test]
    fn smoothing_keeps_the_mean_and_fills_the_gaps_of_single_codes() {
        let mut counts = peaks(&[(128, 60, 300)]);
        for code in (0..CODES).step_by(2) {
            counts[code] = 0;
        }
        assert!(search(&counts).cuts.is_empty());
        let unsmoothed = Intervals::of(
            &counts,
            &PhoenixSettings { hsmooth: 1, intsmax: 64, ..PhoenixSettings::default() },
        );
        assert!(unsmoothed.cuts.len() > 1);
    }
}
