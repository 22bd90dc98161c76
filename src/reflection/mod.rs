//! The Dichromatic Reflection Model itself (sections 2, 3 and 6).

mod amounts;
mod desaturation;
mod highlight;
pub mod photometry;
mod plane;
mod transform;

pub use amounts::{AmountRule, Amounts};
pub use desaturation::{Desaturation, WhitenedColor, WhiteningGain};
pub use highlight::{HighlightTest, MOST_BRANCHES};
pub use plane::{DichromaticPlane, MIN_ANGLE_DEG, PlaneAxes, PlanePoint, Slice, SliceBound, SliceMiss};
pub use transform::{Components, ReflectionTransform};
