//! The decisions about a pixel that no region explains: the light, the surroundings of the pixel, the blob of the pixel.

use super::{HistoryEntry, HistoryKind, LocalFate, LocalStory};
use crate::photo::{LinearImage, Masks};
use crate::reflection::{Desaturation, WhitenedColor, WhiteningGain};
use crate::trace::replay_state::ReplayState;
use crate::trace::timeline::EventId;
use crate::trace::{
    Event, LocalBegan, LocalPoint, LocalStart, PictureOddsFound, PlausibilityTested, RepairVerdict,
    RestoredBand, Stage, Trace,
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
        let restored = record.restored(pixel).copied();
        let mut decisions = Decisions {
            color: image.pixels[pixel],
            clipped: masks.clipped(pixel) && restored.is_none(),
            restored,
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
    let is_estimate =
        |event: &Event| matches!(event, Event::IlluminantEstimated(_) | Event::HighlightsAveraged(_));
    let chosen = |id: &&EventId| !is_estimate(trace.event_at(**id));
    let id = *end.lights.iter().rev().find(chosen).or(end.lights.last())?;
    Some((trace.step_of_event(id), trace.event_at(id)))
}

/// The decisions of the local split that concern the pixel.
#[derive(Default)]
struct Decisions<'a> {
    /// Color of the pixel, counts.
    color: [f32; 3],
    /// Whether a band is clipped that was not restored.
    clipped: bool,
    restored: Option<RestoredBand>,
    point: Option<LocalPoint>,
    light: Option<(usize, &'a Event)>,
    began: Option<(usize, &'a LocalBegan)>,
    /// Log odds of the picture.
    picture_odds: f32,
    /// The decisions that the pixel depends on.
    decided: Vec<(usize, &'a Event)>,
    /// Whether the pixel was filled from the pixels around it.
    filled: bool,
    plausibility: Option<(usize, &'a Event, &'a PlausibilityTested)>,
}

impl<'a> Decisions<'a> {
    fn take(&mut self, step: usize, event: &'a Event) {
        let number = self.point.map_or(0, |point| point.blob());
        match event {
            Event::LocalBegan(began) => {
                self.began = Some((step, began));
                if began.start != LocalStart::Begins {
                    self.decided.push((step, event));
                }
            }
            Event::PictureOddsFound(PictureOddsFound { log_odds, .. }) => {
                self.picture_odds = *log_odds;
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
        let doubted = self.plausibility.is_some_and(|(.., tested)| !tested.plausible());
        let story =
            self.began.filter(|_| self.point.is_some()).map(|(step, began)| (step, self.story(began)));
        let surface = story.as_ref().map_or(0.0, |(_, story)| story.surface);
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

    fn story(&self, began: &LocalBegan) -> LocalStory {
        let figures = self.point.unwrap_or_default().figures();
        let light = if self.point.is_some_and(|point| point.has_second_lamp()) {
            began.second_light
        } else {
            began.light
        };
        let gain = light.and_then(|light| WhiteningGain::new(&light.into()));
        let mut above_ambient: [f32; 3] =
            std::array::from_fn(|band| self.color[band] - began.origin[band] as f32);
        if let Some(RestoredBand { band, value, .. }) = self.restored {
            above_ambient[usize::from(band)] = value;
        }
        let color = gain.map_or(WhitenedColor::default(), |gain| gain.whitened(above_ambient));
        let limits = began.limits;
        let found = figures
            .ratios
            .map_or(Desaturation::default(), |ratios| limits.desaturation(color, ratios, self.clipped));
        let odds = figures.odds + self.picture_odds;
        let ratio = figures.ratios.map_or(1.0, |[ratio, _]| ratio);
        let weight = limits.weight(&found, ratio, began.highlight_evidence.then_some(odds));
        LocalStory {
            mean: color.mean,
            chroma: color.chroma,
            restored: self.restored,
            ratios: figures.ratios,
            body: found.body,
            excess: found.surface,
            noise: found.noise_limit,
            variation: found.variation_limit,
            terms: began.highlight_evidence.then_some(figures.terms),
            odds,
            picture_odds: self.picture_odds,
            weight,
            limits,
            surface: 3f32.sqrt() * figures.amount,
            turn_deg: figures.turn_deg,
            fate: self.fate(began, &found, weight, odds),
        }
    }

    fn fate(&self, began: &LocalBegan, found: &Desaturation, weight: f32, odds: f32) -> LocalFate {
        let has_ratio = self.point.is_some_and(|point| point.figures().ratios.is_some());
        if self.clipped {
            LocalFate::Clipped
        } else if !has_ratio {
            LocalFate::Alone
        } else if !found.is_judged() {
            LocalFate::Gray
        } else if weight > 0.0 {
            LocalFate::Taken
        } else if !found.exceeds_noise() {
            LocalFate::Faint
        } else if !began.highlight_evidence {
            LocalFate::Weak
        } else if odds <= began.limits.odds.start {
            LocalFate::Print
        } else {
            LocalFate::Pale
        }
    }
}
