//! The warnings of a run, a sentence each.

use super::Analysis;
use super::prepared::Prepared;
use crate::baseline::{LEAST_MARKED_PX, NoSkewedT, no_skewed_t};
use crate::color::axis_angle_deg;
use crate::params::{Baseline, LEAST_LAMPS_ANGLE_DEG};
use crate::photo::{CodingError, Masks};
use crate::raster::LabelMap;
use crate::reflection::MIN_ANGLE_DEG;
use crate::segment::LightFindings;

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

/// The warnings about the regions, then about the file's values, then about the size of the regions. `baseline`: the earlier method that
/// found the regions.
pub(super) fn all_warnings(
    analysis: &Analysis,
    prepared: &Prepared,
    restricted: bool,
    baseline: Option<Baseline>,
) -> Vec<String> {
    let labels = &analysis.finals.labels;
    let has_regions = labels.as_slice().iter().any(|&label| label != 0);
    let mut all = match baseline {
        Some(Baseline::ByHand) => marked_warnings(analysis, restricted),
        Some(_) if has_regions => {
            vec![
                "the method finds regions alone: no light and no highlights, all is body reflection"
                    .to_owned(),
            ]
        }
        _ => warnings(analysis, &prepared.masks, restricted),
    };
    all.extend(prepared.noise.coding.as_ref().and_then(compression_warning));
    all.extend(size_warning(labels));
    all
}

/// The warnings about the skewed T of marked pixels, a sentence each. `restricted`: the analysis is restricted to an area.
fn marked_warnings(analysis: &Analysis, restricted: bool) -> Vec<String> {
    let mut all = Vec::new();
    if !restricted {
        all.push("no pixels were marked: the skewed T is fitted to the whole picture".to_owned());
    }
    let which = if restricted { "marked" } else { "picture's" };
    let why = no_skewed_t(&analysis.working.masks, &analysis.matte, &analysis.planar);
    all.extend(why.map(|why| match why {
        NoSkewedT::TooFew(usable) => format!(
            "only {usable} of the {which} pixels are neither dark nor clipped: a skewed T needs {LEAST_MARKED_PX}, nothing was fitted"
        ),
        NoSkewedT::Point => {
            format!("the colors of the {which} pixels vary no more than the noise does: no line was fitted")
        }
        NoSkewedT::Line => format!(
            "the colors of the {which} pixels lie on one line: there is no highlight, and all is body reflection"
        ),
        NoSkewedT::Parallel => format!(
            "the matte and the highlight line of the {which} pixels are less than {MIN_ANGLE_DEG:.0}\u{b0} apart: body and surface reflection are not told from each \
             other, and all is body reflection"
        ),
        NoSkewedT::NoMeeting => format!(
            "the matte and the highlight line of the {which} pixels form no skewed T: all is body reflection"
        ),
    }));
    for region in analysis.intrinsic.regions.iter().filter(|region| !region.model_fits()) {
        all.push(format!(
            "one skewed T does not explain the {which} pixels: they lie {:.1} counts from its plane (rms), noise explains {:.1}; \
             they are not split",
            region.fit_rms_counts, region.fit_limit_counts
        ));
    }
    all
}

/// The warnings about the regions, a sentence each. `restricted`: the analysis is restricted to an area.
fn warnings(analysis: &Analysis, masks: &Masks, restricted: bool) -> Vec<String> {
    let (labels, planar, used) = (&analysis.finals.labels, &analysis.planar, &analysis.used);
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
    warnings.extend(used.second_illuminant.and_then(|second| second_lamp_warning(second, &planar.light)));
    warnings
}

/// The warning about a second lamp that was given, unit, and that lights nothing.
fn second_lamp_warning(second: [f64; 3], light: &LightFindings) -> Option<String> {
    let Some(first) = light.direction else {
        return Some(
            "a second lamp was given, but no light was found beside it: give the first light too (illuminant), or leave second_illuminant at \
             `auto`"
                .to_owned(),
        );
    };
    match light.second {
        None => {
            let angle_deg = axis_angle_deg(&second.into(), &first.into());
            (angle_deg < LEAST_LAMPS_ANGLE_DEG).then(|| format!(
                "the second lamp that was given is {angle_deg:.1}\u{b0} from the light found, both are one lamp: give the other light as \
                 illuminant, or leave second_illuminant at `auto`"
            ))
        }
        Some(found) if found.regions == 0 => Some(
            "the highlights of no region agree better with the second lamp that was given than with the first light: all is split with the first"
                .to_owned(),
        ),
        Some(_) => None,
    }
}
