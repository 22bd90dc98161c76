//! The color space panel: the photograph's colors as points in three dimensions, with the shapes of the model:
//! cylinder, slice, skewed T and illuminant.

mod bar;
mod camera_controller;
mod canvas;
mod cloud;
mod cursor;
mod figure;
mod frame;
mod labels;
mod legend;
mod sphere_points;
pub mod testing;
mod unique_colors;

use super::cube_choices::NamedView;
use super::{PanelContext, context_menu, popup_scroll, widgets};
use crate::app::{Edit, State, ViewCommand};
use crate::gpu::{Batch, Line, Orbit, Projector, Scene, pick};
use crate::gui::outline::{Outline, combine_by_keys};
use crate::raster::{Mask, RegionId};
use crate::view::{Item, Picture, Tool, marking};
use camera_controller::{CameraController, Plane};
use canvas::Canvas;
use cloud::Cloud;
use cursor::CursorPoints;
use egui::{Color32, EventFilter, Pos2, Rect, Response, Sense, Stroke, Ui, vec2};
use figure::Figure;
use frame::AxesFrame;
use std::sync::Arc;
use unique_colors::UniqueColors;

/// Largest distance from the pointer at which a point counts as hovered, screen points.
const HOVER_RADIUS_PT: f32 = 6.0;
/// Radius of the ring around the hovered color, screen points.
const RING_PT: f32 = 7.0;

/// The color space panel.
#[derive(Default)]
pub struct CubePanel {
    camera_controller: CameraController,
    cloud: Cloud,
    cursor_points: CursorPoints,
    sphere_points: sphere_points::SpherePoints,
    unique_colors: UniqueColors,
    figure: Figure,
    frame: AxesFrame,
    canvas: Canvas,
    outline: Outline,
    scene: Scene,
    /// The camera for which the lines of the scene were made: silhouettes depend on the camera.
    lines_camera: Option<Orbit>,
    size: [f32; 2],
    /// The color bin that the context menu is about; none where the pointer was at no point.
    menu_bin: Option<u32>,
}

impl CubePanel {
    /// Drops an unfinished outline when Escape is pressed, and consumes the key, so that the selection stays.
    pub fn cancel_on_escape(&mut self, ctx: &egui::Context) {
        let key = egui::Key::Escape;
        if self.outline.is_unfinished()
            && ctx.input_mut(|input| input.consume_key(egui::Modifiers::NONE, key))
        {
            self.outline = Outline::default();
        }
    }

    /// The camera, to be stored in the settings.
    pub fn camera(&self) -> Orbit {
        self.camera_controller.orbit
    }

    /// Restores a stored camera. The camera then counts as moved by the user: a resized panel does not
    /// frame the cube anew.
    pub fn set_camera(&mut self, camera: Orbit) {
        self.camera_controller.set_orbit(camera);
    }

    /// Moves the camera to a named view; false for a view of a plane while no plane is selected.
    pub fn go_to_view(&mut self, state: &State, view: NamedView) -> bool {
        let plane = Plane::of(state);
        self.camera_controller.go_to_view(view, plane, self.size);
        plane.is_some() || !view.is_of_plane()
    }

    /// Switches between perspective and orthographic projection.
    pub fn toggle_projection(&mut self) {
        self.camera_controller.toggle_projection();
    }

    /// A new panel with the same camera, for exporting the view.
    pub fn clone_with_camera(&self) -> Self {
        Self { camera_controller: self.camera_controller.clone(), ..Self::default() }
    }

    /// Shows the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext) {
        let Some(picture) = cx.state.picture.clone() else {
            widgets::placeholder(ui, cx.palette, "Open a photograph to see its colors.");
            return;
        };
        let Some(gpu) = cx.gpu else {
            let text = "There is no graphics adapter, so the color space cannot be drawn; all else works.";
            widgets::placeholder(ui, cx.palette, text);
            return;
        };
        if !cx.is_export {
            egui::Frame::new().fill(cx.palette.panel).inner_margin(egui::Margin::symmetric(6, 3)).show(
                ui,
                |ui| {
                    bar::show(ui, cx, &mut self.camera_controller, self.size);
                    ui.allocate_space(vec2(ui.available_width(), 0.0));
                },
            );
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        if rect.width() < 8.0 || rect.height() < 8.0 {
            return;
        }
        self.size = [rect.width(), rect.height()];
        let settings = &cx.state.view.cube;
        let full_counts = picture.histogram.full_counts;
        let space_changed = self.frame.update(settings.space, full_counts, cx.state.view.theme);
        if space_changed {
            self.camera_controller
                .set_content(self.frame.lines.iter().flat_map(|line| [line.a, line.b]).collect());
        }
        self.move_camera(ui, cx, &response, rect);
        self.camera_controller.orbit.cut = settings.depth_plane;
        self.update_scene(ui, cx, gpu, &picture, space_changed);
        self.canvas.show(ui, gpu, rect, &self.scene, &self.camera_controller.orbit);
        let projector = self.camera_controller.orbit.projector(self.size);
        self.paint_overlay(ui, cx, &projector, &response, &picture);
        self.handle_pointer(cx, &response, &projector, rect);
        self.mark_outlined(ui, cx, &response, &projector, rect, &picture);
        set_accessible_name(&response);
    }

    /// Moves the camera by pointer and keys, and to the dichromatic plane of the selected region.
    fn move_camera(&mut self, ui: &Ui, cx: &PanelContext, response: &Response, rect: Rect) {
        let (plane, settings) = (Plane::of(cx.state), &cx.state.view.cube);
        if response.clicked() || response.drag_started() {
            response.request_focus();
        }
        let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        self.camera_controller.frame_if_resized(self.size);
        self.camera_controller.follow(plane, settings.locked);
        self.camera_controller.handle_input(ui, response, rect, settings.tool == Tool::Pointer, plane);
    }

    /// Rebuilds the parts of the scene that have changed.
    fn update_scene(
        &mut self,
        ui: &Ui,
        cx: &PanelContext,
        gpu: &egui_wgpu::RenderState,
        picture: &Arc<Picture>,
        space_changed: bool,
    ) {
        let settings = &cx.state.view.cube;
        let camera_moved = self.lines_camera != Some(self.camera_controller.orbit);
        if camera_moved {
            self.unique_colors.note_camera_moved();
        }
        let unique_colors = settings.full_detail.then(|| {
            let fast_device = gpu.adapter.get_info().device_type != wgpu::DeviceType::Cpu;
            self.unique_colors.get(ui.ctx(), picture, fast_device)
        });
        self.cursor_points.update(cx.state, cx.palette, picture);
        let ghosts_only = self.cursor_points.is_shown();
        self.cloud.update(cx.state, cx.palette, picture, unique_colors.flatten().as_ref(), ghosts_only);
        self.scene.points = self.cloud.drawn.to_vec();
        self.scene.points.extend_from_slice(&self.cursor_points.drawn);
        self.sphere_points.update(cx.state, cx.palette, picture);
        self.scene.points.extend_from_slice(&self.sphere_points.drawn);
        self.scene.background = cx.palette.background.to_array();
        let figure_changed = self.figure.update(cx.state, picture);
        if figure_changed {
            self.scene.meshes.clone_from(&self.figure.meshes);
        }
        if camera_moved || space_changed || figure_changed {
            let mut lines: Vec<Line> = self.frame.lines.clone();
            lines.extend(&self.figure.lines);
            lines.extend(self.figure.silhouettes(&self.camera_controller.orbit));
            self.scene.lines = Batch::new(lines);
            self.lines_camera = Some(self.camera_controller.orbit);
        }
    }

    /// Paints labels, gizmo, legend and the ring around the hovered color over the rendered scene.
    fn paint_overlay(
        &self,
        ui: &Ui,
        cx: &PanelContext,
        projector: &Projector,
        response: &Response,
        picture: &Picture,
    ) {
        let rect = response.rect;
        let settings = &cx.state.view.cube;
        let mut occupied = vec![legend::show(ui, cx, rect, self.cloud.fullest, &self.cursor_points.meanings)];
        if matches!(settings.space, crate::view::ColorSpace::Rgb | crate::view::ColorSpace::LogRgb) {
            let axes = self.camera_controller.orbit.right_up_forward();
            occupied.push(frame::gizmo(ui, axes, rect, ["R", "G", "B"], cx.palette));
        }
        occupied.push(self.readout(ui, cx, rect, picture));
        if let Some(test) = cx.state.followed().and_then(crate::view::test_at_cursor) {
            let below = occupied[0].left_bottom() + vec2(0.0, 4.0);
            occupied.push(crate::gui::skewed_t_test::show(
                ui,
                cx.palette,
                cx.palette.background,
                below,
                test,
            ));
        }
        let mut labels = self.figure.labels(ui, projector, rect, cx.palette);
        labels.extend(self.frame.labels(ui, projector, rect, cx.palette));
        labels::show(ui, response.id.with("labels"), &labels, rect, &occupied, cx.palette);
        self.paint_hover_ring(ui, cx, projector, rect, picture);
    }

    /// Writes the hovered color in counts into the lower right corner; returns the rectangle of the text.
    fn readout(&self, ui: &Ui, cx: &PanelContext, rect: Rect, picture: &Picture) -> Rect {
        let corner = rect.right_bottom() - vec2(8.0, 6.0);
        let Some((color, count, region)) = self.hovered(cx, picture) else {
            return Rect::from_min_max(corner, corner);
        };
        let [r, g, b] = color.map(|v| v.round() as i32);
        let region = region.map_or(String::new(), |region| format!("  region {region}"));
        let text = format!("R {r}  G {g}  B {b}  {count} px{region}");
        let font = egui::FontId::proportional(crate::gui::theme::SMALL_PT);
        ui.painter_at(rect).text(corner, egui::Align2::RIGHT_BOTTOM, text, font, cx.palette.text)
    }

    /// Color, number of pixels and region of the pixel or bin that is hovered.
    fn hovered(&self, cx: &PanelContext, picture: &Picture) -> Option<([f32; 3], u32, Option<RegionId>)> {
        let item = cx.state.hover?;
        // While the debugger's cursor is followed, the regions of the result do not exist yet.
        let region = |region: Option<RegionId>| region.filter(|_| cx.state.followed().is_none());
        match item {
            Item::Pixel(pixel) => {
                let color = *picture.photo.image.pixels.as_slice().get(pixel.index())?;
                Some((color, 1, region(cx.state.region_of(item))))
            }
            Item::Bin(bin) => {
                let of = picture.histogram.bins.get(bin as usize)?;
                Some((of.mean, of.count, region(self.cloud.region_of(bin))))
            }
            Item::Window(_) | Item::Region(_) => None,
        }
    }

    /// Paints a ring around the hovered color.
    fn paint_hover_ring(
        &self,
        ui: &Ui,
        cx: &PanelContext,
        projector: &Projector,
        rect: Rect,
        picture: &Picture,
    ) {
        let Some((color, ..)) = self.hovered(cx, picture) else { return };
        let world = cx.state.view.cube.space.place(color, picture.histogram.full_counts);
        let Some(at) = frame::screen_from_world(projector, rect, world) else { return };
        let painter = ui.painter_at(rect);
        let (dark, accent) =
            (Stroke::new(3.5, Color32::from_black_alpha(140)), Stroke::new(1.6, cx.palette.accent));
        for stroke in [dark, accent] {
            painter.circle_stroke(at, RING_PT, stroke);
            for side in [vec2(1.0, 0.0), vec2(-1.0, 0.0), vec2(0.0, 1.0), vec2(0.0, -1.0)] {
                painter.line_segment([at + side * RING_PT, at + side * (RING_PT + 5.0)], stroke);
            }
        }
    }

    /// Sends what the pointer does: hovering a bin highlights its pixels; a click selects the bin's region,
    /// Alt + click the bin; the secondary button opens the menu of both.
    fn handle_pointer(
        &mut self,
        cx: &mut PanelContext,
        response: &Response,
        projector: &Projector,
        rect: Rect,
    ) {
        let is_clicked = response.clicked() || response.secondary_clicked();
        let clicked = response.interact_pointer_pos().filter(|_| is_clicked);
        let pointer = clicked.or(response.hover_pos().filter(|_| !response.dragged()));
        let bin = pointer.and_then(|at| {
            let at = (at - rect.min).into();
            pick::nearest(&self.cloud.bins, projector, at, HOVER_RADIUS_PT).map(|hit| hit.index as u32)
        });
        let hover = bin.map(Item::Bin);
        if let Some((item, at)) = hover.zip(pointer) {
            let is_new = cx.state.hover != hover;
            cx.hover(item);
            if is_new {
                // One bin is one to three pixels of the picture, hardly to be seen: all bins near the pointer are shown.
                let bins = pick::within(&self.cloud.bins, projector, (at - rect.min).into(), HOVER_RADIUS_PT);
                cx.send(ViewCommand::HoverBins(bins.into_iter().map(|bin| bin as u32).collect()));
            }
        }
        if response.clicked() && !response.double_clicked() && cx.state.view.cube.tool == Tool::Pointer {
            let alt = response.ctx.input(|input| input.modifiers.alt);
            let region = bin.and_then(|bin| self.cloud.region_of(bin)).map(Item::Region);
            cx.send(Edit::Select(if alt { hover } else { region.or(hover) }));
        }
        if response.secondary_clicked() {
            self.menu_bin = bin;
        }
        let (bin, is_result) = (self.menu_bin, cx.state.followed().is_none());
        let region = bin.filter(|_| is_result).and_then(|bin| self.cloud.region_of(bin));
        popup_scroll::context_menu(response, |ui| context_menu::of_color(ui, cx, bin, region));
    }

    /// Marks the pixels whose colors lie inside a finished rectangle, lasso or polygon.
    fn mark_outlined(
        &mut self,
        ui: &Ui,
        cx: &mut PanelContext,
        response: &Response,
        projector: &Projector,
        rect: Rect,
        picture: &Picture,
    ) {
        if let Some(outline) = self.outline.handle_pointer(ui, response, cx.state.view.cube.tool) {
            let mask = mask_of(picture, &self.cloud.bins, projector, rect, &outline);
            cx.send(Edit::Mark(Arc::new(mask), combine_by_keys(ui), None));
        }
        self.outline.paint(&ui.painter_at(rect), response, cx.palette.accent);
    }
}

/// Mask of the pixels in bins whose centers appear inside an outline on the screen.
fn mask_of(
    picture: &Picture,
    bins: &[crate::gpu::Point],
    projector: &Projector,
    rect: Rect,
    outline: &[Pos2],
) -> Mask {
    let corners: Vec<[f32; 2]> = outline.iter().map(|corner| (*corner - rect.min).into()).collect();
    let inside = pick::inside_polygon(bins, projector, &corners);
    let inside: Vec<u32> = inside.into_iter().map(|bin| bin as u32).collect();
    let (width, height) = picture.size();
    marking::of_bins(picture, &inside).unwrap_or_else(|| Mask::filled(width, height, false))
}

/// Sets the accessible role and name of the view.
fn set_accessible_name(response: &Response) {
    response
        .widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Canvas, true, "Color space view"));
}
