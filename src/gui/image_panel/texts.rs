//! The texts over the picture: names of layers, legends and warnings.

use super::notes::DismissedNotes;
use super::textures::Slot;
use super::{cursor, overlay};
use crate::gui::PanelContext;
use crate::view::{Instant, Layer};
use egui::accesskit::Role;
use egui::{Align2, Rect, Sense, Ui, WidgetInfo, vec2};

/// Writes the names of the layers (`shows_names`), the legends of their colors, and the warnings of the analysis.
pub fn show_texts(
    ui: &Ui,
    painter: &egui::Painter,
    cx: &PanelContext,
    parts: &[(Layer, Slot, Rect)],
    shows_names: bool,
    instant: Option<&Instant>,
    notes: &mut DismissedNotes,
) {
    let pinned_pt = if instant.is_none() { show_pinned(ui, painter, cx, shows_names) } else { 0.0 };
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
    let names_pt = if shows_names { NAME_PT } else { 0.0 };
    notes.show(ui, painter, cx, painter.clip_rect().translate(vec2(0.0, names_pt + pinned_pt)));
}

/// Height of a name with the distance to what is below, points.
const NAME_PT: f32 = 22.0;

/// Says over the picture that it is of the pinned result, below the names of the layers. Returns the height of the line; 0 where the result is the
/// newest.
fn show_pinned(ui: &Ui, painter: &egui::Painter, cx: &PanelContext, shows_names: bool) -> f32 {
    if !cx.state.shows_pinned() || cx.is_export {
        return 0.0;
    }
    let below = if shows_names { NAME_PT } else { 0.0 };
    let corner = painter.clip_rect().left_top() + vec2(6.0, 6.0 + below);
    let text = "A: the pinned result";
    let place = overlay::text_box(painter, cx.palette, corner, Align2::LEFT_TOP, text);
    let label = ui.interact(place, ui.scope_id().with("pinned result"), Sense::hover());
    label.widget_info(|| WidgetInfo::labeled(Role::Label, true, text));
    label.on_hover_text("The key A goes back to the newest result, B.");
    NAME_PT
}
