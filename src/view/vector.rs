//! Vectors of three numbers, and the arithmetic that shapes need.

/// A color in linear counts, a place in the world of a color space, or a direction in either.
pub type Point = [f32; 3];

/// A vector in single precision.
pub(super) fn point(v: [f64; 3]) -> Point {
    v.map(|x| x as f32)
}

pub(super) fn dot64(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross64(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: Point, b: Point) -> f32 {
    crate::color::dot(a, b)
}

pub(super) fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn distance(a: Point, b: Point) -> f32 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt()
}

pub(super) fn halfway(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| f32::midpoint(a[i], b[i]))
}

pub(super) fn unit(v: Point) -> Option<Point> {
    let length = dot(v, v).sqrt();
    (length > 1e-15 && length.is_finite()).then(|| v.map(|x| x / length))
}
