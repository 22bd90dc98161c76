//! The photograph, and the split of its working picture, from which the photograph is split.

use super::images::Images;
use super::region_plan::RegionPlan;
use crate::raster::{Blocks, LabelMap, Mask};
use crate::segment::{AnalysisInput, FinalRegions};

/// The photograph whose working picture was analyzed.
#[derive(Clone, Copy)]
pub struct Detail<'a> {
    /// The photograph; its noise is that of a single pixel.
    pub input: AnalysisInput<'a>,
    /// Region of each pixel of the photograph.
    pub labels: &'a LabelMap,
    /// The blocks of pixels that are the working pixels.
    pub blocks: Blocks,
}

/// The split of the working picture.
pub(super) struct WorkingSplit<'a> {
    /// The ambient light that was subtracted from both pictures, counts.
    pub(super) origin: [f64; 3],
    /// The working picture.
    pub(super) input: &'a AnalysisInput<'a>,
    /// The regions, and the labels of the working pixels.
    pub(super) regions: &'a FinalRegions,
    /// How each region is split, by `RegionId::index`.
    pub(super) plans: &'a [RegionPlan],
    /// The working pixels that the skewed T of their region explains.
    pub(super) explained_mask: &'a Mask,
    /// The intrinsic images of the working picture.
    pub(super) images: &'a Images,
}
