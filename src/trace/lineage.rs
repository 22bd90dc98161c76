//! Where a region came from: the tree of hypotheses, absorptions, merges and separations that made it, and the story of
//! each hypothesis in it.

use super::{
    Absorbed, CandidateChosen, CandidateTested, ComponentSplit, Dropped, Event, HypothesisChosen,
    HypothesisPassedOver, LineRefitted, PassedOver, RegionsMerged, Renumbered, SliceMade, Trace,
};
use crate::raster::{HypothesisId, RegionId};

/// A hypothesis that a region is made of. In the list of [`lineage`] those that joined it follow it, one deeper.
#[derive(Clone, Debug, PartialEq)]
pub struct Ancestor<'a> {
    /// The hypothesis.
    pub hypothesis: HypothesisId,
    /// How many joinings lie between it and the final region.
    pub depth: usize,
    /// How it began.
    pub birth: Birth<'a>,
    /// How it became part of what it precedes; none for the final region itself.
    pub joined: Option<Joined>,
}

impl Ancestor<'_> {
    /// The step at which it became part of what it precedes; of the final region itself, that of its birth.
    pub fn step(&self) -> usize {
        let (Birth::Area { step: born, .. } | Birth::Part { step: born, .. }) = self.birth;
        self.joined.map_or(born, |joined| joined.step)
    }
}

/// How a region began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Birth<'a> {
    /// As the hypothesis of a merged area (5.3.1).
    Area {
        /// The step.
        step: usize,
        /// What it was chosen by.
        chosen: &'a HypothesisChosen,
    },
    /// As a part of a region that lay apart.
    Part {
        /// The step.
        step: usize,
        /// The hypothesis that it was separated from.
        of: HypothesisId,
        /// Pixels of the part.
        pixels: u32,
    },
}

/// How a region became part of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joined {
    /// The step.
    pub step: usize,
    /// The hypothesis that it became part of.
    pub to: HypothesisId,
    /// How.
    pub how: JoinedHow,
}

/// See [`Joined`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JoinedHow {
    /// It was the other's broad highlight.
    Absorbed {
        /// Distance of the highlight's line from black, counts.
        highlight_foot: f64,
        /// Distance of the object's line from black, counts.
        object_foot: f64,
        /// Distance between the lines, counts.
        gap: f64,
    },
    /// Their lines could not be told apart.
    Merged {
        /// Angle between the lines, degrees.
        angle_deg: f64,
        /// Root mean square distance of its pixels from the other's line, counts.
        rms: f64,
    },
    /// The other one was separated from it.
    Whole,
}

/// The hypotheses that made a region: the hypothesis that became the region first, each followed by those that joined it, in
/// the order of their joining. Empty where there is no such region.
pub fn lineage(trace: &Trace, region: RegionId) -> Vec<Ancestor<'_>> {
    let Some(hypothesis) = hypothesis_of(trace, region) else { return Vec::new() };
    let (births, joins) = (births(trace), joins(trace));
    let mut ancestors = Vec::new();
    // Hypothesis, depth, how the hypothesis joined, and the step from which on nothing concerns the region any more.
    let mut waiting = vec![(hypothesis, 0, None, usize::MAX)];
    while let Some((hypothesis, depth, joined, before)) = waiting.pop() {
        let Some(&birth) = births.get(hypothesis.index()) else { continue };
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
        // A stack: what joined first lies on top.
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

fn births(trace: &Trace) -> Vec<Birth<'_>> {
    let mut births = Vec::new();
    for (step, event) in trace.events() {
        match event {
            Event::HypothesisChosen(chosen) => births.push(Birth::Area { step, chosen }),
            Event::ComponentSplit(ComponentSplit { hypothesis, pixels, .. }) => {
                births.push(Birth::Part { step, of: *hypothesis, pixels: *pixels });
            }
            _ => {}
        }
    }
    births
}

fn joins(trace: &Trace) -> Vec<(HypothesisId, Joined)> {
    let joined = |(step, event): (usize, &Event)| match *event {
        Event::Absorbed(Absorbed { hypothesis, by, highlight_foot, object_foot, gap }) => Some((
            hypothesis,
            Joined { step, to: by, how: JoinedHow::Absorbed { highlight_foot, object_foot, gap } },
        )),
        Event::RegionsMerged(RegionsMerged { hypothesis, into, angle_deg, rms }) => {
            Some((hypothesis, Joined { step, to: into, how: JoinedHow::Merged { angle_deg, rms } }))
        }
        _ => None,
    };
    trace.events().filter_map(joined).collect()
}

/// What became of one hypothesis. All steps are the trace's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HypothesisStory<'a> {
    /// Why it was chosen; none for a part that was separated.
    pub chosen: Option<(usize, &'a HypothesisChosen)>,
    /// Step at which it was separated, the hypothesis that it was part of, and its pixels.
    pub separated: Option<(usize, HypothesisId, u32)>,
    /// Its line after each fit that followed the first.
    pub refits: Vec<(usize, &'a LineRefitted)>,
    /// Its neighbors, tested as its highlight (5.4.1).
    pub tests: Vec<(usize, &'a CandidateTested)>,
    /// The highlight that was chosen.
    pub highlight: Option<(usize, &'a CandidateChosen)>,
    /// Its slices, one for each estimate of the light.
    pub slices: Vec<(usize, &'a SliceMade)>,
    /// Hypotheses that became part of it.
    pub joined: Vec<(HypothesisId, Joined)>,
    /// The event that ended it; none where it stands.
    pub end: Option<(usize, &'a Event)>,
    /// Its region in the result; none where it is in no region, and before the regions are numbered.
    pub region: Option<RegionId>,
}

/// The story of a hypothesis; none where there is no such hypothesis.
pub fn story(trace: &Trace, hypothesis: HypothesisId) -> Option<HypothesisStory<'_>> {
    let mut story = HypothesisStory::default();
    let mut newest = None;
    for (step, event) in trace.events() {
        match event {
            Event::HypothesisChosen(chosen) => {
                newest = Some(chosen.hypothesis);
                if newest == Some(hypothesis) {
                    story.chosen = Some((step, chosen));
                }
            }
            Event::ComponentSplit(ComponentSplit { hypothesis: of, part, pixels }) => {
                newest = Some(*part);
                if newest == Some(hypothesis) {
                    story.separated = Some((step, *of, *pixels));
                }
            }
            Event::LineRefitted(refitted) if refitted.hypothesis == hypothesis => {
                story.refits.push((step, refitted))
            }
            Event::CandidateTested(test) if test.hypothesis == hypothesis => story.tests.push((step, test)),
            Event::CandidateChosen(chosen) if chosen.hypothesis == hypothesis => {
                story.highlight = Some((step, chosen));
            }
            Event::SliceMade(made) if made.hypothesis == hypothesis => story.slices.push((step, made)),
            Event::HypothesisPassedOver(HypothesisPassedOver { reason: PassedOver::Barren, .. })
                if newest == Some(hypothesis) =>
            {
                story.end = Some((step, event));
            }
            Event::Absorbed(Absorbed { hypothesis: ended, .. })
            | Event::RegionsMerged(RegionsMerged { hypothesis: ended, .. })
            | Event::Dropped(Dropped { hypothesis: ended, .. })
                if *ended == hypothesis =>
            {
                story.end = Some((step, event));
            }
            _ => {}
        }
    }
    if story.chosen.is_none() && story.separated.is_none() {
        return None;
    }
    story.joined = joins(trace).into_iter().filter(|(_, joined)| joined.to == hypothesis).collect();
    story.region = region_of(trace, hypothesis);
    Some(story)
}
