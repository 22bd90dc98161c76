//! From a file to linear light, and which of its pixels to believe.

mod linear;
mod masks;
mod noise;

pub use linear::LinearImage;
pub use masks::{MaskLimits, Masks};
pub use noise::estimate_sigma;
