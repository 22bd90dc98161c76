//! The outputs of the stages in working pixels.

use super::Analysis;
use super::prepared::Prepared;
use super::slot::Numbered;
use crate::intrinsic::WorkingSplit;
use crate::params::UsedParams;
use crate::photo::WorkingPicture;
use crate::raster::{Blocks, Raster};
use crate::segment::{Areas, FinalRegions, MatteRegions, PlanarRegions, Windows};
use std::sync::Arc;

/// Merged areas as lists and as a number per working pixel.
pub(super) struct MergedAreas {
    pub(super) areas: Areas,
    /// Number of the area of each working pixel, from 1; 0 where the window has no class.
    pub(super) map: Arc<Raster<u32>>,
}

/// The outputs of the stages from the windows to the split, in working pixels.
pub(super) struct WorkingOutputs {
    pub(super) windows: Numbered<Arc<Windows>>,
    pub(super) merged: Numbered<Arc<MergedAreas>>,
    pub(super) matte: Numbered<Arc<MatteRegions>>,
    pub(super) planar: Numbered<Arc<PlanarRegions>>,
    pub(super) finals: Numbered<Arc<FinalRegions>>,
    pub(super) split: Numbered<Arc<WorkingSplit>>,
    /// Whether the earlier split was still valid.
    pub(super) split_reused: bool,
}

impl WorkingOutputs {
    /// The outputs as the analysis of the working picture, without warnings.
    pub(super) fn analysis(&self, prepared: &Prepared, used: UsedParams) -> Analysis {
        let WorkingPicture { image, masks, .. } = &*prepared.working;
        let itself = WorkingPicture {
            blocks: Blocks::new(1, image.width(), image.height()),
            image: Arc::clone(image),
            masks: Arc::clone(masks),
        };
        let planar = Arc::clone(&self.planar.value);
        Analysis {
            used,
            masks: Arc::clone(masks),
            working: Arc::new(itself),
            windows: Arc::clone(&self.windows.value),
            areas: Arc::clone(&self.merged.value.map),
            matte: Arc::clone(&self.matte.value),
            second_look: None,
            illuminant: planar.illuminant,
            planar,
            finals: Arc::clone(&self.finals.value),
            working_finals: Arc::clone(&self.finals.value),
            intrinsic: Arc::clone(&self.split.value.intrinsic),
            noise: Arc::clone(&prepared.noise),
            warnings: Vec::new(),
        }
    }
}
