//! Section 5: from windows to regions, one file per stage of the paper.

mod absorb;
mod borders;
mod branches;
mod candidates;
mod choice;
mod classify;
mod clipping;
mod evidence;
mod illuminant;
mod in_plane;
mod input;
mod light;
mod linear;
mod matte;
mod merge;
mod model_fit;
mod planar;
mod recorded_labels;
mod regions;
#[cfg(test)]
pub(crate) mod testing;
mod two_lights;
mod unite;
mod vote_light;

pub use branches::{BranchSearch, Branches};
pub use choice::LIGHT_LIMITS;
pub use classify::{Classifier, Windows, classify};
pub use clipping::clipping_regions;
pub use input::AnalysisInput;
pub use light::{Illuminant, LightBasis, LightFindings};
pub use linear::Hypothesis;
pub use matte::{MatteRegions, matte_regions};
pub use merge::{Areas, merge};
pub use model_fit::{POOR_FIT, RegionFit, TEXTURE_CORRELATION};
pub use planar::{PlanarHypothesis, PlanarRegions, planar_regions};
pub use recorded_labels::{Members, Pixels};
pub use regions::{FinalRegions, final_regions, members, neighbors, parts};
