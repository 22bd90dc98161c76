//! The reducer of the commands that change how things are shown.

use super::photographs::compare;
use crate::app::{State, ViewCommand};
use crate::view::Item;
use std::sync::Arc;

/// Changes how things are shown.
pub(super) fn reduce(state: &mut State, command: ViewCommand) {
    match command {
        ViewCommand::Hover(item) => {
            state.hover = item;
            if !matches!(item, Some(Item::Bin(_))) {
                state.hover_pixels = Arc::default();
            }
        }
        ViewCommand::HoverBins(bins) => {
            let pixels = state.picture.as_ref().map(|picture| picture.histogram.pixels_of_all(&bins));
            state.hover_pixels = pixels.unwrap_or_default().into();
        }
        ViewCommand::Pin(keep) => {
            state.pinned = if keep { state.newest.clone() } else { None };
            state.view.show_pinned = false;
        }
        ViewCommand::ShowPinned(pinned) => state.view.show_pinned = pinned && state.pinned.is_some(),
        ViewCommand::Image(settings) => state.view.image = settings,
        ViewCommand::Cube(settings) => state.view.cube = settings,
        ViewCommand::Plane(settings) => state.view.plane = settings,
        ViewCommand::Geometry(settings) => state.view.geometry = settings.in_range(),
        ViewCommand::Profile(line) => state.view.profile = line,
        ViewCommand::Theme(theme) => state.view.theme = theme,
        ViewCommand::TextSize(size) => state.view.text_size = Some(size),
        ViewCommand::Layout(layout) => state.view.layout = layout,
        ViewCommand::Camera(camera) => state.view.camera = camera,
        ViewCommand::Notify(severity, text) => state.notify(severity, text),
        ViewCommand::Dismiss(id) => state.notices.retain(|notice| notice.id != id),
        ViewCommand::ComparePhotographs(compares) => {
            compare(state, compares);
        }
        ViewCommand::CloseElsewhere(kind) => {
            let rest = state.elsewhere.take().and_then(|elsewhere| elsewhere.without(kind));
            state.elsewhere = rest.map(Arc::new);
            state.leave_missing_layers();
        }
        ViewCommand::ForgetRecent => state.recent.clear(),
    }
}
