//! Section 5.4: the planar stage. The matte line of an object and the illuminant span the object's dichromatic plane;
//! extended by the noise into a slice, the plane segments the image anew, now with the highlights.
//!
//! Refined (`robust_illuminant`): the illuminant is estimated, then the slices grow, then both are repeated with the grown
//! regions until the illuminant turns by less than 0.5°. At last the estimate by planes is compared with the votes of small
//! highlights (`vote_light`, the rule of `choice`); where the votes win, the slices grow once more.
//!
//! The readings `grown_matte_line` and `own_cylinder_only` change the paper's planar stage; `params/reading.rs` quotes the text.
//!
//! An illuminant that was given is not estimated, whatever the method: every plane contains the given direction. A second lamp that was
//! given is not sought: each region has the lamp that its highlights agree with (`second_lamp`), and the slices grow once more.

use super::candidates::{EarlierStages, highlight_lines};
use super::choice::{LIGHT_LIMITS, LightDecision, LightEvidence, choose_light};
use super::classify::Windows;
use super::highlight_support::highlight_support;
use super::input::AnalysisInput;
use super::light::{Illuminant, LightFindings};
use super::linear::matte_length;
use super::lit_regions::SecondLamp;
use super::matte::MatteRegions;
use super::merge::Areas;
use super::planar_hypothesis::{PlanarHypothesis, PlanarRegions};
use super::planar_state::PlanarState;
use super::plane_light::{
    PlaneEstimate, PlaneLight, average_of_lines, estimate_beside_matte_regions, estimate_from_grown_regions,
    evidence_of_grown_regions,
};
use super::recorded_labels::Members;
use super::second_lamp::{contradicts, given_second_lamp, second_lamp};
use super::two_lights::Evidence;
use super::vote_light::{LEAST_VOTERS, PictureVotes};
use crate::color::{Line, Moments, Vec3, axis_angle_deg};
use crate::params::LEAST_LAMPS_ANGLE_DEG;
use crate::raster::HypothesisId;
use crate::trace::{
    HighlightsAveraged, IlluminantEstimated, IlluminantGiven, LightBasis, LightChosen, LineRefitted, Pass,
    PassBegan, Recorder, VotesCast,
};
use rayon::prelude::*;
use std::sync::Arc;

/// Largest number of rounds in which illuminant and slices are found again from the grown regions.
const ROUNDS: usize = 3;
/// The rounds end when the illuminant has turned by less than this angle, degrees: such a turn moves no highlight by more
/// than a count across its slice.
const SETTLED_DEG: f64 = 0.5;

/// Grows matte regions into planar ones and estimates the illuminant. `votes`: the votes of small highlights, where they are asked for
/// ([`PictureVotes::are_asked`]) and there are enough of them.
pub fn planar_regions<R: Recorder>(
    input: &AnalysisInput,
    windows: &Windows,
    areas: &Areas,
    matte: &MatteRegions,
    votes: Option<&PictureVotes>,
    recorder: &mut R,
) -> PlanarRegions {
    let members = Members::of(&matte.labels, matte.hypotheses.len());
    if R::KEEPS {
        recorder.record(PassBegan { pass: Pass::Candidates });
    }
    let grown = input.readings.grown_matte_line.then(|| with_grown_lines(input, matte, &members, recorder));
    let matte = grown.as_ref().unwrap_or(matte);
    let lengths: Vec<f64> = (0..matte.hypotheses.len())
        .into_par_iter()
        .map(|index| {
            let pixels = members.region(HypothesisId::from_index(index));
            matte_length(input, &matte.hypotheses[index].line, pixels)
        })
        .collect();
    let earlier = EarlierStages { windows, areas, labels: &matte.labels, hypotheses: &matte.hypotheses };
    let lines = highlight_lines(input, &earlier, &members, &lengths, recorder);
    let state = PlanarState::new(input, matte, lengths, lines, recorder);
    if let Some(direction) = input.used.illuminant {
        under_given_light(state, direction)
    } else if input.refine.robust_illuminant {
        under_robust_light(state, &members, votes)
    } else {
        under_average_light(state, votes)
    }
}

/// The matte regions with the line of each fitted to all of its pixels `members` (reading `grown_matte_line`).
fn with_grown_lines<R: Recorder>(
    input: &AnalysisInput,
    matte: &MatteRegions,
    members: &Members,
    recorder: &mut R,
) -> MatteRegions {
    let mut grown = matte.clone();
    for (id, hypothesis) in HypothesisId::all(matte.hypotheses.len()).zip(&mut grown.hypotheses) {
        let cluster: Moments = members.region(id).iter().map(|pixel| input.pixels[pixel as usize]).collect();
        let Some(line) = Line::principal(&cluster).filter(|_| hypothesis.alive) else { continue };
        hypothesis.line = line;
        if R::KEEPS {
            recorder.record(LineRefitted { hypothesis: id, line });
        }
    }
    grown
}

/// The regions under an illuminant that was given: nothing is estimated, so that one round suffices.
fn under_given_light<R: Recorder>(mut state: PlanarState<R>, direction: [f64; 3]) -> PlanarRegions {
    record_given(&mut state, direction);
    let first = Vec3::from(direction);
    let given = Some(first);
    let mut hypotheses = state.grow_slices(given);
    if state.input.refine.robust_illuminant {
        state.unite();
        hypotheses = state.hypotheses(given);
    }
    let mut light = LightFindings::given(direction);
    if divide_between_given_lamps(&mut state, &hypotheses, &first) {
        state.reset();
        record_given(&mut state, direction);
        hypotheses = grown_and_united(&mut state, given);
        light.second = state.second_lamp.as_ref().map(SecondLamp::findings);
    }
    let illuminant = Some(Illuminant { direction, objects: 0, given: true });
    regions_of(state, hypotheses, illuminant, light)
}

/// The regions under the paper's estimate, the average of the highlight lines.
fn under_average_light<R: Recorder>(
    mut state: PlanarState<R>,
    votes: Option<&PictureVotes>,
) -> PlanarRegions {
    let votes_count = state.input.refine.vote_light;
    let estimate = average_of_lines(&state);
    let light = record_estimate(&mut state, estimate);
    let hypotheses = state.grow_slices(light.direction);
    let mut regions = under_chosen_light(state, hypotheses, light, &[], votes);
    // Small highlights are votes only with `vote_light`: without it the average alone decides whether there is a light.
    let is_average = match regions.light.basis {
        LightBasis::Planes => true,
        LightBasis::Nothing => !votes_count,
        _ => false,
    };
    if is_average {
        // The average has no interval, and is no intersection of planes.
        let basis = LightBasis::Average;
        regions.light = LightFindings { basis, planes: None, interval_deg: None, ..regions.light };
    }
    regions
}

/// The regions under the robust estimate, which is repeated with the grown regions. `members`: pixels of the matte regions.
fn under_robust_light<R: Recorder>(
    mut state: PlanarState<R>,
    members: &Members,
    votes: Option<&PictureVotes>,
) -> PlanarRegions {
    let mut light = match estimate_beside_matte_regions(&state, members) {
        Some(estimate) => record_estimate(&mut state, estimate),
        None => PlaneLight::none(),
    };
    let mut hypotheses = state.grow_slices(light.direction);
    let mut evidence = Vec::new();
    for _ in 0..ROUNDS {
        let Some(before) = light.direction.filter(|_| !state.input.stopped()) else { break };
        let mut estimate = estimate_from_grown_regions(&state, &hypotheses, &before);
        evidence = std::mem::take(&mut estimate.evidence);
        light = record_estimate(&mut state, estimate);
        state.unite();
        if light.direction.is_some_and(|next| axis_angle_deg(&next, &before) < SETTLED_DEG) {
            hypotheses = state.hypotheses(light.direction);
            break;
        }
        state.reset();
        hypotheses = state.grow_slices(light.direction);
    }
    under_chosen_light(state, hypotheses, light, &evidence, votes)
}

/// Compares the light by the planes with the votes of small highlights (`vote_light`), and carries out what `choice`
/// decides. `hypotheses` and the labels of the state are those under the planes' light. `evidence`: what each region tells of the light,
/// where a second lamp is sought.
fn under_chosen_light<R: Recorder>(
    mut state: PlanarState<R>,
    mut hypotheses: Vec<PlanarHypothesis>,
    planes: PlaneLight,
    evidence: &[Evidence],
    votes: Option<&PictureVotes>,
) -> PlanarRegions {
    let mut decision = LightDecision::planes_alone(&planes);
    let mut light = LightFindings {
        planes: planes.known_direction().map(Into::into),
        highlights_alone: planes.highlights_alone,
        ..LightFindings::default()
    };
    if state.input.refine.vote_light && !state.input.stopped() {
        let support = highlight_support(state.input, &state.recorded_labels.labels, &hypotheses);
        let light_evidence = LightEvidence {
            planes,
            votes: votes.map(|votes| votes.light),
            planes_share: votes.zip(planes.direction).map_or(0.0, |(votes, light)| votes.votes.share(&light)),
            support,
        };
        decision = choose_light(&light_evidence);
        record_choice(&mut state, &light_evidence, &decision);
        // The slices have grown under the planes' light.
        if decision.direction != planes.direction {
            hypotheses = grow_again(&mut state, decision.direction);
        }
        light.votes = light_evidence.votes.map(|votes| votes.result.direction);
        light.support = support;
        light.share = votes.zip(decision.direction).map_or(0.0, |(votes, used)| votes.votes.share(&used));
    }
    if let Some(direction) = decision.direction
        && (divide_between_given_lamps(&mut state, &hypotheses, &direction)
            || contradicts(evidence, &direction) && find_second_lamp(&mut state, &hypotheses, &decision))
    {
        hypotheses = grow_again(&mut state, Some(direction));
        light.second = state.second_lamp.as_ref().map(SecondLamp::findings);
    }
    light.direction = decision.direction.map(Into::into);
    light.basis = decision.basis;
    let widening = state.input.interval_widening();
    light.interval_deg = decision.interval_deg.map(|interval_deg| (widening * interval_deg).min(90.0));
    if decision.basis == LightBasis::Planes {
        light.spread_deg = (widening * planes.spread_deg).min(90.0);
    }
    let objects = decision.objects;
    let illuminant = light.direction.map(|direction| Illuminant { direction, objects, given: false });
    regions_of(state, hypotheses, illuminant, light)
}

/// The output of the stage, with the pixels that the second lamp of the state lights.
fn regions_of<R: Recorder>(
    state: PlanarState<R>,
    hypotheses: Vec<PlanarHypothesis>,
    illuminant: Option<Illuminant>,
    light: LightFindings,
) -> PlanarRegions {
    let second_lamp = state.second_lamp.as_ref();
    let second_lamp_mask = second_lamp
        .map(|lamp| Arc::new(lamp.lit_pixels(state.input, &state.recorded_labels.labels, &hypotheses)));
    PlanarRegions { labels: state.recorded_labels.labels, hypotheses, illuminant, light, second_lamp_mask }
}

/// Divides the regions between the light `first`, unit, and a second lamp that was given, if one was and its color is another one.
/// Returns whether the state has the second lamp.
fn divide_between_given_lamps<R: Recorder>(
    state: &mut PlanarState<R>,
    hypotheses: &[PlanarHypothesis],
    first: &Vec3,
) -> bool {
    let Some(second) = state.input.used.second_illuminant.map(Vec3::from) else { return false };
    if axis_angle_deg(&second, first) < LEAST_LAMPS_ANGLE_DEG || state.input.stopped() {
        return false;
    }
    let evidence = evidence_of_grown_regions(state, hypotheses);
    let (compared, lamp) =
        given_second_lamp(&evidence, first, &second, &state.matte_labels, state.matte.len());
    if R::KEEPS {
        state.recorded_labels.recorder.record(compared);
    }
    state.second_lamp = Some(lamp);
    true
}

/// Searches for a second lamp beside the light of `decision` (refinement `second_lamp`). Returns whether there is one; the state has the lamp.
fn find_second_lamp<R: Recorder>(
    state: &mut PlanarState<R>,
    hypotheses: &[PlanarHypothesis],
    decision: &LightDecision,
) -> bool {
    let Some((first, interval_deg)) = decision.direction.zip(decision.interval_deg) else { return false };
    let is_sought = state.input.refine.second_lamp && state.input.used.second_illuminant.is_none();
    if !is_sought || state.input.stopped() {
        return false;
    }
    let evidence = evidence_of_grown_regions(state, hypotheses);
    let (labels, count) = (&state.matte_labels, state.matte.len());
    let widening = state.input.interval_widening();
    let Some((compared, lamp)) = second_lamp(&evidence, &first, interval_deg, widening, labels, count) else {
        return false;
    };
    if R::KEEPS {
        state.recorded_labels.recorder.record(compared);
    }
    state.second_lamp = lamp;
    state.second_lamp.is_some()
}

/// The regions under another illuminant, grown from the matte regions.
fn grow_again<R: Recorder>(state: &mut PlanarState<R>, direction: Option<Vec3>) -> Vec<PlanarHypothesis> {
    state.reset();
    let light = PlaneLight { direction, ..PlaneLight::none() };
    record_estimate(state, PlaneEstimate::of_light(light));
    grown_and_united(state, direction)
}

/// The regions after their slices have grown from the matte regions under a light, and parts of one object are united; without a light no slice grows.
fn grown_and_united<R: Recorder>(
    state: &mut PlanarState<R>,
    direction: Option<Vec3>,
) -> Vec<PlanarHypothesis> {
    let hypotheses = state.grow_slices(direction);
    if direction.is_none() {
        return hypotheses;
    }
    state.unite();
    state.hypotheses(direction)
}

/// Records that the illuminant, unit, was given.
fn record_given<R: Recorder>(state: &mut PlanarState<R>, direction: [f64; 3]) {
    state.recorded_labels.begin(Pass::Illuminant);
    if R::KEEPS {
        state.recorded_labels.recorder.record(IlluminantGiven { direction });
    }
}

/// Records an estimate of the illuminant, and returns the light.
fn record_estimate<R: Recorder>(state: &mut PlanarState<R>, estimate: PlaneEstimate) -> PlaneLight {
    let PlaneEstimate { light, contributions, averaged, two_light_test, .. } = estimate;
    state.recorded_labels.begin(Pass::Illuminant);
    if R::KEEPS
        && let Some(direction) = light.direction
    {
        let direction = direction.into();
        let recorder = &mut *state.recorded_labels.recorder;
        if averaged.is_empty() {
            recorder.record(IlluminantEstimated { direction, contributions, outshone: two_light_test });
        } else {
            recorder.record(HighlightsAveraged { direction, contributions: averaged });
        }
    }
    light
}

/// Records the votes, and which light is used.
fn record_choice<R: Recorder>(
    state: &mut PlanarState<R>,
    evidence: &LightEvidence,
    decision: &LightDecision,
) {
    state.recorded_labels.begin(Pass::LightChoice);
    if R::KEEPS {
        let elected = evidence.votes.map(|votes| votes.result);
        let planes = evidence.planes;
        let recorder = &mut *state.recorded_labels.recorder;
        recorder.record(VotesCast { elected, least_voters: LEAST_VOTERS as u32 });
        recorder.record(LightChosen {
            basis: decision.basis,
            direction: decision.direction.map(Into::into),
            planes: planes.known_direction().map(|direction| (direction.into(), planes.regions as u32)),
            votes: elected,
            support: evidence.support,
            odds: decision.odds,
            limits: LIGHT_LIMITS,
        });
    }
}
