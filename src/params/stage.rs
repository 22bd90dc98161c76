//! The stages of a run, in their order.

/// The stages in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Dark, clipped and bloomed pixels; the parameters left to the image.
    Masks,
    /// Section 5.2.1.
    Classify,
    /// Section 5.2.2.
    Merge,
    /// Section 5.3.
    Linear,
    /// Section 5.4.
    Planar,
    /// Section 5.5.
    Clipping,
    /// Section 6.
    Split,
}

impl Stage {
    /// All of them, first to last.
    pub const ALL: [Self; 7] =
        [Self::Masks, Self::Classify, Self::Merge, Self::Linear, Self::Planar, Self::Clipping, Self::Split];

    /// Its name in reports and traces.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Masks => "masks",
            Self::Classify => "classify",
            Self::Merge => "merge",
            Self::Linear => "linear",
            Self::Planar => "planar",
            Self::Clipping => "clipping",
            Self::Split => "split",
        }
    }

    /// The stage with this name; none where no stage has the name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|stage| stage.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stage_is_found_by_its_name() {
        assert!(Stage::ALL.iter().all(|&stage| Stage::from_name(stage.name()) == Some(stage)));
        assert_eq!(Stage::from_name("mask"), None);
    }
}
