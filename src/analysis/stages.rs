//! The stages in their order, each with the last output and the key from which the output was made.

use super::full_resolution::FullResolution;
use super::photograph::Photograph;
use super::prepared::{MaskKey, Preparation, Prepared};
use super::resolve::used_params;
use super::slot::Slot;
use super::stale::seen_up_to;
use super::subject::Subject;
use super::votes_slot::VotesSlot;
use super::warnings::all_warnings;
use super::windows::{classify_windows, merged_areas, windows_without_class};
use super::working_outputs::{MergedAreas, WorkingOutputs};
use super::{Analysis, Cancelled, Observer, Stage, StageOutput};
use crate::baseline::{
    baseline_regions, marked_matte_region, marked_planar_region, marked_region_with_distorted,
    regions_without_planes,
};
use crate::intrinsic::{WorkingSplit, split};
use crate::params::{Baseline, Params, Rules, UsedParams};
use crate::segment::{
    AnalysisInput, Areas, FinalRegions, MatteRegions, PlanarRegions, Windows, clipping_regions,
    final_regions, matte_regions, planar_regions,
};
use crate::trace::{Recorder, StageTrace, Trace};
use std::sync::Arc;

/// One slot per stage.
#[derive(Default)]
pub struct Stages {
    masks: Slot<MaskKey, Arc<Prepared>>,
    classify: Slot<Key, Arc<Windows>>,
    merge: Slot<Key, Arc<MergedAreas>>,
    /// The votes for the light, which are cast while the linear stage runs: that stage is a chain of steps that one thread takes.
    votes: VotesSlot<Key>,
    linear: Slot<Key, Arc<MatteRegions>>,
    planar: Slot<Key, Arc<PlanarRegions>>,
    clipping: Slot<Key, Arc<FinalRegions>>,
    split: Slot<Key, Arc<WorkingSplit>>,
    /// The outputs in pixels of the photograph, where the working picture has larger pixels.
    full_resolution: FullResolution,
}

/// Key of a stage's output: the generation of the output of the stage before, and the parameters that the stages up to this one
/// read.
type Key = (u64, (UsedParams, Rules));

impl Stages {
    /// Runs the stages that are stale, and, where `R` keeps a record, the stages without one.
    pub fn run<R: Recorder>(
        &mut self,
        subject: &Subject,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<Analysis, Cancelled> {
        let rules = params.rules();
        let (prepared, used) = self.masks::<R>(subject, params, observer)?;
        let input = prepared.working_input(&used, rules);
        let is_whole = prepared.working.blocks.side() == 1;
        let working = self.working_outputs::<R, _>(&WorkingInput { input, rules, is_whole }, observer)?;
        let mut analysis = working.analysis(&prepared, used);
        let mut split_reused = working.split_reused;
        if is_whole {
            // The outputs of a larger scale are not kept beside those of the photograph itself.
            self.full_resolution = FullResolution::default();
        } else {
            observer.working_made(&analysis, &prepared.working.blocks);
            let detail_used = prepared.detail_params(params, used);
            let detail_input = prepared.detail_input(&subject.image, &detail_used, rules);
            let photograph = Photograph {
                prepared: &prepared,
                input: detail_input,
                image: &subject.image,
                params,
                used: &used,
                rules,
            };
            let reused =
                self.full_resolution.enlarge::<R, _>(&photograph, &working, observer, &mut analysis)?;
            split_reused = split_reused && reused;
        }
        observer.finished(Stage::Split, split_reused);
        observer.made(StageOutput::Intrinsic(Arc::clone(&analysis.intrinsic)));
        let restricted = subject.area.is_some();
        analysis.warnings = all_warnings(&subject.image, &analysis, &prepared, restricted, rules.baseline);
        Ok(analysis)
    }

    /// Runs the stages from the windows to the split on the working picture.
    fn working_outputs<R: Recorder, O: Observer>(
        &mut self,
        working: &WorkingInput,
        observer: &mut O,
    ) -> Result<WorkingOutputs, Cancelled> {
        let WorkingInput { input, rules, is_whole } = *working;
        let input = &input;
        let baseline = rules.baseline.as_ref();
        let key = |stage, before| (before, seen_up_to(stage, input.used, rules));
        let tell = |observer: &mut O, output: StageOutput| {
            if is_whole {
                observer.made(output);
            }
        };
        let before = key(Stage::Classify, self.masks.generation());
        let windows = self.classify.get(Stage::Classify, before, observer, |_, recorder: &mut R| {
            Arc::new(match baseline {
                None => classify_windows(input, recorder),
                Some(_) => windows_without_class(input),
            })
        })?;
        tell(observer, StageOutput::Windows(Arc::clone(&windows.value)));
        let before = key(Stage::Merge, windows.number);
        let merged = self.merge.get(Stage::Merge, before, observer, |_, recorder: &mut R| {
            Arc::new(merged_areas(input, &windows.value, recorder))
        })?;
        tell(observer, StageOutput::Areas(Arc::clone(&merged.value.map)));
        let (windows_made, areas) = (&windows.value, &merged.value.areas);
        let votes = self.votes.get(key(Stage::Classify, self.masks.generation()), input, baseline);
        let before = key(Stage::Linear, merged.number);
        let matte = self.linear.get(Stage::Linear, before, observer, |observer, recorder: &mut R| {
            let stop = || observer.cancelled();
            let input = input.stopped_by(&stop);
            rayon::in_place_scope(|scope| {
                scope.spawn(|_| {
                    votes.cast(&input);
                });
                Arc::new(linear_output(&input, baseline, windows_made, areas, recorder))
            })
        })?;
        tell(observer, StageOutput::Matte(Arc::clone(&matte.value)));
        let before = key(Stage::Planar, matte.number);
        let planar = self.planar.get(Stage::Planar, before, observer, |observer, recorder: &mut R| {
            let stop = || observer.cancelled();
            let input = input.stopped_by(&stop);
            Arc::new(match baseline {
                None => {
                    let votes = votes.cast(&input);
                    planar_regions(&input, windows_made, areas, &matte.value, votes, recorder)
                }
                Some(baseline) => planar_baseline(&input, baseline, &matte.value, recorder),
            })
        })?;
        tell(observer, StageOutput::Planar(Arc::clone(&planar.value)));
        let before = key(Stage::Clipping, planar.number);
        let finals = self.clipping.get(Stage::Clipping, before, observer, |observer, recorder: &mut R| {
            let stop = || observer.cancelled();
            Arc::new(clipping_output(&input.stopped_by(&stop), baseline, &planar.value, recorder))
        })?;
        tell(observer, StageOutput::Finals(Arc::clone(&finals.value)));
        observer.started(Stage::Split);
        let before = key(Stage::Split, finals.number);
        let (split, split_reused) =
            self.split.get_silently(Stage::Split, before, observer, |observer: &O, recorder: &mut R| {
                let stop = || observer.cancelled();
                Arc::new(split(&input.stopped_by(&stop), &finals.value, recorder))
            })?;
        Ok(WorkingOutputs { windows, merged, matte, planar, finals, split, split_reused })
    }

    /// The record of all stages; `None` where a stage has no record.
    pub fn trace(&self) -> Option<Trace> {
        let prepared = self.masks.last()?;
        let stage_traces = [
            &self.masks.stage_trace,
            &self.classify.stage_trace,
            &self.merge.stage_trace,
            &self.linear.stage_trace,
            &self.planar.stage_trace,
            &self.clipping.stage_trace,
            &self.split.stage_trace,
        ];
        let stage_traces: Option<Vec<Arc<StageTrace>>> = stage_traces.into_iter().cloned().collect();
        let trace = Trace::of_working_picture(prepared.working.blocks, stage_traces?);
        Some(trace.with_second_look(self.full_resolution.second_look_records()))
    }

    fn masks<R: Recorder>(
        &mut self,
        subject: &Subject,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<(Arc<Prepared>, UsedParams), Cancelled> {
        let preparation = Preparation::new(subject, params);
        let prepared = self.masks.get(Stage::Masks, preparation.key(), observer, |_, recorder: &mut R| {
            Arc::new(preparation.run(recorder))
        })?;
        let prepared = prepared.value;
        let factor = prepared.working.blocks.side();
        let used = used_params(params, &prepared.working.image, factor, &prepared.noise);
        observer.made(StageOutput::Masks { masks: Arc::clone(&prepared.masks), used });
        Ok((prepared, used))
    }
}

/// The output of the linear stage: matte regions, or the regions of an earlier method.
fn linear_output<R: Recorder>(
    input: &AnalysisInput,
    baseline: Option<&Baseline>,
    windows: &Windows,
    areas: &Areas,
    recorder: &mut R,
) -> MatteRegions {
    match baseline {
        None => matte_regions(input, windows, areas, recorder),
        Some(Baseline::ByHand) => marked_matte_region(input, recorder),
        Some(baseline) => baseline_regions(input, baseline, recorder),
    }
}

/// The output of the planar stage of an earlier method: the skewed T of the marked pixels, or regions without planes.
fn planar_baseline<R: Recorder>(
    input: &AnalysisInput,
    baseline: &Baseline,
    matte: &MatteRegions,
    recorder: &mut R,
) -> PlanarRegions {
    match baseline {
        Baseline::ByHand => marked_planar_region(input, matte, recorder),
        _ => regions_without_planes(input, matte),
    }
}

/// The output of the clipping stage. The earlier methods that find regions alone have no clipping stage.
fn clipping_output<R: Recorder>(
    input: &AnalysisInput,
    baseline: Option<&Baseline>,
    planar: &PlanarRegions,
    recorder: &mut R,
) -> FinalRegions {
    let labels = match baseline {
        None => clipping_regions(input, planar, recorder),
        Some(Baseline::ByHand) => marked_region_with_distorted(input, planar, recorder),
        Some(_) => planar.labels.clone(),
    };
    final_regions(input, labels, planar, recorder)
}

/// The working picture, and what is done with it.
#[derive(Clone, Copy)]
struct WorkingInput<'a> {
    input: AnalysisInput<'a>,
    rules: Rules,
    /// Whether the working picture is the photograph: then the observer receives each output.
    is_whole: bool,
}
