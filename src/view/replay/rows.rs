//! The regions table at an instant: the hypotheses so far, and before there are any the windows and areas.

use super::RegionNames;
use crate::raster::{HypothesisId, RegionId};
use crate::trace::{Class, End, Event, Replay, Step, WindowClassified};

/// A hypothesis, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HypothesisRow {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Its pixels now.
    pub pixels: u32,
    /// Unit direction of its line, where it has one.
    pub direction: Option<[f64; 3]>,
    /// Radius of its cylinder, counts.
    pub radius: f64,
    /// What became of it by now.
    pub status: Status,
    /// The region that the hypothesis is, or is part of, in the result; none: no region.
    pub region: Option<RegionId>,
}

/// What became of a hypothesis by now.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// The step taken last is about it.
    AtWork,
    /// It stands.
    Stands,
    /// It was the broad highlight of another.
    Absorbed(HypothesisId),
    /// It became part of another.
    Merged(HypothesisId),
    /// It claimed too few pixels.
    Barren,
    /// It was too small to keep.
    Dropped,
}

impl Status {
    /// In a word or two.
    pub fn text(self) -> String {
        match self {
            Self::AtWork => "at work".to_owned(),
            Self::Stands => "stands".to_owned(),
            Self::Absorbed(by) => format!("absorbed by {by}"),
            Self::Merged(into) => format!("merged into {into}"),
            Self::Barren => "barren".to_owned(),
            Self::Dropped => "dropped".to_owned(),
        }
    }
}

/// The hypotheses so far, in the order of their birth.
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
            None if at_work == Some(id) => Status::AtWork,
            None => Status::Stands,
        },
        region: names.region_of(id),
    };
    replay.numbered_hypotheses().map(row).collect()
}

/// How many windows have been looked at, and what they were found to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WindowCounts {
    /// Windows of the grid.
    pub windows: usize,
    /// Classified ones, by class: point, line, plane, volume.
    pub classes: [usize; 4],
    /// Looked at, but with too few pixels for a class.
    pub unclassed: usize,
    /// Looked at, without a pixel to be believed.
    pub empty: usize,
    /// Not looked at yet.
    pub waiting: usize,
    /// Areas that the classified windows form so far.
    pub areas: usize,
}

/// The windows so far; none before a grid is laid.
pub fn window_counts(replay: &Replay) -> Option<WindowCounts> {
    let grid = replay.grid()?;
    let mut counts = WindowCounts { windows: grid.classes.len(), ..WindowCounts::default() };
    // Nothing is recorded of an empty window: those before the cursor's are such.
    let looked_at = match replay.last()? {
        Step::Event(Event::WindowClassified(WindowClassified { window, .. })) => *window as usize,
        Step::Event(Event::WindowsLaid(_)) => 0,
        _ => counts.windows,
    };
    for (window, (class, area)) in grid.classes.as_slice().iter().zip(grid.areas()).enumerate() {
        match class {
            None if window < looked_at => counts.empty += 1,
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
