//! The vectors by which the pixels of a region are split, and whether the skewed T explains the region (section 6).

use super::{EventData, Subject};
use crate::color::{Line, Vec3};
use crate::raster::RegionId;

/// The vectors by which the pixels of a region are split were fitted (section 6).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VectorsFitted {
    /// The region.
    pub region: RegionId,
    /// Unit body reflection vector.
    pub body: Vec3,
    /// Unit surface reflection vector; none: everything is body reflection.
    pub surface: Option<Vec3>,
    /// The matte line; a pixel is matte or highlight by the nearer of this line and the highlight lines.
    pub matte: Line,
    /// The point where the highlight line left the matte line when the region grew, counts.
    pub start: Vec3,
    /// The points where the highlight lines begin by which pixels are classed, counts, the strongest branch first. A single line
    /// begins at `start`; several lines begin outside the noise around the matte line.
    pub starts: Vec<Vec3>,
    /// Unit direction of the highlight lines by which pixels are classed; none without a plane.
    pub highlight: Option<Vec3>,
    /// Least distance from the body line of a color with surface reflection, counts; negative infinity: there is no limit.
    pub least_offset: f32,
    /// The figures by which the region was judged.
    pub figures: FitFigures,
    /// The limits of the figures.
    pub limits: FitLimits,
    /// Whether the skewed T explains the region; where not, the plane is not used.
    pub model_fits: bool,
    /// Whether the run asks if the skewed T explains the region (refinement `region_holds`); where not, `model_fits` says nothing.
    pub is_judged: bool,
    /// The color from which body and surface reflection are measured: black, or the ambient light, counts.
    pub origin: [f64; 3],
    /// Whether the region is not split, so that the body reflection of a pixel is its color (reading `unsplit_without_highlight`).
    pub unsplit: bool,
    /// The line from which ε is measured without a plane, its mean measured from `origin`; none: ε is 0 (reading `cylinder_noise`).
    pub noise_line: Option<Line>,
}

/// The figures by which a region is judged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FitFigures {
    /// Root mean square distance of the pixels from the plane, counts; without a plane from the line.
    pub rms_counts: f64,
    /// Anticorrelation of surface and body reflection from pixel to pixel: 1 for a print.
    pub texture: f64,
    /// Body reflection lost per surface reflection gained from pixel to pixel.
    pub texture_slope: f64,
    /// Interval of the light as a share of the angle between body and surface vector.
    pub light_share: f64,
    /// Share of the border at which the split makes an edge that the photograph does not have, 0…1.
    pub new_edges: f64,
    /// Mean probability of a highlight in the surface reflection of the plane, 0…1; none where it was not measured.
    pub highlights: Option<f64>,
}

/// The limits of the figures of a region that its skewed T explains: the largest figures, and of the last the least.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct FitLimits {
    /// Root mean square distance from the plane, counts.
    pub rms_counts: f64,
    /// The same in σ.
    pub rms_sigmas: f64,
    /// Anticorrelation of body and surface reflection; both this limit and the next have to be exceeded.
    pub texture: f64,
    /// Body reflection lost per surface reflection gained.
    pub texture_slope: f64,
    /// Interval of the light as a share of the angle between body and surface vector.
    pub light_share: f64,
    /// Share of the border with a new edge, 0…1.
    pub new_edges: f64,
    /// Least mean probability of a highlight in the surface reflection of the plane, 0…1.
    pub highlights: f64,
}

impl EventData for VectorsFitted {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Region(self.region)), None]
    }

    fn heap_bytes(&self) -> usize {
        size_of_val(self.starts.as_slice())
    }
}
