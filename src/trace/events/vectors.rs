//! By which vectors a region's pixels are split, and whether they explain them (section 6).

use super::{EventData, Subject};
use crate::color::{Line, Vec3};
use crate::raster::RegionId;

/// The vectors by which a region's pixels are split were fitted (section 6).
#[derive(Clone, Debug, PartialEq)]
pub struct VectorsFitted {
    /// The region.
    pub region: RegionId,
    /// Unit body reflection vector.
    pub body: Vec3,
    /// Unit surface reflection vector; none: everything is body reflection.
    pub surface: Option<Vec3>,
    /// The matte line that highlight pixels are told from.
    pub matte: Line,
    /// Where the highlight line left it when the region grew, counts.
    pub start: Vec3,
    /// Where the highlight lines begin that its pixels are told by, counts, the strongest branch first. One line begins at `start`;
    /// several begin clear of the noise around the matte line.
    pub starts: Vec<Vec3>,
    /// Unit direction of the highlight line, by which pixels are told apart: the plane's. None without a plane.
    pub highlight: Option<Vec3>,
    /// Surface reflection that lies less than this off the body line is none, counts; negative infinity: any is some.
    pub least_offset: f32,
    /// Root mean square distance of its pixels from the plane, counts.
    pub rms_counts: f64,
    /// How much surface and body reflection vary against each other: 1 for a print.
    pub texture: f64,
    /// Body reflection lost per surface reflection gained from pixel to pixel.
    pub texture_slope: f64,
    /// Up to where these may go.
    pub limits: FitLimits,
    /// Whether one skewed T explains it; where not, its plane is not used.
    pub model_fits: bool,
    /// Where body and surface reflection are measured from: black, or the ambient light, counts.
    pub origin: [f64; 3],
}

/// Up to where a region's figures may go for it to hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FitLimits {
    /// Root mean square distance from the plane, counts, and in σ.
    pub rms_counts: f64,
    /// See there.
    pub rms_sigmas: f64,
    /// Anticorrelation of body and surface reflection; it tells of texture only together with the next.
    pub texture: f64,
    /// Body reflection lost per surface reflection gained.
    pub texture_slope: f64,
}

impl EventData for VectorsFitted {
    fn subjects(&self) -> [Option<Subject>; 2] {
        [Some(Subject::Region(self.region)), None]
    }

    fn heap_bytes(&self) -> usize {
        size_of_val(self.starts.as_slice())
    }
}
