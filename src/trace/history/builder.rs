//! Goes through a trace once and notes what concerns one pixel.

use super::facts::{amounts, final_vectors, verdicts};
use super::growth::{Growth, Reaching, Regions, growing_test, highlight_test};
use super::local::Outside;
use super::patch::Patch;
use super::{HistoryEntry, HistoryKind, Release, SplitStory, Unfit};
use crate::photo::{LinearImage, Masks};
use crate::raster::HypothesisId;
use crate::reflection::Amounts;
use crate::trace::stage_trace::{Move, Owners};
use crate::trace::{
    Absorbed, ComponentSplit, Contest, Dropped, Event, GrowthBegan, HoleFilled, HypothesisChosen,
    HypothesisPassedOver, Measure, Pass, PassBegan, PassedOver, PixelKind, RegionsMerged, Renumbered, Stage,
    StageTrace, Trace, VectorsFitted,
};

/// What an event makes of the changes of hands that follow it.
#[derive(Clone, Copy, Default)]
enum Cause<'a> {
    #[default]
    Nothing,
    Seeds,
    Growth,
    Event(&'a Event),
}

/// What is known while the trace is gone through.
pub(super) struct HistoryBuilder<'a> {
    trace: &'a Trace,
    image: &'a LinearImage,
    masks: &'a Masks,
    pixel: usize,
    color: [f32; 3],
    /// The 4-neighbors and the hypothesis that has each.
    near: Vec<(usize, Option<HypothesisId>)>,
    /// The hypothesis that has the pixel.
    holder: Option<HypothesisId>,
    /// Whether distorted pixels wait for the clipping stage.
    waits: bool,
    regions: Regions<'a>,
    /// How the region of each hypothesis is split, by [`HypothesisId::index`].
    fitted: Vec<Option<&'a VectorsFitted>>,
    patch: Option<Patch<'a>>,
    /// What was decided where its region does not explain it.
    outside: Option<Outside>,
    stage: Stage,
    pass: Option<Pass>,
    cause: Cause<'a>,
    growth: Option<Growth<'a>>,
    /// Hypotheses merged in this pass: which, angle, distance.
    merges: Vec<(HypothesisId, f64, f64)>,
    told: Vec<HistoryEntry>,
}

impl<'a> HistoryBuilder<'a> {
    /// Of a pixel inside the picture.
    pub(super) fn new(trace: &'a Trace, image: &'a LinearImage, masks: &'a Masks, pixel: usize) -> Self {
        let mut near = Vec::with_capacity(4);
        image.pixels.for_each_neighbor(pixel, |index| near.push((index, None)));
        Self {
            trace,
            image,
            masks,
            pixel,
            color: image.pixels[pixel],
            near,
            holder: None,
            waits: false,
            regions: Regions::default(),
            fitted: final_vectors(trace),
            patch: None,
            outside: Outside::of(trace, image, masks, pixel),
            stage: Stage::Masks,
            pass: None,
            cause: Cause::Nothing,
            growth: None,
            merges: Vec::new(),
            told: Vec::new(),
        }
    }

    pub(super) fn tell(mut self) -> Vec<HistoryEntry> {
        let trace = self.trace;
        for (stage_trace, &start) in trace.stage_traces().iter().zip(trace.starts()) {
            let Some(stage) = stage_trace.stage() else { continue };
            (self.stage, self.pass) = (stage, None);
            self.go_through(stage_trace, start);
            self.end_growth();
            self.end_merging();
        }
        self.told.extend(self.outside.into_iter().flat_map(|outside| outside.told));
        // A refusal that is found out at the end of a growth happened when it came to the pixel.
        self.told.sort_by_key(|happening| happening.step);
        self.told
    }

    fn go_through(&mut self, stage_trace: &'a StageTrace, start: usize) {
        let concerned: Vec<(usize, Move)> = stage_trace
            .moves()
            .iter()
            .enumerate()
            .filter(|(_, change)| {
                let pixel = change.pixel();
                pixel == self.pixel || self.near.iter().any(|&(near, _)| near == pixel)
            })
            .map(|(index, &change)| (index, change))
            .collect();
        let mut moves =
            concerned.into_iter().map(|(index, m)| (stage_trace.step_of_move(index), index, m)).peekable();
        for (step, event) in stage_trace.events() {
            while let Some((at, index, change)) = moves.next_if(|&(at, ..)| at < step) {
                self.moved(start + at, change, stage_trace.contest_of_move(index));
            }
            self.hear(start + step, event);
        }
        for (at, index, change) in moves {
            self.moved(start + at, change, stage_trace.contest_of_move(index));
        }
        if let Some(step) = stage_trace.step_of_label(self.pixel) {
            self.split(start + step, stage_trace);
        }
    }

    fn note(&mut self, step: usize, what: HistoryKind) {
        self.told.push(HistoryEntry { step, stage: self.stage, what });
    }

    fn hear(&mut self, step: usize, event: &'a Event) {
        self.end_growth();
        self.regions.hear(event);
        self.cause = Cause::Event(event);
        let told = self.patch.as_mut().and_then(|patch| patch.hear(step, event));
        if let Some(what) = told {
            self.note(step, what);
        }
        match event {
            Event::MasksMade(made) => {
                for verdict in verdicts(self.image, self.masks, &made.limits, self.pixel) {
                    self.note(step, HistoryKind::Masked(verdict));
                }
            }
            Event::PassBegan(PassBegan { pass }) => {
                self.pass = Some(*pass);
                self.merges.clear();
                self.end_merging();
            }
            Event::WindowsLaid(laid) => {
                self.waits = if self.stage == Stage::Classify { laid.tail_test } else { self.waits };
                // A second look is at what is in no region.
                let looked_at = self.holder.is_none() && self.masks.usable(self.pixel);
                self.patch = (self.stage == Stage::Classify || looked_at)
                    .then(|| Patch::new(laid, self.pixel, self.image.width()));
            }
            Event::SeedsPlaced(_) => self.cause = Cause::Seeds,
            Event::GrowthBegan(GrowthBegan { hypothesis, limit }) => {
                self.begin_growth(step, *hypothesis, *limit);
            }
            Event::RegionsMerged(RegionsMerged { hypothesis, angle_deg, rms, .. }) => {
                self.merges.push((*hypothesis, *angle_deg, *rms));
            }
            Event::HypothesisChosen(_) | Event::HypothesisPassedOver(_) => self.hear_of_area(step, event),
            Event::Renumbered(Renumbered { regions }) => {
                if let Some(hypothesis) = self.holder
                    && let Some(&region) = regions.get(hypothesis.index())
                {
                    self.note(step, HistoryKind::Numbered { hypothesis, region });
                }
            }
            _ => {}
        }
    }

    fn hear_of_area(&mut self, step: usize, event: &Event) {
        let is_own = |area| self.patch.as_ref().is_some_and(|patch| patch.is_area(area));
        match event {
            Event::HypothesisChosen(chosen) if is_own(chosen.area) => {
                let &HypothesisChosen { hypothesis, rank, pixels, radius, .. } = &**chosen;
                self.note(step, HistoryKind::AreaChosen { hypothesis, rank, pixels, radius });
            }
            Event::HypothesisPassedOver(HypothesisPassedOver {
                pixels,
                least,
                reason: PassedOver::Barren,
                ..
            }) => {
                // Said after the pixels were given back.
                let given_back = self.told.iter_mut().rev().find_map(|happening| match &mut happening.what {
                    HistoryKind::Released { why: Release::Barren { pixels, least }, .. } => {
                        Some((pixels, least))
                    }
                    _ => None,
                });
                if let Some(slots) = given_back.filter(|(_, least)| **least == 0) {
                    (*slots.0, *slots.1) = (*pixels, *least);
                }
            }
            Event::HypothesisPassedOver(HypothesisPassedOver { area, pixels, least, reason })
                if is_own(*area) && self.holder.is_none() =>
            {
                let what = HistoryKind::AreaPassedOver { pixels: *pixels, least: *least, reason: *reason };
                self.note(step, what);
            }
            _ => {}
        }
    }

    fn end_merging(&mut self) {
        // The areas of the first grid merge in a stage of their own.
        if self.stage != Stage::Classify
            && let Some((step, what)) = self.patch.as_mut().and_then(Patch::merged)
        {
            self.note(step, what);
        }
    }

    fn begin_growth(&mut self, step: usize, hypothesis: HypothesisId, limit: f32) {
        self.cause = Cause::Growth;
        let reaching = match self.stage {
            Stage::Linear => {
                self.regions.cylinder(hypothesis).map(|(axis, radius)| Reaching::Cylinder(axis, radius))
            }
            Stage::Planar => self.regions.slice(hypothesis).map(Reaching::Slice),
            _ => Some(Reaching::Brighter(limit)),
        };
        let Some(reaching) = reaching else { return };
        let test = self.fitted.get(hypothesis.index()).copied().flatten();
        let test = test.and_then(growing_test);
        // By brightness only highlight pixels grow.
        let grows = |pixel: usize| match reaching {
            Reaching::Brighter(_) => test.is_some_and(|test| test.is_highlight(self.image.pixels[pixel])),
            _ => true,
        };
        let beside = self.near.iter().any(|&(pixel, holder)| holder == Some(hypothesis) && grows(pixel));
        let visited = (beside && self.holder != Some(hypothesis)).then_some(step);
        self.growth = Some(Growth { hypothesis, reaching, visited, settled: false });
    }

    fn end_growth(&mut self) {
        let Some(Growth { hypothesis, reaching, visited: Some(step), settled: false }) = self.growth.take()
        else {
            return;
        };
        let by_brightness = matches!(reaching, Reaching::Brighter(_));
        let claimable = if by_brightness {
            self.masks.claimable_by_brightness(self.pixel)
        } else {
            self.masks.claimable_by_color(self.pixel, self.waits)
        };
        if !claimable {
            let stage = self.stage;
            let earlier = self.told.iter_mut().rev().take_while(|happening| happening.stage == stage);
            let mut lists = earlier.filter_map(|happening| match &mut happening.what {
                HistoryKind::Unclaimable { hypotheses } => Some(hypotheses),
                _ => None,
            });
            match lists.next() {
                Some(hypotheses) if hypotheses.contains(&hypothesis) => {}
                Some(hypotheses) => hypotheses.push(hypothesis),
                None => self.note(step, HistoryKind::Unclaimable { hypotheses: vec![hypothesis] }),
            }
            return;
        }
        // What has an owner is not asked for its brightness.
        if by_brightness && self.holder.is_some() {
            return;
        }
        if let Some(barrier) = reaching.barrier(self.color) {
            self.note(step, HistoryKind::Refused { hypothesis, barrier });
        }
    }

    fn moved(&mut self, step: usize, change: Move, contest: Option<Contest>) {
        if change.pixel() == self.pixel {
            match change.change() {
                Some(owners) => {
                    self.handed(step, owners, contest);
                    self.holder = owners.after;
                }
                None => self.kept(step, change.owners(), contest),
            }
            return;
        }
        let Some(Owners { after, .. }) = change.change() else { return };
        for (pixel, holder) in &mut self.near {
            if *pixel == change.pixel() {
                *holder = after;
            }
        }
        if let Some(growth) = &mut self.growth
            && Some(growth.hypothesis) == after
            && self.holder != after
        {
            growth.visited.get_or_insert(step);
        }
    }

    fn kept(&mut self, step: usize, owners: Owners, contest: Option<Contest>) {
        let Owners { before: Some(holder), after: Some(challenger) } = owners else { return };
        let known = self.growth.as_mut().filter(|growth| growth.hypothesis == challenger);
        // A hypothesis that comes from several sides is refused each time, on the same numbers.
        let again = known.is_some_and(|growth| std::mem::replace(&mut growth.settled, true));
        if let Some(contest) = contest.filter(|_| !again) {
            self.note(step, HistoryKind::Kept { holder, challenger, contest });
        }
    }

    fn handed(&mut self, step: usize, owners: Owners, contest: Option<Contest>) {
        let vote = contest.filter(|contest| contest.measure == Measure::Vote);
        let what = match (self.pass, vote, self.cause) {
            (_, Some(vote), _) => voted(owners, &vote),
            (Some(Pass::Reset), ..) => {
                owners.before.map(|from| HistoryKind::Reset { from, to: owners.after })
            }
            (Some(Pass::Uniting | Pass::Joining), ..) => self.merged(owners),
            (_, _, Cause::Seeds) => self.seeded(owners),
            (_, _, Cause::Growth) => self.grown(owners, contest),
            (_, _, Cause::Event(event)) => self.given(owners, event),
            (_, _, Cause::Nothing) => None,
        };
        if let Some(what) = what {
            self.note(step, what);
        }
    }

    /// What a change of owner was for which two hypotheses became one.
    fn merged(&self, owners: Owners) -> Option<HistoryKind> {
        let (from, into) = (owners.before?, owners.after?);
        let merge = self.merges.iter().find(|(vanished, ..)| *vanished == from);
        merge.map(|&(_, angle_deg, rms)| HistoryKind::Merged { from, into, angle_deg, rms })
    }

    /// What a change of owner before a hypothesis's growth was.
    fn seeded(&self, owners: Owners) -> Option<HistoryKind> {
        let hypothesis = owners.after?;
        let (axis, radius) = self.regions.cylinder(hypothesis)?;
        Some(HistoryKind::Seeded { hypothesis, reach: Reaching::Cylinder(axis, radius).reach(self.color) })
    }

    /// What a change of hands during a region's growth was.
    fn grown(&mut self, owners: Owners, contest: Option<Contest>) -> Option<HistoryKind> {
        let growth = self.growth.as_mut()?;
        let (hypothesis, from) = (growth.hypothesis, owners.before);
        if Some(hypothesis) == owners.after {
            growth.settled = true;
            let reach = growth.reaching.reach(self.color);
            return Some(HistoryKind::Claimed { hypothesis, from, reach, contest });
        }
        // Growth gives nothing back: it has ended and was for nothing. The numbers come with the next event.
        growth.settled = true;
        let why = Release::Barren { pixels: 0, least: 0 };
        from.map(|hypothesis| HistoryKind::Released { hypothesis, why })
    }

    /// What a change of hands that an event announced was.
    fn given(&self, owners: Owners, event: &Event) -> Option<HistoryKind> {
        let released = |why| owners.before.map(|hypothesis| HistoryKind::Released { hypothesis, why });
        match *event {
            Event::LineRefitted(_) => {
                let (axis, radius) = self.regions.cylinder(owners.before?)?;
                released(Release::Refit { distance: axis.distance2(self.color).sqrt(), radius })
            }
            Event::Absorbed(Absorbed { by, highlight_foot, object_foot, gap, .. }) => {
                released(Release::Absorbed { by, highlight_foot, object_foot, gap })
            }
            Event::Dropped(Dropped { pixels, .. }) => released(Release::Dropped { pixels }),
            Event::HoleFilled(HoleFilled { hypothesis, pixels, border_share, .. }) => {
                Some(HistoryKind::Filled { hypothesis, pixels, border_share })
            }
            Event::ComponentSplit(ComponentSplit { hypothesis, part, pixels }) => {
                Some(HistoryKind::Separated { hypothesis, part, pixels })
            }
            _ => None,
        }
    }

    fn split(&mut self, step: usize, stage_trace: &StageTrace) {
        let kind = stage_trace.kinds().and_then(|kinds| kinds.as_slice().get(self.pixel)).copied();
        let fitted = self.holder.and_then(|holder| *self.fitted.get(holder.index())?);
        let (Some(kind), Some(fitted)) = (kind, fitted) else { return };
        let believed = matches!(kind, PixelKind::Matte | PixelKind::Highlight);
        let test = highlight_test(fitted).filter(|_| fitted.surface.is_some() && believed);
        let Amounts { components, removed_offset } = amounts(fitted, self.color);
        self.note(
            step,
            HistoryKind::Split(Box::new(SplitStory {
                region: fitted.region,
                kind,
                lines: test.map(|test| test.distances(self.color)),
                amounts: believed.then_some(components),
                cut: removed_offset.filter(|_| believed),
                least_offset: fitted.least_offset,
                ambient: fitted.origin,
                unfit: self.outside.as_ref().map(|outside| Unfit {
                    fit: [fitted.rms_counts, fitted.texture, fitted.texture_slope],
                    limits: fitted.limits,
                    has_plane: fitted.surface.is_some(),
                    model_fits: fitted.model_fits,
                    surface: outside.surface,
                }),
            })),
        );
    }
}

/// What a change of owner by the majority around a pixel was.
fn voted(owners: Owners, vote: &Contest) -> Option<HistoryKind> {
    let (from, hypothesis) = (owners.before?, owners.after?);
    let votes = [vote.challenger as u32, vote.holder as u32];
    Some(HistoryKind::Voted { from, hypothesis, votes })
}
