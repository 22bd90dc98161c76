//! Outlines that a person draws over the points of the color space or of the plane: rectangle, lasso, polygon.

use super::keyboard_focus::is_keyboard_owned;
use crate::app::Combine;
use crate::view::Tool;
use egui::{Color32, Key, Painter, PointerButton, Pos2, Rect, Response, Shape, Stroke, Ui};

/// Smallest distance between two corners of a lasso, points.
const STEP_PT: f32 = 2.0;
/// Largest distance between a click and the first corner at which the click closes a polygon, points.
const CLOSE_PT: f32 = 8.0;
const DASH_PT: f32 = 4.0;

/// An outline that is being drawn.
#[derive(Default)]
pub struct Outline {
    corners: Vec<Pos2>,
    tool: Tool,
}

impl Outline {
    /// Whether an outline has at least one corner and is not closed.
    pub fn is_unfinished(&self) -> bool {
        !self.corners.is_empty()
    }

    /// Adds corners as the pointer moves and clicks. Returns the closed outline in the frame in which the outline is finished.
    pub fn handle_pointer(&mut self, ui: &Ui, response: &Response, tool: Tool) -> Option<Vec<Pos2>> {
        if tool != self.tool {
            self.corners.clear();
            self.tool = tool;
        }
        match tool {
            Tool::Rectangle | Tool::Lasso => self.drag(response, tool),
            Tool::Polygon => self.click(ui, response),
            _ => None,
        }
    }

    /// Adds corners to a rectangle or lasso; returns the outline when the drag ends.
    fn drag(&mut self, response: &Response, tool: Tool) -> Option<Vec<Pos2>> {
        let at = response.interact_pointer_pos();
        if response.drag_started_by(PointerButton::Primary) {
            self.corners = at.map(|at| at - response.drag_delta()).into_iter().collect();
        }
        if response.dragged_by(PointerButton::Primary)
            && let (Some(at), Some(&last)) = (at, self.corners.last())
        {
            if tool == Tool::Rectangle {
                self.corners.truncate(1);
                self.corners.push(at);
            } else if last.distance(at) >= STEP_PT {
                self.corners.push(at);
            }
        }
        response.drag_stopped_by(PointerButton::Primary).then(|| self.take())
    }

    /// Adds a corner to a polygon at a click; returns the polygon when it is closed.
    fn click(&mut self, ui: &Ui, response: &Response) -> Option<Vec<Pos2>> {
        let enter = !is_keyboard_owned(ui.ctx()) && ui.input(|input| input.key_pressed(Key::Enter));
        let clicked = response.interact_pointer_pos().filter(|_| response.clicked());
        let near = |a: Pos2, b: Option<&Pos2>| b.is_some_and(|b| a.distance(*b) < CLOSE_PT);
        let closes = clicked.is_some_and(|at| self.corners.len() > 2 && near(at, self.corners.first()));
        if let Some(at) = clicked.filter(|at| !closes && !near(*at, self.corners.last())) {
            self.corners.push(at);
        }
        let done = closes || response.double_clicked() || enter;
        (done && self.corners.len() > 2).then(|| self.take())
    }

    /// Ends the outline and returns its corners.
    fn take(&mut self) -> Vec<Pos2> {
        let closed = self.closed(None);
        self.corners.clear();
        closed
    }

    /// All corners in order: the four of a rectangle, or those of a lasso or polygon followed by `next`.
    fn closed(&self, next: Option<Pos2>) -> Vec<Pos2> {
        match (self.tool, self.corners.as_slice()) {
            (Tool::Rectangle, &[from, to]) => {
                let rect = Rect::from_two_pos(from, to);
                vec![rect.left_top(), rect.right_top(), rect.right_bottom(), rect.left_bottom()]
            }
            (_, corners) => corners.iter().copied().chain(next).collect(),
        }
    }

    /// Paints the unfinished outline as a dashed line.
    pub fn paint(&self, painter: &Painter, response: &Response, accent: Color32) {
        if self.corners.is_empty() {
            return;
        }
        let next = response.hover_pos().filter(|_| self.tool == Tool::Polygon);
        let mut path = self.closed(next);
        path.extend(path.first().copied());
        let stroke = Stroke::new(1.5, accent);
        painter.extend(Shape::dashed_line(&path, stroke, DASH_PT, DASH_PT));
        if self.tool == Tool::Polygon {
            self.corners.iter().for_each(|corner| {
                painter.circle_filled(*corner, 2.5, accent);
            });
        }
    }
}

/// How newly marked pixels combine with those marked before, by the modifier keys: Shift adds, Alt takes away.
pub fn combine_by_keys(ui: &Ui) -> Combine {
    ui.input(|input| match input.modifiers {
        egui::Modifiers { alt: true, .. } => Combine::Subtract,
        egui::Modifiers { shift: true, .. } => Combine::Union,
        _ => Combine::Replace,
    })
}
