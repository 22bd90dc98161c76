//! The lineage of a region: the tree of hypotheses, absorptions, merges and separations that made the region, and the story of
//! each hypothesis.

use super::replay_state::ReplayState;
use super::{
    Absorbed, CandidateChosen, CandidateTested, ComponentSplit, Event, HistogramsSearched, Hypothesis,
    HypothesisChosen, LineRefitted, MarkedLineFitted, MatteAreasUnited, PatchMade, RegionsMerged, Renumbered,
    SliceMade, Trace,
};
use crate::raster::{HypothesisId, RegionId};

/// A hypothesis that a region is made of. In the list of [`lineage`] those that joined it follow it, one deeper.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ancestor<'a> {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// Number of joinings between the hypothesis and the region.
    pub depth: usize,
    /// How the hypothesis began.
    pub birth: Birth<'a>,
    /// How the hypothesis became part of another one; none for the hypothesis that became the region.
    pub joined: Option<Joined>,
}

impl Ancestor<'_> {
    /// The step at which the hypothesis became part of another one; of the hypothesis that became the region, the step at which it
    /// began.
    pub fn step(&self) -> usize {
        let (Birth::Area { step: born, .. }
        | Birth::Part { step: born, .. }
        | Birth::Picture { step: born, .. }
        | Birth::Marked { step: born, .. }) = self.birth;
        self.joined.map_or(born, |joined| joined.step)
    }
}

/// How a hypothesis began.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Birth<'a> {
    /// As the hypothesis of a merged area (5.3.1).
    Area {
        /// The step.
        step: usize,
        /// The event.
        chosen: &'a HypothesisChosen,
    },
    /// As a separate part of a hypothesis.
    Part {
        /// The step.
        step: usize,
        /// The hypothesis that it was separated from.
        of: HypothesisId,
        /// Number of pixels of the part.
        pixels: u32,
    },
    /// As a region of an earlier method that is no part of another region (5.1, 7.2).
    Picture {
        /// The step.
        step: usize,
        /// Number of pixels of the region.
        pixels: u32,
    },
    /// As the skewed T of marked pixels (section 6, the method by hand).
    Marked {
        /// The step.
        step: usize,
        /// The first fit of the matte line.
        fitted: &'a MarkedLineFitted,
    },
}

/// How a hypothesis became part of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Joined {
    /// The step.
    pub step: usize,
    /// The hypothesis that it became part of.
    pub to: HypothesisId,
    /// How.
    pub how: JoinedHow,
}

/// The way in which a hypothesis became part of another one, see [`Joined`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JoinedHow {
    /// The hypothesis was the broad highlight of the other one.
    Absorbed {
        /// Distance of the highlight's line from black, counts.
        highlight_foot: f64,
        /// Distance of the object's line from black, counts.
        object_foot: f64,
        /// Distance between the lines, counts.
        gap: f64,
    },
    /// The lines of both do not differ significantly.
    Merged {
        /// Angle between the lines, degrees.
        angle_deg: f64,
        /// Root mean square distance of the pixels from the line of the other hypothesis, counts.
        rms: f64,
    },
    /// The matte areas of both form a single cluster, and the growth of the other one took most of the pixels (section 5.4.2).
    United {
        /// Number of pixels that were taken.
        taken_px: u32,
        /// Number of all pixels of the matte area.
        area_px: u32,
    },
    /// The other hypothesis was separated from this one.
    Whole,
}

/// The hypotheses that made a region: the hypothesis that became the region first, each followed by those that joined it, in
/// the order of their joining. Empty where there is no such region.
pub fn lineage(trace: &Trace, region: RegionId) -> Vec<Ancestor<'_>> {
    let Some(hypothesis) = hypothesis_of(trace, region) else { return Vec::new() };
    let state = ReplayState::at_end(trace);
    let joins = joins(trace, &state);
    let mut ancestors = Vec::new();
    // Hypothesis, depth, how the hypothesis joined, and the step from which on nothing concerns the region any more.
    let mut waiting = vec![(hypothesis, 0, None, usize::MAX)];
    while let Some((hypothesis, depth, joined, before)) = waiting.pop() {
        let Some(birth) = state.hypothesis(hypothesis).and_then(|found| birth(trace, found)) else {
            continue;
        };
        ancestors.push(Ancestor { hypothesis, depth, birth, joined });
        let mut found: Vec<_> = joins
            .iter()
            .filter(|(_, joined)| joined.to == hypothesis && joined.step < before)
            .map(|&(from, joined)| (from, depth + 1, Some(joined), joined.step))
            .collect();
        if let Birth::Part { step, of, .. } = birth {
            let joined = Joined { step, to: hypothesis, how: JoinedHow::Whole };
            found.push((of, depth + 1, Some(joined), step));
        }
        found.sort_by_key(|&(.., before)| std::cmp::Reverse(before));
        // A stack: the hypothesis that joined first lies on top.
        waiting.extend(found);
    }
    ancestors
}

/// The hypothesis that became a region; none where there is no such region.
fn hypothesis_of(trace: &Trace, region: RegionId) -> Option<HypothesisId> {
    let index = regions_of(trace)?.iter().position(|&found| found == Some(region))?;
    Some(HypothesisId::from_index(index))
}

/// The region of each hypothesis, by [`HypothesisId::index`], none for a hypothesis that is in no region; `None` before the
/// regions are numbered.
pub fn regions_of(trace: &Trace) -> Option<&[Option<RegionId>]> {
    trace.events().rev().find_map(|(_, event)| match event {
        Event::Renumbered(Renumbered { regions }) => Some(&**regions),
        _ => None,
    })
}

/// The region of a hypothesis in the result; none when the hypothesis is in no region.
pub fn region_of(trace: &Trace, hypothesis: HypothesisId) -> Option<RegionId> {
    regions_of(trace)?.get(hypothesis.index()).copied().flatten()
}

/// How a hypothesis began.
fn birth<'t>(trace: &'t Trace, hypothesis: &Hypothesis) -> Option<Birth<'t>> {
    let id = *hypothesis.events.first()?;
    let step = trace.step_of_event(id);
    match trace.event_at(id) {
        Event::HypothesisChosen(chosen) => Some(Birth::Area { step, chosen }),
        Event::ComponentSplit(ComponentSplit { hypothesis, pixels, .. }) => {
            Some(Birth::Part { step, of: *hypothesis, pixels: *pixels })
        }
        Event::PatchMade(PatchMade { of, pixels, .. }) => Some(match *of {
            Some(of) => Birth::Part { step, of, pixels: *pixels },
            None => Birth::Picture { step, pixels: *pixels },
        }),
        Event::MarkedLineFitted(fitted) => Some(Birth::Marked { step, fitted }),
        _ => None,
    }
}

/// Every hypothesis that became part of another, and how, in the order of the steps.
fn joins(trace: &Trace, state: &ReplayState) -> Vec<(HypothesisId, Joined)> {
    let events = state.hypotheses.iter().flat_map(|hypothesis| &hypothesis.events);
    let mut joins: Vec<_> = events
        .filter_map(|&id| {
            let step = trace.step_of_event(id);
            match *trace.event_at(id) {
                Event::Absorbed(Absorbed { hypothesis, by, highlight_foot, object_foot, gap }) => {
                    let how = JoinedHow::Absorbed { highlight_foot, object_foot, gap };
                    Some((hypothesis, Joined { step, to: by, how }))
                }
                Event::RegionsMerged(RegionsMerged { hypothesis, into, angle_deg, rms }) => {
                    let how = JoinedHow::Merged { angle_deg, rms };
                    Some((hypothesis, Joined { step, to: into, how }))
                }
                Event::MatteAreasUnited(MatteAreasUnited { hypothesis, into, taken_px, area_px }) => {
                    let how = JoinedHow::United { taken_px, area_px };
                    Some((hypothesis, Joined { step, to: into, how }))
                }
                _ => None,
            }
        })
        .collect();
    joins.sort_by_key(|(_, joined)| joined.step);
    joins
}

/// The story of one hypothesis. Steps are numbered through the whole trace.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct HypothesisStory<'a> {
    /// The choice of the hypothesis; none for a part that was separated.
    pub chosen: Option<(usize, &'a HypothesisChosen)>,
    /// The step at which the part was separated, the hypothesis that it was part of, and the number of its pixels.
    pub separated: Option<(usize, HypothesisId, u32)>,
    /// How a region of an earlier method was made.
    pub made: Option<(usize, &'a PatchMade)>,
    /// The search of the histograms of a region of an earlier method that is homogeneous.
    pub searched: Option<(usize, &'a HistogramsSearched)>,
    /// The fits of both lines of marked pixels.
    pub marked: Vec<(usize, &'a MarkedLineFitted)>,
    /// The fits of the line after the first.
    pub refits: Vec<(usize, &'a LineRefitted)>,
    /// The tests of neighbors as its highlight (5.4.1).
    pub tests: Vec<(usize, &'a CandidateTested)>,
    /// The highlight that was chosen.
    pub highlight: Option<(usize, &'a CandidateChosen)>,
    /// The slices, one for each estimate of the light.
    pub slices: Vec<(usize, &'a SliceMade)>,
    /// The hypotheses that became part of this one.
    pub joined: Vec<(HypothesisId, Joined)>,
    /// The event that ended the hypothesis; none where it stands.
    pub end: Option<(usize, &'a Event)>,
    /// The region that the hypothesis became; none where it became no region, and before the regions are numbered.
    pub region: Option<RegionId>,
}

/// The story of a hypothesis; none where there is no such hypothesis.
pub fn story(trace: &Trace, hypothesis: HypothesisId) -> Option<HypothesisStory<'_>> {
    let state = ReplayState::at_end(trace);
    let mut story = HypothesisStory::default();
    for &id in &state.hypothesis(hypothesis)?.events {
        let (step, event) = (trace.step_of_event(id), trace.event_at(id));
        match event {
            Event::HypothesisChosen(chosen) => story.chosen = Some((step, chosen)),
            Event::ComponentSplit(ComponentSplit { hypothesis: of, pixels, .. }) => {
                story.separated = Some((step, *of, *pixels));
            }
            Event::MarkedLineFitted(fitted) => story.marked.push((step, fitted)),
            Event::PatchMade(made) => story.made = Some((step, made)),
            Event::HistogramsSearched(searched) if searched.chosen().is_none() => {
                story.searched = Some((step, searched));
            }
            Event::LineRefitted(refitted) => story.refits.push((step, refitted)),
            Event::CandidateTested(test) => story.tests.push((step, test)),
            Event::CandidateChosen(chosen) => story.highlight = Some((step, chosen)),
            Event::SliceMade(made) => story.slices.push((step, made)),
            _ => story.end = Some((step, event)),
        }
    }
    story.joined = joins(trace, &state).into_iter().filter(|(_, joined)| joined.to == hypothesis).collect();
    story.region = state.region_of(trace, hypothesis);
    Some(story)
}
