//! The subjects of a step: its kind, pixel and hypotheses.

use super::{Kind, Step, Subject};
use crate::raster::{HypothesisId, PixelIndex, RegionId};

impl Step<'_> {
    /// The kind of the step.
    pub fn kind(&self) -> Kind {
        match self {
            Step::Event(event) => event.kind(),
            Step::Claim { .. } => Kind::Claim,
            Step::Refusal { .. } => Kind::Refusal,
            Step::Label { .. } => Kind::Label,
        }
    }

    /// The pixel that the step is about; `None` for an event.
    pub fn pixel(&self) -> Option<PixelIndex> {
        match self {
            Step::Claim { pixel, .. } | Step::Refusal { pixel, .. } | Step::Label { pixel, .. } => {
                Some(*pixel)
            }
            Step::Event(_) => None,
        }
    }

    /// Whether the step is about a hypothesis, or about the region `region` that the hypothesis became.
    pub fn concerns(&self, hypothesis: HypothesisId, region: Option<RegionId>) -> bool {
        match self {
            Step::Event(event) => event.subjects().into_iter().flatten().any(|subject| match subject {
                Subject::Hypothesis(id) => id == hypothesis,
                Subject::Region(id) => region == Some(id),
                Subject::Blob(_) => false,
            }),
            Step::Claim { before, after, .. } => [*before, *after].contains(&Some(hypothesis)),
            Step::Refusal { holder, challenger, .. } => *holder == hypothesis || *challenger == hypothesis,
            Step::Label { .. } => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{BranchesSought, Dropped, Event};

    #[test]
    fn an_event_of_a_region_concerns_the_hypothesis_that_became_the_region() {
        let branches = Event::from(BranchesSought {
            region: RegionId::from_index(1),
            cores: Vec::new(),
            gaps: Vec::new(),
        });
        let dropped = Event::from(Dropped { hypothesis: HypothesisId::from_index(1), pixels: 9 });
        let (second, seventh) = (HypothesisId::from_index(1), HypothesisId::from_index(6));
        let region = |number| RegionId::from_label(number);
        let (branches, dropped) = (Step::Event(&branches), Step::Event(&dropped));
        assert!(
            branches.concerns(seventh, region(2))
                && !branches.concerns(second, region(1))
                && !branches.concerns(second, None)
        );
        assert!(dropped.concerns(second, None) && !dropped.concerns(seventh, region(2)));
    }
}
