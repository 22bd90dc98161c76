//! The Dichromatic Reflection Model itself (sections 2, 3 and 6).

mod highlight;
mod paleness;
pub mod photometry;
mod plane;
mod transform;

pub use highlight::{HighlightTest, MOST_BRANCHES};
pub use paleness::paleness_limits;
pub use plane::{DichromaticPlane, PlaneAxes, PlanePoint, Slice, SliceBound, SliceMiss};
pub use transform::{Components, ReflectionTransform};
