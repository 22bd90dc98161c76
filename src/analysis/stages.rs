//! The stages in their order, each with the last output and the key from which the output was made.

use super::resolve::{NoiseFindings, detail_noise, mask_limits, scale_factor, used_params};
use super::stale::seen_up_to;
use super::{Analysis, Cancelled, Observer, Stage, StageOutput};
use crate::intrinsic::{Detail, Intrinsic, split};
use crate::params::{Params, Refine, Setting, UsedParams};
use crate::photo::{
    CodingError, LinearImage, MaskLimits, Masks, NoiseCorrelation, NoiseEstimate, ShotNoise, WorkingPicture,
};
use crate::raster::{Blocks, LabelMap, Mask, Raster};
use crate::segment::{
    AnalysisInput, Areas, Classifier, FinalRegions, LightFindings, MatteRegions, PlanarRegions, Windows,
    classify, clipping_regions, final_regions, full_resolution_labels, matte_regions, merge, planar_regions,
};
use crate::trace::{MasksMade, Recorder, StageBegan, StageTrace, Trace};
use std::sync::Arc;

/// One slot per stage.
#[derive(Default)]
pub struct Stages {
    masks: Slot<MaskKey, Arc<Prepared>>,
    classify: Slot<Key, Scaled<Windows>>,
    merge: Slot<Key, Arc<MergedAreas>>,
    linear: Slot<Key, Scaled<MatteRegions>>,
    planar: Slot<Key, Scaled<PlanarRegions>>,
    clipping: Slot<Key, Scaled<FinalRegions>>,
    split: Slot<Key, Arc<Intrinsic>>,
}

/// What the first stage makes: the masks, the working picture, and the noise of both pictures.
struct Prepared {
    /// The masks of the photograph.
    masks: Arc<Masks>,
    working: Arc<WorkingPicture>,
    /// The noise of a working pixel, and the coding error of a pixel of the photograph.
    noise: Arc<NoiseFindings>,
    /// The coding error of a working pixel; none: the noise contains it.
    working_coding: Option<CodingError>,
    /// The noise of a pixel of the photograph; none: the working picture is the photograph, or the noise could not be measured.
    detail: Option<NoiseEstimate>,
}

impl Prepared {
    /// The input of the stages: the working picture.
    fn working_input<'a>(&'a self, used: &'a UsedParams, refine: Refine) -> AnalysisInput<'a> {
        let input = AnalysisInput::new(&self.working.image, &self.working.masks, used, refine);
        self.with_errors(input, self.working_coding.as_ref(), self.noise.shot)
    }

    /// The input of the pass at full resolution: the photograph.
    fn detail_input<'a>(
        &'a self,
        image: &'a LinearImage,
        used: &'a UsedParams,
        refine: Refine,
    ) -> AnalysisInput<'a> {
        let input = AnalysisInput::new(image, &self.masks, used, refine);
        let shot = self.detail.map_or(self.noise.shot, |detail| detail.shot);
        self.with_errors(input, self.noise.coding.as_ref(), shot)
    }

    /// An input with a coding error and shot noise, as far as the refinements `coding_error` and `shot_noise` are on.
    fn with_errors<'a>(
        &'a self,
        input: AnalysisInput<'a>,
        coding: Option<&'a CodingError>,
        shot: Option<ShotNoise>,
    ) -> AnalysisInput<'a> {
        let input = if input.refine.shot_noise { input.with_shot_noise(shot) } else { input };
        if input.refine.coding_error { input.with_coding(coding, self.noise.extended) } else { input }
    }

    /// The parameters for single pixels of the photograph, which are noisier than working pixels.
    fn detail_params(&self, params: &Params, used: UsedParams) -> UsedParams {
        let camera_noise =
            detail_noise(params, &self.noise, used.camera_noise, self.detail.map(|detail| detail.sigma));
        UsedParams { camera_noise, ..used }
    }
}

/// A stage's output in pixels of the working picture, and the same in pixels of the photograph.
struct Scaled<T> {
    working: Arc<T>,
    /// Handed out; where the working picture is the photograph, the same value.
    shown: Arc<T>,
}

impl<T> Clone for Scaled<T> {
    fn clone(&self) -> Self {
        Self { working: Arc::clone(&self.working), shown: Arc::clone(&self.shown) }
    }
}

impl<T> Scaled<T> {
    /// `enlarge` makes the value in pixels of the photograph; it is asked only where blocks have more than one pixel.
    fn new(working: T, blocks: &Blocks, enlarge: impl FnOnce(&T) -> T) -> Self {
        let working = Arc::new(working);
        let shown = if blocks.side() == 1 { Arc::clone(&working) } else { Arc::new(enlarge(&working)) };
        Self { working, shown }
    }
}

impl Scaled<Windows> {
    fn windows(working: Windows, blocks: &Blocks) -> Self {
        let enlarge = |made: &Windows| Windows { size_px: made.size_px * blocks.side(), ..made.clone() };
        Self::new(working, blocks, enlarge)
    }
}

impl Scaled<MatteRegions> {
    fn matte(working: MatteRegions, blocks: &Blocks) -> Self {
        let enlarge =
            |made: &MatteRegions| MatteRegions { labels: blocks.enlarged(&made.labels), ..made.clone() };
        Self::new(working, blocks, enlarge)
    }
}

impl Scaled<PlanarRegions> {
    fn planar(working: PlanarRegions, blocks: &Blocks) -> Self {
        let enlarge =
            |made: &PlanarRegions| PlanarRegions { labels: blocks.enlarged(&made.labels), ..made.clone() };
        Self::new(working, blocks, enlarge)
    }
}

impl Scaled<FinalRegions> {
    /// `detail`: the photograph, whose pixels take their regions at full resolution.
    fn finals(working: FinalRegions, blocks: &Blocks, detail: &AnalysisInput) -> Self {
        let at_full_resolution = |made: &FinalRegions| FinalRegions {
            labels: full_resolution_labels(detail, made, blocks),
            ..made.clone()
        };
        Self::new(working, blocks, at_full_resolution)
    }
}

/// Key of a stage's output: the generation of the output of the stage before, and the parameters that the stages up to this one
/// read.
type Key = (u64, (UsedParams, Refine));

/// Key of the masks.
#[derive(Clone, Debug, PartialEq)]
struct MaskKey {
    limits: MaskLimits,
    /// Side of a working pixel, pixels.
    factor: usize,
    /// The setting of the camera noise, if the masks depend on it: the noise is to be estimated, or the minimal intensity is
    /// computed from the noise.
    camera_noise: Option<Setting>,
    /// Whether the minimal intensity is computed from the noise.
    automatic_intensity: bool,
    /// The area of the session.
    area: Option<Arc<Mask>>,
}

/// The image to analyze, and the area of the analysis.
pub struct Subject {
    pub image: Arc<LinearImage>,
    /// The pixels to analyze; `None`: all pixels.
    pub area: Option<Arc<Mask>>,
}

/// Merged areas as lists and as a number per pixel.
struct MergedAreas {
    areas: Areas,
    map: Arc<Raster<u32>>,
}

/// The last output of a stage.
struct Slot<K, V> {
    /// The key and the output that was made from it; `None` before the first run.
    made: Option<(K, V)>,
    /// Number of outputs made so far.
    generation: u64,
    /// The record of the stage, if the last run kept one.
    stage_trace: Option<Arc<StageTrace>>,
}

impl<K, V> Default for Slot<K, V> {
    fn default() -> Self {
        Self { made: None, generation: 0, stage_trace: None }
    }
}

impl<K: PartialEq, V: Clone> Slot<K, V> {
    /// The output for `key`: the last output, or a new one made by `make`. The result of a cancelled `make` is discarded. An
    /// output without a record, where `R` keeps one, is made again for the record; the earlier output is returned.
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
    /// Runs the stages that are stale, and, where `R` keeps a record, the stages without one.
    pub fn run<R: Recorder>(
        &mut self,
        subject: &Subject,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<Analysis, Cancelled> {
        let refine = params.refinements();
        let (prepared, used) = self.masks::<R>(subject, params, observer)?;
        let (image, Prepared { masks, working, .. }) = (&subject.image, &*prepared);
        let blocks = working.blocks;
        let input = prepared.working_input(&used, refine);
        let detail_used = prepared.detail_params(params, used);
        let detail_input = prepared.detail_input(image, &detail_used, refine);

        let key = |stage, before| (before, seen_up_to(stage, &used, refine));

        let after_masks = key(Stage::Classify, self.masks.generation);
        let windows = self.classify.get(Stage::Classify, after_masks, observer, |_, recorder: &mut R| {
            Scaled::windows(classify_windows(&input, recorder), &blocks)
        })?;
        observer.made(StageOutput::Windows(windows.shown.clone()));
        let after_classify = key(Stage::Merge, self.classify.generation);
        let merged = self.merge.get(Stage::Merge, after_classify, observer, |_, recorder: &mut R| {
            let mut classifier = Classifier::new(used.camera_noise, refine.tail_test);
            let areas = merge(&windows.working, &mut classifier, recorder);
            let map = Arc::new(area_map(&areas, &windows.shown, image.width(), image.height()));
            Arc::new(MergedAreas { areas, map })
        })?;
        observer.made(StageOutput::Areas(merged.map.clone()));
        let (windows_of_stages, areas) = (&windows.working, &merged.areas);
        let after_merge = key(Stage::Linear, self.merge.generation);
        let matte = self.linear.get(Stage::Linear, after_merge, observer, |observer, recorder: &mut R| {
            let stop = || observer.cancelled();
            let made = matte_regions(&input.stopped_by(&stop), windows_of_stages, areas, recorder);
            Scaled::matte(made, &blocks)
        })?;
        observer.made(StageOutput::Matte(matte.shown.clone()));
        let after_linear = key(Stage::Planar, self.linear.generation);
        let planar =
            self.planar.get(Stage::Planar, after_linear, observer, |observer, recorder: &mut R| {
                let (stop, input) = (|| observer.cancelled(), &input);
                let input = input.stopped_by(&stop);
                let made = planar_regions(&input, windows_of_stages, areas, &matte.working, recorder);
                Scaled::planar(made, &blocks)
            })?;
        observer.made(StageOutput::Planar(planar.shown.clone()));
        let after_planar = key(Stage::Clipping, self.planar.generation);
        let finals =
            self.clipping.get(Stage::Clipping, after_planar, observer, |observer, recorder: &mut R| {
                let stop = || observer.cancelled();
                let input = input.stopped_by(&stop);
                let labels = clipping_regions(&input, &planar.working, recorder);
                let made = final_regions(&input, labels, &planar.working, recorder);
                Scaled::finals(made, &blocks, &detail_input.stopped_by(&stop))
            })?;
        observer.made(StageOutput::Finals(finals.shown.clone()));
        let after_clipping = key(Stage::Split, self.clipping.generation);
        let intrinsic =
            self.split.get(Stage::Split, after_clipping, observer, |observer, recorder: &mut R| {
                let stop = || observer.cancelled();
                let detail = (blocks.side() > 1).then(|| Detail {
                    input: detail_input.stopped_by(&stop),
                    labels: &finals.shown.labels,
                    blocks,
                });
                Arc::new(split(&input.stopped_by(&stop), &finals.working, detail.as_ref(), recorder))
            })?;
        observer.made(StageOutput::Intrinsic(intrinsic.clone()));
        let (planar, working_finals, finals) = (planar.shown, finals.working, finals.shown);
        let warnings = all_warnings(&finals.labels, &planar, &prepared, subject.area.is_some());
        Ok(Analysis {
            used,
            masks: masks.clone(),
            working: working.clone(),
            windows: windows.shown,
            areas: merged.map.clone(),
            matte: matte.shown,
            illuminant: planar.illuminant,
            planar,
            finals,
            working_finals,
            intrinsic,
            noise: prepared.noise.clone(),
            warnings,
        })
    }

    /// The record of all stages; `None` where a stage has no record.
    pub fn trace(&self) -> Option<Trace> {
        let (_, prepared) = self.masks.made.as_ref()?;
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
        Some(Trace::of_working_picture(prepared.working.blocks, stage_traces?))
    }

    fn masks<R: Recorder>(
        &mut self,
        Subject { image, area }: &Subject,
        params: &Params,
        observer: &mut impl Observer,
    ) -> Result<(Arc<Prepared>, UsedParams), Cancelled> {
        let limits = mask_limits(params, image);
        let factor = scale_factor(params, image);
        let automatic_noise = params.camera_noise == Setting::Auto;
        let automatic_intensity = params.min_intensity == Setting::Auto;
        let depends = automatic_noise || automatic_intensity;
        let camera_noise = depends.then_some(params.camera_noise);
        let key = MaskKey { limits, factor, camera_noise, automatic_intensity, area: area.clone() };
        let pictures = |limits: &MaskLimits| {
            let masks = Masks::new(image, limits);
            let masks = Arc::new(match area {
                Some(area) => masks.within(area),
                None => masks,
            });
            let working = WorkingPicture::new(image, &masks, limits, factor);
            (masks, working)
        };
        let prepared = self.masks.get(Stage::Masks, key, observer, |_, recorder: &mut R| {
            let (masks, working) = pictures(&limits);
            let measured = || NoiseEstimate::measure(&working.image, &working.masks);
            let noise = noise_findings(image, &masks, if automatic_noise { measured() } else { None });
            let (masks, working, limits) = if automatic_intensity {
                let min_intensity = used_params(params, &working.image, factor, &noise).min_intensity;
                let limits = MaskLimits { min_intensity, ..limits };
                let (masks, working) = pictures(&limits);
                (masks, working, limits)
            } else {
                (masks, working, limits)
            };
            let sparse = || NoiseEstimate::measure_sparsely(image, &masks, factor);
            let detail = if factor > 1 && automatic_noise { sparse() } else { None };
            if R::KEEPS {
                let made = masks_made(&working.masks, limits, working.image.pixels.len(), noise.sigma);
                recorder.record(made);
            }
            let working_coding = noise.coding.as_ref().map(|coding| coding.averaged(factor));
            let (working, noise) = (Arc::new(working), Arc::new(noise));
            Arc::new(Prepared { masks, working, noise, working_coding, detail })
        })?;
        let used = used_params(params, &prepared.working.image, factor, &prepared.noise);
        observer.made(StageOutput::Masks { masks: prepared.masks.clone(), used });
        Ok((prepared, used))
    }
}

/// The errors of an image's values; `windows`: the noise that its windows show. A lossless file may hold a picture that was
/// compressed or demosaiced before; the correlation of the noise between neighboring pixels shows it.
fn noise_findings(image: &LinearImage, masks: &Masks, windows: Option<NoiseEstimate>) -> NoiseFindings {
    let coding = image.coding.clone();
    let sigma = windows.map(|windows| windows.sigma);
    let shot = windows.and_then(|windows| windows.shot);
    if coding.as_ref().is_some_and(CodingError::is_extended) {
        return NoiseFindings { sigma, shot, coding, extended: true };
    }
    let Some(correlation) = NoiseCorrelation::measure(image, masks) else {
        return NoiseFindings { sigma, shot, coding, extended: false };
    };
    let coding = coding.map(|coding| if correlation.is_compressed() { coding.as_extended() } else { coding });
    NoiseFindings { sigma, shot, coding, extended: correlation.is_extended() }
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

/// The classified windows. In the paper every pixel counts; with `tail_test` only usable pixels count, and a window gets a class
/// only if at least half of its pixels are usable.
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

/// The merged area of each pixel, from 1; 0 where the window has no class.
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

/// Error of the values, in steps of 1/255 of the coded range, above which compression makes results doubtful.
const DOUBTFUL_CODE_VALUES: f64 = 1.3;
/// Number of pixels below which results are doubtful.
const DOUBTFUL_PIXELS: usize = 10_000;

fn compression_warning(coding: &CodingError) -> Option<String> {
    (coding.is_extended() && coding.code_values > DOUBTFUL_CODE_VALUES).then(|| {
        format!(
            "the picture is compressed so strongly that its values are off by {:.1} code values (standard deviation): the \
             light and faint highlights are not exact",
            coding.code_values
        )
    })
}

fn size_warning(labels: &LabelMap) -> Option<String> {
    let pixels = labels.len();
    (0 < pixels && pixels < DOUBTFUL_PIXELS).then(|| {
        format!(
            "the picture has only {pixels} pixels: windows and regions hold too few of them to be exact, {DOUBTFUL_PIXELS} \
             are enough"
        )
    })
}

/// The warnings about the regions, then about the file's values, then about the size of the regions.
fn all_warnings(
    labels: &LabelMap,
    planar: &PlanarRegions,
    prepared: &Prepared,
    restricted: bool,
) -> Vec<String> {
    let mut all = warnings(labels, planar, &prepared.masks, restricted);
    all.extend(prepared.noise.coding.as_ref().and_then(compression_warning));
    all.extend(size_warning(labels));
    all
}

/// The warnings about the regions, a sentence each. `restricted`: the analysis is restricted to an area.
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
