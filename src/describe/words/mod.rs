//! Decisions in words: one short sentence each, in the paper's terms, value against threshold with their units. The
//! command line and the window say the same.

mod full_resolution;
mod history;
mod lineage;
mod local_history;
mod reason;
#[cfg(test)]
mod tests;
mod warnings;
mod what_if;

pub use history::{Condensed, condense};
pub use reason::{reason_label, reason_meaning};
pub use warnings::{grouped_sentences, sentences};
pub use what_if::what_if_sentence;

use super::names::{Names, ordinal, percent, signed, typographic};
use crate::raster::HypothesisId;
use crate::trace::{Contest, Measure, Step};

impl Names {
    /// The sentence of a step.
    pub fn step(&self, step: &Step) -> String {
        match step {
            Step::Event(event) => self.event(event),
            Step::Claim { pixel, before, after, contest } => {
                let pixel = self.pixel(*pixel);
                match (before, after, contest) {
                    (Some(before), Some(after), Some(contest)) => {
                        let from = self.hypothesis(*before);
                        format!(
                            "{} takes pixel {pixel} from {from}: {}",
                            self.hypothesis(*after),
                            won(contest)
                        )
                    }
                    (Some(before), Some(after), None) => {
                        let (before, after) = (self.hypothesis(*before), self.hypothesis(*after));
                        format!("pixel {pixel} goes from {before} to {after}")
                    }
                    (Some(before), None, _) => format!("{} gives up pixel {pixel}", self.hypothesis(*before)),
                    (None, Some(after), _) => format!("{} takes pixel {pixel}", self.hypothesis(*after)),
                    (None, None, _) => format!("pixel {pixel} stays in no hypothesis"),
                }
            }
            Step::Refusal { pixel, holder, challenger, contest } => {
                let contest = self.kept(*challenger, contest);
                format!("{} keeps pixel {}: {contest}", self.hypothesis(*holder), self.pixel(*pixel))
            }
            Step::Label { pixel, kind } => format!("pixel {} is {}", self.pixel(*pixel), kind.name()),
        }
    }

    /// The reason why a challenger did not get a pixel.
    fn kept(&self, challenger: HypothesisId, contest: &Contest) -> String {
        let Contest { measure, challenger: shown, holder } = *contest;
        let challenger = self.hypothesis(challenger);
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

/// The reason why a challenger won a contest.
fn won(contest: &Contest) -> String {
    let Contest { measure, challenger, holder } = *contest;
    match measure {
        Measure::Axis => format!("{challenger:.1} counts from its axis against {holder:.1}"),
        Measure::Plane => format!("{challenger:.1} counts from its plane against {holder:.1}"),
        Measure::ForeignMatte => format!("{challenger:.1} counts from its axis, radius {holder:.1}"),
        Measure::Vote => format!("it has {challenger:.0} of the {holder:.0} assigned pixels around it"),
    }
}
