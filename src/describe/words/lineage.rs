//! The lineage of a region in words.

use super::super::events::Describe;
use super::Names;
use crate::describe::{counted, grouped};
use crate::trace::{Ancestor, Birth, HypothesisStory, JoinedHow};

impl Names {
    /// How a hypothesis began, and how the hypothesis became part of another one in a [`crate::trace::lineage()`].
    pub fn ancestor(&self, ancestor: &Ancestor) -> String {
        let born = match ancestor.birth {
            Birth::Area { chosen, .. } => {
                format!("from area {} of {}", chosen.area, counted(chosen.pixels, "pixel"))
            }
            Birth::Part { of, pixels, .. } => {
                format!("separated from {}: {}", self.hypothesis(of), counted(pixels, "pixel"))
            }
            Birth::Picture { pixels, .. } => format!("from the picture: {}", counted(pixels, "pixel")),
            Birth::Marked { fitted, .. } => {
                format!(
                    "is the skewed T of marked pixels: its first matte line from {}",
                    counted(fitted.pixels, "pixel")
                )
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
            JoinedHow::United { taken_px, area_px } => {
                format!("; a single matte cluster with it: {} of {}", grouped(taken_px), counted(area_px, "pixel"))
            }
            JoinedHow::Whole => "; it was separated from this one".to_owned(),
        });
        format!("{} {born}{joined}", self.hypothesis(ancestor.hypothesis))
    }

    /// The story of a hypothesis, each sentence with its step, in the order of the steps.
    pub fn story(&self, story: &HypothesisStory) -> Vec<(usize, String)> {
        let mut sentences = Vec::new();
        if let Some((step, chosen)) = story.chosen {
            sentences.push((step, chosen.sentence(self)));
        }
        if let Some((step, of, pixels)) = story.separated {
            sentences.push((
                step,
                format!("separated from {}: {}", self.hypothesis(of), counted(pixels, "pixel")),
            ));
        }
        sentences.extend(story.made.map(|(step, made)| (step, made.sentence(self))));
        sentences.extend(story.searched.map(|(step, searched)| (step, searched.sentence(self))));
        sentences.extend(story.marked.iter().map(|&(step, fitted)| (step, fitted.sentence(self))));
        sentences.extend(story.tests.iter().map(|&(step, test)| (step, test.sentence(self))));
        if let Some((step, chosen)) = story.highlight {
            sentences.push((step, format!("{} is its highlight", self.candidate(chosen.candidate))));
        }
        sentences.extend(story.slices.iter().map(|&(step, made)| (step, made.sentence(self))));
        sentences.extend(story.joined.iter().map(|&(hypothesis, joined)| {
            let how = match joined.how {
                JoinedHow::Absorbed { gap, .. } => {
                    format!("absorbs its broad highlight, gap {gap:.1} counts")
                }
                JoinedHow::Merged { angle_deg, .. } => format!("is joined, {angle_deg:.1}\u{b0} off, by"),
                JoinedHow::United { taken_px, .. } => {
                    format!("takes {} of the same matte cluster from", counted(taken_px, "pixel"))
                }
                JoinedHow::Whole => "was part of".to_owned(),
            };
            (joined.step, format!("{how}: {}", self.hypothesis(hypothesis)))
        }));
        sentences.extend(story.end.map(|(step, event)| (step, self.event(event))));
        sentences.sort_by_key(|&(step, _)| step);
        sentences
    }
}
