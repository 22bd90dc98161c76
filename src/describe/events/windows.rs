//! Windows and areas (section 5.2).

use super::{Describe, LineObjects, nothing};
use crate::describe::names::short;
use crate::describe::{Names, counted, grouped, grouped_decimals};
use crate::trace::{Class, Measured, MergeTried, WindowClassified, WindowsLaid};
use serde_json::json;

impl Describe for WindowsLaid {
    fn sentence(&self, _names: &Names) -> String {
        let Self { size_px, columns, rows, least_pixels, camera_noise, tail_test } = self;
        let test = if *tail_test { "tail test" } else { "the paper's test" };
        format!(
            "{columns} \u{d7} {rows} windows of {size_px} px; at least {least_pixels} valid pixels for a class; {test}, \
             \u{3c3}0 {camera_noise:.2} counts"
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            nothing(),
            json!({"window_size": self.size_px, "columns": self.columns, "rows": self.rows, "tail_test": self.tail_test}),
            json!({"least_pixels": self.least_pixels, "camera_noise": self.camera_noise}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self { size_px: 10, columns: 4, rows: 3, least_pixels: 50, camera_noise: 2.5, tail_test: true }
    }
}

impl Describe for WindowClassified {
    fn sentence(&self, _names: &Names) -> String {
        let window = self.window;
        let pixels = counted(self.pixels, "valid pixel");
        let [a, b, c] = variances(self.eigenvalues);
        let verdict = self.class.map_or("too few for a class", Class::name);
        let held = held(self.chi_square);
        format!("window {window}, {pixels}, variances {a}, {b}, {c} counts\u{b2}, {held}: {verdict}")
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        LineObjects::new(
            json!({"window": self.window}),
            json!({
                "pixels": self.pixels,
                "eigenvalues": self.eigenvalues.map(short),
                "chi_square": short(self.chi_square.value),
                "class": self.class.map(Class::name),
            }),
            json!({"chi_square": short(self.chi_square.limit)}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        let chi_square = Measured::new(12.0, 123.0);
        Self { window: 5, pixels: 100, eigenvalues: [40.0, 2.0, 1.5], chi_square, class: Some(Class::Line) }
    }
}

impl Describe for MergeTried {
    fn sentence(&self, _names: &Names) -> String {
        let Self { into, from, pixels: [a, b], eigenvalues, chi_square, class, union } = self;
        let [x, y, z] = variances(*eigenvalues);
        let [a, b] = [a, b].map(|&pixels| grouped(pixels));
        let verdict = if class == union { "they merge" } else { "they stay apart" };
        format!(
            "areas {into} ({a} px) and {from} ({b} px), both {}: variances of the union {x}, {y}, {z} \
             counts\u{b2}, {}, {}: {verdict}",
            class.name(),
            held(*chi_square),
            union.name()
        )
    }

    fn line_objects(&self, _names: &Names) -> LineObjects {
        let Self { into, from, pixels, eigenvalues, chi_square, class, union } = self;
        LineObjects::new(
            json!({"into": into, "area": from}),
            json!({
                "pixels": pixels,
                "eigenvalues": eigenvalues.map(short),
                "chi_square": short(chi_square.value),
                "union": union.name(),
                "kept": class == union,
            }),
            json!({"class": class.name(), "chi_square": short(chi_square.limit)}),
        )
    }

    #[cfg(test)]
    fn example() -> Self {
        Self {
            into: 2,
            from: 9,
            pixels: [200, 100],
            eigenvalues: [50.0, 30.0, 1.0],
            chi_square: Measured::new(300.0, 210.0),
            class: Class::Line,
            union: Class::Plane,
        }
    }
}

/// The test that decided a class, in numbers.
fn held(chi_square: Measured<f32>) -> String {
    let Measured { value: statistic, limit: threshold } = chi_square;
    let relation = if statistic <= threshold { '\u{2264}' } else { '>' };
    let [statistic, threshold] = [statistic, threshold].map(|value| grouped_decimals(value.into(), 1));
    format!("\u{3c7}\u{b2} {statistic} {relation} {threshold}")
}

/// Variances as text: negative values, which come from rounding, are zero.
pub(in crate::describe) fn variances(eigenvalues: [f32; 3]) -> [String; 3] {
    eigenvalues.map(|variance| grouped_decimals(variance.max(0.0).into(), 1))
}
