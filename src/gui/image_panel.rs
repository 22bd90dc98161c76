//! The image view: the photograph and its layers, with zooming, hovering, marking and measuring.

mod cursor;
mod geometry;
mod icons;
mod navigation;
mod notes;
mod other_size;
mod overlay;
mod paint_request;
mod painting;
mod readout;
mod texts;
mod textures;
mod tiles;
mod toolbar;
mod tools;
mod white_patch;

use super::action::ViewStep;
use super::keyboard_focus::is_keyboard_owned;
use super::verdict_strip::StepSentence;
use super::work_shown::PROGRESS_DELAY;
use super::{PanelContext, context_menu, lacking_result, popup_scroll, start, verdict_strip, widgets};
use crate::app::{DebugSettings, JobCommand, ViewCommand};
use crate::photo::ReadOptions;
use crate::raster::PixelIndex;
use crate::view::{Arrangement, ArrangementKind, ImageSettings, Item, Layer};
use cursor::InstantCache;
use egui::accesskit::Role;
use egui::{
    CentralPanel, Color32, CursorIcon, Frame, Key, Margin, Modifiers, Panel, Rect, Sense, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};
pub use geometry::Placement;
use navigation::{navigate, stepped};
use notes::DismissedNotes;
use paint_request::PaintRequest;
use texts::show_texts;
use textures::{Slot, TextureCache};
use tools::{PointerContext, ToolState};

/// Height without the toolbar below which the panel is low: readout and verdict have a line each, and the picture the rest; points.
const LOW_PT: f32 = 250.0;
/// Width of a panel in which nearly every verdict has room in one line, points; in a narrower panel, the verdict has two.
const ONE_LINE_PT: f32 = 760.0;
/// Half the width of the wipe's handle, points.
const HANDLE_PT: f32 = 6.0;
/// Opacity of the verdict on an older result.
const OLDER_OPACITY: f32 = 0.6;

/// The image panel: the uploaded textures, and the gesture in progress.
#[derive(Default)]
pub struct ImagePanel {
    textures: TextureCache,
    instant_cache: InstantCache,
    tool_state: ToolState,
    /// The layer of the last frame, and whether it was wiped with another, if the instant at the cursor was shown in its place.
    hidden: Option<(Layer, bool)>,
    /// The placement of the picture in the last frame; none before the first frame.
    place: Option<Placement>,
    /// The toolbar's height in the last frame, points.
    toolbar_height_pt: f32,
    step_sentence: StepSentence,
    /// The notes over the picture that a person dismissed.
    notes: DismissedNotes,
    /// The pixel that the context menu is about.
    menu_pixel: Option<PixelIndex>,
    /// Whether the key is held that shows the photograph in place of the layer.
    is_compared: bool,
}

impl ImagePanel {
    /// Cancels the gesture in progress on Escape, before Escape clears the selection.
    pub fn cancel_on_escape(&mut self, ctx: &egui::Context) {
        if self.tool_state.is_busy() && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
        {
            self.tool_state.cancel();
        }
    }

    /// Zooms the view, or moves the picture in it, by one step.
    pub fn step_view(&self, ctx: &egui::Context, cx: &mut PanelContext, step: ViewStep) {
        let Some(place) = self.place.filter(|_| cx.state.picture.is_some()) else { return };
        let mut settings = cx.state.view.image.clone();
        stepped(place, step, ctx.pointer_hover_pos()).store(&mut settings);
        cx.send(ViewCommand::Image(settings));
    }

    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let Some(picture) = cx.state.picture.clone() else {
            nothing_open(ui, cx);
            return;
        };
        let before = &cx.state.view.image;
        let mut settings = before.clone();
        let mut debug = cx.state.view.debug.clone();
        let (palette, state) = (cx.palette, cx.state);
        let is_wiped = settings.arrangement.kind() == ArrangementKind::Wipe;
        let hidden = state.followed().map(|_| (settings.layer, is_wiped));
        let hidden_before = std::mem::replace(&mut self.hidden, hidden);
        if hidden_before.zip(hidden).is_some_and(|(before, now)| before.0 != now.0 || now.1 && !before.1) {
            // A key or the menu has chosen a layer of the result, or a wipe between two.
            debug.follow = false;
        }
        let bar = Frame::new().fill(palette.panel);
        let top = Panel::top("image toolbar").frame(bar.inner_margin(Margin::symmetric(6, 3)));
        let zoom = self.place.map_or(0.0, |place| place.zoom);
        let top = top.show(ui, |ui| {
            toolbar::row(ui, state, palette, &mut settings, &mut debug, zoom, cx.actions);
        });
        // The height of a row that wraps is known from the next frame on.
        let height = top.response.rect.height();
        if (height - std::mem::replace(&mut self.toolbar_height_pt, height)).abs() > 0.5 {
            ui.ctx().request_repaint();
        }
        let is_low = ui.available_height() < LOW_PT;
        let readout_height = readout::height(ui, state, ui.available_width() - 16.0, is_low);
        let frame = bar.inner_margin(Margin { left: 8, right: 8, top: 2, bottom: 2 });
        Panel::bottom("read-out").frame(frame).exact_size(readout_height + 4.0).show(ui, |ui| {
            readout::show(ui, state, palette, is_low);
        });
        self.show_verdict(ui, cx, &mut debug, bar, is_low);
        let columns = toolbar::columns_needed(ui.available_height() - 8.0, &settings);
        let column = Panel::left("tools").resizable(false).exact_size(toolbar::columns_width(columns) + 8.0);
        column.frame(bar.inner_margin(4)).show(ui, |ui| {
            // Where two columns have no room either, the tools are scrolled.
            let area = egui::ScrollArea::vertical();
            let area = area.scroll_bar_visibility(egui::scroll_area::ScrollBarVisibility::AlwaysHidden);
            area.show(ui, |ui| toolbar::tools(ui, palette, &mut settings, columns));
        });
        let (width, height) = picture.size();
        let size = vec2(width as f32, height as f32);
        CentralPanel::default().frame(Frame::new().fill(palette.background)).show(ui, |ui| {
            // The view before or after is no change of the settings.
            let held = self.held_layer(ui, &settings);
            let arrangement = settings.arrangement;
            if let Some(layer) = held {
                (settings.layer, settings.arrangement) = (layer, Arrangement::Single);
            }
            let chosen = before.layer;
            self.show_views(ui, cx, &mut settings, size);
            if held.is_some() {
                (settings.layer, settings.arrangement) = (chosen, arrangement);
            }
        });
        if settings != cx.state.view.image {
            cx.send(ViewCommand::Image(settings));
        }
        cursor::send_settings(cx, debug);
    }

    /// The layer that is shown while the key C is held: the photograph in place of the layers shown, or the body reflection in
    /// place of the photograph. None while the key is up, and while a text is edited.
    fn held_layer(&mut self, ui: &Ui, settings: &ImageSettings) -> Option<Layer> {
        let is_held = ui.input(|input| input.key_down(Key::C) && input.modifiers.is_none());
        self.is_compared = is_held && !is_keyboard_owned(ui.ctx()) && self.is_compared_or_pressed(ui);
        let shows_photograph = settings.arrangement == Arrangement::Single && settings.layer == Layer::Input;
        let other = if shows_photograph { Layer::Body } else { Layer::Input };
        self.is_compared.then_some(other)
    }

    /// Whether the comparison goes on, or begins in this frame: keys that a dialog takes begin none.
    fn is_compared_or_pressed(&self, ui: &Ui) -> bool {
        self.is_compared || ui.input(|input| input.key_pressed(Key::C))
    }

    /// Shows the verdict on the result, or the sentence about the step at the debugger's cursor. The strip has a height that no
    /// sentence changes, and is there before the first result is, so that the picture does not move.
    fn show_verdict(
        &mut self,
        ui: &mut Ui,
        cx: &mut PanelContext,
        debug: &mut DebugSettings,
        bar: Frame,
        is_low: bool,
    ) {
        if cx.is_export {
            return;
        }
        let state = cx.state;
        let preview = state.shown_preview().map(|(preview, _)| &preview.shown);
        let shown = preview.or_else(|| state.shown());
        let rows = if is_low || ui.available_width() >= ONE_LINE_PT { 1 } else { 2 };
        let margin = Margin { left: 8, right: 8, top: 4, bottom: 2 };
        let height = verdict_strip::height_of(ui, rows) + margin.sum().y;
        let panel = Panel::bottom("verdict").frame(bar.inner_margin(margin)).resizable(false);
        panel.exact_size(height).show(ui, |ui| {
            if state.debugger.stopped().is_none() && state.lacks_result() && !state.shows_pinned() {
                return lacking_result::show_in_place_of_verdict(ui, cx);
            }
            if painting::is_older(state) {
                ui.multiply_opacity(OLDER_OPACITY);
            }
            if state.debugger.stopped().is_none() {
                if let Some(shown) = shown {
                    verdict_strip::show_within(ui, cx, shown, rows);
                }
                return;
            }
            cursor::beside_follow_button(ui, state, debug, |ui| match (state.followed(), shown) {
                (Some(replay), _) => self.step_sentence.show(ui, cx, replay),
                // Beside the button the verdict has less width than without it.
                (None, Some(shown)) => verdict_strip::show_within(ui, cx, shown, rows),
                (None, None) => {}
            });
        });
    }

    /// Shows one or two views.
    fn show_views(&mut self, ui: &mut Ui, cx: &mut PanelContext, settings: &mut ImageSettings, size: Vec2) {
        let full = ui.available_rect_before_wrap();
        if full.width() < 8.0 || full.height() < 8.0 {
            return;
        }
        let mut hovered_pixel = None;
        if settings.arrangement == Arrangement::SideBySide {
            let middle = full.center().x.round();
            let left = Rect::from_min_max(full.min, pos2(middle - 1.0, full.bottom()));
            let right = Rect::from_min_max(pos2(middle + 1.0, full.top()), full.max);
            ui.painter().vline(middle, full.y_range(), (2.0, cx.palette.line));
            for (view, slot) in [(left, Slot::Layer), (right, Slot::SecondLayer)] {
                let place = Placement::new(view, size, settings);
                let other_size = other_size::other_size(cx).filter(|_| slot == Slot::SecondLayer);
                let mut show = |ui: &mut Ui| match other_size {
                    Some(other) => self.show_other_size(ui, cx, settings, place.of_size(other), size),
                    None => self.show_view(ui, cx, settings, place, slot),
                };
                // What lies over a picture, as a note with its button, is there once in each view.
                let is_second = slot == Slot::SecondLayer;
                let pixel = if is_second { ui.push_id("second view", show).inner } else { show(ui) };
                hovered_pixel = pixel.or(hovered_pixel);
            }
        } else {
            hovered_pixel =
                self.show_view(ui, cx, settings, Placement::new(full, size, settings), Slot::Layer);
        }
        if let Some(pixel) = hovered_pixel.filter(|_| !settings.readout_locked) {
            cx.hover(Item::Pixel(pixel));
        }
    }

    /// Shows the second view with a photograph of another size than `size`, the size of the photograph shown. Returns the pixel of
    /// the photograph shown that lies where the pointer is.
    fn show_other_size(
        &mut self,
        ui: &mut Ui,
        cx: &PanelContext,
        settings: &mut ImageSettings,
        place: Placement,
        size: Vec2,
    ) -> Option<PixelIndex> {
        let name = "Second picture";
        let response = ui.interact(place.view, ui.scope_id().with(name), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
        other_size::pan_and_zoom(ui, &response, &place, size, settings);
        let (painter, layer) = (ui.painter_at(place.view), settings.other);
        let request = PaintRequest::compared_layer(cx.state, layer, settings);
        let texture = request.and_then(|request| self.textures.get(ui.ctx(), Slot::SecondLayer, &request));
        if let Some(texture) = texture {
            texture.draw(&painter, &place, Color32::WHITE);
        }
        other_size::paint_marks(&painter, cx, &place, size);
        show_texts(ui, &painter, cx, &[(layer, Slot::SecondLayer, place.view)], true, None, &mut self.notes);
        other_size::pixel_under_pointer(ui, &place, size)
    }

    /// Shows one view. Returns the pixel of the view under the pointer.
    fn show_view(
        &mut self,
        ui: &mut Ui,
        cx: &mut PanelContext,
        settings: &mut ImageSettings,
        place: Placement,
        slot: Slot,
    ) -> Option<PixelIndex> {
        self.place = Some(place);
        let name = if slot == Slot::Layer { "Picture" } else { "Second picture" };
        let response = ui.interact(place.view, ui.scope_id().with(name), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
        // The instant at the debugger's cursor takes the whole view.
        let is_wiped = cx.state.followed().is_none();
        let wipe_x = if is_wiped { self.show_wipe_handle(ui, settings, &place) } else { None };
        let layer = if slot == Slot::SecondLayer { settings.other } else { settings.layer };
        let layer = wipe_x.filter(|&x| pointer_is_right_of(ui, x)).map_or(layer, |_| settings.other);
        let context = PointerContext { response: &response, place, layer };
        self.tool_state.handle_pointer(ui, &context, cx, settings);
        navigate(ui, &response, &place, settings);
        self.paint_view(ui, cx, &context, settings, slot, wipe_x);
        if let (Some(encoding), Some(picture)) = (self.notes.take_wanted_encoding(), &cx.state.picture) {
            cx.send(JobCommand::ReadAs(ReadOptions { encoding, ..picture.reading }));
        }
        // A text over the picture does not hide the pixel below.
        if response.secondary_clicked() {
            let pointer = ui.ctx().pointer_latest_pos();
            self.menu_pixel = pointer.and_then(|pointer| place.pixel_at(pointer));
        }
        if let Some(pixel) = self.menu_pixel {
            popup_scroll::context_menu(&response, |ui| context_menu::of_pixel(ui, cx, pixel));
        }
        let pointer = ui.ctx().pointer_hover_pos().filter(|_| ui.rect_contains_pointer(place.view));
        pointer.and_then(|pointer| place.pixel_at(pointer))
    }

    /// Shows the line between two layers, which can be dragged; returns the horizontal position of the line, screen points.
    fn show_wipe_handle(&self, ui: &Ui, settings: &mut ImageSettings, place: &Placement) -> Option<f32> {
        let Arrangement::Wipe(share) = settings.arrangement else { return None };
        let view = place.view;
        let on_screen = |share: f32| {
            place.screen_from_image(pos2(share * place.size.x, 0.0)).x.clamp(view.left(), view.right())
        };
        let x = on_screen(share);
        let handle_rect = Rect::from_x_y_ranges(x - HANDLE_PT..=x + HANDLE_PT, view.y_range());
        let sense = if self.tool_state.is_busy() { Sense::hover() } else { Sense::drag() };
        let handle = ui.interact(handle_rect, ui.scope_id().with("wipe"), sense);
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
}

/// Whether the pointer is at a horizontal position or to the right of it, screen points.
fn pointer_is_right_of(ui: &Ui, x: f32) -> bool {
    ui.input(|input| input.pointer.interact_pos()).is_some_and(|pointer| pointer.x >= x)
}

/// Shows, while no photograph is open, a hint or the progress of reading.
fn nothing_open(ui: &mut Ui, cx: &mut PanelContext) {
    match &cx.state.jobs.reading {
        Some(job) if job.since.elapsed() >= PROGRESS_DELAY => {
            widgets::placeholder(ui, cx.palette, "Reading the photograph\u{2026}");
        }
        Some(job) => ui.ctx().request_repaint_after(PROGRESS_DELAY.saturating_sub(job.since.elapsed())),
        None => start::show(ui, cx),
    }
}
