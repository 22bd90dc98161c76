//! The photograph whose working picture was split.

use super::region_plan::RegionPlans;
use crate::raster::{Blocks, LabelMap};
use crate::segment::{AnalysisInput, FinalRegions};

/// The photograph whose working picture was split.
#[derive(Clone, Copy)]
pub struct Detail<'a> {
    /// The photograph; its noise is that of a single pixel.
    pub input: AnalysisInput<'a>,
    /// Region of each pixel of the photograph. The regions of the second look follow those of the working picture.
    pub labels: &'a LabelMap,
    /// The blocks of pixels that are the working pixels.
    pub blocks: Blocks,
    /// The regions, and the labels of the working pixels.
    pub working_regions: &'a FinalRegions,
    /// How the regions of the second look are split; none without a second look.
    pub second_look: Option<&'a RegionPlans>,
}
