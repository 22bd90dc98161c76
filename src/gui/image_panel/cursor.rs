//! The instant at the debugger's cursor, shown in place of the layer.

use super::geometry::Placement;
use super::icons::{corners, cross};
use super::overlay::{self, MARK_COLOR};
use crate::app::{Command, DebugCommand, DebugSettings, State};
use crate::describe::grouped;
use crate::gui::PanelContext;
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets::color;
use crate::raster::HypothesisId;
use crate::view::{Instant, cursor_place, instant_legend};
use egui::accesskit::Role;
use egui::{Align2, Button, Color32, Painter, Rect, Sense, Shape, Stroke, Ui, UiBuilder, WidgetInfo, vec2};
use std::sync::Arc;

/// Smallest zoom at which a single pixel is framed, screen points per pixel; at a smaller zoom a cross marks the pixel.
const FRAME_ZOOM: f32 = 8.0;

/// The instant at the cursor, computed once for each place of the cursor.
#[derive(Default)]
pub struct InstantCache {
    shown: Option<(InstantKey, Arc<Instant>)>,
}

/// The identity of an instant: number of the result, step, chosen region.
type InstantKey = (u64, usize, Option<HypothesisId>);

impl InstantCache {
    /// The instant at the cursor, where the cursor is followed. While `is_painting`, an older instant of the same trace, so
    /// that a large picture is copied no more often than painted.
    pub fn instant(&mut self, state: &State, is_painting: bool) -> Option<Arc<Instant>> {
        let (Some(replay), Some(shown)) = (state.followed(), state.newest.as_ref()) else {
            self.shown = None;
            return None;
        };
        let debugger = &state.debugger;
        let key = (debugger.generation, replay.at(), debugger.chosen);
        if let Some((at, instant)) = &self.shown
            && (*at == key || (is_painting && at.0 == key.0))
        {
            return Some(Arc::clone(instant));
        }
        let (names, show_focus) = (&debugger.names, debugger.chosen);
        let instant = Arc::new(Instant::of(replay, names, show_focus, &shown.analysis.working));
        self.shown = Some((key, Arc::clone(&instant)));
        Some(instant)
    }
}

/// The button "Follow", shown while the cursor stands before the end of the trace.
fn follow_button(ui: &mut Ui, state: &State, settings: &mut DebugSettings) {
    if state.debugger.stopped().is_none() {
        return;
    }
    let tip = "Image, color space and tables show the instant at the debugger's cursor, not the result.";
    let button = Button::selectable(settings.follow, "Follow");
    if ui.add(button).on_hover_text(tip).clicked() {
        settings.follow = !settings.follow;
    }
}

/// Width of the button "Follow", points.
const FOLLOW_PT: f32 = 60.0;

/// Shows the button "Follow" in the upper right corner, and `contents` in the rest of the width.
pub fn beside_follow_button(
    ui: &mut Ui,
    state: &State,
    settings: &mut DebugSettings,
    contents: impl FnOnce(&mut Ui),
) {
    let full = ui.max_rect();
    let corner =
        Rect::from_min_max(full.right_top() - vec2(FOLLOW_PT, 0.0), full.right_top() + vec2(0.0, 20.0));
    let rest = full.with_max_x(corner.left() - 8.0);
    // Children do not change the size of the strip.
    contents(&mut ui.new_child(UiBuilder::new().max_rect(rest)));
    follow_button(&mut ui.new_child(UiBuilder::new().max_rect(corner)), state, settings);
}

/// Sends changed settings of the debugger.
pub fn send_settings(cx: &mut PanelContext, settings: DebugSettings) {
    if settings != cx.state.view.debug {
        cx.send(Command::Debug(DebugCommand::Settings(settings)));
    }
}

/// Marks the window or pixel of the step taken last.
pub fn mark_step(painter: &Painter, place: &Placement, instant: &Instant) {
    let paint_outline = |area: Rect, tone: Color32| {
        painter.add(Shape::line(corners(area).to_vec(), Stroke::new(3.4, Color32::from_black_alpha(150))));
        painter.add(Shape::line(corners(area).to_vec(), Stroke::new(1.6, tone)));
    };
    if let Some([left, top, side]) = instant.window {
        let square = Rect::from_min_size(egui::pos2(left as f32, top as f32), egui::Vec2::splat(side as f32));
        paint_outline(
            place.screen_rect_of(square.intersect(Rect::from_min_size(egui::Pos2::ZERO, place.size))),
            MARK_COLOR,
        );
    }
    if let Some((pixel, taken)) = instant.pixel {
        let tone = if taken { MARK_COLOR } else { Color32::WHITE };
        let square = place.screen_rect_of(place.square_of(pixel));
        if place.zoom >= FRAME_ZOOM {
            paint_outline(square, tone);
        } else {
            cross(painter, square.center(), tone);
        }
    }
}

/// Shows the cursor's place in the upper left corner, and the legend along the lower edge.
pub fn show_texts(
    ui: &Ui,
    painter: &Painter,
    palette: &ThemeColors,
    view: Rect,
    state: &State,
    instant: &Instant,
) {
    let Some(replay) = state.followed() else { return };
    let before = if state.lacks_result() { "the result before, " } else { "" };
    let text = format!("{before}at step {}: {}", grouped(replay.at()), cursor_place(replay));
    let corner = view.left_top() + vec2(6.0, 6.0);
    let area = overlay::text_box(painter, palette, corner, Align2::LEFT_TOP, &text);
    let label = ui.interact(area, ui.scope_id().with("cursor place"), Sense::hover());
    label.widget_info(|| WidgetInfo::labeled(Role::Label, true, text.clone()));
    overlay::legend_box(painter, palette, view, &instant_legend(instant));
    show_focus(painter, palette, area, state);
}

/// Shows the region in focus beside the cursor's place.
fn show_focus(painter: &Painter, palette: &ThemeColors, beside: Rect, state: &State) {
    let Some(focus) = state.debugger.focus() else { return };
    let names = &state.debugger.names;
    let text = match names.region_of(focus) {
        None => "nothing is left of it".to_owned(),
        Some(number) => format!("\u{2192} region {number}"),
    };
    let font = egui::FontId::proportional(SMALL_PT);
    let galley = painter.layout_no_wrap(text, font, palette.secondary);
    let area = Rect::from_min_size(
        beside.right_top() + vec2(4.0, 0.0),
        vec2(galley.size().x + 24.0, beside.height()),
    );
    painter.rect_filled(area, 3.0, palette.panel.gamma_multiply(0.86));
    let chip = Rect::from_center_size(area.left_center() + vec2(9.5, 0.0), vec2(9.0, 9.0));
    painter.rect_filled(chip, 2.0, color(names.color(focus)));
    painter.galley(area.min + vec2(18.0, 2.0), galley, palette.secondary);
}
