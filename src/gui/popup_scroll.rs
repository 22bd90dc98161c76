//! Menus that scroll where the window is too low for all of their rows.

use egui::style::ScrollStyle;
use egui::{Context, InnerResponse, Response, ScrollArea, TextWrapMode, Ui};

/// Height of the margins and lines of a menu, points.
const FRAME_PT: f32 = 16.0;

/// Height of the lists of choices where the window has room for them, points.
const LIST_PT: f32 = 200.0;

/// Height that a menu or list may have in the window, points. `wanted`: the height where the window has room.
pub fn height_within(ctx: &Context, wanted: f32) -> f32 {
    wanted.min(ctx.content_rect().height() - FRAME_PT).max(40.0)
}

/// Makes the lists of choices that are shown in `ui` no higher than the window.
pub fn limit_lists(ui: &mut Ui) {
    ui.spacing_mut().combo_height = height_within(ui.ctx(), LIST_PT);
}

/// A scroll bar that is seen without the pointer over it: a bar that appears under the pointer alone would not tell that there are further
/// rows.
pub fn visible_bar() -> ScrollStyle {
    ScrollStyle::solid()
}

/// Shows the rows of a menu that may be as high as the window. The row that a key gives the focus is scrolled into view.
pub fn scrolling<R>(ui: &mut Ui, rows: impl FnOnce(&mut Ui) -> R) -> R {
    let room = ui.ctx().content_rect().height() - FRAME_PT;
    scrolling_within(ui, room, rows)
}

/// As [`scrolling`], for a menu of at most `room` points.
pub fn scrolling_within<R>(ui: &mut Ui, room: f32, rows: impl FnOnce(&mut Ui) -> R) -> R {
    ui.spacing_mut().scroll = visible_bar();
    // egui gives a new popup the height of `Spacing::default_area_size`, whatever the window has room for.
    ui.set_max_height(room.max(40.0));
    let area = ScrollArea::vertical().max_height(room.max(40.0));
    let shown = area.show(ui, |ui| {
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        let shown = rows(ui);
        scroll_to_focus(ui);
        shown
    });
    shown.inner
}

/// Scrolls to the row of this menu that has got the focus.
fn scroll_to_focus(ui: &Ui) {
    // Reading the response of the focused widget takes the focus away while the pointer is pressed elsewhere.
    if ui.input(|input| input.pointer.any_pressed()) {
        return;
    }
    let focused = ui.memory(egui::Memory::focused).and_then(|id| ui.ctx().read_response(id));
    if let Some(row) = focused.filter(|row| row.layer_id == ui.layer_id() && row.gained_focus()) {
        ui.scroll_to_rect(row.rect, None);
    }
}

/// Shows the button of a menu whose rows scroll.
pub fn menu_button<R>(
    ui: &mut Ui,
    text: impl Into<String>,
    rows: impl FnOnce(&mut Ui) -> R,
) -> InnerResponse<Option<R>> {
    ui.menu_button(text.into(), |ui| scrolling(ui, rows))
}

/// Shows the menu of the secondary button of the pointer, whose rows scroll.
pub fn context_menu(response: &Response, rows: impl FnOnce(&mut Ui)) {
    response.context_menu(|ui| scrolling(ui, rows));
}
