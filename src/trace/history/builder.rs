//! The history of one pixel, made in one pass over a trace: the changes of owner of the pixel and of its 4-neighbors, and the
//! state of the analysis ([`ReplayState`]) at each of them.

use super::facts::{amounts, verdicts};
use super::growth::{Growth, Reaching, clipped_test, growing_test, highlight_test};
use super::local::Outside;
use super::patch::Patch;
use super::{BorderLimit, HistoryEntry, HistoryKind, MaskVerdict, Release, SplitStory, Unfit};
use crate::color::{Cylinder, vec3};
use crate::photo::{ClippedAreaVerdict, LinearImage, Masks};
use crate::raster::{HypothesisId, PixelIndex};
use crate::reflection::Amounts;
use crate::trace::replay_state::ReplayState;
use crate::trace::stage_trace::{Move, Owners};
use crate::trace::timeline::EventId;
use crate::trace::{
    Absorbed, ComponentSplit, Contest, Dropped, Event, GrowthBegan, HoleFilled, HypothesisChosen,
    HypothesisPassedOver, MarkedPixelsTaken, Measure, Pass, PassBegan, PassedOver, PatchMade, PixelKind,
    RegionsMerged, Renumbered, Stage, StageTrace, Trace,
};

/// The cause of the changes of owner that follow an event.
#[derive(Clone, Copy, Default)]
enum Cause<'a> {
    #[default]
    Nothing,
    Seeds,
    Growth,
    Event(&'a Event),
}

/// The pass over the trace, and the entries so far.
pub(super) struct HistoryBuilder<'a> {
    trace: &'a Trace,
    image: &'a LinearImage,
    masks: &'a Masks,
    pixel: usize,
    /// Color of the pixel, counts.
    color: [f32; 3],
    /// The 4-neighbors and the hypothesis that has each.
    near: Vec<(usize, Option<HypothesisId>)>,
    /// The hypothesis that has the pixel.
    holder: Option<HypothesisId>,
    /// Value from which on a band is clipped, counts.
    clip_threshold: f64,
    /// Whether distorted pixels cannot be claimed before the clipping stage.
    distorted_wait: bool,
    /// The state after the events so far.
    state: ReplayState,
    /// The state after all events.
    end: ReplayState,
    /// The pixel's window in the newest grid; none where that grid was not laid for the pixel.
    patch: Option<Patch<'a>>,
    /// The limit of the pixel's surface reflection by a border; none where there is none.
    border: Option<BorderLimit>,
    /// The decisions about the pixel as one that no region explains; none where a region explains the pixel.
    outside: Option<Outside>,
    stage: Stage,
    pass: Option<Pass>,
    cause: Cause<'a>,
    growth: Option<Growth<'a>>,
    /// The merges of this pass.
    merges: Vec<RegionsMerged>,
    entries: Vec<HistoryEntry>,
}

impl<'a> HistoryBuilder<'a> {
    /// A pass that has not begun, about a pixel inside the picture.
    pub(super) fn new(trace: &'a Trace, image: &'a LinearImage, masks: &'a Masks, pixel: usize) -> Self {
        let mut near = Vec::with_capacity(4);
        image.pixels.for_each_neighbor(pixel, |index| near.push((index, None)));
        let end = ReplayState::at_end(trace);
        Self {
            trace,
            image,
            masks,
            pixel,
            color: image.pixels[pixel],
            near,
            holder: None,
            clip_threshold: f64::INFINITY,
            distorted_wait: false,
            state: ReplayState::default(),
            outside: Outside::of(trace, &end, image, masks, pixel),
            end,
            patch: None,
            border: None,
            stage: Stage::Masks,
            pass: None,
            cause: Cause::Nothing,
            growth: None,
            merges: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// All entries, oldest first.
    pub(super) fn entries(mut self) -> Vec<HistoryEntry> {
        let trace = self.trace;
        for (index, stage_trace) in trace.stage_traces().iter().enumerate() {
            let Some(stage) = stage_trace.stage() else { continue };
            (self.stage, self.pass) = (stage, None);
            self.take_stage(index, stage_trace);
            self.end_growth();
            self.end_merging();
        }
        self.entries.extend(self.outside.into_iter().flat_map(|outside| outside.entries));
        // A refusal is known at the end of a growth only, but belongs to the step at which the growth reached the pixel.
        self.entries.sort_by_key(|entry| entry.step);
        self.entries
    }

    fn take_stage(&mut self, stage: usize, stage_trace: &'a StageTrace) {
        let start = self.trace.starts()[stage];
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
        for (index, (step, event)) in stage_trace.events().enumerate() {
            while let Some((at, index, change)) = moves.next_if(|&(at, ..)| at < step) {
                self.take_move(start + at, change, stage_trace.contest_of_move(index));
            }
            self.take_event(start + step, event, EventId { stage, index });
        }
        for (at, index, change) in moves {
            self.take_move(start + at, change, stage_trace.contest_of_move(index));
        }
        if let Some(step) = stage_trace.step_of_kind(self.pixel) {
            self.take_kind(start + step, stage_trace);
        }
    }

    fn note(&mut self, step: usize, what: HistoryKind) {
        self.entries.push(HistoryEntry { step, stage: self.stage, what });
    }

    fn take_event(&mut self, step: usize, event: &'a Event, id: EventId) {
        self.end_growth();
        self.cause = Cause::Event(event);
        let about_window = self.patch.as_mut().zip(self.state.grids.last());
        if let Some(what) = about_window.and_then(|(patch, grid)| patch.entry(grid, step, event)) {
            self.note(step, what);
        }
        self.state.take(event, id);
        match event {
            Event::MasksMade(made) => {
                self.clip_threshold = made.limits.clip_threshold;
                for verdict in verdicts(self.image, self.masks, &made.limits, self.pixel) {
                    self.note(step, HistoryKind::Masked(verdict));
                }
            }
            Event::ClippedAreaJudged(judged)
                if judged.verdict == ClippedAreaVerdict::Object
                    && judged.holds(PixelIndex::from_index(self.pixel)) =>
            {
                let verdict = MaskVerdict::ClippedObject { clipped: judged.clipped, left: judged.left };
                self.note(step, HistoryKind::Masked(verdict));
            }
            Event::PassBegan(PassBegan { pass }) => {
                self.pass = Some(*pass);
                self.merges.clear();
                self.end_merging();
            }
            Event::WindowsLaid(laid) => {
                if self.stage == Stage::Classify {
                    self.distorted_wait = laid.tail_test;
                }
                // Smaller windows are laid on pixels in no hypothesis.
                let is_leftover = self.holder.is_none() && self.masks.usable(self.pixel);
                self.patch = (self.stage == Stage::Classify || is_leftover)
                    .then(|| Patch::new(laid, self.pixel, self.image.width()));
            }
            Event::SeedsPlaced(_) => self.cause = Cause::Seeds,
            Event::GrowthBegan(GrowthBegan { hypothesis, limit }) => {
                self.begin_growth(step, *hypothesis, *limit);
            }
            Event::BordersLimited(limited) => {
                let kept = limited.kept(PixelIndex::from_index(self.pixel));
                self.border = kept.map(|kept| BorderLimit { kept, reach_px: limited.reach_px });
            }
            Event::RegionsMerged(merged) => self.merges.push(*merged),
            Event::HypothesisChosen(_) | Event::HypothesisPassedOver(_) => self.take_area(step, event),
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

    /// Takes an event about an area.
    fn take_area(&mut self, step: usize, event: &Event) {
        let window = self.patch.as_ref().zip(self.state.grids.last());
        let is_own = |area| window.is_some_and(|(patch, grid)| patch.is_area(grid, area));
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
                // This event follows the changes of owner that gave the pixels back.
                let given_back = self.entries.iter_mut().rev().find_map(|entry| match &mut entry.what {
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
        let fitted = self.end.vectors_of(self.trace, hypothesis);
        let reaching = match self.stage {
            Stage::Linear => {
                self.cylinder(hypothesis).map(|(cylinder, radius)| Reaching::Cylinder(cylinder, radius))
            }
            Stage::Planar => self.state.slice(self.trace, hypothesis).map(Reaching::Slice),
            _ => Some(Reaching::Brighter(
                limit,
                fitted.and_then(|fitted| clipped_test(fitted, self.clip_threshold)),
            )),
        };
        let Some(reaching) = reaching else { return };
        let test = fitted.and_then(growing_test);
        // Growth by brightness starts from highlight pixels only.
        let grows = |pixel: usize| match reaching {
            Reaching::Brighter(..) => test.is_some_and(|test| test.is_highlight(self.image.pixels[pixel])),
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
        let by_brightness = matches!(reaching, Reaching::Brighter(..));
        let claimable = if by_brightness {
            self.masks.claimable_by_brightness(self.pixel)
        } else {
            self.masks.claimable_by_color(self.pixel, self.distorted_wait)
        };
        if !claimable {
            let stage = self.stage;
            let earlier = self.entries.iter_mut().rev().take_while(|entry| entry.stage == stage);
            let mut lists = earlier.filter_map(|entry| match &mut entry.what {
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
        // Growth by brightness takes pixels without an owner only.
        if by_brightness && self.holder.is_some() {
            return;
        }
        if let Some(barrier) = reaching.barrier(self.color) {
            self.note(step, HistoryKind::Refused { hypothesis, barrier });
        }
    }

    /// The cylinder of a hypothesis at this step, and its radius, counts.
    fn cylinder(&self, hypothesis: HypothesisId) -> Option<(Cylinder, f64)> {
        let known = self.state.hypothesis(hypothesis)?;
        Some((known.cylinder()?, known.radius))
    }

    /// Takes a change of owner of the pixel or of a neighbor.
    fn take_move(&mut self, step: usize, change: Move, contest: Option<Contest>) {
        if change.pixel() == self.pixel {
            match change.change() {
                Some(owners) => {
                    self.take_change(step, owners, contest);
                    self.holder = owners.after;
                }
                None => self.take_refusal(step, change.owners(), contest),
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

    /// Takes a change of the pixel's owner that was refused.
    fn take_refusal(&mut self, step: usize, owners: Owners, contest: Option<Contest>) {
        let Owners { before: Some(holder), after: Some(challenger) } = owners else { return };
        let known = self.growth.as_mut().filter(|growth| growth.hypothesis == challenger);
        // A hypothesis that reaches the pixel from several sides is refused each time, by the same numbers.
        let again = known.is_some_and(|growth| std::mem::replace(&mut growth.settled, true));
        if let Some(contest) = contest.filter(|_| !again) {
            self.note(step, HistoryKind::Kept { holder, challenger, contest });
        }
    }

    /// Takes a change of the pixel's owner.
    fn take_change(&mut self, step: usize, owners: Owners, contest: Option<Contest>) {
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

    /// The entry of a change of owner by which two hypotheses became one.
    fn merged(&self, owners: Owners) -> Option<HistoryKind> {
        let (from, into) = (owners.before?, owners.after?);
        let merge = self.merges.iter().find(|merged| merged.hypothesis == from)?;
        Some(HistoryKind::Merged { from, into, angle_deg: merge.angle_deg, rms: merge.rms })
    }

    /// The entry of a pixel that a growth starts from.
    fn seeded(&self, owners: Owners) -> Option<HistoryKind> {
        let hypothesis = owners.after?;
        let (cylinder, radius) = self.cylinder(hypothesis)?;
        let reach = Reaching::Cylinder(cylinder, radius).reach(self.color);
        Some(HistoryKind::Seeded { hypothesis, reach })
    }

    /// The entry of a change of owner during a growth.
    fn grown(&mut self, owners: Owners, contest: Option<Contest>) -> Option<HistoryKind> {
        let growth = self.growth.as_mut()?;
        let (hypothesis, from) = (growth.hypothesis, owners.before);
        if Some(hypothesis) == owners.after {
            growth.settled = true;
            let reach = growth.reaching.reach(self.color);
            return Some(HistoryKind::Claimed { hypothesis, from, reach, contest });
        }
        // A growth gives no pixel back: the hypothesis claimed too few pixels. The event with the numbers follows.
        growth.settled = true;
        let why = Release::Barren { pixels: 0, least: 0 };
        from.map(|hypothesis| HistoryKind::Released { hypothesis, why })
    }

    /// The entry of a change of owner that an event announced.
    fn given(&self, owners: Owners, event: &Event) -> Option<HistoryKind> {
        let released = |why| owners.before.map(|hypothesis| HistoryKind::Released { hypothesis, why });
        match *event {
            Event::LineRefitted(_) => {
                let (cylinder, radius) = self.cylinder(owners.before?)?;
                released(Release::Refit { distance: cylinder.distance2(self.color).sqrt(), radius })
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
            Event::PatchMade(PatchMade { hypothesis, of, pixels, interval, .. }) => {
                let code = interval.map_or(0, |interval| interval.feature.code(self.color));
                Some(HistoryKind::Patched { hypothesis, of, pixels, interval, code })
            }
            Event::MarkedPixelsTaken(MarkedPixelsTaken { hypothesis, cluster, .. }) => {
                let line = self.state.hypothesis(hypothesis)?.line()?;
                let distance = line.distance(&vec3(self.color));
                Some(HistoryKind::Marked { hypothesis, cluster, distance })
            }
            _ => None,
        }
    }

    /// Takes the step at which the pixel gets its kind and is split.
    fn take_kind(&mut self, step: usize, stage_trace: &StageTrace) {
        let kind = stage_trace.kinds().and_then(|kinds| kinds.as_slice().get(self.pixel)).copied();
        let fitted = self.holder.and_then(|holder| self.end.vectors_of(self.trace, holder));
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
                amounts: (believed && !fitted.unsplit).then_some(components),
                unsplit: fitted.unsplit,
                cut: removed_offset.filter(|_| believed),
                border: self.border,
                least_offset: fitted.least_offset,
                ambient: fitted.origin,
                unfit: self.outside.as_ref().map(|outside| Unfit {
                    fit: fitted.figures,
                    limits: fitted.limits,
                    has_plane: fitted.surface.is_some(),
                    model_fits: fitted.model_fits,
                    surface: outside.surface,
                }),
            })),
        );
    }
}

/// The entry of a change of owner by the majority around the pixel.
fn voted(owners: Owners, vote: &Contest) -> Option<HistoryKind> {
    let (from, hypothesis) = (owners.before?, owners.after?);
    let votes = [vote.challenger as u32, vote.holder as u32];
    Some(HistoryKind::Voted { from, hypothesis, votes })
}
