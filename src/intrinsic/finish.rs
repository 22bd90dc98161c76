//! The end of the split: the confidence and the reason of each pixel.

use super::confidence::ConfidenceInput;
use super::images::Images;
use super::reason::ReasonInput;
use super::{Intrinsic, RegionReflection};
use crate::raster::{LabelMap, Mask, Raster};
use crate::segment::AnalysisInput;
use crate::trace::Ambient;

/// What the confidence and the reason of each pixel are computed from, beside the images.
pub(super) struct Finish<'a> {
    /// The picture that was split.
    pub(super) input: &'a AnalysisInput<'a>,
    /// Region of each pixel.
    pub(super) labels: &'a LabelMap,
    /// Color of the light, unit; none where the light is not known.
    pub(super) light: Option<[f64; 3]>,
    /// The pixels that the skewed T of their region explains.
    pub(super) explained_mask: &'a Mask,
    /// What noise and coding explain of the distance of a pixel from the plane of each region (σ), counts, by
    /// [`RegionId::index`](crate::raster::RegionId::index).
    pub(super) pixel_sigmas: Vec<f32>,
}

impl Finish<'_> {
    /// The result, with the confidence and the reason of each pixel. `local`: the confidence of the local split, where it ran.
    pub(super) fn intrinsic(
        &self,
        images: Images,
        reports: Vec<RegionReflection>,
        local: Option<Raster<f32>>,
    ) -> Intrinsic {
        let Images { body, surface, noise, kinds } = images;
        let confidence_input = ConfidenceInput {
            labels: self.labels,
            explained_mask: self.explained_mask,
            kinds: &kinds,
            noise: &noise,
            regions: &reports,
            pixel_sigmas: &self.pixel_sigmas,
        };
        let confidence = confidence_input.confidence(local);
        let reason_input = ReasonInput {
            masks: self.input.masks,
            labels: self.labels,
            explained_mask: self.explained_mask,
            kinds: &kinds,
            noise: &noise,
            regions: &reports,
            light: self.light,
            pixel_sigmas: &self.pixel_sigmas,
        };
        let reasons = reason_input.reasons();
        let ambient = Ambient::default();
        Intrinsic { body, surface, noise, kinds, confidence, reasons, ambient, regions: reports }
    }
}
