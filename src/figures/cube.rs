//! The histogram of the colors seen from a side, with the cylinders of the hypotheses (color figure 2).
//!
//! Points are drawn into a picture, axes and hypotheses over it as lines. The cube is seen in parallel projection, blue upward.

use super::picture::transparent_uri;
use super::scene::Scene;
use crate::color::srgb_from_linear;
use crate::raster::RegionId;
use crate::view::{
    ColorSpace, Histogram, Point, RegionShapes, illuminant_line, region_shapes, second_lamp_line,
};
use std::fmt::Write;

/// Most regions whose hypotheses are drawn, the largest first.
pub const MOST_HYPOTHESES: usize = 24;

/// Columns and rows of the plot, units of the drawing.
const SIZE: [f64; 2] = [400.0, 400.0];
/// Points of the picture per unit of the drawing.
const DENSITY: f64 = 2.0;
/// Length of the cube's edge, units of the drawing.
const EDGE: f64 = 240.0;
/// Where the middle of the cube is.
const MIDDLE: [f64; 2] = [200.0, 200.0];

/// Share of full scale below which the brightest color makes the cube smaller.
const FAR_DARKER: f32 = 0.6;

/// A direction from which the cube is seen.
#[derive(Clone, Copy)]
pub struct Side {
    /// Angle around the blue axis, from red to green, degrees.
    pub azimuth_deg: f64,
    /// Angle above the plane of red and green, degrees.
    pub elevation_deg: f64,
}

/// The two sides of the figure, a quarter turn apart. Black is far from the viewer in both.
pub const SIDES: [Side; 2] =
    [Side { azimuth_deg: -18.0, elevation_deg: 20.0 }, Side { azimuth_deg: 72.0, elevation_deg: 20.0 }];

/// The parallel projection of colors.
struct Projection {
    right: [f64; 3],
    up: [f64; 3],
    toward: [f64; 3],
    /// Counts along an edge of the cube.
    full: f64,
}

impl Projection {
    fn new(side: Side, full: f64) -> Self {
        let (sin, cos) = side.azimuth_deg.to_radians().sin_cos();
        let (rise, run) = side.elevation_deg.to_radians().sin_cos();
        Self {
            right: [-sin, cos, 0.0],
            up: [-rise * cos, -rise * sin, run],
            toward: [run * cos, run * sin, rise],
            full,
        }
    }

    /// Place of a color in the drawing, and its nearness to the viewer.
    fn place(&self, color: Point) -> ([f64; 2], f64) {
        let p = color.map(|v| f64::from(v) / self.full - 0.5);
        let along = |axis: [f64; 3]| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
        ([MIDDLE[0] + EDGE * along(self.right), MIDDLE[1] - EDGE * along(self.up)], along(self.toward))
    }

    fn at(&self, color: Point) -> [f64; 2] {
        self.place(color).0
    }
}

/// The histogram of a scene from a side, as an `svg` element.
pub fn svg(scene: &Scene, side: Side) -> String {
    let histogram = &scene.shown.picture.histogram;
    let edge = edge_counts(histogram);
    let projection = Projection::new(side, f64::from(edge));
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"Color histogram from azimuth {:.0} degrees\">\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#17181c\"/>",
        side.azimuth_deg
    );
    svg.push_str(&frame(&projection, edge));
    let shapes: Vec<(RegionShapes, String)> = RegionId::all(scene.report.regions.len())
        .take(if scene.lacks_stage().is_some() { 0 } else { MOST_HYPOTHESES })
        .filter_map(|region| {
            let [r, g, b] = scene.shown.region_colors.get(region.index())?;
            Some((region_shapes(&scene.shown, region)?, format!("#{r:02x}{g:02x}{b:02x}")))
        })
        .collect();
    for (shape, color) in &shapes {
        svg.push_str(&cylinder(&projection, shape, color));
    }
    let size_px = SIZE.map(|length| (length * DENSITY) as usize);
    let uri = transparent_uri(size_px.map(|length| length as u32), &points(scene, &projection, size_px));
    // Writing to a string cannot fail.
    let _ = write!(svg, "<image width=\"{width}\" height=\"{height}\" href=\"{uri}\"/>");
    for (shape, color) in &shapes {
        svg.push_str(&lines(&projection, shape, color));
    }
    for [from, to] in illuminant_line(&scene.shown).into_iter().chain(second_lamp_line(&scene.shown)) {
        let (a, b) = (projection.at(from), projection.at(to));
        let _ = write!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#fff\" stroke-width=\"1\" stroke-dasharray=\"5 4\"/>",
            a[0], a[1], b[0], b[1]
        );
    }
    svg.push_str(&labels(&projection, edge));
    svg.push_str("</svg>");
    svg
}

/// Counts along the edge of the cube that is drawn: full scale, or less where all colors are far darker, as in a file with room
/// above white.
fn edge_counts(histogram: &Histogram) -> f32 {
    let brightest = histogram.bins.iter().flat_map(|bin| bin.mean).fold(0.0f32, f32::max);
    if brightest < FAR_DARKER * histogram.full_counts {
        (1.1 * brightest).max(1.0)
    } else {
        histogram.full_counts
    }
}

/// Names and colors of the axes.
const AXES: [(&str, &str); 3] = [("R", "#ff8078"), ("G", "#7edb86"), ("B", "#8fb4ff")];

/// The edges of the cube, those from black in the colors of their axes.
fn frame(projection: &Projection, full: f32) -> String {
    let edges: String = ColorSpace::Rgb
        .frame(1.0)
        .iter()
        .map(|edge| path(&edge_points(projection, edge, full), false))
        .collect();
    let mut svg = format!("<path d=\"{edges}\" fill=\"none\" stroke=\"#5b5e66\" stroke-width=\".7\"/>");
    for (band, (_, color)) in AXES.iter().enumerate() {
        let mut end = [0.0; 3];
        end[band] = full;
        let axis = path(&[projection.at([0.0; 3]), projection.at(end)], false);
        let _ =
            write!(svg, "<path d=\"{axis}\" stroke=\"{color}\" stroke-width=\"1\" stroke-opacity=\".75\"/>");
    }
    svg
}

fn edge_points(projection: &Projection, edge: &[Point], full: f32) -> Vec<[f64; 2]> {
    edge.iter().map(|p| projection.at(p.map(|v| v * full))).collect()
}

/// The names of the axes at their ends, and the counts of full scale.
fn labels(projection: &Projection, full: f32) -> String {
    let beyond = 1.09 * full;
    let name = |(band, (name, color)): (usize, &(&str, &str))| {
        let mut end = [0.0; 3];
        end[band] = beyond;
        let [x, y] = projection.at(end);
        format!(
            "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"14\" fill=\"{color}\" stroke=\"#17181c\" stroke-width=\"3\" paint-order=\"stroke\">{name}</text>",
            y + 4.5
        )
    };
    let note = format!(
        "<text x=\"12\" y=\"{:.0}\" font-size=\"11\" fill=\"#a9acb4\">edge: {full:.0} counts</text>",
        SIZE[1] - 12.0
    );
    AXES.iter().enumerate().map(name).collect::<String>() + &note
}

/// The cylinder of a hypothesis: its outline is convex.
fn cylinder(projection: &Projection, shape: &RegionShapes, color: &str) -> String {
    let Some(cylinder) = &shape.cylinder else { return String::new() };
    let corners: Vec<[f64; 2]> = cylinder.surface.points.iter().map(|&p| projection.at(p)).collect();
    let outline = path(&hull(corners), true);
    format!(
        "<path d=\"{outline}\" fill=\"{color}\" fill-opacity=\".2\" stroke=\"{color}\" stroke-width=\"1.1\" stroke-opacity=\".9\"/>"
    )
}

/// The matte line and the highlight lines of a region.
fn lines(projection: &Projection, shape: &RegionShapes, color: &str) -> String {
    let line = |line: &[Point; 2]| path(&line.map(|p| projection.at(p)), false);
    let highlights: String = shape.highlight_lines.iter().map(line).collect();
    let matte = line(&shape.matte_line);
    format!(
        "<path d=\"{matte}\" stroke=\"{color}\" stroke-width=\"1.2\" fill=\"none\"/>\
         <path d=\"{highlights}\" stroke=\"#fff\" stroke-width=\"1.6\" fill=\"none\"/>"
    )
}

/// A polyline as the data of a path.
fn path(points: &[[f64; 2]], closed: bool) -> String {
    let mut data = String::new();
    for (i, [x, y]) in points.iter().enumerate() {
        let _ = write!(data, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
    }
    if closed && !points.is_empty() {
        data.push('Z');
    }
    data
}

/// The convex hull of points, in order (Andrew 1979).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = kept[..]
                && (b[0] - a[0]) * (p[1] - a[1]) <= (b[1] - a[1]) * (p[0] - a[0])
            {
                kept.pop();
            }
            kept.push(p);
        }
        kept.pop();
        kept
    };
    let mut outline = chain(&mut points.iter().copied());
    outline.extend(chain(&mut points.iter().rev().copied()));
    outline
}

/// The bins of the histogram as squares in their own color, the nearest on top: RGBA, `size_px` columns and rows.
fn points(scene: &Scene, projection: &Projection, size_px: [usize; 2]) -> Vec<u8> {
    let histogram = &scene.shown.picture.histogram;
    let gain = scene.look.exposure_ev.exp2() / 255.0;
    let mut bins: Vec<(f64, usize)> =
        histogram.bins.iter().map(|bin| projection.place(bin.mean).1).zip(0..).collect();
    bins.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut rgba = vec![0u8; 4 * size_px[0] * size_px[1]];
    for (_, index) in bins {
        let bin = &histogram.bins[index];
        let [x, y] = projection.at(bin.mean).map(|v| v * DENSITY);
        // From 3 to 7 points for 1 to 10 000 pixels.
        let reach = (f64::from(bin.count).log10() / 2.0 + 1.5).min(3.5);
        let color = bin.mean.map(|v| (255.0 * srgb_from_linear((v * gain).clamp(0.0, 1.0))).round() as u8);
        // Black points would not be seen on the dark ground.
        let color = color.map(|code| code.max(58));
        let inside = |v: f64, length: usize| (v.max(0.0) as usize).min(length);
        for row in inside(y - reach, size_px[1])..inside(y + reach + 1.0, size_px[1]) {
            for column in inside(x - reach, size_px[0])..inside(x + reach + 1.0, size_px[0]) {
                let at = 4 * (row * size_px[0] + column);
                rgba[at..at + 4].copy_from_slice(&[color[0], color[1], color[2], 255]);
            }
        }
    }
    rgba
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_square_and_points_inside_are_its_corners() {
        let points = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0], [0.0, 0.0]];
        assert_eq!(hull(points), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert_eq!(hull(vec![[3.0, 4.0]]), Vec::<[f64; 2]>::new());
    }

    /// The cube never leaves the drawing, and blue is upward.
    #[test]
    fn all_corners_of_the_cube_are_inside_the_drawing() {
        for side in SIDES {
            let projection = Projection::new(side, 255.0);
            for corner in 0..8u8 {
                let color = [0, 1, 2].map(|band| if corner >> band & 1 == 0 { -23.0 } else { 278.0 });
                let [x, y] = projection.at(color);
                assert!((0.0..=SIZE[0]).contains(&x) && (0.0..=SIZE[1]).contains(&y), "{x} {y}");
            }
            assert!(projection.at([0.0, 0.0, 255.0])[1] < projection.at([0.0; 3])[1]);
        }
    }
}
