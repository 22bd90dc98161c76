//! The view of a compared photograph that has another size than the photograph shown: the same part of the picture by fractions of its
//! sides. Panning and zooming go on in both views as one; tools work in the first view only, because marks have pixels of the first
//! photograph.

use super::geometry::Placement;
use super::navigation::navigate;
use super::overlay;
use crate::gui::PanelContext;
use crate::raster::PixelIndex;
use crate::view::{ImageSettings, Item};
use egui::{Color32, PointerButton, Response, Stroke, Ui, Vec2, pos2};

/// Radius of the ring at the place of the hovered pixel, points.
const RING_PT: f32 = 5.0;

/// Columns and rows of the compared photograph, where they are not those of the photograph shown.
pub fn other_size(cx: &PanelContext) -> Option<Vec2> {
    let size_of = |(width, height): (usize, usize)| Vec2::new(width as f32, height as f32);
    let shown = cx.state.picture.as_ref()?.size();
    let other = cx.state.compared_photograph()?.picture.size();
    (other != shown).then(|| size_of(other))
}

/// Pans and zooms by the pointer and the keys over the view; `size`: columns and rows of the photograph shown, in whose pixels the
/// settings are.
pub fn pan_and_zoom(
    ui: &Ui,
    response: &Response,
    place: &Placement,
    size: Vec2,
    settings: &mut ImageSettings,
) {
    if response.double_clicked() {
        (settings.zoom, settings.center_px) = (None, None);
        return;
    }
    if response.dragged_by(PointerButton::Primary) || response.dragged_by(PointerButton::Middle) {
        place.panned(response.drag_delta()).of_size(size).store(settings);
        return;
    }
    let mut own = settings.clone();
    place.store(&mut own);
    let before = (own.zoom, own.center_px);
    navigate(ui, response, place, &mut own);
    if (own.zoom, own.center_px) != before {
        Placement::new(place.view, place.size, &own).of_size(size).store(settings);
    }
}

/// The pixel of the photograph shown, of columns and rows `size`, at the fraction of the sides where the pointer is.
pub fn pixel_under_pointer(ui: &Ui, place: &Placement, size: Vec2) -> Option<PixelIndex> {
    let pointer = ui.ctx().pointer_hover_pos().filter(|_| ui.rect_contains_pointer(place.view))?;
    place.pixel_at(pointer)?;
    let at = (place.image_from_screen(pointer).to_vec2() / place.size * size).min(size - Vec2::splat(1.0));
    Some(PixelIndex::new(at.y as u32 * size.x as u32 + at.x as u32))
}

/// Paints the grid, and a ring at the place of the hovered pixel of the photograph shown.
pub fn paint_marks(painter: &egui::Painter, cx: &PanelContext, place: &Placement, size: Vec2) {
    overlay::grid(painter, place);
    let Some(Item::Pixel(pixel)) = cx.state.hover else { return };
    let [x, y] = pixel.position(size.x as usize);
    let middle = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / size * place.size;
    let at = place.screen_from_image(pos2(middle.x, middle.y));
    painter.circle_stroke(at, RING_PT, Stroke::new(3.0, Color32::from_black_alpha(140)));
    painter.circle_stroke(at, RING_PT, Stroke::new(1.4, Color32::WHITE));
}
