//! The camera of the color space panel, moved by pointer, keys and named views.

use crate::app::State;
use crate::gpu::shapes::cube_edges;
use crate::gpu::{Orbit, Projection};
use crate::gui::cube_choices::NamedView;
use crate::gui::keyboard_focus::is_keyboard_owned;
use crate::view::ColorSpace;
use egui::{Event, Key, PointerButton, Rect, Response, Ui};

/// Margin for the axes' labels beside and above the framed cube, points; limited to `MARGIN_SHARE` of the view.
const MARGIN_PT: [f32; 2] = [64.0, 30.0];
const MARGIN_SHARE: f32 = 0.14;
/// Length of the drag that has the same effect as one press of an arrow key, points.
const KEY_STEP_PT: f32 = 18.0;
/// Zoom factor of one press of + or −.
const KEY_ZOOM: f32 = 1.15;
/// Scroll distance that zooms by the factor e, points.
const SCROLL_PT: f32 = 260.0;

/// A dichromatic plane in the RGB cube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal: body × surface.
    pub normal: [f32; 3],
    /// Unit body vector.
    pub body: [f32; 3],
}

impl Plane {
    /// The plane of the selected region; `None` when the region has no plane or the space is not RGB.
    pub fn of(state: &State) -> Option<Self> {
        let region = state.selected_region()?;
        let region = state.shown()?.analysis.intrinsic.regions.get(region.index())?;
        let normal = region.plane_normal.filter(|_| state.view.cube.space == ColorSpace::Rgb)?;
        Some(Self { normal: normal.map(|v| v as f32), body: region.body.map(|v| v as f32) })
    }
}

/// The camera, and whether a person, the frame of the view or a selected plane has placed the camera.
#[derive(Clone, Default)]
pub struct CameraController {
    /// Place and direction of the camera.
    pub orbit: Orbit,
    /// Points to be seen when the space is framed, world units; the corners of the unit cube if empty.
    content: Vec<[f32; 3]>,
    /// Size of the view for which the space was framed, points.
    framed_size: Option<[f32; 2]>,
    /// Whether the user has moved the camera since the space was framed.
    moved_by_user: bool,
    /// The view of the plane, which follows the selection until the user turns the camera.
    followed_view: Option<NamedView>,
    followed_plane: Option<Plane>,
}

impl CameraController {
    /// Restores a camera that the user chose earlier.
    pub fn set_orbit(&mut self, orbit: Orbit) {
        (self.orbit, self.moved_by_user) = (orbit.checked(), true);
    }

    /// Frames the whole space when the view's size has changed, unless the user has moved the camera.
    pub fn frame_if_resized(&mut self, size: [f32; 2]) {
        if !self.moved_by_user && self.framed_size != Some(size) {
            self.frame(size);
        }
    }

    /// Sets the points of another space that are to be seen; the next frame frames them, unless the user has
    /// moved the camera.
    pub fn set_content(&mut self, content: Vec<[f32; 3]>) {
        self.content = content;
        self.framed_size = None;
    }

    /// Moves the camera to a named view. Views of a plane have no effect without one.
    pub fn go_to_view(&mut self, named_view: NamedView, plane: Option<Plane>, size: [f32; 2]) {
        match (named_view, plane) {
            (NamedView::Along(preset), _) => {
                self.orbit.preset(preset);
                self.followed_view = None;
            }
            (NamedView::FaceOn | NamedView::EdgeOn, Some(plane)) => {
                self.turn_to(named_view, plane);
                (self.followed_view, self.followed_plane) = (Some(named_view), Some(plane));
            }
            (_, None) => return,
        }
        self.frame(size);
    }

    /// Turns the camera to the plane of a newly selected region, unless the view is locked.
    pub fn follow(&mut self, plane: Option<Plane>, locked: bool) {
        if let (Some(named_view), Some(plane), false) = (self.followed_view, plane, locked)
            && self.followed_plane != Some(plane)
        {
            self.turn_to(named_view, plane);
            self.followed_plane = Some(plane);
        }
    }

    /// Turns the camera to a view of a plane.
    fn turn_to(&mut self, named_view: NamedView, Plane { normal, body }: Plane) {
        // The body vector points to the right and the light's color up, as in the plane panel.
        let inward = cross(normal, body);
        if named_view == NamedView::FaceOn {
            self.orbit.face(normal, inward);
        } else {
            self.orbit.edge_on(normal, body);
        }
    }

    /// Moves and scales the space to the middle of the view, as large as the margins allow.
    fn frame(&mut self, size: [f32; 2]) {
        self.moved_by_user = false;
        // A view that was not shown yet has no size, and is framed when it is shown.
        self.framed_size = size.iter().all(|&length| length > 0.0).then_some(size);
        if self.framed_size.is_none() {
            return;
        }
        self.orbit.fit(size[0] / size[1].max(1.0));
        let middle = size.map(|length| 0.5 * length);
        // A moved space has a slightly different perspective, so the step is repeated.
        for _ in 0..3 {
            let projector = self.orbit.projector(size);
            let cube = cube_edges().into_iter().flatten().filter(|_| self.content.is_empty());
            let mut bounds = Rect::NOTHING;
            cube.chain(self.content.iter().copied())
                .filter_map(|corner| projector.screen_from_world(corner))
                .for_each(|corner| bounds.extend_with(corner.at.into()));
            if !bounds.is_positive() {
                return;
            }
            let free = |axis: usize| size[axis] - 2.0 * MARGIN_PT[axis].min(MARGIN_SHARE * size[axis]);
            let center = bounds.center();
            self.orbit.pan([middle[0] - center.x, middle[1] - center.y], size[1]);
            let factor = (free(0) / bounds.width()).min(free(1) / bounds.height());
            self.orbit.zoom_at(factor, middle, size);
        }
    }

    /// Switches between perspective and orthographic projection.
    pub fn toggle_projection(&mut self) {
        self.orbit.projection = match self.orbit.projection {
            Projection::Perspective => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective,
        };
    }

    /// Turns, moves and zooms the camera by pointer and keys. `orbits`: whether a drag with the primary button turns
    /// the camera, which it does while the pointer tool is chosen.
    pub fn handle_input(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        orbits: bool,
        plane: Option<Plane>,
    ) {
        let size = [rect.width(), rect.height()];
        let before = self.orbit;
        let takes_keys = (response.hovered() || response.has_focus()) && !is_keyboard_owned(ui.ctx());
        let keys = if takes_keys { pressed(ui) } else { Vec::new() };
        self.handle_pointer(ui, response, rect, orbits);
        for &key in &keys {
            self.handle_key(key, size);
        }
        self.moved_by_user |= self.orbit != before;
        let named = keys.iter().find_map(|key| NamedView::ALL.into_iter().find(|(_, of, ..)| of == key));
        let reset = (response.double_clicked() && orbits).then_some(NamedView::ALL[0]);
        if let Some((named_view, ..)) = named.or(reset) {
            self.go_to_view(named_view, plane, size);
        }
    }

    /// Turns, moves and zooms the camera by the pointer.
    fn handle_pointer(&mut self, ui: &Ui, response: &Response, rect: Rect, orbits: bool) {
        let size = [rect.width(), rect.height()];
        let delta = response.drag_delta();
        let shift = ui.input(|input| input.modifiers.shift);
        let primary = response.dragged_by(PointerButton::Primary) && orbits;
        let other_button =
            response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Secondary);
        if other_button || (primary && shift) {
            self.orbit.pan(delta.into(), size[1]);
        } else if primary && delta != egui::Vec2::ZERO {
            self.orbit.orbit(delta.into());
            self.followed_view = None;
        }
        if let Some(pointer) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = (scroll / SCROLL_PT).exp() * pinch;
            if (factor - 1.0).abs() > 1e-6 {
                self.orbit.zoom_at(factor, (pointer - rect.min).into(), size);
            }
        }
    }

    /// Turns or zooms the camera by a key.
    fn handle_key(&mut self, key: Key, size: [f32; 2]) {
        let middle = size.map(|length| length / 2.0);
        let step = match key {
            Key::ArrowLeft => [-KEY_STEP_PT, 0.0],
            Key::ArrowRight => [KEY_STEP_PT, 0.0],
            Key::ArrowUp => [0.0, -KEY_STEP_PT],
            Key::ArrowDown => [0.0, KEY_STEP_PT],
            Key::Plus | Key::Equals => return self.orbit.zoom_at(KEY_ZOOM, middle, size),
            Key::Minus => return self.orbit.zoom_at(1.0 / KEY_ZOOM, middle, size),
            Key::M => return self.toggle_projection(),
            _ => return,
        };
        self.orbit.orbit(step);
        self.followed_view = None;
    }
}

/// Keys pressed in this frame without modifiers or with Shift.
fn pressed(ui: &Ui) -> Vec<Key> {
    let plain = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } if !modifiers.command && !modifiers.alt => {
            Some(*key)
        }
        _ => None,
    };
    ui.input(|input| input.events.iter().filter_map(plain).collect())
}

/// The cross product.
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
