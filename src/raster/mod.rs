//! Rectangles of values: pixels, masks and label maps, and what is done with them whatever they mean.
//!
//! Everything is row-major: the value of column `x`, row `y` is at index `y * width + x`.

mod blur;
mod components;
mod grid;
mod ids;
mod morphology;
mod roi;

pub use blur::blur;
pub use components::{Border, ComponentSearch, Components, Connectivity};
pub use grid::{LabelMap, Mask, Raster, UNASSIGNED};
pub use ids::{HypothesisId, PixelIndex, RegionId};
pub use morphology::dilate;
pub use roi::Roi;
