//! Section 6: every pixel split into body reflection, surface reflection and noise.

mod ambient;
mod angle_limits;
mod border_edges;
mod border_mixtures;
mod confidence;
mod detail;
mod explained_mask;
mod far_colors;
mod finish;
mod full_resolution;
mod images;
mod local;
mod pixel;
mod plane_evidence;
mod reason;
mod region;
mod region_plan;
mod region_warning;
mod restore;
mod split;
mod vectors;

pub use detail::Detail;
pub use full_resolution::split_photograph;
pub use reason::Reason;
pub use region_plan::{FittedPlace, RegionPlans};
pub use region_warning::{AngleWarning, RegionWarning};
pub use split::{JudgedPlans, WorkingSplit, judged_plans, split};

use crate::raster::{Raster, RegionId};
pub use crate::segment::RegionVerdict;
pub use crate::trace::{Ambient, AmbientVerdict, Meeting, PixelKind};

/// The intrinsic images, and the report of each region.
#[derive(Clone, Debug, PartialEq)]
pub struct Intrinsic {
    /// Body reflection, counts (m_b·C_b); the input where a pixel is unassigned.
    pub body: Raster<[f32; 3]>,
    /// Surface reflection, counts (m_s·C_s); zero where a pixel is unassigned.
    pub surface: Raster<[f32; 3]>,
    /// Signed distance ε from the dichromatic plane, counts; zero where a pixel is unassigned.
    pub noise: Raster<f32>,
    /// Whether each pixel is matte, highlight, restored, lost or unassigned.
    pub kinds: Raster<PixelKind>,
    /// Confidence in the split of each pixel, 0…1.
    pub confidence: Raster<f32>,
    /// The reason why the skewed T of one region does not explain a pixel.
    pub reasons: Raster<Reason>,
    /// The estimate of the ambient light.
    pub ambient: Ambient,
    /// The regions, by [`RegionId::index`].
    pub regions: Vec<RegionReflection>,
}

/// One highlight line of a region, and the highlights on it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct HighlightBranch {
    /// Color at which the line leaves the matte line, counts.
    pub start: [f64; 3],
    /// Amount of body reflection under its highlights, m_b, counts.
    pub body: f64,
    /// Number of the line's highlight pixels, restored ones included.
    pub pixels: usize,
    /// Share of these in the region's highlight pixels, 0…1; 0 for a region without highlight pixels.
    pub share: f64,
}

/// One region's reflection vectors and how well they explain its pixels.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RegionReflection {
    /// The region.
    pub id: RegionId,
    /// Number of the region's pixels.
    pub pixels: usize,
    /// Number of pixels nearer to the matte line.
    pub matte_pixels: usize,
    /// Number of the other pixels: nearer to a highlight line, or clipped or bloomed. Without a highlight line they are no
    /// highlights, see [`Self::highlights`].
    pub highlight_pixels: usize,
    /// Number of clipped pixels.
    pub clipped_pixels: usize,
    /// Body reflection vector C_b, unit.
    pub body: [f64; 3],
    /// Surface reflection vector C_s, unit; none where the region has no dichromatic plane.
    pub surface: Option<[f64; 3]>,
    /// Mean color of the matte pixels, counts.
    pub matte_mean: [f64; 3],
    /// Color at which the strongest highlight line leaves the matte line, counts; none without a surface reflection vector.
    pub highlight_start: Option<[f64; 3]>,
    /// The region's highlight lines (section 7.4), the strongest first: more than one where highlights lie on different amounts
    /// of body reflection. Empty where body and surface reflection cannot be separated.
    pub highlight_branches: Vec<HighlightBranch>,
    /// Unit normal of the dichromatic plane, C_b × C_s.
    pub plane_normal: Option<[f64; 3]>,
    /// Angle between body and surface vector, degrees.
    pub angle_deg: Option<f64>,
    /// Root mean square distance of the undistorted pixels from the plane, counts; without a plane from the matte line.
    pub fit_rms_counts: f64,
    /// The part of that distance which noise and the error of the file's values explain (σ), counts.
    pub fit_sigma_counts: f64,
    /// Largest such distance of a region that the model fits, counts.
    pub fit_limit_counts: f64,
    /// Whether one skewed T explains the region; where not, why, and the region's plane is not used.
    pub verdict: RegionVerdict,
    /// Confidence in the region's split, 0…1; 0 where the skewed T does not explain the region.
    pub confidence: f64,
    /// How much surface and body reflection vary against each other from pixel to pixel: 1 for a print, about 0 for highlights.
    pub texture: f64,
    /// Whether body and surface reflection can be separated.
    pub separable: bool,
    /// The adjacent regions, ascending.
    pub neighbors: Vec<RegionId>,
    /// Warnings about the region's split.
    pub warnings: Vec<RegionWarning>,
}

impl RegionReflection {
    /// Number of pixels that belong to the region's highlights, clipped and bloomed ones included; none of a region without a
    /// highlight line, and of one without such pixels.
    pub fn highlights(&self) -> Option<usize> {
        self.surface.map(|_| self.highlight_pixels).filter(|&pixels| pixels > 0)
    }

    /// Whether one skewed T explains the region, or its matte line alone where it has no plane; where not, the region's plane is not used.
    pub fn model_fits(&self) -> bool {
        self.verdict.fits()
    }
}
