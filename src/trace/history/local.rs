//! The decisions about a pixel that no region explains: the light, the surroundings of the pixel, the blob of the pixel.

use super::{HistoryEntry, HistoryKind, LocalFate, LocalStory};
use crate::photo::{LinearImage, Masks};
use crate::reflection::{Desaturation, WhitenedColor, WhiteningGain};
use crate::trace::replay_state::ReplayState;
use crate::trace::timeline::EventId;
use crate::trace::{
    BlobsCounted, Event, LocalBegan, LocalPoint, LocalStart, PlausibilityTested, RepairVerdict, Stage, Trace,
};

/// The decisions about a pixel that no region explains, and their outcome.
pub(super) struct Outside {
    /// The decisions, oldest first.
    pub(super) entries: Vec<HistoryEntry>,
    /// Amount of surface reflection m_s that was found, counts; none where the pixel was filled from the pixels around it.
    pub(super) surface: Option<f32>,
}

impl Outside {
    /// None for a pixel that a region explains, or that is dark.
    /// `end` is the state after all events of `trace`.
    pub(super) fn of(
        trace: &Trace,
        end: &ReplayState,
        image: &LinearImage,
        masks: &Masks,
        pixel: usize,
    ) -> Option<Self> {
        let record = trace.stage_trace(Stage::Split)?.local()?;
        if !record.outside(pixel) {
            return None;
        }
        let point = record.point(pixel).copied();
        let mut decisions = Decisions {
            color: image.pixels[pixel],
            clipped: masks.clipped(pixel),
            point,
            light: decisive_light(trace, end),
            ..Decisions::default()
        };
        for &id in &end.local {
            decisions.take(trace.step_of_event(id), trace.event_at(id));
        }
        Some(decisions.outside())
    }
}

/// The step and event of the light under which pixels are split: where a light was chosen, the choice and not the light of the
/// slices that follow.
fn decisive_light<'t>(trace: &'t Trace, end: &ReplayState) -> Option<(usize, &'t Event)> {
    let chosen = |id: &&EventId| !matches!(trace.event_at(**id), Event::IlluminantEstimated(_));
    let id = *end.lights.iter().rev().find(chosen).or(end.lights.last())?;
    Some((trace.step_of_event(id), trace.event_at(id)))
}

/// The decisions of the local split that concern the pixel.
#[derive(Default)]
struct Decisions<'a> {
    /// Color of the pixel, counts.
    color: [f32; 3],
    clipped: bool,
    point: Option<LocalPoint>,
    light: Option<(usize, &'a Event)>,
    began: Option<(usize, &'a LocalBegan)>,
    /// Fewest pixels of a blob that may be a highlight.
    least_px: u32,
    /// The judgment of the pixel's blob, and other decisions that the pixel depends on.
    decided: Vec<(usize, &'a Event)>,
    /// Whether the pixel's blob is a highlight.
    kept: bool,
    /// Whether the pixel was filled from the pixels around it.
    filled: bool,
    plausibility: Option<(usize, &'a Event, &'a PlausibilityTested)>,
}

impl<'a> Decisions<'a> {
    fn take(&mut self, step: usize, event: &'a Event) {
        let number = self.point.map_or(0, |point| point.blob);
        match event {
            Event::LocalBegan(began) => {
                self.began = Some((step, began));
                if began.start != LocalStart::Begins {
                    self.decided.push((step, event));
                }
            }
            Event::BlobsCounted(BlobsCounted { least, .. }) => self.least_px = *least,
            Event::BlobJudged(judged) if judged.blob == number => {
                self.kept = judged.kept;
                self.decided.push((step, event));
            }
            Event::RepairTried(tried) if tried.blob == number => {
                self.filled = tried.verdict == RepairVerdict::Filled;
                self.decided.push((step, event));
            }
            Event::PlausibilityTested(tested) => self.plausibility = Some((step, event, tested)),
            _ => {}
        }
    }

    fn outside(mut self) -> Outside {
        let doubted = self.plausibility.is_some_and(|(.., tested)| tested.reject_reason.is_some());
        let story = self.began.filter(|_| self.point.is_some()).map(|(step, began)| {
            let story = self.story(began, doubted);
            (step, story)
        });
        let surface = story.as_ref().map_or(0.0, |(_, story)| if doubted { 0.0 } else { story.surface() });
        if let Some((step, event, _)) = self.plausibility.filter(|_| doubted || surface > 0.0 || self.filled)
        {
            self.decided.push((step, event));
        }
        let decided = |event: &Event| HistoryKind::Decided(Box::new(event.clone()));
        let entry = |step, stage, what| HistoryEntry { step, stage, what };
        let mut entries: Vec<HistoryEntry> = Vec::new();
        entries.extend(self.light.map(|(step, event)| entry(step, Stage::Planar, decided(event))));
        entries.extend(
            story.map(|(step, story)| entry(step, Stage::Split, HistoryKind::Surroundings(Box::new(story)))),
        );
        entries.extend(self.decided.iter().map(|&(step, event)| entry(step, Stage::Split, decided(event))));
        entries.sort_by_key(|entry| entry.step);
        Outside { entries, surface: (!self.filled).then_some(surface) }
    }

    fn story(&self, began: &LocalBegan, doubted: bool) -> LocalStory {
        let point = self.point.unwrap_or_default();
        let gain = began.light.and_then(|light| WhiteningGain::new(&light.into()));
        let color = gain.map_or(WhitenedColor::default(), |gain| {
            gain.whitened(std::array::from_fn(|band| self.color[band] - began.origin[band] as f32))
        });
        let ratios = point.ratios();
        let limits = began.limits;
        let found =
            ratios.map_or(Desaturation::default(), |ratios| limits.desaturation(color, ratios, self.clipped));
        LocalStory {
            mean: color.mean,
            chroma: color.chroma,
            ratios,
            body: found.body,
            excess: found.surface,
            noise: found.noise_limit,
            variation: found.variation_limit,
            texture: point.texture(),
            weight: limits.weight(point.texture()),
            limits,
            least_px: self.least_px,
            fate: self.fate(began, point, color, &found),
            doubted,
        }
    }

    fn fate(
        &self,
        began: &LocalBegan,
        point: LocalPoint,
        color: WhitenedColor,
        found: &Desaturation,
    ) -> LocalFate {
        if self.clipped {
            return LocalFate::Clipped;
        }
        if !began.limits.has_hue(color) {
            return LocalFate::Gray;
        }
        if point.ratios().is_none() {
            return LocalFate::Alone;
        }
        if !began.hysteresis {
            return if found.is_strong() { LocalFate::Taken } else { LocalFate::Weak };
        }
        match point.blob {
            0 if !found.exceeds_noise() => LocalFate::Faint,
            0 if began.limits.weight(point.texture()) <= 0.0 => LocalFate::Texture,
            0 => LocalFate::Thin,
            LocalPoint::SMALL => LocalFate::Small,
            _ if self.kept => LocalFate::Taken,
            _ => LocalFate::NoHighlight,
        }
    }
}
