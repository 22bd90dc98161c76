//! Slices (section 5.4.2).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, nothing, vector};
use crate::describe::{Names, counted, grouped};
use crate::trace::{MatteAreasUnited, SliceMade};
use serde_json::json;

impl Describe for SliceMade {
    fn sentence(&self, names: &Names) -> String {
        format!(
            "slice of {}: light {:.0}\u{b0} from the matte line, which is {:.0} counts long; half width {:.1} counts",
            names.hypothesis(self.hypothesis),
            self.plane.angle_deg(),
            self.matte_length,
            self.half_width
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis}),
            json!({
                "angle_deg": self.plane.angle_deg(),
                "normal": vector(&self.plane.normal),
                "matte_length": self.matte_length,
                "start": vector(&self.start),
            }),
            json!({"half_width": self.half_width}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        use crate::reflection::{DichromaticPlane, Slice};
        let matte = super::linear::example_line();
        let white = crate::color::Vec3::repeat(1.0).normalize();
        let plane = DichromaticPlane::new(&matte, &white).expect("invariant: the directions differ");
        Self {
            hypothesis: hypothesis(1),
            plane,
            matte_length: 100.0,
            start: matte.mean,
            half_width: 8.0,
            slice: Slice::unbounded(&plane, 8.0),
        }
    }
}

impl Describe for MatteAreasUnited {
    fn sentence(&self, names: &Names) -> String {
        let Self { hypothesis, into, taken_px, area_px } = *self;
        format!(
            "the matte area of {} is united with {}: {} of its {} lie in the same matte cylinder",
            names.hypothesis(hypothesis),
            names.hypothesis(into),
            grouped(taken_px),
            counted(area_px, "pixel")
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"region": self.hypothesis, "into": self.into}),
            json!({"pixels": self.taken_px, "area_pixels": self.area_px}),
            nothing(),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { hypothesis: hypothesis(2), into: hypothesis(1), taken_px: 400, area_px: 500 }
    }
}
