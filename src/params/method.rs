//! The methods: the paper's, refined and as written, and the earlier methods that the paper is held against.

use serde::{Deserialize, Serialize};

/// Which algorithm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The paper's algorithm with the refinements that [`Refine`](super::Refine) switches on.
    #[default]
    Refined,
    /// The algorithm as written in 1990, its weaknesses included.
    Paper,
    /// Phoenix, a system of recursive region splitting, to compare with (section 7.2).
    Phoenix,
    /// Clusters of the histogram of the whole picture, the way that section 5.1 rejects, to compare with.
    TopDown,
    /// A skewed T fitted to pixels that a person has marked, the method of 1987 and 1988 (section 6), to compare with.
    ByHand,
}

impl Method {
    /// All methods: the refined one first, then by age.
    pub const ALL: [Self; 5] = [Self::Refined, Self::Paper, Self::ByHand, Self::Phoenix, Self::TopDown];

    /// The name on the command line, in files and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Refined => "refined",
            Self::Paper => "paper",
            Self::Phoenix => "phoenix",
            Self::TopDown => "top-down",
            Self::ByHand => "by-hand",
        }
    }

    /// The method with this name; none where no method has the name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.name() == name)
    }

    /// What the method is, in one sentence.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Refined => "The paper's algorithm with refinements, each a switch.",
            Self::Paper => "The algorithm as it was written in 1990, its weaknesses included.",
            Self::Phoenix => {
                "Regions alone, split by valleys in the histograms of color features (section 7.2, color figure 15)."
            }
            Self::TopDown => {
                "Regions alone: clusters of the whole picture's histogram, the way that section 5.1 rejects."
            }
            Self::ByHand => {
                "One skewed T fitted to the pixels of an area that a person has marked, as in 1987 and 1988 (section 6)."
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_method_is_found_by_its_name() {
        assert!(Method::ALL.iter().all(|&method| Method::from_name(method.name()) == Some(method)));
        assert_eq!(Method::from_name("Refined"), None);
    }
}
