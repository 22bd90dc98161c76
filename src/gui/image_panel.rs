//! The image view: the photograph and its layers, with zooming, hovering, marking and measuring.

mod cursor;
mod geometry;
mod icons;
mod overlay;
mod readout;
mod textures;
mod tiles;
mod toolbar;
mod tools;

use super::status::PATIENCE;
use super::{PanelContext, widgets};
use crate::app::ViewCommand;
use crate::raster::PixelIndex;
use crate::view::{Arrangement, ImageSettings, Instant, Item, Layer, Tool};
use cursor::InstantCache;
use egui::accesskit::Role;
use egui::{
    Align2, CentralPanel, Color32, CursorIcon, EventFilter, Frame, Key, Margin, Modifiers, Panel, Rect,
    Response, Sense, Ui, Vec2, WidgetInfo, pos2, vec2,
};
pub use geometry::Placement;
use std::sync::Arc;
use textures::{PaintRequest, Slot, TextureCache};
use tools::{PointerContext, ToolState};

/// Half the width of the wipe's handle, points.
const HANDLE_PT: f32 = 6.0;
/// Distance that an arrow key moves the picture, points.
const STEP_PT: f32 = 40.0;

/// The panel: what it has uploaded, and the gesture in progress.
#[derive(Default)]
pub struct ImagePanel {
    textures: TextureCache,
    instant_cache: InstantCache,
    hand: ToolState,
    /// The pixel under the pointer that this panel sent last.
    pointed: Option<PixelIndex>,
    /// The layer of the last frame, if the instant at the cursor was shown in its place.
    unseen: Option<Layer>,
    /// The zoom of the last frame, screen points a pixel.
    zoom: f32,
    /// The toolbar's height in the last frame, points.
    bar_pt: f32,
}

impl ImagePanel {
    /// Cancels the gesture in progress on Escape, before Escape clears the selection.
    pub fn take_escape(&mut self, ctx: &egui::Context) {
        if self.hand.is_busy() && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            self.hand.give_up();
        }
    }

    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let Some(picture) = &cx.state.picture else {
            nothing_open(ui, cx);
            return;
        };
        let before = &cx.state.view.image;
        let mut settings = before.clone();
        let mut debug = cx.state.view.debug.clone();
        let (tones, state) = (cx.tones, cx.state);
        let unseen = state.followed().map(|_| settings.layer);
        let before_key = std::mem::replace(&mut self.unseen, unseen);
        if before_key.zip(unseen).is_some_and(|(before, now)| before != now) {
            // A key or the menu has chosen a layer of the result.
            debug.follow = false;
        }
        let bar = Frame::new().fill(tones.panel);
        let top = Panel::top("image toolbar").frame(bar.inner_margin(Margin::symmetric(6, 3)));
        let top = top.show(ui, |ui| toolbar::row(ui, state, tones, &mut settings, &mut debug, self.zoom));
        // The height of a row that wraps is known from the next frame on.
        let height = top.response.rect.height();
        if (height - std::mem::replace(&mut self.bar_pt, height)).abs() > 0.5 {
            ui.ctx().request_repaint();
        }
        let strip = readout::height(ui, ui.available_width() - 16.0);
        let frame = bar.inner_margin(Margin { left: 8, right: 8, top: 2, bottom: 2 });
        Panel::bottom("read-out").frame(frame).exact_size(strip + 4.0).show(ui, |ui| {
            readout::show(ui, state, tones);
        });
        let column = Panel::left("tools").resizable(false).exact_size(icons::SIDE_PT + 8.0);
        column.frame(bar.inner_margin(4)).show(ui, |ui| toolbar::column(ui, tones, &mut settings));
        let (width, height) = picture.size();
        let size = vec2(width as f32, height as f32);
        CentralPanel::default().frame(Frame::new().fill(tones.background)).show(ui, |ui| {
            self.views(ui, cx, &mut settings, size);
        });
        if settings != cx.state.view.image {
            cx.send(ViewCommand::Image(settings));
        }
        cursor::send(cx, debug);
    }

    /// Shows one or two views.
    fn views(&mut self, ui: &mut Ui, cx: &mut PanelContext, settings: &mut ImageSettings, size: Vec2) {
        let full = ui.available_rect_before_wrap();
        if full.width() < 8.0 || full.height() < 8.0 {
            return;
        }
        let mut pointed = None;
        if settings.arrangement == Arrangement::SideBySide {
            let middle = full.center().x.round();
            let left = Rect::from_min_max(full.min, pos2(middle - 1.0, full.bottom()));
            let right = Rect::from_min_max(pos2(middle + 1.0, full.top()), full.max);
            ui.painter().vline(middle, full.y_range(), (2.0, cx.tones.line));
            for (view, slot) in [(left, Slot::Layer), (right, Slot::Other)] {
                pointed = self.view(ui, cx, settings, Placement::new(view, size, settings), slot).or(pointed);
            }
        } else {
            pointed = self.view(ui, cx, settings, Placement::new(full, size, settings), Slot::Layer);
        }
        self.tell(cx, pointed);
    }

    /// Shows one view. Returns the pixel under the pointer in it.
    fn view(
        &mut self,
        ui: &mut Ui,
        cx: &mut PanelContext,
        settings: &mut ImageSettings,
        place: Placement,
        slot: Slot,
    ) -> Option<PixelIndex> {
        self.zoom = place.zoom;
        let name = if slot == Slot::Layer { "Picture" } else { "Second picture" };
        let response = ui.interact(place.view, ui.scope_id().with(name), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
        let wiped = self.wipe(ui, settings, &place);
        let layer = if slot == Slot::Other { settings.other } else { settings.layer };
        let layer = wiped.filter(|&x| pointer_is_right_of(ui, x)).map_or(layer, |_| settings.other);
        let spot = PointerContext { response: &response, place, layer };
        self.hand.act(ui, &spot, cx, settings);
        travel(ui, &response, &place, settings);
        self.draw(ui, cx, &spot, slot, wiped);
        let pointer = response.hover_pos().filter(|_| response.contains_pointer());
        pointer.and_then(|pointer| place.pixel_at(pointer))
    }

    /// The line between two layers; where it is on the screen.
    fn wipe(&self, ui: &Ui, settings: &mut ImageSettings, place: &Placement) -> Option<f32> {
        let Arrangement::Wipe(share) = settings.arrangement else { return None };
        let view = place.view;
        let on_screen = |share: f32| {
            place.screen_from_image(pos2(share * place.size.x, 0.0)).x.clamp(view.left(), view.right())
        };
        let x = on_screen(share);
        let grasp = Rect::from_x_y_ranges(x - HANDLE_PT..=x + HANDLE_PT, view.y_range());
        let sense = if self.hand.is_busy() { Sense::hover() } else { Sense::drag() };
        let handle = ui.interact(grasp, ui.scope_id().with("wipe"), sense);
        handle.widget_info(|| WidgetInfo::slider(true, f64::from(share), "Wipe line"));
        if handle.hovered() || handle.dragged() {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        let pointer = handle.interact_pointer_pos().filter(|_| handle.dragged());
        if let Some(pointer) = pointer {
            let share = place.image_from_screen(pointer).x / place.size.x.max(1.0);
            settings.arrangement = Arrangement::Wipe(share.clamp(0.0, 1.0));
        }
        Some(x)
    }

    fn draw(&mut self, ui: &Ui, cx: &PanelContext, spot: &PointerContext, slot: Slot, wiped: Option<f32>) {
        let (place, state) = (&spot.place, cx.state);
        let settings = &state.view.image;
        let painter = ui.painter_at(place.view);
        let own = if slot == Slot::Other { settings.other } else { settings.layer };
        let mut parts = vec![(own, slot, place.view)];
        if let Some(x) = wiped {
            parts[0].2.max.x = x;
            parts.push((
                settings.other,
                Slot::Other,
                Rect::from_min_max(pos2(x, place.view.top()), place.view.max),
            ));
        }
        let large = place.size.x * place.size.y > textures::LARGE_PX as f32;
        let instant = self.instant_cache.instant(state, large && self.textures.is_painting());
        for &(layer, slot, part) in &parts {
            let painter = painter.with_clip_rect(part);
            if let Some(instant) = instant.as_ref().filter(|_| slot == Slot::Layer) {
                self.instant(ui, &painter, spot, state, instant);
                continue;
            }
            let order = PaintRequest::layer(state, layer, settings);
            let texture = order.and_then(|order| self.textures.get(ui.ctx(), slot, &order));
            if let Some(texture) = texture {
                texture.draw(&painter, place, tint(cx, layer));
                overlay::values(&painter, place, state, layer, texture);
            }
        }
        overlay::grid(&painter, place);
        if place.zoom >= overlay::LINES {
            overlay::outlines(&painter, place, state);
        } else if let Some(order) = PaintRequest::marks(state)
            && let Some(texture) = self.textures.get(ui.ctx(), Slot::Marks, &order)
        {
            texture.draw(&painter, place, Color32::WHITE);
        }
        overlay::profile(&painter, place, state);
        overlay::pixels(&painter, place, state, spot.response.contains_pointer());
        let brush =
            (settings.tool == Tool::Brush && spot.response.contains_pointer()).then_some(settings.brush_px);
        self.hand.draw(&painter, place, brush);
        if let Some(x) = wiped {
            handle(&painter, cx, place.view, x);
        }
        words(ui, &painter, cx, &parts, instant.as_deref());
    }

    /// The instant at the debugger's cursor, over the photograph.
    fn instant(
        &mut self,
        ui: &Ui,
        painter: &egui::Painter,
        spot: &PointerContext,
        state: &crate::app::State,
        instant: &Arc<Instant>,
    ) {
        let settings = &state.view.image;
        let photograph = PaintRequest::layer(state, Layer::Input, settings).map(|order| (Slot::Layer, order));
        let over = PaintRequest::instant(state, instant).map(|order| (Slot::Instant, order));
        for (slot, order) in photograph.into_iter().chain(over) {
            if let Some(texture) = self.textures.get(ui.ctx(), slot, &order) {
                texture.draw(painter, &spot.place, Color32::WHITE);
                if slot == Slot::Layer {
                    overlay::values(painter, &spot.place, state, Layer::Input, texture);
                }
            }
        }
        cursor::spot(painter, &spot.place, instant);
    }

    /// Sends the pixel under the pointer, when it has changed.
    fn tell(&mut self, cx: &mut PanelContext, pixel: Option<PixelIndex>) {
        let item = pixel.map(Item::Pixel);
        let told = self.pointed.is_some() || pixel.is_some();
        if told
            && item != cx.state.hover
            && (pixel.is_some() || self.pointed.map(Item::Pixel) == cx.state.hover)
        {
            cx.send(ViewCommand::Hover(item));
        }
        self.pointed = pixel;
    }
}

/// Names of the layers where there are two, what their colors mean, and what the analysis warns of.
fn words(
    ui: &Ui,
    painter: &egui::Painter,
    cx: &PanelContext,
    parts: &[(Layer, Slot, Rect)],
    instant: Option<&Instant>,
) {
    let two = cx.state.view.image.arrangement != Arrangement::Single;
    for &(layer, slot, part) in parts {
        let painter = painter.with_clip_rect(part);
        if let Some(instant) = instant.filter(|_| slot == Slot::Layer) {
            cursor::words(ui, &painter, cx.tones, part, cx.state, instant);
            continue;
        }
        if two {
            let right = parts.len() == 2 && slot == Slot::Other;
            let (corner, align) = if right {
                (part.right_top() + vec2(-6.0, 6.0), Align2::RIGHT_TOP)
            } else {
                (part.left_top() + vec2(6.0, 6.0), Align2::LEFT_TOP)
            };
            overlay::tag(&painter, cx.tones, corner, align, layer.name());
        }
        overlay::key(&painter, cx.tones, part, layer);
    }
    if instant.is_some() {
        return;
    }
    let view = painter.clip_rect();
    let below = if two { vec2(0.0, 22.0) } else { Vec2::ZERO };
    overlay::warnings(painter, cx.tones, view.translate(below), cx.state);
}

/// Zooms and pans by scrolling, pinching and keys.
fn travel(ui: &Ui, response: &Response, place: &Placement, settings: &mut ImageSettings) {
    let pointer = response.hover_pos().filter(|_| response.contains_pointer());
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
    let factor = pinch * (scroll / 200.0).exp();
    if let Some(pointer) = pointer.filter(|_| (factor - 1.0).abs() > 1e-6) {
        place.zoomed(factor, pointer).put(settings);
    }
    let focused = ui.memory(egui::Memory::focused);
    let listens = response.has_focus() || (pointer.is_some() && focused.is_none());
    if !listens {
        return;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let (by, factor) = ui.input(|input| {
        if input.modifiers.command {
            return (Vec2::ZERO, 1.0);
        }
        let presses = |key: Key| input.num_presses(key) as f32;
        let by = vec2(
            presses(Key::ArrowLeft) - presses(Key::ArrowRight),
            presses(Key::ArrowUp) - presses(Key::ArrowDown),
        );
        let nearer = presses(Key::Plus) + presses(Key::Equals) - presses(Key::Minus);
        (by * STEP_PT, 1.25f32.powf(nearer))
    });
    if by != Vec2::ZERO {
        place.panned(by).put(settings);
    } else if (factor - 1.0).abs() > 1e-6 {
        place.zoomed(factor, pointer.unwrap_or(place.view.center())).put(settings);
    }
}

fn pointer_is_right_of(ui: &Ui, x: f32) -> bool {
    ui.input(|input| input.pointer.interact_pos()).is_some_and(|pointer| pointer.x >= x)
}

/// A picture of an older result is dimmed when the newer one takes long.
fn tint(cx: &PanelContext, layer: Layer) -> Color32 {
    let state = cx.state;
    let late = state.jobs.analysis.is_some_and(|job| job.since.elapsed() >= PATIENCE);
    let stale = late && layer.needs_result() && !state.is_current() && !state.view.show_pinned;
    if stale { Color32::from_gray(140) } else { Color32::WHITE }
}

/// The wipe's line, with a grip in its middle.
fn handle(painter: &egui::Painter, cx: &PanelContext, view: Rect, x: f32) {
    painter.vline(x, view.y_range(), (3.0, Color32::from_black_alpha(130)));
    painter.vline(x, view.y_range(), (1.4, overlay::MARK));
    let grip = Rect::from_center_size(pos2(x, view.center().y), vec2(9.0, 26.0));
    painter.rect(grip, 4.0, cx.tones.panel, (1.4, overlay::MARK), egui::StrokeKind::Middle);
    for dx in [-1.5, 1.5] {
        painter.vline(
            x + dx,
            egui::Rangef::new(grip.center().y - 6.0, grip.center().y + 6.0),
            (1.0, overlay::MARK),
        );
    }
}

fn nothing_open(ui: &mut Ui, cx: &PanelContext) {
    match &cx.state.jobs.reading {
        Some(job) if job.since.elapsed() >= PATIENCE => {
            widgets::nothing(ui, cx.tones, "Reading the photograph\u{2026}");
        }
        Some(job) => ui.ctx().request_repaint_after(PATIENCE.saturating_sub(job.since.elapsed())),
        None => {
            widgets::nothing(ui, cx.tones, "Open a photograph: Ctrl+O, drop a file here, or paste");
        }
    }
}
