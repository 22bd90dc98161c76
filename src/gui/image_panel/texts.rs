//! The texts over the picture: names of layers, legends and warnings.

use super::textures::Slot;
use super::{cursor, overlay};
use crate::gui::PanelContext;
use crate::view::{Instant, Layer};
use egui::accesskit::Role;
use egui::{Align2, Rect, Sense, Ui, Vec2, WidgetInfo, vec2};

/// Writes the names of the layers (`shows_names`), the legends of their colors, and the warnings of the analysis.
pub fn show_texts(
    ui: &Ui,
    painter: &egui::Painter,
    cx: &PanelContext,
    parts: &[(Layer, Slot, Rect)],
    shows_names: bool,
    instant: Option<&Instant>,
) {
    for &(layer, slot, part) in parts {
        let painter = painter.with_clip_rect(part);
        if let Some(instant) = instant.filter(|_| slot == Slot::Layer) {
            cursor::show_texts(ui, &painter, cx.palette, part, cx.state, instant);
            continue;
        }
        if shows_names {
            let right = parts.len() == 2 && slot == Slot::SecondLayer;
            let (corner, align) = if right {
                (part.right_top() + vec2(-6.0, 6.0), Align2::RIGHT_TOP)
            } else {
                (part.left_top() + vec2(6.0, 6.0), Align2::LEFT_TOP)
            };
            let compared = cx.state.compared_photograph().filter(|_| slot == Slot::SecondLayer);
            let shown = compared.map_or_else(
                || layer.name().to_owned(),
                |other| format!("{}: {}", other.picture.origin.name(), layer.name()),
            );
            let place = overlay::text_box(&painter, cx.palette, corner, align, &shown);
            let name = ui.interact(place, ui.scope_id().with(("layer shown", right)), Sense::hover());
            let text = format!("Layer shown: {shown}");
            name.widget_info(|| WidgetInfo::labeled(Role::Label, true, text.clone()));
        }
        let is_compared = cx.state.compared_photograph().is_some() && slot == Slot::SecondLayer;
        match cx.state.lacks(layer).filter(|_| !is_compared) {
            None => overlay::layer_legend(&painter, cx.palette, part, layer, cx.state),
            Some(lacking) => {
                let corner = part.left_bottom() + vec2(6.0, -6.0);
                let place = overlay::text_box(&painter, cx.palette, corner, Align2::LEFT_BOTTOM, lacking);
                let why = ui.interact(place, ui.scope_id().with(("layer lacks", layer)), Sense::hover());
                why.widget_info(|| WidgetInfo::labeled(Role::Label, true, lacking));
            }
        }
    }
    // The verdict under the picture says why there is no region.
    let is_told =
        !cx.is_export && cx.state.shown().is_some_and(|shown| shown.analysis.intrinsic.regions.is_empty());
    if instant.is_some() || is_told {
        return;
    }
    let view = painter.clip_rect();
    let below = if shows_names { vec2(0.0, 22.0) } else { Vec2::ZERO };
    overlay::warnings(painter, cx.palette, view.translate(below), cx.state);
}
