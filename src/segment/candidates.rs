//! Section 5.4.1: which neighbor is the highlight of a matte region?
//!
//! A highlight cluster and the matte line form a skewed T: the lines pass near one another, in the upper 50 % of the matte
//! line, and the highlight's direction is positive in every band. The 50 % test decides most: without it there are 415
//! more false acceptances and 41 more true ones.
//!
//! The candidates are the leftover pixels of the merged areas (the pixels that linear growth has not claimed; with whole areas
//! the illuminant is off by 2.93° instead of 2.61°), neighboring linear regions, and regions absorbed as broad highlights.
//!
//! Before the 50 % heuristic, "Gershon has tested whether two clusters are nearly parallel or whether they intersect" (Gershon, Jepson &
//! Tsotsos 1987). His test stands beside it in every record, and decides in its place under the reading `gershon_test`: lines that meet and
//! differ by [`PARALLEL_DEG`] or more intersect. The text names no angle. On nine scenes with known truth, of 181 candidates (144 highlights)
//! the 50 % heuristic accepts 105 highlights and nothing else, Gershon's test 109 highlights and 17 others: lines that meet in the dark.
//!
//! The text can be read in several ways. The readings `distorted_candidates`, `all_neighbors`, `gap_within_noise`,
//! `strict_upper_half`, `beyond_meeting_point` and `chosen_start` choose among them; `params/reading.rs` quotes the text.

use super::absorb::is_positive;
use super::borders::near_hypotheses;
use super::classify::{Classifier, Windows};
use super::input::AnalysisInput;
use super::linear::Hypothesis;
use super::merge::Areas;
use super::recorded_labels::Members;
use crate::color::{Line, Moments, Vec3, axis_angle_deg, closest_points};
use crate::photo::Masks;
use crate::raster::{HypothesisId, LabelMap, UNASSIGNED, pixels_where};
use crate::trace::{
    CandidateChosen, CandidateSource, CandidateTested, CandidateVerdict, Class, Measured, Recorder,
};
use std::collections::{BTreeMap, BTreeSet};

/// Fewest pixels of a candidate; the reading `all_neighbors` has no such limit.
const MIN_PIXELS: f64 = 10.0;
/// Pixels of a neighboring region that its line is taken from, evenly chosen.
const CLUSTER_SAMPLES: usize = 4000;
/// Limits of the meeting point on the matte line, as shares of its length: the 50 % heuristic of section 3.2, and a tolerance
/// beyond the end of the line, to which the radius of the cylinder is added. The reading `strict_upper_half` has no tolerance.
const UPPER: [f64; 2] = [0.5, 1.1];

/// Angle between two lines below which clusters are nearly parallel, degrees (Gershon's test).
const PARALLEL_DEG: f64 = 10.0;

/// The highlight line of a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighlightLine {
    /// Weighted mean of all accepted meeting points, on the matte line, counts. Under the reading `chosen_start` the meeting point of
    /// the candidate nearest to this mean.
    pub start: Vec3,
    /// Unit direction of the candidate nearest to it.
    pub direction: Vec3,
    /// Pixels of all accepted candidates.
    pub pixels: f64,
}

/// The results of the earlier stages.
pub struct EarlierStages<'a> {
    /// The windows (section 5.2.1).
    pub windows: &'a Windows,
    /// The merged areas (section 5.2.2).
    pub areas: &'a Areas,
    /// Linear region of each pixel.
    pub labels: &'a LabelMap,
    /// The linear hypotheses.
    pub hypotheses: &'a [Hypothesis],
}

/// The highlight line of every region, whose pixels are `members` and whose matte lines are `lengths` long (counts); `None`
/// for a region of which no candidate passed the tests.
pub fn highlight_lines<R: Recorder>(
    input: &AnalysisInput,
    earlier: &EarlierStages,
    members: &Members,
    lengths: &[f64],
    recorder: &mut R,
) -> Vec<Option<HighlightLine>> {
    let EarlierStages { labels, hypotheses, .. } = *earlier;
    let mut neighbors = leftover_neighbors(input, earlier);
    let mut clusters: BTreeMap<HypothesisId, Moments> = BTreeMap::new();
    for (a, b) in near_hypotheses(labels, 1) {
        for (own, other) in [(a, b), (b, a)] {
            let cluster = clusters.entry(other).or_insert_with(|| {
                members
                    .region(other)
                    .sample(input.fit_samples(CLUSTER_SAMPLES))
                    .map(|pixel| input.pixels[pixel as usize])
                    .collect()
            });
            neighbors.entry(own).or_default().push((CandidateSource::Hypothesis(other), *cluster));
        }
    }
    let mut classifier = Classifier::new(input.used.camera_noise, input.refine.tail_test);
    HypothesisId::all(hypotheses.len())
        .map(|id| {
            let hypothesis = &hypotheses[id.index()];
            if !hypothesis.alive {
                return None;
            }
            let mut clusters = neighbors.remove(&id).unwrap_or_default();
            clusters.extend_from_slice(&hypothesis.highlights);
            let length = lengths[id.index()];
            let mut tests = Tests { input, hypothesis: id, matte: hypothesis.line, length, recorder };
            let accepted: Vec<Accepted> = clusters
                .iter()
                .filter(|(_, cluster)| {
                    let all = input.readings.all_neighbors;
                    all || (cluster.n >= MIN_PIXELS && classifier.classify(cluster).0 != Class::Point)
                })
                .filter_map(|(source, cluster)| tests.run(*source, cluster))
                .collect();
            tests.choose(&accepted)
        })
        .collect()
}

/// Whether a pixel is left over from the linear stage: it belongs to no region and its color is used. The leftover pixels of a
/// merged area are one highlight candidate.
#[inline]
pub fn is_leftover(labels: &LabelMap, masks: &Masks, pixel: usize) -> bool {
    labels[pixel] == UNASSIGNED && masks.usable(pixel)
}

/// Whether a pixel belongs to the candidate of its merged area: it is left over, and its color is used or, where candidates contain
/// distorted pixels (`with_distorted`, reading `distorted_candidates`), clipped or bloomed.
#[inline]
pub fn is_of_candidate(labels: &LabelMap, masks: &Masks, with_distorted: bool, pixel: usize) -> bool {
    if with_distorted {
        labels[pixel] == UNASSIGNED && masks.claimable_by_color(pixel, false)
    } else {
        is_leftover(labels, masks, pixel)
    }
}

/// For each region, the leftover pixels of every merged area of which a leftover pixel is a 4-neighbor of the region.
fn leftover_neighbors(
    input: &AnalysisInput,
    earlier: &EarlierStages,
) -> BTreeMap<HypothesisId, Vec<(CandidateSource, Moments)>> {
    let EarlierStages { windows, areas, labels, .. } = *earlier;
    let width = labels.width();
    let mut leftovers: BTreeMap<u32, Moments> = BTreeMap::new();
    let mut touching: BTreeSet<(HypothesisId, u32)> = BTreeSet::new();
    let with_distorted = input.readings.distorted_candidates;
    let is_of_candidate = |pixel: usize| is_of_candidate(labels, input.masks, with_distorted, pixel);
    for pixel in pixels_where(labels.len(), is_of_candidate) {
        let area = areas.of_window[windows.window_of(pixel, width)];
        leftovers.entry(area).or_default().add(input.pixels[pixel]);
        labels.for_each_neighbor(pixel, |near| {
            if let Some(hypothesis) = HypothesisId::from_label(labels[near]) {
                touching.insert((hypothesis, area));
            }
        });
    }
    let mut neighbors: BTreeMap<HypothesisId, Vec<_>> = BTreeMap::new();
    for (hypothesis, area) in touching {
        if let Some(&cluster) = leftovers.get(&area) {
            neighbors.entry(hypothesis).or_default().push((CandidateSource::Leftover(area), cluster));
        }
    }
    neighbors
}

/// The matte line of a hypothesis.
pub struct MatteLine {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// The line.
    pub line: Line,
    /// Length of the line from black, counts.
    pub length: f64,
}

/// The highlight line of pixels that a person has marked, whose highlight pixels have the moments `cluster`; `None` where the tests of a
/// skewed T fail. The 50 % heuristic is measured and does not decide.
pub fn marked_highlight_line<R: Recorder>(
    input: &AnalysisInput,
    matte: &MatteLine,
    cluster: &Moments,
    recorder: &mut R,
) -> Option<HighlightLine> {
    let MatteLine { hypothesis, line, length } = *matte;
    let mut tests = Tests { input, hypothesis, matte: line, length, recorder };
    let accepted = tests.run(CandidateSource::Marked, cluster);
    tests.choose(accepted.as_slice())
}

/// A candidate that passed the tests.
struct Accepted {
    source: CandidateSource,
    /// The point of the matte line that is nearest to the candidate's line, counts.
    meeting_point: Vec3,
    /// Unit direction of the candidate's line.
    direction: Vec3,
    /// Number of the candidate's pixels.
    pixels: f64,
}

/// The limits of the skewed-T tests of one region.
struct Limits {
    /// Largest distance between both lines, counts: the radius of the cylinder, or the camera noise under the reading
    /// `gap_within_noise`.
    gap: f64,
    /// Least and largest position of the meeting point on the matte line, counts.
    position: [f64; 2],
    /// The same in percent of the length of the matte line.
    position_percent: [f64; 2],
}

impl Limits {
    /// The limits for a matte line of a length in counts.
    fn new(input: &AnalysisInput, length: f64) -> Self {
        let (used, readings) = (input.used, input.readings);
        let radius = used.radius_counts();
        let gap = if readings.gap_within_noise { used.camera_noise } else { radius };
        let lower = UPPER[0] * length;
        let percent = |position: f64| 100.0 * position / length.max(f64::MIN_POSITIVE);
        if readings.strict_upper_half {
            return Self { gap, position: [lower, length], position_percent: [100.0 * UPPER[0], 100.0] };
        }
        let position_percent = [100.0 * UPPER[0], 100.0 * UPPER[1] + percent(radius)];
        Self { gap, position: [lower, UPPER[1] * length + radius], position_percent }
    }
}

/// The skewed-T tests of one region's candidates.
struct Tests<'a, 's, R: Recorder> {
    input: &'a AnalysisInput<'s>,
    hypothesis: HypothesisId,
    /// Matte line of the hypothesis, and its length from black, counts.
    matte: Line,
    length: f64,
    recorder: &'a mut R,
}

impl<R: Recorder> Tests<'_, '_, R> {
    /// Tests one candidate, whose colors have the moments `cluster`; `None` where the candidate fails.
    fn run(&mut self, source: CandidateSource, cluster: &Moments) -> Option<Accepted> {
        let line = Line::principal(cluster)?;
        let (on_matte, on_candidate) = closest_points(&self.matte, &line)?;
        let limits = Limits::new(self.input, self.length);
        let gap = (on_matte - on_candidate).norm();
        let position = on_matte.dot(&self.matte.direction);
        let angle_deg = Measured::new(axis_angle_deg(&line.direction, &self.matte.direction), PARALLEL_DEG);
        let lies_beyond = (line.mean - on_candidate).dot(&line.direction) >= 0.0;
        let verdict = CandidateVerdict {
            lines_meet: gap <= limits.gap,
            upper_half: position >= limits.position[0] && position <= limits.position[1],
            not_parallel: angle_deg.value >= angle_deg.limit,
            by_gershon: self.input.readings.gershon_test,
            is_marked: source == CandidateSource::Marked,
            positive: is_positive(&line.direction),
            beyond: lies_beyond || !self.input.readings.beyond_meeting_point,
        };
        if R::KEEPS {
            let percent = |position: f64| 100.0 * position / self.length.max(f64::MIN_POSITIVE);
            self.recorder.record(CandidateTested {
                hypothesis: self.hypothesis,
                candidate: source,
                pixels: cluster.n as u32,
                matte: self.matte,
                matte_length: self.length,
                line,
                meeting: [on_matte, on_candidate],
                gap: Measured::new(gap, limits.gap),
                position_percent: percent(position),
                position_limits: limits.position_percent,
                angle_deg,
                verdict,
                weight: if verdict.accepted() { cluster.n } else { 0.0 },
                with_distorted: self.input.readings.distorted_candidates,
            });
        }
        verdict.accepted().then_some(Accepted {
            source,
            meeting_point: on_matte,
            direction: line.direction,
            pixels: cluster.n,
        })
    }

    /// The highlight line: the direction of the accepted candidate whose meeting point is nearest to the mean of all meeting
    /// points, weighted by their pixels. `None` without an accepted candidate.
    fn choose(&mut self, accepted: &[Accepted]) -> Option<HighlightLine> {
        let pixels: f64 = accepted.iter().map(|candidate| candidate.pixels).sum();
        let sum: Vec3 = accepted.iter().map(|candidate| candidate.meeting_point * candidate.pixels).sum();
        let start = sum / pixels.max(1.0);
        let from_mean = |candidate: &Accepted| (candidate.meeting_point - start).norm();
        let chosen = accepted.iter().min_by(|a, b| from_mean(a).total_cmp(&from_mean(b)))?;
        if R::KEEPS {
            self.recorder.record(CandidateChosen {
                hypothesis: self.hypothesis,
                candidate: chosen.source,
                meeting_point: start,
                direction: chosen.direction,
            });
        }
        let is_chosen_start = self.input.readings.chosen_start;
        let start = if is_chosen_start { chosen.meeting_point } else { start };
        Some(HighlightLine { start, direction: chosen.direction, pixels })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::rgb;
    use crate::params::Readings;
    use crate::segment::testing::Drawing;
    use crate::trace::{Stage, Step, TraceRecorder};

    const LENGTH: f64 = 160.0;

    fn body() -> Vec3 {
        Vec3::new(0.9, 0.3, 0.2).normalize()
    }

    fn white() -> Vec3 {
        Vec3::repeat(1.0).normalize()
    }

    /// The verdict on twenty colors from `start` on along `direction`: lines meet, upper half, positive, beyond.
    fn verdict(start: Vec3, direction: Vec3) -> [bool; 4] {
        let drawing = Drawing::new(&["."], |_| Vec3::zeros());
        let cluster: Moments =
            (1..=20).map(|step| rgb(&(start + direction * (f64::from(step) * 4.0)))).collect();
        let matte = Line::new(body() * LENGTH / 2.0, body());
        let mut recorder = TraceRecorder::default();
        let mut tests = Tests {
            input: &drawing.input(),
            hypothesis: HypothesisId::from_index(0),
            matte,
            length: LENGTH,
            recorder: &mut recorder,
        };
        let accepted = tests.run(CandidateSource::Hypothesis(HypothesisId::from_index(1)), &cluster);
        let stage_trace = recorder.finish(Stage::Planar).unwrap();
        let Some(Step::Event(crate::trace::Event::CandidateTested(test))) = stage_trace.step(0) else {
            panic!("one test, one event: {stage_trace:?}")
        };
        let verdict = test.verdict;
        assert_eq!((stage_trace.len(), accepted.is_some()), (1, verdict.accepted()));
        [verdict.lines_meet, verdict.upper_half, verdict.positive, verdict.beyond]
    }

    #[test]
    fn gershons_test_refuses_nearly_parallel_clusters_and_accepts_those_that_meet_in_the_dark() {
        let verdict = |readings: Readings, start: Vec3, direction: Vec3| {
            let drawing = Drawing::new(&["."], |_| Vec3::zeros());
            let cluster: Moments =
                (1..=20).map(|step| rgb(&(start + direction * (f64::from(step) * 4.0)))).collect();
            let mut recorder = crate::trace::NoopRecorder;
            let mut tests = Tests {
                input: &drawing.input().with_readings(readings),
                hypothesis: HypothesisId::from_index(0),
                matte: Line::new(body() * LENGTH / 2.0, body()),
                length: LENGTH,
                recorder: &mut recorder,
            };
            tests.run(CandidateSource::Hypothesis(HypothesisId::from_index(1)), &cluster).is_some()
        };
        let gershon = Readings { gershon_test: true, ..Readings::REFINED };
        let nearly = (body() + white() * 0.1).normalize();
        let in_the_dark = body() * (0.1 * LENGTH);
        for (readings, parallel, dark) in [(Readings::REFINED, true, false), (gershon, false, true)] {
            assert_eq!(verdict(readings, body() * (0.75 * LENGTH), nearly), parallel);
            assert_eq!(verdict(readings, in_the_dark, white()), dark);
            assert!(verdict(readings, body() * (0.75 * LENGTH), white()), "both accept a highlight");
        }
    }

    #[test]
    fn a_skewed_t_passes_and_each_test_can_fail_alone() {
        let start = body() * (0.75 * LENGTH);
        let across = body().cross(&white()).normalize();
        assert_eq!(verdict(start, white()), [true; 4]);
        assert_eq!(verdict(start + across * 30.0, white()), [false, true, true, true]);
        assert_eq!(verdict(body() * (0.3 * LENGTH), white()), [true, false, true, true]);
        let negative = Vec3::new(0.8, 0.5, -0.3).normalize();
        assert_eq!(verdict(start, negative), [true, true, false, true]);
        let below = start - white() * 90.0;
        assert_eq!(verdict(below, white()), [true, true, true, false]);
    }

    #[test]
    fn the_chosen_candidate_meets_the_matte_line_nearest_to_the_mean_of_all() {
        let drawing = Drawing::new(&["."], |_| Vec3::zeros());
        let accepted = |share: f64, direction: Vec3, pixels: f64| Accepted {
            source: CandidateSource::Leftover(0),
            meeting_point: body() * (share * LENGTH),
            direction,
            pixels,
        };
        let mut silent = crate::trace::NoopRecorder;
        let matte = Line::new(body(), body());
        let mut tests = Tests {
            input: &drawing.input(),
            hypothesis: HypothesisId::from_index(0),
            matte,
            length: LENGTH,
            recorder: &mut silent,
        };
        let few = accepted(0.5, Vec3::x(), 10.0);
        let many = accepted(0.9, Vec3::y(), 90.0);
        let chosen = tests.choose(&[few, many]).unwrap();
        assert_eq!((chosen.direction, chosen.pixels), (Vec3::y(), 100.0));
        assert!((chosen.start - body() * (0.86 * LENGTH)).norm() < 1e-9);
        assert_eq!(tests.choose(&[]), None);
    }
}
