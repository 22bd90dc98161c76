//! Icons of the playback controls.

use crate::app::Direction;
use crate::gui::icons::icon_button;
use crate::gui::theme::ThemeColors;
use egui::{Color32, Painter, Pos2, Rect, Response, Shape, Stroke, Ui, vec2};

pub use crate::gui::icons::SIDE_PT;

/// The icon on a playback button.
#[derive(Clone, Copy, PartialEq)]
pub enum PlaybackIcon {
    /// Go to the beginning or to the end.
    Limit(Direction),
    /// Step by a stage.
    Stage(Direction),
    /// Step by a hypothesis.
    Hypothesis(Direction),
    /// Step by an event.
    Event(Direction),
    /// Play forward or backward.
    Play(Direction),
    /// Stop playing at the cursor.
    Pause,
    /// Step into the next hypothesis.
    Into,
    /// Play again from the start when the end is reached.
    Loop,
    /// Decisions are recorded.
    Record,
}

/// A button that is on or off. `name` is its accessible name.
pub fn button(
    ui: &mut Ui,
    palette: &ThemeColors,
    icon: PlaybackIcon,
    on: bool,
    name: &str,
    tip: &str,
) -> Response {
    icon_button(ui, palette, on, name, tip, |painter, square, color| {
        draw(painter, square, icon, color, palette);
    })
}

/// Paints an icon. Coordinates are those of the forward icon in a square of 14 × 14; backward icons are mirrored.
fn draw(painter: &Painter, square: Rect, icon: PlaybackIcon, color: Color32, palette: &ThemeColors) {
    let back = matches!(
        icon,
        PlaybackIcon::Limit(Direction::Back)
            | PlaybackIcon::Stage(Direction::Back)
            | PlaybackIcon::Hypothesis(Direction::Back)
            | PlaybackIcon::Event(Direction::Back)
            | PlaybackIcon::Play(Direction::Back)
    );
    let at = |x: f32, y: f32| square.min + vec2(if back { 14.0 - x } else { x }, y) * (square.width() / 14.0);
    let stroke = Stroke::new(1.4, color);
    let triangle = |left: f32, right: f32, half: f32| {
        let points = vec![at(left, 7.0 - half), at(right, 7.0), at(left, 7.0 + half)];
        painter.add(Shape::convex_polygon(points, color, Stroke::NONE));
    };
    let bar = |x: f32, half: f32| {
        painter.line_segment([at(x, 7.0 - half), at(x, 7.0 + half)], stroke);
    };
    match icon {
        PlaybackIcon::Limit(_) => {
            triangle(1.0, 6.0, 4.0);
            triangle(6.0, 11.0, 4.0);
            bar(12.0, 4.5);
        }
        PlaybackIcon::Stage(_) => {
            triangle(3.0, 9.0, 4.0);
            bar(10.5, 4.5);
        }
        PlaybackIcon::Hypothesis(_) => {
            triangle(1.5, 7.0, 4.0);
            triangle(7.0, 12.5, 4.0);
        }
        PlaybackIcon::Event(_) => {
            painter.add(Shape::line(vec![at(5.0, 3.0), at(9.0, 7.0), at(5.0, 11.0)], stroke));
        }
        PlaybackIcon::Play(_) => triangle(3.0, 12.0, 5.5),
        PlaybackIcon::Pause => {
            for x in [4.5, 9.5] {
                painter.line_segment([at(x, 2.5), at(x, 11.5)], Stroke::new(2.6, color));
            }
        }
        PlaybackIcon::Into => {
            painter
                .add(Shape::line(vec![at(2.5, 8.0), at(2.5, 12.0), at(11.5, 12.0), at(11.5, 8.0)], stroke));
            painter.line_segment([at(7.0, 1.5), at(7.0, 8.5)], stroke);
            painter.add(Shape::line(vec![at(4.2, 6.0), at(7.0, 9.0), at(9.8, 6.0)], stroke));
        }
        PlaybackIcon::Loop => circular_arrow(painter, at, stroke),
        PlaybackIcon::Record => {
            painter.circle_stroke(at(7.0, 7.0), 5.2, stroke);
            painter.circle_filled(at(7.0, 7.0), 2.8, palette.accent);
        }
    }
}

/// Paints a circular arrow.
fn circular_arrow(painter: &Painter, at: impl Fn(f32, f32) -> Pos2, stroke: Stroke) {
    let on_circle = |i: usize| {
        let angle = (i as f32 / 20.0 * 0.8 - 0.2) * std::f32::consts::TAU;
        at(7.0 + 5.0 * angle.cos(), 7.0 + 5.0 * angle.sin())
    };
    painter.add(Shape::line((0..=20).map(on_circle).collect(), stroke));
    painter.add(Shape::line(vec![at(5.4, 1.0), at(8.8, 2.3), at(7.6, 5.4)], stroke));
}
