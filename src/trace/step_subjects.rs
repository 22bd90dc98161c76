//! What a step is about.

use super::{Kind, Step, Subject};

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
    pub fn pixel(&self) -> Option<u32> {
        match self {
            Step::Claim { pixel, .. } | Step::Refusal { pixel, .. } | Step::Label { pixel, .. } => {
                Some(*pixel)
            }
            Step::Event(_) => None,
        }
    }

    /// Whether the step is about a hypothesis, or about the region `region` that the hypothesis became.
    pub fn concerns(&self, hypothesis: u16, region: Option<u16>) -> bool {
        match self {
            Step::Event(event) => event.subjects().into_iter().flatten().any(|subject| match subject {
                Subject::Hypothesis(id) => id == hypothesis,
                Subject::Region(id) => region == Some(id),
                Subject::Blob(_) => false,
            }),
            Step::Claim { before, after, .. } => *before == hypothesis || *after == hypothesis,
            Step::Refusal { holder, challenger, .. } => *holder == hypothesis || *challenger == hypothesis,
            Step::Label { .. } => false,
        }
    }
}
