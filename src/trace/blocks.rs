//! Passes and blocks: the parts into which the trace of a stage divides.

use super::{
    Absorbed, ComponentSplit, Event, GrowthBegan, HoleFilled, HypothesisPassedOver, Pass, PassBegan,
    PassedOver,
};
use crate::raster::HypothesisId;
use std::ops::Range;

/// A part of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassSpan {
    /// The steps of the pass.
    pub steps: Range<usize>,
    /// The pass.
    pub pass: Pass,
}

/// Consecutive steps about one subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The steps of the block.
    pub steps: Range<usize>,
    /// The subject.
    pub topic: Topic,
}

/// The subject of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Topic {
    /// A linear hypothesis is chosen and grows (5.3), or a region of an earlier method is searched (7.2).
    Hypothesis(HypothesisId),
    /// A broad highlight is absorbed by its object.
    Absorption(HypothesisId),
    /// The neighbors of a hypothesis are tested as its highlight (5.4.1).
    Candidates(HypothesisId),
    /// The slice of a hypothesis is made and grows (5.4.2).
    Slice(HypothesisId),
    /// The highlight of a hypothesis grows by brightness (5.5).
    Brightness(HypothesisId),
    /// A hole is given to a hypothesis (5.5).
    Hole(HypothesisId),
    /// A separate part becomes a hypothesis of its own, or a region of an earlier method is made (5.1, 7.2).
    Part(HypothesisId),
}

impl Topic {
    /// The hypothesis that the block is about.
    pub fn hypothesis(self) -> HypothesisId {
        match self {
            Self::Hypothesis(hypothesis)
            | Self::Absorption(hypothesis)
            | Self::Candidates(hypothesis)
            | Self::Slice(hypothesis)
            | Self::Brightness(hypothesis)
            | Self::Hole(hypothesis)
            | Self::Part(hypothesis) => hypothesis,
        }
    }
}

/// The passes and blocks of one stage.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Contents {
    pub(super) passes: Vec<PassSpan>,
    pub(super) blocks: Vec<Block>,
    open: bool,
}

impl Contents {
    /// The contents of a stage of `len` steps.
    pub(super) fn of<'a>(events: impl Iterator<Item = (usize, &'a Event)>, len: usize) -> Self {
        let mut contents = Self::default();
        for (step, event) in events {
            contents.take(step, event);
        }
        contents.close(len);
        if let Some(last) = contents.passes.last_mut() {
            last.steps.end = len;
        }
        contents
    }

    fn take(&mut self, step: usize, event: &Event) {
        let topic = match event {
            Event::PassBegan(PassBegan { pass }) => {
                self.close(step);
                if let Some(last) = self.passes.last_mut() {
                    last.steps.end = step;
                }
                self.passes.push(PassSpan { steps: step..step, pass: *pass });
                return;
            }
            Event::HypothesisPassedOver(HypothesisPassedOver { reason: PassedOver::Barren, .. }) => {
                return self.close(step + 1);
            }
            Event::HypothesisPassedOver(_) => return self.close(step),
            Event::HypothesisChosen(chosen) => Topic::Hypothesis(chosen.hypothesis),
            Event::Absorbed(Absorbed { hypothesis, .. }) => Topic::Absorption(*hypothesis),
            Event::CandidateTested(test) => Topic::Candidates(test.hypothesis),
            Event::SliceMade(made) => Topic::Slice(made.hypothesis),
            // The growth of hypotheses and slices lies within their blocks.
            Event::GrowthBegan(GrowthBegan { hypothesis, .. }) if self.pass() == Some(Pass::Brightness) => {
                Topic::Brightness(*hypothesis)
            }
            Event::HoleFilled(HoleFilled { hypothesis, .. }) => Topic::Hole(*hypothesis),
            Event::ComponentSplit(ComponentSplit { part, .. }) => Topic::Part(*part),
            Event::HistogramsSearched(searched) => Topic::Hypothesis(searched.hypothesis),
            Event::PatchMade(made) => Topic::Part(made.hypothesis),
            Event::MarkedLineFitted(fitted) => Topic::Hypothesis(fitted.hypothesis),
            _ => return,
        };
        let goes_on = matches!((topic, event), (Topic::Candidates(_), _) | (_, Event::MarkedLineFitted(_)))
            && self.open
            && self.blocks.last().is_some_and(|last| last.topic == topic);
        if !goes_on {
            self.close(step);
            self.blocks.push(Block { steps: step..step, topic });
            self.open = true;
        }
    }

    fn pass(&self) -> Option<Pass> {
        self.passes.last().map(|last| last.pass)
    }

    fn close(&mut self, step: usize) {
        if std::mem::take(&mut self.open)
            && let Some(last) = self.blocks.last_mut()
        {
            last.steps.end = step;
        }
    }
}
