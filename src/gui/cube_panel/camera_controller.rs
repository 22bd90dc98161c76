//! The camera of the color space panel, moved by pointer, keys and named views.

use crate::app::State;
use crate::gpu::shapes::cube_edges;
use crate::gpu::{Orbit, Preset, Projection};
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

/// The views that a menu offers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// Along a named direction.
    Along(Preset),
    /// Onto the selected region's dichromatic plane.
    FaceOn,
    /// Along the selected region's dichromatic plane.
    EdgeOn,
}

impl Sight {
    /// All views with key, name and tooltip.
    pub const ALL: [(Self, Key, &'static str, &'static str); 7] = [
        (Self::Along(Preset::Home), Key::Home, "Home", "The whole cube from the front, blue up."),
        (
            Self::Along(Preset::Red),
            Key::X,
            "Along red",
            "Along the red axis towards black: green against blue.",
        ),
        (Self::Along(Preset::Green), Key::Y, "Along green", "Along the green axis: red against blue."),
        (
            Self::Along(Preset::Blue),
            Key::U,
            "Along blue",
            "Along the blue axis towards black: red against green.",
        ),
        (
            Self::Along(Preset::Gray),
            Key::D,
            "Along the gray diagonal",
            "From white to black: hue and saturation without brightness.",
        ),
        (
            Self::FaceOn,
            Key::S,
            "Face-on to the plane",
            "The selected region's dichromatic plane from the front: the skewed T of figure 2.",
        ),
        (
            Self::EdgeOn,
            Key::E,
            "Edge-on to the plane",
            "Along the selected region's dichromatic plane: how thin its slice is, as in figure 9.",
        ),
    ];
}

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

/// The camera, and how it got to its place.
#[derive(Clone, Default)]
pub struct CameraController {
    /// Place and direction of the camera.
    pub orbit: Orbit,
    /// Points to be seen when the space is framed, world units; the corners of the unit cube if empty.
    whole: Vec<[f32; 3]>,
    /// Size of the view for which the space was framed, points.
    framed: Option<[f32; 2]>,
    /// Whether the user has moved the camera since the space was framed.
    by_hand: bool,
    /// The view of the plane, which follows the selection until the user turns the camera.
    follows: Option<Sight>,
    faced: Option<Plane>,
}

impl CameraController {
    /// Restores a camera that the user chose earlier.
    pub fn place(&mut self, orbit: Orbit) {
        (self.orbit, self.by_hand) = (orbit.checked(), true);
    }

    /// Frames the whole space when the view's size has changed, unless the user has moved the camera.
    pub fn arrive(&mut self, size: [f32; 2]) {
        if !self.by_hand && self.framed != Some(size) {
            self.frame(size);
        }
    }

    /// Sets the points of another space that are to be seen; the next frame frames them, unless the user has moved
    /// the camera.
    pub fn enter(&mut self, whole: Vec<[f32; 3]>) {
        self.whole = whole;
        self.framed = None;
    }

    /// Moves the camera to a named view. Views of a plane have no effect without one.
    pub fn look(&mut self, sight: Sight, plane: Option<Plane>, size: [f32; 2]) {
        match (sight, plane) {
            (Sight::Along(preset), _) => {
                self.orbit.preset(preset);
                self.follows = None;
            }
            (Sight::FaceOn | Sight::EdgeOn, Some(plane)) => {
                self.turn_to(sight, plane);
                (self.follows, self.faced) = (Some(sight), Some(plane));
            }
            (_, None) => return,
        }
        self.frame(size);
    }

    /// Turns the camera to the plane of a newly selected region, unless the view is locked.
    pub fn follow(&mut self, plane: Option<Plane>, locked: bool) {
        if let (Some(sight), Some(plane), false) = (self.follows, plane, locked)
            && self.faced != Some(plane)
        {
            self.turn_to(sight, plane);
            self.faced = Some(plane);
        }
    }

    fn turn_to(&mut self, sight: Sight, Plane { normal, body }: Plane) {
        // The body vector points to the right and the light's color up, as in the plane panel.
        let inward = cross(normal, body);
        if sight == Sight::FaceOn {
            self.orbit.face(normal, inward);
        } else {
            self.orbit.edge_on(normal, body);
        }
    }

    /// Moves and scales the space to the middle of the view, as large as the margins allow.
    fn frame(&mut self, size: [f32; 2]) {
        (self.framed, self.by_hand) = (Some(size), false);
        self.orbit.fit(size[0] / size[1].max(1.0));
        let middle = size.map(|length| 0.5 * length);
        // Moving the space changes its perspective slightly, so the step is repeated.
        for _ in 0..3 {
            let projector = self.orbit.projector(size);
            let cube = cube_edges().into_iter().flatten().filter(|_| self.whole.is_empty());
            let mut seen = Rect::NOTHING;
            cube.chain(self.whole.iter().copied())
                .filter_map(|corner| projector.screen_from_world(corner))
                .for_each(|corner| seen.extend_with(corner.at.into()));
            if !seen.is_positive() {
                return;
            }
            let free = |axis: usize| size[axis] - 2.0 * MARGIN_PT[axis].min(MARGIN_SHARE * size[axis]);
            let center = seen.center();
            self.orbit.pan([middle[0] - center.x, middle[1] - center.y], size[1]);
            let factor = (free(0) / seen.width()).min(free(1) / seen.height());
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
    /// the camera,
    /// which it does while the pointer tool is chosen.
    pub fn obey(&mut self, ui: &Ui, response: &Response, rect: Rect, orbits: bool, plane: Option<Plane>) {
        let size = [rect.width(), rect.height()];
        let before = self.orbit;
        let listens = (response.hovered() || response.has_focus()) && !ui.ctx().text_edit_focused();
        let keys = if listens { pressed(ui) } else { Vec::new() };
        self.obey_pointer(ui, response, rect, orbits);
        for &key in &keys {
            self.obey_key(key, size);
        }
        self.by_hand |= self.orbit != before;
        let named = keys.iter().find_map(|key| Sight::ALL.into_iter().find(|(_, of, ..)| of == key));
        let reset = (response.double_clicked() && orbits).then_some(Sight::ALL[0]);
        if let Some((sight, ..)) = named.or(reset) {
            self.look(sight, plane, size);
        }
    }

    fn obey_pointer(&mut self, ui: &Ui, response: &Response, rect: Rect, orbits: bool) {
        let size = [rect.width(), rect.height()];
        let delta = response.drag_delta();
        let shift = ui.input(|input| input.modifiers.shift);
        let primary = response.dragged_by(PointerButton::Primary) && orbits;
        let second =
            response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Secondary);
        if second || (primary && shift) {
            self.orbit.pan(delta.into(), size[1]);
        } else if primary && delta != egui::Vec2::ZERO {
            self.orbit.orbit(delta.into());
            self.follows = None;
        }
        if let Some(pointer) = response.hover_pos() {
            let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
            let factor = (scroll / SCROLL_PT).exp() * pinch;
            if (factor - 1.0).abs() > 1e-6 {
                self.orbit.zoom_at(factor, (pointer - rect.min).into(), size);
            }
        }
    }

    fn obey_key(&mut self, key: Key, size: [f32; 2]) {
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
        self.follows = None;
    }
}

/// Keys pressed in this frame, alone or with Shift.
fn pressed(ui: &Ui) -> Vec<Key> {
    let plain = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } if !modifiers.command && !modifiers.alt => {
            Some(*key)
        }
        _ => None,
    };
    ui.input(|input| input.events.iter().filter_map(plain).collect())
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
