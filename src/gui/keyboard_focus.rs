//! The ring around the widget that has the focus of the keyboard.

use super::theme::ThemeColors;
use egui::{
    Context, FocusDirection, Id, Key, LayerId, Order, Popup, Response, Stroke, StrokeKind, SurrenderFocusOn,
};

/// Whether keys belong to a text that is being edited or to an open menu, and to no view.
pub fn is_keyboard_owned(ctx: &Context) -> bool {
    ctx.text_edit_focused() || Popup::is_any_open(ctx)
}

/// Lets a press beside a field end the editing of its text. Otherwise only a click does, and after a slider was dragged Ctrl+Z would be for
/// the field.
pub fn end_editing_on_press(ctx: &Context) {
    ctx.options_mut(|options| options.input_options.surrender_focus_on = SurrenderFocusOn::Presses);
}

/// The focus, where it came by a key. A focus that came by the pointer needs no ring: the pointer shows the place.
#[derive(Default)]
pub struct KeyboardFocus {
    /// Whether the focus came by the key Tab, or in a menu by an arrow key.
    is_by_key: bool,
    /// Whether the last Tab was pressed with Shift.
    is_moving_back: bool,
}

impl KeyboardFocus {
    /// Moves the focus on from a handle between two panels, which no key can move. To be called before the panels are shown.
    pub fn skip_splitters(&self, ctx: &Context) {
        // Reading the response of the focused widget takes the focus away while the pointer is pressed elsewhere.
        if !self.is_by_key || ctx.input(|input| input.pointer.any_pressed()) {
            return;
        }
        let focused = ctx.memory(egui::Memory::focused).and_then(|id| ctx.read_response(id));
        let grab_pt = ctx.global_style().interaction.resize_grab_radius_side * 2.0;
        let is_splitter = |widget: &Response| {
            let size = widget.rect.size();
            widget.sense.senses_drag() && size.min_elem() <= grab_pt + 0.5 && size.max_elem() > 4.0 * grab_pt
        };
        if focused.is_some_and(|widget| is_splitter(&widget)) {
            let direction = if self.is_moving_back { FocusDirection::Previous } else { FocusDirection::Next };
            ctx.memory_mut(|memory| memory.move_focus(direction));
            ctx.request_repaint();
        }
    }

    /// Paints a ring around the focused widget, when the focus came by a key. A selection has a fill and no ring. To be called
    /// after the panels are shown.
    pub fn show(&mut self, ctx: &Context, palette: &ThemeColors) {
        let in_menu = Popup::is_any_open(ctx);
        let (by_tab, by_arrow, by_pointer, shift) = ctx.input(|input| {
            let is_arrow = [Key::ArrowUp, Key::ArrowDown, Key::ArrowLeft, Key::ArrowRight, Key::F10]
                .into_iter()
                .any(|key| input.key_pressed(key));
            let (tab, pointer) = (input.key_pressed(Key::Tab), input.pointer.any_pressed());
            (tab, in_menu && is_arrow, pointer, input.modifiers.shift)
        });
        if by_tab {
            self.is_moving_back = shift;
        }
        let by_key = by_tab || by_arrow;
        self.is_by_key = (self.is_by_key || by_key) && !by_pointer;
        let focused = ctx.memory(egui::Memory::focused).filter(|_| self.is_by_key);
        if let Some(widget) = focused.and_then(|id| ctx.read_response(id)) {
            let layer = LayerId::new(Order::Foreground, Id::unique("focus ring"));
            let rect = widget.rect.intersect(widget.interact_rect.expand(1.0)).expand(2.0);
            ctx.layer_painter(layer).rect_stroke(
                rect,
                4.0,
                Stroke::new(2.0, palette.text),
                StrokeKind::Inside,
            );
        }
    }
}
