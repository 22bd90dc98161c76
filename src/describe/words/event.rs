//! Events in words.

use super::light::{ambient_sought, light_chosen, votes_cast, whose_light};
use super::{Names, count, direction, local, percent};
use crate::trace::{
    BranchesSought, CandidateSource, CandidateTest, Class, Event, HypothesisChosen, IlluminantEstimated,
    MasksMade, Pass, PassedOver, SliceMade, VectorsFitted, WindowsLaid,
};

impl Names {
    /// What was decided.
    pub fn event(&self, event: &Event) -> String {
        match event {
            Event::StageBegan { stage } => format!("stage {} begins", stage.name()),
            Event::PassBegan { pass } => pass_began(*pass),
            Event::MasksMade(made) => masks_made(made),
            Event::WindowsLaid(laid) => windows_laid(laid),
            Event::WindowClassified { window, pixels, eigenvalues, chi_square, class } => {
                let pixels = count(*pixels, "valid pixel");
                let [a, b, c] = variances(*eigenvalues);
                let verdict = class.map_or("too few for a class", Class::name);
                let held = held(*chi_square);
                format!(
                    "window {window}, {pixels}, variances {a:.1}, {b:.1}, {c:.1} counts\u{b2}, {held}: {verdict}"
                )
            }
            Event::MergeTried { into, from, pixels: [a, b], eigenvalues, chi_square, class, union } => {
                let [x, y, z] = variances(*eigenvalues);
                let verdict = if class == union { "they merge" } else { "they stay apart" };
                format!(
                    "areas {into} ({a} px) and {from} ({b} px), both {}: variances of the union {x:.1}, {y:.1}, {z:.1} \
                     counts\u{b2}, {}, {}: {verdict}",
                    class.name(),
                    held(*chi_square),
                    union.name()
                )
            }
            Event::HypothesisChosen(chosen) => self.chosen(chosen),
            Event::HypothesisPassedOver { area, pixels, least, reason } => {
                format!("area {area} is passed over: {}", passed_over(*reason, *pixels, *least))
            }
            Event::SeedsPlaced { region, pixels } => {
                format!("{} starts from {}", self.region(*region), count(*pixels, "pixel"))
            }
            Event::GrowthBegan { region, limit } => {
                format!("{} grows, limit {limit:.1} counts", self.region(*region))
            }
            Event::LineRefitted(refitted) => {
                let line = direction(refitted.line.direction.into());
                let region = self.region(refitted.region);
                format!("the line of {region} is fitted again: direction {line}")
            }
            Event::SliceMade(made) => self.slice_made(made),
            Event::CandidateTested(test) => self.tested(test),
            Event::CandidateChosen(chosen) => format!(
                "{} is the highlight of {}: direction {}",
                self.candidate(chosen.candidate),
                self.region(chosen.region),
                direction(chosen.direction.into())
            ),
            Event::IlluminantEstimated(estimated) => illuminant(estimated),
            Event::IlluminantGiven { direction: light } => {
                format!("the light is given: {}", direction(*light))
            }
            Event::VotesCast(votes) => votes_cast(votes),
            Event::LightChosen(chosen) => light_chosen(chosen),
            Event::AmbientSought(ambient) => ambient_sought(ambient),
            Event::BranchesSought(sought) => branches_sought(sought),
            Event::VectorsFitted(fitted) => vectors_fitted(fitted),
            Event::Local(decision) => self.local(decision),
            Event::Renumbered { finals } => {
                let kept = finals.iter().filter(|&&number| number > 0).count();
                format!("of {} hypotheses {kept} are regions, numbered by size", finals.len())
            }
            other => self.ending(other),
        }
    }

    /// Events that change what regions there are.
    fn ending(&self, event: &Event) -> String {
        match event {
            Event::Absorbed { region, by, feet: [highlight, object], gap } => format!(
                "{} is the broad highlight of {}: its line misses black by {highlight:.1} counts, the object's by \
                 {object:.1}; the lines pass {gap:.1} counts from one another",
                self.region(*region),
                self.region(*by)
            ),
            Event::RegionsMerged { region, into, angle_deg, rms } => format!(
                "{} joins {}: their lines differ by {angle_deg:.1}\u{b0} and its pixels lie {rms:.1} counts from the \
                 other's (rms)",
                self.region(*region),
                self.region(*into)
            ),
            Event::HoleFilled { region, pixel, pixels, border_share } => format!(
                "a hole of {} at {} goes to {}, which holds {} of its border",
                count(*pixels, "pixel"),
                self.pixel(*pixel),
                self.region(*region),
                percent(*border_share)
            ),
            Event::Dropped { region, pixels } => {
                format!("{} is dropped, too small: {}", self.region(*region), count(*pixels, "pixel"))
            }
            Event::ComponentSplit { region, part, pixels } => format!(
                "{} of {} lie apart and become {}",
                count(*pixels, "pixel"),
                self.region(*region),
                self.region(*part)
            ),
            // All others are said above.
            _ => String::new(),
        }
    }

    pub(super) fn chosen(&self, chosen: &HypothesisChosen) -> String {
        let HypothesisChosen { region, area, rank, pixels, line, radius } = chosen;
        format!(
            "{} starts from area {area}, {} in size: {pixels} unclaimed pixels, direction {}, radius {radius:.1} counts",
            self.region(*region),
            ordinal(*rank),
            direction(line.direction.into())
        )
    }

    pub(super) fn slice_made(&self, made: &SliceMade) -> String {
        format!(
            "slice of {}: light {:.0}\u{b0} from the matte line, which is {:.0} counts long; half width {:.1} counts",
            self.region(made.region),
            made.plane.angle_deg(),
            made.matte_length,
            made.half_width
        )
    }

    /// A skewed-T test: what was measured, and which tests failed.
    pub fn tested(&self, test: &CandidateTest) -> String {
        let failed = failed_tests(test);
        let verdict = if failed.is_empty() { "passed".to_owned() } else { failed.join("; ") };
        format!(
            "{} ({} px) as highlight of {}: the lines pass {:.1} counts from one another, at {:.0} % of the matte line: {verdict}",
            self.candidate(test.candidate),
            test.pixels,
            self.region(test.region),
            test.gap[0],
            test.position_percent
        )
    }

    /// Where a highlight candidate came from.
    pub fn candidate(&self, source: CandidateSource) -> String {
        match source {
            CandidateSource::Leftover(area) => format!("what is left of area {area}"),
            CandidateSource::Region(region) => self.region(region),
            CandidateSource::Absorbed(region) => format!("absorbed {}", self.region(region)),
        }
    }
}

/// The test that decided a class, in numbers.
fn held([statistic, threshold]: [f32; 2]) -> String {
    let relation = if statistic <= threshold { '\u{2264}' } else { '>' };
    format!("\u{3c7}\u{b2} {statistic:.1} {relation} {threshold:.1}")
}

/// Variances to print: rounding may leave less than nothing of them.
pub(super) fn variances(eigenvalues: [f32; 3]) -> [f32; 3] {
    eigenvalues.map(|variance| variance.max(0.0))
}

/// The tests that a candidate failed, each with its numbers.
fn failed_tests(test: &CandidateTest) -> Vec<String> {
    let [gap, radius] = test.gap;
    let [low, high] = test.position_limits;
    let at = test.position_percent;
    let verdict = test.verdict;
    let mut failed = Vec::new();
    if !verdict.lines_meet {
        failed.push(format!("no skewed T: {gap:.1} counts apart, at most {radius:.1}"));
    }
    if !verdict.upper_half {
        failed.push(format!("not in the upper half: at {at:.0} %, {low:.0} to {high:.0} % are allowed"));
    }
    if !verdict.positive {
        failed.push(format!("its direction {} is negative in a band", direction(test.line.direction.into())));
    }
    if !verdict.beyond {
        failed.push("it lies on the wrong side of the meeting point".to_owned());
    }
    failed
}

fn pass_began(pass: Pass) -> String {
    match pass {
        Pass::SecondLook(size) => format!("{} in windows of {size} px", pass.name()),
        _ => pass.name().to_owned(),
    }
}

fn masks_made(made: &MasksMade) -> String {
    let MasksMade { dark, distorted, sigma, .. } = made;
    let noise = sigma.map_or_else(String::new, |sigma| format!(", noise \u{3c3} {sigma:.2} counts"));
    format!("{} dark, {distorted} clipped or bloomed{noise}", count(*dark, "pixel"))
}

fn windows_laid(laid: &WindowsLaid) -> String {
    let WindowsLaid { size_px, columns, rows, least_pixels, camera_noise, tail_test } = laid;
    let test = if *tail_test { "tail test" } else { "the paper's test" };
    format!(
        "{columns} \u{d7} {rows} windows of {size_px} px; at least {least_pixels} valid pixels for a class; {test}, \
         \u{3c3}0 {camera_noise:.2} counts"
    )
}

/// Why an area did not start a hypothesis, or in vain.
pub(super) fn passed_over(reason: PassedOver, pixels: u32, least: u32) -> String {
    match reason {
        PassedOver::TooSmall => format!("{pixels} unclaimed pixels, it needs {least}"),
        PassedOver::Consumed => format!("others claimed all but {pixels} of its pixels, it needs {least}"),
        PassedOver::FarFromBlack => "its line passes black outside the cylinder's radius".to_owned(),
        PassedOver::NoExtent => "its colors have no extent to fit a line to".to_owned(),
        PassedOver::Barren => format!("growing from it claimed fewer than {least} pixels"),
        PassedOver::NoNumberLeft => "there is no number left for another region".to_owned(),
    }
}

fn illuminant(estimated: &IlluminantEstimated) -> String {
    let IlluminantEstimated { direction: light, contributions, outshone } = estimated;
    let heard = contributions.iter().filter(|contribution| contribution.weight > 0.0);
    let worst = heard.clone().map(|contribution| contribution.residual_deg).fold(0.0, f64::max);
    let from = match heard.count() {
        0 => String::new(),
        n => format!(" from {}, at most {worst:.1}\u{b0} off", count(n as u64, "constraint")),
    };
    let whose = outshone.as_ref().map_or_else(String::new, whose_light);
    format!("the light is {}{from}{whose}", direction(*light))
}

fn branches_sought(sought: &BranchesSought) -> String {
    let cores = sought.cores.iter().map(|core| format!("{:.0} \u{b1} {:.0}", core.body, core.deviation));
    let cores: Vec<String> = cores.collect();
    let gap = |&[difference, limit]: &[f32; 2]| {
        let relation = if difference > limit { '>' } else { '\u{2264}' };
        format!("{difference:.0} {relation} {limit:.0}")
    };
    let gaps: Vec<String> = sought.gaps.iter().map(gap).collect();
    let apart = if gaps.is_empty() { String::new() } else { format!(", apart {}", gaps.join(", ")) };
    format!(
        "region {}: m_b under its {} {} counts{apart}: {}",
        sought.region,
        if cores.len() == 1 { "highlight is" } else { "highlights is" },
        cores.join(", "),
        match sought.branches() {
            1 => "one highlight branch".to_owned(),
            n => format!("{n} highlight branches"),
        }
    )
}

fn vectors_fitted(fitted: &VectorsFitted) -> String {
    let body = direction(fitted.body.into());
    let surface = fitted.surface.map_or_else(
        || "no surface vector: all is body reflection".to_owned(),
        |surface| format!("surface vector {}", direction(surface.into())),
    );
    let verdict = local::verdict(fitted);
    format!("region {} is split by body vector {body}, {surface}; {verdict}", fitted.region)
}

/// `the largest`, `the 2nd`, of areas that were looked at before.
pub(super) fn ordinal(rank: u32) -> String {
    let n = rank.saturating_add(1);
    let ending = match (n % 10, n % 100) {
        (_, 11..=13) => "th",
        (1, _) => "st",
        (2, _) => "nd",
        (3, _) => "rd",
        _ => "th",
    };
    if rank == 0 { "the largest".to_owned() } else { format!("the {n}{ending}") }
}
