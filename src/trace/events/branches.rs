//! The highlight lines of a region, of which there may be more than one (section 7.4, figure 13).

use super::{EventData, Subject};
use crate::raster::RegionId;
use crate::trace::Measured;

/// The highlights of a region were compared: whether they lie on different shades of the body (section 7.4).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BranchesSought {
    /// The region.
    pub region: RegionId,
    /// The cores of the highlights, by ascending body reflection.
    pub cores: Vec<HighlightCore>,
    /// From each core to the next: the difference of their body reflection, and the least difference of two branches, counts.
    pub gaps: Vec<Measured<f32>>,
}

impl BranchesSought {
    /// Number of branches.
    pub fn branches(&self) -> usize {
        self.cores.iter().map(|core| core.branch + 1).max().unwrap_or(0)
    }
}

/// The brightest part of one highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct HighlightCore {
    /// Amount of body reflection under the core, median of the undistorted pixels, counts.
    pub body: f32,
    /// Standard deviation of that amount from pixel to pixel, counts: noise, shading, and the error of the plane.
    pub deviation: f32,
    /// Amount of surface reflection, mean of the undistorted pixels, counts.
    pub surface: f32,
    /// Number of pixels, clipped and bloomed ones included.
    pub pixels: u32,
    /// First column, first row, last column and last row of the core.
    pub span_px: [u32; 4],
    /// The branch of the core, from 0 for the strongest.
    pub branch: usize,
}

impl EventData for BranchesSought {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Region(self.region)), None]
    }

    fn heap_bytes(&self) -> usize {
        size_of_val(self.cores.as_slice()) + size_of_val(self.gaps.as_slice())
    }
}
