//! What was decided about a pixel that lies outside of what holds: under which light, by what around it, in which blob.

use super::{HistoryEntry, HistoryKind, LocalFate, LocalStory};
use crate::photo::{LinearImage, Masks};
use crate::reflection::{Desaturation, WhitenedColor, WhiteningGain};
use crate::trace::{
    BlobsCounted, Event, LocalBegan, LocalPoint, LocalStart, PlausibilityTested, RepairVerdict, Stage, Trace,
};

/// What is told, and what came of it.
pub(super) struct Outside {
    /// Oldest first.
    pub(super) told: Vec<HistoryEntry>,
    /// Amount of surface reflection m_s that was found, counts; none where it was filled from what is around it.
    pub(super) surface: Option<f32>,
}

impl Outside {
    /// None for a pixel that a region explains, or that is dark.
    pub(super) fn of(trace: &Trace, image: &LinearImage, masks: &Masks, pixel: usize) -> Option<Self> {
        let record = trace.stage_trace(Stage::Split)?.local()?;
        if !record.outside(pixel) {
            return None;
        }
        let mut case = Case {
            color: image.pixels[pixel],
            clipped: masks.clipped(pixel),
            point: record.point(pixel).copied(),
            ..Case::default()
        };
        for (step, event) in trace.events() {
            case.hear(step, event);
        }
        Some(case.told())
    }
}

/// The decisions that concern the pixel.
#[derive(Default)]
struct Case<'a> {
    color: [f32; 3],
    clipped: bool,
    point: Option<LocalPoint>,
    light: Option<(usize, Stage, &'a Event)>,
    began: Option<(usize, &'a LocalBegan)>,
    least_px: u32,
    /// Its blob's judgment, whether it is kept, and what else was decided.
    decided: Vec<(usize, &'a Event)>,
    kept: bool,
    filled: bool,
    plausibility: Option<(usize, &'a Event, &'a PlausibilityTested)>,
}

impl<'a> Case<'a> {
    fn hear(&mut self, step: usize, event: &'a Event) {
        let number = self.point.map_or(0, |point| point.blob);
        match event {
            // Where lights were held against each other, the choice says more than the light of the slices that follow.
            Event::IlluminantEstimated(_) if matches!(self.light, Some((.., Event::LightChosen(_)))) => {}
            Event::IlluminantEstimated(_) | Event::IlluminantGiven(_) => {
                self.light = Some((step, Stage::Planar, event));
            }
            Event::LightChosen(_) => self.light = Some((step, Stage::Planar, event)),
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

    fn told(mut self) -> Outside {
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
        let light = self
            .light
            .map(|(step, stage, event)| (step, stage, HistoryKind::Decided(Box::new(event.clone()))));
        let story =
            story.map(|(step, story)| (step, Stage::Split, HistoryKind::Surroundings(Box::new(story))));
        let decided = self.decided.into_iter();
        let decided =
            decided.map(|(step, event)| (step, Stage::Split, HistoryKind::Decided(Box::new(event.clone()))));
        let mut told: Vec<HistoryEntry> = light
            .into_iter()
            .chain(story)
            .chain(decided)
            .map(|(step, stage, what)| HistoryEntry { step, stage, what })
            .collect();
        told.sort_by_key(|happening| happening.step);
        Outside { told, surface: (!self.filled).then_some(surface) }
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
