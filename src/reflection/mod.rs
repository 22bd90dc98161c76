//! The Dichromatic Reflection Model itself (sections 2, 3 and 6).

mod amounts;
mod clipped_color;
mod desaturation;
mod highlight;
pub mod photometry;
mod plane;
mod sphere_cluster;
mod transform;

pub use amounts::{AmountRule, Amounts};
pub use clipped_color::ClippedColorTest;
pub use desaturation::{Desaturation, WhitenedColor, WhiteningGain};
pub use highlight::{HighlightTest, MOST_BRANCHES};
pub use plane::{DichromaticPlane, MIN_ANGLE_DEG, PlaneAxes, PlanePoint, Slice, SliceBound, SliceMiss};
pub use sphere_cluster::{SpherePoint, phase_of_q, sphere_points};
pub use transform::{Components, ReflectionTransform};
