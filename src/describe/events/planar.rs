//! Slices (section 5.4.2).

#[cfg(test)]
use super::hypothesis;
use super::{Describe, LineObjects, vector};
use crate::describe::Names;
use crate::trace::SliceMade;
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
