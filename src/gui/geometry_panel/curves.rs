//! Figure 6: where the highlight line starts on the matte line, over the phase angle, for spheres at several distances; with the sphere of
//! the settings and the selected region.

use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::reflection::photometry::{SphereGeometry, q_infinity};
use crate::view::GeometrySettings;
use egui::accesskit::Role;
use egui::{Align2, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2};

/// Distances d/r of the quiet curves; the curve of an infinite distance is equation (11).
const DISTANCES: [f64; 3] = [1.5, 2.0, 5.0];
/// Number of points of a curve.
const POINTS: u16 = 120;
/// Least share of the matte line that the chart shows.
const LEAST_Q: f64 = 0.4;

/// Points of the curve of a sphere: phase angle, degrees, and q.
fn curve(distance: f64) -> Vec<[f64; 2]> {
    let most = SphereGeometry::new(1.0, distance, 0.0).map_or(0.0, SphereGeometry::max_phase_deg);
    let phases = (0..=POINTS).map(|index| most * f64::from(index) / f64::from(POINTS));
    let q = |phase: f64| Some([phase, SphereGeometry::new(1.0, distance, phase)?.q()?]);
    phases.filter_map(q).collect()
}

/// Where a phase angle, degrees, and a q lie in the area of the curves, screen points.
fn place(area: Rect, [phase, q]: [f64; 2]) -> Pos2 {
    let up = (q - LEAST_Q) / (1.0 - LEAST_Q);
    pos2(area.left() + area.width() * (phase / 180.0) as f32, area.bottom() - area.height() * up as f32)
}

/// Paints the lines of round values in the area of the curves, with their numbers beside it.
fn paint_grid(painter: &Painter, palette: &ThemeColors, area: Rect) {
    let (font, quiet) = (FontId::proportional(SMALL_PT), Stroke::new(1.0, palette.line));
    for phase in [0.0, 45.0, 90.0, 135.0, 180.0] {
        let x = place(area, [phase, 1.0]).x;
        painter.vline(x, area.y_range(), quiet);
        let (below, text) = (pos2(x, area.bottom() + 3.0), format!("{phase:.0}\u{b0}"));
        painter.text(below, Align2::CENTER_TOP, text, font.clone(), palette.secondary);
    }
    for q in [0.4, 0.5, 0.6, 0.8, 1.0] {
        let y = place(area, [0.0, q]).y;
        painter.hline(area.x_range(), y, quiet);
        let (beside, text) = (pos2(area.left() - 4.0, y), format!("{q:.1}"));
        painter.text(beside, Align2::RIGHT_CENTER, text, font.clone(), palette.secondary);
    }
}

/// Shows the chart in `size`. `share`: the place of the selected region's highlight on its matte line.
pub fn show(ui: &mut Ui, palette: &ThemeColors, size: Vec2, settings: GeometrySettings, share: Option<f64>) {
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let q = settings.sphere().and_then(SphereGeometry::q);
    let now = q.map_or_else(String::new, |q| {
        format!(": the highlight line starts at {:.1} % of the matte line", 100.0 * q)
    });
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("Figure 6{now}")));
    response.on_hover_text(
        "Figure 6: the start of the highlight line as a share of the matte line, over the phase angle. The paper's heuristic takes the upper half (section 5.4.1).",
    );
    let area = Rect::from_min_max(rect.min + vec2(30.0, 16.0), rect.max - vec2(14.0, 18.0));
    if area.width() < 10.0 || area.height() < 10.0 {
        return;
    }
    let painter = ui.painter_at(rect);
    let font = FontId::proportional(SMALL_PT);
    paint_grid(&painter, palette, area);
    let line = |points: &[[f64; 2]], stroke: Stroke| {
        Shape::line(points.iter().map(|&point| place(area, point)).collect(), stroke)
    };
    for distance in DISTANCES {
        painter.add(line(&curve(distance), Stroke::new(1.0, palette.secondary.gamma_multiply(0.7))));
    }
    let infinite: Vec<[f64; 2]> =
        (0..=180u16).filter_map(|phase| Some([f64::from(phase), q_infinity(f64::from(phase))?])).collect();
    painter.add(line(&infinite, Stroke::new(1.0, palette.secondary)));
    painter.add(line(&curve(settings.distance), Stroke::new(2.0, palette.accent)));
    let corner = area.left_top() - vec2(0.0, 3.0);
    painter.text(
        corner,
        Align2::LEFT_BOTTOM,
        "q over g, gray: d/r 1.5, 2, 5, \u{221e}",
        font.clone(),
        palette.text,
    );
    if let Some(share) = share.filter(|share| (LEAST_Q..=1.0).contains(share)) {
        let y = place(area, [0.0, share]).y;
        painter.extend(Shape::dashed_line(
            &[pos2(area.left(), y), pos2(area.right(), y)],
            Stroke::new(1.5, palette.text),
            5.0,
            4.0,
        ));
        painter.text(pos2(area.right(), y - 1.0), Align2::RIGHT_BOTTOM, "the region", font, palette.text);
    }
    if let Some(q) = q {
        painter.circle(
            place(area, [settings.phase_deg, q]),
            4.5,
            palette.accent,
            Stroke::new(1.5, palette.text),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_of_five_radii_has_the_minimum_of_the_paper_and_ends_at_a_half() {
        let points = curve(5.0);
        let least = points.iter().map(|point| point[1]).fold(1.0, f64::min);
        assert!((least - 0.4973).abs() < 1e-4, "{least}");
        assert!((points[points.len() - 1][1] - 0.5).abs() < 1e-2);
        assert!((points[0][1] - 1.0).abs() < 1e-12);
    }
}
