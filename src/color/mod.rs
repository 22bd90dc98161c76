//! Points in the RGB cube: moments and eigenvectors of clusters, the χ² test, robust lines, cylinders.
//!
//! Colors of pixels are `[f32; 3]` in linear counts; lines and moments fitted to colors are `f64`.

mod chi_square;
mod cluster;
mod contrast;
mod eigen;
mod line;
mod moments;
mod srgb;

pub use chi_square::ChiSquareThresholds;
pub use cluster::{ClusterTest, Trial};
pub use contrast::ContrastCurve;
pub use eigen::{eigenvalues, principal_axes};
pub(crate) use line::closest_points;
pub use line::{Cylinder, Line, OuterSide, RobustFitSettings};
pub use moments::Moments;
pub use srgb::{linear_from_srgb, srgb_from_linear};

/// A vector or point of the color space; colors of pixels are `[f32; 3]` instead.
pub type Vec3 = nalgebra::Vector3<f64>;

/// A pixel's color as a vector.
#[inline]
pub fn vec3(color: [f32; 3]) -> Vec3 {
    Vec3::new(f64::from(color[0]), f64::from(color[1]), f64::from(color[2]))
}

/// A vector as a pixel's color.
#[inline]
pub fn rgb(vector: &Vec3) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}

/// Scalar product of two colors.
#[inline]
pub fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Euclidean length of a color.
#[inline]
pub fn length(color: [f32; 3]) -> f32 {
    dot(color, color).sqrt()
}

/// Angle between two directions regardless of their signs, degrees in 0…90.
pub fn axis_angle_deg(a: &Vec3, b: &Vec3) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs()).to_degrees()
}
