//! The pixels that the step at the cursor is about: the color space view shows them in full, all others faintly.

use super::growth_pixels::{
    candidate_pixels, growth_pixels, measured_and_ignored, pixels_of_region, sampled, test_at_cursor,
};
use crate::photo::{ClippedAreaVerdict, Masks};
use crate::raster::{HypothesisId, Raster};
use crate::trace::{Class, Event, Grid, MergeTried, RepairVerdict, Replay, Stage, Step, WindowClassified};
use crate::view::Meaning;
use crate::view::Meaning::{Refused, Taken};

/// The part of a group of pixels in the step at the cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What the step did with the pixels. Taken: pixels of the hypothesis, of the area that would remain, or of a blob that is a
    /// highlight. Refused: pixels that the hypothesis did not take, of the area that would vanish, or of a blob that is no
    /// highlight.
    Meaning(Meaning),
    /// Pixels of a window of this class (5.2.1).
    Window(Option<Class>),
}

/// A group of pixels, and its part in the step.
pub type StepPixels = (Role, Vec<u32>);

/// The pixels that the step at the cursor is about, at most `most` of each group, evenly chosen. `focus` is the hypothesis whose
/// pixels stand in where the step is about no pixels.
pub fn step_pixels(
    replay: &Replay,
    focus: Option<HypothesisId>,
    colors: &Raster<[f32; 3]>,
    masks: &Masks,
    most: usize,
) -> Vec<StepPixels> {
    let groups = groups(replay, focus, colors, masks).into_iter();
    let few = |(role, pixels): StepPixels| (role, sampled(&pixels, most).collect::<Vec<u32>>());
    groups.map(few).filter(|(_, pixels)| !pixels.is_empty()).collect()
}

/// Groups of pixels by their meanings.
fn of_meanings<const N: usize>(groups: [(Meaning, Vec<u32>); N]) -> Vec<StepPixels> {
    groups.map(|(meaning, pixels)| (Role::Meaning(meaning), pixels)).into()
}

fn groups(
    replay: &Replay,
    focus: Option<HypothesisId>,
    colors: &Raster<[f32; 3]>,
    masks: &Masks,
) -> Vec<StepPixels> {
    if let Some(test) = test_at_cursor(replay) {
        let own = pixels_of_region(replay, test.hypothesis);
        let (measured, ignored) = measured_and_ignored(test, &own, colors);
        let candidate = candidate_pixels(replay, test, masks);
        return of_meanings([
            (Taken, measured),
            (Meaning::Ignored, ignored),
            (Meaning::Candidate, candidate),
        ]);
    }
    if let Some(grown) = growth_pixels(replay, colors, masks) {
        return of_meanings([
            (Taken, pixels_of_region(replay, grown.hypothesis)),
            (Refused, grown.outside),
            (Meaning::JustTaken, grown.newest),
        ]);
    }
    if let Some((blob, kept)) = blob_at_cursor(replay) {
        return of_meanings([(if kept { Taken } else { Refused }, blob)]);
    }
    let width = colors.width();
    match (replay.last(), replay.grid()) {
        (Some(Step::Event(Event::WindowClassified(WindowClassified { window, class, .. }))), Some(grid)) => {
            vec![(Role::Window(*class), pixels_in(grid, width, colors.height(), |at| at == *window as usize))]
        }
        (Some(Step::Event(Event::MergeTried(MergeTried { into, from, class, union, .. }))), Some(grid)) => {
            let areas = grid.areas();
            let root = |window: &u32| areas.get(*window as usize).copied();
            let pixels = |root: Option<u32>| {
                pixels_in(grid, width, colors.height(), |at| areas.get(at).copied() == root)
            };
            let mut groups = of_meanings([(Taken, pixels(root(into)))]);
            if class != union {
                groups.push((Role::Meaning(Refused), pixels(root(from))));
            }
            groups
        }
        _ => focus.map_or_else(Vec::new, |focus| of_meanings([(Taken, pixels_of_region(replay, focus))])),
    }
}

/// The pixels of the clipped area that the step taken last judged, and whether the area may be a highlight or is filled.
pub fn blob_at_cursor(replay: &Replay) -> Option<(Vec<u32>, bool)> {
    let (blob, kept) = match replay.last()? {
        Step::Event(Event::ClippedAreaJudged(judged)) => {
            let pixels = judged.pixels.iter().map(|pixel| pixel.get()).collect();
            return Some((pixels, judged.verdict != ClippedAreaVerdict::Object));
        }
        Step::Event(Event::RepairTried(tried)) => (tried.blob, tried.verdict == RepairVerdict::Filled),
        _ => return None,
    };
    Some((replay.trace().stage_trace(Stage::Split)?.local()?.blob(blob), kept))
}

/// The pixels of some windows, window by window.
fn pixels_in(grid: &Grid, width: usize, height: usize, wanted: impl Fn(usize) -> bool) -> Vec<u32> {
    let (side, columns) = ((grid.laid.size_px as usize).max(1), (grid.laid.columns as usize).max(1));
    let mut pixels = Vec::new();
    for window in (0..grid.classes.len()).filter(|&window| wanted(window)) {
        let (left, top) = (window % columns * side, window / columns * side);
        for y in top..(top + side).min(height) {
            pixels.extend((left..(left + side).min(width)).map(|x| (y * width + x) as u32));
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{PixelIndex, Roi};
    use crate::trace::{
        LocalPoint, LocalPoints, LocalRecord, Measured, Recorder, RepairTried, Trace, TraceRecorder,
    };
    use std::sync::Arc;

    #[test]
    fn a_step_about_a_blob_is_about_its_pixels() {
        let window = Roi::around((4, 2), 0, |_| true).unwrap();
        let mut of = Raster::filled(4, 2, LocalPoint::default());
        of[1].set_blob(1);
        of[2].set_blob(1);
        of[7].set_blob(2);
        let mut recorder = TraceRecorder::default();
        for (blob, pixel, verdict) in [(1, 1, RepairVerdict::NoRise), (2, 7, RepairVerdict::Filled)] {
            recorder.record(RepairTried {
                blob,
                pixel: PixelIndex::new(pixel),
                pixels: 2,
                ring: Measured::new(0.5, 0.4),
                inner: 2.0,
                outer: 1.0,
                spread: Measured::new(0.1, 0.5),
                around: Measured::new(2.0, 1.0),
                verdict,
            });
        }
        recorder.local(LocalRecord::Points(LocalPoints { roi: window, of, restored: Vec::new() }));
        let stage_trace = Arc::new(recorder.finish(Stage::Split).unwrap());
        let mut replay = Replay::new(Arc::new(Trace::new(4, 2, vec![stage_trace])));
        assert_eq!(blob_at_cursor(&replay), None);
        replay.forward();
        assert_eq!(blob_at_cursor(&replay), Some((vec![1, 2], false)));
        replay.forward();
        assert_eq!(blob_at_cursor(&replay), Some((vec![7], true)));
    }
}
