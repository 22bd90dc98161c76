//! A skewed-T test (section 5.4.1) over a chart: what is tested, and each value against its limit.

use super::theme::{SMALL_PT, ThemeColors};
use super::threshold_bar;
use crate::trace::CandidateTested;
use crate::view::{candidate_name, candidate_tests};
use egui::accesskit::Role;
use egui::{Color32, FontId, Pos2, Rect, Sense, Ui, WidgetInfo, vec2};

/// Shows the test with its upper left corner at `corner`, on the background color `ground`; returns the rectangle.
pub fn show(ui: &Ui, palette: &ThemeColors, ground: Color32, corner: Pos2, test: &CandidateTested) -> Rect {
    let halo = ground.gamma_multiply(0.8);
    let text = format!("highlight of {}: {}?", test.hypothesis, candidate_name(test.candidate));
    let galley = ui.painter().layout_no_wrap(text.clone(), FontId::proportional(SMALL_PT), palette.text);
    let heading = Rect::from_min_size(corner, galley.size());
    ui.painter().rect_filled(heading.expand2(vec2(2.0, 0.0)), 2.0, halo);
    ui.painter().galley(corner, galley, palette.text);
    let response = ui.interact(heading, ui.scope_id().with("skewed T"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, text.clone()));
    let tip =
        "A neighboring cluster is the region's highlight if both lines form a skewed T (section 5.4.1).";
    response.on_hover_text(tip);
    let below = heading.left_bottom() + vec2(0.0, 2.0);
    heading.union(threshold_bar::show_at(ui, palette, halo, below, &candidate_tests(test)))
}
