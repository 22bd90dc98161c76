//! Rectangles of values (pixels, masks and label maps), and operations on them that do not depend on what the values mean.
//!
//! Rasters are row-major: the value of column `x`, row `y` is at index `y * width + x`.

mod blocks;
mod blur;
mod components;
mod covering;
mod grid;
mod ids;
mod morphology;
mod pull_push;
mod relaxation;
mod roi;

pub use blocks::Blocks;
pub(crate) use blur::blur;
pub(crate) use components::{Border, ComponentSearch, Components, Connectivity, pixels_where};
pub(crate) use covering::disjoint_rectangles;
pub use grid::{LabelMap, Mask, Raster, UNASSIGNED};
pub use ids::{HypothesisId, PixelIndex, RegionId};
pub(crate) use morphology::{dilate, erode};
pub(crate) use pull_push::pull_push;
pub(crate) use relaxation::{Target, relax, relax_towards};
pub(crate) use roi::Roi;
