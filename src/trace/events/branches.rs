//! Whether a region has more than one highlight line (section 7.4, figure 13).

use super::{EventData, Subject};
use crate::raster::RegionId;
use crate::trace::Measured;

/// The highlights of a region were held against one another: do they lie on different shades (section 7.4)?
#[derive(Clone, Debug, PartialEq)]
pub struct BranchesSought {
    /// The region.
    pub region: RegionId,
    /// Its highlights' cores, by ascending body reflection.
    pub cores: Vec<HighlightCore>,
    /// From each core to the next: how much their body reflection differs, and from which difference on they belong to two
    /// branches, counts.
    pub gaps: Vec<Measured<f32>>,
}

impl BranchesSought {
    /// How many branches there are.
    pub fn branches(&self) -> usize {
        self.cores.iter().map(|core| core.branch + 1).max().unwrap_or(0)
    }
}

/// The brightest part of one highlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighlightCore {
    /// Amount of body reflection under it, the median of its undistorted pixels, counts.
    pub body: f32,
    /// Standard deviation of that from pixel to pixel, counts: noise, shading, and what the plane leaves open.
    pub deviation: f32,
    /// Amount of surface reflection, the mean of its undistorted pixels, counts.
    pub surface: f32,
    /// Its pixels, clipped and bloomed ones included.
    pub pixels: u32,
    /// First column and row and last column and row that it spans.
    pub span_px: [u32; 4],
    /// The branch that it belongs to, from 0 for the strongest.
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
