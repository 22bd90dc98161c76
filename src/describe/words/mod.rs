//! Decisions in words: one short sentence each, in the paper's terms, value against threshold with their units. The
//! command line and the window say the same.

mod history;
mod lineage;
mod local_history;
#[cfg(test)]
mod tests;
mod what_if;

pub use history::{Condensed, condense};
pub use what_if::what_if_sentence;

use crate::trace::{Contest, Measure, Step, Trace, final_numbers};

/// What regions and pixels are called in sentences.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    width: usize,
    finals: Vec<u16>,
}

impl Names {
    /// The names in a trace. A region that is in the result is called by both its numbers.
    pub fn of(trace: &Trace) -> Self {
        let finals = final_numbers(trace).map_or_else(Vec::new, <[u16]>::to_vec);
        Self { width: trace.width(), finals }
    }

    /// `hypothesis 7 (region 3)`: its number of birth, and its number in the result where it is in it.
    pub fn region(&self, region: u16) -> String {
        match self.number(region) {
            Some(number) => format!("hypothesis {region} (region {number})"),
            None => format!("hypothesis {region}"),
        }
    }

    /// Its number in the result; none for one that is not in it.
    pub fn number(&self, region: u16) -> Option<u16> {
        let index = usize::from(region).checked_sub(1)?;
        self.finals.get(index).copied().filter(|&number| number > 0)
    }

    /// Several regions: `hypotheses 1, 2 and 5`.
    fn regions(&self, regions: &[u16]) -> String {
        let [only] = regions else {
            let numbers: Vec<String> = regions.iter().map(u16::to_string).collect();
            let Some((last, others)) = numbers.split_last() else { return "no hypothesis".to_owned() };
            return format!("hypotheses {} and {last}", others.join(", "));
        };
        self.region(*only)
    }

    /// `(12, 7)`: column and row.
    pub fn pixel(&self, pixel: u32) -> String {
        let (x, y) = self.place(pixel);
        format!("({x}, {y})")
    }

    /// Column and row of a pixel.
    pub fn place(&self, pixel: u32) -> (usize, usize) {
        let width = self.width.max(1);
        (pixel as usize % width, pixel as usize / width)
    }

    /// What happened at a step.
    pub fn step(&self, step: &Step) -> String {
        match step {
            Step::Event(event) => self.event(event),
            Step::Claim { pixel, before, after, contest } => self.claim(*pixel, (*before, *after), *contest),
            Step::Refusal { pixel, holder, challenger, contest } => {
                let contest = self.kept(*challenger, contest);
                format!("{} keeps pixel {}: {contest}", self.region(*holder), self.pixel(*pixel))
            }
            Step::Label { pixel, kind } => format!("pixel {} is {}", self.pixel(*pixel), kind.name()),
        }
    }

    fn claim(&self, pixel: u32, (before, after): (u16, u16), contest: Option<Contest>) -> String {
        let pixel = self.pixel(pixel);
        let (Some(contest), true) = (contest, after > 0) else {
            return match (before, after) {
                (0, after) => format!("{} takes pixel {pixel}", self.region(after)),
                (before, 0) => format!("{} gives up pixel {pixel}", self.region(before)),
                (before, after) => {
                    format!("pixel {pixel} goes from {} to {}", self.region(before), self.region(after))
                }
            };
        };
        let from = self.region(before);
        format!("{} takes pixel {pixel} from {from}: {}", self.region(after), won(&contest))
    }

    /// Why a challenger did not get a pixel.
    fn kept(&self, challenger: u16, contest: &Contest) -> String {
        let Contest { measure, challenger: shown, holder } = *contest;
        let challenger = self.region(challenger);
        match measure {
            Measure::Axis => {
                format!("{holder:.1} counts from its axis, {shown:.1} from that of {challenger}")
            }
            Measure::Plane => {
                format!("{holder:.1} counts from its plane, {shown:.1} from that of {challenger}")
            }
            Measure::ForeignMatte => format!(
                "it is a matte pixel of another region, {shown:.1} counts from the axis of {challenger}, radius {holder:.1}"
            ),
            Measure::Vote => {
                format!("{challenger} has {shown:.0} of the {holder:.0} assigned pixels around it")
            }
        }
    }
}

/// How a contest was won.
fn won(contest: &Contest) -> String {
    let Contest { measure, challenger, holder } = *contest;
    match measure {
        Measure::Axis => format!("{challenger:.1} counts from its axis against {holder:.1}"),
        Measure::Plane => format!("{challenger:.1} counts from its plane against {holder:.1}"),
        Measure::ForeignMatte => format!("{challenger:.1} counts from its axis, radius {holder:.1}"),
        Measure::Vote => format!("it has {challenger:.0} of the {holder:.0} assigned pixels around it"),
    }
}

/// `1 pixel`, `12 pixels`.
pub(super) fn count(n: impl Into<u64>, what: &str) -> String {
    let n = n.into();
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// A direction with two decimals.
pub(super) fn direction(vector: [f64; 3]) -> String {
    let [r, g, b] = vector;
    format!("({r:.2}, {g:.2}, {b:.2})")
}

/// A percentage that is 100 only for all and 0 only for none.
pub(super) fn percent(share: f64) -> String {
    format!("{:.0} %", if share < 1.0 { (share * 100.0).min(99.0) } else { 100.0 })
}

/// A percentage with one decimal.
pub(super) fn tenths(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
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
