//! The masks of dark, clipped and bloomed pixels (section 4).

use super::EventData;
use crate::photo::MaskLimits;

/// The masks of dark, clipped and bloomed pixels were made (section 4).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MasksMade {
    /// The limits of the masks.
    pub limits: MaskLimits,
    /// Number of pixels that are too dark to be analyzed, invalid pixels and pixels outside the area included.
    pub dark: u32,
    /// Number of other pixels that are clipped or bloomed.
    pub distorted: u32,
    /// Standard deviation of the noise of a band, estimated from the image, counts; none where it was not estimated or could not be
    /// estimated.
    pub sigma: Option<f64>,
}

impl EventData for MasksMade {}
