//! From a file to linear light, and which of its pixels to believe.

mod linear;

pub use linear::LinearImage;
