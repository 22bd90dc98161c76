//! The fields of the report.

use super::light_facts::{AmbientFacts, IlluminantFacts, NoiseFacts};
use super::region_facts::RegionFacts;
use super::scores::Scores;
use super::skewed_t_facts::SkewedTFacts;
use super::words::sentences;
use crate::analysis::{Analysis, Stage};
use crate::intrinsic::Reason;
use crate::params::{
    AmbientSetting, IlluminantSetting, Method, Parameter, Params, PhoenixSettings, Readings, Refine, Setting,
    parameter_rows,
};
use crate::photo::Photo;
use crate::raster::{Mask, UNASSIGNED};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Version of the schema; the version rises when the name or the meaning of a field changes.
pub const SCHEMA: u32 = 1;

/// The report of one analyzed image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Report {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the program that wrote the report.
    pub program: String,
    /// The file and how it was read.
    pub image: ImageFacts,
    /// The area that the analysis was restricted to, if it was.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area: Option<AreaFacts>,
    /// The settings as asked for and as used.
    pub params: ParamsFacts,
    /// The errors of the image's values; absent in reports of versions that did not ask.
    #[serde(default)]
    pub noise: NoiseFacts,
    /// The working picture; absent in reports of versions that had none.
    #[serde(default)]
    pub scale: ScaleFacts,
    /// The color of the light.
    pub illuminant: IlluminantFacts,
    /// The ambient light; absent in reports of versions that did not estimate ambient light.
    #[serde(default)]
    pub ambient: AmbientFacts,
    /// The skewed T of marked pixels; absent under every other method, and without a highlight line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub skewed_t: Option<SkewedTFacts>,
    /// The regions; region `id` of `regions.png` is at index `id − 1`.
    pub regions: Vec<RegionFacts>,
    /// Number of pixels in no region; with an area, of pixels inside the area.
    pub unassigned_pixels: usize,
    /// Number of pixels by the reason why they are not explained, by name; with an area, of pixels inside the area.
    #[serde(default)]
    pub reasons: BTreeMap<String, usize>,
    /// Warnings, each an English phrase: of the file first, then of the analysis.
    pub warnings: Vec<String>,
    /// The scores against a ground truth, when there was one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scores: Option<Scores>,
    /// Wall time of each step.
    pub timings_ms: Timings,
}

impl Report {
    /// The report of one run. `file_warnings` come from reading the image; area, scores and timings are still empty.
    pub fn new(image: ImageFacts, params: &Params, analysis: &Analysis, file_warnings: &[String]) -> Self {
        let labels = analysis.finals.labels.as_slice();
        let is_unassigned =
            |&(pixel, &id): &(usize, &u16)| id == UNASSIGNED && !analysis.masks.outside(pixel);
        // The paper's light is the average of highlight directions, unless a refinement replaces the average.
        let refine = params.refinements();
        let is_refined = params.method == Method::Refined || refine.robust_illuminant || refine.vote_light;
        let unassigned = labels.par_iter().enumerate().filter(is_unassigned).count();
        Self {
            schema: SCHEMA,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            image,
            area: None,
            params: ParamsFacts::new(params, analysis),
            noise: NoiseFacts::new(analysis),
            scale: ScaleFacts::new(params, analysis),
            illuminant: IlluminantFacts::new(analysis, is_refined),
            ambient: AmbientFacts::new(analysis),
            skewed_t: SkewedTFacts::new(params, analysis),
            regions: analysis.intrinsic.regions.iter().map(RegionFacts::from).collect(),
            unassigned_pixels: unassigned,
            reasons: reasons(analysis),
            warnings: file_warnings.iter().cloned().chain(sentences(&analysis.warnings)).collect(),
            scores: None,
            timings_ms: Timings::default(),
        }
    }
}

/// Number of pixels with each reason.
fn reasons(analysis: &Analysis) -> BTreeMap<String, usize> {
    let none = || [0usize; Reason::ALL.len()];
    let counted = |mut counts: [usize; Reason::ALL.len()], &reason: &Reason| {
        counts[reason as usize] += 1;
        counts
    };
    let sums = analysis.intrinsic.reasons.as_slice().par_iter().fold(none, counted);
    let counts = sums.reduce(none, |a, b| std::array::from_fn(|reason| a[reason] + b[reason]));
    Reason::ALL.iter().zip(counts).map(|(reason, count)| (reason.name().to_owned(), count)).collect()
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

impl ImageFacts {
    /// Of a photograph, and of the SHA-256 of its file.
    pub fn of(photo: &Photo, sha256: &str) -> Self {
        let file = Path::new(&photo.name).file_name().unwrap_or_default();
        Self {
            file: file.to_string_lossy().into_owned(),
            sha256: sha256.to_owned(),
            width: photo.image.width(),
            height: photo.image.height(),
            encoding: photo.encoding.to_string(),
            full_scale: photo.full_scale,
        }
    }
}

/// The area that an analysis was restricted to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AreaFacts {
    /// Name of the mask's file, without folders.
    pub file: String,
    /// Pixels inside.
    pub pixels: usize,
}

impl AreaFacts {
    /// The facts of `mask`, true inside, which is kept in a file of this name.
    pub fn new(file: &str, mask: &Mask) -> Self {
        let pixels = mask.count();
        Self { file: file.to_owned(), pixels }
    }
}

/// The working picture, in which regions and light were found. All counts of pixels in the report are of the photograph's pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ScaleFacts {
    /// Side of a working pixel, pixels; 1: the working picture is the photograph.
    pub factor: usize,
    /// Columns of the working picture.
    pub width: usize,
    /// Rows of the working picture.
    pub height: usize,
    /// Why the factor was used.
    pub reason: String,
    /// The second look at what the working picture left unexplained; null where it found nothing, or nothing was left.
    #[serde(default)]
    pub second_look: Option<SecondLookFacts>,
}

/// The second look, whose regions are the last in the list of regions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SecondLookFacts {
    /// Side of a pixel of the finer picture, pixels.
    pub factor: usize,
    /// Number of its regions.
    pub regions: usize,
}

impl Default for ScaleFacts {
    fn default() -> Self {
        Self { factor: 1, width: 0, height: 0, reason: String::new(), second_look: None }
    }
}

impl ScaleFacts {
    fn new(params: &Params, analysis: &Analysis) -> Self {
        let blocks = &analysis.working.blocks;
        let factor = blocks.side();
        let [width, height] = blocks.picture();
        let megapixels = (width * height) as f64 / 1e6;
        let reason = match (params.scale, factor) {
            (Setting::Value(_), _) => "given".to_owned(),
            (Setting::Auto, 1) => {
                format!("{megapixels:.1} megapixels are not averaged: only larger photographs gain by it")
            }
            (Setting::Auto, _) => format!(
                "{megapixels:.1} megapixels are averaged over blocks of {factor} \u{d7} {factor}: about 0.5 megapixels are left"
            ),
        };
        let second_look =
            analysis.second_look.map(|found| SecondLookFacts { factor: found.side, regions: found.regions });
        Self { factor, width: blocks.columns(), height: blocks.rows(), reason, second_look }
    }
}

/// A parameter as it was asked for and as it was used.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParameterFacts {
    /// A number or `auto`.
    pub asked: Setting,
    /// The number that was used; null where the parameter was off (infinite).
    pub used: Option<f64>,
}

/// The light as it was asked for and as it was used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LightFacts {
    /// Three numbers of any length, or `auto`.
    pub asked: IlluminantSetting,
    /// The unit vector that was used; null where the image gave no evidence of the light.
    pub used: Option<[f64; 3]>,
}

/// The ambient light as it was asked for and as it was used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AmbientAsked {
    /// Three numbers in counts, `auto` or `off`.
    pub asked: AmbientSetting,
    /// The color that was subtracted before the split, counts; null: nothing was subtracted.
    pub used: Option<[f64; 3]>,
}

macro_rules! define_params_facts {
    ($($field:ident $variant:ident $meaning:literal { $($row:tt)* })*) => {
        /// Method, parameters and refinements of a run.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[non_exhaustive]
        pub struct ParamsFacts {
            /// The method.
            pub method: Method,
            $(
                #[doc = concat!($meaning, ".")]
                #[serde(default = "ParameterFacts::unknown")]
                pub $field: ParameterFacts,
            )*
            /// The color of the light. Absent in reports of versions without this setting.
            #[serde(default)]
            pub illuminant: LightFacts,
            /// The color of the second lamp. Absent in reports of versions without this setting.
            #[serde(default)]
            pub second_illuminant: LightFacts,
            /// The ambient light. Absent in reports of versions without this setting.
            #[serde(default)]
            pub ambient: AmbientAsked,
            /// The refinements in force: under the paper's method those that were added to it.
            pub refine: Refine,
            /// How the paper was read; absent under the refined method.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub readings: Option<Readings>,
            /// The parameters of Phoenix; absent under every other method.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub phoenix: Option<PhoenixSettings>,
        }

        impl ParamsFacts {
            /// The parameters that were asked for.
            pub fn asked(&self) -> Params {
                let mut params = Params {
                    $($field: self.$field.asked,)*
                    illuminant: self.illuminant.asked,
                    second_illuminant: self.second_illuminant.asked,
                    ambient: self.ambient.asked,
                    phoenix: self.phoenix.unwrap_or_default(),
                    ..Params::of(self.method)
                };
                match self.method {
                    Method::Refined => params.refine = self.refine,
                    Method::Paper => params.paper.with = self.refine,
                    Method::Phoenix | Method::TopDown | Method::ByHand => {}
                }
                params.paper.readings = self.readings.unwrap_or(params.paper.readings);
                params
            }

            fn new(params: &Params, analysis: &Analysis) -> Self {
                Self {
                    method: params.method,
                    $($field: ParameterFacts::new(Parameter::$variant, params, analysis),)*
                    illuminant: LightFacts {
                        asked: params.illuminant,
                        used: analysis.illuminant.map(|light| light.direction),
                    },
                    second_illuminant: LightFacts {
                        asked: params.second_illuminant,
                        used: analysis.planar.light.second.map(|second| second.direction),
                    },
                    ambient: AmbientAsked {
                        asked: params.ambient,
                        used: analysis.intrinsic.ambient.subtracted,
                    },
                    refine: params.refinements(),
                    readings: (params.method == Method::Paper).then_some(params.paper.readings),
                    phoenix: (params.method == Method::Phoenix).then_some(params.phoenix),
                }
            }
        }
    };
}
parameter_rows!(define_params_facts);

impl ParameterFacts {
    /// The facts of a parameter that a report of an earlier version does not name.
    const fn unknown() -> Self {
        Self { asked: Setting::Auto, used: None }
    }

    fn new(parameter: Parameter, params: &Params, analysis: &Analysis) -> Self {
        let number = analysis.used.get(parameter);
        Self { asked: params.get(parameter), used: number.is_finite().then_some(number) }
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
    /// From the result to all files but the report itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub write: Option<f64>,
}

impl Timings {
    /// The time of one stage, for changes.
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

    /// Sum of the times of all stages, without reading and writing, milliseconds.
    pub fn analysis_ms(mut self) -> f64 {
        Stage::ALL.iter().filter_map(|&stage| *self.slot(stage)).sum()
    }
}
