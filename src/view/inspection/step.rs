//! The findings about the step at the debugger's cursor.

use super::fits::fit_tests;
use super::{Inspection, Limits, ThresholdTest, Tone, candidate_tests};
use crate::color::vec3;
use crate::describe::Names;
use crate::describe::grouped;
use crate::photo::ClippedAreaVerdict;
use crate::raster::{HypothesisId, PixelIndex, Raster};
use crate::trace::{
    Class, Contest, Event, FeatureVerdict, HistogramsSearched, HypothesisPassedOver, LocalStart, Measure,
    Measured, MergeTried, Pass, PassedOver, RepairTried, RepairVerdict, Replay, Stage, Step,
    WindowClassified,
};

/// The findings about the step taken last; none before the first step. `colors`: those of the working picture, counts.
pub fn inspect_step(replay: &Replay, names: &Names, colors: &Raster<[f32; 3]>) -> Option<Inspection> {
    let step = replay.last()?;
    let (verdict, tone) = step_verdict(&step);
    let tests = match step {
        Step::Event(event) => event_tests(event, replay),
        Step::Claim { pixel, after, contest, .. } => pixel_tests(replay, colors, pixel, after, contest),
        Step::Refusal { pixel, challenger, contest, .. } => {
            pixel_tests(replay, colors, pixel, Some(challenger), Some(contest))
        }
        Step::Label { .. } => Vec::new(),
    };
    Some(Inspection {
        subject: format!("Step {}", grouped(replay.at())),
        verdict,
        tone,
        sentence: names.step(&step),
        tests,
        of_region: None,
        section: section(replay),
    })
}

/// The search of histograms that the step taken last is; none for any other step.
pub fn histograms_at_cursor(replay: &Replay) -> Option<&HistogramsSearched> {
    match replay.last()? {
        Step::Event(Event::HistogramsSearched(searched)) => Some(&**searched),
        _ => None,
    }
}

/// The section of the stage at the cursor; of an earlier method the section that describes it.
fn section(replay: &Replay) -> &'static str {
    match replay.pass() {
        Some(Pass::Splitting) => return "7.2",
        Some(Pass::Clusters) => return "5.1",
        Some(Pass::Marked) => return "6",
        _ => {}
    }
    match replay.stage() {
        None | Some(Stage::Masks) => "4",
        Some(Stage::Classify) => "5.2.1",
        Some(Stage::Merge) => "5.2.2",
        Some(Stage::Linear) => "5.3",
        Some(Stage::Planar) => "5.4",
        Some(Stage::Clipping) => "5.5",
        Some(Stage::Split) => "6",
    }
}

/// The verdict of a step in one to three words.
pub fn step_verdict(step: &Step) -> (String, Tone) {
    let (word, tone) = match step {
        Step::Claim { after: Some(_), .. } => ("Taken", Tone::Good),
        Step::Claim { after: None, .. } => ("Given back", Tone::Bad),
        Step::Refusal { .. } => ("Refused", Tone::Bad),
        Step::Label { kind, .. } => return (capitalized(kind.name()), Tone::Neutral),
        Step::Event(event) => return event_verdict(event),
    };
    (word.to_owned(), tone)
}

/// The verdict of an event. An event that decides nothing has the name of its kind.
fn event_verdict(event: &Event) -> (String, Tone) {
    let of = |good: bool, yes: &str, no: &str| {
        (if good { yes } else { no }.to_owned(), if good { Tone::Good } else { Tone::Bad })
    };
    match event {
        Event::WindowClassified(found) => (
            found.class.map_or_else(|| "No class".to_owned(), |class| capitalized(class.name())),
            Tone::Neutral,
        ),
        Event::MergeTried(tried) => of(tried.class == tried.union, "Merged", "Stay apart"),
        Event::HypothesisChosen(_) | Event::CandidateChosen(_) => of(true, "Taken", ""),
        Event::HypothesisPassedOver(_) | Event::Dropped(_) => of(false, "", "Refused"),
        Event::Absorbed(_) => of(false, "", "Absorbed"),
        Event::HistogramsSearched(searched) => of(searched.chosen().is_some(), "Split", "Homogeneous"),
        Event::CandidateTested(test) => of(test.verdict.accepted(), "Skewed T", "No skewed T"),
        Event::VectorsFitted(fitted) => holds_verdict(fitted.is_judged, fitted.model_fits),
        Event::LocalBegan(began) => of(began.start == LocalStart::Begins, "Begins", "Does not begin"),
        Event::PlausibilityTested(tested) => of(tested.plausible(), "Plausible", "Not plausible"),
        Event::ClippedAreaJudged(judged) => {
            of(judged.verdict != ClippedAreaVerdict::Object, "May be a highlight", "Clipped object")
        }
        Event::RepairTried(tried) => of(tried.verdict == RepairVerdict::Filled, "Filled", "Not filled"),
        other => (capitalized(other.kind().name()), Tone::Neutral),
    }
}

/// The verdict on a region: whether the skewed T explains the region, or that nobody asks, as under the paper's method.
pub(super) fn holds_verdict(is_judged: bool, model_fits: bool) -> (String, Tone) {
    let (word, tone) = match (is_judged, model_fits) {
        (false, _) => ("Not judged", Tone::Neutral),
        (true, true) => ("Holds", Tone::Good),
        (true, false) => ("Does not hold", Tone::Bad),
    };
    (word.to_owned(), tone)
}

/// The values of an event with their limits; empty for an event that decides by no limit.
fn event_tests(event: &Event, replay: &Replay) -> Vec<ThresholdTest> {
    match event {
        Event::WindowClassified(found) => {
            window_tests(found, replay.grid().map(|grid| grid.laid.least_pixels))
        }
        Event::MergeTried(tried) => merge_tests(tried),
        Event::HypothesisChosen(chosen) => {
            let foot = chosen.line.foot().norm();
            vec![foot_test(Measured::new(foot, chosen.radius))]
        }
        Event::HypothesisPassedOver(passed) => passed_over_tests(passed),
        Event::CandidateTested(test) => candidate_tests(test).to_vec(),
        Event::HistogramsSearched(searched) => histogram_tests(searched),
        Event::VectorsFitted(fitted) if fitted.is_judged => fit_tests(fitted),
        Event::BranchesSought(sought) => sought
            .gaps
            .iter()
            .map(|gap| {
                let tip = "Difference of body reflection under two highlights, from which on they have lines of their own (section 7.4).";
                ThresholdTest::at_least("body from core to core", widened(*gap), "counts", tip)
            })
            .collect(),
        Event::LightChosen(chosen) => chosen.odds.as_ref().map_or_else(Vec::new, |odds| {
            let tip = "Logarithm of the odds for the light by votes: above the limit the votes win (section 5.4.1).";
            let measured = Measured::new(odds.sum(), chosen.limits.log_odds);
            vec![ThresholdTest::at_least("log odds for the votes", measured, "", tip)]
        }),
        Event::LocalBegan(began) => {
            let tip = "Unexplained lit pixels, from which on the local split begins (beyond section 6).";
            vec![pixels_test(began.pixels, began.least, tip)]
        }
        Event::PlausibilityTested(tested) => tested.share.map_or_else(Vec::new, |share| {
            let tip = "Share of the votes for the light; below the limit no pixel is split locally (beyond section 6).";
            vec![ThresholdTest::at_least("votes", Measured::new(share, tested.least_share), "", tip)]
        }),
        Event::ClippedAreaJudged(judged) => {
            let tip = "Share of the surface reflection that would be left one pixel farther out from the clipped area: below the limit its edge is too abrupt for a highlight (beyond section 4).";
            vec![ThresholdTest::at_least("left one pixel farther out", judged.left, "", tip)]
        }
        Event::RepairTried(tried) => repair_tests(tried),
        _ => Vec::new(),
    }
}

/// The tests of a window; `least` is the fewest valid pixels of a window that gets a class.
pub(super) fn window_tests(found: &WindowClassified, least: Option<u32>) -> Vec<ThresholdTest> {
    let enough = least.map(|least| {
        let tip = "Valid pixels of the window, from which on the window gets a class (section 5.2.1).";
        pixels_test(found.pixels, least, tip)
    });
    let chi_square = found.class.map(|_| chi_square(found.chi_square));
    enough.into_iter().chain(chi_square).collect()
}

fn merge_tests(tried: &MergeTried) -> Vec<ThresholdTest> {
    let same = |class: Class| tried.union == class;
    let test = chi_square(tried.chi_square);
    // A union of class volume has passed no test: its value exceeds the quantile.
    vec![ThresholdTest { passed: test.passed && same(tried.class), ..test }]
}

/// The χ² test that decided a class (section 5.2.1).
fn chi_square(measured: Measured<f32>) -> ThresholdTest {
    let tip = "\u{3c7}\u{b2} of the variances that are left, against the quantile of noise: below it, no direction is left but noise (section 5.2.1, table 1).";
    ThresholdTest::at_most("\u{3c7}\u{b2}", widened(measured), "", tip)
}

/// The scores of the features of a region that have a valley (section 7.2).
fn histogram_tests(searched: &HistogramsSearched) -> Vec<ThresholdTest> {
    let tip = "Score of the least prominent valley in the feature's histogram, of 1000: 0 where the valley is as high as the lower peak beside it (section 7.2).";
    let with_valley = searched.features.iter().filter(|feature| feature.verdict != FeatureVerdict::NoValley);
    with_valley
        .map(|feature| {
            ThresholdTest::at_least(feature.feature.name(), widened(feature.score), "of 1000", tip)
        })
        .collect()
}

fn passed_over_tests(passed: &HypothesisPassedOver) -> Vec<ThresholdTest> {
    match passed.reason {
        PassedOver::TooSmall | PassedOver::Consumed => {
            let tip =
                "Unclaimed pixels of the area, from which on the area starts a hypothesis (section 5.3.1).";
            vec![pixels_test(passed.pixels, passed.least, tip)]
        }
        PassedOver::FarFromBlack | PassedOver::NoExtent | PassedOver::Barren | PassedOver::NoNumberLeft => {
            Vec::new()
        }
    }
}

fn repair_tests(tried: &RepairTried) -> Vec<ThresholdTest> {
    let ring = "Share of the ring around the blob that is highlight (section 5.5).";
    let spread = "Standard deviation of the ring's body reflection as a share of its mean: one material (section 5.5).";
    let around = "Highlight pixels around the blob, against the least number (section 5.5).";
    vec![
        ThresholdTest::at_least("highlight in the ring", widened(tried.ring), "", ring),
        ThresholdTest::at_most("spread of the ring", widened(tried.spread), "", spread),
        ThresholdTest::at_least("highlight around", widened(tried.around), "px", around),
    ]
}

/// The distances of a pixel's color from the axis and the plane of a hypothesis, and the contest for the pixel.
fn pixel_tests(
    replay: &Replay,
    colors: &Raster<[f32; 3]>,
    pixel: PixelIndex,
    hypothesis: Option<HypothesisId>,
    contest: Option<Contest>,
) -> Vec<ThresholdTest> {
    let mut tests = Vec::new();
    let color = colors.as_slice().get(pixel.index()).copied();
    let found = hypothesis.and_then(|id| Some((replay.hypothesis(id)?, replay.slice(id))));
    if let (Some(color), Some((hypothesis, slice))) = (color, found) {
        if let Some(slice) = slice {
            let distance = f64::from(slice.slice.distance(color)).abs();
            let tip =
                "Distance of the color from the plane, against half the slice's thickness (section 5.4.2).";
            let measured = Measured::new(distance, slice.half_width);
            tests.push(ThresholdTest::at_most("from the plane", measured, "counts", tip));
        } else if let Some(line) = hypothesis.line() {
            let tip =
                "Distance of the color from the axis, against the radius of the cylinder (section 5.3.2).";
            let measured = Measured::new(line.distance(&vec3(color)), hypothesis.radius);
            tests.push(ThresholdTest::at_most("from the axis", measured, "counts", tip));
        }
    }
    tests.extend(contest.map(contest_test));
    tests
}

/// The values of the two hypotheses that wanted a pixel.
fn contest_test(contest: Contest) -> ThresholdTest {
    let measured = Measured::new(f64::from(contest.challenger), f64::from(contest.holder));
    match contest.measure {
        Measure::Axis => {
            let tip = "Distance from the axis of the hypothesis that wants the pixel, against that of the holder: the nearer wins (section 5.3.2).";
            ThresholdTest::at_most("axis against the holder's", measured, "counts", tip)
        }
        Measure::Plane => {
            let tip = "Distance from the plane of the hypothesis that wants the pixel, against that of the holder: the nearer wins (section 5.4.2).";
            ThresholdTest::at_most("plane against the holder's", measured, "counts", tip)
        }
        Measure::ForeignMatte => {
            let tip = "The pixel is a matte pixel of another hypothesis: distance from the axis of the hypothesis that wants the pixel, against the radius (section 5.4.2).";
            ThresholdTest::at_most("from its axis", measured, "counts", tip)
        }
        Measure::Vote => {
            let [won, all] = [measured.value, measured.limit];
            let tip = "Pixels of the winner around the pixel, and of all hypotheses there: the majority wins (section 5.3.2).";
            ThresholdTest {
                name: "votes",
                value: won,
                limits: Limits::Within([0.0, all]),
                unit: "px",
                passed: true,
                tip,
            }
        }
    }
}

/// The distance of a line from black.
fn foot_test(measured: Measured<f64>) -> ThresholdTest {
    let tip = "Distance of the line from black, against the radius of the cylinder: a matte line goes through black (section 5.3.1).";
    ThresholdTest::at_most("line from black", measured, "counts", tip)
}

fn pixels_test(pixels: u32, least: u32, tip: &'static str) -> ThresholdTest {
    ThresholdTest::at_least("pixels", Measured::new(f64::from(pixels), f64::from(least)), "px", tip)
}

fn widened(measured: Measured<f32>) -> Measured<f64> {
    Measured::new(f64::from(measured.value), f64::from(measured.limit))
}

fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
