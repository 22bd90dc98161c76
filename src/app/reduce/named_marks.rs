//! The changes of the named marks.

use crate::app::NamedMarkEdit;
use crate::raster::Mask;
use crate::view::{NamedMark, Selection};
use std::sync::Arc;

/// Changes the named marks of a selection. An edit of a mark that does not exist changes nothing.
pub(super) fn edit_named_marks(selection: &mut Selection, edit: NamedMarkEdit) {
    let mut named = (*selection.named).clone();
    match edit {
        NamedMarkEdit::Keep => {
            let Some(mask) = selection.marked.clone() else { return };
            let mark = NamedMark::new(named.free_name(), named.free_color(), mask);
            named.marks.push(mark);
            named.active = Some(named.marks.len() - 1);
        }
        NamedMarkEdit::Activate(index) => {
            let Some(mark) = named.marks.get(index) else { return };
            selection.marked = Some(Arc::clone(&mark.mask)).filter(|_| mark.pixels > 0);
            named.active = Some(index);
        }
        NamedMarkEdit::Release => (named.active, selection.marked) = (None, None),
        NamedMarkEdit::Rename(index, name) => {
            let Some(mark) = named.marks.get_mut(index) else { return };
            mark.name = name;
        }
        NamedMarkEdit::Recolor(index) => {
            let color = named.free_color();
            let Some(mark) = named.marks.get_mut(index) else { return };
            mark.color = color;
        }
        NamedMarkEdit::Remove(index) => {
            if index >= named.marks.len() {
                return;
            }
            named.marks.remove(index);
            let (was_active, before) = (named.active == Some(index), named.active);
            named.active = before.filter(|_| !was_active).map(|active| active - usize::from(active > index));
            if was_active {
                selection.marked = None;
            }
        }
    }
    selection.named = Arc::new(named);
}

/// Gives the marked pixels to the active mark, after a tool has changed the marked pixels. `size`: columns and rows of the
/// photograph.
pub(super) fn update_active_mark(selection: &mut Selection, size: (usize, usize)) {
    let Some(active) = selection.named.active else { return };
    let mut named = (*selection.named).clone();
    let Some(mark) = named.marks.get_mut(active) else { return };
    let empty = || Arc::new(Mask::filled(size.0, size.1, false));
    mark.set_mask(selection.marked.clone().unwrap_or_else(empty));
    selection.named = Arc::new(named);
}
