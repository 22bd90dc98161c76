//! Which light: that of the planes, or that of the votes? (refinement `vote_light`)
//!
//! The planes are right to a tenth of a degree where objects are what section 3 assumes, and up to 18° off where they are
//! printed; the votes are right to a degree in both. So the planes are believed where regions that hold, and show highlights,
//! cover 30 % of what is lit. Else the votes are, and slices are made anew under their light, if enough votes agree on a light
//! that is not unusual. Where neither speaks, no light is known and nothing is split by planes: a picture without highlights
//! stays as it is.

use super::illuminant::white_offsets_deg;
use super::input::AnalysisInput;
use super::light::{Illuminant, LightBasis, LightFindings};
use super::model_fit::RegionFit;
use super::planar::{PlanarHypothesis, PlanarRegions, PlanarState};
use super::recorded_labels::Members;
use super::vote_light::{LEAST_VOTERS, Votes};
use crate::color::Vec3;
use crate::raster::{HypothesisId, LabelMap};
use crate::trace::{LightChosen, LightLimits, Pass, Recorder, VoteResult, VotesCast};
use rayon::prelude::*;

/// What the ways to a light are held against.
pub const LIGHT_LIMITS: LightLimits =
    LightLimits { support: 0.3, hardly: 0.05, share: 0.02, offsets_deg: [20.0, 8.0] };
/// A region shows a highlight if so many of its pixels, and such a share of them, are nearer to the highlight line.
const HIGHLIGHT_PX: usize = 30;
const HIGHLIGHT_SHARE: f64 = 0.005;
/// Pixels of a region that are looked at, evenly chosen.
const SAMPLES: usize = 6000;

/// The planes' light, the regions it rests on, and within how many degrees it lies.
#[derive(Clone, Copy, Debug)]
pub struct ByPlanes {
    pub direction: Option<Vec3>,
    pub objects: usize,
    pub interval_deg: f64,
    /// Whether it rests on the planes of the highlights alone, as faint surface reflection has another color.
    pub highlights_alone: bool,
}

impl<R: Recorder> PlanarState<'_, '_, R> {
    /// Holds the planes' light against the votes, and finishes with the better one.
    pub fn choose(mut self, mut hypotheses: Vec<PlanarHypothesis>, planes: ByPlanes) -> PlanarRegions {
        let by_planes = planes.direction.filter(|_| planes.objects > 0);
        let mut light = LightFindings {
            direction: by_planes.map(Into::into),
            basis: if by_planes.is_some() { LightBasis::Planes } else { LightBasis::Nothing },
            planes: by_planes.map(Into::into),
            interval_deg: by_planes.map(|_| planes.interval_deg),
            highlights_alone: planes.highlights_alone,
            ..LightFindings::default()
        };
        let mut objects = planes.objects;
        if self.input.refine.vote_light && !self.input.stopped() {
            let votes = Votes::cast(self.input);
            let elected = votes.as_ref().map(elected);
            light.votes = elected.map(|elected| elected.direction);
            light.support = support(self.input, &self.recorded_labels.labels, &hypotheses);
            light.basis = better(&light, elected.as_ref());
            light.direction = match light.basis {
                LightBasis::Votes => light.votes,
                LightBasis::Nothing => None,
                _ => light.direction,
            };
            self.tell(&light, elected, objects);
            match (light.basis, &votes) {
                (LightBasis::Votes, Some(votes)) => {
                    let winner = light.direction.map(Vec3::from);
                    light.interval_deg = winner.map(|winner| votes.interval_deg(&winner));
                    objects = votes.blobs;
                    hypotheses = self.slices_anew(winner);
                }
                (LightBasis::Nothing, Some(_)) => {
                    light.interval_deg = None;
                    hypotheses = self.slices_anew(None);
                }
                _ => {
                    // Ways that contradict each other are not as sure as each is of itself.
                    let disagreement_deg = light
                        .agreement_deg()
                        .filter(|_| light.support < 2.0 * LIGHT_LIMITS.support)
                        .unwrap_or(0.0);
                    light.interval_deg =
                        light.interval_deg.map(|interval| interval.max(disagreement_deg / 2.0));
                }
            }
            let used = light.direction.map(Vec3::from);
            light.share = votes.zip(used).map_or(0.0, |(votes, used)| votes.share(&used));
        }
        let illuminant = light.direction.map(|direction| Illuminant { direction, objects, given: false });
        PlanarRegions { labels: self.recorded_labels.labels, hypotheses, illuminant, light }
    }

    /// Records what was found, and which light is used.
    fn tell(&mut self, light: &LightFindings, elected: Option<VoteResult>, objects: usize) {
        self.recorded_labels.begin(Pass::LightChoice);
        if R::KEEPS {
            let votes = VotesCast { elected, least_voters: LEAST_VOTERS as u32 };
            self.recorded_labels.recorder.record(votes);
            let chosen = LightChosen {
                basis: light.basis,
                direction: light.direction,
                planes: light.planes.map(|planes| (planes, objects as u32)),
                votes: elected,
                support: light.support,
                limits: LIGHT_LIMITS,
            };
            self.recorded_labels.recorder.record(chosen);
        }
    }

    /// The regions under another light, from the matte ones on.
    fn slices_anew(&mut self, light: Option<Vec3>) -> Vec<PlanarHypothesis> {
        self.reset();
        self.announce(light, Vec::new(), None);
        let hypotheses = self.slices(light);
        if light.is_none() {
            return hypotheses;
        }
        self.unite();
        self.hypotheses(light)
    }
}

/// The light that votes are for.
fn elected(votes: &Votes) -> VoteResult {
    let winner = votes.winner();
    VoteResult {
        direction: winner.into(),
        voters: votes.voters() as u32,
        blobs: votes.blobs as u32,
        share: votes.share(&winner),
        offsets_deg: white_offsets_deg(&winner),
    }
}

/// What the light had better rest on.
fn better(light: &LightFindings, elected: Option<&VoteResult>) -> LightBasis {
    let Some(elected) = elected else { return light.basis };
    let limits = LIGHT_LIMITS;
    let usual = (0..2).all(|i| elected.offsets_deg[i].abs() <= limits.offsets_deg[i]);
    if light.support < limits.support && usual && elected.share >= limits.share {
        LightBasis::Votes
    } else if light.support < limits.hardly {
        LightBasis::Nothing
    } else {
        light.basis
    }
}

/// Share of the lit pixels that lie in regions which hold and show a highlight.
fn support(input: &AnalysisInput, labels: &LabelMap, hypotheses: &[PlanarHypothesis]) -> f64 {
    let members = Members::of(labels, hypotheses.len());
    let supporting = (0..hypotheses.len())
        .into_par_iter()
        .map(HypothesisId::from_index)
        .map(|id| {
            let hypothesis = &hypotheses[id.index()];
            let pixels = members.region(id);
            let Some((plane, test)) = hypothesis.plane.zip(hypothesis.highlight_test()) else { return 0 };
            if input.stopped() || pixels.len() < HIGHLIGHT_PX {
                return 0;
            }
            let vectors = (&plane.matte.mean, &plane.matte.direction, Some(&plane.surface));
            let usable = pixels.sample(SAMPLES).filter(|&pixel| input.masks.usable(pixel as usize));
            let (highlight, seen) = usable.fold((0, 0), |(highlight, seen), pixel| {
                (highlight + usize::from(test.is_highlight(input.pixels[pixel as usize])), seen + 1)
            });
            let share = highlight as f64 / f64::from(seen.max(1));
            let shows = share >= HIGHLIGHT_SHARE && share * pixels.len() as f64 >= HIGHLIGHT_PX as f64;
            let holds =
                shows && RegionFit::new(input, labels, (id.get(), pixels), vectors).holds(input.sigma());
            if holds { pixels.len() } else { 0 }
        })
        .sum::<usize>();
    let lit = (0..labels.len()).filter(|&pixel| !input.masks.dark(pixel)).count();
    supporting as f64 / lit.max(1) as f64
}
