//! The sign of work under way. It turns in few steps: each step draws the whole window, which a software driver does on the processor
//! that the work needs, and a key would wait for the drawing.

use egui::{Color32, Sense, Shape, Stroke, Ui, vec2};
use std::f32::consts::TAU;
use std::time::Duration;

/// Time between two steps.
const STEP: Duration = Duration::from_millis(250);

/// Number of steps of a turn.
const STEPS: u32 = 8;

/// Diameter of the sign, points.
const DIAMETER_PT: f32 = 10.0;

/// Number of points of the arc.
const POINTS: u32 = 16;

/// Shows the sign of work that began `elapsed` ago.
pub fn show(ui: &mut Ui, color: Color32, elapsed: Duration) {
    let (rect, _) = ui.allocate_exact_size(vec2(DIAMETER_PT + 2.0, DIAMETER_PT + 2.0), Sense::hover());
    let step = (elapsed.as_millis() / STEP.as_millis()) as u32 % STEPS;
    let begin = step as f32 / STEPS as f32;
    let point = |index: u32| {
        let angle = TAU * (begin + 0.7 * index as f32 / POINTS as f32);
        rect.center() + 0.5 * DIAMETER_PT * vec2(angle.cos(), angle.sin())
    };
    ui.painter().add(Shape::line((0..=POINTS).map(point).collect(), Stroke::new(2.0, color)));
    ui.ctx().request_repaint_after(STEP);
}
