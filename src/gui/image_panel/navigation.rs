//! Zooming and panning of the image view.

use super::geometry::Placement;
use crate::gui::action::ViewStep;
use crate::view::ImageSettings;
use egui::{EventFilter, Pos2, Response, Ui, vec2};

/// Distance that a step moves the picture, points.
const PAN_STEP_PT: f32 = 40.0;

/// Factor of a step of the zoom.
const ZOOM_STEP: f32 = 1.25;

/// Zooms by scrolling and pinching. A click gives the view the focus, in which the arrow keys stay: they step the debugger and do not
/// move the focus on.
pub fn navigate(ui: &Ui, response: &Response, place: &Placement, settings: &mut ImageSettings) {
    let pointer = response.hover_pos().filter(|_| response.contains_pointer());
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
    let factor = pinch * (scroll / 200.0).exp();
    if let Some(pointer) = pointer.filter(|_| (factor - 1.0).abs() > 1e-6) {
        place.zoomed(factor, pointer).store(settings);
    }
    if response.has_focus() {
        let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    }
}

/// The placement after a step. The zoom keeps the point under the pointer, or without a pointer in the view, the point in its middle.
pub fn stepped(place: Placement, step: ViewStep, pointer: Option<Pos2>) -> Placement {
    let anchor = pointer.filter(|&pointer| place.view.contains(pointer)).unwrap_or(place.view.center());
    match step {
        ViewStep::ZoomIn => place.zoomed(ZOOM_STEP, anchor),
        ViewStep::ZoomOut => place.zoomed(1.0 / ZOOM_STEP, anchor),
        ViewStep::Left => place.panned(vec2(PAN_STEP_PT, 0.0)),
        ViewStep::Right => place.panned(vec2(-PAN_STEP_PT, 0.0)),
        ViewStep::Up => place.panned(vec2(0.0, PAN_STEP_PT)),
        ViewStep::Down => place.panned(vec2(0.0, -PAN_STEP_PT)),
    }
}
