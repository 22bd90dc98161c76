//! The axes of the color spaces: their ends in the world, and the values along them.

use super::ColorSpace;
use super::space::{LAB_REACH, LOG_FLOOR};
use super::vector::Point;

/// An axis of a space.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Short name of the axis.
    pub name: &'static str,
    /// Unit of the values; empty for pure numbers.
    pub unit: &'static str,
    /// What the axis measures, one sentence.
    pub meaning: &'static str,
    /// The ends of the axis in the world, at its least and at its largest value.
    pub line: Vec<Point>,
    /// The marks on the axis, ascending.
    pub ticks: Vec<Tick>,
}

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The value at the mark, in the unit of the axis.
    pub value: f32,
    /// The value as text.
    pub label: String,
    /// Place of the mark in the world.
    pub place: Point,
}
impl ColorSpace {
    /// The axes of the space.
    pub fn axes(self, full_counts: f32) -> Vec<Axis> {
        match self {
            Self::Rgb => self.bands(
                ["R", "G", "B"],
                ["Red, linear light.", "Green, linear light.", "Blue, linear light."],
                &round_counts(full_counts),
                full_counts,
            ),
            Self::LogRgb => self.bands(
                ["log R", "log G", "log B"],
                ["Red, logarithmic.", "Green, logarithmic.", "Blue, logarithmic."],
                &[1.0, 4.0, 16.0, 64.0, 255.0].map(|share| share * LOG_FLOOR * full_counts),
                full_counts,
            ),
            Self::Lab => lab_axes(),
            Self::Hsv => hsv_axes(full_counts),
            Self::Chromaticity => chromaticity_axes(full_counts),
        }
    }

    /// Axes along the three bands.
    fn bands(
        self,
        names: [&'static str; 3],
        meanings: [&'static str; 3],
        values: &[f32],
        full_counts: f32,
    ) -> Vec<Axis> {
        let on = |band: usize, counts: f32| {
            let mut color = [0.0; 3];
            color[band] = counts;
            self.place(color, full_counts)
        };
        (0..3)
            .map(|band| Axis {
                name: names[band],
                unit: "counts",
                meaning: meanings[band],
                line: vec![on(band, 0.0), on(band, full_counts)],
                ticks: values.iter().map(|&value| tick(value, on(band, value))).collect(),
            })
            .collect()
    }
}

/// Multiples of a quarter of full scale, rounded to a power of two, and full scale itself.
fn round_counts(full_counts: f32) -> Vec<f32> {
    let step = (full_counts / 4.0).log2().ceil().exp2();
    let mut values: Vec<f32> =
        (0..4).map(|i| i as f32 * step).filter(|v| *v < full_counts - 0.3 * step).collect();
    values.push(full_counts);
    values
}

fn tick(value: f32, place: Point) -> Tick {
    let digits = match value.abs() {
        v if v == 0.0 || v >= 10.0 || (v - v.round()).abs() < 1e-3 => 0,
        v if v >= 1.0 => 1,
        _ => 2,
    };
    let label =
        if value < 0.0 { format!("\u{2212}{:.digits$}", -value) } else { format!("{value:.digits$}") };
    Tick { value, label, place }
}

fn lab_axes() -> Vec<Axis> {
    let gray = |l: f32| [0.5, 0.5, l / 100.0];
    let opponent = |value: f32| 0.5 + 0.5 * value / LAB_REACH;
    let across = |name, meaning, place: &dyn Fn(f32) -> Point| Axis {
        name,
        unit: "",
        meaning,
        line: vec![place(-100.0), place(100.0)],
        ticks: [-100.0, -50.0, 0.0, 50.0, 100.0].map(|v| tick(v, place(v))).to_vec(),
    };
    let lightness = Axis {
        name: "L*",
        unit: "",
        meaning: "Lightness, from black to white.",
        line: vec![gray(0.0), gray(100.0)],
        ticks: [0.0, 25.0, 50.0, 75.0, 100.0].map(|l| tick(l, gray(l))).to_vec(),
    };
    vec![
        across("a*", "From green to red.", &|v| [opponent(v), 0.5, 0.0]),
        across("b*", "From blue to yellow.", &|v| [0.5, opponent(v), 0.0]),
        lightness,
    ]
}

fn hsv_axes(full_counts: f32) -> Vec<Axis> {
    let rim = |degrees: f32, saturation: f32| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        [0.5 + 0.5 * saturation * cosine, 0.5 + 0.5 * saturation * sine, 1.0]
    };
    let gray = |counts: f32| [0.5, 0.5, counts / full_counts];
    vec![
        Axis {
            name: "hue",
            unit: "\u{b0}",
            meaning: "Angle around gray: red 0, green 120, blue 240.",
            line: (0..=72).map(|i| rim(5.0 * i as f32, 1.0)).collect(),
            ticks: (0..6).map(|i| tick(60.0 * i as f32, rim(60.0 * i as f32, 1.0))).collect(),
        },
        Axis {
            name: "saturation",
            unit: "",
            meaning: "Distance from gray: one minus the smallest band over the largest.",
            line: vec![rim(0.0, 0.0), rim(0.0, 1.0)],
            ticks: [0.0, 0.5, 1.0].map(|s| tick(s, rim(0.0, s))).to_vec(),
        },
        Axis {
            name: "value",
            unit: "counts",
            meaning: "The largest band.",
            line: vec![gray(0.0), gray(full_counts)],
            ticks: round_counts(full_counts).into_iter().map(|v| tick(v, gray(v))).collect(),
        },
    ]
}

fn chromaticity_axes(full_counts: f32) -> Vec<Axis> {
    let share = |name, meaning, place: &dyn Fn(f32) -> Point| Axis {
        name,
        unit: "",
        meaning,
        line: vec![place(0.0), place(1.0)],
        ticks: [0.0, 0.25, 0.5, 0.75, 1.0].map(|v| tick(v, place(v))).to_vec(),
    };
    let height = |sum: f32| [0.0, 0.0, sum / (3.0 * full_counts)];
    let sum = Axis {
        name: "R+G+B",
        unit: "counts",
        meaning: "Sum of the three bands.",
        line: vec![height(0.0), height(3.0 * full_counts)],
        ticks: round_counts(3.0 * full_counts).into_iter().map(|v| tick(v, height(v))).collect(),
    };
    vec![
        share("r", "Share of red: R / (R+G+B).", &|v| [v, 0.0, 0.0]),
        share("g", "Share of green: G / (R+G+B).", &|v| [0.0, v, 0.0]),
        sum,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_marked_at_round_numbers() {
        assert_eq!(round_counts(255.0), [0.0, 64.0, 128.0, 192.0, 255.0]);
        assert_eq!(round_counts(2040.0), [0.0, 512.0, 1024.0, 1536.0, 2040.0]);
        assert_eq!(round_counts(300.0), [0.0, 128.0, 256.0, 300.0]);
        assert_eq!(round_counts(260.0), [0.0, 128.0, 260.0], "256 would touch 260");
        assert_eq!(round_counts(1.0), [0.0, 0.25, 0.5, 0.75, 1.0]);
        let labels: Vec<String> =
            [0.0, 0.25, 1.5, 192.0, 1374.3, -50.0].map(|v| tick(v, [0.0; 3]).label).to_vec();
        assert_eq!(labels, ["0", "0.25", "1.5", "192", "1374", "\u{2212}50"]);
    }

    #[test]
    fn every_tick_lies_on_its_axis_in_ascending_order() {
        for space in ColorSpace::ALL {
            let axes = space.axes(255.0);
            assert_eq!(axes.len(), 3);
            for axis in axes {
                assert!(axis.ticks.len() >= 3, "{}", axis.name);
                assert!(axis.ticks.is_sorted_by(|a, b| a.value < b.value), "{}", axis.name);
                for tick in &axis.ticks {
                    let off = axis.line.windows(2).map(|ends| off_segment(tick.place, ends[0], ends[1]));
                    let off = off.fold(f32::INFINITY, f32::min);
                    assert!(off < 2e-3, "{} {}: {off}", axis.name, tick.label);
                }
            }
        }
    }

    /// Distance of a point from a segment.
    fn off_segment(p: Point, a: Point, b: Point) -> f32 {
        let (ab, ap): (Point, Point) =
            (std::array::from_fn(|i| b[i] - a[i]), std::array::from_fn(|i| p[i] - a[i]));
        let t = (crate::color::dot(ap, ab) / crate::color::dot(ab, ab)).clamp(0.0, 1.0);
        (0..3).map(|i| (ap[i] - t * ab[i]).powi(2)).sum::<f32>().sqrt()
    }
}
