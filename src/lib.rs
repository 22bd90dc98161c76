//! Physics-based colour vision with the Dichromatic Reflection Model (Klinker, Shafer & Kanade 1990).

pub mod analysis;
pub mod intrinsic;
pub mod photo;
pub mod raster;
pub mod reflection;
pub mod segment;
pub mod trace;
