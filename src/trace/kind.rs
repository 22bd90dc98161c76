//! What kinds of steps there are, and what they are called.

use super::{Event, LocalDecision, Step};

/// A kind of step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A stage begins.
    Stage,
    /// A part of a stage begins.
    Pass,
    /// The masks were made (4).
    Masks,
    /// A grid of windows was laid.
    Windows,
    /// A window was classified (5.2.1).
    Window,
    /// A merge was tried (5.2.2).
    Merge,
    /// A hypothesis was chosen (5.3.1).
    Hypothesis,
    /// An area was passed over.
    PassedOver,
    /// Seeds were placed.
    Seeds,
    /// A growth begins.
    Growth,
    /// A line was fitted again.
    Refit,
    /// A highlight was absorbed.
    Absorbed,
    /// Two regions became one.
    Merged,
    /// A highlight candidate was tested (5.4.1).
    Candidate,
    /// A highlight candidate was chosen.
    Highlight,
    /// The illuminant was estimated or given.
    Illuminant,
    /// Small highlights voted for a light.
    Votes,
    /// It was decided which light is used.
    LightChoice,
    /// A slice was made (5.4.2).
    Slice,
    /// A hole was filled (5.5).
    Hole,
    /// A region was dropped.
    Dropped,
    /// A part became a region.
    Part,
    /// Regions got their final numbers.
    Numbers,
    /// Ambient light was sought (7.5).
    Ambient,
    /// A region's highlights were held against one another (7.4).
    Branches,
    /// Reflection vectors were fitted (6).
    Vectors,
    /// The local split begins, or does not.
    LocalSplit,
    /// Candidate highlights were counted.
    Blobs,
    /// A candidate highlight was judged.
    Blob,
    /// It was tested whether highlights are believable.
    Plausibility,
    /// A clipped blob was filled, or not.
    Repair,
    /// A pixel changed hands.
    Claim,
    /// A pixel was refused in a conflict.
    Refusal,
    /// A pixel got its role (6).
    Label,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 34] = [
        Self::Stage,
        Self::Pass,
        Self::Masks,
        Self::Windows,
        Self::Window,
        Self::Merge,
        Self::Hypothesis,
        Self::PassedOver,
        Self::Seeds,
        Self::Growth,
        Self::Refit,
        Self::Absorbed,
        Self::Merged,
        Self::Candidate,
        Self::Highlight,
        Self::Illuminant,
        Self::Votes,
        Self::LightChoice,
        Self::Slice,
        Self::Hole,
        Self::Dropped,
        Self::Part,
        Self::Numbers,
        Self::Ambient,
        Self::Branches,
        Self::Vectors,
        Self::LocalSplit,
        Self::Blobs,
        Self::Blob,
        Self::Plausibility,
        Self::Repair,
        Self::Claim,
        Self::Refusal,
        Self::Label,
    ];

    /// Its name in traces and menus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stage => "stage",
            Self::Pass => "pass",
            Self::Masks => "masks",
            Self::Windows => "windows",
            Self::Window => "window",
            Self::Merge => "merge",
            Self::Hypothesis => "hypothesis",
            Self::PassedOver => "passed over",
            Self::Seeds => "seeds",
            Self::Growth => "growth",
            Self::Refit => "refit",
            Self::Absorbed => "absorbed",
            Self::Merged => "regions merged",
            Self::Candidate => "candidate",
            Self::Highlight => "highlight chosen",
            Self::Illuminant => "illuminant",
            Self::Votes => "votes",
            Self::LightChoice => "light chosen",
            Self::Slice => "slice",
            Self::Hole => "hole filled",
            Self::Dropped => "dropped",
            Self::Part => "part separated",
            Self::Numbers => "numbers",
            Self::Ambient => "ambient light",
            Self::Branches => "highlight branches",
            Self::Vectors => "vectors",
            Self::LocalSplit => "local split",
            Self::Blobs => "blobs",
            Self::Blob => "blob",
            Self::Plausibility => "belief",
            Self::Repair => "clip repair",
            Self::Claim => "claim",
            Self::Refusal => "refusal",
            Self::Label => "label",
        }
    }
}

impl Event {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Self::StageBegan { .. } => Kind::Stage,
            Self::PassBegan { .. } => Kind::Pass,
            Self::MasksMade(_) => Kind::Masks,
            Self::WindowsLaid(_) => Kind::Windows,
            Self::WindowClassified { .. } => Kind::Window,
            Self::MergeTried { .. } => Kind::Merge,
            Self::HypothesisChosen(_) => Kind::Hypothesis,
            Self::HypothesisPassedOver { .. } => Kind::PassedOver,
            Self::SeedsPlaced { .. } => Kind::Seeds,
            Self::GrowthBegan { .. } => Kind::Growth,
            Self::LineRefitted(_) => Kind::Refit,
            Self::Absorbed { .. } => Kind::Absorbed,
            Self::RegionsMerged { .. } => Kind::Merged,
            Self::CandidateTested(_) => Kind::Candidate,
            Self::CandidateChosen(_) => Kind::Highlight,
            Self::IlluminantEstimated(_) | Self::IlluminantGiven { .. } => Kind::Illuminant,
            Self::VotesCast(_) => Kind::Votes,
            Self::LightChosen(_) => Kind::LightChoice,
            Self::SliceMade(_) => Kind::Slice,
            Self::HoleFilled { .. } => Kind::Hole,
            Self::Dropped { .. } => Kind::Dropped,
            Self::ComponentSplit { .. } => Kind::Part,
            Self::Renumbered { .. } => Kind::Numbers,
            Self::AmbientSought(_) => Kind::Ambient,
            Self::BranchesSought(_) => Kind::Branches,
            Self::VectorsFitted(_) => Kind::Vectors,
            Self::Local(LocalDecision::Began(_)) => Kind::LocalSplit,
            Self::Local(LocalDecision::Blobs { .. }) => Kind::Blobs,
            Self::Local(LocalDecision::Blob(_)) => Kind::Blob,
            Self::Local(LocalDecision::Plausibility(_)) => Kind::Plausibility,
            Self::Local(LocalDecision::Repair(_)) => Kind::Repair,
        }
    }

    /// The regions that it is about, by their numbers of birth; the final number where vectors are fitted.
    pub fn regions(&self) -> [Option<u16>; 2] {
        match self {
            Self::HypothesisChosen(chosen) => [Some(chosen.region), None],
            Self::SeedsPlaced { region, .. }
            | Self::GrowthBegan { region, .. }
            | Self::HoleFilled { region, .. }
            | Self::Dropped { region, .. } => [Some(*region), None],
            Self::LineRefitted(refitted) => [Some(refitted.region), None],
            Self::Absorbed { region, by, .. } => [Some(*region), Some(*by)],
            Self::RegionsMerged { region, into, .. } => [Some(*region), Some(*into)],
            Self::CandidateTested(test) => [Some(test.region), None],
            Self::CandidateChosen(chosen) => [Some(chosen.region), None],
            Self::SliceMade(made) => [Some(made.region), None],
            Self::ComponentSplit { region, part, .. } => [Some(*region), Some(*part)],
            _ => [None, None],
        }
    }
}

impl Step<'_> {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Step::Event(event) => event.kind(),
            Step::Claim { .. } => Kind::Claim,
            Step::Refusal { .. } => Kind::Refusal,
            Step::Label { .. } => Kind::Label,
        }
    }

    /// The pixel that it is about, where it is about one.
    pub fn pixel(&self) -> Option<u32> {
        match self {
            Step::Claim { pixel, .. } | Step::Refusal { pixel, .. } | Step::Label { pixel, .. } => {
                Some(*pixel)
            }
            Step::Event(_) => None,
        }
    }

    /// Whether it is about a region, by its number of birth.
    pub fn concerns(&self, region: u16) -> bool {
        match self {
            Step::Event(event) => event.regions().contains(&Some(region)),
            Step::Claim { before, after, .. } => *before == region || *after == region,
            Step::Refusal { holder, challenger, .. } => *holder == region || *challenger == region,
            Step::Label { .. } => false,
        }
    }
}
