//! The row of controls above the color space: coloring, space, tools, shapes to show, named views.

use super::camera_controller::{CameraController, Plane};
use crate::app::ViewCommand;
use crate::gpu::Projection;
use crate::gui::PanelContext;
use crate::gui::cube_choices::{COLORINGS, CUBE_BOXES, NEEDS_PLANE, NamedView};
use crate::gui::icons::{self, Icon};
use crate::gui::popup_scroll::{menu_button, scrolling};
use crate::gui::widgets::clickable;
use crate::view::{ColorSpace, CubeSettings, Tool};
use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, ComboBox, PopupCloseBehavior, Slider, Ui, WidgetInfo};

/// Below this width all tools are in one menu, points.
const NARROW_PT: f32 = 430.0;

const TOOLS: [(Tool, Icon, &str, &str); 4] = [
    (
        Tool::Pointer,
        Icon::Arrow,
        "Color space: pointer",
        "Drag orbits, Shift-drag pans, a click selects the region (Alt: the colors alone).",
    ),
    (
        Tool::Rectangle,
        Icon::Rectangle,
        "Color space: rectangle",
        "Drag a rectangle: its colors' pixels are marked. Shift adds, Alt takes away.",
    ),
    (
        Tool::Lasso,
        Icon::Lasso,
        "Color space: lasso",
        "Draw around colors: their pixels are marked. Shift adds, Alt takes away.",
    ),
    (
        Tool::Polygon,
        Icon::Polygon,
        "Color space: polygon",
        "Click corner by corner, Enter or double-click closes. Shift adds, Alt takes away.",
    ),
];

/// Shows the row. `size` is width and height of the view, points, for named views that frame the space.
pub fn show(ui: &mut Ui, cx: &mut PanelContext, camera_controller: &mut CameraController, size: [f32; 2]) {
    let before = &cx.state.view.cube;
    let mut settings = before.clone();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 5.0;
        let narrow = ui.available_width() < NARROW_PT;
        color_by(ui, &mut settings);
        space(ui, &mut settings);
        tools(ui, cx, &mut settings, narrow);
        open_menu("Show").ui(ui, |ui| scrolling(ui, |ui| shape_checkboxes(ui, &mut settings)));
        menu_button(ui, "Views", |ui| view_menu(ui, camera_controller, Plane::of(cx.state), size)).response.on_hover_text(
            "Views with a name: along an axis, onto the selected dichromatic plane, in perspective or not.",
        );
        let lock = icons::button(ui, cx.palette, Icon::Lock(settings.locked), settings.locked, "Lock the view");
        if lock
            .on_hover_text(
                "Locked: a view of the dichromatic plane stays as it is when another region is selected.",
            )
            .clicked()
        {
            settings.locked = !settings.locked;
        }
    });
    if settings != *before {
        cx.send(ViewCommand::Cube(settings));
    }
}

/// A menu that stays open while its boxes are clicked.
fn open_menu(text: &str) -> MenuButton<'_> {
    MenuButton::new(text).config(MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside))
}

/// Shows the choice of the coloring.
fn color_by(ui: &mut Ui, settings: &mut CubeSettings) {
    let current =
        COLORINGS.iter().find(|(choice, ..)| *choice == settings.color_by).map_or("", |(_, name, _)| name);
    combo(ui, "Color by", current, 58.0, |ui| {
        for (choice, name, tip) in COLORINGS {
            ui.selectable_value(&mut settings.color_by, choice, name).on_hover_text(tip);
        }
    });
}

/// Shows the choice of the color space.
fn space(ui: &mut Ui, settings: &mut CubeSettings) {
    combo(ui, "Color space shown", short_name(settings.space), 58.0, |ui| {
        for space in ColorSpace::ALL {
            ui.selectable_value(&mut settings.space, space, space.name()).on_hover_text(space.meaning());
        }
    });
}

/// A name short enough for the button.
const fn short_name(space: ColorSpace) -> &'static str {
    match space {
        ColorSpace::Lab => "L*a*b*",
        ColorSpace::Chromaticity => "r\u{2013}g",
        other => other.name(),
    }
}

/// Shows a choice with an accessible name.
fn combo(ui: &mut Ui, name: &str, current: &str, width: f32, choices: impl FnOnce(&mut Ui)) {
    let combo = ComboBox::from_id_salt(name).selected_text(current).width(width);
    let response = combo.show_ui(ui, choices).response;
    response.widget_info(|| {
        let mut info = WidgetInfo::labeled(egui::accesskit::Role::ComboBox, true, name);
        info.current_text_value = Some(current.to_owned());
        info
    });
    response.on_hover_text(name);
}

/// Shows the tools as buttons, or as a menu in a narrow view.
fn tools(ui: &mut Ui, cx: &PanelContext, settings: &mut CubeSettings, narrow: bool) {
    if narrow {
        menu_button(ui, "Tool", |ui| {
            for (tool, _, name, tip) in TOOLS {
                let name = name.trim_start_matches("Color space: ");
                if ui.radio(settings.tool == tool, name).on_hover_text(tip).clicked() {
                    settings.tool = tool;
                }
            }
        });
        return;
    }
    ui.spacing_mut().item_spacing.x = 1.0;
    for (tool, icon, name, tip) in TOOLS {
        if icons::button(ui, cx.palette, icon, settings.tool == tool, name).on_hover_text(tip).clicked() {
            settings.tool = tool;
        }
    }
    ui.spacing_mut().item_spacing.x = 4.0;
}

/// Shows the boxes of the shapes and of the points' appearance.
fn shape_checkboxes(ui: &mut Ui, settings: &mut CubeSettings) {
    for shown in CUBE_BOXES {
        ui.checkbox((shown.slot)(settings), shown.name).on_hover_text(shown.tip);
    }
    point_sliders(ui, settings);
}

/// Shows the sliders of the points' size and opacity, and of the depth plane; a double-click resets.
fn point_sliders(ui: &mut Ui, settings: &mut CubeSettings) {
    let defaults = CubeSettings::default();
    ui.spacing_mut().slider_width = 110.0;
    for (value, range, default, name, tip) in [
        (
            &mut settings.point_scale,
            0.25..=4.0,
            defaults.point_scale,
            "Point size",
            "Factor of the points' diameters; a double-click resets.",
        ),
        (
            &mut settings.point_opacity,
            0.05..=1.0,
            defaults.point_opacity,
            "Point opacity",
            "Opacity of the points that are no ghosts; a double-click resets.",
        ),
        (
            &mut settings.depth_plane,
            0.0..=1.0,
            defaults.depth_plane,
            "Depth plane",
            "Hides what is nearer to the viewer than this share of the cube's depth; a double-click resets.",
        ),
    ] {
        let slider = ui.add(Slider::new(value, range).max_decimals(2).text(name)).on_hover_text(tip);
        if clickable(&slider).double_clicked() {
            *value = default;
        }
    }
}

/// Shows the named views and the choice of the projection.
fn view_menu(ui: &mut Ui, camera_controller: &mut CameraController, plane: Option<Plane>, size: [f32; 2]) {
    for (named_view, key, name, tip) in NamedView::ALL {
        let button = Button::new(name).shortcut_text(key.name());
        let response = ui.add_enabled(!named_view.is_of_plane() || plane.is_some(), button);
        let response = response.on_hover_text(tip).on_disabled_hover_text(NEEDS_PLANE);
        if response.clicked() {
            camera_controller.go_to_view(named_view, plane, size);
        }
    }
    let mut perspective = camera_controller.orbit.projection == Projection::Perspective;
    let tip = "Farther is smaller; otherwise parallel lines stay parallel. Key M.";
    if ui.checkbox(&mut perspective, "Perspective").on_hover_text(tip).changed() {
        camera_controller.toggle_projection();
    }
}
