//! Decisions about a pixel in words.

use super::super::events::{interval_text, passed_over, variances};
use super::local_history::{surroundings, unfit};
use super::reason::{NO_VALUE, OUTSIDE_AREA};
use super::{Names, ordinal, percent, signed, won};
use crate::color::Trial;
use crate::describe::{counted, grouped, grouped_decimals};
use crate::reflection::{SliceBound, SliceMiss};
use crate::trace::{
    Barrier, BorderLimit, Class, CodeInterval, HistoryEntry, HistoryKind, MarkedCluster, MaskVerdict,
    MergeStory, PixelKind, Reach, Release, SplitStory, WindowStory,
};

/// History entries that say nearly the same, as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Condensed {
    /// The last of these entries.
    pub last: HistoryEntry,
    /// Number of these entries.
    pub times: usize,
}

/// Combines claims and refusals by one hypothesis within one stage: a pixel is taken, given back and refused once in each round of
/// slices under a better light. The last entry stands for all. Oldest first, as given.
pub fn condense(history: &[HistoryEntry]) -> Vec<Condensed> {
    let mut condensed: Vec<Condensed> = Vec::new();
    let key = |entry: &HistoryEntry| match entry.what {
        HistoryKind::Refused { hypothesis, .. } => Some((entry.stage, 0, Some(hypothesis), None)),
        HistoryKind::Kept { holder, challenger, .. } => {
            Some((entry.stage, 1, Some(challenger), Some(holder)))
        }
        HistoryKind::Claimed { hypothesis, from, .. } => Some((entry.stage, 2, Some(hypothesis), from)),
        HistoryKind::Reset { from, to } => Some((entry.stage, 3, Some(from), to)),
        _ => None,
    };
    for entry in history {
        let known = key(entry);
        let mut times = 1;
        if known.is_some()
            && let Some(earlier) = condensed.iter().rposition(|earlier| key(&earlier.last) == known)
        {
            times += condensed.remove(earlier).times;
        }
        condensed.push(Condensed { last: entry.clone(), times });
    }
    condensed
}

impl Names {
    /// The sentence of a decision about a pixel.
    pub fn history_entry(&self, entry: &HistoryEntry) -> String {
        match &entry.what {
            HistoryKind::Masked(verdict) => masked(verdict),
            HistoryKind::Window(story) => window(story),
            HistoryKind::Merging(story) => merging(story),
            HistoryKind::AreaChosen { hypothesis, rank, pixels, radius } => format!(
                "its area, {} with {}, starts {}, radius {radius:.1} counts",
                ordinal(*rank),
                counted(*pixels, "unclaimed pixel"),
                self.hypothesis(*hypothesis)
            ),
            HistoryKind::AreaPassedOver { pixels, least, reason } => {
                format!("its area starts no hypothesis: {}", passed_over(*reason, *pixels, *least))
            }
            HistoryKind::Seeded { hypothesis, reach } => {
                format!("{} starts from it: {}", self.hypothesis(*hypothesis), inside(*reach))
            }
            HistoryKind::Claimed { hypothesis, from, reach, contest } => {
                let from_whom =
                    from.map_or_else(String::new, |from| format!(" from {}", self.hypothesis(from)));
                let how = match contest {
                    Some(contest) => format!("{}{}", won(contest), limit(*reach)),
                    None => inside(*reach),
                };
                format!("{} takes it{from_whom}: {how}", self.hypothesis(*hypothesis))
            }
            HistoryKind::Kept { holder, challenger, contest } => {
                let why = self.kept(*challenger, contest);
                format!("{} keeps it: {why}", self.hypothesis(*holder))
            }
            HistoryKind::Refused { hypothesis, barrier } => {
                format!(
                    "{} grows beside it and refuses it: {}",
                    self.hypothesis(*hypothesis),
                    outside(*barrier)
                )
            }
            HistoryKind::Unclaimable { hypotheses } => {
                format!(
                    "{} grew beside it, but its mask keeps it from being claimed by its color",
                    self.hypotheses(hypotheses)
                )
            }
            HistoryKind::Split(story) => split(self, story),
            HistoryKind::Surroundings(story) => surroundings(story),
            HistoryKind::Decided(event) => self.event(event),
            other => self.moved(other),
        }
    }

    /// The sentence of a change of owner that is no claim.
    fn moved(&self, what: &HistoryKind) -> String {
        match what {
            HistoryKind::Released { hypothesis, why } => {
                format!("{} gives it up: {}", self.hypothesis(*hypothesis), self.release(*why))
            }
            HistoryKind::Merged { from, into, angle_deg, rms } => format!(
                "with all of {} it joins {}: their lines differ by {angle_deg:.1}\u{b0}, rms distance {rms:.1} counts",
                self.hypothesis(*from),
                self.hypothesis(*into)
            ),
            HistoryKind::Voted { from, hypothesis, votes: [own, all] } => format!(
                "from {} it follows the majority to {}: {own} of {all} assigned pixels around it",
                self.hypothesis(*from),
                self.hypothesis(*hypothesis)
            ),
            HistoryKind::Reset { from, to: None } => {
                format!("{} gives it back: slices start anew under a better light", self.hypothesis(*from))
            }
            HistoryKind::Reset { from, to: Some(to) } => format!(
                "it goes back from {} to {}: slices start anew under a better light",
                self.hypothesis(*from),
                self.hypothesis(*to)
            ),
            HistoryKind::Filled { hypothesis, pixels, border_share } => format!(
                "a hole of {} around it goes to {}, which holds {} of its border",
                counted(*pixels, "pixel"),
                self.hypothesis(*hypothesis),
                percent(*border_share)
            ),
            HistoryKind::Separated { hypothesis, part, pixels } => format!(
                "with {} that lie apart from {} it becomes {}",
                counted(*pixels, "pixel"),
                self.hypothesis(*hypothesis),
                self.hypothesis(*part)
            ),
            HistoryKind::Patched { hypothesis, of, pixels, interval, code } => {
                let of = of.map_or_else(|| "the picture".to_owned(), |of| self.hypothesis(of));
                let size = counted(*pixels, "pixel");
                let part = format!("{}, a part of {of} ({size})", self.hypothesis(*hypothesis));
                patched(&part, *interval, *code)
            }
            HistoryKind::Marked { hypothesis, cluster, distance } => {
                let (of, what) = (self.hypothesis(*hypothesis), side_of_matte_line(*cluster));
                format!("it was marked and belongs to {of}: {what}, {distance:.1} counts from the matte line")
            }
            HistoryKind::Numbered { hypothesis, region: None } => {
                format!("hypothesis {hypothesis} is not in the result")
            }
            HistoryKind::Numbered { hypothesis, region: Some(region) } => {
                format!("hypothesis {hypothesis} becomes {}", self.region(*region))
            }
            // All other kinds have their sentences above.
            _ => String::new(),
        }
    }

    fn release(&self, why: Release) -> String {
        match why {
            Release::Refit { distance, radius } => {
                format!("{distance:.1} counts from its refitted axis, radius {radius:.1}")
            }
            Release::Barren { least, .. } => {
                format!("growing claimed fewer than {}", counted(least, "pixel"))
            }
            Release::Absorbed { by, highlight_foot: highlight, object_foot: object, gap } => format!(
                "it is the broad highlight of {}: its line misses black by {highlight:.1} counts (the object's by \
                 {object:.1}), gap {gap:.1}",
                self.hypothesis(by)
            ),
            Release::Dropped { pixels } => format!("too small to keep, {}", counted(pixels, "pixel")),
        }
    }
}

/// The sentence of a pixel's patch. `part`: the hypothesis, and what it is a part of. `code`: the pixel's code of the interval's feature.
fn patched(part: &str, interval: Option<CodeInterval>, code: u8) -> String {
    let Some(interval) = interval else { return format!("it belongs to {part}") };
    let (name, codes) = (interval.feature.name(), interval_text(interval));
    if (interval.low..=interval.high).contains(&code) {
        format!("its {name} {code} puts it into {part}: {codes}")
    } else {
        format!("its {name} is {code}, but its patch is small and absorbed by {part}: {codes}")
    }
}

/// On which side of the matte line a marked pixel lies, a clause.
const fn side_of_matte_line(cluster: MarkedCluster) -> &'static str {
    match cluster {
        MarkedCluster::Matte => "it is nearer to the matte line",
        MarkedCluster::Highlight => "it is not nearer to the matte line",
        _ => "it is clipped or bloomed, and no line is fitted to it",
    }
}

fn masked(verdict: &MaskVerdict) -> String {
    match *verdict {
        MaskVerdict::Believed { brightness: [from_black, dark], largest: [largest, clip] } => {
            let clip = if clip.is_finite() {
                format!("largest band {largest:.1}, clipped from {clip:.1} on")
            } else {
                "clipping is off".to_owned()
            };
            format!("believed: {from_black:.1} counts from black, dark below {dark:.1}; {clip}")
        }
        MaskVerdict::Outside => OUTSIDE_AREA.to_owned(),
        MaskVerdict::Invalid => NO_VALUE.to_owned(),
        MaskVerdict::ClippedObject { clipped, left } => format!(
            "part of a clipped object of {} or of its edge, no highlight: {} of the surface reflection would be left one pixel farther out, below {}",
            counted(clipped, "pixel"),
            percent(left.value),
            percent(left.limit)
        ),
        MaskVerdict::Dark { brightness: [from_black, dark] } => {
            format!("dark: {from_black:.1} counts from black, below {dark:.1}")
        }
        MaskVerdict::Clipped { largest: [largest, clip] } => {
            format!("clipped: largest band {largest:.1} counts, threshold {clip:.1}")
        }
        MaskVerdict::Bloomed { neighbors: [clipped, density] } => {
            format!("bloomed: {} clipped, {density} suffice", counted(clipped, "neighbor"))
        }
    }
}

fn window(story: &WindowStory) -> String {
    let WindowStory { size_px, pixels: [pixels, least], eigenvalues, trials, tail_test, class } = story;
    let [a, b, c] = variances(*eigenvalues);
    let place = format!("its window of {size_px} px");
    let Some(class) = class else {
        return format!("{place} has no class: {}, it needs {least}", counted(*pixels, "valid pixel"));
    };
    let tests: Vec<String> = trials.iter().map(|trial| tried(trial, *tail_test)).collect();
    format!(
        "{place} is a {}: variances {a}, {b}, {c} counts\u{b2} of {}; {}",
        class.name(),
        counted(*pixels, "pixel"),
        tests.join(", ")
    )
}

/// `beyond 1 direction χ² 95.2 ≤ 123.2`
fn tried(trial: &Trial, tail_test: bool) -> String {
    let relation = if trial.is_noise() { '\u{2264}' } else { '>' };
    let what = match (tail_test, trial.directions) {
        (true, 0) => "all of it".to_owned(),
        (true, n) => format!("beyond {}", counted(n, "direction")),
        (false, n) => format!("direction {}", n + 1),
    };
    format!("{what} {}", chi_square(trial, relation))
}

/// `χ² 95.2 ≤ 123.2`
fn chi_square(trial: &Trial, relation: char) -> String {
    let [statistic, threshold] =
        [trial.statistic(), trial.threshold()].map(|value| grouped_decimals(value, 1));
    format!("\u{3c7}\u{b2} {statistic} {relation} {threshold}")
}

fn merging(story: &MergeStory) -> String {
    let MergeStory { tried, joined, pixels, refusal, class } = story;
    let grown = format!(
        "its area, a {}, grows to {}: {} of {} kept the class",
        class.name(),
        counted(*pixels, "pixel"),
        grouped(*joined),
        counted(*tried, "union")
    );
    let Some(refusal) = refusal else { return grown };
    let test = refusal.trial.map_or_else(String::new, |trial| format!(" ({})", chi_square(&trial, '>')));
    let union = refusal.union.name();
    let union = if refusal.union == Class::Point { "only a point" } else { union };
    format!(
        "{grown}; the last refused, with {}, would be a {union}{test}",
        counted(refusal.neighbor_pixels, "pixel")
    )
}

/// `3.2 counts from its axis, radius 10.0`
fn inside(reach: Reach) -> String {
    match reach {
        Reach::Axis { distance, radius } => format!("{distance:.1} counts from its axis, radius {radius:.1}"),
        Reach::Plane { distance, half_width } => {
            format!("{distance:.1} counts from its plane, half width {half_width:.1}")
        }
        Reach::Brightness { brightness, start } => {
            format!("{brightness:.1} counts bright, its highlight starts at {start:.1}")
        }
    }
}

/// The limit of a reach, for a sentence that names the distance already.
fn limit(reach: Reach) -> String {
    match reach {
        Reach::Axis { radius, .. } => format!(", radius {radius:.1}"),
        Reach::Plane { half_width, .. } => format!(", half width {half_width:.1}"),
        Reach::Brightness { .. } => String::new(),
    }
}

fn outside(barrier: Barrier) -> String {
    match barrier {
        Barrier::Cylinder { distance, radius } => {
            format!("{distance:.1} counts from its axis, radius {radius:.1}")
        }
        Barrier::Slice(SliceMiss { bound, value, limit }) => match bound {
            SliceBound::Height => format!("{value:.1} counts from its plane, half width {limit:.1}"),
            SliceBound::Surface => format!(
                "{:.1} counts beyond the matte line, away from the light; {:.1} are allowed",
                -value, -limit
            ),
            SliceBound::Black => {
                format!("body reflection {value:.1} counts, at least {limit:.1} is allowed")
            }
            SliceBound::MatteEnd => {
                format!("body reflection {value:.1} counts, past the end of the matte line at {limit:.1}")
            }
        },
        Barrier::OtherBands { distance, limit } => format!(
            "its bands that do not clip are {distance:.1} counts from any body and surface reflection of it, at most {limit:.1}"
        ),
        Barrier::Darker { brightness, start } => {
            format!("{brightness:.1} counts bright, its highlight starts at {start:.1}")
        }
    }
}

fn split(names: &Names, story: &SplitStory) -> String {
    let region = names.region(story.region);
    if let Some(why) = &story.unfit {
        return unfit(&region, why);
    }
    let SplitStory { kind, lines, amounts, unsplit, cut, border, least_offset, ambient, .. } = story;
    let what = match (kind, lines) {
        (PixelKind::Restored, _) => "is restored from the bands that can be believed".to_owned(),
        (PixelKind::Lost, _) => "is clipped in every band: its split is a guess".to_owned(),
        (_, Some([matte, highlight])) => format!(
            "is {}: {matte:.1} counts from the matte line, {highlight:.1} from the highlight line",
            kind.name()
        ),
        (_, None) if *unsplit => format!("stays as it is: {region} has no highlight line"),
        (_, None) => format!("is {}: {region} has no highlight line", kind.name()),
    };
    let amounts = amounts.map_or_else(String::new, |amounts| {
        let none = cut.map_or_else(String::new, |offset| {
            format!(" ({offset:.1} counts off the body line, noise up to {least_offset:.1})")
        });
        format!(
            "; body {:.1}, surface {:.1}{none}, \u{3b5} {} counts",
            amounts.body,
            amounts.surface,
            signed(amounts.noise, 1)
        )
    });
    let without = if ambient.iter().all(|&band| band == 0.0) {
        String::new()
    } else {
        let [r, g, b] = ambient;
        format!(", without ambient light of {r:.1}, {g:.1}, {b:.1} counts")
    };
    let limited = border.map_or_else(String::new, |BorderLimit { kept, reach_px, .. }| {
        format!(
            "; {:.0} % of the surface stays, as much as further inside, because another region within {reach_px} px mixes its color",
            100.0 * kept
        )
    });
    format!("in {region} it {what}{amounts}{without}{limited}")
}
