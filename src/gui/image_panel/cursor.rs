//! The instant at the debugger's cursor, shown in place of the layer.

use super::geometry::Placement;
use super::icons::{corners, cross};
use super::overlay::{self, MARK};
use crate::app::{Command, DebugCommand, DebugSettings, State};
use crate::gui::PanelContext;
use crate::gui::theme::{SMALL_PT, Tones};
use crate::gui::widgets::{color, grouped};
use crate::raster::HypothesisId;
use crate::view::{Instant, cursor_place, instant_legend};
use egui::accesskit::Role;
use egui::{Align2, Button, Color32, Painter, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};
use std::sync::Arc;

/// From this zoom on a single pixel is framed, below it is marked with a cross; screen points per pixel.
const FRAMED: f32 = 8.0;

/// The instant that is shown, computed once for each place of the cursor.
#[derive(Default)]
pub struct InstantCache {
    shown: Option<(Frame, Arc<Instant>)>,
}

/// The identity of an instant: number of the result, step, chosen region.
type Frame = (u64, usize, Option<HypothesisId>);

impl InstantCache {
    /// The instant at the cursor, where it is followed; an older one while `busy`, so that a large picture is not copied
    /// more often than it is painted.
    pub fn instant(&mut self, state: &State, busy: bool) -> Option<Arc<Instant>> {
        let (Some(replay), Some(shown)) = (state.followed(), state.newest.as_ref()) else {
            self.shown = None;
            return None;
        };
        let debugger = &state.debugger;
        let frame = (debugger.generation, replay.at(), debugger.chosen);
        if let Some((at, instant)) = &self.shown
            && (*at == frame || (busy && at.0 == frame.0))
        {
            return Some(Arc::clone(instant));
        }
        let (names, chosen) = (&debugger.names, debugger.chosen);
        let instant = Arc::new(Instant::of(replay, names, chosen, &shown.analysis.working));
        self.shown = Some((frame, Arc::clone(&instant)));
        Some(instant)
    }
}

/// The button "Follow", shown while the cursor stands before the end of the trace.
pub fn toggle(ui: &mut Ui, state: &State, settings: &mut DebugSettings) {
    if state.debugger.stopped().is_none() {
        return;
    }
    let tip = "Image, color space and tables show the instant at the debugger's cursor, not the result.";
    let button = Button::selectable(settings.follow, "Follow");
    if ui.add(button).on_hover_text(tip).clicked() {
        settings.follow = !settings.follow;
    }
}

/// Sends changed settings of the debugger.
pub fn send(cx: &mut PanelContext, settings: DebugSettings) {
    if settings != cx.state.view.debug {
        cx.send(Command::Debug(DebugCommand::Settings(settings)));
    }
}

/// Marks the window or pixel of the step taken last.
pub fn spot(painter: &Painter, place: &Placement, instant: &Instant) {
    let line = |area: Rect, tone: Color32| {
        painter.add(Shape::line(corners(area).to_vec(), Stroke::new(3.4, Color32::from_black_alpha(150))));
        painter.add(Shape::line(corners(area).to_vec(), Stroke::new(1.6, tone)));
    };
    if let Some([left, top, side]) = instant.window {
        let square = Rect::from_min_size(egui::pos2(left as f32, top as f32), egui::Vec2::splat(side as f32));
        line(place.screen_rect_of(square.intersect(Rect::from_min_size(egui::Pos2::ZERO, place.size))), MARK);
    }
    if let Some((pixel, taken)) = instant.pixel {
        let tone = if taken { MARK } else { Color32::WHITE };
        let square = place.screen_rect_of(place.square_of(pixel));
        if place.zoom >= FRAMED {
            line(square, tone);
        } else {
            cross(painter, square.center(), tone);
        }
    }
}

/// Shows the cursor's place in the upper left corner, and the legend along the lower edge.
pub fn words(ui: &Ui, painter: &Painter, tones: &Tones, view: Rect, state: &State, instant: &Instant) {
    let Some(replay) = state.followed() else { return };
    let text = format!("at step {}: {}", grouped(replay.at()), cursor_place(replay));
    let corner = view.left_top() + vec2(6.0, 6.0);
    let area = overlay::tag(painter, tones, corner, Align2::LEFT_TOP, &text);
    let label = ui.interact(area, ui.scope_id().with("cursor place"), Sense::hover());
    label.widget_info(|| WidgetInfo::labeled(Role::Label, true, text.clone()));
    label.on_hover_text(
        "The picture shows this instant of the analysis; \u{201c}Follow\u{201d} turns back to the result.",
    );
    overlay::entries(painter, tones, view, &instant_legend(instant));
    chosen(painter, tones, area, state);
}

/// Shows the region in focus beside the cursor's place.
fn chosen(painter: &Painter, tones: &Tones, beside: Rect, state: &State) {
    let Some(focus) = state.debugger.focus() else { return };
    let names = &state.debugger.names;
    let text = match names.region_of(focus) {
        None => "nothing is left of it".to_owned(),
        Some(number) => format!("\u{2192} region {number}"),
    };
    let font = egui::FontId::proportional(SMALL_PT);
    let galley = painter.layout_no_wrap(text, font, tones.quiet);
    let area = Rect::from_min_size(
        beside.right_top() + vec2(4.0, 0.0),
        vec2(galley.size().x + 24.0, beside.height()),
    );
    painter.rect_filled(area, 3.0, tones.panel.gamma_multiply(0.86));
    let chip = Rect::from_center_size(area.left_center() + vec2(9.5, 0.0), vec2(9.0, 9.0));
    painter.rect_filled(chip, 2.0, color(names.color(focus)));
    painter.galley(area.min + vec2(18.0, 2.0), galley, tones.quiet);
}
