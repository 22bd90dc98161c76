//! The schema itself.

use super::scores::Scores;
use crate::analysis::{Analysis, Stage};
use crate::intrinsic::RegionReflection;
use crate::raster::UNASSIGNED;
use crate::segment::{Method, Parameter, Params, Refine, Setting, UsedParams};
use serde::{Deserialize, Serialize};

/// Version of the schema; it rises when a field changes its name or its meaning.
pub const SCHEMA: u32 = 1;

/// Everything that is said about one analysed image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the program that wrote it.
    pub program: String,
    /// The file and how it was read.
    pub image: ImageFacts,
    /// What was asked for and what was used.
    pub params: ParamsFacts,
    /// The colour of the light.
    pub illuminant: IlluminantFacts,
    /// The regions; region `id` of `regions.png` is at index `id − 1`.
    pub regions: Vec<RegionFacts>,
    /// Pixels in no region.
    pub unassigned_pixels: usize,
    /// What to beware of, in words: of the file first, then of the analysis.
    pub warnings: Vec<String>,
    /// How it compares with a ground truth, when there was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scores: Option<Scores>,
    /// Wall time of each step.
    pub timings_ms: Timings,
}

impl Report {
    /// The report of one run. `file_warnings` come from reading the image; scores and timings are still empty.
    pub fn new(image: ImageFacts, params: &Params, analysis: &Analysis, file_warnings: &[String]) -> Self {
        let labels = analysis.finals.labels.as_slice();
        let unassigned = labels.iter().filter(|&&id| id == UNASSIGNED).count();
        Self {
            schema: SCHEMA,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            image,
            params: ParamsFacts::new(params, &analysis.used),
            illuminant: IlluminantFacts {
                direction: analysis.illuminant.map(|light| light.direction),
                objects: analysis.illuminant.map_or(0, |light| light.objects),
            },
            regions: analysis.intrinsic.regions.iter().map(RegionFacts::from).collect(),
            unassigned_pixels: unassigned,
            warnings: file_warnings.iter().chain(&analysis.warnings).cloned().collect(),
            scores: None,
            timings_ms: Timings::default(),
        }
    }
}

/// The file and how it was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageFacts {
    /// File name, without folders.
    pub file: String,
    /// SHA-256 of the file's bytes, lower-case hexadecimal.
    pub sha256: String,
    /// Columns, after the file's orientation was applied.
    pub width: usize,
    /// Rows, after the file's orientation was applied.
    pub height: usize,
    /// Encoding that was undone, in words.
    pub encoding: String,
    /// Counts that the file's full scale stands for.
    pub full_scale: f64,
}

/// A parameter as it was asked for and as it was used.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterFacts {
    /// A number or `auto`.
    pub asked: Setting,
    /// The number that the run worked with; null where it was off (infinite).
    pub used: Option<f64>,
}

/// Method, parameters and refinements of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "Parameter::spec describes each")]
pub struct ParamsFacts {
    pub method: Method,
    pub clip_threshold: ParameterFacts,
    pub bloom_density: ParameterFacts,
    pub camera_noise: ParameterFacts,
    pub min_intensity: ParameterFacts,
    pub cylinder_width: ParameterFacts,
    pub slice_width: ParameterFacts,
    pub window_size: ParameterFacts,
    pub min_area: ParameterFacts,
    /// The refinements in force: all off under the paper's method.
    pub refine: Refine,
}

impl ParamsFacts {
    fn new(params: &Params, used: &UsedParams) -> Self {
        let facts = |parameter| {
            let number = used.get(parameter);
            ParameterFacts { asked: params.get(parameter), used: number.is_finite().then_some(number) }
        };
        Self {
            method: params.method,
            clip_threshold: facts(Parameter::ClipThreshold),
            bloom_density: facts(Parameter::BloomDensity),
            camera_noise: facts(Parameter::CameraNoise),
            min_intensity: facts(Parameter::MinIntensity),
            cylinder_width: facts(Parameter::CylinderWidth),
            slice_width: facts(Parameter::SliceWidth),
            window_size: facts(Parameter::WindowSize),
            min_area: facts(Parameter::MinArea),
            refine: params.refinements(),
        }
    }
}

/// The colour of the light and what it rests on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct IlluminantFacts {
    /// Unit vector; null where nothing in the image told of it.
    pub direction: Option<[f64; 3]>,
    /// Number of regions whose highlights it rests on.
    pub objects: usize,
}

/// One region, as [`RegionReflection`] describes it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "RegionReflection describes each")]
pub struct RegionFacts {
    pub id: u16,
    pub pixels: usize,
    pub matte_pixels: usize,
    pub highlight_pixels: usize,
    pub clipped_pixels: usize,
    pub body: [f64; 3],
    pub surface: Option<[f64; 3]>,
    pub matte_mean: [f64; 3],
    pub highlight_start: Option<[f64; 3]>,
    pub plane_normal: Option<[f64; 3]>,
    pub angle_deg: Option<f64>,
    pub fit_rms_counts: f64,
    pub separable: bool,
    pub neighbours: Vec<u16>,
    pub warnings: Vec<String>,
}

impl From<&RegionReflection> for RegionFacts {
    fn from(region: &RegionReflection) -> Self {
        Self {
            id: region.id,
            pixels: region.pixels,
            matte_pixels: region.matte_pixels,
            highlight_pixels: region.highlight_pixels,
            clipped_pixels: region.clipped_pixels,
            body: region.body,
            surface: region.surface,
            matte_mean: region.matte_mean,
            highlight_start: region.highlight_start,
            plane_normal: region.plane_normal,
            angle_deg: region.angle_deg,
            fit_rms_counts: region.fit_rms_counts,
            separable: region.separable,
            neighbours: region.neighbours.clone(),
            warnings: region.warnings.clone(),
        }
    }
}

/// Wall time of each step in milliseconds; a step that did not take place is left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
#[allow(missing_docs, reason = "Stage describes each")]
pub struct Timings {
    /// From the file's bytes to linear light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub read: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mask: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub classify: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub merge: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub linear: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub planar: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clipping: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub split: Option<f64>,
    /// All files of the result but the report itself, which cannot hold the time it has yet to take.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub write: Option<f64>,
}

impl Timings {
    /// The time of one stage, to be set.
    pub fn slot(&mut self, stage: Stage) -> &mut Option<f64> {
        match stage {
            Stage::Masks => &mut self.mask,
            Stage::Classify => &mut self.classify,
            Stage::Merge => &mut self.merge,
            Stage::Linear => &mut self.linear,
            Stage::Planar => &mut self.planar,
            Stage::Clipping => &mut self.clipping,
            Stage::Split => &mut self.split,
        }
    }

    /// All stages together, reading and writing apart.
    pub fn analysis_ms(mut self) -> f64 {
        Stage::ALL.iter().filter_map(|&stage| *self.slot(stage)).sum()
    }
}
