//! Where a region came from: the tree of hypotheses, absorptions, merges and separations that made it, and the story of
//! each hypothesis in it.

use super::{
    Absorbed, CandidateChosen, CandidateTested, ComponentSplit, Dropped, Event, HypothesisChosen,
    HypothesisPassedOver, LineRefitted, PassedOver, RegionsMerged, Renumbered, SliceMade, Trace,
};

/// A hypothesis that a region is made of. In the list of [`lineage`] those that joined it follow it, one deeper.
#[derive(Clone, Debug, PartialEq)]
pub struct Ancestor<'a> {
    /// The region, by its number of birth.
    pub region: u16,
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
        /// The region that it was separated from.
        of: u16,
        /// Pixels of the part.
        pixels: u32,
    },
}

/// How a region became part of another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joined {
    /// The step.
    pub step: usize,
    /// The region that it became part of.
    pub to: u16,
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

/// The hypotheses that made a region, by its final number: itself first, each followed by those that joined it, in the
/// order of their joining. Empty where there is no such region.
pub fn lineage(trace: &Trace, number: u16) -> Vec<Ancestor<'_>> {
    let Some(region) = birth_number(trace, number) else { return Vec::new() };
    let (births, joins) = (births(trace), joins(trace));
    let mut ancestors = Vec::new();
    // Region, depth, how it joined, and the step from which on nothing concerns this region any more.
    let mut waiting = vec![(region, 0, None, usize::MAX)];
    while let Some((region, depth, joined, before)) = waiting.pop() {
        let index = usize::from(region) - 1;
        let Some(&birth) = births.get(index) else { continue };
        ancestors.push(Ancestor { region, depth, birth, joined });
        let mut found: Vec<_> = joins
            .iter()
            .filter(|(_, joined)| joined.to == region && joined.step < before)
            .map(|&(from, joined)| (from, depth + 1, Some(joined), joined.step))
            .collect();
        if let Birth::Part { step, of, .. } = birth {
            let joined = Joined { step, to: region, how: JoinedHow::Whole };
            found.push((of, depth + 1, Some(joined), step));
        }
        found.sort_by_key(|&(.., before)| std::cmp::Reverse(before));
        // A stack: what joined first lies on top.
        waiting.extend(found);
    }
    ancestors
}

/// A region's number of birth from its final one.
fn birth_number(trace: &Trace, number: u16) -> Option<u16> {
    let finals = final_numbers(trace)?;
    let index = finals.iter().position(|&given| given == number && number > 0)?;
    Some(index as u16 + 1)
}

/// The final number of each region at index `birth − 1`, 0 for those that are no more; none before numbers are given.
pub fn final_numbers(trace: &Trace) -> Option<&[u16]> {
    trace.events().rev().find_map(|(_, event)| match event {
        Event::Renumbered(Renumbered { finals }) => Some(&**finals),
        _ => None,
    })
}

/// Region id of a hypothesis in the result; `None` when the hypothesis is in no region.
pub fn region_id(trace: &Trace, hypothesis: u16) -> Option<u16> {
    let index = usize::from(hypothesis).checked_sub(1)?;
    final_numbers(trace)?.get(index).copied().filter(|&region| region > 0)
}

fn births(trace: &Trace) -> Vec<Birth<'_>> {
    let mut births = Vec::new();
    for (step, event) in trace.events() {
        match event {
            Event::HypothesisChosen(chosen) => births.push(Birth::Area { step, chosen }),
            Event::ComponentSplit(ComponentSplit { region, pixels, .. }) => {
                births.push(Birth::Part { step, of: *region, pixels: *pixels });
            }
            _ => {}
        }
    }
    births
}

fn joins(trace: &Trace) -> Vec<(u16, Joined)> {
    let joined = |(step, event): (usize, &Event)| match *event {
        Event::Absorbed(Absorbed { region, by, highlight_foot, object_foot, gap }) => Some((
            region,
            Joined { step, to: by, how: JoinedHow::Absorbed { highlight_foot, object_foot, gap } },
        )),
        Event::RegionsMerged(RegionsMerged { region, into, angle_deg, rms }) => {
            Some((region, Joined { step, to: into, how: JoinedHow::Merged { angle_deg, rms } }))
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
    /// Step at which it was separated, the region that it was part of, and its pixels.
    pub separated: Option<(usize, u16, u32)>,
    /// Its line after each fit that followed the first.
    pub refits: Vec<(usize, &'a LineRefitted)>,
    /// Its neighbors, tested as its highlight (5.4.1).
    pub tests: Vec<(usize, &'a CandidateTested)>,
    /// The highlight that was chosen.
    pub highlight: Option<(usize, &'a CandidateChosen)>,
    /// Its slices, one for each estimate of the light.
    pub slices: Vec<(usize, &'a SliceMade)>,
    /// Regions that became part of it.
    pub joined: Vec<(u16, Joined)>,
    /// The event that ended it; none where it stands.
    pub end: Option<(usize, &'a Event)>,
    /// Its number in the result; 0 where it is not in it, none before numbers are given.
    pub number: Option<u16>,
}

/// The story of a hypothesis by its number of birth; none where there is no such hypothesis.
pub fn story(trace: &Trace, region: u16) -> Option<HypothesisStory<'_>> {
    let mut story = HypothesisStory::default();
    let mut born = 0u16;
    for (step, event) in trace.events() {
        match event {
            Event::HypothesisChosen(chosen) => {
                born = chosen.region;
                if born == region {
                    story.chosen = Some((step, chosen));
                }
            }
            Event::ComponentSplit(ComponentSplit { region: of, part, pixels }) => {
                born = *part;
                if born == region {
                    story.separated = Some((step, *of, *pixels));
                }
            }
            Event::LineRefitted(refitted) if refitted.region == region => story.refits.push((step, refitted)),
            Event::CandidateTested(test) if test.region == region => story.tests.push((step, test)),
            Event::CandidateChosen(chosen) if chosen.region == region => {
                story.highlight = Some((step, chosen));
            }
            Event::SliceMade(made) if made.region == region => story.slices.push((step, made)),
            Event::HypothesisPassedOver(HypothesisPassedOver { reason: PassedOver::Barren, .. })
                if born == region =>
            {
                story.end = Some((step, event));
            }
            Event::Absorbed(Absorbed { region: ended, .. })
            | Event::RegionsMerged(RegionsMerged { region: ended, .. })
            | Event::Dropped(Dropped { region: ended, .. })
                if *ended == region =>
            {
                story.end = Some((step, event));
            }
            _ => {}
        }
    }
    if story.chosen.is_none() && story.separated.is_none() {
        return None;
    }
    story.joined = joins(trace).into_iter().filter(|(_, joined)| joined.to == region).collect();
    let index = usize::from(region).checked_sub(1);
    story.number = final_numbers(trace).and_then(|finals| finals.get(index?).copied());
    Some(story)
}
