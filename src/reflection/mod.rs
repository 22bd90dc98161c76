//! The Dichromatic Reflection Model itself (sections 2, 3 and 6).

pub mod photometry;
mod plane;
mod transform;

pub use plane::{DichromaticPlane, PlaneAxes, PlanePoint, Slice};
pub use transform::{Components, ReflectionTransform};
