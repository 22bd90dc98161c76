//! The owners of the pixels at the debugger's cursor, copied once for each place of the cursor.

use crate::app::State;
use crate::view::OwnersAtCursor;
use std::sync::Arc;

/// A place of the debugger's cursor: generation of the trace, and number of steps taken.
pub type CursorPlace = (u64, usize);

/// The owners that were copied last.
#[derive(Default)]
pub struct CursorOwners {
    last: Option<(CursorPlace, Arc<OwnersAtCursor>)>,
}

impl CursorOwners {
    /// The owners at the cursor, with the place of the cursor; none where panels show the result.
    pub fn get(&mut self, state: &State) -> Option<(CursorPlace, Arc<OwnersAtCursor>)> {
        let Some(replay) = state.followed() else {
            self.last = None;
            return None;
        };
        let place = (state.debugger.generation, replay.at());
        self.last.take_if(|(last, _)| *last != place);
        let copy = || (place, Arc::new(OwnersAtCursor::of(replay, &state.debugger.names)));
        Some(self.last.get_or_insert_with(copy).clone())
    }
}
