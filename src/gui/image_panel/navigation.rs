//! Zooming and panning of the image view.

use super::geometry::Placement;
use crate::view::ImageSettings;
use egui::{Event, EventFilter, Key, Response, Ui, Vec2, vec2};

/// Distance that an arrow key moves the picture, points.
const PAN_STEP_PT: f32 = 40.0;

/// Zooms and pans by scrolling, pinching and keys.
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
    let focused = ui.memory(egui::Memory::focused);
    let takes_keys = response.has_focus() || (pointer.is_some() && focused.is_none());
    if !takes_keys {
        return;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let (offset, factor) = ui.input(|input| {
        // The modifiers of each press count and not those at the end of the frame: Ctrl++ enlarges the interface, and in a slow frame
        // Ctrl is up again.
        let presses = |wanted: Key| {
            let is_wanted = |event: &&Event| {
                matches!(event, Event::Key { key, pressed: true, modifiers, .. } if *key == wanted && !modifiers.command)
            };
            input.events.iter().filter(is_wanted).count() as f32
        };
        let offset = vec2(
            presses(Key::ArrowLeft) - presses(Key::ArrowRight),
            presses(Key::ArrowUp) - presses(Key::ArrowDown),
        );
        let zoom_steps = presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus);
        (offset * PAN_STEP_PT, 1.25f32.powf(zoom_steps))
    });
    if offset != Vec2::ZERO {
        place.panned(offset).store(settings);
    } else if (factor - 1.0).abs() > 1e-6 {
        place.zoomed(factor, pointer.unwrap_or(place.view.center())).store(settings);
    }
}
