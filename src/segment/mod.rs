//! Section 5: from windows to regions, one file per stage of the paper.

mod absorb;
mod borders;
mod branches;
mod candidates;
mod choice;
mod classify;
mod clipping;
mod evidence;
mod full_resolution;
mod highlight_support;
mod illuminant;
mod in_plane;
mod input;
mod light;
mod linear;
mod lit_regions;
mod matte;
mod matte_areas;
mod merge;
mod model_fit;
mod object_parts;
mod planar;
mod planar_hypothesis;
mod planar_state;
mod plane_light;
mod recorded_labels;
mod regions;
mod second_lamp;
mod seed_areas;
#[cfg(test)]
pub(crate) mod testing;
mod texture;
mod two_lights;
mod unite;
mod vote_light;

pub(crate) use branches::{BranchSearch, Branches};
pub(crate) use candidates::{HighlightLine, MatteLine, is_of_candidate, marked_highlight_line};
pub(crate) use choice::LIGHT_LIMITS;
pub(crate) use linear::{line_fit, matte_length};
pub(crate) use model_fit::{FittedPlane, NewEdges, RegionFit};
pub(crate) use object_parts::parts;
pub(crate) use recorded_labels::{Members, Pixels, RecordedLabels};
pub(crate) use regions::{members, neighbors};
#[cfg(test)]
pub(crate) use second_lamp::LAMP_LIMITS;

pub use classify::{Classifier, Windows, classify};
pub use clipping::clipping_regions;
pub use full_resolution::{PixelPlace, PlaceRule, full_resolution_labels};
pub use input::AnalysisInput;
pub use light::{Illuminant, LightBasis, LightFindings, SecondLampFindings};
pub use linear::Hypothesis;
pub use matte::{MatteRegions, matte_regions};
pub use merge::{Areas, merge};
pub use model_fit::RegionVerdict;
pub use planar::planar_regions;
pub use planar_hypothesis::{PlanarHypothesis, PlanarRegions};
pub use regions::{FinalRegions, final_regions};
pub use vote_light::PictureVotes;
