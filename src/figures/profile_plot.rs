//! Body reflection, surface reflection and noise along a line as curves (color figure 11).

use super::html::escaped;
use super::numbers::decimals;
use super::scene::Scene;
use crate::raster::RegionId;
use crate::view::{ProfileSample, profile};
use std::fmt::Write;

/// Size of the plot, units of the drawing.
const WIDTH: f64 = 760.0;
/// Left and right end of the curves.
const ENDS: [f64; 2] = [58.0, 748.0];
/// Height of a panel, and of the space below it.
const PANEL: [f64; 2] = [120.0, 26.0];
/// Height of the band that shows the regions.
const BAND: f64 = 9.0;
/// Most positions along the line at which a curve has values of its own; more are drawn as the range of each group.
const MOST_POSITIONS: usize = 690;

/// A curve of the plot.
struct Curve {
    name: &'static str,
    color: &'static str,
    value: fn(&ProfileSample) -> Option<f32>,
    /// Whether the range contains zero in its middle.
    is_signed: bool,
}

const CURVES: [Curve; 3] = [
    Curve {
        name: "body reflection m\u{303}_b, counts",
        color: "#1f5a96",
        value: |s| s.body,
        is_signed: false,
    },
    Curve {
        name: "surface reflection m\u{303}_s, counts",
        color: "#b3402a",
        value: |s| s.surface,
        is_signed: false,
    },
    Curve { name: "noise \u{3b5}, counts", color: "#4d4d4d", value: |s| s.noise, is_signed: true },
];

/// The samples along the scene's line.
pub fn samples(scene: &Scene) -> Vec<ProfileSample> {
    profile(&scene.shown.picture, Some(&scene.shown), scene.line)
}

/// The largest amounts of body and surface reflection and the largest distance from the plane, counts.
pub fn largest(samples: &[ProfileSample]) -> [f32; 3] {
    std::array::from_fn(|i| {
        samples.iter().filter_map(CURVES[i].value).fold(0.0f32, |most, v| most.max(v.abs()))
    })
}

/// The plot as an `svg` element.
pub fn svg(scene: &Scene, samples: &[ProfileSample]) -> String {
    let height = 3.0 * (PANEL[0] + PANEL[1]) + BAND + 40.0;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"Profiles of body reflection, surface reflection and noise\" font-size=\"12\">"
    );
    let length = samples.last().map_or(1.0, |last| f64::from(last.position_px)).max(1.0);
    let x_of = |position: f64| ENDS[0] + (ENDS[1] - ENDS[0]) * position / length;
    let mut top = 16.0;
    for curve in &CURVES {
        svg.push_str(&panel(curve, samples, top, &x_of));
        top += PANEL[0] + PANEL[1];
    }
    svg.push_str(&region_band(scene, samples, top - 12.0, &x_of));
    svg.push_str(&positions(samples, length, top - 12.0 + BAND, &x_of));
    svg.push_str("</svg>");
    svg
}

/// One curve with its frame and the marks of its axis.
fn panel(curve: &Curve, samples: &[ProfileSample], top: f64, x_of: &dyn Fn(f64) -> f64) -> String {
    let values = || samples.iter().filter_map(curve.value).map(f64::from);
    let high = values().fold(0.0f64, f64::max);
    let low = values().fold(0.0f64, f64::min);
    let reach = if curve.is_signed { high.max(-low).max(1.0) } else { high.max(1.0) };
    let [low, high] = if curve.is_signed { [-reach, reach] } else { [low.min(0.0), reach] };
    let step = round_step((high - low) / 5.0);
    let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
    let y_of = |value: f64| top + PANEL[0] * (1.0 - (value - low) / (high - low));
    let mut svg = format!(
        "<text x=\"{}\" y=\"{:.1}\" fill=\"{}\">{}</text>",
        ENDS[0],
        top - 5.0,
        curve.color,
        named(curve.name)
    );
    let marks = ((high - low) / step).round() as usize;
    for mark in 0..=marks {
        let value = low + step * mark as f64;
        let y = y_of(value);
        let is_zero = value.abs() < step / 2.0;
        let gray = if is_zero { "#8a8a8a" } else { "#dedbd5" };
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<path d=\"M{} {y:.1}H{}\" stroke=\"{gray}\" stroke-width=\".8\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#444\" font-size=\"11\">{}</text>",
            ENDS[0],
            ENDS[1],
            ENDS[0] - 7.0,
            y + 3.8,
            decimals(value, usize::from(step < 1.0))
        );
    }
    let data = curve_path(samples, curve.value, x_of, &y_of);
    let _ = write!(
        svg,
        "<path d=\"{data}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\" stroke-linejoin=\"round\"/>",
        curve.color
    );
    svg
}

/// A name with a subscript after its underscore.
fn named(name: &str) -> String {
    let html = escaped(name);
    match html.split_once('_') {
        None => html,
        Some((before, after)) => {
            let (sub, rest) = after.split_at(1);
            format!("{before}<tspan dy=\"3\" font-size=\"9\">{sub}</tspan><tspan dy=\"-3\">{rest}</tspan>")
        }
    }
}

/// The data of a curve's path. The curve is interrupted where a sample has no value.
fn curve_path(
    samples: &[ProfileSample],
    value: fn(&ProfileSample) -> Option<f32>,
    x_of: &dyn Fn(f64) -> f64,
    y_of: &dyn Fn(f64) -> f64,
) -> String {
    let group = samples.len().div_ceil(MOST_POSITIONS).max(1);
    let mut data = String::new();
    let mut pen = 'M';
    for group in samples.chunks(group) {
        let x = x_of(f64::from(group[group.len() / 2].position_px));
        let values = || group.iter().filter_map(value).map(f64::from);
        let (low, high) = (values().reduce(f64::min), values().reduce(f64::max));
        let (Some(low), Some(high)) = (low, high) else {
            pen = 'M';
            continue;
        };
        let _ = write!(data, "{pen}{x:.1} {:.1}", y_of(high));
        if group.len() > 1 {
            let _ = write!(data, "V{:.1}", y_of(low));
        }
        pen = 'L';
    }
    data
}

/// The regions along the line, in their colors.
fn region_band(scene: &Scene, samples: &[ProfileSample], top: f64, x_of: &dyn Fn(f64) -> f64) -> String {
    let mut svg = String::new();
    for run in samples.chunk_by(|a, b| a.region == b.region) {
        let (Some(first), Some(last)) = (run.first(), run.last()) else { continue };
        let color = first.region.and_then(|region: RegionId| scene.shown.region_colors.get(region.index()));
        let Some([r, g, b]) = color else { continue };
        let (from, to) = (x_of(f64::from(first.position_px)), x_of(f64::from(last.position_px) + 1.0));
        let width = to.min(ENDS[1] + 1.0) - from;
        let _ = write!(
            svg,
            "<rect x=\"{from:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{BAND}\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>"
        );
    }
    svg
}

/// The axis of the positions.
fn positions(samples: &[ProfileSample], length: f64, top: f64, x_of: &dyn Fn(f64) -> f64) -> String {
    let mut svg =
        format!("<path d=\"M{} {top:.1}H{}\" stroke=\"#444\" stroke-width=\".8\"/>", ENDS[0], ENDS[1]);
    let step = round_step(length / 6.0).max(1.0);
    let marks = if samples.is_empty() { 0 } else { (length / step).floor() as usize + 1 };
    for mark in 0..marks {
        let x = x_of(step * mark as f64);
        let _ = write!(
            svg,
            "<path d=\"M{x:.1} {top:.1}v4\" stroke=\"#444\" stroke-width=\".8\"/><text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#444\" font-size=\"11\">{:.0}</text>",
            top + 15.0,
            step * mark as f64
        );
    }
    let _ = write!(
        svg,
        "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#444\">position along the line, pixels</text>",
        ENDS[1],
        top + 30.0
    );
    svg
}

/// The next number 1, 2 or 5 times a power of ten.
fn round_step(at_least: f64) -> f64 {
    let power = 10f64.powf(at_least.max(1e-9).log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step >= at_least * (1.0 - 1e-9))
        .unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_numbers() {
        for (wanted, step) in [(0.3, 0.5), (1.0, 1.0), (1.1, 2.0), (2.6, 5.0), (51.0, 100.0)] {
            assert!((round_step(wanted) - step).abs() < 1e-9, "{wanted}");
        }
    }

    #[test]
    fn subscripts_are_lowered() {
        assert_eq!(
            named("m_b, counts"),
            "m<tspan dy=\"3\" font-size=\"9\">b</tspan><tspan dy=\"-3\">, counts</tspan>"
        );
        assert_eq!(named("noise"), "noise");
    }
}
