//! What a session analyzes.

use crate::photo::LinearImage;
use crate::raster::Mask;
use std::sync::Arc;

/// The image to analyze, and the area of the analysis.
pub struct Subject {
    pub image: Arc<LinearImage>,
    /// The pixels to analyze; `None`: all pixels.
    pub area: Option<Arc<Mask>>,
}
