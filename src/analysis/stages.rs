//! The stages in their order, each with its last output and the key that the output was made from.

use super::resolve::{mask_limits, used_params};
use super::stale::seen_up_to;
use super::{Analysis, Cancelled, Observer, Stage, StageOutput};
use crate::intrinsic::{Intrinsic, split};
use crate::params::{Params, Refine, Setting, UsedParams};
use crate::photo::{LinearImage, MaskLimits, Masks, estimate_sigma};
use crate::raster::{LabelMap, Mask, Raster};
use crate::segment::{
    AnalysisInput, Areas, Classifier, FinalRegions, LightFindings, MatteRegions, PlanarRegions, Windows,
    classify, clipping_regions, final_regions, matte_regions, merge, planar_regions,
};
use crate::trace::{MasksMade, Recorder, StageBegan, StageTrace, Trace};
use std::sync::Arc;

/// The last output of each stage.
#[derive(Default)]
pub struct Stages {
    masks: Slot<MaskKey, (Arc<Masks>, Option<f64>)>,
    classify: Slot<Key, Arc<Windows>>,
    merge: Slot<Key, Arc<MergedAreas>>,
    linear: Slot<Key, Arc<MatteRegions>>,
    planar: Slot<Key, Arc<PlanarRegions>>,
    clipping: Slot<Key, Arc<FinalRegions>>,
    split: Slot<Key, Arc<Intrinsic>>,
}

/// Generation of the stage before, and the parameters that the stages up to this one read.
type Key = (u64, (UsedParams, Refine));

#[derive(Clone, Debug, PartialEq)]
struct MaskKey {
    limits: MaskLimits,
    /// The noise, where the masks depend on it: where it is to be estimated, and where the minimal intensity follows it.
    camera_noise: Option<Setting>,
    /// Whether the minimal intensity follows the noise.
    automatic_intensity: bool,
    /// The area of the session.
    area: Option<Arc<Mask>>,
}

/// The image to analyze, and the part of it.
pub struct Subject {
    pub image: Arc<LinearImage>,
    /// The pixels to analyze; none: all.
    pub area: Option<Arc<Mask>>,
}

/// Merged areas as a list and as a map.
struct MergedAreas {
    areas: Areas,
    map: Arc<Raster<u32>>,
}

/// A stage's last output with its key, a generation that rises with every new output, and the record, if one was kept.
struct Slot<K, V> {
    made: Option<(K, V)>,
    generation: u64,
    stage_trace: Option<Arc<StageTrace>>,
}

impl<K, V> Default for Slot<K, V> {
    fn default() -> Self {
        Self { made: None, generation: 0, stage_trace: None }
    }
}

impl<K: PartialEq, V: Clone> Slot<K, V> {
    /// The output made from `key`: the last one, or a new one. What a cancelled `make` hands out is thrown away. An output
    /// without a record, where one is wanted, is made again for it, and stays the same.
    fn get<O: Observer, R: Recorder>(
        &mut self,
        stage: Stage,
        key: K,
        observer: &mut O,
        make: impl FnOnce(&O, &mut R) -> V,
    ) -> Result<V, Cancelled> {
        if observer.cancelled() {
            return Err(Cancelled);
        }
        observer.started(stage);
        let kept =
            self.made.as_ref().filter(|(made_from, _)| *made_from == key).map(|(_, value)| value.clone());
        if let Some(value) = kept.clone().filter(|_| !R::KEEPS || self.stage_trace.is_some()) {
            observer.finished(stage, true);
            return Ok(value);
        }
        let mut recorder = R::default();
        if R::KEEPS {
            recorder.record(StageBegan { stage });
        }
        let value = make(observer, &mut recorder);
        if observer.cancelled() {
            return Err(Cancelled);
        }
        self.stage_trace = recorder.finish(stage).map(Arc::new);
        observer.finished(stage, false);
        if let Some(value) = kept {
            return Ok(value);
        }
        self.made = Some((key, value.clone()));
        self.generation += 1;
        Ok(value)
    }
}

impl Stages {
    /// Runs the stages that are stale, and, where `R` keeps a record, the stages that have none.
    pub fn run<R: Recorder>(
        &mut self,
        subject: &Subject,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<Analysis, Cancelled> {
        let refine = params.refinements();
        let (masks, used) = self.masks::<R>(subject, params, observer)?;
        let image = &subject.image;
        let input = AnalysisInput::new(image, &masks, &used, refine);

        let key = |stage, before| (before, seen_up_to(stage, &used, refine));

        let after_masks = key(Stage::Classify, self.masks.generation);
        let windows = self.classify.get(Stage::Classify, after_masks, observer, |_, recorder: &mut R| {
            Arc::new(classify_windows(&input, recorder))
        })?;
        observer.made(StageOutput::Windows(windows.clone()));
        let after_classify = key(Stage::Merge, self.classify.generation);
        let merged = self.merge.get(Stage::Merge, after_classify, observer, |_, recorder: &mut R| {
            let mut classifier = Classifier::new(used.camera_noise, refine.tail_test);
            let areas = merge(&windows, &mut classifier, recorder);
            let map = Arc::new(area_map(&areas, &windows, image.width(), image.height()));
            Arc::new(MergedAreas { areas, map })
        })?;
        observer.made(StageOutput::Areas(merged.map.clone()));
        let areas = &merged.areas;
        let after_merge = key(Stage::Linear, self.merge.generation);
        let matte = self.linear.get(Stage::Linear, after_merge, observer, |observer, recorder: &mut R| {
            let stop = || observer.cancelled();
            Arc::new(matte_regions(&input.stopped_by(&stop), &windows, areas, recorder))
        })?;
        observer.made(StageOutput::Matte(matte.clone()));
        let after_linear = key(Stage::Planar, self.linear.generation);
        let planar =
            self.planar.get(Stage::Planar, after_linear, observer, |observer, recorder: &mut R| {
                let stop = || observer.cancelled();
                Arc::new(planar_regions(&input.stopped_by(&stop), &windows, areas, &matte, recorder))
            })?;
        observer.made(StageOutput::Planar(planar.clone()));
        let after_planar = key(Stage::Clipping, self.planar.generation);
        let finals =
            self.clipping.get(Stage::Clipping, after_planar, observer, |observer, recorder: &mut R| {
                let stop = || observer.cancelled();
                let input = input.stopped_by(&stop);
                let labels = clipping_regions(&input, &planar, recorder);
                Arc::new(final_regions(&input, labels, &planar, recorder))
            })?;
        observer.made(StageOutput::Finals(finals.clone()));
        let after_clipping = key(Stage::Split, self.clipping.generation);
        let intrinsic =
            self.split.get(Stage::Split, after_clipping, observer, |observer, recorder: &mut R| {
                let stop = || observer.cancelled();
                Arc::new(split(&input.stopped_by(&stop), &finals, recorder))
            })?;
        observer.made(StageOutput::Intrinsic(intrinsic.clone()));
        let warnings = warnings(&finals.labels, &planar, &masks, subject.area.is_some());
        let areas = merged.map.clone();
        let illuminant = planar.illuminant;
        Ok(Analysis { used, masks, windows, areas, matte, planar, finals, illuminant, intrinsic, warnings })
    }

    /// The record of all stages; none where a stage has no record.
    pub fn trace(&self, width: usize, height: usize) -> Option<Trace> {
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
        Some(Trace::new(width, height, stage_traces?))
    }

    fn masks<R: Recorder>(
        &mut self,
        Subject { image, area }: &Subject,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<(Arc<Masks>, UsedParams), Cancelled> {
        let limits = mask_limits(params, image);
        let automatic_noise = params.camera_noise == Setting::Auto;
        let automatic_intensity = params.min_intensity == Setting::Auto;
        let depends = automatic_noise || automatic_intensity;
        let camera_noise = depends.then_some(params.camera_noise);
        let key = MaskKey { limits, camera_noise, automatic_intensity, area: area.clone() };
        let masks_of = |limits: &MaskLimits| {
            let masks = Masks::new(image, limits);
            match area {
                Some(area) => masks.within(area),
                None => masks,
            }
        };
        let (masks, sigma) = self.masks.get(Stage::Masks, key, observer, |_, recorder: &mut R| {
            let masks = masks_of(&limits);
            let sigma = if automatic_noise { estimate_sigma(image, &masks) } else { None };
            let (masks, limits) = if automatic_intensity {
                let min_intensity = used_params(params, image, sigma).min_intensity;
                let limits = MaskLimits { min_intensity, ..limits };
                (masks_of(&limits), limits)
            } else {
                (masks, limits)
            };
            if R::KEEPS {
                let made = masks_made(&masks, limits, image.pixels.len(), sigma);
                recorder.record(made);
            }
            (Arc::new(masks), sigma)
        })?;
        let used = used_params(params, image, sigma);
        observer.made(StageOutput::Masks { masks: masks.clone(), used });
        Ok((masks, used))
    }
}

fn masks_made(masks: &Masks, limits: MaskLimits, pixels: usize, sigma: Option<f64>) -> MasksMade {
    let count = |test: &dyn Fn(usize) -> bool| (0..pixels).filter(|&pixel| test(pixel)).count() as u32;
    MasksMade {
        limits,
        dark: count(&|pixel| masks.dark(pixel)),
        distorted: count(&|pixel| !masks.dark(pixel) && masks.distorted(pixel)),
        sigma,
    }
}

/// The paper's windows hold every pixel, refined ones the believable ones, and at least half of them.
fn classify_windows<R: Recorder>(input: &AnalysisInput, recorder: &mut R) -> Windows {
    let size_px = input.used.window_size as usize;
    let mut classifier = Classifier::new(input.used.camera_noise, input.refine.tail_test);
    if input.refine.tail_test {
        let valid = |pixel| input.masks.usable(pixel);
        classify(input.pixels, valid, size_px, size_px * size_px / 2, &mut classifier, recorder)
    } else {
        let valid = |pixel| !input.masks.invalid(pixel) && !input.masks.outside(pixel);
        classify(input.pixels, valid, size_px, 2, &mut classifier, recorder)
    }
}

/// The merged area of each pixel, from 1; 0: none.
fn area_map(areas: &Areas, windows: &Windows, width: usize, height: usize) -> Raster<u32> {
    let size_px = windows.size_px;
    let number = |&area: &u32| if areas.classes[area as usize].is_some() { area + 1 } else { 0 };
    let mut map = Vec::with_capacity(width * height);
    for y in 0..height {
        if y % size_px > 0 {
            map.extend_from_within((y - 1) * width..y * width);
            continue;
        }
        for (column, area) in areas.of_window.row(y / size_px).iter().enumerate() {
            let end = y * width + ((column + 1) * size_px).min(width);
            map.resize(end, number(area));
        }
    }
    Raster::from_vec(width, height, map).unwrap_or_default()
}

fn warnings(labels: &LabelMap, planar: &PlanarRegions, masks: &Masks, restricted: bool) -> Vec<String> {
    let mut warnings = Vec::new();
    let lit = (0..labels.len()).filter(|&pixel| !masks.dark(pixel)).count();
    let assigned = labels.as_slice().iter().filter(|&&label| label != 0).count();
    if labels.is_empty() || lit == 0 {
        let which = if restricted { "every pixel of the area" } else { "every pixel" };
        warnings.push(format!("{which} is darker than the minimal intensity: nothing was analyzed"));
    } else if assigned == 0 {
        warnings.push(
            "no linear area was found: no window varies along one direction beyond the noise".to_owned(),
        );
    } else if planar.illuminant.is_none() {
        let why = match planar.light {
            LightFindings { planes: None, votes: None, .. } => "no highlight was found".to_owned(),
            light => light.reason(),
        };
        warnings.push(format!("{why}: the light's color is unknown and all is body reflection"));
    }
    warnings
}
