//! The dichromatic plane of one object (sections 3.1 and 5.4.2): the plane that matte line and illuminant span.
//!
//! A color has three coordinates relative to the plane: `along` the matte direction from black, the in-plane `offset` from the
//! matte line towards the illuminant, and the signed `height` above the plane. With θ the angle between matte line and
//! illuminant, the amount of surface reflection is offset / sinθ, and the amount of body reflection is along − offset·cotθ.

use crate::color::{Line, Vec3, dot, rgb};

/// Smallest angle between body and surface reflection vector at which both can be told apart, degrees. Below this angle the
/// noise is amplified more than nineteen times, and the plane is undetermined.
pub const MIN_ANGLE_DEG: f64 = 3.0;

/// A dichromatic plane with its matte line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DichromaticPlane {
    /// The matte line.
    pub matte: Line,
    /// Unit direction of surface reflection, that of the illuminant.
    pub surface: Vec3,
    /// Unit direction in the plane, perpendicular to the matte line, on the illuminant's side.
    pub inward: Vec3,
    /// Unit normal, matte direction × inward.
    pub normal: Vec3,
    /// Angle between matte line and illuminant, radians in 0…π/2.
    pub angle_rad: f64,
}

impl DichromaticPlane {
    /// The plane of a matte line and an illuminant; `None` when they are collinear to 1e-6.
    pub fn new(matte: &Line, illuminant: &Vec3) -> Option<Self> {
        let surface = illuminant.normalize();
        let across = surface - matte.direction * surface.dot(&matte.direction);
        let sine = across.norm();
        if sine < 1e-6 {
            return None;
        }
        let inward = across / sine;
        Some(Self {
            matte: *matte,
            surface,
            inward,
            normal: matte.direction.cross(&inward),
            angle_rad: sine.atan2(surface.dot(&matte.direction)),
        })
    }

    /// Angle between matte line and illuminant, degrees.
    pub fn angle_deg(&self) -> f64 {
        self.angle_rad.to_degrees()
    }

    /// The axes of the plane's coordinates, in the precision of pixels.
    pub fn coordinates(&self) -> PlaneAxes {
        PlaneAxes {
            mean: rgb(&self.matte.mean),
            direction: rgb(&self.matte.direction),
            inward: rgb(&self.inward),
            normal: rgb(&self.normal),
        }
    }
}

/// The coordinate axes of a dichromatic plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneAxes {
    mean: [f32; 3],
    direction: [f32; 3],
    inward: [f32; 3],
    normal: [f32; 3],
}

/// Coordinates of a color relative to a dichromatic plane, counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePoint {
    /// Along the matte direction, from black.
    pub along: f32,
    /// In the plane, from the matte line, positive towards the illuminant.
    pub offset: f32,
    /// Above the plane, with sign.
    pub height: f32,
}

impl PlaneAxes {
    /// The coordinates of a color.
    #[inline]
    pub fn of(&self, color: [f32; 3]) -> PlanePoint {
        let v = [color[0] - self.mean[0], color[1] - self.mean[1], color[2] - self.mean[2]];
        PlanePoint {
            along: dot(color, self.direction),
            offset: dot(v, self.inward),
            height: dot(v, self.normal),
        }
    }
}

/// The part of the color space around a dichromatic plane that a planar hypothesis claims (figure 10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slice {
    axes: PlaneAxes,
    half_width: f32,
    bounds: Option<Bounds>,
}

/// A bound of a slice, and the measure that the bound limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SliceBound {
    /// The two faces. Measure: distance from the plane.
    Height,
    /// The side of the matte line on which surface reflection is negative. Measure: signed distance from the matte line.
    Surface,
    /// Black, below which body reflection is negative. Measure: amount of body reflection.
    Black,
    /// The end of the matte line. Measure: amount of body reflection.
    MatteEnd,
}

/// The bound outside which a color lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceMiss {
    /// The bound.
    pub bound: SliceBound,
    /// Measure of the color, counts.
    pub value: f32,
    /// Limit of the measure, counts.
    pub limit: f32,
}

/// Limits of body and surface reflection in a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bounds {
    /// Least offset from the matte line, counts.
    least_offset: f32,
    /// cotθ, θ the angle between matte line and illuminant.
    cotangent: f32,
    /// Largest amount of body reflection, counts.
    most_body: f32,
    /// Tolerance of the amount of body reflection, counts.
    slack: f32,
}

impl Slice {
    /// All colors within `half_width_counts` of the plane.
    pub fn unbounded(plane: &DichromaticPlane, half_width_counts: f64) -> Self {
        Self { axes: plane.coordinates(), half_width: half_width_counts as f32, bounds: None }
    }

    /// The colors within `half_width_counts` of the plane with an offset of at least −`radius_counts` from the matte line, and
    /// with body reflection between 0 and 115 % of the matte line's length `matte_length_counts`, with a tolerance of
    /// `radius_counts`.
    pub fn bounded(
        plane: &DichromaticPlane,
        half_width_counts: f64,
        radius_counts: f64,
        matte_length_counts: f64,
    ) -> Self {
        let bounds = Bounds {
            least_offset: -radius_counts as f32,
            cotangent: (1.0 / plane.angle_rad.tan()) as f32,
            most_body: (1.15 * matte_length_counts + radius_counts) as f32,
            slack: (radius_counts / plane.angle_rad.sin()) as f32,
        };
        Self { bounds: Some(bounds), ..Self::unbounded(plane, half_width_counts) }
    }

    /// Whether a color lies inside: [`Self::miss`] finds no bound. Growth asks this of every pixel that it visits, without the bound.
    #[inline]
    pub fn contains(&self, color: [f32; 3]) -> bool {
        let point = self.axes.of(color);
        point.height.abs() <= self.half_width
            && self.bounds.is_none_or(|b| {
                let body = point.along - b.cotangent * point.offset;
                point.offset >= b.least_offset && body >= -b.slack && body <= b.most_body + b.slack
            })
    }

    /// The first bound outside which a color lies; `None` for a color inside the slice.
    pub fn miss(&self, color: [f32; 3]) -> Option<SliceMiss> {
        let point = self.axes.of(color);
        let miss = |bound, value, limit| Some(SliceMiss { bound, value, limit });
        if point.height.abs() > self.half_width {
            return miss(SliceBound::Height, point.height.abs(), self.half_width);
        }
        let b = self.bounds?;
        let body = point.along - b.cotangent * point.offset;
        if point.offset < b.least_offset {
            return miss(SliceBound::Surface, point.offset, b.least_offset);
        }
        if body < -b.slack {
            return miss(SliceBound::Black, body, -b.slack);
        }
        (body > b.most_body + b.slack).then_some(SliceMiss {
            bound: SliceBound::MatteEnd,
            value: body,
            limit: b.most_body + b.slack,
        })
    }

    /// Distance of a color from the plane, counts.
    #[inline]
    pub fn distance(&self, color: [f32; 3]) -> f32 {
        self.axes.of(color).height.abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::vec3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn coordinates_are_body_surface_and_noise(
            d in prop::array::uniform3(0.05f64..1.0),
            s in prop::array::uniform3(0.3f64..1.0),
            (body, surface, height) in (20f64..200.0, 0f64..200.0, -5f64..5.0),
        ) {
            let (d, s) = (Vec3::from(d).normalize(), Vec3::from(s).normalize());
            prop_assume!(d.cross(&s).norm() > 0.1);
            let plane = DichromaticPlane::new(&Line::new(d * 90.0, d), &s).unwrap();
            let color = rgb(&(d * body + s * surface + plane.normal * height));
            let point = plane.coordinates().of(color);
            let (sine, cosine) = plane.angle_rad.sin_cos();
            prop_assert!((f64::from(point.offset) - surface * sine).abs() < 1e-3);
            prop_assert!((f64::from(point.along) - body - surface * cosine).abs() < 1e-3);
            prop_assert!((f64::from(point.height) - height).abs() < 1e-3);
            prop_assert!((plane.normal.dot(&vec3(rgb(&s)))).abs() < 1e-6);
            let slice = Slice::bounded(&plane, 6.0, 8.0, 200.0);
            prop_assert!(slice.contains(color) && slice.miss(color).is_none());
            prop_assert!(!Slice::bounded(&plane, 6.0, 8.0, body / 2.0 - 40.0 / sine).contains(color));
        }
    }

    proptest! {
        #[test]
        fn a_color_is_inside_unless_it_lies_outside_some_bound(c in prop::array::uniform3(0f32..255.0), s in prop::array::uniform3(0.3f64..1.0)) {
            let (d, s) = (Vec3::new(0.9, 0.3, 0.2).normalize(), Vec3::from(s).normalize());
            let plane = DichromaticPlane::new(&Line::new(d * 90.0, d), &s).unwrap();
            for slice in [Slice::bounded(&plane, 6.0, 8.0, 120.0), Slice::unbounded(&plane, 6.0)] {
                let miss = slice.miss(c);
                prop_assert_eq!(slice.contains(c), miss.is_none());
                if let Some(SliceMiss { bound, value, limit }) = miss {
                    let below = matches!(bound, SliceBound::Surface | SliceBound::Black);
                    prop_assert!(if below { value < limit } else { value > limit }, "{:?}", miss);
                }
            }
        }
    }

    #[test]
    fn a_color_can_lie_outside_each_bound() {
        // Body along red, light along green: coordinates are the bands themselves.
        let plane = DichromaticPlane::new(&Line::new(Vec3::x() * 50.0, Vec3::x()), &Vec3::y()).unwrap();
        let slice = Slice::bounded(&plane, 6.0, 8.0, 100.0);
        let miss = |color| slice.miss(color).map(|miss| (miss.bound, miss.value.round(), miss.limit.round()));
        assert_eq!(miss([50.0, 90.0, 3.0]), None);
        assert_eq!(miss([50.0, 90.0, 9.0]), Some((SliceBound::Height, 9.0, 6.0)));
        assert_eq!(miss([50.0, -9.0, 0.0]), Some((SliceBound::Surface, -9.0, -8.0)));
        assert_eq!(miss([-9.0, 20.0, 0.0]), Some((SliceBound::Black, -9.0, -8.0)));
        // 15 % beyond the matte line, and twice the radius.
        assert_eq!(miss([140.0, 20.0, 0.0]), Some((SliceBound::MatteEnd, 140.0, 131.0)));
    }

    #[test]
    fn collinear_vectors_span_no_plane() {
        let line = Line::new(Vec3::repeat(50.0), Vec3::repeat(1.0));
        assert!(DichromaticPlane::new(&line, &Vec3::repeat(1.0)).is_none());
    }
}
