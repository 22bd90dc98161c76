//! The findings about an item at the debugger's cursor: what is decided so far, and nothing of what is decided later.

use super::item::left_out;
use super::{Inspection, Tone};
use crate::describe::counted;
use crate::raster::{HypothesisId, PixelIndex, RegionId};
use crate::trace::{Class, PixelKind, Replay};
use crate::view::{HypothesisRow, Item, PixelReading, RegionNames, ResultSnapshot, hypothesis_rows};

/// The findings about an item at the cursor; none where the photograph has no such item. `shown`: the result whose trace is replayed, for
/// the colors of the photograph.
pub fn inspect_item_at(
    replay: &Replay,
    names: &RegionNames,
    shown: &ResultSnapshot,
    item: Item,
) -> Option<Inspection> {
    match item {
        Item::Pixel(pixel) => of_pixel(replay, names, shown, pixel),
        Item::Region(region) => Some(of_region(replay, names, region)),
        Item::Window(window) => Some(of_window(replay, window)),
        Item::Bin(_) => super::inspect_item(shown, item),
    }
}

/// The findings before the first step.
pub fn inspect_beginning(steps: usize) -> Inspection {
    Inspection {
        sentence: format!("{} follow; the timeline or an arrow key leads to them", counted(steps, "step")),
        ..finding("Step 0".to_owned(), "Nothing is decided yet", Tone::Neutral, "4")
    }
}

fn finding(subject: String, verdict: &str, tone: Tone, section: &'static str) -> Inspection {
    let (verdict, sentence) = (verdict.to_owned(), String::new());
    Inspection { subject, verdict, tone, sentence, tests: Vec::new(), of_region: None, section }
}

fn of_pixel(
    replay: &Replay,
    names: &RegionNames,
    shown: &ResultSnapshot,
    pixel: PixelIndex,
) -> Option<Inspection> {
    let reading = PixelReading::at_cursor(&shown.picture, replay, names, pixel.index())?;
    let analyzed = reading.analyzed?;
    let [x, y] = reading.at;
    let subject = format!("Pixel {x}, {y}");
    if let Some(found) = left_out(shown, pixel, &subject) {
        return Some(found);
    }
    let Some(hypothesis) = analyzed.region.and_then(HypothesisId::from_label) else {
        return Some(finding(subject, "In no hypothesis so far", Tone::Neutral, "5.3"));
    };
    let becomes = names.region_of(hypothesis);
    let becomes = becomes.map_or_else(String::new, |region| format!(", which becomes region {region}"));
    // Which kind of pixel it is, is decided at the end alone.
    let kind = match analyzed.kind {
        PixelKind::Unassigned => String::new(),
        kind => format!("{} ", kind.name()),
    };
    Some(Inspection {
        sentence: format!("{kind}pixel of hypothesis {hypothesis}{becomes}"),
        ..finding(subject, &format!("In hypothesis {hypothesis}"), Tone::Good, "5.3")
    })
}

fn of_region(replay: &Replay, names: &RegionNames, region: RegionId) -> Inspection {
    let rows = hypothesis_rows(replay, names);
    let of_region: Vec<&HypothesisRow> = rows.iter().filter(|row| row.region == Some(region)).collect();
    let subject = format!("Region {region}");
    if of_region.is_empty() {
        return finding(subject, "Not begun", Tone::Neutral, "5.3");
    }
    let pixels: u32 = of_region.iter().map(|row| row.pixels).sum();
    let counted = |pixels: u32| working_pixels(pixels, replay.trace().pixel_blocks().side());
    let parts = of_region
        .iter()
        .map(|row| format!("hypothesis {} {}, {}", row.hypothesis, row.status.text(), counted(row.pixels)));
    Inspection {
        sentence: parts.collect::<Vec<_>>().join("; "),
        ..finding(subject, &format!("{} so far", counted(pixels)), Tone::Neutral, "5.3")
    }
}

/// A number of working pixels in words; `side`: side of a working pixel, pixels of the photograph.
fn working_pixels(pixels: u32, side: usize) -> String {
    let counted = counted(pixels, "pixel");
    if side > 1 { format!("{counted} of {side} \u{d7} {side}") } else { counted }
}

fn of_window(replay: &Replay, window: u32) -> Inspection {
    let class = replay.first_grid().and_then(|grid| grid.classes.as_slice().get(window as usize).copied());
    let verdict = match class.flatten() {
        None => "Not classified yet",
        Some(class) => class.map_or("No class", Class::name),
    };
    finding(format!("Window {}", window + 1), verdict, Tone::Neutral, "5.2.1")
}
