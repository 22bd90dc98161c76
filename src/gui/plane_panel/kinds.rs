//! Kinds of pixels (matte, highlight, restored, lost; section 6): colors, names, and the legend.

use crate::app::ViewCommand;
use crate::gui::PanelContext;
use crate::gui::icons::{self, Icon};
use crate::gui::widgets;
use crate::intrinsic::PixelKind;
use crate::view::{PlanePixel, PlaneSettings, RegionPlane, Theme, Tool};
use egui::{Color32, Ui};

/// The kinds with names and tooltips.
const KINDS: [(PixelKind, &str, &str); 4] = [
    (PixelKind::Matte, "matte", "Nearer to the matte line: body reflection alone (section 6)."),
    (
        PixelKind::Highlight,
        "highlight",
        "Nearer to the highlight line: light reflected at the surface as well (section 6).",
    ),
    (
        PixelKind::Restored,
        "restored",
        "Clipped or bloomed; split by the bands that can be believed (section 6).",
    ),
    (PixelKind::Lost, "lost", "Clipped in every band, or clipped in a region that is not split (section 6)."),
];

/// The color of a kind. Colors differ in hue and in lightness.
pub fn color(kind: PixelKind, theme: Theme) -> Color32 {
    let [r, g, b] = match (kind, theme) {
        (PixelKind::Matte, Theme::Dark) => [0x5C, 0x96, 0xC8],
        (PixelKind::Matte, Theme::Light) => [0x2A, 0x66, 0x98],
        (PixelKind::Highlight, Theme::Dark) => [0xF0, 0xE2, 0x8A],
        (PixelKind::Highlight, Theme::Light) => [0xA8, 0x86, 0x00],
        (PixelKind::Restored, Theme::Dark) => [0xD0, 0x84, 0xC8],
        (PixelKind::Restored, Theme::Light) => [0x98, 0x3C, 0x90],
        (PixelKind::Lost | PixelKind::Unassigned, _) => [0x8A, 0x8A, 0x8A],
    };
    Color32::from_rgb(r, g, b)
}

/// The color of a point: at the debugger's cursor the color of its meaning, in a result the color of its kind. `own` is the color of
/// the hypothesis at the cursor.
pub fn color_of(point: &PlanePixel, own: Option<[u8; 3]>, theme: Theme) -> Color32 {
    point.meaning.map_or_else(|| color(point.kind, theme), |meaning| widgets::color(meaning.color(own)))
}

/// Shows the choice between own colors and labels, and the legend of the labels.
pub fn toolbar(ui: &mut Ui, cx: &mut PanelContext, plane: &RegionPlane) {
    let by_label = cx.state.view.plane.color_by_label;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 5.0;
        for (choice, name, tip) in [
            (true, "By label", "Points in the color of what they are to the region."),
            (false, "Own color", "Points in the color that was measured."),
        ] {
            if ui.selectable_label(by_label == choice, name).on_hover_text(tip).clicked() {
                let settings = PlaneSettings { color_by_label: choice, ..cx.state.view.plane.clone() };
                cx.send(ViewCommand::Plane(settings));
            }
        }
        ui.add_space(6.0);
        tools(ui, cx);
        if by_label {
            ui.add_space(6.0);
            for (kind, name, tip) in KINDS {
                if plane.points.iter().any(|point| point.kind == kind) {
                    let color = color(kind, cx.state.view.theme);
                    widgets::legend_entry(ui, cx.palette, color, name).on_hover_text(tip);
                    ui.add_space(6.0);
                }
            }
        }
        if cx.state.view.geometry.is_drawn && plane.has_plane {
            let tip = "The cluster of the sphere in the panel Geometry (section 3.2).";
            widgets::legend_entry(ui, cx.palette, cx.palette.accent, "sphere").on_hover_text(tip);
        }
    });
}

/// Shows the tools that mark points.
fn tools(ui: &mut Ui, cx: &mut PanelContext) {
    let settings = cx.state.view.plane.clone();
    for (tool, icon, name, tip) in [
        (Tool::Pointer, Icon::Arrow, "Plane: pointer", "A click selects a pixel, a drag pans."),
        (
            Tool::Lasso,
            Icon::Lasso,
            "Plane: lasso",
            "Marks the region's pixels inside a free outline; Shift adds, Alt takes away (section 3.1).",
        ),
    ] {
        if icons::button(ui, cx.palette, icon, settings.tool == tool, name).on_hover_text(tip).clicked() {
            cx.send(ViewCommand::Plane(PlaneSettings { tool, ..settings.clone() }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::PixelIndex;
    use crate::view::Meaning;

    #[test]
    fn points_at_the_cursor_have_the_colors_of_their_meanings() {
        for meaning in Meaning::ALL {
            let own = Some([10, 200, 30]);
            let point = PlanePixel {
                body: 1.0,
                surface: 1.0,
                color: [1.0; 3],
                kind: PixelKind::Matte,
                meaning: Some(meaning),
                pixel: PixelIndex::new(0),
                count: 1,
            };
            assert_eq!(color_of(&point, own, Theme::Dark), widgets::color(meaning.color(own)));
            let in_result = PlanePixel { meaning: None, ..point };
            assert_eq!(color_of(&in_result, own, Theme::Light), color(PixelKind::Matte, Theme::Light));
        }
    }
}
