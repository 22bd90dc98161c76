//! Section 6: every pixel split into body reflection, surface reflection and noise.

mod ambient;
mod confidence;
mod explained_mask;
mod images;
mod local;
mod pixel;
mod reason;
mod region;
mod region_plan;
mod restore;
mod split;
mod vectors;

pub use reason::Reason;
pub use split::split;

use crate::raster::Raster;
pub use crate::segment::POOR_FIT;
pub use crate::trace::{Ambient, AmbientVerdict, Meeting, PixelKind};

/// The intrinsic images and what is known of each region.
#[derive(Clone, Debug, PartialEq)]
pub struct Intrinsic {
    /// Body reflection, counts (m_b·C_b); the input where a pixel is unassigned.
    pub body: Raster<[f32; 3]>,
    /// Surface reflection, counts (m_s·C_s); zero where a pixel is unassigned.
    pub surface: Raster<[f32; 3]>,
    /// Signed distance ε from the dichromatic plane, counts; zero where a pixel is unassigned.
    pub noise: Raster<f32>,
    /// What each pixel is to its region.
    pub kinds: Raster<PixelKind>,
    /// How far the split of each pixel is to be believed, 0…1.
    pub confidence: Raster<f32>,
    /// Why a pixel is not explained by one region's skewed T.
    pub reasons: Raster<Reason>,
    /// What is known of the ambient light.
    pub ambient: Ambient,
    /// The regions; region `id` is at index `id − 1`.
    pub regions: Vec<RegionReflection>,
}

/// One highlight line of a region, and the highlights on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighlightBranch {
    /// Where it leaves the matte line, counts.
    pub start: [f64; 3],
    /// Amount of body reflection under its highlights, m_b, counts.
    pub body: f64,
    /// Its pixels, restored ones included.
    pub pixels: usize,
    /// Its share of the region's highlight pixels, 0…1; 0 where there are none.
    pub share: f64,
}

/// One region's reflection vectors and how well they explain its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionReflection {
    /// Its label, from 1.
    pub id: u16,
    /// All its pixels.
    pub pixels: usize,
    /// Pixels nearer to the matte line.
    pub matte_pixels: usize,
    /// Pixels nearer to the highlight line, restored ones included.
    pub highlight_pixels: usize,
    /// Clipped pixels.
    pub clipped_pixels: usize,
    /// Body reflection vector C_b, unit.
    pub body: [f64; 3],
    /// Surface reflection vector C_s, unit; none where the region has no dichromatic plane.
    pub surface: Option<[f64; 3]>,
    /// Mean color of the matte pixels, counts.
    pub matte_mean: [f64; 3],
    /// Where the highlight line leaves the matte line, counts; that of the strongest branch.
    pub highlight_start: Option<[f64; 3]>,
    /// Its highlight lines (7.4), the strongest first: more than one where highlights lie on different shades. Empty where body
    /// and surface cannot be told apart.
    pub highlight_branches: Vec<HighlightBranch>,
    /// Unit normal of the dichromatic plane, C_b × C_s.
    pub plane_normal: Option<[f64; 3]>,
    /// Angle between body and surface vector, degrees.
    pub angle_deg: Option<f64>,
    /// Root mean square distance of its undistorted pixels from the plane (from the line without one), counts.
    pub fit_rms_counts: f64,
    /// Whether one skewed T explains it; where not, its plane is not used.
    pub model_fits: bool,
    /// How far its split is to be believed, 0…1; 0 where it does not hold.
    pub confidence: f64,
    /// How much surface and body reflection vary against each other from pixel to pixel: 1 for a print, about 0 for highlights.
    pub texture: f64,
    /// Whether body and surface can be told apart.
    pub separable: bool,
    /// Regions that it touches, ascending.
    pub neighbors: Vec<u16>,
    /// What to beware of, in words.
    pub warnings: Vec<String>,
}
