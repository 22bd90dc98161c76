//! The output of each stage, for observers that show outputs before the run has ended.

use super::Stage;
use crate::intrinsic::Intrinsic;
use crate::params::UsedParams;
use crate::photo::Masks;
use crate::raster::Raster;
use crate::segment::{FinalRegions, MatteRegions, PlanarRegions, Windows};
use std::sync::Arc;

/// The output of one stage, shared with the session and with the [`super::Analysis`] at the end of the run.
#[derive(Clone, Debug)]
pub enum StageOutput {
    /// The masks, and the parameters estimated from the image.
    Masks {
        /// The masks: dark, clipped, bloomed and invalid pixels, and pixels outside the area.
        masks: Arc<Masks>,
        /// The parameters that the run uses.
        used: UsedParams,
    },
    /// The windows with their moments and classes.
    Windows(Arc<Windows>),
    /// Merged area of each pixel, from 1; 0 where its window has no class.
    Areas(Arc<Raster<u32>>),
    /// Regions and hypotheses after the linear stage.
    Matte(Arc<MatteRegions>),
    /// Regions and planar hypotheses after the planar stage, and the light.
    Planar(Arc<PlanarRegions>),
    /// The final regions.
    Finals(Arc<FinalRegions>),
    /// The intrinsic images and the regions' reflection vectors.
    Intrinsic(Arc<Intrinsic>),
}

impl StageOutput {
    /// The stage that made this output.
    pub fn stage(&self) -> Stage {
        match self {
            Self::Masks { .. } => Stage::Masks,
            Self::Windows(_) => Stage::Classify,
            Self::Areas(_) => Stage::Merge,
            Self::Matte(_) => Stage::Linear,
            Self::Planar(_) => Stage::Planar,
            Self::Finals(_) => Stage::Clipping,
            Self::Intrinsic(_) => Stage::Split,
        }
    }
}
