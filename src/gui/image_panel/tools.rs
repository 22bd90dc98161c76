//! Clicks and drags in the picture: selecting, marking, the profile's line and the white patch.

use super::geometry::Placement;
use super::icons::{corners, dashed};
use super::overlay::MARK_COLOR;
use super::white_patch;
use crate::app::{Combine, Command, Edit, Gesture, Question, State, ViewCommand};
use crate::gui::PanelContext;
use crate::gui::keyboard_focus::is_keyboard_owned;
use crate::raster::{Mask, PixelIndex};
use crate::view::marking::{brush, outline, rectangle};
use crate::view::{ImageSettings, Item, Layer, ProfileLine, Tool};
use egui::{
    Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Rect, Response, Stroke, Ui, pos2,
};
use std::sync::Arc;

/// Distance within which the pointer is on a handle or a first corner, screen points.
const HANDLE_RADIUS_PT: f32 = 8.0;
/// A drag shorter than this is a click, screen points.
const CLICK_TOLERANCE_PT: f32 = 3.0;

/// A gesture in progress, in pixels of the picture.
#[derive(Clone, Debug, Default, PartialEq)]
enum PendingGesture {
    /// No gesture.
    #[default]
    None,
    /// Moving the picture: a drag while Space is held.
    Pan,
    /// Drawing a rectangle, with the corner where the drag began.
    Rectangle(Pos2),
    /// Drawing a free outline, with the corners so far.
    Lasso(Vec<Pos2>),
    /// Drawing a polygon, with the corners so far.
    Polygon(Vec<Pos2>),
    /// Painting, with the position of the brush in the last frame.
    Brush(Pos2),
    /// Moving one end of the profile's line, with the other end.
    Profile(Pos2),
}

/// The tool, and the gesture in progress.
#[derive(Default)]
pub struct ToolState {
    gesture: PendingGesture,
    tool: Tool,
    /// The pointer, in pixels of the picture.
    pointer_px: Pos2,
}

/// The view under the pointer.
pub struct PointerContext<'a> {
    /// The response of the view's widget.
    pub response: &'a Response,
    /// The picture's place in the view.
    pub place: Placement,
    /// The layer under the pointer.
    pub layer: Layer,
}

impl ToolState {
    /// Cancels the gesture in progress.
    pub fn cancel(&mut self) {
        self.gesture = PendingGesture::None;
    }

    /// Whether a gesture is in progress.
    pub fn is_busy(&self) -> bool {
        self.gesture != PendingGesture::None
    }

    /// Handles the pointer in one view: begins, continues and ends gestures, and sends their commands.
    pub fn handle_pointer(
        &mut self,
        ui: &Ui,
        context: &PointerContext,
        cx: &mut PanelContext,
        settings: &mut ImageSettings,
    ) {
        if self.tool != settings.tool {
            (self.gesture, self.tool) = (PendingGesture::None, settings.tool);
        }
        let PointerContext { response, place, .. } = context;
        let (pointer, modifiers, pressed, released, space) = ui.input(|input| {
            let pointer = &input.pointer;
            let space = input.key_down(Key::Space);
            (
                pointer.interact_pos(),
                input.modifiers,
                pointer.primary_pressed(),
                pointer.any_released(),
                space,
            )
        });
        let is_pressed_here = response.is_pointer_button_down_on();
        // A tap is a press and its release within one frame: the button is up again when the frame is drawn.
        let is_begun = pressed && (is_pressed_here || response.clicked_by(PointerButton::Primary));
        if let Some(pointer) = pointer.filter(|_| is_pressed_here || response.hovered()) {
            self.pointer_px = place.image_from_screen(pointer);
        }
        if is_begun && space {
            self.gesture = PendingGesture::Pan;
        }
        let primary = response.dragged_by(PointerButton::Primary);
        let pans = self.gesture == PendingGesture::Pan || (self.tool == Tool::Pointer && !space);
        if response.dragged_by(PointerButton::Middle) || (primary && pans) {
            place.panned(response.drag_delta()).store(settings);
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return;
        }
        if self.gesture == PendingGesture::Pan {
            if released {
                self.gesture = PendingGesture::None;
            }
            return;
        }
        if response.hovered() && self.tool != Tool::Pointer {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        match self.tool {
            Tool::Pointer => select_by_click(context, cx, settings, modifiers),
            Tool::Polygon => self.extend_polygon(ui, context, cx, modifiers),
            _ => {
                if is_begun {
                    self.begin_drag(place, cx, modifiers, settings.brush_px);
                } else if is_pressed_here {
                    self.continue_drag(place, cx, modifiers, settings.brush_px);
                }
                // In a slow frame a release is neither a click nor the end of a drag.
                if released && (is_pressed_here || response.drag_stopped() || response.hovered()) {
                    self.end_drag(place, cx, modifiers);
                }
            }
        }
    }

    /// Begins the gesture of the tool at the pointer.
    fn begin_drag(&mut self, place: &Placement, cx: &mut PanelContext, modifiers: Modifiers, radius_px: f32) {
        let pointer_px = self.pointer_px;
        match self.tool {
            Tool::Rectangle | Tool::WhitePatch => self.gesture = PendingGesture::Rectangle(pointer_px),
            Tool::Lasso => self.gesture = PendingGesture::Lasso(vec![pointer_px]),
            Tool::Brush => {
                self.gesture = PendingGesture::Brush(pointer_px);
                let mask = brush(picture_size(place), &[pointer_px.into()], radius_px);
                cx.send(Edit::Mark(Arc::new(mask), combine_by_keys(modifiers), Some(Gesture::Brush)));
            }
            Tool::Profile => {
                let near = |end: &[f32; 2]| {
                    (pos2(end[0], end[1]) - pointer_px).length() * place.zoom < HANDLE_RADIUS_PT
                };
                let fixed_end = match cx.state.view.profile {
                    ProfileLine::Between(a, b) if near(&a) => b.into(),
                    ProfileLine::Between(a, b) if near(&b) => a.into(),
                    _ => clamped_to_picture(pointer_px, place),
                };
                self.gesture = PendingGesture::Profile(fixed_end);
            }
            Tool::Pointer | Tool::Polygon => {}
        }
    }

    /// Continues the gesture to the pointer.
    fn continue_drag(
        &mut self,
        place: &Placement,
        cx: &mut PanelContext,
        modifiers: Modifiers,
        radius_px: f32,
    ) {
        let pointer_px = self.pointer_px;
        match &mut self.gesture {
            PendingGesture::Lasso(path) => {
                let far = path.last().is_none_or(|last| (*last - pointer_px).length() * place.zoom >= 1.5);
                if far {
                    path.push(pointer_px);
                }
            }
            PendingGesture::Brush(last) if *last != pointer_px => {
                let mask = brush(picture_size(place), &[(*last).into(), pointer_px.into()], radius_px);
                *last = pointer_px;
                // The first sample of a stroke has replaced the earlier marks already.
                let combine_by_keys = if modifiers.alt { Combine::Subtract } else { Combine::Union };
                cx.send(Edit::Mark(Arc::new(mask), combine_by_keys, Some(Gesture::Brush)));
            }
            PendingGesture::Profile(fixed_end) => {
                let fixed_end = *fixed_end;
                let end = clamped_to_picture(
                    if modifiers.shift { on_row_or_column(fixed_end, pointer_px) } else { pointer_px },
                    place,
                );
                let line = ProfileLine::Between(fixed_end.into(), end.into());
                if end != fixed_end && line != cx.state.view.profile {
                    cx.send(ViewCommand::Profile(line));
                }
            }
            _ => {}
        }
    }

    /// Ends the gesture at the pointer, and sends its marks.
    fn end_drag(&mut self, place: &Placement, cx: &mut PanelContext, modifiers: Modifiers) {
        let pointer_px = self.pointer_px;
        match std::mem::take(&mut self.gesture) {
            PendingGesture::Rectangle(from) => {
                let size = picture_size(place);
                let mask = rectangle(size, from.into(), pointer_px.into());
                let is_click = (from - pointer_px).abs().max_elem() * place.zoom < CLICK_TOLERANCE_PT;
                match (self.tool, is_click) {
                    (Tool::WhitePatch, false) => white_patch::pin_lamp(cx, &mask, modifiers.shift),
                    (Tool::WhitePatch, true) => {
                        white_patch::pin_lamp(cx, &white_patch::around(size, pointer_px), modifiers.shift);
                    }
                    (_, false) => send_mark(cx, mask, modifiers),
                    (_, true) => clear_marks(cx, modifiers),
                }
            }
            PendingGesture::Lasso(path) if path.len() > 2 => {
                send_mark(cx, outline(picture_size(place), &as_arrays(&path)), modifiers);
            }
            PendingGesture::Lasso(_) => clear_marks(cx, modifiers),
            PendingGesture::Brush(_) => cx.send(Edit::EndGesture(Gesture::Brush)),
            _ => {}
        }
    }

    /// Adds a corner to the polygon at a click; marks the polygon at a double click, a click on the first corner, or Enter.
    fn extend_polygon(
        &mut self,
        ui: &Ui,
        context: &PointerContext,
        cx: &mut PanelContext,
        modifiers: Modifiers,
    ) {
        let (response, place) = (context.response, &context.place);
        let pointer_px = self.pointer_px;
        let mut is_closed = !is_keyboard_owned(ui.ctx()) && ui.input(|input| input.key_pressed(Key::Enter));
        if response.clicked_by(PointerButton::Primary) {
            if let PendingGesture::Polygon(path) = &mut self.gesture {
                let first = (path[0] - pointer_px).length() * place.zoom < HANDLE_RADIUS_PT;
                is_closed |= response.double_clicked_by(PointerButton::Primary) || (first && path.len() > 2);
                if !is_closed {
                    path.push(pointer_px);
                }
            } else {
                self.gesture = PendingGesture::Polygon(vec![pointer_px]);
            }
        }
        if !is_closed {
            return;
        }
        match std::mem::take(&mut self.gesture) {
            PendingGesture::Polygon(path) if path.len() > 2 => {
                send_mark(cx, outline(picture_size(place), &as_arrays(&path)), modifiers);
            }
            _ => {}
        }
    }

    /// Draws the gesture in progress, and the brush at the pointer.
    pub fn draw(&self, painter: &Painter, place: &Placement, brush_px: Option<f32>) {
        let to_screen = |points: &[Pos2]| -> Vec<Pos2> {
            points.iter().map(|&point| place.screen_from_image(point)).collect()
        };
        match &self.gesture {
            PendingGesture::Rectangle(from) => {
                let area = place.screen_rect_of(Rect::from_two_pos(*from, self.pointer_px));
                painter.rect_filled(area, 0.0, MARK_COLOR.gamma_multiply(0.12));
                dashed(painter, &corners(area), MARK_COLOR);
            }
            PendingGesture::Lasso(path) | PendingGesture::Polygon(path) => {
                let mut points = to_screen(path);
                points.push(place.screen_from_image(self.pointer_px));
                if matches!(self.gesture, PendingGesture::Polygon(_)) {
                    for &corner in &points[..points.len() - 1] {
                        painter.circle_filled(corner, 2.5, MARK_COLOR);
                    }
                    painter.circle_stroke(points[0], HANDLE_RADIUS_PT, Stroke::new(1.0, MARK_COLOR));
                } else {
                    points.push(points[0]);
                }
                dashed(painter, &points, MARK_COLOR);
            }
            _ => {}
        }
        if let Some(radius_px) = brush_px {
            let center = place.screen_from_image(self.pointer_px);
            let radius = (radius_px * place.zoom).max(1.5);
            painter.circle_stroke(center, radius, Stroke::new(2.6, Color32::from_black_alpha(140)));
            painter.circle_stroke(center, radius, Stroke::new(1.2, MARK_COLOR));
        }
    }
}

/// Selects on a click, and fits the picture on a double click.
fn select_by_click(
    context: &PointerContext,
    cx: &mut PanelContext,
    settings: &mut ImageSettings,
    modifiers: Modifiers,
) {
    let response = context.response;
    if response.double_clicked_by(PointerButton::Primary) {
        (settings.zoom, settings.center_px) = (None, None);
    } else if response.clicked_by(PointerButton::Primary) {
        let pixel = response.interact_pointer_pos().and_then(|at| context.place.pixel_at(at));
        let item = pixel.and_then(|pixel| item_at(cx.state, context.layer, pixel, modifiers.alt));
        if item != cx.state.document.selection.item {
            cx.send(Edit::Select(item));
        }
        cx.commands.extend(pixel.map(|pixel| Command::Ask(Question::Why(pixel))));
    }
}

/// The item that a click on a pixel selects.
fn item_at(state: &State, layer: Layer, pixel: PixelIndex, exact_pixel: bool) -> Option<Item> {
    if exact_pixel {
        return Some(Item::Pixel(pixel));
    }
    let shown = state.shown()?;
    if layer == Layer::Classes {
        let width = shown.picture.size().0;
        let [x, y] = pixel.position(width).map(|place| place / shown.window_px());
        let class = shown.classes().get(x, y).copied().flatten();
        return class.map(|_| Item::Window((y * shown.classes().width() + x) as u32));
    }
    state.region_of(Item::Pixel(pixel)).map(Item::Region)
}

/// The combination of new marks with earlier marks that the modifier keys choose.
fn combine_by_keys(modifiers: Modifiers) -> Combine {
    match (modifiers.shift, modifiers.alt) {
        (_, true) => Combine::Subtract,
        (true, false) => Combine::Union,
        (false, false) => Combine::Replace,
    }
}

/// Marks the pixels of a mask, combined with earlier marks by the modifier keys.
fn send_mark(cx: &mut PanelContext, mask: Mask, modifiers: Modifiers) {
    cx.send(Edit::Mark(Arc::new(mask), combine_by_keys(modifiers), None));
}

/// Clears the marks after a click that draws nothing.
fn clear_marks(cx: &mut PanelContext, modifiers: Modifiers) {
    if let Some(marked) = &cx.state.document.selection.marked
        && combine_by_keys(modifiers) == Combine::Replace
    {
        let nothing = Mask::filled(marked.width(), marked.height(), false);
        cx.send(Edit::Mark(Arc::new(nothing), Combine::Replace, None));
    }
}

/// The point on the row or column of `from` that is nearest to `to`.
fn on_row_or_column(from: Pos2, to: Pos2) -> Pos2 {
    if (to.x - from.x).abs() >= (to.y - from.y).abs() { pos2(to.x, from.y) } else { pos2(from.x, to.y) }
}

/// The point of the picture that is nearest to a point, pixels.
fn clamped_to_picture(point: Pos2, place: &Placement) -> Pos2 {
    point.clamp(Pos2::ZERO, place.size.to_pos2())
}

/// Columns and rows of the picture.
fn picture_size(place: &Placement) -> (usize, usize) {
    (place.size.x as usize, place.size.y as usize)
}

/// Points as arrays of x and y.
fn as_arrays(points: &[Pos2]) -> Vec<[f32; 2]> {
    points.iter().map(|&point| point.into()).collect()
}
