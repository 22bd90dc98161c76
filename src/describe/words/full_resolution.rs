//! What the pass at full resolution made of a pixel, in words.

use super::Names;
use crate::segment::{PixelPlace, PlaceRule};
use crate::trace::{Ancestor, HistoryEntry};

impl Names {
    /// How a pixel of the photograph took its region, where regions were found in a working picture with larger pixels.
    /// `is_looked_at_again`: sentences of the second look follow.
    pub fn pixel_place(&self, place: &PixelPlace, is_looked_at_again: bool) -> String {
        let side = place.side;
        let of_working =
            place.working_region.map_or("in no region".to_owned(), |region| format!("in region {region}"));
        let took =
            place.region.map_or("is in no region".to_owned(), |region| format!("takes region {region}"));
        let why = match (place.rule, place.region) {
            (PlaceRule::Dark, _) => format!("it is not lit; its working pixel is {of_working}"),
            (PlaceRule::Distorted, _) => {
                format!("it is clipped or bloomed, and its working pixel is {of_working}")
            }
            (PlaceRule::Inside, _) => {
                format!("its working pixel and the working pixels around are {of_working}")
            }
            (PlaceRule::Border, Some(_)) => format!(
                "its own color fits that region best of those around; its working pixel is {of_working}"
            ),
            (PlaceRule::SecondLook { side: finer }, _) => format!(
                "the second look found it in a picture with blocks of {finer} \u{d7} {finer} pixels; its working pixel is {of_working}"
            ),
            (PlaceRule::Border, None) => {
                format!("its own color fits no region around; its working pixel is {of_working}")
            }
        };
        let others = if is_looked_at_again { "all that is not of the second look" } else { "all else" };
        format!(
            "at full resolution the pixel {took}: {why}; {others} is told of the working pixel, the mean of {side} \u{d7} {side} pixels"
        )
    }

    /// A decision of the second look about a pixel. These are the names in the record of the second look.
    pub fn second_look_entry(&self, entry: &HistoryEntry) -> String {
        format!("second look: {}", self.history_entry(entry))
    }

    /// What a region of the second look is made of. These are the names in the record of the second look, whose hypotheses are numbered
    /// apart from those of the working picture.
    pub fn second_look_ancestor(&self, ancestor: &Ancestor) -> String {
        format!("second look: {}", self.ancestor(ancestor))
    }
}
