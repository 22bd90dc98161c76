//! Clicks and drags in the picture: selecting, marking, the profile's line and the white patch.

use super::geometry::Placement;
use super::icons::{corners, dashed};
use super::overlay::MARK;
use crate::app::{Combine, Command, Edit, Gesture, Question, Severity, State, ViewCommand};
use crate::gui::PanelContext;
use crate::raster::{Mask, PixelIndex};
use crate::view::marking::{brush, outline, rectangle};
use crate::view::{ImageSettings, Item, Layer, ProfileLine, Tool};
use egui::{
    Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Rect, Response, Stroke, Ui, pos2,
};
use std::sync::Arc;

/// Distance within which the pointer is on a handle or a first corner, screen points.
const GRASP_PT: f32 = 8.0;
/// A drag shorter than this is a click, screen points.
const STILL_PT: f32 = 3.0;

/// A gesture in progress, in pixels of the picture.
#[derive(Clone, Debug, Default, PartialEq)]
enum Draft {
    #[default]
    None,
    /// Space and drag.
    Pan,
    Rectangle(Pos2),
    Lasso(Vec<Pos2>),
    Polygon(Vec<Pos2>),
    /// Where the brush was last.
    Brush(Pos2),
    /// The end of the profile line that stays.
    Profile(Pos2),
}

/// The state of the tool.
#[derive(Default)]
pub struct ToolState {
    draft: Draft,
    tool: Tool,
    /// The pointer, in pixels of the picture.
    at: Pos2,
}

/// The view under the pointer.
pub struct PointerContext<'a> {
    /// The view.
    pub response: &'a Response,
    /// The picture's place in it.
    pub place: Placement,
    /// The layer under the pointer.
    pub layer: Layer,
}

impl ToolState {
    /// Cancels the gesture in progress.
    pub fn give_up(&mut self) {
        self.draft = Draft::None;
    }

    /// Whether a gesture is in progress.
    pub fn is_busy(&self) -> bool {
        self.draft != Draft::None
    }

    /// Follows the pointer in one view.
    pub fn act(
        &mut self,
        ui: &Ui,
        spot: &PointerContext,
        cx: &mut PanelContext,
        settings: &mut ImageSettings,
    ) {
        if self.tool != settings.tool {
            (self.draft, self.tool) = (Draft::None, settings.tool);
        }
        let PointerContext { response, place, .. } = spot;
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
        let held = response.is_pointer_button_down_on();
        if let Some(pointer) = pointer.filter(|_| held || response.hovered()) {
            self.at = place.image_from_screen(pointer);
        }
        if pressed && held && space {
            self.draft = Draft::Pan;
        }
        let primary = response.dragged_by(PointerButton::Primary);
        let pans = self.draft == Draft::Pan || (self.tool == Tool::Pointer && !space);
        if response.dragged_by(PointerButton::Middle) || (primary && pans) {
            place.panned(response.drag_delta()).put(settings);
            ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
            return;
        }
        if self.draft == Draft::Pan {
            if released {
                self.draft = Draft::None;
            }
            return;
        }
        if response.hovered() && self.tool != Tool::Pointer {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        match self.tool {
            Tool::Pointer => point(spot, cx, settings, modifiers),
            Tool::Polygon => self.polygon(ui, spot, cx, modifiers),
            _ => {
                if pressed && held {
                    self.begin(place, cx, modifiers, settings.brush_px);
                } else if held {
                    self.go_on(place, cx, modifiers, settings.brush_px);
                }
                if released && (held || response.drag_stopped() || response.clicked()) {
                    self.end(place, cx, modifiers);
                }
            }
        }
    }

    fn begin(&mut self, place: &Placement, cx: &mut PanelContext, modifiers: Modifiers, radius_px: f32) {
        let at = self.at;
        match self.tool {
            Tool::Rectangle | Tool::WhitePatch => self.draft = Draft::Rectangle(at),
            Tool::Lasso => self.draft = Draft::Lasso(vec![at]),
            Tool::Brush => {
                self.draft = Draft::Brush(at);
                let mask = brush(size(place), &[at.into()], radius_px);
                cx.send(Edit::Mark(Arc::new(mask), combine(modifiers), Some(Gesture::Brush)));
            }
            Tool::Profile => {
                let near = |end: &[f32; 2]| (pos2(end[0], end[1]) - at).length() * place.zoom < GRASP_PT;
                let stays = match cx.state.view.profile {
                    ProfileLine::Between(a, b) if near(&a) => b.into(),
                    ProfileLine::Between(a, b) if near(&b) => a.into(),
                    _ => within(at, place),
                };
                self.draft = Draft::Profile(stays);
            }
            Tool::Pointer | Tool::Polygon => {}
        }
    }

    fn go_on(&mut self, place: &Placement, cx: &mut PanelContext, modifiers: Modifiers, radius_px: f32) {
        let at = self.at;
        match &mut self.draft {
            Draft::Lasso(path) => {
                let far = path.last().is_none_or(|last| (*last - at).length() * place.zoom >= 1.5);
                if far {
                    path.push(at);
                }
            }
            Draft::Brush(last) if *last != at => {
                let mask = brush(size(place), &[(*last).into(), at.into()], radius_px);
                *last = at;
                // A stroke that replaces the marks does so with its first sample.
                let combine = if modifiers.alt { Combine::Subtract } else { Combine::Union };
                cx.send(Edit::Mark(Arc::new(mask), combine, Some(Gesture::Brush)));
            }
            Draft::Profile(stays) => {
                let stays = *stays;
                let end = within(if modifiers.shift { straight(stays, at) } else { at }, place);
                let line = ProfileLine::Between(stays.into(), end.into());
                if end != stays && line != cx.state.view.profile {
                    cx.send(ViewCommand::Profile(line));
                }
            }
            _ => {}
        }
    }

    fn end(&mut self, place: &Placement, cx: &mut PanelContext, modifiers: Modifiers) {
        let at = self.at;
        match std::mem::take(&mut self.draft) {
            Draft::Rectangle(from) => {
                let mask = rectangle(size(place), from.into(), at.into());
                let still = (from - at).abs().max_elem() * place.zoom < STILL_PT;
                match (self.tool, still) {
                    (Tool::WhitePatch, false) => pin(cx, &mask),
                    (Tool::WhitePatch, true) => {}
                    (_, false) => mark(cx, mask, modifiers),
                    (_, true) => unmark(cx, modifiers),
                }
            }
            Draft::Lasso(path) if path.len() > 2 => mark(cx, outline(size(place), &arrays(&path)), modifiers),
            Draft::Lasso(_) => unmark(cx, modifiers),
            Draft::Brush(_) => cx.send(Edit::EndGesture),
            _ => {}
        }
    }

    fn polygon(&mut self, ui: &Ui, spot: &PointerContext, cx: &mut PanelContext, modifiers: Modifiers) {
        let (response, place) = (spot.response, &spot.place);
        let at = self.at;
        let mut closes = ui.input(|input| input.key_pressed(Key::Enter));
        if response.clicked_by(PointerButton::Primary) {
            if let Draft::Polygon(path) = &mut self.draft {
                let first = (path[0] - at).length() * place.zoom < GRASP_PT;
                closes |= response.double_clicked_by(PointerButton::Primary) || (first && path.len() > 2);
                if !closes {
                    path.push(at);
                }
            } else {
                self.draft = Draft::Polygon(vec![at]);
            }
        }
        if !closes {
            return;
        }
        match std::mem::take(&mut self.draft) {
            Draft::Polygon(path) if path.len() > 2 => {
                mark(cx, outline(size(place), &arrays(&path)), modifiers);
            }
            _ => {}
        }
    }

    /// Draws the gesture in progress, and the brush at the pointer.
    pub fn draw(&self, painter: &Painter, place: &Placement, brush_px: Option<f32>) {
        let to_screen = |points: &[Pos2]| -> Vec<Pos2> {
            points.iter().map(|&point| place.screen_from_image(point)).collect()
        };
        match &self.draft {
            Draft::Rectangle(from) => {
                let area = place.screen_rect_of(Rect::from_two_pos(*from, self.at));
                painter.rect_filled(area, 0.0, MARK.gamma_multiply(0.12));
                dashed(painter, &corners(area), MARK);
            }
            Draft::Lasso(path) | Draft::Polygon(path) => {
                let mut points = to_screen(path);
                points.push(place.screen_from_image(self.at));
                if matches!(self.draft, Draft::Polygon(_)) {
                    for &corner in &points[..points.len() - 1] {
                        painter.circle_filled(corner, 2.5, MARK);
                    }
                    painter.circle_stroke(points[0], GRASP_PT, Stroke::new(1.0, MARK));
                } else {
                    points.push(points[0]);
                }
                dashed(painter, &points, MARK);
            }
            _ => {}
        }
        if let Some(radius_px) = brush_px {
            let center = place.screen_from_image(self.at);
            let radius = (radius_px * place.zoom).max(1.5);
            painter.circle_stroke(center, radius, Stroke::new(2.6, Color32::from_black_alpha(140)));
            painter.circle_stroke(center, radius, Stroke::new(1.2, MARK));
        }
    }
}

/// Selects on a click, and fits the picture on a double click.
fn point(spot: &PointerContext, cx: &mut PanelContext, settings: &mut ImageSettings, modifiers: Modifiers) {
    let response = spot.response;
    if response.double_clicked_by(PointerButton::Primary) {
        (settings.zoom, settings.center_px) = (None, None);
    } else if response.clicked_by(PointerButton::Primary) {
        let pixel = response.interact_pointer_pos().and_then(|at| spot.place.pixel_at(at));
        let item = pixel.and_then(|pixel| item_at(cx.state, spot.layer, pixel, modifiers.alt));
        if item != cx.state.document.selection.item {
            cx.send(Edit::Select(item));
        }
        cx.out.extend(pixel.map(|pixel| Command::Ask(Question::Why(pixel))));
    }
}

/// The item that a click on a pixel selects.
fn item_at(state: &State, layer: Layer, pixel: PixelIndex, the_pixel: bool) -> Option<Item> {
    if the_pixel {
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

/// How new marks combine with those before, by the modifier keys.
fn combine(modifiers: Modifiers) -> Combine {
    match (modifiers.shift, modifiers.alt) {
        (_, true) => Combine::Subtract,
        (true, false) => Combine::Union,
        (false, false) => Combine::Replace,
    }
}

fn mark(cx: &mut PanelContext, mask: Mask, modifiers: Modifiers) {
    cx.send(Edit::Mark(Arc::new(mask), combine(modifiers), None));
}

/// Clears the marks after a click that draws nothing.
fn unmark(cx: &mut PanelContext, modifiers: Modifiers) {
    if let Some(marked) = &cx.state.document.selection.marked
        && combine(modifiers) == Combine::Replace
    {
        let nothing = Mask::filled(marked.width(), marked.height(), false);
        cx.send(Edit::Mark(Arc::new(nothing), Combine::Replace, None));
    }
}

/// Pins the light's color to the mean of the reliable pixels.
fn pin(cx: &mut PanelContext, mask: &Mask) {
    let command: Command = match mean_direction(cx.state, mask) {
        Some(direction) => Edit::PinIlluminant(Some(direction), None).into(),
        None => ViewCommand::Notify(
            Severity::Warning,
            "white patch: all its pixels are clipped, black or hold no value; outline a darker part"
                .to_owned(),
        )
        .into(),
    };
    cx.send(command);
}

fn mean_direction(state: &State, mask: &Mask) -> Option<[f64; 3]> {
    let image = &state.picture.as_ref()?.photo.image;
    let masks = state.newest.as_ref().map(|shown| &shown.analysis.masks);
    let full = image.saturation.unwrap_or(f32::INFINITY);
    let usable = |pixel: usize, color: &[f32; 3]| match masks {
        Some(masks) => !masks.distorted(pixel) && !masks.invalid(pixel),
        None => !image.invalid[pixel] && color.iter().all(|&band| band < full),
    };
    let mut sum = [0.0f64; 3];
    for (pixel, color) in image.pixels.as_slice().iter().enumerate() {
        if mask[pixel] && usable(pixel, color) {
            for (sum, &band) in sum.iter_mut().zip(color) {
                *sum += f64::from(band);
            }
        }
    }
    let length = sum.iter().map(|band| band * band).sum::<f64>().sqrt();
    (length > 0.0).then(|| sum.map(|band| band / length))
}

/// The point on the row or column of `from` that is nearest to `to`.
fn straight(from: Pos2, to: Pos2) -> Pos2 {
    if (to.x - from.x).abs() >= (to.y - from.y).abs() { pos2(to.x, from.y) } else { pos2(from.x, to.y) }
}

fn within(point: Pos2, place: &Placement) -> Pos2 {
    point.clamp(Pos2::ZERO, place.size.to_pos2())
}

fn size(place: &Placement) -> (usize, usize) {
    (place.size.x as usize, place.size.y as usize)
}

fn arrays(points: &[Pos2]) -> Vec<[f32; 2]> {
    points.iter().map(|&point| point.into()).collect()
}
