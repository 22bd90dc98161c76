//! Where a region came from, in words.

use super::super::events::Describe;
use super::{Names, count};
use crate::trace::{Ancestor, Birth, HypothesisStory, JoinedHow};

impl Names {
    /// How a hypothesis began, and how it became part of what it precedes in its [`crate::trace::lineage()`].
    pub fn ancestor(&self, ancestor: &Ancestor) -> String {
        let born = match ancestor.birth {
            Birth::Area { chosen, .. } => format!("from area {} of {} pixels", chosen.area, chosen.pixels),
            Birth::Part { of, pixels, .. } => {
                format!("separated from {}: {}", self.hypothesis(of), count(pixels, "pixel"))
            }
        };
        let joined = ancestor.joined.map_or_else(String::new, |joined| match joined.how {
            JoinedHow::Absorbed { highlight_foot: highlight, object_foot: object, gap } => format!(
                "; its broad highlight: its line misses black by {highlight:.1} counts, the object's by {object:.1}, gap \
                 {gap:.1}"
            ),
            JoinedHow::Merged { angle_deg, rms } => {
                format!("; one line with it: {angle_deg:.1}\u{b0} apart, rms distance {rms:.1} counts")
            }
            JoinedHow::Whole => "; it was separated from this one".to_owned(),
        });
        format!("{} {born}{joined}", self.hypothesis(ancestor.hypothesis))
    }

    /// The story of a hypothesis, each sentence with the step that it tells of; in the order of the steps.
    pub fn story(&self, story: &HypothesisStory) -> Vec<(usize, String)> {
        let mut told = Vec::new();
        if let Some((step, chosen)) = story.chosen {
            told.push((step, chosen.sentence(self)));
        }
        if let Some((step, of, pixels)) = story.separated {
            told.push((step, format!("separated from {}: {}", self.hypothesis(of), count(pixels, "pixel"))));
        }
        told.extend(story.tests.iter().map(|&(step, test)| (step, test.sentence(self))));
        if let Some((step, chosen)) = story.highlight {
            told.push((step, format!("{} is its highlight", self.candidate(chosen.candidate))));
        }
        told.extend(story.slices.iter().map(|&(step, made)| (step, made.sentence(self))));
        told.extend(story.joined.iter().map(|&(hypothesis, joined)| {
            let how = match joined.how {
                JoinedHow::Absorbed { gap, .. } => {
                    format!("absorbs its broad highlight, gap {gap:.1} counts")
                }
                JoinedHow::Merged { angle_deg, .. } => format!("is joined, {angle_deg:.1}\u{b0} off, by"),
                JoinedHow::Whole => "was part of".to_owned(),
            };
            (joined.step, format!("{how}: {}", self.hypothesis(hypothesis)))
        }));
        told.extend(story.end.map(|(step, event)| (step, self.event(event))));
        told.sort_by_key(|&(step, _)| step);
        told
    }
}
