//! What is painted in a view: layers or the instant at the debugger's cursor, what lies over them, and texts.

use super::paint_request::PaintRequest;
use super::texts::show_texts;
use super::textures::{LARGE_PX, Slot};
use super::tools::PointerContext;
use super::{ImagePanel, cursor, other_size, overlay};
use crate::app::State;
use crate::gui::PanelContext;
use crate::gui::work_shown::PROGRESS_DELAY;
use crate::view::{Arrangement, ImageSettings, Instant, Layer, Tool};
use egui::{Color32, Painter, Rangef, Rect, StrokeKind, Ui, pos2, vec2};
use std::sync::Arc;

impl ImagePanel {
    /// Paints one view: layers or instant, grid, outlines, profile, marks, and texts. `wipe_x` is the horizontal position of
    /// the line between two layers, screen points.
    pub(super) fn paint_view(
        &mut self,
        ui: &Ui,
        cx: &PanelContext,
        context: &PointerContext,
        settings: &ImageSettings,
        slot: Slot,
        wipe_x: Option<f32>,
    ) {
        let (place, state) = (&context.place, cx.state);
        let painter = ui.painter_at(place.view);
        let whole_view = if slot == Slot::SecondLayer { settings.other } else { settings.layer };
        let mut parts = vec![(whole_view, slot, place.view)];
        if let Some(x) = wipe_x {
            parts[0].2.max.x = x;
            parts.push((
                settings.other,
                Slot::SecondLayer,
                Rect::from_min_max(pos2(x, place.view.top()), place.view.max),
            ));
        }
        let is_large = place.size.x * place.size.y > LARGE_PX as f32;
        let instant = self.instant_cache.instant(state, is_large && self.textures.is_painting());
        for &(layer, slot, part) in &parts {
            let painter = painter.with_clip_rect(part);
            if let Some(instant) = instant.as_ref().filter(|_| slot == Slot::Layer) {
                self.paint_instant(ui, &painter, context, state, instant);
                continue;
            }
            let compared = match slot {
                Slot::SecondLayer => PaintRequest::compared_layer(state, layer, settings),
                _ => None,
            };
            let is_compared = compared.is_some();
            let request = compared.or_else(|| PaintRequest::layer(state, layer, settings));
            let texture = request.and_then(|request| self.textures.get(ui.ctx(), slot, &request));
            if let Some(texture) = texture {
                let other = other_size::other_size(cx).filter(|_| is_compared);
                let place_of_texture = other.map_or(*place, |size| place.of_size(size));
                texture.draw(&painter, &place_of_texture, tint(cx, layer));
                // The numbers of the other photograph are not at hand.
                if !is_compared {
                    overlay::values(&painter, place, state, layer, texture);
                }
            }
        }
        // Marks have pixels of the photograph shown, and not of a compared one of another size.
        let of_first = other_size::other_size(cx).filter(|_| wipe_x.is_some()).map(|_| parts[0].2);
        let painter_of_marks = of_first.map_or_else(|| painter.clone(), |part| painter.with_clip_rect(part));
        self.paint_marks(ui, &painter_of_marks, cx, context, settings);
        if let Some(x) = wipe_x {
            paint_wipe_line(&painter, cx, place.view, x);
        }
        let shows_names = settings.arrangement != Arrangement::Single || self.is_compared;
        show_texts(ui, &painter, cx, &parts, shows_names, instant.as_deref(), &mut self.notes);
    }

    /// Paints what lies over the layers of one view: grid, outlines, hovered colors, profile, marks, and the gesture in progress.
    fn paint_marks(
        &mut self,
        ui: &Ui,
        painter: &Painter,
        cx: &PanelContext,
        context: &PointerContext,
        settings: &ImageSettings,
    ) {
        let (place, state) = (&context.place, cx.state);
        overlay::grid(painter, place);
        if place.zoom >= overlay::OUTLINE_ZOOM {
            overlay::outlines(painter, place, state);
        } else {
            let marks = PaintRequest::marks(state).map(|request| (Slot::Marks, request));
            let outline = PaintRequest::preview_outline(state).map(|request| (Slot::PreviewOutline, request));
            for (slot, request) in marks.into_iter().chain(outline) {
                if let Some(texture) = self.textures.get(ui.ctx(), slot, &request) {
                    texture.draw(painter, place, Color32::WHITE);
                }
            }
        }
        overlay::hovered_colors(painter, place, state);
        overlay::profile(painter, place, state);
        overlay::pixels(painter, place, state, context.response.contains_pointer());
        overlay::mark_at_pointer(ui, painter, cx.palette, place, state);
        let brush = (settings.tool == Tool::Brush && context.response.contains_pointer())
            .then_some(settings.brush_px);
        self.tool_state.draw(painter, place, brush);
    }

    /// Paints the instant at the debugger's cursor over the photograph.
    fn paint_instant(
        &mut self,
        ui: &Ui,
        painter: &Painter,
        context: &PointerContext,
        state: &State,
        instant: &Arc<Instant>,
    ) {
        let settings = &state.view.image;
        let photograph =
            PaintRequest::layer(state, Layer::Input, settings).map(|request| (Slot::Layer, request));
        let over = PaintRequest::instant(state, instant).map(|request| (Slot::Instant, request));
        for (slot, request) in photograph.into_iter().chain(over) {
            if let Some(texture) = self.textures.get(ui.ctx(), slot, &request) {
                texture.draw(painter, &context.place, Color32::WHITE);
                if slot == Slot::Layer {
                    overlay::values(painter, &context.place, state, Layer::Input, texture);
                }
            }
        }
        cursor::mark_step(painter, &context.place, instant);
    }
}

/// The factor of a layer's colors: gray for a layer of an older result, when the newer result takes long or was canceled; otherwise white.
fn tint(cx: &PanelContext, layer: Layer) -> Color32 {
    if layer.needs_result() && is_older(cx.state) { Color32::from_gray(140) } else { Color32::WHITE }
}

/// Whether layers and verdict are of an older result, while the newer result takes long or was canceled.
pub(super) fn is_older(state: &State) -> bool {
    let is_late = state.jobs.analysis.is_some_and(|job| job.since.elapsed() >= PROGRESS_DELAY);
    // A preview is made anew several times a second while a slider moves.
    let is_current = state.is_current() || state.shown_preview().is_some();
    is_late && !is_current && !state.view.show_pinned || state.shows_other_parameters()
}

/// The wipe's line, with a grip in its middle.
fn paint_wipe_line(painter: &Painter, cx: &PanelContext, view: Rect, x: f32) {
    painter.vline(x, view.y_range(), (3.0, Color32::from_black_alpha(130)));
    painter.vline(x, view.y_range(), (1.4, overlay::MARK_COLOR));
    let grip = Rect::from_center_size(pos2(x, view.center().y), vec2(9.0, 26.0));
    painter.rect(grip, 4.0, cx.palette.panel, (1.4, overlay::MARK_COLOR), StrokeKind::Middle);
    for dx in [-1.5, 1.5] {
        painter.vline(
            x + dx,
            Rangef::new(grip.center().y - 6.0, grip.center().y + 6.0),
            (1.0, overlay::MARK_COLOR),
        );
    }
}
