//! The drawing of sphere, light and camera in their plane, and what the camera sees. A drag anywhere moves light and camera: they stay
//! symmetric about the vertical, on which the highlight lies.

use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets;
use crate::reflection::SpherePoint;
use crate::reflection::photometry::SphereGeometry;
use crate::view::{GeometrySettings, RegionPlane, SPHERE_DISTANCES};
use egui::accesskit::Role;
use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

/// Radius of the handles of light and camera, points.
const HANDLE_PT: f32 = 6.0;
/// Margin around the drawing, points.
const MARGIN_PT: f32 = 12.0;
/// Number of points of an arc.
const ARC_POINTS: u16 = 48;

/// The places of the drawing.
#[derive(Clone, Copy)]
struct Frame {
    center: Pos2,
    /// Radius of the sphere, points.
    radius: f32,
    /// Largest distance of the handles from the center, points.
    reach: f32,
}

impl Frame {
    fn of(rect: Rect) -> Self {
        let reach = (0.5 * rect.width().min(1.5 * rect.height()) - MARGIN_PT).max(8.0);
        let center = pos2(rect.center().x, rect.top() + 0.66 * rect.height());
        Self { center, radius: 0.3 * reach, reach: reach.min(0.66 * rect.height() - MARGIN_PT).max(6.0) }
    }

    /// The direction of an angle from the vertical, to the right.
    fn direction(angle_deg: f64) -> Vec2 {
        let (sine, cosine) = angle_deg.to_radians().sin_cos();
        vec2(sine as f32, -cosine as f32)
    }

    /// The distance on the screen of a distance d/r: logarithmic, so that 1.1 to 100 radii fit.
    fn length_of(self, distance: f64) -> f32 {
        let [low, high] = SPHERE_DISTANCES.map(f64::ln);
        let share = ((distance.ln() - low) / (high - low)).clamp(0.0, 1.0) as f32;
        let least = (self.radius + HANDLE_PT).min(self.reach);
        egui::lerp(least..=self.reach, share)
    }

    /// d/r of a distance on the screen.
    fn distance_of(self, length: f32) -> f64 {
        let [low, high] = SPHERE_DISTANCES.map(f64::ln);
        let least = (self.radius + HANDLE_PT).min(self.reach);
        let share = f64::from(((length - least) / (self.reach - least).max(1e-3)).clamp(0.0, 1.0));
        (low + share * (high - low)).exp()
    }

    /// A run of points on the sphere's outline between two angles from the vertical, degrees.
    fn arc(self, from_deg: f64, to_deg: f64, radius: f32) -> Vec<Pos2> {
        let angle = |index: u16| from_deg + (to_deg - from_deg) * f64::from(index) / f64::from(ARC_POINTS);
        (0..=ARC_POINTS).map(|index| self.center + Self::direction(angle(index)) * radius).collect()
    }
}

/// Shows the drawing in `size`; a drag sets distance and phase angle.
pub fn show(
    ui: &mut Ui,
    palette: &ThemeColors,
    size: Vec2,
    settings: &mut GeometrySettings,
    points: &[SpherePoint],
    plane: Option<&RegionPlane>,
) {
    let (rect, response) = ui.allocate_exact_size(size, Sense::DRAG);
    let frame = Frame::of(rect);
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        let from_center = pointer - frame.center;
        let angle_deg = f64::from(from_center.x.abs().atan2(-from_center.y)).to_degrees();
        (settings.distance, settings.phase_deg) = (frame.distance_of(from_center.length()), 2.0 * angle_deg);
        *settings = settings.in_range();
    }
    let text = format!(
        "Sphere, light and camera: distance {:.1} radii, phase angle {:.0} degrees",
        settings.distance, settings.phase_deg
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, text.clone()));
    if let Some(sphere) = settings.sphere() {
        paint(&ui.painter_at(rect), palette, rect, frame, *settings, sphere);
    }
    paint_picture(&ui.painter_at(rect), palette, rect, points, plane);
    response.on_hover_cursor(egui::CursorIcon::Grab).on_hover_text(
        "Drag light or camera: the angle between them is g, their distance d. Thick: lit and visible. Not to scale (figure 3).",
    );
}

/// Paints sphere, light, camera, and the points of the highlight and of the brightest visible matte color.
fn paint(
    painter: &Painter,
    palette: &ThemeColors,
    rect: Rect,
    frame: Frame,
    settings: GeometrySettings,
    sphere: SphereGeometry,
) {
    let half = sphere.phase_deg() / 2.0;
    let horizon = sphere.max_phase_deg() / 2.0;
    let length = frame.length_of(settings.distance);
    let [light, camera] = [half, -half].map(|angle| frame.center + Frame::direction(angle) * length);
    let quiet = Stroke::new(1.0, palette.secondary);
    painter.circle_stroke(frame.center, frame.radius, quiet);
    let lit = frame.arc(half - horizon, half + horizon, frame.radius - 3.0);
    painter.add(Shape::line(lit, Stroke::new(2.0, palette.accent)));
    let seen = frame.arc(-half - horizon, -half + horizon, frame.radius + 3.0);
    painter.add(Shape::line(seen, Stroke::new(2.0, palette.text)));
    let both = frame.arc(half - horizon, horizon - half, frame.radius);
    painter.add(Shape::line(both, Stroke::new(4.0, palette.text)));
    for end in [light, camera] {
        painter.extend(Shape::dashed_line(&[frame.center, end], quiet, 3.0, 3.0));
    }
    let angle = frame.arc(-half, half, (0.5 * frame.radius).min(22.0));
    painter.add(Shape::line(angle, quiet));
    painter.circle(light, HANDLE_PT, palette.accent, Stroke::new(1.5, palette.text));
    let square = Rect::from_center_size(camera, Vec2::splat(2.0 * HANDLE_PT));
    painter.rect(square, 2.0, palette.panel, Stroke::new(1.5, palette.text), egui::StrokeKind::Inside);
    let font = FontId::proportional(SMALL_PT);
    let name = |at: Pos2, text: &str, color: Color32| {
        let galley = painter.layout_no_wrap(text.to_owned(), font.clone(), color);
        let corner = Align2::CENTER_BOTTOM.anchor_size(at - vec2(0.0, HANDLE_PT + 2.0), galley.size()).min;
        let room = (rect.size() - galley.size()).max(Vec2::ZERO);
        painter.galley(corner.clamp(rect.min, rect.min + room), galley, color);
    };
    // With light and camera in one place, one name says so.
    if (light - camera).length() < 44.0 {
        name(light + (camera - light) / 2.0, "light and camera", palette.text);
    } else {
        name(light, "light", palette.text);
        name(camera, "camera", palette.text);
    }
    let brightest_deg = half - sphere.brightest_normal_deg();
    for (angle_deg, color) in [(brightest_deg, palette.accent), (0.0, palette.text)] {
        let at = frame.center + Frame::direction(angle_deg) * frame.radius;
        painter.circle(at, 4.0, color, Stroke::new(1.0, palette.panel));
    }
    let text = format!("g {:.0}\u{b0}", sphere.phase_deg());
    painter.text(frame.center + vec2(0.0, 4.0), Align2::CENTER_TOP, text, font, palette.secondary);
}

/// Paints the sphere as the camera sees it, in the lower left corner, in the colors of the plane's region or in grays.
fn paint_picture(
    painter: &Painter,
    palette: &ThemeColors,
    rect: Rect,
    points: &[SpherePoint],
    plane: Option<&RegionPlane>,
) {
    let radius = (0.17 * rect.height()).min(0.14 * rect.width());
    let center = rect.left_bottom() + vec2(radius + 4.0, -radius - 16.0);
    painter.circle_filled(center, radius, Color32::BLACK);
    let side = 2.0 * radius / 64.0 * 1.15;
    let (body, surface) = plane.map_or(([0.6; 3], [0.577; 3]), |plane| (plane.body, plane.surface));
    let mut mesh = egui::Mesh::default();
    for point in points {
        let counts = std::array::from_fn(|band| {
            200.0 * (point.body * body[band] + 1.4 * point.surface * surface[band])
        });
        let at = center + vec2(point.at[0], -point.at[1]) * radius;
        mesh.add_colored_rect(
            Rect::from_center_size(at, Vec2::splat(side)),
            widgets::own_color(counts, None),
        );
    }
    painter.add(Shape::mesh(mesh));
    let below = pos2(center.x, center.y + radius + 2.0);
    painter.text(below, Align2::CENTER_TOP, "seen", FontId::proportional(SMALL_PT), palette.secondary);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_distance_on_the_screen_is_the_distance_that_was_drawn() {
        for size in [vec2(300.0, 190.0), vec2(120.0, 120.0)] {
            let frame = Frame::of(Rect::from_min_size(pos2(10.0, 20.0), size));
            for distance in [1.1, 2.0, 5.0, 40.0, 100.0] {
                let found = frame.distance_of(frame.length_of(distance));
                assert!((found / distance - 1.0).abs() < 1e-3, "{size} {distance} {found}");
            }
        }
    }
}
