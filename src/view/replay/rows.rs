//! The table of the regions at an instant: the hypotheses so far, and before the first hypothesis the windows and areas.

use super::RegionNames;
use crate::raster::{HypothesisId, RegionId};
use crate::trace::{Class, End, Event, Replay, Step, WindowClassified};

/// A row of the table: a hypothesis at the instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HypothesisRow {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Number of its pixels.
    pub pixels: u32,
    /// Unit direction of the line, where there is one.
    pub direction: Option<[f64; 3]>,
    /// Radius of the cylinder, counts.
    pub radius: f64,
    /// The status at the instant.
    pub status: Status,
    /// The region that the hypothesis is, or is part of, in the result; none: no region.
    pub region: Option<RegionId>,
}

/// The status of a hypothesis at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// The step taken last is about the hypothesis.
    AtWork,
    /// The hypothesis stands.
    Stands,
    /// The hypothesis was the broad highlight of another.
    Absorbed(HypothesisId),
    /// The hypothesis became part of another.
    Merged(HypothesisId),
    /// The hypothesis claimed too few pixels.
    Barren,
    /// The hypothesis was too small to keep.
    Dropped,
    /// The hypothesis, a region of an earlier method, was divided into parts.
    Divided,
}

impl Status {
    /// The status in a word or two.
    pub fn text(self) -> String {
        match self {
            Self::AtWork => "growing now".to_owned(),
            Self::Stands => "complete".to_owned(),
            Self::Absorbed(by) => format!("absorbed by {by}"),
            Self::Merged(into) => format!("merged into {into}"),
            Self::Barren => "barren".to_owned(),
            Self::Dropped => "dropped".to_owned(),
            Self::Divided => "divided".to_owned(),
        }
    }
}

/// The hypotheses so far, in the order in which they were made.
pub fn hypothesis_rows(replay: &Replay, names: &RegionNames) -> Vec<HypothesisRow> {
    let last = replay.at().checked_sub(1);
    let at_work = last.and_then(|last| replay.trace().block_at(last)).map(|block| block.topic.hypothesis());
    let row = |(id, hypothesis): (HypothesisId, &crate::trace::Hypothesis)| HypothesisRow {
        hypothesis: id,
        pixels: replay.size(id),
        direction: hypothesis.line().map(|line| line.direction.into()),
        radius: hypothesis.radius,
        status: match hypothesis.end() {
            Some(End::Barren) => Status::Barren,
            Some(End::Absorbed(by)) => Status::Absorbed(by),
            Some(End::Merged(into)) => Status::Merged(into),
            Some(End::Dropped) => Status::Dropped,
            Some(End::Divided) => Status::Divided,
            None if at_work == Some(id) => Status::AtWork,
            None => Status::Stands,
        },
        region: names.region_of(id),
    };
    replay.numbered_hypotheses().map(row).collect()
}

/// Numbers of windows by class, at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WindowCounts {
    /// Number of windows of the grid.
    pub windows: usize,
    /// Numbers of classified windows by class: point, line, plane, volume.
    pub classes: [usize; 4],
    /// Number of windows with too few valid pixels for a class.
    pub unclassed: usize,
    /// Number of windows without a valid pixel, before the window of the step taken last.
    pub empty: usize,
    /// Number of windows that were not classified yet.
    pub waiting: usize,
    /// Number of areas that the classified windows form so far.
    pub areas: usize,
}

/// The numbers of windows so far; none before a grid is laid.
pub fn window_counts(replay: &Replay) -> Option<WindowCounts> {
    let grid = replay.grid()?;
    let mut counts = WindowCounts { windows: grid.classes.len(), ..WindowCounts::default() };
    // No event is recorded of an empty window: unclassified windows before the window at the cursor are empty.
    let step_pixels = match replay.last()? {
        Step::Event(Event::WindowClassified(WindowClassified { window, .. })) => *window as usize,
        Step::Event(Event::WindowsLaid(_)) => 0,
        _ => counts.windows,
    };
    for (window, (class, area)) in grid.classes.as_slice().iter().zip(grid.areas()).enumerate() {
        match class {
            None if window < step_pixels => counts.empty += 1,
            None => counts.waiting += 1,
            Some(None) => counts.unclassed += 1,
            Some(Some(class)) => {
                counts.classes[match class {
                    Class::Point => 0,
                    Class::Line => 1,
                    Class::Plane => 2,
                    Class::Volume => 3,
                }] += 1;
                counts.areas += usize::from(area as usize == window);
            }
        }
    }
    Some(counts)
}
