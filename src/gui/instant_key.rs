//! The identity of the instant at the debugger's cursor.

use crate::app::State;
use crate::raster::HypothesisId;

/// The identity of an instant: the number of the result whose trace it is in, the cursor's step, and the chosen region.
pub type InstantKey = (u64, usize, Option<HypothesisId>);

/// The instant that the color space shows; none where it shows the result.
pub fn instant_key(state: &State) -> Option<InstantKey> {
    let replay = state.followed()?;
    Some((state.debugger.generation, replay.at(), state.debugger.chosen))
}
