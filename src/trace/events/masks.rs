//! The masks of dark, clipped and bloomed pixels (section 4), and the clipped areas.

use super::EventData;
use crate::photo::{ClippedArea, ClippedAreaVerdict, MaskLimits};
use crate::raster::PixelIndex;
use crate::trace::Measured;

/// The masks of dark, clipped and bloomed pixels were made (section 4).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MasksMade {
    /// The limits of the masks.
    pub limits: MaskLimits,
    /// Number of pixels that are too dark to be analyzed, invalid pixels and pixels outside the area included, those of clipped objects not.
    pub dark: u32,
    /// Number of other pixels that are clipped or bloomed.
    pub distorted: u32,
    /// Standard deviation of the noise of a band, estimated from the image, counts; none where it was not estimated or could not be
    /// estimated.
    pub sigma: Option<f64>,
}

impl EventData for MasksMade {}

/// A clipped area was judged by its edge: an object that clips, or what may be a highlight (refinement `clipped_objects`).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ClippedAreaJudged {
    /// The first pixel of the area and its edge.
    pub pixel: PixelIndex,
    /// Number of clipped pixels.
    pub clipped: u32,
    /// The share of surface reflection that would be left one pixel farther out, and the share below which the edge is abrupt.
    pub left: Measured<f64>,
    /// What the area is.
    pub verdict: ClippedAreaVerdict,
    /// The clipped pixels and those of the edge around them, ascending.
    pub pixels: Vec<PixelIndex>,
}

impl ClippedAreaJudged {
    /// Whether the pixel belongs to the area or to its edge.
    pub fn holds(&self, pixel: PixelIndex) -> bool {
        self.pixels.binary_search(&pixel).is_ok()
    }
}

impl From<&ClippedArea> for ClippedAreaJudged {
    fn from(area: &ClippedArea) -> Self {
        let pixels: Vec<PixelIndex> =
            area.pixels.iter().map(|&pixel| PixelIndex::from_index(pixel)).collect();
        Self {
            pixel: pixels.first().copied().unwrap_or_default(),
            clipped: area.clipped as u32,
            left: Measured::new(area.left, area.most_left),
            verdict: area.verdict,
            pixels,
        }
    }
}

impl EventData for ClippedAreaJudged {
    fn heap_bytes(&self) -> usize {
        size_of_val(self.pixels.as_slice())
    }
}
