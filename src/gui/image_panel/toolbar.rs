//! The image panel's row of controls (layer, arrangement, zoom, display) and its column of tools.

use super::icons::{self, ToolbarIcon};
use crate::app::{DebugSettings, State};
use crate::gui::action::{Action, LayerFile};
use crate::gui::icons::{Icon, button};
use crate::gui::popup_scroll::{height_within, scrolling};
use crate::gui::shortcuts::keys_of;
use crate::gui::theme::{SMALL_PT, ThemeColors};
use crate::gui::widgets::{clickable, keep_unless_edited};
use crate::view::{Arrangement, ArrangementKind, Fill, ImageSettings, Layer, Tool};
use egui::accesskit::Role;
use egui::{
    Button, ComboBox, DragValue, Label, Popup, PopupCloseBehavior, Response, RichText, Sense, Slider, Ui,
    WidgetInfo, vec2,
};

/// Tools in the order of the column.
const TOOLS: [(Tool, &str, &str); 7] = [
    (Tool::Pointer, "Pointer", "Click selects a region, Alt + click a pixel; drag pans."),
    (Tool::Rectangle, "Rectangle", "Marks a rectangle; Shift adds, Alt takes away."),
    (Tool::Lasso, "Lasso", "Marks what a free outline encloses; Shift adds, Alt takes away."),
    (Tool::Polygon, "Polygon", "Marks a polygon, corner by corner; double-click or Enter closes it."),
    (Tool::Brush, "Brush", "Marks what it sweeps over; Shift adds, Alt takes away."),
    (Tool::Profile, "Profile line", "The line of the profile; Shift keeps it in a row or column."),
    (
        Tool::WhitePatch,
        "White patch",
        "Pins the light's color to the mean of a white patch, dragged or 5 px around a click (section 6); with Shift the second lamp's (7.5).",
    ),
];

/// Shows the row. `zoom` is the current zoom, screen points per pixel; `actions` takes the exports that are asked for.
pub fn row(
    ui: &mut Ui,
    state: &State,
    palette: &ThemeColors,
    settings: &mut ImageSettings,
    debug: &mut DebugSettings,
    zoom: f32,
    actions: &mut Vec<Action>,
) {
    ui.spacing_mut().item_spacing = vec2(3.0, 3.0);
    ui.spacing_mut().interact_size.y = icons::SIDE_PT;
    ui.horizontal_wrapped(|ui| {
        let followed = state.followed().is_some();
        if layer_menu(ui, state, "Layer", &mut settings.layer, followed, actions) {
            debug.follow = false;
        }
        let kind = shown_arrangement(settings, followed);
        if arrangement_buttons(ui, palette, settings, kind) && followed {
            debug.follow = false;
        }
        if kind != ArrangementKind::Single {
            layer_menu(ui, state, "Second layer", &mut settings.other, false, actions);
        }
        fill_button(ui, palette, settings);
        zoom_controls(ui, settings, zoom);
        display_menu(ui, palette, settings);
        lock_button(ui, palette, settings);
        export_button(ui, state, actions);
    });
}

/// Shows the button that opens the dialog of exports.
fn export_button(ui: &mut Ui, state: &State, actions: &mut Vec<Action>) {
    let keys = keys_of(ui.ctx(), Action::Export);
    let tip = format!("Writes the photograph without highlights, images, tables or figures ({keys}).");
    let button = ui.add_enabled(state.shown().is_some(), Button::new("Export\u{2026}"));
    button.widget_info(|| WidgetInfo::labeled(Role::Button, button.enabled(), "Open Export\u{2026}"));
    if button.on_hover_text(tip).clicked() {
        actions.push(Action::Export);
    }
}

/// Shows the button that locks the readout.
fn lock_button(ui: &mut Ui, palette: &ThemeColors, settings: &mut ImageSettings) {
    let locked = settings.readout_locked;
    let tip = format!(
        "Locked: readout and inspector stay with the selected pixel or region while the pointer moves ({})",
        keys_of(ui.ctx(), Action::LockReadout)
    );
    let button = button(ui, palette, Icon::Lock(locked), locked, "Lock the readout");
    if button.on_hover_text(tip).clicked() {
        settings.readout_locked = !locked;
    }
}

/// Shows the choice of a layer, and below the layers the exports of the present one; returns whether a layer was chosen in place of the instant at the debugger's cursor.
fn layer_menu(
    ui: &mut Ui,
    state: &State,
    name: &str,
    layer: &mut Layer,
    followed: bool,
    actions: &mut Vec<Action>,
) -> bool {
    let now = if followed { "At the cursor" } else { layer.name() };
    let combo =
        ComboBox::from_id_salt(name).width(104.0).height(height_within(ui.ctx(), 580.0)).selected_text(now);
    let mut chosen = false;
    let shown = combo.show_ui(ui, |ui| {
        // The whole list is seen in a low window.
        ui.spacing_mut().item_spacing.y = 1.0;
        for choice in Layer::ALL {
            let lacking = state.lacks(choice);
            let keys = keys_of(ui.ctx(), Action::Layer(choice));
            let button = Button::selectable(!followed && *layer == choice, choice.name()).shortcut_text(keys);
            let button = ui.add_enabled(lacking.is_none(), button).on_hover_text(choice.tip());
            if button.on_disabled_hover_text(lacking.unwrap_or_default()).clicked() {
                *layer = choice;
                chosen = followed;
            }
        }
        ui.separator();
        for file in LayerFile::ALL {
            let text = format!("Export {} as {}\u{2026}", layer.name().to_lowercase(), file.name());
            let tip = "Writes this layer alone: PNG as shown, OpenEXR or NumPy with its numbers (section 6).";
            if ui.button(text).on_hover_text(tip).clicked() {
                actions.push(Action::ExportLayer(*layer, file));
                ui.close();
            }
        }
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, name));
    let of_cursor = "What is decided at the debugger's cursor; a layer shows the result instead.";
    shown.response.on_hover_text(if followed { of_cursor } else { layer.tip() });
    chosen
}

/// How one or two layers share the view: the instant at the debugger's cursor, where it is `followed`, is not wiped.
fn shown_arrangement(settings: &ImageSettings, followed: bool) -> ArrangementKind {
    match settings.arrangement.kind() {
        ArrangementKind::Wipe if followed => ArrangementKind::Single,
        kind => kind,
    }
}

/// Shows the buttons for one layer, a wipe, and two views, of which `now` is shown. Returns whether the wipe was chosen, which is one of two layers
/// of the result.
fn arrangement_buttons(
    ui: &mut Ui,
    palette: &ThemeColors,
    settings: &mut ImageSettings,
    now: ArrangementKind,
) -> bool {
    let mut is_wipe_chosen = false;
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        for kind in ArrangementKind::ALL {
            let icon = ToolbarIcon::Arrangement(kind);
            if icons::toggle(ui, palette, icon, now == kind, kind.name(), kind.meaning()).clicked() {
                settings.arrange(kind);
                is_wipe_chosen = kind == ArrangementKind::Wipe;
            }
        }
    });
    is_wipe_chosen
}

/// Shows the button that switches between fills and outlines.
fn fill_button(ui: &mut Ui, palette: &ThemeColors, settings: &mut ImageSettings) {
    let second = settings.arrangement != Arrangement::Single;
    let overlay = settings.layer.is_overlay() || (second && settings.other.is_overlay());
    let outline = settings.fill == Fill::Outline;
    let tip = format!(
        "Outlines instead of fills, of areas over the photograph ({})",
        keys_of(ui.ctx(), Action::Outline)
    );
    ui.add_enabled_ui(overlay, |ui| {
        let icon = ToolbarIcon::Fill(Fill::Outline);
        if icons::toggle(ui, palette, icon, outline && overlay, "Outlines", &tip).clicked() {
            settings.fill = if outline { Fill::Fill } else { Fill::Outline };
        }
    });
}

/// Shows the buttons "Fit" and "1:1", and the field of the zoom.
fn zoom_controls(ui: &mut Ui, settings: &mut ImageSettings, zoom: f32) {
    ui.spacing_mut().button_padding.x = 5.0;
    let fit = Button::selectable(settings.zoom.is_none(), "Fit");
    let tip = format!("The whole picture ({}, double-click)", keys_of(ui.ctx(), Action::Fit));
    if ui.add(fit).on_hover_text(tip).clicked() {
        (settings.zoom, settings.center_px) = (None, None);
    }
    let tip = format!("One screen point a pixel ({})", keys_of(ui.ctx(), Action::OneToOne));
    let is_one_to_one = settings.zoom == Some(1.0);
    if ui.add(Button::selectable(is_one_to_one, "1:1")).on_hover_text(tip).clicked() {
        settings.zoom = Some(1.0);
    }
    let mut percent = zoom * 100.0;
    let (speed, before) = (percent / 100.0, percent);
    let field = DragValue::new(&mut percent).range(0.0..=f32::MAX).speed(speed).max_decimals(0).suffix(" %");
    let mut field = ui.add_sized(vec2(48.0, ui.spacing().interact_size.y), field);
    keep_unless_edited(&mut field, before, &mut percent, |v| format!("{v:.0}"));
    set_accessible_name(&field, "Zoom", f64::from(percent));
    if field.changed() && percent > 0.0 {
        settings.zoom = Some(percent / 100.0);
    }
    field.on_hover_text("Zoom: scroll over the picture, + and \u{2212}, or type here");
}

/// Sets the accessible name of a number's field.
fn set_accessible_name(response: &Response, name: &str, value: f64) {
    response
        .widget_info(|| WidgetInfo { label: Some(name.to_owned()), ..WidgetInfo::drag_value(true, value) });
}

/// Shows the button of the display settings, which do not change the analysis. The button is on while exposure or gamma
/// differ from their defaults.
fn display_menu(ui: &mut Ui, palette: &ThemeColors, settings: &mut ImageSettings) {
    let defaults = ImageSettings::default();
    let differs = |value: f32, defaults: f32| (value - defaults).abs() > 1e-4;
    let changed =
        differs(settings.exposure_ev, defaults.exposure_ev) || differs(settings.gamma, defaults.gamma);
    let tip = "Exposure, gamma and opacity, of the display only";
    let button = icons::toggle(ui, palette, ToolbarIcon::Display, changed, "Display", tip);
    let popup = Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let rows = |ui: &mut Ui| {
        ui.spacing_mut().slider_width = 120.0;
        egui::Grid::new("display").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            let exposure = Slider::new(&mut settings.exposure_ev, -6.0..=6.0).step_by(0.1).suffix(" EV");
            if slider(ui, "Exposure", "Stops, of the display only.", exposure) {
                settings.exposure_ev = defaults.exposure_ev;
            }
            let gamma = Slider::new(&mut settings.gamma, 0.25..=4.0).logarithmic(true).max_decimals(2);
            if slider(ui, "Gamma", "Brightens (above 1) the middle tones, of the display only.", gamma) {
                settings.gamma = defaults.gamma;
            }
            let opacity = Slider::new(&mut settings.opacity, 0.0..=1.0).max_decimals(2);
            if slider(ui, "Opacity", "Of fills over the photograph.", opacity) {
                settings.opacity = defaults.opacity;
            }
        });
        let note = "Double-click resets. None of this changes the analysis.";
        ui.label(RichText::new(note).size(SMALL_PT).color(palette.secondary));
    };
    popup.show(|ui| scrolling(ui, rows));
}

/// Shows a slider in a row of the grid; returns whether it was double-clicked, which resets the value.
fn slider(ui: &mut Ui, name: &str, tip: &str, slider: Slider<'_>) -> bool {
    let label = ui.add(Label::new(name).sense(Sense::click())).on_hover_text(tip);
    let slider = clickable(&ui.add(slider).labelled_by(label.id).on_hover_text(tip));
    ui.end_row();
    slider.double_clicked() || label.double_clicked()
}

/// Gap between tools, points.
const TOOL_GAP_PT: f32 = 2.0;
/// Height of the field of the brush's radius, points.
const RADIUS_PT: f32 = 18.0;

/// Number of columns that the tools need in a height, points: two where one column is too high.
pub fn columns_needed(height: f32, settings: &ImageSettings) -> usize {
    let radius = if settings.tool == Tool::Brush { RADIUS_PT + TOOL_GAP_PT } else { 0.0 };
    let one_column = TOOLS.len() as f32 * (icons::SIDE_PT + TOOL_GAP_PT) - TOOL_GAP_PT + radius;
    if one_column <= height { 1 } else { 2 }
}

/// Width of so many columns of tools, points.
pub fn columns_width(columns: usize) -> f32 {
    columns as f32 * (icons::SIDE_PT + TOOL_GAP_PT) - TOOL_GAP_PT
}

/// Shows the tools in so many columns, and the field of the brush's radius.
pub fn tools(ui: &mut Ui, palette: &ThemeColors, settings: &mut ImageSettings, columns: usize) {
    ui.spacing_mut().item_spacing = vec2(TOOL_GAP_PT, TOOL_GAP_PT);
    for row in TOOLS.chunks(columns) {
        ui.horizontal(|ui| {
            for &(tool, name, tip) in row {
                let tip = format!("{name} ({}). {tip}", keys_of(ui.ctx(), Action::Tool(tool)));
                let is_chosen = settings.tool == tool;
                if icons::toggle(ui, palette, ToolbarIcon::Tool(tool), is_chosen, name, &tip).clicked() {
                    settings.tool = tool;
                }
            }
        });
    }
    if settings.tool == Tool::Brush {
        // The field must not be wider than the tools.
        ui.spacing_mut().button_padding.x = 0.0;
        ui.spacing_mut().interact_size.x = icons::SIDE_PT;
        ui.style_mut().drag_value_text_style = egui::TextStyle::Small;
        let decimals = usize::from(settings.brush_px < 10.0);
        let before = settings.brush_px;
        let radius = DragValue::new(&mut settings.brush_px).range(0.5..=500.0).speed(0.25);
        let radius = radius.max_decimals(decimals);
        let mut radius = ui.add_sized(vec2(icons::SIDE_PT, RADIUS_PT), radius);
        keep_unless_edited(&mut radius, before, &mut settings.brush_px, |v| format!("{v:.decimals$}"));
        set_accessible_name(&radius, "Brush radius", f64::from(settings.brush_px));
        radius.on_hover_text("Radius of the brush, pixels of the picture");
    }
}
