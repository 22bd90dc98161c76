//! The room of the windows over the panels: dialogs, the list of commands and the list of keys stay within a small window.

use super::popup_scroll::visible_bar;
use egui::{Align2, Context, ScrollArea, Ui, Window, vec2};

/// Largest distance of such a window from the upper end of the program's window, points.
const MOST_ABOVE_PT: f32 = 64.0;

/// Height of the title, the margins and the lines of such a window, and of the room below it, points.
const FRAME_PT: f32 = 56.0;

/// Width of the margins of such a window and of the room beside it, points.
const SIDES_PT: f32 = 32.0;

/// Width of the path's row in a dialog that has room for it, points.
pub const PATH_ROW_PT: f32 = 660.0;

/// Width of what stands beside the field for the path, and of a scroll bar, points.
const BUTTONS_PT: f32 = 200.0;

/// Least width of a row in which the buttons stand beside the field, points. In a narrower one they stand below it.
const ONE_ROW_PT: f32 = 390.0;

/// Width of the word before the field for the path, points.
const WORD_PT: f32 = 76.0;

/// Distance from the upper end of the program's window, points.
fn above_pt(ctx: &Context) -> f32 {
    (0.075 * ctx.content_rect().height()).min(MOST_ABOVE_PT)
}

/// Places a window of fixed size in the middle, near the upper end. `width`: the width of its contents where there is room, points.
pub fn placed<'open>(window: Window<'open>, ctx: &Context, width: f32) -> Window<'open> {
    let place = vec2(0.0, above_pt(ctx));
    let window = window.collapsible(false).resizable(false).anchor(Align2::CENTER_TOP, place);
    window.default_width(width_within(ctx, width))
}

/// Width of the contents that are to be `wanted` points wide.
pub fn width_within(ctx: &Context, wanted: f32) -> f32 {
    wanted.min(ctx.content_rect().width() - SIDES_PT).max(40.0)
}

/// Width of the field for the path of a dialog, points.
pub fn path_width(ctx: &Context) -> f32 {
    let row_pt = width_within(ctx, PATH_ROW_PT);
    let beside_pt = if row_pt >= ONE_ROW_PT { BUTTONS_PT } else { WORD_PT };
    (row_pt - beside_pt).max(40.0)
}

/// Largest height of the contents of a placed window, points.
pub fn height(ctx: &Context) -> f32 {
    (ctx.content_rect().height() - above_pt(ctx) - FRAME_PT).max(40.0)
}

/// Shows contents that scroll where they are higher than `room` points.
pub fn scrolling<R>(ui: &mut Ui, salt: &str, room: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    in_area(ui, ScrollArea::vertical().id_salt(salt), room, contents)
}

/// As [`scrolling`], but at first the end of the contents is seen.
pub fn scrolling_from_end<R>(ui: &mut Ui, salt: &str, room: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    in_area(ui, ScrollArea::vertical().id_salt(salt).stick_to_bottom(true), room, contents)
}

/// Shows contents in an area of at most `room` points of height.
fn in_area<R>(ui: &mut Ui, area: ScrollArea, room: f32, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let shown = ui.scope(|ui| {
        let scroll = std::mem::replace(&mut ui.spacing_mut().scroll, visible_bar());
        // egui gives a new window the height of `Spacing::default_area_size`, whatever the room.
        ui.set_max_height(room);
        area.max_height(room).auto_shrink([false, true]).show(ui, |ui| {
            ui.spacing_mut().scroll = scroll;
            contents(ui)
        })
    });
    shown.inner.inner
}
