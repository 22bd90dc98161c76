//! What is doubtful about a whole run, as data: `describe` has the sentences.

use super::Analysis;
use super::contrast::{ContrastFinding, contrast_finding};
use super::prepared::Prepared;
use crate::baseline::{NoSkewedT, no_skewed_t};
use crate::color::axis_angle_deg;
use crate::params::{Baseline, LEAST_LAMPS_ANGLE_DEG};
use crate::photo::{CodingError, LinearImage, Masks};
use crate::raster::LabelMap;
use crate::segment::LightFindings;
use rayon::prelude::*;

/// Error of the values, in steps of 1/255 of the coded range, above which compression makes results doubtful.
const DOUBTFUL_CODE_VALUES: f64 = 1.3;
/// Number of pixels below which results are doubtful.
const DOUBTFUL_PIXELS: usize = 10_000;

/// A doubt about a whole run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RunWarning {
    /// Every pixel is darker than the minimal intensity.
    Dark {
        /// Whether the run was restricted to an area.
        is_restricted: bool,
    },
    /// Every pixel that is not darker than the minimal intensity is clipped, bloomed, or of a clipped object.
    Clipped {
        /// Whether the run was restricted to an area.
        is_restricted: bool,
    },
    /// No window varies along one direction beyond the noise.
    NoLinearArea,
    /// The color of the light is unknown, as these findings tell.
    UnknownLight(LightFindings),
    /// The method finds regions alone: no light and no highlights.
    RegionsAlone,
    /// A second lamp was given, but there is no first light.
    SecondLampAlone,
    /// The second lamp that was given is the light that was found.
    SecondLampIsFirst {
        /// Angle between both, degrees.
        angle_deg: f64,
    },
    /// No region's highlights agree better with the second lamp that was given than with the first light.
    SecondLampIdle,
    /// No pixels were marked for the skewed T of marked pixels: all count as marked.
    NothingMarked,
    /// The marked pixels have no skewed T.
    NoSkewedT {
        /// What is missing.
        why: NoSkewedT,
        /// Whether the run was restricted to an area.
        is_restricted: bool,
    },
    /// One skewed T does not explain the marked pixels.
    SkewedTMisfit {
        /// Root mean square distance of the pixels from the plane, counts.
        rms_counts: f64,
        /// Largest distance that noise explains, counts.
        limit_counts: f64,
        /// Whether the run was restricted to an area.
        is_restricted: bool,
    },
    /// The planes of the regions are bent as by a camera's contrast curve.
    Contrast(ContrastFinding),
    /// The picture is compressed strongly.
    Compressed {
        /// Standard deviation of the error of its values, in steps of 1/255 of the coded range.
        code_values: f64,
    },
    /// The picture has few pixels.
    FewPixels {
        /// Number of pixels.
        pixels: usize,
        /// Number of pixels that are enough.
        enough: usize,
    },
}

fn contrast_warning(image: &LinearImage, analysis: &Analysis) -> Option<RunWarning> {
    contrast_finding(analysis, image.contrast?, image.saturation?).map(RunWarning::Contrast)
}

fn compression_warning(coding: &CodingError) -> Option<RunWarning> {
    let code_values = coding.code_values;
    (coding.is_extended() && code_values > DOUBTFUL_CODE_VALUES)
        .then_some(RunWarning::Compressed { code_values })
}

fn size_warning(labels: &LabelMap) -> Option<RunWarning> {
    let pixels = labels.len();
    (0 < pixels && pixels < DOUBTFUL_PIXELS)
        .then_some(RunWarning::FewPixels { pixels, enough: DOUBTFUL_PIXELS })
}

/// The warnings about the regions, then about the file's values, then about the size of the picture. `is_restricted`: whether the analysis
/// is restricted to an area. `baseline`: the earlier method that found the regions.
pub(super) fn all_warnings(
    image: &LinearImage,
    analysis: &Analysis,
    prepared: &Prepared,
    is_restricted: bool,
    baseline: Option<Baseline>,
) -> Vec<RunWarning> {
    let labels = &analysis.finals.labels;
    let has_regions = labels.as_slice().par_iter().any(|&label| label != 0);
    let mut all = match baseline {
        Some(Baseline::ByHand) => marked_warnings(analysis, is_restricted),
        Some(_) if has_regions => vec![RunWarning::RegionsAlone],
        _ => region_warnings(analysis, &prepared.masks, has_regions, is_restricted),
    };
    if baseline.is_none() {
        all.extend(contrast_warning(image, analysis));
    }
    all.extend(prepared.noise.coding.as_ref().and_then(compression_warning));
    all.extend(size_warning(labels));
    all
}

/// The warnings about the skewed T of marked pixels.
fn marked_warnings(analysis: &Analysis, is_restricted: bool) -> Vec<RunWarning> {
    let mut all = Vec::new();
    if !is_restricted {
        all.push(RunWarning::NothingMarked);
    }
    let why = no_skewed_t(&analysis.working.masks, &analysis.matte, &analysis.planar);
    all.extend(why.map(|why| RunWarning::NoSkewedT { why, is_restricted }));
    let misfits = analysis.intrinsic.regions.iter().filter(|region| !region.model_fits());
    all.extend(misfits.map(|region| RunWarning::SkewedTMisfit {
        rms_counts: region.fit_rms_counts,
        limit_counts: region.fit_limit_counts,
        is_restricted,
    }));
    all
}

/// The warnings about regions and light.
fn region_warnings(
    analysis: &Analysis,
    masks: &Masks,
    has_regions: bool,
    is_restricted: bool,
) -> Vec<RunWarning> {
    let (labels, planar, used) = (&analysis.finals.labels, &analysis.planar, &analysis.used);
    let mut warnings = Vec::new();
    let pixels = || (0..labels.len()).into_par_iter();
    if !pixels().any(|pixel| masks.usable(pixel)) {
        let are_clipped = pixels().any(|pixel| masks.clipped(pixel) && masks.has_value(pixel));
        warnings.push(if are_clipped {
            RunWarning::Clipped { is_restricted }
        } else {
            RunWarning::Dark { is_restricted }
        });
    } else if !has_regions {
        warnings.push(RunWarning::NoLinearArea);
    } else if planar.illuminant.is_none() {
        warnings.push(RunWarning::UnknownLight(planar.light));
    }
    warnings.extend(used.second_illuminant.and_then(|second| second_lamp_warning(second, &planar.light)));
    warnings
}

/// The warning about a second lamp that was given, unit, and that lights nothing.
fn second_lamp_warning(second: [f64; 3], light: &LightFindings) -> Option<RunWarning> {
    let Some(first) = light.direction else { return Some(RunWarning::SecondLampAlone) };
    match light.second {
        None => {
            let angle_deg = axis_angle_deg(&second.into(), &first.into());
            (angle_deg < LEAST_LAMPS_ANGLE_DEG).then_some(RunWarning::SecondLampIsFirst { angle_deg })
        }
        Some(found) => (found.regions == 0).then_some(RunWarning::SecondLampIdle),
    }
}
